/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The options of all commands that compute: run, extend, retry. */
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

/* *run from the command line; run->file and run->study are left to the caller: *study is what
 * --study says, NULL if it was not given. */
FRACAS_MUST_USE fracas_err fracas_cli_read_run_options(const fracas_arguments *arguments,
                                                       fracas_run_options *run, const char **study);

/* Runs with these options and ends as `fracas run` does: table and report on standard output, the
 * verdict as the error. `argc`, `argv`: the command line of the ranks, `fracas run FILE ...`, which
 * must give the same options. */
FRACAS_MUST_USE fracas_err fracas_cli_run(const fracas_run_options *run, int argc, char **argv);

/* `fracas run FILE --study STUDY` with the options that `given` has, those of a command with
 * FRACAS_STUDY_RUN_OPTIONS, done by `runner`. */
typedef fracas_err fracas_cli_runner(const fracas_run_options *run, int argc, char **argv);
FRACAS_MUST_USE fracas_err fracas_cli_run_as(const fracas_arguments *given, const char *file,
                                             const char *study, fracas_cli_runner *runner);

/* The place of an option of FRACAS_STUDY_RUN_OPTIONS, which has one of that name, in its command's
 * values. */
size_t fracas_cli_run_option(const char *name);

/* Goes on with the study that is the operand of a command with FRACAS_STUDY_RUN_OPTIONS: `fracas
 * run STUDY/campaign.yaml --study STUDY` with the options that were given. */
FRACAS_MUST_USE fracas_err fracas_cli_run_study(const fracas_arguments *arguments);

#endif
