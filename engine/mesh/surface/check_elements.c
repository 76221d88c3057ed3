/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Faults of an element by itself. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <inttypes.h>
#include <math.h>

/* Squares of areas of such lengths neither overflow nor vanish. */
#define LARGEST_COORDINATE 1e50
#define LEAST_SHARE 1e-9 /* by the mean */

static const double *node_of(const fracas_surface_arrays *arrays, size_t element, size_t corner)
{
    return arrays->node[arrays->element[element * (size_t)(3 * arrays->order) + corner]];
}

static fracas_err check_sizes(const fracas_surface_arrays *arrays)
{
    if (arrays->order != 1 && arrays->order != 2)
        return fracas_fail(FRACAS_USAGE, "a surface has elements of order 1 or 2, not %d",
                           arrays->order);
    if (arrays->nelements == 0 || arrays->nelements > FRACAS_SURFACE_LARGEST)
        return fracas_fail(FRACAS_USAGE, "a surface has 1 to %zu triangles, not %zu",
                           FRACAS_SURFACE_LARGEST, arrays->nelements);
    if (arrays->nnodes > FRACAS_SURFACE_LARGEST)
        return fracas_fail(FRACAS_USAGE, "a surface has at most %zu nodes, not %zu",
                           FRACAS_SURFACE_LARGEST, arrays->nnodes);
    return FRACAS_OK;
}

/* Marks the nodes that elements name. */
static fracas_err check_names(const fracas_surface_arrays *arrays, bool *is_used)
{
    const size_t corners = (size_t)(3 * arrays->order);
    for (size_t e = 0; e < arrays->nelements; e++) {
        const uint32_t *node = arrays->element + corners * e;
        for (size_t k = 0; k < corners; k++) {
            if (node[k] >= arrays->nnodes)
                return fracas_fail(FRACAS_USAGE,
                                   "element %" PRId64 " names node %" PRIu32 ", but there are %zu",
                                   fracas_surface_element_name(arrays, e), node[k], arrays->nnodes);
            for (size_t j = 0; j < k; j++)
                if (node[j] == node[k])
                    return fracas_fail(FRACAS_USAGE,
                                       "element %" PRId64 " names node %" PRId64 " twice",
                                       fracas_surface_element_name(arrays, e),
                                       fracas_surface_node_name(arrays, node[k]));
            is_used[node[k]] = true;
        }
    }
    return FRACAS_OK;
}

static fracas_err check_nodes(const fracas_surface_arrays *arrays, const bool *is_used)
{
    for (size_t n = 0; n < arrays->nnodes; n++) {
        if (!is_used[n])
            return fracas_fail(FRACAS_USAGE, "node %" PRId64 " belongs to no element: leave it out",
                               fracas_surface_node_name(arrays, n));
        for (int i = 0; i < 3; i++)
            if (!(fabs(arrays->node[n][i]) <= LARGEST_COORDINATE))
                return fracas_fail(FRACAS_USAGE,
                                   "node %" PRId64
                                   " has the %c coordinate %g m: it should be a number up to %g m",
                                   fracas_surface_node_name(arrays, n), "xyz"[i],
                                   arrays -> node[n][i], LARGEST_COORDINATE);
    }
    return FRACAS_OK;
}

/* Twice the area of the flat triangle of the vertices. */
static double double_area(const fracas_surface_arrays *arrays, size_t e, double normal[3])
{
    fracas_surface_normal(node_of(arrays, e, 0), node_of(arrays, e, 1), node_of(arrays, e, 2),
                          normal);
    return sqrt(fracas_surface_dot(normal, normal));
}

static double distance(const double a[3], const double b[3])
{
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return sqrt(fracas_surface_dot(d, d));
}

static fracas_err check_shapes(const fracas_surface_arrays *arrays)
{
    double area = 0.0, edge = 0.0, normal[3];
    for (size_t e = 0; e < arrays->nelements; e++) {
        area += double_area(arrays, e, normal);
        for (size_t k = 0; k < 3; k++)
            edge += distance(node_of(arrays, e, k), node_of(arrays, e, (k + 1) % 3));
    }
    const double least_area = LEAST_SHARE * area / (double)arrays->nelements;
    const double least_edge = LEAST_SHARE * edge / (3.0 * (double)arrays->nelements);
    for (size_t e = 0; e < arrays->nelements; e++) {
        for (size_t k = 0; k < 3; k++) {
            const double length = distance(node_of(arrays, e, k), node_of(arrays, e, (k + 1) % 3));
            if (!(length > least_edge))
                return fracas_fail(
                    FRACAS_USAGE,
                    "element %" PRId64 " is degenerate: its edge %zu is %g m long, the mean %g m",
                    fracas_surface_element_name(arrays, e), k, length, least_edge / LEAST_SHARE);
        }
        const double own = double_area(arrays, e, normal);
        if (!(own > least_area))
            return fracas_fail(
                FRACAS_USAGE,
                "element %" PRId64 " is degenerate: its area is %g m2, the mean %g m2",
                fracas_surface_element_name(arrays, e), 0.5 * own, 0.5 * least_area / LEAST_SHARE);
    }
    return FRACAS_OK;
}

fracas_err fracas_surface_check_elements(const fracas_surface_arrays *arrays)
{
    TRY(check_sizes(arrays));
    OWNED bool *is_used = calloc(arrays->nnodes + 1, sizeof *is_used); /* 0 bytes may give NULL */
    if (!is_used) return fracas_no_memory("the nodes of a mesh");
    TRY(check_names(arrays, is_used));
    TRY(check_nodes(arrays, is_used));
    return check_shapes(arrays);
}

/* ---- curved elements ---- */

/* Control point of the quadratic element between vertices i and j; the vertex itself for i = j. */
static void control_point(const fracas_surface_arrays *arrays, size_t e, size_t i, size_t j,
                          double c[3])
{
    const double *a = node_of(arrays, e, i), *b = node_of(arrays, e, j);
    const double *m = node_of(arrays, e, (j == (i + 1) % 3 ? i : j) + 3);
    for (int k = 0; k < 3; k++) c[k] = i == j ? a[k] : 2.0 * m[k] - 0.5 * (a[k] + b[k]);
}

/* (meshes.2) The Jacobian along the flat normal is lambda' B lambda with the area coordinates
 * lambda; in shares of its value on the flat triangle. */
static void jacobian_form(const fracas_surface_arrays *arrays, size_t e, double b[3][3])
{
    double normal[3], u[3][3], v[3][3];
    const double flat = double_area(arrays, e, normal);
    for (size_t k = 0; k < 3; k++) {
        double c[3][3];
        for (size_t l = 0; l < 3; l++) control_point(arrays, e, k, l, c[l]);
        for (int i = 0; i < 3; i++) {
            u[k][i] = 2.0 * (c[1][i] - c[0][i]);
            v[k][i] = 2.0 * (c[2][i] - c[0][i]);
        }
    }
    static const double origin[3];
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++) {
            double kl[3], lk[3];
            fracas_surface_normal(origin, u[k], v[l], kl);
            fracas_surface_normal(origin, u[l], v[k], lk);
            b[k][l] = 0.5 * (fracas_surface_dot(kl, normal) + fracas_surface_dot(lk, normal)) /
                      (flat * flat);
        }
}

/* (meshes.3) Hadeler: lambda' B lambda > 0 for all lambda >= 0 but 0. */
static bool is_copositive(double b[3][3])
{
    if (!(b[0][0] > 0.0 && b[1][1] > 0.0 && b[2][2] > 0.0)) return false;
    const double r[3] = {sqrt(b[0][0]), sqrt(b[1][1]), sqrt(b[2][2])};
    const double p = b[0][1] + r[0] * r[1], q = b[1][2] + r[1] * r[2], s = b[2][0] + r[2] * r[0];
    if (!(p > 0.0 && q > 0.0 && s > 0.0)) return false;
    return r[0] * r[1] * r[2] + b[0][1] * r[2] + b[1][2] * r[0] + b[2][0] * r[1] +
               sqrt(2.0 * p * q * s) >
           0.0;
}

fracas_err fracas_surface_check_jacobians(const fracas_surface_arrays *arrays)
{
    for (size_t e = 0; e < arrays->nelements; e++) {
        double b[3][3];
        jacobian_form(arrays, e, b);
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++) b[k][l] -= LEAST_SHARE;
        if (!is_copositive(b))
            return fracas_fail(FRACAS_USAGE,
                               "element %" PRId64
                               " is folded: its Jacobian is not positive everywhere; move its "
                               "mid-side nodes to the middle",
                               fracas_surface_element_name(arrays, e));
    }
    return FRACAS_OK;
}
