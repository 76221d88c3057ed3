/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cohesive laws: traction against opening once an interface has reached its strength
 * (docs/theory/cohesive.md).
 *
 * A law is one file, engine/cohesive/LAW.h, and its line in laws.list.h. The list is included in
 * three modes, and a law's file has one part for each:
 *   FRACAS_LAW(name, bar, ring, membrane, shell) is defined: the law's line. For each body it says
 *       how the kernels use the law: FLUX or RIGID for chains, YES for surfaces, RESULTANTS for
 *       shells, or NO.
 *   FRACAS_LAW_TABLES is defined: parameters and traits, compiled once (law.c).
 *   Neither is defined: the functions over lanes (engine/cohesive/kernels.h). A law that says FLUX
 *       defines line_NAME (kernels.h). One that says YES defines plane_at_NAME, which brings the
 *       point's fields up to date but in a calm step (plane.h), and plane_opening_NAME, from which
 *       break times are interpolated. Where the flux stays in series, it is an envelope: series.h
 *       has the rest. One that says RESULTANTS acts on those of a shell's Gauss point, not at its
 *       layers: it defines resultant_at_NAME and resultant_opening_NAME (resultants.h).
 * D is 0 before the onset and exactly 1 once broken; fragments and events compare with 1. The
 * traction is 0 at the break. A law that ends at T_b > 0 there counts the stored energy as
 * dissipated, on chains T_b^2/(2K) of the flux, too: a break's `created` is that of its mean alone.
 * A parameter of one law alone is a number own[] of the section (FRACAS_LAW_NUMBER), which kernels
 * read as in->own[] or at->own[]. The trait `own` can compute more from them.
 * Code outside a law's file asks for its traits and never which law it is. */
#ifndef FRACAS_ENGINE_COHESIVE_LAW_H
#define FRACAS_ENGINE_COHESIVE_LAW_H

#include "engine/spec.h"

/* Keeps or drops its argument, by an entry of a law's line. */
#define FRACAS_IF_YES(...) __VA_ARGS__
#define FRACAS_IF_FLUX(...) __VA_ARGS__
#define FRACAS_IF_RIGID(...) __VA_ARGS__
#define FRACAS_IF_RESULTANTS(...) __VA_ARGS__
#define FRACAS_IF_NO(...)

/* Numbers of the laws, 0 to FRACAS_LAWS - 1, in the order of the list. */
#define FRACAS_LAW(name, bar, ring, membrane, shell) FRACAS_LAW_##name,
enum {
#include "engine/cohesive/laws.list.h"
    FRACAS_LAWS
};
#undef FRACAS_LAW

/* First values of a surface's point in every law: damage D, and the peak p [Pa], 0 before onset;
 * then its own, SURFACE_POINT_FIELDS_MOST in all. */
enum { SURFACE_DAMAGE, SURFACE_PEAK, SURFACE_POINT_FIELDS, SURFACE_POINT_FIELDS_MOST = 8 };

typedef struct {
    fracas_kind kind; /* first: an entry of the section `cohesive` */
    int number;       /* FRACAS_LAW_name */
    /* True: the flux holds the interface until onset, the opening is in series with it. False: an
     * interface of a chain is rigid until onset, one of a surface leaves the flux there. */
    bool flux;
    /* G_c over sigma_c delta_c; NULL: 1/2, linear softening. */
    double (*fullness)(const fracas_cohesive *);
    /* Slope of its steepest softening over sigma_c^2/(2 G_c); laws with `flux`, whose stiffness
     * must exceed it. NULL: 1. */
    double (*steepest)(const fracas_cohesive *);
    /* Fills the law's own numbers as its kernels read them, from own[] of the section; a body's
     * lanes and interfaces share them. NULL: as they are. */
    void (*own)(const fracas_spec *, double own[FRACAS_LAW_OWN]);
    /* True: it gains or loses energy on mixed paths. The energy guard then ends no run. */
    bool open_ledger;
    /* True: normal and shear tractions keep their shares of the onset, so that a break on a mixed
     * path takes less than G_c. */
    bool shares_of_onset;
    int fields[2]; /* surfaces: values without, with friction, at most SURFACE_POINT_FIELDS_MOST */
    /* Surfaces: where a Gauss point's values have a resultant that is its peak times the thickness
     * after a break by tension alone; 0: nowhere. */
    int tension;
    /* Chains. */
    double (*contact)(const fracas_cohesive *); /* contact stiffness over E/h, 1; NULL: at most 1 */
    /* Stiffness of contact of an interface of this sigma_c [Pa/m]; NULL: by `contact`. */
    double (*contact_by_strength)(const fracas_spec *, double strength);
    /* Constant of an interface, of its stiffness K [Pa/m] and sigma_c [Pa]; NULL: 0. */
    double (*constant)(const fracas_cohesive *, double stiffness, double strength);
    /* Least factor by which the law refines the time step, 0 to 1; NULL: it does not. */
    double (*finest)(const fracas_cohesive *);
    /* Distance of an open interface within which none opens [m]; NULL: 0. */
    double (*zone)(const fracas_cohesive *);
} fracas_law;

#define FRACAS_LAW(name, bar, ring, membrane, shell) extern const fracas_law fracas_law_##name;
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW

static inline const fracas_law *fracas_law_of(const fracas_spec *spec)
{
    return (const fracas_law *)(const void *)spec->cohesive.law; /* .kind is its first member */
}

/* The traits, with what NULL stands for. */
double fracas_law_fullness(const fracas_cohesive *cohesive);
double fracas_law_steepest(const fracas_cohesive *cohesive);
double fracas_law_zone(const fracas_cohesive *cohesive);
void fracas_law_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN]);

extern const fracas_section fracas_cohesive_section;
extern const fracas_kind fracas_onset_mean, fracas_onset_flux;
/* True where the mean of the stresses is held against the strength, not the flux. */
bool fracas_onset_by_mean(const fracas_cohesive *cohesive);
extern const fracas_kind fracas_zone_softening, fracas_zone_steep; /* stershic's own_choice */

#endif
