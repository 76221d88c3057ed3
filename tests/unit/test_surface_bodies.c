/* SPDX-License-Identifier: GPL-3.0-or-later */
/* engine/mesh/surface: rectangles, annuli, spheres, octants and cylinders: topology, areas,
 * perturbation, bits. */
#include "tests/support/surface.h"
#include "tests/support/surface_measures.h"

#define PI 3.14159265358979323846

typedef struct {
    const char *name;
    body_shape shape;
    double length[2], area, border;
    long euler;
    int tags;
    double area_ratio,
        edge_ratio; /* largest by smallest, at 16 divisions: measured, and rounded up */
} body;

static const body bodies[] = {
    {"rectangle", SHAPE_RECTANGLE, {3.0, 2.0}, 6.0, 10.0, 1, 4, 1.0001, 1.4143},
    {"annulus", SHAPE_ANNULUS, {1.0, 2.0}, 3.0 * PI, 6.0 * PI, 0, 2, 1.03, 1.54},
    {"sphere", SHAPE_SPHERE, {2.0}, 16.0 * PI, 0.0, 2, 0, 1.2, 1.18},
    {"octant", SHAPE_OCTANT, {2.0}, 2.0 * PI, 3.0 * PI, 1, 3, 1.75, 1.47},
    {"tube", SHAPE_TUBE, {2.0, 5.0}, 20.0 * PI, 8.0 * PI, 0, 4, 1.0001, 1.43},
    {"half of a tube", SHAPE_TUBE_HALF, {2.0, 5.0}, 10.0 * PI, 4.0 * PI + 10.0, 1, 4, 1.0001, 1.43},
    {"quarter", SHAPE_TUBE_QUARTER, {2.0, 5.0}, 5.0 * PI, 2.0 * PI + 10.0, 1, 4, 1.0001, 1.43},
    {"octant of a tube",
     SHAPE_TUBE_OCTANT,
     {2.0, 5.0},
     2.5 * PI,
     2.0 * PI + 5.0,
     1,
     4,
     1.0001,
     1.43},
};

static bool is_tube(const body *b)
{
    return b->shape >= SHAPE_TUBE;
}

static a_surface *made(const body *b, size_t divisions, int order)
{
    return surface_of(b->shape, b->length,
                      &(fracas_surface_fineness){.divisions = divisions, .order = order});
}

static a_surface *perturbed(const body *b, size_t divisions, int order, uint64_t seed, bool ends)
{
    return surface_moved(b->shape, b->length, divisions, order, seed, ends);
}

/* Its radius; 0 if it is flat. */
static double radius_of(const body *b)
{
    return b->shape < SHAPE_SPHERE ? 0.0 : b->length[0];
}

/* From the origin, of a tube from its axis. */
static double distance_of(const body *b, const double x[3])
{
    return sqrt(x[0] * x[0] + (is_tube(b) ? 0.0 : x[1] * x[1]) + x[2] * x[2]);
}

/* Six times the volume of the tetrahedron to the origin on a sphere, of a tube to the element's
 * height on its axis, else twice the area: positive unless inverted. */
static double outward(const body *of, const fracas_surface *s, size_t e)
{
    double corner[3][3], height = 0.0;
    for (size_t k = 0; k < 3; k++) memcpy(corner[k], s->node[corner_of(s, e, k)], sizeof corner[k]);
    for (size_t k = 0; k < 3 && is_tube(of); k++) height += corner[k][1] / 3.0;
    for (size_t k = 0; k < 3; k++) corner[k][1] -= height;
    const double *a = corner[0], *b = corner[1], *c = corner[2];
    if (radius_of(of) == 0.0) return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/* Planes of symmetry x, y, z = 0, and ends, all to the last bit. */
static void check_end(const body *b, int tag, const double x[3])
{
    const double low = b->shape == SHAPE_TUBE_OCTANT ? 0.0 : -0.5 * b->length[1];
    assert_true(tag > 2 || b->shape > SHAPE_TUBE);
    if (tag > 2) assert_true(x[1] == (tag == 3 ? low : 0.5 * b->length[1]));
    else if (b->shape == SHAPE_TUBE_HALF) assert_true(x[2] == 0.0 && (x[0] < 0.0) == (tag == 1));
    else assert_true(x[tag == 1 ? 0 : 2] == 0.0);
}

/* What holds for every mesh of a body: nodes on it to round-off, elements outward, tags where they
 * belong. */
static void check_body(const body *b, const fracas_surface *s)
{
    const double of = radius_of(b);
    check_edges(s);
    assert_int_equal(euler(s), b->euler);
    for (size_t n = 0; n < s->nnodes; n++) {
        const double *x = s->node[n], radius = distance_of(b, x);
        if (of > 0.0) assert_true(fabs(radius - of) < 4e-16 * of);
        else assert_true(x[2] == 0.0);
    }
    for (size_t e = 0; e < s->nelements; e++) assert_true(outward(b, s, e) > 0.0);
    for (size_t i = 0; i < s->ninterfaces; i++) assert_int_equal(s->interface[i].tag, 0);
    for (size_t i = 0; i < s->nborders; i++) {
        const fracas_surface_border *f = &s->border[i];
        assert_true(f->tag >= 1 && f->tag <= b->tags);
        const size_t corner[3] = {f->edge, (f->edge + 1) % 3, 3 + f->edge};
        for (int k = 0; k < 1 + s->order; k++) {
            const double *x = s->node[corner_of(s, f->element, corner[k])];
            const double radius = sqrt(x[0] * x[0] + x[1] * x[1]);
            if (b->shape == SHAPE_RECTANGLE)
                assert_true(f->tag <= 2 ? x[0] == (f->tag == 1 ? -1.5 : 1.5)
                                        : x[1] == (f->tag == 3 ? -1.0 : 1.0));
            if (b->shape == SHAPE_ANNULUS) assert_true(fabs(radius - f->tag) < 5e-16 * f->tag);
            if (b->shape == SHAPE_OCTANT) assert_true(x[f->tag - 1] == 0.0); /* to the last bit */
            if (is_tube(b)) check_end(b, f->tag, x);
        }
    }
}

static void test_bodies(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++)
        for (int order = 1; order <= 2; order++)
            for (size_t n = 1; n <= 16; n += n < 6 ? 1 : 5) {
                OWN(a_surface) s = made(&bodies[i], n, order);
                check_body(&bodies[i], s);
                if (bodies[i].shape == SHAPE_SPHERE) assert_int_equal(s->nelements, 20 * n * n);
                if (bodies[i].shape == SHAPE_OCTANT) assert_int_equal(s->nelements, n * n);
                if (bodies[i].shape == SHAPE_RECTANGLE)
                    assert_int_equal(s->nelements, 2 * n * ((3 * n + 1) / 2));
                if (!is_tube(&bodies[i])) continue;
                /* the quarter of the circle, PI, is the longer side of the octant, 2.5 */
                const double by = bodies[i].shape == SHAPE_TUBE_OCTANT ? PI / 2.5 : 5.0 / PI;
                const size_t quarters = bodies[i].shape == SHAPE_TUBE        ? 4
                                        : bodies[i].shape == SHAPE_TUBE_HALF ? 2
                                                                             : 1;
                assert_int_equal(s->nelements, 2 * quarters * n * (size_t)lround((double)n * by));
            }
}

/* Of the octant: every node of a plane of symmetry is there to the last bit, nothing else comes
 * near. */
static void test_planes(void **state)
{
    const size_t n = 12;
    OWN(a_surface) s = perturbed(&bodies[3], n, 2, 3, false);
    size_t on_plane = 0;
    for (size_t k = 0; k < s->nnodes; k++)
        for (int i = 0; i < 3; i++) {
            on_plane += s->node[k][i] == 0.0;
            assert_true(s->node[k][i] == 0.0 || s->node[k][i] > 0.01);
        }
    assert_int_equal(on_plane, 3 * (2 * n + 1)); /* on each plane 2 n + 1, the corners on two */
}

/* Flat bodies with straight edges to round-off: n terms of 1/n of the sum, each within some 4 units
 * of 1.1e-16. Curved ones converge with h^2 by chords; with h^4 by parabolas. Ratios of the errors
 * of meshes with h and h/2 approach 4 and 16, and are within 4 % and 8 % of that at these h (the
 * next term is of relative order h^2 < 0.02, with a factor of a few). The chords of each circle of
 * an annulus cut off pi h^2/6, the same outside and inside: h^4 is left. */
static void test_areas(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++)
        for (int order = 1; order <= 2; order++) {
            const body *b = &bodies[i];
            double area[2], border[2];
            for (int k = 0; k < 2; k++) {
                OWN(a_surface) s = made(b, k ? 32 : 16, order);
                fracas_surface_measures all;
                fracas_surface_measure(s, &all);
                area[k] = all.area - b->area;
                border[k] = all.border - b->border;
            }
            print_message("%s, order %d: area %.3g then %.3g, ratio %.2f; border %.3g then %.3g, "
                          "ratio %.2f\n",
                          b->name, order, area[0], area[1], area[0] / area[1], border[0], border[1],
                          border[0] / border[1]);
            if (b->shape == SHAPE_RECTANGLE) {
                assert_true(fabs(area[1]) < 1e-12 && fabs(border[1]) < 1e-12);
                continue;
            }
            const double expected = order == 1 ? 4.0 : 16.0, share = order == 1 ? 0.04 : 0.08;
            const double further = b->shape == SHAPE_ANNULUS && order == 1 ? 4.0 : 1.0;
            assert_true(fabs(area[0] / area[1] - further * expected) < share * further * expected);
            if (b->border > 0.0)
                assert_true(fabs(border[0] / border[1] - expected) < share * expected);
        }
}

/* The area of the polygon between the chords of n and m nodes on the circles, whatever lies
 * between. */
static void test_annulus_area(void **state)
{
    OWN(a_surface) plain = perturbed(&bodies[1], 5, 1, 9, false);
    fracas_surface_measures all;
    fracas_surface_measure(plain, &all);
    double count[3] = {0};
    for (size_t i = 0; i < plain->nborders; i++) count[plain->border[i].tag]++;
    const double exact = 0.5 * (count[2] * 4.0 * sin(2.0 * PI / count[2]) -
                                count[1] * sin(2.0 * PI / count[1]));
    assert_true(fabs(all.area - exact) < 1e-13);
}

static void test_uniformity(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++) {
        OWN(a_surface) s = made(&bodies[i], 16, 1);
        fracas_surface_measures all;
        fracas_surface_measure(s, &all);
        const double area = all.largest_area / all.least_area,
                     edge = all.largest_edge / all.least_edge;
        print_message("%s: %zu elements, largest by smallest area %.4f, edge %.4f; across "
                      "interfaces %.1f, at most %zu\n",
                      bodies[i].name, s->nelements, area, edge, all.mean_distance,
                      all.largest_distance);
        assert_true(area <= bodies[i].area_ratio && edge <= bodies[i].edge_ratio);
        /* A level of Cuthill and McKee's search is about as long as the body is wide. */
        assert_true(all.mean_distance < 3.0 * sqrt((double)s->nelements));
    }
}

/* The mean element is as large as the equilateral triangle asked for, but for the rounding of
 * divisions: half of one in n changes the area by 1/n, and n > 10 here (the annulus: 12 layers,
 * whose circles round too); the mean edge follows. */
static void test_size(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++) {
        const fracas_surface_fineness fineness = {.size = 0.1, .order = 1};
        OWN(a_surface) s = surface_of(bodies[i].shape, bodies[i].length, &fineness);
        double sum = 0.0;
        for (size_t k = 0; k < 3 * s->nelements; k++) sum += fracas_surface_length(s, k / 3, k % 3);
        const double mean = sum / (3.0 * (double)s->nelements);
        const double area = bodies[i].area / (double)s->nelements / (0.25 * sqrt(3.0) * 0.01);
        print_message("%s of size 0.1: mean edge %.4f, mean area %.4f\n", bodies[i].name, mean,
                      area);
        assert_true(fabs(area - 1.0) < 0.1 && fabs(mean - 0.1) < 0.01);
    }
}

/* Largest distance of a vertex from where it is without perturbation, in local edge lengths, is
 * amplitude sqrt(2); the boundary stays. Twice the area of a flat element is linear in each of the
 * six numbers of its vertices, so that it is least where all are -1 or 1: with each element's 64
 * cases positive, no numbers invert it. */
static void test_never_inverts(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++)
        for (size_t n = 1; n <= 9; n += 2) {
            const body *b = &bodies[i];
            OWN(a_surface) plain = made(b, n, 1);
            double(*shift)[2] = zeroed(plain->nvertices, sizeof *shift);
            const double(**corner)[3] = zeroed(4, sizeof *corner);
            /* Positions for the four corners of the square; elements and vertices stand in the same
             * order in all meshes. */
            const fracas_surface *at[4];
            for (int c = 0; c < 4; c++) {
                for (size_t v = 0; v < plain->nvertices; v++) {
                    shift[v][0] = c % 2 ? 1.0 : -1.0;
                    shift[v][1] = c / 2 ? 1.0 : -1.0;
                }
                const fracas_surface_fineness fineness = {.divisions = n,
                                                          .order = 1,
                                                          .amplitude = 0.3,
                                                          .nshifts = plain->nvertices,
                                                          .shift = (const double(*)[2])shift};
                at[c] = surface_of(b->shape, b->length, &fineness);
                corner[c] = at[c]->node;
            }
            double least = INFINITY;
            for (size_t e = 0; e < plain->nelements; e++)
                for (int c = 0; c < 64; c++) {
                    double node[3][3];
                    for (size_t k = 0; k < 3; k++)
                        memcpy(node[k], corner[c >> (2 * k) & 3][corner_of(plain, e, k)],
                               sizeof node[k]);
                    const fracas_surface one = {.corners = 3,
                                                .node = (const double(*)[3])node,
                                                .element = (uint32_t[]){0, 1, 2}};
                    least = fmin(least, outward(b, &one, 0) / outward(b, plain, e));
                }
            if (!(least > 0.0)) fail_msg("%s, %zu divisions: %g", b->name, n, least);
            if (n == 9)
                print_message("%s: least area after the worst perturbation %.4f of its own\n",
                              b->name, least);
            for (int c = 0; c < 4; c++) fracas_surface_destroy(at[c]);
            free(corner);
            free(shift);
        }
}

static void test_perturbed(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++)
        for (int order = 1; order <= 2; order++)
            for (uint64_t seed = 1; seed <= 12; seed++) {
                const size_t n = (size_t)seed;
                const body *b = &bodies[i];
                OWN(a_surface) s = perturbed(b, n, order, seed, seed % 2),
                               *plain = made(b, n, order);
                check_body(b, s);
                size_t moved = 0;
                double most = 0.0;
                fracas_surface_measures all;
                fracas_surface_measure(plain, &all);
                for (size_t k = 0; k < s->nnodes; k++) {
                    double d = 0.0;
                    for (int c = 0; c < 3; c++) d += pow(s->node[k][c] - plain->node[k][c], 2.0);
                    most = fmax(most, sqrt(d));
                    moved += d > 0.0;
                }
                /* An edge is never shorter than the altitude, 2/sqrt(3) of which is the local
                 * length. */
                assert_true(most <= 0.3 * sqrt(2.0) * 2.0 / sqrt(3.0) * all.largest_edge);
                if (n > 4) assert_true(moved > s->nnodes / 4 && most > 0.1 * all.least_edge);
            }
}

/* Coarse, thick, thin: circles never cross, curved ones included. */
static void test_annuli(void **state)
{
    for (double inner = 0.01; inner < 0.995; inner += 0.0701)
        for (size_t divisions = 1; divisions <= 4; divisions++)
            for (int order = 1; order <= 2; order++) {
                const fracas_surface_fineness fineness = {.divisions = divisions, .order = order};
                const double radii[2] = {inner, 1.0};
                OWN(a_surface) plain = surface_of(SHAPE_ANNULUS, radii, &fineness),
                               *s = surface_moved(SHAPE_ANNULUS, radii, divisions, order, divisions,
                                                  true);
                double area = 0.0;
                for (size_t e = 0; e < s->nelements; e++) {
                    assert_true(outward(&bodies[1], plain, e) > 0.0 &&
                                outward(&bodies[1], s, e) > 0.0);
                    area += s->area[e];
                }
                fracas_surface_measures all;
                fracas_surface_measure(plain, &all);
                assert_true(fabs(area - all.area) < 1e-13);
                assert_int_equal(euler(s), 0);
            }
}

static void expect(fracas_err err, const char *message)
{
    FAILS(err, FRACAS_USAGE, message);
}

static void test_refused(void **state)
{
    const fracas_surface *s = NULL;
    const double shift[4][2] = {{0.0, 0.5}, {0.0, -1.5}, {0.0, 0.0}, {0.0, 0.0}};
    fracas_surface_fineness f = {.divisions = 1, .order = 1};
    expect(fracas_surface_rectangle(-1.0, 1.0, &f, &s), "the width of a surface is -1 m");
    expect(fracas_surface_rectangle(1.0, NAN, &f, &s), "the height of a surface is nan m");
    expect(fracas_surface_annulus(0.0, 1.0, &f, &s), "the inner radius of a surface is 0 m");
    expect(fracas_surface_annulus(1.0, 1.0, &f, &s),
           "the outer radius of an annulus is 1 m, the inner one 1 m");
    expect(fracas_surface_sphere(INFINITY, &f, &s), "the radius of a surface is inf m");
    expect(fracas_surface_octant(0.0, &f, &s), "the radius of a surface is 0 m");
    expect(fracas_surface_cylinder(0.0, 1.0, 0, &f, &s), "the radius of a surface is 0 m");
    expect(fracas_surface_cylinder(1.0, -1.0, 0, &f, &s), "the length of a surface is -1 m");
    expect(fracas_surface_cylinder(1e-20, 1e20, 0, &f, &s), "elements, more than");
    f.order = 3;
    expect(fracas_surface_sphere(1.0, &f, &s), "order 1 or 2, not 3");
    f.order = 1;
    f.size = 0.1;
    expect(fracas_surface_sphere(1.0, &f, &s), "not both");
    f.divisions = 0;
    f.size = -0.1;
    expect(fracas_surface_sphere(1.0, &f, &s), "the size of the elements of a surface is -0.1 m");
    f.size = 1e-20;
    expect(fracas_surface_sphere(1.0, &f, &s), "e+20 divisions");
    expect(fracas_surface_annulus(1.0, 2.0, &f, &s), "divisions");
    f.size = 1e-5;
    expect(fracas_surface_rectangle(1.0, 1.0, &f, &s), "elements, more than");
    expect(fracas_surface_annulus(1.0, 2.0, &f, &s), "elements, more than");
    f.size = 0.0;
    expect(fracas_surface_sphere(1.0, &f, &s), "not neither");
    f.divisions = 1;
    f.amplitude = 0.31;
    expect(fracas_surface_rectangle(1.0, 1.0, &f, &s),
           "perturbation is 0.31: it should be between 0 and 0.3");
    f.amplitude = 0.3;
    expect(fracas_surface_rectangle(1.0, 1.0, &f, &s),
           "needs a pair of numbers for each of its 4 vertices, not 0");
    f.shift = shift;
    f.nshifts = 3;
    expect(fracas_surface_rectangle(1.0, 1.0, &f, &s), "4 vertices, not 3");
    f.nshifts = 4;
    expect(fracas_surface_rectangle(1.0, 1.0, &f, &s),
           "number 1 of vertex 1 in a mesh's perturbation is -1.5");
    assert_null(s);
}

/* The same bits from every compiler and on every CPU: a change of these is one of every mesh. */
static void test_bits(void **state)
{
    static const uint64_t golden[][2] = {
        {0x8a331ad5461bbe74, 0x61ed2581fd5f1d39}, {0x1cb5415b2eb412d1, 0xe9a0ad3b1ad00f0f},
        {0xca48d546424be57a, 0x4c6850602b364004}, {0x90feec28914a2f5a, 0xd4d117494b31ceb0},
        {0xcede5846f91ba28c, 0xe72a49de7536bd6b}, {0x5a69bd3eb1175bdf, 0x07642968c7cf1387},
        {0xc8ba51e48c100802, 0xf7c9291d99e7b149}, {0xa28dff65af647bb7, 0x08ef8178cb5ae972}};
    bool same = true;
    for (size_t i = 0; i < FRACAS_COUNT(bodies); i++)
        for (int order = 1; order <= 2; order++) {
            OWN(a_surface) s = perturbed(&bodies[i], 9, order, 77, false);
            const uint64_t sum = checksum_of(s);
            same = same && sum == golden[i][order - 1];
            if (sum != golden[i][order - 1])
                print_message("%s, order %d: 0x%016llx\n", bodies[i].name, order,
                              (unsigned long long)sum);
        }
    assert_true(same);
}

TESTS(test_bodies, test_planes, test_areas, test_annulus_area, test_uniformity, test_size,
      test_never_inverts, test_perturbed, test_annuli, test_refused, test_bits)
