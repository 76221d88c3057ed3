/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* A tube closed by half spheres: its area, the resultants of a pressure, and its static stretch
 * (docs/theory/meshes.md). */
#include "engine/loading/load.h"
#include "engine/mesh/surface/capsule.h"
#include "tests/support/loads.h"
#include "tests/support/shell.h"
#include "tests/support/shell_statics.h"
#include "tests/support/test.h"

#define RADIUS 1.0
#define LENGTH 4.0
#define PRESSURE 1e-3

static fracas_spec capsule_of(const fracas_kind *part, int64_t divisions)
{
    fracas_spec spec = shell_spec(&fracas_shape_capsule);
    spec.geometry.part = part;
    spec.geometry.radius = RADIUS;
    spec.geometry.length = LENGTH;
    spec.geometry.thickness = 0.05;
    spec.mesh.divisions = divisions;
    spec.loading = bare_load(&fracas_loading_pressure);
    *load_number(&spec.loading, "pressure") = PRESSURE;
    return spec;
}

/* Forces of a pressure by components, and the area. */
typedef struct {
    double force[3], area;
} pressed;

static pressed pressed_of(const fracas_kind *part, int64_t divisions)
{
    pressed sum = {.area = 0};
    fracas_model *model = distorted_model(capsule_of(part, divisions), 0.2, 7);
    const fracas_surface_tables *t = model->plan;
    for (size_t e = 0; e < t->nelements; e++) {
        const double *force = t->load + (t->load_row[e] - 1) * fracas_surface_unknowns(t);
        for (size_t i = 0; i < fracas_surface_unknowns(t); i++) sum.force[i % 3] += force[i];
        sum.area += model->surface->area[e];
    }
    assert_true((model->surface->nborders == 0) == (part == &fracas_part_whole));
    fracas_model_destroy(model);
    return sum;
}

/* 4 pi R^2 + 2 pi R L, and the shadow of an octant along each axis: a quarter of a disk, and of the
 * tube's rectangle. Parabolic edges err by the fourth power of their length. The whole, where every
 * shadow is 0, is 8 octants. */
static void parts_have_their_areas(void **unused)
{
    static const fracas_kind *const part[4] = {&fracas_part_octant, &fracas_part_quarter,
                                               &fracas_part_half, &fracas_part_whole};
    const double disk = M_PI * RADIUS * RADIUS / 4, tube = RADIUS * LENGTH / 2,
                 area = 4 * M_PI * RADIUS * RADIUS + 2 * M_PI * RADIUS * LENGTH,
                 shadow[3] = {disk + tube, disk, disk + tube};
    const int sides[4][3] = {{1, 1, 1}, {2, 0, 2}, {0, 0, 4}, {0, 0, 0}};
    for (int p = 0; p < 4; p++) {
        double error[2] = {0};
        for (int fine = 0; fine < 2; fine++) {
            const pressed sum = pressed_of(part[p], fine ? 8 : 4);
            error[fine] = fabs(sum.area * (8 >> p) / area - 1);
            for (int i = 0; i < 3; i++)
                error[fine] = fmax(error[fine],
                                   fabs(sum.force[i] / (PRESSURE * shadow[i]) - sides[p][i]));
        }
        print_message("capsule, %s: area and shadows within %.1e, %.1e\n", part[p]->name, error[0],
                      error[1]);
        assert_true(error[1] < 1e-4 && error[1] < error[0] / 10);
    }
}

/* Under a pressure the middle of the tube has sigma_theta = p R/h and sigma_z = p R/(2 h):
 * w = p R^2 (1 - nu/2)/(E h), and u_y = p R (1/2 - nu)/(E h) y; the caps' bending has decayed by
 * exp(-1.29 L/(2 sqrt(R h))), 1e-5, and the rest is the mesh. */
static void it_stretches_as_closed_tubes_do(void **unused)
{
    for (int fine = 0; fine < 2; fine++) {
        const fracas_spec spec = capsule_of(&fracas_part_octant, fine ? 8 : 4);
        const double E = spec.material.young, nu = spec.material.poisson,
                     unit = PRESSURE * RADIUS / (E * spec.geometry.thickness);
        OWN(fracas_model) model = distorted_model(spec, 0, 3);
        const fracas_surface_tables *t = model->plan;
        shell_statics *s = statics_open(model);
        OWNED double *f = vector_of(s->n), *u = vector_of(s->n);
        for (size_t i = 0; i < s->n; i++) {
            const size_t size = fracas_surface_unknowns(t), e = i / size;
            f[i] = t->load[(t->load_row[e] - 1) * size + i % size];
        }
        statics_solve(s, f, u);
        double w = 0, moved = 0, at = 0;
        for (size_t i = 0; i < s->n; i++) {
            const double *x = place_of(model, i);
            if (i % 3 == 0 && fabs(x[1]) < 1e-9 && fabs(x[2]) < 1e-9) w = u[i];
            if (i % 3 == 1 && fabs(x[2]) < 1e-9 && x[1] < LENGTH / 6 && x[1] > at) {
                at = x[1];
                moved = u[i];
            }
        }
        assert_close(w, unit * RADIUS * (1 - nu / 2), 1e-3);
        assert_close(moved, unit * (0.5 - nu) * at, 1e-3);
        print_message("capsule: w %+.1e, u_y at %.2f %+.1e\n",
                      w / (unit * RADIUS * (1 - nu / 2)) - 1, at,
                      moved / (unit * (0.5 - nu) * at) - 1);
        statics_close(s);
    }
}

/* Six times the volume of the tetrahedron to the place of the axis beside an element: positive
 * unless inverted. */
static double outward(const fracas_surface *s, size_t e)
{
    double corner[3][3], height = 0, volume = 0;
    for (size_t k = 0; k < 3; k++) {
        memcpy(corner[k], fracas_surface_node(s, e, k), sizeof corner[k]);
        height += corner[k][1] / 3;
    }
    height = fmax(-LENGTH / 2, fmin(height, LENGTH / 2));
    for (size_t k = 0; k < 3; k++) corner[k][1] -= height;
    const double *a = corner[0], *b = corner[1], *c = corner[2];
    for (int i = 0; i < 3; i++)
        volume += a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]);
    return volume;
}

/* Vertices moved by up to 0.25 of an edge stay on it, 1 beside the axis: some roundings. Those on
 * planes of symmetry are in them to the last bit; elements keep their side, and
 * seams are no edges. */
static void moved_nodes_stay_on_it(void **unused)
{
    uint64_t noise = 5;
    for (int planes = 0; planes < 4; planes++)
        for (size_t n = 2; n <= 8; n++) {
            fracas_surface_fineness fineness = {.divisions = n, .order = 2};
            const fracas_surface *s;
            OK(fracas_surface_capsule(RADIUS, LENGTH, planes, &fineness, &s));
            const size_t rows = (size_t)lround(LENGTH / M_PI * (double)n), octants = 8u >> planes;
            assert_int_equal(s->nelements, octants * (2 * n * (rows ? rows : 1) + n * n));
            double(*shift)[2] = zeroed(s->nvertices, sizeof *shift);
            for (size_t v = 0; v < s->nvertices; v++)
                for (int i = 0; i < 2; i++) shift[v][i] = next_share(&noise) < 0.5 ? -1 : 1;
            fineness.amplitude = 0.25;
            fineness.shift = (const double(*)[2])shift;
            fineness.nshifts = s->nvertices;
            fracas_surface_destroy(s);
            OK(fracas_surface_capsule(RADIUS, LENGTH, planes, &fineness, &s));
            for (size_t k = 0; k < s->nnodes; k++) {
                const double *x = s->node[k], y = fmax(0, fabs(x[1]) - LENGTH / 2);
                assert_true(fabs(sqrt(x[0] * x[0] + y * y + x[2] * x[2]) - RADIUS) < 2e-15);
            }
            for (size_t b = 0; b < s->nborders; b++)
                for (size_t k = 0; k < 3; k++) {
                    const fracas_surface_border *of = &s->border[b];
                    const size_t corner[3] = {of->edge, (of->edge + 1) % 3, 3 + of->edge};
                    const double *x = fracas_surface_node(s, of->element, corner[k]);
                    assert_true(x[of->tag == 1 ? 0 : of->tag == 2 ? 2 : 1] == 0);
                }
            for (size_t e = 0; e < s->nelements; e++) assert_true(outward(s, e) > 0);
            for (size_t i = 0; i < s->ninterfaces; i++) assert_int_equal(s->interface[i].tag, 0);
            fracas_surface_destroy(s);
            fineness.amplitude = 0.3;
            FAILS(fracas_surface_capsule(RADIUS, LENGTH, planes, &fineness, &s), FRACAS_USAGE,
                  "is 0.3", "at most 0.25");
            free(shift);
        }
}

/* A pressed octant, free but for its symmetry: kinetic + elastic energy - work stays, to rounding
 * of 300 steps. */
static void its_ledger_holds(void **unused)
{
    fracas_spec spec = capsule_of(&fracas_part_octant, 4);
    spec.cohesive.fracture_energy = 1e12;
    spec.time.end = 1e3;
    one_run run = begin_run(distorted_model(spec, 0.2, 5), 1, 1e6);
    for (int s = 0; s < 300; s++) step_run(&run);
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    print_message("capsule: residual %.1e of the work\n", ledger->largest_residual / ledger->work);
    assert_true(ledger->work > 0 && ledger->largest_residual < 1e-12 * ledger->work);
    clear_run(&run);
}

TESTS(parts_have_their_areas, it_stretches_as_closed_tubes_do, moved_nodes_stay_on_it,
      its_ledger_holds)
