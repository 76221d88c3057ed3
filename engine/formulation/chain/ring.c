/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ring: nodes in the plane, an element is a spring along its chord (docs/theory/ring.md). */
#include "engine/formulation/chain/ring_sweep.h"

#include "base/elementary.h"
#include "base/own.h"
#include "engine/cohesive/law.h"
#include "engine/formulation/chain/chain.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>

FRACAS_KERNEL_TABLE(const fracas_ring_kernel, fracas_ring);

static const fracas_chain flux_chain = {
    .fields = RING_FIELDS, .damage = RING_DAMAGE, .strength = RING_STRENGTH, .law = RING_LAW};
static const fracas_chain rigid_chain = {.fields = RING_FIELDS_STERSHIC,
                                         .damage = RING_DAMAGE,
                                         .strength = RING_STRENGTH,
                                         .law = RING_LAW,
                                         .open = RING_LINK_OPEN,
                                         .barred = RING_LINK_BARRED};

static bool has_flux(const fracas_model *model)
{
    return fracas_law_of(&model->spec)->flux;
}

/* Radius of the vertices of the polygon whose perimeter is the ring's circumference [m]  (ring.1).
 */
static double vertex_radius(const fracas_model *model)
{
    return model->element_size / (2.0 * fracas_sinpi(1.0 / (double)model->elements));
}

/* The drive of the nodes while the ring moves. */
static fracas_ring_motion motion_of(const fracas_model *model)
{
    return fracas_loading_traits_of(&model->spec)->motion(&model->spec, vertex_radius(model));
}

static fracas_ring_constants constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double young = spec->material.young, h = model->element_size;
    const fracas_ring_motion motion = motion_of(model);
    /* a node's share of a force per length, by area */
    const double share = motion.drive == FRACAS_RING_FORCED ? 0.5 * h / spec->geometry.area : 1.0;
    return (fracas_ring_constants){
        .elements = model->elements,
        .table = model->table,
        .current = spec->geometry.direction == &fracas_direction_current,
        .young = young,
        .spring = fracas_law_of(spec)->contact(&spec->cohesive) * young / h,
        .whole = fracas_chain_whole(fracas_law_of(spec)->contact(&spec->cohesive)),
        .size = h,
        .bending = young * h / 12.0,
        .corner = fracas_sinpi(2.0 / (double)model->elements),
        .radius = vertex_radius(model),
        .nodal_mass = 0.5 * spec->material.density * h,
        .fracture_energy = spec->cohesive.fracture_energy,
        .critical_opening = spec->cohesive.critical_opening,
        .area = spec->geometry.area,
        .time_step = model->time_step,
        .own = model->own,
        .drive = motion.drive,
        .circumferential = motion.circumferential,
        .level = motion.level * share,
        .rate = motion.rate * share};
}

static fracas_err ring_model_init(fracas_model *model)
{
    const double zone = fracas_law_zone(&model->spec.cohesive);
    TRY(fracas_chain_model_init(model, has_flux(model) ? &flux_chain : &rigid_chain, 3));
    const size_t n = model->elements;
    if (zone > 0 && zone * (1 + 1e-12) < model->element_size)
        return fracas_fail(
            FRACAS_USAGE,
            "cohesive.zone is %.4g m, but elements are %.4g m long, so that it holds no other "
            "interface: raise it, or mesh.elements above %.15g, or leave it out",
            zone, model->element_size, ceil(fracas_spec_length(&model->spec) / zone));
    double *table = model->table = malloc(n * RING_TABLE * sizeof *table);
    if (!table) return fracas_no_memory("the mesh of a ring");
    model->bytes = n * RING_TABLE * sizeof *table;
    for (size_t e = 0; e < n; e++) {
        const double angle = (double)(2 * e) / (double)n, middle = (double)(2 * e + 1) / (double)n;
        table[e * RING_TABLE + RING_COS] = fracas_cospi(angle);
        table[e * RING_TABLE + RING_SIN] = fracas_sinpi(angle);
        table[e * RING_TABLE + RING_START_X] = -model->element_size * fracas_sinpi(middle);
        table[e * RING_TABLE + RING_START_Y] = model->element_size * fracas_cospi(middle);
    }
    const bool held = motion_of(model).drive == FRACAS_RING_HELD; /* a free spin stretches, too */
    model->rigid_part = held ? FRACAS_MOTION_HOMOGENEOUS : FRACAS_MOTION_NONE;
    return fracas_chain_critical_step(model);
}

static void ring_interface_positions(const fracas_model *model, double (*position)[3])
{
    const double radius = model->spec.geometry.radius;
    for (size_t e = 0; e < model->interfaces; e++) {
        const double *node = model->table + fracas_chain_next(model, e) * RING_TABLE;
        position[e][0] = radius * node[RING_COS];
        position[e][1] = radius * node[RING_SIN];
        position[e][2] = 0;
    }
}

/* ---- state ---- */

/* First velocities outward and along the ring [m/s]: of central difference half a step before the
 * start, at the acceleration of the start, of Newmark at the start itself  (ring.10). */
static void start_velocities(const fracas_model *model, double velocity[2])
{
    const fracas_ring_constants ring = constants_of(model);
    const fracas_ring_motion motion = motion_of(model);
    const double back = has_flux(model) ? 0.5 * model->time_step : 0.0;
    velocity[0] = motion.start[0];
    velocity[1] = motion.start[1];
    if (ring.drive == FRACAS_RING_HELD)
        velocity[ring.circumferential] = ring.level - ring.rate * back;
    if (ring.drive == FRACAS_RING_FORCED)
        velocity[ring.circumferential] = -ring.level / ring.nodal_mass * back;
}

static void ring_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    double velocity[2];
    start_velocities(model, velocity);
    fracas_chain_lane_init(model, step, lane);
    for (size_t e = 0; e < model->elements; e++) {
        for (size_t side = 0; side < 2; side++) {
            const double *table = model->table + (e + side) % model->elements * RING_TABLE;
            const int field = side ? RING_V_RIGHT : RING_V_LEFT;
            *fracas_chain_field(model, step, e, field, lane) = velocity[0] * table[RING_COS] -
                                                               velocity[1] * table[RING_SIN];
            *fracas_chain_field(model, step, e, field + 1, lane) = velocity[0] * table[RING_SIN] +
                                                                   velocity[1] * table[RING_COS];
        }
        if (!has_flux(model)) *fracas_chain_field(model, step, e, RING_STRAIN, lane) = -1.0;
    }
}

static void ring_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_ring_constants ring = constants_of(model);
    fracas_ring_sweep *sweep = fracas_ring[step->isa][step->lanes]
                                   ->sweep[fracas_law_of(&model->spec)->number][step->balanced];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&ring, step, first);
}

/* ---- fragments ---- */

static void chord_of(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                     double chord[2])
{
    const double *start = model->table + e * RING_TABLE + RING_START_X;
    for (int i = 0; i < 2; i++)
        chord[i] = start[i] + *fracas_chain_field(model, step, e, RING_U_RIGHT + i, lane) -
                   *fracas_chain_field(model, step, e, RING_U_LEFT + i, lane);
}

/* Stress of an element [Pa], and its strain. */
static double stress_of(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                        double *strain)
{
    double chord[2];
    chord_of(model, step, lane, e, chord);
    *strain = sqrt(chord[0] * chord[0] + chord[1] * chord[1]) / model->element_size - 1;
    return has_flux(model) ? model->spec.material.young * *strain
                           : *fracas_chain_field(model, step, e, RING_STRESS, lane);
}

/* [J] */
static double strain_energy(const fracas_model *model, const fracas_step *step, int lane, size_t e)
{
    double strain;
    const double stress = stress_of(model, step, lane, e, &strain);
    return 0.5 * model->spec.geometry.area * model->element_size * stress * strain;
}

/* Place of a node of an element now [m]. */
static void place_of(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                     size_t side, double x[3])
{
    const double radius = vertex_radius(model);
    const double *table = model->table + (e + side) % model->elements * RING_TABLE;
    const int u = side ? RING_U_RIGHT : RING_U_LEFT;
    x[0] = radius * table[RING_COS] + *fracas_chain_field(model, step, e, u, lane);
    x[1] = radius * table[RING_SIN] + *fracas_chain_field(model, step, e, u + 1, lane);
    x[2] = 0;
}

/* Adds one element's two nodes to its fragment's sums, less a motion, unless that is NULL. */
static void add_element(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                        const fracas_fragment_motion *motion, fracas_fragment_sums *f)
{
    const double mass = 0.5 * model->spec.material.density * model->spec.geometry.area *
                        model->element_size;
    const double before = f->mass;
    f->elements++;
    f->size += model->element_size;
    f->strain_energy += strain_energy(model, step, lane, e);
    for (size_t side = 0; side < 2; side++) {
        const int v = side ? RING_V_RIGHT : RING_V_LEFT;
        double x[3];
        place_of(model, step, lane, e, side, x);
        double w[3] = {*fracas_chain_field(model, step, e, v, lane),
                       *fracas_chain_field(model, step, e, v + 1, lane)};
        if (motion) fracas_fragment_motion_take_off(motion, x, w);
        fracas_fragment_sums_add(f, mass, x, w);
    }
    f->mass = before + 2 * mass; /* rounded once an element */
}

static void ring_add_up(const fracas_model *model, const fracas_step *step, int lane,
                        const fracas_fragment_motion *motion, fracas_fragment_sums *sums)
{
    for (size_t e = 0; e < model->elements; e++) {
        const size_t f = step->partition.label[e];
        add_element(model, step, lane, e, motion ? &motion[f] : NULL, &sums[f]);
    }
}

/* Fragments as (bar.17), in the plane  (ring.18). */
static fracas_err ring_harvest(const fracas_model *model, fracas_step *step, int lane,
                               fracas_record *record)
{
    const size_t count = fracas_chain_partition(model, step, lane);
    OWNED fracas_fragment_sums *sums = calloc(count, sizeof *sums);
    if (!sums) return fracas_no_memory("the fragments of a realization");
    ring_add_up(model, step, lane, NULL, sums);
    TRY(fracas_fragments_take(sums, count, 1, record));
    return fracas_chain_harvest_interfaces(model, step, lane, record);
}

static void ring_add_matter(const fracas_model *model, const fracas_step *step, int lane,
                            const uint32_t *element, size_t count, fracas_fragment_matter *matter,
                            double (*node)[3])
{
    const fracas_spec *spec = &model->spec;
    const double mass = spec->material.density * spec->geometry.area * model->element_size;
    for (size_t n = 0; n < count; n++, node += 2) {
        for (size_t side = 0; side < 2; side++)
            place_of(model, step, lane, element[n], side, node[side]);
        fracas_chain_add_segment(spec, mass, (const double(*)[3])node, matter);
    }
}

/* ---- fields ---- */

static double opening_of(const fracas_model *model, const fracas_step *step, int lane, size_t e)
{
    const size_t next = fracas_chain_next(model, e);
    const double *vertex = model->table + next * RING_TABLE;
    double normal[2] = {-vertex[RING_SIN], vertex[RING_COS]}, jump = 0; /* (ring.4) */
    if (model->spec.geometry.direction == &fracas_direction_current) {
        double left[2], right[2];
        chord_of(model, step, lane, e, left);
        chord_of(model, step, lane, next, right);
        for (int i = 0; i < 2; i++) normal[i] = left[i] + right[i];
        const double length = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
        for (int i = 0; i < 2; i++) normal[i] /= length;
    }
    for (int i = 0; i < 2; i++)
        jump += normal[i] * (*fracas_chain_field(model, step, next, RING_U_LEFT + i, lane) -
                             *fracas_chain_field(model, step, e, RING_U_RIGHT + i, lane));
    return jump;
}

static void ring_fields(const fracas_model *model, const fracas_step *step, int lane,
                        fracas_fields *f)
{
    const double mass = 0.5 * model->spec.material.density * model->spec.geometry.area *
                        model->element_size;
    for (size_t e = 0; e < model->elements; e++) {
        double strain;
        f->stress[0][e] = stress_of(model, step, lane, e, &strain);
        for (size_t side = 0; side < 2; side++) {
            const size_t node = 2 * e + side;
            const int u = side ? RING_U_RIGHT : RING_U_LEFT, v = side ? RING_V_RIGHT : RING_V_LEFT;
            place_of(model, step, lane, e, side, f->place[node]);
            for (int i = 0; i < 2; i++) {
                f->displacement[node][i] = *fracas_chain_field(model, step, e, u + i, lane);
                f->velocity[node][i] = *fracas_chain_field(model, step, e, v + i, lane);
            }
            f->displacement[node][2] = f->velocity[node][2] = 0;
            f->mass[node] = mass;
        }
    }
    for (size_t e = 0; e < model->interfaces; e++) {
        fracas_chain_fill_interface(model, step, lane, e, f);
        f->opening[e] = opening_of(model, step, lane, e);
    }
}

/* Places before any motion are on the polygon. */
static void ring_locate(const fracas_model *model, const double place[3], fracas_spot *spot)
{
    const double radius = vertex_radius(model);
    for (size_t e = 0; e < model->elements; e++) {
        double ends[2][3] = {{0}};
        for (size_t side = 0; side < 2; side++) {
            const double *table = model->table + (e + side) % model->elements * RING_TABLE;
            ends[side][0] = radius * table[RING_COS];
            ends[side][1] = radius * table[RING_SIN];
        }
        fracas_chain_locate(model, e, (const double(*)[3])ends, place, spot);
    }
}

/* (probes.2) */
static void ring_motion_at(const fracas_model *model, const fracas_step *step, int lane,
                           const fracas_spot *spot, double displacement[3], double velocity[3])
{
    for (int i = 0; i < 3; i++) displacement[i] = velocity[i] = 0;
    for (int side = 0; side < 2; side++) {
        const int u = side ? RING_U_RIGHT : RING_U_LEFT, v = side ? RING_V_RIGHT : RING_V_LEFT;
        for (int i = 0; i < 2; i++) {
            displacement[i] += spot->weight[side] *
                               *fracas_chain_field(model, step, spot->element, u + i, lane);
            velocity[i] += spot->weight[side] *
                           *fracas_chain_field(model, step, spot->element, v + i, lane);
        }
    }
}

static const fracas_kind *const goes_with[] = {&fracas_shape_ring,
                                               &fracas_spacing_uniform,
                                               &fracas_loading_imposed_rate,
                                               &fracas_loading_initial_velocity,
                                               &fracas_loading_held_velocity,
                                               &fracas_loading_force};
const fracas_formulation fracas_formulation_ring = {
    .kind = {.name = "ring",
             .groups = FRACAS_GROUP_RING,
             .doc = "a closed ring in the plane, of springs along its circumference",
             FRACAS_GOES_WITH(goes_with)},
    .model_init = ring_model_init,
    .check_strength = fracas_chain_check_strength,
    .interface_positions = ring_interface_positions,
    .lane_init = ring_lane_init,
    .advance = ring_advance,
    .add_up = ring_add_up,
    .harvest = ring_harvest,
    .add_matter = ring_add_matter,
    .fields = ring_fields,
    .locate = ring_locate,
    .motion_at = ring_motion_at,
    FRACAS_CHAIN_FORMULATION};
