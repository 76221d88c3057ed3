/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading, writing and planning a campaign when the k-th allocation fails, for every k: an error,
 * never a crash. The file has no units: the scanner inside UDUNITS-2 ends the program when memory
 * is short. */
#include "campaigns/plan/plan.h"
#include "engine/integrator/frequencies.h"
#include "tests/support/campaign_text.h"

#include <limits.h>

#ifdef __SANITIZE_ADDRESS__
/* AddressSanitizer owns malloc; this program has nothing to do there. */
int fracas_test(void)
{
    return 0;
}
#else

#include "tests/support/fail_each.h"

static const char sweep[] =
    "sweep:\n  - cases: [{name: a}, {name: b, strength.minimum: 1e6}]\n"
    "  - loading.rate: {from: 1, to: 2, points: 3}\n"
    "  - design: {type: latin-hypercube, points: 2, parameters: {material.young: {distribution: "
    "uniform, minimum: 2e11, maximum: 3e11}}}\n"
    "  - design: {type: sobol, points: 2, parameters: {material.density: {distribution: uniform, "
    "minimum: 2e3, maximum: 3e3}, cohesive.fracture_energy: {distribution: uniform, minimum: 90, "
    "maximum: 100}}, correlation: [{between: [material.density, cohesive.fracture_energy], "
    "coefficient: 0.5}]}\n";

typedef struct {
    fracas_units *units;
    char path[40];
    fracas_hash hash; /* of the campaign in the file */
} source;

static fracas_err read_source(const void *context)
{
    const source *from = context;
    OWN(fracas_campaign) campaign = NULL;
    fracas_err err = fracas_campaign_read_with(from->units, from->path, &campaign);
    if (!err) assert_true(fracas_hash_equal(&campaign->hash, &from->hash));
    return err;
}

static void test_read(void **state)
{
    source from;
    make_path(from.path);
    OK(fracas_units_create(&from.units));
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    from.hash = campaign->hash;
    FILE *out = fopen(from.path, "w");
    assert_non_null(out);
    OK(fracas_campaign_write(campaign, out)); /* in SI */
    assert_int_equal(fclose(out), 0);
    fail_each_of(read_source, &from, LONG_MAX);
    /* As it was written by hand, whose designs are cases in what is resolved. */
    OWN(fracas_campaign) plain = read_replaced("", "");
    out = fopen(from.path, "w");
    assert_non_null(out);
    OK(fracas_campaign_write(plain, out));
    fputs(sweep, out);
    assert_int_equal(fclose(out), 0);
    OWN(fracas_campaign) swept = NULL;
    OK(fracas_campaign_read_with(from.units, from.path, &swept));
    from.hash = swept->hash;
    fail_each_of(read_source, &from, LONG_MAX);
    unlink(from.path);
    fracas_units_destroy(from.units);
}

static fracas_err make_copy(const void *context)
{
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    TRY(fracas_campaign_copy_make(context, &copy));
    assert_true(copy.nfiles == 1 && copy.file->size == 8);
    return FRACAS_OK;
}

/* The same of a campaign that names a file, and of its copy for study.h5. */
static void test_read_file(void **state)
{
    source from;
    char strengths[40], named[100], copy[60];
    make_path(from.path);
    make_path(strengths);
    write_bytes(strengths, "3e8\n4e8\n", 8);
    OK(fracas_units_create(&from.units));
    snprintf(named, sizeof named, "sweep:\n  - strength: [{distribution: file, file: %s}]\n",
             strengths);
    OWN(fracas_campaign) campaign = read_replaced("", named);
    from.hash = campaign->hash;
    OWNED char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    OK(fracas_campaign_write(campaign, out)); /* in SI */
    assert_int_equal(fclose(out), 0);
    snprintf(copy, sizeof copy, FRACAS_ATTACHMENTS "/%s", campaign->point[0].strength.file->digest);
    OWNED char *there = replace(text, copy, strengths);
    write_bytes(from.path, there, strlen(there));
    fail_each_of(read_source, &from, LONG_MAX);
    fail_each_of(make_copy, campaign, LONG_MAX);
    unlink(from.path);
    unlink(strengths);
    fracas_units_destroy(from.units);
}

static fracas_err write_and_compare(const void *context)
{
    const fracas_campaign *campaign = context;
    TRY(fracas_campaign_extends(campaign, campaign));
    FILE *out = fopen("/dev/null", "w");
    if (!out) return fracas_no_memory("a stream");
    fracas_err err = fracas_campaign_write(campaign, out);
    fclose(out);
    return err;
}

/* Each time anew: a campaign keeps the frequencies of its models. */
static fracas_err forget(const void *context, fracas_campaign *campaign,
                         fracas_frequencies **frequencies)
{
    TRY(fracas_frequencies_create(frequencies));
    *campaign = *(const fracas_campaign *)context;
    campaign->frequencies = *frequencies;
    return FRACAS_OK;
}

static fracas_err print_plan(const void *context)
{
    OWN(fracas_frequencies) frequencies = NULL;
    fracas_campaign campaign;
    TRY(forget(context, &campaign, &frequencies));
    FILE *out = fopen("/dev/null", "w");
    if (!out) return fracas_no_memory("a stream");
    fracas_err err = fracas_plan_print(&campaign, &(fracas_plan_options){.jobs = 1}, out);
    fclose(out);
    return err;
}

static fracas_err print_reference(const void *context)
{
    FILE *out = fopen("/dev/null", "w");
    if (!out) return fracas_no_memory("a stream");
    fracas_err err = fracas_campaign_reference(out);
    fclose(out);
    return err;
}

static void test_use(void **state)
{
    fail_each_of(print_reference, NULL, LONG_MAX);
    OWN(fracas_campaign) campaign = read_replaced("", sweep);
    fail_each_of(write_and_compare, campaign, LONG_MAX);
    /* The plan repeats short batches until the clock has seen enough: some of them. */
    fail_each_of(print_plan, campaign, 40);
}

static fracas_err count_cost(const void *context)
{
    OWN(fracas_frequencies) frequencies = NULL;
    fracas_campaign campaign;
    double cost;
    TRY(forget(context, &campaign, &frequencies));
    return fracas_plan_cost(&campaign, 0, &cost, NULL);
}

/* Strengths of flaws need the mesh when the file is read; a perturbed one is made twice, then
 * planned, and timed. */
static void test_surface(void **state)
{
    static const char text[] =
        "name: test\nseed: 7\nmodel: membrane\ngeometry: {width: 0.01, height: 0.005, thickness: "
        "1e-4}\n"
        "mesh: {divisions: 2, amplitude: 0.2}\nmaterial: {young: 370e9, poisson: 0.25, density: "
        "3900}\n"
        "cohesive: {fracture_energy: 5000}\nloading: {rate: 1e4}\ntime: {end: 1e-7}\nreplicas: 2\n"
        "strength: {distribution: flaws, flaw_density: 1e11, minimum: 1e8, maximum: 4e8, exponent: "
        "2}\n";
    source from;
    make_path(from.path);
    write_bytes(from.path, text, strlen(text));
    OK(fracas_units_create(&from.units));
    OWN(fracas_campaign) campaign = read_text(text);
    from.hash = campaign->hash;
    fail_each_of(read_source, &from, LONG_MAX);
    fail_each_of(count_cost, campaign, LONG_MAX);
    fail_each_of(print_plan, campaign, LONG_MAX);
    unlink(from.path);
    fracas_units_destroy(from.units);
}

TESTS(test_read, test_read_file, test_use, test_surface)

#endif
