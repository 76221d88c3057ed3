/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fragments in space: sums over nodes become centre, momenta and the spin of a rigid body. */
#include "engine/fragments/fragments.h"
#include "tests/support/test.h"

#include <float.h>

typedef struct {
    double at[3];
} vector;

static vector plus(vector a, double factor, vector b)
{
    for (int i = 0; i < 3; i++) a.at[i] += factor * b.at[i];
    return a;
}

static vector turned(vector a, vector b) /* a x b */
{
    return (vector){{a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
                     a.at[0] * b.at[1] - a.at[1] * b.at[0]}};
}

static double inner(vector a, vector b)
{
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}
static double length(vector a)
{
    return sqrt(inner(a, a));
}

static double off(const double found[3], vector expected)
{
    return length(plus((vector){{found[0], found[1], found[2]}}, -1, expected));
}

/* Two unit vectors across each other and their normal, far from every axis: columns of a rotation
 * by quaternion (1, 2, 3, 4)/sqrt(30). */
static const vector along = {{-20.0 / 30, 20.0 / 30, 10.0 / 30}},
                    across = {{4.0 / 30, -10.0 / 30, 28.0 / 30}},
                    normal = {{22.0 / 30, 20.0 / 30, 4.0 / 30}};

/* Adds a node at place y of a body whose centre X moves with V and that turns with omega. */
static void add_node(fracas_fragment_sums *sums, double mass, vector centre, vector speed,
                     vector omega, vector y)
{
    const vector x = plus(centre, 1, y), v = plus(speed, 1, turned(omega, y));
    fracas_fragment_sums_add(sums, mass, x.at, v.at);
}

static fracas_fragment only(const fracas_fragment_sums *sums)
{
    RECORD(record);
    record.fragments_dust = 0;
    OK(fracas_fragments_take(sums, 1, 2, &record));
    assert_true(record.nfragment == 1 && record.fragments == 1);
    const fracas_fragment f = record.fragment[0];
    return f;
}

/* A square plate of side a, n x n points of mass m, tilted in space, about a tilted axis: L = I_1
 * (omega - (omega.n) n) + 2 I_1 (omega.n) n with I_1 = n^2 m a^2 (n + 1)/(12 (n - 1)), and the spin
 * is omega. Velocities are rounded to 1.1e-16 of V + omega a, places to 1.1e-16 of X: the angular
 * momentum of n^2 = 25 nodes is off by at most some 25 x 4 roundings of its largest term M X (V +
 * omega a), and L = M a^2 omega/12 at least, so 1e-14 of 12 X (V + omega a)/(a^2 omega), at each
 * distance X. */
static void a_plate_that_turns(void **unused)
{
    const double a = 2e-3, mass = 3e-6, distances[] = {0, 1e-3, 1.0};
    const int n = 5;
    const vector omega = {{3e3, -5e3, 7e3}}, speed = {{40, 20, -70}};
    for (int d = 0; d < 3; d++) {
        fracas_fragment_sums sums = {.elements = 3, .size = 0.5};
        const vector centre = plus((vector){{0, 0, 0}}, distances[d], (vector){{0.3, -0.7, 0.5}});
        for (int i = 0; i < n * n; i++) {
            const vector y = plus(plus((vector){{0, 0, 0}}, a * ((i % n) / (n - 1.0) - 0.5), along),
                                  a * ((i / n) / (n - 1.0) - 0.5), across);
            add_node(&sums, mass, centre, speed, omega, y);
        }
        const fracas_fragment f = only(&sums);
        const double inertia = n * n * mass * a * a * (n + 1) / (12.0 * (n - 1));
        const vector moment = plus(plus((vector){{0, 0, 0}}, inertia, omega),
                                   inertia * inner(omega, normal), normal);
        const double reach = distances[d] + a, fast = length(speed) + a * length(omega);
        const double bound = 1e-14 * 12 * reach * fast / (a * a * length(omega));
        print_message("[  figures ] at %g m: spin off by %.1e of it, bound %.1e\n", distances[d],
                      off(f.spin, omega) / length(omega), bound);
        assert_true(off(f.spin, omega) < bound * length(omega));
        assert_true(off(f.angular_momentum, moment) < bound * length(moment));
        assert_true(off(f.position, centre) < 1e-14 * reach &&
                    off(f.velocity, speed) < 1e-14 * fast);
        assert_true(fabs(f.mass / (n * n * mass) - 1) < 1e-14 && f.size == 0.5 && f.elements == 3 &&
                    f.dust == 0);
    }
}

/* A body of three different moments of inertia (boxes of 8 corners, sides 1 : 0.5 : 0.01), an axis
 * that is none of its own, and one of equal ones (a cube): a dozen roundings of each, and the
 * largest moment over the smallest, 4, of those: 1e-14. */
static void a_box_that_turns(void **unused)
{
    const double sides[2][3] = {{1, 0.5, 0.01}, {0.3, 0.3, 0.3}};
    const vector omega = {{0.3, 2, -1}}, still = {{0, 0, 0}};
    for (int b = 0; b < 2; b++) {
        fracas_fragment_sums sums = {0};
        for (int i = 0; i < 8; i++) {
            vector y = plus(still, (i & 1 ? 0.5 : -0.5) * sides[b][0], along);
            y = plus(y, (i & 2 ? 0.5 : -0.5) * sides[b][1], across);
            y = plus(y, (i & 4 ? 0.5 : -0.5) * sides[b][2], normal);
            add_node(&sums, 2, still, still, omega, y);
        }
        const fracas_fragment f = only(&sums);
        double square[3];
        for (int i = 0; i < 3; i++) square[i] = 16 * 0.25 * sides[b][i] * sides[b][i];
        vector moment = plus(still, (square[1] + square[2]) * inner(omega, along), along);
        moment = plus(moment, (square[2] + square[0]) * inner(omega, across), across);
        moment = plus(moment, (square[0] + square[1]) * inner(omega, normal), normal);
        assert_true(off(f.spin, omega) < 1e-14 * length(omega));
        assert_true(off(f.angular_momentum, moment) < 1e-14 * length(moment));
    }
}

/* Two masses a distance D apart: L = mu D x (v_2 - v_1), mu = m_1 m_2/(m_1 + m_2), and of all spins
 * that have it the least is D x (v_2 - v_1)/D^2: none about D. Seen from 1 m and 100 m away, too,
 * where rounding gives the line a thickness of 1e-16 m and 1e-14 m. Bounds as for the plate. So for
 * more nodes on a line; a single node has no spin, wherever it is. */
static void what_lies_on_a_line_does_not_turn_about_it(void **unused)
{
    const vector still = {{0, 0, 0}}, omega = {{3e3, -5e3, 7e3}}, speed = {{40, 20, -70}};
    const vector seen = plus(omega, -inner(omega, along),
                             along); /* without the part about the line */
    for (int nodes = 1; nodes <= 7; nodes++)
        for (int d = 0; d < 4; d++) {
            const double distances[] = {0, 1e-3, 1, 100}, distance = distances[d], size = 1e-3;
            const vector centre = plus(still, distance, normal);
            fracas_fragment_sums sums = {0};
            double mass = 0, middle = 0;
            for (int k = 0; k < nodes; k++) {
                add_node(&sums, k + 1, centre, speed, omega, plus(still, k * size, along));
                mass += k + 1;
                middle += (k + 1) * k * size;
            }
            middle /= mass;
            const fracas_fragment f = only(&sums);
            const double bound = 1e-14 * 12 * (distance + 7 * size) *
                                 (length(speed) + 7 * size * length(omega)) / (size * size);
            assert_true(off(f.spin, nodes == 1 ? still : seen) <= bound);
            assert_true(fabs(inner((vector){{f.spin[0], f.spin[1], f.spin[2]}}, along)) <= bound);
            if (nodes == 1) assert_true(off(f.spin, still) == 0);
            if (nodes != 2) continue;
            const vector apart = plus(still, size, along), relative = turned(omega, apart);
            assert_true(off(f.angular_momentum, plus(still, 2.0 / 3, turned(apart, relative))) <=
                        bound * size * size);
            assert_true(off(f.spin, plus(still, 1 / (size * size), turned(apart, relative))) <=
                        bound);
            assert_true(off(f.position, plus(centre, middle, along)) < 1e-15 * (distance + size));
        }
}

/* Two nodes in one place but for its rounding are a point: without the bound on that the spin would
 * be 1 m/s over 1e-16 m. */
static void a_rounding_is_no_body(void **unused)
{
    fracas_fragment_sums sums = {0};
    const double x[2][3] = {{1, -0.7, 0.3}, {nextafter(1, 2), -0.7, 0.3}},
                 v[2][3] = {{0, 1, 2}, {0.5, -1, 1}};
    for (int k = 0; k < 2; k++) fracas_fragment_sums_add(&sums, 1, x[k], v[k]);
    const fracas_fragment f = only(&sums);
    for (int i = 0; i < 3; i++) assert_true(f.spin[i] == 0);
}

/* In a plane only L_z is there, and spin = L_z/(sum of m y.y) about z: the others are 0 to the bit.
 */
static void in_the_plane_the_spin_is_upright(void **unused)
{
    uint64_t state = 3;
    for (int trial = 0; trial < 100; trial++) {
        fracas_fragment_sums sums = {0};
        double x[9][2], mass[9], polar = 0;
        for (int k = 0; k < 9; k++) {
            const double at[3] = {x[k][0] = random_noise(&state), x[k][1] = random_noise(&state),
                                  0},
                         v[3] = {random_noise(&state), random_noise(&state), 0};
            fracas_fragment_sums_add(&sums, mass[k] = 1 + random_noise(&state), at, v);
        }
        const fracas_fragment f = only(&sums);
        for (int k = 0; k < 9; k++)
            polar += mass[k] * ((x[k][0] - f.position[0]) * (x[k][0] - f.position[0]) +
                                (x[k][1] - f.position[1]) * (x[k][1] - f.position[1]));
        assert_true(f.spin[0] == 0 && f.spin[1] == 0 && f.angular_momentum[0] == 0 &&
                    f.angular_momentum[1] == 0);
        assert_true(f.position[2] == 0 && f.velocity[2] == 0 && f.spin[2] != 0);
        assert_true(fabs(f.spin[2] * polar - f.angular_momentum[2]) <
                    1e-14 *
                        fabs(f.angular_momentum[2])); /* some 20 roundings of sums of one sign */
    }
}

/* A triangle of consistent masses M_kl = m (1 + delta_kl)/12: its second moments about its centre
 * are m/12 sum of y_k y_k^T, a quarter of what masses m/3 at its vertices have, and so is L; the
 * spin of either is omega. */
static void consistent_masses_turn_as_the_triangle_does(void **unused)
{
    const vector still = {{0, 0, 0}}, omega = {{0.3, 2, -1}}, centre = {{2, -1, 0.5}},
                 speed = {{1, 0.2, 3}};
    vector y[3] = {along, across, still};
    const vector middle = plus(plus(still, 1.0 / 3, along), 1.0 / 3, across);
    fracas_fragment_sums lumped = {.elements = 1}, coupled = {.elements = 1};
    const double mass = 1.2;
    for (int k = 0; k < 3; k++) {
        y[k] = plus(y[k], -1, middle);
        add_node(&lumped, mass / 3, centre, speed, omega, y[k]);
    }
    for (int k = 0; k < 3; k++) {
        vector carried = still, momentum = still;
        for (int l = 0; l < 3; l++) {
            const double share = mass * (k == l ? 2 : 1) / 12;
            carried = plus(plus(carried, share, centre), share, y[l]);
            momentum = plus(plus(momentum, share, speed), share, turned(omega, y[l]));
        }
        const vector x = plus(centre, 1, y[k]), v = plus(speed, 1, turned(omega, y[k]));
        fracas_fragment_sums_add_coupled(&coupled, mass / 3, x.at, v.at, carried.at, momentum.at);
    }
    const fracas_fragment a = only(&lumped), b = only(&coupled);
    const vector quarter = plus(
        still, 0.25,
        (vector){{a.angular_momentum[0], a.angular_momentum[1], a.angular_momentum[2]}});
    /* A dozen roundings of X V = 8, L = 0.1 m omega: 1e-13 */
    assert_true(off(a.spin, omega) < 1e-13 && off(b.spin, omega) < 1e-13);
    assert_true(off(b.angular_momentum, quarter) < 1e-13 && length(quarter) > 0.1);
    assert_true(off(b.position, centre) < 1e-14 && off(b.velocity, speed) < 1e-14 &&
                fabs(b.mass - mass) < 1e-15 && b.dust == 1);
}

/* Any motion: momentum and moment of momentum of the fragments are those of the nodes; some 60
 * roundings of terms below 1: 1e-14. */
static void momenta_are_those_of_the_nodes(void **unused)
{
    enum { COUNT = 5, NODES = 60 };
    uint64_t state = 17;
    fracas_fragment_sums sums[COUNT];
    memset(sums, 0, sizeof sums);
    vector momentum = {{0}}, moment = {{0}};
    for (int k = 0; k < NODES; k++) {
        const vector x = {{random_noise(&state), random_noise(&state), random_noise(&state)}},
                     v = {{random_noise(&state), random_noise(&state), random_noise(&state)}};
        const double mass = 0.6 + random_noise(&state);
        fracas_fragment_sums_add(&sums[k % COUNT], mass, x.at, v.at);
        sums[k % COUNT].elements = k % COUNT;
        momentum = plus(momentum, mass, v);
        moment = plus(moment, mass, turned(x, v));
    }
    RECORD(record);
    OK(fracas_fragments_take(sums, COUNT, 2, &record));
    assert_int_equal(record.nfragment, COUNT);
    assert_int_equal(record.fragments, COUNT);
    assert_int_equal(record.fragments_dust, 3); /* of 0, 1 and 2 elements */
    vector whole = {{0}}, about = {{0}};
    for (int f = 0; f < COUNT; f++) {
        const fracas_fragment *part = &record.fragment[f];
        const vector x = {{part->position[0], part->position[1], part->position[2]}},
                     v = {{part->velocity[0], part->velocity[1], part->velocity[2]}};
        whole = plus(whole, part->mass, v);
        about = plus(plus(about, part->mass, turned(x, v)), 1,
                     (vector){{part->angular_momentum[0], part->angular_momentum[1],
                               part->angular_momentum[2]}});
        assert_int_equal(part->dust, part->elements <= 2);
    }
    assert_true(off(record.momentum, momentum) < 1e-14 && off(whole.at, momentum) < 1e-14 &&
                off(about.at, moment) < 1e-14);
    assert_true(length(momentum) > 0.1 && length(moment) > 0.1);
}

/* What is no number stays none. */
static void no_number_has_no_spin(void **unused)
{
    fracas_fragment_sums sums = {0};
    for (int k = 0; k < 4; k++) {
        const double x[3] = {k == 2 ? NAN : k % 2, k / 2, 1}, v[3] = {1, 2, 3};
        fracas_fragment_sums_add(&sums, 1, x, v);
    }
    const fracas_fragment f = only(&sums);
    for (int i = 0; i < 3; i++) assert_true(isnan(f.spin[i]));
}

/* ---- motions ---- */

enum { SIDE = 4, CUBE = SIDE * SIDE * SIDE };

/* Node k of a cube of side 3 about `centre`; its axes are those of space, all second moments alike:
 * 64 x 1.25 of masses 1. */
static vector cube_node(int k, vector centre)
{
    const vector y = {{k % SIDE - 1.5, k / SIDE % SIDE - 1.5, k / SIDE / SIDE - 1.5}};
    return plus(centre, 1, y);
}

/* Kinetic energy of masses 1 at x with velocities v, beside the motion of this kind. */
static double beside(const vector *x, const vector *v, int count, fracas_motion kind)
{
    fracas_fragment_sums all = {.elements = 2}, rest = {0};
    for (int k = 0; k < count; k++) fracas_fragment_sums_add(&all, 1, x[k].at, v[k].at);
    const fracas_fragment_motion motion = fracas_fragment_motion_of(&all, kind);
    for (int k = 0; k < count; k++) {
        vector left = v[k];
        fracas_fragment_motion_take_off(&motion, x[k].at, left.at);
        fracas_fragment_sums_add(&rest, 1, x[k].at, left.at);
    }
    return rest.kinetic;
}

/* A rigid motion leaves nothing beside it, of either kind; a homogeneous one its strain rates
 * beside the rigid motion, 64 x 1.25/2 sum of D_ij^2, D the symmetric part of its gradient;
 * velocities +1 and -1 in turn are across all of these and keep their 64/2 a direction. The rests
 * of velocities of 100 are some ten roundings of 1e-14: energies of 64 x 1e-26 at most. */
static void what_is_beside_a_motion(void **unused)
{
    const vector centre = {{2, -1, 0.5}}, speed = {{30, -20, 60}}, omega = {{3, 20, -10}};
    const double gradient[3][3] = {{20, 3, -4}, {7, -15, 2}, {1, 9, 5}};
    vector x[CUBE], rigid[CUBE], homogeneous[CUBE], all[CUBE];
    double strain = 0;
    for (int i = 0; i < 9; i++) {
        const double rate = 0.5 * (gradient[i / 3][i % 3] + gradient[i % 3][i / 3]);
        strain += 0.5 * CUBE * 1.25 * rate * rate;
    }
    for (int k = 0; k < CUBE; k++) {
        const vector y = cube_node(k, (vector){{0}});
        const double sign = (k + k / SIDE + k / SIDE / SIDE) % 2 ? -1 : 1;
        x[k] = plus(centre, 1, y);
        rigid[k] = plus(speed, 1, turned(omega, y));
        homogeneous[k] = speed;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) homogeneous[k].at[i] += gradient[i][j] * y.at[j];
        all[k] = plus(homogeneous[k], sign, (vector){{1, 1, 1}});
    }
    const double least = 1e-24;
    assert_true(beside(x, rigid, CUBE, FRACAS_MOTION_RIGID) < least);
    assert_true(beside(x, rigid, CUBE, FRACAS_MOTION_HOMOGENEOUS) < least);
    assert_true(beside(x, homogeneous, CUBE, FRACAS_MOTION_HOMOGENEOUS) < least);
    assert_true(fabs(beside(x, homogeneous, CUBE, FRACAS_MOTION_RIGID) / strain - 1) < 1e-12);
    /* the cross term of a rest of 1e-13 and of 96 */
    assert_true(fabs(beside(x, all, CUBE, FRACAS_MOTION_HOMOGENEOUS) - 96) < 1e-10);
    assert_true(beside(x, all, CUBE, FRACAS_MOTION_NONE) > 1e5);
}

/* In directions without extent there is no gradient: two nodes part along their line and turn about
 * their middle, one node flies, and nothing is left. */
static void points_and_lines_have_motions(void **unused)
{
    const vector x[2] = {{{1, 2, 3}}, {{2, 0, 1}}}, v[2] = {{{5, -7, 2}}, {{-3, 1, 4}}};
    assert_true(beside(x, v, 1, FRACAS_MOTION_HOMOGENEOUS) == 0);
    assert_true(beside(x, v, 2, FRACAS_MOTION_HOMOGENEOUS) < 1e-28);
    /* rigid: what is along the line, 2 x 1/2 (|dv . dx|/|dx|/2)^2, dv . dx = -8 - 16 - 4 */
    const double along_line = 28.0 * 28.0 / 9 / 4;
    assert_true(fabs(beside(x, v, 2, FRACAS_MOTION_RIGID) - along_line) < 1e-12 * along_line);
}

TESTS(a_plate_that_turns, a_box_that_turns, what_lies_on_a_line_does_not_turn_about_it,
      a_rounding_is_no_body, in_the_plane_the_spin_is_upright,
      consistent_masses_turn_as_the_triangle_does, momenta_are_those_of_the_nodes,
      no_number_has_no_spin, what_is_beside_a_motion, points_and_lines_have_motions)
