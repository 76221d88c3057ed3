/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands report and export, and studies opened for an analysis. */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "analysis/data/output.h"
#include "analysis/fit/fits.h"
#include "base/param.h"
#include "base/text.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/status/describe.h"
#include "cli/look.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

static const fracas_option report_options[] = {
    {"x", "KEY",
     "draw mean counts and sizes against this parameter or statistic (the strain rate)"},
    {"series", "KEY", "draw a series for each value of this parameter"},
    {"panels", "KEY", "draw a panel for each value of this parameter"},
    {"y", "KEYS", "statistics to draw beside size and count, as aspect,onset_time (dissipated)"},
    {"points", "LIST", "draw figures of these points, as 3,17,20-25 or all (all of 16, 6 of more)"},
    {"output", "FOLDER", "where to; also -o FOLDER (STUDY/report)", 'o'},
    {"json", NULL, "print the statistics as JSON"},
    {"live", NULL, "write the report again and again until the study is computed"},
    FRACAS_INTERVAL_OPTION("30s"),
    {"quiet", NULL, "only write the report"},
    FRACAS_WIDE_OPTION,
    {0}};

/* Tells readers of the table about fits left out, as the page does. */
static fracas_err print_hidden_fits(const fracas_analysis *analysis, const char *study)
{
    FRACAS_CLEARED(fracas_shown_fits) shown = {0};
    TRY(fracas_shown_fits_read(study, analysis, &shown));
    if (shown.left_out) printf("warning: %s\n", shown.left_out);
    if (shown.stale > 0)
        printf("fits of %zu point%s in %s/" FRACAS_FITS_FILE
               " are of other realizations and not shown: `fracas fit %s` makes them again\n",
               shown.stale, shown.stale == 1 ? "" : "s", study,
               fracas_shell_path(study, NULL).text);
    return FRACAS_OK;
}

/* Keys of the command come before those of the campaign. */
static fracas_err set_axes(fracas_analysis *analysis, const fracas_campaign *campaign,
                           const fracas_report_view *view)
{
    const fracas_report_keys none = {0}, *keys = campaign ? &campaign->report : &none;
    const char *x = view->x ? view->x : keys->x,
               *series = view->series ? view->series : keys->series,
               *panels = view->panels ? view->panels : keys->panels,
               *y = view->y ? view->y : keys->y;
    if (y) TRY(fracas_analysis_ordinates(analysis, y));
    if (view->points) TRY(fracas_analysis_points(analysis, view->points));
    return x || series || panels ? fracas_analysis_axes(analysis, x, series, panels) : FRACAS_OK;
}

static fracas_err page_of(const char *study, const fracas_report_view *view, char **page)
{
    return view->output ? fracas_path(page, "%s/index.html", view->output)
                        : fracas_path(page, "%s/report/index.html", study);
}

/* Prints the table and writes the last page. */
static fracas_err finish(const fracas_analysis *analysis, const char *study,
                         const fracas_report_view *view)
{
    OWNED char *page = NULL;
    if (view->json) TRY(fracas_analysis_write_json(analysis, study, stdout));
    else if (!view->quiet) fracas_analysis_print_table(analysis, view->columns, stdout);
    TRY(fracas_report_write(analysis, study, view->output, 0));
    if (view->json || view->quiet) return FRACAS_OK;
    TRY(print_hidden_fits(analysis, study));
    TRY(page_of(study, view, &page));
    printf("report: %s\n", page);
    return FRACAS_OK;
}

fracas_err fracas_cli_report(const char *study, const fracas_report_view *view)
{
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    OWNED char *beside = NULL;
    fracas_report_view named = *view; /* beside a file alone may be the user's own files */
    if (!view->output && fracas_cli_alone(study)) {
        TRY(fracas_path(&beside, "%s/report", study));
        named.output = beside;
    }
    TRY(fracas_cli_analyse(study, &campaign, &analysis));
    TRY(set_axes(analysis, campaign, view));
    return finish(analysis, study, &named);
}

fracas_err fracas_cli_check_report(const char *file, const fracas_campaign *campaign)
{
    const fracas_report_keys *keys = &campaign->report;
    fracas_err err = fracas_analysis_check_ordinates(keys->y);
    if (!err && keys->x && fracas_point_table_find(&campaign->table, keys->x) == SIZE_MAX &&
        !fracas_analysis_is_statistic(keys->x))
        err = fracas_fail(FRACAS_USAGE,
                          "x of the figures, `%s`: no parameter of the points and no statistic "
                          "(summary.json has these) has this name",
                          keys->x);
    if (!err) err = fracas_analysis_check_axes(keys->x, keys->series, keys->panels);
    return err ? fracas_fail_within(err, "%s: `report`", file) : FRACAS_OK;
}

/* ---- while the study is computed ---- */

typedef struct {
    int seconds; /* after which a page loads itself again */
    fracas_report_view view;
} live_report;

/* Nothing done yet, or an index out of reach for a moment, is no error before the last look. */
static fracas_err write_page(void *context, const fracas_look *look, bool last)
{
    const live_report *live = context;
    OWN(fracas_analysis) analysis = NULL;
    OWNED char *page = NULL;
    const fracas_err err = fracas_analysis_create(look->study, &look->campaign->hash,
                                                  &look->campaign->table, &analysis);
    if (!last && (err == FRACAS_INTERRUPTED || err == FRACAS_IN_USE)) return FRACAS_OK;
    TRY(err);
    TRY(set_axes(analysis, look->campaign, &live->view));
    if (last) return finish(analysis, look->study, &live->view);
    const fracas_counts counts = fracas_look_counts(look);
    char text[256];
    TRY(fracas_report_write(analysis, look->study, live->view.output, live->seconds));
    fracas_counts_describe(&counts, false, look->rate, look->left, text, sizeof text);
    TRY(page_of(look->study, &live->view, &page));
    if (!live->view.quiet) fprintf(stderr, "fracas: %s: %s\n", page, text);
    return FRACAS_OK;
}

static fracas_err report(const fracas_arguments *arguments)
{
    double interval = 30;
    const fracas_report_view view = {.json = fracas_given(arguments, "json"),
                                     .quiet = fracas_given(arguments, "quiet"),
                                     .columns = fracas_cli_columns(arguments),
                                     .x = fracas_given(arguments, "x"),
                                     .series = fracas_given(arguments, "series"),
                                     .panels = fracas_given(arguments, "panels"),
                                     .y = fracas_given(arguments, "y"),
                                     .points = fracas_given(arguments, "points"),
                                     .output = fracas_given(arguments, "output")};
    TRY(fracas_watch_interval(arguments, "live", &interval));
    if (!fracas_given(arguments, "live")) return fracas_cli_report(arguments->operand, &view);
    live_report live = {(int)fmin(ceil(interval), 86400), view};
    return fracas_watch(arguments->operand, interval, write_page, &live);
}

const fracas_command fracas_command_report = {
    .name = "report",
    .operand = "STUDY",
    .doc = "Prints the result table and writes STUDY/report",
    .more =
        "\nSTUDY is a folder, or study.h5 alone.\n"
        "The report is index.html with its figures, and the numbers as CSV files. Of a study "
        "that is being computed, or was interrupted,\n"
        "it is of what is done by now, and says so. With --live an open page loads itself again "
        "until the last one.\n",
    .options = report_options,
    .run = report,
};

/* ---- export ---- */

static const fracas_option export_options[] = {
    {"to", "DIR", "where to (STUDY/export)"},
    {"study", "NEW", "instead make a study of study.h5 in the folder NEW, to go on with"},
    {"histories", NULL, "energies over time of every realization, too: histories.csv"},
    {"cracks", NULL, "lengths, tips and speeds of cracks of surfaces, too: cracks.csv, breaks.csv"},
    {"vtk", NULL, "instead write how fragments move and cracks grow, for ParaView (STUDY/vtk)"},
    {"point", "P", "with --vtk: of this point alone"},
    {"replica", "R", "with --vtk: this replica (the one that the report shows)"},
    {"times", "LIST",
     "with --vtk: times, as 26us,28us, or how many: half after equal shares of the breaks, half "
     "even (24)"},
    {0}};

static fracas_err export_grids(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    OWNED double *time = NULL;
    int point = -1, replica = -1;
    fracas_grids_request request = {.count = FRACAS_FRAMES};
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    TRY(fracas_arguments_integer(arguments, "replica", 0, INT_MAX, &replica));
    TRY(fracas_cli_times(arguments, &request.count, &time));
    if (time) TRY(fracas_cli_times_in_order(arguments, &request.count, time));
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    request.point = point < 0 ? SIZE_MAX : (size_t)point;
    request.replica = replica;
    request.time = time;
    request.folder = fracas_given(arguments, "to");
    return fracas_export_grids(analysis, arguments->operand, &request, stdout);
}

/* Each way to export has options of its own. */
static fracas_err check_export(const fracas_arguments *arguments)
{
    static const char *const of_grids[] = {"point", "replica", "times"}, *const of_tables[] = {
                                                                             "histories", "cracks"};
    const bool vtk = fracas_given(arguments, "vtk"), study = fracas_given(arguments, "study");
    for (size_t k = 0; k < FRACAS_COUNT(of_grids); k++)
        if (!vtk && fracas_given(arguments, of_grids[k]))
            return fracas_fail(FRACAS_USAGE, "export: --%s is for --vtk: call it with that",
                               of_grids[k]);
    for (size_t k = 0; k < FRACAS_COUNT(of_tables); k++)
        if (vtk && fracas_given(arguments, of_tables[k]))
            return fracas_fail(FRACAS_USAGE,
                               "export: --vtk is in the place of tables: call it without --%s",
                               of_tables[k]);
    if (vtk && study)
        return fracas_fail(FRACAS_USAGE, "export: --vtk and --study are two ways: choose one");
    return FRACAS_OK;
}

static fracas_err export(const fracas_arguments *arguments)
{
    const fracas_export_more more = {.histories = fracas_given(arguments, "histories") != NULL,
                                     .cracks = fracas_given(arguments, "cracks") != NULL};
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    OWNED char *folder = NULL;
    const char *new = fracas_given(arguments, "study");
    if (new && (fracas_given(arguments, "to") || more.histories || more.cracks))
        return fracas_fail(FRACAS_USAGE, "export: --study is in the place of tables: call it "
                                         "without --to, --histories and --cracks");
    TRY(check_export(arguments));
    if (new) return fracas_cli_unpack(arguments, new);
    if (fracas_given(arguments, "vtk")) return export_grids(arguments);
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    TRY(fracas_output_folder_in(fracas_given(arguments, "to"), arguments->operand, "export",
                                &folder));
    TRY(fracas_export_free(analysis, folder, more));
    TRY(fracas_export_write(analysis, folder, more));
    printf("export: %s/datapackage.json\n", folder);
    return FRACAS_OK;
}

const fracas_command fracas_command_export = {
    .name = "export",
    .operand = "STUDY",
    .doc = "Writes the tables of STUDY as a Frictionless Data Package",
    .more = "\nSTUDY is a folder, or study.h5 alone.\n"
            "points.csv (parameters and statistics), realizations.csv, fragments.csv, "
            "statistics.csv (a line a number, with its unit),\n"
            "energies.csv and convergence.csv (over time, and with the replicas), "
            "probes.csv where the campaign has probes, and datapackage.json, which says of every "
            "column what it is: type, unit, meaning. For "
            "pandas, R, or a data repository.\n\n"
            "With --study NEW, a folder that is not there or empty, study.h5 alone becomes a whole "
            "study: NEW/campaign.yaml, its files, the results\n"
            "and an index, for run, extend and merge-studies. Of a study.h5 of another version of "
            "fracas NEW gets the campaign alone.\n\n"
            "With --vtk each point's realization of the report becomes two series of grids: its "
            "elements where their fragments have moved, and its\n"
            "interfaces. Fragments are rigid bodies: `fracas replay --fields` computes them again, "
            "with stresses. The campaign must say\n"
            "`output: {interfaces: true}`. After the end of a realization they fly on.\n",
    .options = export_options,
    .run = export,
};
