/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `stershic`: the algorithm of Stershic's paper for rings. An open link follows rigid_link_law;
 * the rest of the algorithm is the ring's (engine/formulation/chain/ring_stershic.h). */
#if defined FRACAS_LAW
FRACAS_LAW(stershic, NO, RIGID, NO, NO)
#else

/* Its own numbers: stiffness of contact over E/h [1]; factor xi of the time step for each critical
 * zone [1]; distance of an open interface within which none opens [m], 0: no zone. For the kernels,
 * 1 where all links on steep secants refine the time step, else 0. */
enum { STERSHIC_PENALTY, STERSHIC_REFINEMENT, STERSHIC_ZONE, STERSHIC_STEEP };

#if defined FRACAS_LAW_TABLES

const fracas_kind fracas_zone_softening = {
    "softening",
    "open links on the softening branch while they carry more than E/h times their opening "
    "(the paper's)"};
const fracas_kind fracas_zone_steep = {
    "steep", "all open links that carry more than E/h times their opening, closing ones too: a "
             "hundredth of the ledger's residual and less, for a seventh more steps"};
static const fracas_kind *const zones[] = {&fracas_zone_softening, &fracas_zone_steep};

static const fracas_param stershic_params[] = {
    FRACAS_LAW_REAL(fracture_energy, "J/m2", 0, 0, INFINITY, false, 0,
                    "fracture energy G_c, the same at every interface; or give critical_opening"),
    FRACAS_LAW_REAL(critical_opening, "m", 0, 0, INFINITY, false, 0,
                    "opening delta_c at which an interface is broken, the same at every one; or "
                    "give fracture_energy"),
    FRACAS_LAW_NUMBER("penalty", own[STERSHIC_PENALTY], "1", 1, 0, 100, true, 0,
                      "stiffness of contact by that of an element, E/h"),
    FRACAS_LAW_NUMBER(
        "refinement", own[STERSHIC_REFINEMENT], "1", 0.25, 0, 1, true, 0,
        "factor of the time step while an interface is about to open or softens "
        "steeply, and once more while one is in compression; 0.1 to 0.4 in the paper, "
        "1 for none"),
    {FRACAS_ONE_OF("critical_zone", zones, offsetof(fracas_cohesive, own_choice),
                   "which open links refine the time step")},
    FRACAS_LAW_NUMBER(
        "zone", own[STERSHIC_ZONE], "m", 0, 0, INFINITY, false, 0,
        "once an interface opens, none opens within this distance of it, and elements "
        "between two interfaces so barred suffer damage; 0 for no such zone"),
};

static double stershic_contact(const fracas_cohesive *cohesive)
{
    return cohesive->own[STERSHIC_PENALTY];
}

/* Two critical zones refine the step, each by the same factor  (ring.12). */
static double stershic_finest(const fracas_cohesive *cohesive)
{
    return cohesive->own[STERSHIC_REFINEMENT] * cohesive->own[STERSHIC_REFINEMENT];
}

static double stershic_zone(const fracas_cohesive *cohesive)
{
    return cohesive->own[STERSHIC_ZONE];
}

static void stershic_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN])
{
    own[STERSHIC_STEEP] = spec->cohesive.own_choice == &fracas_zone_steep;
}

const fracas_law fracas_law_stershic = {
    FRACAS_LAW_HEAD(stershic, "stershic",
                    "linear softening of a link that is rigid until its stress reaches its "
                    "strength, with refinement of the time step and fracture-limiting zone (the "
                    "algorithm of Stershic's paper)"),
    .own = stershic_own, .contact = stershic_contact, .finest = stershic_finest,
    .zone = stershic_zone};

#endif
#endif
