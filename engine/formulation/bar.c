/* The bar: one coordinate, background motion rate t x taken out (docs/theory/bar.md). */
#include "engine/formulation/bar_sweep.h"

#include "base/elementary.h"
#include "engine/cohesive/law.h"
#include "engine/fragments/fragments.h"
#include "engine/integrator/critical_step.h"
#include "engine/loading/loading.h"
#include "engine/material/elastic.h"
#include "engine/mesh/body.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static bool is_periodic(const fracas_model *model)
{
    return model->spec.geometry.ends == &fracas_ends_periodic;
}

static bool is_nitsche(const fracas_model *model)
{
    return model->spec.cohesive.law == &fracas_law_nitsche;
}

/* Nodal mass as (bar.5). */
static fracas_bar_constants constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double young = spec->material.young, energy = spec->cohesive.fracture_energy;
    return (fracas_bar_constants){
        .elements = model->elements, .periodic = is_periodic(model), .young = young,
        .spring = spec->cohesive.beta * young / model->element_size,
        .contact_offset = 4.5 * fracas_pow(spec->loading.rate, 2.0 / 3.0) * young * fracas_pow(energy, 2.0 / 3.0) *
                          fracas_pow(spec->material.density, 1.0 / 3.0),
        .size = model->element_size, .nodal_mass = 0.5 * spec->material.density * model->element_size,
        .fracture_energy = energy, .rate = spec->loading.rate, .area = spec->geometry.area};
}

/* ---- critical time step ---- */

typedef struct {
    const fracas_model *model;
    fracas_bar_constants bar;
    bool closed; /* all interfaces uncracked; else all broken and in contact */
} bar_operator;

/* Twice the force that interface stress `traction` and flux slip `slip` leave on the nodes right and left of it. */
static void apply_interface(const bar_operator *o, const double *left, const double *right, double *force_left,
                            double *force_right, double *slip)
{
    const double modulus = o->bar.young / o->bar.size;
    double q = right[0] - left[1];
    double mean = 0.5 * modulus * (left[1] - left[0] + right[1] - right[0]);
    bool flux = o->closed && is_nitsche(o->model);
    double traction = o->closed ? mean + (flux ? o->bar.spring * q : 0.0) : o->model->contact * q;
    *slip = flux ? q : 0.0;
    *force_left = -traction;
    *force_right = traction;
}

/* result = M^-1 K w, w = (left, right) node of each element: equations (bar.6) and (bar.7), linear. */
static void apply_bar(const void *context, const double *w, double *result)
{
    const bar_operator *o = context;
    const size_t n = o->bar.elements;
    const double modulus = o->bar.young / o->bar.size;
    for (size_t i = 0; i < 2 * n; i++) result[i] = 0;
    for (size_t e = 0; e < n; e++) {
        double stress = modulus * (w[2 * e + 1] - w[2 * e]);
        result[2 * e] -= stress;
        result[2 * e + 1] += stress;
    }
    for (size_t e = 0; e < (o->bar.periodic ? n : n - 1); e++) {
        size_t r = e + 1 < n ? e + 1 : 0;
        double slip, on_left, on_right;
        apply_interface(o, w + 2 * e, w + 2 * r, &on_left, &on_right, &slip);
        double symmetrising = 0.5 * modulus * slip;
        result[2 * e] -= symmetrising;
        result[2 * e + 1] += symmetrising + on_left;
        result[2 * r] += on_right - symmetrising;
        result[2 * r + 1] += symmetrising;
    }
    if (!o->bar.periodic) result[0] = result[2 * n - 1] = 0;
    for (size_t i = 0; i < 2 * n; i++) result[i] /= o->bar.nodal_mass;
}

/* A regular bar's largest frequency is that of a short one: 1024 elements at most are looked at. */
static fracas_err top_frequency_squared(const fracas_model *model, bool closed, double *omega_squared)
{
    const size_t n = model->elements < 1024 ? model->elements : 1024;
    bar_operator o = {model, constants_of(model), closed};
    o.bar.elements = n;
    double *start = malloc(2 * n * sizeof *start);
    if (!start) return fracas_no_memory("the critical time step");
    /* The extreme modes of a regular bar: nodes of an element, or whole elements, in turn up and down; a little of
     * everything else for other cases. Tied nodes of a rigid link need equal values. */
    uint64_t noise = 1;
    bool tied = closed && !is_nitsche(model);
    for (size_t e = 0; e < n; e++) {
        double sign = e % 2 ? -1.0 : 1.0;
        noise = noise * 6364136223846793005u + 1442695040888963407u;
        double small = 1e-3 * ((double)(noise >> 40) / 16777216.0 - 0.5);
        start[2 * e] = tied ? sign + small : 1.0 + 0.5 * sign + small;
        start[2 * e + 1] = tied ? 0.0 : -1.0 + 0.25 * sign - small;
    }
    for (size_t e = 0; tied && e < n; e++) start[2 * e + 1] = start[2 * ((e + 1) % n)];
    if (!o.bar.periodic) start[0] = start[2 * n - 1] = 0;
    fracas_err code = fracas_power_iteration(apply_bar, &o, 2 * n, start, omega_squared);
    free(start);
    return code;
}

static fracas_err bar_model_init(fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    if (spec->mesh.elements < 2 || spec->mesh.elements > 100000000)
        return fracas_fail(FRACAS_USAGE, "mesh.elements is %" PRId64 "; a bar takes 2 to 1e8 elements", spec->mesh.elements);
    model->elements = (size_t)spec->mesh.elements;
    model->interfaces = is_periodic(model) ? model->elements : model->elements - 1;
    model->element_size = spec->geometry.length / (double)model->elements;
    model->mass = spec->material.density * spec->geometry.area * spec->geometry.length;
    fracas_bar_constants bar = constants_of(model);
    /* Critical step (bar.16). The penalty of rigid-link depends on each strength; check_strength keeps it below the elements' stiffness. */
    model->contact = is_nitsche(model) ? bar.spring : bar.young / bar.size;
    double closed, cracked;
    TRY(top_frequency_squared(model, true, &closed));
    TRY(top_frequency_squared(model, false, &cracked));
    model->critical_closed = FRACAS_CENTRAL_DIFFERENCE_LIMIT / sqrt(closed);
    model->critical_cracked = FRACAS_CENTRAL_DIFFERENCE_LIMIT / sqrt(cracked);
    model->critical_step = fmin(model->critical_closed, model->critical_cracked);
    return FRACAS_OK;
}

/* ---- strength ---- */

static fracas_err bar_check_strength(const fracas_model *model, double strength)
{
    const fracas_bar_constants bar = constants_of(model);
    if (!(strength > 0) || !isfinite(strength))
        return fracas_fail(FRACAS_USAGE, "strength of %g Pa; it must be positive and finite: check the section strength", strength);
    if (is_nitsche(model)) {
        /* K > sigma_c/delta_c = sigma_c^2/(2 G_c), or the interface could not soften as slowly as the law asks  (cohesive.7). */
        double margin = 2 * bar.spring * bar.fracture_energy / strength - strength; /* K delta_c - sigma_c */
        double longest = 2 * model->spec.cohesive.beta * bar.young * bar.fracture_energy / (strength * strength);
        if (!(margin > 0) || !isfinite(margin))
            return fracas_fail(FRACAS_USAGE, "strength %g Pa needs elements shorter than %.4g m, they are %.4g m: "
                               "raise mesh.elements above %.0f (or cohesive.beta)", strength, longest, bar.size,
                               ceil(model->spec.geometry.length / longest));
        return FRACAS_OK;
    }
    double penalty = (strength * strength + bar.contact_offset) / (4.5 * bar.fracture_energy);
    if (penalty > model->contact)
        return fracas_fail(FRACAS_USAGE, "contact penalty %.4g Pa/m of strength %g Pa exceeds the elements' stiffness "
                           "%.4g Pa/m: raise mesh.elements above %.0f", penalty, strength, model->contact,
                           ceil(model->spec.geometry.length * penalty / bar.young));
    return FRACAS_OK;
}

/* ---- state ---- */

static size_t bar_state_size(const fracas_model *model)
{
    return model->elements * BAR_FIELDS;
}

static double *field_of(const fracas_model *model, const fracas_step *step, size_t element, int field, int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes;
    return step->state + group * lanes * bar_state_size(model) + (element * BAR_FIELDS + (size_t)field) * lanes +
           (size_t)lane % lanes;
}

static double *bar_strength(const fracas_model *model, const fracas_step *step, int lane, size_t *stride)
{
    *stride = (size_t)(BAR_FIELDS * step->lanes);
    return field_of(model, step, 0, BAR_STRENGTH, lane);
}

static void bar_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_bar_constants bar = constants_of(model);
    for (size_t e = 0; e < model->elements; e++) {
        for (int field = 0; field < BAR_FIELDS; field++)
            if (field != BAR_STRENGTH) *field_of(model, step, e, field, lane) = 0.0;
        double strength = *field_of(model, step, e, BAR_STRENGTH, lane);
        if (is_nitsche(model) && e < model->interfaces)
            *field_of(model, step, e, BAR_LAW, lane) = 2 * bar.spring * bar.fracture_energy / strength - strength;
    }
}

static void bar_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_bar_constants bar = constants_of(model);
    const fracas_bar_kernels *kernels = step->isa == FRACAS_ISA_AVX512 ? &fracas_bar_kernels_avx512
                                        : step->isa == FRACAS_ISA_AVX2 ? &fracas_bar_kernels_avx2
                                                                       : &fracas_bar_kernels_baseline;
    int which = step->lanes == 8 ? 2 : step->lanes == 4 ? 1 : 0;
    fracas_bar_sweep *sweep = (is_nitsche(model) ? kernels->nitsche : kernels->rigid_link)[which];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&bar, step, first);
}

static int64_t bar_fragment_count(const fracas_model *model, int64_t broken)
{
    /* A closed bar needs two breaks to have two fragments; a held one is cut in two by the first. */
    return is_periodic(model) ? (broken > 1 ? broken : 1) : broken + 1;
}

/* ---- what is left of a lane ---- */

typedef struct {
    const fracas_model *model;
    const fracas_step *step;
    int lane;
} lane_view;

static double lane_value(const lane_view *view, size_t element, int field)
{
    return *field_of(view->model, view->step, element, field, view->lane);
}

/* Adds up the elements of each fragment, moved as (bar.1). In a closed bar whose last interface holds, the elements after the
 * last break belong to the fragment of element 0: they are taken one circumference back, so that it is in one piece. */
static void add_elements(const lane_view *view, const uint32_t *label, fracas_fragment *fragment)
{
    const fracas_model *model = view->model;
    const fracas_spec *spec = &model->spec;
    const double h = model->element_size, mass = spec->material.density * spec->geometry.area * h;
    const double time = view->step->time[view->lane], rate = spec->loading.rate, length = spec->geometry.length;
    size_t back = model->elements; /* elements from here on are taken back */
    while (is_periodic(model) && back > 0 && !(lane_value(view, back - 1, BAR_DAMAGE) >= 1.0)) back--;
    for (size_t e = 0; e < model->elements; e++) {
        fracas_fragment *f = &fragment[label[e]];
        double x = h * ((double)e + 0.5) - (e >= back ? length : 0.0);
        double w = 0.5 * (lane_value(view, e, BAR_W_LEFT) + lane_value(view, e, BAR_W_RIGHT));
        double v = 0.5 * (lane_value(view, e, BAR_V_LEFT) + lane_value(view, e, BAR_V_RIGHT));
        f->elements++;
        f->mass += mass;
        f->size += h;
        f->position[0] += x * (1 + rate * time) + w;
        f->velocity[0] += rate * x + v;
    }
}

/* Fragments as (bar.17). */
static fracas_err harvest_fragments(const lane_view *view, fracas_record *record)
{
    const fracas_model *model = view->model;
    fracas_partition partition;
    TRY(fracas_partition_init(&partition, model->elements));
    for (size_t e = 0; e < model->interfaces; e++)
        if (!(lane_value(view, e, BAR_DAMAGE) >= 1.0))
            fracas_partition_join(&partition, (uint32_t)e, (uint32_t)(e + 1 < model->elements ? e + 1 : 0));
    size_t count = fracas_partition_label(&partition);
    fracas_fragment *fragment = calloc(count, sizeof *fragment);
    if (!fragment) {
        fracas_partition_clear(&partition);
        return fracas_no_memory("the fragments of a realization");
    }
    add_elements(view, partition.label, fragment);
    fracas_partition_clear(&partition);
    const double stretched = model->spec.geometry.length * (1 + model->spec.loading.rate * view->step->time[view->lane]);
    for (size_t f = 0; f < count; f++) {
        double n = (double)fragment[f].elements;
        fragment[f].position[0] /= n;
        fragment[f].velocity[0] /= n;
        fragment[f].dust = fragment[f].elements == 1;
        record->fragments_dust += fragment[f].dust;
        if (is_periodic(model) && fragment[f].position[0] < 0) {
            fragment[f].position[0] += stretched;
            fragment[f].velocity[0] += model->spec.loading.rate * model->spec.geometry.length;
        }
    }
    record->fragment = fragment;
    record->nfragment = count;
    record->fragments = (int64_t)count;
    return FRACAS_OK;
}

static fracas_err harvest_interfaces(const lane_view *view, fracas_record *record)
{
    const size_t n = view->model->interfaces;
    record->interface = calloc(n, sizeof *record->interface);
    if (!record->interface) return fracas_no_memory("the interfaces of a realization");
    record->ninterface = n;
    for (size_t e = 0; e < n; e++) {
        size_t at = e * (size_t)view->step->width + (size_t)view->lane;
        record->interface[e] = (fracas_interface_row){
            .strength = lane_value(view, e, BAR_STRENGTH), .damage = lane_value(view, e, BAR_DAMAGE),
            .onset_time = view->step->onset_time[at], .break_time = view->step->break_time[at]};
    }
    return FRACAS_OK;
}

static fracas_err bar_harvest(const fracas_model *model, const fracas_step *step, int lane, fracas_record *record)
{
    lane_view view = {model, step, lane};
    double momentum = 0, nodal = 0.5 * model->mass / (double)model->elements;
    for (size_t e = 0; e < model->elements; e++)
        momentum += lane_value(&view, e, BAR_V_LEFT) + lane_value(&view, e, BAR_V_RIGHT);
    record->momentum[0] = nodal * momentum;
    record->momentum[1] = record->momentum[2] = 0;
    TRY(harvest_fragments(&view, record));
    return step->onset_time ? harvest_interfaces(&view, record) : FRACAS_OK;
}

static const fracas_kind *const goes_with[] = {&fracas_shape_bar, &fracas_law_nitsche, &fracas_law_rigid_link,
                                               &fracas_loading_imposed_rate};
const fracas_formulation fracas_formulation_bar = {
    .kind = {.name = "bar", .doc = "a bar stretched at a uniform rate: the hoop direction of an expanding ring",
             .goes_with = goes_with, .ngoes_with = FRACAS_COUNT(goes_with)},
    .model_init = bar_model_init, .check_strength = bar_check_strength, .state_size = bar_state_size,
    .strength = bar_strength, .lane_init = bar_lane_init, .advance = bar_advance,
    .fragment_count = bar_fragment_count, .harvest = bar_harvest,
};
