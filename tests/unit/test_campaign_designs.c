/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Designs in campaign files: the points are what the sampler's room gives, as choices of an axis;
 * how they grow. Common random numbers. */
#include "campaigns/plan/point_model.h"
#include "sampler/design/design.h"
#include "sampler/design/uncertain.h"
#include "tests/support/kinds.h"
#include "tests/support/campaign_text.h"

#include "base/units.h"

#define YOUNG                                                                                    \
    "        material.young: {distribution: normal, mean: 370 GPa, deviation: 10 GPa, minimum: " \
    "365 GPa}\n"
#define ENERGY \
    "        cohesive.fracture_energy: {distribution: weibull, scale: 50 J/m2, shape: 10}\n"
#define RATE \
    "        loading.rate: {distribution: log-uniform, minimum: 1e3 1/s, maximum: 1e5 1/s}\n"
#define ELEMENTS "        mesh.elements: {distribution: uniform, minimum: 50.5, maximum: 950.5}\n"
#define TIED                                                                                  \
    "      correlation: [{between: [cohesive.fracture_energy, material.young], coefficient: " \
    "0.5}]\n"

/* The plain campaign with a design of `type` (which may name the points too) and these parameters.
 */
static fracas_campaign *read_design(const char *type, const char *parameters)
{
    char sweep[1200];
    snprintf(sweep, sizeof sweep, "sweep:\n  - design:\n      type: %s\n      parameters:\n%s",
             type, parameters);
    return read_replaced("", sweep);
}

static uint64_t name_of(const char *path)
{
    const fracas_hash hash = fracas_hash_of(path, strlen(path));
    uint64_t word[2];
    fracas_hash_words(&hash, word);
    return word[0];
}

/* Parameters are named by the first half of their paths' hash, seed 7 is the campaign's; units,
 * rounding, whole numbers. */
static void test_points(void **state)
{
    static const char *const types[] = {"latin-hypercube\n      points: 9",
                                        "sobol\n      points: 9", "random\n      points: 9"};
    const double tied[16] = {1, 0.5, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const uint64_t name[4] = {name_of("material.young"), name_of("cohesive.fracture_energy"),
                              name_of("loading.rate"), name_of("mesh.elements")};
    const fracas_uncertain young = UNCERTAIN("normal", .mean = 370e9, .deviation = 10e9,
                                             .minimum = 365e9, .maximum = NAN);
    const fracas_uncertain energy = UNCERTAIN("weibull", .minimum = 0, .scale = 50, .shape = 10);
    const fracas_uncertain rate = UNCERTAIN("log-uniform", .minimum = 1e3, .maximum = 1e5);
    const fracas_uncertain elements = UNCERTAIN("uniform", .minimum = 50.5, .maximum = 950.5);
    for (size_t t = 0; t < FRACAS_COUNT(types); t++) {
        OWN(fracas_campaign) campaign = read_design(types[t], YOUNG ENERGY RATE ELEMENTS TIED);
        const fracas_design design = {fracas_design_types[t], 7, 9, 4, name, tied};
        fracas_probability p[36];
        OK(fracas_design_fill(&design, p));
        assert_int_equal(campaign->npoints, 9);
        for (size_t i = 0; i < 9; i++) {
            const fracas_spec *spec = &campaign->point[i].spec;
            assert_true(spec->material.young ==
                        fracas_number_round(fracas_uncertain_quantile(&young, p[4 * i])));
            assert_true(spec->cohesive.fracture_energy ==
                        fracas_number_round(fracas_uncertain_quantile(&energy, p[4 * i + 1])));
            assert_true(spec->loading.rate ==
                        fracas_number_round(fracas_uncertain_quantile(&rate, p[4 * i + 2])));
            assert_int_equal(spec->mesh.elements,
                             lround(fracas_uncertain_quantile(&elements, p[4 * i + 3])));
            assert_true(spec->material.young >= 365e9 && spec->material.density == 2750);
        }
    }
}

static void test_shipped(void **state)
{
    OWN(fracas_campaign) campaign;
    OK(fracas_campaign_read(FRACAS_SOURCE_DIR "/campaigns/examples/bar-uncertain.yaml", &campaign));
    assert_int_equal(campaign->npoints, 64);
    assert_true(campaign->common_random_numbers);
    size_t varied = 0;
    for (size_t c = 0; c < campaign->table.ncolumns; c++)
        varied += fracas_point_table_varies(&campaign->table, c);
    assert_int_equal(varied, 5);
}

/* Two designs and a list: the last axis runs fastest, and each design is as it is alone. */
static void test_product(void **state)
{
    OWN(fracas_campaign) young = read_design("sobol\n      points: 3", YOUNG),
                         *rate = read_design("random\n      points: 2", RATE);
    OWN(fracas_campaign) both = read_design(
        "sobol\n      points: 3",
        YOUNG "  - design:\n      type: random\n      points: 2\n      parameters:\n" RATE
              "  - mesh.elements: [10, 20]\n");
    assert_int_equal(both->npoints, 12);
    for (size_t p = 0; p < 12; p++) {
        assert_true(both->point[p].spec.material.young == young->point[p / 4].spec.material.young);
        assert_true(both->point[p].spec.loading.rate == rate->point[p / 2 % 2].spec.loading.rate);
        assert_int_equal(both->point[p].spec.mesh.elements, p % 2 ? 20 : 10);
    }
}

/* A design in which two distributions of strength share a key: the drawn value is for the kind that
 * the point has. */
static void test_drawn_with_kind(void **state)
{
    OWN(fracas_campaign) campaign = read_design(
        "random\n      points: 3",
        "        strength.shape: {distribution: uniform, minimum: 5, maximum: 9}\n"
        "  - strength: [{distribution: weibull, scale: 300 MPa}, {distribution: gamma, scale: 30 "
        "MPa}]\n");
    assert_int_equal(campaign->npoints, 6);
    for (size_t p = 0; p < 6; p++)
        assert_true(campaign->point[p].strength.shape >= 5 &&
                    campaign->point[p].strength.shape <= 9);
}

static void test_extension(void **state)
{
    static const struct {
        const char *before, *after, *words[3]; /* no words: it extends */
    } table[] = {
        {"random\n      points: 8", "random\n      points: 20", {NULL}},
        {"sobol\n      points: 8", "sobol\n      points: 20", {NULL}},
        {"latin-hypercube\n      points: 8", "latin-hypercube\n      points: 8", {NULL}},
        {"latin-hypercube\n      points: 8",
         "latin-hypercube\n      points: 16",
         {"material.young is 3", "Pa in the study (its point 0), but 3",
          "can be extended by points and replicas"}},
        {"sobol\n      points: 8",
         "sobol\n      points: 4",
         {"has 8 points, and this campaign file only 4", "point 4; a study keeps"}},
        {"sobol\n      points: 8",
         "random\n      points: 8",
         {"material.young is 3", "in the study (its point 0)"}},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        OWN(fracas_campaign) before = read_design(table[i].before, YOUNG),
                             *now = read_design(table[i].after, YOUNG);
        check_extends(now, before, table[i].words);
    }
}

/* The same points written as cases have the same hashes, so that their random numbers are the same.
 */
static void test_hashes(void **state)
{
    char sweep[1200];
    OWN(fracas_campaign) drawn = read_design("latin-hypercube\n      points: 4", YOUNG ELEMENTS);
    int used = snprintf(sweep, sizeof sweep, "sweep:\n  - cases:\n");
    for (size_t p = 0; p < 4; p++) {
        const fracas_spec *spec = &drawn->point[p].spec;
        used += snprintf(sweep + used, sizeof sweep - (size_t)used,
                         "    - {material.young: %.15g, mesh.elements: %d}\n", spec->material.young,
                         (int)spec->mesh.elements);
    }
    OWN(fracas_campaign) written = read_replaced("", sweep);
    assert_true(fracas_hash_equal(&drawn->hash, &written->hash));
    for (size_t p = 0; p < 4; p++)
        assert_true(fracas_hash_equal(&drawn->point[p].hash, &written->point[p].hash));
}

/* ---- random_numbers ---- */

static bool same_stream(const fracas_campaign *campaign, size_t p, size_t q, uint64_t purpose)
{
    const fracas_stream a = fracas_point_stream(campaign, p, purpose, 3),
                        b = fracas_point_stream(campaign, q, purpose, 3);
    return fracas_stream_uniform(&a, 5) == fracas_stream_uniform(&b, 5);
}

/* `common` changes the campaign's hash and no point's, and the numbers; `independent` is the
 * default. */
static void test_common_random_numbers(void **state)
{
    OWN(fracas_campaign) plain = read_replaced("", "sweep:\n  - loading.rate: [1e3, 2e3]\n");
    OWN(fracas_campaign) said = read_replaced(
        "", "random_numbers: independent\nsweep:\n  - loading.rate: [1e3, 2e3]\n");
    OWN(fracas_campaign) common = read_replaced(
        "", "random_numbers: common\nsweep:\n  - loading.rate: [1e3, 2e3]\n");
    assert_false(plain->common_random_numbers || said->common_random_numbers);
    assert_true(common->common_random_numbers);
    assert_true(fracas_hash_equal(&plain->hash, &said->hash));
    assert_false(fracas_hash_equal(&plain->hash, &common->hash));
    for (uint64_t purpose = FRACAS_PURPOSE_STRENGTH; purpose <= FRACAS_PURPOSE_MESH; purpose++) {
        assert_false(same_stream(plain, 0, 1, purpose));
        assert_true(same_stream(common, 0, 1, purpose));
    }
    for (size_t p = 0; p < 2; p++)
        assert_true(fracas_hash_equal(&plain->point[p].hash, &common->point[p].hash));
    double noise[2][10];
    for (size_t p = 0; p < 2; p++) fracas_point_mesh_noise(common, p, 10, noise[p]);
    assert_memory_equal(noise[0], noise[1], sizeof noise[0]);
    for (size_t p = 0; p < 2; p++) fracas_point_mesh_noise(plain, p, 10, noise[p]);
    assert_memory_not_equal(noise[0], noise[1], sizeof noise[0]);
}

/* By xxhsum -H2 of what docs/formats/campaign-file.md says, not by this program. */
static void test_common_hash(void **state)
{
    OWN(fracas_campaign) common = read_replaced("", "random_numbers: common\n");
    assert_string_equal(fracas_hash_hex(&common->hash).text, "8c97a0072a795eaa347bdfaa7186fcc7");
}

TESTS(test_points, test_shipped, test_product, test_drawn_with_kind, test_extension, test_hashes,
      test_common_random_numbers, test_common_hash)
