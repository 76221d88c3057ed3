/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The critical time step of a chain: Lanczos' iteration on the bar's sweep as an operator. */
#include "engine/formulation/chain/bar_sweep.h"

#include "base/own.h"
#include "engine/formulation/chain/chain.h"
#include "engine/integrator/integrator.h"
#include "engine/integrator/lanczos.h"

#include <math.h>

FRACAS_KERNEL_TABLE(const fracas_bar_kernel, fracas_bar);

typedef struct {
    fracas_step step; /* first: it is aligned */
    fracas_bar_constants bar;
    int flux; /* interfaces are whole by their flux, or in contact; else tied */
} chain_operator;

static double size_of(const chain_operator *o, size_t e)
{
    return o->bar.sizes ? o->bar.sizes[e] : o->bar.size;
}

static void close_operator(chain_operator *o)
{
    if (o) free(o->step.state);
    free(o);
}
FRACAS_OWNER(chain_operator, close_operator)

/* The operator of a chain: all interfaces uncracked, or all broken and in contact. A regular chain
 * has the largest frequency of a short one: 1024 elements are enough. */
static fracas_err open_operator(const fracas_model *model, bool contact, chain_operator **out)
{
    enum { ENOUGH = 1024 };
    const fracas_spec *spec = &model->spec;
    const fracas_law *law = fracas_law_of(spec);
    const double young = spec->material.young, h = model->element_size,
                 factor = fracas_chain_contact_factor(spec);
    chain_operator *o = aligned_alloc(64, (sizeof *o + 63) / 64 * 64);
    if (!o) return fracas_no_memory("the critical time step");
    const size_t n = !model->sizes && model->elements > ENOUGH ? ENOUGH : model->elements;
    *o = (chain_operator){.step = {.width = 1, .lanes = 1, .kick = {1}},
                          .flux = contact || law->flux,
                          .bar = {.elements = n,
                                  .periodic = fracas_chain_is_closed(model),
                                  .held = fracas_chain_is_held(model),
                                  .walls = fracas_chain_gap(model) >= 0,
                                  .contact_factor = factor,
                                  .contact = contact,
                                  .young = young,
                                  .beta = factor,
                                  .spring = factor * young / h,
                                  .size = h,
                                  .sizes = model->sizes,
                                  .nodal_mass = 0.5 * spec->material.density * h}};
    *out = o;
    o->step.state = calloc(n * BAR_FIELDS, sizeof *o->step.state);
    return o->step.state ? FRACAS_OK : fracas_no_memory("the critical time step");
}

/* result = M^-1 K w, w = (left, right) node of each element. */
static void apply(void *context, const double *w, double *result)
{
    chain_operator *o = context;
    double *state = o->step.state;
    for (size_t e = 0; e < o->bar.elements; e++) {
        state[e * BAR_FIELDS + BAR_W_LEFT] = w[2 * e];
        state[e * BAR_FIELDS + BAR_W_RIGHT] = w[2 * e + 1];
        state[e * BAR_FIELDS + BAR_V_LEFT] = state[e * BAR_FIELDS + BAR_V_RIGHT] = 0;
    }
    fracas_bar[FRACAS_ISA_BASELINE][1]->operator[o->flux][!o->bar.sizes](&o->bar, &o->step, 0);
    for (size_t e = 0; e < o->bar.elements; e++) {
        result[2 * e] = -state[e * BAR_FIELDS + BAR_V_LEFT];
        result[2 * e + 1] = -state[e * BAR_FIELDS + BAR_V_RIGHT];
    }
}

static void multiply_by_mass(void *context, const double *w, double *result)
{
    const chain_operator *o = context; /* kg/m2 */
    for (size_t i = 0; i < 2 * o->bar.elements; i++)
        result[i] = o->bar.nodal_mass * (size_of(o, i / 2) / o->bar.size) * w[i];
}

/* The extreme modes of a regular chain (nodes of an element, or whole elements, in turn up and
 * down), most of it in small elements, and a little noise. Tied nodes have equal values. */
static void fill_start(const chain_operator *o, double *start)
{
    const size_t n = o->bar.elements;
    const bool tied = !o->flux;
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
    if (o->bar.held) start[0] = start[2 * n - 1] = 0;
}

static fracas_err critical_step(const fracas_model *model, bool contact, double *step)
{
    OWN(chain_operator) o = NULL;
    TRY(open_operator(model, contact, &o));
    const size_t n = 2 * o->bar.elements;
    double omega_squared = 0;
    OWNED double *start = malloc(n * sizeof *start);
    if (!start) return fracas_no_memory("the critical time step");
    fill_start(o, start);
    TRY(fracas_lanczos(&(fracas_lanczos_problem){apply, multiply_by_mass, o, n, 1e-9}, start,
                       &omega_squared));
    *step = FRACAS_CENTRAL_DIFFERENCE_LIMIT / sqrt(omega_squared);
    return FRACAS_OK;
}

/* (bar.16) */
fracas_err fracas_chain_critical_step(fracas_model *model)
{
    TRY(critical_step(model, false, &model->critical_closed));
    TRY(critical_step(model, true, &model->critical_cracked));
    /* A law that refines the step itself starts from the uncracked one. */
    model->critical_step = fracas_law_of(&model->spec)->finest
                               ? model->critical_closed
                               : fmin(model->critical_closed, model->critical_cracked);
    return FRACAS_OK;
}
