/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths given by position: each interface takes the line of a file at its own place. Lines are
 * sorted into the cells of a grid with about as many cells as interfaces, so each interface looks
 * at a few lines. The order of the lines does not matter. */
#include "sampler/distribution/distribution.h"
#include "sampler/distribution/given.h"

#include "base/own.h"

#include <inttypes.h>

#define NEAR 1e-3 /* by the interfaces' spacing: a line so near to an interface lies on it */
#define NONE UINT32_MAX

/* A line of the file. */
typedef struct {
    double x[2];     /* m */
    double strength; /* Pa */
    int64_t line;
    uint32_t next;      /* the next of its cell, or NONE */
    uint32_t interface; /* the line at its place, or NONE */
} place;

/* The next place, without its cell; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_place(fracas_lines *lines, place *p, bool *found)
{
    static const char form[] = "x [m], y [m], strength [Pa]";
    *found = fracas_lines_next_row(lines);
    if (!*found) return FRACAS_OK;
    TRY(fracas_lines_check_commas(lines, 3, "x,y,strength"));
    TRY(fracas_lines_number(lines, "x", form, &p->x[0]));
    TRY(fracas_lines_number(lines, "y", form, &p->x[1]));
    TRY(fracas_lines_number(lines, "strength", form, &p->strength));
    p->line = lines->line;
    p->next = p->interface = NONE;
    if (p->strength > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s:%" PRId64 ": a strength of %g Pa; it must be greater than 0",
                       lines->file->path, p->line, p->strength);
}

FRACAS_MUST_USE static fracas_err next_strength(fracas_lines *lines, double *value, bool *found)
{
    place p;
    TRY(next_place(lines, &p, found));
    if (*found) *value = p.strength;
    return FRACAS_OK;
}

/* ---- the match ---- */

/* Cells over the rectangle around the interfaces, and `near` more on each side. */
typedef struct {
    const fracas_attachment *file;
    place *place;
    size_t nplaces;
    double origin[2], spacing, near; /* m */
    size_t cells[2];
    uint32_t *head; /* a place of each cell, or NONE */
} grid;

static void grid_clear(grid *g)
{
    free(g->place);
    free(g->head);
}

/* Spacing s of a regular grid of n points over the rectangle, n = (w/s + 1)(h/s + 1); of a single
 * point, how far out it is. */
static double spacing_of(size_t n, const double least[2], const double most[2])
{
    const double w = most[0] - least[0], h = most[1] - least[1], rest = (double)(n - 1);
    const double out = fmax(fmax(fabs(least[0]), fabs(least[1])),
                            fmax(fabs(most[0]), fabs(most[1])));
    if (n > 1 && w + h > 0)
        return (w + h + sqrt((w + h) * (w + h) + 4 * rest * w * h)) / (2 * rest);
    return out > 0 ? out : 1;
}

FRACAS_MUST_USE static fracas_err read_places(grid *g)
{
    fracas_lines_summary of;
    bool found;
    TRY(fracas_lines_summarize(g->file, next_strength, &of));
    if (!(g->place = malloc(of.count * sizeof *g->place)))
        return fracas_no_memory("the strengths of a file");
    g->nplaces = of.count;
    fracas_lines lines = fracas_lines_begin(g->file);
    for (size_t k = 0; k < of.count; k++) TRY(next_place(&lines, &g->place[k], &found));
    return FRACAS_OK;
}

/* The cell of x [m], moved by `by` near-distances, along an axis; cells[axis] if it is outside. */
static size_t cell_of(const grid *g, int axis, double x, double by)
{
    const double cell = floor((x - g->origin[axis] + by * g->near) / g->spacing);
    return cell >= 0 && cell < (double)g->cells[axis] ? (size_t)cell : g->cells[axis];
}

FRACAS_MUST_USE static fracas_err grid_init(grid *g, size_t n, const double (*position)[3])
{
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    TRY(read_places(g));
    for (size_t i = 0; i < n; i++)
        for (int a = 0; a < 2; a++) {
            least[a] = fmin(least[a], position[i][a]);
            most[a] = fmax(most[a], position[i][a]);
        }
    g->spacing = spacing_of(n, least, most);
    g->near = NEAR * g->spacing;
    for (int a = 0; a < 2; a++) {
        g->origin[a] = least[a] - 2 * g->near;
        g->cells[a] = (size_t)((most[a] - least[a]) / g->spacing + 4 * NEAR) + 1;
    }
    const size_t cells = g->cells[0] * g->cells[1];
    if (!(g->head = malloc(cells * sizeof *g->head)))
        return fracas_no_memory("the strengths of a file");
    for (size_t c = 0; c < cells; c++) g->head[c] = NONE;
    for (size_t k = 0; k < g->nplaces; k++) {
        const size_t cx = cell_of(g, 0, g->place[k].x[0], 0),
                     cy = cell_of(g, 1, g->place[k].x[1], 0);
        if (cx == g->cells[0] || cy == g->cells[1]) continue; /* no interface is near */
        uint32_t *head = &g->head[cy * g->cells[0] + cx];
        g->place[k].next = *head;
        *head = (uint32_t)k;
    }
    return FRACAS_OK;
}

static double distance2(const place *p, const double x[3])
{
    return (p->x[0] - x[0]) * (p->x[0] - x[0]) + (p->x[1] - x[1]) * (p->x[1] - x[1]);
}

/* The places near x: the first two by their lines, NONE where there are fewer. */
static void find(const grid *g, const double x[3], uint32_t found[2])
{
    const size_t low[2] = {cell_of(g, 0, x[0], -1), cell_of(g, 1, x[1], -1)};
    const size_t high[2] = {cell_of(g, 0, x[0], 1), cell_of(g, 1, x[1], 1)};
    found[0] = found[1] = NONE;
    for (size_t cy = low[1]; cy <= high[1] && cy < g->cells[1]; cy++)
        for (size_t cx = low[0]; cx <= high[0] && cx < g->cells[0]; cx++)
            for (uint32_t k = g->head[cy * g->cells[0] + cx]; k != NONE; k = g->place[k].next) {
                if (distance2(&g->place[k], x) > g->near * g->near) continue;
                if (k < found[0]) {
                    found[1] = found[0];
                    found[0] = k;
                } else if (k < found[1]) {
                    found[1] = k;
                }
            }
}

FRACAS_MUST_USE static fracas_err no_line(const grid *g, size_t i, const double x[3],
                                          size_t missing, size_t n)
{
    size_t nearest = 0;
    for (size_t k = 1; k < g->nplaces; k++)
        if (distance2(&g->place[k], x) < distance2(&g->place[nearest], x)) nearest = k;
    return fracas_fail(FRACAS_USAGE,
                       "%s has no line for %zu of %zu interfaces; interface %zu is at x = %.9g m, "
                       "y = %.9g m, and the nearest line, %" PRId64
                       ", is %.3g m away, more than %.3g m, a thousandth of the interfaces' "
                       "spacing: the file must have the positions of this mesh, in m",
                       g->file->path, missing, n, i, x[0], x[1], g->place[nearest].line,
                       sqrt(distance2(&g->place[nearest], x)), g->near);
}

/* Finds the line of interface i; counts it as missing where there is none. */
FRACAS_MUST_USE static fracas_err match(grid *g, size_t i, const double x[3], double *strength,
                                        size_t *missing)
{
    uint32_t found[2];
    find(g, x, found);
    if (found[0] == NONE) {
        (*missing)++;
        return FRACAS_OK;
    }
    place *p = &g->place[found[0]];
    if (found[1] != NONE)
        return fracas_fail(FRACAS_USAGE,
                           "%s: lines %" PRId64 " and %" PRId64
                           " are both at interface %zu, x = %.9g m, y = %.9g m (within %.3g m, a "
                           "thousandth of the interfaces' spacing): leave one out",
                           g->file->path, p->line, g->place[found[1]].line, i, x[0], x[1], g->near);
    if (p->interface != NONE)
        return fracas_fail(FRACAS_USAGE,
                           "%s:%" PRId64 ": x = %.9g m, y = %.9g m is at two interfaces, %" PRIu32
                           " and %zu, which positions do not tell apart: give strengths by number "
                           "(distribution: file)",
                           g->file->path, p->line, p->x[0], p->x[1], p->interface, i);
    p->interface = (uint32_t)i;
    *strength = p->strength;
    return FRACAS_OK;
}

FRACAS_MUST_USE static fracas_err match_all(grid *g, size_t n, const double (*position)[3],
                                            size_t stride, double *sigma_c)
{
    size_t missing = 0, first = 0;
    TRY(grid_init(g, n, position));
    for (size_t i = 0; i < n; i++) {
        const size_t before = missing;
        TRY(match(g, i, position[i], &sigma_c[i * stride], &missing));
        if (missing == 1 && before == 0) first = i;
    }
    return missing ? no_line(g, first, position[first], missing, n) : FRACAS_OK;
}

FRACAS_MUST_USE static fracas_err positions_fill(const fracas_strength *strength, size_t n,
                                                 const double (*position)[3], size_t stride,
                                                 double *sigma_c)
{
    FRACAS_CLEARED(grid) g = {.file = strength->file};
    return n ? match_all(&g, n, position, stride, sigma_c) : FRACAS_OK; /* 0: a single triangle */
}

static const fracas_param params[] = {
    FRACAS_STRENGTH_FILE(
        "text whose lines begin with x [m], y [m] and a strength [Pa], in any order, one at "
        "each interface: at the middle between the ends of its edge; lines at no interface, "
        "what follows on a line, headings in the first line, empty lines and lines that start "
        "with # are skipped"),
};
const fracas_distribution fracas_positions = {
    .kind = {.name = "positions",
             .doc = "strengths of all interfaces from a file, found by where they are, the same "
                    "for every replica",
             FRACAS_PARAMS(params)},
    .quantile = fracas_given_quantile,
    .moments = fracas_given_moments,
    .init = fracas_given_init,
    .read = next_strength,
    .fill = positions_fill,
    .placed = true,
};
