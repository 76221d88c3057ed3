/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any law of engine/cohesive/laws.list.h at one point, called with plain numbers. */
#ifndef FRACAS_TESTS_SUPPORT_LAW_POINT_H
#define FRACAS_TESTS_SUPPORT_LAW_POINT_H

#include "base/isa.h"
#include "engine/cohesive/law.h"

/* How kernels use a law: an interface of a chain in series with the flux, an open rigid link, a
 * point of a surface, a Gauss point of a shell under membrane forces alone. */
typedef enum { LAW_LINE, LAW_LINK, LAW_PLANE, LAW_RESULTANTS } law_form;

typedef struct {
    int law; /* its number */
    law_form form;
    double k_n, k_t, beta_c; /* Pa/m, Pa/m, 1 */
    double sigma_c, energy;  /* Pa, J/m2 */
    double constant;         /* the law's, of lines */
    double thickness;        /* m, of resultants */
    int onset_mean;
    double own[FRACAS_LAW_OWN];
} law_case;

/* Mean tractions [Pa], jumps [m]. */
typedef struct {
    double m_n, m_t, q_n, q_t;
} law_at;

/* What a law keeps: values of a surface's point or of three layers; of lines D alone. */
typedef struct {
    double value[3 * SURFACE_POINT_FIELDS_MOST];
} law_memory;

/* Tractions [Pa], the flux's part of the jumps [m], energies [J/m2]: of the flux, of openings and
 * contact, dissipated so far, put in by this step. */
typedef struct {
    double t_n, t_t, s_n, s_t, flux, stored, dissipated, created, damage, peak;
    double opening; /* over that of the break; once it has cracked */
    int cracked, cracks, breaks;
} law_out;

/* A unit (base/isa.h) of tests/support/law_kernel.c. Arrays are [lane]; lanes share law, form,
 * thickness, onset and own numbers. */
typedef void law_unit(const law_case *const *kind, const law_at *in, law_memory *memory,
                      law_out *out);

#endif
