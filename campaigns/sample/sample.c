/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/sample/sample.h"

#include "campaigns/plan/point_model.h"
#include "engine/mesh/surface/surface.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static fracas_err draw(const fracas_campaign *campaign, size_t point, fracas_sample *sample)
{
    TRY(fracas_realizer_init(campaign, point, &sample->realizer));
    const fracas_model *model = sample->realizer.model;
    const size_t interfaces = fracas_model_interfaces(model);
    sample->n = fracas_field_size(sample->realizer.field);
    sample->points = interfaces > 0 ? sample->n / interfaces : 1;
    sample->strength = malloc((sample->n + 1) * sizeof *sample->strength);
    sample->position = malloc((sample->n + 1) * sizeof *sample->position);
    if (!sample->strength || !sample->position)
        return fracas_no_memory("the strengths of a realization");
    for (size_t i = 0; i < interfaces; i++) {
        const fracas_extent one = fracas_model_extent(model, i);
        sample->extent.volume += one.volume / (double)interfaces;
        sample->extent.area += one.area / (double)interfaces;
    }
    fracas_model_interface_positions(model, sample->position);
    sample->error = fracas_field_error(sample->realizer.field);
    return fracas_realizer_sample(&sample->realizer, sample->replica, 1, sample->strength);
}

fracas_err fracas_sample_draw(const fracas_campaign *campaign, size_t point, int64_t replica,
                              fracas_sample *sample)
{
    *sample = (fracas_sample){.replica = replica};
    TRY(fracas_campaign_has(campaign, point));
    fracas_err err = draw(campaign, point, sample);
    if (!err) return FRACAS_OK;
    fracas_sample_clear(sample);
    return fracas_fail_within(err, "point %zu", point);
}

void fracas_sample_clear(fracas_sample *sample)
{
    fracas_realizer_clear(&sample->realizer);
    free(sample->strength);
    free(sample->position);
    *sample = (fracas_sample){0};
}

/* ---- files ---- */

void fracas_sample_write_csv(const fracas_sample *sample, FILE *out)
{
    fputs(FRACAS_SAMPLE_CSV, out);
    for (size_t k = 0; k < sample->n; k++) {
        const double *x = sample->position[k];
        fprintf(out, "%zu,%zu,%.12g,%.12g,%.12g,%.17g\n", k / sample->points, k % sample->points,
                x[0], x[1], x[2], sample->strength[k]);
    }
}

/* Cell types of VTK. */
enum { VTK_VERTEX = 1, VTK_LINE = 3 };

static void write_points(const double (*position)[3], size_t n, FILE *out)
{
    fprintf(out, "POINTS %zu double\n", n);
    for (size_t i = 0; i < n; i++)
        fprintf(out, "%.12g %.12g %.12g\n", position[i][0], position[i][1], position[i][2]);
}

static void write_types(size_t n, int type, FILE *out)
{
    fprintf(out, "CELL_TYPES %zu\n", n);
    for (size_t i = 0; i < n; i++) fprintf(out, "%d\n", type);
}

static void write_edges(const fracas_surface *surface, FILE *out)
{
    write_points(surface->node, surface->nnodes, out);
    fprintf(out, "CELLS %zu %zu\n", surface->ninterfaces, 3 * surface->ninterfaces);
    for (size_t i = 0; i < surface->ninterfaces; i++) {
        const fracas_surface_interface *interface = &surface->interface[i];
        const uint32_t *vertex = &surface->element[interface->element[0] * surface->corners];
        fprintf(out, "2 %" PRIu32 " %" PRIu32 "\n", vertex[interface->edge[0]],
                vertex[(interface->edge[0] + 1) % 3]);
    }
    write_types(surface->ninterfaces, VTK_LINE, out);
}

static void write_vertices(const fracas_sample *sample, FILE *out)
{
    write_points((const double(*)[3])sample->position, sample->n, out);
    fprintf(out, "CELLS %zu %zu\n", sample->n, 2 * sample->n);
    for (size_t k = 0; k < sample->n; k++) fprintf(out, "1 %zu\n", k);
    write_types(sample->n, VTK_VERTEX, out);
}

void fracas_sample_write_vtk(const fracas_sample *sample, FILE *out)
{
    const fracas_surface *surface = fracas_model_surface(sample->realizer.model);
    fprintf(out,
            FRACAS_SAMPLE_VTK "%s, point %zu, replica %" PRId64
                              "\nASCII\nDATASET UNSTRUCTURED_GRID\n",
            sample->realizer.campaign->name, sample->realizer.point, sample->replica);
    if (surface && sample->points == 1) write_edges(surface, out);
    else write_vertices(sample, out);
    fprintf(out, "CELL_DATA %zu\nSCALARS strength double 1\nLOOKUP_TABLE default\n", sample->n);
    for (size_t k = 0; k < sample->n; k++) fprintf(out, "%.17g\n", sample->strength[k]);
}
