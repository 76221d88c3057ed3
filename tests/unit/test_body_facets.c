/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Surfaces in space: which of their elements show, where and in what order, against closed forms
 * and a search for what is nearest. Spheres and octants of 1 m, broken along the borders of Voronoi
 * cells. */
#include "tests/support/body.h"

/* Largest circumradius of an element: the planes of the elements are at least sqrt(1 - that^2) from
 * the centre. */
static double widest(const fracas_stored_mesh *mesh)
{
    double largest = 0;
    for (size_t e = 0; e < mesh->nelements; e++) {
        double edge[3], s = 0;
        for (int k = 0; k < 3; k++) {
            const double *a = mesh->node[mesh->element[e].node[k]].position,
                         *b = mesh->node[mesh->element[e].node[(k + 1) % 3]].position;
            edge[k] = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
            s += edge[k] / 2;
        }
        const double area = sqrt(s * (s - edge[0]) * (s - edge[1]) * (s - edge[2]));
        largest = fmax(largest, edge[0] * edge[1] * edge[2] / (4 * area));
    }
    return largest;
}

/* The mesh has a centre, and no element is seen edge on: of each pair across it one faces the
 * reader. The polyhedron is between the sphere that its planes touch at least and its own: so is
 * what it covers, to rounding. */
static void half_of_a_sphere_shows(void **state)
{
    static const double view[][2] = {
        {45, 35.264389682754654}, {20, 30}, {-100, -70}, {0.3, 89.1}, {-90, 90}};
    body b;
    make_body(false, 8, 2, 30, false, &b);
    const double c = widest(&b.mesh);
    for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
        FRACAS_CLEARED(fracas_facets) facets = look(&b, view[v][0], view[v][1], 0, 0);
        size_t shown = 0, outer = 0;
        double area = 0;
        assert_int_equal(facets.nfacets, b.mesh.nelements);
        for (size_t f = 0; f < facets.nfacets; f++) {
            if (fabs(area_of(&facets, f)) <
                1e-12) { /* the last two views look along edges of the icosahedron */
                assert_int_equal(facets.facet[f].layer, -1);
                continue;
            }
            outer += facets.facet[f].kind == FRACAS_FACET_OUTER;
            shown += facets.facet[f].layer == 0;
            assert_int_equal(facets.facet[f].layer,
                             facets.facet[f].kind == FRACAS_FACET_OUTER ? 0 : -1);
            if (facets.facet[f].layer >= 0) area += area_of(&facets, f);
        }
        if (v < 3) assert_int_equal(2 * outer, b.mesh.nelements);
        assert_int_equal(outer, shown);
        assert_true(area < M_PI && area > M_PI * (1 - c * c));
    }
    assert_true(c < 0.15);
    clear_body(&b);
}

/* From (1, 1, 1) all of its outer skin, from (-1, -1, -1) all of the inner one. The arcs of its
 * borders are ellipses there, each triangle from the centre pi/4 / sqrt(3); straight edges lose
 * h^2/6 of a sector's area, h = pi/2/20. */
static void all_of_an_octant_shows(void **state)
{
    body b;
    make_body(true, 20, 1, 20, false, &b);
    const double h = M_PI / 2 / 20, exact = 3 * M_PI / 4 / sqrt(3);
    for (int side = 1; side >= -1; side -= 2) {
        FRACAS_CLEARED(fracas_facets)
        facets = look(&b, side > 0 ? 45 : 225, side * 35.264389682754654, 0, 0);
        double area = 0;
        for (size_t f = 0; f < facets.nfacets; f++) {
            assert_int_equal(facets.facet[f].kind,
                             side > 0 ? FRACAS_FACET_OUTER : FRACAS_FACET_INNER);
            assert_int_equal(facets.facet[f].layer, 0);
            assert_true(area_of(&facets, f) > 0);
            area += area_of(&facets, f);
        }
        assert_true(area < exact && area > exact * (1 - h * h / 6 - 1e-12));
    }
    clear_body(&b);
}

/* The view along z has x to the right and y upward; from (1, 0, 0) these are y and z; turning keeps
 * lengths. */
static void views_turn(void **state)
{
    static const fracas_view view[] = {{-90, 90}, {0, 0}, {45, 35.264389682754654}};
    static const double expected[][3] = {
        {1, 2, 3}, {2, 3, 1}, {0.70710678118654757, 1.2247448713915889, 3.4641016151377544}};
    const double vector[3] = {1, 2, 3};
    for (int v = 0; v < 3; v++) {
        double turned[3];
        fracas_view_turn(&view[v], vector, turned);
        for (int i = 0; i < 3; i++)
            assert_true(fabs(turned[i] - expected[v][i]) <
                        4e-15); /* 9 roundings of numbers up to 4 */
    }
}

/* ---- what is before what ---- */

/* What is drawn last at a point is what is nearest there: a search over all facets. Points are
 * spread at random. */
static void assert_nearest_last(const fracas_facets *facets, size_t at_least)
{
    uint64_t x = 5;
    size_t wrong = 0, seen = 0;
    const size_t points = 4000;
    for (size_t p = 0; p < points; p++) {
        double point[2], nearest = -INFINITY;
        size_t front = SIZE_MAX, last = SIZE_MAX;
        bool close = false;
        for (int i = 0; i < 2; i++)
            point[i] = facets->least[i] + (facets->largest[i] - facets->least[i]) *
                                              (double)(sample_bits(&x) >> 11) * 0x1p-53;
        for (size_t f = 0; f < facets->nfacets; f++) {
            const double depth = depth_at(facets, f, point, &close);
            if (depth == -INFINITY) continue;
            if (depth > nearest) nearest = depth, front = f;
            const int32_t layer = facets->facet[f].layer;
            if (layer < 0) continue;
            if (last == SIZE_MAX || layer < facets->facet[last].layer) last = f;
        }
        if (close || front == SIZE_MAX) continue;
        seen++;
        wrong += front != last;
    }
    assert_true(seen >= at_least);
    assert_int_equal(wrong, 0);
}

static void the_nearest_is_drawn_last(void **state)
{
    static const struct {
        bool octant;
        double view[2], explode, thickness;
    } looks[] = {{true, {225, -35}, 0, 0},      {true, {225, -35}, 0.2, 0.02},
                 {true, {100, -10}, 0, 0.02},   {true, {-30, 10}, 0.15, 0.05},
                 {false, {45, 35}, 0.15, 0.01}, {false, {10, 0}, 0.4, 0},
                 {false, {200, -50}, 1, 0.1}};
    for (size_t l = 0; l < sizeof looks / sizeof *looks; l++) {
        body b;
        make_body(looks[l].octant, looks[l].octant ? 16 : 8, 2, 25, false, &b);
        FRACAS_CLEARED(fracas_facets)
        facets = look(&b, looks[l].view[0], looks[l].view[1], looks[l].explode, looks[l].thickness);
        size_t hidden = 0;
        for (size_t f = 0; f < facets.nfacets; f++) hidden += facets.facet[f].layer < 0;
        if (!looks[l].octant)
            assert_true(hidden > 50); /* through gaps some of the inner side shows */
        assert_true(facets.nlayers < 32);
        assert_nearest_last(&facets, 1000);
        clear_body(&b);
    }
}

/* ---- fragments apart, and the thickness ---- */

/* A fragment moves as a whole: what its facets move by is 0.3 of the way from the centroid of all
 * to its own, of straight triangles, to the rounding of a few hundred sums. */
static void fragments_move_apart(void **state)
{
    body b;
    make_body(true, 20, 2, 9, false, &b);
    FRACAS_CLEARED(fracas_facets) still = look(&b, 45, 35, 0, 0), apart = look(&b, 45, 35, 0.3, 0);
    const fracas_view view = {45, 35};
    const size_t nfragments = b.now.nfragments;
    double(*centre)[4] = zeroed(nfragments + 1, sizeof *centre); /* the last one of all */
    for (size_t e = 0; e < b.mesh.nelements; e++) {
        const double *p[3];
        double n[3], middle[3], turned[3];
        for (int k = 0; k < 3; k++) p[k] = b.mesh.node[b.mesh.element[e].node[k]].position;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) -
                   (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
            middle[i] = (p[0][i] + p[1][i] + p[2][i]) / 3;
        }
        const double area = hypot(hypot(n[0], n[1]), n[2]);
        fracas_view_turn(&view, middle, turned);
        for (size_t to = b.now.fragment[e];; to = nfragments) {
            for (int i = 0; i < 3; i++) centre[to][i] += area * turned[i];
            centre[to][3] += area;
            if (to == nfragments) break;
        }
    }
    for (size_t f = 0; f < still.nskin; f++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                const double *own = centre[still.facet[f].fragment], *all = centre[nfragments];
                const double moved = corner(&apart, f, k)[i] - corner(&still, f, k)[i];
                assert_true(fabs(moved - 0.3 * (own[i] / own[3] - all[i] / all[3])) < 1e-13);
                if (i < 2)
                    assert_true(corner(&apart, f, k)[i] >= apart.least[i] &&
                                corner(&apart, f, k)[i] <= apart.largest[i]);
            }
    for (int i = 0; i < 2; i++) /* the frame is that of any time */
        assert_true(fabs((apart.largest[i] - apart.least[i]) -
                         1.3 * (still.largest[i] - still.least[i])) < 1e-14);
    size_t sides = 0, parted = 0;
    for (size_t f = 0; f < apart.nskin; f++)
        for (int k = 0; k < 3; k++) {
            const int32_t other = apart.facet[f].neighbour[k];
            assert_true(other < 0 || apart.facet[other].fragment == apart.facet[f].fragment);
            sides += apart.facet[f].side[k] == FRACAS_SIDE_PARTED;
        }
    for (size_t i = 0; i < b.mesh.ninterfaces; i++) {
        const uint32_t *of = b.now.fragment, f = of[b.mesh.interface[i].element[0]],
                       g = of[b.mesh.interface[i].element[1]];
        if (f != g)
            parted += (size_t)(b.now.elements[f] > FRACAS_SURFACE_DUST) +
                      (b.now.elements[g] > FRACAS_SURFACE_DUST);
    }
    assert_true(parted > 40);
    assert_int_equal(sides, parted); /* dust has no lines */
    free(centre);
    clear_body(&b);
}

/* From (-1, 0, 0) the cut at x = 0 lies across the view: a quarter of the ring from 1 - t/2 to 1 +
 * t/2, of area pi/2 t. Straight edges lose h^2/6 of it; a normal at a border is the mean of one
 * side alone, up to h/2 aside, which loses h^2/8: 0.2 % with h = 0.08. */
static void the_thickness_shows_at_borders(void **state)
{
    body b;
    make_body(true, 20, 2, 0, false, &b);
    const double t = 0.04, exact = M_PI / 2 * t;
    FRACAS_CLEARED(fracas_facets)
    back = look(&b, 225, -35.264389682754654, 0, t), front = look(&b, 45, 35.264389682754654, 0, t);
    FRACAS_CLEARED(fracas_facets) side = look(&b, 180, 0, 0, t);
    double area = 0;
    size_t lines = 0;
    for (size_t f = back.nskin; f < back.nfacets; f++) {
        const double *m = back.node[back.facet[f].middle[0]], *end = corner(&back, f, 0);
        assert_int_equal(hypot(hypot(m[0], m[1]), m[2]) > 1,
                         hypot(hypot(end[0], end[1]), end[2]) > 1); /* in the same skin */
        assert_int_equal(back.facet[f].kind, FRACAS_FACET_CUT);
        for (int k = 0; k < 3; k++) {
            if (back.facet[f].side[k] != FRACAS_SIDE_EDGE) continue;
            const double *p = corner(&back, f, k), *q = corner(&back, f, (k + 1) % 3);
            assert_true(hypot(hypot(p[0], p[1]), p[2]) > 1 &&
                        hypot(hypot(q[0], q[1]), q[2]) > 1); /* the outer skin */
            lines++;
        }
    }
    assert_int_equal(back.nfacets - back.nskin, 2 * b.mesh.nborders); /* two halves each */
    assert_int_equal(
        lines, b.mesh.nborders); /* along the far skin; that which faces the reader has its own */
    assert_int_equal(front.nfacets, front.nskin); /* cuts are turned away */
    for (size_t f = side.nskin; f < side.nfacets; f++) {
        bool there = true;
        for (int k = 0; k < 3; k++) there = there && fabs(corner(&side, f, k)[2]) < t * 0.08;
        if (there) area += area_of(&side, f);
        if (there) assert_int_equal(side.facet[f].layer, 0);
    }
    assert_true(fabs(area / exact - 1) < 0.002);
    clear_body(&b);
}

TESTS(half_of_a_sphere_shows, all_of_an_octant_shows, views_turn, the_nearest_is_drawn_last,
      fragments_move_apart, the_thickness_shows_at_borders)
