/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* Refined campaigns: of every shipped example, and where a refinement cannot be. */
#include "campaigns/plan/forecast.h"
#include "campaigns/plan/refine.h"
#include "campaigns/scheduler/session/keep.h"
#include "tests/support/campaign_text.h"
#include "engine/mesh/make.h"
#define FOLDER "fracas-refine"
#include "tests/support/folder.h"

#include <glob.h>

static bool is_named(const char *path, const char *const *names)
{
    for (; *names; names++)
        if (!strcmp(path, *names)) return true;
    return false;
}

/* What may differ: twice or half of what it was, and what follows. */
static double factor_of(fracas_refinement what, const char *path)
{
    static const char *const doubled[FRACAS_NREFINEMENTS][5] = {
        [FRACAS_REFINE_MESH] = {"mesh.elements", "mesh.divisions"},
        [FRACAS_REFINE_BETA] = {"cohesive.beta", "cohesive.beta_shear"},
        [FRACAS_REFINE_END] = {"time.end", "time.transits", "time.quiet", "time.multiple"}};
    static const char *const halved[FRACAS_NREFINEMENTS][2] = {
        [FRACAS_REFINE_MESH] = {"mesh.size"}, [FRACAS_REFINE_STEP] = {"time.safety"}};
    return is_named(path, doubled[what]) ? 2 : is_named(path, halved[what]) ? 0.5 : 1;
}

static fracas_value value_at(const fracas_campaign *campaign, size_t p, const char *path)
{
    const size_t c = fracas_point_table_find(&campaign->table, path);
    return c == SIZE_MAX ? (fracas_value){.real = NAN, .text = ""}
                         : campaign->table.point[p].value[c];
}

/* Every value of every point is that of the file but for those that are to be refined. */
static void check_values(const char *file, const fracas_campaign *plain, fracas_refinement what,
                         const fracas_refined *refined)
{
    const fracas_campaign *fine = refined->campaign;
    assert_int_equal(fine->npoints + refined->left, plain->npoints);
    assert_int_equal(fine->output.history, plain->output.history);
    for (size_t p = 0; p < fine->npoints; p++) {
        const size_t from = refined->from[p];
        size_t changed = 0;
        assert_true(p == 0 || from > refined->from[p - 1]);
        assert_int_equal(fine->point[p].replicas, plain->point[from].replicas);
        assert_int_equal(fracas_point_most(&fine->point[p]),
                         fracas_point_most(&plain->point[from]));
        for (size_t c = 0; c < plain->table.ncolumns; c++) {
            const char *path = plain->table.column[c].path;
            const fracas_value was = plain->table.point[from].value[c],
                               is = value_at(fine, p, path);
            const bool lattice = !strcmp(path, "derived.lattice");
            const double factor = lattice ? 1 / factor_of(what, "mesh.elements")
                                          : factor_of(what, path);
            if (!strncmp(path, "derived.strength", 16) || !strcmp(path, "derived.fracture_energy"))
                continue; /* of an interface: with a size effect, of its size */
            changed += factor != 1 && was.real != 0 && !isnan(was.real);
            const bool near = isnan(was.real) ? isnan(is.real)
                                              : fabs(is.real - factor * was.real) <=
                                                    1e-14 * fabs(is.real); /* 15 digits are kept */
            const bool same = near && !strcmp(was.text, is.text);
            if (!same)
                fail_msg("%s, %s, point %zu: %s was %.17g%s, is %.17g%s", file,
                         fracas_refinement_name[what], p, path, was.real, was.text, is.real,
                         is.text);
        }
        assert_true(what == FRACAS_REFINE_NOTHING || changed > 0);
    }
}

/* It reads back from the file that a run gets as what it is. */
static void check_file(const fracas_campaign *campaign)
{
    char path[200];
    OWN(fracas_campaign) again;
    OK(fracas_campaign_keep(campaign, folder, "fine.yaml", NULL));
    snprintf(path, sizeof path, "%s/fine.yaml", folder);
    OK(fracas_campaign_read(path, &again));
    assert_true(fracas_hash_equal(&again->hash, &campaign->hash));
    assert_string_equal(again->name, campaign->name);
}

/* Elements of the first point: two for one along a line, four for one on a surface. There a number
 * of layers is rounded, which here are 8 or more: (16 +- 1/2)/(8 +- 1/2) of them for one is 2
 * within 10 %. */
static void check_elements(const fracas_campaign *plain, const fracas_refined *refined)
{
    fracas_forecast coarse, fine;
    OK(fracas_forecast_make(plain, refined->from[0], &coarse));
    OK(fracas_forecast_make(refined->campaign, 0, &fine));
    const bool surface = fracas_spec_is_surface(&plain->point[0].spec);
    const double ratio = (double)fine.elements / (double)coarse.elements,
                 halves = fine.element / coarse.element;
    if (!surface) assert_true(fine.elements == 2 * coarse.elements);
    else if (!(ratio > 4 * 0.81 && ratio < 4 * 1.21))
        fail_msg("%s: %g times as many elements", plain->name, ratio);
    if (!(halves > 0.5 / 1.1 && halves < 0.5 * 1.1))
        fail_msg("%s: elements are %g times as large", plain->name, halves);
}

/* What cannot be refined, and what is said of the first such point. */
static void check_left(const char *name, fracas_refinement what, const fracas_refined *refined)
{
    static const struct {
        const char *name;
        fracas_refinement what;
        size_t left;
        const char *why;
    } known[] = {
        {"bar-replay.yaml", FRACAS_REFINE_MESH, 6,
         "point 0: strengths/dynfrag1d-N1250.csv has 1249 strengths, but the mesh has 2499 "
         "interfaces"},
        {"bar-replay.yaml", FRACAS_REFINE_BETA, 3, "point 0: its interfaces have no cohesive.beta"},
        {"plate-akantu.yaml", FRACAS_REFINE_MESH, 8, "point 0: its mesh is from a file"},
        {"ring-variants.yaml", FRACAS_REFINE_BETA, 10,
         "point 1: its interfaces have no cohesive.beta"},
        {"ring-zoning.yaml", FRACAS_REFINE_BETA, 11,
         "point 0: its interfaces have no cohesive.beta"},
    };
    size_t left = 0;
    for (size_t k = 0; k < FRACAS_COUNT(known); k++) {
        if (strcmp(known[k].name, name) != 0 || known[k].what != what) continue;
        left = known[k].left;
        if (strncmp(refined->why, known[k].why, strlen(known[k].why)) != 0)
            fail_msg("%s: %s", name, refined->why);
    }
    if (refined->left != left)
        fail_msg("%s, %s: %zu left out, %s", name, fracas_refinement_name[what], refined->left,
                 refined->why);
}

/* The same campaign on meshes of triangles that are made in no time. */
static void coarsen(const char *file, char path[200])
{
    OWN(fracas_campaign) campaign;
    OK(fracas_campaign_read(file, &campaign));
    for (size_t p = 0; p < campaign->npoints; p++) {
        campaign->point[p].spec.mesh.size *= 3;
        int64_t *divisions = &campaign->point[p].spec.mesh.divisions;
        if (*divisions > 0) *divisions = *divisions > 20 ? *divisions / 10 : 2;
        campaign->point[p].spec.cohesive.fracture_energy *= 50; /* which such elements resolve */
    }
    OK(fracas_campaign_keep(campaign, folder, "coarse.yaml", NULL));
    snprintf(path, 200, "%s/coarse.yaml", folder);
}

static void check_example(const char *example)
{
    fracas_campaign *plain;
    char coarse[200];
    const char *file = example, *name = strrchr(example, '/') + 1;
    if (!strncmp(name, "sphere", 6) || !strncmp(name, "plate", 5) ||
        !strncmp(name, "cylinder", 8)) {
        coarsen(example, coarse);
        file = coarse;
    }
    OK(fracas_campaign_read(file, &plain));
    const bool given = !strcmp(name, "plate-akantu.yaml"); /* its mesh, from a file, is large */
    for (fracas_refinement what = FRACAS_REFINE_NOTHING; what < FRACAS_NREFINEMENTS; what++) {
        fracas_refined refined;
        if (given && what != FRACAS_REFINE_MESH) continue;
        OK(fracas_refined_create(file, 0, what, &refined));
        if (refined.campaign) {
            assert_true(refined.campaign->common_random_numbers);
            assert_true((refined.campaign->seed == plain->seed) == (what != FRACAS_REFINE_MESH));
            check_values(example, plain, what, &refined);
            check_file(refined.campaign);
            if (what == FRACAS_REFINE_MESH) check_elements(plain, &refined);
        }
        check_left(name, what, &refined);
        fracas_refined_clear(&refined);
    }
    fracas_campaign_destroy(plain);
}

static void every_example(void **state)
{
    glob_t files;
    assert_int_equal(glob(FRACAS_SOURCE_DIR "/campaigns/examples/*.yaml", 0, NULL, &files), 0);
    assert_true(files.gl_pathc > 15);
    for (size_t i = 0; i < files.gl_pathc; i++) check_example(files.gl_pathv[i]);
    globfree(&files);
}

/* A copy of the plain campaign with `find` replaced by `put`, refined. */
static void refine_replaced(const char *find, const char *put, int64_t replicas,
                            fracas_refinement what, fracas_refined *refined)
{
    char path[40], *text = replace(plain_campaign, find, put);
    make_path(path);
    write_bytes(path, text, strlen(text));
    free(text);
    fracas_err err = fracas_refined_create(path, replicas, what, refined);
    unlink(path);
    if (err) fail_msg("%s", fracas_message());
}

/* Points that cannot be refined are left out one by one, and the others keep their place in the
 * file, their case and their replicas. */
static void some_left_out(void **state)
{
    fracas_refined refined;
    const char *sweep = "sweep:\n  - cases:\n      - {name: a, cohesive.law: rigid-link}\n      - "
                        "{name: b}\n      - {name: c, cohesive.beta: 6000}\n"
                        "      - {name: d, cohesive.beta: 8, replicas: 5}\n";
    refine_replaced("", sweep, 0, FRACAS_REFINE_BETA, &refined);
    assert_int_equal(refined.left, 2);
    assert_string_equal(refined.why, "point 0: its interfaces have no cohesive.beta");
    assert_int_equal(refined.campaign->npoints, 2);
    assert_int_equal(refined.from[0], 1);
    assert_int_equal(refined.from[1], 3);
    assert_true(refined.campaign->point[1].spec.cohesive.beta == 16);
    assert_int_equal(refined.campaign->point[1].replicas, 5);
    assert_string_equal(value_at(refined.campaign, 1, "case").text, "d");
    assert_true(refined.cost[1] > 0 && refined.cost[1] > refined.cost[0]);
    check_file(refined.campaign);
    fracas_refined_clear(&refined);
    refine_replaced("  fracture_energy", "  beta: 6000\n  fracture_energy", 0, FRACAS_REFINE_BETA,
                    &refined);
    assert_null(refined.campaign);
    assert_int_equal(refined.left, 1);
    assert_string_equal(refined.why,
                        "point 0: cohesive.beta is 6000 already, and its range ends at 10000");
    fracas_refined_clear(&refined);
}

/* Strengths are shared with all but the mesh, as the streams say; replicas beside
 * the file count. */
static void names_and_numbers(void **state)
{
    fracas_refined refined;
    for (fracas_refinement what = FRACAS_REFINE_NOTHING; what < FRACAS_NREFINEMENTS; what++) {
        char name[20];
        refine_replaced("name: test", "name: x", 9, what, &refined);
        snprintf(name, sizeof name, "x-%s", fracas_refinement_name[what]);
        assert_string_equal(refined.campaign->name, name);
        assert_int_equal(refined.campaign->point[0].replicas, 9);
        assert_true((refined.campaign->seed == 7) == (what != FRACAS_REFINE_MESH));
        fracas_refined_clear(&refined);
    }
    /* A hundred letters are the most that a name can have. */
    char longest[140];
    snprintf(longest, sizeof longest, "name: %0100d", 7);
    refine_replaced("name: test", longest, 0, FRACAS_REFINE_STEP, &refined);
    assert_int_equal(strlen(refined.campaign->name), 100);
    assert_string_equal(refined.campaign->name + 95, "-step");
    check_file(refined.campaign);
    fracas_refined_clear(&refined);
}

TESTS_ALL(make_folder, remove_folder, every_example, some_left_out, names_and_numbers)
