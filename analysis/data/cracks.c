/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Interfaces break one after the other. A break leads from a crack to a vertex: such breaks
 * are the way of the crack, a tree. Where two cracks meet, the way goes on into
 * the younger one from there. Equations: docs/theory/cracks.md. */
#include "analysis/data/cracks.h"

#include "analysis/data/surface.h"
#include "base/own.h"
#include "base/partition.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { NONE = -1 };

typedef struct {
    int64_t crack;   /* at the root of its set; NONE: none */
    int64_t before;  /* the vertex before it on the way; NONE: the way begins here */
    double distance; /* m */
    double time;     /* s, when it was reached; NaN: in a notch */
    size_t degree;   /* broken interfaces */
    size_t first;    /* place in growth.at where its broken interfaces begin */
} vertex;

typedef struct {
    const fracas_stored_mesh *mesh;
    fracas_cracks *cracks;
    fracas_partition sets;
    vertex *vertex;
    int64_t *tip;   /* farthest vertex of each crack; NONE: it did not grow */
    size_t *at;     /* broken interfaces by vertices */
    uint8_t *way;   /* 1: the interface is on the way of its crack */
    double *weight; /* m, length of each broken interface; 0 in a notch */
    int64_t *stack; /* room for all vertices */
    double total;   /* m */
} growth;

static const double *place_of(const growth *of, int64_t v)
{
    return of->mesh->node[v].position;
}

static double between(const double a[3], const double b[3])
{
    return sqrt((b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) +
                (b[2] - a[2]) * (b[2] - a[2]));
}

/* Length of an interface [m]; along a parabola through its middle by Gauss' rule of three points.
 */
static double length_of(const fracas_stored_mesh *mesh, size_t i)
{
    static const double at[3] = {-0.7745966692414834, 0, 0.7745966692414834},
                        weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    const int64_t *node = mesh->interface[i].node;
    const double *a = mesh->node[node[0]].position, *b = mesh->node[node[1]].position;
    if (node[2] < 0) return between(a, b);
    const double *m = mesh->node[node[2]].position, origin[3] = {0, 0, 0};
    double sum = 0;
    for (int q = 0; q < 3; q++) {
        double slope[3];
        for (int k = 0; k < 3; k++) slope[k] = (b[k] - a[k]) / 2 + at[q] * (a[k] + b[k] - 2 * m[k]);
        sum += weight[q] * between(origin, slope);
    }
    return sum;
}

static int64_t other_end(const growth *of, size_t i, int64_t v)
{
    const int64_t *node = of->mesh->interface[i].node;
    return node[0] == v ? node[1] : node[0];
}

/* ---- slopes ---- */

/* Slope of distance against time over the last `most` vertices of the way to `v`, down to a notch
 * (cracks.3); NaN of fewer than `least`, and where all have one time. */
static double slope_to(const growth *of, int64_t v, size_t least, size_t most)
{
    size_t n = 0;
    double time = 0, distance = 0, over = 0, under = 0;
    for (int64_t k = v; k != NONE && n < most && !isnan(of->vertex[k].time);
         k = of->vertex[k].before, n++) {
        time += of->vertex[k].time;
        distance += of->vertex[k].distance;
    }
    if (n < least) return NAN;
    time /= (double)n;
    distance /= (double)n;
    int64_t k = v;
    for (size_t i = 0; i < n; i++, k = of->vertex[k].before) {
        const double t = of->vertex[k].time - time;
        over += t * (of->vertex[k].distance - distance);
        under += t * t;
    }
    return under > 0 ? over / under : NAN;
}

/* ---- the end of a crack ---- */

/* Sets start, tip, extent and speed from the way as it is. */
static void finish_crack(growth *to, size_t number)
{
    fracas_crack *crack = &to->cracks->crack[number];
    int64_t first = to->tip[number];
    if (first == NONE) return;
    while (to->vertex[first].before != NONE && !isnan(to->vertex[first].time))
        first = to->vertex[first].before;
    for (int k = 0; k < 3; k++) crack->tip[k] = place_of(to, to->tip[number])[k];
    for (int k = 0; k < 3 && isnan(to->vertex[first].time); k++)
        crack->start[k] = place_of(to, first)[k];
    crack->extent = between(crack->start, crack->tip);
    crack->speed = slope_to(to, to->tip[number], 2, SIZE_MAX);
}

/* The crack has met an older one, which has all of it from now on. */
static void end_crack(growth *to, size_t number, size_t older, double time)
{
    fracas_crack *crack = &to->cracks->crack[number], *into = &to->cracks->crack[older];
    finish_crack(to, number);
    crack->met = older;
    crack->met_time = time;
    into->start_time = fmin(into->start_time, crack->start_time); /* NaN: a notch without breaks */
    into->fastest = fmax(into->fastest, crack->fastest);
    into->breaks += crack->breaks;
    into->branches += crack->branches;
    into->length += crack->length;
    into->notch += crack->notch;
}

/* ---- a break ---- */

static size_t begin_crack(growth *to, size_t i, double time)
{
    const size_t number = to->cracks->ncracks++;
    fracas_crack *crack = &to->cracks->crack[number];
    *crack = (fracas_crack){.start_time = NAN,
                            .end_time = NAN,
                            .start = {NAN, NAN, NAN},
                            .tip = {NAN, NAN, NAN},
                            .extent = NAN,
                            .speed = NAN,
                            .fastest = NAN,
                            .met = SIZE_MAX,
                            .met_time = NAN};
    to->tip[number] = NONE;
    if (!(time > 0)) return number;
    for (int k = 0; k < 3; k++)
        crack->start[k] = (place_of(to, to->mesh->interface[i].node[0])[k] +
                           place_of(to, to->mesh->interface[i].node[1])[k]) /
                          2;
    return number;
}

/* The vertex is reached from `before`, which is NONE where a crack starts  (cracks.2). */
static void reach(growth *to, size_t crack, int64_t v, int64_t before, double distance)
{
    to->vertex[v].before = before;
    to->vertex[v].distance = distance;
    if (!(distance > to->cracks->crack[crack].reach)) return;
    to->cracks->crack[crack].reach = distance;
    to->tip[crack] = v;
}

static int64_t crack_of(growth *of, int64_t v)
{
    return of->vertex[fracas_partition_root(&of->sets, (uint32_t)v)].crack;
}

static void unite(growth *to, int64_t a, int64_t b, size_t crack)
{
    fracas_partition_unite(&to->sets, (uint32_t)a, (uint32_t)b);
    to->vertex[fracas_partition_root(&to->sets, (uint32_t)a)].crack = (int64_t)crack;
}

/* The way goes on from `from` over interface i to `v` and into the whole crack of v:
 * distances count from the start of the older crack. */
static void reroute(growth *to, size_t crack, int64_t from, int64_t v, size_t i)
{
    size_t depth = 0;
    reach(to, crack, v, from, to->vertex[from].distance + to->weight[i]);
    to->stack[depth++] = v;
    while (depth > 0) {
        const int64_t u = to->stack[--depth];
        const vertex *here = &to->vertex[u];
        for (size_t k = here->first; k < here[1].first; k++) {
            const size_t j = to->at[k];
            const int64_t w = other_end(to, j, u);
            if (!to->way[j] || w == here->before) continue;
            reach(to, crack, w, u, here->distance + to->weight[j]);
            to->stack[depth++] = w;
        }
    }
}

static size_t start_here(growth *to, size_t i, double time)
{
    const int64_t *node = to->mesh->interface[i].node;
    const size_t crack = begin_crack(to, i, time);
    for (int end = 0; end < 2; end++) {
        reach(to, crack, node[end], NONE, to->weight[i] / 2);
        to->vertex[node[end]].time = time > 0 ? time : NAN;
    }
    to->vertex[node[1]].before = time > 0 ? NONE : node[0];
    to->way[i] = 1;
    unite(to, node[0], node[1], crack);
    return crack;
}

/* Joins the ends of interface i; *tip: the farther one. */
static size_t join(growth *to, size_t i, double time, int64_t *tip, bool *closes)
{
    int64_t a = to->mesh->interface[i].node[0], b = to->mesh->interface[i].node[1];
    int64_t of_a = crack_of(to, a), of_b = crack_of(to, b);
    *tip = b;
    *closes = of_a != NONE && of_a == of_b;
    if (of_a == NONE && of_b == NONE) return start_here(to, i, time);
    if (*closes) {
        *tip = to->vertex[a].distance > to->vertex[b].distance ? a : b;
        return (size_t)of_a;
    }
    if (of_a == NONE || (of_b != NONE && of_b < of_a)) { /* from a, of the older crack, to b */
        const int64_t c = a, of_c = of_a;
        a = b, of_a = of_b;
        b = c, of_b = of_c;
    }
    if (of_b == NONE) {
        to->vertex[b].time = time > 0 ? time : NAN;
        reach(to, (size_t)of_a, b, a, to->vertex[a].distance + to->weight[i]);
    } else {
        end_crack(to, (size_t)of_b, (size_t)of_a, time);
        reroute(to, (size_t)of_a, a, b, i);
    }
    to->way[i] = 1;
    unite(to, a, b, (size_t)of_a);
    *tip = b;
    return (size_t)of_a;
}

static void count_ends(growth *to, size_t i, size_t crack)
{
    for (int end = 0; end < 2; end++)
        if (++to->vertex[to->mesh->interface[i].node[end]].degree == 3)
            to->cracks->crack[crack].branches++;
}

/* The next break, with the length of all until it  (cracks.1). */
static void add_break(growth *to, size_t i, double time)
{
    int64_t tip;
    bool closes;
    const size_t number = join(to, i, time, &tip, &closes);
    fracas_crack *crack = &to->cracks->crack[number];
    count_ends(to, i, number);
    if (isnan(crack->start_time)) crack->start_time = time;
    crack->end_time = time;
    crack->breaks++;
    crack->length += to->weight[i];
    to->total += to->weight[i];
    fracas_crack_break *row = &to->cracks->broke[to->cracks->nbreaks++];
    *row = (fracas_crack_break){
        .time = time,
        .interface = i,
        .crack = number,
        .length = to->total,
        .crack_length = crack->length,
        .distance = to->vertex[tip].distance,
        .speed = closes ? NAN : slope_to(to, tip, FRACAS_CRACK_WINDOW, FRACAS_CRACK_WINDOW)};
    for (int k = 0; k < 3; k++) row->tip[k] = place_of(to, tip)[k];
    crack->fastest = fmax(crack->fastest, row->speed);
}

/* ---- all of them ---- */

/* They break at once, and no way is longer by them. Notches in touch are one; numbers of the
 * others are given again. */
static void add_notches(growth *to, const fracas_surface_break *sorted, size_t count)
{
    fracas_cracks *cracks = to->cracks;
    size_t kept = 0;
    for (size_t i = 0; i < count; i++) {
        int64_t tip;
        bool closes;
        const size_t crack = join(to, sorted[i].interface, 0, &tip, &closes);
        cracks->crack[crack].notch += length_of(to->mesh, sorted[i].interface);
        for (int end = 0; end < 2; end++)
            to->vertex[to->mesh->interface[sorted[i].interface].node[end]].degree++;
    }
    for (size_t c = 0; c < cracks->ncracks; c++) {
        if (cracks->crack[c].met != SIZE_MAX) continue;
        for (size_t v = 0; v < to->mesh->nnodes && kept < c; v++)
            if (to->vertex[v].crack == (int64_t)c) to->vertex[v].crack = (int64_t)kept;
        cracks->crack[kept++] = cracks->crack[c];
    }
    cracks->ncracks = kept;
}

/* Parts of cracks between two fragments at the end. */
static fracas_err find_between(const growth *of, const fracas_record *record)
{
    FRACAS_CLEARED(fracas_surface_state) state = {0};
    fracas_cracks *cracks = of->cracks;
    TRY(fracas_surface_state_create(of->mesh, record, INFINITY, &state));
    for (size_t k = 0; k < cracks->nbreaks; k++) {
        const fracas_crack_break *row = &cracks->broke[k];
        const int64_t *element = of->mesh->interface[row->interface].element;
        size_t crack = row->crack;
        while (cracks->crack[crack].met != SIZE_MAX) crack = cracks->crack[crack].met;
        if (state.fragment[element[0]] != state.fragment[element[1]])
            cracks->crack[crack].between += of->weight[row->interface];
    }
    for (size_t c = 0; c < cracks->ncracks; c++)
        if (cracks->crack[c].met != SIZE_MAX) cracks->crack[c].between = NAN;
    return FRACAS_OK;
}

/* Broken interfaces of every vertex. */
static void list_at_vertices(growth *to, const fracas_surface_break *sorted, size_t count)
{
    const size_t nnodes = to->mesh->nnodes;
    for (size_t k = 0; k < 2 * count; k++)
        to->vertex[to->mesh->interface[sorted[k / 2].interface].node[k % 2] + 1].first++;
    for (size_t v = 0; v < nnodes; v++) {
        to->vertex[v + 1].first += to->vertex[v].first;
        to->vertex[v].crack = NONE;
        to->vertex[v].before = (int64_t)to->vertex[v].first; /* where the next one goes */
    }
    for (size_t k = 0; k < 2 * count; k++) {
        const size_t i = sorted[k / 2].interface;
        to->at[to->vertex[to->mesh->interface[i].node[k % 2]].before++] = i;
    }
    for (size_t v = 0; v < nnodes; v++) to->vertex[v].before = NONE;
}

static fracas_err allocate(growth *to, size_t count)
{
    const size_t nnodes = to->mesh->nnodes;
    to->cracks->crack = calloc(count + 1, sizeof *to->cracks->crack);
    to->cracks->broke = calloc(count + 1, sizeof *to->cracks->broke);
    to->vertex = calloc(nnodes + 1, sizeof *to->vertex);
    to->tip = calloc(count + 1, sizeof *to->tip);
    to->at = calloc(2 * count + 1, sizeof *to->at);
    to->way = calloc(to->mesh->ninterfaces + 1, sizeof *to->way);
    to->weight = calloc(to->mesh->ninterfaces + 1, sizeof *to->weight);
    to->stack = calloc(nnodes + 1, sizeof *to->stack);
    if (!to->cracks->crack || !to->cracks->broke || !to->vertex || !to->tip || !to->at ||
        !to->way || !to->weight || !to->stack)
        return fracas_no_memory("the cracks of a surface");
    return fracas_partition_init(&to->sets, nnodes);
}

static void growth_clear(growth *to)
{
    fracas_partition_clear(&to->sets);
    free(to->vertex);
    free(to->tip);
    free(to->at);
    free(to->way);
    free(to->weight);
    free(to->stack);
}

fracas_err fracas_cracks_find(const fracas_stored_mesh *mesh, const fracas_record *record,
                              fracas_cracks *cracks)
{
    __attribute__((cleanup(growth_clear))) growth to = {.mesh = mesh, .cracks = cracks};
    OWNED fracas_surface_break *sorted = NULL;
    size_t count, notched = 0;
    *cracks = (fracas_cracks){0};
    TRY(fracas_surface_check(mesh, record));
    TRY(fracas_surface_breaks(record, &sorted, &count));
    TRY(allocate(&to, count));
    list_at_vertices(&to, sorted, count);
    while (notched < count && !(sorted[notched].time > 0)) notched++;
    for (size_t k = notched; k < count; k++)
        to.weight[sorted[k].interface] = length_of(mesh, sorted[k].interface);
    add_notches(&to, sorted, notched);
    for (size_t k = notched; k < count; k++) add_break(&to, sorted[k].interface, sorted[k].time);
    for (size_t c = 0; c < cracks->ncracks; c++)
        if (cracks->crack[c].met == SIZE_MAX) finish_crack(&to, c);
    return find_between(&to, record);
}

void fracas_cracks_clear(fracas_cracks *cracks)
{
    free(cracks->crack);
    free(cracks->broke);
    *cracks = (fracas_cracks){0};
}

size_t fracas_cracks_longest(const fracas_cracks *cracks)
{
    size_t longest = SIZE_MAX;
    for (size_t c = 0; c < cracks->ncracks; c++)
        if (cracks->crack[c].met == SIZE_MAX &&
            cracks->crack[c].length > (longest == SIZE_MAX ? 0 : cracks->crack[longest].length))
            longest = c;
    return longest;
}

/* ---- as tables ---- */

#define NUMBER(row, key, unit, doc, member) FRACAS_FIELD(row, NUMBER, key, unit, doc, member)
#define PLACE(row, key, doc, member)                      \
    NUMBER(row, key "_x", "m", doc ", x", member[0]),     \
        NUMBER(row, key "_y", "m", doc ", y", member[1]), \
        NUMBER(row, key "_z", "m", doc ", z", member[2])

static const fracas_field crack_fields[] = {
    NUMBER(fracas_crack, "start_time", "s", "time of its first break", start_time),
    PLACE(fracas_crack, "start", "where the way to its tip begins", start),
    NUMBER(fracas_crack, "end_time", "s", "time of its last break", end_time),
    FRACAS_FIELD(fracas_crack, INTEGER, "breaks", "1",
                 "its interfaces that broke, those of cracks that it met included", breaks),
    NUMBER(fracas_crack, "length", "m", "their length", length),
    NUMBER(fracas_crack, "notch", "m", "length of its notches, broken from the start", notch),
    NUMBER(fracas_crack, "between", "m", "part of the length between two fragments at the end",
           between),
    NUMBER(fracas_crack, "reach", "m", "largest distance of its tip from the start, along its way",
           reach),
    PLACE(fracas_crack, "tip", "place of that tip before any motion", tip),
    NUMBER(fracas_crack, "extent", "m", "straight distance from start to tip", extent),
    FRACAS_FIELD(fracas_crack, INTEGER, "branches", "1",
                 "vertices of three or more broken interfaces", branches),
    NUMBER(fracas_crack, "speed", "m/s", "slope of distance against time on the whole way", speed),
    NUMBER(fracas_crack, "fastest", "m/s", "largest speed of its breaks", fastest),
    FRACAS_FIELD(fracas_crack, INDEX, "met", "1", "the older crack that it met, and is part of",
                 met),
    NUMBER(fracas_crack, "met_time", "s", "time at which it met that one", met_time),
};
static const fracas_field break_fields[] = {
    NUMBER(fracas_crack_break, "time", "s", "time of the break", time),
    FRACAS_FIELD(fracas_crack_break, INDEX, "interface", "1",
                 "row of the interface in its realization, from 0", interface),
    FRACAS_FIELD(fracas_crack_break, INDEX, "crack", "1",
                 "its crack, or the older of the two that it joins", crack),
    NUMBER(fracas_crack_break, "length", "m", "length of all cracks by then", length),
    NUMBER(fracas_crack_break, "crack_length", "m", "length of this crack by then", crack_length),
    PLACE(fracas_crack_break, "tip", "place of its tip before any motion", tip),
    NUMBER(fracas_crack_break, "distance", "m", "distance of the tip from the start, along the way",
           distance),
    NUMBER(fracas_crack_break, "speed", "m/s",
           "slope of distance against time over the last 8 vertices of the way", speed),
};
const fracas_fields fracas_crack_fields = FRACAS_FIELDS(crack_fields);
const fracas_fields fracas_crack_break_fields = FRACAS_FIELDS(break_fields);
