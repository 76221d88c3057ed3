/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/chain/chain.h"

#include "engine/cohesive/law.h"
#include "engine/mesh/body.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

fracas_err fracas_chain_model_init(fracas_model *model, const fracas_chain *chain, int64_t least)
{
    const fracas_spec *spec = &model->spec;
    const int64_t elements = spec->mesh.elements;
    const bool closed = fracas_shape_of(spec)->round || fracas_model_period(model) > 0;
    if (elements < least || elements > 100000000)
        return fracas_fail(FRACAS_USAGE,
                           "mesh.elements is %" PRId64 "; a %s takes %" PRId64 " to 1e8 elements",
                           elements, spec->formulation->name, least);
    model->chain = chain;
    model->elements = (size_t)elements;
    model->interfaces = model->elements - (closed ? 0 : 1);
    model->element_size = model->longest = fracas_spec_length(spec) / (double)elements;
    model->mass = spec->material.density * spec->geometry.area * fracas_spec_length(spec);
    model->wave_speed = sqrt(spec->material.young / spec->material.density);
    return FRACAS_OK;
}

bool fracas_chain_is_free(const fracas_model *model)
{
    const fracas_shape *shape = fracas_shape_of(&model->spec);
    return shape->free && shape->free(&model->spec.geometry);
}

double fracas_chain_gap(const fracas_model *model)
{
    const fracas_shape *shape = fracas_shape_of(&model->spec);
    return shape->gap ? shape->gap(&model->spec.geometry) : NAN;
}

double fracas_chain_contact_factor(const fracas_spec *spec)
{
    const fracas_law *law = fracas_law_of(spec);
    return law->contact ? law->contact(&spec->cohesive) : 1.0;
}

double *fracas_chain_field(const fracas_model *model, const fracas_step *step, size_t element,
                           int field, int lane)
{
    const size_t lanes = (size_t)step->lanes, group = (size_t)lane / lanes,
                 fields = (size_t)model->chain->fields;
    return step->state + group * lanes * model->elements * fields +
           (element * fields + (size_t)field) * lanes + (size_t)lane % lanes;
}

double fracas_chain_interface_volume(const fracas_model *model, size_t e)
{
    return model->spec.geometry.area *
           (0.5 *
            (fracas_chain_size(model, e) + fracas_chain_size(model, fracas_chain_next(model, e))));
}

size_t fracas_chain_state_size(const fracas_model *model)
{
    return model->elements * (size_t)model->chain->fields;
}

double *fracas_chain_strength(const fracas_model *model, const fracas_step *step, int lane,
                              size_t *stride)
{
    *stride = (size_t)(model->chain->fields * step->lanes);
    return fracas_chain_field(model, step, 0, model->chain->strength, lane);
}

/* K of interface e: its factor times E/h, with 1/h the mean of its two elements'  (bar.18) */
static double stiffness_of(const fracas_model *model, size_t e)
{
    const double young = model->spec.material.young,
                 factor = fracas_law_of(&model->spec)->contact(&model->spec.cohesive);
    if (!model->sizes) return factor * young / model->element_size;
    return factor *
           (0.5 * (young / model->sizes[e] + young / model->sizes[fracas_chain_next(model, e)]));
}

void fracas_chain_lane_init(const fracas_model *model, const fracas_step *step, int lane)
{
    const fracas_law *law = fracas_law_of(&model->spec);
    const fracas_chain *chain = model->chain;
    for (size_t e = 0; e < model->elements; e++) {
        const double strength = *fracas_chain_field(model, step, e, chain->strength, lane);
        for (int field = 0; field < chain->fields; field++)
            if (field != chain->strength) *fracas_chain_field(model, step, e, field, lane) = 0.0;
        if (law->constant && e < model->interfaces)
            *fracas_chain_field(model, step, e, chain->law, lane) = law->constant(
                &model->spec.cohesive, stiffness_of(model, e), strength);
    }
    for (size_t n = 0; n < model->nnotch; n++) {
        *fracas_chain_field(model, step, model->notch[n], chain->damage, lane) = 1;
        if (!law->flux)
            *fracas_chain_field(model, step, model->notch[n], chain->law, lane) = chain->open;
    }
}

/* K > sigma_c/delta_c = sigma_c^2/(2 G_c), with K delta_c - sigma_c finite  (cohesive.7) */
fracas_err fracas_chain_check_strength(const fracas_model *model, double strength)
{
    const fracas_cohesive *cohesive = &model->spec.cohesive;
    const fracas_law *law = fracas_law_of(&model->spec);
    if (!law->flux) return FRACAS_OK;
    const double young = model->spec.material.young, energy = cohesive->fracture_energy,
                 h = model->longest;
    const double steep = fracas_law_steepest(cohesive) * strength;
    double margin = 2 * (cohesive->beta * young / h) * energy / strength - steep;
    double most = 2 * cohesive->beta * young * energy / (strength * steep);
    if (margin > 0 && isfinite(margin)) return FRACAS_OK;
    if (!isfinite(margin) || !isfinite(most))
        return fracas_fail(FRACAS_USAGE,
                           "strength %g Pa and cohesive.fracture_energy %g J/m2 give no critical "
                           "opening that can be computed with: are both in the units meant? A "
                           "bare number is SI",
                           strength, energy);
    const double needed = ceil((double)model->elements * h / most);
    return fracas_fail(FRACAS_USAGE,
                       "strength %g Pa needs elements shorter than %.4g m, they are %.4g m: raise "
                       "mesh.elements above %.15g (or cohesive.beta)%s",
                       strength, most, h, needed,
                       needed < 1e7
                           ? ""
                           : "; so many: are material.young [Pa], cohesive.fracture_energy [J/m2] "
                             "and lengths [m] in the units meant? A bare number is SI");
}

fracas_err fracas_chain_count(const fracas_model *model, fracas_step *step, int lane,
                              fracas_census *census)
{
    const int64_t broken = step->broken[lane] + (int64_t)model->nnotch;
    census->all = fracas_chain_is_closed(model) ? (broken > 1 ? broken : 1) : broken + 1;
    census->held = 0;
    census->size = fracas_spec_length(&model->spec) / (double)census->all;
    return FRACAS_OK;
}

bool fracas_chain_is_broken(const fracas_model *model, const fracas_step *step, size_t element,
                            int lane)
{
    return element >= model->interfaces ||
           *fracas_chain_field(model, step, element, model->chain->damage, lane) >= 1.0;
}

/* (bar.17) */
size_t fracas_chain_partition(const fracas_model *model, fracas_step *step, int lane)
{
    fracas_partition *partition = &step->partition;
    fracas_partition_reset(partition);
    for (size_t e = 0; e < model->interfaces; e++)
        if (!fracas_chain_is_broken(model, step, e, lane))
            fracas_partition_unite(partition, (uint32_t)e, (uint32_t)fracas_chain_next(model, e));
    return fracas_partition_label(partition);
}

/* A square of area A has the second moment A/12 along each direction, a rod of length l l^2/12. */
void fracas_chain_add_segment(const fracas_spec *spec, double mass, const double ends[2][3],
                              fracas_fragment_matter *matter)
{
    double middle[3], along[3], square = 0, spread[6];
    for (int i = 0; i < 3; i++) {
        middle[i] = 0.5 * (ends[0][i] + ends[1][i]);
        along[i] = ends[1][i] - ends[0][i];
        square += along[i] * along[i];
    }
    const double length = sqrt(square);
    for (int i = 0; i < 3; i++) along[i] /= length;
    fracas_fragment_spread(along, mass * square / 12, mass * spec->geometry.area / 12, spread);
    fracas_fragment_matter_add(matter, mass, middle, spread);
}

size_t fracas_chain_element_nodes(const fracas_model *model)
{
    (void)model;
    return 2;
}

void fracas_chain_add_cracks(const fracas_model *model, const fracas_step *step, int lane,
                             fracas_fragment *fragment)
{
    const uint32_t *label = step->partition.label;
    for (size_t e = 0; e < model->interfaces; e++) {
        if (!fracas_chain_is_broken(model, step, e, lane)) continue;
        fragment[label[e]].crack_area += model->spec.geometry.area;
        fragment[label[fracas_chain_next(model, e)]].crack_area += model->spec.geometry.area;
    }
}

size_t fracas_chain_interface_nodes(const fracas_model *model)
{
    (void)model;
    return 1;
}

/* (probes.1) */
void fracas_chain_locate(const fracas_model *model, size_t e, const double ends[2][3],
                         const double place[3], fracas_spot *spot)
{
    double along = 0, square = 0, distance = 0, at[3];
    for (int i = 0; i < 3; i++) {
        const double side = ends[1][i] - ends[0][i];
        along += side * (place[i] - ends[0][i]);
        square += side * side;
    }
    const double s = fmin(1, fmax(0, along / square));
    for (int i = 0; i < 3; i++) {
        at[i] = (1 - s) * ends[0][i] + s * ends[1][i];
        distance += (place[i] - at[i]) * (place[i] - at[i]);
    }
    distance = sqrt(distance);
    if (e > 0 && !(distance < spot->distance - 1e-9 * fracas_chain_size(model, e))) return;
    *spot = (fracas_spot){.element = e, .weight = {1 - s, s}, .distance = distance};
    memcpy(spot->place, at, sizeof at);
}

/* Times are NaN where none are kept. */
static fracas_interface_row row_of(const fracas_model *model, const fracas_step *step, int lane,
                                   size_t e)
{
    const size_t at = e * (size_t)step->width + (size_t)lane;
    return (fracas_interface_row){
        .strength = *fracas_chain_field(model, step, e, model->chain->strength, lane),
        .damage = *fracas_chain_field(model, step, e, model->chain->damage, lane),
        .onset_time = step->onset_time ? step->onset_time[at] : NAN,
        .break_time = step->onset_time ? step->break_time[at] : NAN};
}

/* The last interface of a closed bar lies at both ends of the line: it takes its first side. */
void fracas_chain_fill_interface(const fracas_model *model, const fracas_step *step, int lane,
                                 size_t e, fracas_fields *f)
{
    const fracas_interface_row row = row_of(model, step, lane, e);
    const size_t next = fracas_chain_next(model, e);
    const double *left = f->place[2 * e + 1],
                 *right = next < e && fracas_model_period(model) > 0 ? left : f->place[2 * next];
    for (int i = 0; i < 3; i++) f->middle[e][i] = 0.5 * (left[i] + right[i]);
    f->between[e][0] = (int64_t)e;
    f->between[e][1] = (int64_t)next;
    f->damage[e] = row.damage;
    f->strength[e] = row.strength;
    f->onset_time[e] = row.onset_time;
}

fracas_err fracas_chain_harvest_interfaces(const fracas_model *model, const fracas_step *step,
                                           int lane, fracas_record *record)
{
    if (!step->onset_time) return FRACAS_OK;
    record->interface = calloc(model->interfaces, sizeof *record->interface);
    if (!record->interface) return fracas_no_memory("the interfaces of a realization");
    record->ninterface = model->interfaces;
    for (size_t e = 0; e < model->interfaces; e++)
        record->interface[e] = row_of(model, step, lane, e);
    return FRACAS_OK;
}
