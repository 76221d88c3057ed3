/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Membranes that break: a small plate, its strengths, and what can be read off its state without
 * the harvest. */
#ifndef FRACAS_TESTS_SUPPORT_MEMBRANE_CRACKS_H
#define FRACAS_TESTS_SUPPORT_MEMBRANE_CRACKS_H

#include "tests/support/membrane_elastic.h"

#include "base/partition.h"

/* A free plate of 6 mm x 5 mm that expands: E 320 GPa, nu 0.3, rho 3300, G_c 200 J/m2, half the
 * critical step. */
static inline fracas_spec brittle_plate(int64_t order, int64_t divisions, double rate, double end)
{
    fracas_spec spec = membrane_spec(&fracas_shape_plate, order, divisions);
    spec.geometry.width = 6e-3;
    spec.geometry.height = 5e-3;
    spec.loading.rate = rate;
    spec.time.end = end;
    spec.time.safety = 0.5;
    return spec;
}

static inline void hold_edges(fracas_spec *spec, const fracas_kind *kind)
{
    for (int i = 0; i < FRACAS_EDGES; i++) spec->geometry.edge[i] = kind;
}

/* Sums of some elements over nodes k, l, without the harvest: mass, M_kl x_l, M_kl v_l, x_k x M_kl
 * v_l, with x displaced; sum of |M_kl v_l|. */
typedef struct {
    double mass, centre[2], momentum[2], moment_moved, scale;
    int64_t elements;
} membrane_sums;

static inline void add_sums(const fracas_batch *batch, size_t e, membrane_sums *sums)
{
    const fracas_model *model = batch->model;
    for (size_t k = 0; k < model->surface->corners; k++) {
        const double *x = node_at(model, e, k);
        double p[2] = {0}, moved[2];
        for (size_t i = 0; i < 2; i++) {
            moved[i] = x[i] + *value_at(batch, e, SURFACE_U, 2 * k + i);
            for (size_t l = 0; l < model->surface->corners; l++) {
                p[i] += mass_between(model, e, k, l) * *value_at(batch, e, SURFACE_V, 2 * l + i);
                sums->centre[i] += mass_between(model, e, k, l) *
                                   (node_at(model, e, l)[i] +
                                    *value_at(batch, e, SURFACE_U, 2 * l + i));
            }
            sums->momentum[i] += p[i];
            sums->scale += fabs(p[i]);
        }
        for (size_t l = 0; l < model->surface->corners; l++)
            sums->mass += mass_between(model, e, k, l);
        sums->moment_moved += moved[0] * p[1] - moved[1] * p[0];
    }
    sums->elements++;
}

static inline membrane_sums sums_of(const fracas_batch *batch)
{
    membrane_sums sums = {0};
    for (size_t e = 0; e < batch->model->elements; e++) add_sums(batch, e, &sums);
    return sums;
}

/* Labels the elements by the interfaces that `joins` says hold; returns how many sets. `label`
 * [elements]. Not by union-find: labels are passed on until nothing changes. */
typedef bool interface_joins(const fracas_interface_row *row, double time);

static inline int64_t label_fragments(const fracas_model *model, const fracas_interface_row *row,
                                      interface_joins *joins, double time, size_t *label)
{
    for (size_t e = 0; e < model->elements; e++) label[e] = e;
    for (bool changed = true; changed;) {
        changed = false;
        for (size_t i = 0; i < model->interfaces; i++) {
            const uint32_t *element = model->surface->interface[i].element;
            const size_t a = label[element[0]], b = label[element[1]];
            if (a == b || !joins(&row[i], time)) continue;
            label[element[0]] = label[element[1]] = a < b ? a : b;
            changed = true;
        }
    }
    int64_t count = 0;
    for (size_t e = 0; e < model->elements; e++) count += label[e] == e;
    return count;
}

static inline bool is_not_broken(const fracas_interface_row *row, double unused)
{
    return row->damage < 1;
}

static inline bool is_not_broken_by(const fracas_interface_row *row, double time)
{
    return !(row->break_time <= time);
}

#endif
