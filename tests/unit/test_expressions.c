/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a campaign file that follow from other keys. */
#include "tests/support/campaign_text.h"

#include "campaigns/file/expression.h"

#include <math.h>

static fracas_err look_up(void *context, const char *path, size_t length,
                          fracas_magnitude *magnitude)
{
    static const fracas_magnitude length_of_bar = {0.05, {{1, 0, 0, 0}}},
                                  stiffness = {275e9, {{-1, 1, -2, 0}}};
    (void)context;
    if (!strncmp(path, "geometry.length", length)) *magnitude = length_of_bar;
    else if (!strncmp(path, "material.young", length)) *magnitude = stiffness;
    else return fracas_fail(FRACAS_USAGE, "no such key");
    return FRACAS_OK;
}

/* Exact values; powers of m, kg, s. */
static void values(void **unused)
{
    static const struct {
        const char *text;
        double value, power[3];
    } good[] = {
        {"1 + 2 * 3 - 4 / 8", 6.5, {0}},
        {"2 - 3 - 4", -5, {0}},
        {"-2^2 * (1 + 1)", -8, {0}},
        {"8 / 4 / 2", 1, {0}},
        {"geometry.length", 0.05, {1}},
        {"ceil(geometry.length / 20 um)", 2500, {0}}, /* 2500 + 4.5e-13 in doubles */
        {"floor(geometry.length/0.05 m)", 1, {0}},
        {"round(-2.5)", -2, {0}},
        {"max(1 mm, geometry.length, 2 mm)", 0.05, {1}},
        {"min(geometry.length,1 m)", 0.05, {1}},
        {"sqrt(4 m2)", 2, {1}},
        {"sqrt(material.young / 11 kg * 1 m)", 158113.8830084189666, {0, 0, -1}},
        {"abs(-3 kHz)", 3000, {0, 0, -1}},
        {"2 * pi", 6.283185307179586, {0}},
        {"1e4 1/s * geometry.length", 500, {1, 0, -1}},
        {"10 N/m", 10, {0, 1, -2}},
        {"2mm", 0.002, {1}},
        {"1 \xc2\xb5s + 1 \xce\xbcs", 2e-6, {0, 0, 1}},
        {"3 rad/s", 3, {0, 0, -1}},
    };
    OWN(fracas_units) units;
    assert_int_equal(fracas_units_create(&units), 0);
    for (size_t i = 0; i < FRACAS_COUNT(good); i++) {
        fracas_magnitude made;
        OK(fracas_expression_evaluate(units, good[i].text, look_up, NULL, &made));
        /* units and quotients are rounded once each */
        if (!(fabs(made.value - good[i].value) <= 1e-15 * fabs(good[i].value)))
            fail_msg("%s is %.17g", good[i].text, made.value);
        for (int k = 0; k < 3; k++) assert_true(made.dimension.power[k] == good[i].power[k]);
    }
}

static void faults(void **unused)
{
    static const struct {
        const char *text, *says;
    } bad[] = {
        {"", "expected a number, a key or a function at its end"},
        {"1 +", "at its end"},
        {"(1", "expected `)`"},
        {"1 2", "expected an operator where `2` stands"},
        {"1 )", "where `)` stands"},
        {"1 / (2 - 2)", "divides by 0"},
        {"1 m + 1 s", "different dimensions"},
        {"max(1 m, 1)", "different dimensions"},
        {"min(1, 2", "expected `,` or `)`"},
        {"ceil(1 m)", "takes a pure number"},
        {"2 ^ 0.5", "exponents are whole numbers"},
        {"2 ^ 10", "exponents are whole numbers"},
        {"1 foo", "`foo` is no unit, key or function"},
        {"length / 2", "`length` is no unit, key or function"},
        {"1 A", "`A` is no unit"},
        {"geometry.foo", "no such key"},
        {"3 geometry.length", "expected an operator"},
        {"1e300 * 1e300", "no finite number"},
        {"sqrt(-1)", "no finite number"},
        {"sin(1)", "`sin` is no unit, key or function"},
    };
    OWN(fracas_units) units;
    assert_int_equal(fracas_units_create(&units), 0);
    for (size_t i = 0; i < FRACAS_COUNT(bad); i++) {
        fracas_magnitude made;
        assert_int_equal(fracas_expression_evaluate(units, bad[i].text, look_up, NULL, &made),
                         FRACAS_USAGE);
        if (!strstr(fracas_message(), bad[i].says))
            fail_msg("%s: %s", bad[i].text, fracas_message());
    }
}

#define CAMPAIGN(elements, rate, more)                                                      \
    "name: e\nseed: 1\nmodel: ring\ngeometry: {radius: 8 mm, area: 1 mm2}\n"                \
    "mesh: {elements: \"" elements "\"}\nmaterial: {young: 275 GPa, density: 2750 kg/m3}\n" \
    "cohesive: {law: nitsche, fracture_energy: 100 J/m2}\n"                                 \
    "strength: {distribution: weibull, scale: 300 MPa, shape: 10}\n"                        \
    "loading: {type: initial-velocity, radial: \"" rate                                     \
    "\"}\ntime: {end: 2 us}\nreplicas: 1\n" more

/* Each point has its own values, and they are its identity: written out, the hashes are the same.
 */
static void points_have_their_own(void **unused)
{
    OWN(fracas_campaign)
    given = read_text(CAMPAIGN("ceil(2 * pi * geometry.radius / 20 um)",
                               "geometry.radius * 1e4 1/s",
                               "sweep:\n  - geometry.radius: [8 mm, 4 mm]\n")),
    *plain = read_text(CAMPAIGN("7", "7",
                                "sweep:\n  - zip:\n      geometry.radius: [8 mm, 4 mm]\n      "
                                "mesh.elements: [2514, 1257]\n      loading.radial: [80, 40]\n"));
    assert_int_equal(given->npoints, 2);
    for (size_t p = 0; p < 2; p++)
        assert_true(fracas_hash_equal(&given->point[p].hash, &plain->point[p].hash));
    /* in a sweep, and of what another section has by default */
    OWN(fracas_campaign)
    swept = read_text(
        CAMPAIGN("200", "80", "sweep:\n  - time.end: [\"1 us / time.safety\", 3 us]\n"));
    assert_true(swept->point[0].spec.time.end ==
                    fracas_number_round(1e-6 / swept->point[0].spec.time.safety) &&
                swept->point[1].spec.time.end == 3e-6);
}

/* The campaign is refused at this place, with these words. */
static void refuse(const char *text, const char *place, const char *says)
{
    char path[40];
    fracas_campaign *campaign = NULL;
    make_path(path);
    write_bytes(path, text, strlen(text));
    const fracas_err err = fracas_campaign_read(path, &campaign);
    unlink(path);
    const char *words[] = {place, says};
    test_fails(text, err, FRACAS_USAGE, words, 2);
}

static void places(void **unused)
{
    refuse(CAMPAIGN("geometry.radius / 3 um", "80", ""), "5:18: `elements`", "no whole number");
    refuse(CAMPAIGN("ceil(geometry.length)", "80", ""), "5:18", "does not belong to this point");
    refuse(CAMPAIGN("mesh.elements * 2", "80", ""), "5:18", "break the circle");
    refuse(CAMPAIGN("ceil(loading.radial * 1 s/m)", "mesh.elements * 1 m/s", ""), "5:18",
           "break the circle");
    refuse(CAMPAIGN("200", "geometry.radius", ""), "9:43: `radial`", "is not a velocity");
    refuse(CAMPAIGN("200", "geometry.gap * 1 1/s", ""), "9:43", "does not belong to this point");
    refuse(CAMPAIGN("ceil(output.history)", "80", ""), "5:18", "no number of a point");
    refuse(CAMPAIGN("ceil(-geometry.radius / 1 m)", "80", ""), "5:18", "out of range");
    refuse(CAMPAIGN("200", "80",
                    "sweep:\n  - loading.radial: {from: \"geometry.radius * 1 1/s\", to: 90, "
                    "points: 2}\n"),
           "13:28", "cannot stand here");
}

TESTS(values, faults, points_have_their_own, places)
