/* SPDX-License-Identifier: GPL-3.0-or-later */
/* By how much fragments lie over each other: bodies cut in two and moved, in closed form. */
#include "engine/fragments/overlap.h"
#include "tests/support/test.h"

#define PI 3.14159265358979323846

enum { CELLS = 7, ELEMENTS = 2 * 2 * CELLS * CELLS };

/* Fields of `elements` elements, of which nothing but places and fragments is read. */
typedef struct {
    fracas_fields fields;
    double place[ELEMENTS * 6][3];
    int64_t fragment[ELEMENTS];
} body;

static void begin(body *b, size_t elements, size_t corners)
{
    *b = (body){.fields = {.elements = elements, .corners = corners}};
    b->fields.place = b->place;
    b->fields.fragment = b->fragment;
}

/* A square of side 1 about 0, turned by `angle` and moved to x, y, as fragment number `which` of a
 * body of two: CELLS x CELLS cells of two triangles, one of which goes the other way round. */
static void add_square(body *b, int which, double angle, double x, double y)
{
    static const int corner[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {0, 1}, {1, 1}}};
    const double c = cos(angle), s = sin(angle);
    for (int e = 0; e < 2 * CELLS * CELLS; e++) {
        const int cell = e / 2, to = which * 2 * CELLS * CELLS + e;
        for (int k = 0; k < 3; k++) {
            const double u = (double)(cell % CELLS + corner[e % 2][k][0]) / CELLS - 0.5,
                         v = (double)(cell / CELLS + corner[e % 2][k][1]) / CELLS - 0.5;
            double *place = b->place[to * (int)b->fields.corners + k];
            place[0] = x + c * u - s * v;
            place[1] = y + s * u + c * v;
            place[2] = 0.25;
        }
        b->fragment[to] = which;
    }
}

static double overlap_of(const body *b)
{
    double overlap;
    OK(fracas_fragments_overlap(&b->fields, &overlap));
    return overlap;
}

/* Sums of some thousand areas of order 1/CELLS^2: 1e-13. */
static void squares_over_each_other(void **unused)
{
    static body b;
    for (size_t corners = 3; corners <= 6; corners += 3)
        for (int angle = 0; angle < 4; angle++) { /* of both */
            begin(&b, ELEMENTS, corners);
            const double turn = 0.3 * angle, dx = 0.37, dy = 0.81;
            for (size_t k = 0; k < ELEMENTS * corners; k++) b.place[k][2] = 0.25;
            add_square(&b, 0, turn, 0, 0);
            add_square(&b, 1, turn, cos(turn) * dx - sin(turn) * dy,
                       sin(turn) * dx + cos(turn) * dy);
            assert_true(fabs(overlap_of(&b) - 0.5 * (1 - dx) * (1 - dy)) < 1e-13);
            for (int e = 0; e < ELEMENTS; e++) b.fragment[e] = 3;
            assert_true(overlap_of(&b) == 0);
        }
    begin(&b, ELEMENTS, 3); /* their common part is a regular octagon, 2 (sqrt 2 - 1) */
    add_square(&b, 0, 0.1, 2, 3);
    add_square(&b, 1, 0.1 + PI / 4, 2, 3);
    assert_true(fabs(overlap_of(&b) - (sqrt(2) - 1)) < 1e-13);
    add_square(&b, 1, 0.1, 2 + cos(0.1), 3 + sin(0.1)); /* side by side */
    assert_true(overlap_of(&b) < 1e-13);
    b.place[17][2] = 0.3; /* in no plane */
    assert_true(isnan(overlap_of(&b)));
}

/* Two halves of a bar, pushed into each other by d. */
static void halves_of_a_bar(void **unused)
{
    static body b;
    const double d = 0.123;
    begin(&b, 20, 2);
    for (int e = 0; e < 20; e++) {
        b.fragment[e] = e / 10;
        for (int k = 0; k < 2; k++) b.place[2 * e + k][0] = 0.05 * (e + k) - d * (e / 10);
    }
    assert_true(fabs(overlap_of(&b) - d) < 1e-14);
    b.place[3][1] = 1e-3;
    assert_true(isnan(overlap_of(&b)));
}

TESTS(squares_over_each_other, halves_of_a_bar)
