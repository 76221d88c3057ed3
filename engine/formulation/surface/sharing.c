/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/sharing.h"

#include "engine/formulation/surface/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { COUNTS = 3 /* numbers of a lane's events: onsets, breaks, first onset */ };

struct fracas_surface_sharing {
    const fracas_peers *peers;
    size_t nblocks;
    size_t *block, *element, *interface; /* [peers + 1]: first one of each; interfaces by their
                                            first elements */
    uint32_t (*cut)[2]; /* elements of an interface between two peers: here, there; peer by peer */
    size_t *cut_end;    /* [peers + 1]: of those with the peers before */
    fracas_parcel *out, *in;                                     /* [peers] */
    int64_t cracked[FRACAS_LANES_MAX], broken[FRACAS_LANES_MAX]; /* before this step */
};

/* ---- shares ---- */

static size_t peer_of(const fracas_surface_sharing *s, size_t element)
{
    size_t peer = 0;
    while (element >= s->element[peer + 1]) peer++;
    return peer;
}

static bool is_mine(const fracas_surface_sharing *s, size_t element)
{
    return element >= s->element[s->peers->number] && element < s->element[s->peers->number + 1];
}

/* The other peer at an interface, and which side is here; false: all or nothing is. */
static bool is_cut(const fracas_surface_sharing *s, const uint32_t pair[2], size_t *peer, int *here)
{
    *here = is_mine(s, pair[0]) ? 0 : 1;
    if (is_mine(s, pair[0]) == is_mine(s, pair[1])) return false;
    *peer = peer_of(s, pair[1 - *here]);
    return true;
}

static void find_cuts(fracas_surface_sharing *s, const fracas_surface_tables *t, bool fill)
{
    size_t peer;
    int here;
    for (size_t i = 0; i < t->ninterfaces; i++) {
        const uint32_t *pair = t->element[i];
        if (!is_cut(s, pair, &peer, &here)) continue;
        const size_t at = s->cut_end[peer + 1]++;
        if (!fill) continue;
        s->cut[at][0] = pair[here];
        s->cut[at][1] = pair[1 - here];
    }
}

/* The end of the greatest branch of the tree of blocks that begins at `block` and ends before `to`.
 */
static size_t branch_end(const fracas_surface_sharing *s, size_t block, size_t to)
{
    size_t size = 1;
    while (size < s->nblocks && block % (2 * size) == 0 &&
           (block + 2 * size <= to || to == s->nblocks))
        size *= 2;
    return block + size;
}

static size_t branches_of(const fracas_surface_sharing *s, size_t peer)
{
    size_t count = 0;
    const size_t to = s->block[peer + 1];
    for (size_t b = s->block[peer]; b < to; b = branch_end(s, b, to)) count++;
    return count;
}

/* Doubles that `from` tells another peer, of `width` lanes; `with`: which of the two is not here.
 */
static size_t message_size(const fracas_surface_sharing *s, const fracas_surface_constants *c,
                           size_t from, size_t with, size_t width)
{
    const size_t cuts = s->cut_end[with + 1] - s->cut_end[with];
    return width *
           (branches_of(s, from) * SURFACE_SUMS + COUNTS + cuts * fracas_surface_element_fields(c));
}

/* ---- room ---- */

void fracas_surface_sharing_destroy(fracas_surface_sharing *s)
{
    if (!s) return;
    for (size_t p = 0; s->out && s->in && p < s->peers->count; p++) {
        free(s->out[p].bytes);
        free(s->in[p].bytes);
    }
    void *const owned[] = {s->block, s->element, s->interface, s->cut, s->cut_end, s->out, s->in};
    for (size_t i = 0; i < FRACAS_COUNT(owned); i++) free(owned[i]);
    free(s);
}

static void set_shares(fracas_surface_sharing *s, const fracas_surface_tables *t)
{
    size_t i = 0;
    for (size_t p = 0; p <= s->peers->count; p++) {
        s->block[p] = fracas_surface_share(s->nblocks, p, s->peers->count);
        s->element[p] = s->block[p] * SURFACE_BLOCK;
        if (s->element[p] > t->nelements) s->element[p] = t->nelements;
        while (i < t->ninterfaces && t->element[i][0] < s->element[p]) i++;
        s->interface[p] = i;
    }
}

static fracas_err set_cuts(fracas_surface_sharing *s, const fracas_surface_tables *t)
{
    find_cuts(s, t, false);
    for (size_t p = 0; p < s->peers->count; p++) s->cut_end[p + 1] += s->cut_end[p];
    s->cut = malloc((s->cut_end[s->peers->count] + 1) * sizeof *s->cut);
    if (!s->cut) return fracas_no_memory("a shared body");
    memmove(s->cut_end + 1, s->cut_end, s->peers->count * sizeof *s->cut_end);
    find_cuts(s, t, true);
    return FRACAS_OK;
}

static fracas_err set_parcels(fracas_surface_sharing *s, const fracas_surface_constants *c)
{
    for (size_t p = 0; p < s->peers->count; p++) {
        if (p == s->peers->number) continue;
        s->out[p].bytes = malloc(sizeof(double) *
                                 message_size(s, c, s->peers->number, p, FRACAS_LANES_MAX));
        s->in[p].bytes = malloc(sizeof(double) * message_size(s, c, p, p, FRACAS_LANES_MAX));
        if (!s->out[p].bytes || !s->in[p].bytes) return fracas_no_memory("a shared body");
    }
    return FRACAS_OK;
}

static fracas_err fill(fracas_surface_sharing *s, const fracas_surface_constants *c)
{
    const size_t count = s->peers->count + 1;
    size_t **const array[] = {&s->block, &s->element, &s->interface, &s->cut_end};
    for (size_t i = 0; i < FRACAS_COUNT(array); i++)
        if (!(*array[i] = calloc(count + 1, sizeof **array[i])))
            return fracas_no_memory("a shared body");
    s->out = calloc(count, sizeof *s->out);
    s->in = calloc(count, sizeof *s->in);
    if (!s->out || !s->in) return fracas_no_memory("a shared body");
    set_shares(s, c->tables);
    TRY(set_cuts(s, c->tables));
    return set_parcels(s, c);
}

fracas_err fracas_surface_sharing_create(const fracas_surface_constants *c,
                                         const fracas_peers *peers, fracas_surface_sharing **out)
{
    fracas_surface_sharing *s = calloc(1, sizeof *s);
    if (!s) return fracas_no_memory("a shared body");
    s->peers = peers;
    s->nblocks = fracas_surface_blocks(c->tables);
    fracas_err err = fill(s, c);
    if (err) fracas_surface_sharing_destroy(s);
    else *out = s;
    return err;
}

/* ---- a step ---- */

void fracas_surface_sharing_begin(fracas_surface_sharing *s, const fracas_step *step)
{
    memcpy(s->cracked, step->cracked, sizeof s->cracked);
    memcpy(s->broken, step->broken, sizeof s->broken);
}

/* Doubles between a message, moved on, and the state. */
static void move(double **message, double *at, size_t count, bool load)
{
    memcpy(load ? at : *message, load ? *message : at, count * sizeof *at);
    *message += count;
}

/* All that `peer` tells this one, or is told. */
static void move_all(const fracas_surface_sharing *s, const fracas_surface_constants *c,
                     const fracas_step *step, size_t peer, bool load, double *message)
{
    const fracas_surface_division *division = step->division.plan;
    const size_t from = load ? peer : s->peers->number, to = s->block[from + 1],
                 lanes = (size_t)step->lanes, fields = fracas_surface_element_fields(c);
    for (int first = 0; first < step->width; first += step->lanes) {
        for (size_t b = s->block[from]; b < to; b = branch_end(s, b, to))
            move(&message, fracas_surface_field(step, division->sums + b * SURFACE_SUMS, first),
                 SURFACE_SUMS * lanes, load);
        for (size_t i = s->cut_end[peer]; i < s->cut_end[peer + 1]; i++)
            move(&message, fracas_surface_field(step, s->cut[i][load] * fields, first),
                 fields * lanes, load);
    }
}

/* Each lane's events in this step, behind the rest. */
static void tell_events(const fracas_surface_sharing *s, const fracas_step *step, double *message)
{
    for (int l = 0; l < step->width; l++, message += COUNTS) {
        message[0] = (double)(step->cracked[l] - s->cracked[l]);
        message[1] = (double)(step->broken[l] - s->broken[l]);
        message[2] = step->first_onset[l];
    }
}

static void hear_events(fracas_step *step, const double *message)
{
    for (int l = 0; l < step->width; l++, message += COUNTS) {
        step->cracked[l] += (int64_t)message[0];
        step->broken[l] += (int64_t)message[1];
        step->first_onset[l] = fmin(step->first_onset[l], message[2]);
    }
}

static fracas_err exchange(fracas_surface_sharing *s, const fracas_surface_constants *c,
                           fracas_step *step)
{
    const size_t width = (size_t)step->width, counts = width * COUNTS;
    for (size_t p = 0; p < s->peers->count; p++) {
        if (p == s->peers->number) continue;
        const size_t size = message_size(s, c, s->peers->number, p, width);
        s->out[p].size = size * sizeof(double);
        s->in[p].size = message_size(s, c, p, p, width) * sizeof(double);
        move_all(s, c, step, p, false, s->out[p].bytes);
        tell_events(s, step, (double *)s->out[p].bytes + size - counts);
    }
    TRY(s->peers->exchange(s->peers->context, s->out, s->in));
    for (size_t p = 0; p < s->peers->count; p++) {
        if (p == s->peers->number) continue;
        move_all(s, c, step, p, true, s->in[p].bytes);
        hear_events(step, (double *)s->in[p].bytes + s->in[p].size / sizeof(double) - counts);
    }
    return FRACAS_OK;
}

void fracas_surface_sharing_add(const fracas_surface_sharing *s, double *sums, size_t size)
{
    for (size_t apart = 1; apart < s->nblocks; apart *= 2) {
        size_t done = SIZE_MAX;
        for (size_t p = 1; p < s->peers->count; p++) {
            const size_t to = s->block[p], b = to / (2 * apart) * (2 * apart);
            if (b == to || b == done || to == s->nblocks || b + apart >= s->nblocks) continue;
            for (size_t i = 0; i < size; i++) sums[b * size + i] += sums[(b + apart) * size + i];
            done = b;
        }
    }
}

fracas_err fracas_surface_share_step(const fracas_model *model, fracas_step *step)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const fracas_surface_division *division = step->division.plan;
    fracas_surface_sharing *s = division->sharing;
    fracas_surface_add_blocks(&c, step, s->block[s->peers->number], s->block[s->peers->number + 1]);
    TRY(exchange(s, &c, step));
    fracas_surface_totals(&c, step);
    return FRACAS_OK;
}

/* ---- the whole state ---- */

/* Brings the rows of the others to the leading peer. */
static fracas_err gather_rows(const fracas_surface_sharing *s, void *rows, const size_t *from,
                              size_t size)
{
    const size_t count = s->peers->count, me = s->peers->number;
    OWNED fracas_parcel *parcel = calloc(2 * count, sizeof *parcel);
    if (!parcel) return fracas_no_memory("a shared body");
    for (size_t p = me ? me : 1; p < (me ? me + 1 : count); p++)
        parcel[me ? 0 : count + p] = (fracas_parcel){(char *)rows + from[p] * size,
                                                     (from[p + 1] - from[p]) * size};
    return s->peers->exchange(s->peers->context, parcel, parcel + count);
}

static fracas_err gather_all(const fracas_surface_sharing *s, const fracas_surface_constants *c,
                             fracas_step *step)
{
    const size_t number = sizeof(double), lanes = (size_t)step->lanes;
    double *const times[] = {step->onset_time, step->break_time};
    for (int first = 0; first < step->width; first += step->lanes) {
        TRY(gather_rows(s, fracas_surface_field(step, 0, first), s->element,
                        fracas_surface_element_fields(c) * lanes * number));
        TRY(gather_rows(s, fracas_surface_field(step, fracas_surface_interfaces_at(c), first),
                        s->interface, fracas_surface_interface_fields(c) * lanes * number));
    }
    for (size_t i = 0; step->onset_time && i < FRACAS_COUNT(times); i++)
        TRY(gather_rows(s, times[i], s->interface, (size_t)step->width * number));
    return FRACAS_OK;
}

fracas_err fracas_surface_gather(const fracas_model *model, fracas_step *step, int lane)
{
    const fracas_surface_constants c = fracas_surface_constants_of(model);
    const fracas_surface_division *division = step->division.plan;
    const fracas_surface_sharing *s = division->sharing;
    if (lane < 0) return gather_all(s, &c, step);
    OWNED bool *broken = malloc(model->interfaces + 1);
    if (!broken) return fracas_no_memory("a shared body");
    const size_t me = s->peers->number;
    for (size_t i = s->interface[me]; i < s->interface[me + 1]; i++)
        broken[i] = fracas_surface_is_broken(&c, step, i, lane);
    TRY(gather_rows(s, broken, s->interface, sizeof *broken));
    for (size_t i = s->interface[1]; me == 0 && i < model->interfaces; i++)
        if (broken[i] && !fracas_surface_is_broken(&c, step, i, lane))
            fracas_surface_break(&c, step, i, lane);
    return FRACAS_OK;
}
