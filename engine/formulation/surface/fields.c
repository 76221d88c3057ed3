/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a surface between two steps. */
#include "engine/formulation/surface/surface.h"

#include <string.h>

/* An element's node in the state: field SURFACE_U or SURFACE_V, filled up with zeros. */
static void node_value(const fracas_surface_constants *c, const fracas_step *step, int lane,
                       size_t e, int field, size_t k, double value[3])
{
    const size_t dimension = (size_t)c->tables->body->dimension,
                 at = e * fracas_surface_element_fields(c) +
                      (size_t)field * fracas_surface_unknowns(c->tables) + dimension * k;
    value[2] = 0;
    for (size_t i = 0; i < dimension; i++) value[i] = *fracas_surface_field(step, at + i, lane);
}

/* The row sum of masses, which has the whole momentum of an even motion. */
static double node_mass(const fracas_surface_tables *t, size_t e, size_t k)
{
    const size_t nodes = (size_t)SURFACE_NODES(t->order);
    double mass = t->consistent ? 0 : t->lumped[(2 * e + 1) * nodes + k];
    for (size_t l = 0; t->consistent && l < nodes; l++)
        mass += t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return mass;
}

/* Means of an element's stresses by its bulk points' weights, in space. */
static void fill_stress(const fracas_surface_constants *c, size_t e, double *u, fracas_fields *f)
{
    enum { MOST = 6 };
    const fracas_surface_tables *t = c->tables;
    const size_t points = (size_t)SURFACE_BULK(t->order), stresses = (size_t)t->body->stresses;
    const double *bulk = t->bulk + e * points * t->body->bulk_table;
    double stress[SURFACE_BULK(2) * MOST], mean[2 * MOST] = {0}, weights = 0;
    (*t->body->kernels)[FRACAS_ISA_BASELINE][1]->strain[t->order - 1](c, e, u, stress);
    for (size_t g = 0; g < points; g++, bulk += t->body->bulk_table) {
        double tensor[2 * MOST];
        t->body->turn_stress(bulk, stress + g * stresses, tensor);
        for (size_t j = 0; j < 2 * stresses; j++) mean[j] += bulk[SURFACE_WEIGHT] * tensor[j];
        weights += bulk[SURFACE_WEIGHT];
    }
    const double *from = mean;
    for (size_t s = 0; s < FRACAS_STRESSES; s++)
        for (size_t j = 0; j < f->components[s]; j++)
            f->stress[s][e * f->components[s] + j] = *from++ / weights;
}

static void fill_element(const fracas_model *model, const fracas_surface_constants *c,
                         const fracas_step *step, int lane, size_t e, fracas_fields *f)
{
    const size_t dimension = (size_t)c->tables->body->dimension;
    double u[SURFACE_UNKNOWNS_MOST];
    for (size_t k = 0; k < f->corners; k++) {
        const size_t node = e * f->corners + k;
        const double *start = fracas_surface_node(model->surface, e, k);
        node_value(c, step, lane, e, SURFACE_U, k, f->displacement[node]);
        node_value(c, step, lane, e, SURFACE_V, k, f->velocity[node]);
        for (int i = 0; i < 3; i++) f->place[node][i] = start[i] + f->displacement[node][i];
        memcpy(u + dimension * k, f->displacement[node], dimension * sizeof *u);
        f->mass[node] = node_mass(c->tables, e, k);
    }
    fill_stress(c, e, u, f);
}

/* Node n of an interface, its ends and then its middle, in the arrays of nodes, by side. */
static size_t node_of(const fracas_surface_interface *of, size_t corners, int side, size_t n)
{
    const size_t edge = of->edge[side], first = (edge + (side ? 1 : 0)) % 3,
                 last = (edge + (side ? 0 : 1)) % 3;
    return of->element[side] * corners + (n == 0 ? first : n == 1 ? last : 3 + edge);
}

/* Opening at the Gauss points of an interface, its mean by their weights [m]. */
static double opening_of(const fracas_surface_tables *t, size_t i, const double (*jump)[3])
{
    static const double point[2][3] = {FRACAS_EDGE_POINTS_1, FRACAS_EDGE_POINTS_2},
                        weight[2][3] = {FRACAS_EDGE_WEIGHTS_1, FRACAS_EDGE_WEIGHTS_2};
    const size_t points = (size_t)SURFACE_EDGE(t->order);
    const double *table = t->interface + i * (t->body->head + points * t->body->point_table) +
                          t->body->head;
    double opening = 0;
    for (size_t g = 0; g < points; g++, table += t->body->point_table) {
        double normal[3], shape[3], spread[3];
        fracas_edge_shape(t->order, point[t->order - 1][g], shape, spread);
        t->body->normal(table, normal);
        for (int n = 0; n < t->order + 1; n++)
            for (int j = 0; j < 3; j++)
                opening += weight[t->order - 1][g] * shape[n] * jump[n][j] * normal[j];
    }
    return opening;
}

static void fill_interface(const fracas_model *model, const fracas_surface_constants *c,
                           const fracas_step *step, int lane, size_t i, fracas_fields *f)
{
    const fracas_surface_interface *of = &model->surface->interface[i];
    const fracas_interface_row row = fracas_surface_interface_row(model, c, step, i, lane);
    double jump[3][3];
    for (size_t n = 0; n < f->ends; n++) {
        const size_t one = node_of(of, f->corners, 0, n), other = node_of(of, f->corners, 1, n);
        for (int j = 0; j < 3; j++) {
            jump[n][j] = f->displacement[other][j] - f->displacement[one][j];
            f->middle[i * f->ends + n][j] = 0.5 * (f->place[one][j] + f->place[other][j]);
        }
    }
    for (int side = 0; side < 2; side++) f->between[i][side] = of->element[side];
    f->opening[i] = opening_of(c->tables, i, (const double(*)[3])jump);
    f->damage[i] = row.damage;
    f->strength[i] = row.strength;
    f->onset_time[i] = row.onset_time;
}

size_t fracas_surface_interface_nodes(const fracas_model *model)
{
    return (size_t)model->surface->order + 1;
}

void fracas_surface_fields(const fracas_model *model, const fracas_step *step, int lane,
                           fracas_fields *fields)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    for (size_t e = 0; e < fields->elements; e++) fill_element(model, &c, step, lane, e, fields);
    for (size_t i = 0; i < fields->interfaces; i++)
        fill_interface(model, &c, step, lane, i, fields);
}
