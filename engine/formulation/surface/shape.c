/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of a surface's fragments: matter over its middle surface and its thickness, cracks. */
#include "engine/formulation/surface/surface.h"

#include <math.h>
#include <string.h>

/* A rule that is exact for second moments of triangles with straight edges: of order 1 the bulk
 * points of order 2. */
typedef struct {
    size_t points, nodes;
    double weight[FRACAS_TRIANGLE_FINE], value[FRACAS_TRIANGLE_FINE][6],
        slope[FRACAS_TRIANGLE_FINE][6][2];
} rule;

static void make_rule(int order, rule *r)
{
    static const double few[3][2] = FRACAS_TRIANGLE_POINTS_2;
    r->nodes = (size_t)SURFACE_NODES(order);
    r->points = order == 1 ? 3 : FRACAS_TRIANGLE_FINE;
    for (size_t g = 0; g < r->points; g++) {
        const double *at = order == 1 ? few[g] : fracas_triangle_fine[g];
        r->weight[g] = order == 1 ? 1.0 / 6 : fracas_triangle_fine[g][2];
        fracas_triangle_shape(order, at[0], at[1], r->value[g], r->slope[g]);
    }
}

/* n = dx/dxi x dx/deta at point g of an element with these nodes; returns |n| [m2]. */
static double normal_at(const rule *r, size_t g, const double (*x)[3], double n[3])
{
    double tangent[2][3] = {{0}};
    for (size_t k = 0; k < r->nodes; k++)
        for (int i = 0; i < 3; i++)
            for (int a = 0; a < 2; a++) tangent[a][i] += r->slope[g][k][a] * x[k][i];
    double square = 0;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = tangent[0][j] * tangent[1][k] - tangent[0][k] * tangent[1][j];
        square += n[i] * n[i];
    }
    return sqrt(square);
}

/* An element with nodes `start` before any motion and x now. A plate of thickness h has the second
 * moment m h^2/12 along its normal. */
static void add_element(const rule *r, const double (*start)[3], const double (*x)[3],
                        const fracas_spec *spec, fracas_fragment_matter *matter)
{
    const double h = spec->geometry.thickness;
    for (size_t g = 0; g < r->points; g++) {
        double normal[3], at[3] = {0}, spread[6];
        const double mass = spec->material.density * h * r->weight[g] *
                            normal_at(r, g, start, normal),
                     length = normal_at(r, g, x, normal);
        for (int i = 0; i < 3; i++) {
            normal[i] /= length;
            for (size_t k = 0; k < r->nodes; k++) at[i] += r->value[g][k] * x[k][i];
        }
        fracas_fragment_spread(normal, mass * h * h / 12, 0, spread);
        fracas_fragment_matter_add(matter, mass, at, spread);
    }
}

void fracas_surface_add_matter(const fracas_model *model, const fracas_step *step, int lane,
                               const uint32_t *element, size_t count,
                               fracas_fragment_matter *matter, double (*node)[3])
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const size_t dimension = (size_t)c.tables->body->dimension,
                 fields = fracas_surface_element_fields(&c);
    rule r;
    make_rule(c.tables->order, &r);
    for (size_t n = 0; n < count; n++, node += r.nodes) {
        double start[6][3];
        for (size_t k = 0; k < r.nodes; k++) {
            memcpy(start[k], fracas_surface_node(model->surface, element[n], k), sizeof start[k]);
            memcpy(node[k], start[k], sizeof start[k]);
            for (size_t i = 0; i < dimension; i++)
                node[k][i] += *fracas_surface_field(step, element[n] * fields + dimension * k + i,
                                                    lane); /* SURFACE_U is first */
        }
        add_element(&r, (const double(*)[3])start, (const double(*)[3])node, &model->spec, matter);
    }
}

void fracas_surface_add_cracks(const fracas_model *model, const fracas_step *step, int lane,
                               fracas_fragment *fragment)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    for (size_t i = 0; i < model->interfaces; i++) {
        const fracas_surface_interface *of = &model->surface->interface[i];
        if (!fracas_surface_is_broken(&c, step, i, lane)) continue;
        const double area = c.thickness *
                            fracas_surface_length(model->surface, of->element[0], of->edge[0]);
        for (int side = 0; side < 2; side++)
            fragment[step->partition.label[of->element[side]]].crack_area += area;
    }
}

size_t fracas_surface_element_nodes(const fracas_model *model)
{
    return model->surface->corners;
}
