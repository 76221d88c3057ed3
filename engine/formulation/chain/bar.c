/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bar: one coordinate, background motion rate t x taken out (docs/theory/bar.md). */
#include "engine/formulation/chain/bar_sweep.h"

#include "base/elementary.h"
#include "engine/cohesive/law.h"
#include "engine/formulation/chain/chain.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

FRACAS_KERNEL_TABLE(const fracas_bar_kernel, fracas_bar);

static const fracas_chain chain = {
    .fields = BAR_FIELDS, .damage = BAR_DAMAGE, .strength = BAR_STRENGTH};

static bool is_uniform(const fracas_model *model)
{
    return fracas_spacing_of(&model->spec)->uniform;
}

/* Nodal mass as (bar.5). */
static fracas_bar_constants constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double young = spec->material.young, energy = spec->cohesive.fracture_energy;
    return (fracas_bar_constants){.elements = model->elements,
                                  .periodic = fracas_chain_is_closed(model),
                                  .young = young,
                                  .spring = spec->cohesive.beta * young / model->element_size,
                                  .beta = spec->cohesive.beta,
                                  .contact_offset = 4.5 *
                                                    fracas_pow(spec->loading.rate, 2.0 / 3.0) *
                                                    young * fracas_pow(energy, 2.0 / 3.0) *
                                                    fracas_pow(spec->material.density, 1.0 / 3.0),
                                  .size = model->element_size,
                                  .nodal_mass = 0.5 * spec->material.density * model->element_size,
                                  .density = spec->material.density,
                                  .sizes = is_uniform(model) ? NULL : model->table,
                                  .fracture_energy = energy,
                                  .rate = spec->loading.rate,
                                  .area = spec->geometry.area};
}

/* ---- mesh ---- */

static double size_of(const fracas_model *model, size_t e)
{
    return is_uniform(model) ? model->element_size : model->table[e];
}

/* The interface on the right of element e. Its stiffness is K = beta E/h with 1/h the mean of its
 * two elements'  (bar.18). */
static double spring_of(const fracas_model *model, size_t e)
{
    const fracas_bar_constants bar = constants_of(model);
    if (is_uniform(model)) return bar.spring;
    const size_t next = e + 1 < model->elements ? e + 1 : 0;
    return bar.beta * (0.5 * (bar.young / size_of(model, e) + bar.young / size_of(model, next)));
}

static double bar_interface_volume(const fracas_model *model, size_t e)
{
    return model->spec.geometry.area *
           (0.5 * (size_of(model, e) + size_of(model, e + 1 < model->elements ? e + 1 : 0)));
}

static void bar_interface_positions(const fracas_model *model, double (*position)[3])
{
    double end = 0;
    for (size_t e = 0; e < model->interfaces; e++) {
        end += size_of(model, e);
        position[e][0] = is_uniform(model) ? model->element_size * (double)(e + 1) : end;
        position[e][1] = position[e][2] = 0;
    }
}

/* Lengths of elements that are not alike, in model->table  (bar.19). */
static fracas_err fill_sizes(fracas_model *model)
{
    const fracas_mesh *mesh = &model->spec.mesh;
    double *size = model->table = malloc(model->elements * sizeof *size);
    if (!size) return fracas_no_memory("the mesh of a bar");
    TRY(fracas_spacing_of(&model->spec)->fill(mesh, model->spec.geometry.length, size));
    for (size_t e = 0; e < model->elements; e++) model->longest = fmax(model->longest, size[e]);
    return FRACAS_OK;
}

static fracas_err bar_model_init(fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    if (spec->mesh.elements < 2 || spec->mesh.elements > 100000000)
        return fracas_fail(FRACAS_USAGE,
                           "mesh.elements is %" PRId64 "; a bar takes 2 to 1e8 elements",
                           spec->mesh.elements);
    model->elements = (size_t)spec->mesh.elements;
    model->interfaces = model->elements - (fracas_model_period(model) > 0 ? 0 : 1);
    model->element_size = spec->geometry.length / (double)model->elements;
    model->longest = model->element_size;
    model->mass = spec->material.density * spec->geometry.area * spec->geometry.length;
    if (!is_uniform(model)) TRY(fill_sizes(model));
    /* Where the stiffness of contact depends on the strength, check_strength keeps it below the
     * elements'. */
    return fracas_chain_critical_step(model, is_uniform(model) ? NULL : model->table);
}

/* ---- strength ---- */

static fracas_err bar_check_strength(const fracas_model *model, double strength)
{
    TRY(fracas_chain_check_strength(model, strength));
    if (!fracas_law_of(&model->spec)->contact_by_strength) return FRACAS_OK;
    const fracas_bar_constants bar = constants_of(model);
    const double h = model->longest;
    double penalty = (strength * strength + bar.contact_offset) / (4.5 * bar.fracture_energy);
    if (penalty > bar.young / h)
        return fracas_fail(
            FRACAS_USAGE,
            "contact penalty %.4g Pa/m of strength %g Pa exceeds the elements' stiffness %.4g "
            "Pa/m: raise mesh.elements above %.0f",
            penalty, strength, bar.young / h,
            ceil(h / model->element_size * model->spec.geometry.length * penalty / bar.young));
    return FRACAS_OK;
}

/* ---- state ---- */

static size_t bar_state_size(const fracas_model *model)
{
    return model->elements * BAR_FIELDS;
}

static double *field_of(const fracas_model *model, const fracas_step *step, size_t element,
                        int field, int lane)
{
    return fracas_chain_field(&chain, model, step, element, field, lane);
}

static double *bar_strength(const fracas_model *model, const fracas_step *step, int lane,
                            size_t *stride)
{
    return fracas_chain_strength(&chain, model, step, lane, stride);
}

static void bar_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const double energy = model->spec.cohesive.fracture_energy;
    const fracas_law *law = fracas_law_of(&model->spec);
    for (size_t e = 0; e < model->elements; e++) {
        for (int field = 0; field < BAR_FIELDS; field++)
            if (field != BAR_STRENGTH) *field_of(model, step, e, field, lane) = 0.0;
        double strength = *field_of(model, step, e, BAR_STRENGTH, lane);
        if (law->constant && e < model->interfaces)
            *field_of(model, step, e, BAR_LAW, lane) = law->constant(spring_of(model, e), energy,
                                                                     strength);
    }
}

static void bar_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_bar_constants bar = constants_of(model);
    fracas_bar_sweep *sweep = fracas_bar[step->isa][step->lanes]
                                  ->sweep[fracas_law_of(&model->spec)->number][is_uniform(model)];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&bar, step, first);
}

/* ---- what is left of a lane ---- */

typedef struct {
    const fracas_model *model;
    fracas_step *step;
    int lane;
} lane_view;

static double lane_value(const lane_view *view, size_t element, int field)
{
    return *field_of(view->model, view->step, element, field, view->lane);
}

/* Adds up the elements of each fragment, moved as (bar.1). In a closed bar whose last interface
 * holds, the elements after the last break belong to the fragment of element 0: they are taken one
 * circumference back, so that it is in one piece. */
static void add_elements(const lane_view *view, const uint32_t *label, fracas_fragment *fragment)
{
    const fracas_model *model = view->model;
    const fracas_spec *spec = &model->spec;
    const double mass_per_length = spec->material.density * spec->geometry.area;
    const double time = view->step->time[view->lane], rate = spec->loading.rate,
                 length = spec->geometry.length;
    size_t back = model->elements; /* elements from here on are taken back */
    while (fracas_chain_is_closed(model) && back > 0 &&
           !fracas_chain_is_broken(&chain, model, view->step, back - 1, view->lane))
        back--;
    double node = 0;
    for (size_t e = 0; e < model->elements; e++) {
        fracas_fragment *f = &fragment[label[e]];
        const double h = size_of(model, e), start = is_uniform(model) ? h * (double)e : node;
        double x = start + 0.5 * h - (e >= back ? length : 0.0);
        double w = 0.5 * (lane_value(view, e, BAR_W_LEFT) + lane_value(view, e, BAR_W_RIGHT));
        double v = 0.5 * (lane_value(view, e, BAR_V_LEFT) + lane_value(view, e, BAR_V_RIGHT));
        f->elements++;
        f->mass += mass_per_length * h;
        f->size += h;
        f->position[0] += h * (x * (1 + rate * time) + w);
        f->velocity[0] += h * (rate * x + v);
        node += h;
    }
}

/* Fragments as (bar.17). */
static fracas_err harvest_fragments(const lane_view *view, fracas_record *record)
{
    const fracas_model *model = view->model;
    const size_t count = fracas_chain_partition(&chain, model, view->step, view->lane);
    fracas_fragment *fragment = calloc(count, sizeof *fragment);
    if (!fragment) return fracas_no_memory("the fragments of a realization");
    add_elements(view, view->step->partition.label, fragment);
    const double stretched = model->spec.geometry.length *
                             (1 + model->spec.loading.rate * view->step->time[view->lane]);
    for (size_t f = 0; f < count; f++) {
        fragment[f].position[0] /= fragment[f].size;
        fragment[f].velocity[0] /= fragment[f].size;
        fragment[f].dust = fragment[f].elements == 1;
        record->fragments_dust += fragment[f].dust;
        if (fracas_chain_is_closed(model) && fragment[f].position[0] < 0) {
            fragment[f].position[0] += stretched;
            fragment[f].velocity[0] += model->spec.loading.rate * model->spec.geometry.length;
        }
    }
    record->fragment = fragment;
    record->nfragment = count;
    record->fragments = (int64_t)count;
    return FRACAS_OK;
}

static fracas_err bar_harvest(const fracas_model *model, fracas_step *step, int lane,
                              fracas_record *record)
{
    lane_view view = {model, step, lane};
    const double mass_per_length = 0.5 * model->spec.material.density * model->spec.geometry.area;
    record->momentum[0] = record->momentum[1] = record->momentum[2] = 0;
    for (size_t e = 0; e < model->elements; e++)
        record->momentum[0] += mass_per_length * size_of(model, e) *
                               (lane_value(&view, e, BAR_V_LEFT) +
                                lane_value(&view, e, BAR_V_RIGHT));
    TRY(harvest_fragments(&view, record));
    return step->onset_time ? fracas_chain_harvest_interfaces(&chain, model, step, lane, record)
                            : FRACAS_OK;
}

static const fracas_kind *const goes_with[] = {&fracas_shape_bar, &fracas_spacing_uniform,
                                               &fracas_spacing_graded, &fracas_spacing_perturbed,
                                               &fracas_loading_imposed_rate};
const fracas_formulation fracas_formulation_bar = {
    .kind = {.name = "bar",
             .doc = "a bar stretched at a uniform rate: the hoop direction of an expanding ring",
             FRACAS_GOES_WITH(goes_with)},
    .model_init = bar_model_init,
    .check_strength = bar_check_strength,
    .interface_volume = bar_interface_volume,
    .interface_positions = bar_interface_positions,
    .state_size = bar_state_size,
    .strength = bar_strength,
    .lane_init = bar_lane_init,
    .advance = bar_advance,
    .fragment_count = fracas_chain_fragment_count,
    .harvest = bar_harvest,
};
