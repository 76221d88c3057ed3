/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/loads.h"

#include "base/own.h"
#include "engine/loading/load.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* The load of a loading, but a motion. */
static const fracas_load *force_of(const fracas_model *model, int n)
{
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    return load && !load->path ? load : NULL;
}

/* A force and its tables. */
typedef struct {
    const fracas_model *model;
    const fracas_loading *loading;
    const fracas_load *load;
    fracas_surface_tables *tables;
    uint32_t *row;    /* [element]: this load's part of load_row */
    size_t dimension; /* the body's */
} forcing;

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
    fracas_surface_at(surface, e, xi, eta, p.shape, p.at.x, p.base);
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
static void density_at(const forcing *of, const fracas_place *at, double density[3])
{
    const double share = fracas_load_spot(of->loading, at->x);
    of->load->density(&of->model->spec, of->loading, at, density);
    for (int i = 0; i < 3; i++) density[i] *= share;
}

/* Adds weight N_k d to the forces on an element's nodes. */
static void add_force(const forcing *of, const element_point *p, double weight, double *force)
{
    double density[3];
    density_at(of, &p->at, density);
    for (size_t k = 0; k < of->model->surface->corners; k++)
        for (size_t i = 0; i < of->dimension; i++)
            force[of->dimension * k + i] += weight * p->shape[k] * density[i];
}

/* F_k = int N_k d dA  (loads.3) */
static void fill_area(const forcing *of, size_t e, double *force)
{
    for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
        const double *at = fracas_triangle_fine[g];
        const element_point p = point_at(of->model->surface, e, at[0], at[1]);
        add_force(of, &p, at[2] * p.area, force);
    }
}

/* Nodes of a triangle. */
static const double node_place[6][2] = {{0, 0}, {1, 0}, {0, 1}, {0.5, 0}, {0.5, 0.5}, {0, 0.5}};

/* F_k = sum_l M_kl d(x_l)  (loads.3) */
static void fill_mass_load(const forcing *of, size_t e, double *force)
{
    const size_t nodes = of->model->surface->corners, dimension = of->dimension;
    for (size_t l = 0; l < nodes; l++) {
        double density[3];
        const element_point p = point_at(of->model->surface, e, node_place[l][0], node_place[l][1]);
        density_at(of, &p.at, density);
        for (size_t k = 0; k < nodes; k++)
            for (size_t i = 0; i < dimension; i++)
                force[dimension * k + i] += fracas_surface_mass(of->tables, e, k, l) * density[i];
    }
}

/* F_k = share int N_k d ds  (loads.3) */
static void fill_edge(const forcing *of, const fracas_surface_border *border, double share,
                      double *force)
{
    static const double at[3] = FRACAS_EDGE_POINTS_2, weight[3] = FRACAS_EDGE_WEIGHTS_2;
    for (int g = 0; g < 3; g++) {
        double speed;
        const element_point p = edge_point_at(of->model->surface, border, at[g], &speed);
        add_force(of, &p, share * weight[g] * speed, force);
    }
}

/* ---- edges ---- */

bool fracas_surface_is_loaded(const fracas_model *model, int32_t tag, bool inside)
{
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        const fracas_load *load = fracas_loading_load(&model->spec, n);
        const char *key;
        int32_t loaded;
        const bool anywhere = load && load->on == FRACAS_LOAD_ON_NODES;
        if (!load || !load->edge || (!anywhere && (load->on == FRACAS_LOAD_ON_LINE) != inside))
            continue;
        for (int i = 0; (key = load->edge(fracas_loading_at(&model->spec, n), i)); i++)
            if (!fracas_shape_edge_tag(&model->spec.geometry, "edge", key, &loaded) &&
                loaded == tag)
                return true;
    }
    return false;
}

int32_t fracas_surface_edge_key(const fracas_model *model, int32_t tag)
{
    if (tag <= 0 || tag >= FRACAS_EDGES) return 0;
    const bool own = fracas_shape_edge(&model->spec, tag) || model->spec.geometry.edge[tag] ||
                     fracas_surface_is_loaded(model, tag, false);
    return own ? tag : 0;
}

/* ---- tables ---- */

fracas_err fracas_surface_load_tag(const fracas_model *model, int n, int i, int32_t *tag)
{
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    const char *key = load->edge ? load->edge(fracas_loading_at(&model->spec, n), i) : NULL;
    const fracas_surface *surface = model->surface;
    char asked[40];
    *tag = 0;
    snprintf(asked, sizeof asked, "%s.%s", fracas_loading_sections[n].name,
             i == 0 ? "edge" : "second_edge");
    if (load->on == FRACAS_LOAD_ON_EDGE && !key && i == 0)
        return fracas_fail(FRACAS_USAGE, "%s is not given: on which edge does it act?", asked);
    if (!key) return FRACAS_OK;
    TRY(fracas_shape_edge_tag(&model->spec.geometry, asked, key, tag));
    const bool inside = load->on == FRACAS_LOAD_ON_LINE,
               anywhere = load->on == FRACAS_LOAD_ON_NODES;
    size_t borders = 0, interfaces = 0;
    for (size_t b = 0; b < surface->nborders; b++) borders += surface->border[b].tag == *tag;
    for (size_t b = 0; b < surface->ninterfaces; b++)
        interfaces += surface->interface[b].tag == *tag;
    if (inside && borders > 0 && interfaces > 0)
        return fracas_fail(FRACAS_USAGE,
                           "%s is %s, whose group has %zu edges inside the body and %zu on its "
                           "boundary: the latter would carry nothing: take them out of the group, "
                           "and load them by a traction",
                           asked, key, interfaces, borders);
    if ((inside ? interfaces : borders) > 0 || (anywhere && interfaces > 0)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is %s, but the mesh has no edge %s of the physical group "
                       "%d: give the lines that number, or the group the name %s; edges %s",
                       asked, key, inside ? "inside the body" : "on its boundary", (int)*tag, key,
                       inside ? "of the boundary take a traction" : "inside take a line-force");
}

/* Sets on[interface] under the load of loading number n. *share: of its density, for a path to have
 * the force of its line; 1 of a group  (loads.11) */
static fracas_err find_line(const fracas_model *model, int n, bool *on, double *share)
{
    const fracas_surface *surface = model->surface;
    const fracas_load *load = fracas_loading_load(&model->spec, n);
    int32_t tag;
    double path = 0;
    TRY(fracas_surface_load_tag(model, n, 0, &tag));
    for (size_t i = 0; i < surface->ninterfaces; i++)
        on[i] = tag != 0 && surface->interface[i].tag == tag;
    *share = 1;
    if (tag != 0) return FRACAS_OK;
    const fracas_line line = load->line(fracas_loading_at(&model->spec, n),
                                        fracas_loading_sections[n].name,
                                        fracas_mesh_mean_length(surface));
    TRY(fracas_line_find(&line, surface, on));
    for (size_t i = 0; i < surface->ninterfaces; i++)
        if (on[i])
            path += fracas_surface_length(surface, surface->interface[i].element[0],
                                          surface->interface[i].edge[0]);
    *share = line.length / path;
    return FRACAS_OK;
}

/* Number of elements under the load of loading number n, at most. */
static fracas_err count_of(const fracas_model *model, int n, size_t *count)
{
    const fracas_surface *surface = model->surface;
    int32_t tag;
    *count = surface->nelements;
    TRY(fracas_surface_load_tag(model, n, 0, &tag));
    if (tag == 0 || fracas_loading_load(&model->spec, n)->on != FRACAS_LOAD_ON_EDGE)
        return FRACAS_OK;
    *count = 0;
    for (size_t b = 0; b < surface->nborders; b++) *count += surface->border[b].tag == tag;
    return FRACAS_OK;
}

fracas_err fracas_surface_loads_count(const fracas_model *model, size_t *forces, size_t *count)
{
    *forces = *count = 0;
    for (int n = 0; n < FRACAS_LOADINGS; n++) {
        size_t own;
        if (!force_of(model, n)) continue;
        TRY(count_of(model, n, &own));
        *forces += 1;
        *count += own;
    }
    return FRACAS_OK;
}

/* The forces of an element's row, which begins at its first use. */
static double *row_of(const forcing *of, size_t e, const double middle[3])
{
    fracas_surface_tables *t = of->tables;
    if (of->row[e] == 0) {
        of->row[e] = (uint32_t)++t->nloads;
        t->load_clock[t->nloads - 1] = fracas_load_clock_at(of->loading, middle);
    }
    return t->load + (size_t)(of->row[e] - 1) * fracas_surface_unknowns(t);
}

static void fill_edges(const forcing *of, int32_t tag)
{
    for (size_t b = 0; b < of->model->surface->nborders; b++) {
        const fracas_surface_border *border = &of->model->surface->border[b];
        double speed;
        if (border->tag != tag) continue;
        const element_point middle = edge_point_at(of->model->surface, border, 0.5, &speed);
        fill_edge(of, border, 1, row_of(of, border->element, middle.at.x));
    }
}

/* A share of an interface's force goes to the element on one side. */
static void fill_side(const forcing *of, size_t i, int side, double share)
{
    const fracas_surface_interface *interface = &of->model->surface->interface[i];
    const fracas_surface_border edge = {.element = interface->element[side],
                                        .edge = interface->edge[side]};
    double speed;
    const element_point middle = edge_point_at(of->model->surface, &edge, 0.5, &speed);
    fill_edge(of, &edge, share, row_of(of, edge.element, middle.at.x));
}

/* Half of the force goes to the element on each side. */
static fracas_err fill_line(const forcing *of, int n)
{
    const fracas_surface *surface = of->model->surface;
    OWNED bool *on = calloc(surface->ninterfaces + 1, sizeof *on);
    double share;
    if (!on) return fracas_no_memory("a load of a body");
    TRY(find_line(of->model, n, on, &share));
    for (size_t i = 0; i < surface->ninterfaces; i++)
        for (int side = 0; on[i] && side < 2; side++) fill_side(of, i, side, 0.5 * share);
    return FRACAS_OK;
}

/* ---- forces on nodes ---- */

/* Adds a share of F at node k to its force. */
static void push_node(const forcing *of, size_t e, size_t k, double share)
{
    double whole[3];
    const element_point p = point_at(of->model->surface, e, node_place[k][0], node_place[k][1]),
                        middle = point_at(of->model->surface, e, 1.0 / 3, 1.0 / 3);
    double *force = row_of(of, e, middle.at.x);
    density_at(of, &p.at, whole);
    for (size_t i = 0; i < of->dimension; i++) force[of->dimension * k + i] += share * whole[i];
}

/* F_k = F int N_k ds/(length of the edges), inside the body half on each side  (loads.12) */
static void fill_group(const forcing *of, int32_t tag)
{
    const fracas_surface *surface = of->model->surface;
    double length = 0, speed;
    for (size_t b = 0; b < surface->nborders; b++)
        if (surface->border[b].tag == tag)
            length += fracas_surface_length(surface, surface->border[b].element,
                                            surface->border[b].edge);
    for (size_t i = 0; i < surface->ninterfaces; i++)
        if (surface->interface[i].tag == tag)
            length += fracas_surface_length(surface, surface->interface[i].element[0],
                                            surface->interface[i].edge[0]);
    for (size_t b = 0; b < surface->nborders; b++) {
        const fracas_surface_border *border = &surface->border[b];
        if (border->tag != tag) continue;
        const element_point middle = edge_point_at(surface, border, 0.5, &speed);
        fill_edge(of, border, 1 / length, row_of(of, border->element, middle.at.x));
    }
    for (size_t i = 0; i < surface->ninterfaces; i++)
        for (int side = 0; surface->interface[i].tag == tag && side < 2; side++)
            fill_side(of, i, side, 0.5 / length);
}

/* F_k = N_k(foot) A_e F/(sum of A_e), in the elements at the foot  (loads.13) */
static fracas_err fill_point(const forcing *of, int n)
{
    const fracas_surface *surface = of->model->surface;
    fracas_spot foot, spot;
    double at[3], sum = 0;
    of->load->middle(of->loading, (int)of->dimension, at);
    fracas_surface_locate(of->model, at, &foot);
    const double most = fracas_mesh_mean_length(surface);
    if (foot.distance > most)
        return fracas_fail(FRACAS_USAGE,
                           "%s %s is beside the body: the nearest point, (%.6g, %.6g, %.6g) m, is "
                           "%.3g m away, more than an edge, %.3g m: move at_x, at_y, at_z",
                           fracas_loading_sections[n].name, of->loading->type->name, foot.place[0],
                           foot.place[1], foot.place[2], foot.distance, most);
    for (size_t e = 0; e < surface->nelements; e++)
        if (fracas_surface_has(surface, e, foot.place, &spot)) sum += surface->area[e];
    for (size_t e = 0; e < surface->nelements; e++)
        if (fracas_surface_has(surface, e, foot.place, &spot))
            for (size_t k = 0; k < surface->corners; k++)
                push_node(of, e, k, spot.weight[k] * surface->area[e] / sum);
    return FRACAS_OK;
}

/* F_k = w_k F/(sum of w over all nodes of the set in all elements), w_k the lumped mass of an
 * element with density 1  (loads.14) */
static fracas_err fill_nodes(const forcing *of, int n)
{
    static const double lumped[2][6] = {
        {1.0 / 3, 1.0 / 3, 1.0 / 3},
        {1.0 / 19, 1.0 / 19, 1.0 / 19, 16.0 / 57, 16.0 / 57, 16.0 / 57}};
    const fracas_surface *surface = of->model->surface;
    const double *share = lumped[surface->order - 1];
    const size_t corners = surface->corners;
    OWNED bool *on = calloc(surface->nnodes + 1, sizeof *on);
    double sum = 0;
    if (!on) return fracas_no_memory("a load of a body");
    TRY(fracas_surface_nodes_mark(of->model, n, (int)of->dimension, on));
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < corners; k++)
            if (on[surface->element[e * corners + k]]) sum += share[k] * surface->area[e];
    if (!(sum > 0)) return fill_point(of, n);
    for (size_t e = 0; e < surface->nelements; e++)
        for (size_t k = 0; k < corners; k++)
            if (on[surface->element[e * corners + k]])
                push_node(of, e, k, share[k] * surface->area[e] / sum);
    return FRACAS_OK;
}

static void fill_elements(const forcing *of)
{
    for (size_t e = 0; e < of->tables->nelements; e++) {
        const element_point middle = point_at(of->model->surface, e, 1.0 / 3, 1.0 / 3);
        double *force = row_of(of, e, middle.at.x);
        if (of->load->on == FRACAS_LOAD_ON_MASS) fill_mass_load(of, e, force);
        else fill_area(of, e, force);
    }
}

/* Largest component of a load's forces: any, and on a node free to move [N]; and their sums. */
typedef struct {
    double any, moving, all, free;
} largest;

static largest largest_of(const forcing *of)
{
    const fracas_surface_tables *t = of->tables;
    const size_t size = fracas_surface_unknowns(t);
    largest found = {0};
    for (size_t e = 0; e < t->nelements; e++)
        for (size_t i = 0; of->row[e] > 0 && i < size; i++) {
            const double force = fabs(t->load[(of->row[e] - 1) * size + i]);
            found.any = fmax(found.any, force);
            found.all += force;
            if (t->held[e] >> i & 1) continue;
            found.moving = fmax(found.moving, force);
            found.free += force;
        }
    return found;
}

/* Below a rounding of the largest a force is none: shape functions of nodes off an edge. Beside
 * another load one may be 0, as where a sweep takes it away. */
static fracas_err check_moves(const forcing *of, int n)
{
    const largest found = largest_of(of);
    const bool beside = !fracas_loading_is_alone(&of->model->spec);
    if (of->load->on == FRACAS_LOAD_ON_NODES && found.free < 0.5 * found.all)
        return fracas_fail(FRACAS_USAGE,
                           "%.0f %% of the force of %s %s acts where geometry or a load holds the "
                           "body, and moves nothing: free these edges, or move the force",
                           100 * (1 - found.free / found.all), fracas_loading_sections[n].name,
                           of->loading->type->name);
    if (found.moving > 1e-9 * found.any || (beside && found.any == 0)) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "%s %s has no force where the body could move: all its components are "
        "0, or act on an edge that geometry holds%s, or on a spot beside the body: give it one, "
        "free the edge, or move the spot",
        fracas_loading_sections[n].name, of->loading->type->name,
        of->tables->moved ? " or a load moves" : "");
}

static fracas_err fill_force(const fracas_model *model, fracas_surface_tables *t, int n)
{
    const forcing of = {.model = model,
                        .loading = fracas_loading_at(&model->spec, n),
                        .load = force_of(model, n),
                        .tables = t,
                        .row = t->load_row + (size_t)t->forces * t->nelements,
                        .dimension = (size_t)t->body->dimension};
    int32_t tag;
    t->force[t->forces++] = n;
    TRY(fracas_load_history(of.loading, &t->history[n]));
    TRY(fracas_surface_load_tag(model, n, 0, &tag));
    if (of.load->on == FRACAS_LOAD_ON_NODES && tag != 0) fill_group(&of, tag);
    else if (of.load->on == FRACAS_LOAD_ON_NODES) TRY(fill_nodes(&of, n));
    else if (of.load->on == FRACAS_LOAD_ON_LINE) TRY(fill_line(&of, n));
    else if (tag != 0) fill_edges(&of, tag);
    else fill_elements(&of);
    return check_moves(&of, n);
}

fracas_err fracas_surface_loads_fill(const fracas_model *model, fracas_surface_tables *t)
{
    for (int n = 0; n < FRACAS_LOADINGS; n++)
        if (force_of(model, n)) TRY(fill_force(model, t, n));
    return FRACAS_OK;
}
