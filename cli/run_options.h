/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Common options of run, extend, retry, converge and submit. */
#ifndef FRACAS_CLI_RUN_OPTIONS_H
#define FRACAS_CLI_RUN_OPTIONS_H

#include "cli/cli.h"

#include "campaigns/scheduler/run.h"

/* In the place of `fracas_command.options`. */
enum { FRACAS_NRUN_OPTIONS = 16 };
extern const fracas_option fracas_cli_run_options[FRACAS_NRUN_OPTIONS];

/* The same but --study, for a command whose operand is the study. */
#define FRACAS_STUDY_RUN_OPTIONS (fracas_cli_run_options + 1)
enum { FRACAS_NSTUDY_RUN_OPTIONS = FRACAS_NRUN_OPTIONS - 1 };

/* Reads *run from the command line, but for run->file and run->study; *study is the value of
 * --study, or NULL. */
FRACAS_MUST_USE fracas_err fracas_cli_read_run_options(const fracas_arguments *arguments,
                                                       fracas_run_options *run, const char **study);

/* Runs as `fracas run`: prints table and report, returns the result. `argc`, `argv`: the command
 * line of the ranks, `fracas run FILE ...`, with the same options. */
FRACAS_MUST_USE fracas_err fracas_cli_run(const fracas_run_options *run, int argc, char **argv);

/* Calls `runner` for `fracas run FILE --study STUDY` with the options in `given`, of a command with
 * FRACAS_STUDY_RUN_OPTIONS. */
typedef fracas_err fracas_cli_runner(const fracas_run_options *run, int argc, char **argv);
FRACAS_MUST_USE fracas_err fracas_cli_run_as(const fracas_arguments *given, const char *file,
                                             const char *study, fracas_cli_runner *runner);

/* Index of an existing option of FRACAS_STUDY_RUN_OPTIONS. */
size_t fracas_cli_run_option(const char *name);

/* Continues the operand STUDY: `fracas run STUDY/campaign.yaml --study STUDY` with the given
 * options. */
FRACAS_MUST_USE fracas_err fracas_cli_run_study(const fracas_arguments *arguments);

#endif
