/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/surface.h"

#include "base/partition.h"
#include "base/own.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

fracas_err fracas_surface_check(const fracas_stored_mesh *mesh, const fracas_record *record)
{
    if (record->ninterface == mesh->ninterfaces) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "a realization has %zu interfaces, the mesh of its point %zu; `fracas "
                       "verify` checks the study",
                       record->ninterface, mesh->ninterfaces);
}

/* ---- at one time ---- */

static fracas_interface_state state_of(const fracas_interface_row *row, double time)
{
    if (row->break_time <= time) return FRACAS_INTERFACE_BROKEN; /* NaN: never */
    return row->onset_time <= time ? FRACAS_INTERFACE_CRACKED : FRACAS_INTERFACE_CLOSED;
}

static fracas_err find_fragments(const fracas_stored_mesh *mesh, fracas_surface_state *state)
{
    fracas_partition partition;
    TRY(fracas_partition_init(&partition, mesh->nelements));
    for (size_t i = 0; i < mesh->ninterfaces; i++)
        if (state->interface[i] != FRACAS_INTERFACE_BROKEN)
            fracas_partition_unite(&partition, (uint32_t)mesh->interface[i].element[0],
                                   (uint32_t)mesh->interface[i].element[1]);
    state->nfragments = fracas_partition_label(&partition);
    state->fragment = partition.label;
    partition.label = NULL;
    fracas_partition_clear(&partition);
    state->elements = calloc(state->nfragments + 1, sizeof *state->elements);
    if (!state->elements) return fracas_no_memory("the fragments of a surface");
    for (size_t e = 0; e < mesh->nelements; e++) state->elements[state->fragment[e]]++;
    for (size_t f = 0; f < state->nfragments; f++)
        state->ndust += state->elements[f] <= FRACAS_SURFACE_DUST;
    return FRACAS_OK;
}

fracas_err fracas_surface_state_create(const fracas_stored_mesh *mesh, const fracas_record *record,
                                       double time, fracas_surface_state *state)
{
    *state = (fracas_surface_state){.time = time};
    TRY(fracas_surface_check(mesh, record));
    state->interface = malloc(mesh->ninterfaces + 1);
    if (!state->interface) return fracas_no_memory("the interfaces of a surface");
    for (size_t i = 0; i < mesh->ninterfaces; i++) {
        state->interface[i] = (uint8_t)state_of(&record->interface[i], time);
        state->ncracked += state->interface[i] == FRACAS_INTERFACE_CRACKED;
        state->nbroken += state->interface[i] == FRACAS_INTERFACE_BROKEN;
    }
    return find_fragments(mesh, state);
}

void fracas_surface_state_clear(fracas_surface_state *state)
{
    free(state->interface);
    free(state->fragment);
    free(state->elements);
    *state = (fracas_surface_state){0};
}

/* ---- a crack through the width ---- */

static int by_time(const void *a, const void *b)
{
    const fracas_surface_break *x = a, *y = b;
    if (x->time != y->time) return x->time < y->time ? -1 : 1;
    return (x->interface > y->interface) - (x->interface < y->interface);
}

fracas_err fracas_surface_breaks(const fracas_record *record, fracas_surface_break **sorted,
                                 size_t *count)
{
    *count = 0;
    *sorted = malloc((record->ninterface + 1) * sizeof **sorted);
    if (!*sorted) return fracas_no_memory("the broken interfaces of a surface");
    for (size_t i = 0; i < record->ninterface; i++)
        if (isfinite(record->interface[i].break_time))
            (*sorted)[(*count)++] = (fracas_surface_break){record->interface[i].break_time, i};
    qsort(*sorted, *count, sizeof **sorted, by_time);
    return FRACAS_OK;
}

/* Sides touched by a vertex, or by the crack with this root: bits 1 and 2. False if a side is empty
 * or both touch. */
static bool mark_sides(const fracas_stored_mesh *mesh, const int64_t tag[2], uint8_t *touches)
{
    bool apart = true;
    unsigned found = 0;
    for (size_t b = 0; b < mesh->nborders; b++)
        for (unsigned side = 0; side < 2; side++) {
            if (mesh->border[b].tag != tag[side]) continue;
            found |= 1u << side;
            for (int end = 0; end < 2; end++) {
                uint8_t *at = &touches[mesh->border[b].node[end]];
                *at |= (uint8_t)(1u << side);
                if (*at == 3) apart = false;
            }
        }
    return apart && found == 3;
}

/* Lets the interfaces break one after the other until a crack touches both sides. */
static double break_through(const fracas_stored_mesh *mesh, const fracas_surface_break *sorted,
                            size_t count, fracas_partition *cracks, uint8_t *touches)
{
    for (size_t i = 0; i < count; i++) {
        const int64_t *node = mesh->interface[sorted[i].interface].node;
        const uint32_t a = fracas_partition_root(cracks, (uint32_t)node[0]);
        const uint32_t b = fracas_partition_root(cracks, (uint32_t)node[1]);
        const uint8_t both = touches[a] | touches[b];
        fracas_partition_unite(cracks, a, b);
        touches[fracas_partition_root(cracks, a)] = both;
        if (both == 3) return sorted[i].time;
    }
    return NAN;
}

fracas_err fracas_surface_through(const fracas_stored_mesh *mesh, const fracas_record *record,
                                  const int64_t tag[2], double *time)
{
    FRACAS_CLEARED(fracas_partition) cracks = {0};
    size_t count = 0;
    *time = NAN;
    TRY(fracas_surface_check(mesh, record));
    OWNED fracas_surface_break *sorted = NULL;
    OWNED uint8_t *touches = calloc(mesh->nnodes + 1, 1);
    if (!touches) return fracas_no_memory("the vertices of a surface");
    if (!mark_sides(mesh, tag, touches)) return FRACAS_OK;
    TRY(fracas_surface_breaks(record, &sorted, &count));
    TRY(fracas_partition_init(&cracks, mesh->nnodes));
    *time = break_through(mesh, sorted, count, &cracks, touches);
    return FRACAS_OK;
}

void fracas_surface_first_times(const fracas_record *record, fracas_surface_times *times)
{
    *times = (fracas_surface_times){NAN, NAN, {NAN, NAN}};
    for (size_t i = 0; i < record->ninterface; i++) {
        times->onset = fmin(times->onset, record->interface[i].onset_time);
        if (record->interface[i].break_time > 0) /* 0: before the start, in a notch */
            times->broken = fmin(times->broken, record->interface[i].break_time);
    }
}

fracas_err fracas_surface_times_of(const fracas_stored_mesh *mesh, const fracas_record *record,
                                   fracas_surface_times *times)
{
    static const int64_t pair[2][2] = {{1, 2}, {3, 4}};
    fracas_surface_first_times(record, times);
    TRY(fracas_surface_check(mesh, record));
    for (int k = 0; k < 2; k++)
        TRY(fracas_surface_through(mesh, record, pair[k], &times->through[k]));
    return FRACAS_OK;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The different times at which interfaces broke, ascending, to `at`; how many. */
static size_t list_breaks(const fracas_record *record, double *at)
{
    size_t count = 0, kept = 0;
    for (size_t i = 0; i < record->ninterface; i++)
        if (record->interface[i].break_time > 0) /* NaN: never, 0: before the start */
            at[count++] = record->interface[i].break_time;
    qsort(at, count, sizeof *at, by_value);
    for (size_t i = 0; i < count; i++)
        if (kept == 0 || at[i] > at[kept - 1]) at[kept++] = at[i];
    return kept;
}

fracas_err fracas_surface_moments(const fracas_record *record, double *time, size_t *count)
{
    const double onset = record->onset_time, end = record->end_time;
    const size_t n = *count;
    OWNED double *at = malloc((record->ninterface + 1) * sizeof *at);
    if (!at) return fracas_no_memory("the times of pictures");
    if (!(onset < end)) *count = n > 0;
    const size_t breaks = list_breaks(record, at);
    for (size_t k = 0; k + 1 < *count; k++)
        time[k] = breaks >= n ? at[(k + 1) * breaks / n - 1]
                              : onset + (end - onset) * ((double)(k + 1) / (double)n);
    if (*count > 0) time[*count - 1] = end;
    return FRACAS_OK;
}
