/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bar's sweep over lanes: a kernel (docs/theory/bar.md, docs/theory/cohesive.md). */
#include "engine/cohesive/balance.h"
#include "engine/cohesive/kernels.h"
#include "engine/formulation/chain/bar_sweep.h"
#include "engine/formulation/chain/chain_events.h"
#include "engine/integrator/central_difference.h"

enum { BAR_OPERATOR = FRACAS_LAWS }; /* in place of a law */

/* An element at t_n: displacements drifted, velocities still those of t_{n-1/2}. */
typedef struct {
    vd w_left, w_right, v_left, v_right, stress;
    vd modulus; /* E/h [Pa/m] */
    vd size;    /* h/h of all, where they are not alike: 1 */
} bar_element;

/* Action of an interface on its two elements. */
typedef struct {
    vd traction, slip; /* T [Pa], q - delta [m] */
    vmask closed;      /* rigid links: both nodes move as one ... */
    vd common; /* ... under this force [Pa] per mass, in units of an element's of mean length */
} bar_link;

typedef struct {
    const fracas_bar_constants *bar;
    fracas_step *step;
    int first;                      /* lane of the step that is lane 0 here */
    double *state;                  /* state of these lanes */
    vd drift, kick;                 /* dt [s], dt/(nodal mass) [m/(s Pa)] */
    vd load_stress;                 /* E rate t [Pa] */
    vd spring, compliance, modulus; /* K, 1/K, E/h [Pa/m] of elements of one length */
    balance_coupling coupling;      /* for elements of one length */
    /* sums over the body, for the ledger, 0 at first */
    vd stress_squared, flux_energy, opening_energy, damage, velocity_squared, stress, slip;
} bar_context;

LANES_FUNCTION bar_element bar_load(const bar_context *c, int uniform, size_t e)
{
    const double *at = c->state + e * BAR_FIELDS * LANES;
    bar_element element = {.v_left = lanes_load(at + BAR_V_LEFT * LANES),
                           .v_right = lanes_load(at + BAR_V_RIGHT * LANES),
                           .w_left = lanes_load(at + BAR_W_LEFT * LANES),
                           .w_right = lanes_load(at + BAR_W_RIGHT * LANES)};
    element.w_left = central_drift(element.w_left, element.v_left, c->drift);
    element.w_right = central_drift(element.w_right, element.v_right, c->drift);
    element.size = lanes_set(uniform ? 1.0 : c->bar->sizes[e] / c->bar->size);
    element.modulus = uniform ? c->modulus : c->modulus / element.size;
    /* sigma = E (rate t + dw/dx)   (bar.3) */
    element.stress = c->load_stress + element.modulus * (element.w_right - element.w_left);
    return element;
}

/* Time derivative of the mean stress within the step [Pa/s]. */
LANES_FUNCTION vd bar_stress_rate(const bar_context *c, int uniform, const bar_element *left,
                                  const bar_element *right)
{
    const vd half = lanes_set(0.5), load = lanes_set(c->bar->young * c->bar->rate);
    if (uniform)
        return half * c->modulus * (left->v_right - left->v_left + right->v_right - right->v_left) +
               load;
    return half * (left->modulus * (left->v_right - left->v_left) +
                   right->modulus * (right->v_right - right->v_left)) +
           load;
}

/* Balancing traction of a crossing [Pa]  (balance.6) */
LANES_FUNCTION vd bar_balance(const bar_context *c, int uniform, const line_input *in,
                              const line_result *it, const bar_element *left,
                              const bar_element *right)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    const vd rate = in->stiffness * (right->v_left - left->v_right) +
                    lanes_select(lanes_le(one, in->damage), zero,
                                 bar_stress_rate(c, uniform, left, right));
    balance_coupling coupling = c->coupling;
    if (!uniform)
        coupling = balance_couple(in->stiffness, c->kick / left->size + c->kick / right->size,
                                  c->drift, lanes_set(c->bar->whole),
                                  lanes_load(c->step->balance + c->first));
    return balance_traction(&coupling, in, it, c->drift * rate);
}

/* An interface in series with the flux. */
LANES_FUNCTION bar_link bar_flux(bar_context *c, int uniform, int law, int balanced, size_t e,
                                 const bar_element *left, const bar_element *right)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5);
    double *at = c->state + e * BAR_FIELDS * LANES;
    vd before = lanes_load(at + BAR_DAMAGE * LANES);
    vd mean = half * (left->stress + right->stress); /* (bar.2) */
    vd q = right->w_left - left->w_right;
    /* K = beta E/h, 1/h the mean of both elements'  (bar.18) */
    vd spring = uniform ? c->spring
                        : lanes_set(c->bar->beta) * (half * (left->modulus + right->modulus));
    vd compliance = uniform ? c->compliance : one / spring;
    const line_input in = {.mean = mean,
                           .jump = q,
                           .damage = before,
                           .sigma_c = lanes_load(at + BAR_STRENGTH * LANES),
                           .constant = lanes_load(at + BAR_LAW * LANES),
                           .stiffness = spring,
                           .compliance = compliance,
                           .own = c->bar->own};
    const line_result it = line_law(law, &in);
    lanes_store(at + BAR_DAMAGE * LANES, it.damage);

    /* Energies per area, twice: slip (m + T) of the flux, T delta stored in the opening or in
     * contact  (cohesive.5) */
    c->flux_energy += it.slip * (mean + it.traction);
    c->opening_energy += it.traction * (q - it.slip);
    c->damage += it.dissipated;
    /* forces and the load's power have the balance, energies do not */
    vd traction = it.traction, slip = it.slip;
    if (balanced) {
        const vd extra = bar_balance(c, uniform, &in, &it, left, right);
        traction += extra;
        slip += lanes_select(lanes_le(one, it.damage), zero, extra * compliance);
    }
    c->slip += slip;

    vmask grows = lanes_lt(before, it.damage);
    vmask cracks = lanes_and(grows, lanes_le(before, zero)),
          breaks = lanes_and(grows, lanes_le(one, it.damage));
    if (__builtin_expect(lanes_any(lanes_or(cracks, breaks)), 0)) {
        /* S is linear in time within the step: it crosses sigma_c, and K delta_c  (bar.12) */
        vd rate = bar_stress_rate(c, uniform, left, right) +
                  spring * (right->v_left - left->v_right);
        vd time = lanes_load(c->step->time + c->first);
        vd onset = time - it.past_onset / rate,
           broke = time - (it.past_onset - it.softening) / rate;
        vd lost = half * mean * mean * compliance; /* (cohesive.6) */
        chain_note_events(c->step, c->first, c->bar->area, e,
                          &(chain_events){cracks, breaks, onset, broke, zero, lost});
    }
    return (bar_link){.traction = traction, .slip = slip};
}

LANES_FUNCTION bar_link bar_rigid_link(bar_context *c, int uniform, size_t e,
                                       const bar_element *left, const bar_element *right)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0), half = lanes_set(0.5),
             two = lanes_set(BAR_LINK_OPEN);
    double *at = c->state + e * BAR_FIELDS * LANES;
    vd before = lanes_load(at + BAR_DAMAGE * LANES), state = lanes_load(at + BAR_LAW * LANES);
    vd sigma_c = lanes_load(at + BAR_STRENGTH * LANES);
    vd mean = half * (left->stress + right->stress);
    vd q = right->w_left - left->w_right;
    vd delta_c = lanes_set(2.0 * c->bar->fracture_energy) / sigma_c;
    vmask open = lanes_le(two, state), exceeded = lanes_lt(zero, state);
    vmask cracks = lanes_and(lanes_le(state, zero), lanes_lt(sigma_c, mean));
    /* closed 0 -> exceeded 1 -> open 2 */
    lanes_store(at + BAR_LAW * LANES, lanes_select(exceeded, two, lanes_select(cracks, one, zero)));

    vd damage = before;
    vd traction = rigid_link_law(q, &damage, sigma_c, delta_c,
                                 rigid_link_penalty(sigma_c, c->bar->own, c->bar->fracture_energy));
    damage = lanes_select(open, damage, before);
    traction = lanes_select(open, traction, mean);
    lanes_store(at + BAR_DAMAGE * LANES, damage);
    c->opening_energy += lanes_select(open, traction * q, zero);
    c->damage += damage;

    vmask breaks = lanes_and(lanes_lt(before, damage), lanes_le(one, damage));
    if (__builtin_expect(lanes_any(lanes_or(cracks, breaks)), 0)) {
        vd time = lanes_load(c->step->time + c->first);
        vd onset = time - (mean - sigma_c) / bar_stress_rate(c, uniform, left, right);
        vd broke = time - (q - delta_c) / (right->v_left - left->v_right);
        chain_note_events(c->step, c->first, c->bar->area, e,
                          &(chain_events){cracks, breaks, onset, broke, zero, zero});
    }
    /* both nodes accelerate as one, under the force on both */
    vd common = uniform ? half * (right->stress - left->stress)
                        : (right->stress - left->stress) / (left->size + right->size);
    return (bar_link){
        .traction = traction, .slip = zero, .closed = lanes_lt(state, two), .common = common};
}

/* An interface of the operator  (bar.6), (bar.7). */
LANES_FUNCTION bar_link bar_linear(const bar_context *c, int uniform, const bar_element *left,
                                   const bar_element *right)
{
    const vd zero = lanes_set(0.0), half = lanes_set(0.5);
    const vd q = right->w_left - left->w_right;
    const vd spring = uniform ? c->spring
                              : lanes_set(c->bar->beta) * (half * (left->modulus + right->modulus));
    if (c->bar->contact) return (bar_link){.traction = spring * q, .slip = zero};
    return (bar_link){.traction = half * (left->stress + right->stress) + spring * q,
                      .slip = q,
                      .closed = lanes_le(zero, zero),
                      .common = uniform
                                    ? half * (right->stress - left->stress)
                                    : (right->stress - left->stress) / (left->size + right->size)};
}

LANES_FUNCTION bar_link bar_interface(bar_context *c, int uniform, int flux, int law, int balanced,
                                      size_t e, const bar_element *left, const bar_element *right)
{
    if (law == BAR_OPERATOR) return bar_linear(c, uniform, left, right);
    return flux ? bar_flux(c, uniform, law, balanced, e, left, right)
                : bar_rigid_link(c, uniform, e, left, right);
}

/* Forces and kick of one element, and its share of the sums; a held node stays where it is. */
LANES_FUNCTION void bar_finish(bar_context *c, int uniform, int flux, size_t e,
                               const bar_element *element, const bar_link *left,
                               const bar_link *right, int hold_left, int hold_right)
{
    const vd half = lanes_set(0.5);
    double *at = c->state + e * BAR_FIELDS * LANES;
    /* N = sigma + (E/2h) (slip of both ends): bulk and symmetrisation  (bar.6); forces per area
     * (bar.7) */
    vd internal = element->stress;
    if (flux) internal += half * element->modulus * (left->slip + right->slip);
    vd force_left = internal - left->traction, force_right = right->traction - internal;
    if (!uniform) { /* per mass */
        force_left = force_left / element->size;
        force_right = force_right / element->size;
    }
    if (!flux) { /* the same number on both sides: tied nodes stay together to the bit */
        force_left = lanes_select(left->closed, left->common, force_left);
        force_right = lanes_select(right->closed, right->common, force_right);
    }
    vd v_left = hold_left ? element->v_left : central_kick(element->v_left, force_left, c->kick);
    vd v_right = hold_right ? element->v_right
                            : central_kick(element->v_right, force_right, c->kick);
    /* kinetic energy of leapfrog, v_{n-1/2} v_{n+1/2}  (bar.11) */
    vd velocity_squared = element->v_left * v_left + element->v_right * v_right;
    vd stress_squared = element->stress * element->stress;
    c->velocity_squared += uniform ? velocity_squared : element->size * velocity_squared;
    c->stress_squared += uniform ? stress_squared : element->size * stress_squared;
    c->stress += uniform ? element->stress : element->size * element->stress;
    lanes_store(at + BAR_W_LEFT * LANES, element->w_left);
    lanes_store(at + BAR_W_RIGHT * LANES, element->w_right);
    lanes_store(at + BAR_V_LEFT * LANES, v_left);
    lanes_store(at + BAR_V_RIGHT * LANES, v_right);
}

/* Tractions of walls at both ends [Pa], and twice the energy that they store per area; else 0. */
typedef struct {
    vd traction[2], energy;
} bar_walls;

/* Sums to energies [J], those of the potential (bar.4), and power [W]  (bar.8), (bar.21). */
LANES_FUNCTION void bar_totals(const bar_context *c, const bar_walls *walls)
{
    const fracas_bar_constants *bar = c->bar;
    fracas_step *step = c->step;
    lanes_store(step->kinetic + c->first,
                lanes_set(0.5 * bar->area * bar->nodal_mass) * c->velocity_squared);
    lanes_store(step->elastic + c->first,
                lanes_set(0.5 * bar->area * bar->size / bar->young) * c->stress_squared +
                    lanes_set(0.5 * bar->area) * c->flux_energy);
    lanes_store(step->cohesive + c->first, lanes_set(0.5 * bar->area) * c->opening_energy);
    lanes_store(step->dissipated + c->first,
                lanes_set(bar->area * bar->fracture_energy) * c->damage);
    lanes_store(
        step->power + c->first,
        lanes_set(bar->area * bar->rate) *
                (lanes_set(bar->size) * c->stress + lanes_set(bar->young) * c->slip) -
            lanes_set(bar->area * bar->parting) * (walls->traction[0] + walls->traction[1]));
}

LANES_FUNCTION bar_context bar_begin(const fracas_bar_constants *bar, fracas_step *step, int first)
{
    return (bar_context){.bar = bar,
                         .step = step,
                         .first = first,
                         .state = step->state + (size_t)first * bar->elements * BAR_FIELDS,
                         .drift = lanes_load(step->drift + first),
                         .kick = lanes_load(step->kick + first) / lanes_set(bar->nodal_mass),
                         .load_stress = lanes_set(bar->young) *
                                        (lanes_set(bar->rate) * lanes_load(step->time + first)),
                         .spring = lanes_set(bar->spring),
                         .compliance = lanes_set(1.0 / bar->spring),
                         .modulus = lanes_set(bar->young / bar->size)};
}

/* The wall beyond the left or right end, which meet as the faces of a broken interface  (bar.20).
 */
LANES_FUNCTION void bar_wall(const bar_context *c, int operates, const bar_element *end, int right,
                             bar_walls *walls)
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    const vd spring = lanes_set(c->bar->contact_factor) * end->modulus;
    const vd inward = right ? zero - end->w_right : end->w_left,
             speed = right ? zero - end->v_right : end->v_left;
    const vd away = lanes_set(c->bar->gap) -
                    lanes_set(c->bar->parting) * lanes_load(c->step->time + c->first);
    const vd q = away + inward, trial = spring * q, traction = lanes_min(zero, trial);
    const line_input in = {.mean = end->stress, .damage = one};
    const line_result it = {.traction = traction, .damage = one, .trial = trial, .secant = zero};
    const balance_coupling coupling = balance_couple(spring, c->kick / end->size, c->drift, one,
                                                     one);
    const vd change = c->drift * (spring * (speed - lanes_set(c->bar->parting)));
    walls->energy += traction * q;
    walls->traction[right] = traction + balance_traction(&coupling, &in, &it, change);
    if (operates) walls->traction[right] = spring * inward;
}

/* Out of line, and before the sweep: elements there have all registers. */
__attribute__((noinline, cold, unused)) static void bar_meet_walls(const fracas_bar_constants *bar,
                                                                   fracas_step *step, int first,
                                                                   int operates, bar_walls *walls)
{
    const bar_context context = bar_begin(bar, step, first);
    const int uniform = !bar->sizes;
    const bar_element left = bar_load(&context, uniform, 0),
                      right = bar_load(&context, uniform, bar->elements - 1);
    bar_wall(&context, operates, &left, 0, walls);
    bar_wall(&context, operates, &right, 1, walls);
}

LANES_FUNCTION void bar_run(const fracas_bar_constants *bar, fracas_step *step, int first,
                            int uniform, int flux, int law, int balanced)
{
    const vd zero = lanes_set(0.0);
    const size_t last = bar->elements - 1;
    bar_walls walls = {.energy = zero};
    if (bar->walls) bar_meet_walls(bar, step, first, law == BAR_OPERATOR, &walls);
    bar_context context = bar_begin(bar, step, first);
    context.opening_energy = walls.energy;
    bar_context *c = &context;
    if (balanced && uniform)
        c->coupling = balance_couple(c->spring, c->kick + c->kick, c->drift, lanes_set(bar->whole),
                                     lanes_load(step->balance + first));

    /* One pass in place: an element is written once both its interfaces are known; registers keep
     * the part for its right neighbour. The interface closing a periodic bar comes first. */
    bar_element element = bar_load(c, uniform, 0);
    bar_link closing = {.traction = walls.traction[0], .slip = zero}, left;
    if (bar->periodic) {
        bar_element end = bar_load(c, uniform, last);
        closing = bar_interface(c, uniform, flux, law, balanced, last, &end, &element);
    }
    bar_element next = bar_load(c, uniform, 1);
    bar_link right = bar_interface(c, uniform, flux, law, balanced, 0, &element, &next);
    if (!bar->held) bar_finish(c, uniform, flux, 0, &element, &closing, &right, 0, 0);
    else bar_finish(c, uniform, flux, 0, &element, &closing, &right, 1, 0);
    for (size_t e = 1; e < last; e++) {
        left = right;
        element = next;
        next = bar_load(c, uniform, e + 1);
        right = bar_interface(c, uniform, flux, law, balanced, e, &element, &next);
        bar_finish(c, uniform, flux, e, &element, &left, &right, 0, 0);
    }
    if (!bar->periodic) closing.traction = walls.traction[1];
    if (!bar->held) bar_finish(c, uniform, flux, last, &next, &right, &closing, 0, 0);
    else bar_finish(c, uniform, flux, last, &next, &right, &closing, 0, 1);
    if (law != BAR_OPERATOR) bar_totals(c, &walls);
}

#define BAR_SWEEP(name, uniform, flux, law, balanced)                               \
    static void name(const fracas_bar_constants *bar, fracas_step *step, int first) \
    {                                                                               \
        bar_run(bar, step, first, uniform, flux, law, balanced);                    \
    }
#if LANES == 1
BAR_SWEEP(even_tied, 1, 0, BAR_OPERATOR, 0)
BAR_SWEEP(uneven_tied, 0, 0, BAR_OPERATOR, 0)
BAR_SWEEP(even_whole, 1, 1, BAR_OPERATOR, 0)
BAR_SWEEP(uneven_whole, 0, 1, BAR_OPERATOR, 0)
#endif

#define BAR_FLUX(name)                                          \
    BAR_SWEEP(even_##name, 1, 1, FRACAS_LAW_##name, 0)          \
    BAR_SWEEP(uneven_##name, 0, 1, FRACAS_LAW_##name, 0)        \
    BAR_SWEEP(even_balanced_##name, 1, 1, FRACAS_LAW_##name, 1) \
    BAR_SWEEP(uneven_balanced_##name, 0, 1, FRACAS_LAW_##name, 1)
#define BAR_RIGID(name)                                \
    BAR_SWEEP(even_##name, 1, 0, FRACAS_LAW_##name, 0) \
    BAR_SWEEP(uneven_##name, 0, 0, FRACAS_LAW_##name, 0)
#define BAR_NO(name)
#define FRACAS_LAW(name, bar, ring, membrane, shell) BAR_##bar(name)
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#undef BAR_FLUX
#undef BAR_RIGID

#define BAR_FLUX(name) \
    [FRACAS_LAW_##     \
        name] = {{uneven_##name, even_##name}, {uneven_balanced_##name, even_balanced_##name}},
#define BAR_RIGID(name) \
    [FRACAS_LAW_##name] = {{uneven_##name, even_##name}, {uneven_##name, even_##name}},
#define FRACAS_LAW(name, bar, ring, membrane, shell) BAR_##bar(name)
const fracas_bar_kernel LANES_UNIT(fracas_bar) = {
#if LANES == 1
    .operator= {{uneven_tied, even_tied}, {uneven_whole, even_whole}},
#endif
    .sweep = {
#include "engine/cohesive/laws.list.h"
    }};
