#include "cli/cli.h"

#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/prepare.h"
#include "campaigns/scheduler/run.h"

#include <limits.h>
#include <stdio.h>

enum { STUDY, JOBS, LANES, ISA, SEGMENT_AGE, SEGMENT_SIZE, SHUFFLE };
static const fracas_option options[] = {
    [STUDY] = {"study", "DIR", "folder of the study (studies/NAME, NAME from the campaign file)"},
    [JOBS] = {"jobs", "N", "processes that compute (one a core)"},
    [LANES] = {"lanes", "1|4|8", "realizations side by side in a batch (as many as fit)"},
    [ISA] = {"isa", "baseline|avx2|avx512", "instruction set (the best there is)"},
    [SEGMENT_AGE] = {"segment-age", "S", "write a segment when it is S seconds old (5)"},
    [SEGMENT_SIZE] = {"segment-size", "MB", "or has MB megabytes (64; 1 MB is 1048576 bytes)"},
    [SHUFFLE] = {"shuffle", NULL, "compute in a shuffled order (the results are the same)"},
};

static fracas_err read_options(const fracas_arguments *arguments, fracas_run_options *run)
{
    static const char *const lanes[] = {"1", "4", "8"};
    static const int widths[] = {1, 4, 8};
    int width = -1, isa = FRACAS_ISA_BEST;

    fracas_run_options_init(run);
    run->file = arguments->operand;
    run->study = arguments->value[STUDY];
    run->shuffle = arguments->value[SHUFFLE];
    TRY(fracas_arguments_integer(arguments, JOBS, 1, INT_MAX, &run->jobs));
    TRY(fracas_arguments_word(arguments, LANES, lanes, FRACAS_COUNT(lanes), &width));
    if (width >= 0) run->width = widths[width];
    TRY(fracas_arguments_word(arguments, ISA, fracas_isa_name, FRACAS_NISAS, &isa));
    run->isa = (fracas_isa)isa;
    TRY(fracas_arguments_real(arguments, SEGMENT_AGE, 1.0, &run->segment_age));
    return fracas_arguments_real(arguments, SEGMENT_SIZE, 1048576.0, &run->segment_bytes);
}

/* Where the run left its study. */
static fracas_err find_study(const fracas_run_options *run, char *study, size_t size)
{
    fracas_campaign *campaign;
    TRY(fracas_campaign_read(run->file, &campaign));
    fracas_err code = fracas_study_folder(run, campaign, study, size);
    fracas_campaign_destroy(campaign);
    return code;
}

static fracas_err run(const fracas_arguments *arguments)
{
    fracas_run_options run;
    TRY(read_options(arguments, &run));
    bool ran;
    fracas_err end = fracas_run(&run, arguments->argc, arguments->argv, &ran);
    if (!fracas_run_speaks()) return FRACAS_OK;
    if (end != FRACAS_OK && end != FRACAS_SOME_FAILED) return end;

    char study[PATH_MAX], message[1024]; /* how the run ended, said after the report */
    snprintf(message, sizeof message, "%s", fracas_message());
    TRY(find_study(&run, study, sizeof study));
    if (!ran) fprintf(stderr, "fracas: %s is complete, nothing to compute\n", study);
    TRY(fracas_cli_report(study, false));
    return end ? fracas_fail(end, "%s", message) : FRACAS_OK;
}

const fracas_command fracas_command_run = {
    .name = "run", .operand = "FILE", .doc = "Runs the campaign of FILE: computes, stores, reports",
    .more = "\nThe study is made in the current folder. The same command resumes a study that was interrupted, does nothing\n"
            "where one is complete, and adds what a longer campaign file asks for. Ctrl-C stops it when what is being\n"
            "computed is stored. It can also be started by mpirun or srun, one process a core.\n",
    .options = options, .noptions = FRACAS_COUNT(options), .run = run,
};
