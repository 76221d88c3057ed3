/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Characteristic scales of dynamic fragmentation and laws for the mean fragment size
 * (docs/theory/scaling-laws.md). */
#ifndef FRACAS_ANALYSIS_ESTIMATE_SCALES_H
#define FRACAS_ANALYSIS_ESTIMATE_SCALES_H

#include <stdbool.h>

typedef struct {
    double time;    /* t0 [s] */
    double size;    /* s0 [m] */
    double rate;    /* edot0 [1/s] */
    double modulus; /* M of the strengths, of Mott's law; NaN: they have none */
} fracas_scales;

/* t0 = E Gc/(sigma_c^2 c), s0 = c t0, edot0 = c sigma_c^3/(E^2 Gc) with c = sqrt(E/rho)
 * (scaling-laws.1) to (scaling-laws.3). young E > 0 [Pa], density rho > 0 [kg/m3], strength sigma_c
 * > 0 [Pa], fracture_energy Gc > 0 [J/m2]; a NaN argument gives NaN scales. The modulus is NaN. */
fracas_scales fracas_scales_of(double young, double density, double strength,
                               double fracture_energy);

/* Mean strengths of pieces of a chain that interfaces make up as weakest links. */
typedef struct {
    double mean, least; /* Pa, of an interface; 0 <= least < mean */
    double size;        /* m of the chain that an interface stands for */
    double exponent;    /* m of strengths - least = x (size/s)^(1/m); NaN: uniform */
    double specimens;   /* uniform: in an interface, n of x (n + 1)/(n s/size + 1) */
} fracas_piece_strength;

/* Mean strength of a piece of length s > 0 [Pa]  (scaling-laws.17), (scaling-laws.18) */
double fracas_piece_strength_at(const fracas_piece_strength *of, double s);

/* Mean strength of a piece as long as its own s0 = young Gc/strength^2 [Pa]  (scaling-laws.19): one
 * for all meshes. fracture_energy Gc [J/m2] is at the strength of an interface; in proportion to
 * the strength if `opening`. NaN where there is no such piece, or there may be several. */
double fracas_piece_strength_find(const fracas_piece_strength *of, double young,
                                  double fracture_energy, bool opening);

/* True if lines of scaling laws are the same but for round-off. */
bool fracas_scales_same(const fracas_scales *a, const fracas_scales *b);

typedef enum {
    FRACAS_LAW_ZMR,              /* Zhou, Molinari & Ramesh, APL 2006 */
    FRACAS_LAW_GRADY,            /* Grady 1982 */
    FRACAS_LAW_GLENN_CHUDNOVSKY, /* Glenn & Chudnovsky 1986 */
    FRACAS_LAW_ZMR2,             /* Zhou, Molinari & Ramesh 2006, second form */
    FRACAS_LAW_MOTT              /* Mott 1947, with the mean of Grady 1981 */
} fracas_scaling_law_id;

#define FRACAS_SCALING_LAWS 5

typedef struct {
    const char *key;  /* in JSON and CSV */
    const char *name; /* in tables and legends */
    double (*normalised)(
        double e,
        double modulus); /* s/s0 at e = edot/edot0 > 0; Mott's alone depends on the modulus */
} fracas_scaling_law;

/* Indexed by fracas_scaling_law_id. */
extern const fracas_scaling_law fracas_scaling_laws[FRACAS_SCALING_LAWS];

/* s [m] = s0 f(rate/edot0, M), rate > 0 [1/s]; NaN by Mott's law without a modulus. */
double fracas_scaling_law_at(fracas_scaling_law_id law, const fracas_scales *scales, double rate);

#endif
