/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Frequencies of thin plates, strips and tubes by the shell's operator, masses lumped.
 */
#include "tests/support/shell_statics.h"
#include "tests/support/test.h"

static double wave(const fracas_spec *spec) /* sqrt(D/(rho h)) */
{
    const double h = spec->geometry.thickness, nu = spec->material.poisson;
    return sqrt(spec->material.young * h * h / (12 * (1 - nu * nu) * spec->material.density));
}

typedef struct {
    const char *name;
    double size[2], thickness, poisson, exact[3]; /* omega by sqrt(D/(rho h)) */
    const fracas_kind *edge[2];                   /* at the ends of x; along x */
    size_t count, ny[3], nx[3];
    double within, beta_shear, rotary;
} vibration;

static void frequencies(const vibration *v, size_t level, double beta, double beta_shear,
                        double *error)
{
    fracas_spec spec = shell_spec(&fracas_shape_file);
    spec.geometry.thickness = v->thickness;
    spec.material.poisson = v->poisson;
    spec.cohesive.beta = beta;
    spec.cohesive.beta_shear = beta_shear;
    spec.time.rotary_inertia = v->rotary;
    for (int tag = 1; tag <= PLATE_SIDES; tag++) spec.geometry.edge[tag] = v->edge[tag > 2];
    OWN(fracas_model) model = grid_model(
        &spec,
        &(shell_grid){.nx = v->nx[level], .ny = v->ny[level], .map = flat_map, .how = v->size});
    shell_statics *s = statics_open(model);
    const int more = (int)v->count + 2;
    double *mode = random_start(s, more), omega[5];
    lowest_frequencies(s, (int)v->count, more, mode, omega);
    print_message("%s, %zu x %zu cells, beta %g, beta_shear %g:", v->name, v->nx[level],
                  v->ny[level], beta, beta_shear);
    for (size_t k = 0; k < v->count; k++) {
        error[k] = omega[k] / (v->exact[k] * wave(&spec)) - 1;
        print_message("  %+.3f %%", 100 * error[k]);
    }
    print_message("\n");
    free(mode);
    statics_close(s);
}

/* Frequencies are wrong by the energy of the modes' errors, of order 2 in h: the slope of the last
 * halving is within 0.2 of that, and the finest mesh within 0.5 %, for beta 5 and 10. */
static void check(const vibration *v)
{
    for (int k = 0; k < 2; k++) {
        double error[3][3];
        for (size_t level = k ? 1 : 0; level < 3; level++)
            frequencies(v, level, k ? 10 : 5, v->beta_shear, error[level]);
        for (size_t m = 0; m < v->count; m++) {
            const double slope = log2(fabs(error[1][m] / error[2][m]));
            print_message("  mode %zu: slope %.2f\n", m, slope);
            assert_true(fabs(error[2][m]) < v->within);
            assert_true(fabs(slope - 2) < 0.2);
        }
    }
}

/* pi^2 (m^2/a^2 + n^2/b^2): modes 1 1, 2 1 and 1 2 of a rectangle, which has no two alike. */
static void a_supported_plate(void **unused)
{
    const double a = 1, b = 0.8, p = PI * PI;
    check(&(vibration){.name = "supported plate",
                       .size = {a, b},
                       .thickness = 1e-3,
                       .poisson = 0.3,
                       .exact = {p * (1 / (a * a) + 1 / (b * b)), p * (4 / (a * a) + 1 / (b * b)),
                                 p * (1 / (a * a) + 4 / (b * b))},
                       .edge = {&fracas_edge_fixed, &fracas_edge_fixed},
                       .count = 3,
                       .nx = {8, 16, 32},
                       .ny = {8, 16, 32},
                       .within = 0.005,
                       .beta_shear = 1});
}

/* cos(k L) cosh(k L) = 1: k L = 4.73004, 7.85320. nu = 0 makes the strip a beam. */
static void a_clamped_beam(void **unused)
{
    check(&(vibration){.name = "clamped beam",
                       .size = {10, 1},
                       .thickness = 1e-2,
                       .poisson = 0,
                       .exact = {0.4730041 * 0.4730041, 0.7853205 * 0.7853205},
                       .edge = {&fracas_edge_clamped, &fracas_edge_free},
                       .count = 2,
                       .nx = {10, 20, 40},
                       .ny = {1, 2, 4},
                       .within = 0.005,
                       .beta_shear = 1});
}

/* k^2/sqrt(1 + h^2 k^2/12), k^2 as of the thin plate: 1.1 and 2.3 % less, of a plate a tenth as
 * thick as it is long (Rayleigh's, without shear). */
static void a_thick_plate(void **unused)
{
    const double a = 1, b = 0.8, p = PI * PI, h = 0.1,
                 square[2] = {p * (1 / (a * a) + 1 / (b * b)), p * (4 / (a * a) + 1 / (b * b))};
    vibration v = {.name = "thick supported plate",
                   .size = {a, b},
                   .thickness = h,
                   .poisson = 0.3,
                   .edge = {&fracas_edge_fixed, &fracas_edge_fixed},
                   .count = 2,
                   .nx = {8, 16, 32},
                   .ny = {8, 16, 32},
                   .within = 0.005,
                   .beta_shear = 1e4,
                   .rotary = 1};
    for (int m = 0; m < 2; m++) v.exact[m] = square[m] / sqrt(1 + h * h * square[m] / 12);
    check(&v);
}

/* omega^2 by E/(rho R^2) of the lowest modes of a free tube of radius 1, symmetric in x, y, z. */
static void tube_frequencies(double length, double thickness, int64_t divisions, int count,
                             double *square)
{
    fracas_spec spec = shell_spec(&fracas_shape_cylinder);
    spec.geometry.part = &fracas_part_octant;
    spec.geometry.length = length;
    spec.geometry.thickness = thickness;
    spec.mesh.divisions = divisions;
    OWN(fracas_model) model = distorted_model(spec, 0, 0);
    shell_statics *s = statics_open(model);
    double *mode = random_start(s, count + 2), omega[5];
    lowest_frequencies(s, count, count + 2, mode, omega);
    print_message("tube of length %g, thickness %g, %zu elements:", length, thickness,
                  model->elements);
    for (int k = 0; k < count; k++) {
        square[k] = omega[k] * omega[k] * spec.material.density / spec.material.young;
        print_message("  %.6f", square[k]);
    }
    print_message("\n");
    free(mode);
    statics_close(s);
}

/* Inextensional: n^2 (n^2 - 1)^2/(n^2 + 1) h^2/12 by E' = E of a ring, which bends the other way
 * too, and by E/(1 - nu^2) of a tube much longer than sqrt(R h), which cannot (Rayleigh); the two
 * are 10 % apart. */
static double ovalising(double n, double h)
{
    const double m = n * n - 1;
    return n * n * m * m / (n * n + 1) * h * h / 12;
}

static void a_free_tube_becomes_oval(void **unused)
{
    const double h = 0.02;
    double ring[2], tube[2];
    tube_frequencies(0.05, h, 1, 2, ring);
    tube_frequencies(4, h, 22, 2, tube);
    for (int k = 0; k < 2; k++) {
        const double thin = ovalising(2 + 2 * k, h);
        print_message("n = %d: ring %+.3f %%, tube %+.3f %%\n", 2 + 2 * k,
                      100 * (ring[k] / thin - 1), 100 * (tube[k] * (1 - 0.09) / thin - 1));
        assert_true(fabs(ring[k] / thin - 1) < 0.01);
        assert_true(fabs(tube[k] * (1 - 0.09) / thin - 1) < 0.01);
    }
}

/* A free tube breathes under hoop stress alone, and gets nu w/R shorter by length: with the energy
 * of this (Rayleigh, Love) omega^2 = E/(rho R^2) (1 + h^2/(12 R^2))/(1 + nu^2 L^2/(12 R^2)), as
 * (shell.4) counts w/R^2 as a curvature. So thick a ring has but two modes below, n = 2 and
 * n = 4. */
static void a_free_tube_breathes(void **unused)
{
    double square[2][3];
    for (int k = 0; k < 2; k++) tube_frequencies(0.3, 0.12, 2 << k, 3, square[k]);
    const double exact = (1 + 0.12 * 0.12 / 12) / (1 + 0.09 * 0.3 * 0.3 / 12);
    print_message("breathing: %+.3f %%, %+.3f %%\n", 100 * (square[0][2] / exact - 1),
                  100 * (square[1][2] / exact - 1));
    assert_true(fabs(square[1][2] / exact - 1) < 2e-4);
}

/* A plate turning about an axis in its plane has twice the energy w^2 (rho h int y^2 dA + r rho
 * h^3/12 A), to round-off. A translation has none of the second: R is an energy of gradients. */
static void a_rigid_turn(void **unused)
{
    const double size[2] = {1.2, 1}, turn = 3, share = 0.6;
    fracas_spec spec = shell_spec(&fracas_shape_file);
    spec.time.rotary_inertia = share;
    const shell_grid grid = {.nx = 4, .ny = 3, .map = flat_map, .how = size, .distortion = 0.2};
    OWN(fracas_model) with = grid_model(&spec, &grid);
    spec.time.rotary_inertia = NAN;
    OWN(fracas_model) without = grid_model(&spec, &grid);
    const size_t n = unknowns_of(with);
    OWNED double *v = vector_of(n), *moved = vector_of(n);
    for (size_t i = 2; i < n; i += 3) v[i] = turn * place_of(with, i)[1];
    const double h = spec.geometry.thickness, rho = spec.material.density;
    const double more = mass_product(with, v, v) - mass_product(without, v, v);
    const double expected = share * turn * turn * rho * h * h * h / 12 * size[0] * size[1];
    assert_true(fabs(more / expected - 1) < 1e-10);
    for (size_t i = 0; i < n; i++) moved[i] = (double)(1 + i % 3);
    assert_true(fabs(mass_product(with, moved, v) - mass_product(without, moved, v)) <
                1e-12 * mass_product(with, v, v));
}

TESTS(a_supported_plate, a_clamped_beam, a_thick_plate, a_free_tube_becomes_oval,
      a_free_tube_breathes, a_rigid_turn)
