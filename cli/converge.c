/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/run.h"

#include "analysis/converge/converge.h"
#include "base/param.h"
#include "base/text.h"
#include "campaigns/plan/forecast.h"
#include "campaigns/plan/refine.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/session/keep.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/types/clock.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fracas_option options[] = {
    FRACAS_RUN_OPTIONS,
    {"study", "DIR", "folder of the studies (studies/NAME-converge)"},
    {"only", "mesh|step|beta|end", "refine that alone (all in turn)"},
    {"tolerance", "PERCENT", "a change within which a number holds (2)"},
    {"json", NULL, "print the result as JSON"},
    {0}};

enum { NAME = 8, STUDY_PATH = PATH_MAX + NAME };

/* The order of the runs, short ones first. */
static const fracas_refinement order[] = {FRACAS_REFINE_NOTHING, FRACAS_REFINE_END,
                                          FRACAS_REFINE_STEP, FRACAS_REFINE_BETA,
                                          FRACAS_REFINE_MESH};

typedef struct {
    const fracas_arguments *arguments;
    char folder[PATH_MAX];
    char study[FRACAS_NREFINEMENTS][STUDY_PATH]; /* FOLDER/mesh */
    fracas_refined refined[FRACAS_NREFINEMENTS]; /* campaign NULL: not asked for, or impossible */
    double began, walltime;                      /* s */
    fracas_err end; /* FRACAS_SOME_FAILED if a realization of any study failed */
    char failure[STUDY_PATH + 1024];
} converging;

static const fracas_refined *base_of(const converging *c)
{
    return &c->refined[FRACAS_REFINE_NOTHING];
}

/* ---- before ---- */

static fracas_err check_rank(void)
{
    if (fracas_run_is_rank())
        return fracas_fail(FRACAS_USAGE,
                           "converge: it starts several runs, each with ranks of its own: give "
                           "it --jobs N instead of starting it by mpirun or srun");
    return FRACAS_OK;
}

static fracas_err find_folder(converging *c)
{
    const char *given = fracas_given(c->arguments, "study");
    OWN(fracas_campaign) campaign = NULL;
    if (given && !*given)
        return fracas_fail(FRACAS_USAGE, "--study is empty; name a folder, or leave it out");
    TRY(fracas_campaign_read(c->arguments->operand, &campaign));
    const int n = given ? snprintf(c->folder, sizeof c->folder, "%s", given)
                        : snprintf(c->folder, sizeof c->folder, "studies/%s-converge",
                                   campaign->name);
    if (n >= (int)sizeof c->folder)
        return fracas_fail(FRACAS_USAGE, "the path of the study is too long: %s", given);
    for (size_t r = 0; r < FRACAS_NREFINEMENTS; r++)
        snprintf(c->study[r], sizeof c->study[r], "%s/%s", c->folder, fracas_refinement_name[r]);
    return FRACAS_OK;
}

/* True if the study has the points of the campaign in `file` with more replicas, at most *replicas.
 */
static bool has_more(const char *study, const char *file, fracas_refinement by, int64_t *replicas)
{
    char path[STUDY_PATH + 2 * NAME];
    OWN(fracas_campaign) there = NULL;
    FRACAS_CLEARED(fracas_refined) refined = {0};
    snprintf(path, sizeof path, "%s/campaign.yaml", study);
    if (fracas_campaign_read(path, &there)) return false;
    *replicas = 0;
    for (size_t p = 0; p < there->npoints; p++)
        if (there->point[p].replicas > *replicas) *replicas = there->point[p].replicas;
    return !fracas_refined_create(file, *replicas, by, &refined) && refined.campaign &&
           !fracas_study_fits(study, refined.campaign);
}

/* If only the replicas differ, the error names the number to ask for: the maximum over all studies.
 */
static fracas_err check_study(const converging *c, fracas_refinement by)
{
    int64_t replicas, most = 0;
    TRY(fracas_study_place(c->study[by]));
    fracas_err err = fracas_study_fits(c->study[by], c->refined[by].campaign);
    if (!err) return FRACAS_OK;
    if (!has_more(c->study[by], c->arguments->operand, by, &replicas))
        return fracas_study_fits(c->study[by], c->refined[by].campaign);
    for (fracas_refinement r = 0; r < FRACAS_NREFINEMENTS; r++)
        if (has_more(c->study[r], c->arguments->operand, r, &replicas) && replicas > most)
            most = replicas;
    return fracas_fail(err,
                       "%s has %" PRId64 " replicas of each point already: give --replicas %" PRId64
                       " or more (or another --study)",
                       c->folder, most, most);
}

/* Makes every campaign and checks its study, if there is one, before anything is written. */
static fracas_err make_campaigns(converging *c)
{
    int replicas = 0, only = -1;
    TRY(fracas_arguments_integer(c->arguments, "replicas", 1, INT_MAX, &replicas));
    TRY(fracas_arguments_word(c->arguments, "only", fracas_refinement_name + 1,
                              FRACAS_NREFINEMENTS - 1, &only));
    bool any = false;
    for (size_t r = 0; r < FRACAS_NREFINEMENTS; r++) {
        if (r != FRACAS_REFINE_NOTHING && only >= 0 && (size_t)only + 1 != r) continue;
        fracas_refined *refined = &c->refined[r];
        TRY(fracas_refined_create(c->arguments->operand, replicas, (fracas_refinement)r, refined));
        if (refined->left > 0)
            fprintf(stderr, "fracas: %s: %zu point%s left out: %s\n", fracas_refinement_name[r],
                    refined->left, refined->left == 1 ? " is" : "s are", refined->why);
        if (!refined->campaign) continue;
        any = any || r != FRACAS_REFINE_NOTHING;
        TRY(check_study(c, (fracas_refinement)r));
    }
    if (any) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s: nothing of it can be refined (above: why)",
                       c->arguments->operand);
}

/* Upper bound of the predicted time of the unrefined campaign [s]. */
static fracas_err predict(const converging *c, double *time)
{
    const fracas_campaign *campaign = base_of(c)->campaign;
    fracas_run_options run;
    int jobs;
    fracas_run_options_init(&run);
    TRY(fracas_arguments_integer(c->arguments, "jobs", 1, INT_MAX, &run.jobs));
    TRY(fracas_allocation_jobs(run.jobs, campaign->parallel.parts, &jobs));
    OWNED fracas_forecast *forecast = calloc(campaign->npoints, sizeof *forecast);
    if (!forecast) return fracas_no_memory("the plan");
    *time = 0;
    TRY(fracas_forecast_all(campaign, jobs, false, forecast));
    for (size_t p = 0; p < campaign->npoints; p++) *time += forecast[p].time;
    return FRACAS_OK;
}

static double cost_of(const fracas_refined *refined)
{
    double sum = 0;
    for (size_t p = 0; p < refined->campaign->npoints; p++) sum += refined->cost[p];
    return sum;
}

static void write_duration(double seconds, char text[32])
{
    if (seconds < 99.5) snprintf(text, 32, "%.2g s", seconds);
    else if (seconds < 5940) snprintf(text, 32, "%.0f min", seconds / 60);
    else if (seconds < 172800) snprintf(text, 32, "%.1f h", seconds / 3600);
    else snprintf(text, 32, "%.1f days", seconds / 86400);
}

/* Prints predicted times, by the speed of the unrefined campaign. */
static fracas_err print_costs(const converging *c)
{
    double base = 0, total = 0;
    char text[32];
    TRY(predict(c, &base));
    fprintf(stderr, "fracas: predicted for whole studies, at most:\n");
    for (size_t i = 0; i < FRACAS_COUNT(order); i++) {
        const fracas_refined *refined = &c->refined[order[i]];
        if (!refined->campaign) continue;
        const double factor = cost_of(refined) / cost_of(base_of(c)), time = factor * base;
        total += time;
        write_duration(time, text);
        fprintf(stderr, "fracas:   %-4s  %-25s %4zu point%s  %6.3g times the work  %8s\n",
                fracas_refinement_name[order[i]], fracas_refinement_doc[order[i]],
                refined->campaign->npoints, refined->campaign->npoints == 1 ? " " : "s", factor,
                text);
    }
    write_duration(total, text);
    fprintf(stderr, "fracas:   together %s\n", text);
    return FRACAS_OK;
}

/* ---- the runs ---- */

static fracas_err run_one(const fracas_run_options *run, int argc, char **argv)
{
    FRACAS_CLEARED(fracas_run_facts) facts;
    fracas_err end = fracas_run(run, argc, argv, &facts);
    if (!end && !facts.ran)
        fprintf(stderr, "fracas: %s is complete, nothing to compute\n", run->study);
    return end;
}

/* Each run gets the rest of the walltime. */
static fracas_err run_study(converging *c, fracas_refinement by)
{
    char file[STUDY_PATH + NAME], name[2 * NAME], left[32];
    fracas_arguments given = *c->arguments;
    snprintf(name, sizeof name, "%s.yaml", fracas_refinement_name[by]);
    snprintf(file, sizeof file, "%s/%s", c->folder, name);
    TRY(fracas_campaign_keep(c->refined[by].campaign, c->folder, name, NULL));
    if (c->walltime > 0) {
        const double rest = c->walltime - (fracas_now() - c->began);
        if (rest < 0.1)
            return fracas_fail(
                FRACAS_INTERRUPTED,
                "the walltime is over: what was done is kept; the same command goes on from there");
        snprintf(left, sizeof left, "%.3fs", rest);
        fracas_arguments_set(&given, "walltime", left);
    }
    fracas_arguments_set(&given, "replicas", NULL); /* the file has them */
    fprintf(stderr, "fracas: %s, %s\n", fracas_refinement_name[by], fracas_refinement_doc[by]);
    fracas_err end = fracas_cli_run_as(&given, file, c->study[by], run_one);
    if (end != FRACAS_SOME_FAILED)
        return end ? fracas_fail_within(end, "%s", c->study[by]) : FRACAS_OK;
    c->end = end;
    snprintf(c->failure, sizeof c->failure, "%s: %s", c->study[by], fracas_message());
    return FRACAS_OK;
}

/* Before the first run: no output replaces a file of the user's. */
static fracas_err check_files(const converging *c)
{
    for (size_t i = 0; i < FRACAS_COUNT(order); i++) {
        char name[2 * NAME];
        snprintf(name, sizeof name, "%s.yaml", fracas_refinement_name[order[i]]);
        if (c->refined[order[i]].campaign)
            TRY(fracas_campaign_keeps(c->refined[order[i]].campaign, c->folder, name));
    }
    return fracas_convergence_keeps(c->folder);
}

/* ---- the result ---- */

static fracas_err add_refinement(const converging *c, fracas_refinement by,
                                 fracas_convergence *convergence)
{
    const fracas_refined *refined = &c->refined[by], *base = base_of(c);
    const size_t npoints = refined->campaign->npoints;
    OWNED fracas_hash *before = calloc(npoints, sizeof *before);
    OWNED fracas_hash *after = calloc(npoints, sizeof *after);
    if (!before || !after) return fracas_no_memory("the points of the campaign");
    for (size_t p = 0; p < npoints; p++) {
        before[p] = base->campaign->point[refined->from[p]].hash;
        after[p] = refined->campaign->point[p].hash;
    }
    const fracas_refinement_map map = {fracas_refinement_name[by],
                                       fracas_refinement_doc[by],
                                       by != FRACAS_REFINE_MESH,
                                       npoints,
                                       before,
                                       after};
    return fracas_convergence_add(convergence, c->study[by], &map);
}

static fracas_err compare(const converging *c, double tolerance)
{
    OWN(fracas_convergence) convergence = NULL;
    TRY(fracas_convergence_create(c->study[FRACAS_REFINE_NOTHING], tolerance, &convergence));
    for (fracas_refinement r = FRACAS_REFINE_MESH; r < FRACAS_NREFINEMENTS; r++) {
        const fracas_refined *refined = &c->refined[r];
        if (refined->campaign) TRY(add_refinement(c, r, convergence));
        if (refined->left > 0)
            fracas_convergence_leave(convergence, fracas_refinement_name[r], refined->left,
                                     refined->why);
    }
    TRY(fracas_convergence_judge(convergence));
    TRY(fracas_convergence_write_csv(convergence, c->folder));
    const char *slash = strrchr(c->folder, '/');
    TRY(fracas_convergence_write_page(convergence, c->folder,
                                      slash && slash[1] ? slash + 1 : c->folder));
    if (fracas_given(c->arguments, "json")) {
        fracas_convergence_write_json(convergence, stdout);
        return FRACAS_OK;
    }
    TRY(fracas_convergence_print(convergence, fracas_cli_columns(c->arguments), stdout));
    printf("report: %s/report/index.html; all digits: %s/converge.csv; a study's own report: "
           "fracas report %s\n",
           c->folder, c->folder, fracas_shell_path(c->study[FRACAS_REFINE_NOTHING], NULL).text);
    return FRACAS_OK;
}

static fracas_err converge_with(converging *c)
{
    double tolerance = 0.02;
    TRY(check_rank());
    TRY(fracas_arguments_real(c->arguments, "tolerance", 0.01, &tolerance));
    if (tolerance <= 0)
        return fracas_fail(
            FRACAS_USAGE,
            "converge: --tolerance is 0; a number never is the same: give a per cent above 0");
    TRY(fracas_arguments_time(c->arguments, "walltime", &c->walltime));
    TRY(find_folder(c));
    TRY(make_campaigns(c));
    TRY(print_costs(c));
    TRY(check_files(c));
    for (size_t i = 0; i < FRACAS_COUNT(order); i++)
        if (c->refined[order[i]].campaign) TRY(run_study(c, order[i]));
    TRY(compare(c, tolerance));
    return c->end ? fracas_fail(c->end, "%s", c->failure) : FRACAS_OK;
}

static fracas_err converge(const fracas_arguments *arguments)
{
    OWNED converging *c = calloc(1, sizeof *c);
    if (!c) return fracas_no_memory("the convergence");
    c->arguments = arguments;
    c->began = fracas_now();
    fracas_err err = converge_with(c);
    for (size_t r = 0; r < FRACAS_NREFINEMENTS; r++) fracas_refined_clear(&c->refined[r]);
    return err;
}

const fracas_command fracas_command_converge = {
    .name = "converge",
    .operand = "FILE",
    .doc = "Runs FILE with mesh, step, beta and end refined in turn, and says which numbers move",
    .more =
        "\nThe campaign of FILE as it is, to twice its end, with half the time step, with "
        "interfaces twice as stiff, and on a mesh of half the size is\n"
        "computed, each as a study in DIR; then every headline number is compared with what it is "
        "without: a "
        "table, and figures on the page DIR/report/index.html.\n"
        "It ends with 0 whatever moved. The same command goes on with what was interrupted, "
        "prints the result of what is complete, and extends\n"
        "all studies by more --replicas. FILE itself is run anew, as a study of its own: the "
        "same strengths in all studies, of which all but\n"
        "those of mesh make pairs. Strengths that scatter much and have no reference volume belong "
        "to interfaces: mesh moves with their number.\n",
    .options = options,
    .refused = "part",
    .why = "is of one study; here there are several, which are compared when all of them are "
           "complete: leave it out",
    .run = converge,
};
