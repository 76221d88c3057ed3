/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/ellipsoid.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double square_apart(const double a[3], const double b[3])
{
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return x * x + y * y + z * z;
}

/* The node farthest from a place, and the square of its distance. */
static size_t farthest(const double (*node)[3], size_t count, const double from[3], double *square)
{
    size_t found = 0;
    *square = 0;
    for (size_t k = 0; k < count; k++) {
        const double apart = square_apart(node[k], from);
        if (apart > *square) {
            *square = apart;
            found = k;
        }
    }
    return found;
}

/* From the first node to the farthest one, and on from there while that is farther: the square of
 * the last distance, and the middle of its ends. */
static double walk(const double (*node)[3], size_t count, double middle[3])
{
    double best = -1;
    for (size_t from = 0;;) {
        double square;
        const size_t to = farthest(node, count, node[from], &square);
        if (!(square > best)) return best;
        best = square;
        for (int i = 0; i < 3; i++) middle[i] = 0.5 * (node[from][i] + node[to][i]);
        from = to;
    }
}

static double largest_of_pairs(const double (*node)[3], size_t count, double best)
{
    for (size_t k = 1; k < count; k++)
        for (size_t l = 0; l < k; l++) best = fmax(best, square_apart(node[k], node[l]));
    return best;
}

/* Places of a grid of 8 x 8 cells on the faces of a cube: tan(k 11.25 degrees). The direction
 * farthest from all others, in the middle of a cell, is 8.0 degrees from four of them: cos is
 * FRACAS_EXTENT_SURE. */
enum { GRID = 4, DIRECTIONS = 12 * GRID * GRID + 1 };
static const double grid[GRID + 1] = {0, 0.19891236737965800, 0.41421356237309503,
                                      0.66817863791929888, 1};

/* One of each direction and its opposite. */
static size_t make_directions(double (*direction)[3])
{
    size_t count = 0;
    for (int i = -GRID; i <= GRID; i++)
        for (int j = -GRID; j <= GRID; j++)
            for (int k = 0; k <= GRID; k++) {
                const int at[3] = {i, j, k};
                const int most = abs(i) > abs(j) ? abs(i) : abs(j);
                if (most < GRID && k < GRID) continue; /* inside the cube */
                if (k == 0 && (j < 0 || (j == 0 && i < 0))) continue;
                for (int c = 0; c < 3; c++)
                    direction[count][c] = at[c] < 0 ? -grid[-at[c]] : grid[at[c]];
                count++;
            }
    return count;
}

/* Pairs of the nodes farthest along the directions and against them. */
static double largest_along(const double (*node)[3], size_t count, double best)
{
    double direction[DIRECTIONS][3], end[2 * DIRECTIONS][3];
    const size_t directions = make_directions(direction);
    for (size_t d = 0; d < directions; d++) {
        const double *along = direction[d];
        double least = INFINITY, most = -INFINITY;
        size_t first = 0, last = 0;
        for (size_t k = 0; k < count; k++) {
            const double at = along[0] * node[k][0] + along[1] * node[k][1] + along[2] * node[k][2];
            if (at < least) least = at, first = k;
            if (at > most) most = at, last = k;
        }
        memcpy(end[2 * d], node[first], sizeof end[0]);
        memcpy(end[2 * d + 1], node[last], sizeof end[0]);
    }
    return largest_of_pairs((const double(*)[3])end, 2 * directions, best);
}

/* (fragments.8) */
double fracas_fragment_extent(const double (*node)[3], size_t count)
{
    double near[FRACAS_EXTENT_ALL][3], middle[3] = {0}, square;
    if (count == 0) return 0;
    const double best = walk(node, count, middle);
    farthest(node, count, middle, &square);
    const double reach = sqrt(square), least = (sqrt(best) - reach) * (1 - 1e-12);
    if (reach <= 0.5 * sqrt(best) * (1 + 1e-14)) return sqrt(best);
    size_t kept = 0;
    for (size_t k = 0; k < count; k++) {
        if (sqrt(square_apart(node[k], middle)) < least) continue;
        if (kept == FRACAS_EXTENT_ALL) return sqrt(largest_along(node, count, best));
        memcpy(near[kept++], node[k], sizeof near[0]);
    }
    return sqrt(largest_of_pairs((const double(*)[3])near, kept, best));
}
