/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plan: what is printed, and that it is what the engine says. */
#include "tests/support/strengths.h"
#include "campaigns/plan/forecast.h"
#include "campaigns/plan/plan.h"
#include "campaigns/store/file/schema.h"
#include "engine/engine.h"
#include "tests/support/campaign_text.h"

#include <time.h>

static const char sweep[] =
    "sweep:\n  - loading.rate: [1e3, 1e4]\n  - strength.maximum: [300 MPa, 301 MPa]\n";

static void expect(const char *text, const char *part)
{
    assert_has(text, part);
}

static void test_cost(void **state)
{
    OWN(fracas_campaign) campaign = read_text(plain_campaign);
    OWN(fracas_model) model;
    double cost = 0;
    OK(fracas_model_create(&campaign->point[0].spec, &model));
    OK(fracas_plan_cost(campaign, 0, &cost, NULL));
    assert_true(cost == 100.0 * (double)fracas_model_steps(model)); /* whole numbers: exact */
    assert_true(fracas_model_steps(model) > 1);
}

/* Rows end at the same column, as every cell is right-aligned. */
static void test_text(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    OWNED char *text = plan_text(campaign, 2, false);
    expect(text, "Campaign test: 4 points, 12 realizations\n");
    expect(text, "for 2 processes");
    const char *head = strstr(
        text, "point  loading.rate  strength.maximum  replicas  elements  time step");
    if (!head) fail_msg("no head in:\n%s", text);
    size_t length = strcspn(head, "\n");
    for (int row = 0; row < 7; row++, head += length + 1) { /* head, units, four points, total */
        if (strcspn(head, "\n") != length)
            fail_msg("row %d is not as long as the head:\n%s", row, text);
        if (row == 1) assert_memory_equal(head, "                1/s                Pa", 37);
        if (row == 6) assert_memory_equal(head, "total", 5);
    }
}

static void test_json(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    OWNED char *text = plan_text(campaign, 2, true);
    expect(text, "\"points\": 4,");
    expect(text, "\"realizations\": 12");
    expect(text, "\"loading.rate\": 10000");
    expect(text, "\"elements\": 100");
    /* Intact bodies of one fragment, with 11 rows of history: at 0 and 10 times. */
    expect(text, "\"fragments\": 1,");
    char bytes[64];
    snprintf(bytes, sizeof bytes, "\"bytes\": %.15g",
             3 * (fracas_row_bytes(FRACAS_SET_REALIZATION) + fracas_row_bytes(FRACAS_SET_FRAGMENT) +
                  11 * fracas_row_bytes(FRACAS_SET_HISTORY)));
    expect(text, bytes);
}

/* More than 100 points are summed up, unless all are asked for. */
static void test_summary(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - loading.rate: {from: 1 1/s, to: 101 1/s, points: 101}\n"
            "  - cohesive.law: [nitsche]\n");
    OWNED char *text = plan_text(campaign, 1, false);
    expect(text, "loading.rate      1/s");
    double least = 0, most = 0;
    assert_int_equal(
        sscanf(strstr(text, "loading.rate"), "loading.rate 1/s %lg %lg", &least, &most), 2);
    assert_true(least == 1 && most == 101);
    expect(text, "`--points` lists every point.");
    assert_null(strstr(text, "\n   57 "));
    FILE *out = text_begin();
    OK(fracas_plan_print(campaign, &(fracas_plan_options){.jobs = 1, .points = true}, out));
    OWNED char *all = text_end(out);
    expect(all, "\n   57 ");
    expect(all, "\n  100 ");
    assert_null(strstr(all, "--points"));
}

/* Points that run, but tell little: elements longer than a softening zone, strengths without
 * scatter. */
static void test_warnings(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - mesh.elements: [100, 1000]\n"
            "  - strength: [{distribution: constant, value: 300 MPa}, {distribution: uniform, "
            "minimum: 299 MPa, maximum: 301 MPa}]\n");
    double length = campaign->point[0].spec.geometry.length,
           softening = 275e9 * 100 / (300e6 * 300e6);
    bool coarse = length / 100 / softening > 0.5;
    OWNED char *text = plan_text(campaign, 2, false), *json = plan_text(campaign, 2, true);
    expect(text, "warning: 2 of 4 points (--json lists them), worst 0: all interfaces are equally");
    expect(text, "warning: 2 of 4 points (--json lists them), worst 0: elements are ");
    for (int p = 0; p < 4; p++) {
        char uniform[64], long_elements[64];
        snprintf(uniform, sizeof uniform, "point %d: all interfaces are equally strong", p);
        snprintf(long_elements, sizeof long_elements, "point %d: elements are ", p);
        assert_int_equal(strstr(json, uniform) != NULL, p % 2 == 0);
        assert_int_equal(strstr(json, long_elements) != NULL, p < 2 && coarse);
    }
    assert_true(coarse);
}

static int lines_with(const char *text, const char *part)
{
    int lines = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part)) lines++;
    return lines;
}

/* Bars of longer and longer elements, the last the longest: one line, of that one, however many
 * points there are. */
static void test_a_line_a_kind(void **state)
{
    static const int many[] = {1, 18, 1000};
    for (size_t i = 0; i < FRACAS_COUNT(many); i++) {
        char lengths[160], said[160], last[64];
        snprintf(lengths, sizeof lengths,
                 many[i] == 1
                     ? "sweep:\n  - geometry.length: [0.1 m]\n"
                     : "sweep:\n  - geometry.length: {from: 50 mm, to: 100 mm, points: %d}\n",
                 many[i]);
        OWN(fracas_campaign) campaign = read_replaced("", lengths);
        OWNED char *text = plan_text(campaign, 1, false), *json = plan_text(campaign, 1, true);
        assert_int_equal(campaign->npoints, many[i]);
        /* E G_c/sigma_c^2 = 306 um; the 100 elements are of 1 mm, 3.27 of it */
        if (many[i] == 1)
            snprintf(said, sizeof said, "warning: point 0: elements are 3.27 E G_c/sigma_c^2 long");
        else
            snprintf(said, sizeof said,
                     "warning: %d of %d points (--json lists them), worst %d: elements are 3.27 ",
                     many[i], many[i], many[i] - 1);
        assert_has(text, said);
        assert_int_equal(lines_with(text, "warning: "), 1);
        assert_int_equal(lines_with(json, ": elements are "), many[i]);
        snprintf(last, sizeof last, "\"point %d: elements are 3.27 ", many[i] - 1);
        assert_has(json, last);
    }
}

/* Strengths that scatter make counts depend on the mesh, unless they have a size effect; the volume
 * that the plan names leaves this mesh's strengths as they are. */
static void test_strengths_that_the_mesh_changes(void **state)
{
    static const char words[] = "without a reference size: halving the elements ",
                      moves[] = "moves the count by up to 5 %, of `uniform` mostly up";
    /* e = 1e4/(1e4 285.4e6^3/(275e9^2 100)) = 0.3253: 0.75 0.1203/(1 + 4.5 0.4730) = 2.88 %; of a
     * mean of 300 MPa e = 0.2801: 0.75 0.1/(1 + 4.5 0.4281) = 2.56 % */
    static const struct {
        const char *strength, *lowers; /* NULL: no warning */
    } table[] = {
        {"distribution: weibull, scale: 300 MPa, shape: 10", "lowers the count by about 2.9 %"},
        {"distribution: weibull, scale: 300 MPa, shape: 40", NULL},
        {"distribution: normal, mean: 300 MPa, deviation: 30 MPa",
         "lowers the count by about 2.6 %"},
        {"distribution: lognormal, median: 300 MPa, sigma: 0.1", "lowers the count by about "},
        {"distribution: gamma, mean: 300 MPa, deviation: 30 MPa", "lowers the count by about 2.6"},
        {"distribution: uniform, minimum: 250 MPa, maximum: 350 MPa", moves},
        {"distribution: weibull, minimum: 200 MPa, scale: 100 MPa, shape: 3", moves},
        {"distribution: uniform, minimum: 299 MPa, maximum: 301 MPa", NULL},
        {"distribution: constant, value: 300 MPa", NULL},
        {"distribution: weibull, scale: 300 MPa, shape: 10, reference_area: 1 mm2", NULL},
        {"distribution: weibull, scale: 300 MPa, shape: 10, covariance: exponential, "
         "correlation_length: 1 mm",
         NULL},
        {"distribution: flaws, flaw_density: 1e11 1/m3, minimum: 100 MPa, maximum: 400 MPa, "
         "exponent: 2",
         NULL},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i += CASE_STRIDE) {
        char text[300];
        snprintf(text, sizeof text, "sweep:\n  - strength: [{%s}]\n  - mesh.elements: [3000]\n",
                 table[i].strength);
        OWN(fracas_campaign) campaign = read_replaced("", text);
        OWNED char *plan = plan_text(campaign, 1, false);
        const char *found = strstr(plan, words);
        assert_int_equal(found != NULL, table[i].lowers != NULL);
        if (!found) continue;
        assert_has(plan, table[i].lowers);
        const char *remedy = strstr(plan, "set strength.reference_volume: ");
        double volume = 0;
        assert_true(remedy &&
                    sscanf(remedy, "set strength.reference_volume: %lf mm3", &volume) == 1);
        fracas_strength with = campaign->point[0].strength;
        with.reference_volume = 1e-9 * volume;
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        const fracas_extent extent = {.volume = forecast.volume};
        for (double u = 0.01; u < 1; u += 0.14) {
            const fracas_probability p = fracas_probability_of(u);
            const double now = fracas_strength_quantile(&campaign->point[0].strength, extent, p);
            /* the volume has six digits */
            assert_true(fabs(fracas_strength_quantile(&with, extent, p) / now - 1) < 1e-6);
        }
    }
}

/* A ring of 10 mm with this load, 1000 elements. `more`: further keys of the case, each after a
 * comma; or "initial", for interfaces that open along initial directions. */
static fracas_campaign *read_ring(const char *loading, const char *more)
{
    char sweep_of_ring[512];
    snprintf(sweep_of_ring, sizeof sweep_of_ring,
             "sweep:\n  - cases:\n      - {name: ring, model: ring, mesh: {elements: 1000}, "
             "loading: {%s}, geometry: {radius: 10 mm, area: 1 mm2%s}%s}\n",
             loading, strstr(more, "initial") ? ", direction: initial" : "",
             strstr(more, "initial") ? "" : more);
    return read_replaced("", sweep_of_ring);
}

static double bound_of(const char *loading)
{
    OWN(fracas_campaign) campaign = read_ring(loading, "");
    fracas_forecast forecast;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    assert_true(campaign->point[0].spec.time.end == 500e-9);
    return forecast.bound;
}

/* The stress that a ring stays below: E 275 GPa, rho 2750 kg/m3, c 10 km/s, R 10 mm, until 0.5 us,
 * half of R/c; each load from its own closed form, none from none. E rate t; E t (v + a t/2)/R; E a
 * t^2/(2 R) of an acceleration, of a spin v^2/R, of a force per length f/(rho A). 1e-12: a few
 * roundings. */
static void test_bound_of_a_rings_stress(void **state)
{
    const double E = 275e9, R = 0.01, t = 500e-9;
    const struct {
        const char *loading;
        double bound;
    } loads[] = {
        {"type: imposed-rate, rate: 1e4", E * 1e4 * t},
        {"type: initial-velocity, radial: 100", E * 1e4 * t},
        {"type: initial-velocity, radial: -100", E * 1e4 * t},
        {"type: initial-velocity, radial: 100, circumferential: 300",
         E * 1e4 * t + E * t * t / 2 * 9e4 / (R * R)},
        {"type: held-velocity, velocity: 100, acceleration: 1e8",
         E * t * (100 + 0.5 * 1e8 * t) / R},
        {"type: held-velocity, direction: circumferential, velocity: 300",
         E * t * t / 2 * 9e4 / (R * R)},
        {"type: force, force: 1e6", E * t * t / 2 * 1e6 / (2750e-6 * R)},
        {"type: force, force: 0, force_rate: 2e12", E * t * t / 2 * 1e6 / (2750e-6 * R)},
        {"type: force, direction: circumferential, force: 1e6",
         E * t * t / 2 * pow(1e6 * t / 2750e-6, 2) / (R * R)},
        {"type: force, force: 0", 0},
    };
    for (size_t i = 0; i < sizeof loads / sizeof *loads; i++)
        if (!(fabs(bound_of(loads[i].loading) - loads[i].bound) <= 1e-12 * loads[i].bound))
            fail_msg("%s: %.15g, not %.15g", loads[i].loading, bound_of(loads[i].loading),
                     loads[i].bound);
}

/* What a plan says of a ring before it is run. R/c is 1 us: the ring turns at 1.57 us and is
 * compressed from 3.14 us on; it cracks above 300 MPa, that is radial 10.9 m/s. Half of it are 31.4
 * mm. */
static void test_warnings_of_rings(void **state)
{
    static const char *const says[] = {"swings back: raise its velocity",
                                       "raise its velocity or time.end",
                                       "load it harder, or longer",
                                       "the whole ring comes under compression",
                                       "cohesive.zone is longer than half",
                                       "are strength, material and loading in",
                                       "the ring turns by",
                                       "waves go at",
                                       "is reached in 1 time step of",
                                       "faster than waves go in it, 1e+04 m/s",
                                       "load it harder; a longer run does not help"};
    const struct {
        const char *loading, *more;
        unsigned expected; /* bit i: says[i] */
    } rings[] = {
        {"type: initial-velocity, radial: 12 m/s", ", time: {end: 5 us}", 0},
        {"type: initial-velocity, radial: 10 m/s", ", time: {end: 1.5 us}", 2},
        {"type: initial-velocity, radial: 10 m/s", ", time: {end: 3 us}", 1},
        {"type: initial-velocity, radial: 10 m/s", ", time: {end: 3.2 us}", 1 | 8},
        {"type: initial-velocity, radial: -100 m/s", "", 8},
        {"type: held-velocity, velocity: 1 m/s", "", 4},
        {"type: force, force: -1e9", "", 8},
        {"type: force, force: 1e9", "", 0},
        /* a = f/(rho A) = 3.64e6 m/s2: E a t^2/(2 R) = 12.5 MPa, and 2 R rho a = 200 MPa at most,
           from 2 us on */
        {"type: force, force: 1e4", "", 4},
        {"type: force, force: 1e4", ", time: {end: 5 us}", 1024},
        {"type: initial-velocity, radial: 1000 m/s", ", cohesive: {law: stershic, zone: 31 mm}", 0},
        {"type: initial-velocity, radial: 1000 m/s", ", cohesive: {law: stershic, zone: 32 mm}",
         16},
        /* 275 GPa 1e5/s dt, dt = 62.8 um/(10 km/s) 0.25/f, f of a few units: 10 to 40 MPa */
        {"type: initial-velocity, radial: 1000 m/s",
         ", strength: {distribution: uniform, minimum: 299, maximum: 301}", 32},
        {"type: initial-velocity, radial: 1000 m/s",
         ", strength: {distribution: uniform, minimum: 45 MPa, maximum: 50 MPa}", 0},
        {"type: initial-velocity, radial: 1000 m/s", ", material: {young: 275 GPa, density: 2.7}",
         128}, /* 319 km/s */
        {"type: initial-velocity, radial: 1000 m/s", ", material: {young: 60 GPa, density: 100}",
         0}, /* 24.5 km/s */
        {"type: initial-velocity, radial: 1000 m/s", ", material: {young: 65 GPa, density: 100}",
         128}, /* 25.5 km/s */
        {"type: initial-velocity, radial: 1000 m/s", ", material: {young: 275 GPa, density: 1e12}",
         32 | 128 | 256},
        {"type: initial-velocity, radial: 9.9 km/s", "", 0},
        {"type: initial-velocity, radial: 10.1 km/s", "", 512},
        /* turned until 0.5 us by V t/R, V t/R + a t^2/2R, f t^2/(2 rho A R) + f' t^3/(6 rho A R):
           0.0075 or 0.0125 */
        {"type: initial-velocity, radial: 1000 m/s, circumferential: 150 m/s", "initial", 0},
        {"type: initial-velocity, radial: 1000 m/s, circumferential: -250 m/s", "initial", 64},
        {"type: initial-velocity, radial: 1000 m/s, circumferential: 250 m/s", "", 0},
        {"type: held-velocity, direction: circumferential, velocity: 50, acceleration: 4e8",
         "initial", 4},
        {"type: held-velocity, direction: circumferential, velocity: 50, acceleration: 8e8",
         "initial", 4 | 64},
        {"type: force, direction: circumferential, force: 1e6, force_rate: 2e12", "initial", 4},
        {"type: force, direction: circumferential, force: 1.65e6, force_rate: 8e12", "initial",
         4 | 64},
    };
    for (size_t i = 0; i < sizeof rings / sizeof *rings; i += CASE_STRIDE) {
        OWN(fracas_campaign) campaign = read_ring(rings[i].loading, rings[i].more);
        OWNED char *text = plan_text(campaign, 2, false);
        for (unsigned w = 0; w < sizeof says / sizeof *says; w++)
            if ((strstr(text, says[w]) != NULL) != (rings[i].expected >> w & 1))
                fail_msg("ring %zu, \"%s\":\n%s", i, says[w], text);
    }
}

/* A heavy tail is refused for the strongest interface it will draw, not for its mean. */
static void test_heavy_tail(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - strength: [{distribution: weibull, scale: 30 MPa, shape: 0.5}]\n");
    OWN(fracas_model) model;
    OK(fracas_model_create(&campaign->point[0].spec, &model));
    const fracas_point *point = &campaign->point[0];
    double mean = mean_of_strength(&point->strength, fracas_model_interface_volume(model, 0));
    OK(fracas_model_check_strength(model, mean));
    double cost;
    FAILS(fracas_plan_cost(campaign, 0, &cost, NULL), FRACAS_USAGE, "point 0: the strongest of ",
          "raise mesh.elements above");
}

/* Flaws are rarest in the smallest interface: on a graded mesh it is that one, here the last, whose
 * strength counts. In 3.5 mm3 are 350 flaws, in 3.5e-3 mm3 a third of one; the longest elements
 * bear 255 MPa. */
static void test_flaws_of_small_elements(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - cases:\n"
            "      - {name: small, mesh: {spacing: graded, ratio: 0.001}, strength: {distribution: "
            "flaws, flaw_density: 1e11 1/m3, minimum: 100 MPa, maximum: 400 MPa, exponent: 2}}\n");
    const fracas_point *point = &campaign->point[0];
    OWN(fracas_model) model;
    OK(fracas_model_create(&point->spec, &model));
    double first = quantile_of(&point->strength, fracas_model_interface_volume(model, 0), 1 - 1e-6);
    OK(fracas_model_check_strength(model, first));
    double cost;
    FAILS(fracas_plan_cost(campaign, 0, &cost, NULL), FRACAS_USAGE, "point 0: the strongest of ");
}

/* What the engine refuses is refused here, with the point. */
static void test_refused(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - cohesive.fracture_energy: [100, 1e-9]\n");
    FILE *out = fopen("/dev/null", "w");
    assert_non_null(out);
    FAILS(fracas_plan_print(campaign, &(fracas_plan_options){.jobs = 1}, out), FRACAS_USAGE,
          "point 1: ");
    fclose(out);
}

static fracas_campaign *refined_ring(const char *refinement)
{
    char text[1024];
    snprintf(
        text, sizeof text,
        "name: refined\nseed: 1\nmodel: ring\ngeometry: {radius: 1 mm}\nmesh: {elements: 200}\n"
        "material: {young: 275 GPa, density: 2750 kg/m3}\n"
        "cohesive: {law: stershic, fracture_energy: 100 J/m2, refinement: %s}\n"
        "strength: {distribution: uniform, minimum: 290 MPa, maximum: 310 MPa}\n"
        "loading: {rate: 100 1/s}\ntime: {end: 15 us, safety: 0.5}\nreplicas: 1\n",
        refinement);
    return read_text(text);
}

/* However short steps may become, a plan is soon made. This ring's stress takes 0.55 us from 0.95
 * to all of its strength, 3.5 million steps of 1.57 ns 1e-4, ten seconds or more; what is timed of
 * it takes a tenth of a second (a second with sanitizers). */
static void test_refined(void **state)
{
    OWN(fracas_campaign) campaign = refined_ring("1e-4");
    const clock_t before = clock(); /* of the processor */
    OWNED char *text = plan_text(campaign, 2, false);
    assert_true((double)(clock() - before) < 5.0 * CLOCKS_PER_SEC);
    OWN(fracas_model) model;
    OK(fracas_model_create(&campaign->point[0].spec, &model));
    const double base = 15e-6 / fracas_model_time_step(model);
    assert_true(fabs((double)fracas_model_steps(model) - 1e8 * base) <= 1.0); /* rounded up */
}

/* More steps than can be taken, or counted, are refused. */
static void test_refined_too_far(void **state)
{
    static const char *const refinements[] = {"5e-5", "1e-10", "1e-60",
                                              "1e-100"}; /* 9.5e3/25e-10 = 3.8e12, ... */
    for (size_t r = 0; r < FRACAS_COUNT(refinements); r++) {
        OWN(fracas_campaign) campaign = refined_ring(refinements[r]);
        fracas_model *model = NULL;
        assert_int_equal(fracas_model_create(&campaign->point[0].spec, &model), FRACAS_USAGE);
        assert_null(model);
        expect(fracas_message(), "1e+12 are allowed: raise cohesive.refinement");
    }
}

static void test_write_fails(void **state)
{
    OWN(fracas_campaign) campaign = read_text(plain_campaign);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    FAILS(fracas_plan_print(campaign, &(fracas_plan_options){.jobs = 1, .json = true}, full),
          FRACAS_ENVIRONMENT, "No space left");
    fclose(full);
}

/* Grady's fragments of 100 J/m2 at 1e5 /s are (2400/(3900 1e10))^(1/3) = 395 um, which waves cross
 * in 40.5 ns. After the onset at 300 MPa/(370 GPa 1e5 /s) = 8.1 ns, 1 us is k = 24.5, 0.8 us 19.5.
 */
static void plan_of_long_runs(void **state)
{
    static const struct {
        const char *model, *law, *time;
        bool said;
    } table[] = {{"membrane", "nitsche", "safety: 0.5, end: 1e-6", true},
                 {"membrane", "nitsche", "safety: 0.25, end: 1e-6", false},
                 {"membrane", "nitsche", "safety: 0.5, end: 0.8e-6", false},
                 {"membrane", "camacho-ortiz", "safety: 0.5, end: 1e-6", false},
                 {"shell", "nitsche", "safety: 0.5, end: 1e-6", false},
                 {"shell", "nitsche", "safety: 0.6, end: 1e-6", true}};
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[700];
        snprintf(
            text, sizeof text,
            "name: t\nseed: 7\nmodel: %s\ngeometry: {shape: plate, width: 1 mm, height: 1 mm, "
            "thickness: 0.1 mm}\nmesh: {divisions: 4}\nmaterial: {young: 370e9, poisson: 0.25, "
            "density: 3900}\ncohesive: {law: %s, fracture_energy: 100}\nstrength: "
            "{distribution: constant, value: 300e6}\nloading: {rate: 1e5}\ntime: {%s}\n"
            "replicas: 1\n",
            table[i].model, table[i].law, table[i].time);
        OWN(fracas_campaign) campaign = read_text(text);
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        const double end = campaign->point[0].spec.time.end;
        assert_true(fabs(forecast.transits / ((end - 3e8 / 370e9 / 1e5) * sqrt(370e9 / 3900) /
                                              cbrt(2400 / (3900 * 1e10))) -
                         1) < 1e-12);
        OWNED char *plan = plan_text(campaign, 1, false);
        assert_int_equal(strstr(plan, "crosses a fragment some 24 times") != NULL, table[i].said);
    }
}

/* A bar is one part; 128 triangles are two blocks of 64. */
static void plan_of_parts(void **state)
{
    static const char bar[] = "model: bar\ngeometry: {length: 10 mm}\nmesh: {elements: 800}",
                      plate[] = "model: membrane\ngeometry: {shape: plate, width: 1 mm, height: "
                                "1 mm, thickness: 0.1 mm}\nmesh: {divisions: 8}";
    static const struct {
        const char *body;
        int parts;
        const char *said;
    } table[] = {{bar, 1, NULL},
                 {bar, 2, "a body of 800 elements is computed in 1 part at most, and"},
                 {plate, 2, NULL},
                 {plate, 3, "a body of 128 elements is computed in 2 parts at most, and"}};
    (void)state;
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[700];
        snprintf(text, sizeof text,
                 "name: t\nseed: 7\n%s\nmaterial: {young: 370e9, density: 3900%s}\ncohesive: "
                 "{fracture_energy: 100}\nstrength: {minimum: 264e6, scale: 50e6, shape: 2}\n"
                 "loading: {rate: 1e5}\ntime: {end: 1e-7}\nreplicas: 1\nparallel: {parts: %d}\n",
                 table[i].body, table[i].body == plate ? ", poisson: 0.2" : "", table[i].parts);
        OWN(fracas_campaign) campaign = read_text(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        if (table[i].said) assert_has(plan, table[i].said);
        else assert_null(strstr(plan, "parallel.parts is"));
    }
}

/* The warning comes above 2 kJ/m2, of whichever key sets the fracture energy: with nitsche's line
 * G_c = strength delta_c/2, 300 MPa 20 um/2 = 3 kJ/m2. */
static void plan_of_a_metal(void **state)
{
    static const struct {
        const char *energy, *said;
    } table[] = {{"fracture_energy: 2 kJ/m2", NULL},
                 {"fracture_energy: 2.1 kJ/m2", "a fracture energy of 2.1 kJ/m2 is a metal's"},
                 {"critical_opening: 13 um", NULL},
                 {"critical_opening: 20 um", "is cohesive.critical_opening in the unit meant?"}};
    (void)state;
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[600];
        snprintf(
            text, sizeof text,
            "name: t\nseed: 7\nmodel: membrane\ngeometry: {shape: plate, width: 50 mm, height: "
            "50 mm, thickness: 1 mm}\nmesh: {divisions: 4}\nmaterial: {young: 70e9, density: "
            "2700, poisson: 0.3}\ncohesive: {%s}\nstrength: {distribution: uniform, minimum: "
            "299e6, maximum: 301e6}\nloading: {rate: 1e3}\ntime: {end: 1e-5}\nreplicas: 1\n",
            table[i].energy);
        OWN(fracas_campaign) campaign = read_text(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        if (table[i].said) assert_has(plan, table[i].said);
        else assert_null(strstr(plan, "a metal's"));
    }
}

/* A notch between two ends in one place breaks nothing, and no one may take it for a cut. */
static void plan_of_a_notch(void **state)
{
    static const struct {
        const char *notch;
        bool said;
    } table[] = {{"from_x: 5 mm, to_x: 5 mm", true},
                 {"from_x: 4.9 mm, to_x: 5.1 mm", false},
                 {"to_x: 0", true},
                 {"", false}};
    (void)state;
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[600];
        snprintf(text, sizeof text,
                 "name: t\nseed: 7\nmodel: bar\ngeometry: {ends: free, length: 20 mm}\nmesh: "
                 "{elements: 100}\nmaterial: {young: 70e9, density: 2700}\ncohesive: "
                 "{fracture_energy: 100}\nstrength: {distribution: uniform, minimum: 290e6, "
                 "maximum: 310e6}\nnotch: {%s}\nloading: {rate: 1e4}\ntime: {end: 1e-6}\n"
                 "replicas: 1\n",
                 table[i].notch);
        OWN(fracas_campaign) campaign = read_text(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        assert_true((strstr(plan, "both ends of the notch") != NULL) == table[i].said);
    }
}

TESTS(test_cost, test_text, test_json, test_summary, test_warnings, test_a_line_a_kind,
      test_strengths_that_the_mesh_changes, test_heavy_tail, test_flaws_of_small_elements,
      test_bound_of_a_rings_stress, test_warnings_of_rings, test_refused, test_refined,
      test_refined_too_far, test_write_fails, plan_of_long_runs, plan_of_parts, plan_of_a_metal,
      plan_of_a_notch)
