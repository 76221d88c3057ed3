/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a realization between two steps: its elements and interfaces where they are now. */
#ifndef FRACAS_ENGINE_FIELDS_H
#define FRACAS_ENGINE_FIELDS_H

#include "base/err.h"
#include "base/own.h"

#include <stddef.h>
#include <stdint.h>

/* Values that say how an element is loaded: one along it, or the tensor xx, yy, zz, xy, yz, xz. */
typedef struct {
    const char *name; /* stress [Pa]; N [N/m] and M [N], the resultants of a shell */
    size_t components;
} fracas_stress_array;
enum { FRACAS_STRESSES = 2 }; /* at most */

/* Elements have no common nodes, so that cracks are seen open. */
typedef struct {
    size_t elements, interfaces;
    size_t corners; /* nodes of an element */
    size_t ends;    /* nodes of an interface: 1 of a chain, 2 or 3 of a surface */
    const char *name[FRACAS_STRESSES];  /* stresses; NULL: no more */
    size_t components[FRACAS_STRESSES]; /* theirs */
    double time;                        /* s */
    /* [element][node] */
    double (*place)[3];        /* m, now */
    double (*displacement)[3]; /* m, the background's included */
    double (*velocity)[3];     /* m/s, of central difference half a step later */
    double *mass;              /* kg, the node's share */
    /* [element] */
    double *stress[FRACAS_STRESSES]; /* [component]: means over the element */
    int64_t *fragment;               /* from 0, in the order of the record's */
    double *fragment_mass;           /* kg */
    /* [interface] */
    double (*middle)[3];   /* [end] m, now, half-way between its two sides */
    int64_t (*between)[2]; /* its two elements */
    double *damage;        /* 0 to 1 */
    double *opening;       /* m, mean over its Gauss points */
    double *strength;      /* Pa, the least of its Gauss points */
    double *onset_time;    /* s; NaN: not yet, or the batch keeps no interfaces */
    double *reals;         /* memory of the above */
    int64_t *integers;
} fracas_fields;

struct fracas_model;
struct fracas_batch;

/* Room for the fields of one lane. */
FRACAS_MUST_USE fracas_err fracas_fields_create(const struct fracas_model *model,
                                                fracas_fields **fields);
void fracas_fields_destroy(fracas_fields *fields); /* NULL is allowed */
FRACAS_OWNER(fracas_fields, fracas_fields_destroy)

/* Fills them from a lane of the same model, between two steps or after the last. No step depends
 * on it. */
void fracas_batch_fields(struct fracas_batch *batch, size_t lane, fracas_fields *fields);

#endif
