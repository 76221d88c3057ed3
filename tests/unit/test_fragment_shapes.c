/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of fragments: the ellipsoid of their matter, the largest distance of their nodes. */
#include "base/param.h"
#include "engine/fragments/ellipsoid.h"
#include "tests/support/test.h"

/* A rotation by the quaternion (1, 2, 3, 4)/sqrt(30); columns are the images of x, y, z. */
static const double turn[3][3] = {{-20.0 / 30, 4.0 / 30, 22.0 / 30},
                                  {20.0 / 30, -10.0 / 30, 20.0 / 30},
                                  {10.0 / 30, 28.0 / 30, 4.0 / 30}};

static void place(const double y[3], const double shift[3], double x[3])
{
    for (int i = 0; i < 3; i++) {
        x[i] = shift[i];
        for (int j = 0; j < 3; j++) x[i] += turn[i][j] * y[j];
    }
}

static double inner(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Sorted, of unit length, across each other, right-handed, and with the signs of the format. */
static void check_axes(const fracas_fragment *f)
{
    assert_true(f->semi_axis[0] >= f->semi_axis[1] && f->semi_axis[1] >= f->semi_axis[2]);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++)
            assert_true(fabs(inner(f->axis[a], f->axis[b]) - (a == b)) < 1e-14);
    for (int a = 0; a < 2; a++) {
        double largest = 0;
        for (int i = 0; i < 3; i++)
            if (fabs(f->axis[a][i]) > fabs(largest)) largest = f->axis[a][i];
        assert_true(largest > 0);
    }
    const double *x = f->axis[0], *y = f->axis[1], *z = f->axis[2];
    assert_true(x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
                    x[2] * (y[0] * z[1] - y[1] * z[0]) >
                0.5);
}

/* A box of sides a, b, h: four plates about the Gauss points of a x b, which are exact. The
 * homogeneous ellipsoid with semi-axes s has the second moments m s^2/5, the box m side^2/12: s =
 * sqrt(5/3) side/2, and its volume is 4 pi/3 (5/3)^1.5/8 = 1.127 of the box's. Some ten roundings
 * of the largest moment, times (X/a)^2 for places rounded far off: 1e-14 (a/h)^2 (1 + X/a). */
static void a_box(void **unused)
{
    const double side[3] = {2e-3, 1e-3, 1e-4}, mass = 3e-6, far[] = {0, 1e-2, 1};
    for (int d = 0; d < 3; d++) {
        const double shift[3] = {0.3 * far[d], -0.7 * far[d], 0.5 * far[d]}, z[3] = {0, 0, 1},
                     still[3] = {0};
        double normal[3], spread[6];
        place(z, still, normal);
        fracas_fragment_spread(normal, mass / 4 * side[2] * side[2] / 12, 0, spread);
        fracas_fragment_matter matter = {0};
        for (int k = 0; k < 4; k++) {
            const double y[3] = {(k & 1 ? 0.5 : -0.5) * side[0] / sqrt(3),
                                 (k & 2 ? 0.5 : -0.5) * side[1] / sqrt(3), 0};
            double x[3];
            place(y, shift, x);
            fracas_fragment_matter_add(&matter, mass / 4, x, spread);
        }
        fracas_fragment f;
        fracas_fragment_set_ellipsoid(&matter, &f);
        check_axes(&f);
        const double bound = 1e-14 * 400 * (1 + far[d] / side[0]);
        double volume = 4 * M_PI / 3;
        for (int a = 0; a < 3; a++) {
            double unit[3] = {0}, image[3];
            unit[a] = 1;
            place(unit, still, image);
            assert_true(fabs(f.semi_axis[a] / (sqrt(5.0 / 3) * side[a] / 2) - 1) < bound);
            assert_true(fabs(fabs(inner(f.axis[a], image)) - 1) < bound);
            volume *= f.semi_axis[a];
        }
        assert_true(fabs(volume / (side[0] * side[1] * side[2]) -
                         M_PI / 6 * (5.0 / 3) * sqrt(5.0 / 3)) < 3 * bound);
    }
}

/* A rod of length l and square section A: sqrt(5/12) l along it, sqrt(5 A/12) across. */
static void a_rod(void **unused)
{
    const double along[3] = {20.0 / 30, -10.0 / 30, 20.0 / 30}, length = 3, area = 0.04, mass = 7,
                 x[3] = {1, 2, 3};
    double spread[6];
    fracas_fragment_spread(along, mass * length * length / 12, mass * area / 12, spread);
    fracas_fragment_matter matter = {0};
    fracas_fragment_matter_add(&matter, mass, x, spread);
    fracas_fragment f;
    fracas_fragment_set_ellipsoid(&matter, &f);
    check_axes(&f);
    assert_true(fabs(f.semi_axis[0] / (sqrt(5.0 / 12) * length) - 1) < 1e-14);
    for (int a = 1; a < 3; a++) /* ten roundings of 9/0.04 times as much */
        assert_true(fabs(f.semi_axis[a] / sqrt(5 * area / 12) - 1) < 1e-12);
    for (int i = 0; i < 3; i++) assert_true(fabs(f.axis[0][i] - along[i]) < 1e-14);
}

/* Lumps of any masses, moved as a rigid body: the same semi-axes to 1e-12, axes turned. Axes are
 * uncertain by 1e-15 of the largest moment over the difference of two, here 2 % at least. */
static void a_rigid_motion_changes_no_shape(void **unused)
{
    uint64_t state = 5;
    const double still[3] = {0}, none[6] = {0}, shift[3] = {3, -2, 7};
    for (int trial = 0; trial < 50; trial++) {
        fracas_fragment_matter here = {0}, there = {0};
        for (int k = 0; k < 40; k++) {
            const double y[3] = {random_noise(&state), 0.6 * random_noise(&state),
                                 0.3 * random_noise(&state)},
                         mass = 0.6 + random_noise(&state);
            double x[3];
            place(y, shift, x);
            fracas_fragment_matter_add(&here, mass, y, none);
            fracas_fragment_matter_add(&there, mass, x, none);
        }
        fracas_fragment a, b;
        fracas_fragment_set_ellipsoid(&here, &a);
        fracas_fragment_set_ellipsoid(&there, &b);
        check_axes(&a);
        check_axes(&b);
        for (int k = 0; k < 3; k++) {
            double image[3];
            place(a.axis[k], still, image);
            assert_true(fabs(b.semi_axis[k] / a.semi_axis[k] - 1) < 1e-12);
            assert_true(fabs(fabs(inner(image, b.axis[k])) - 1) < 1e-12);
        }
    }
}

/* Equal moments keep the order of x, y, z; matter that is nowhere has no shape. */
static void no_preference_and_no_place(void **unused)
{
    const double none[6] = {0};
    fracas_fragment_matter matter = {0};
    for (int k = 0; k < 8; k++) {
        const double x[3] = {k & 1, k >> 1 & 1, k >> 2};
        fracas_fragment_matter_add(&matter, 1, x, none);
    }
    fracas_fragment f;
    fracas_fragment_set_ellipsoid(&matter, &f);
    for (int i = 0; i < 9; i++) assert_true(f.axis[i / 3][i % 3] == (i % 4 == 0));
    for (int a = 0; a < 3; a++) assert_true(f.semi_axis[a] == sqrt(1.25));
    const double nowhere[3] = {0, NAN, 0};
    fracas_fragment_matter_add(&matter, 1, nowhere, none);
    fracas_fragment_set_ellipsoid(&matter, &f);
    for (int i = 0; i < 9; i++)
        assert_true(isnan(f.axis[i / 3][i % 3]) && isnan(f.semi_axis[i % 3]));
}

/* ---- extent ---- */

static double brute_force(const double (*node)[3], size_t count)
{
    double best = 0;
    for (size_t k = 0; k < count; k++)
        for (size_t l = 0; l < k; l++) {
            double square = 0;
            for (int i = 0; i < 3; i++)
                square += (node[k][i] - node[l][i]) * (node[k][i] - node[l][i]);
            best = fmax(best, square);
        }
    return sqrt(best);
}

enum { CUBES, SPHERES, DISCS, NEEDLES, SPLINTERS, CLOUDS };

static void make_cloud(int cloud, uint64_t *state, size_t count, double (*node)[3])
{
    for (size_t k = 0; k < count; k++) {
        double y[3], length;
        do {
            for (int i = 0; i < 3; i++) y[i] = 2 * random_noise(state);
            if (cloud == DISCS) y[2] = 0;
            length = sqrt(inner(y, y));
        } while (cloud != CUBES && (length > 1 || length < 0.1));
        const double factor[3] = {cloud == SPHERES ? 1 / length : 1,
                                  cloud == NEEDLES     ? 0
                                  : cloud == SPLINTERS ? 0.1
                                  : cloud == SPHERES   ? 1 / length
                                                       : 1,
                                  cloud == NEEDLES || cloud == SPLINTERS ? 0
                                  : cloud == SPHERES                     ? 1 / length
                                                                         : 1},
                     shift[3] = {5, 2, -1};
        for (int i = 0; i < 3; i++) y[i] *= factor[i];
        place(y, shift, node[k]);
    }
}

/* The largest distance, exact but for rounding of places of 5 where few nodes may be its ends: that
 * is so of small clouds, of needles and splinters; else no smaller than the sure part of it, and
 * never larger. */
static void the_largest_distance(void **unused)
{
    enum { MOST = 4000 };
    static const size_t counts[] = {0, 1, 2, 3, 17, FRACAS_EXTENT_ALL, 1000, MOST};
    double(*node)[3] = taken(MOST * sizeof *node), worst = 0;
    uint64_t state = 11;
    for (int cloud = CUBES; cloud < CLOUDS; cloud++)
        for (size_t c = 0; c < FRACAS_COUNT(counts); c++) {
            make_cloud(cloud, &state, counts[c], node);
            const double found = fracas_fragment_extent((const double(*)[3])node, counts[c]),
                         wanted = brute_force((const double(*)[3])node, counts[c]);
            const bool exact = counts[c] <= FRACAS_EXTENT_ALL || cloud == NEEDLES ||
                               cloud == SPLINTERS;
            assert_true(found <= wanted * (1 + 1e-15));
            assert_true(found >= wanted * (exact ? 1 - 1e-14 : FRACAS_EXTENT_SURE));
            if (wanted > 0) worst = fmax(worst, 1 - found / wanted);
        }
    print_message("[  figures ] largest distances are at most %.1e too small\n", worst);
    free(node);
}

/* A triangle of equal sides, whose third corner is far from the ball over any side, and nodes along
 * it: more may be ends than are compared in pairs, and directions find the corners. */
static void corners_are_found_among_many(void **unused)
{
    enum { COUNT = 3000 };
    double(*node)[3] = taken(COUNT * sizeof *node);
    const double corner[4][2] = {{0, 0}, {1, 0}, {0.5, 0.86602540378443865}, {0, 0}},
                 shift[3] = {0.1, 0.2, 0.3};
    for (size_t k = 0; k < COUNT; k++) {
        const size_t side = k / (COUNT / 3);
        const double s = (double)(k % (COUNT / 3)) / (COUNT / 3);
        const double y[3] = {corner[side][0] + s * (corner[side + 1][0] - corner[side][0]),
                             corner[side][1] + s * (corner[side + 1][1] - corner[side][1]), 0};
        place(y, shift, node[COUNT - 1 - k]);
    }
    assert_true(fabs(fracas_fragment_extent((const double(*)[3])node, COUNT) - 1) < 1e-14);
    free(node);
}

/* A spheroid with semi-axes 1.2 and 1: from a node of its waist the farthest is opposite, 2 away,
 * and no walk leads from there to the tips, 2.4 apart, far from the axes and diagonals of space.
 * Nodes farthest along a direction 24 degrees from theirs are 0.98 of it apart. */
static void tips_are_found_from_the_waist(void **unused)
{
    enum { COUNT = 4000 };
    double(*node)[3] = taken(COUNT * sizeof *node);
    const double size = sqrt(1 + 0.41 * 0.41 + 0.2 * 0.2),
                 tip[3] = {1 / size, 0.41 / size, 0.2 / size},
                 waist[3] = {-0.41 / hypot(1, 0.41), 1 / hypot(1, 0.41), 0};
    uint64_t state = 7;
    for (size_t k = 0; k < COUNT; k++) {
        double y[3];
        for (int i = 0; i < 3; i++) y[i] = k < 2 ? waist[i] : k < 4 ? tip[i] : random_noise(&state);
        if (k % 2)
            for (int i = 0; i < 3; i++) y[i] = -y[i];
        const double length = sqrt(inner(y, y)), along = inner(y, tip) / length;
        for (int i = 0; i < 3; i++) node[k][i] = y[i] / length + 0.2 * along * tip[i];
    }
    const double found = fracas_fragment_extent((const double(*)[3])node, COUNT);
    assert_true(fabs(brute_force((const double(*)[3])node, COUNT) - 2.4) < 1e-12);
    assert_true(found <= 2.4 * (1 + 1e-14) && found >= 2.4 * FRACAS_EXTENT_SURE);
    free(node);
}

TESTS(a_box, a_rod, a_rigid_motion_changes_no_shape, no_preference_and_no_place,
      the_largest_distance, corners_are_found_among_many, tips_are_found_from_the_waist)
