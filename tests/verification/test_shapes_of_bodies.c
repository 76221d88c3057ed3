/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of the fragments of bars, rings, membranes and shells, beside closed forms. */
#include "engine/formulation/chain/chain.h"
#include "engine/solver/shapes.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/ring.h"
#include "tests/support/shell.h"

#define HALF_SIDE 1.2909944487358056 /* sqrt(5/3): semi-axis of a box by half its side */

static void same(double found, double wanted, double tolerance)
{
    if (fabs(found - wanted) <= tolerance * fabs(wanted)) return;
    fail_msg("%.17g for %.17g: off by %.1e of it", found, wanted, fabs(found / wanted - 1));
}

/* The record of a lane as it is. */
static void shapes_of(const fracas_batch *batch, fracas_record *record)
{
    fracas_step *step = (fracas_step *)&batch->step;
    fracas_record_clear(record);
    record->fragments_dust = 0;
    OK(batch->model->formulation->harvest(batch->model, step, 0, record));
    OK(fracas_shapes_take(batch->model, step, 0, record));
    double volume = 0;
    for (size_t f = 0; f < record->nfragment; f++) volume += record->fragment[f].volume;
    same(volume, batch->model->mass / batch->model->spec.material.density, 1e-12);
}

/* ---- chains ---- */

static void break_chain(const fracas_batch *batch, size_t e)
{
    const fracas_model *model = batch->model;
    *fracas_chain_field(model, &batch->step, e, model->chain->damage, 0) = 1;
}

/* Pieces of a bar at rest, one of them across the end of the coordinate: a rod of its length l with
 * a square section of 1 mm2. Then the same when the bar is stretched by 1.1, and its pieces are
 * not. Sums of 100 terms: 1e-12. */
static void pieces_of_a_bar(void **unused)
{
    enum { N = 100 };
    for (int spacing = 0; spacing < 2; spacing++)
        for (int stretched = 0; stretched < 2; stretched++) {
            fracas_spec spec = bar_reference(N, 1e4, 1);
            if (spacing) bar_grade(&spec, 4);
            one_run run = begin(&spec, 300e6);
            const fracas_model *model = run.model;
            const size_t after[] = {9, 39, 79}; /* breaks: behind these */
            for (int k = 0; k < 3; k++) break_chain(run.batch, after[k]);
            if (stretched) run.batch->step.time[0] = 1e-5;
            double start = 0;
            for (size_t e = 0; e < N; e++) { /* w takes back the stretch of each element's place */
                const double h = fracas_chain_size(model, e), back = stretched ? -0.1 : 0,
                             from = e > after[2] ? start - spec.geometry.length : start;
                *fracas_chain_field(model, &run.batch->step, e, 0, 0) = back * from;
                *fracas_chain_field(model, &run.batch->step, e, 1, 0) = back * (from + h);
                start += h;
            }
            RECORD(record);
            shapes_of(run.batch, &record);
            assert_int_equal(record.nfragment, 3);
            for (size_t f = 0; f < 3; f++) {
                const fracas_fragment *part = &record.fragment[f];
                const double length = part->size;
                same(part->volume, length * 1e-6, 1e-12);
                same(part->semi_axis[0], sqrt(5.0 / 12) * length, 1e-12);
                same(part->semi_axis[1], sqrt(5e-6 / 12), 1e-12);
                same(part->semi_axis[2], sqrt(5e-6 / 12), 1e-12);
                for (int i = 0; i < 9; i++) assert_true(part->axis[i / 3][i % 3] == (i % 4 == 0));
                same(part->extent, length, 1e-12);
                assert_true(part->crack_area == 2e-6);
            }
            clear_run(&run);
        }
}

/* A closed bar with one break is one piece, with a face on either side of it; without a break it
 * has none. */
static void a_bar_in_one_piece(void **unused)
{
    fracas_spec spec = bar_reference(50, 1e4, 1);
    one_run run = begin(&spec, 300e6);
    RECORD(record);
    for (int breaks = 0; breaks < 2; breaks++) {
        shapes_of(run.batch, &record);
        assert_int_equal(record.nfragment, 1);
        same(record.fragment[0].extent, 0.05, 1e-12);
        assert_true(record.fragment[0].crack_area == breaks * 2e-6);
        break_chain(run.batch, 20);
    }
    clear_run(&run);
}

/* An arc of the half angle a and radius R has its centre at R sin a/a, the second moments by mass
 * R^2 (1/2 + sin 2a/(4a)) - (R sin a/a)^2 along the direction to it, R^2 (1/2 - sin 2a/(4a))
 * across, and of a section of area A A/12 along the normals: that times (1/2 + sin 2a/(4a)), times
 * (1/2 - sin 2a/(4a)), and 1 out of the plane. Chords of 1/1000 of the ring, of its length, miss
 * the arc by (pi/1000)^2. Its ends are a chord apart. */
static void arcs_of_a_ring(void **unused)
{
    enum { N = 1000 };
    fracas_spec spec = ring_reference(N, 1e4, 1);
    spec.geometry.area = 1e-8;
    one_run run = begin(&spec, 300e6);
    const size_t after[] = {49, 349};
    for (int k = 0; k < 2; k++) break_chain(run.batch, after[k]);
    RECORD(record);
    shapes_of(run.batch, &record);
    assert_int_equal(record.nfragment, 2);
    const fracas_fragment *part = &record.fragment[1]; /* 300 elements about an angle of 0.4 pi */
    const double half = 0.3 * M_PI, radius = RING_RADIUS, ratio = sin(2 * half) / (4 * half),
                 centre = sin(half) / half, section = 1e-8 / 12,
                 near = radius * radius * (0.5 + ratio - centre * centre) + section * (0.5 + ratio),
                 wide = radius * radius * (0.5 - ratio) + section * (0.5 - ratio);
    same(part->semi_axis[0], sqrt(5 * wide), 1e-5);
    same(part->semi_axis[1], sqrt(5 * near), 1e-5);
    same(part->semi_axis[2], sqrt(5 * section), 1e-12);
    assert_true(fabs(part->axis[0][0] - sin(0.4 * M_PI)) < 1e-5 &&
                fabs(part->axis[0][1] + cos(0.4 * M_PI)) < 1e-5 && part->axis[0][2] == 0);
    same(fabs(part->axis[2][2]), 1, 1e-14);
    /* nodes are where the chords have the length of arcs */
    same(part->extent, 2 * radius * (M_PI / N) / sin(M_PI / N) * sin(half), 1e-12);
    assert_true(part->crack_area == 2e-8);
    /* the rest is more than half of the ring: two nodes are a diameter apart */
    same(record.fragment[0].extent, 2 * radius * (M_PI / N) / sin(M_PI / N), 1e-12);
    clear_run(&run);
}

/* ---- surfaces ---- */

static void check_box(const fracas_fragment *part, const double side[3], double tolerance)
{
    same(part->volume, side[0] * side[1] * side[2], tolerance);
    for (int a = 0; a < 3; a++) same(part->semi_axis[a], HALF_SIDE * side[a] / 2, tolerance);
    same(part->extent, hypot(side[0], side[1]), tolerance);
}

/* A plate of 12 mm x 10 mm x 1 mm in one piece, cut through at x = 0, and with one more broken
 * interface inside a half, both of whose faces are that half's. A membrane of either order. */
static void a_plate_and_its_halves(void **unused)
{
    for (int order = 1; order < 3; order++) {
        one_run run = begin_run(
            distorted_model(membrane_spec(&fracas_shape_plate, order, 10), 0, 0), 1, 300e6);
        const fracas_model *model = run.model;
        double(*at)[3] = taken(model->interfaces * sizeof *at);
        fracas_model_interface_positions(model, at);
        RECORD(record);
        shapes_of(run.batch, &record);
        assert_int_equal(record.nfragment, 1);
        const double whole[3] = {12e-3, 10e-3, 1e-3}, half[3] = {10e-3, 6e-3, 1e-3};
        check_box(&record.fragment[0], whole, 1e-12);
        for (int i = 0; i < 9; i++)
            assert_true(fabs(record.fragment[0].axis[i / 3][i % 3] - (i % 4 == 0)) < 1e-12);
        assert_true(record.fragment[0].crack_area == 0);
        size_t inside = SIZE_MAX;
        for (size_t i = 0; i < model->interfaces; i++) {
            if (fabs(at[i][0]) < 1e-9) break_interface(run.batch, i);
            else if (at[i][0] > 3e-3 && inside == SIZE_MAX) inside = i;
        }
        for (int more = 0; more < 2; more++) {
            const double length = fracas_surface_length(
                model->surface, model->surface->interface[inside].element[0],
                model->surface->interface[inside].edge[0]);
            shapes_of(run.batch, &record);
            assert_int_equal(record.nfragment, 2);
            for (size_t f = 0; f < 2; f++) {
                const fracas_fragment *part = &record.fragment[f];
                check_box(part, half, 1e-12);
                same(part->crack_area,
                     (10e-3 + (more && part->position[0] > 0 ? 2 * length : 0)) * 1e-3, 1e-12);
                assert_true(part->axis[0][1] > 1 - 1e-12 && part->axis[1][0] > 1 - 1e-12);
            }
            break_interface(run.batch, inside);
        }
        free(at);
        clear_run(&run);
    }
}

/* The half x > 0 is stretched by 1.3, with the mass of the other: with the half width a, x has the
 * mean 0.075 a and the mean square a^2 (1 + 1.69)/6. */
static void mass_stays_where_matter_is(void **unused)
{
    one_run run = begin_run(distorted_model(membrane_spec(&fracas_shape_plate, 1, 10), 0, 0), 1,
                            300e6);
    for (size_t e = 0; e < run.model->elements; e++) {
        double middle = 0;
        for (size_t k = 0; k < 3; k++) middle += node_at(run.model, e, k)[0];
        for (size_t k = 0; k < 3 && middle > 0; k++)
            *value_at(run.batch, e, SURFACE_U, 2 * k) = 0.3 * node_at(run.model, e, k)[0];
    }
    RECORD(record);
    shapes_of(run.batch, &record);
    const double a = 6e-3;
    same(record.fragment[0].semi_axis[0], sqrt(5 * (2.69 / 6 - 0.075 * 0.075)) * a, 1e-12);
    same(record.fragment[0].extent, hypot(2.3 * a, 10e-3), 1e-12);
    clear_run(&run);
}

/* Displacements of a rigid motion. */
static void move_rigidly(const fracas_batch *batch, const double turn[3][3], const double shift[3])
{
    for (size_t at = 0; at < unknowns_of(batch->model); at += 3) {
        const double *x = place_of(batch->model, at);
        for (size_t i = 0; i < 3; i++)
            *value_of(batch, at + i, SURFACE_U) = shift[i] + dot3(turn[i], x) - x[i];
    }
}

/* A shell: a flat plate that lies aslant in space, and that a motion turns once more, far away. The
 * thickness is along its normal. */
static const double aslant[3][3] = {{-20.0 / 30, 4.0 / 30, 22.0 / 30},
                                    {20.0 / 30, -10.0 / 30, 20.0 / 30},
                                    {10.0 / 30, 28.0 / 30, 4.0 / 30}};
static void aslant_map(const void *how, double s, double t, double x[3])
{
    const double *side = how;
    for (int i = 0; i < 3; i++) x[i] = aslant[i][0] * s * side[0] + aslant[i][1] * t * side[1];
}

static void a_plate_in_space(void **unused)
{
    const double side[3] = {2, 1.5, 0.1}, turn[3][3] = {{0, 0.6, -0.8}, {1, 0, 0}, {0, -0.8, -0.6}},
                 still[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, shift[2][3] = {{0}, {7, -3, 5}};
    const fracas_spec spec = shell_spec(&fracas_shape_plate);
    const shell_grid grid = {6, 5, aslant_map, side, 0.2, 3, 0};
    fracas_model *model = grid_model(&spec, &grid);
    one_run run = begin_run(model, 1, 1);
    RECORD(record);
    for (int moved = 0; moved < 2; moved++) {
        const double(*by)[3] = moved ? turn : still;
        move_rigidly(run.batch, by, shift[moved]);
        shapes_of(run.batch, &record);
        assert_int_equal(record.nfragment, 1);
        const fracas_fragment *plate = &record.fragment[0];
        check_box(plate, side, 1e-12);
        for (int a = 0; a < 3; a++) {
            const double axis[3] = {aslant[0][a], aslant[1][a], aslant[2][a]};
            double image[3];
            for (int i = 0; i < 3; i++) image[i] = dot3(by[i], axis);
            same(fabs(dot3(image, plate->axis[a])), 1, 1e-12);
        }
    }
    clear_run(&run);
}

/* An octant of a sphere of radius R and thickness h has the mean squares of x R^2/3, of x y 2
 * R^2/(3 pi), its centre at R/2 along each, and of its normals 1/3 and 2/(3 pi): moments by mass
 * along (1, 1, 1)   R^2 (4/(3 pi) - 5/12) + h^2/12 (1/3 + 4/(3 pi)), and across, twice,
 * R^2 (1/3 - 2/(3 pi)) + h^2/12 (1/3 - 2/(3 pi)). Its corners are sqrt(2) R apart. Quadratic
 * triangles miss the sphere by h_e^4, 1/16 at half the size. */
static void an_octant_of_a_sphere(void **unused)
{
    double miss[2];
    for (int k = 0; k < 2; k++) {
        fracas_spec spec = shell_spec(&fracas_shape_sphere);
        spec.geometry.part = &fracas_part_octant;
        spec.mesh.divisions = k ? 12 : 6;
        one_run run = begin_run(make_model(&spec), 1, 1);
        RECORD(record);
        shapes_of(run.batch, &record);
        assert_int_equal(record.nfragment, 1);
        const fracas_fragment *octant = &record.fragment[0];
        const double r = 1, h = 0.1, p = 1 / (3 * M_PI), flat = h * h / 12,
                     along = r * r * (4 * p - 5.0 / 12) + flat * (1.0 / 3 + 4 * p),
                     across = (r * r + flat) * (1.0 / 3 - 2 * p);
        const double wanted[3] = {sqrt(5 * across), sqrt(5 * across), sqrt(5 * along)};
        miss[k] = 0;
        for (int a = 0; a < 3; a++)
            miss[k] = fmax(miss[k], fabs(octant->semi_axis[a] / wanted[a] - 1));
        miss[k] = fmax(miss[k], fabs(octant->volume / (M_PI / 2 * r * r * h) - 1));
        for (int i = 0; i < 3; i++) same(fabs(octant->axis[2][i]), sqrt(1.0 / 3), 1e-4);
        assert_true(dot3(octant->axis[2], (const double[3]){1, 1, 1}) *
                        dot3(octant->axis[2], (const double[3]){1, 1, 1}) >
                    3 * (1 - 1e-8));
        same(octant->extent, M_SQRT2 * r, 1e-14);
        clear_run(&run);
    }
    print_message("[  figures ] an octant's shape misses by %.1e, %.1e\n", miss[0], miss[1]);
    assert_true(miss[0] < 3e-4 && miss[1] < miss[0] / 12);
}

/* All interfaces broken: single triangles. Their second moments m/12 sum of y y^T of the corners
 * give a^2 + b^2 = 5/12 sum |y|^2 and a b = 5 A/(6 sqrt 3); their thickness sqrt(5/12) h; the
 * extent is the longest side. Then the faces are all edges but the border's. */
static void single_triangles(void **unused)
{
    for (int order = 1; order < 3; order++) {
        one_run run = begin_run(
            distorted_model(membrane_spec(&fracas_shape_plate, order, 4), DISTORTION, 3), 1, 300e6);
        const fracas_model *model = run.model;
        const double h = model->spec.geometry.thickness;
        double faces = 0, edges = 0;
        for (size_t i = 0; i < model->interfaces; i++) {
            break_interface(run.batch, i);
            edges += 2 * h *
                     fracas_surface_length(model->surface, model->surface->interface[i].element[0],
                                           model->surface->interface[i].edge[0]);
        }
        RECORD(record);
        shapes_of(run.batch, &record);
        assert_int_equal(record.nfragment, model->elements);
        for (size_t e = 0; e < model->elements; e++) {
            const fracas_fragment *part = &record.fragment[e];
            double longest = 0, squares = 0;
            for (size_t k = 0; k < 3; k++) {
                const double *a = node_at(model, e, k), *b = node_at(model, e, (k + 1) % 3);
                longest = fmax(longest, hypot(b[0] - a[0], b[1] - a[1]));
                for (int i = 0; i < 2; i++) /* sum of |y|^2 is that of squared sides, by 3 */
                    squares += (b[i] - a[i]) * (b[i] - a[i]) / 3;
            }
            double in_plane[2];
            int found = 0;
            for (int a = 0; a < 3; a++)
                if (fabs(part->axis[a][2]) < 0.5) in_plane[found++] = part->semi_axis[a];
                else same(part->semi_axis[a], sqrt(5.0 / 12) * h, 1e-12);
            assert_int_equal(found, 2);
            same(in_plane[0] * in_plane[0] + in_plane[1] * in_plane[1], 5 * squares / 12, 1e-12);
            same(in_plane[0] * in_plane[1], 5 * model->surface->area[e] / (6 * sqrt(3)), 1e-12);
            same(part->extent, longest, 1e-12);
            same(part->volume, model->surface->area[e] * h, 1e-12);
            faces += part->crack_area;
        }
        same(faces, edges, 1e-12);
        clear_run(&run);
    }
}

/* A fragment that is nowhere has a volume and no other shape; its neighbour has both. */
static void a_fragment_that_is_nowhere(void **unused)
{
    fracas_spec spec = bar_reference(50, 1e4, 1);
    one_run run = begin(&spec, 300e6);
    break_chain(run.batch, 2);
    break_chain(run.batch, 6);
    *fracas_chain_field(run.model, &run.batch->step, 4, 0, 0) = NAN;
    RECORD(record);
    shapes_of(run.batch, &record);
    const fracas_fragment *nowhere = &record.fragment[1];
    assert_true(isnan(nowhere->extent) && isnan(nowhere->semi_axis[0]) &&
                isnan(nowhere->axis[2][2]) && nowhere->volume > 0 && nowhere->crack_area == 2e-6);
    assert_true(record.fragment[0].extent > 0 && record.fragment[0].semi_axis[2] > 0);
    clear_run(&run);
}

TESTS(pieces_of_a_bar, a_bar_in_one_piece, arcs_of_a_ring, a_plate_and_its_halves,
      mass_stays_where_matter_is, a_plate_in_space, an_octant_of_a_sphere, single_triangles,
      a_fragment_that_is_nowhere)
