/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of a surface: masses, and the body's own geometry. */
#include "engine/formulation/surface/surface.h"

#include "engine/formulation/surface/loads.h"
#include "engine/integrator/integrator.h"
#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"

#include <stdlib.h>

/* The arrays of the tables; the linear operator reads all but the positions. */
#define OPERATOR_TABLES(TABLE) \
    TABLE(bulk)                \
    TABLE(lumped)              \
    TABLE(consistent)          \
    TABLE(rotary)              \
    TABLE(interface)           \
    TABLE(element)             \
    TABLE(edge)                \
    TABLE(held)                \
    TABLE(fixed)               \
    TABLE(rim)                 \
    TABLE(rim_edge)            \
    TABLE(rim_from)
#define TABLES(TABLE)      \
    OPERATOR_TABLES(TABLE) \
    TABLE(position)        \
    TABLE(load_row)        \
    TABLE(load)            \
    TABLE(load_clock)      \
    TABLE(moved)           \
    TABLE(moved_row)       \
    TABLE(moved_by)        \
    TABLE(set)             \
    TABLE(direction)       \
    TABLE(start)

/* Their lengths; 0: there is none. */
#define TABLE(name) size_t name;
typedef struct {
    TABLES(TABLE)
} lengths;
#undef TABLE

typedef struct {
    bool consistent, rotary, positions, start; /* there are such tables */
    size_t forces, loads, sets; /* loads that are forces, rows of them, sets of nodes */
    bool moves;                 /* a load moves nodes ... */
    size_t moved;               /* ... in rows: made once they are known */
} optional;

static lengths lengths_of(const fracas_surface_tables *t, optional has)
{
    const fracas_surface_body *body = t->body;
    const size_t n = t->nelements, m = t->ninterfaces ? t->ninterfaces : 1,
                 nodes = (size_t)SURFACE_NODES(t->order);
    return (lengths){
        .bulk = n * (size_t)SURFACE_BULK(t->order) * body->bulk_table,
        .lumped = n * 2 * nodes,
        .consistent = has.consistent ? n * 3 * nodes * nodes : 0,
        .rotary = has.rotary ? n * SURFACE_ROTARY_TABLE : 0,
        .interface = m * (body->head + (size_t)SURFACE_EDGE(t->order) * body->point_table),
        .element = m,
        .edge = m,
        .held = n,
        .fixed = n,
        .rim = t->nrims * body->rim_table + 1,
        .rim_edge = t->nrims + 1,
        .rim_from = n + 1,
        .position = has.positions ? n * nodes * 2 : 0,
        .load_row = has.forces * n,
        .load = has.loads * nodes * (size_t)body->dimension,
        .load_clock = has.loads,
        .moved = has.moves ? n : 0,
        .moved_row = has.moves ? n : 0,
        .moved_by = has.moved,
        .set = has.sets * n,
        .direction = has.moved * nodes * (size_t)body->dimension,
        .start = has.start ? has.moved * nodes * (size_t)body->dimension : 0,
    };
}

void fracas_surface_tables_destroy(void *p)
{
    fracas_surface_tables *t = p;
    if (!t) return;
#define TABLE(name) free(t->name);
    TABLES(TABLE)
#undef TABLE
    for (int n = 0; n < FRACAS_LOADINGS; n++) fracas_profile_clear(&t->history[n]);
    free(t);
}

static bool allocate(fracas_surface_tables *t, const lengths *length)
{
    bool good = true;
#define TABLE(name)                                                    \
    if (length->name) t->name = calloc(length->name, sizeof *t->name); \
    good = good && (t->name || !length->name);
    TABLES(TABLE)
#undef TABLE
    return good;
}

static lengths own_lengths(const fracas_surface_tables *t)
{
    return lengths_of(t,
                      (optional){t->consistent, t->rotary, t->position, t->start, (size_t)t->forces,
                                 t->nloads, (size_t)t->sets, t->moved, t->nmoved});
}

size_t fracas_surface_tables_bytes(const fracas_surface_tables *t)
{
    const lengths length = own_lengths(t);
    size_t bytes = 0;
#define TABLE(name) bytes += length.name * sizeof *t->name;
    TABLES(TABLE)
#undef TABLE
    return bytes;
}

fracas_hash fracas_surface_tables_hash(const fracas_surface_tables *t)
{
    const lengths length = own_lengths(t);
    fracas_hash part[sizeof(lengths) / sizeof(size_t)] = {0};
    size_t parts = 0;
#define TABLE(name) part[parts++] = fracas_hash_of(t->name, length.name * sizeof *t->name);
    OPERATOR_TABLES(TABLE)
#undef TABLE
    return fracas_hash_of(part, sizeof part);
}

/* ---- masses ---- */

/* consistent[k n + l] = int density N_k N_l dA, n = surface->corners, and lumped[k] by the rule of
 * Hinton, Rock and Zienkiewicz: its diagonal, scaled to the element's mass  (membrane.13).
 * `density` per area [kg/m2]; masses in kg. */
static void find_masses(const fracas_surface *surface, size_t element, double density,
                        double *consistent, double *lumped)
{
    const size_t nodes = surface->corners;
    double shape[6], total = 0, trace = 0;
    for (size_t i = 0; i < nodes * nodes; i++) consistent[i] = 0;
    for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
        const double *point = fracas_triangle_fine[g];
        const double weight = density * point[2] *
                              fracas_surface_density(surface, element, point[0], point[1], shape);
        total += weight;
        for (size_t k = 0; k < nodes; k++)
            for (size_t l = 0; l < nodes; l++)
                consistent[k * nodes + l] += weight * shape[k] * shape[l];
    }
    for (size_t k = 0; k < nodes; k++) trace += consistent[k * nodes + k];
    for (size_t k = 0; k < nodes; k++) lumped[k] = total * consistent[k * nodes + k] / trace;
}

/* m = inverse of the n x n matrix m (Gauss-Jordan, positive definite: no pivoting). */
static void invert(double *m, int n)
{
    for (int p = 0; p < n; p++) {
        const double pivot = 1.0 / m[p * n + p];
        m[p * n + p] = 1.0;
        for (int c = 0; c < n; c++) m[p * n + c] *= pivot;
        for (int r = 0; r < n; r++) {
            if (r == p) continue;
            const double factor = m[r * n + p];
            m[r * n + p] = 0.0;
            for (int c = 0; c < n; c++) m[r * n + c] -= factor * m[p * n + c];
        }
    }
}

/* Inverse of the mass among the nodes free in a component; 0 for held ones. */
static void invert_free(const double *mass, int nodes, unsigned held, int component,
                        double *inverse)
{
    for (int r = 0; r < nodes; r++)
        for (int c = 0; c < nodes; c++) {
            const bool out = (held >> (2 * r + component) & 1) || (held >> (2 * c + component) & 1);
            inverse[r * nodes + c] = out ? r == c : mass[r * nodes + c];
        }
    invert(inverse, nodes);
    for (int r = 0; r < nodes; r++)
        if (held >> (2 * r + component) & 1) inverse[r * nodes + r] = 0.0;
}

/* (membrane.13) */
static void fill_mass(const fracas_model *model, fracas_surface_tables *t, size_t e)
{
    const int nodes = SURFACE_NODES(t->order);
    double mass[36], *lumped = t->lumped + 2 * (size_t)nodes * e;
    find_masses(model->surface, e, model->spec.material.density * model->spec.geometry.thickness,
                mass, lumped + nodes);
    for (int k = 0; k < nodes; k++) lumped[k] = 1.0 / lumped[nodes + k];
    if (!t->consistent) return;
    const size_t entries = (size_t)(nodes * nodes);
    double *consistent = t->consistent + 3 * entries * e;
    for (int i = 0; i < 2; i++)
        invert_free(mass, nodes, t->held[e], i, consistent + (size_t)i * entries);
    for (size_t i = 0; i < entries; i++) consistent[2 * entries + i] = mass[i];
}

/* (M + T' R T)^-1 = M^-1 - M^-1 T' S T M^-1 with T_k = t less its components held at node k; with
 * p_k = |T_k|^2 and D = diag(p_k/m_k), S = D^-1 (D - (D^-1 + R)^-1) D^-1  (shell.16), (shell.17) */
static void fill_rotary(const fracas_model *model, fracas_surface_tables *t, size_t e)
{
    const int nodes = SURFACE_NODES(t->order);
    double *table = t->rotary + e * SURFACE_ROTARY_TABLE, *rotary = table + SURFACE_ROTARY,
           *inverse = table + SURFACE_ROTARY_INVERSE, part[6], all[36];
    const double *mass = t->lumped + (2 * e + 1) * (size_t)nodes;
    t->body->fill_rotary(model, e, table + SURFACE_TURNING, rotary);
    for (int i = 0; i < nodes * (nodes + 1) / 2; i++) rotary[i] *= model->spec.time.rotary_inertia;
    for (int k = 0; k < nodes; k++) {
        double held = 0;
        for (int i = 0; i < 3; i++)
            if (t->held[e] >> (3 * k + i) & 1)
                held += table[SURFACE_TURNING + i] * table[SURFACE_TURNING + i];
        part[k] = held < 1 - 1e-12 ? 1 - held : 0;
    }
    for (int k = 0; k < nodes; k++)
        for (int l = 0; l < nodes; l++)
            all[k * nodes + l] = (part[k] > 0 && part[l] > 0 ? rotary[fracas_surface_entry(k, l)]
                                                             : 0) +
                                 (k == l ? mass[k] / (part[k] > 0 ? part[k] : 1) : 0);
    invert(all, nodes);
    for (int k = 0; k < nodes; k++)
        for (int l = 0; l <= k; l++)
            inverse[fracas_surface_entry(k, l)] = part[k] > 0 && part[l] > 0
                                                      ? (all[k * nodes + l] -
                                                         (k == l ? 1 / (mass[k] / part[k]) : 0)) /
                                                            (part[k] * part[l])
                                                      : 0;
}

static void fill_positions(const fracas_surface *surface, fracas_surface_tables *t, size_t e)
{
    for (size_t k = 0; k < surface->corners; k++)
        for (size_t i = 0; i < 2; i++)
            t->position[2 * (e * surface->corners + k) + i] = fracas_surface_node(surface, e, k)[i];
}

/* ---- elements and interfaces ---- */

static void fill_element(const fracas_model *model, fracas_surface_tables *t, size_t e)
{
    static const double at[2][3][2] = {FRACAS_TRIANGLE_POINTS_1, FRACAS_TRIANGLE_POINTS_2};
    const size_t points = SURFACE_BULK(t->order);
    for (size_t g = 0; g < points; g++)
        t->body->fill_bulk(model, e, at[t->order - 1][g][0], at[t->order - 1][g][1],
                           0.5 / (double)points, t->bulk + (e * points + g) * t->body->bulk_table);
    fill_mass(model, t, e);
    if (t->rotary) fill_rotary(model, t, e);
    if (t->position) fill_positions(model->surface, t, e);
    t->moves = t->moves || t->held[e] & ~t->fixed[e];
}

static void fill_interface(const fracas_model *model, fracas_surface_tables *t, size_t i)
{
    static const double at[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2},
                        weight[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const fracas_surface_interface *interface = &model->surface->interface[i];
    const fracas_surface_body *body = t->body;
    const size_t points = SURFACE_EDGE(t->order);
    double *head = t->interface + i * (body->head + points * body->point_table);
    for (int side = 0; side < 2; side++) {
        t->element[i][side] = interface->element[side];
        t->edge[i][side] = (uint8_t)interface->edge[side];
    }
    body->fill_head(model, fracas_surface_inverse_size(model->surface, i), head);
    head[SURFACE_COMPLIANCE] = 1.0 / head[SURFACE_STIFFNESS];
    for (size_t g = 0; g < points; g++)
        body->fill_point(model, interface, at[t->order - 1][g], weight[t->order - 1][g],
                         head + body->head + g * body->point_table);
}

static fracas_err fill(const fracas_model *model, fracas_surface_tables *t)
{
    TRY(fracas_surface_edges_fill(model, t));
    TRY(fracas_surface_nodes_fill(model, t));
    TRY(fracas_surface_motion_fill(model, t));
    for (size_t e = 0; e < t->nelements; e++) fill_element(model, t, e);
    for (size_t i = 0; i < t->ninterfaces; i++) fill_interface(model, t, i);
    return fracas_surface_loads_fill(model, t);
}

fracas_err fracas_surface_tables_create(const fracas_model *model, fracas_surface_tables **tables)
{
    const fracas_surface *surface = model->surface;
    fracas_surface_tables *t = calloc(1, sizeof *t);
    if (!t) return fracas_no_memory("the tables of a surface");
    t->body = model->formulation->kind.traits;
    t->order = surface->order;
    t->nelements = surface->nelements;
    t->ninterfaces = surface->ninterfaces;
    for (size_t b = 0; b < surface->nborders; b++)
        t->nrims += fracas_surface_has_rim(model, &surface->border[b]);
    const fracas_time *time = &model->spec.time;
    size_t forces, loads;
    int number[FRACAS_LOADINGS];
    fracas_err err = fracas_surface_loads_count(model, &forces, &loads);
    if (!err) err = fracas_surface_motions(model, t);
    t->sets = fracas_surface_node_sets(model, number);
    const lengths length = lengths_of(
        t, (optional){.consistent = fracas_mass_is_consistent(time),
                      .rotary = t->body->fill_rotary && time->rotary_inertia > 0,
                      .positions = fracas_loading_traits_of(&model->spec)->body_force,
                      .start = fracas_initial_is_strained(&model->spec),
                      .forces = forces,
                      .loads = loads,
                      .sets = (size_t)t->sets,
                      .moves = t->motions > 0});
    if (!err)
        err = allocate(t, &length) ? fill(model, t) : fracas_no_memory("the tables of a surface");
    if (err) fracas_surface_tables_destroy(t);
    else *tables = t;
    return err;
}
