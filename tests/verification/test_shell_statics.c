/* Shells at rest under loads: the pinched hemisphere, the Scordelis-Lo roof, plates with exact solutions. Tables of
 * docs/results/shell.md. */
#include "tests/support/shell_statics.h"

/* ---- loads ---- */

/* Force `load` [N] on the nodes at a place, shared equally by the elements that have one there. */
static void load_point(const fracas_model *model, const double at[3], const double load[3], double *f)
{
    size_t found[16], count = 0;
    for (size_t i = 0; i < unknowns_of(model); i += 3) {
        const double *x = place_of(model, i);
        if (hypot(hypot(x[0] - at[0], x[1] - at[1]), x[2] - at[2]) < 1e-9 * (1 + fabs(at[0]) + fabs(at[1]) + fabs(at[2]))) found[count++] = i;
    }
    assert_true(count > 0 && count <= 16);
    for (size_t k = 0; k < count; k++)
        for (size_t i = 0; i < 3; i++) f[found[k] + i] += load[i] / (double)count;
}

/* Mean of a component of the displacements there. */
static double read_point(const fracas_model *model, const double at[3], size_t component, const double *u)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < unknowns_of(model); i += 3) {
        const double *x = place_of(model, i);
        if (hypot(hypot(x[0] - at[0], x[1] - at[1]), x[2] - at[2]) > 1e-9 * (1 + fabs(at[0]) + fabs(at[1]) + fabs(at[2]))) continue;
        sum += u[i + component];
        count++;
    }
    assert_true(count > 0);
    return sum / (double)count;
}

/* Force by area q(x) [Pa] along an axis: int N q dA. */
typedef double shell_pressure(const void *how, const double x[3]);

static void load_area(const fracas_model *model, shell_pressure *q, const void *how, size_t axis, double *f)
{
    for (size_t e = 0; e < model->elements; e++)
        for (int g = 0; g < FRACAS_TRIANGLE_FINE; g++) {
            const double *point = fracas_triangle_fine[g];
            double x[3] = {0};
            fracas_shell_geometry at;
            fracas_shell_geometry_at(model->surface, e, point[0], point[1], &at);
            for (size_t k = 0; k < SHELL_NODES; k++)
                for (int i = 0; i < 3; i++) x[i] += at.shape[k] * node_at(model, e, k)[i];
            for (size_t k = 0; k < SHELL_NODES; k++)
                f[e * SHELL_UNKNOWNS + 3 * k + axis] += point[2] * at.area * at.shape[k] * q(how, x);
        }
}

/* ---- the pinched hemisphere ---- */

static void hemisphere_map(const void *how, double s, double t, double x[3])
{
    const double radius = *(const double *)how, longitude = PI / 2 * s, latitude = PI / 180 * 72 * t;
    x[0] = radius * cos(latitude) * (s < 1 ? cos(longitude) : 0);
    x[1] = radius * cos(latitude) * (s > 0 ? sin(longitude) : 0);
    x[2] = radius * sin(latitude);
}

static double hemisphere(size_t n, double beta, double beta_shear, double distortion)
{
    const double radius = 10, out[3] = {1, 0, 0}, in[3] = {0, -1, 0}, a[3] = {radius, 0, 0}, b[3] = {0, radius, 0};
    fracas_spec spec = shell_spec(&fracas_shape_file);
    spec.geometry.thickness = 0.04;
    spec.geometry.edge[1] = spec.geometry.edge[2] = &fracas_edge_symmetry;
    spec.material = (fracas_material){.young = 6.825e7, .density = 1, .poisson = 0.3};
    spec.cohesive.beta = beta;
    spec.cohesive.beta_shear = beta_shear;
    fracas_model *model = grid_model(&spec, &(shell_grid){.nx = n, .ny = n, .map = hemisphere_map, .how = &radius, .distortion = distortion, .seed = 3});
    shell_statics *s = statics_open_pinned(model, 3 * 3 + 2); /* along z nothing holds or moves it */
    double *f = vector_of(s->n), *u = vector_of(s->n);
    load_point(model, a, out, f);
    load_point(model, b, in, f);
    statics_solve(s, f, u);
    const double first = read_point(model, a, 0, u), second = -read_point(model, b, 1, u);
    (void)second;
    free(f);
    free(u);
    statics_close(s);
    fracas_model_destroy(model);
    return first;
}

static void roof_quarter(const void *how, double s, double t, double x[3])
{
    const double *size = how, angle = s * size[2];
    x[0] = s > 0 ? size[0] * sin(angle) : 0;
    x[1] = t * 0.5 * size[1];
    x[2] = size[0] * cos(angle);
}

static double uniform(const void *how, const double x[3])
{
    (void)x;
    return *(const double *)how;
}

static double roof(size_t n, double beta, double beta_shear, double distortion)
{
    const double size[3] = {25, 50, 40 * PI / 180}, load = -90, at[3] = {25 * sin(size[2]), 0, 25 * cos(size[2])};
    fracas_spec spec = shell_spec(&fracas_shape_file);
    spec.geometry.thickness = 0.25;
    spec.geometry.edge[1] = spec.geometry.edge[3] = &fracas_edge_symmetry;
    spec.geometry.edge[4] = &fracas_edge_diaphragm;
    spec.material = (fracas_material){.young = 4.32e8, .density = 1, .poisson = 0};
    spec.cohesive.beta = beta;
    spec.cohesive.beta_shear = beta_shear;
    fracas_model *model = grid_model(&spec, &(shell_grid){.nx = n, .ny = n, .map = roof_quarter, .how = size, .distortion = distortion, .seed = 3});
    shell_statics *s = statics_open(model);
    double *f = vector_of(s->n), *u = vector_of(s->n);
    load_area(model, uniform, &load, 2, f);
    statics_solve(s, f, u);
    const double down = -read_point(model, at, 2, u);
    free(f);
    free(u);
    statics_close(s);
    fracas_model_destroy(model);
    return down;
}

static void explore(void **unused)
{
    (void)unused;
    const double shear[] = {1e-4, 1e-2, 1, 10};
    for (int what = 0; what < 2; what++)
        for (double beta = 5; beta < 11; beta += 5)
            for (int k = 0; k < 4; k++) {
                print_message("%s beta %g shear %g:", what ? "roof" : "hemisphere", beta, shear[k]);
                for (size_t n = 4; n <= 32; n *= 2) print_message(" %zu: %.5f", n, what ? roof(n, beta, shear[k], 0) : hemisphere(n, beta, shear[k], 0));
                print_message("\n");
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(explore)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
