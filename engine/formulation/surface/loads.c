/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/loads.h"

#include "engine/loading/load.h"
#include "engine/mesh/body.h"

#include <math.h>

/* The load of the model, but a motion. */
static const fracas_load *load_of(const fracas_model *model)
{
    const fracas_load *load = fracas_loading_traits_of(&model->spec)->load;
    return load && !load->path ? load : NULL;
}

/* ---- places ---- */

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* Divides a vector by its length, which comes back. */
static double normalize(double a[3])
{
    const double length = sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    for (int i = 0; i < 3; i++) a[i] /= length;
    return length;
}

/* A point of an element: values of the shape functions, dx/dxi, dx/deta [m], |dx/dxi x dx/deta|
 * [m2], and the place without its edge. */
typedef struct {
    double shape[6], base[2][3], area;
    fracas_place at;
} element_point;

static element_point point_at(const fracas_surface *surface, size_t e, double xi, double eta)
{
    element_point p = {0};
    double derivative[6][2];
    fracas_triangle_shape(surface->order, xi, eta, p.shape, derivative);
    for (size_t k = 0; k < surface->corners; k++)
        for (int i = 0; i < 3; i++) {
            const double x = fracas_surface_node(surface, e, k)[i];
            p.at.x[i] += p.shape[k] * x;
            for (int a = 0; a < 2; a++) p.base[a][i] += derivative[k][a] * x;
        }
    cross(p.base[0], p.base[1], p.at.normal);
    p.area = normalize(p.at.normal);
    return p;
}

/* The same at s in (0, 1) on an edge, with its directions; `speed` is |dx/ds| [m]. */
static element_point edge_point_at(const fracas_surface *surface,
                                   const fracas_surface_border *border, double s, double *speed)
{
    static const double corner[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    const double *a = corner[border->edge], *b = corner[(border->edge + 1) % 3];
    element_point p = point_at(surface, border->element, a[0] + s * (b[0] - a[0]),
                               a[1] + s * (b[1] - a[1]));
    for (int i = 0; i < 3; i++)
        p.at.along[i] = p.base[0][i] * (b[0] - a[0]) + p.base[1][i] * (b[1] - a[1]);
    *speed = normalize(p.at.along);
    cross(p.at.along, p.at.normal, p.at.outward);
    return p;
}

fracas_place fracas_surface_place_on(const fracas_surface *surface,
                                     const fracas_surface_border *border, double s, double *speed)
{
    return edge_point_at(surface, border, s, speed).at;
}

/* ---- forces ---- */

/* d(x), whose share its spot gives  (loads.1), (loads.9) */
static void density_at(const fracas_model *model, const fracas_place *at, double density[3])
{
    const double share = fracas_load_spot(&model->spec.loading, at->x);
    load_of(model)->density(&model->spec, at, density);
    for (int i = 0; i < 3; i++) density[i] *= share;
}

/* Adds weight N_k d to the forces on an element's nodes. */
static void add_force(const fracas_model *model, size_t dimension, const element_point *p,
                      double weight, double *force)
{
    double density[3];
    density_at(model, &p->at, density);
    for (size_t k = 0; k < model->surface->corners; k++)
        for (size_t i = 0; i < dimension; i++)
            force[dimension * k + i] += weight * p->shape[k] * density[i];
}

/* F_k = int N_k d dA  (loads.3) */
static void fill_area(const fracas_model *model, size_t dimension, size_t e, double *force)
{
    for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
        const double *at = fracas_triangle_fine[g];
        const element_point p = point_at(model->surface, e, at[0], at[1]);
        add_force(model, dimension, &p, at[2] * p.area, force);
    }
}

/* F_k = sum_l M_kl d(x_l)  (loads.3) */
static void fill_mass_load(const fracas_model *model, const fracas_surface_tables *t, size_t e,
                           double *force)
{
    static const double corner[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};
    const size_t nodes = model->surface->corners, dimension = (size_t)t->body->dimension;
    for (size_t l = 0; l < nodes; l++) {
        double density[3];
        const element_point p = point_at(model->surface, e, corner[l][0], corner[l][1]);
        density_at(model, &p.at, density);
        for (size_t k = 0; k < nodes; k++)
            for (size_t i = 0; i < dimension; i++)
                force[dimension * k + i] += fracas_surface_mass(t, e, k, l) * density[i];
    }
}

/* F_k = int N_k d ds  (loads.3) */
static void fill_edge(const fracas_model *model, size_t dimension,
                      const fracas_surface_border *border, double *force)
{
    static const double at[3] = FRACAS_EDGE_POINTS_2, weight[3] = FRACAS_EDGE_WEIGHTS_2;
    for (int g = 0; g < 3; g++) {
        double speed;
        const element_point p = edge_point_at(model->surface, border, at[g], &speed);
        add_force(model, dimension, &p, weight[g] * speed, force);
    }
}

/* ---- tables ---- */

fracas_err fracas_surface_load_tag(const fracas_model *model, int i, int32_t *tag)
{
    const fracas_load *load = fracas_loading_traits_of(&model->spec)->load;
    const char *asked = i == 0 ? "loading.edge" : "loading.second_edge",
               *key = load->edge ? load->edge(&model->spec, i) : NULL;
    const fracas_surface *surface = model->surface;
    *tag = 0;
    if (load->on == FRACAS_LOAD_ON_EDGE && !key && i == 0)
        return fracas_fail(FRACAS_USAGE, "loading.edge is not given: on which edge does it act?");
    if (!key) return FRACAS_OK;
    TRY(fracas_shape_edge_tag(&model->spec.geometry, asked, key, tag));
    for (size_t b = 0; b < surface->nborders; b++)
        if (surface->border[b].tag == *tag) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is %s, but the mesh has no edge on its boundary of the physical group "
                       "%d: give the lines that number, or the group the name %s",
                       asked, key, (int)*tag, key);
}

fracas_err fracas_surface_loads_count(const fracas_model *model, size_t *count)
{
    const fracas_surface *surface = model->surface;
    int32_t tag;
    *count = load_of(model) ? surface->nelements : 0;
    if (*count == 0) return FRACAS_OK;
    TRY(fracas_surface_load_tag(model, 0, &tag));
    if (tag == 0) return FRACAS_OK;
    *count = 0;
    for (size_t b = 0; b < surface->nborders; b++) *count += surface->border[b].tag == tag;
    return FRACAS_OK;
}

/* The forces of an element's row, which begins at its first use. */
static double *row_of(const fracas_model *model, fracas_surface_tables *t, size_t e,
                      const double middle[3])
{
    if (t->load_row[e] == 0) {
        t->load_row[e] = (uint32_t)++t->nloads;
        t->load_clock[t->nloads - 1] = fracas_load_clock_at(&model->spec.loading, middle);
    }
    return t->load + (size_t)(t->load_row[e] - 1) * fracas_surface_unknowns(t);
}

static void fill_edges(const fracas_model *model, fracas_surface_tables *t, int32_t tag)
{
    for (size_t b = 0; b < model->surface->nborders; b++) {
        const fracas_surface_border *border = &model->surface->border[b];
        double speed;
        if (border->tag != tag) continue;
        const element_point middle = edge_point_at(model->surface, border, 0.5, &speed);
        fill_edge(model, (size_t)t->body->dimension, border,
                  row_of(model, t, border->element, middle.at.x));
    }
}

static void fill_elements(const fracas_model *model, fracas_surface_tables *t)
{
    for (size_t e = 0; e < t->nelements; e++) {
        const element_point middle = point_at(model->surface, e, 1.0 / 3, 1.0 / 3);
        double *force = row_of(model, t, e, middle.at.x);
        if (load_of(model)->on == FRACAS_LOAD_ON_MASS) fill_mass_load(model, t, e, force);
        else fill_area(model, (size_t)t->body->dimension, e, force);
    }
}

/* Some component of a force moves a node; below a rounding of the largest it is none: shape
 * functions of nodes off an edge. */
static bool moves_any(const fracas_surface_tables *t)
{
    const size_t size = fracas_surface_unknowns(t);
    double largest = 0, moving = 0;
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; t->load_row[e] > 0 && i < size; i++) {
            const double force = fabs(t->load[(t->load_row[e] - 1) * size + i]);
            largest = fmax(largest, force);
            if (!(t->held[e] >> i & 1)) moving = fmax(moving, force);
        }
    return moving > 1e-9 * largest;
}

fracas_err fracas_surface_loads_fill(const fracas_model *model, fracas_surface_tables *t)
{
    int32_t tag;
    if (!load_of(model)) return FRACAS_OK;
    TRY(fracas_load_history(&model->spec.loading, &t->load_history));
    TRY(fracas_surface_load_tag(model, 0, &tag));
    if (tag != 0) fill_edges(model, t, tag);
    else fill_elements(model, t);
    if (moves_any(t)) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "loading %s has no force where the body could move: all its components are "
        "0, or act on an edge that geometry holds, or on a spot beside the body: give it one, "
        "free the edge, or move the spot",
        model->spec.loading.type->name);
}
