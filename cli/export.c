/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <stdio.h>

static const fracas_option options[] = {
    {"to", "DIR", "where to (STUDY/export)"},
    {"histories", NULL, "energies over time of every realization, too: histories.csv"},
    {0}};

static fracas_err export(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    OWNED char *folder = NULL;
    const char *to = fracas_given(arguments, "to");
    TRY(to ? fracas_path(&folder, "%s", to)
           : fracas_path(&folder, "%s/export", arguments->operand));
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    TRY(fracas_export_write(analysis, folder, fracas_given(arguments, "histories") != NULL));
    printf("export: %s/datapackage.json\n", folder);
    return FRACAS_OK;
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
    .run = export,
};
