/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files whose strengths are given by mean and deviation, or for a specimen of some size.
 */
#include "tests/support/campaign_text.h"
#include "tests/support/strengths.h"

#include "campaigns/plan/point_model.h"

static const char uniform[] = "  distribution: uniform\n  minimum: 299 MPa\n  maximum: 301 MPa\n";

static size_t column(const fracas_campaign *campaign, const char *path)
{
    return fracas_point_table_find(&campaign->table, path);
}

/* What is not given has no column, and so no trace in a hash; what is given has. */
static void test_what_is_given_counts(void **state)
{
    OWN(fracas_campaign) plain = read_text(plain_campaign);
    OWN(fracas_campaign) moments = read_replaced(
        uniform, "  distribution: uniform\n  mean: 300 MPa\n  deviation: 0.5 MPa\n");
    assert_int_equal(column(plain, "strength.mean"), SIZE_MAX);
    assert_int_equal(column(plain, "strength.reference_volume"), SIZE_MAX);
    assert_int_equal(column(moments, "strength.minimum"), SIZE_MAX);
    assert_true(real(moments, 0, "strength.mean") == 300e6 &&
                real(moments, 0, "strength.deviation") == 0.5e6);
    assert_true(fabs(real(moments, 0, "derived.strength_mean") - 300e6) < 1e-6);
    assert_false(fracas_hash_equal(&plain->point[0].hash, &moments->point[0].hash));
}

/* Laws of one mean and deviation: each draws with its own, and a parameter of a sweep is put in the
 * place of the section's. */
static void test_sweeps_of_moments(void **state)
{
    fracas_campaign *campaign = read_replaced(
        "", "sweep:\n  - strength: [{distribution: weibull, mean: 300 MPa, deviation: 30 MPa}, "
            "{distribution: gamma, mean: 300 MPa, deviation: 30 MPa}, {distribution: lognormal, "
            "mean: 300 MPa, deviation: 30 MPa}, {distribution: normal, kept_mean: 300 MPa, "
            "kept_deviation: 30 MPa}]\n");
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_strength *strength = &campaign->point[p].strength;
        assert_true(fabs(real(campaign, p, "derived.strength_mean") - 300e6) < 1e-3);
        assert_true(fabs(fracas_strength_deviation(strength, (fracas_extent){1, 1}) - 30e6) < 1e-3);
    }
    assert_int_equal(campaign->npoints, 4);
    fracas_campaign_destroy(campaign);
    OWNED char *text = replace(plain_campaign, uniform,
                               "  distribution: weibull\n  mean: 300 MPa\n  deviation: 30 MPa\n");
    OWNED char *whole = replace(text, "", "sweep:\n  - strength.deviation: [10 MPa, 20 MPa]\n");
    campaign = read_text(whole);
    assert_int_equal(campaign->npoints, 2);
    assert_true(campaign->point[0].strength.deviation == 10e6 &&
                campaign->point[1].strength.deviation == 20e6);
    fracas_campaign_destroy(campaign);
}

/* The field that a run draws from: interfaces of 0.05 m x 1 mm2 / 100 have the strengths of a
 * specimen of 1 mm3 times (1/0.5)^(1/m). 1e-13: two powers. */
static void test_field_has_the_size_effect(void **state)
{
    static const char sweep[] =
        "sweep:\n  - strength: [{distribution: weibull, scale: 300 MPa, shape: 8}, {distribution: "
        "weibull, scale: 300 MPa, shape: 8, reference_volume: 1 mm3}]\n";
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    const double expected = pow(2.0, 1.0 / 8.0);
    assert_true(fabs(real(campaign, 1, "derived.strength_mean") /
                         real(campaign, 0, "derived.strength_mean") / expected -
                     1) < 1e-13);
    double drawn[2][100];
    for (size_t p = 0; p < 2; p++) {
        OWN(fracas_model) model;
        OWN(fracas_field) field;
        const fracas_stream stream = {.seed = 5, .purpose = FRACAS_PURPOSE_STRENGTH};
        OK(fracas_model_create(&campaign->point[p].spec, &model));
        OK(fracas_model_field(model, &campaign->point[p].strength, &field));
        assert_int_equal(fracas_field_size(field), 100);
        OK(fracas_field_sample(field, &stream, 1, drawn[p]));
    }
    for (int i = 0; i < 100; i++)
        assert_true(fabs(drawn[1][i] / drawn[0][i] / expected - 1) < 1e-13);
}

TESTS(test_what_is_given_counts, test_sweeps_of_moments, test_field_has_the_size_effect)
