/* SPDX-License-Identifier: GPL-3.0-or-later */
/* engine/mesh/surface: surfaces from arrays, every refusal, the order of elements. */
#include "tests/support/surface.h"
#include "tests/support/surface_measures.h"

/* A square of two triangles and a third on its right side:
 *     3 - 2
 *     | / | \
 *     0 - 1 - 4 */
typedef struct {
    double node[16][3];
    uint32_t element[36];
    fracas_surface_tag tag[4];
    fracas_surface_arrays arrays;
} sample;

static void make_sample(sample *s)
{
    *s = (sample){.node = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}},
                  .element = {0, 1, 2, 0, 2, 3, 1, 4, 2},
                  .tag = {{{0, 1}, 7}, {{3, 2}, 8}, {{1, 2}, 9}}};
    s->arrays = (fracas_surface_arrays){.order = 1,
                                        .nnodes = 5,
                                        .nelements = 3,
                                        .ntags = 3,
                                        .node = (const double(*)[3])s->node,
                                        .element = s->element,
                                        .tag = s->tag};
}

/* The same with mid-side nodes, 5 to 11. */
static void make_quadratic(sample *s)
{
    static const uint32_t element[18] = {0, 1, 2, 5, 6, 7, 0, 2, 3, 7, 8, 9, 1, 4, 2, 10, 11, 6};
    static const uint32_t ends[7][2] = {{0, 1}, {1, 2}, {2, 0}, {2, 3}, {3, 0}, {1, 4}, {4, 2}};
    make_sample(s);
    memcpy(s->element, element, sizeof element);
    for (size_t m = 0; m < 7; m++)
        for (int i = 0; i < 3; i++)
            s->node[5 + m][i] = 0.5 * (s->node[ends[m][0]][i] + s->node[ends[m][1]][i]);
    s->arrays.order = 2;
    s->arrays.nnodes = 12;
}

/* The sample is refused, and made anew. */
static void expect(sample *s, const char *message)
{
    OWN(a_surface) surface = NULL;
    FAILS(fracas_surface_assemble(&s->arrays, &surface), FRACAS_USAGE, message);
    assert_null(surface);
    if (s->arrays.order == 2) make_quadratic(s);
    else make_sample(s);
}

static size_t place_of(const fracas_surface *surface, int64_t given)
{
    size_t e = 0;
    while (surface->given[e] != given) e++;
    return e;
}

static void test_assembled(void **state)
{
    sample s;
    for (int order = 1; order <= 2; order++) {
        if (order == 1) make_sample(&s);
        else make_quadratic(&s);
        OWN(a_surface) surface = NULL;
        OK(fracas_surface_assemble(&s.arrays, &surface));
        assert_int_equal(surface->order, order);
        assert_int_equal(surface->nvertices, 5);
        assert_int_equal(surface->ninterfaces, 2);
        assert_int_equal(surface->nborders, 5);
        assert_int_equal(euler(surface), 1);
        check_edges(surface);
        /* The same triangles, node for node. */
        for (size_t e = 0; e < 3; e++)
            for (size_t k = 0; k < surface->corners; k++)
                for (int i = 0; i < 3; i++)
                    assert_true(
                        surface->node[corner_of(surface, e, k)][i] ==
                        s.node[s.element[surface->corners * (size_t)surface->given[e] + k]][i]);
        /* Tags: of two edges of the boundary, and of the interface between elements 0 and 2. */
        int tagged = 0;
        for (size_t b = 0; b < surface->nborders; b++) {
            const fracas_surface_border *f = &surface->border[b];
            const int64_t given = surface->given[f->element];
            tagged += given == 0 && f->edge == 0 && f->tag == 7;
            tagged += given == 1 && f->edge == 1 && f->tag == 8;
            tagged += f->tag == 0;
        }
        assert_int_equal(tagged, 5);
        for (size_t i = 0; i < 2; i++) {
            const fracas_surface_interface *f = &surface->interface[i];
            const bool is_right = f->element[0] == place_of(surface, 2) ||
                                  f->element[1] == place_of(surface, 2);
            assert_int_equal(f->tag, is_right ? 9 : 0);
        }
        fracas_surface_measures all;
        fracas_surface_measure(surface, &all);
        assert_true(fabs(all.area - 1.5) < 1e-15 && fabs(all.border - 4.0 - sqrt(2.0)) < 1e-14);
        assert_true(all.least_area == 0.5 && fabs(all.largest_edge - sqrt(2.0)) < 1e-15 &&
                    fabs(all.least_edge - 1.0) < 1e-15);
        assert_true(all.largest_distance == 1 &&
                    all.mean_distance == 1.0); /* the middle one comes between its neighbours */
    }
}

static void test_refused_elements(void **state)
{
    sample s;
    make_sample(&s);
    s.element[7] = 5;
    expect(&s, "element 2 names node 5, but there are 5");
    s.element[5] = 2;
    expect(&s, "element 1 names node 2 twice");
    s.arrays.nnodes = 6;
    expect(&s, "node 5 belongs to no element");
    s.node[3][1] = NAN;
    expect(&s, "node 3 has the y coordinate nan m");
    s.node[3][1] = 1e51;
    expect(&s, "node 3 has the y coordinate 1e+51 m");
    s.node[4][0] = 1.0;
    s.node[4][1] = 0.5; /* between nodes 1 and 2 */
    expect(&s, "element 2 is degenerate: its area is 0 m2, the mean 0.333333 m2");
    s.node[4][0] = 1.0;
    s.node[4][1] = 1e-10;
    expect(&s, "element 2 is degenerate: its edge 0 is 1e-10 m long");
    for (size_t n = 0; n < 5; n++)
        for (int i = 0; i < 3; i++) s.node[n][i] = 1.0; /* all in one place */
    expect(&s, "element 0 is degenerate");
    s.arrays.order = 3;
    expect(&s, "order 1 or 2, not 3");
    s.arrays.nelements = 0;
    expect(&s, "not 0");
}

static void test_refused_neighbours(void **state)
{
    sample s;
    make_sample(&s);
    memcpy(s.element, (uint32_t[]){0, 1, 2, 0, 2, 3, 1, 4, 2, 4, 2, 1}, 12 * sizeof *s.element);
    s.arrays.nelements = 4;
    expect(&s, "elements 2 and 3 have the same vertices");
    /* The first triangle turned round is at odds with both its neighbours, each of which is so with
     * one. */
    memcpy(s.element, (uint32_t[]){0, 2, 1}, 3 * sizeof *s.element);
    expect(&s, "element 0 is inverted: it goes round against 2 of its neighbours");
    /* Node 4 moved into the square: element 2 goes back over element 0. */
    s.node[4][0] = 0.5;
    expect(&s, "is inverted: it is folded back on 1 of its neighbours by more than 120 degrees");
    /* Folded up by 90 degrees is a surface. */
    s.node[4][0] = 1.0;
    s.node[4][2] = 1.0;
    OWN(a_surface) surface = NULL;
    OK(fracas_surface_assemble(&s.arrays, &surface));
    /* A fin on the edge between nodes 1 and 2. */
    make_sample(&s);
    memcpy(s.node[5], (double[]){1.0, 0.5, 1.0}, sizeof s.node[5]);
    memcpy(s.element + 9, (uint32_t[]){1, 2, 5}, 3 * sizeof *s.element);
    s.arrays.nelements = 4;
    s.arrays.nnodes = 6;
    expect(&s, "the edge between nodes 1 and 2 is shared by elements 0, 2 and 3");
    /* A band with half a turn has no outside. */
    for (size_t n = 0; n < 5; n++) {
        s.node[n][0] = cos(1.0 + 2.1 * (double)n);
        s.node[n][1] = sin(1.0 + 2.1 * (double)n);
        s.node[n][2] = n % 2 ? 0.2 : -0.1 * (double)n;
    }
    s.arrays.nelements = 5;
    s.arrays.nnodes = 5;
    s.arrays.ntags = 0;
    memcpy(s.element, (uint32_t[]){0, 1, 2, 1, 3, 2, 2, 3, 4, 3, 0, 4, 4, 0, 1},
           15 * sizeof *s.element);
    expect(&s, "is inverted: it goes round against 1 of its neighbours");
}

static void test_refused_middles(void **state)
{
    sample s;
    make_quadratic(&s);
    memcpy(s.node[12], s.node[6], sizeof s.node[12]); /* another node in the same place */
    s.element[17] = 12;
    s.arrays.nnodes = 13;
    expect(&s, "elements 0 and 2 have different nodes, 6 and 12, in the middle of the edge between "
               "nodes 1 and 2");
    s.element[11] = 5; /* the node of edge 0-1 for edge 3-0 too */
    memcpy(s.node[9], s.node[11], sizeof s.node[9]);
    s.element[16] = 9;
    s.arrays.nnodes = 11;
    expect(&s, "node 5 in the middle of an edge of element 1 has another place in element 0");
    s.element[11] = 4; /* a vertex of element 2 */
    memcpy(s.node[9], s.node[11], sizeof s.node[9]);
    s.element[16] = 9;
    s.arrays.nnodes = 11;
    expect(&s, "node 4 in the middle of an edge of element 1 has another place in element 2");
    /* (meshes.2) On the edge from 0 to 1, of length 1, the node of the middle may be a quarter off:
     * at 1/4 the Jacobian of a straight edge vanishes at the vertex. */
    for (int step = 0; step <= 1; step++) {
        make_quadratic(&s);
        s.node[5][0] = 0.25 + (step ? 1e-6 : -1e-6);
        OWN(a_surface) surface = NULL;
        if (step == 0) {
            expect(&s, "element 0 is folded: its Jacobian is not positive everywhere");
            continue;
        }
        OK(fracas_surface_assemble(&s.arrays, &surface));
    }
}

/* One element of order 2 with these nodes. */
static fracas_err assemble_one(const double (*node)[3])
{
    const uint32_t element[6] = {0, 1, 2, 3, 4, 5};
    const fracas_surface_arrays arrays = {
        .order = 2, .nnodes = 6, .nelements = 1, .node = node, .element = element};
    OWN(a_surface) surface = NULL;
    return fracas_surface_assemble(&arrays, &surface);
}

/* The Jacobian of one random element is positive on a fine grid when it is accepted, and not when
 * it is refused: the criterion is exact, so that only the grid leaves a gap, of elements whose
 * least value is near zero. */
static void test_jacobian(void **state)
{
    enum { TRIES = 3000, GRID = 60 };
    uint64_t x = 5;
    int accepted = 0, refused = 0;
    for (int t = 0; t < TRIES; t++) {
        double node[6][3] = {{0, 0, 0},   {1, 0, 0},     {0, 1, 0},
                             {0.5, 0, 0}, {0.5, 0.5, 0}, {0, 0.5, 0}};
        for (int k = 3; k < 6; k++)
            for (int i = 0; i < 2; i++) node[k][i] += 0.5 * (next_share(&x) - 0.5);
        double least = INFINITY;
        for (int i = 0; i <= GRID; i++)
            for (int j = 0; i + j <= GRID; j++) {
                const double r = (double)i / GRID, s = (double)j / GRID, q = 1.0 - r - s;
                const double dr[6] = {1 - 4 * q, 4 * r - 1, 0, 4 * (q - r), 4 * s, -4 * s};
                const double ds[6] = {1 - 4 * q, 0, 4 * s - 1, -4 * r, 4 * r, 4 * (q - s)};
                double d[2][2] = {{0}};
                for (int k = 0; k < 6; k++)
                    for (int c = 0; c < 2; c++) {
                        d[0][c] += dr[k] * node[k][c];
                        d[1][c] += ds[k] * node[k][c];
                    }
                least = fmin(least, d[0][0] * d[1][1] - d[0][1] * d[1][0]);
            }
        const fracas_err err = assemble_one((const double(*)[3])node);
        accepted += !err;
        refused += err != FRACAS_OK;
        /* A quadratic form with second derivatives below 16 lies at most 16 (1/60)^2/2 under its
         * values on the grid. */
        if (err ? least > 0.003 : least <= 0.0)
            fail_msg("try %d: %d, least Jacobian %g", t, err, least);
    }
    assert_true(accepted > TRIES / 10 && refused > TRIES / 10);
}

/* A triangle a, b, c of the complex plane under z -> z^2, which an element of order 2 is without
 * error: the Jacobian, 4 |z|^2, is positive unless 0 lies inside. There, all nodes and edges may
 * look well. */
static void test_squared(void **state)
{
    uint64_t x = 11;
    int accepted = 0, refused = 0, inside_only = 0;
    for (int t = 0; t < 20000; t++) {
        double z[6][2], node[6][3] = {{0}}, gap = INFINITY, side[3];
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 2; i++) z[k][i] = 2.0 * next_share(&x) - (i == 0 ? 0.5 : 1.0);
        for (int k = 0; k < 3; k++) {
            const double *a = z[k], *b = z[(k + 1) % 3];
            for (int i = 0; i < 2; i++) z[3 + k][i] = 0.5 * (a[i] + b[i]);
            side[k] = a[0] * b[1] - a[1] * b[0]; /* twice the area of 0, a, b */
            gap = fmin(gap, fabs(side[k]));
        }
        for (int k = 0; k < 6; k++) {
            node[k][0] = z[k][0] * z[k][0] - z[k][1] * z[k][1];
            node[k][1] = 2.0 * z[k][0] * z[k][1];
        }
        const double flat = (node[1][0] - node[0][0]) * (node[2][1] - node[0][1]) -
                            (node[1][1] - node[0][1]) * (node[2][0] - node[0][0]);
        if (side[0] + side[1] + side[2] < 1e-3 || gap < 1e-3 || fabs(flat) < 1e-3)
            continue; /* clockwise, or hard to tell */
        const bool is_inside = side[0] > 0.0 && side[1] > 0.0 && side[2] > 0.0;
        const fracas_err err = assemble_one((const double(*)[3])node);
        const bool is_good = flat > 0.0 && !is_inside;
        if (is_good ? err != FRACAS_OK : err != FRACAS_USAGE)
            fail_msg("try %d: %d, inside %d, flat %g", t, err, is_inside, flat);
        accepted += is_good;
        refused += !is_good;
        inside_only += is_inside && flat > 0.0;
    }
    assert_true(accepted > 1000 && refused > 1000 && inside_only > 20);
}

static void test_refused_tags(void **state)
{
    sample s;
    make_sample(&s);
    s.tag[0].node[1] = 3;
    s.tag[0].node[0] = 1;
    expect(&s, "tag 7 is for nodes 1 and 3, between which no triangle has an edge");
    s.tag[1] = (fracas_surface_tag){.node = {1, 0}, .tag = 8};
    expect(&s, "the edge between nodes 1 and 0 has the tags 7 and 8");
    s.tag[2].node[1] = 5;
    expect(&s, "tag 9 is for node 5, but there are 5");
    s.tag[1] = (fracas_surface_tag){.node = {1, 0}, .tag = 7}; /* the same twice: harmless */
    OWN(a_surface) surface = NULL;
    OK(fracas_surface_assemble(&s.arrays, &surface));
}

static void test_names(void **state)
{
    static const int64_t nodes[] = {100, 101, 102, 103, 104, 105}, elements[] = {40, 50, 60};
    sample s;
    make_sample(&s);
    s.arrays.node_number = nodes;
    s.arrays.element_number = elements;
    s.element[7] = s.element[6];
    expect(&s, "element 60 names node 101 twice");
    s.arrays.node_number = nodes;
    s.arrays.element_number = elements;
    OWN(a_surface) surface = NULL;
    OK(fracas_surface_assemble(&s.arrays, &surface));
    assert_int_equal(surface->given[1], 40); /* between its neighbours */
}

/* A rectangle of 60 x 60 squares whose 7200 elements and nodes come shuffled. A strip of such a
 * mesh has 120 elements across; Cuthill and McKee go over it in diagonals, whose length is 1.5
 * strips at most and less near the corners. */
static void test_locality(void **state)
{
    const fracas_surface_fineness fineness = {.divisions = 60, .order = 1};
    OWN(a_surface) plain, *surface;
    OK(fracas_surface_rectangle(1.0, 1.0, &fineness, &plain));
    OWNED uint32_t *element = taken(3 * plain->nelements * sizeof *element);
    memcpy(element, plain->element, 3 * plain->nelements * sizeof *element);
    uint64_t x = 1;
    for (size_t e = plain->nelements - 1; e > 0; e--) {
        const size_t other = (size_t)(next_share(&x) * (double)(e + 1));
        for (size_t k = 0; k < 3; k++) {
            const uint32_t swapped = element[3 * e + k];
            element[3 * e + k] = element[3 * other + k];
            element[3 * other + k] = swapped;
        }
    }
    const fracas_surface_arrays arrays = {.order = 1,
                                          .nnodes = plain->nnodes,
                                          .nelements = plain->nelements,
                                          .node = plain->node,
                                          .element = element};
    OK(fracas_surface_assemble(&arrays, &surface));
    check_edges(surface);
    double before = 0.0, nodes_apart = 0.0;
    for (size_t i = 0; i < surface->ninterfaces; i++)
        before += fabs((double)(surface->given[surface->interface[i].element[0]] -
                                surface->given[surface->interface[i].element[1]]));
    before /= (double)surface->ninterfaces;
    for (size_t e = 0; e < surface->nelements; e++) {
        uint32_t low = UINT32_MAX, high = 0;
        for (size_t k = 0; k < 3; k++) {
            const uint32_t node = corner_of(surface, e, k);
            low = node < low ? node : low;
            high = node > high ? node : high;
        }
        nodes_apart += (double)(high - low) / (double)surface->nelements;
    }
    fracas_surface_measures all;
    fracas_surface_measure(surface, &all);
    print_message("distance across interfaces: shuffled %.1f, ordered %.1f, at most %zu; of an "
                  "element's nodes %.1f\n",
                  before, all.mean_distance, all.largest_distance, nodes_apart);
    assert_true(fabs(before - 7200.0 / 3.0) < 100.0); /* two numbers drawn from n are n/3 apart */
    assert_true(all.mean_distance < 120.0 && all.largest_distance < 180);
}

/* Two squares that do not touch are one surface in two parts. */
static void test_parts(void **state)
{
    const double node[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}};
    const uint32_t element[6] = {0, 1, 2, 3, 4, 5};
    const fracas_surface_arrays arrays = {
        .order = 1, .nnodes = 6, .nelements = 2, .node = node, .element = element};
    OWN(a_surface) surface = NULL;
    OK(fracas_surface_assemble(&arrays, &surface));
    assert_int_equal(euler(surface), 2);
    assert_int_equal(surface->ninterfaces, 0);
    check_edges(surface);
    fracas_surface_destroy(NULL);
}

TESTS(test_assembled, test_refused_elements, test_refused_neighbours, test_refused_middles,
      test_jacobian, test_squared, test_refused_tags, test_names, test_locality, test_parts)
