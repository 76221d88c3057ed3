/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The membrane: plane stress on a flat surface of triangles (docs/theory/membrane.md). */
#include "engine/formulation/surface/membrane.h"

#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <string.h>

FRACAS_KERNEL_TABLE(const fracas_surface_kernel, fracas_membrane);

static fracas_err check_flat(const fracas_surface *surface)
{
    for (size_t n = 0; n < surface->nnodes; n++)
        if (surface->node[n][2] != surface->node[0][2])
            return fracas_fail(FRACAS_USAGE,
                               "a membrane is flat, but the mesh has nodes at z = %g and %g m: its "
                               "elements must lie in a plane z = const: turn the body into one "
                               "(Gmsh: Rotate), or give model: shell",
                               surface->node[0][2], surface->node[n][2]);
    return FRACAS_OK;
}

/* ---- tables ---- */

/* Coordinates of the nodes of an element in the plane. */
static void nodes_of(const fracas_surface *surface, size_t e, double (*x)[2])
{
    for (size_t k = 0; k < surface->corners; k++)
        for (int i = 0; i < 2; i++) x[k][i] = fracas_surface_node(surface, e, k)[i];
}

static void fill_bulk(const fracas_model *model, size_t e, double xi, double eta, double weight,
                      double *bulk)
{
    double x[6][2], shape[6], derivative[6][2], j[2][2] = {{0}}; /* d(x, y)/d(xi, eta) */
    nodes_of(model->surface, e, x);
    fracas_triangle_shape(model->surface->order, xi, eta, shape, derivative);
    for (int i = 0; i < 2; i++)
        for (int a = 0; a < 2; a++)
            for (size_t k = 0; k < model->surface->corners; k++)
                j[i][a] += x[k][i] * derivative[k][a];
    const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
    bulk[SURFACE_XI_X] = j[1][1] / det;
    bulk[SURFACE_XI_Y] = -j[0][1] / det;
    bulk[SURFACE_ETA_X] = -j[1][0] / det;
    bulk[SURFACE_ETA_Y] = j[0][0] / det;
    bulk[SURFACE_WEIGHT] = weight * det * model->spec.geometry.thickness;
}

/* K = beta E/(1 - nu^2)/h_s  (membrane.5) */
static void fill_head(const fracas_model *model, double inverse_size, double *head)
{
    const double nu = model->spec.material.poisson,
                 modulus = model->spec.material.young / (1 - nu * nu);
    head[SURFACE_STIFFNESS] = model->spec.cohesive.beta * modulus * inverse_size;
}

static void fill_point(const fracas_model *model, const fracas_surface_interface *interface,
                       double s, double weight, double *point)
{
    const uint32_t k = interface->edge[0];
    double x[6][2], slope[3], tangent[2]; /* dx/ds */
    nodes_of(model->surface, interface->element[0], x);
    fracas_edge_slope(s, slope);
    for (int i = 0; i < 2; i++) {
        const double a = x[k][i], b = x[(k + 1) % 3][i];
        tangent[i] = model->surface->order == 2
                         ? slope[0] * a + slope[1] * b + slope[2] * x[3 + k][i]
                         : b - a;
    }
    const double speed = sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
    point[MEMBRANE_NX] = tangent[1] / speed;
    point[MEMBRANE_NY] = -tangent[0] / speed;
    point[MEMBRANE_AREA] = weight * speed * model->spec.geometry.thickness;
}

/* Edges along an axis meet their plane at a right angle. */
static unsigned axis_of(const fracas_surface *surface, const fracas_surface_border *border,
                        double least)
{
    double x[6][2];
    nodes_of(surface, border->element, x);
    const double *a = x[border->edge], *b = x[(border->edge + 1) % 3], dx = fabs(b[0] - a[0]),
                 dy = fabs(b[1] - a[1]);
    (void)least;
    if (fmin(dx, dy) > 1e-9 * fmax(dx, dy)) return 0;
    return dy > dx ? 1 : 2;
}

/* ---- the body ---- */

/* By the element's own masses: lumped ones would give quadratic elements another momentum, which
 * is not kept. */
static void add_node(const fracas_surface_tables *t, size_t e, size_t k, const double (*x)[3],
                     const double (*v)[3], fracas_fragment_sums *sums)
{
    double mass = 0, carried[3] = {0}, momentum[3] = {0};
    for (size_t l = 0; l < (size_t)SURFACE_NODES(t->order); l++) {
        const double share = fracas_surface_mass(t, e, k, l);
        mass += share;
        for (size_t i = 0; i < 2; i++) {
            carried[i] += share * x[l][i];
            momentum[i] += share * v[l][i];
        }
    }
    fracas_fragment_sums_add_coupled(sums, mass, x[k], v[k], carried, momentum);
}

static void turn_stress(const double *bulk, const double *stress, double *tensor)
{
    (void)bulk;
    memcpy(tensor, (double[6]){stress[0], stress[1], 0, stress[2]}, 6 * sizeof *tensor);
}

static void normal_at(const double *point, double normal[3])
{
    memcpy(normal, (double[3]){point[MEMBRANE_NX], point[MEMBRANE_NY]}, 3 * sizeof *normal);
}

static const double layer[] = {1.0};
static const fracas_surface_body body = {.dimension = 2,
                                         .stresses = 3,
                                         .layers = 1,
                                         .layer = layer,
                                         .bulk_table = SURFACE_BULK_HEAD,
                                         .head = SURFACE_HEAD,
                                         .point_table = MEMBRANE_POINT_TABLE,
                                         .kernels = &fracas_membrane,
                                         .check_mesh = check_flat,
                                         .fill_bulk = fill_bulk,
                                         .fill_head = fill_head,
                                         .fill_point = fill_point,
                                         .edge_axis = axis_of,
                                         .turn_stress = turn_stress,
                                         .normal = normal_at,
                                         .add_node = add_node};

static const fracas_kind *const goes_with[] = {
    &fracas_shape_plate,        &fracas_shape_annulus, &fracas_shape_file,
    &fracas_spacing_triangles,  &fracas_spacing_given, &fracas_loading_expansion,
    &fracas_loading_centrifugal};
const fracas_formulation fracas_formulation_membrane = {
    .kind = {.name = "membrane",
             .groups = FRACAS_GROUP_MEMBRANE,
             .doc = "a plate in plane stress, of triangles in its plane",
             FRACAS_GOES_WITH(goes_with),
             .traits = &body},
    .safety = 0.25,
    .flat = true,
    .stress = {{"stress", 6}},
    FRACAS_SURFACE_FORMULATION};
