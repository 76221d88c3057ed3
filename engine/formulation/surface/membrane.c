/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane: plane stress on a flat surface of triangles that share no nodes
 * (docs/theory/membrane.md). */
#include "engine/formulation/surface/membrane.h"

#include "engine/cohesive/law.h"
#include "engine/formulation/surface/common.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <math.h>
#include <stdlib.h>

static const fracas_membrane_tables *tables_of(const fracas_model *model)
{
    return model->plan;
}

/* k_n = K max(1, 1/beta_c^2), k_t = beta_c^2 k_n: neither is softer than K  (membrane.6) */
fracas_membrane_constants fracas_membrane_constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, c11 = spec->material.young / (1 - nu * nu),
                 beta_c = spec->cohesive.coupling;
    const fracas_law *law = fracas_law_of(spec);
    const bool centrifugal = spec->loading.type == &fracas_loading_centrifugal;
    fracas_membrane_constants c = {.tables = tables_of(model),
                                   .c11 = c11,
                                   .c12 = nu * c11,
                                   .c33 = spec->material.young / (2 * (1 + nu)),
                                   .normal = beta_c < 1 ? 1 / (beta_c * beta_c) : 1,
                                   .energy = spec->cohesive.fracture_energy,
                                   .opening = spec->cohesive.critical_opening,
                                   .beta_c = beta_c,
                                   .mu_c = spec->cohesive.friction,
                                   .onset_mean = spec->cohesive.onset != &fracas_onset_flux,
                                   .flux = law->flux,
                                   .friction = spec->cohesive.friction > 0,
                                   .point_fields = law->fields[spec->cohesive.friction > 0],
                                   .strengths = (int)model->strengths,
                                   .speed = centrifugal ? spec->loading.speed : 0,
                                   .ramp = spec->loading.ramp,
                                   .motion = fracas_surface_motion_of(&spec->time)};
    c.tangential = beta_c * beta_c * c.normal;
    c.fields = c.motion.alpha ? SURFACE_FIELDS_ALPHA : SURFACE_FIELDS;
    return c;
}

/* ---- the model ---- */

static fracas_err check_flat(const fracas_surface *surface)
{
    for (size_t n = 0; n < surface->nnodes; n++)
        if (surface->node[n][2] != surface->node[0][2])
            return fracas_fail(FRACAS_USAGE,
                               "a membrane is flat, but the mesh has nodes at z = %g and %g m: its "
                               "elements must lie in a plane z = const",
                               surface->node[0][2], surface->node[n][2]);
    const uint32_t *t = surface->element;
    const double *a = surface->node[t[0]], *b = surface->node[t[1]], *c = surface->node[t[2]];
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "the mesh's elements go round clockwise, seen from +z: turn them round");
}

static void measure(fracas_model *model)
{
    const fracas_membrane_tables *t = tables_of(model);
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++) model->mass += t->lumped[(2 * e + 1) * nodes + k];
    fracas_surface_measure_model(model);
}

static fracas_err membrane_model_init(fracas_model *model)
{
    fracas_membrane_tables *tables;
    TRY(fracas_surface_check_noise(&model->spec.mesh));
    TRY(fracas_mesh_make(&model->spec, &model->surface));
    TRY(check_flat(model->surface));
    TRY(fracas_surface_check_beta(model));
    model->elements = model->surface->nelements;
    model->interfaces = model->surface->ninterfaces;
    if (model->spec.strength_per_point)
        model->strengths = (size_t)MEMBRANE_EDGE(model->surface->order);
    TRY(fracas_membrane_tables_create(model, &tables));
    model->plan = tables;
    TRY(fracas_surface_check_motion(model, tables->held != NULL));
    measure(model);
    return fracas_membrane_critical_step(model);
}

/* ---- state ---- */

static size_t membrane_state_size(const fracas_model *model)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    return fracas_membrane_state_fields(&c);
}

/* Field `field` of a lane, counted from the start of its group's state. */
static double *value_at(const fracas_membrane_constants *c, const fracas_step *step, size_t field,
                        int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    return step->state + (group * fracas_membrane_state_fields(c) + field) * lanes +
           (size_t)lane % lanes;
}

double *fracas_membrane_value(const fracas_model *model, const fracas_step *step, size_t element,
                              int field, int i, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const int size = 2 * MEMBRANE_NODES(c.tables->order);
    return value_at(
        &c, step, element * fracas_membrane_element_fields(&c) + (size_t)(field * size + i), lane);
}

double *fracas_membrane_point(const fracas_model *model, const fracas_step *step, size_t interface,
                              int g, int field, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t at = fracas_membrane_joints_at(&c) + interface * fracas_membrane_joint_fields(&c);
    return value_at(&c, step, at + (size_t)(g * c.point_fields + field), lane);
}

static double *membrane_strength(const fracas_model *model, const fracas_step *step, int lane,
                                 size_t *stride)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    *stride = (size_t)step->lanes;
    return value_at(&c, step, fracas_membrane_strengths_at(&c), lane);
}

/* Velocity that node k of element e starts with  (membrane.17) */
static double start_velocity(const fracas_model *model, size_t e, size_t k, int i)
{
    const fracas_membrane_tables *t = tables_of(model);
    const size_t bit = 2 * k + (size_t)i;
    const bool held = t->held && (t->held[e] >> bit & 1), fixed = held && (t->fixed[e] >> bit & 1);
    const double *x =
        model->surface->node[model->surface->element[e * model->surface->corners + k]];
    return fracas_surface_start_velocity(&model->spec.loading, x, i, held, fixed);
}

static void membrane_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t nodes = (size_t)MEMBRANE_NODES(c.tables->order),
                 fields = fracas_membrane_element_fields(&c);
    const size_t joint = fracas_membrane_joint_fields(&c), joints = fracas_membrane_joints_at(&c);
    for (size_t e = 0; e < model->elements; e++) {
        for (size_t f = 0; f < fields; f++) *value_at(&c, step, e * fields + f, lane) = 0;
        for (size_t k = 0; k < nodes; k++)
            for (int i = 0; i < 2; i++)
                *value_at(&c, step, e * fields + (size_t)SURFACE_V * 2 * nodes + 2 * k + (size_t)i,
                          lane) = start_velocity(model, e, k, i);
    }
    for (size_t i = 0; i < model->interfaces; i++)
        for (size_t f = 0; f < joint; f++) *value_at(&c, step, joints + i * joint + f, lane) = 0;
}

FRACAS_KERNEL_TABLE(const fracas_membrane_kernel, fracas_membrane);

static void membrane_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    fracas_membrane_sweep *sweep =
        fracas_membrane[step->isa][step->lanes]
            ->sweep[fracas_law_of(&model->spec)->number][c.tables->order - 1];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&c, step, first);
}

/* ---- what is left of a lane ---- */

static double point_value(const fracas_membrane_constants *c, const fracas_step *step,
                          size_t interface, int g, int field, int lane)
{
    const size_t at = fracas_membrane_joints_at(c) + interface * fracas_membrane_joint_fields(c);
    return *value_at(c, step, at + (size_t)(g * c->point_fields + field), lane);
}

/* D of an interface: the mean over its points by their weights, 1 only where all are broken
 * (membrane.18) */
static double membrane_damage(const fracas_model *model, const fracas_step *step, size_t i,
                              int lane)
{
    static const double weight[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const int order = c.tables->order;
    double damage = 0;
    bool broken = true;
    for (int g = 0; g < MEMBRANE_EDGE(order); g++) {
        const double at = point_value(&c, step, i, g, SURFACE_DAMAGE, lane);
        damage += weight[order - 1][g] * at;
        broken = broken && at >= 1.0;
    }
    return broken ? 1.0 : fmin(damage, 1.0 - 0x1p-53);
}

static int64_t membrane_fragment_count(const fracas_model *model, fracas_step *step, int lane)
{
    return fracas_surface_fragment_count(model, step, lane, membrane_damage);
}

/* M_kl of element e, of its lumped or consistent masses [kg]. */
static double mass_at(const fracas_membrane_tables *t, size_t e, size_t k, size_t l)
{
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order);
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

/* Adds the nodes of an element to its fragment's sums. By the masses that it moves with: of
 * quadratic elements the lumped ones give another momentum, which is not kept. */
static void add_element(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                        fracas_fragment_sums *f)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t nodes = (size_t)MEMBRANE_NODES(c.tables->order),
                 base = e * fracas_membrane_element_fields(&c);
    double x[6][3] = {{0}};
    for (size_t k = 0; k < nodes; k++)
        for (size_t i = 0; i < 2; i++)
            x[k][i] = model->surface->node[model->surface->element[e * nodes + k]][i] +
                      *value_at(&c, step, base + 2 * k + i, lane);
    for (size_t k = 0; k < nodes; k++) {
        double mass = 0, carried[3] = {0}, momentum[3] = {0};
        for (size_t l = 0; l < nodes; l++) {
            const double share = mass_at(c.tables, e, k, l);
            mass += share;
            for (size_t i = 0; i < 2; i++) {
                carried[i] += share * x[l][i];
                momentum[i] += share * *value_at(&c, step,
                                                 base + (size_t)SURFACE_V * 2 * nodes + 2 * l + i,
                                                 lane);
            }
        }
        fracas_fragment_sums_add_coupled(f, mass, x[k], carried, momentum);
    }
}

/* (membrane.19) */
static fracas_err membrane_harvest(const fracas_model *model, fracas_step *step, int lane,
                                   fracas_record *record)
{
    return fracas_surface_harvest(model, step, lane, membrane_damage, add_element, record);
}

static const fracas_kind *const goes_with[] = {
    &fracas_shape_plate,        &fracas_shape_annulus, &fracas_shape_file,
    &fracas_spacing_triangles,  &fracas_spacing_given, &fracas_loading_expansion,
    &fracas_loading_centrifugal};
const fracas_formulation fracas_formulation_membrane = {
    .kind = {.name = "membrane",
             .doc = "a plate in plane stress, of triangles in its plane",
             .goes_with = goes_with,
             .ngoes_with = FRACAS_COUNT(goes_with)},
    .model_init = membrane_model_init,
    .check_strength = fracas_surface_check_strength,
    .interface_volume = fracas_surface_interface_volume,
    .plan_destroy = fracas_membrane_tables_destroy,
    .state_size = membrane_state_size,
    .strength = membrane_strength,
    .lane_init = membrane_lane_init,
    .advance = membrane_advance,
    .fragment_count = membrane_fragment_count,
    .harvest = membrane_harvest,
};
