/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a surface over lanes, second part: visits of elements and interfaces, the same for
 * every body (engine/formulation/surface/kernel.h), and the kernel's unit.
 *
 * An element is drifted and strained when its turn comes. Then come the interfaces with elements
 * before it. Once an element has all its interfaces it gets its forces and is kicked. Interfaces
 * see an element through its displacements and the stresses at its bulk points, and give back
 * forces on nodes and strains at those points: both are few. */

#include "engine/formulation/surface/load_kernel.h"
#include "engine/formulation/surface/motion_kernel.h"

/* ---- interfaces ---- */

/* Records the events at an interface, lane by lane; a ghost has none: another part records them. */
__attribute__((noinline, cold, unused)) static void
surface_record_events(const surface_context *c, int points, const fracas_surface_facet *facet,
                      const vmask *cracks, const vmask *breaks, vmask opens, vmask parts)
{
    for (int l = 0; l < LANES; l++) {
        fracas_surface_event event = {.interface = facet->interface,
                                      .lane = c->first + l,
                                      .element = {surface_place(c, facet->element[0]) + l,
                                                  surface_place(c, facet->element[1]) + l},
                                      .fields = surface_place(c, facet->at) + l,
                                      .opens = lanes_get(opens, l),
                                      .parts = lanes_get(parts, l)};
        for (int p = 0; p < points; p++) {
            event.cracks[p] = lanes_get(cracks[p], l);
            event.breaks[p] = lanes_get(breaks[p], l);
        }
        if (event.opens || event.parts) fracas_surface_record_event(c->constants, c->step, &event);
    }
}

/* The law's view of an interface; the strength is each Gauss point's own. */
LANES_FUNCTION plane_interface surface_interface(const fracas_surface_constants *s,
                                                 const double *table, int calm)
{
    const vd stiffness = lanes_set(table[SURFACE_STIFFNESS]);
    return (plane_interface){.k_n = lanes_set(s->normal) * stiffness,
                             .k_t = lanes_set(s->tangential) * stiffness,
                             .softness_n = lanes_set(table[SURFACE_COMPLIANCE] / s->normal),
                             .softness_t = lanes_set(table[SURFACE_COMPLIANCE] / s->tangential),
                             .beta_c = lanes_set(s->beta_c),
                             .per_beta_c = lanes_set(1.0 / s->beta_c),
                             .mu_c = lanes_set(s->mu_c),
                             .energy = lanes_set(s->energy),
                             .opening = lanes_set(s->opening),
                             .own = s->own,
                             .onset_mean = s->onset_mean,
                             .friction = calm ? 0 : s->friction,
                             .calm = calm};
}

/* An interface at which some lane is cracked, or is about to (shell.14). `at` holds the flux of the
 * other lanes. False where it was called for a calm step and some lane has an onset or a break in
 * it: then nothing but `at` has changed. `calm` is a constant of each call. */
LANES_FUNCTION int surface_crack(surface_context *c, int order, int law, int calm,
                                 const fracas_surface_facet *facet, double *fields,
                                 const double *strength, BODY(point) at[3])
{
    const vd zero = lanes_set(0.0), one = lanes_set(1.0);
    const fracas_surface_constants *s = c->constants;
    const int points = SURFACE_EDGE(order);
    const double *table = surface_table(c, order, facet->interface);
    plane_interface interface = surface_interface(s, table, calm);
    vmask cracks[3 * BODY_LAYERS], breaks[3 * BODY_LAYERS];
    vmask whole = lanes_le(zero, zero), broken = whole, opens = lanes_lt(one, zero), parts = opens;
    vd damage[3 * BODY_LAYERS];
    vd flux = zero, stored = zero, dissipated = zero;
    vd created = zero, rubbed = zero, bending = zero;
    UNROLL_FOR (int g = 0; g < points; g++) {
        const double *place = table + BODY_HEAD + g * BODY_POINT_TABLE;
        const vd weight = lanes_set(place[BODY_MEASURE]);
        interface.sigma_c = lanes_load(strength + (size_t)g * c->strength_step);
        const surface_marks marks = {damage + g * BODY_LAYERS, cracks + g * BODY_LAYERS,
                                     breaks + g * BODY_LAYERS};
        const surface_opening all = BODY(crack)(
            c, &interface, law, place, &at[g],
            surface_at(fields, g * BODY_LAYERS * s->point_fields), &marks);
        flux += weight * all.flux;
        stored += weight * all.stored;
        dissipated += weight * all.dissipated;
        created += weight * all.created;
        rubbed += weight * all.rubbed;
        if (BODY_LAYERS > 1) bending += weight * all.bending;
        whole = lanes_and(whole, all.whole);
        broken = lanes_and(broken, all.broken);
        UNROLL_FOR (int k = 0; k < BODY_LAYERS; k++) {
            opens = lanes_or(opens, cracks[g * BODY_LAYERS + k]);
            parts = lanes_or(parts, breaks[g * BODY_LAYERS + k]);
        }
    }
    if (calm && __builtin_expect(lanes_any(lanes_or(opens, parts)), 0)) return 0;
    c->sum[SURFACE_FLUX] += flux;
    c->sum[SURFACE_STORED] += stored;
    c->sum[SURFACE_DISSIPATED] += dissipated;
    if (BODY_LAYERS > 1) c->sum[SURFACE_BENDING] += bending;
    if (calm) {
        UNROLL_FOR (int p = 0; p < points * BODY_LAYERS; p++)
            lanes_store(surface_at(fields, p * s->point_fields + SURFACE_DAMAGE), damage[p]);
        return 1;
    }
    c->sum[SURFACE_CREATED] += created;
    c->sum[SURFACE_RUBBED] += rubbed;
    opens = lanes_and(opens, whole);  /* the first of its points */
    parts = lanes_and(parts, broken); /* the last */
    if (!c->ghost && __builtin_expect(lanes_any(lanes_or(opens, parts)), 0))
        surface_record_events(c, points * BODY_LAYERS, facet, cracks, breaks, opens, parts);
    return 1;
}

/* An interface: tractions at its Gauss points, and their forces on its elements. False where it was
 * called for a calm step and that fails: then nothing has changed. */
LANES_FUNCTION int surface_interface_forces(surface_context *c, int order, int law, int calm,
                                            const fracas_surface_facet *facet)
{
    const size_t i = facet->interface;
    const fracas_surface_constants *s = c->constants;
    const int points = SURFACE_EDGE(order);
    const surface_sides sides = surface_sides_of(c, order, facet);
    double *fields = surface_place(c, facet->at);
    const double *strength = c->strengths + i * c->strengths_size;
    BODY(point) at[3];
    BODY(flux)(c, order, i, &sides, at);
    if (law == SURFACE_OPERATOR) {
        UNROLL_FOR (int g = 0; g < points; g++)
            if (s->contact) BODY(press)(&at[g]);
        BODY(scatter)(c, order, i, &sides, at);
        return 1;
    }
    /* No lane is past its onset where none has a peak and no traction is near the least strength:
     * an onset needs |T| >= min(1, beta_c) sigma_c. The margin covers its round-off, so that lanes
     * do not depend on each other. */
    vd largest = lanes_set(0.0), touched = lanes_set(0.0), weakest = lanes_load(strength);
    UNROLL_FOR (int g = 0; g < points; g++) {
        largest = plane_max(largest, BODY(square)(s, &at[g]));
        weakest = plane_min(weakest, lanes_load(strength + (size_t)g * c->strength_step));
        UNROLL_FOR (int k = 0; k < BODY_LAYERS; k++)
            touched += lanes_load(
                surface_at(fields, (g * BODY_LAYERS + k) * s->point_fields + SURFACE_PEAK));
    }
    const vd floor = lanes_set(0.999 * (s->beta_c < 1.0 ? s->beta_c : 1.0)) * weakest;
    if (lanes_any(lanes_or(lanes_lt(lanes_set(0.0), touched), lanes_lt(floor * floor, largest)))) {
        if (!surface_crack(c, order, law, calm, facet, fields, strength, at)) return 0;
    } else {
        const double *place = surface_table(c, order, i) + BODY_HEAD;
        vd flux = lanes_set(0.0);
        UNROLL_FOR (int g = 0; g < points; g++)
            flux += lanes_set(place[g * BODY_POINT_TABLE + BODY_MEASURE]) *
                    BODY(flux_energy)(&at[g]);
        c->sum[SURFACE_FLUX] += flux;
    }
    BODY(scatter)(c, order, i, &sides, at);
    return 1;
}

/* ---- elements ---- */

/* Stresses of element e from its displacements `at`; the rest of its slot is cleared. */
LANES_FUNCTION void surface_enter(surface_context *c, int order, size_t e, double *at, double *slot)
{
    const int from = BODY_SLOT_EXTRA(order), end = BODY_SLOT(order);
    UNROLL_FOR (int i = from; i < end; i++) lanes_store(surface_at(slot, i), lanes_set(0.0));
    BODY(strain)(c, order, e, at, slot);
}

/* Accelerations by internal and body forces, 0 of held components; power of their reactions at
 * `velocity`, added to the sum `power`. */
LANES_FUNCTION void surface_accelerate(const surface_context *c, int order, size_t e, int power,
                                       const vd *velocity, const vd *force, vd *acceleration)
{
    const int nodes = SURFACE_NODES(order), size = BODY_SIZE(order);
    const fracas_surface_tables *t = c->tables;
    const uint32_t held = t->held[e];
    const double *lumped = t->lumped + e * (size_t)(2 * nodes);
    const double *consistent = BODY_PLANE && t->consistent
                                   ? t->consistent + e * (size_t)(3 * nodes * nodes)
                                   : NULL;
    const double *position = BODY_PLANE && t->position ? t->position + e * (size_t)size : NULL;
    UNROLL_FOR (int i = 0; i < size; i++) {
        if (!consistent) {
            acceleration[i] = lanes_set(-lumped[i / BODY_DIMENSION]) * force[i];
        } else {
            acceleration[i] = lanes_set(0.0);
            UNROLL_FOR (int k = 0; k < nodes; k++)
                acceleration[i] += lanes_set(-consistent[(i % 2 * nodes + i / 2) * nodes + k]) *
                                   force[2 * k + i % 2];
        }
        if (position) acceleration[i] += c->spin * lanes_set(position[i]); /* (membrane.10) */
    }
    const double *rotary = BODY_DIMENSION == 3 && t->rotary ? t->rotary + e * SURFACE_ROTARY_TABLE
                                                            : NULL;
    if (rotary) {
        vd pushed[18];
        UNROLL_FOR (int i = 0; i < size; i++) pushed[i] = held >> i & 1 ? lanes_set(0.0) : force[i];
        surface_turn(rotary, pushed, acceleration);
    }
    if (__builtin_expect(held != 0, 0)) {
        vd sum = lanes_set(0.0);
        for (int i = 0; i < size; i++) {
            if (!(held >> i & 1)) continue;
            acceleration[i] = lanes_set(0.0);
            vd reaction = force[i]; /* (membrane.11) */
            for (int k = 0; consistent && k < nodes; k++)
                if (!(held >> (2 * k + i % 2) & 1))
                    reaction += lanes_set(consistent[(2 * nodes + i / 2) * nodes + k]) *
                                acceleration[2 * k + i % 2];
            sum += reaction * velocity[i];
        }
        if (rotary) sum += surface_twist(rotary, held, acceleration, velocity);
        surface_add(surface_at(surface_sums(c, e), power), sum);
    }
}

/* The same of an element with moved components: the others get the inertia of these, too, and the
 * power is that at velocity d: the force along the path  (loads.8). */
__attribute__((noinline, cold)) static void surface_accelerate_moved(const surface_context *c,
                                                                     int order, size_t e,
                                                                     double *at, surface_moving *of)
{
    const int power = SURFACE_POWER + surface_mover(c, e);
    surface_lead_moved(c, order, e, at, of);
    if (BODY_PLANE && order == 1)
        surface_accelerate(c, 1, e, power, of->direction, of->force, of->acceleration);
    else surface_accelerate(c, 2, e, power, of->direction, of->force, of->acceleration);
    for (int i = 0; i < BODY_SIZE(order); i++) of->acceleration[i] += of->lead[i];
    if (BODY_PLANE && c->tables->position)
        surface_add(surface_at(surface_sums(c, e), power),
                    -surface_spin_along(c, order, e, of->direction));
}

/* Every element: those with moved components get copies, so that others keep their registers. */
LANES_FUNCTION void surface_accelerate_any(const surface_context *c, int order, size_t e,
                                           double *at, const vd *velocity, const vd *force,
                                           vd *acceleration)
{
    const int size = BODY_SIZE(order);
    if (!surface_is_moved(c, e)) {
        surface_accelerate(c, order, e, SURFACE_POWER, velocity, force, acceleration);
        return;
    }
    surface_moving of;
    UNROLL_FOR (int i = 0; i < size; i++) of.velocity[i] = velocity[i], of.force[i] = force[i];
    surface_accelerate_moved(c, order, e, at, &of);
    UNROLL_FOR (int i = 0; i < size; i++) acceleration[i] = of.acceleration[i];
}

/* x.M y of an element, and the moment of M x. */
LANES_FUNCTION vd surface_product(const surface_context *c, int order, size_t e, const vd *x,
                                  const vd *y, vd *moment)
{
    const double *rotary = c->tables->rotary;
    *moment = lanes_set(0.0);
    vd product = BODY(kinetic)(c, order, e, x, y, moment);
    if (BODY_DIMENSION == 3 && rotary)
        product += surface_spun(rotary + e * SURFACE_ROTARY_TABLE, x, y);
    return product;
}

/* Adds to an element's sums what Hulbert and Chung's scheme has beside leapfrog: kinetic energy,
 * damped energy, displacement in this step. `last` is a_{n-1}  (membrane.20), (membrane.21),
 * (membrane.22). */
LANES_FUNCTION void surface_damp_of(const surface_context *c, int order, size_t e, double *at,
                                    const vd *last)
{
    const fracas_surface_motion *m = &c->constants->motion;
    const int size = BODY_SIZE(order);
    const vd dt = c->kick, root = lanes_set(m->root);
    vd less[18], more[18], change[18], moment;
    UNROLL_FOR (int i = 0; i < size; i++) {
        const vd now = lanes_load(surface_at(at, SURFACE_A * size + i)),
                 next = lanes_load(surface_at(at, SURFACE_A_NEXT * size + i));
        less[i] = now - root * (next - now);
        more[i] = now + root * (next - now);
        change[i] = next - lanes_select(c->begins, now, last[i]);
    }
    double *sums = surface_sums(c, e);
    surface_add(surface_at(sums, SURFACE_KINETIC),
                lanes_set(m->excess) * dt * dt * surface_product(c, order, e, less, more, &moment));
    surface_add(surface_at(sums, SURFACE_DAMPED),
                lanes_set(0.25 * m->damping) * dt * dt *
                    surface_product(c, order, e, change, change, &moment));
    surface_loads loads;
    surface_loads_of(c, order, e, &loads);
    if (!loads.count && !(BODY_PLANE && c->tables->position)) return;
    UNROLL_FOR (int i = 0; i < size; i++)
        change[i] = lanes_load(surface_at(at, SURFACE_A * size + i)) - last[i];
    surface_work(c, &loads, size, lanes_set(m->excess) * dt, change, sums);
    if (!BODY_PLANE || !c->tables->position) return;
    surface_product(c, order, e, change, change, &moment);
    surface_add(surface_at(sums, SURFACE_MOMENT), lanes_set(m->excess) * dt * moment);
}

/* A function of its own: central difference, which does not call it, stays as fast. */
__attribute__((noinline)) static void surface_damp(const surface_context *c, int order, size_t e,
                                                   double *at, const vd *last)
{
    if (BODY_PLANE && order == 1) surface_damp_of(c, 1, e, at, last);
    else surface_damp_of(c, 2, e, at, last);
}

/* Keeps forces and accelerations of an element with held nodes, for its reactions (probes.3). */
__attribute__((noinline, cold)) static void
surface_keep(const surface_context *c, int size, size_t e, const vd *force, const vd *acceleration)
{
    const fracas_surface_division *division = c->step->division.plan;
    if (division->kept_row[e] == 0) return;
    double *row = c->state +
                  (division->kept + (division->kept_row[e] - 1) * (size_t)(2 * size)) * LANES;
    for (int i = 0; i < size; i++) {
        lanes_store(surface_at(row, i), force[i]);
        lanes_store(surface_at(row, size + i), acceleration[i]);
    }
}

/* Forces and kick of an element, and its share of kinetic energy. */
LANES_FUNCTION void surface_finish(surface_context *c, int order, int law,
                                   const fracas_surface_finish *finish)
{
    const int size = BODY_SIZE(order);
    const size_t e = finish->element;
    double *at = surface_place(c, finish->at), *slot = surface_place(c, finish->slot);
    vd force[18], v[18], a[18], after[18];
    UNROLL_FOR (int i = 0; i < size; i++)
        force[i] = lanes_load(surface_at(slot, BODY_SLOT_FORCE(order) + i));
    BODY(forces)(c, order, e, slot, force);
    surface_loads loads = {.count = 0};
    if (law != SURFACE_OPERATOR) {
        surface_loads_of(c, order, e, &loads);
        surface_take_loads(&loads, size, force);
    }
    UNROLL_FOR (int i = 0; i < size; i++) v[i] = lanes_load(surface_at(at, SURFACE_V * size + i));
    if (law != SURFACE_OPERATOR) {
        surface_accelerate_any(c, order, e, at, v, force, a);
    } else {
        surface_accelerate(c, order, e, SURFACE_POWER, v, force, a);
        UNROLL_FOR (int i = 0; i < size; i++)
            lanes_store(surface_at(at, SURFACE_V * size + i), a[i]);
        return;
    }
    if (__builtin_expect(c->keeps, 0)) surface_keep(c, size, e, force, a);
    const int alpha = c->constants->motion.alpha;
    vd last[18], moment;
    if (alpha) {
        UNROLL_FOR (int i = 0; i < size; i++)
            last[i] = lanes_load(surface_at(at, SURFACE_A * size + i));
    }
    if ((loads.count || c->constants->strained) &&
        !alpha) { /* velocities at the start become those of half a step before */
        const vd back = lanes_select(c->begins, lanes_set(0.5) * c->kick, lanes_set(0.0));
        UNROLL_FOR (int i = 0; i < size; i++) v[i] -= back * a[i];
        for (int i = 0; surface_is_moved(c, e) && i < size; i++) /* led from 0 to their path */
            if (c->tables->moved[e] >> i & 1) v[i] += back * a[i];
    }
    surface_kick(&c->constants->motion, c->kick, c->begins, size, at, a, v, after);
    double *sums = surface_sums(c, e);
    surface_add(surface_at(sums, SURFACE_KINETIC), surface_product(c, order, e, v, after, &moment));
    if (BODY_PLANE) surface_add(surface_at(sums, SURFACE_MOMENT), moment);
    surface_work(c, &loads, size, lanes_set(1.0), v, sums);
    if (alpha) surface_damp(c, order, e, at, last);
}

/* Begins the sums of element e's block, and ends them at its last turn. */
LANES_FUNCTION void surface_begin_block(surface_context *c, size_t e)
{
    UNROLL_FOR (int s = 0; s < SURFACE_SUMS_BY_TURN; s++) c->sum[s] = lanes_set(0.0);
    UNROLL_FOR (int s = SURFACE_SUMS_BY_TURN; s < SURFACE_SUMS; s++)
        lanes_store(surface_at(surface_sums(c, e), s), lanes_set(0.0));
}

LANES_FUNCTION void surface_end_block(const surface_context *c, size_t e)
{
    UNROLL_FOR (int s = 0; s < SURFACE_SUMS_BY_TURN; s++)
        lanes_store(surface_at(surface_sums(c, e), s), c->sum[s]);
}

/* Has the CPU fetch `size` bytes. */
LANES_FUNCTION void surface_fetch(const void *from, size_t size)
{
    for (size_t at = 0; at < size; at += 64) __builtin_prefetch((const char *)from + at);
}

/* Has the CPU fetch an element and its interfaces, before their turn comes: their memory is far
 * away, and each visit is long. */
LANES_FUNCTION void surface_fetch_turn(const surface_context *c, int order,
                                       const fracas_surface_turn *turn,
                                       const fracas_surface_facet *facet)
{
    const fracas_surface_tables *t = c->tables;
    const size_t nodes = (size_t)SURFACE_NODES(order), e = turn->element;
    surface_fetch(surface_place(c, turn->at), c->element_size * sizeof(double));
    surface_fetch(surface_bulk(c, order, e),
                  SURFACE_BULK(order) * BODY_BULK_TABLE * sizeof(double));
    surface_fetch(t->lumped + 2 * nodes * e, 2 * nodes * sizeof(double));
    if (BODY_DIMENSION == 3 && t->rotary)
        surface_fetch(t->rotary + e * SURFACE_ROTARY_TABLE, SURFACE_ROTARY_TABLE * sizeof(double));
    for (size_t j = turn[-1].facet_end; j < turn->facet_end; j++) {
        const size_t i = facet[j].interface;
        surface_fetch(surface_table(c, order, i),
                      (BODY_HEAD + SURFACE_EDGE(order) * BODY_POINT_TABLE) * sizeof(double));
        surface_fetch(surface_place(c, facet[j].at), c->interface_size * sizeof(double));
        surface_fetch(c->strengths + i * c->strengths_size, c->strengths_size * sizeof(double));
    }
}

/* An interface with friction, or with an onset or a break in this step. */
typedef void surface_interface_with_events(surface_context *context,
                                           const fracas_surface_facet *facet);

LANES_FUNCTION void surface_run(const fracas_surface_constants *s, fracas_step *step, int first,
                                size_t number, int order, int law,
                                surface_interface_with_events *with_events)
{
    const fracas_surface_division *division = step->division.plan;
    const fracas_surface_part *part = &division->part[number];
    double *state = step->state + (size_t)first * division->fields;
    surface_context context = {.constants = s,
                               .tables = s->tables,
                               .step = step,
                               .first = first,
                               .keeps = division->kept_row != NULL,
                               .state = state,
                               .sums = state + division->sums * LANES,
                               .element_size = fracas_surface_element_fields(s) * LANES,
                               .interface_size = fracas_surface_interface_fields(s) * LANES,
                               .strengths = state + fracas_surface_strengths_at(s) * LANES,
                               .strengths_size = (size_t)s->strengths * LANES,
                               .strength_step = s->strengths > 1 ? LANES : 0,
                               .drift = lanes_load(step->drift + first),
                               .kick = lanes_load(step->kick + first),
                               .begins = lanes_le(lanes_load(step->drift + first), lanes_set(0.0)),
                               .spin = lanes_load(step->spin + first)};
    surface_context *c = &context;
    const fracas_surface_facet *facet = part->facet;
    const fracas_surface_finish *finish = part->finish;
    for (const fracas_surface_turn *turn = part->turn; turn < part->turn + part->turns; turn++) {
        const size_t e = turn->element;
        double *at = surface_place(c, turn->at);
        c->ghost = turn->ghost;
        if (turn + 1 < part->turn + part->turns)
            surface_fetch_turn(c, order, turn + 1, part->facet);
        if (!c->ghost && e % SURFACE_BLOCK == 0) surface_begin_block(c, e);
        if (law != SURFACE_OPERATOR) surface_drift(&s->motion, c->drift, BODY_SIZE(order), at);
        if (law != SURFACE_OPERATOR && surface_is_moved(c, e)) surface_place_moved(c, order, e, at);
        surface_enter(c, order, e, at, surface_place(c, turn->slot));
        for (; facet < part->facet + turn->facet_end; facet++)
            if (s->friction || !surface_interface_forces(c, order, law, 1, facet))
                with_events(c, facet);
        for (; finish < part->finish + turn->finish_end; finish++)
            surface_finish(c, order, law, finish);
        if (!c->ghost && ((e + 1) % SURFACE_BLOCK == 0 || e + 1 == s->tables->nelements))
            surface_end_block(c, e);
    }
}

#if LANES == 1
/* Brings a view up to date  (membrane.12). */
LANES_FUNCTION void surface_inspect(const fracas_surface_constants *s, int order, size_t i,
                                    fracas_surface_view *view)
{
    surface_context c = {.constants = s, .tables = s->tables};
    surface_sides sides = surface_edges(order, s->tables->edge[i]);
    const double *table = surface_table(&c, order, i);
    plane_interface interface = surface_interface(s, table, 0);
    double slot[2][BODY_SLOT(2)];
    BODY(point) at[3];
    for (int side = 0; side < 2; side++) {
        sides.element[side] = view->u[side];
        sides.slot[side] = slot[side];
        surface_enter(&c, order, s->tables->element[i][side], view->u[side], slot[side]);
    }
    BODY(flux)(&c, order, i, &sides, at);
    for (int p = 0; p < SURFACE_EDGE(order) * BODY_LAYERS; p++) {
        const int g = p / BODY_LAYERS;
        const double *fields = view->fields + g * BODY_LAYERS * s->point_fields;
        const plane_input in = BODY(input)(s, table + BODY_HEAD + g * BODY_POINT_TABLE, &at[g],
                                           p % BODY_LAYERS);
        const plane_traction held = plane_held(&interface, &in);
        view->onset[p] = lanes_sqrt(plane_onset(&interface, held.n, held.t)) / view->strength[g];
        view->opening[p] = BODY(opening)(s, &interface, &in, &at[g], p % BODY_LAYERS, fields);
    }
}

LANES_FUNCTION double surface_strain(const fracas_surface_constants *s, int order, size_t e,
                                     double *u, double *stress)
{
    surface_context c = {.constants = s, .tables = s->tables};
    double slot[BODY_SLOT(2)], energy;
    surface_enter(&c, order, e, u, slot);
    lanes_store(&energy, c.sum[SURFACE_STRAIN]);
    if (stress) memcpy(stress, slot, (size_t)BODY_SLOT_EXTRA(order) * sizeof *stress);
    return 0.5 * energy;
}
#endif

#define SURFACE_SWEEP(name, order, law)                                                         \
    __attribute__((noinline)) static void name##_with_events(surface_context *c,                \
                                                             const fracas_surface_facet *facet) \
    {                                                                                           \
        surface_interface_forces(c, order, law, 0, facet);                                      \
    }                                                                                           \
    static void name(const fracas_surface_constants *constants, fracas_step *step, int first,   \
                     size_t part)                                                               \
    {                                                                                           \
        surface_run(constants, step, first, part, order, law, name##_with_events);              \
    }
#define SURFACE_LOOK(name, order, law)                                    \
    static void name(const fracas_surface_constants *constants, size_t i, \
                     fracas_surface_view *view)                           \
    {                                                                     \
        surface_inspect(constants, order, i, view);                       \
    }
#define SURFACE_STRAIN(name, order, law)                                                     \
    static double name(const fracas_surface_constants *constants, size_t element, double *u, \
                       double *stress)                                                       \
    {                                                                                        \
        return surface_strain(constants, order, element, u, stress);                         \
    }
#if BODY_PLANE
#define SURFACE_ORDERS(DEFINE, name, law) \
    DEFINE(linear_##name, 1, law) DEFINE(quadratic_##name, 2, law)
#define SURFACE_ENTRY(name)             \
    {                                   \
        linear_##name, quadratic_##name \
    }
#else
#define SURFACE_ORDERS(DEFINE, name, law) DEFINE(quadratic_##name, 2, law)
#define SURFACE_ENTRY(name)    \
    {                          \
        NULL, quadratic_##name \
    }
#endif

#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    BODY_TAKES(bar, ring, membrane, shell, SURFACE_ORDERS(SURFACE_SWEEP, name, FRACAS_LAW_##name))
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#if LANES == 1
SURFACE_ORDERS(SURFACE_SWEEP, operator, SURFACE_OPERATOR)
SURFACE_ORDERS(SURFACE_LOOK, look, )
SURFACE_ORDERS(SURFACE_STRAIN, strain, )
#endif

#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    BODY_TAKES(bar, ring, membrane, shell, [FRACAS_LAW_##name] = SURFACE_ENTRY(name), )
const fracas_surface_kernel LANES_UNIT(BODY_OF(fracas, BODY_NAME)) = {
#if LANES == 1
    .look = SURFACE_ENTRY(look),
    .strain = SURFACE_ENTRY(strain),
#endif
    .sweep = {
#if LANES == 1
        [SURFACE_OPERATOR] = SURFACE_ENTRY(operator),
#endif
#include "engine/cohesive/laws.list.h"
    }};
