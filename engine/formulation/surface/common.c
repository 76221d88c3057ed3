/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/common.h"

#include "engine/cohesive/law.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/surface/surface.h"

#include <math.h>
#include <stdlib.h>

fracas_err fracas_surface_check_noise(const fracas_mesh *mesh)
{
    if (mesh->noise || mesh->spacing != &fracas_spacing_triangles || mesh->amplitude == 0)
        return FRACAS_OK;
    return fracas_fail(FRACAS_BUG, "a perturbed mesh without random numbers");
}

/* The operator is positive from 1.15 (linear) and 2.25 (quadratic) on, measured on meshes distorted
 * by up to 30 %, nu up to 0.49: tests/verification/test_membrane_patch.c. Bending needs less. */
fracas_err fracas_surface_check_beta(const fracas_model *model)
{
    const double least = model->surface->order == 2 ? 2.3 : 1.3;
    if (model->spec.cohesive.beta >= least) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "cohesive.beta is %g, too soft for %s triangles: give %g or more; twice as much is usual",
        model->spec.cohesive.beta, model->surface->order == 2 ? "quadratic" : "linear", least);
}

fracas_err fracas_surface_check_motion(const fracas_model *model, bool held)
{
    const fracas_loading *loading = &model->spec.loading;
    if (loading->type != &fracas_loading_expansion || loading->start != &fracas_start_rest || held)
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "loading.start is rest, and all edges are free: nothing would "
                                     "ever move; let an edge be held, or start moving");
}

/* K >= 2 sigma_c/delta_c at the softest interface: twice the least stiffness of a linear law
 * (cohesive.7), so that no peak as small as the strength is cut  (cohesive.13) */
fracas_err fracas_surface_check_strength(const fracas_model *model, double strength)
{
    const fracas_spec *spec = &model->spec;
    if (!(strength > 0) || !isfinite(strength))
        return fracas_fail(
            FRACAS_USAGE,
            "strength of %g Pa; it must be positive and finite: check the section strength",
            strength);
    const double nu = spec->material.poisson, modulus = spec->material.young / (1 - nu * nu);
    const fracas_law *law = fracas_law_of(spec);
    const double most = spec->cohesive.beta * modulus *
                        fracas_spec_fracture_energy(spec, strength) /
                        (strength * strength * (law->flux ? law->steepest : 1));
    if (!law->flux || (isfinite(most) && model->longest <= most)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "strength %g Pa needs elements of which area/edge is below %.4g m, the "
                       "largest is %.4g m: refine the mesh %.3g times (or raise cohesive.beta)",
                       strength, most, model->longest, ceil(100 * model->longest / most) / 100);
}

/* A third of its two elements. */
double fracas_surface_interface_volume(const fracas_model *model, size_t i)
{
    const fracas_surface_interface *interface = &model->surface->interface[i];
    double area = 0;
    for (int side = 0; side < 2; side++)
        area += fracas_surface_area(model->surface, interface->element[side]);
    return model->spec.geometry.thickness * (area / 3);
}

double fracas_surface_inverse_size(const fracas_surface *surface, size_t i)
{
    const fracas_surface_interface *interface = &surface->interface[i];
    const double length = fracas_surface_length(surface, interface->element[0], interface->edge[0]);
    double inverse_size = 0;
    for (int side = 0; side < 2; side++)
        inverse_size += 0.5 * length / fracas_surface_area(surface, interface->element[side]);
    return inverse_size;
}

void fracas_surface_measure_model(fracas_model *model)
{
    const fracas_surface *surface = model->surface;
    double length = 0;
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        length += fracas_surface_length(surface, surface->interface[i].element[0],
                                        surface->interface[i].edge[0]);
        model->longest = fmax(model->longest, 1.0 / fracas_surface_inverse_size(surface, i));
    }
    model->element_size =
        surface->ninterfaces
            ? length / (double)surface->ninterfaces
            : sqrt(model->mass / (model->spec.material.density * model->spec.geometry.thickness));
}

double fracas_surface_start_velocity(const fracas_loading *loading, const double *x, int i,
                                     bool held, bool fixed)
{
    if (held && fixed) return 0;
    if (loading->type != &fracas_loading_expansion ||
        (loading->start == &fracas_start_rest && !held))
        return 0;
    return (i == 1 ? loading->ratio : 1.0) * loading->rate * x[i];
}

/* Labels which elements hang together; the number of fragments. */
static size_t partition(const fracas_model *model, fracas_step *step, int lane,
                        fracas_surface_damage *damage)
{
    fracas_partition_reset(&step->partition);
    for (size_t i = 0; i < model->interfaces; i++) {
        const uint32_t *element = model->surface->interface[i].element;
        if (damage(model, step, i, lane) < 1.0)
            fracas_partition_join(&step->partition, element[0], element[1]);
    }
    return fracas_partition_label(&step->partition);
}

int64_t fracas_surface_fragment_count(const fracas_model *model, fracas_step *step, int lane,
                                      fracas_surface_damage *damage)
{
    return step->broken[lane] == 0 ? 1 : (int64_t)partition(model, step, lane, damage);
}

/* The least of an interface's strengths. */
static double weakest_of(const double *strength, size_t stride, size_t strengths)
{
    double least = strength[0];
    for (size_t g = 1; g < strengths; g++) least = fmin(least, strength[g * stride]);
    return least;
}

static fracas_err harvest_interfaces(const fracas_model *model, const fracas_step *step, int lane,
                                     fracas_surface_damage *damage, fracas_record *record)
{
    size_t stride;
    const double *strength = model->formulation->strength(model, step, lane, &stride);
    record->interface = calloc(model->interfaces ? model->interfaces : 1,
                               sizeof *record->interface);
    if (!record->interface) return fracas_no_memory("the interfaces of a realization");
    record->ninterface = model->interfaces;
    for (size_t i = 0; i < model->interfaces; i++) {
        const size_t at = i * (size_t)step->width + (size_t)lane;
        const double weakest = weakest_of(strength + i * model->strengths * stride, stride,
                                          model->strengths);
        record->interface[i] = (fracas_interface_row){.strength = weakest,
                                                      .damage = damage(model, step, i, lane),
                                                      .onset_time = step->onset_time[at],
                                                      .break_time = step->break_time[at]};
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_harvest(const fracas_model *model, fracas_step *step, int lane,
                                  fracas_surface_damage *damage, fracas_surface_add_element *add,
                                  fracas_record *record)
{
    const size_t count = partition(model, step, lane, damage);
    const double surface_density = model->spec.material.density * model->spec.geometry.thickness;
    fracas_fragment_sums *sums = calloc(count, sizeof *sums);
    if (!sums) return fracas_no_memory("the fragments of a realization");
    for (size_t e = 0; e < model->elements; e++) {
        fracas_fragment_sums *f = &sums[step->partition.label[e]];
        f->elements++;
        add(model, step, lane, e, f);
    }
    for (size_t f = 0; f < count; f++) sums[f].size = sqrt(sums[f].mass / surface_density);
    fracas_err err = fracas_fragments_take(sums, count, 2, record);
    free(sums);
    TRY(err);
    return step->onset_time ? harvest_interfaces(model, step, lane, damage, record) : FRACAS_OK;
}
