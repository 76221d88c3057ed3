/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/run_options.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/part.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/store/store.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    STUDY /* the first: FRACAS_STUDY_RUN_OPTIONS */,
    JOBS,
    REPLICAS,
    PART,
    WALLTIME,
    ISOLATION,
    LEASE_TIME,
    LEASE_LIMIT,
    MEMORY_LIMIT,
    LANES,
    ISA,
    SEGMENT_AGE,
    SEGMENT_SIZE,
    SHUFFLE,
    FORCE,
    IGNORE_SPACE
};
const fracas_option fracas_cli_run_options[FRACAS_NRUN_OPTIONS] = {
    [STUDY] = {"study", "DIR", "folder of the study (studies/NAME, NAME from the campaign file)"},
    [JOBS] = {"jobs", "N", "processes that compute (one a core)"},
    [REPLICAS] = {"replicas", "N", "replicas of every point (as the campaign file says)"},
    [PART] = {"part", "K/N", "compute the K-th of N parts only, for `fracas merge-studies`"},
    [WALLTIME] = {"walltime", "TIME", "have stopped, resumable, after TIME: 55m, 1h30m, 2:00:00"},
    [ISOLATION] = {"isolation", "lease|none", "a process for each lease, or none (lease)"},
    [LEASE_TIME] = {"lease-time", "S", "lease so much that it takes S seconds; 0: one batch (1)"},
    [LEASE_LIMIT] = {"lease-limit", "TIME",
                     "kill a lease after TIME (10m and 50 times its prediction)"},
    [MEMORY_LIMIT] = {"memory-limit", "MB", "memory that a lease may allocate (the machine's)"},
    [LANES] = {"lanes", "1|4|8", "realizations side by side in a batch (as many as fit)"},
    [ISA] = {"isa", "baseline|avx2|avx512", "instruction set (the best there is)"},
    [SEGMENT_AGE] = {"segment-age", "S", "write a segment when it is S seconds old (5)"},
    [SEGMENT_SIZE] = {"segment-size", "MB", "or has MB megabytes (64; 1 MB is 1048576 bytes)"},
    [SHUFFLE] = {"shuffle", NULL, "compute in a shuffled order (the results are the same)"},
    [FORCE] = {"force", NULL, "take the study over from a run on another host that is dead"},
    [IGNORE_SPACE] = {"ignore-space", NULL,
                      "start though the disk has less space than is predicted"},
};

static fracas_err read_part(const fracas_arguments *arguments, fracas_run_options *run)
{
    const char *text = arguments->value[PART];
    int end = 0;
    if (!text) return FRACAS_OK;
    if (sscanf(text, "%d/%d%n", &run->part, &run->parts, &end) == 2 && !text[end] &&
        run->part >= 1 && run->part <= run->parts)
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s: --part is `%s`; it must be K/N with K from 1 to N, such as 1/2",
                       arguments->command->name, text);
}

fracas_err fracas_cli_read_run_options(const fracas_arguments *arguments, fracas_run_options *run,
                                       const char **study)
{
    static const char *const lanes[] = {"1", "4", "8"};
    static const int widths[] = {1, 4, 8};
    int width = -1, isa = FRACAS_ISA_BEST, isolation = FRACAS_ISOLATION_LEASE, replicas = 0;

    fracas_run_options_init(run);
    *study = arguments->value[STUDY];
    run->shuffle = arguments->value[SHUFFLE];
    run->force = arguments->value[FORCE];
    run->ignore_space = arguments->value[IGNORE_SPACE];
    TRY(fracas_arguments_integer(arguments, JOBS, 1, INT_MAX, &run->jobs));
    TRY(fracas_arguments_integer(arguments, REPLICAS, 1, INT_MAX, &replicas));
    run->replicas = replicas;
    TRY(read_part(arguments, run));
    TRY(fracas_arguments_time(arguments, WALLTIME, &run->walltime));
    TRY(fracas_arguments_word(arguments, ISOLATION, fracas_isolation_name, 2, &isolation));
    run->isolation = (fracas_isolation)isolation;
    TRY(fracas_arguments_real(arguments, LEASE_TIME, 1.0, &run->lease_seconds));
    TRY(fracas_arguments_time(arguments, LEASE_LIMIT, &run->lease_limit));
    TRY(fracas_arguments_real(arguments, MEMORY_LIMIT, 1048576.0, &run->memory_limit));
    TRY(fracas_arguments_word(arguments, LANES, lanes, FRACAS_COUNT(lanes), &width));
    if (width >= 0) run->width = widths[width];
    TRY(fracas_arguments_word(arguments, ISA, fracas_isa_name, FRACAS_NISAS, &isa));
    run->isa = (fracas_isa)isa;
    TRY(fracas_arguments_real(arguments, SEGMENT_AGE, 1.0, &run->segment_age));
    return fracas_arguments_real(arguments, SEGMENT_SIZE, 1048576.0, &run->segment_bytes);
}

/* The folder of the run's study. */
static fracas_err find_study(const fracas_run_options *run, char *study, size_t size)
{
    fracas_campaign *campaign;
    TRY(fracas_run_campaign(run, &campaign));
    fracas_err code = fracas_study_folder(run, campaign, study, size);
    fracas_campaign_destroy(campaign);
    return code;
}

fracas_err fracas_cli_run(const fracas_run_options *run, int argc, char **argv)
{
    bool ran;
    fracas_err end = fracas_run(run, argc, argv, &ran);
    if (!fracas_run_speaks()) return FRACAS_OK;
    if (end != FRACAS_OK && end != FRACAS_SOME_FAILED) return end;

    char study[PATH_MAX], message[1024]; /* the error, for after the report */
    snprintf(message, sizeof message, "%s", fracas_message());
    TRY(find_study(run, study, sizeof study));
    if (!ran) fprintf(stderr, "fracas: %s is complete, nothing to compute\n", study);
    TRY(fracas_cli_report(study, false));
    return end ? fracas_fail(end, "%s", message) : FRACAS_OK;
}

/* Appends the given options as --NAME=VALUE behind `before` arguments; the caller frees these. */
static fracas_err append_options(const fracas_arguments *given, int before, char **argv, int *argc)
{
    *argc = before;
    for (size_t i = 0; i < FRACAS_NRUN_OPTIONS; i++) {
        const fracas_option *option = &fracas_cli_run_options[i];
        if (!given->value[i]) continue;
        if (asprintf(&argv[*argc], "--%s%s%s", option->name, option->argument ? "=" : "",
                     given->value[i]) < 0)
            return fracas_no_memory("the arguments of the run");
        ++*argc;
    }
    return FRACAS_OK;
}

/* "K/N" of a study of one part, else "". The run will report a damaged index. */
static void read_own_part(const char *study, char *text, size_t size)
{
    fracas_index *index;
    int part, parts;
    *text = '\0';
    if (fracas_index_open(study, false, &index)) return;
    if (!fracas_index_part(index, &part, &parts) && parts > 1)
        snprintf(text, size, "%d/%d", part, parts);
    fracas_index_close(index);
}

fracas_err fracas_cli_run_as(const fracas_arguments *arguments, const char *file, const char *study,
                             fracas_cli_runner *runner)
{
    /* The options of `run`, with --study first, not given. */
    const fracas_command as_run = {.name = arguments->command->name,
                                   .options = fracas_cli_run_options,
                                   .noptions = FRACAS_NRUN_OPTIONS};
    fracas_arguments given = {.command = &as_run};
    memcpy(given.value + 1, arguments->value, FRACAS_NSTUDY_RUN_OPTIONS * sizeof *given.value);
    fracas_run_options run;
    char program[] = "fracas", command[] = "run", option[] = "--study";
    enum { BEFORE = 5 };
    char *argv[BEFORE + FRACAS_NRUN_OPTIONS + 1] = {program, command, (char *)file, option,
                                                    (char *)study};
    int argc;
    const char *none;
    TRY(fracas_cli_read_run_options(&given, &run, &none));
    run.file = file;
    run.study = study;
    fracas_err code = append_options(&given, BEFORE, argv, &argc);
    if (!code) code = runner(&run, argc, argv);
    for (int i = BEFORE; i < argc; i++) free(argv[i]);
    return code;
}

size_t fracas_cli_run_option(const char *name)
{
    size_t i = 0;
    while (strcmp(FRACAS_STUDY_RUN_OPTIONS[i].name, name) != 0) i++;
    return i;
}

fracas_err fracas_cli_run_study(const fracas_arguments *arguments)
{
    fracas_arguments given = *arguments;
    char file[PATH_MAX + 16], part[32];
    const size_t parts = fracas_cli_run_option("part");
    read_own_part(arguments->operand, part, sizeof part);
    if (!given.value[parts] && *part) given.value[parts] = part;
    if (strlen(arguments->operand) >= PATH_MAX)
        return fracas_fail(FRACAS_USAGE, "the path of the study is too long: %s",
                           arguments->operand);
    snprintf(file, sizeof file, "%s/campaign.yaml", arguments->operand);
    return fracas_cli_run_as(&given, file, arguments->operand, fracas_cli_run);
}
