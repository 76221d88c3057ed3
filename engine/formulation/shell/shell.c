/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell: linear Kirchhoff-Love kinematics on a surface of quadratic triangles that share no
 * nodes (docs/theory/shell.md). */
#include "engine/formulation/shell/shell.h"

#include "engine/cohesive/law.h"
#include "engine/formulation/surface/common.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <math.h>
#include <stdlib.h>

static const fracas_shell_tables *tables_of(const fracas_model *model)
{
    return model->plan;
}

/* k_n = K max(1, 1/beta_c^2), k_t = beta_c^2 k_n: neither is softer than K  (membrane.6) */
fracas_shell_constants fracas_shell_constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, h = spec->geometry.thickness,
                 c11 = h * spec->material.young / (1 - nu * nu);
    const double c33 = h * spec->material.young / (2 * (1 + nu)), bending = h * h / 12,
                 beta_c = spec->cohesive.coupling;
    fracas_shell_constants c = {.tables = tables_of(model),
                                .thickness = h,
                                .c11 = c11,
                                .c12 = nu * c11,
                                .c33 = c33,
                                .d11 = bending * c11,
                                .d12 = bending * nu * c11,
                                .d33 = bending * c33,
                                .normal = beta_c < 1 ? 1 / (beta_c * beta_c) : 1,
                                .energy = spec->cohesive.fracture_energy,
                                .opening = spec->cohesive.critical_opening,
                                .beta_c = beta_c,
                                .mu_c = spec->cohesive.friction,
                                .onset_mean = spec->cohesive.onset != &fracas_onset_flux,
                                .friction = spec->cohesive.friction > 0,
                                .motion = fracas_surface_motion_of(&spec->time)};
    c.tangential = beta_c * beta_c * c.normal;
    c.fields = c.motion.alpha ? SURFACE_FIELDS_ALPHA : SURFACE_FIELDS;
    c.strengths = (int)model->strengths;
    c.point_fields = fracas_law_of(spec)->fields[c.friction];
    return c;
}

/* ---- the model ---- */

static fracas_err check_order(const fracas_surface *surface)
{
    if (surface->order == 2) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "a shell's elements bend, which linear triangles cannot: make the mesh of quadratic ones");
}

/* As thick as its radius of curvature, at the edges of elements, it is no shell. */
static fracas_err check_thickness(const fracas_model *model)
{
    const fracas_shell_tables *t = tables_of(model);
    const double h = model->spec.geometry.thickness;
    double most = 0;
    for (size_t i = 0; i < t->ninterfaces; i++)
        for (int g = 0; g < SHELL_EDGE; g++) {
            const double *place = t->joint + i * SHELL_JOINT_TABLE + SHELL_POINTS +
                                  g * SHELL_POINT_TABLE;
            most = fmax(most, fmax(fabs(place[SHELL_L_NN]), fabs(place[SHELL_L_SS])));
        }
    if (most * h < 1) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "geometry.thickness is %g m, and the mid-surface has a radius of curvature of %g m: a "
        "shell is thin, a tenth of its radius and less: lower the thickness",
        h, 1 / most);
}

/* Some edge moves with the loading. */
static bool holds_moving(const fracas_shell_tables *t)
{
    for (size_t e = 0; e < t->nelements; e++)
        if (t->held[e] & ~t->fixed[e]) return true;
    return false;
}

static fracas_err shell_model_init(fracas_model *model)
{
    fracas_shell_tables *tables;
    TRY(fracas_surface_check_noise(&model->spec.mesh));
    TRY(fracas_mesh_make(&model->spec, &model->surface));
    TRY(check_order(model->surface));
    TRY(fracas_surface_check_beta(model));
    model->elements = model->surface->nelements;
    model->interfaces = model->surface->ninterfaces;
    if (model->spec.strength_per_point) model->strengths = SHELL_EDGE;
    TRY(fracas_shell_tables_create(model, &tables));
    model->plan = tables;
    TRY(check_thickness(model));
    TRY(fracas_surface_check_motion(model, holds_moving(tables)));
    for (size_t k = 0; k < SHELL_NODES * tables->nelements; k++)
        model->mass +=
            tables->mass[k / SHELL_NODES * 2 * SHELL_NODES + SHELL_NODES + k % SHELL_NODES];
    fracas_surface_measure_model(model);
    return fracas_shell_critical_step(model);
}

/* ---- state ---- */

static size_t shell_state_size(const fracas_model *model)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    return fracas_shell_state_fields(&c);
}

/* Field `field` of a lane, counted from the start of its group's state. */
static double *value_at(const fracas_shell_constants *c, const fracas_step *step, size_t field,
                        int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    return step->state + (group * fracas_shell_state_fields(c) + field) * lanes +
           (size_t)lane % lanes;
}

static double *element_value(const fracas_shell_constants *c, const fracas_step *step,
                             size_t element, int field, int i, int lane)
{
    return value_at(c, step,
                    element * fracas_shell_element_fields(c) + (size_t)(field * SHELL_UNKNOWNS + i),
                    lane);
}

static double *point_value(const fracas_shell_constants *c, const fracas_step *step,
                           size_t interface, int g, int k, int field, int lane)
{
    const size_t at = fracas_shell_joints_at(c) + interface * fracas_shell_joint_fields(c);
    return value_at(c, step, at + (size_t)((g * SHELL_LAYERS + k) * c->point_fields + field), lane);
}

double *fracas_shell_value(const fracas_model *model, const fracas_step *step, size_t element,
                           int field, int i, int lane)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    return element_value(&c, step, element, field, i, lane);
}

double *fracas_shell_point(const fracas_model *model, const fracas_step *step, size_t interface,
                           int g, int k, int field, int lane)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    return point_value(&c, step, interface, g, k, field, lane);
}

static double *shell_strength(const fracas_model *model, const fracas_step *step, int lane,
                              size_t *stride)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    *stride = (size_t)step->lanes;
    return value_at(&c, step, fracas_shell_strengths_at(&c), lane);
}

static void shell_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    const fracas_surface *surface = model->surface;
    const size_t fields = fracas_shell_element_fields(&c), joint = fracas_shell_joint_fields(&c),
                 joints = fracas_shell_joints_at(&c);
    for (size_t e = 0; e < model->elements; e++) {
        for (size_t f = 0; f < fields; f++) *value_at(&c, step, e * fields + f, lane) = 0;
        for (int i = 0; i < SHELL_UNKNOWNS; i++) {
            const double *x = surface->node[surface->element[e * SHELL_NODES + (size_t)i / 3]];
            *element_value(&c, step, e, SURFACE_V, i, lane) = fracas_surface_start_velocity(
                &model->spec.loading, x, i % 3, c.tables->held[e] >> i & 1,
                c.tables->fixed[e] >> i & 1);
        }
    }
    for (size_t i = 0; i < model->interfaces; i++)
        for (size_t f = 0; f < joint; f++) *value_at(&c, step, joints + i * joint + f, lane) = 0;
}

FRACAS_KERNEL_TABLE(const fracas_shell_kernel, fracas_shell);

static void shell_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    fracas_shell_sweep *sweep =
        fracas_shell[step->isa][step->lanes]->sweep[fracas_law_of(&model->spec)->number];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&c, step, first);
}

/* ---- what is left of a lane ---- */

static double shell_damage(const fracas_model *model, const fracas_step *step, size_t i, int lane)
{
    static const double along[SHELL_EDGE] = FRACAS_EDGE_WEIGHTS_2,
                        across[SHELL_LAYERS] = SHELL_LAYER_WEIGHTS;
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    double damage = 0;
    bool broken = true;
    for (int g = 0; g < SHELL_EDGE; g++)
        for (int k = 0; k < SHELL_LAYERS; k++) {
            const double at = *point_value(&c, step, i, g, k, SURFACE_DAMAGE, lane);
            damage += along[g] * across[k] * at;
            broken = broken && at >= 1.0;
        }
    return broken ? 1.0 : fmin(damage, 1.0 - 0x1p-53);
}

static int64_t shell_fragment_count(const fracas_model *model, fracas_step *step, int lane)
{
    return fracas_surface_fragment_count(model, step, lane, shell_damage);
}

static void add_element(const fracas_model *model, const fracas_step *step, int lane, size_t e,
                        fracas_fragment_sums *f)
{
    const fracas_shell_constants c = fracas_shell_constants_of(model);
    for (int k = 0; k < SHELL_NODES; k++) {
        const double *start =
            model->surface->node[model->surface->element[e * SHELL_NODES + (size_t)k]];
        double x[3], v[3];
        for (int i = 0; i < 3; i++) {
            x[i] = start[i] + *element_value(&c, step, e, SURFACE_U, 3 * k + i, lane);
            v[i] = *element_value(&c, step, e, SURFACE_V, 3 * k + i, lane);
        }
        fracas_fragment_sums_add(f, c.tables->mass[e * 2 * SHELL_NODES + SHELL_NODES + (size_t)k],
                                 x, v);
    }
}

static fracas_err shell_harvest(const fracas_model *model, fracas_step *step, int lane,
                                fracas_record *record)
{
    return fracas_surface_harvest(model, step, lane, shell_damage, add_element, record);
}

static const fracas_kind *const goes_with[] = {
    &fracas_shape_sphere,      &fracas_shape_plate,   &fracas_shape_annulus,    &fracas_shape_file,
    &fracas_spacing_triangles, &fracas_spacing_given, &fracas_loading_expansion};
const fracas_formulation fracas_formulation_shell = {
    .kind = {.name = "shell",
             .doc = "a thin shell or plate that stretches and bends, of triangles in space",
             .goes_with = goes_with,
             .ngoes_with = FRACAS_COUNT(goes_with)},
    .model_init = shell_model_init,
    .check_strength = fracas_surface_check_strength,
    .interface_volume = fracas_surface_interface_volume,
    .plan_destroy = fracas_shell_tables_destroy,
    .state_size = shell_state_size,
    .strength = shell_strength,
    .lane_init = shell_lane_init,
    .advance = shell_advance,
    .fragment_count = shell_fragment_count,
    .harvest = shell_harvest,
};
