/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where strengths are: one for each Gauss point, and a factor that depends on the position; from
 * the file to the field. */
#define FOLDER "fracas-test"
#include "tests/support/campaign_folder.h"

#include "campaigns/sample/sample.h"
#include "engine/solver/batch.h"
#include "sampler/field/grading.h"
#include "tests/support/strengths.h"

/* ---- the factor ---- */

/* The factor at one place, by a profile. */
static double factor_of(const char *text, const fracas_kind *along, const double position[3])
{
    const fracas_attachment file = attached("f.csv", text);
    const fracas_strength strength = {.factor = &file, .factor_along = along};
    OWNED double *factor = NULL;
    OK(fracas_grading_create(&strength, 1, (const double(*)[3])position, &factor));
    const double value = factor[0];
    return value;
}

/* Coordinates and factors are such that nothing is rounded. */
static void factors_are_linear_between_lines(void **state)
{
    static const char *const texts[] = {"0,1\n1,2\n1,4\n3,8\n", "0,1,a\n1,2 b\n1,4,c 7\n3.0,8,2\n",
                                        "x,f,n\n0,1,5\n1,2,5\n1,4,6\n3,8,6\n",
                                        "x, factor\r\n# remark\n\n 0 1 first\r\n1\t2\n1 , 4\n3,8",
                                        "\357\273\2770,1\n0.5,1.5\n1,2\n1,4\n2,6\n3,8\n"};
    static const struct {
        double at, factor;
    } table[] = {
        {-5, 1}, {0, 1},      {0.25, 1.25}, {0.5, 1.5},  {0.75, 1.75}, {1 - 0x1p-20, 2 - 0x1p-20},
        {1, 4},  {1.25, 4.5}, {2, 6},       {2.75, 7.5}, {3, 8},       {1e9, 8}};
    for (size_t t = 0; t < FRACAS_COUNT(texts); t++)
        for (size_t i = 0; i < sizeof table / sizeof *table; i++)
            assert_true(factor_of(texts[t], &fracas_along_x, (double[3]){table[i].at, 7, 9}) ==
                        table[i].factor);
    static const double at[3] = {3, 4, 0.5}; /* 5 from the z axis, wherever along it */
    assert_true(factor_of("0,0.5\n10,10.5\n", &fracas_along_radius, (double[3]){3, 4, 12}) == 5.5);
    static const char steps[] = "-1,1\n0,1\n0,2\n1,2\n1,3\n3.5,3\n3.5,4\n4.5,4\n4.5,5\n";
    assert_true(factor_of(steps, &fracas_along_x, at) == 3 &&
                factor_of(steps, &fracas_along_y, at) == 4);
    assert_true(factor_of(steps, &fracas_along_z, at) == 2 &&
                factor_of(steps, &fracas_along_radius, at) == 5);
    assert_true(factor_of("1,2\n1,4\n", &fracas_along_x, (double[3]){1 - 0x1p-53}) == 2 &&
                factor_of("1,2\n1,4\n", &fracas_along_x, (double[3]){1}) == 4);
    assert_true(factor_of("1,0.25\n", &fracas_along_x, (double[3]){0}) == 0.25 &&
                factor_of("1,0.25\n", &fracas_along_x, (double[3]){2}) == 0.25);
}

static void what_is_wrong_is_said(void **state)
{
    static const struct {
        const char *text, *words;
    } table[] = {
        {"0,1\n1,two\n",
         "f.csv:2: found `two` as factor; a line begins with a coordinate [m] and a factor"},
        {"0,1\n1\n", "f.csv:2: found nothing as factor"},
        {"0 mm,1\n", "f.csv:1: found `mm` as factor"},
        {"x,f\ny,f\n", "f.csv:2: found `y` as coordinate"},
        {"0,1\ninf,2\n", "f.csv:2: found `inf` as coordinate"},
        {"0,1\n1,nan\n", "f.csv:2: found `nan` as factor"},
        {"# 1\n0,1\n1,0\n", "f.csv:3: a factor of 0; it must be greater than 0"},
        {"0,-1\n", "f.csv:1: a factor of -1; it must be greater than 0"},
        {"0,1\n2,1\n1,1\n", "f.csv:3: the coordinate 1 m comes after 2 m; sort the lines"},
        {"0,1\n2,1\n2,3\n2,4\n", "f.csv:4: the coordinate 2 m is given a third time"},
        {"1,1\n1,2\n1,3\n", "f.csv:3: the coordinate 1 m is given a third time"},
        {"0,02, 1\n0,03, 0,6\n", "f.csv:1: found `0,02, 1`; expected a decimal point, not a comma"},
        {"0,1\n0,03, 0,6\n", "f.csv:2: found `0,03, 0,6`; expected a decimal point"},
        {"0,5 1\n", "expected a decimal point"},
        {"0,5\t1\n", "expected a decimal point"},
        {"0,03; 0,6\n", "expected a decimal point"},
        {"x;f\n0,5;1\n", "expected a decimal point"},
        {"0,02,1\n", "expected a decimal point"},
        {"1,5,0,6\n", "expected a decimal point"},
        {"x,f\n0,5, 1\n", "or, if the comma ends a column, the names of all columns in a first "
                          "line (`coordinate,factor`)"},
        {"x,f\n", "f.csv has no factor; expected lines of a coordinate [m] and a factor"}};
    for (size_t t = 0; t < sizeof table / sizeof *table; t++) {
        const fracas_attachment file = attached("f.csv", table[t].text);
        const fracas_strength strength = STRENGTH("constant", .value = 1, .factor = &file,
                                                  .factor_along = &fracas_along_x);
        FAILS(fracas_strength_check(&strength), FRACAS_USAGE, table[t].words);
    }
}

/* A factor multiplies what the law draws, or the file gives; one of 1 changes no bit, nor does it
 * change what is drawn. */
static void a_field_is_the_law_times_the_factor(void **state)
{
    enum { N = 50 };
    static const char given[] = "3e8\n", ones[] = "0,1\n1,1\n1,1\n4,1\n",
                      halves[] = "0,1\n10,1\n10,0.5\n20,0.5\n20,3\n30,3\n30,0.7\n";
    char lines[N * sizeof given] = "";
    for (int i = 0; i < N; i++) strcat(lines, given);
    const fracas_attachment file = attached("s.csv", lines);
    const fracas_attachment one = attached("1.csv", ones), half = attached("f.csv", halves);
    const fracas_strength law[] = {
        STRENGTH("weibull", .minimum = 264e6, .scale = 50e6, .shape = 2),
        STRENGTH("flaws", .own[0] = 1e9, .own[1] = 3, .minimum = 1e6, .maximum = 1e9),
        STRENGTH("file", .file = &file)};
    double position[N][3] = {{0}}, plain[N], got[N];
    for (int i = 0; i < N; i++) position[i][1] = i;
    for (size_t l = 0; l < sizeof law / sizeof *law; l++) {
        const fracas_stream stream = {.seed = 3, .purpose = FRACAS_PURPOSE_STRENGTH};
        fracas_strength graded = law[l];
        OK(sample_strengths(&law[l], &stream, N, NULL, (const double(*)[3])position, 1, plain));
        graded.factor_along = &fracas_along_y;
        graded.factor = &one;
        OK(sample_strengths(&graded, &stream, N, NULL, (const double(*)[3])position, 1, got));
        assert_memory_equal(plain, got, sizeof got);
        graded.factor = &half;
        OK(sample_strengths(&graded, &stream, N, NULL, (const double(*)[3])position, 1, got));
        for (int i = 0; i < N; i++)
            assert_true(got[i] == plain[i] * (i < 10 ? 1 : i < 20 ? 0.5 : i < 30 ? 3 : 0.7));
    }
}

/* ---- campaigns, in a folder of their own ---- */

/* A bar of 50 mm and 100 elements that all stretch alike, until it cracks; its strengths are what a
 * test says. */
#define BAR(strength)                                                                              \
    "name: bar\nseed: 7\nmodel: bar\ngeometry: {length: 50 mm}\nmesh: {elements: 100}\nmaterial: " \
    "{young: 275 GPa, density: 2750 kg/m3}\n"                                                      \
    "cohesive: {fracture_energy: 100 J/m2}\nstrength: {" strength                                  \
    "}\nloading: {rate: 1e4 1/s}\ntime: {stop: time, end: 150 ns}\nreplicas: 1\n"
#define CONSTANT "distribution: constant, value: 300 MPa"

static void keys_go_together(void **state)
{
    put("f.csv", "0,1\n1,2\n");
    put("s.csv", "3e8\n");
    put("wrong.csv", "0,1\n-1,2\n");
    bad(BAR(CONSTANT ", factor: f.csv"), "strength.factor needs `factor_along`: x, y, z or radius, "
                                         "what the coordinates of f.csv are");
    bad(BAR(CONSTANT ", factor_along: x"),
        "strength.factor_along is given without a file `factor`");
    bad(BAR(CONSTANT ", factor: wrong.csv, factor_along: x"),
        "wrong.csv:2: the coordinate -1 m comes after 0 m");
    bad(BAR("distribution: file, file: s.csv, per: gauss-point"),
        "strength.per is gauss-point, but the distribution `file` gives one");
    bad(BAR("distribution: positions, file: s.csv, per: gauss-point"),
        "but the distribution `positions` gives one");
    bad(BAR(CONSTANT ", per: point"), "unknown per `point`; per can be: interface, gauss-point");
    OWN(fracas_campaign) campaign = good(BAR(CONSTANT)),
                         *same = good(BAR(CONSTANT ", per: gauss-point")),
                         *graded = good(BAR(CONSTANT ", factor: f.csv, factor_along: radius"));
    assert_false(fracas_hash_equal(&campaign->point[0].hash, &same->point[0].hash));
    assert_false(fracas_hash_equal(&campaign->point[0].hash, &graded->point[0].hash));
    assert_null(campaign->point[0].strength.per);
    assert_true(fracas_strength_is_per_point(&same->point[0].strength) &&
                !fracas_strength_is_per_point(&graded->point[0].strength));
    OWN(fracas_model) model;
    OK(fracas_point_model_create(same, 0, &model));
    assert_int_equal(fracas_model_strengths_per_interface(model), 1);
}

/* Strengths are least at x = 30 mm, the right end of element 59: its interface opens first, when E
 * rate t is its strength. The stress is known to round-off until then; 1e-12 of the time. */
static void a_bar_opens_where_its_factor_is_least(void **state)
{
    enum { WEAK = 59 };
    put("f.csv", "x [m], factor\n0, 1.3\n0.03, 0.9\n0.05, 1.2\n");
    OWN(fracas_campaign) campaign = good(BAR(CONSTANT ", factor: f.csv, factor_along: x"));
    OWN(fracas_model) model;
    OWN(fracas_field) field;
    OWN(fracas_batch) batch;
    size_t stride;
    OK(fracas_point_model_create(campaign, 0, &model));
    OK(fracas_model_field(model, &campaign->point[0].strength, &field));
    OK(fracas_batch_create(
        model, 1, &(fracas_batch_options){.interfaces = true, .isa = FRACAS_ISA_BEST}, &batch));
    double *sigma_c = fracas_batch_strength(batch, 0, &stride);
    OK(fracas_field_sample(field, &(fracas_stream){0}, stride, sigma_c));
    assert_true(fabs(sigma_c[WEAK * stride] / 270e6 - 1) < 1e-15 &&
                fabs(sigma_c[29 * stride] / 330e6 - 1) < 1e-15); /* x = 15 mm: 1.1 */
    RECORD(record);
    OK(fracas_batch_run(batch, &record));
    assert_true(record.cracked > 0 && record.onset_time == record.interface[WEAK].onset_time);
    assert_true(fabs(record.onset_time / (270e6 / (275e9 * 1e4)) - 1) < 1e-12);
}

/* ---- the forecast ---- */

static fracas_forecast forecast_of(const char *text)
{
    fracas_forecast forecast;
    OWN(fracas_campaign) campaign = good(text);
    OK(fracas_forecast_make(campaign, 0, &forecast));
    return forecast;
}

/* One interface in 100 has the factor 2: 1.01 is the mean. The mesh bears 663 MPa, and so one of
 * 900 MPa is not let pass. */
static void a_forecast_knows_the_factor(void **state)
{
    put("f.csv", "0.0297,1\n0.0297,2\n0.0303,2\n0.0303,1\n");
    put("large.csv", "0.0297,1\n0.0297,3\n0.0303,3\n0.0303,1\n");
    put("two.csv", "0,2\n");
    const fracas_forecast plain = forecast_of(BAR(CONSTANT)),
                          one = forecast_of(BAR(CONSTANT ", factor: f.csv, factor_along: x")),
                          twice = forecast_of(BAR(CONSTANT ", factor: two.csv, factor_along: x"));
    assert_true(plain.uniform && twice.uniform && !one.uniform);
    assert_true(plain.mean == 300e6 && twice.mean == 600e6 && fabs(one.mean / 303e6 - 1) < 1e-14);
    assert_true(fabs(twice.coarseness / plain.coarseness - 4) < 1e-12);
    OWN(fracas_campaign) campaign = good(BAR(CONSTANT ", factor: large.csv, factor_along: x"));
    fracas_forecast forecast;
    FAILS(fracas_forecast_make(campaign, 0, &forecast), FRACAS_USAGE,
          "the strongest of 100 interfaces (all replicas together)");
    const size_t column = fracas_point_table_find(&campaign->table, "derived.strength_mean");
    assert_true(campaign->table.point[0].value[column].real == 300e6); /* of the law */
}

/* ---- Gauss points ---- */

#define SURFACE(model, body, mesh, strength)                                                       \
    "name: surface\nseed: 7\nmodel: " model "\ngeometry: {" body                                   \
    ", thickness: 0.1 mm}\nmesh: {" mesh "}\n"                                                     \
    "material: {young: 370 GPa, poisson: 0.25, density: 3900 kg/m3}\ncohesive: {fracture_energy: " \
    "50 J/m2}\nstrength: {" strength "}\n"                                                         \
    "loading: {rate: 1e4 1/s}\ntime: {end: 10 ns}\nreplicas: 1\n"
#define FLAWS                                                                                  \
    "distribution: flaws, per: gauss-point, minimum: 100 MPa, maximum: 300 MPa, exponent: 3, " \
    "flaw_density: 1e12 1/m3"

/* Strength k = i*points + g is that of the site (i, g), of an equal part of what the interface
 * stands for. */
static void check_points(const char *text, size_t points)
{
    OWN(fracas_campaign) campaign = good(text);
    FRACAS_CLEARED(fracas_sample) sample;
    OK(fracas_sample_draw(campaign, 0, 4, &sample));
    const fracas_stream stream = fracas_point_stream(campaign, 0, FRACAS_PURPOSE_STRENGTH, 4);
    assert_int_equal(fracas_model_strengths_per_interface(sample.realizer.model), points);
    assert_int_equal(sample.n, points * fracas_model_interfaces(sample.realizer.model));
    for (size_t i = 0, k = 0; i < fracas_model_interfaces(sample.realizer.model); i++)
        for (size_t g = 0; g < points; g++, k++) {
            const fracas_extent extent = {
                fracas_model_interface_volume(sample.realizer.model, i) / (double)points,
                fracas_model_interface_area(sample.realizer.model, i) / (double)points};
            const double u = fracas_stream_uniform(&stream, fracas_stream_site(i, g));
            assert_true(sample.strength[k] == fracas_strength_quantile(&campaign->point[0].strength,
                                                                       extent,
                                                                       fracas_probability_of(u)));
        }
}

static void each_gauss_point_has_its_own(void **state)
{
    check_points(SURFACE("membrane", "width: 2 mm, height: 1 mm", "divisions: 3", FLAWS), 2);
    check_points(SURFACE("membrane", "shape: annulus, inner: 1 mm, outer: 2 mm",
                         "divisions: 2, order: 2", FLAWS),
                 3);
    check_points(SURFACE("shell", "shape: sphere, radius: 2 mm", "divisions: 2", FLAWS), 3);
    put("f.csv", "0,1\n0,2\n");
    OWN(fracas_campaign) campaign = good(
        SURFACE("membrane", "width: 2 mm, height: 1 mm", "divisions: 3",
                CONSTANT ", per: gauss-point, factor: f.csv, factor_along: x"));
    FRACAS_CLEARED(fracas_sample) sample;
    OK(fracas_sample_draw(campaign, 0, 0, &sample));
    size_t right = 0;
    for (size_t k = 0; k < sample.n; k++) {
        assert_true(sample.strength[k] == (sample.position[k][0] < 0 ? 300e6 : 600e6));
        right += sample.position[k][0] >= 0;
    }
    assert_true(right > 0 && right < sample.n);
}

/* All strengths of a point count where the strongest is looked for. */
static void a_forecast_counts_gauss_points(void **state)
{
    static const char *const text[] = {
        SURFACE("membrane", "width: 2 mm, height: 2 mm", "divisions: 2",
                "distribution: lognormal, median: 300 MPa, sigma: 1.5"),
        SURFACE("membrane", "width: 2 mm, height: 2 mm", "divisions: 2",
                "distribution: lognormal, median: 300 MPa, sigma: 1.5, per: gauss-point")};
    static const char *const words[] = {"the strongest of 8 interfaces",
                                        "the strongest of 16 Gauss points"};
    for (int t = 0; t < 2; t++) {
        OWN(fracas_campaign) campaign = good(text[t]);
        fracas_forecast forecast;
        FAILS(fracas_forecast_make(campaign, 0, &forecast), FRACAS_USAGE, words[t]);
    }
}

/* A plate pulled at 1e3 /s for 3 us is stretched by 3e-3; its diagonal of 20.4 mm, shorter than the
 * way of a wave, opens a crack by 61 um at most. A factor of 0.01 makes 2 G_c/sigma_c 130 um, of
 * 0.1 13 um: computed, no interface of the first strip breaks, and 28 of the second do. With
 * critical_opening 1.3 um and 1e-4, Grady's fragments are of 0.5 mm at 1e3 /s and of 0.11 mm at 1e4
 * /s, where 45 % of the strip's interfaces break, 11 % at 1e3 /s. */
static void plan_of_weak_strips(void **state)
{
    static const char never[] = "interfaces break at an opening of 2 fracture_energy/strength = ",
                      shatters[] = "that part shatters: give fracture_energy";
    static const struct {
        double factor, rate;
        const char *law;
        const char *said[2];
    } table[] = {
        {0.01, 1e3, "fracture_energy: 200 J/m2", {never, "raise the least factor to 0.02"}},
        {1e-4, 1e3, "fracture_energy: 200 J/m2", {never, "where strength.factor is 0.0001"}},
        {0.1, 1e3, "fracture_energy: 200 J/m2", {NULL}},
        {0.4, 1e3, "fracture_energy: 200 J/m2", {NULL}},
        {1e-4, 1e3, "critical_opening: 1.3 um", {NULL}},
        {1e-4, 1e4, "critical_opening: 1.3 um", {shatters, "fragments of 0.00011 m"}},
        {0.4, 1e4, "critical_opening: 1.3 um", {NULL}},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[900], profile[100];
        snprintf(profile, sizeof profile, "-1e-3,1\n-1e-3,%g\n1e-3,%g\n1e-3,1\n", table[i].factor,
                 table[i].factor);
        put("strip.csv", profile);
        snprintf(
            text, sizeof text,
            "name: strip\nseed: 1\nmodel: membrane\ngeometry: {shape: plate, width: 20 mm, "
            "height: 4 mm, thickness: 0.5 mm, left: held, right: held}\nmesh: {size: 0.3 mm, "
            "amplitude: 0.2}\nmaterial: {young: 370 GPa, poisson: 0.25, density: 3900}\n"
            "cohesive: {law: nitsche, %s}\nstrength: {distribution: weibull, minimum: 264 MPa, "
            "scale: 50 MPa, shape: 2, factor: strip.csv, factor_along: x}\nloading: {type: "
            "expansion, rate: %g, ratio: 0}\ntime: {stop: time, end: 3 us}\nreplicas: 1\n",
            table[i].law, table[i].rate);
        OWN(fracas_campaign) campaign = good(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        for (int k = 0; k < 2 && table[i].said[k]; k++) assert_has(plan, table[i].said[k]);
        if (table[i].said[0] != never) assert_null(strstr(plan, never));
        if (table[i].said[0] != shatters) assert_null(strstr(plan, shatters));
    }
}

/* Bodies of four models that crack before time.end. A bar of 50 mm at 1e4 /s for 1 us is stretched
 * by 0.5 mm, of which waves set 0.1 mm free; a break takes 0.67 mm with 1e5 J/m2 and 300 MPa. With
 * a thousandth of it all break. The last two loads crack none. */
static void plan_of_bodies_that_never_break(void **state)
{
    static const char bar[] = "model: bar\ngeometry: {ends: periodic, length: 50 mm}\nmesh: "
                              "{elements: 50}\nloading: {type: imposed-rate, rate: 1e4}\n",
                      ring[] = "model: ring\ngeometry: {radius: 8 mm}\nmesh: {elements: 50}\n"
                               "loading: {type: initial-velocity, radial: 80}\n",
                      plate[] = "model: membrane\ngeometry: {shape: plate, width: 5 mm, height: 5 "
                                "mm, thickness: 1 mm, left: held, right: held}\nmesh: {divisions: "
                                "4}\nloading: {type: expansion, rate: 1e4, ratio: 0}\n",
                      sphere[] = "model: shell\ngeometry: {shape: sphere, radius: 8 mm, "
                                 "thickness: 0.2 mm}\nmesh: {divisions: 4}\nloading: {type: "
                                 "expansion, rate: 1e4}\n",
                      slow[] = "model: shell\ngeometry: {shape: sphere, radius: 8 mm, thickness: "
                               "0.2 mm}\nmesh: {divisions: 4}\nloading: {type: expansion, rate: "
                               "10}\n",
                      spun[] = "model: membrane\ngeometry: {shape: annulus, inner: 5 mm, outer: "
                               "10 mm, thickness: 1 mm}\nmesh: {size: 2 mm}\nloading: {type: "
                               "centrifugal, speed: 6000 rad/s}\n";
    static const struct {
        const char *body, *law, *said, *key;
    } table[] = {
        {bar, "fracture_energy: 100 kJ/m2",
         "= 0.00067 m, and until time.end the load opens none "
         "by more than 0.0001 m: they crack and never break: is cohesive.fracture_energy in the "
         "unit (J/m2, kJ/m2) meant",
         "or raise time.end or loading.rate"},
        {bar, "fracture_energy: 100 J/m2", NULL, NULL},
        {bar, "law: rigid-link, fracture_energy: 100 kJ/m2", "= 0.00067 m", "loading.rate"},
        {ring, "fracture_energy: 100 kJ/m2", "= 0.00067 m", "loading.radial"},
        {ring, "law: stershic, critical_opening: 0.67 mm", "of critical_opening = 0.00067 m",
         "loading.radial"},
        {ring, "fracture_energy: 100 J/m2", NULL, NULL},
        {plate, "fracture_energy: 100 kJ/m2", "= 0.00067 m", "loading.rate"},
        {plate, "critical_opening: 0.67 mm", "of critical_opening = 0.00067 m", "loading.rate"},
        {plate, "fracture_energy: 100 J/m2", NULL, NULL},
        {sphere, "fracture_energy: 100 kJ/m2", "= 0.00067 m", "loading.rate"},
        {sphere, "critical_opening: 0.67 mm", "of critical_opening = 0.00067 m", "loading.rate"},
        {sphere, "fracture_energy: 100 J/m2", NULL, NULL},
        {slow, "fracture_energy: 100 J/m2", "the stress stays below ", "load it harder"},
        {spun, "fracture_energy: 100 J/m2", "the stress stays below ", "load it harder"},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char text[1200];
        const bool surface = strstr(table[i].body, "thickness");
        snprintf(text, sizeof text,
                 "name: whole\nseed: 1\n%smaterial: {young: 275 GPa, density: 2750%s}\ncohesive: "
                 "{%s}\nstrength: {distribution: constant, value: 300 MPa}\ntime: {stop: time, "
                 "end: 1 us}\nreplicas: 1\n",
                 table[i].body, surface ? ", poisson: 0.25" : "", table[i].law);
        OWN(fracas_campaign) campaign = good(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        if (table[i].said) {
            assert_has(plan, table[i].said);
            assert_has(plan, table[i].key);
        } else {
            assert_null(strstr(plan, "never break"));
            assert_null(strstr(plan, "the stress stays below"));
        }
    }
}

TESTS_ALL(make_folder, remove_folder, factors_are_linear_between_lines, what_is_wrong_is_said,
          a_field_is_the_law_times_the_factor, keys_go_together,
          a_bar_opens_where_its_factor_is_least, a_forecast_knows_the_factor,
          each_gauss_point_has_its_own, a_forecast_counts_gauss_points, plan_of_weak_strips,
          plan_of_bodies_that_never_break)
