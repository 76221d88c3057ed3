/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strength fields: the part shared by all replicas of a point, made once, and the strengths of each
 * replica. */
#ifndef FRACAS_SAMPLER_FIELD_FIELD_H
#define FRACAS_SAMPLER_FIELD_FIELD_H

#include "base/own.h"
#include "base/isa.h"
#include "sampler/strength.h"
#include "sampler/stream.h"

/* The sites of strengths: a mesh as the sampler sees it. Strength k = i*points + g belongs to
 * Gauss point g of interface i. */
typedef struct {
    size_t n;                    /* interfaces */
    size_t points;               /* strengths of each: 1, or one for each of its Gauss points */
    const fracas_extent *extent; /* [n]: extent of each strength of interface i */
    const double (*position)[3]; /* [n*points] m, at the start */
    double period;               /* m: of a body whose ends, along x, are joined; 0: of none */
} fracas_sites;

typedef struct fracas_field fracas_field;

/* The field of these strengths over these sites, which are copied as far as they are needed;
 * `strength` must outlive it. FRACAS_USAGE where they do not go together (`positions`: a file with
 * other sites than these; the caller checks the number of lines of `file`), FRACAS_ENVIRONMENT
 * without memory. */
FRACAS_MUST_USE fracas_err fracas_field_create(const fracas_strength *strength,
                                               const fracas_sites *sites, fracas_field **field);
void fracas_field_destroy(fracas_field *field); /* NULL is allowed */
FRACAS_OWNER(fracas_field, fracas_field_destroy)

/* Draws with this instruction set instead of the best of this CPU; all give the same bits.
 * FRACAS_USAGE if the CPU lacks it. */
FRACAS_MUST_USE fracas_err fracas_field_use(fracas_field *field, fracas_isa isa);

/* Number of strengths of a realization, n*points. */
size_t fracas_field_size(const fracas_field *field);

/* Largest difference found between the field's correlation and the given covariance. All pairs are
 * compared for equally spaced sites and for at most FRACAS_DENSE_SITES; else 128 sites with all.
 * Marginals are exact. 0 where strengths are independent or given. */
double fracas_field_error(const fracas_field *field);

/* sigma_c[k*stride] = strength k [Pa] of the stream's realization; `stride` lets a lane of a batch
 * be filled in place. In graded material (sampler/field/grading.h) the factor is applied. Each
 * value depends on the field and the name of the stream alone. Given strengths come from the file,
 * whatever the stream; NaN beyond its end. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_field_sample(const fracas_field *field,
                                               const fracas_stream *stream, size_t stride,
                                               double *sigma_c);

#endif
