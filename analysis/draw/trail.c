/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/trail.h"

#include "analysis/data/room.h"

#include <math.h>
#include <stdlib.h>

fracas_err fracas_trail_add(fracas_trail *trail, const int64_t node[3], bool backwards)
{
    TRY(fracas_grow(&trail->edge, sizeof *trail->edge, trail->count, &trail->capacity,
                    "the lines of a picture"));
    trail->edge[trail->count++] = (fracas_trail_edge){
        {(uint32_t)node[backwards], (uint32_t)node[!backwards]}, (int32_t)node[2]};
    return FRACAS_OK;
}

void fracas_trail_clear(fracas_trail *trail)
{
    free(trail->edge);
    *trail = (fracas_trail){0};
}

/* ---- which edges leave a node ---- */

typedef struct {
    fracas_room room;
    size_t nnodes;
    uint32_t *node;       /* nodes with an edge, ascending; edges know them by their place here */
    uint32_t (*place)[2]; /* for the ends of each edge */
    size_t *first;        /* for each node, in `leaving` */
    size_t *next;         /* for each node its first edge not known to be used */
    size_t *leaving;      /* 2 edge + 1 if the edge is gone through backwards */
    bool *used;           /* for each edge */
} departures;

static int by_number(const void *a, const void *b)
{
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* A mesh has far more nodes than most trails have. */
static fracas_err list_nodes(const fracas_trail *trail, departures *from)
{
    FRACAS_TAKE(&from->room, from->node, 2 * trail->count);
    FRACAS_TAKE(&from->room, from->place, trail->count);
    TRY(fracas_room_check(&from->room, "the lines of a picture"));
    for (size_t e = 0; e < trail->count; e++)
        for (int end = 0; end < 2; end++)
            from->node[2 * e + (size_t)end] = trail->edge[e].node[end];
    qsort(from->node, 2 * trail->count, sizeof *from->node, by_number);
    for (size_t k = 0; k < 2 * trail->count; k++)
        if (k == 0 || from->node[k] != from->node[from->nnodes - 1])
            from->node[from->nnodes++] = from->node[k];
    for (size_t e = 0; e < trail->count; e++)
        for (int end = 0; end < 2; end++) {
            const uint32_t *found = bsearch(&trail->edge[e].node[end], from->node, from->nnodes,
                                            sizeof *from->node, by_number);
            from->place[e][end] = (uint32_t)(found - from->node);
        }
    return FRACAS_OK;
}

static fracas_err list_departures(const fracas_trail *trail, bool closed, departures *from)
{
    size_t *start; /* node of each way */
    TRY(list_nodes(trail, from));
    FRACAS_TAKE(&from->room, start, 2 * trail->count);
    FRACAS_TAKE(&from->room, from->next, from->nnodes);
    FRACAS_TAKE(&from->room, from->used, trail->count);
    TRY(fracas_room_check(&from->room, "the lines of a picture"));
    for (size_t way = 0; way < 2 * trail->count; way++)
        start[way] = closed && way % 2 ? SIZE_MAX : from->place[way / 2][way % 2];
    TRY(fracas_room_groups(&from->room, start, 2 * trail->count, from->nnodes, &from->first,
                           &from->leaving));
    for (size_t n = 0; n < from->nnodes; n++) from->next[n] = from->first[n];
    return FRACAS_OK;
}

/* The next edge to go on with from a node, SIZE_MAX if none is left; marks it used. */
static size_t depart(departures *from, size_t node)
{
    while (from->next[node] < from->first[node + 1]) {
        size_t way = from->leaving[from->next[node]++];
        if (from->used[way / 2]) continue;
        from->used[way / 2] = true;
        return way;
    }
    return SIZE_MAX;
}

/* ---- writing ---- */

typedef struct {
    const fracas_spot *spot;
    FILE *out;
    char command; /* the last one */
} trail_pen;

static void put_pair(trail_pen *pen, char command, int32_t dx, int32_t dy)
{
    if (command != pen->command) putc(command, pen->out);
    else if (dx >= 0) putc(' ', pen->out); /* a sign separates as well */
    pen->command = command;
    fprintf(pen->out, "%d%s%d", (int)dx, dy < 0 ? "" : " ", (int)dy);
}

/* A parabola through the middle where the middle is off the straight line (by more than a unit),
 * else the line. */
static void put_edge(trail_pen *pen, const fracas_trail_edge *edge, bool backwards)
{
    const fracas_spot a = pen->spot[edge->node[backwards]], b = pen->spot[edge->node[!backwards]];
    if (edge->middle >= 0) {
        const fracas_spot m = pen->spot[edge->middle];
        const int32_t bow[2] = {2 * m.x - a.x - b.x, 2 * m.y - a.y - b.y};
        if (abs(bow[0]) > 2 || abs(bow[1]) > 2) {
            put_pair(pen, 'q', 2 * m.x - (a.x + b.x) / 2 - a.x, 2 * m.y - (a.y + b.y) / 2 - a.y);
            put_pair(pen, 'q', b.x - a.x, b.y - a.y);
            return;
        }
    }
    put_pair(pen, 'l', b.x - a.x, b.y - a.y);
}

/* One line as long as it gets from a node; nothing if no edge leaves it. */
static void put_line(trail_pen *pen, const fracas_trail *trail, departures *from, size_t node,
                     bool closed)
{
    size_t way = depart(from, node);
    if (way == SIZE_MAX) return;
    pen->command = 'M';
    fprintf(pen->out, "M%d %d", (int)pen->spot[from->node[node]].x,
            (int)pen->spot[from->node[node]].y);
    for (; way != SIZE_MAX; way = depart(from, node)) {
        put_edge(pen, &trail->edge[way / 2], way % 2);
        node = from->place[way / 2][way % 2 == 0];
    }
    if (closed) putc('z', pen->out);
}

static void put_lines(const fracas_trail *trail, const fracas_spot *spot, bool closed,
                      departures *from, const char *class, FILE *out)
{
    trail_pen pen = {.spot = spot, .out = out};
    fprintf(out, "<path class=\"%s\"%s d=\"", class, closed ? " fill-rule=\"evenodd\"" : "");
    for (size_t n = 0; n < from->nnodes && !closed; n++) /* open lines start there */
        if ((from->first[n + 1] - from->first[n]) % 2 == 1) put_line(&pen, trail, from, n, false);
    for (size_t n = 0; n < from->nnodes; n++)
        while (from->next[n] < from->first[n + 1]) put_line(&pen, trail, from, n, closed);
    fputs("\"/>\n", out);
}

fracas_err fracas_trail_write(const fracas_trail *trail, const fracas_spot *spot, bool closed,
                              const char *class, FILE *out)
{
    if (trail->count == 0) return FRACAS_OK;
    departures from = {0};
    fracas_err err = list_departures(trail, closed, &from);
    if (!err) put_lines(trail, spot, closed, &from, class, out);
    fracas_room_clear(&from.room);
    return err;
}

static const double tallest = 1.3; /* height/width, at most */

void fracas_frame_fit(const double least[2], const double largest[2], int width,
                      fracas_frame *frame)
{
    const double room = width - 2 * FRACAS_FRAME_MARGIN,
                 extent[2] = {largest[0] - least[0], largest[1] - least[1]};
    frame->scale = fmin(room / extent[0], tallest * width / extent[1]);
    frame->width = extent[0] * frame->scale;
    frame->height = extent[1] * frame->scale;
    frame->left = (width - frame->width) / 2;
    frame->corner[0] = least[0];
    frame->corner[1] = largest[1];
}

fracas_spot fracas_frame_place(const fracas_frame *frame, const double *at)
{
    const double x = frame->left + (at[0] - frame->corner[0]) * frame->scale;
    const double y = FRACAS_FRAME_MARGIN + (frame->corner[1] - at[1]) * frame->scale;
    return (fracas_spot){(int32_t)lround(FRACAS_FRAME_UNITS * x),
                         (int32_t)lround(FRACAS_FRAME_UNITS * y)};
}
