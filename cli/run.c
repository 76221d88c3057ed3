/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/run_options.h"

static fracas_err run(const fracas_arguments *arguments)
{
    fracas_run_options run;
    TRY(fracas_cli_read_run_options(arguments, &run));
    run.file = arguments->operand;
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
            "computed is stored. It can also be started by mpirun or srun, one process a core.\n",
    .options = fracas_cli_run_options,
    .run = run,
};
