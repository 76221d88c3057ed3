/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands run, extend and retry, and a run by another command. */
#include "cli/run.h"

#include "base/param.h"
#include "base/terminal.h"
#include "base/text.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/session/upkeep.h"
#include "campaigns/scheduler/written_fields.h"
#include "campaigns/store/index.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const fracas_option fracas_cli_run_options[FRACAS_NRUN_OPTIONS + 1] = {
    FRACAS_STUDY_OPTION, FRACAS_RUN_OPTIONS, {0}};

static fracas_err read_part(const fracas_arguments *arguments, fracas_run_options *run)
{
    const char *text = fracas_given(arguments, "part");
    int end = 0;
    if (!text) return FRACAS_OK;
    if (sscanf(text, "%d/%d%n", &run->part, &run->parts, &end) == 2 && !text[end] &&
        run->part >= 1 && run->part <= run->parts)
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s: --part is `%s`; it must be K/N with K from 1 to N, such as 1/2",
                       arguments->command->name, text);
}

fracas_err fracas_cli_read_run_options(const fracas_arguments *arguments, fracas_run_options *run)
{
    static const char *const lanes[] = {"1", "4", "8"};
    static const int widths[] = {1, 4, 8};
    int width = -1, isa = FRACAS_ISA_BEST, isolation = FRACAS_ISOLATION_LEASE, replicas = 0;

    fracas_run_options_init(run);
    run->study = fracas_given(arguments, "study");
    run->shuffle = fracas_given(arguments, "shuffle");
    run->force = fracas_given(arguments, "force");
    run->quiet = fracas_given(arguments, "quiet");
    run->wide = fracas_given(arguments, "wide");
    run->no_report = fracas_given(arguments, "no-report");
    run->ignore_space = fracas_given(arguments, "ignore-space");
    TRY(fracas_arguments_integer(arguments, "jobs", 1, INT_MAX, &run->jobs));
    TRY(fracas_arguments_integer(arguments, "replicas", 1, INT_MAX, &replicas));
    run->replicas = replicas;
    TRY(read_part(arguments, run));
    TRY(fracas_arguments_time(arguments, "walltime", &run->walltime));
    TRY(fracas_arguments_word(arguments, "isolation", fracas_isolation_name, 2, &isolation));
    run->isolation = (fracas_isolation)isolation;
    TRY(fracas_arguments_real(arguments, "checkpoint-time", 1.0, &run->checkpoint_seconds));
    TRY(fracas_arguments_real(arguments, "lease-time", 1.0, &run->lease_seconds));
    TRY(fracas_arguments_time(arguments, "lease-limit", &run->lease_limit));
    TRY(fracas_arguments_real(arguments, "memory-limit", 1048576.0, &run->memory_limit));
    TRY(fracas_arguments_word(arguments, "lanes", lanes, FRACAS_COUNT(lanes), &width));
    if (width >= 0) run->width = widths[width];
    TRY(fracas_arguments_word(arguments, "isa", fracas_isa_name, FRACAS_NISAS, &isa));
    run->isa = (fracas_isa)isa;
    TRY(fracas_arguments_real(arguments, "segment-age", 1.0, &run->segment_age));
    return fracas_arguments_real(arguments, "segment-size", 1048576.0, &run->segment_bytes);
}

/* Without a report of its own a run leaves the earlier one. */
static void say_old_report(const char *study)
{
    char page[PATH_MAX + 32];
    snprintf(page, sizeof page, "%s/report/index.html", study);
    if (access(page, F_OK)) return;
    fprintf(stderr, "fracas: %s is of earlier results: `fracas report %s` makes it again\n", page,
            fracas_shell_path(study, NULL).text);
}

fracas_err fracas_cli_run(const fracas_run_options *run, int argc, char **argv)
{
    FRACAS_CLEARED(fracas_run_facts) facts;
    fracas_err end = fracas_run(run, argc, argv, &facts);
    if (!fracas_run_owns_terminal()) return FRACAS_OK;
    if (end != FRACAS_OK && end != FRACAS_SOME_FAILED) return end;

    const char *study = facts.study;
    char message[1024]; /* the error, for after the report */
    snprintf(message, sizeof message, "%s", fracas_message());
    if (!facts.ran && !run->quiet)
        fprintf(stderr, "fracas: %s is complete, nothing to compute\n", study);
    const fracas_report_view view = {
        .quiet = run->quiet, .columns = run->wide ? 0 : fracas_terminal_of(STDOUT_FILENO).columns};
    if (!run->no_report) TRY(fracas_cli_report(study, &view));
    else if (facts.ran) say_old_report(study);
    const fracas_err fields = fracas_written_fields(study, facts.campaign, stderr);
    if (!end) return fields;
    if (fields) fprintf(stderr, "fracas: %s\n", fracas_message());
    return fracas_fail(end, "%s", message);
}

/* "K/N" of a study of one part, else "". The run will report a damaged index. */
static void read_own_part(const char *study, char *text, size_t size)
{
    OWN(fracas_index) index = NULL;
    int part, parts;
    *text = '\0';
    if (fracas_index_open(study, false, &index)) return;
    if (!fracas_index_part(index, &part, &parts) && parts > 1)
        snprintf(text, size, "%d/%d", part, parts);
}

fracas_err fracas_cli_run_as(const fracas_arguments *arguments, const char *file, const char *study,
                             fracas_cli_runner *runner)
{
    fracas_run_options run;
    char program[] = "fracas", command[] = "run", option[] = "--study";
    enum { BEFORE = 5 };
    char *argv[BEFORE + FRACAS_NRUN_OPTIONS + 1] = {program, command, (char *)file, option,
                                                    (char *)study};
    int argc = BEFORE;
    TRY(fracas_cli_read_run_options(arguments, &run));
    run.file = file;
    run.study = study;
    fracas_err code = FRACAS_OK;
    for (const fracas_option *o = FRACAS_STUDY_RUN_OPTIONS; !code && o->name; o++) {
        const char *value = fracas_given(arguments, o->name);
        if (!value) continue;
        if (asprintf(&argv[argc], "--%s%s%s", o->name, o->argument ? "=" : "", value) < 0)
            code = fracas_no_memory("the arguments of the run");
        else argc++;
    }
    if (!code) code = runner(&run, argc, argv);
    for (int i = BEFORE; i < argc; i++) free(argv[i]);
    return code;
}

fracas_err fracas_cli_run_study(const fracas_arguments *arguments)
{
    fracas_arguments given = *arguments;
    char file[PATH_MAX + 16], part[32];
    read_own_part(arguments->operand, part, sizeof part);
    if (!fracas_given(arguments, "part") && *part) fracas_arguments_set(&given, "part", part);
    if (strlen(arguments->operand) >= PATH_MAX)
        return fracas_fail(FRACAS_USAGE, "the path of the study is too long: %s",
                           arguments->operand);
    snprintf(file, sizeof file, "%s/campaign.yaml", arguments->operand);
    return fracas_cli_run_as(&given, file, arguments->operand, fracas_cli_run);
}

/* ---- run ---- */

static fracas_err run(const fracas_arguments *arguments)
{
    fracas_run_options run;
    TRY(fracas_cli_read_run_options(arguments, &run));
    run.file = arguments->operand;
    run.check = fracas_cli_check_report;
    return fracas_cli_run(&run, arguments->argc, arguments->argv);
}

const fracas_command fracas_command_run = {
    .name = "run",
    .operand = "FILE",
    .doc = "Runs the campaign of FILE: computes, stores, reports",
    .more = "\nThe study is made in the current folder. The same command resumes a study that was "
            "interrupted, does nothing\n"
            "where one is complete, and adds what a longer campaign file asks for. Ctrl-C stops it "
            "when what is being\n"
            "computed is stored. FILE may be edited meanwhile: the run goes on with what it has "
            "read. It can also be started by mpirun\n"
            "or srun, one process a core.\n",
    .options = fracas_cli_run_options,
    .run = run,
};

/* ---- extend ---- */

/* Prints present and future numbers of realizations. FRACAS_USAGE for fewer, or with a rule. */
static fracas_err check_growth(const char *study, const fracas_campaign *campaign, int replicas)
{
    int64_t before = 0;
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *point = &campaign->point[p];
        if (point->rule.maximum > 0)
            return fracas_fail(
                FRACAS_USAGE,
                "extend: a rule decides the replicas of point %zu of %s; to get more, raise "
                "`maximum` or lower `relative-half-width` of `replicas` in a copy of "
                "%s/campaign.yaml, put it beside that, and `fracas run` it with --study %s",
                p, study, study, fracas_shell_path(study, NULL).text);
        if (point->replicas > replicas)
            return fracas_fail(FRACAS_USAGE,
                               "extend: --replicas %d: point %zu of %s has %" PRId64
                               " already; a study can only grow",
                               replicas, p, study, point->replicas);
        before += point->replicas;
    }
    const int64_t after = (int64_t)campaign->npoints * replicas;
    if (fracas_run_owns_terminal() && after > before)
        fprintf(stderr, "fracas: %s is to grow from %" PRId64 " realizations to %" PRId64 "\n",
                study, before, after);
    return FRACAS_OK;
}

static fracas_err extend(const fracas_arguments *arguments)
{
    int replicas = 0;
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_arguments_integer(arguments, "replicas", 1, INT_MAX, &replicas));
    if (!replicas)
        return fracas_fail(FRACAS_USAGE,
                           "extend: --replicas N is missing: how many every point shall have");
    TRY(fracas_cli_read_campaign(arguments->operand, &campaign));
    TRY(check_growth(arguments->operand, campaign, replicas));
    return fracas_cli_run_study(arguments);
}

const fracas_command fracas_command_extend = {
    .name = "extend",
    .operand = "STUDY",
    .doc = "Gives the points of STUDY more replicas: --replicas N of each",
    .more = "\nWhat is there stays: only what is new is computed, and study.h5 becomes that of a "
            "campaign that had N replicas from the\n"
            "start. More points, or a tighter rule for replicas, come by `fracas run` with a "
            "longer campaign file.\n",
    .options = FRACAS_STUDY_RUN_OPTIONS,
    .run = extend,
};

/* ---- retry ---- */

static const fracas_option retry_options[] = {
    FRACAS_RUN_OPTIONS,
    {"failed", NULL, "those that FAILED; there is nothing else to retry"},
    {"point", "P", "those of point P, from 0 (all)"},
    {0}};

static fracas_err plan_again(const char *study, int point)
{
    OWN(fracas_campaign) campaign = NULL;
    int64_t rows = 0;
    TRY(fracas_cli_read_campaign(study, &campaign));
    TRY(fracas_upkeep_retry(study, campaign, point, &rows));
    fprintf(stderr, "fracas: %" PRId64 " failed realizations of %s are planned again\n", rows,
            study);
    return FRACAS_OK;
}

static fracas_err retry(const fracas_arguments *arguments)
{
    int point = -1;
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    if (!fracas_given(arguments, "failed"))
        return fracas_fail(FRACAS_USAGE,
                           "retry: --failed is missing: fracas retry STUDY --failed computes again "
                           "what FAILED; what was interrupted, `fracas run` computes");
    if (fracas_run_owns_terminal()) TRY(plan_again(arguments->operand, point));
    return fracas_cli_run_study(arguments);
}

const fracas_command fracas_command_retry = {
    .name = "retry",
    .operand = "STUDY",
    .doc = "Computes again what FAILED in STUDY: --failed",
    .more = "\nA realization that crashed its process three times is FAILED for good: `fracas "
            "status STUDY` names it and the reason. This\n"
            "forgets its attempts and runs STUDY/campaign.yaml. Worth it after a machine or a "
            "limit was to blame (memory, time, a\n"
            "killed job); what crashes by itself fails again.\n",
    .options = retry_options,
    .run = retry,
};
