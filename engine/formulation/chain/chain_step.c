/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The critical time step of a chain, by power iteration on its linearised operator. */
#include "engine/formulation/chain/chain.h"

#include "engine/cohesive/law.h"
#include "engine/integrator/critical_step.h"

#include <math.h>
#include <stdlib.h>

typedef struct {
    const fracas_model *model;
    const double *size; /* m, of each element; NULL: all alike */
    size_t elements;
    bool ring;   /* the last interface closes the chain */
    bool closed; /* all interfaces uncracked; else all broken and in contact */
} chain_operator;

static double size_of(const chain_operator *o, size_t e)
{
    return o->size ? o->size[e] : o->model->element_size;
}

static double modulus_of(const chain_operator *o, size_t e)
{
    return o->model->spec.material.young / size_of(o, e);
}

static bool has_flux(const chain_operator *o)
{
    return o->closed && fracas_law_of(&o->model->spec)->flux;
}

/* Stiffness of a broken interface in contact. */
static double contact_of(const chain_operator *o, size_t left, size_t right)
{
    const fracas_spec *spec = &o->model->spec;
    const fracas_law *law = fracas_law_of(spec);
    const double factor = law->contact ? law->contact(&spec->cohesive) : 1.0;
    return factor * (0.5 * (modulus_of(o, left) + modulus_of(o, right)));
}

/* result = M^-1 K w, w = (left, right) node of each element: equations (bar.6) and (bar.7), linear.
 * Nodes tied by a rigid link share their force. */
static void apply_chain(const void *context, const double *w, double *result)
{
    const chain_operator *o = context;
    const size_t n = o->elements;
    for (size_t e = 0; e < n; e++) {
        double stress = modulus_of(o, e) * (w[2 * e + 1] - w[2 * e]);
        result[2 * e] = -stress;
        result[2 * e + 1] = stress;
    }
    const bool tied = o->closed && !has_flux(o);
    for (size_t l = 0; l < (o->ring ? n : n - 1); l++) {
        const size_t r = l + 1 < n ? l + 1 : 0;
        const double q = w[2 * r] - w[2 * l + 1];
        if (tied) continue;
        double traction = contact_of(o, l, r) * q;
        if (o->closed) {
            const double left = 0.5 * modulus_of(o, l), right = 0.5 * modulus_of(o, r);
            traction += left * (w[2 * l + 1] - w[2 * l]) + right * (w[2 * r + 1] - w[2 * r]);
            result[2 * l] -= left * q;
            result[2 * l + 1] += left * q;
            result[2 * r] -= right * q;
            result[2 * r + 1] += right * q;
        }
        result[2 * l + 1] -= traction;
        result[2 * r] += traction;
    }
    for (size_t l = 0; tied && l < (o->ring ? n : n - 1); l++) {
        const size_t r = l + 1 < n ? l + 1 : 0;
        double share = (result[2 * l + 1] + result[2 * r]) / (size_of(o, l) + size_of(o, r));
        result[2 * l + 1] = share * size_of(o, l);
        result[2 * r] = share * size_of(o, r);
    }
    if (!o->ring) result[0] = result[2 * n - 1] = 0;
    for (size_t i = 0; i < 2 * n; i++)
        result[i] /= 0.5 * o->model->spec.material.density * size_of(o, i / 2);
}

/* The extreme modes of a regular chain: nodes of an element, or whole elements, in turn up and
 * down; a little of everything else for other cases; most of it where elements are small. Tied
 * nodes of a rigid link have equal values. */
static void fill_start(const chain_operator *o, double *start)
{
    const size_t n = o->elements;
    const bool tied = o->closed && !has_flux(o);
    double least = size_of(o, 0);
    for (size_t e = 1; e < n; e++) least = fmin(least, size_of(o, e));
    uint64_t noise = 1;
    for (size_t e = 0; e < n; e++) {
        double sign = e % 2 ? -1.0 : 1.0, part = least / size_of(o, e),
               large = part * part * part * part;
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        double small = 1e-3 * ((double)(noise >> 40) / 16777216.0 - 0.5);
        start[2 * e] = tied ? large * sign + small : large * (1.0 + 0.5 * sign) + small;
        start[2 * e + 1] = tied ? 0.0 : large * (-1.0 + 0.25 * sign) - small;
    }
    for (size_t e = 0; tied && e < n; e++) start[2 * e + 1] = start[2 * ((e + 1) % n)];
    if (!o->ring) start[0] = start[2 * n - 1] = 0;
}

/* A regular chain's largest frequency is that of a short one: 1024 elements at most are looked at.
 */
static fracas_err critical_step(const fracas_model *model, const double *size, bool closed,
                                double *step)
{
    enum { ENOUGH = 1024 };
    const size_t n = !size && model->elements > ENOUGH ? ENOUGH : model->elements;
    const chain_operator o = {model, size, n, fracas_chain_is_closed(model), closed};
    double omega_squared, *start = malloc(2 * n * sizeof *start);
    if (!start) return fracas_no_memory("the critical time step");
    fill_start(&o, start);
    fracas_err code = fracas_power_iteration(apply_chain, &o, 2 * n, start, &omega_squared);
    free(start);
    *step = FRACAS_CENTRAL_DIFFERENCE_LIMIT / sqrt(omega_squared);
    return code;
}

/* (bar.16) */
fracas_err fracas_chain_critical_step(fracas_model *model, const double *size)
{
    TRY(critical_step(model, size, true, &model->critical_closed));
    TRY(critical_step(model, size, false, &model->critical_cracked));
    /* A law that refines the step itself starts from the uncracked one. */
    model->critical_step = fracas_law_of(&model->spec)->finest
                               ? model->critical_closed
                               : fmin(model->critical_closed, model->critical_cracked);
    return FRACAS_OK;
}
