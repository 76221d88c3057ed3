/* The membrane: plane stress on a flat surface of triangles that share no nodes (docs/theory/membrane.md). */
#include "engine/formulation/surface/membrane.h"

#include "engine/cohesive/law.h"
#include "engine/integrator/hulbert_chung.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <math.h>
#include <stdlib.h>

static const fracas_membrane_tables *tables_of(const fracas_model *model) { return model->plan; }

static bool is_nitsche(const fracas_model *model) { return model->spec.cohesive.law == &fracas_law_nitsche; }

static int point_fields_of(const fracas_model *model)
{
    const bool friction = model->spec.cohesive.friction > 0;
    if (is_nitsche(model)) return friction ? MEMBRANE_POINT_FIELDS_FRICTION : MEMBRANE_POINT_FIELDS;
    return friction ? MEMBRANE_POINT_FIELDS_EXTRINSIC_FRICTION : MEMBRANE_POINT_FIELDS_EXTRINSIC;
}

/* k_n = K max(1, 1/beta_c^2), k_t = beta_c^2 k_n: neither is softer than K  (membrane.6) */
fracas_membrane_constants fracas_membrane_constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, c11 = spec->material.young / (1 - nu * nu), beta_c = spec->cohesive.coupling;
    const fracas_hulbert_chung alpha = fracas_hulbert_chung_of(spec->time.spectral_radius);
    const bool centrifugal = spec->loading.type == &fracas_loading_centrifugal;
    fracas_membrane_constants c = {
        .tables = tables_of(model), .c11 = c11, .c12 = nu * c11, .c33 = spec->material.young / (2 * (1 + nu)),
        .normal = beta_c < 1 ? 1 / (beta_c * beta_c) : 1, .energy = spec->cohesive.fracture_energy, .opening = spec->cohesive.critical_opening, .beta_c = beta_c,
        .mu_c = spec->cohesive.friction, .onset_mean = spec->cohesive.onset != &fracas_onset_flux,
        .standard = spec->cohesive.law != &fracas_law_camacho_ortiz, .friction = spec->cohesive.friction > 0,
        .point_fields = point_fields_of(model), .speed = centrifugal ? spec->loading.speed : 0, .ramp = spec->loading.ramp,
        .alpha = spec->time.integrator == &fracas_integrator_hulbert_chung, .alpha_m = alpha.alpha_m, .b = alpha.beta, .g = alpha.gamma};
    c.tangential = beta_c * beta_c * c.normal;
    c.fields = c.alpha ? MEMBRANE_FIELDS_ALPHA : MEMBRANE_FIELDS;
    return c;
}

/* ---- the model ---- */

static fracas_err check_flat(const fracas_surface *surface)
{
    for (size_t n = 0; n < surface->nnodes; n++)
        if (surface->node[n][2] != surface->node[0][2])
            return fracas_fail(FRACAS_USAGE, "a membrane is flat, but the mesh has nodes at z = %g and %g m: its elements must lie in a plane "
                               "z = const", surface->node[0][2], surface->node[n][2]);
    const uint32_t *t = surface->element;
    const double *a = surface->node[t[0]], *b = surface->node[t[1]], *c = surface->node[t[2]];
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "the mesh's elements go round clockwise, seen from +z: turn them round");
}

/* The operator is positive from 1.15 (linear) and 2.25 (quadratic) on, measured on meshes distorted by up to 30 %, nu up to 0.49:
 * tests/verification/test_membrane_patch.c. */
static fracas_err check_beta(const fracas_model *model)
{
    const double least = model->surface->order == 2 ? 2.3 : 1.3;
    if (model->spec.cohesive.beta >= least) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "cohesive.beta is %g, too soft for %s triangles: give %g or more; twice as much is usual",
                       model->spec.cohesive.beta, model->surface->order == 2 ? "quadratic" : "linear", least);
}

static fracas_err check_noise(const fracas_mesh *mesh)
{
    if (mesh->noise || mesh->spacing != &fracas_spacing_triangles || mesh->amplitude == 0) return FRACAS_OK;
    return fracas_fail(FRACAS_BUG, "a perturbed mesh without random numbers");
}

static fracas_err check_motion(const fracas_model *model)
{
    const fracas_loading *loading = &model->spec.loading;
    if (loading->type != &fracas_loading_expansion || loading->start != &fracas_start_rest || tables_of(model)->held) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "loading.start is rest, and all edges are free: nothing would ever move; let an edge be held, or start "
                       "moving");
}

static void measure(fracas_model *model)
{
    const fracas_membrane_tables *t = tables_of(model);
    const fracas_spec *spec = &model->spec;
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order), joint = MEMBRANE_POINTS + (size_t)MEMBRANE_EDGE(t->order) * MEMBRANE_POINT_TABLE;
    const double nu = spec->material.poisson, beta_modulus = spec->cohesive.beta * spec->material.young / (1 - nu * nu);
    double length = 0;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++) model->mass += t->lumped[(2 * e + 1) * nodes + k];
    for (size_t i = 0; i < t->ninterfaces; i++) {
        const fracas_surface_interface *interface = &model->surface->interface[i];
        length += fracas_surface_length(model->surface, interface->element[0], interface->edge[0]);
        model->longest = fmax(model->longest, beta_modulus / t->joint[i * joint + MEMBRANE_STIFFNESS]);
    }
    model->element_size = t->ninterfaces ? length / (double)t->ninterfaces : sqrt(model->mass / (spec->material.density * spec->geometry.thickness));
}

static fracas_err membrane_model_init(fracas_model *model)
{
    fracas_membrane_tables *tables;
    TRY(check_noise(&model->spec.mesh));
    TRY(fracas_mesh_make(&model->spec, &model->surface));
    TRY(check_flat(model->surface));
    TRY(check_beta(model));
    model->elements = model->surface->nelements;
    model->interfaces = model->surface->ninterfaces;
    TRY(fracas_membrane_tables_create(model, &tables));
    model->plan = tables;
    TRY(check_motion(model));
    measure(model);
    return fracas_membrane_critical_step(model);
}

/* K >= 2 sigma_c/delta_c at the softest interface: twice what the law asks for (cohesive.7), so that no peak as small as the strength
 * is cut  (cohesive.13) */
static fracas_err membrane_check_strength(const fracas_model *model, double strength)
{
    const fracas_spec *spec = &model->spec;
    if (!(strength > 0) || !isfinite(strength))
        return fracas_fail(FRACAS_USAGE, "strength of %g Pa; it must be positive and finite: check the section strength", strength);
    const double nu = spec->material.poisson, modulus = spec->material.young / (1 - nu * nu);
    const double most = spec->cohesive.beta * modulus * fracas_spec_fracture_energy(spec, strength) / (strength * strength);
    if (!is_nitsche(model) || (isfinite(most) && model->longest <= most)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "strength %g Pa needs elements of which area/edge is below %.4g m, the largest is %.4g m: refine the "
                       "mesh %.3g times (or raise cohesive.beta)", strength, most, model->longest, model->longest / most);
}

/* A third of its two elements. */
static double membrane_interface_volume(const fracas_model *model, size_t i)
{
    const fracas_surface_interface *interface = &model->surface->interface[i];
    double area = 0;
    for (int side = 0; side < 2; side++) area += fracas_surface_area(model->surface, interface->element[side]);
    return model->spec.geometry.thickness * (area / 3);
}

/* ---- state ---- */

static size_t membrane_state_size(const fracas_model *model)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    return fracas_membrane_state_fields(&c);
}

/* Field `field` of a lane, counted from the start of its group's state. */
static double *value_at(const fracas_membrane_constants *c, const fracas_step *step, size_t field, int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    return step->state + (group * fracas_membrane_state_fields(c) + field) * lanes + (size_t)lane % lanes;
}

double *fracas_membrane_value(const fracas_model *model, const fracas_step *step, size_t element, int field, int i, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const int size = 2 * MEMBRANE_NODES(c.tables->order);
    return value_at(&c, step, element * fracas_membrane_element_fields(&c) + (size_t)(field * size + i), lane);
}

double *fracas_membrane_point(const fracas_model *model, const fracas_step *step, size_t interface, int g, int field, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t at = fracas_membrane_joints_at(&c) + interface * fracas_membrane_joint_fields(&c);
    return value_at(&c, step, at + MEMBRANE_LAW + (size_t)(g * c.point_fields + field), lane);
}

static double *membrane_strength(const fracas_model *model, const fracas_step *step, int lane, size_t *stride)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    *stride = fracas_membrane_joint_fields(&c) * (size_t)step->lanes;
    return value_at(&c, step, fracas_membrane_joints_at(&c) + MEMBRANE_STRENGTH, lane);
}

/* Velocity that node k of element e starts with: that of the expansion, everywhere or where it is held, none where it is fixed
 * (membrane.17) */
static double start_velocity(const fracas_model *model, size_t e, size_t k, int i)
{
    const fracas_loading *loading = &model->spec.loading;
    const fracas_membrane_tables *t = tables_of(model);
    const unsigned held = t->held ? t->held[e] >> (2 * k + (size_t)i) & 1u : 0u;
    if (held && t->fixed[e] >> (2 * k + (size_t)i) & 1u) return 0;
    if (loading->type != &fracas_loading_expansion || (loading->start == &fracas_start_rest && !held)) return 0;
    const double *x = model->surface->node[model->surface->element[e * model->surface->corners + k]];
    return (i ? loading->ratio : 1.0) * loading->rate * x[i];
}

static void membrane_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t nodes = (size_t)MEMBRANE_NODES(c.tables->order), fields = fracas_membrane_element_fields(&c);
    const size_t joint = fracas_membrane_joint_fields(&c), joints = fracas_membrane_joints_at(&c);
    for (size_t e = 0; e < model->elements; e++) {
        for (size_t f = 0; f < fields; f++) *value_at(&c, step, e * fields + f, lane) = 0;
        for (size_t k = 0; k < nodes; k++)
            for (int i = 0; i < 2; i++)
                *value_at(&c, step, e * fields + (size_t)MEMBRANE_V * 2 * nodes + 2 * k + (size_t)i, lane) = start_velocity(model, e, k, i);
    }
    for (size_t i = 0; i < model->interfaces; i++)
        for (size_t f = MEMBRANE_LAW; f < joint; f++) *value_at(&c, step, joints + i * joint + f, lane) = 0;
}

static void membrane_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const fracas_membrane_kernels *kernels = step->isa == FRACAS_ISA_AVX512 ? &fracas_membrane_kernels_avx512
                                             : step->isa == FRACAS_ISA_AVX2 ? &fracas_membrane_kernels_avx2
                                                                            : &fracas_membrane_kernels_baseline;
    const int width = step->lanes == 8 ? 2 : step->lanes == 4 ? 1 : 0;
    fracas_membrane_sweep *sweep = kernels->sweep[is_nitsche(model) ? MEMBRANE_NITSCHE : MEMBRANE_EXTRINSIC][c.tables->order - 1][width];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&c, step, first);
}

/* ---- what is left of a lane ---- */

static double point_value(const fracas_membrane_constants *c, const fracas_step *step, size_t interface, int g, int field, int lane)
{
    const size_t at = fracas_membrane_joints_at(c) + interface * fracas_membrane_joint_fields(c);
    return *value_at(c, step, at + MEMBRANE_LAW + (size_t)(g * c->point_fields + field), lane);
}

/* D of an interface: the mean over its points by their weights, 1 only where all are broken  (membrane.18) */
static double damage_of(const fracas_membrane_constants *c, const fracas_step *step, size_t i, int lane)
{
    static const double weight[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const int order = c->tables->order;
    double damage = 0;
    bool broken = true;
    for (int g = 0; g < MEMBRANE_EDGE(order); g++) {
        const double at = point_value(c, step, i, g, MEMBRANE_DAMAGE, lane);
        damage += weight[order - 1][g] * at;
        broken = broken && at >= 1.0;
    }
    return broken ? 1.0 : fmin(damage, 1.0 - 0x1p-53);
}

static size_t partition(const fracas_model *model, fracas_step *step, int lane)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    fracas_partition_reset(&step->partition);
    for (size_t i = 0; i < model->interfaces; i++)
        if (damage_of(&c, step, i, lane) < 1.0) fracas_partition_join(&step->partition, c.tables->element[i][0], c.tables->element[i][1]);
    return fracas_partition_label(&step->partition);
}

static int64_t membrane_fragment_count(const fracas_model *model, fracas_step *step, int lane)
{
    return step->broken[lane] == 0 ? 1 : (int64_t)partition(model, step, lane);
}

/* M_kl of element e, of its lumped or consistent masses [kg]. */
static double mass_at(const fracas_membrane_tables *t, size_t e, size_t k, size_t l)
{
    const size_t nodes = (size_t)MEMBRANE_NODES(t->order);
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

/* Adds the nodes of an element to its fragment's sums. By the masses that it moves with: of quadratic elements the lumped ones
 * give another momentum, which is not kept. */
static void add_element(const fracas_model *model, const fracas_step *step, int lane, size_t e, fracas_fragment_sums *f)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    const size_t nodes = (size_t)MEMBRANE_NODES(c.tables->order), base = e * fracas_membrane_element_fields(&c);
    double x[6][3] = {{0}};
    f->elements++;
    for (size_t k = 0; k < nodes; k++)
        for (size_t i = 0; i < 2; i++)
            x[k][i] = model->surface->node[model->surface->element[e * nodes + k]][i] + *value_at(&c, step, base + 2 * k + i, lane);
    for (size_t k = 0; k < nodes; k++) {
        double mass = 0, carried[3] = {0}, momentum[3] = {0};
        for (size_t l = 0; l < nodes; l++) {
            const double share = mass_at(c.tables, e, k, l);
            mass += share;
            for (size_t i = 0; i < 2; i++) {
                carried[i] += share * x[l][i];
                momentum[i] += share * *value_at(&c, step, base + (size_t)MEMBRANE_V * 2 * nodes + 2 * l + i, lane);
            }
        }
        fracas_fragment_sums_add_coupled(f, mass, x[k], carried, momentum);
    }
}

static fracas_err harvest_interfaces(const fracas_model *model, const fracas_step *step, int lane, fracas_record *record)
{
    const fracas_membrane_constants c = fracas_membrane_constants_of(model);
    size_t stride;
    const double *strength = membrane_strength(model, step, lane, &stride);
    record->interface = calloc(model->interfaces ? model->interfaces : 1, sizeof *record->interface);
    if (!record->interface) return fracas_no_memory("the interfaces of a realization");
    record->ninterface = model->interfaces;
    for (size_t i = 0; i < model->interfaces; i++) {
        const size_t at = i * (size_t)step->width + (size_t)lane;
        record->interface[i] = (fracas_interface_row){.strength = strength[i * stride], .damage = damage_of(&c, step, i, lane),
                                                      .onset_time = step->onset_time[at], .break_time = step->break_time[at]};
    }
    return FRACAS_OK;
}

/* (membrane.19) */
static fracas_err membrane_harvest(const fracas_model *model, fracas_step *step, int lane, fracas_record *record)
{
    const size_t count = partition(model, step, lane);
    const double surface_density = model->spec.material.density * model->spec.geometry.thickness;
    fracas_fragment_sums *sums = calloc(count, sizeof *sums);
    if (!sums) return fracas_no_memory("the fragments of a realization");
    for (size_t e = 0; e < model->elements; e++) add_element(model, step, lane, e, &sums[step->partition.label[e]]);
    for (size_t f = 0; f < count; f++) sums[f].size = sqrt(sums[f].mass / surface_density);
    fracas_err err = fracas_fragments_take(sums, count, 2, record);
    free(sums);
    TRY(err);
    return step->onset_time ? harvest_interfaces(model, step, lane, record) : FRACAS_OK;
}

static const fracas_kind *const goes_with[] = {
    &fracas_shape_plate, &fracas_shape_annulus, &fracas_shape_file, &fracas_spacing_triangles, &fracas_spacing_given,
    &fracas_law_nitsche, &fracas_law_camacho_ortiz_standard, &fracas_law_camacho_ortiz, &fracas_loading_expansion,
    &fracas_loading_centrifugal};
const fracas_formulation fracas_formulation_membrane = {
    .kind = {.name = "membrane", .doc = "a plate in plane stress, of triangles in its plane", .goes_with = goes_with,
             .ngoes_with = FRACAS_COUNT(goes_with)},
    .model_init = membrane_model_init, .check_strength = membrane_check_strength, .interface_volume = membrane_interface_volume,
    .plan_destroy = fracas_membrane_tables_destroy, .state_size = membrane_state_size, .strength = membrane_strength,
    .lane_init = membrane_lane_init, .advance = membrane_advance, .fragment_count = membrane_fragment_count,
    .harvest = membrane_harvest,
};
