/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common options of run, extend, retry, converge and submit. */
#ifndef FRACAS_CLI_RUN_H
#define FRACAS_CLI_RUN_H

#include "cli/cli.h"

#include "campaigns/scheduler/run.h"

/* Options of a run, for a table of options; --study is not for commands whose operand it is. */
#define FRACAS_STUDY_OPTION                                                               \
    {                                                                                     \
        "study", "DIR", "folder of the study (studies/NAME, NAME from the campaign file)" \
    }
#define FRACAS_RUN_OPTIONS                                                                    \
    {"jobs", "N", "processes that compute (one a core)"},                                     \
        {"replicas", "N", "replicas of every point (as the campaign file says)"},             \
        {"part", "K/N", "compute the K-th of N parts only, for `fracas merge-studies`"},      \
        {"walltime", "TIME", "have stopped, resumable, after TIME: 55m, 1h30m, 2:00:00"},     \
        {"isolation", "lease|none", "a process for each lease, or none (lease)"},             \
        {"checkpoint-time", "S",                                                              \
         "keep the state of what computes for longer than S seconds (120)"},                  \
        {"lease-time", "S", "lease so much that it takes S seconds; 0: one batch (1)"},       \
        {"lease-limit", "TIME", "kill a lease after TIME (10m and 50 times its prediction)"}, \
        {"memory-limit", "MB", "memory that a lease may allocate (the machine's)"},           \
        {"lanes", "1|4|8", "realizations side by side in a batch (as many as fit)"},          \
        {"isa", "baseline|avx2|avx512", "instruction set (the best there is)"},               \
        {"segment-age", "S", "write a segment when it is S seconds old (5)"},                 \
        {"segment-size", "MB", "or has MB megabytes (64; 1 MB is 1048576 bytes)"},            \
        {"quiet", NULL, "no progress and no table, only what goes wrong"},                    \
        {"wide", NULL, "tables as wide as they are, also on a narrower terminal"},            \
        {"no-report", NULL, "compute and store alone: `fracas report STUDY` reports later"},  \
        {"shuffle", NULL, "compute in a shuffled order (the results are the same)"},          \
        {"force", NULL, "take the study over from a run on another host that is dead"},       \
    {                                                                                         \
        "ignore-space", NULL, "start though the disk has less space than is predicted"        \
    }

/* These, --study first, for commands without any other. */
enum { FRACAS_NRUN_OPTIONS = 20 };
extern const fracas_option fracas_cli_run_options[FRACAS_NRUN_OPTIONS + 1];
#define FRACAS_STUDY_RUN_OPTIONS (fracas_cli_run_options + 1)

/* Reads *run from the command line of a command with these options, run->study from --study, but
 * for run->file. */
FRACAS_MUST_USE fracas_err fracas_cli_read_run_options(const fracas_arguments *arguments,
                                                       fracas_run_options *run);

/* Runs as `fracas run`: prints table and report, returns the result. `argc`, `argv`: the command
 * line of the ranks, `fracas run FILE ...`, with the same options. */
FRACAS_MUST_USE fracas_err fracas_cli_run(const fracas_run_options *run, int argc, char **argv);

/* Calls `runner` for `fracas run FILE --study STUDY` with the options given. */
typedef fracas_err fracas_cli_runner(const fracas_run_options *run, int argc, char **argv);
FRACAS_MUST_USE fracas_err fracas_cli_run_as(const fracas_arguments *given, const char *file,
                                             const char *study, fracas_cli_runner *runner);

/* Continues the operand STUDY: `fracas run STUDY/campaign.yaml --study STUDY` with the given
 * options. */
FRACAS_MUST_USE fracas_err fracas_cli_run_study(const fracas_arguments *arguments);

#endif
