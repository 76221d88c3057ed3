/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <stdio.h>
#include <stdlib.h>

enum { TO, HISTORIES };
static const fracas_option options[] = {
    [TO] = {"to", "DIR", "where to (STUDY/export)"},
    [HISTORIES] = {"histories", NULL,
                   "energies over time of every realization, too: histories.csv"},
};

static fracas_err write_tables(const fracas_arguments *arguments, const char *folder)
{
    fracas_campaign *campaign;
    fracas_analysis *analysis;
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    const fracas_err err = fracas_export_write(analysis, folder,
                                               arguments->value[HISTORIES] != NULL);
    fracas_analysis_destroy(analysis);
    fracas_campaign_destroy(campaign);
    if (!err) printf("export: %s/datapackage.json\n", folder);
    return err;
}

static fracas_err export(const fracas_arguments *arguments)
{
    char *folder;
    TRY(fracas_cli_check_study(arguments->operand));
    if (arguments->value[TO]) return write_tables(arguments, arguments->value[TO]);
    if (asprintf(&folder, "%s/export", arguments->operand) < 0) return fracas_no_memory("a path");
    const fracas_err err = write_tables(arguments, folder);
    free(folder);
    return err;
}

const fracas_command fracas_command_export = {
    .name = "export",
    .operand = "STUDY",
    .doc = "Writes the tables of STUDY as a Frictionless Data Package",
    .more = "\npoints.csv (parameters and statistics), realizations.csv, fragments.csv, "
            "statistics.csv (a line a number, with its unit),\n"
            "energies.csv and convergence.csv (over time, and with the replicas), and "
            "datapackage.json, which says of every column what it is: type, unit, meaning. For "
            "pandas, R, or a data repository.\n",
    .options = options,
    .noptions = FRACAS_COUNT(options),
    .run = export,
};
