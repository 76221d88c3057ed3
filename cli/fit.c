/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "analysis/analysis.h"
#include "analysis/export/tables.h"
#include "base/param.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/launch/allocation.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <time.h>
#include <unistd.h>

static const fracas_option options[] = {
    {"point", "P", "fit the point of this number alone, from 0, and keep the fits of the others",
     0},
    {"jobs", "N", "processes that fit, a point each at a time (one a core); the fits are the same",
     0},
    {"resamples", "B", "resamples of intervals and p-values, 99 to 100000 (999)", 0},
    {"json", NULL, "print the fits as JSON", 0},
    FRACAS_WIDE_OPTION,
    {0}};

/* Reads valid fits of the other points before any computation; NULL without a file. */
static fracas_err read_others(const char *study, const fracas_analysis *analysis, bool wanted,
                              fracas_fits **older)
{
    size_t stale;
    *older = NULL;
    if (!wanted) return FRACAS_OK;
    TRY(fracas_fits_read(study, older));
    if (*older) fracas_fits_keep(*older, analysis, &stale);
    return FRACAS_OK;
}

/* A line on a terminal that is written over. */
static void show_progress(void *context, size_t done, size_t saved, size_t all)
{
    const time_t *began = context;
    const double elapsed = difftime(time(NULL), *began);
    char left[48] = "", before[64] = "";
    if (!isatty(STDERR_FILENO)) return;
    if (done > saved && done < all) {
        const long s = lround(elapsed * (double)(all - done) / (double)(done - saved));
        snprintf(left, sizeof left, ", some %ld:%02ld left", s / 60, s % 60);
    }
    if (saved > 0) snprintf(before, sizeof before, ", %zu of them by an earlier call", saved);
    fprintf(stderr, "\rfitted %zu of %zu points%s%s\033[K%s", done, all, before, left,
            done == all ? "\n" : "");
}

/* Many processes fit the whole study; one point is fitted in this one. */
static fracas_err make_fits(const fracas_arguments *arguments, const fracas_analysis *analysis,
                            size_t point, int resamples, fracas_fits **fits)
{
    time_t began = time(NULL);
    int jobs = fracas_allocation_cores();
    TRY(fracas_arguments_integer(arguments, "jobs", 1, 1024, &jobs));
    if (point != SIZE_MAX) return fracas_fits_create(analysis, point, resamples, fits);
    const fracas_fits_work work = {jobs, arguments->operand, show_progress, &began};
    return fracas_fits_create_by(analysis, resamples, &work, fits);
}

static fracas_err fit_study(const fracas_arguments *arguments, const fracas_analysis *analysis,
                            size_t point, int resamples)
{
    const char *study = arguments->operand;
    const bool json = fracas_given(arguments, "json") != NULL;
    OWN(fracas_fits) fits = NULL;
    OWN(fracas_fits) older = NULL;
    TRY(read_others(study, analysis, point != SIZE_MAX, &older));
    TRY(make_fits(arguments, analysis, point, resamples, &fits));
    const size_t made = fits->n; /* rows to show, out of all rows */
    fracas_err code = older ? fracas_fits_complete(fits, older) : FRACAS_OK;
    if (!code) code = fracas_fits_write(fits, study); /* first: the reader of the output may end */
    if (!code && point == SIZE_MAX) fracas_fits_forget_part(study);
    fits->n = made;
    if (json) fracas_fits_write_json(fits, stdout);
    else fracas_fits_print(fits, analysis, fracas_cli_columns(arguments), stdout);
    if (!code && !json) printf("\nfits: %s/" FRACAS_FITS_FILE "\n", study);
    return code;
}

static fracas_err check_free(const char *study)
{
    if (!fracas_fits_foreign(study)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s/" FRACAS_FITS_FILE " is there, and no `fracas fit` wrote it: move it "
                       "away, or fit a copy of study.h5 in another folder",
                       study);
}

static fracas_err fit(const fracas_arguments *arguments)
{
    int point = -1, resamples = FRACAS_FITS_RESAMPLES;
    OWN(fracas_campaign) campaign = NULL;
    OWN(fracas_analysis) analysis = NULL;
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    TRY(fracas_arguments_integer(arguments, "resamples", 99, 100000, &resamples));
    if (access(arguments->operand, W_OK) && errno != ENOENT) /* first: fits take minutes */
        return fracas_fail_system(
            errno,
            "fit: %s/" FRACAS_FITS_FILE
            " could not be written; make the folder writable, or fit a copy of the study",
            arguments->operand);
    TRY(fracas_cli_analyse(arguments->operand, &campaign, &analysis));
    TRY(check_free(arguments->operand));
    return fit_study(arguments, analysis, point < 0 ? SIZE_MAX : (size_t)point, resamples);
}

const fracas_command fracas_command_fit = {
    .name = "fit",
    .operand = "STUDY",
    .doc = "Fits families of distributions to the fragment sizes of every point",
    .more = "\nSTUDY is a folder, or study.h5 alone.\n"
            "By maximum likelihood, with intervals and p-values that resample realizations: half "
            "a minute or so for a point, on all cores. They are kept in\n"
            "STUDY/fits.csv, for the report. Each point is saved when it is done: after Ctrl-C the "
            "same command goes on.\n",
    .options = options,
    .run = fit,
};
