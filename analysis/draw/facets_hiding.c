/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_facets_hide: pairs of facets that overlap in the picture, by a grid of cells; hidden
 * facets; layers. */
#include "analysis/draw/facets.h"

#include "analysis/data/room.h"
#include "base/partition.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { MOST_CORNERS = 6, LATTICE = 8 }; /* steps along a side: 45 points */
enum { MOST_LAYERS = 32 };              /* circles of facets hiding each other stop there */
static const double touching = 1e-6;    /* parts of areas, and of sizes, that count as none */

typedef struct {
    uint32_t behind, front;
} cover;

typedef struct {
    fracas_facets *facets;
    fracas_room room;
    double corner[2], cell; /* m: of the grid */
    size_t columns, rows;
    size_t *first; /* for each cell, in `of` */
    uint32_t *of;  /* facets */
    size_t ncovers, capacity;
    cover *covers;          /* as they are found */
    size_t *start, *sorted; /* for each facet, in `sorted`; covers by the facet behind */
} hiding;

static const double *corner_of(const fracas_facets *facets, size_t f, int k)
{
    return facets->node[facets->facet[f].node[k]];
}

/* ---- the grid ---- */

static void box_of(const fracas_facets *facets, size_t f, double least[2], double largest[2])
{
    for (int i = 0; i < 2; i++) {
        const double a = corner_of(facets, f, 0)[i], b = corner_of(facets, f, 1)[i],
                     c = corner_of(facets, f, 2)[i];
        least[i] = fmin(a, fmin(b, c));
        largest[i] = fmax(a, fmax(b, c));
    }
}

static size_t index_in(double at, double corner, double cell, size_t count)
{
    const double place = floor((at - corner) / cell);
    if (!(place > 0)) return 0;
    return place < (double)(count - 1) ? (size_t)place : count - 1;
}

/* Columns and rows touched by a facet: from[0], from[1] to to[0], to[1]. */
static void cells_of(const hiding *h, size_t f, size_t from[2], size_t to[2])
{
    double least[2], largest[2];
    box_of(h->facets, f, least, largest);
    const size_t count[2] = {h->columns, h->rows};
    for (int i = 0; i < 2; i++) {
        from[i] = index_in(least[i], h->corner[i], h->cell, count[i]);
        to[i] = index_in(largest[i], h->corner[i], h->cell, count[i]);
    }
}

/* Cells as large as twice the square root of the mean area of a facet. */
static fracas_err make_grid(hiding *h)
{
    const fracas_facets *facets = h->facets;
    const double width = facets->largest[0] - facets->least[0],
                 height = facets->largest[1] - facets->least[1];
    h->cell = 2 * sqrt(width * height / (double)facets->nfacets) + fmax(width, height) / 4096;
    h->columns = (size_t)(width / h->cell) + 1;
    h->rows = (size_t)(height / h->cell) + 1;
    h->corner[0] = facets->least[0];
    h->corner[1] = facets->least[1];
    FRACAS_TAKE(&h->room, h->first, h->columns * h->rows + 1);
    TRY(fracas_room_check(&h->room, "the facets of a picture"));
    size_t from[2], to[2], sum = 0;
    for (size_t f = 0; f < facets->nfacets; f++) {
        cells_of(h, f, from, to);
        for (size_t j = from[1]; j <= to[1]; j++)
            for (size_t i = from[0]; i <= to[0]; i++) h->first[j * h->columns + i + 2]++, sum++;
    }
    for (size_t c = 0; c < h->columns * h->rows; c++) h->first[c + 2] += h->first[c + 1];
    FRACAS_TAKE(&h->room, h->of, sum);
    TRY(fracas_room_check(&h->room, "the facets of a picture"));
    for (size_t f = 0; f < facets->nfacets; f++) {
        cells_of(h, f, from, to);
        for (size_t j = from[1]; j <= to[1]; j++)
            for (size_t i = from[0]; i <= to[0]; i++)
                h->of[h->first[j * h->columns + i + 1]++] = (uint32_t)f;
    }
    return FRACAS_OK;
}

/* ---- two facets ---- */

/* Twice the area of abc, positive counter-clockwise. */
static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static double twice_area(const fracas_facets *facets, size_t f)
{
    return turn(corner_of(facets, f, 0), corner_of(facets, f, 1), corner_of(facets, f, 2));
}

/* Part of a polygon to the left of a to b. */
static int clip(double (*at)[2], int n, const double a[2], const double b[2])
{
    double kept[MOST_CORNERS + 1][2];
    int count = 0;
    for (int k = 0; k < n; k++) {
        const double *p = at[k], *q = at[(k + 1) % n], inside = turn(a, b, p), next = turn(a, b, q);
        if (inside >= 0) kept[count][0] = p[0], kept[count++][1] = p[1];
        if ((inside >= 0) == (next >= 0)) continue;
        const double share = inside / (inside - next);
        for (int i = 0; i < 2; i++) kept[count][i] = p[i] + share * (q[i] - p[i]);
        count++;
    }
    for (int k = 0; k < count; k++) at[k][0] = kept[k][0], at[k][1] = kept[k][1];
    return count;
}

/* Twice the area common to two facets in the picture, and its centroid. */
static double common(const fracas_facets *facets, size_t f, size_t g, double centre[2])
{
    double at[MOST_CORNERS + 1][2], sum = 0;
    int n = 3;
    for (int k = 0; k < 3; k++)
        at[k][0] = corner_of(facets, f, k)[0], at[k][1] = corner_of(facets, f, k)[1];
    for (int k = 0; k < 3 && n > 0; k++)
        n = clip(at, n, corner_of(facets, g, k), corner_of(facets, g, (k + 1) % 3));
    centre[0] = centre[1] = 0;
    for (int k = 1; k + 1 < n; k++) {
        const double twice = turn(at[0], at[k], at[k + 1]);
        for (int i = 0; i < 2; i++) centre[i] += twice * (at[0][i] + at[k][i] + at[k + 1][i]) / 3;
        sum += twice;
    }
    for (int i = 0; i < 2 && sum > 0; i++) centre[i] /= sum;
    return sum;
}

/* Depth of a facet at a point; false if the point is beside it. */
static bool depth_at(const fracas_facets *facets, size_t f, const double point[2], double *depth)
{
    const double *a = corner_of(facets, f, 0), *b = corner_of(facets, f, 1),
                 *c = corner_of(facets, f, 2);
    const double twice = turn(a, b, c), u = turn(b, c, point) / twice,
                 v = turn(c, a, point) / twice, w = 1 - u - v;
    if (!(u > -touching && v > -touching && w > -touching)) return false;
    *depth = u * a[2] + v * b[2] + w * c[2];
    return true;
}

static fracas_err add_cover(hiding *h, uint32_t behind, uint32_t front)
{
    TRY(fracas_grow(&h->covers, sizeof *h->covers, h->ncovers, &h->capacity,
                    "the facets of a picture"));
    h->covers[h->ncovers++] = (cover){behind, front};
    return FRACAS_OK;
}

static fracas_err compare(hiding *h, uint32_t f, uint32_t g)
{
    double centre[2], of_f, of_g;
    const double area[2] = {twice_area(h->facets, f), twice_area(h->facets, g)};
    const double both = common(h->facets, f, g, centre);
    if (!(both > touching * fmin(area[0], area[1]))) return FRACAS_OK;
    if (!depth_at(h->facets, f, centre, &of_f) || !depth_at(h->facets, g, centre, &of_g))
        return FRACAS_OK;
    if (fabs(of_f - of_g) <= touching * h->cell) return FRACAS_OK;
    return of_f < of_g ? add_cover(h, f, g) : add_cover(h, g, f);
}

/* Overlapping boxes are compared in one cell only: that of the lower left corner of their common
 * part. */
static bool meet_in(const hiding *h, size_t f, size_t g, size_t column, size_t row)
{
    double least[2][2], largest[2][2], corner[2];
    box_of(h->facets, f, least[0], largest[0]);
    box_of(h->facets, g, least[1], largest[1]);
    for (int i = 0; i < 2; i++) {
        corner[i] = fmax(least[0][i], least[1][i]);
        if (!(corner[i] < fmin(largest[0][i], largest[1][i]))) return false;
    }
    return index_in(corner[0], h->corner[0], h->cell, h->columns) == column &&
           index_in(corner[1], h->corner[1], h->cell, h->rows) == row;
}

static fracas_err find_covers(hiding *h)
{
    for (size_t row = 0; row < h->rows; row++)
        for (size_t column = 0; column < h->columns; column++) {
            const size_t cell = row * h->columns + column;
            for (size_t i = h->first[cell]; i < h->first[cell + 1]; i++)
                for (size_t j = i + 1; j < h->first[cell + 1]; j++)
                    if (meet_in(h, h->of[i], h->of[j], column, row))
                        TRY(compare(h, h->of[i], h->of[j]));
        }
    return FRACAS_OK;
}

static fracas_err sort_covers(hiding *h)
{
    size_t *behind;
    FRACAS_TAKE(&h->room, behind, h->ncovers);
    TRY(fracas_room_check(&h->room, "the facets of a picture"));
    for (size_t c = 0; c < h->ncovers; c++) behind[c] = h->covers[c].behind;
    return fracas_room_groups(&h->room, behind, h->ncovers, h->facets->nfacets, &h->start,
                              &h->sorted);
}

/* ---- visible parts ---- */

/* True if another facet lies before the point of f with these barycentric coordinates. */
static bool is_covered(const hiding *h, size_t f, const double share[3])
{
    double point[3] = {0, 0, 0}, depth;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) point[i] += share[k] * corner_of(h->facets, f, k)[i];
    for (size_t c = h->start[f]; c < h->start[f + 1]; c++)
        if (depth_at(h->facets, h->covers[h->sorted[c]].front, point, &depth) && depth > point[2])
            return true;
    return false;
}

/* True if all points of a lattice over the facet are covered, its outermost ones 1 % of the way
 * from the corners to the middle. */
static bool is_hidden(const hiding *h, size_t f)
{
    if (h->start[f] == h->start[f + 1]) return false;
    for (int i = 0; i <= LATTICE; i++)
        for (int j = 0; i + j <= LATTICE; j++) {
            const int count[3] = {i, j, LATTICE - i - j};
            double share[3];
            for (int k = 0; k < 3; k++) share[k] = 0.99 * count[k] / LATTICE + 0.01 / 3;
            if (!is_covered(h, f, share)) return false;
        }
    return true;
}

/* Equal to rounding, relative to lengths in space. */
static bool is_edge_on(const fracas_facets *facets, size_t f)
{
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = corner_of(facets, f, k), *b = corner_of(facets, f, (k + 1) % 3);
        longest = fmax(longest, hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]));
    }
    return !(twice_area(facets, f) > touching * longest * longest);
}

/* ---- layers ---- */

/* Facets drawn at once: connected ones, as long as they hide nothing that hides them. */
typedef struct {
    size_t count;
    uint32_t *of;   /* for each facet: labels of the partition */
    int32_t *layer; /* for each part */
    bool *split;    /* for each part: it hides some of itself, or a part that hides it */
} parts;

static fracas_err find_parts(hiding *h, fracas_partition *partition, parts *p)
{
    const fracas_facets *facets = h->facets;
    TRY(fracas_partition_init(partition, facets->nfacets));
    for (size_t f = 0; f < facets->nfacets; f++)
        for (int side = 0; side < 3; side++) {
            const int32_t other = facets->facet[f].neighbour[side];
            if (other >= 0 && facets->facet[f].layer >= 0 && facets->facet[other].layer >= 0)
                fracas_partition_unite(partition, (uint32_t)f, (uint32_t)other);
        }
    p->count = fracas_partition_label(partition);
    p->of = partition->label;
    FRACAS_TAKE(&h->room, p->layer, p->count + facets->nfacets); /* room for all of them split */
    FRACAS_TAKE(&h->room, p->split, p->count + facets->nfacets);
    return fracas_room_check(&h->room, "the facets of a picture");
}

/* One more than the largest layer of all facets that hide some of it. Parts hiding each other in a
 * circle are split, with those far behind them. */
static void raise_parts(const hiding *h, parts *p)
{
    const fracas_facet *facet = h->facets->facet;
    bool grown = true;
    for (size_t k = 0; k < p->count; k++) p->layer[k] = 0;
    while (grown) { /* some layer grows each time, and none beyond the last */
        grown = false;
        for (size_t c = 0; c < h->ncovers; c++) {
            const cover *pair = &h->covers[h->sorted[c]];
            if (facet[pair->front].layer < 0 || facet[pair->behind].layer < 0) continue;
            const uint32_t front = p->of[pair->front], behind = p->of[pair->behind];
            if (front == behind || p->layer[front] + 1 >= MOST_LAYERS)
                p->split[front] = p->split[behind] = true;
            else if (p->layer[behind] <= p->layer[front])
                p->layer[behind] = p->layer[front] + 1, grown = true;
        }
    }
}

static void split_parts(const hiding *h, parts *p)
{
    for (size_t f = 0; f < h->facets->nfacets; f++)
        if (p->split[p->of[f]]) p->of[f] = (uint32_t)p->count++;
}

static fracas_err find_layers(hiding *h)
{
    fracas_facets *facets = h->facets;
    FRACAS_CLEARED(fracas_partition) partition = {0};
    parts p = {0};
    for (size_t f = 0; f < facets->nfacets; f++)
        facets->facet[f].layer = is_edge_on(facets, f) || is_hidden(h, f) ? -1 : 0;
    TRY(find_parts(h, &partition, &p));
    raise_parts(h, &p);
    split_parts(h, &p);
    raise_parts(h, &p);
    facets->nlayers = 1;
    for (size_t f = 0; f < facets->nfacets; f++) {
        fracas_facet *facet = &facets->facet[f];
        if (facet->layer < 0) continue;
        facet->layer = p.layer[p.of[f]];
        if (facet->layer >= (int32_t)facets->nlayers) facets->nlayers = (size_t)facet->layer + 1;
    }
    return FRACAS_OK;
}

fracas_err fracas_facets_hide(fracas_facets *facets)
{
    hiding h = {.facets = facets};
    fracas_err err = make_grid(&h);
    if (!err) err = find_covers(&h);
    if (!err) err = sort_covers(&h);
    if (!err) err = find_layers(&h);
    free(h.covers);
    fracas_room_clear(&h.room);
    return err;
}
