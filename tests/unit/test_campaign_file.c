/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Good campaign files: values, sweeps, hashes, columns, the resolved file. */
#include "campaigns/file/catalog.h"
#include "tests/support/campaign_text.h"

#include "campaigns/file/identity.h"
#include "engine/loading/loading.h"

static void check_hex(const fracas_hash *hash, const char *expected)
{
    assert_string_equal(fracas_hash_hex(hash).text, expected);
}

static void test_example(void **state)
{
    static const double rate[] = {1e3, 1e4, 1e5, 1e6};
    OWN(fracas_campaign) campaign;
    assert_int_equal(fracas_campaign_read(
                         FRACAS_SOURCE_DIR "/campaigns/examples/bar-rate-sweep.yaml", &campaign),
                     0);
    assert_string_equal(campaign->name, "bar-rate-sweep");
    assert_int_equal(campaign->npoints, 4);
    for (size_t p = 0; p < 4; p++) {
        const fracas_point *point = &campaign->point[p];
        assert_true(point->spec.loading.rate == rate[p]);
        assert_true(point->spec.material.young == 275e9 && point->spec.material.density == 2750);
        assert_string_equal(point->spec.formulation->name, "bar");
        assert_string_equal(point->strength.distribution->name, "uniform");
        assert_true(point->replicas >= 32);
    }
    fracas_campaign_destroy(NULL);
}

static void test_plain(void **state)
{
    OWN(fracas_campaign) campaign = read_text(plain_campaign);
    const fracas_spec *spec = &campaign->point[0].spec;
    assert_int_equal(campaign->npoints, 1);
    assert_int_equal(campaign->seed, 7);
    assert_int_equal(campaign->output.history, 10);
    assert_false(campaign->output.interfaces);
    assert_int_equal(campaign->point[0].replicas, 3);
    assert_int_equal(spec->mesh.elements, 100);
    assert_true(spec->geometry.length == 0.05 &&
                spec->geometry.area == 1e-6); /* the second by default */
    assert_true(spec->cohesive.fracture_energy == 100 && spec->cohesive.beta == 4);
    assert_true(spec->time.end == 500e-9 && spec->time.quiet == 1e-7 && spec->time.safety == 0.25);
    assert_string_equal(spec->loading.type->name, "imposed-rate");
    assert_true(campaign->point[0].strength.minimum == 299e6 &&
                campaign->point[0].strength.maximum == 301e6);
}

/* The hashes were computed by xxhsum, not by this program, as docs/formats/campaign-file.md says.
 */
/* Editors on Windows begin a file with a byte order mark and end lines with CR LF: the same
 * campaign. */
static void test_windows(void **state)
{
    char text[4096] = "\xEF\xBB\xBF";
    size_t used = strlen(text);
    for (const char *c = plain_campaign; *c; c++) {
        assert_true(used + 3 < sizeof text);
        if (*c == '\n') text[used++] = '\r';
        text[used++] = *c;
    }
    text[used] = '\0';
    OWN(fracas_campaign) plain = read_text(plain_campaign), *windows = read_text(text);
    assert_true(fracas_hash_equal(&plain->hash, &windows->hash));
}

static void test_golden_hash(void **state)
{
    static const char text[] =
        "cohesive.beta=4\ncohesive.fracture_energy=100\ncohesive.law=nitsche\ngeometry.area=1e-06\n"
        "geometry.ends=periodic\n"
        "geometry.length=0.05\ngeometry.shape=bar\nloading.rate=10000\nloading.type=imposed-"
        "rate\nmaterial.density=2750\n"
        "material.young=275000000000\nmesh.elements=100\nmesh.spacing=uniform\nmodel=bar\nstrength."
        "distribution=uniform\n"
        "strength.maximum=301000000\nstrength.minimum=299000000\ntime.end=5e-07\ntime.quiet=1e-07\n"
        "time.quiet_fraction=0.001\ntime.safety=0.25\ntime.stop=quiet\n";
    OWN(fracas_campaign) campaign = read_text(plain_campaign);
    fracas_hash hash = fracas_hash_of(text, strlen(text));
    assert_true(fracas_hash_equal(&campaign->point[0].hash, &hash));
    check_hex(&hash, "58d9c55f95db3a035b352a26d66c7e2d");
    check_hex(&campaign->hash, "f9479c3f08a89b61d672d6b02224658e");
    OWNED char *page = whole_file(FRACAS_SOURCE_DIR "/docs/formats/campaign-file.md");
    assert_has(page, "# 58d9c55f95db3a035b352a26d66c7e2d\n");
    assert_has(page, "# f9479c3f08a89b61d672d6b02224658e\n");
}

/* What is and what is not part of a point's and of a campaign's identity. */
static void test_hashes(void **state)
{
    static const struct {
        const char *find, *put;
        bool same_point, same_campaign;
    } table[] = {
        {"name: test", "name: other", true, true},
        {"length: 50 mm", "length: 0.05", true, true},
        {"length: 50 mm", "length: 5 cm", true, true},
        {"length: 50 mm", "length: 50 mm\n  area: 1 mm2", true, true},
        {"length: 50 mm", "length: 50 mm\n  shape: bar", true, true},
        {"  ends: periodic\n", "", true, true},
        {"elements: 100", "elements: 100\n  spacing: uniform", true, true},
        {"young: 275 GPa\n  density: 2750 kg/m3", "density: 2.75 g/cm3\n  young: 2.75e11", true,
         true},
        {"elements: 100", "elements: 1e2", true, true},
        {"seed: 7", "seed: 8", true, false},
        {"replicas: 3", "replicas: 4", true, false},
        {"history: 10", "history: 11", true, false},
        {"history: 10", "history: 10\n  interfaces: true", true, false},
        {"", "sweep:\n  - cases: [{name: a}]\n", true, false},
        {"", "report: {x: count.mean}\n", true, true},
        {"elements: 100", "elements: 101", false, false},
        {"length: 50 mm", "length: 50.0000000000001 mm", false, false},
        {"ends: periodic", "ends: held", false, false},
        {"law: nitsche", "law: nitsche\n  beta: 5", false, false},
        {"elements: 100", "elements: 100\n  spacing: graded\n  ratio: 1", false, false},
        {"stop: quiet\n  end: 500 ns\n  quiet: 100 ns", "stop: time\n  end: 500 ns", false, false},
    };
    OWN(fracas_campaign) plain = read_text(plain_campaign);
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        OWN(fracas_campaign) other = read_replaced(table[i].find, table[i].put);
        bool same_point = fracas_hash_equal(&plain->point[0].hash, &other->point[0].hash);
        bool same_campaign = fracas_hash_equal(&plain->hash, &other->hash);
        if (same_point != table[i].same_point || same_campaign != table[i].same_campaign)
            fail_msg("%s: point %s, campaign %s", table[i].put, same_point ? "same" : "differs",
                     same_campaign ? "same" : "differs");
    }
}

/* ---- sweeps ---- */

static void test_product(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced("",
                                                  "sweep:\n  - loading.rate: [1e3 1/s, 1e4]\n"
                                                  "  - material.young: [1 GPa, 2 GPa, 3 GPa]\n");
    assert_int_equal(campaign->npoints, 6);
    for (size_t p = 0; p < 6; p++) { /* the last axis is the fastest */
        assert_true(campaign->point[p].spec.loading.rate == (p < 3 ? 1e3 : 1e4));
        assert_true(campaign->point[p].spec.material.young == 1e9 * (double)(p % 3 + 1));
    }
}

static void test_ranges(void **state)
{
    static const double lin[] = {0.1, 0.2, 0.3, 0.4, 0.5};
    static const double log_down[] = {1e6, 316227.766016838, 1e5, 31622.7766016838,
                                      1e4, 3162.27766016838, 1e3};
    OWN(fracas_campaign) linear = read_replaced(
        "", "sweep:\n  - loading.rate: {from: 0.1 1/s, to: 0.5, points: 5, spacing: lin}\n");
    OWN(fracas_campaign) falling = read_replaced(
        "", "sweep:\n  - loading.rate: {from: 1e6, to: 1e3, points: 7, spacing: log}\n");
    OWN(fracas_campaign) whole = read_replaced(
        "", "sweep:\n  - mesh.elements: {from: 1000, to: 8000, points: 4, spacing: log}\n");
    for (size_t p = 0; p < 5; p++) assert_true(linear->point[p].spec.loading.rate == lin[p]);
    for (size_t p = 0; p < 7; p++) assert_true(falling->point[p].spec.loading.rate == log_down[p]);
    for (size_t p = 0; p < 4; p++) assert_int_equal(whole->point[p].spec.mesh.elements, 1000 << p);
}

static void test_zip(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - zip:\n      loading.rate: [1, 2, 3]\n   "
            "   mesh.elements: {from: 10, to: 30, points: 3}\n"
            "      strength: [{minimum: 1 MPa}, {distribution: "
            "constant, value: 5 MPa}, {maximum: 400 MPa}]\n");
    assert_int_equal(campaign->npoints, 3);
    for (size_t p = 0; p < 3; p++) {
        assert_true(campaign->point[p].spec.loading.rate == (double)(p + 1));
        assert_int_equal(campaign->point[p].spec.mesh.elements, 10 * (p + 1));
    }
    assert_true(campaign->point[0].strength.minimum == 1e6 &&
                campaign->point[0].strength.maximum == 301e6);
    assert_string_equal(campaign->point[1].strength.distribution->name, "constant");
    assert_true(campaign->point[1].strength.value == 5e6);
    assert_true(campaign->point[2].strength.minimum == 299e6 &&
                campaign->point[2].strength.maximum == 400e6);
}

static void test_cases(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "",
        "sweep:\n  - cases:\n      - name: soft\n        material: {young: 1 GPa}\n        "
        "loading.rate: 5\n"
        "      - {name: hard, replicas: 9, geometry: {ends: held}}\n      - mesh: {elements: 7}\n"
        "  - cases: [{name: a}, {name: b, time: {safety: 0.1}}]\n");
    static const char *const names[] = {"soft/a", "soft/b", "hard/a", "hard/b", "a", "b"};
    assert_int_equal(campaign->npoints, 6);
    for (size_t p = 0; p < 6; p++) {
        const fracas_spec *spec = &campaign->point[p].spec;
        assert_string_equal(at(campaign, p, "case")->text, names[p]);
        assert_int_equal(campaign->point[p].replicas, p / 2 == 1 ? 9 : 3);
        assert_int_equal(campaign->table.point[p].replicas, campaign->point[p].replicas);
        assert_true(spec->material.young == (p / 2 == 0 ? 1e9 : 275e9) &&
                    spec->loading.rate == (p / 2 == 0 ? 5 : 1e4));
        assert_string_equal(spec->geometry.ends->name, p / 2 == 1 ? "held" : "periodic");
        assert_int_equal(spec->mesh.elements, p / 2 == 2 ? 7 : 100);
        assert_true(spec->time.safety == (p % 2 ? 0.1 : 0.25));
    }
}

/* A swept kind drops the base's keys of the old kind, even one of the same name (`minimum`), and
 * keeps common ones. */
static void test_changed_kind(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - strength: [{}, {distribution: weibull, scale: 300 MPa, shape: 10}]\n"
            "  - cohesive.law: [nitsche, rigid-link]\n");
    assert_int_equal(campaign->npoints, 4);
    for (size_t p = 0; p < 4; p++) {
        assert_true(real(campaign, p, "strength.minimum") == (p < 2 ? 299e6 : 0));
        const double shape = real(campaign, p, "strength.shape"),
                     maximum = real(campaign, p, "strength.maximum");
        const double beta = real(campaign, p, "cohesive.beta");
        assert_true(p < 2 ? isnan(shape) && maximum == 301e6 : shape == 10 && isnan(maximum));
        assert_true(p % 2 == 0 ? beta == 4 : isnan(beta));
        assert_true(campaign->point[p].spec.cohesive.fracture_energy == 100);
    }
}

/* A key that all kinds have stays when the kind is swept, though each has a range of its own for
 * it. */
static void test_key_of_all_kinds(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - cohesive.law: [nitsche, rigid-link]\n");
    for (size_t p = 0; p < 2; p++)
        assert_true(real(campaign, p, "cohesive.fracture_energy") == 100);
    assert_true(real(campaign, 0, "cohesive.beta") == 4 &&
                isnan(real(campaign, 1, "cohesive.beta")));
}

/* A value that is a name: swept, and by default the first one. */
static void test_choices(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - geometry.ends: [held, periodic]\n"
            "  - geometry: [{}, {shape: bar, length: 1 m}]\n");
    assert_int_equal(campaign->npoints, 4);
    for (size_t p = 0; p < 4; p++) {
        assert_string_equal(at(campaign, p, "geometry.ends")->text, p < 2 ? "held" : "periodic");
        assert_string_equal(campaign->point[p].spec.geometry.ends->name,
                            p < 2 ? "held" : "periodic");
        assert_true(isnan(real(campaign, p, "geometry.ends")));
        assert_true(campaign->point[p].spec.geometry.length == (p % 2 ? 1 : 0.05));
    }
    OWN(fracas_campaign) first = read_replaced("  ends: periodic\n", "");
    assert_string_equal(at(first, 0, "geometry.ends")->text, "periodic");
    assert_string_equal(at(first, 0, "geometry.shape")->text, "bar");
    assert_null(first->point[0].spec.geometry.direction); /* of the other shape */
}

/* The sweep may supply what the sections leave out. */
static void test_supplied_by_sweep(void **state)
{
    static const char strength[] =
        "strength:\n  distribution: uniform\n  minimum: 299 MPa\n  maximum: 301 MPa\n";
    OWNED char *text = replace(plain_campaign, strength, "");
    OWNED char *bare = replace(text, "loading:\n  rate: 1e4 1/s\n", "");
    OWNED char *swept = replace(bare, "replicas: 3\n", "");
    OWNED char *full = replace(
        swept, "",
        "sweep:\n  - loading.rate: [1e3, 1e4]\n"
        "  - cases: [{replicas: 1, strength: {distribution: constant, value: 3 MPa}}]\n");
    OWN(fracas_campaign) campaign = read_text(full);
    assert_int_equal(campaign->npoints, 2);
    assert_int_equal(campaign->point[1].replicas, 1);
    assert_true(campaign->point[1].strength.value == 3e6);
}

/* ---- the table ---- */

static void test_table(void **state)
{
    static const char sweep[] =
        "sweep:\n  - strength: [{}, {distribution: constant, value: 5 MPa}]\n";
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    const fracas_point_table *table = &campaign->table;
    static const char paths[] =
        "cohesive.beta cohesive.fracture_energy cohesive.law derived.fracture_energy "
        "derived.lattice derived.length derived.radius derived.strain_rate "
        "derived.strength_deviation derived.strength_mean derived.strength_modulus derived.surface "
        "geometry.area "
        "geometry.ends geometry.length geometry.shape loading.rate loading.type "
        "material.density material.young mesh.elements mesh.spacing model "
        "strength.distribution strength.maximum strength.minimum strength.value "
        "time.end time.quiet time.quiet_fraction time.safety time.stop ";
    char found[sizeof paths] = "";
    for (size_t c = 0; c < table->ncolumns; c++) {
        strncat(strncat(found, table->column[c].path, sizeof found - 1 - strlen(found)), " ",
                sizeof found - 1 - strlen(found));
        assert_int_equal(fracas_point_table_find(table, table->column[c].path), c);
        bool text = strcmp(table->column[c].unit, "") == 0;
        assert_int_equal(table->column[c].text, text);
        for (size_t p = 0; p < 2; p++) {
            const fracas_value *value = &table->point[p].value[c];
            assert_true(!text || (isnan(value->real) && *value->text));
        }
    }
    assert_string_equal(found, paths);
    assert_int_equal(fracas_point_table_find(table, "case"), SIZE_MAX);
    assert_true(real(campaign, 0, "derived.strain_rate") == real(campaign, 0, "loading.rate"));
    assert_true(real(campaign, 0, "derived.strength_mean") == 300e6);
    assert_true(real(campaign, 1, "derived.strength_mean") == 5e6);
    const double wide = real(campaign, 0, "strength.maximum") -
                        real(campaign, 0, "strength.minimum");
    assert_true(fabs(real(campaign, 0, "derived.strength_deviation") / (wide / sqrt(12)) - 1) <
                1e-13); /* of a uniform distribution */
    assert_true(real(campaign, 1, "derived.strength_deviation") == 0);
    const double length = real(campaign, 0, "geometry.length");
    assert_true(real(campaign, 0, "derived.length") == length);
    assert_true(real(campaign, 0, "derived.lattice") ==
                length / real(campaign, 0, "mesh.elements"));
    assert_true(real(campaign, 0, "derived.fracture_energy") ==
                real(campaign, 0, "cohesive.fracture_energy"));
    assert_true(real(campaign, 0, "derived.surface") == 0);
    assert_true(isnan(real(campaign, 0, "derived.radius")));
    assert_true(isnan(real(campaign, 0, "derived.strength_modulus")));
    assert_true(isnan(real(campaign, 0, "strength.value")) &&
                real(campaign, 1, "strength.value") == 5e6);
    assert_string_equal(at(campaign, 1, "strength.distribution")->text, "constant");
    assert_string_equal(table->column[fracas_point_table_find(table, "material.young")].unit, "Pa");
    for (size_t p = 0; p < 2; p++)
        assert_true(fracas_hash_equal(&table->point[p].hash, &campaign->point[p].hash));
}

/* (scaling-laws.8), (scaling-laws.9): the shape by lgamma, which no code of ours uses. */
static void test_modulus(void **state)
{
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - strength: [{distribution: weibull, scale: 400 MPa, shape: 10}, "
            "{distribution: weibull, minimum: 100 MPa, mean: 300 MPa, deviation: 50 MPa}, "
            "{distribution: flaws, flaw_density: 1.387e9, minimum: 100 MPa, maximum: 400 MPa, "
            "exponent: 3}, {distribution: flaws, flaw_density: 1.386e9, minimum: 100 MPa, maximum: "
            "400 MPa, exponent: 3}, {distribution: lognormal, mean: 300 MPa, deviation: 50 MPa}, "
            "{distribution: constant, value: 300 MPa}]\n");
    static const char modulus[] = "derived.strength_modulus", mean[] = "derived.strength_mean";
    assert_true(fabs(real(campaign, 0, modulus) - 10) < 1e-13);
    const double x = 300 / (200 * real(campaign, 1, modulus));
    const double variation = expm1(lgamma(1 + 2 * x) - 2 * lgamma(1 + x));
    assert_true(fabs(variation / (0.25 * 0.25) - 1) < 1e-11);
    assert_true(fabs(real(campaign, 2, modulus) /
                         (3 * real(campaign, 2, mean) / (real(campaign, 2, mean) - 100e6)) -
                     1) < 1e-13);
    /* above ln 2 flaws in the 0.5 mm3 of an interface more than half have one; no power below */
    for (size_t p = 3; p < 6; p++) assert_true(isnan(real(campaign, p, modulus)));
    static const char deviation[] = "derived.strength_deviation";
    const double gamma = lgamma(1.1),
                 weibull = 400e6 * exp(gamma) * sqrt(expm1(lgamma(1.2) - 2 * gamma));
    assert_true(fabs(real(campaign, 0, deviation) / weibull - 1) < 1e-11);
    assert_true(fabs(real(campaign, 1, deviation) / 50e6 - 1) < 1e-11);
    assert_true(fabs(real(campaign, 4, deviation) / 50e6 - 1) < 1e-13);
}

/* (settled.10) at rate/edot0 = 0.28009 (docs/theory/scaling-laws.md): 109.09 ns + 120 469.9 um/c =
 * 5.748 us; twice the transits of another rule 11.386 us. `end` as given comes first. Weibull's of
 * 500 mm3, 275.45 MPa, have interfaces of 0.5 mm3 with 1096.6 MPa, so an onset of 398.8 ns, and
 * e = 0.3618, ZMR 1.3698 s0, Mott (M = 5) 3.0985 s0 with s0 = 362.5 um: 9.360 us. At 100 /s the
 * size by ZMR is 1.3 mm: a bar of 1 mm has 10.909 us + 120 1 mm/c = 22.909 us. At 1 /s and 280.5
 * MPa it is 1.0200 ms + 18.9 us, of which two digits would be too early. */
static void test_cap(void **state)
{
    static const char before[] = "  stop: quiet\n  end: 500 ns\n  quiet: 100 ns\n";
    OWN(fracas_campaign) campaign = read_replaced(
        before, "  stop: settled\nsweep:\n  - cases:\n    - {time.stop: settled}\n    - "
                "{time.transits: 0}\n"
                "    - {time: {stop: transits, transits: 40}}\n    - {time.end: 3 us}\n"
                "    - {time: {stop: time, end: 2 us}}\n"
                "    - {strength: {distribution: weibull, scale: 300 MPa, shape: 5, "
                "reference_volume: 500 mm3}}\n"
                "    - {loading.rate: 100, geometry.length: 1 mm}\n"
                "    - {loading.rate: 1, strength: {distribution: constant, value: 280.5 MPa}}\n");
    const double end[] = {5.7e-6, 5.7e-6, 1.1e-5, 3e-6, 2e-6, 9.4e-6, 2.3e-5, 1.04e-3};
    for (size_t p = 0; p < FRACAS_COUNT(end); p++)
        if (real(campaign, p, "time.end") != end[p])
            fail_msg("time.end of point %zu is %g s", p, real(campaign, p, "time.end"));
}

/* Powers of two, so that quotients are exact. */
static void test_strain_rate(void **state)
{
    fracas_spec spec = {.geometry.radius = 0.0078125,
                        .loading = {.type = &fracas_loading_imposed_rate,
                                    .rate = 3e3,
                                    .radial = 128,
                                    .velocity = 64,
                                    .direction = &fracas_axis_radial}};
    assert_true(fracas_spec_strain_rate(&spec) == 3e3);
    spec.loading.type = &fracas_loading_initial_velocity;
    assert_true(fracas_spec_strain_rate(&spec) == 16384);
    spec.loading.type = &fracas_loading_held_velocity;
    assert_true(fracas_spec_strain_rate(&spec) == 8192);
    spec.loading.direction = &fracas_axis_circumferential;
    assert_true(isnan(fracas_spec_strain_rate(&spec)));
    spec.loading = (fracas_loading){
        .type = &fracas_loading_force, .direction = &fracas_axis_radial, .force = 5};
    assert_true(isnan(fracas_spec_strain_rate(&spec)));
}

/* Kinds of one section that have a key in common must give it one type and unit: they share a leaf
 * and a column. Each may have choices of its own, but those of one name are one. */
static void check_same_key(const fracas_section *section, const fracas_param *a,
                           const fracas_param *b)
{
    if (strcmp(a->name, b->name) != 0) return;
    if (a->type != b->type || strcmp(a->unit, b->unit) != 0)
        fail_msg("%s.%s has two types or units", section->name, a->name);
    assert_true(a->nchoices + b->nchoices <= FRACAS_MOST_CHOICES);
    for (size_t c = 0; c < a->nchoices; c++)
        for (size_t d = 0; d < b->nchoices; d++)
            if (strcmp(a->choices[c]->name, b->choices[d]->name) == 0 &&
                a->choices[c] != b->choices[d])
                fail_msg("%s.%s has two of %s", section->name, a->name, a->choices[c]->name);
}

static void check_section(const fracas_section *section)
{
    for (size_t k = 0; k < section->nkinds; k++)
        for (size_t p = 0; p < section->kinds[k]->nparams; p++) {
            const fracas_param *param = &section->kinds[k]->params[p];
            for (size_t c = 0; c < section->nparams; c++)
                if (strcmp(section->params[c].name, param->name) == 0)
                    fail_msg("%s.%s is there twice", section->name, param->name);
            for (size_t l = 0; l < k; l++)
                for (size_t q = 0; q < section->kinds[l]->nparams; q++)
                    check_same_key(section, param, &section->kinds[l]->params[q]);
        }
}

static void test_tables_agree(void **state)
{
    for (size_t s = 0; s < fracas_engine_nsections; s++) check_section(fracas_engine_sections[s]);
    check_section(&fracas_strength_section);
}

/* The file and the sweep that docs/formats/campaign-file.md shows, first and last of three
 * (test_campaign_membranes has the other). */
static void test_page_examples(void **state)
{
    OWNED char *page = whole_file(FRACAS_SOURCE_DIR "/docs/formats/campaign-file.md");
    char *block[4], *end = page;
    for (int b = 0; b < 4; b++) {
        block[b] = strstr(end, "```yaml\n") + strlen("```yaml\n");
        end = strstr(block[b], "```");
        *end++ = '\0';
    }
    OWN(fracas_campaign) plain = read_text(plain_campaign), *shown = read_text(block[0]),
                         *swept = read_replaced("", block[2]), *drawn = read_replaced("", block[3]);
    assert_true(fracas_hash_equal(&plain->hash, &shown->hash));
    assert_int_equal(swept->npoints, 2 * 4 * 2 * 2 * 2);
    assert_int_equal(drawn->npoints, 64);
}

/* ---- the resolved file ---- */

static void test_round_trip(void **state)
{
    static const char *const sweeps[] = {
        "",
        "sweep:\n  - cases: [{name: alone, replicas: 5}]\n",
        "sweep:\n  - loading.rate: {from: 1e3, to: 1e6, points: 4, spacing: log}\n  - "
        "mesh.elements: [10, 1e8]\n",
        "sweep:\n  - cases:\n      - {name: a, replicas: 1000000000}\n      - {strength.minimum: 1 "
        "Pa, replicas: 1}\n",
        ("sweep:\n  - strength: [{}, {distribution: weibull, scale: 3 MPa, shape: 10}, "
         "{distribution: constant, value: 1}]\n"
         "  - cohesive.law: [nitsche, rigid-link]\n  - time: [{}, {stop: time}]\n"
         "  - geometry.ends: [periodic, held]\n"),
        ("sweep:\n  - strength: [{}, {distribution: weibull, mean: 3 MPa, deviation: 1 MPa, "
         "reference_volume: 1 mm3}, {distribution: normal, kept_mean: 3 MPa, kept_deviation: 2 "
         "MPa}]\n"),
        "sweep:\n  - geometry.ends: [periodic, held]\n  - mesh: [{}, {spacing: graded, ratio: "
        "3}]\n",
        "sweep:\n  - geometry: [{}, {ends: free}, {ends: free, gap: 1 um}]\n",
        "sweep:\n  - zip:\n      material.young: [0.1 GPa, 0.3 GPa]\n      time.stop: [quiet, "
        "time]\n",
        "random_numbers: common\nsweep:\n  - loading.rate: [1e3, 2e3]\n",
        /* names of two axes, joined in the resolved file, and such a name */
        ("sweep:\n  - cases: [{name: a, loading.rate: 1e3}, {name: b, loading.rate: 2e3}]\n"
         "  - cases: [{name: a, mesh.elements: 10}, {name: b/c, mesh.elements: 11}]\n"),
        ("sweep:\n  - design: {type: latin-hypercube, points: 20, parameters: {mesh.elements: "
         "{distribution: lognormal, median: 1e4, sigma: 1}, material.young: {distribution: normal, "
         "mean: 270 GPa, deviation: 10 GPa}}}\n  - strength.maximum: [301 MPa, 302 MPa]\n"
         "  - design: {type: sobol, points: 3, parameters: {loading.rate: {distribution: "
         "log-uniform, minimum: 1e3, maximum: 1e5}}}\n"),
    };
    for (size_t i = 0; i < FRACAS_COUNT(sweeps); i++) {
        OWN(fracas_campaign) campaign = read_replaced("", sweeps[i]);
        check_round_trip(campaign);
    }
}

/* The largest campaign, every number of it varied, is still one that can be read back. */
static void test_largest_round_trip(void **state)
{
    static const char *const paths[] = {"geometry.length",  "geometry.area",
                                        "mesh.elements",    "material.young",
                                        "material.density", "cohesive.fracture_energy",
                                        "cohesive.beta",    "loading.rate",
                                        "time.end",         "time.quiet"};
    char sweep[2000] = "sweep:\n  - zip:\n";
    for (size_t i = 0; i < FRACAS_COUNT(paths); i++) {
        size_t used = strlen(sweep);
        snprintf(sweep + used, sizeof sweep - used,
                 "      %s: {from: 17, to: 99000, points: 10000%s}\n", paths[i],
                 i == 2 || i == 6 ? "" : ", spacing: log"); /* whole, or at most 1e4 */
    }
    char *text = replace(sweep, "cohesive.beta: {from: 17, to: 99000",
                         "cohesive.beta: {from: 17, to: 9900");
    OWN(fracas_campaign) campaign = read_replaced("", text);
    free(text);
    text = write_text(campaign);
    OWN(fracas_campaign) back = read_text(text);
    assert_int_equal(back->npoints, 10000);
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    free(text);
}

/* Axes of the report are kept with the study, in no hash, and a study may get others. */
static void test_report_keys(void **state)
{
    static const char sweep[] = "sweep:\n  - loading.rate: [1e3, 1e4]\n";
    char put[200];
    snprintf(put, sizeof put, "%sreport: {x: size.mean, series: loading.rate}\n", sweep);
    OWN(fracas_campaign) plain = read_replaced("", sweep), *with = read_replaced("", put);
    assert_true(!plain->report.x && !plain->report.series && !plain->report.panels);
    assert_string_equal(with->report.x, "size.mean");
    assert_true(fracas_hash_equal(&plain->hash, &with->hash));
    OK(fracas_campaign_extends(with, plain));
    OK(fracas_campaign_extends(plain, with));
    OWNED char *text = write_text(with), *bare = write_text(plain);
    assert_has(text, "\nreport: {x: size.mean, series: loading.rate}\n");
    assert_null(strstr(bare, "report"));
    OWN(fracas_campaign) back = read_text(text);
    assert_string_equal(back->report.series, "loading.rate");
    assert_null(back->report.y);
    snprintf(put, sizeof put, "%sreport: {x: size.mean, y: [aspect, onset_time]}\n", sweep);
    OWN(fracas_campaign) list = read_replaced("", put);
    assert_string_equal(list->report.y, "aspect,onset_time");
    OWNED char *listed = write_text(list);
    assert_has(listed, "\nreport: {x: size.mean, y: [aspect, onset_time]}\n");
    snprintf(put, sizeof put, "%sreport: {y: aspect}\n", sweep);
    OWN(fracas_campaign) one = read_replaced("", put);
    OWNED char *alone = write_text(one);
    assert_has(alone, "\nreport: {y: [aspect]}\n");
    snprintf(put, sizeof put, "%sreport: {panels: loading.rate, y: aspect}\n", sweep);
    OWN(fracas_campaign) panels = read_replaced("", put);
    assert_string_equal(panels->report.panels, "loading.rate");
    OWNED char *parted = write_text(panels);
    assert_has(parted, "\nreport: {panels: loading.rate, y: [aspect]}\n");
}

/* A file that cannot be written is said. */
static void test_write_fails(void **state)
{
    OWN(fracas_campaign) campaign = read_text(plain_campaign);
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    FAILS(fracas_campaign_write(campaign, full), FRACAS_ENVIRONMENT, "No space left");
    fclose(full);
}

/* ---- the reference page ---- */

static void test_reference_page(void **state)
{
    FILE *out = text_begin();
    OK(fracas_campaign_reference(out));
    OWNED char *text = text_end(out);
    OWNED char *page = whole_file(FRACAS_SOURCE_DIR "/docs/formats/campaign-file-keys.md");
    if (strcmp(page, text) != 0)
        fail_msg(
            "docs/formats/campaign-file-keys.md is not what the tables say: in the folder of the "
            "sources, `build/werror/fracas reference > docs/formats/campaign-file-keys.md`");
}

TESTS(test_example, test_plain, test_windows, test_golden_hash, test_hashes, test_product,
      test_ranges, test_zip, test_cases, test_changed_kind, test_supplied_by_sweep, test_table,
      test_tables_agree, test_modulus, test_cap, test_strain_rate, test_round_trip,
      test_write_fails, test_reference_page, test_choices, test_key_of_all_kinds,
      test_page_examples, test_largest_round_trip, test_report_keys)
