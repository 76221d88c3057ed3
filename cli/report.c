/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands report and export, and studies opened for an analysis. */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "analysis/data/output.h"
#include "analysis/fit/fits.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <errno.h>
#include <limits.h>
#include <string.h>
#include <unistd.h>

static const fracas_option report_options[] = {{"json", NULL, "print the statistics as JSON"}, {0}};

fracas_err fracas_cli_check_study(const char *study)
{
    char file[PATH_MAX];
    snprintf(file, sizeof file, "%s/campaign.yaml", study);
    if (!access(file, R_OK)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s is no study: %s: %s; `fracas run FILE` makes one", study,
                       file, strerror(errno));
}

fracas_err fracas_cli_read_campaign(const char *study, fracas_campaign **campaign)
{
    char file[PATH_MAX];
    TRY(fracas_cli_check_study(study));
    snprintf(file, sizeof file, "%s/campaign.yaml", study);
    fracas_err code = fracas_campaign_read(file, campaign);
    if (code != FRACAS_USAGE) return code;
    return fracas_fail_within(FRACAS_DAMAGED,
                              "the study's campaign file is damaged; remove it and run the "
                              "campaign file it was made from, or restore it");
}

fracas_err fracas_cli_analyse(const char *study, fracas_campaign **campaign,
                              fracas_analysis **analysis)
{
    TRY(fracas_cli_read_campaign(study, campaign));
    return fracas_analysis_create(study, &(*campaign)->hash, &(*campaign)->table, analysis);
}

/* Tells readers of the table about fits left out, as the page does. */
static fracas_err print_hidden_fits(const fracas_analysis *analysis, const char *study)
{
    FRACAS_CLEARED(fracas_shown_fits) shown = {0};
    TRY(fracas_shown_fits_read(study, analysis, &shown));
    if (shown.left_out) printf("warning: %s\n", shown.left_out);
    if (shown.stale > 0)
        printf("fits of %zu point%s in %s/" FRACAS_FITS_FILE
               " are of other realizations and not shown: `fracas fit %s` makes them again\n",
               shown.stale, shown.stale == 1 ? "" : "s", study, study);
    return FRACAS_OK;
}

fracas_err fracas_cli_report(const char *study, bool json)
{
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    TRY(fracas_cli_analyse(study, &campaign, &analysis));
    if (json) TRY(fracas_analysis_write_json(analysis, study, stdout));
    else fracas_analysis_print_table(analysis, stdout);
    TRY(fracas_report_write(analysis, study));
    if (json) return FRACAS_OK;
    TRY(print_hidden_fits(analysis, study));
    printf("report: %s/report/index.html\n", study);
    return FRACAS_OK;
}

static fracas_err report(const fracas_arguments *arguments)
{
    return fracas_cli_report(arguments->operand, fracas_given(arguments, "json"));
}

const fracas_command fracas_command_report = {
    .name = "report",
    .operand = "STUDY",
    .doc = "Prints the result table and writes STUDY/report",
    .more = "\nThe report is index.html with its figures, and the numbers as CSV files. Of a study "
            "that is being computed, or was interrupted,\n"
            "it is of what is done by now, and says so.\n",
    .options = report_options,
    .run = report,
};

/* ---- export ---- */

static const fracas_option export_options[] = {
    {"to", "DIR", "where to (STUDY/export)"},
    {"histories", NULL, "energies over time of every realization, too: histories.csv"},
    {0}};

static fracas_err export(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    OWNED char *folder = NULL;
    const char *to = fracas_given(arguments, "to");
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    TRY(to ? fracas_path(&folder, "%s", to)
           : fracas_output_folder_in(arguments->operand, "export", &folder));
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
    .options = export_options,
    .run = export,
};
