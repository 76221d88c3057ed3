/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bar: one coordinate, background motion rate t x taken out (docs/theory/bar.md). */
#include "engine/formulation/chain/bar_sweep.h"

#include "engine/cohesive/law.h"
#include "engine/formulation/chain/chain.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <stdlib.h>

FRACAS_KERNEL_TABLE(const fracas_bar_kernel, fracas_bar);

static const fracas_chain chain = {.fields = BAR_FIELDS,
                                   .damage = BAR_DAMAGE,
                                   .strength = BAR_STRENGTH,
                                   .law = BAR_LAW,
                                   .open = BAR_LINK_OPEN};

/* Where the background is at rest [m]  (bar.1). */
static double middle_of(const fracas_model *model)
{
    return fracas_chain_is_free(model) ? 0.5 * model->spec.geometry.length : 0;
}

/* Nodal mass as (bar.5). */
static fracas_bar_constants constants_of(const fracas_model *model)
{
    const fracas_spec *spec = &model->spec;
    const double young = spec->material.young, energy = spec->cohesive.fracture_energy,
                 gap = fracas_chain_gap(model);
    return (fracas_bar_constants){.elements = model->elements,
                                  .periodic = fracas_chain_is_closed(model),
                                  .held = fracas_chain_is_held(model),
                                  .walls = gap >= 0,
                                  .gap = gap,
                                  .parting = spec->loading.rate * middle_of(model),
                                  .contact_factor = fracas_chain_contact_factor(spec),
                                  .young = young,
                                  .spring = spec->cohesive.beta * young / model->element_size,
                                  .beta = spec->cohesive.beta,
                                  .whole = fracas_chain_whole(spec->cohesive.beta),
                                  .own = model->own,
                                  .size = model->element_size,
                                  .nodal_mass = 0.5 * spec->material.density * model->element_size,
                                  .sizes = model->sizes,
                                  .fracture_energy = energy,
                                  .rate = spec->loading.rate,
                                  .area = spec->geometry.area};
}

/* ---- mesh ---- */

static void bar_interface_positions(const fracas_model *model, double (*position)[3])
{
    double end = 0;
    for (size_t e = 0; e < model->interfaces; e++) {
        end += fracas_chain_size(model, e);
        position[e][0] = model->sizes ? end : model->element_size * (double)(e + 1);
        position[e][1] = position[e][2] = 0;
    }
}

/* (bar.19) */
static fracas_err fill_sizes(fracas_model *model)
{
    const fracas_spacing *spacing = fracas_spacing_of(&model->spec);
    if (!spacing->fill) return FRACAS_OK;
    model->sizes = malloc(model->elements * sizeof *model->sizes);
    if (!model->sizes) return fracas_no_memory("the mesh of a bar");
    model->bytes = model->elements * sizeof *model->sizes;
    TRY(spacing->fill(&model->spec.mesh, model->spec.geometry.length, model->sizes));
    for (size_t e = 0; e < model->elements; e++)
        model->longest = fmax(model->longest, model->sizes[e]);
    return FRACAS_OK;
}

static fracas_err bar_model_init(fracas_model *model)
{
    TRY(fracas_chain_model_init(model, &chain, 2));
    TRY(fill_sizes(model));
    /* a free bar may fly, unless it meets a wall */
    if (fracas_chain_is_held(model) || fracas_chain_gap(model) >= 0)
        model->rigid_part = FRACAS_MOTION_NONE;
    /* check_strength keeps a stiffness of contact by strength below the elements'. */
    return fracas_chain_critical_step(model);
}

/* ---- strength ---- */

static fracas_err bar_check_strength(const fracas_model *model, double strength)
{
    TRY(fracas_chain_check_strength(model, strength));
    const fracas_law *law = fracas_law_of(&model->spec);
    if (!law->contact_by_strength) return FRACAS_OK;
    const double h = model->longest, young = model->spec.material.young,
                 penalty = law->contact_by_strength(&model->spec, strength);
    if (penalty > young / h)
        return fracas_fail(
            FRACAS_USAGE,
            "contact penalty %.4g Pa/m of strength %g Pa exceeds the elements' stiffness %.4g "
            "Pa/m: raise mesh.elements above %.15g",
            penalty, strength, young / h,
            ceil(h / model->element_size * model->spec.geometry.length * penalty / young));
    return FRACAS_OK;
}

static void bar_advance(const fracas_model *model, fracas_step *step)
{
    const fracas_bar_constants bar = constants_of(model);
    fracas_bar_sweep *sweep =
        fracas_bar[step->isa][step->lanes]
            ->sweep[fracas_law_of(&model->spec)->number][step->balanced][!model->sizes];
    for (int first = 0; first < step->width; first += step->lanes) sweep(&bar, step, first);
}

/* ---- fragments ---- */

/* Mean of two fields, those of an element's ends. */
static double mean_of(const fracas_model *model, const fracas_step *step, size_t e, int left,
                      int right, int lane)
{
    return 0.5 * (*fracas_chain_field(model, step, e, left, lane) +
                  *fracas_chain_field(model, step, e, right, lane));
}

/* Elements from here on are after the last break of a closed bar, in the fragment of element 0:
 * they are taken one circumference back. */
static size_t taken_back(const fracas_model *model, const fracas_step *step, int lane)
{
    size_t back = model->elements;
    while (fracas_chain_is_closed(model) && back > 0 &&
           !fracas_chain_is_broken(model, step, back - 1, lane))
        back--;
    return back;
}

/* The peculiar motion, with masses at the nodes. */
static void bar_add_up(const fracas_model *model, const fracas_step *step, int lane,
                       const fracas_fragment_motion *motion, fracas_fragment_sums *sums)
{
    const fracas_spec *spec = &model->spec;
    const size_t back = taken_back(model, step, lane);
    const double background = spec->loading.rate * step->time[lane];
    double start = 0;
    for (size_t e = 0; e < model->elements; e++) {
        const size_t f = step->partition.label[e];
        const double h = fracas_chain_size(model, e), volume = spec->geometry.area * h,
                     mass = 0.5 * spec->material.density * volume;
        const double strain = background + (*fracas_chain_field(model, step, e, BAR_W_RIGHT, lane) -
                                            *fracas_chain_field(model, step, e, BAR_W_LEFT, lane)) /
                                               h;
        sums[f].elements++;
        sums[f].strain_energy += 0.5 * spec->material.young * strain * strain * volume;
        for (int side = 0; side < 2; side++) {
            const double at = start + side * h - (e >= back ? spec->geometry.length : 0);
            const double x[3] = {at};
            double v[3] = {*fracas_chain_field(model, step, e, BAR_V_LEFT + side, lane)};
            if (motion) fracas_fragment_motion_take_off(&motion[f], x, v);
            fracas_fragment_sums_add(&sums[f], mass, x, v);
        }
        start += h;
    }
}

static double bar_background(const fracas_model *model, double time)
{
    (void)time;
    return model->spec.loading.rate;
}

/* Adds up the elements of each fragment, moved as (bar.1). */
static void add_elements(const fracas_model *model, const fracas_step *step, int lane,
                         fracas_fragment *fragment)
{
    const fracas_spec *spec = &model->spec;
    const double mass_per_length = spec->material.density * spec->geometry.area;
    const double time = step->time[lane], rate = spec->loading.rate, length = spec->geometry.length,
                 drift = rate * middle_of(model);
    const size_t back = taken_back(model, step, lane);
    double node = 0;
    for (size_t e = 0; e < model->elements; e++) {
        fracas_fragment *f = &fragment[step->partition.label[e]];
        const double h = fracas_chain_size(model, e), start = model->sizes ? node : h * (double)e;
        double x = start + 0.5 * h - (e >= back ? length : 0.0);
        double w = mean_of(model, step, e, BAR_W_LEFT, BAR_W_RIGHT, lane);
        double v = mean_of(model, step, e, BAR_V_LEFT, BAR_V_RIGHT, lane);
        f->elements++;
        f->mass += mass_per_length * h;
        f->size += h;
        f->position[0] += h * (x * (1 + rate * time) - drift * time + w);
        f->velocity[0] += h * (rate * x - drift + v);
        node += h;
    }
}

/* Fragments as (bar.17). */
static fracas_err bar_harvest(const fracas_model *model, fracas_step *step, int lane,
                              fracas_record *record)
{
    const fracas_spec *spec = &model->spec;
    const double mass_per_length = spec->material.density * spec->geometry.area,
                 length = spec->geometry.length, rate = spec->loading.rate;
    record->momentum[0] = record->momentum[1] = record->momentum[2] = 0;
    for (size_t e = 0; e < model->elements; e++)
        record->momentum[0] += mass_per_length * fracas_chain_size(model, e) *
                               mean_of(model, step, e, BAR_V_LEFT, BAR_V_RIGHT, lane);
    const size_t count = fracas_chain_partition(model, step, lane);
    fracas_fragment *fragment = calloc(count, sizeof *fragment);
    if (!fragment) return fracas_no_memory("the fragments of a realization");
    add_elements(model, step, lane, fragment);
    for (size_t f = 0; f < count; f++) {
        fragment[f].position[0] /= fragment[f].size;
        fragment[f].velocity[0] /= fragment[f].size;
        fragment[f].dust = fragment[f].elements == 1;
        record->fragments_dust += fragment[f].dust;
        if (fracas_chain_is_closed(model) && fragment[f].position[0] < 0) {
            fragment[f].position[0] += length * (1 + rate * step->time[lane]);
            fragment[f].velocity[0] += rate * length;
        }
    }
    record->fragment = fragment;
    record->nfragment = count;
    record->fragments = (int64_t)count;
    return fracas_chain_harvest_interfaces(model, step, lane, record);
}

/* Where a fragment begins that goes on across the end of the coordinate: behind a break. */
static size_t beginning_of(const fracas_model *model, const fracas_step *step, int lane,
                           const uint32_t *element, size_t count)
{
    for (size_t n = 1; n < count; n++)
        if (fracas_chain_is_broken(model, step, element[n - 1], lane)) return n;
    return 0;
}

/* Seen from where the fragment begins. */
static void bar_add_matter(const fracas_model *model, const fracas_step *step, int lane,
                           const uint32_t *element, size_t count, fracas_fragment_matter *matter,
                           double (*node)[3])
{
    const fracas_spec *spec = &model->spec;
    const double stretch = 1 + spec->loading.rate * step->time[lane],
                 mass_per_length = spec->material.density * spec->geometry.area;
    const size_t begin = beginning_of(model, step, lane, element, count);
    double start = 0;
    for (size_t n = 0; n < count; n++) {
        const size_t e = element[(begin + n) % count];
        const double h = fracas_chain_size(model, e);
        const double ends[2][3] = {
            {start * stretch + *fracas_chain_field(model, step, e, BAR_W_LEFT, lane)},
            {(start + h) * stretch + *fracas_chain_field(model, step, e, BAR_W_RIGHT, lane)}};
        fracas_chain_add_segment(spec, mass_per_length * h, ends, matter);
        memcpy(node[2 * n], ends, sizeof ends);
        start += h;
    }
}

/* (bar.1): the background's part of displacements is exact, not a difference of places. */
static void bar_fields(const fracas_model *model, const fracas_step *step, int lane,
                       fracas_fields *f)
{
    const fracas_spec *spec = &model->spec;
    const double rate = spec->loading.rate, time = step->time[lane],
                 drift = rate * middle_of(model);
    double start = 0;
    for (size_t e = 0; e < model->elements; e++) {
        const double h = fracas_chain_size(model, e);
        const double *w = fracas_chain_field(model, step, e, BAR_W_LEFT, lane);
        const size_t apart = (size_t)step->lanes; /* from a field to the next */
        f->stress[0][e] = spec->material.young * (rate * time + (w[apart] - w[0]) / h);
        for (size_t side = 0; side < 2; side++) {
            const size_t node = 2 * e + side;
            const double x = (model->sizes ? start : h * (double)e) + (double)side * h,
                         u = (rate * x - drift) * time + w[side * apart],
                         v = rate * x - drift + w[(BAR_V_LEFT + side) * apart];
            memcpy(f->place[node], (double[3]){x + u}, sizeof f->place[node]);
            memcpy(f->displacement[node], (double[3]){u}, sizeof f->displacement[node]);
            memcpy(f->velocity[node], (double[3]){v}, sizeof f->velocity[node]);
            f->mass[node] = 0.5 * spec->material.density * spec->geometry.area * h;
        }
        start += h;
    }
    for (size_t e = 0; e < model->interfaces; e++) {
        fracas_chain_fill_interface(model, step, lane, e, f);
        f->opening[e] = *fracas_chain_field(model, step, fracas_chain_next(model, e), BAR_W_LEFT,
                                            lane) -
                        *fracas_chain_field(model, step, e, BAR_W_RIGHT, lane);
    }
}

static void bar_locate(const fracas_model *model, const double place[3], fracas_spot *spot)
{
    double start = 0;
    for (size_t e = 0; e < model->elements; e++) {
        const double h = fracas_chain_size(model, e), left = model->sizes ? start : h * (double)e;
        const double ends[2][3] = {{left}, {left + h}};
        fracas_chain_locate(model, e, ends, place, spot);
        start += h;
    }
}

/* (bar.1), (probes.2) */
static void bar_motion_at(const fracas_model *model, const fracas_step *step, int lane,
                          const fracas_spot *spot, double displacement[3], double velocity[3])
{
    const double rate = model->spec.loading.rate,
                 background = rate * spot->place[0] - rate * middle_of(model);
    double w = 0, v = 0;
    for (int side = 0; side < 2; side++) {
        w += spot->weight[side] *
             *fracas_chain_field(model, step, spot->element, BAR_W_LEFT + side, lane);
        v += spot->weight[side] *
             *fracas_chain_field(model, step, spot->element, BAR_V_LEFT + side, lane);
    }
    memcpy(displacement, (double[3]){background * step->time[lane] + w}, 3 * sizeof w);
    memcpy(velocity, (double[3]){background + v}, 3 * sizeof v);
}

static const fracas_kind *const goes_with[] = {&fracas_shape_bar, &fracas_spacing_uniform,
                                               &fracas_spacing_graded, &fracas_spacing_perturbed,
                                               &fracas_loading_imposed_rate};
const fracas_formulation fracas_formulation_bar = {
    .kind = {.name = "bar",
             .groups = FRACAS_GROUP_BAR,
             .doc = "a bar stretched at a uniform rate: the hoop direction of an expanding ring",
             FRACAS_GOES_WITH(goes_with)},
    .model_init = bar_model_init,
    .check_strength = bar_check_strength,
    .interface_positions = bar_interface_positions,
    .lane_init = fracas_chain_lane_init,
    .advance = bar_advance,
    .add_up = bar_add_up,
    .background = bar_background,
    .harvest = bar_harvest,
    .add_matter = bar_add_matter,
    .fields = bar_fields,
    .locate = bar_locate,
    .motion_at = bar_motion_at,
    FRACAS_CHAIN_FORMULATION};
