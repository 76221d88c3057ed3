/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/formulation.h"

#include "base/own.h"
#include "engine/cohesive/law.h"
#include "engine/element/triangle.h"
#include "engine/mesh/body.h"
#include "engine/mesh/notch.h"
#include "engine/mesh/surface/surface.h"

#include <math.h>
#include <stdlib.h>

#define MOST_STEPS 1e12 /* years of computing, for a bar of two elements */

static double finest_of(const fracas_model *model)
{
    const fracas_law *law = fracas_law_of(&model->spec);
    return law->finest ? law->finest(&model->spec.cohesive) : 1.0;
}

/* Steps to time.end, at most: a law may refine the time step. */
static double most_steps(const fracas_model *model)
{
    return ceil(model->spec.time.end / (finest_of(model) * model->time_step));
}

static fracas_err check_steps(const fracas_model *model)
{
    const double step = model->time_step, end = model->spec.time.end;
    if (!(step > 0 && isfinite(step)))
        return fracas_fail(FRACAS_USAGE,
                           "a critical time step of %s: are young, density and all lengths in the "
                           "units meant? A bare number is SI",
                           isnan(step) ? "no number"
                           : step > 0  ? "more seconds than can be counted"
                                       : "0 s");
    if (end / step > MOST_STEPS)
        return fracas_fail(
            FRACAS_USAGE,
            "time.end %g s is %.3g time steps of %.3g s; %g are allowed: are time.end, "
            "young, density and all lengths in the units meant? A bare number is SI",
            end, end / step, step, MOST_STEPS);
    if (most_steps(model) <= MOST_STEPS) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "time.end %g s is %.3g of the finest time steps, which law %s may refine by "
                       "%g; %g are allowed: raise cohesive.refinement",
                       end, most_steps(model), model->spec.cohesive.law->name, finest_of(model),
                       MOST_STEPS);
}

/* A formulation asks shape, spacing and loading for traits of its partners alone. */
static fracas_err check_partners(const fracas_spec *spec)
{
    const fracas_kind *model = spec->formulation, *const chosen[] = {spec->geometry.shape,
                                                                     spec->mesh.spacing,
                                                                     spec->loading.type};
    for (size_t c = 0; c < FRACAS_COUNT(chosen); c++) {
        size_t g = 0;
        if (chosen[c]->only & model->groups) continue;
        while (g < model->ngoes_with && model->goes_with[g] != chosen[c]) g++;
        if (g == model->ngoes_with)
            return fracas_fail(FRACAS_USAGE, "model %s does not go with %s", model->name,
                               chosen[c]->name);
    }
    return FRACAS_OK;
}

static fracas_err find_notch(fracas_model *model)
{
    OWNED double(*position)[3] = NULL;
    if (!model->surface && fracas_notch_has_line(&model->spec.notch)) {
        position = malloc((model->interfaces + 1) * sizeof *position);
        if (!position) return fracas_no_memory("the notch of a body");
        fracas_model_interface_positions(model, position);
    }
    const fracas_notch_places places = {model->surface, model->interfaces,
                                        (const double(*)[3])position, model->element_size};
    TRY(fracas_notch_find(&model->spec.notch, &places, &model->notch, &model->nnotch));
    if (model->formulation->part_notch && !fracas_notch_touches(&model->spec.notch))
        model->formulation->part_notch(model);
    return FRACAS_OK;
}

fracas_err fracas_model_create(const fracas_spec *spec, fracas_model **out)
{
    TRY(check_partners(spec));
    OWN(fracas_model) model = calloc(1, sizeof *model);
    if (!model) return fracas_no_memory("a model");
    model->spec = *spec;
    model->formulation = (const fracas_formulation *)(const void *)spec->formulation;
    model->strengths = 1;
    model->tolerance = 0.05;
    fracas_law_own(spec, model->own);
    TRY(model->formulation->model_init(model));
    TRY(find_notch(model));
    model->spec.mesh.noise = NULL; /* the caller's, and done with, as is a file */
    model->spec.geometry.file = NULL;
    model->spec.frequencies = NULL;
    model->time_step = spec->time.safety * model->critical_step;
    TRY(check_steps(model));
    *out = model;
    model = NULL;
    return FRACAS_OK;
}

void fracas_model_destroy(fracas_model *model)
{
    if (!model) return;
    if (model->plan) model->formulation->plan_destroy(model->plan);
    fracas_surface_destroy(model->surface);
    free(model->table);
    free(model->sizes);
    free(model->notch);
    free(model);
}

size_t fracas_model_interfaces(const fracas_model *model)
{
    return model->interfaces;
}
size_t fracas_model_strengths_per_interface(const fracas_model *model)
{
    return model->strengths;
}
size_t fracas_model_elements(const fracas_model *model)
{
    return model->elements;
}
double fracas_model_element_size(const fracas_model *model)
{
    return model->element_size;
}
double fracas_model_bytes(const fracas_model *model)
{
    return (double)model->bytes;
}
double fracas_model_lane_bytes(const fracas_model *model)
{
    return (double)(model->formulation->state_size(model) * sizeof(double));
}
double fracas_model_time_step(const fracas_model *model)
{
    return model->time_step;
}

const fracas_surface *fracas_model_surface(const fracas_model *model)
{
    return model->surface;
}

size_t fracas_model_parts_most(const fracas_model *model)
{
    return model->formulation->parts_most ? model->formulation->parts_most(model) : 1;
}

double fracas_model_long_safety(const fracas_model *model)
{
    return model->formulation->safety;
}

int64_t fracas_model_steps(const fracas_model *model)
{
    return (int64_t)most_steps(model);
}

double fracas_model_interface_volume(const fracas_model *model, size_t interface)
{
    return model->formulation->interface_volume(model, interface);
}

double fracas_model_interface_area(const fracas_model *model, size_t interface)
{
    const fracas_geometry *geometry = &model->spec.geometry;
    if (!model->surface) return geometry->area;
    return fracas_surface_length(model->surface, model->surface->interface[interface].element[0],
                                 model->surface->interface[interface].edge[0]) *
           geometry->thickness;
}

double fracas_model_period(const fracas_model *model)
{
    const fracas_shape *shape = fracas_shape_of(&model->spec);
    return shape->period ? shape->period(&model->spec.geometry) : 0;
}

/* Ends of an edge and, of quadratic triangles, its middle; else its first end, without a share. */
static void edge_nodes(const fracas_surface *surface, size_t interface, const double *node[3])
{
    const size_t element = surface->interface[interface].element[0];
    const uint32_t edge = surface->interface[interface].edge[0];
    node[0] = fracas_surface_node(surface, element, edge);
    node[1] = fracas_surface_node(surface, element, (edge + 1) % 3);
    node[2] = surface->order == 2 ? fracas_surface_node(surface, element, 3 + edge) : node[0];
}

/* x = sum_a N_a(s_g) x_a  (grading.4) */
static void surface_positions(const fracas_surface *surface, size_t strengths,
                              double (*position)[3])
{
    static const double edge_point[2][FRACAS_EDGE_MOST] = {FRACAS_EDGE_POINTS_1,
                                                           FRACAS_EDGE_POINTS_2};
    for (size_t i = 0, k = 0; i < surface->ninterfaces; i++) {
        const double *node[3];
        edge_nodes(surface, i, node);
        for (size_t g = 0; g < strengths; g++, k++) {
            double shape[3] = {0.5, 0.5, 0}, spread[3];
            if (strengths > 1)
                fracas_edge_shape(surface->order, edge_point[surface->order - 1][g], shape, spread);
            if (surface->order == 1) shape[2] = 0;
            for (int j = 0; j < 3; j++)
                position[k][j] = shape[0] * node[0][j] + shape[1] * node[1][j] +
                                 shape[2] * node[2][j];
        }
    }
}

void fracas_model_interface_positions(const fracas_model *model, double (*position)[3])
{
    if (model->surface) surface_positions(model->surface, model->strengths, position);
    else model->formulation->interface_positions(model, position);
}

fracas_err fracas_model_check_strength(const fracas_model *model, double strength)
{
    if (strength > 0 && isfinite(strength))
        return model->formulation->check_strength(model, strength);
    return fracas_fail(
        FRACAS_USAGE,
        "strength of %g Pa; it must be positive and finite: check the section strength", strength);
}
