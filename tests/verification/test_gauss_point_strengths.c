/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths at the Gauss points of a surface's interfaces: where they are, and that equal ones are
 * as one. What unequal ones do: test_membrane_cracks, test_shell_cracks; that lanes and axes do not
 * matter: tests/invariant. */
#include "tests/support/distorted_model.h"
#include "tests/support/lanes.h"

#include "engine/integrator/integrator.h"
#include "tests/support/test.h"

/* A body that breaks: E 320 GPa, nu 0.3, rho 3300, G_c 200 J/m2; a plate of 6 mm x 5 mm, an annulus
 * of 2 to 4 mm, a sphere of 1.5 mm. */
static fracas_spec body_of(const fracas_formulation *formulation, const fracas_kind *shape,
                           int64_t order, int64_t divisions)
{
    fracas_spec spec = surface_spec(formulation, shape);
    spec.geometry.width = 6e-3;
    spec.geometry.height = 5e-3;
    spec.geometry.inner = 2e-3;
    spec.geometry.outer = 4e-3;
    spec.geometry.radius = 1.5e-3;
    spec.geometry.thickness = 3e-4;
    spec.mesh.divisions = divisions;
    spec.mesh.order = order;
    spec.loading.rate = 2e4;
    spec.time.end = 5e-7;
    return spec;
}

static void run(const fracas_model *model, int width, fracas_isa isa, fracas_record *record)
{
    const fracas_stream stream = {.seed = 6, .purpose = FRACAS_PURPOSE_STRENGTH};
    OWN(fracas_batch) batch = batch_with(
        model, (size_t)width,
        (fracas_batch_options){.history = 20, .interfaces = true, .width = width, .isa = isa});
    for (size_t l = 0; l < (size_t)width; l++) {
        for (size_t k = 0; k < strengths_of(model); k++)
            bar_set_strength(batch, l, k,
                             300e6 * (1 + 0.3 * fracas_stream_uniform(
                                                    &stream, k / model->strengths + 100000 * l)));
        fracas_record_init(&record[l]);
    }
    OK(fracas_batch_run(batch, record));
}

static void equal_strengths_are_as_one(void **unused)
{
    const fracas_spec body[] = {body_of(&fracas_formulation_membrane, &fracas_shape_plate, 1, 6),
                                body_of(&fracas_formulation_membrane, &fracas_shape_annulus, 2, 4),
                                body_of(&fracas_formulation_shell, &fracas_shape_sphere, 2, 1)};
    for (size_t b = 0; b < sizeof body / sizeof *body; b++)
        for (int width = 1; width <= 8; width += 7) {
            fracas_record record[2][8];
            for (int per_point = 0; per_point < 2; per_point++) {
                fracas_spec spec = body[b];
                spec.strength_per_point = per_point;
                OWN(fracas_model) model = distorted_model(spec, 0.1, 3);
                assert_int_equal(fracas_model_strengths_per_interface(model),
                                 per_point ? spec.mesh.order + 1 : 1);
                run(model, width, width == 1 ? FRACAS_ISA_BASELINE : FRACAS_ISA_BEST,
                    record[per_point]);
            }
            for (int l = 0; l < width; l++) {
                assert_true(record[0][l].fragments > 5);
                assert_same_record(&record[0][l], &record[1][l]);
                for (int k = 0; k < 2; k++) fracas_record_clear(&record[k][l]);
            }
        }
}

static void every_one_is_checked(void **unused)
{
    fracas_spec spec = body_of(&fracas_formulation_membrane, &fracas_shape_plate, 1, 2);
    spec.strength_per_point = true;
    OWN(fracas_model) model = distorted_model(spec, 0, 0);
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    OK(fracas_batch_begin(batch));
    bar_set_strength(batch, 0, strengths_of(model) - 1, 0);
    assert_int_equal(fracas_batch_begin(batch), FRACAS_USAGE);
    char words[60];
    snprintf(words, sizeof words, "interface %zu: strength of 0 Pa", model->interfaces - 1);
    assert_non_null(strstr(fracas_message(), words));
}

static void chains_have_one(void **unused)
{
    fracas_spec spec = bar_reference(10, 1e4, 1e-6);
    spec.strength_per_point = true;
    OWN(fracas_model) model = make_model(&spec);
    assert_int_equal(fracas_model_strengths_per_interface(model), 1);
}

/* The point at s from the first end of an edge, by Lagrange's polynomials through its nodes. */
static void on_edge(const fracas_surface *surface, const fracas_surface_interface *interface,
                    int side, double s, double x[3])
{
    const uint32_t *node = surface->element + interface->element[side] * surface->corners;
    const int edge = interface->edge[side];
    const double *a = surface->node[node[edge]], *b = surface->node[node[(edge + 1) % 3]];
    for (int i = 0; i < 3; i++) {
        x[i] = (1 - s) * a[i] + s * b[i];
        if (surface->order == 2)
            x[i] += 4 * s * (1 - s) * (surface->node[node[3 + edge]][i] - 0.5 * (a[i] + b[i]));
    }
}

/* Gauss's points, from both sides of an edge. Coordinates are up to 6 mm, sums of three terms:
 * 1e-17 m is ten times their rounding. */
static void positions_are_those_of_gauss(void **unused)
{
    const fracas_spec body[] = {body_of(&fracas_formulation_membrane, &fracas_shape_plate, 1, 4),
                                body_of(&fracas_formulation_membrane, &fracas_shape_annulus, 2, 4),
                                body_of(&fracas_formulation_shell, &fracas_shape_sphere, 2, 1)};
    for (size_t b = 0; b < sizeof body / sizeof *body; b++) {
        fracas_spec spec = body[b];
        spec.strength_per_point = true;
        OWN(fracas_model) model = distorted_model(spec, 0.1, 3);
        const size_t points = model->strengths;
        double(*position)[3] = taken(strengths_of(model) * sizeof *position), worst = 0;
        fracas_model_interface_positions(model, position);
        for (size_t k = 0; k < strengths_of(model); k++)
            for (int side = 0; side < 2; side++) {
                const double off = ((double)(k % points) - 0.5 * (double)(points - 1)) *
                                   (points == 2 ? sqrt(1.0 / 3) : sqrt(0.15));
                double x[3];
                on_edge(model->surface, &model->surface->interface[k / points], side,
                        side ? 0.5 - off : 0.5 + off, x);
                for (int i = 0; i < 3; i++) worst = fmax(worst, fabs(position[k][i] - x[i]));
            }
        assert_true(worst < 1e-17);
        free(position);
    }
}

TESTS(equal_strengths_are_as_one, every_one_is_checked, chains_have_one,
      positions_are_those_of_gauss)
