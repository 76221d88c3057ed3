/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A surface as a linear operator, and its critical time step. */
#include "engine/formulation/surface/surface.h"

#include "engine/integrator/frequencies.h"
#include "engine/integrator/integrator.h"
#include "engine/integrator/lanczos.h"

#include <math.h>
#include <stdlib.h>

struct fracas_surface_operator {
    fracas_step step; /* first: it is aligned */
    fracas_surface_constants constants;
};

fracas_err fracas_surface_operator_open(const fracas_model *model, int contact,
                                        fracas_surface_operator **out)
{
    OWN(fracas_surface_operator) op = aligned_alloc(64, (sizeof *op + 63) / 64 * 64);
    if (!op) return fracas_no_memory("the critical time step");
    *op = (fracas_surface_operator){.step = {.width = 1, .lanes = 1},
                                    .constants = fracas_surface_constants_of(model)};
    op->constants.contact = contact;
    op->constants.motion.alpha = 0;
    op->constants.fields = SURFACE_FIELDS;
    op->constants.point_fields = 0; /* no law: interfaces have no state */
    op->constants.speed = 0;
    fracas_surface_division *division;
    TRY(fracas_surface_division_create(&op->constants, 1, false, &division));
    op->step.division = (fracas_division){.parts = 1, .fields = division->fields, .plan = division};
    op->step.state = calloc(division->fields, sizeof *op->step.state);
    if (!op->step.state) return fracas_no_memory("the critical time step");
    *out = op;
    op = NULL;
    return FRACAS_OK;
}

void fracas_surface_operator_apply(fracas_surface_operator *op, const double *u,
                                   double *acceleration)
{
    const fracas_surface_constants *c = &op->constants;
    const fracas_surface_tables *t = c->tables;
    const size_t size = fracas_surface_unknowns(t), fields = fracas_surface_element_fields(c);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < size; i++) op->step.state[e * fields + i] = u[e * size + i];
    (*t->body->kernels)[FRACAS_ISA_BASELINE][1]->sweep[SURFACE_OPERATOR][t->order - 1](c, &op->step,
                                                                                       0, 0);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; i < size; i++)
            acceleration[e * size + i] = op->step.state[e * fields + SURFACE_V * size + i];
}

void fracas_surface_operator_close(fracas_surface_operator *op)
{
    if (!op) return;
    fracas_surface_division_destroy(op->step.division.plan);
    free(op->step.state);
    free(op);
}

static void apply(void *context, const double *w, double *result)
{
    fracas_surface_operator *op = context;
    const fracas_surface_tables *t = op->constants.tables;
    fracas_surface_operator_apply(op, w, result);
    for (size_t i = 0; i < fracas_surface_unknowns(t) * t->nelements; i++) result[i] = -result[i];
}

/* result += t R (t . w)  (shell.16) */
static void add_rotary(const double *table, const double *w, double *result)
{
    const double *t = table + SURFACE_TURNING;
    for (int k = 0; k < 6; k++) {
        double sum = 0;
        for (int l = 0; l < 6; l++)
            sum += table[SURFACE_ROTARY + fracas_surface_entry(k, l)] *
                   (t[0] * w[3 * l] + t[1] * w[3 * l + 1] + t[2] * w[3 * l + 2]);
        for (int i = 0; i < 3; i++) result[3 * k + i] += t[i] * sum;
    }
}

static void multiply_by_mass(void *context, const double *w, double *result)
{
    const fracas_surface_tables *t = ((const fracas_surface_operator *)context)->constants.tables;
    const size_t nodes = (size_t)SURFACE_NODES(t->order), dimension = (size_t)t->body->dimension;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++)
            for (size_t i = 0; i < dimension; i++) {
                const double *u = w + dimension * nodes * e;
                double sum = t->consistent
                                 ? 0
                                 : t->lumped[(2 * e + 1) * nodes + k] * u[dimension * k + i];
                for (size_t l = 0; t->consistent && l < nodes; l++)
                    sum += t->consistent[((3 * e + 2) * nodes + k) * nodes + l] *
                           u[dimension * l + i];
                result[dimension * (nodes * e + k) + i] = sum;
            }
    for (size_t e = 0; t->rotary && e < t->nelements; e++)
        add_rotary(t->rotary + e * SURFACE_ROTARY_TABLE, w + 18 * e, result + 18 * e);
}

/* A little of everything, most of it where elements are small; nothing where nodes are held. */
static void fill_start(const fracas_surface_tables *t, double *start)
{
    const size_t size = fracas_surface_unknowns(t), nodes = (size_t)SURFACE_NODES(t->order);
    double least = INFINITY;
    for (size_t e = 0; e < t->nelements; e++)
        if (t->held[e] != (1ull << size) - 1) least = fmin(least, t->lumped[(2 * e + 1) * nodes]);
    uint64_t noise = 1;
    for (size_t i = 0; i < size * t->nelements; i++) {
        const size_t e = i / size;
        const double part = least / t->lumped[(2 * e + 1) * nodes];
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        start[i] = t->held[e] >> i % size & 1
                       ? 0
                       : part * part * ((double)(noise >> 40) / 16777216.0 - 0.5);
    }
}

/* The highest angular frequency of K u = omega^2 M u, with the bound of Lanczos' iteration added
 * [1/s]. */
static fracas_err largest_frequency(const fracas_model *model, int contact, double *omega)
{
    OWN(fracas_surface_operator) op = NULL;
    TRY(fracas_surface_operator_open(model, contact, &op));
    const fracas_surface_tables *t = op->constants.tables;
    const size_t n = fracas_surface_unknowns(t) * t->nelements;
    double square = 0;
    OWNED double *start = malloc(n * sizeof *start);
    if (!start) return fracas_no_memory("the critical time step");
    fill_start(t, start);
    TRY(fracas_lanczos(&(fracas_lanczos_problem){apply, multiply_by_mass, op, n}, start, &square));
    *omega = sqrt(square);
    if (square > 0 && isfinite(square)) return FRACAS_OK;
    for (size_t i = 0; i < n; i++)
        if (start[i] != 0)
            return fracas_fail(FRACAS_USAGE,
                               "the highest frequency of the mesh cannot be computed: are young, "
                               "density, thickness and all lengths in the units meant? A bare "
                               "number is SI");
    return fracas_fail(FRACAS_USAGE,
                       "every node of the mesh is held: leave an edge free, or refine the mesh");
}

/* Equal for equal K and M. */
static fracas_hash operator_hash(const fracas_model *model)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const struct {
        fracas_hash tables;
        double constant[9];
    } all = {fracas_surface_tables_hash(c.tables),
             {c.thickness, c.c11, c.c12, c.c33, c.d11, c.d12, c.d33, c.normal, c.tangential}};
    return fracas_hash_of(&all, sizeof all);
}

typedef struct {
    const fracas_model *model;
    double omega[2];
    fracas_err err[2];
} frequency_task;

static void find_one(void *context, size_t contact)
{
    frequency_task *task = context;
    task->err[contact] = largest_frequency(task->model, (int)contact, &task->omega[contact]);
}

/* Both at once where the surface is large. */
static fracas_err compute_frequencies(const fracas_model *model, fracas_frequency_pair *found)
{
    enum { LARGE = 10000 /* elements: a tenth of a second */ };
    OWN(fracas_team) team = NULL;
    frequency_task task = {.model = model};
    if (model->elements < LARGE || fracas_team_create(2, &team))
        for (size_t contact = 0; contact < 2; contact++) find_one(&task, contact);
    else fracas_team_run(team, find_one, &task);
    if (!task.err[0] && task.err[1])
        find_one(&task, 1); /* an error's message stays in its thread */
    for (int contact = 0; contact < 2; contact++) TRY(task.err[contact]);
    *found = (fracas_frequency_pair){.whole = task.omega[0], .pressed = task.omega[1]};
    return FRACAS_OK;
}

static fracas_err find_frequencies(const fracas_model *model, fracas_frequency_pair *found)
{
    fracas_frequencies *known = model->spec.frequencies;
    const fracas_hash body = known ? operator_hash(model) : (fracas_hash){0};
    if (known && fracas_frequencies_find(known, &body, found)) return FRACAS_OK;
    TRY(compute_frequencies(model, found));
    return known ? fracas_frequencies_keep(known, &body, found) : FRACAS_OK;
}

/* (membrane.16) */
fracas_err fracas_surface_critical_step(fracas_model *model)
{
    const double limit = fracas_integrator_of(&model->spec)->limit(&model->spec.time);
    fracas_frequency_pair found;
    TRY(find_frequencies(model, &found));
    model->critical_closed = limit / found.whole;
    model->critical_cracked = limit / found.pressed;
    model->critical_step = fmin(model->critical_closed, model->critical_cracked);
    return FRACAS_OK;
}
