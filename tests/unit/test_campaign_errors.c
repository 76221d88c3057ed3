/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wrong campaign file is told: place, what was found, what is allowed, the nearest known
 * key. */
#include "campaigns/file/read.h"
#include "campaigns/file/setting.h"
#include "tests/support/campaign_text.h"
#include "tests/support/test.h"

typedef struct {
    const char *find,
        *put; /* the plain campaign with this replaced (find "": appended, at line 28) */
    int line, column;
    const char *words[4]; /* which the message must have */
} wrong;

static void check(const fracas_units *units, const wrong *w)
{
    char path[40], place[80];
    char *text = replace(plain_campaign, w->find, w->put);
    fracas_campaign *campaign = NULL;
    make_path(path);
    write_bytes(path, text, strlen(text));
    fracas_err err = fracas_campaign_read_with(units, path, &campaign);
    unlink(path);
    free(text);
    if (getenv("FRACAS_READ_ALOUD"))
        print_message("%s   (%d:%d)\n", fracas_message() + strlen(path), w->line, w->column);
    if (err != FRACAS_USAGE || campaign) fail_msg("accepted: %s", w->put);
    snprintf(place, sizeof place, "%s:%d:%d: ", path, w->line, w->column);
    if (strncmp(fracas_message(), place, strlen(place)) != 0)
        fail_msg("expected %d:%d for \"%s\": %s", w->line, w->column, w->put, fracas_message());
    for (int i = 0; i < 4 && w->words[i]; i++)
        if (!strstr(fracas_message(), w->words[i]))
            fail_msg("no \"%s\" in: %s", w->words[i], fracas_message());
}

#define CHECK_ALL(table) \
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) check(*state, &(table)[i])

static void test_yaml(void **state)
{
    static const wrong table[] = {
        {"model: bar", "model: bar\n\tarea: 3", 4, 1, {"a tab", "spaces"}},
        {"model: bar", "model: @bar", 3, 8, {"cannot start with `@`", "quotes"}},
        {"model: bar",
         "model: [bar",
         4,
         9,
         {"not YAML", "the list [...] that begins at line 3, column 8"}},
        {"model: bar",
         "model bar",
         4,
         1,
         {"not YAML", "':'", "the line that begins at line 3, column 1"}},
        {"model: bar", "model: \"bar", 28, 1, {"not YAML"}},
        {"model: bar",
         "model: b\xff"
         "ar",
         3,
         9,
         {"not plain UTF-8", "save it as UTF-8"}},
        {"model: bar",
         "model: b\x01"
         "ar",
         3,
         9,
         {"not plain UTF-8"}},
        {"model: bar", "model: \"b\\x01ar\"", 3, 8, {"control character"}},
        {"model: bar", "model: &a bar", 3, 8, {"anchors and aliases"}},
        {"model: bar", "model: *a", 3, 8, {"anchors and aliases"}},
        {"model: bar", "model: !!str bar", 3, 8, {"tags"}},
        {"model: bar", "? [model]\n: bar", 3, 3, {"where a key is expected"}},
        {"model: bar",
         "model: [[[[[[[[[[[[[[[[[[1]]]]]]]]]]]]]]]]]]",
         3,
         23,
         {"nested deeper than 16"}},
        {"model: bar",
         "model: "
         "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
         "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"
         "aaaaaaaaaaaaaaaaaaaaaaa",
         3,
         8,
         {"a text of 201 bytes", "at most 200"}},
        {"", "---\nname: other\n", 28, 1, {"a second document", "remove `---`"}},
        {"seed: 7", "seed: 7\nseed: 8", 3, 1, {"`seed` is given twice", "line 2"}},
        {"  young: 275 GPa",
         "  young: 275 GPa\n  young: 1 GPa",
         11,
         3,
         {"`young` is given twice", "line 10"}},
    };
    CHECK_ALL(table);
}

static void test_top(void **state)
{
    static const wrong table[] = {
        {"name: test\n", "", 1, 1, {"no `name`", "becomes its folder"}},
        {"name: test", "name: a/b", 1, 7, {"`a/b`", "letters", "digits"}},
        {"name: test", "name: ..", 1, 7, {"`..`", "starts with a letter or digit"}},
        {"name: test", "name: [a]", 1, 7, {"`name`", "found a list"}},
        {"name: test", "name:", 1, 6, {"`name`", "found nothing"}},
        {"seed: 7\n", "", 1, 1, {"no `seed`", "seed: 1"}},
        {"seed: 7", "seed: -1", 2, 7, {"`seed`", "`-1`", "18446744073709551615"}},
        {"seed: 7", "seed: 1e3", 2, 7, {"`1e3`", "in digits"}},
        {"seed: 7", "seed: 18446744073709551616", 2, 7, {"`18446744073709551616`"}},
        {"replicas: 3\n", "", 1, 1, {"no `replicas`", "replicas: 32"}},
        {"replicas: 3",
         "replicas: 0",
         25,
         11,
         {"`replicas`", "0 is out of range", "1 to 1000000000"}},
        {"replicas: 3", "replicas: 2.5", 25, 11, {"`2.5` is not a whole number"}},
        {"replicas: 3", "replicas: 3x", 25, 11, {"`replicas`", "`3x` is not a number"}},
        {"replicas: 3", "replicas: [3, 4]", 25, 11, {"`replicas`", "a list", "a whole number"}},
        {"replicas: 3",
         "replica: 3",
         25,
         1,
         {"unknown key `replica`", "did you mean `replicas`?", "known are: name, seed"}},
        {"material:", "materail:", 9, 1, {"unknown key `materail`", "did you mean `material`?"}},
        {"", "rate: 5\n", 28, 1, {"unknown key `rate`", "write `rate:` indented below `loading:`"}},
        {"",
         "loading.rate: 5\n",
         28,
         1,
         {"unknown key `loading.rate`", "write `rate:` indented below `loading:`"}},
        {"model: bar", "model: rod", 3, 8, {"unknown model `rod`", "model can be: bar, ring"}},
        {"model: bar", "model: {bar: 1}", 3, 8, {"`model`", "found a section", "a name"}},
    };
    CHECK_ALL(table);
}

static void test_keys(void **state)
{
    static const wrong table[] = {
        {"  fracture_energy:",
         "  fracture_enrgy:",
         14,
         3,
         {"unknown key `fracture_enrgy` in cohesive", "did you mean `fracture_energy`?",
          "keys of cohesive: beta"}},
        {"  elements: 100",
         "  elements: 100\n  density: 5",
         9,
         3,
         {"unknown key `density` in mesh", "section material"}},
        {"  elements: 100",
         "  12: 100",
         8,
         3,
         {"unknown key `12` in mesh",
          "keys of mesh: amplitude, divisions, elements, order, ratio, size, spacing"}},
        {"  maximum: 301 MPa",
         "  maximum: 301 MPa\n  shape: 5",
         19,
         3,
         {"`shape` belongs to distribution weibull", "this is uniform", "line 16"}},
        {"  distribution: uniform\n",
         "",
         17,
         3,
         {"`maximum` belongs to distribution uniform",
          "this is weibull, the default, as no `distribution`"}},
        {"  distribution: uniform",
         "  distribution: lognormal",
         18,
         3,
         {"`maximum` belongs to distribution uniform", "this is lognormal"}},
        {"  distribution: uniform",
         "  distribution: unifrom",
         16,
         17,
         {"unknown distribution `unifrom`", "`uniform`"}},
        {"  law: nitsche",
         "  law: Nitsche",
         13,
         8,
         {"unknown law `Nitsche`", "did you mean `nitsche`?", "rigid-link"}},
        {"  maximum: 301 MPa\n",
         "",
         17,
         12,
         {"distribution uniform needs `minimum` and `maximum`, or `mean` and `deviation`",
          "add `maximum`"}},
        {"  maximum: 301 MPa",
         "  maximum: 301 MPa\n  covariance: matern",
         17,
         12,
         {"`strength`: `covariance` without a `correlation_length`: give it"}},
        {"  maximum: 301 MPa",
         "  maximum: 301 MPa\n  correlation_length: 1 mm",
         17,
         12,
         {"`strength`: `correlation_length` without a `covariance`",
          "exponential, matern or gaussian"}},
        {"  maximum: 301 MPa",
         "  maximum: 301 MPa\n  covariance: gaussian\n  correlation_length: 1 mm\n  smoothness: 2",
         21,
         15,
         {"`strength`: `smoothness` is that of a matern covariance alone"}},
        {"  maximum: 301 MPa",
         "  maximum: 301 MPa\n  covariance: spherical",
         19,
         15,
         {"unknown covariance `spherical`", "gaussian"}},
        {"  young: 275 GPa\n",
         "",
         9,
         1,
         {"material needs `young` (Young's modulus E)", "a stress"}},
        {"mesh:\n  elements: 100\n", "", 1, 1, {"mesh needs `elements`", "a whole number"}},
        {"  quiet: 100 ns\n",
         "",
         22,
         9,
         {"time with stop settled needs `quiet`", "a time, in s or us"}},
        {"material:\n  young: 275 GPa\n  density: 2750 kg/m3",
         "material: steel",
         9,
         11,
         {"`material` is a section, but found `steel`", "density, poisson, young"}},
        {"material:\n  young: 275 GPa\n  density: 2750 kg/m3",
         "material: [5]",
         9,
         11,
         {"found a list"}},
    };
    CHECK_ALL(table);
}

static void test_values(void **state)
{
    static const wrong table[] = {
        {"275 GPa",
         "264 mm",
         10,
         10,
         {"`young`", "`264 mm` is a length", "expected a stress", "Pa or MPa"}},
        {"275 GPa", "275 GPA", 10, 10, {"`young`", "unknown unit, `GPA`"}},
        {"275 GPa", "275GPa", 10, 10, {"`275GPa` is not a number", "a space before the unit"}},
        {"275 GPa", "-5 GPa", 10, 10, {"`young`", "-5 GPa is out of range", "more than 0 Pa"}},
        {"275 GPa", "nan", 10, 10, {"`nan` is not a number"}},
        {"275 GPa", "", 10, 9, {"`young`", "found nothing", "a stress"}},
        {"275 GPa", "{a: 1}", 10, 10, {"`young`", "found a section", "a stress"}},
        {"275 GPa", "[1 GPa, 2 GPa]", 10, 10, {"found a list", "- material.young: [...]"}},
        {"elements: 100", "elements: 12x", 8, 13, {"`elements`", "`12x` is not a number"}},
        {"elements: 100", "elements: 1e", 8, 13, {"`1e` is not a number"}},
        {"elements: 100", "elements: 1.5", 8, 13, {"`1.5` is not a whole number"}},
        {"elements: 100",
         "elements: 1e20",
         8,
         13,
         {"`1e20` is not a whole number of at most 15 digits"}},
        {"elements: 100",
         "elements: 1",
         8,
         13,
         {"1 is out of range", "at least 2, at most 100000000"}},
        {"elements: 100", "elements: 100 m", 8, 13, {"`100 m` is not a number"}},
        {"  quiet: 100 ns",
         "  quiet: 100 ns\n  safety: 1.5",
         25,
         11,
         {"`safety`", "1.5 is out of range", "more than 0, at most 1"}},
        {"  quiet: 100 ns",
         "  quiet: 100 ns\n  safety: 0.5 s",
         25,
         11,
         {"`0.5 s` has a unit", "a pure number"}},
        {"  history: 10",
         "  history: -1",
         27,
         12,
         {"`history`", "-1 is out of range", "at least 0"}},
        {"  history: 10", "  interfaces: yes", 27, 15, {"`interfaces`", "`yes`", "true or false"}},
        {"  history: 10",
         "  interfaces: [true]",
         27,
         15,
         {"`interfaces`", "found a list", "true or false"}},
    };
    CHECK_ALL(table);
}

static void test_choices(void **state)
{
    static const wrong table[] = {
        {"ends: periodic",
         "ends: perodic",
         5,
         9,
         {"unknown ends `perodic`", "did you mean `periodic`?", "ends can be: periodic, held"}},
        {"ends: periodic", "ends: 5", 5, 9, {"unknown ends `5`; ends can be: periodic, held"}},
        {"ends: periodic",
         "ends: [held]",
         5,
         9,
         {"`ends`: found a list", "- geometry.ends: [...]"}},
        {"ends: periodic", "ends: {a: 1}", 5, 9, {"`ends`: found a section; expected a name"}},
        {"ends: periodic", "ends:", 5, 8, {"`ends`: found nothing; expected a name"}},
        {"ends: periodic", "ends: periodic\n  ends: held", 6, 3, {"`ends` is given twice"}},
        {"ends: periodic",
         "direction: current",
         5,
         3,
         {"`direction` belongs to shape ring; this is bar, the default, as no `shape` is given"}},
        {"ends: periodic",
         "shape: bar\n  direction: current",
         6,
         3,
         {"`direction` belongs to shape ring; this is bar (line 5)"}},
        {"",
         "sweep:\n  - geometry.ends: [periodic, hold]\n",
         29,
         31,
         {"unknown ends `hold`", "`held`"}},
        {"",
         "sweep:\n  - geometry.ends: {from: 1, to: 2, points: 2}\n",
         29,
         20,
         {"`geometry.ends` is not a number"}},
        {"",
         "sweep:\n  - geometry.direction: [initial]\n",
         29,
         26,
         {"`direction` belongs to shape ring"}},
    };
    CHECK_ALL(table);
}

/* Kinds that the model does not take, wherever they are named. */
static void test_combinations(void **state)
{
    static const wrong table[] = {
        {"ends: periodic",
         "shape: ring\n  radius: 5 cm",
         5,
         10,
         {"`shape`: ring cannot be combined with model bar, which takes bar; the model is chosen "
          "at line 3"}},
        {"model: bar\ngeometry:\n  ends: periodic\n  length: 50 mm",
         "geometry:\n  shape: ring\n  radius: 5 cm",
         4,
         10,
         {"`shape`: ring cannot be combined with model bar, which takes bar"}},
        {"law: nitsche",
         "law: stershic",
         13,
         8,
         {"`law`: stershic cannot be combined with model bar, which takes nitsche or rigid-link"}},
        {"rate: 1e4 1/s",
         "type: force\n  force: -1 N/m",
         20,
         9,
         {"`type`: force cannot be combined with model bar, which takes imposed-rate"}},
        {"",
         "sweep:\n  - cohesive.law: [nitsche, stershic]\n",
         29,
         29,
         {"`law`: stershic cannot be combined with model bar", "line 3"}},
        {"",
         "sweep:\n  - cases:\n      - {name: a}\n      - loading: {type: held-velocity, velocity: "
         "-5 m/s}\n",
         31,
         25,
         {"`type`: held-velocity cannot be combined with model bar"}},
        {"",
         "sweep:\n  - zip:\n      model: [bar]\n      geometry: [{shape: ring, radius: 1}]\n",
         31,
         26,
         {"`shape`: ring cannot be combined with model bar, which takes bar; the model is chosen "
          "at line 30"}},
    };
    CHECK_ALL(table);
}

/* Keys that other models have. */
static void test_other_models(void **state)
{
    static const wrong table[] = {
        {"density: 2750 kg/m3",
         "density: 2750 kg/m3\n  poisson: 0.2",
         12,
         3,
         {"`poisson` belongs to model membrane or shell; this is bar (line 3)"}},
        {"law: nitsche",
         "law: nitsche\n  onset: flux",
         14,
         3,
         {"`onset` belongs to model membrane or shell; this is bar (line 3)"}},
        {"law: nitsche",
         "law: rigid-link\n  onset: flux",
         14,
         3,
         {"`onset` belongs to law nitsche or camacho-ortiz-standard or camacho-ortiz; this is "
          "rigid-link (line 13)"}},
        {"stop: settled",
         "mass: lumped\n  stop: settled",
         22,
         3,
         {"`mass` belongs to model membrane; this is bar (line 3)"}},
        {"density: 2750 kg/m3", "density: 2750 kg/m3\n  poisson: 2", 12, 12, {"2 is out of range"}},
        {"model: bar\ngeometry:\n  ends: periodic\n  length: 50 mm\nmesh:\n  elements: "
         "100\nmaterial:",
         "geometry:\n  ends: periodic\n  length: 50 mm\nmesh:\n  elements: 100\nmaterial:\n  "
         "poisson: 0.2",
         9,
         3,
         {"`poisson` belongs to model membrane or shell; this is bar, the default, as no `model` "
          "is given"}},
        {"",
         "sweep:\n  - material.poisson: [0.2, 0.3]\n",
         29,
         24,
         {"`poisson` belongs to model membrane or shell; this is bar (line 3)"}},
        {"",
         "sweep:\n  - zip:\n      material: [{young: 1 GPa}, {poisson: 0.2}]\n",
         30,
         35,
         {"`poisson` belongs to model membrane or shell"}},
        {"  quiet: 100 ns\n",
         "  quiet: 100 ns\n  mass: lumped\nsweep:\n  - model: [bar]\n",
         25,
         3,
         {"`mass` belongs to model membrane; this is bar (line 27)"}},
        {"ends: periodic",
         "thickness: 1 mm",
         5,
         3,
         {"`thickness` belongs to shape plate or annulus or sphere or file; this is bar"}},
    };
    CHECK_ALL(table);
}

/* Ranges with no lower limit. */
static void test_any_number(void **state)
{
    fracas_param any = {.name = "v", .unit = "m/s", .minimum = -INFINITY, .maximum = INFINITY},
                 low = any;
    low.maximum = 5;
    const fracas_leaf leaf = {.path = "a.v", .key = "v", .param = &any};
    const fracas_node node = {.text = "6", .line = 2, .column = 3};
    const fracas_file file = {.name = "f"};
    for (double value = -1e300; value <= 1e300; value += 1e300)
        OK(fracas_setting_check(
            &file, &(fracas_setting){.leaf = &leaf, .node = &node, .value = value}, &any));
    const fracas_setting six = {.leaf = &leaf, .node = &node, .value = 6};
    assert_int_equal(fracas_setting_check(&file, &six, &low), FRACAS_USAGE);
    assert_string_equal(fracas_message(),
                        "f:2:3: `v`: 6 is out of range; allowed is any number at most 5 m/s");
}

static void test_sweeps(void **state)
{
    static const wrong table[] = {
        {"", "sweep: []\n", 28, 8, {"`sweep`", "no axis"}},
        {"",
         "sweep:\n  - strength.minimum: [299 MPa, 302 MPa]\n",
         29,
         33,
         {"`strength`", "swap them"}},
        {"",
         "sweep:\n  - time: [{stop: settled, end: 1 us, quiet: 2 us}]\n",
         29,
         46,
         {"`time`", "quiet is 2e-06 s", "end is 1e-06 s"}},
        {"", "sweep: 5\n", 28, 8, {"`sweep`", "found `5`", "a list of axes"}},
        {"",
         "sweep:\n  loading.rate: [1, 2]\n",
         29,
         3,
         {"`sweep`", "found a section", "after `- `"}},
        {"", "sweep:\n  - 5\n", 29, 5, {"an axis", "found `5`"}},
        {"", "sweep:\n  - {}\n", 29, 5, {"an axis", "found nothing"}},
        {"",
         "sweep:\n  - loading.rate: [1, 2]\n    time.end: [1, 2]\n",
         30,
         5,
         {"a second path, `time.end`", "zip"}},
        {"", "sweep:\n  - loading.rate: []\n", 29, 19, {"no values"}},
        {"",
         "sweep:\n  - loading.rate: 5\n",
         29,
         19,
         {"`loading.rate`", "found `5`", "[...]", "{from"}},
        {"",
         "sweep:\n  - loading.rat: [5]\n",
         29,
         5,
         {"unknown path `loading.rat`", "did you mean `loading.rate`?"}},
        {"",
         "sweep:\n  - loding.rate: [5]\n",
         29,
         5,
         {"unknown path `loding.rate`", "did you mean `loading.rate`?"}},
        {"", "sweep:\n  - seed: [5]\n", 29, 5, {"`seed` cannot be swept"}},
        {"",
         "sweep:\n  - replicas: [5]\n",
         29,
         5,
         {"`replicas` is not a parameter to sweep", "cases"}},
        {"",
         "sweep:\n  - output.history: [5]\n",
         29,
         5,
         {"`output.history` cannot be swept", "whole campaign"}},
        {"",
         "sweep:\n  - loading.rate: [1, -2 1/s]\n",
         29,
         23,
         {"`rate`", "-2 1/s is out of range", "more than 0 1/s"}},
        {"",
         "sweep:\n  - loading.rate: [1, 2 m]\n",
         29,
         23,
         {"`rate`", "`2 m` is a length", "expected a rate"}},
        {"", "sweep:\n  - loading.rate: [1, [2]]\n", 29, 23, {"`rate`", "found a list"}},
        {"",
         "sweep:\n  - loading.rate: [1e3, 2e3, 1000 1/s]\n",
         29,
         30,
         {"points 1 and 3", "the same values", "line 29, column 20"}},
        {"",
         "sweep:\n  - loading.rate: [1, 2]\n  - loading.rate: [3, 4]\n",
         30,
         20,
         {"swept by two axes", "line 29"}},
        {"", "sweep:\n  - loading.rate: {from: 1, points: 3}\n", 29, 19, {"a range without `to`"}},
        {"", "sweep:\n  - loading.rate: {from: 1, to: 3}\n", 29, 19, {"a range without `points`"}},
        {"",
         "sweep:\n  - loading.rate: {from: 1, to: 3, points: 1}\n",
         29,
         44,
         {"`points`", "out of range", "2 to 10000"}},
        {"",
         "sweep:\n  - loading.rate: {from: 1, to: 1, points: 3}\n",
         29,
         19,
         {"`from` and `to` are equal"}},
        {"",
         "sweep:\n  - loading.rate: {from: 1, to: 3, point: 3}\n",
         29,
         36,
         {"unknown key `point` in a range", "`points`"}},
        {"",
         "sweep:\n  - loading.rate: {from: 1, to: 3, points: 3, spacing: lg}\n",
         29,
         56,
         {"`lg`", "lin", "log"}},
        {"",
         "sweep:\n  - loading.rate: {from: -1, to: 3, points: 3, spacing: log}\n",
         29,
         57,
         {"greater than 0"}},
        {"",
         "sweep:\n  - loading.rate: {from: -1, to: 3, points: 3}\n",
         29,
         19,
         {"-1 is out of range"}},
        {"",
         "sweep:\n  - cohesive.law: {from: 1, to: 3, points: 3}\n",
         29,
         19,
         {"`cohesive.law` is not a number"}},
        {"",
         "sweep:\n  - strength: {from: 1, to: 3, points: 3}\n",
         29,
         15,
         {"`strength` is a section", "a list of sections"}},
        {"", "sweep:\n  - strength: [5]\n", 29, 16, {"`strength` is a section, but found `5`"}},
        {"",
         "sweep:\n  - strength: [{distribution: weibull, scale: 3 MPa}]\n",
         29,
         47,
         {"distribution weibull needs `scale` and `shape`", "add `shape`"}},
        {"",
         "sweep:\n  - strength.mean: [300 MPa]\n",
         17,
         12,
         {"distribution uniform needs", "`minimum` and `maximum` say all: take out `mean`"}},
        {"",
         "sweep:\n  - strength.shape: [5, 10]\n",
         29,
         22,
         {"`shape` belongs to distribution weibull", "this is uniform"}},
        {"", "sweep:\n  - zip: [1]\n", 29, 10, {"`zip`", "found a list"}},
        {"", "sweep:\n  - zip: {}\n", 29, 10, {"`zip`", "found nothing"}},
        {"",
         "sweep:\n  - zip:\n      loading.rate: [1, 2]\n      time.end: [1, 2, 3]\n",
         31,
         7,
         {"`time.end` has 3 values", "has 2", "the same number"}},
        {"",
         "sweep:\n  - zip:\n      loading.rate: [1, 2]\n      time.end: {from: 1, to: 2, points: "
         "3}\n",
         31,
         7,
         {"`time.end` has 3 values"}},
        {"",
         "sweep:\n  - zip:\n      strength: [{minimum: 1}]\n      strength.minimum: [2]\n",
         31,
         26,
         {"`strength.minimum`", "twice"}},
        {"", "sweep:\n  - cases: 5\n", 29, 12, {"`cases`", "found `5`"}},
        {"", "sweep:\n  - cases: []\n", 29, 12, {"no values"}},
        {"", "sweep:\n  - cases:\n      - 5\n", 30, 9, {"a case", "found `5`"}},
        {"",
         "sweep:\n  - cases:\n      - nam: a\n",
         30,
         9,
         {"unknown path `nam`", "did you mean `name`?", "section.key"}},
        {"", "sweep:\n  - cases:\n      - name: a b\n", 30, 15, {"`name`", "`a b`"}},
        {"", "sweep:\n  - cases:\n      - replicas: 0\n", 30, 19, {"`replicas`", "out of range"}},
        {"",
         "sweep:\n  - cases:\n      - loading: {rte: 5}\n",
         30,
         19,
         {"unknown key `rte` in loading", "`rate`"}},
        {"",
         "sweep:\n  - cases:\n      - {name: a}\n      - {name: b}\n",
         31,
         9,
         {"points 1 and 2", "line 30, column 9"}},
        {"",
         "sweep:\n  - cases:\n      - {replicas: 4}\n  - cases:\n      - {replicas: 5}\n",
         32,
         9,
         {"cases of two axes"}},
        {"",
         "sweep:\n  - loading.rate: {from: 1, to: 2, points: 1000}\n"
         "  - time.end: {from: 1, to: 2, points: 1000}\n",
         30,
         5,
         {"more than 10000 points"}},
        {"", "sweep:\n  - model: [bar, rope]\n", 29, 18, {"unknown model `rope`"}},
    };
    CHECK_ALL(table);
}

/* Files that are wrong as a whole. */
/* A design at line 29 whose `type: random, points: 4` is followed by this; its law by what is put
 * there. */
#define DESIGN(rest) "sweep:\n  - design: {type: random, points: 4, " rest "}\n"
#define YOUNG(rest) DESIGN("parameters: {material.young: {" rest "}}")
#define TIED(rest)                                                                      \
    "sweep:\n  - design:\n      type: sobol\n      points: 4\n      parameters:\n"      \
    "        material.young: {distribution: uniform, minimum: 1 GPa, maximum: 2 GPa}\n" \
    "        material.density: {distribution: uniform, minimum: 1, maximum: 2}\n"       \
    "        loading.rate: {distribution: uniform, minimum: 1, maximum: 2}\n      "     \
    "correlation:" rest "\n"

static void test_designs(void **state)
{
    static const wrong table[] = {
        {"",
         "sweep:\n  - design: 4\n",
         29,
         13,
         {"`design`: found `4`", "`type:`, `points:` and `parameters:`"}},
        {"",
         "sweep:\n  - desing: {type: random}\n",
         29,
         5,
         {"unknown path `desing`", "did you mean `design`?"}},
        {"", "sweep:\n  - 4\n", 29, 5, {"an axis of the sweep", "`cases:` or `design:`"}},
        {"",
         DESIGN("point: 3"),
         29,
         39,
         {"unknown key `point` in a design", "did you mean `points`?", "correlation"}},
        {"",
         "sweep:\n  - design: {points: 4}\n",
         29,
         13,
         {"no `type` is given", "type can be: latin-hypercube, sobol, random"}},
        {"",
         "sweep:\n  - design: {type: latin-hypercub}\n",
         29,
         20,
         {"unknown type `latin-hypercub`", "did you mean `latin-hypercube`?"}},
        {"", "sweep:\n  - design: {type: [random]}\n", 29, 20, {"`type`: found a list"}},
        {"",
         "sweep:\n  - design: {type: random}\n",
         29,
         13,
         {"no `points` is given", "`points: 64`"}},
        {"",
         "sweep:\n  - design: {type: random, points: 10001}\n",
         29,
         36,
         {"10001 is out of range", "1 to 10000"}},
        {"", "sweep:\n  - design: {type: random, points: 0}\n", 29, 36, {"0 is out of range"}},
        {"",
         "sweep:\n  - design: {type: random, points: 4}\n",
         29,
         13,
         {"no `parameters` is given"}},
        {"", DESIGN("parameters: 3"), 29, 51, {"`parameters`: found `3`"}},
        {"", DESIGN("parameters: {}"), 29, 51, {"`parameters`: found nothing"}},
        {"",
         DESIGN("parameters: {young: {}}"),
         29,
         52,
         {"unknown path `young`", "known are section.key, and: model"}},
        {"",
         DESIGN("parameters: {replicas: {}}"),
         29,
         52,
         {"`replicas` is not a parameter to sweep"}},
        {"",
         DESIGN("parameters: {output.history: {}}"),
         29,
         52,
         {"`output.history` cannot be swept"}},
        {"",
         DESIGN("parameters: {material: {}}"),
         29,
         52,
         {"`material` is a section, which cannot be drawn", "`- material: [...]`"}},
        {"",
         DESIGN("parameters: {cohesive.law: {}}"),
         29,
         52,
         {"`cohesive.law` is a kind, which cannot be drawn"}},
        {"",
         DESIGN("parameters: {geometry.ends: {}}"),
         29,
         52,
         {"`geometry.ends` is no number, which cannot be drawn"}},
        {"", DESIGN("parameters: {strength.file: {}}"), 29, 52, {"`strength.file` is no number"}},
        {"",
         DESIGN("parameters: {material.young: 3 GPa}"),
         29,
         68,
         {"`material.young`: found `3 GPa`; expected a distribution"}},
        {"",
         YOUNG("mean: 3 GPa"),
         29,
         68,
         {"no `distribution` is given", "distribution can be: uniform, log-uniform, normal"}},
        {"",
         YOUNG("distribution: norml"),
         29,
         83,
         {"unknown distribution `norml`", "did you mean `normal`?"}},
        {"",
         YOUNG("distribution: normal, sigma: 3"),
         29,
         91,
         {"unknown key `sigma` in the distribution normal",
          "keys of the distribution normal: distribution, mean, deviation"}},
        {"",
         YOUNG("distribution: normal, mean: 3 GPa"),
         29,
         68,
         {"`material.young` with distribution normal needs `deviation`"}},
        {"",
         YOUNG("distribution: normal, mean: 3 mm, deviation: 1 GPa"),
         29,
         97,
         {"`mean`: `3 mm` is a length; expected a stress"}},
        {"",
         YOUNG("distribution: normal, mean: 3 GPa, deviation: 0 GPa"),
         29,
         115,
         {"`deviation`: 0 GPa is out of range; allowed is more than 0 Pa"}},
        {"",
         YOUNG("distribution: weibull, scale: 3 GPa, shape: 3 GPa"),
         29,
         113,
         {"`shape`: `3 GPa`", "pure number"}},
        {"",
         YOUNG("distribution: uniform, minimum: [3], maximum: 4"),
         29,
         101,
         {"`minimum`: found a list"}},
        {"",
         YOUNG("distribution: uniform, minimum: 4, maximum: 3"),
         29,
         68,
         {"`material.young`: its minimum is 4 and its maximum 3", "swap them"}},
        {"",
         YOUNG("distribution: normal, mean: 3 GPa, deviation: 1 GPa, maximum: -5 GPa"),
         29,
         68,
         {"its bounds leave 6.22e-16 of the normal"}},
        {"",
         YOUNG("distribution: lognormal, median: 1.7e308, sigma: 10"),
         29,
         68,
         {"`material.young`: point ",
          "of the design is beyond all numbers; narrow its distribution"}},
        {"",
         YOUNG("distribution: uniform, minimum: -3 GPa, maximum: -2 GPa"),
         29,
         68,
         {"`material.young`: point 1 of the design draws -2",
          " Pa, which is out of range; allowed is more than 0 Pa; choose a distribution"}},
        {"",
         DESIGN("parameters: {strength.shape: {distribution: uniform, minimum: 1, maximum: 2}}"),
         29,
         52,
         {"`shape` belongs to distribution"}},
        {"",
         DESIGN("parameters: {mesh.elements: {distribution: uniform, minimum: 7.6, maximum: 8.4}}"),
         29,
         13,
         {"points 1 and 2 of the sweep have the same values", "whole numbers", "fewer points"}},
        {"",
         YOUNG("distribution: uniform, minimum: 1, maximum: 2") "  - material.young: [1 GPa]\n",
         30,
         22,
         {"`material.young` is swept by two axes, here and at line 29"}},
        {"", TIED(" 3"), 36, 20, {"`correlation`: found `3`"}},
        {"", TIED(" []"), 36, 20, {"`correlation`: found nothing"}},
        {"",
         TIED("\n        - {between: [material.young, material.density]}"),
         37,
         11,
         {"a correlation is {between: ["}},
        {"",
         TIED("\n        - {between: [material.young], coefficient: 1}"),
         37,
         11,
         {"a correlation is {between: ["}},
        {"",
         TIED("\n        - {between: [material.young, material.density], coefficient: 0.1, of: 3}"),
         37,
         75,
         {"unknown key `of` in a correlation"}},
        {"",
         TIED("\n        - {between: [material.young, material.densty], coefficient: 1}"),
         37,
         38,
         {"`material.densty` is no parameter of this design", "did you mean `material.density`?"}},
        {"",
         TIED("\n        - {between: [material.young, material.young], coefficient: 1}"),
         37,
         21,
         {"`material.young` twice"}},
        {"",
         TIED("\n        - {between: [material.young, material.density], coefficient: 1.1}"),
         37,
         70,
         {"1.1 is out of range; allowed is at least -1, at most 1"}},
        {"",
         TIED("\n        - {between: [material.young, material.density], coefficient: -1}"),
         37,
         70,
         {"-1 is out of range; allowed is more than -1 and less than 1"}},
        {"",
         TIED("\n        - {between: [material.young, material.density], coefficient: 0.1}\n       "
              " - {between: [material.density, material.young], coefficient: 0.1}"),
         38,
         21,
         {"`material.density` and `material.young` is given twice"}},
        {"",
         TIED("\n        - {between: [material.young, material.density], coefficient: 0.9}\n       "
              " - {between: [material.young, loading.rate], coefficient: 0.8}\n        - {between: "
              "[loading.rate, material.density], coefficient: -0.9}"),
         37,
         9,
         {"contradict each other", "`loading.rate`", "leave it -13.",
          "`material.density` first (-0.9)"}},
        {"",
         "sweep:\n  - design: {type: sobol, points: 4, parameters: {a: 1, b: 1, c: 1, d: 1, e: 1, "
         "f: 1, g: 1, h: 1, i: 1, j: 1, k: 1, l: 1, m: 1, n: 1, o: 1, p: 1, q: 1, r: 1, s: 1, t: "
         "1, u: 1, v: 1, w: 1, x: 1, y1: 1, z: 1, aa: 1, ab: 1, ac: 1, ad: 1, ae: 1, af: 1, ag: 1, "
         "ah: 1, ai: 1, aj: 1, ak: 1, al: 1, am: 1, an: 1, ao: 1}}\n",
         29,
         38,
         {"41 parameters; sobol has at most 40"}},
    };
    CHECK_ALL(table);
}

static void test_whole_files(void **state)
{
    static const struct {
        const char *text, *words[2];
    } table[] = {
        {"", {":1:1: ", "the file is empty"}},
        {"# nothing\n", {":2:1: ", "the file is empty"}},
        {"- 1\n", {":1:1: ", "found a list"}},
        {"bar\n", {":1:1: ", "found a single value"}},
        {"\xff\xfe"
         "n\0a\0",
         {":1:1: ", "UTF-8"}},
    };
    char path[40];
    fracas_campaign *campaign = NULL;
    make_path(path);
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        write_bytes(path, table[i].text, strlen(table[i].text));
        assert_int_equal(fracas_campaign_read(path, &campaign), FRACAS_USAGE);
        for (int w = 0; w < 2; w++)
            if (!strstr(fracas_message(), table[i].words[w]))
                fail_msg("no \"%s\" in: %s", table[i].words[w], fracas_message());
    }
    size_t size = (16 << 20) + 1;
    char *large = malloc(size);
    assert_non_null(large);
    memset(large, '#', size);
    write_bytes(path, large, size);
    assert_int_equal(fracas_campaign_read(path, &campaign), FRACAS_USAGE);
    assert_non_null(strstr(fracas_message(), "larger than 16 MiB"));
    memcpy(large, "a: [", 4);
    for (size_t i = 4; i + 1 < size; i += 2) memcpy(large + i, "1,", 2);
    write_bytes(path, large, size / 4);
    free(large);
    assert_int_equal(fracas_campaign_read(path, &campaign), FRACAS_USAGE);
    assert_non_null(strstr(fracas_message(), "more than 1000000 values"));
    unlink(path);
    assert_int_equal(fracas_campaign_read(path, &campaign), FRACAS_USAGE);
    assert_non_null(strstr(fracas_message(), "there is no campaign file"));
    assert_int_equal(fracas_campaign_read("/", &campaign), FRACAS_ENVIRONMENT);
    assert_null(campaign);
}

static int load(void **state)
{
    fracas_units *units;
    if (fracas_units_create(&units)) return -1;
    *state = units;
    return 0;
}

static int unload(void **state)
{
    fracas_units_destroy(*state);
    return 0;
}

TESTS_ALL(load, unload, test_yaml, test_top, test_keys, test_choices, test_combinations,
          test_other_models, test_any_number, test_values, test_sweeps, test_designs,
          test_whole_files)
