/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane as an operator, and its critical time step. */
#include "engine/formulation/surface/membrane.h"

#include "engine/formulation/surface/critical_step.h"

#include <stdlib.h>

FRACAS_KERNEL_TABLE(const fracas_membrane_kernel, fracas_membrane);

struct fracas_membrane_operator {
    fracas_step step; /* first: it is aligned */
    fracas_membrane_constants constants;
};

fracas_err fracas_membrane_operator_open(const fracas_model *model, int contact,
                                         fracas_membrane_operator **out)
{
    fracas_membrane_operator *op = aligned_alloc(64, (sizeof *op + 63) / 64 * 64);
    if (!op) return fracas_no_memory("the critical time step");
    *op = (fracas_membrane_operator){.step = {.width = 1, .lanes = 1},
                                     .constants = fracas_membrane_constants_of(model)};
    op->constants.contact = contact;
    op->constants.motion.alpha = 0;
    op->constants.fields = SURFACE_FIELDS;
    op->constants.point_fields = 0; /* no law: interfaces have no state */
    op->constants.speed = 0;
    op->step.state = calloc(fracas_membrane_state_fields(&op->constants), sizeof *op->step.state);
    if (!op->step.state) {
        free(op);
        return fracas_no_memory("the critical time step");
    }
    *out = op;
    return FRACAS_OK;
}

void fracas_membrane_operator_apply(fracas_membrane_operator *op, const double *u,
                                    double *acceleration)
{
    const fracas_membrane_constants *c = &op->constants;
    const size_t size = 2 * (size_t)MEMBRANE_NODES(c->tables->order),
                 fields = fracas_membrane_element_fields(c);
    for (size_t e = 0; e < c->tables->nelements; e++)
        for (size_t i = 0; i < size; i++) op->step.state[e * fields + i] = u[e * size + i];
    fracas_membrane[FRACAS_ISA_BASELINE][1]->sweep[SURFACE_OPERATOR][c->tables->order - 1](
        c, &op->step, 0);
    for (size_t e = 0; e < c->tables->nelements; e++)
        for (size_t i = 0; i < size; i++)
            acceleration[e * size + i] = op->step.state[e * fields + SURFACE_V * size + i];
}

void fracas_membrane_operator_close(fracas_membrane_operator *op)
{
    if (!op) return;
    free(op->step.state);
    free(op);
}

static void apply(void *context, const double *w, double *result)
{
    fracas_membrane_operator *op = context;
    const fracas_membrane_tables *t = op->constants.tables;
    fracas_membrane_operator_apply(op, w, result);
    for (size_t i = 0; i < 2 * (size_t)MEMBRANE_NODES(t->order) * t->nelements; i++)
        result[i] = -result[i];
}

static void multiply_by_mass(void *context, const double *w, double *result)
{
    const fracas_membrane_tables *t = ((const fracas_membrane_operator *)context)->constants.tables;
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++)
            for (size_t i = 0; i < 2; i++) {
                const double *u = w + 2 * nodes * e;
                double sum = t->consistent ? 0 : t->lumped[(2 * e + 1) * nodes + k] * u[2 * k + i];
                for (size_t l = 0; t->consistent && l < nodes; l++)
                    sum += t->consistent[((3 * e + 2) * nodes + k) * nodes + l] * u[2 * l + i];
                result[2 * (nodes * e + k) + i] = sum;
            }
}

static fracas_err largest_frequency(const fracas_model *model, int contact, double *omega)
{
    fracas_membrane_operator *op;
    TRY(fracas_membrane_operator_open(model, contact, &op));
    const fracas_membrane_tables *t = op->constants.tables;
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order), n = 2 * nodes * t->nelements;
    double *scale = malloc(n * sizeof *scale);
    fracas_err err = scale ? FRACAS_OK : fracas_no_memory("the critical time step");
    for (size_t i = 0; scale && i < n; i++) {
        const size_t e = i / (2 * nodes);
        scale[i] = t->held && (t->held[e] >> i % (2 * nodes) & 1) ? 0
                                                                  : t->lumped[(2 * e + 1) * nodes];
    }
    if (!err)
        err = fracas_surface_frequency(&(fracas_lanczos_problem){apply, multiply_by_mass, op, n},
                                       scale, omega);
    free(scale);
    fracas_membrane_operator_close(op);
    return err;
}

/* (membrane.16) */
fracas_err fracas_membrane_critical_step(fracas_model *model)
{
    double whole, pressed;
    TRY(largest_frequency(model, 0, &whole));
    TRY(largest_frequency(model, 1, &pressed));
    fracas_surface_set_critical_step(model, whole, pressed);
    return FRACAS_OK;
}
