/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/forecast.h"

#include "base/text.h"
#include "campaigns/plan/bounds.h"
#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"
#include "campaigns/plan/size.h"
#include "campaigns/plan/speed.h"
#include "campaigns/plan/start.h"
#include "engine/cohesive/law.h"
#include "engine/formulation/surface/loads.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/solver/batch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Quantile `u` of the strengths of interfaces of this extent [Pa]. */
static double strength_at(const fracas_point *point, fracas_extent extent, double u)
{
    return fracas_strength_quantile(&point->strength, extent, fracas_probability_of(u));
}

/* Checks the strongest of all strengths at the place of the largest factor, `most`. */
static fracas_err check_strongest(const fracas_model *model, const fracas_point *point,
                                  fracas_extent extent, double most)
{
    if (fracas_model_interfaces(model) == 0) return FRACAS_OK; /* a single triangle */
    const double strengths = (double)(fracas_model_interfaces(model) *
                                      fracas_model_strengths_per_interface(model));
    const double drawn = strengths * (double)fracas_point_most(point);
    const double u = fmin(1.0 - 0.01 / drawn, 1.0 - 0x1p-53);
    fracas_err err = fracas_model_check_strength(model, most * strength_at(point, extent, u));
    const char *what = fracas_model_strengths_per_interface(model) > 1 ? "Gauss points"
                                                                       : "interfaces";
    return err ? fracas_fail_within(err, "the strongest of %.3g %s (all replicas together)", drawn,
                                    what)
               : FRACAS_OK;
}

static fracas_err check_count(const fracas_model *model, const fracas_strength *strength)
{
    const size_t given = fracas_strength_count(strength),
                 interfaces = fracas_model_interfaces(model);
    if (given == 0 || given == interfaces) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "%s has %zu strengths, but the mesh has %zu interfaces; each needs one line of the file",
        strength->file->path, given, interfaces);
}

/* Samples the strength of each interface and checks it. */
static fracas_err check_places(const fracas_model *model, const fracas_strength *strength)
{
    const size_t n = fracas_model_strengths(model),
                 each = fracas_model_strengths_per_interface(model);
    OWN(fracas_field) field = NULL;
    TRY(fracas_model_field(model, strength, &field));
    OWNED double(*position)[3] = malloc(n * sizeof *position);
    OWNED double *sigma_c = malloc(n * sizeof *sigma_c);
    if (n > 0 && (!position || !sigma_c)) return fracas_no_memory("the strengths of a mesh");
    fracas_model_interface_positions(model, position);
    TRY(fracas_field_sample(field, &(fracas_stream){0}, 1, sigma_c));
    for (size_t i = 0; i < n; i++) {
        fracas_err err = fracas_model_check_strength(model, sigma_c[i]);
        if (err)
            return fracas_fail_within(err, "%s, interface %zu at x = %.9g m, y = %.9g m",
                                      strength->file->path, i / each, position[i][0],
                                      position[i][1]);
    }
    return FRACAS_OK;
}

static fracas_err check_strengths(const fracas_model *model, const fracas_point *point,
                                  fracas_extent extent, double most)
{
    if (fracas_strength_is_placed(&point->strength)) return check_places(model, &point->strength);
    TRY(check_count(model, &point->strength));
    return check_strongest(model, point, extent, most);
}

/* Forecasts of rings alone. A compressed ring with next to no bending stiffness folds, starting
 * from round-off; held radial velocities keep it round. */
static void describe_ring(const fracas_spec *spec, fracas_forecast *forecast)
{
    const fracas_loading_traits *traits = fracas_loading_traits_of(spec);
    const double radius = spec->geometry.radius;
    forecast->turn = M_PI_2 * radius / sqrt(spec->material.young / spec->material.density);
    forecast->folds = traits->folds &&
                      traits->folds(spec, forecast->bound < forecast->mean, forecast->turn);
    if (spec->geometry.direction == &fracas_direction_initial && traits->path)
        forecast->turned = fabs(traits->path(spec, spec->time.end)) / radius;
    forecast->zone_covers_ring = fracas_law_zone(&spec->cohesive) > 0.5 * fracas_spec_length(spec);
}

/* Diagonal of the box around all interfaces, and their largest distance from the z axis [m]. */
static fracas_err measure_body(const fracas_model *model, double *diagonal, double *reach)
{
    const size_t n = fracas_model_strengths(model);
    double square = 0;
    *reach = 0;
    OWNED double(*position)[3] = malloc((n + 1) * sizeof *position);
    if (!position) return fracas_no_memory("the places of interfaces");
    fracas_model_interface_positions(model, position);
    for (int axis = 0; axis < 3; axis++) {
        double least = INFINITY, most = -INFINITY;
        for (size_t i = 0; i < n; i++) {
            least = fmin(least, position[i][axis]);
            most = fmax(most, position[i][axis]);
        }
        if (n > 0) square += (most - least) * (most - least);
    }
    for (size_t i = 0; i < n; i++) *reach = fmax(*reach, hypot(position[i][0], position[i][1]));
    *diagonal = sqrt(square);
    return FRACAS_OK;
}

/* Bounds on stress and opening until time.end, and whether a longer run raises them. */
static void bound_stress(const fracas_spec *spec, const fracas_body_size *size,
                         fracas_forecast *forecast)
{
    fracas_spec longer = *spec;
    longer.time.end *= 2;
    forecast->bound = fracas_stress_bound(spec, size);
    forecast->available = fracas_opening_bound(spec, forecast->bound, size->extent);
    const double stress = fracas_stress_bound(&longer, size),
                 opening = fracas_opening_bound(&longer, stress, size->extent);
    forecast->stress_grows = stress > forecast->bound * (1 + 1e-9);
    forecast->opening_grows = opening > forecast->available * (1 + 1e-9);
}

/* Openings of breaks by the least factor of the strengths, and fragments there. By the strongest 1
 * % of strengths, whose openings are least, it is known that none breaks. `mean`, `strong`:
 * strength without the factor [Pa]. */
static void describe_breaks(const fracas_spec *spec, double mean, double strong,
                            const fracas_factor_range *factor, fracas_forecast *forecast)
{
    const double weak = forecast->factor * mean;
    forecast->opening = fracas_spec_critical_opening(spec, weak);
    const bool any = forecast->interfaces > 0;
    forecast->unbroken = any && fracas_spec_critical_opening(spec, forecast->factor * strong) >
                                    forecast->available;
    forecast->whole = any && fracas_spec_critical_opening(spec, factor->most * strong) >
                                 forecast->available;
    forecast->pieces = fracas_grady_size(spec, weak);
}

/* True if the strengths have a least value above 0: ever rarer ones are no weaker. */
static bool has_least(const fracas_point *point, fracas_extent extent)
{
    return strength_at(point, extent, 1e-300) > 0.999 * strength_at(point, extent, 1e-150);
}

/* The elements change the count by the strengths. On surfaces it depends on them with a
 * reference as well (docs/results/sampling.md). */
static void describe_mesh_effect(const fracas_point *point, const fracas_model *model,
                                 fracas_extent extent, fracas_forecast *forecast)
{
    const fracas_strength *strength = &point->strength;
    if (fracas_model_surface(model) || fracas_strength_has_size_effect(strength) ||
        strength->covariance || fracas_strength_is_given(strength))
        return;
    const bool bounded = has_least(point, extent);
    if (bounded && forecast->scatter > FRACAS_SCATTER_NOTABLE)
        forecast->mesh_effect_bounded = FRACAS_MESH_EFFECT_BOUNDED;
    if (!bounded)
        forecast->mesh_effect = fracas_mesh_effect(
            forecast->scatter, fracas_spec_normalised_rate(&point->spec, forecast->mean));
}

/* Keeps the lesser of two groups, of which 0 is none, and its name. */
static void keep_lesser(const fracas_surface *surface, int32_t number, fracas_surface_group *least)
{
    if (number <= 0 || (least->number > 0 && least->number <= number)) return;
    *least = (fracas_surface_group){.number = number};
    for (size_t g = 0; g < surface->ngroups; g++)
        if (surface->group[g].number == number) *least = surface->group[g];
}

/* Groups of edges without a key, and whether any edge is left to `edges`. */
static void describe_groups(const fracas_model *model, fracas_forecast *forecast)
{
    enum { MOST = 100 };
    const fracas_surface *surface = fracas_model_surface(model);
    const fracas_kind *const *edge = model->spec.geometry.edge;
    int32_t seen[MOST];
    bool held = false, some = false;
    for (size_t b = 0; b < surface->nborders; b++) {
        const int32_t tag = surface->border[b].tag;
        const int key = fracas_surface_edge_key(model, tag);
        some = some || key == 0;
        held = held || (key > 0 && edge[key] != &fracas_edge_free);
        if (key > 0 || tag <= 0) continue;
        size_t k = 0;
        while (k < forecast->nloose && seen[k] != tag) k++;
        if (k < forecast->nloose || k == MOST) continue;
        seen[forecast->nloose++] = tag;
        keep_lesser(surface, tag, &forecast->loose);
    }
    forecast->unheld = !some && !held && edge[0] != &fracas_edge_free;
}

static fracas_err describe_file(const fracas_model *model, fracas_forecast *forecast)
{
    const fracas_surface *surface = fracas_model_surface(model);
    describe_groups(model, forecast);
    for (size_t i = 0; i < surface->ninterfaces; i++)
        if (!fracas_surface_is_loaded(model, surface->interface[i].tag, true))
            keep_lesser(surface, surface->interface[i].tag, &forecast->inner);
    return fracas_surface_survey_make(surface, &forecast->mesh);
}

/* Keeps the first doubt. */
static void doubt(const fracas_attachment *file, bool last, fracas_forecast *forecast)
{
    if (!file || forecast->doubted) return;
    forecast->doubts = fracas_lines_doubt(file, last);
    if (*forecast->doubts.unit || forecast->doubts.line) forecast->doubted = file->path;
}

static void describe_files(const fracas_point *point, fracas_forecast *forecast)
{
    doubt(point->strength.file,
          fracas_strength_is_given(&point->strength) &&
              !fracas_strength_is_placed(&point->strength),
          forecast);
    doubt(point->strength.factor, false, forecast);
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        const fracas_loading *loading = fracas_loading_at(&point->spec, n);
        if (loading) doubt(loading->history, false, forecast);
    }
}

static fracas_err describe(const fracas_point *point, const fracas_model *model, bool estimated,
                           fracas_forecast *forecast)
{
    *forecast = (fracas_forecast){
        .estimated = estimated,
        .elements = (int64_t)fracas_model_elements(model),
        .interfaces = (int64_t)fracas_model_interfaces(model),
        .steps = fracas_model_steps(model),
        .time_step = fracas_model_time_step(model),
    };
    const fracas_spec *spec = &point->spec;
    const fracas_extents extent = fracas_extents_of(model);
    fracas_factor_range factor;
    TRY(fracas_model_factors(model, &point->strength, &factor));
    const double mean = factor.mean * fracas_strength_mean(&point->strength, extent.mean);
    const double softening = spec->material.young * fracas_spec_fracture_energy(spec, mean) /
                             (mean * mean);
    forecast->element = fracas_model_element_size(model);
    forecast->coarseness = forecast->element / softening;
    double reach;
    TRY(measure_body(model, &forecast->extent, &reach));
    if (fracas_shape_of(spec)->from_file) TRY(describe_file(model, forecast));
    describe_files(point, forecast);
    forecast->flat = point->strength.factor && factor.least == factor.most;
    forecast->uniform = factor.least == factor.most && strength_at(point, extent.mean, 0.25) ==
                                                           strength_at(point, extent.mean, 0.75);
    forecast->equal = forecast->uniform &&
                      fracas_strength_deviation(&point->strength, extent.mean) == 0;
    forecast->lines = forecast->uniform && fracas_spacing_of(spec)->rows &&
                      spec->mesh.amplitude == 0;
    forecast->mean = mean;
    bound_stress(spec, &(fracas_body_size){forecast->extent, reach, forecast->element}, forecast);
    forecast->spread = fracas_model_surface(model) && !fracas_law_of(spec)->flux
                           ? factor.most * strength_at(point, extent.mean, 0.99) -
                                 factor.least * strength_at(point, extent.mean, 0.01)
                           : NAN;
    forecast->step_stress = spec->material.young * fabs(fracas_spec_strain_rate(spec)) *
                            forecast->time_step;
    forecast->scatter = fracas_strength_deviation(&point->strength, extent.mean) /
                        fracas_strength_mean(&point->strength, extent.mean);
    if (!isfinite(forecast->scatter)) forecast->scatter = 0;
    forecast->transits = fracas_expected_transits(spec, mean);
    forecast->parts_most = fracas_model_parts_most(model);
    forecast->long_safety = fracas_model_long_safety(model);
    if (fracas_shape_of(spec)->round) describe_ring(spec, forecast);
    forecast->volume = extent.mean.volume;
    describe_mesh_effect(point, model, extent.mean, forecast);
    forecast->factor = fmin(1, factor.least);
    describe_breaks(spec, mean / factor.mean, strength_at(point, extent.mean, 0.99), &factor,
                    forecast);
    forecast->repeated = fracas_strength_is_given(&point->strength) && point->replicas > 1;
    forecast->started = fracas_start_speed(model);
    forecast->released = fracas_start_released(model);
    return estimated ? FRACAS_OK : check_strengths(model, point, extent.least, factor.most);
}

double fracas_bending_steps(const fracas_spec *spec, double element)
{
    return isnan(spec->time.rotary_inertia) ? fmax(1, 2.5 * spec->geometry.thickness / element) : 1;
}

/* The forecast and its model. */
static fracas_err forecast_with(const fracas_campaign *campaign, size_t index, bool quick,
                                fracas_forecast *forecast, fracas_model **model)
{
    fracas_point point = campaign->point[index];
    double coarser = 1;
    if (quick && point.spec.mesh.divisions > FRACAS_FORECAST_QUICK &&
        !fracas_strength_is_given(&point.strength)) {
        coarser = (double)point.spec.mesh.divisions / FRACAS_FORECAST_QUICK;
        point.spec.mesh.divisions = FRACAS_FORECAST_QUICK;
    }
    TRY(fracas_point_model_like(campaign, index, &point.spec, model));
    TRY(describe(&point, *model, coarser > 1, forecast));
    TRY(fracas_model_check_probes(*model, &campaign->probes, campaign->output.reactions != NULL));
    forecast->parts = campaign->parallel.parts;
    if (coarser == 1) return FRACAS_OK;
    forecast->elements = llround((double)forecast->elements * coarser * coarser);
    forecast->interfaces = llround((double)forecast->interfaces * coarser * coarser);
    const double steps = coarser * fracas_bending_steps(&point.spec, forecast->element / coarser) /
                         fracas_bending_steps(&point.spec, forecast->element);
    forecast->steps = llround((double)forecast->steps * steps);
    forecast->time_step /= steps;
    forecast->element /= coarser;
    return FRACAS_OK;
}

fracas_err fracas_forecast_make(const fracas_campaign *campaign, size_t point,
                                fracas_forecast *forecast)
{
    OWN(fracas_model) model = NULL;
    fracas_err err = forecast_with(campaign, point, false, forecast, &model);
    return err ? fracas_fail_within(err, "point %zu", point) : FRACAS_OK;
}

/* ---- cost ---- */

fracas_err fracas_plan_cost(const fracas_campaign *campaign, size_t point, double *cost,
                            double *bytes)
{
    OWN(fracas_model) model = NULL;
    const fracas_err err = fracas_point_model_create(campaign, point, &model);
    if (err) return fracas_fail_within(err, "point %zu", point);
    return fracas_plan_cost_with(campaign, point, model, NULL, cost, bytes);
}

/* True if the point's mesh is that of the point before, whose warnings have been said. */
static bool is_mesh_of_last(const fracas_campaign *campaign, size_t point)
{
    if (point == 0) return false;
    const fracas_geometry *is = &campaign->point[point].spec.geometry,
                          *was = &campaign->point[point - 1].spec.geometry;
    return is->file && was->file && is->unit == was->unit &&
           !strcmp(is->file->digest, was->file->digest);
}

void fracas_plan_words_say(const fracas_plan_words *words, const char *text)
{
    static const char word[] = "fracas: warning: ";
    fputs(word, words->out);
    fracas_text_wrap(text, (int)strlen(word), words->columns, words->out);
}

static void warn_of(const fracas_campaign *campaign, size_t point, const fracas_forecast *forecast,
                    fracas_plan_words *words)
{
    char text[FRACAS_WARNING_TEXT], line[FRACAS_WARNING_TEXT + 32];
    const fracas_point *of = &campaign->point[point];
    for (int w = 0; w < FRACAS_RUN_WARNINGS && !is_mesh_of_last(campaign, point); w++) {
        if (!(fracas_plan_warnings[w](of, forecast, text, sizeof text) > 0)) continue;
        snprintf(line, sizeof line, "point %zu: %s", point, text);
        fracas_plan_words_say(words, line);
    }
    if (fracas_plan_warn_unbroken(of, forecast, text, sizeof text) > 0 && words->unbroken++ == 0)
        snprintf(words->first, sizeof words->first, "point %zu: %s", point, text);
}

fracas_err fracas_plan_cost_with(const fracas_campaign *campaign, size_t point,
                                 const fracas_model *model, fracas_plan_words *words, double *cost,
                                 double *bytes)
{
    fracas_forecast forecast;
    fracas_err err = describe(&campaign->point[point], model, false, &forecast);
    if (!err)
        err = fracas_model_check_probes(model, &campaign->probes,
                                        campaign->output.reactions != NULL);
    if (err) return fracas_fail_within(err, "point %zu", point);
    if (words) warn_of(campaign, point, &forecast, words);
    *cost = (double)forecast.elements * (double)forecast.steps;
    fracas_rows_expect(campaign, &campaign->point[point].spec, &forecast);
    if (bytes) *bytes = fracas_realization_bytes(campaign, &forecast);
    return FRACAS_OK;
}

/* ---- all points ---- */

size_t fracas_forecast_lanes(const fracas_point *point)
{
    return point->replicas < FRACAS_LANES_MAX ? (size_t)point->replicas : FRACAS_LANES_MAX;
}

/* The model, a batch's lanes, times of onsets and breaks where interfaces are kept, labels. */
static double memory_of(const fracas_campaign *campaign, const fracas_point *point,
                        const fracas_model *model)
{
    const double kept = campaign->output.interfaces ? 2 * sizeof(double) : 0;
    return fracas_model_bytes(model) +
           fracas_batch_width(fracas_forecast_lanes(point)) *
               (fracas_model_lane_bytes(model) + kept * (double)fracas_model_interfaces(model)) +
           2 * sizeof(size_t) * (double)fracas_model_elements(model);
}

/* Forecast p with its speed, given the forecasts before it. */
static fracas_err forecast_timed(const fracas_campaign *campaign, size_t p, bool quick,
                                 double *budget, fracas_forecast *forecast)
{
    OWN(fracas_model) model = NULL;
    TRY(forecast_with(campaign, p, quick, &forecast[p], &model));
    forecast[p].memory = memory_of(campaign, &campaign->point[p], model);
    if (forecast[p].estimated)
        forecast[p].memory *= (double)forecast[p].elements / (double)fracas_model_elements(model);
    forecast[p].speed = fracas_speed_of_similar(campaign, forecast, p);
    if (!(forecast[p].speed > 0)) TRY(fracas_speed_measure(campaign, p, model, &forecast[p]));
    fracas_rows_expect(campaign, &campaign->point[p].spec, &forecast[p]);
    return fracas_rows_try(campaign, p, model, budget, forecast);
}

/* Says which point comes next, where that may take long, or after each second of patience. */
static void say_next(const fracas_campaign *campaign, size_t p, bool quick, double *said)
{
    enum { LARGE = 150 /* divisions: a second or two */ };
    static const double patience = 2; /* s of this process */
    const bool large = !quick && campaign->point[p].spec.mesh.divisions > LARGE;
    if (!large && fracas_processor_time() - *said < patience) return;
    fprintf(stderr, "fracas: point %zu of %zu is looked at%s\n", p, campaign->npoints,
            large ? "; the critical step of its mesh takes long (`fracas plan --quick` estimates)"
                  : "");
    *said = fracas_processor_time();
}

fracas_err fracas_forecast_all(const fracas_campaign *campaign, int jobs, bool quick,
                               fracas_forecast *forecast)
{
    double said = fracas_processor_time(), budget = FRACAS_ROWS_BUDGET;
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        say_next(campaign, p, quick, &said);
        fracas_err err = forecast_timed(campaign, p, quick, &budget, forecast);
        if (err) return fracas_fail_within(err, "point %zu", p);
        const double work = (double)forecast[p].elements * (double)forecast[p].steps *
                            (double)fracas_point_most(point);
        forecast[p].time = work / (forecast[p].speed * jobs);
        forecast[p].bytes = fracas_realization_bytes(campaign, &forecast[p]) *
                            (double)fracas_point_most(point);
    }
    return FRACAS_OK;
}
