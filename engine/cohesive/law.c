/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/cohesive/law.h"

#include "engine/formulation/formulation.h"

#define FRACTURE_ENERGY(least, otherwise, what)                                      \
    {                                                                                \
        "fracture_energy", FRACAS_REAL, "J/m2", what, otherwise, 0, INFINITY, least, \
            offsetof(fracas_cohesive, fracture_energy)                               \
    }

const fracas_kind fracas_onset_mean = {.name = "mean",
                                       .doc = "the mean of the stresses on both sides"};
const fracas_kind fracas_onset_flux = {.name = "flux",
                                       .doc = "the traction of the discontinuous-Galerkin flux"};
static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};

/* Of surfaces, whose interfaces can slide too. */
#define OF_SURFACES                                                                              \
    {"fracture_energy",                                                                          \
     FRACAS_REAL,                                                                                \
     "J/m2",                                                                                     \
     "fracture energy G_c, the same at every interface; or give critical_opening",               \
     0,                                                                                          \
     0,                                                                                          \
     INFINITY,                                                                                   \
     false,                                                                                      \
     offsetof(fracas_cohesive, fracture_energy),                                                 \
     .only = fracas_surface_models},                                                             \
        {"critical_opening",                                                                     \
         FRACAS_REAL,                                                                            \
         "m",                                                                                    \
         "opening delta_c at which an interface is broken, the same at every one: its G_c is "   \
         "strength delta_c/2; or give fracture_energy",                                          \
         0,                                                                                      \
         0,                                                                                      \
         INFINITY,                                                                               \
         false,                                                                                  \
         offsetof(fracas_cohesive, critical_opening),                                            \
         .only = fracas_surface_models},                                                         \
        {"beta",                                                                                 \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element by its edge; " \
         "1.3 or more, 2.3 "                                                                     \
         "with quadratic triangles",                                                             \
         5,                                                                                      \
         1.3,                                                                                    \
         1e4,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, beta),                                                        \
         .only = fracas_membrane_models},                                                        \
        {"beta",                                                                                 \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element by its edge",  \
         5,                                                                                      \
         2.3,                                                                                    \
         1e4,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, beta),                                                        \
         .only = fracas_shell_models},                                                           \
        {"beta_shear",                                                                           \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "stiffness that keeps faces from shearing off across the shell: beta_shear E "          \
         "thickness/(2 (1 + nu) h) by "                                                          \
         "length of the edge",                                                                   \
         1,                                                                                      \
         0,                                                                                      \
         1e4,                                                                                    \
         true,                                                                                   \
         offsetof(fracas_cohesive, beta_shear),                                                  \
         .only = fracas_shell_models},                                                           \
        {.name = "onset",                                                                        \
         .type = FRACAS_CHOICE,                                                                  \
         .unit = "1",                                                                            \
         .doc = "what is held against the strength",                                             \
         .choices = onsets,                                                                      \
         .nchoices = FRACAS_COUNT(onsets),                                                       \
         .offset = offsetof(fracas_cohesive, onset),                                             \
         .only = fracas_surface_models},                                                         \
        {"coupling",                                                                             \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "shear strength by normal strength, beta_c",                                            \
         1,                                                                                      \
         0.01,                                                                                   \
         100,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, coupling),                                                    \
         .only = fracas_surface_models},                                                         \
    {                                                                                            \
        "friction", FRACAS_REAL, "1",                                                            \
            "Coulomb's coefficient of friction between closed faces, mu_c", 0, 0, 10, false,     \
            offsetof(fracas_cohesive, friction), .only = fracas_surface_models                   \
    }

static const fracas_param nitsche[] = {
    {"fracture_energy", FRACAS_REAL, "J/m2", "fracture energy G_c", FRACAS_REQUIRED, 0, INFINITY,
     true, offsetof(fracas_cohesive, fracture_energy), .only = fracas_chain_models},
    {"beta", FRACAS_REAL, "1",
     "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or more in practice",
     4, 1, 1e4, true, offsetof(fracas_cohesive, beta), .only = fracas_chain_models},
    OF_SURFACES,
};
const fracas_kind fracas_law_nitsche = {
    .name = "nitsche",
    .doc = "linear softening, the opening in series with the discontinuous-Galerkin flux",
    .params = nitsche,
    .nparams = FRACAS_COUNT(nitsche)};

static const fracas_param rigid_link[] = {
    FRACTURE_ENERGY(true, FRACAS_REQUIRED, "fracture energy G_c")};
const fracas_kind fracas_law_rigid_link = {
    .name = "rigid-link",
    .doc = "linear softening of a link that is rigid until its stress has exceeded its strength, "
           "contact by penalty (the algorithm of the code DynFrag1D)",
    .params = rigid_link,
    .nparams = FRACAS_COUNT(rigid_link)};

const fracas_kind fracas_zone_softening = {
    .name = "softening",
    .doc = "open links on the softening branch while they carry more than E/h times their opening "
           "(the paper's)"};
const fracas_kind fracas_zone_steep = {
    .name = "steep",
    .doc = "all open links that carry more than E/h times their opening, closing ones too: a "
           "hundredth of the ledger's residual and less, for a seventh more steps"};
static const fracas_kind *const zones[] = {&fracas_zone_softening, &fracas_zone_steep};

static const fracas_param stershic[] = {
    FRACTURE_ENERGY(false, 0,
                    "fracture energy G_c, the same at every interface; or give critical_opening"),
    {"critical_opening", FRACAS_REAL, "m",
     "opening delta_c at which an interface is broken, the same at every one; or give "
     "fracture_energy",
     0, 0, INFINITY, false, offsetof(fracas_cohesive, critical_opening)},
    {"penalty", FRACAS_REAL, "1", "stiffness of contact by that of an element, E/h", 1, 0, 100,
     true, offsetof(fracas_cohesive, penalty)},
    {"refinement", FRACAS_REAL, "1",
     "factor of the time step while an interface is about to open or softens steeply, and once "
     "more while one is in compression; 0.1 to 0.4 in the paper, 1 for none",
     0.25, 0, 1, true, offsetof(fracas_cohesive, refinement)},
    {.name = "critical_zone",
     .type = FRACAS_CHOICE,
     .unit = "1",
     .doc = "which open links refine the time step",
     .choices = zones,
     .nchoices = FRACAS_COUNT(zones),
     .offset = offsetof(fracas_cohesive, critical_zone)},
    {"zone", FRACAS_REAL, "m",
     "once an interface opens, none opens within this distance of it, and elements between two "
     "interfaces so barred suffer damage; 0 for no such zone",
     0, 0, INFINITY, false, offsetof(fracas_cohesive, zone)},
};
const fracas_kind fracas_law_stershic = {
    .name = "stershic",
    .doc = "linear softening of a link that is rigid until its stress reaches its strength, with "
           "refinement of the time step and fracture-limiting zone (the algorithm of Stershic's "
           "paper)",
    .params = stershic,
    .nparams = FRACAS_COUNT(stershic)};

static const fracas_param extrinsic[] = {OF_SURFACES};
const fracas_kind fracas_law_camacho_ortiz_standard = {
    .name = "camacho-ortiz-standard",
    .doc = "linear softening of an interface that leaves the discontinuous-Galerkin flux at onset "
           "(the usual extrinsic law): wants a time.safety of 0.05",
    .params = extrinsic,
    .nparams = FRACAS_COUNT(extrinsic)};
const fracas_kind fracas_law_camacho_ortiz = {
    .name = "camacho-ortiz",
    .doc = "the same with normal and shear traction scaled by those at onset (Becker and Noels' "
           "paper); dissipates less than G_c on mixed paths: for comparison",
    .params = extrinsic,
    .nparams = FRACAS_COUNT(extrinsic)};

static const fracas_kind *const laws[] = {&fracas_law_nitsche, &fracas_law_rigid_link,
                                          &fracas_law_stershic, &fracas_law_camacho_ortiz_standard,
                                          &fracas_law_camacho_ortiz};

/* Where the table leaves the choice between two keys; it demands the fracture energy elsewhere. */
static fracas_err check_cohesive(const void *section)
{
    const fracas_cohesive *cohesive = section;
    if ((cohesive->fracture_energy > 0) != (cohesive->critical_opening > 0)) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE, "law %s takes either fracture_energy or critical_opening, and %s given: %s",
        cohesive->law->name, cohesive->fracture_energy > 0 ? "both are" : "neither is",
        cohesive->fracture_energy > 0
            ? "leave one out, or set it to 0 where a sweep would inherit it"
            : "add one, for instance `fracture_energy: 100 J/m2`");
}

const fracas_section fracas_cohesive_section = {
    .name = "cohesive",
    .doc = "How interfaces open",
    .selector = "law",
    .kinds = laws,
    .nkinds = FRACAS_COUNT(laws),
    .kind_offset = offsetof(fracas_cohesive, law),
    .offset = offsetof(fracas_spec, cohesive),
    .hashed = true,
    .check = check_cohesive,
};
