/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Breaks still to come in a chain, fragment by fragment (docs/theory/settled.md). */
#include "base/own.h"
#include "engine/formulation/chain/chain.h"

#include <math.h>
#include <stdlib.h>

/* Energy to open an interface for good [J], (1 - D) G_c A  (settled.3); INFINITY where it never
 * will. */
static double cost_of(const fracas_model *model, const fracas_step *step, size_t e, int lane)
{
    const fracas_chain *chain = model->chain;
    const double damage = *fracas_chain_field(model, step, e, chain->damage, lane),
                 strength = *fracas_chain_field(model, step, e, chain->strength, lane);
    if (chain->barred != 0 &&
        *fracas_chain_field(model, step, e, chain->law, lane) == chain->barred)
        return INFINITY;
    return (1 - damage) * fracas_spec_fracture_energy(&model->spec, strength) *
           model->spec.geometry.area;
}

static void add(fracas_fragment_sums *sums, const fracas_fragment_sums *more, double sign)
{
    sums->mass += sign * more->mass;
    for (int i = 0; i < 3; i++) {
        sums->first[i] += sign * more->first[i];
        sums->momentum[i] += sign * more->momentum[i];
    }
}

/* Kinetic energy of two parts flying away from each other [J], else 0; their rigid motion does not
 * part them  (settled.4). */
static double parting_energy(const fracas_fragment_sums *left, const fracas_fragment_sums *right,
                             double background)
{
    double distance = 0, parting = 0;
    for (int i = 0; i < 3; i++) {
        const double between = right->first[i] / right->mass - left->first[i] / left->mass;
        distance += between * between;
        parting += between * (right->momentum[i] / right->mass - left->momentum[i] / left->mass);
    }
    parting += background * distance;
    if (!(parting > 0)) return 0;
    const double reduced = left->mass * right->mass / (left->mass + right->mass);
    return 0.5 * reduced * parting * parting / distance;
}

/* The fragment of `count` elements from `first` on, around a closed chain. `cost` has room. */
static void add_fragment(const fracas_model *model, const fracas_step *step, int lane, size_t first,
                         size_t count, double energy, const fracas_fragment_sums *element,
                         double *cost, fracas_rest *rest)
{
    const fracas_formulation *body = model->formulation;
    const double background = body->background ? body->background(model, step->time[lane]) : 0;
    fracas_fragment_sums left = {0}, right = {0};
    double parting = 0;
    for (size_t k = 0; k < count; k++) add(&right, &element[(first + k) % model->elements], 1);
    for (size_t k = 0; k + 1 < count; k++) {
        const size_t e = (first + k) % model->elements;
        cost[k] = cost_of(model, step, e, lane);
        add(&left, &element[e], 1);
        add(&right, &element[e], -1);
        if (*fracas_chain_field(model, step, e, model->chain->damage, lane) > 0)
            parting = fmax(parting, parting_energy(&left, &right, background) / cost[k]);
    }
    fracas_rest_add(rest, energy, cost, count - 1, parting);
}

fracas_err fracas_chain_rest(const fracas_model *model, const fracas_step *step, int lane,
                             const double *energy, const fracas_fragment_sums *element,
                             fracas_rest *rest)
{
    const size_t n = model->elements;
    size_t first = 0;
    OWNED double *cost = malloc(n * sizeof *cost);
    if (!cost) return fracas_no_memory("the fragments of a realization");
    while (fracas_chain_is_closed(model) && first < n &&
           !fracas_chain_is_broken(model, step, (first + n - 1) % n, lane))
        first++;
    *rest = (fracas_rest){0};
    for (size_t done = 0, count; done < n; done += count) {
        const size_t begin = (first + done) % n;
        count = 1;
        while (!fracas_chain_is_broken(model, step, (begin + count - 1) % n, lane)) count++;
        add_fragment(model, step, lane, begin, count, energy[step->partition.label[begin]], element,
                     cost, rest);
    }
    return FRACAS_OK;
}
