/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell as an operator, and its critical time step. */
#include "engine/formulation/shell/shell.h"

#include "engine/formulation/surface/critical_step.h"

#include <stdlib.h>

FRACAS_KERNEL_TABLE(const fracas_shell_kernel, fracas_shell);

struct fracas_shell_operator {
    fracas_step step; /* first: it is aligned */
    fracas_shell_constants constants;
};

fracas_err fracas_shell_operator_open(const fracas_model *model, int contact,
                                      fracas_shell_operator **out)
{
    fracas_shell_operator *op = aligned_alloc(64, (sizeof *op + 63) / 64 * 64);
    if (!op) return fracas_no_memory("the critical time step");
    *op = (fracas_shell_operator){.step = {.width = 1, .lanes = 1},
                                  .constants = fracas_shell_constants_of(model)};
    op->constants.contact = contact;
    op->constants.motion.alpha = 0;
    op->constants.fields = SURFACE_FIELDS;
    op->constants.point_fields = 0; /* no law: interfaces have no state */
    op->step.state = calloc(fracas_shell_state_fields(&op->constants), sizeof *op->step.state);
    if (!op->step.state) {
        free(op);
        return fracas_no_memory("the critical time step");
    }
    *out = op;
    return FRACAS_OK;
}

void fracas_shell_operator_apply(fracas_shell_operator *op, const double *u, double *acceleration)
{
    const fracas_shell_constants *c = &op->constants;
    const size_t fields = fracas_shell_element_fields(c);
    for (size_t e = 0; e < c->tables->nelements; e++)
        for (size_t i = 0; i < SHELL_UNKNOWNS; i++)
            op->step.state[e * fields + i] = u[e * SHELL_UNKNOWNS + i];
    fracas_shell[FRACAS_ISA_BASELINE][1]->sweep[SURFACE_OPERATOR](c, &op->step, 0);
    for (size_t e = 0; e < c->tables->nelements; e++)
        for (size_t i = 0; i < SHELL_UNKNOWNS; i++)
            acceleration[e * SHELL_UNKNOWNS + i] =
                op->step.state[e * fields + SURFACE_V * SHELL_UNKNOWNS + i];
}

void fracas_shell_operator_close(fracas_shell_operator *op)
{
    if (!op) return;
    free(op->step.state);
    free(op);
}

static void apply(void *context, const double *w, double *result)
{
    fracas_shell_operator *op = context;
    fracas_shell_operator_apply(op, w, result);
    for (size_t i = 0; i < SHELL_UNKNOWNS * op->constants.tables->nelements; i++)
        result[i] = -result[i];
}

static double mass_of(const fracas_shell_tables *t, size_t unknown)
{
    return t->mass[unknown / SHELL_UNKNOWNS * 2 * SHELL_NODES + SHELL_NODES +
                   unknown % SHELL_UNKNOWNS / 3];
}

static void multiply_by_mass(void *context, const double *w, double *result)
{
    const fracas_shell_tables *t = ((const fracas_shell_operator *)context)->constants.tables;
    for (size_t i = 0; i < SHELL_UNKNOWNS * t->nelements; i++) result[i] = mass_of(t, i) * w[i];
}

static fracas_err largest_frequency(const fracas_model *model, int contact, double *omega)
{
    fracas_shell_operator *op;
    TRY(fracas_shell_operator_open(model, contact, &op));
    const fracas_shell_tables *t = op->constants.tables;
    const size_t n = SHELL_UNKNOWNS * t->nelements;
    double *scale = malloc(n * sizeof *scale);
    fracas_err err = scale ? FRACAS_OK : fracas_no_memory("the critical time step");
    for (size_t i = 0; scale && i < n; i++)
        scale[i] = t->held[i / SHELL_UNKNOWNS] >> i % SHELL_UNKNOWNS & 1
                       ? 0
                       : mass_of(t, i / SHELL_UNKNOWNS * SHELL_UNKNOWNS);
    if (!err)
        err = fracas_surface_frequency(&(fracas_lanczos_problem){apply, multiply_by_mass, op, n},
                                       scale, omega);
    free(scale);
    fracas_shell_operator_close(op);
    return err;
}

fracas_err fracas_shell_critical_step(fracas_model *model)
{
    double whole, pressed;
    TRY(largest_frequency(model, 0, &whole));
    TRY(largest_frequency(model, 1, &pressed));
    fracas_surface_set_critical_step(model, whole, pressed);
    return FRACAS_OK;
}
