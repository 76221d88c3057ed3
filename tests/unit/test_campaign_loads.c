/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files with several loads and with initial states: values, hashes, bounds, warnings. */
#include "tests/support/campaign_text.h"
#include "tests/support/loads.h"

#include "campaigns/plan/forecast.h"
#include "engine/loading/loading.h"

static fracas_campaign *read_membrane(const char *find, const char *put)
{
    OWNED char *plain = campaign_file("membrane"), *text = replace(plain, find, put);
    return read_text(text);
}

/* ---- several loads ---- */

static bool same_hash(const fracas_campaign *a, const fracas_campaign *b)
{
    return fracas_hash_equal(&a->hash, &b->hash) &&
           fracas_hash_equal(&a->point[0].hash, &b->point[0].hash);
}

/* A list of one is that one; items have places of their own, and their order is the campaign's. */
static void test_list_of_loads(void **state)
{
    static const char loading[] = "loading: {rate: 1e4 1/s}\n";
    OWN(fracas_campaign) plain = read_membrane("", ""),
                         *one = read_membrane(loading, "loading: [{rate: 1e4 1/s}]\n"),
                         *empty = read_membrane(loading, "loading: [{rate: 1e4 1/s}, {}]\n"),
                         *all = read_membrane(
                             loading, "loading:\n  - {rate: 1e4 1/s}\n  - {type: traction, edge: "
                                      "right, normal: 1 MPa}\n  - {type: body-force, x: 2 m/s2}\n"),
                         *turned = read_membrane(
                             loading, "loading:\n  - {rate: 1e4 1/s}\n  - {type: body-force, x: 2 "
                                      "m/s2}\n  - {type: traction, edge: right, normal: 1 MPa}\n");
    assert_true(same_hash(plain, one) && same_hash(plain, empty));
    assert_false(same_hash(plain, all) || same_hash(all, turned));
    const fracas_spec *spec = &all->point[0].spec;
    assert_true(spec->loading.rate == 1e4 && load_value(&spec->also[0], "normal") == 1e6 &&
                load_value(&spec->also[1], "x") == 2);
    assert_ptr_equal(spec->also[0].type, &fracas_loading_traction);
    assert_ptr_equal(spec->also[1].type, &fracas_loading_body_force);
    assert_null(plain->point[0].spec.also[0].type);
    for (size_t c = 0; c < plain->table.ncolumns; c++) /* a study without them has no new column */
        assert_null(strstr(plain->table.column[c].path, "loading_"));
    check_round_trip(all);
    check_round_trip(turned);
}

/* Sweeps of items, of their kinds, and of one that only some points have. */
static void test_swept_loads(void **state)
{
    OWN(fracas_campaign) campaign = read_membrane(
        "loading: {rate: 1e4 1/s}\n",
        "loading:\n  - {type: body-force, y: 1 m/s2}\n  - {type: traction, edge: top, normal: 1 "
        "MPa}\nsweep:\n  - loading.y: [1 m/s2, 2 m/s2]\n  - cases:\n      - {name: two, "
        "loading_2.normal: 2 MPa}\n      - {name: three, loading_3.type: body-force, loading_3.x: "
        "4 "
        "m/s2}\n      - {name: other, loading_2: {type: body-force, x: 3 m/s2}}\n");
    assert_int_equal(campaign->npoints, 6);
    for (size_t p = 0; p < 6; p++) {
        const fracas_spec *spec = &campaign->point[p].spec;
        const fracas_loading *second = &spec->also[0], *third = &spec->also[1];
        assert_true(load_value(&spec->loading, "y") == (p < 3 ? 1 : 2));
        if (p % 3 == 2) assert_true(load_value(second, "x") == 3);
        else assert_true(load_value(second, "normal") == (p % 3 == 0 ? 2e6 : 1e6));
        assert_true(p % 3 == 1 ? load_value(third, "x") == 4 : third->type == NULL);
    }
    check_round_trip(campaign);
}

/* plan's bound of the stress is that of all loads, of starts and of notches: a false one says that
 * nothing breaks. */
static void test_bounds_of_lists(void **state)
{
    static const struct {
        const char *find, *put;
        bool known; /* a bound below 10 MPa, that of rate 10 in 0.1 us, and of 3 MPa at the start */
    } of[] = {
        {"rate: 1e4 1/s", "rate: 10 1/s", true},
        {"{rate: 1e4 1/s}", "[{rate: 10 1/s}, {type: traction, edge: left, normal: 5 GPa}]", false},
        {"{rate: 1e4 1/s}", "{type: none}\ninitial: {stress_x: 3 MPa}", true},
        {"{rate: 1e4 1/s}", "{type: none}\ninitial: {velocity_x: 3 m/s, from_x: 0}", false},
        {"{rate: 1e4 1/s}",
         "{type: none}\ninitial: {stress_x: 3 MPa}\nnotch: {from_y: -1 mm, to_y: 1 mm}", false},
    };
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        OWN(fracas_campaign) campaign = read_membrane(of[i].find, of[i].put);
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        print_message("%s: bound %g Pa\n", of[i].put, forecast.bound);
        assert_true((forecast.bound < 10e6) == of[i].known);
    }
}

/* Both faces of a crack in a strained body run away at c eps from the start. */
static void test_opening_of_a_start(void **state)
{
    OWN(fracas_campaign) campaign = read_membrane("{rate: 1e4 1/s}",
                                                  "{type: none}\ninitial: {stress_x: 3 MPa}");
    fracas_forecast forecast;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    const double opens = 2 * 3e6 / 370e9 * sqrt(370e9 / 3900) * 0.1e-6;
    assert_true(forecast.available > opens && forecast.available < 2 * opens);
}

/* True if a warning of plan on the campaign's point has these words. */
static bool warns_with(const fracas_campaign *campaign, const char *words)
{
    char text[FRACAS_WARNING_TEXT];
    fracas_forecast forecast;
    bool told = false;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    for (size_t w = 0; w < FRACAS_PLAN_WARNINGS; w++)
        told = told ||
               (fracas_plan_warnings[w](&campaign->point[0], &forecast, text, sizeof text) > 0 &&
                strstr(text, words));
    return told;
}

/* Starts above the strengths, 308 MPa in the mean, are told, and no others: under pressure the
 * shear at 45 degrees counts, half of it. */
static void test_starts_above_strengths(void **state)
{
    static const char *const stress[] = {"300 MPa", "320 MPa", "-400 MPa", "-700 MPa"};
    for (size_t i = 0; i < FRACAS_COUNT(stress); i++) {
        char put[100];
        snprintf(put, sizeof put, "{type: none}\ninitial: {stress_x: %s}", stress[i]);
        OWN(fracas_campaign) campaign = read_membrane("{rate: 1e4 1/s}", put);
        assert_true(warns_with(campaign, "interfaces crack at once") == (i % 2 == 1));
    }
}

/* The membrane at rest but for its start, with edges that geometry gives. */
static fracas_campaign *read_start(const char *edges, const char *start)
{
    char put[300];
    OWNED char *plain = campaign_file("membrane"),
               *still = replace(plain, "{rate: 1e4 1/s}", "{type: none}");
    snprintf(put, sizeof put, "thickness: 0.1 mm%s}", edges);
    OWNED char *held = replace(still, "thickness: 0.1 mm}", put);
    snprintf(put, sizeof put, "%s\n", start);
    OWNED char *text = replace(held, "", put);
    return read_text(text);
}

/* The plate is 10 mm by 5 mm: left and right have a third of its outline. What edges hold, or loads
 * balance, stays; what lies on others springs back. */
static void test_starts_that_spring_back(void **state)
{
    static const struct {
        const char *edges, *start, *told; /* "": no warning */
    } of[] = {
        {"", "initial: {stress_x: 20 MPa}", "no edge keeps 100 % of its"},
        {", left: fixed", "initial: {stress_x: 20 MPa}", "no edge keeps 50 % of its"},
        {", bottom: fixed, top: fixed", "initial: {stress_x: 20 MPa}",
         "no edge keeps 100 % of its"},
        {", left: fixed, right: fixed", "initial: {stress_x: 20 MPa}", ""},
        {", left: sliding, right: sliding", "initial: {stress_x: 20 MPa}", ""},
        {", left: sliding, right: fixed", "initial: {stress_xy: 20 MPa}",
         "no edge keeps 83 % of its"},
        {", left: fixed, right: fixed", "initial: {stress_x: 20 MPa, stress_y: 20 MPa}",
         "no edge keeps 67 % of its"},
        {", left: fixed, right: fixed, top: fixed, bottom: fixed",
         "initial: {temperature: -60 K, expansion_coefficient: 8e-6 1/K}", ""},
    };
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        OWN(fracas_campaign) campaign = read_start(of[i].edges, of[i].start);
        print_message("geometry %s, %s\n", of[i].edges, of[i].start);
        assert_true(warns_with(campaign, "springs back") == (*of[i].told != 0));
        assert_true(warns_with(campaign, of[i].told) || !*of[i].told);
    }
    OWN(fracas_campaign) drawn = read_membrane(
        "thickness: 0.1 mm}", "thickness: 0.1 mm, left: fixed}\ninitial: {stress_x: 20 MPa}");
    assert_true(warns_with(drawn, "springs back"));
    OWN(fracas_campaign) loaded = read_membrane(
        "loading: {rate: 1e4 1/s}", "initial: {stress_x: 20 MPa}\nloading: [{type: traction, edge: "
                                    "left, normal: 20 MPa}, {type: traction, edge: right, normal: "
                                    "20 MPa}]");
    assert_false(warns_with(loaded, "springs back"));
}

/* Strains of 20 % and more, and velocities above waves, at sqrt(E/rho) = 9740 m/s, or above 0.4
 * times that at the rim of a region, which strains by v/(2 c). */
static void test_starts_too_large(void **state)
{
    static const struct {
        const char *start;
        const char *told; /* "": no warning */
    } of[] = {
        {"initial: {strain_x: 0.19}", ""},
        {"initial: {strain_x: -0.25}", "a strain of 25 %"},
        {"initial: {strain_x: 0.15, strain_y: -0.15, strain_xy: 0.2}", "a strain of 25 %"},
        {"initial: {velocity_x: 9 km/s}", ""},
        {"initial: {velocity_x: 11.688 km/s}", "starts at up to 1.17e+04 m/s"},
        {"initial: {velocity_x: 3.8 km/s, from_x: 0 mm}", ""},
        {"initial: {velocity_x: 4 km/s, from_x: 0 mm}", "starts at up to 4e+03 m/s"},
        {"initial: {spin: 4e6 1/s}", "starts at up to 2.24e+04 m/s"}, /* hypot(5, 2.5) mm */
    };
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        OWN(fracas_campaign) campaign = read_start("", of[i].start);
        print_message("%s\n", of[i].start);
        assert_true(warns_with(campaign, "takes strains as small") == (*of[i].told != 0));
        assert_true(warns_with(campaign, of[i].told) || !*of[i].told);
    }
}

/* ---- the start ---- */

/* A section without values is none; values are in the point's name, and in its bytes. */
static void test_initial_section(void **state)
{
    OWN(fracas_campaign) plain = read_membrane("", ""), *empty = read_membrane("", "initial: {}\n"),
                         *pulled = read_membrane("",
                                                 "initial: {stress_x: 3 MPa, velocity_y: 2 m/s, "
                                                 "from_x: 0 m}\nsweep:\n  - "
                                                 "initial.strain_y: [0, 1e-4]\n");
    const fracas_initial *initial = &pulled->point[1].spec.initial;
    assert_true(same_hash(plain, empty) && !same_hash(plain, pulled));
    assert_true(initial->stress[0] == 3e6 && initial->velocity[1] == 2 && initial->from[0] == 0 &&
                initial->strain[1] == 1e-4 && isnan(initial->spin) && isnan(initial->to[0]));
    check_round_trip(pulled);
}

TESTS(test_list_of_loads, test_swept_loads, test_bounds_of_lists, test_opening_of_a_start,
      test_starts_above_strengths, test_starts_that_spring_back, test_starts_too_large,
      test_initial_section)
