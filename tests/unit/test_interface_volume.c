/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The volume of the body that an interface stands for: by closed form, and all of them together are
 * the body. */
#include "tests/support/bar.h"

#include "engine/mesh/make.h"
#include "tests/support/surface_measures.h"

static double mean_of(const fracas_spec *spec)
{
    double volume, area;
    OK(fracas_mesh_interface_extent(spec, &volume, &area));
    return volume;
}

/* Rounding: three products and a quotient, 2^-53 each; 2 pi is a double within 2^-53. */
static void assert_near(double got, double expected)
{
    if (!(fabs(got - expected) <= 6e-16 * expected))
        fail_msg("%.17g m3, expected %.17g m3", got, expected);
}

static void mean_volume_of_each_shape(void **unused)
{
    fracas_spec spec = bar_reference(250, 1e4, 1e-6); /* 50 mm, 1 mm2 */
    assert_near(mean_of(&spec), 2e-10);
    spec.geometry.radius = 1.0; /* means nothing for a bar */
    assert_near(mean_of(&spec), 2e-10);
    spec.geometry = (fracas_geometry){.shape = &fracas_shape_ring, .radius = 0.025, .area = 4e-6};
    assert_near(mean_of(&spec), 4e-6 * 2.0 * acos(-1.0) * 0.025 / 250.0);
}

/* A periodic bar has as many interfaces as elements; each sum rounds by 2^-53. */
static void interfaces_share_the_body(void **unused)
{
    for (int64_t elements = 2; elements < 2000; elements *= 3) {
        fracas_spec spec = bar_reference(elements, 1e4, 1e-6);
        OWN(fracas_model) model;
        OK(fracas_model_create(&spec, &model));
        const size_t n = fracas_model_interfaces(model);
        double sum = 0.0;
        for (size_t i = 0; i < n; i++) sum += fracas_model_interface_volume(model, i);
        assert_true(fabs(sum - 5e-8) <= 5e-8 * 0x1p-53 * (double)(n + 5));
        assert_near(mean_of(&spec), fracas_model_interface_volume(model, n / 2));
    }
}

/* The same on elements of different lengths, each interface with half of both its elements. A held
 * bar has none at its ends, and lacks half of its first and of its last element. */
static void interfaces_share_the_body_on_any_mesh(void **unused)
{
    double noise[301];
    for (int i = 0; i < 4; i++) {
        fracas_spec spec = bar_reference(300, 1e4, 1e-6);
        if (i % 2) bar_perturb(&spec, 0.45, 1, noise);
        else bar_grade(&spec, 100);
        if (i / 2) spec.geometry.ends = &fracas_ends_held;
        OWN(fracas_model) model;
        OK(fracas_model_create(&spec, &model));
        const size_t n = fracas_model_interfaces(model);
        const double *h = model->sizes;
        double sum = 0.0, body = i / 2 ? 5e-8 - 0.5e-6 * (h[0] + h[299]) : 5e-8;
        assert_int_equal(n, i / 2 ? 299 : 300);
        for (size_t k = 0; k < n; k++) {
            sum += fracas_model_interface_volume(model, k);
            assert_near(fracas_model_interface_volume(model, k),
                        0.5e-6 * (h[k] + h[(k + 1) % 300]));
        }
        assert_true(fabs(h[0] / h[150] - 1) > 0.01); /* they are different */
        /* a rounding for each length, as much again for their sum, and one for each volume */
        assert_true(fabs(sum - body) <= 5e-8 * 0x1p-53 * (3 * 300 + 5));
    }
}

/* Squares cut in two: every interface has a third of a square. */
static void plates_by_closed_form(void **unused)
{
    fracas_spec spec = {.geometry = {.shape = &fracas_shape_plate,
                                     .width = 3e-3,
                                     .height = 2e-3,
                                     .thickness = 1e-4},
                        .mesh = {.spacing = &fracas_spacing_triangles, .divisions = 8}};
    for (spec.mesh.order = 1; spec.mesh.order <= 2;
         spec.mesh.order++) /* 8 x 12 squares, each area and their sum of 800 rounded */
        assert_true(fabs(mean_of(&spec) / (6e-10 / (3 * 96)) - 1) < 800 * 0x1p-53);
}

/* Each element's area counts a third for each of its edges that is an interface: all of them is the
 * body but for a third of each element at a boundary edge. */
static void surfaces_lack_what_is_at_edges(void **unused)
{
    fracas_spec spec = {.geometry = {.shape = &fracas_shape_annulus,
                                     .inner = 1e-3,
                                     .outer = 3e-3,
                                     .thickness = 1e-4},
                        .mesh = {.spacing = &fracas_spacing_triangles, .divisions = 6}};
    for (spec.mesh.order = 1; spec.mesh.order <= 2; spec.mesh.order++) {
        const fracas_surface *s;
        fracas_surface_measures all;
        OK(fracas_mesh_make(&spec, &s));
        fracas_surface_measure(s, &all);
        double area = all.area;
        for (size_t b = 0; b < s->nborders; b++) area -= s->area[s->border[b].element] / 3;
        /* sums of some 1000 positive terms, each rounded */
        assert_true(fabs(mean_of(&spec) * (double)s->ninterfaces / (1e-4 * area) - 1) <
                    4000 * 0x1p-53);
        fracas_surface_destroy(s);
    }
}

TESTS(mean_volume_of_each_shape, interfaces_share_the_body, interfaces_share_the_body_on_any_mesh,
      plates_by_closed_form, surfaces_lack_what_is_at_edges)
