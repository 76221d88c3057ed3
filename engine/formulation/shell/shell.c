/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell: linear Kirchhoff-Love kinematics on a surface of quadratic triangles
 * (docs/theory/shell.md). */
#include "engine/formulation/shell/shell.h"

#include "engine/element/triangle.h"
#include "engine/formulation/shell/geometry.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <string.h>

FRACAS_KERNEL_TABLE(const fracas_surface_kernel, fracas_shell);

static fracas_err check_order(const fracas_surface *surface)
{
    if (surface->order == 2) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "a shell's elements bend, which linear triangles cannot: make the mesh of quadratic ones "
        "(gmsh -order 2)");
}

/* As thick as its radius of curvature, at the edges of elements, it is no shell. */
static fracas_err check_thickness(const fracas_model *model)
{
    const fracas_surface_tables *t = model->plan;
    const double h = model->spec.geometry.thickness;
    double most = 0;
    for (size_t i = 0; i < t->ninterfaces; i++)
        for (int g = 0; g < SHELL_EDGE; g++) {
            const double *place = t->interface + i * SHELL_INTERFACE_TABLE + SHELL_POINTS +
                                  g * SHELL_POINT_TABLE;
            most = fmax(most, fmax(fabs(place[SHELL_L_NN]), fabs(place[SHELL_L_SS])));
        }
    if (most * h < 1) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "geometry.thickness is %g m, and the mid-surface has a radius of curvature of %g m: a "
        "shell is thin, a tenth of its radius and less: lower the thickness",
        h, 1 / most);
}

/* ---- tables ---- */

/* Coefficients of u,xixi, u,etaeta and u,xieta in the second derivatives along xx, yy, 2 xy, with
 * c[a][i] = phi^a . e_i  (shell.4). */
static void second_derivatives(double c[2][2], double of[3][3])
{
    for (int i = 0; i < 2; i++) {
        of[i][0] = c[0][i] * c[0][i];
        of[i][1] = c[1][i] * c[1][i];
        of[i][2] = 2 * c[0][i] * c[1][i];
    }
    of[2][0] = 2 * c[0][0] * c[0][1];
    of[2][1] = 2 * c[1][0] * c[1][1];
    of[2][2] = 2 * (c[0][0] * c[1][1] + c[0][1] * c[1][0]);
}

static void fill_bulk(const fracas_model *model, size_t e, double xi, double eta, double weight,
                      double *bulk)
{
    double c[2][2], of[3][3];
    fracas_shell_geometry here;
    fracas_shell_geometry_at(model->surface, e, xi, eta, &here);
    for (int a = 0; a < 2; a++) {
        c[a][0] = bulk[SURFACE_XI_X + 2 * a] = fracas_shell_dot(here.dual[a], here.x);
        c[a][1] = bulk[SURFACE_XI_Y + 2 * a] = fracas_shell_dot(here.dual[a], here.y);
    }
    for (int i = 0; i < 3; i++) {
        bulk[SHELL_X + i] = here.x[i];
        bulk[SHELL_Y + i] = here.y[i];
        bulk[SHELL_T + i] = here.normal[i];
    }
    second_derivatives(c, of);
    for (int ij = 0; ij < 3; ij++)
        for (int b = 0; b < 3; b++) {
            bulk[SHELL_SECOND + 3 * ij + b] = -of[ij][b];
            for (int a = 0; a < 2; a++) { /* Christoffel's symbols G^a_b */
                double *first = &bulk[SHELL_FIRST + 2 * ij + a];
                *first = (b ? *first : 0) +
                         of[ij][b] * fracas_shell_dot(here.second[b], here.dual[a]);
            }
        }
    bulk[SURFACE_WEIGHT] = weight * here.area;
}

/* One side of an edge at a point where the edge runs along `tangent`: its normal in the surface, n
 * = s x t, comes back. */
static void fill_side(const fracas_shell_geometry *at, const double tangent[3], double sign,
                      double share, double *side, double normal[3])
{
    fracas_shell_cross(tangent, at->normal, normal);
    const double nx = fracas_shell_dot(normal, at->x), ny = fracas_shell_dot(normal, at->y);
    side[SHELL_SQUARE_X] = share * nx * nx;
    side[SHELL_SQUARE_Y] = share * ny * ny;
    side[SHELL_PRODUCT] = share * nx * ny;
    const double along[2] = {fracas_shell_dot(normal, at->dual[0]),
                             fracas_shell_dot(normal, at->dual[1])};
    for (int k = 0; k < SHELL_NODES; k++)
        side[SHELL_SLOPE + k] = along[0] * at->slope[k][0] + along[1] * at->slope[k][1];
    for (int i = 0; i < 3; i++) side[SHELL_TURN + i] = sign * at->normal[i];
}

/* L_ij = -t . d_i d_j phi of directions a, b in the surface  (shell.3) */
static double curvature(const fracas_shell_geometry *at, const double a[3], const double b[3])
{
    const double ax = fracas_shell_dot(a, at->dual[0]), ay = fracas_shell_dot(a, at->dual[1]);
    const double bx = fracas_shell_dot(b, at->dual[0]), by = fracas_shell_dot(b, at->dual[1]);
    return -(ax * bx * fracas_shell_dot(at->normal, at->second[0]) +
             ay * by * fracas_shell_dot(at->normal, at->second[1]) +
             (ax * by + ay * bx) * fracas_shell_dot(at->normal, at->second[2]));
}

static void fill_point(const fracas_model *model, const fracas_surface_interface *interface,
                       double s, double weight, double *point)
{
    fracas_shell_geometry at[2];
    double tangent[3], normal[2][3], speed = 0;
    for (int side = 0; side < 2; side++) {
        double xi, eta;
        fracas_shell_edge_point(interface->edge[side], side ? 1 - s : s, &xi, &eta);
        fracas_shell_geometry_at(model->surface, interface->element[side], xi, eta, &at[side]);
        if (side == 0) speed = fracas_shell_edge_tangent(&at[0], interface->edge[0], tangent);
        fill_side(&at[side], tangent, side ? -1 : 1, 0.5, point + SHELL_SIDES + side * SHELL_SIDE,
                  normal[side]);
    }
    double *lift = point + SHELL_LIFT, length = 0;
    for (int i = 0; i < 3; i++) lift[i] = at[0].normal[i] + at[1].normal[i];
    length = sqrt(fracas_shell_dot(lift, lift));
    for (int i = 0; i < 3; i++) {
        lift[i] /= length;
        point[SHELL_S + i] = tangent[i];
    }
    fracas_shell_cross(tangent, lift, point + SHELL_N);
    point[SHELL_PER_SPEED] = 1.0 / speed;
    point[SHELL_LENGTH] = weight * speed;
    point[SHELL_L_NN] = 0.5 * (curvature(&at[0], normal[0], normal[0]) +
                               curvature(&at[1], normal[1], normal[1]));
    point[SHELL_L_NS] = 0.5 * (curvature(&at[0], normal[0], tangent) +
                               curvature(&at[1], normal[1], tangent));
    point[SHELL_L_SS] = 0.5 *
                        (curvature(&at[0], tangent, tangent) + curvature(&at[1], tangent, tangent));
}

/* (membrane.5), (shell.7) */
static void fill_head(const fracas_model *model, double inverse_size, double *head)
{
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, young = spec->material.young;
    head[SURFACE_STIFFNESS] = spec->cohesive.beta * young / (1 - nu * nu) * inverse_size;
    head[SHELL_SHEARING] = spec->cohesive.beta_shear * young / (2 * (1 + nu)) *
                           spec->geometry.thickness * inverse_size;
}

/* (shell.16) */
static void fill_rotary(const fracas_model *model, size_t e, double t[3], double *rotary)
{
    static const double at[SHELL_BULK][2] = FRACAS_TRIANGLE_POINTS_2;
    const double h = model->spec.geometry.thickness,
                 inertia = model->spec.material.density * h * h * h / 12;
    fracas_shell_geometry here;
    fracas_shell_geometry_at(model->surface, e, 1.0 / 3, 1.0 / 3, &here);
    for (int i = 0; i < 3; i++) t[i] = here.normal[i];
    for (int g = 0; g < SHELL_BULK; g++) {
        double slope[SHELL_NODES][3];
        fracas_shell_geometry_at(model->surface, e, at[g][0], at[g][1], &here);
        for (int k = 0; k < SHELL_NODES; k++)
            for (int i = 0; i < 3; i++)
                slope[k][i] = here.slope[k][0] * here.dual[0][i] +
                              here.slope[k][1] * here.dual[1][i];
        for (int k = 0; k < SHELL_NODES; k++)
            for (int l = 0; l <= k; l++) {
                double *entry = &rotary[fracas_surface_entry(k, l)];
                *entry = (g ? *entry : 0) +
                         inertia * here.area / 6 * fracas_shell_dot(slope[k], slope[l]);
            }
    }
}

/* ---- edges ---- */

/* The director's turn about the edge has twice the stiffness of an interface's: the other side is
 * its mirror image  (shell.9) */
static void fill_rim(const fracas_model *model, const fracas_surface_border *border, double *rim)
{
    static const double edge_point[3] = FRACAS_EDGE_POINTS_2, weight[3] = FRACAS_EDGE_WEIGHTS_2;
    const fracas_spec *spec = &model->spec;
    const double nu = spec->material.poisson, h = spec->geometry.thickness,
                 modulus = spec->material.young / (1 - nu * nu);
    const double length = fracas_surface_length(model->surface, border->element, border->edge);
    rim[SHELL_RIM_STIFFNESS] = 2 * spec->cohesive.beta * modulus * (h * h * h / 12) * length /
                               model->surface->area[border->element];
    for (int g = 0; g < SHELL_EDGE; g++) {
        double xi, eta, tangent[3], normal[3],
            *point = rim + SHELL_RIM_POINTS + g * SHELL_RIM_POINT_TABLE;
        fracas_shell_geometry at;
        fracas_shell_edge_point(border->edge, edge_point[g], &xi, &eta);
        fracas_shell_geometry_at(model->surface, border->element, xi, eta, &at);
        point[SHELL_RIM_LENGTH] = weight[g] * fracas_shell_edge_tangent(&at, border->edge, tangent);
        fill_side(&at, tangent, 1, 1, point + SHELL_RIM_SIDE, normal);
    }
}

static unsigned axis_of(const fracas_surface *surface, const fracas_surface_border *border,
                        double least)
{
    double xi, eta, tangent[3], normal[3];
    fracas_shell_geometry at;
    fracas_shell_edge_point(border->edge, 0.5, &xi, &eta);
    fracas_shell_geometry_at(surface, border->element, xi, eta, &at);
    const double speed = fracas_shell_edge_tangent(&at, border->edge, tangent);
    fracas_shell_cross(tangent, at.normal, normal);
    const size_t e = border->element, k = border->edge;
    const double *a = fracas_surface_node(surface, e, k),
                 *b = fracas_surface_node(surface, e, (k + 1) % 3),
                 *c = fracas_surface_node(surface, e, 3 + k);
    int axis = 3;
    for (int i = 0; i < 3; i++) {
        const bool is_in_plane = fmax(fabs(b[i] - a[i]), fabs(c[i] - a[i])) <= 1e-9 * speed;
        if (is_in_plane && fabs(normal[i]) >= least &&
            (axis == 3 || fabs(normal[i]) > fabs(normal[axis])))
            axis = i;
    }
    return axis < 3 ? 1u << axis : 0;
}

/* ---- the body ---- */

static void add_node(const fracas_surface_tables *t, size_t e, size_t k, const double (*x)[3],
                     const double (*v)[3], fracas_fragment_sums *sums)
{
    fracas_fragment_sums_add(sums, t->lumped[(2 * e + 1) * SHELL_NODES + k], x[k], v[k]);
}

/* r_xx x x + r_yy y y + r_xy (x y + y x), of n and of m. */
static void turn_stress(const double *bulk, const double *stress, double *tensor)
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    const double *x = bulk + SHELL_X, *y = bulk + SHELL_Y;
    for (const double *r = stress; r < stress + 6; r += 3, tensor += 6)
        for (int p = 0; p < 6; p++) {
            const int i = pair[p][0], j = pair[p][1];
            tensor[p] = r[0] * x[i] * x[j] + r[1] * y[i] * y[j] +
                        r[2] * (x[i] * y[j] + y[i] * x[j]);
        }
}

static void normal_at(const double *point, double normal[3])
{
    memcpy(normal, point + SHELL_N, 3 * sizeof *normal);
}

static const double layer[] = SHELL_LAYER_WEIGHTS;
static const fracas_surface_body body = {.dimension = 3,
                                         .stresses = 6,
                                         .layers = SHELL_LAYERS,
                                         .layer = layer,
                                         .resultants = true,
                                         .bulk_table = SHELL_BULK_TABLE,
                                         .head = SHELL_POINTS,
                                         .point_table = SHELL_POINT_TABLE,
                                         .rim_table = SHELL_RIM_TABLE,
                                         .kernels = &fracas_shell,
                                         .check_mesh = check_order,
                                         .check_tables = check_thickness,
                                         .fill_bulk = fill_bulk,
                                         .fill_head = fill_head,
                                         .fill_point = fill_point,
                                         .fill_rim = fill_rim,
                                         .fill_rotary = fill_rotary,
                                         .edge_axis = axis_of,
                                         .turn_stress = turn_stress,
                                         .normal = normal_at,
                                         .add_node = add_node};

static const fracas_kind *const goes_with[] = {
    &fracas_shape_sphere,      &fracas_shape_plate,   &fracas_shape_annulus,
    &fracas_shape_cylinder,    &fracas_shape_file,    &fracas_shape_capsule,
    &fracas_spacing_triangles, &fracas_spacing_given, &fracas_loading_expansion};
const fracas_formulation fracas_formulation_shell = {
    .kind = {.name = "shell",
             .groups = FRACAS_GROUP_SHELL,
             .doc = "a thin shell or plate that stretches and bends, of triangles in space",
             FRACAS_GOES_WITH(goes_with),
             .traits = &body},
    .safety = 0.5,
    .stress = {{"N", 6}, {"M", 6}},
    FRACAS_SURFACE_FORMULATION};
