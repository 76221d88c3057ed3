/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/body.h"

#include "analysis/data/columns.h"

#include <math.h>
#include <string.h>

static bool text_is(const fracas_point_table *table, size_t point, const char *path,
                    const char *text)
{
    const size_t column = fracas_point_table_find(table, path);
    return column != SIZE_MAX && !strcmp(table->point[point].value[column].text, text);
}

fracas_body fracas_body_of(const fracas_point_table *table, size_t point)
{
    const double opening = fracas_columns_real(table, point, "cohesive.critical_opening"),
                 strength = fracas_columns_real(table, point, "derived.strength_mean"),
                 elements = fracas_columns_real(table, point, "mesh.elements");
    fracas_body body = {
        .surface = isfinite(fracas_columns_real(table, point, "geometry.thickness")),
        .length = fracas_columns_real(table, point, "geometry.length"),
        .radius = text_is(table, point, "model", "ring")
                      ? fracas_columns_real(table, point, "geometry.radius")
                      : NAN,
        .fracture_energy = opening > 0
                               ? 0.5 * opening * strength
                               : fracas_columns_real(table, point, "cohesive.fracture_energy"),
    };
    if (body.radius > 0) body.length = 2 * M_PI * body.radius;
    const bool graded = fracas_point_table_find(table, "mesh.spacing") != SIZE_MAX &&
                        !text_is(table, point, "mesh.spacing", "uniform");
    if (!graded && !body.surface && body.length > 0 && elements > 0)
        body.lattice = body.length / elements;
    return body;
}
