/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The host's part of membranes and shells: model, state, fragments. */
#include "engine/formulation/surface/surface.h"

#include "engine/formulation/surface/loads.h"
#include "engine/integrator/hulbert_chung.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"
#include "engine/mesh/surface/survey.h"

#include <math.h>
#include <string.h>

static const fracas_surface_tables *tables_of(const fracas_model *model)
{
    return model->plan;
}

/* k_n = K max(1, 1/beta_c^2), k_t = beta_c^2 k_n: neither is softer than K  (membrane.6) */
fracas_surface_constants fracas_surface_constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const fracas_surface_tables *t = tables_of(model);
    const fracas_hulbert_chung alpha = fracas_hulbert_chung_of(spec->time.spectral_radius);
    const fracas_law *law = fracas_law_of(spec);
    const double beta_c = spec->cohesive.coupling, nu = spec->material.poisson,
                 h = spec->geometry.thickness, bending = h * h / 12,
                 young = (t->body->resultants ? h : 1) * spec->material.young;
    const bool friction = spec->cohesive.friction > 0,
               accelerations = fracas_integrator_of(spec)->accelerations,
               spins = fracas_loading_traits_of(spec)->body_force;
    fracas_surface_constants c = {
        .tables = t,
        .thickness = h,
        .c11 = young / (1 - nu * nu),
        .c33 = young / (2 * (1 + nu)),
        .normal = beta_c < 1 ? 1 / (beta_c * beta_c) : 1,
        .energy = spec->cohesive.fracture_energy,
        .opening = 2 * fracas_law_fullness(&spec->cohesive) * spec->cohesive.critical_opening,
        .own = model->own,
        .beta_c = beta_c,
        .mu_c = spec->cohesive.friction,
        .onset_mean = fracas_onset_by_mean(&spec->cohesive),
        .friction = friction,
        .law = law->number,
        .fields = accelerations ? SURFACE_FIELDS_ALPHA : SURFACE_FIELDS,
        .point_fields = law->fields[friction],
        .strengths = (int)model->strengths,
        .speed = spins ? spec->loading.speed : 0,
        .ramp = spec->loading.ramp,
        .strained = fracas_initial_is_strained(spec),
        .motion = {accelerations, alpha.alpha_m, alpha.beta, alpha.gamma, alpha.excess,
                   alpha.damping, sqrt(0.5 * (1 - alpha.alpha_m))}};
    for (int n = 0; n < t->forces; n++) c.force[n] = fracas_loading_at(spec, t->force[n]);
    for (int m = 0; m < t->motions; m++) c.moving[m] = fracas_loading_at(spec, t->motion[m]);
    c.c12 = nu * c.c11;
    c.d11 = bending * c.c11;
    c.d12 = bending * nu * c.c11;
    c.d33 = bending * c.c33;
    c.tangential = beta_c * beta_c * c.normal;
    return c;
}

/* The first loading's stretch at the start. */
static fracas_stretch stretch_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    return fracas_loading_traits_of(spec)->surface(spec, &spec->loading, 0);
}

/* ---- the model ---- */

static fracas_err check_noise(const fracas_spec *spec)
{
    const fracas_mesh *mesh = &spec->mesh;
    if (mesh->noise || !fracas_spacing_of(spec)->rows || mesh->amplitude == 0) return FRACAS_OK;
    return fracas_fail(FRACAS_BUG, "a perturbed mesh without random numbers");
}

/* The operator is positive from 1.15 (linear) and 2.25 (quadratic) on, measured on meshes distorted
 * by up to 30 %, nu up to 0.49: tests/verification/test_membrane_patch.c. Bending needs less. */
static fracas_err check_beta(const fracas_model *model)
{
    const double least = model->surface->order == 2 ? 2.3 : 1.3;
    if (model->spec.cohesive.beta >= least) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "cohesive.beta is %g, too soft for %s triangles: give %g or more; twice as much is usual",
        model->spec.cohesive.beta, model->surface->order == 2 ? "quadratic" : "linear", least);
}

/* Something moves: not all starts at rest, or an edge moves with the load. */
static fracas_err check_motion(const fracas_model *model)
{
    const bool idle = fracas_loading_is_idle(&model->spec);
    if ((!idle && (!stretch_of(model).shock || tables_of(model)->moves)) ||
        fracas_initial_moves(&model->spec.initial) || fracas_initial_is_strained(&model->spec))
        return FRACAS_OK;
    if (idle)
        return fracas_fail(FRACAS_USAGE,
                           "loading.type is %s, and initial gives no velocity and no strain: "
                           "nothing would ever move; give it one, or another load",
                           model->spec.loading.type->name);
    return fracas_fail(FRACAS_USAGE, "loading.start is rest, and no edge moves: nothing would ever "
                                     "move; let an edge be held, or start moving");
}

double fracas_surface_inverse_size(const fracas_surface *surface, size_t i)
{
    const fracas_surface_interface *interface = &surface->interface[i];
    const double length = fracas_surface_length(surface, interface->element[0], interface->edge[0]);
    double inverse_size = 0;
    for (int side = 0; side < 2; side++)
        inverse_size += 0.5 * length / surface->area[interface->element[side]];
    return inverse_size;
}

/* element_size and longest, once the mass is known. */
static void measure(fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    for (size_t i = 0; i < surface->ninterfaces; i++)
        model->longest = fmax(model->longest, 1.0 / fracas_surface_inverse_size(surface, i));
    model->element_size =
        surface->ninterfaces
            ? fracas_mesh_mean_length(surface)
            : sqrt(model->mass / (model->spec.material.density * model->spec.geometry.thickness));
}

/* Motion that can never become strain energy: the rigid motion of a free body; the imposed
 * expansion if every held edge follows it; none if an edge is fixed, or must not turn. */
static fracas_motion rigid_part(const fracas_model *model)
{
    const fracas_surface_tables *t = tables_of(model);
    if (t->moves && stretch_of(model).moving) return FRACAS_MOTION_HOMOGENEOUS;
    for (size_t e = 0; e < t->nelements; e++)
        if (t->held[e]) return FRACAS_MOTION_NONE;
    return t->nrims ? FRACAS_MOTION_NONE : FRACAS_MOTION_RIGID;
}

fracas_err fracas_surface_model_init(fracas_model *model)
{
    const fracas_surface_body *body = model->formulation->kind.traits;
    fracas_surface_tables *t;
    const fracas_law *law = fracas_law_of(&model->spec);
    if (law->fields[1] > SURFACE_POINT_FIELDS_MOST)
        return fracas_fail(FRACAS_BUG, "law %s has %d values a point, %d are allowed",
                           law->kind.name, law->fields[1], (int)SURFACE_POINT_FIELDS_MOST);
    TRY(check_noise(&model->spec));
    TRY(fracas_mesh_make(&model->spec, &model->surface));
    TRY(fracas_surface_check_whole(model->surface));
    TRY(body->check_mesh(model->surface));
    TRY(check_beta(model));
    model->elements = model->surface->nelements;
    model->interfaces = model->surface->ninterfaces;
    if (model->spec.strength_per_point)
        model->strengths = (size_t)SURFACE_EDGE(model->surface->order);
    TRY(fracas_surface_tables_create(model, &t));
    model->plan = t;
    model->bytes = fracas_surface_bytes(model->surface) + fracas_surface_tables_bytes(t);
    model->rigid_part = rigid_part(model);
    if (body->check_tables) TRY(body->check_tables(model));
    TRY(check_motion(model));
    const size_t nodes = (size_t)SURFACE_NODES(t->order);
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t k = 0; k < nodes; k++) model->mass += t->lumped[(2 * e + 1) * nodes + k];
    measure(model);
    TRY(fracas_surface_check_initial(model));
    model->wave_speed = sqrt(model->spec.material.young /
                             (model->spec.material.density *
                              (1 - model->spec.material.poisson * model->spec.material.poisson)));
    return fracas_surface_critical_step(model);
}

/* K >= 2 sigma_c/delta_c at the softest interface: twice the least stiffness of a linear law
 * (cohesive.7), so no peak as small as the strength is cut  (cohesive.13) */
fracas_err fracas_surface_check_strength(const fracas_model *model, double strength)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, modulus = spec->material.young / (1 - nu * nu);
    const fracas_law *law = fracas_law_of(spec);
    const double most = spec->cohesive.beta * modulus *
                        fracas_spec_fracture_energy(spec, strength) /
                        (strength * strength * fracas_law_steepest(&spec->cohesive));
    if (!law->flux || (isfinite(most) && model->longest <= most)) return FRACAS_OK;
    char unit[160] = "";
    if (fracas_shape_of(spec)->from_file && !spec->geometry.unit) {
        double side[3];
        fracas_surface_box(model->surface, side);
        const char *likely = fracas_surface_likely_unit(fmax(side[0], fmax(side[1], side[2])));
        snprintf(unit, sizeof unit,
                 "; the mesh file makes a body of %.3g by %.3g by %.3g m: if it is in %s, give "
                 "geometry.unit: %s",
                 side[0], side[1], side[2], likely, likely);
    }
    const double times = ceil(100 * model->longest / most) / 100;
    char remedy[120] =
        "are material.young, the strengths, the fracture energy and lengths in their units?";
    if (times < 100)
        snprintf(remedy, sizeof remedy, "refine the mesh %.3g times (or raise cohesive.beta)",
                 times);
    return fracas_fail(FRACAS_USAGE,
                       "strength %g Pa needs elements of which area/edge is below %.4g m, the "
                       "largest is %.4g m: %s%s",
                       strength, most, model->longest, remedy, unit);
}

/* A third of its two elements. */
double fracas_surface_interface_volume(const fracas_model *model, size_t i)
{
    const fracas_surface_interface *interface = &model->surface->interface[i];
    double area = 0;
    for (int side = 0; side < 2; side++) area += model->surface->area[interface->element[side]];
    return model->spec.geometry.thickness * (area / 3);
}

/* ---- state ---- */

size_t fracas_surface_state_size(const fracas_model *model)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    return fracas_surface_state_fields(&c);
}

size_t fracas_surface_parts_most(const fracas_model *model)
{
    return fracas_surface_blocks(fracas_surface_constants_of(model).tables);
}

fracas_err fracas_surface_model_divide(const fracas_model *model, size_t parts,
                                       fracas_division *out)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    fracas_surface_division *division;
    TRY(fracas_surface_division_create(&c, parts, out->reactions, &division));
    fracas_err err = out->reactions ? fracas_surface_holds_fill(model, division) : FRACAS_OK;
    if (err) {
        fracas_surface_division_destroy(division);
        return err;
    }
    out->parts = division->parts;
    out->fields = division->fields;
    out->plan = division;
    return FRACAS_OK;
}

double *fracas_surface_field(const fracas_step *step, size_t field, int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    return step->state + (group * step->division.fields + field) * lanes + (size_t)lane % lanes;
}

static double *element_value(const fracas_surface_constants *c, const fracas_step *step,
                             size_t element, int field, size_t i, int lane)
{
    return fracas_surface_field(step,
                                element * fracas_surface_element_fields(c) +
                                    (size_t)field * fracas_surface_unknowns(c->tables) + i,
                                lane);
}

static double *point_value(const fracas_surface_constants *c, const fracas_step *step,
                           size_t interface, int p, int field, int lane)
{
    const size_t at = fracas_surface_interfaces_at(c) +
                      interface * fracas_surface_interface_fields(c);
    return fracas_surface_field(step, at + (size_t)(p * c->point_fields + field), lane);
}

double *fracas_surface_strength(const fracas_model *model, const fracas_step *step, int lane,
                                size_t *stride)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    *stride = (size_t)step->lanes;
    return fracas_surface_field(step, fracas_surface_strengths_at(&c), lane);
}

/* Velocity of unknown i of element e at the start [m/s]: the expansion's, everywhere or where it
 * is held; 0 where it is fixed  (membrane.17) */
static double start_velocity(const fracas_model *model, size_t e, size_t i)
{
    const fracas_surface_tables *t = tables_of(model);
    const fracas_stretch stretch = stretch_of(model);
    const size_t dimension = (size_t)t->body->dimension, component = i % dimension;
    const bool held = t->held[e] >> i & 1, fixed = t->fixed[e] >> i & 1;
    const double *x = fracas_surface_node(model->surface, e, i / dimension);
    if ((held && fixed) || !stretch.moving || (stretch.shock && !held)) return 0;
    const double along[3] = {1, stretch.ratio, isnan(stretch.ratio_z) ? 1 : stretch.ratio_z};
    return along[component] * model->spec.loading.rate * x[component];
}

/* Pressed faces push by k q. Laws divide by k: it is no 0, but too small for any sum to notice. */
void fracas_surface_part_notch(fracas_model *model)
{
    fracas_surface_tables *t = model->plan;
    const size_t size = t->body->head + (size_t)SURFACE_EDGE(t->order) * t->body->point_table;
    for (size_t n = 0; n < model->nnotch; n++) {
        double *head = t->interface + model->notch[n] * size;
        head[SURFACE_STIFFNESS] *= 0x1p-400;
        head[SURFACE_COMPLIANCE] = 1 / head[SURFACE_STIFFNESS];
    }
}

/* Broken by tension before the start, with so small a peak that k delta_c is more for any k. */
static void begin_broken(const fracas_model *model, const fracas_surface_constants *c,
                         const fracas_step *step, size_t interface, int lane)
{
    const double peak = 0x1p-450; /* Pa */
    const int layers = c->tables->body->layers, tension = fracas_law_of(&model->spec)->tension;
    for (int p = 0; p < (int)fracas_surface_points(c->tables); p++) {
        *point_value(c, step, interface, p, SURFACE_DAMAGE, lane) = 1;
        *point_value(c, step, interface, p, SURFACE_PEAK, lane) = peak;
        if (tension && p % layers == 0)
            *point_value(c, step, interface, p, tension, lane) = peak * c->thickness;
    }
}

void fracas_surface_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const size_t strengths = fracas_surface_strengths_at(&c);
    for (size_t f = 0; f < strengths; f++) *fracas_surface_field(step, f, lane) = 0;
    for (size_t e = 0; e < model->elements; e++)
        for (size_t i = 0; i < fracas_surface_unknowns(c.tables); i++) {
            *element_value(&c, step, e, SURFACE_V, i, lane) =
                start_velocity(model, e, i) + fracas_surface_initial_velocity(model, e, i);
            if (c.strained)
                *element_value(&c, step, e, SURFACE_U, i,
                               lane) = fracas_surface_initial_displacement(model, e, i);
        }
    for (size_t n = 0; n < model->nnotch; n++) begin_broken(model, &c, step, model->notch[n], lane);
}

/* ---- a step ---- */

typedef struct {
    fracas_surface_constants constants;
    fracas_surface_sweep *sweep;
    fracas_step *step;
} surface_task;

/* Brings a part's copies up to date. */
static void copy_ghosts(const fracas_step *step, const fracas_surface_part *part)
{
    const size_t lanes = (size_t)step->lanes;
    for (int first = 0; first < step->width; first += step->lanes)
        for (size_t i = 0; i < part->copies; i++)
            memcpy(fracas_surface_field(step, part->copy[i].to, first),
                   fracas_surface_field(step, part->copy[i].from, first),
                   part->copy[i].count * lanes * sizeof(double));
}

/* A part's step. None begins before all have their copies. */
static void advance_part(void *context, size_t number)
{
    const surface_task *task = context;
    fracas_step *step = task->step;
    const fracas_surface_division *division = step->division.plan;
    copy_ghosts(step, &division->part[number]);
    fracas_team_meet(step->team);
    for (int first = 0; first < step->width; first += step->lanes)
        task->sweep(&task->constants, step, first, number);
}

/* The amplitude of load n without a front. */
static double amplitude_at(const fracas_surface_constants *c, int n, double time)
{
    static const double anywhere[3] = {0};
    const fracas_load_clock clock = fracas_load_clock_at(c->force[n], anywhere);
    return fracas_load_amplitude(c->force[n], &c->tables->history[c->tables->force[n]], &clock,
                                 time);
}

void fracas_surface_advance(const fracas_model *model, fracas_step *step)
{
    surface_task task = {.constants = fracas_surface_constants_of(model), .step = step};
    const fracas_surface_constants *c = &task.constants;
    const fracas_surface_kernel *kernel = (*c->tables->body->kernels)[step->isa][step->lanes];
    task.sweep = kernel->sweep[fracas_law_of(&model->spec)->number][c->tables->order - 1];
    for (int l = 0; l < step->width; l++) {
        step->spin[l] = fracas_surface_spin(c, step->time[l]);
        for (int n = 0; n < c->tables->forces; n++) {
            step->amplitude[n][l] = amplitude_at(c, n, step->time[l]);
            step->amplitude_before[n][l] = amplitude_at(c, n, step->time[l] - step->drift[l]);
        }
        for (int m = 0; m < c->tables->motions; m++) {
            step->path[m][l] = fracas_surface_path(c, m, step->time[l]);
            step->path_next[m][l] = fracas_surface_path(c, m, step->time[l] + step->kick[l]);
        }
    }
    fracas_team_run(step->team, advance_part, &task);
    fracas_surface_totals(c, step);
}

/* ---- fragments ---- */

bool fracas_surface_is_broken(const fracas_surface_constants *c, const fracas_step *step, size_t i,
                              int lane)
{
    for (size_t p = 0; p < fracas_surface_points(c->tables); p++)
        if (!(*point_value(c, step, i, (int)p, SURFACE_DAMAGE, lane) >= 1.0)) return false;
    return true;
}

/* D of an interface: the mean over its points by their weights, 1 only where all are broken
 * (membrane.18) */
static double damage_of(const fracas_surface_constants *c, const fracas_step *step, size_t i,
                        int lane)
{
    static const double weight[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const fracas_surface_body *body = c->tables->body;
    const int order = c->tables->order;
    double damage = 0;
    for (int g = 0; g < SURFACE_EDGE(order); g++)
        for (int k = 0; k < body->layers; k++) {
            const double at = *point_value(c, step, i, g * body->layers + k, SURFACE_DAMAGE, lane);
            damage += weight[order - 1][g] * body->layer[k] * at;
        }
    return fracas_surface_is_broken(c, step, i, lane) ? 1.0 : fmin(damage, 1.0 - 0x1p-53);
}

size_t fracas_surface_partition(const fracas_model *model, fracas_step *step, int lane)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    fracas_partition_reset(&step->partition);
    for (size_t i = 0; i < model->interfaces; i++) {
        const uint32_t *element = model->surface->interface[i].element;
        if (!fracas_surface_is_broken(&c, step, i, lane))
            fracas_partition_unite(&step->partition, element[0], element[1]);
    }
    return fracas_partition_label(&step->partition);
}

/* True if the load moves an edge of the element along; a sliding edge in a plane of symmetry stays.
 */
static bool is_pulled(const fracas_model *model, size_t e)
{
    const fracas_surface_tables *t = tables_of(model);
    if (t->moved && t->moved[e]) return true;
    const uint32_t moving = t->held[e] & ~t->fixed[e];
    for (size_t i = 0; moving >> i; i++)
        if (moving >> i & 1 && start_velocity(model, e, i) != 0) return true;
    return false;
}

/* Fragments with such an element, and the area of the others [m2]. */
static fracas_err count_held(const fracas_model *model, const fracas_step *step,
                             fracas_census *census, double *area)
{
    OWNED bool *held = calloc((size_t)census->all, sizeof *held);
    if (!held) return fracas_no_memory("the fragments of a realization");
    for (size_t e = 0; e < model->elements; e++) {
        const size_t f = step->partition.label[e];
        if (held[f] || !is_pulled(model, e)) continue;
        held[f] = true;
        census->held++;
    }
    *area = 0;
    for (size_t e = 0; e < model->elements; e++)
        *area += held[step->partition.label[e]] ? 0 : model->surface->area[e];
    return FRACAS_OK;
}

fracas_err fracas_surface_count(const fracas_model *model, fracas_step *step, int lane,
                                fracas_census *census)
{
    const double surface_density = model->spec.material.density * model->spec.geometry.thickness;
    double area = model->mass / surface_density;
    *census = (fracas_census){.all = 1};
    const bool parted = step->broken[lane] > 0 || model->nnotch > 0;
    if (parted) census->all = (int64_t)fracas_surface_partition(model, step, lane);
    if (tables_of(model)->moves && (step->broken[lane] > 0 || census->all > 1))
        TRY(count_held(model, step, census, &area));
    census->size = sqrt(area / (double)(census->all - census->held));
    return FRACAS_OK;
}

/* The least of an interface's strengths. */
static double weakest_of(const double *strength, size_t stride, size_t strengths)
{
    double least = strength[0];
    for (size_t g = 1; g < strengths; g++) least = fmin(least, strength[g * stride]);
    return least;
}

fracas_interface_row fracas_surface_interface_row(const fracas_model *model,
                                                  const fracas_surface_constants *c,
                                                  const fracas_step *step, size_t i, int lane)
{
    const double *strength = fracas_surface_field(
        step, fracas_surface_strengths_at(c) + fracas_surface_strength_of(c, i, 0), lane);
    const size_t at = i * (size_t)step->width + (size_t)lane;
    return (fracas_interface_row){
        .strength = weakest_of(strength, (size_t)step->lanes, model->strengths),
        .damage = damage_of(c, step, i, lane),
        .onset_time = step->onset_time ? step->onset_time[at] : NAN,
        .break_time = step->onset_time ? step->break_time[at] : NAN};
}

static fracas_err harvest_interfaces(const fracas_model *model, const fracas_step *step, int lane,
                                     fracas_record *record)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    record->interface = calloc(model->interfaces ? model->interfaces : 1,
                               sizeof *record->interface);
    if (!record->interface) return fracas_no_memory("the interfaces of a realization");
    record->ninterface = model->interfaces;
    for (size_t i = 0; i < model->interfaces; i++)
        record->interface[i] = fracas_surface_interface_row(model, &c, step, i, lane);
    return FRACAS_OK;
}

static void add_element(const fracas_model *model, const fracas_surface_constants *c,
                        const fracas_step *step, int lane, size_t e,
                        const fracas_fragment_motion *motion, fracas_fragment_sums *sums)
{
    const size_t nodes = model->surface->corners, dimension = (size_t)c->tables->body->dimension;
    double x[6][3] = {{0}}, v[6][3] = {{0}}, u[SURFACE_UNKNOWNS_MOST];
    for (size_t k = 0; k < nodes; k++) {
        for (size_t i = 0; i < dimension; i++) {
            const size_t unknown = dimension * k + i;
            u[unknown] = *element_value(c, step, e, SURFACE_U, unknown, lane);
            x[k][i] = fracas_surface_node(model->surface, e, k)[i] + u[unknown];
            v[k][i] = *element_value(c, step, e, SURFACE_V, unknown, lane);
        }
        if (motion) fracas_fragment_motion_take_off(motion, x[k], v[k]);
    }
    sums->elements++;
    sums->strain_energy +=
        (*c->tables->body->kernels)[FRACAS_ISA_BASELINE][1]->strain[c->tables->order - 1](c, e, u,
                                                                                          NULL);
    for (size_t k = 0; k < nodes; k++)
        c->tables->body->add_node(c->tables, e, k, (const double(*)[3])x, (const double(*)[3])v,
                                  sums);
}

void fracas_surface_add_up(const fracas_model *model, const fracas_step *step, int lane,
                           const fracas_fragment_motion *motion, fracas_fragment_sums *sums)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    for (size_t e = 0; e < model->elements; e++) {
        const size_t f = step->partition.label[e];
        add_element(model, &c, step, lane, e, motion ? &motion[f] : NULL, &sums[f]);
    }
}

/* (membrane.19) */
fracas_err fracas_surface_harvest(const fracas_model *model, fracas_step *step, int lane,
                                  fracas_record *record)
{
    const size_t count = fracas_surface_partition(model, step, lane);
    const double surface_density = model->spec.material.density * model->spec.geometry.thickness;
    OWNED fracas_fragment_sums *sums = calloc(count, sizeof *sums);
    if (!sums) return fracas_no_memory("the fragments of a realization");
    fracas_surface_add_up(model, step, lane, NULL, sums);
    for (size_t f = 0; f < count; f++) sums[f].size = sqrt(sums[f].mass / surface_density);
    TRY(fracas_fragments_take(sums, count, 2, record));
    return step->onset_time ? harvest_interfaces(model, step, lane, record) : FRACAS_OK;
}
