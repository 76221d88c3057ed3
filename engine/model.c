#include "engine/formulation/formulation.h"

#include "engine/cohesive/law.h"
#include "engine/mesh/body.h"
#include "engine/mesh/surface/surface.h"

#include <math.h>
#include <stdlib.h>

#define MOST_STEPS 1e12 /* years of computing, for a bar of two elements */

/* Steps to time.end, at most: stershic refines its time step twice. */
static double most_steps(const fracas_model *model)
{
    const fracas_cohesive *cohesive = &model->spec.cohesive;
    const double finest = cohesive->law == &fracas_law_stershic ? cohesive->refinement * cohesive->refinement : 1.0;
    return ceil(model->spec.time.end / (finest * model->time_step));
}

static fracas_err check_steps(const fracas_model *model)
{
    const double step = model->time_step, end = model->spec.time.end;
    if (!(step > 0 && isfinite(step)))
        return fracas_fail(FRACAS_USAGE, "time step %g s: check material, mesh and time.safety", step);
    if (end / step > MOST_STEPS)
        return fracas_fail(FRACAS_USAGE, "time.end %g s is %.3g time steps of %.3g s; %g are allowed", end, end / step, step,
                           MOST_STEPS);
    if (most_steps(model) <= MOST_STEPS) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "time.end %g s is %.3g of the finest time steps, refined twice by cohesive.refinement %g; %g are "
                       "allowed: raise cohesive.refinement", end, most_steps(model), model->spec.cohesive.refinement, MOST_STEPS);
}

fracas_err fracas_model_create(const fracas_spec *spec, fracas_model **out)
{
    fracas_model *model = calloc(1, sizeof *model);
    if (!model) return fracas_no_memory("a model");
    model->spec = *spec;
    model->formulation = (const fracas_formulation *)(const void *)spec->formulation; /* .kind is its first member */
    fracas_err code = model->formulation->model_init(model);
    model->spec.mesh.noise = NULL; /* the caller's, and done with, as is a file */
    model->spec.geometry.file = NULL;
    model->time_step = spec->time.safety * model->critical_step;
    if (!code) code = check_steps(model);
    if (code) {
        fracas_model_destroy(model);
        return code;
    }
    *out = model;
    return FRACAS_OK;
}

void fracas_model_destroy(fracas_model *model)
{
    if (!model) return;
    if (model->plan) model->formulation->plan_destroy(model->plan);
    fracas_surface_destroy(model->surface);
    free(model->table);
    free(model);
}

size_t fracas_model_interfaces(const fracas_model *model) { return model->interfaces; }
size_t fracas_model_elements(const fracas_model *model) { return model->elements; }
double fracas_model_element_size(const fracas_model *model) { return model->element_size; }
double fracas_model_critical_time_step(const fracas_model *model) { return model->critical_step; }
double fracas_model_time_step(const fracas_model *model) { return model->time_step; }

const fracas_surface *fracas_model_surface(const fracas_model *model) { return model->surface; }

int64_t fracas_model_steps(const fracas_model *model) { return (int64_t)most_steps(model); }

double fracas_model_interface_volume(const fracas_model *model, size_t interface)
{
    return model->formulation->interface_volume(model, interface);
}

double fracas_model_interface_area(const fracas_model *model, size_t interface)
{
    const fracas_geometry *geometry = &model->spec.geometry;
    if (!model->surface) return geometry->area;
    return fracas_surface_length(model->surface, model->surface->interface[interface].element[0], model->surface->interface[interface].edge[0]) *
           geometry->thickness;
}

double fracas_model_period(const fracas_model *model)
{
    const fracas_geometry *geometry = &model->spec.geometry;
    return geometry->ends == &fracas_ends_periodic ? geometry->length : 0;
}

static void surface_positions(const fracas_surface *surface, double (*position)[3])
{
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const fracas_surface_interface *interface = &surface->interface[i];
        const uint32_t *vertex = &surface->element[interface->element[0] * surface->corners];
        const double *a = surface->node[vertex[interface->edge[0]]], *b = surface->node[vertex[(interface->edge[0] + 1) % 3]];
        for (int k = 0; k < 3; k++) position[i][k] = 0.5 * (a[k] + b[k]);
    }
}

void fracas_model_interface_positions(const fracas_model *model, double (*position)[3])
{
    if (model->surface) surface_positions(model->surface, position);
    else model->formulation->interface_positions(model, position);
}

fracas_err fracas_model_check_strength(const fracas_model *model, double strength)
{
    return model->formulation->check_strength(model, strength);
}
