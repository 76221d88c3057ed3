/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Traits of a surface's body: membrane or shell. */
#ifndef FRACAS_ENGINE_FORMULATION_SURFACE_TRAITS_H
#define FRACAS_ENGINE_FORMULATION_SURFACE_TRAITS_H

#include "engine/formulation/surface/sweep.h"

/* A body: the traits of its formulation. Its functions fill tables of the caller's. */
struct fracas_surface_body {
    int dimension;       /* components of a displacement */
    int stresses;        /* values of stress at a bulk point */
    int layers;          /* points through the thickness at each Gauss point of an interface */
    const double *layer; /* [layers]: their weights, of sum 1 */
    bool resultants;     /* stresses are integrals over the thickness */
    size_t bulk_table, head, point_table, rim_table; /* doubles; no rims: 0 */
    const fracas_surface_kernels *kernels;
    /* FRACAS_USAGE for a mesh unfit for this body; before and after its tables are filled. */
    fracas_err (*check_mesh)(const fracas_surface *surface);
    fracas_err (*check_tables)(const fracas_model *model); /* NULL: nothing to check */
    /* A bulk point at xi, eta of an element, of quadrature weight `weight`. */
    void (*fill_bulk)(const fracas_model *model, size_t element, double xi, double eta,
                      double weight, double *bulk);
    /* Head of an interface but for its compliance; `inverse_size` is 1/h_s [1/m]. */
    void (*fill_head)(const fracas_model *model, double inverse_size, double *head);
    /* Its Gauss point at s of the first element's edge, of quadrature weight `weight`. */
    void (*fill_point)(const fracas_model *model, const fracas_surface_interface *interface,
                       double s, double weight, double *point);
    void (*fill_rim)(const fracas_model *model, const fracas_surface_border *border, double *rim);
    /* Direction t and matrix R of an element's whole rotary inertia; NULL: the body has none. */
    void (*fill_rotary)(const fracas_model *model, size_t element, double t[3], double *rotary);
    /* The axis across the plane x, y or z = const of an edge, as a bit, of two the one nearer to
     * the edge's own normal; 0: there is none, or its cosine with that is below `least`. */
    unsigned (*edge_axis)(const fracas_surface *surface, const fracas_surface_border *border,
                          double least);
    /* Turns the stresses of a bulk point, by its table, into tensors in space: xx, yy, zz, xy, yz,
     * xz of each three. */
    void (*turn_stress)(const double *bulk, const double *stress, double *tensor);
    /* Normal of an interface at a Gauss point, by its table. */
    void (*normal)(const double *point, double normal[3]);
    /* Adds node k of an element to its fragment's sums, with its inertia in the sweep; x and v
     * are those of all its nodes [m], [m/s]. */
    void (*add_node)(const fracas_surface_tables *tables, size_t element, size_t k,
                     const double (*x)[3], const double (*v)[3], fracas_fragment_sums *sums);
};

/* ---- sizes by them ---- */

/* Sizes and places in a group's state, in units of one field's lanes. */
static inline size_t fracas_surface_unknowns(const fracas_surface_tables *t)
{
    return (size_t)(t->body->dimension * SURFACE_NODES(t->order));
}
static inline size_t fracas_surface_points(const fracas_surface_tables *t)
{
    return (size_t)(SURFACE_EDGE(t->order) * t->body->layers);
}
static inline size_t fracas_surface_element_fields(const fracas_surface_constants *c)
{
    return (size_t)c->fields * fracas_surface_unknowns(c->tables);
}
static inline size_t fracas_surface_interface_fields(const fracas_surface_constants *c)
{
    return fracas_surface_points(c->tables) * (size_t)c->point_fields;
}
static inline size_t fracas_surface_interfaces_at(const fracas_surface_constants *c)
{
    return c->tables->nelements * fracas_surface_element_fields(c);
}
static inline size_t fracas_surface_strengths_at(const fracas_surface_constants *c)
{
    return fracas_surface_interfaces_at(c) +
           c->tables->ninterfaces * fracas_surface_interface_fields(c);
}
static inline size_t fracas_surface_state_fields(const fracas_surface_constants *c)
{
    return fracas_surface_strengths_at(c) + c->tables->ninterfaces * (size_t)c->strengths;
}
/* A slot: stresses at the bulk points, strains added there by symmetrisation, forces. */
static inline size_t fracas_surface_slot(const fracas_surface_tables *t)
{
    return (size_t)(2 * t->body->stresses * SURFACE_BULK(t->order)) + fracas_surface_unknowns(t);
}
static inline size_t fracas_surface_blocks(const fracas_surface_tables *t)
{
    return (t->nelements + SURFACE_BLOCK - 1) / SURFACE_BLOCK;
}
/* Number of the strength at Gauss point g of an interface. */
static inline size_t fracas_surface_strength_of(const fracas_surface_constants *c, size_t interface,
                                                int g)
{
    return interface * (size_t)c->strengths + (c->strengths > 1 ? (size_t)g : 0);
}

/* M_kl of the lumped or consistent masses of element e [kg]. */
static inline double fracas_surface_mass(const fracas_surface_tables *t, size_t e, size_t k,
                                         size_t l)
{
    const size_t nodes = (size_t)SURFACE_NODES(t->order);
    if (t->consistent) return t->consistent[((3 * e + 2) * nodes + k) * nodes + l];
    return k == l ? t->lumped[(2 * e + 1) * nodes + k] : 0;
}

#endif
