#include "cli/cli.h"

#include "analysis/analysis.h"
#include "analysis/fit/fits.h"
#include "base/param.h"
#include "campaigns/campaign.h"

#include <limits.h>
#include <stdint.h>

enum { POINT, RESAMPLES, JSON };
static const fracas_option options[] = {
    [POINT] = {"point", "P", "fit the point of this number alone, from 0, and keep the fits of the others", 0},
    [RESAMPLES] = {"resamples", "B", "resamples of intervals and p-values, 99 to 100000 (999)", 0},
    [JSON] = {"json", NULL, "print the fits as JSON", 0},
};

/* Fits of the other points, if they are of the same study.h5. */
static fracas_err keep_others(const char *study, fracas_fits *fits)
{
    fracas_fits *older;
    bool stale;
    TRY(fracas_fits_read(study, &older, &stale));
    fracas_err code = older && !stale ? fracas_fits_complete(fits, older) : FRACAS_OK;
    fracas_fits_destroy(older);
    return code;
}

static fracas_err fit(const fracas_arguments *arguments)
{
    const char *study = arguments->operand;
    int point = -1, resamples = FRACAS_FITS_RESAMPLES;
    fracas_campaign *campaign;
    fracas_analysis *analysis;
    fracas_fits *fits = NULL;
    TRY(fracas_arguments_integer(arguments, POINT, 0, INT_MAX, &point));
    TRY(fracas_arguments_integer(arguments, RESAMPLES, 99, 100000, &resamples));
    TRY(fracas_cli_analyse(study, &campaign, &analysis));
    fracas_err code = fracas_fits_create(analysis, study, point < 0 ? SIZE_MAX : (size_t)point, resamples, &fits);
    if (!code && !arguments->value[JSON]) fracas_fits_print(fits, analysis, stdout);
    if (!code && arguments->value[JSON]) fracas_fits_write_json(fits, stdout);
    if (!code && point >= 0) code = keep_others(study, fits);
    if (!code) code = fracas_fits_write(fits, study);
    if (!code && !arguments->value[JSON]) printf("\nfits: %s/" FRACAS_FITS_FILE "\n", study);
    fracas_fits_destroy(fits);
    fracas_analysis_destroy(analysis);
    fracas_campaign_destroy(campaign);
    return code;
}

const fracas_command fracas_command_fit = {
    .name = "fit", .operand = "STUDY", .doc = "Fits families of distributions to the fragment sizes of every point",
    .more = "\nBy maximum likelihood, with intervals and p-values that resample realizations: half a minute or so for a point. They are kept in\n"
            "STUDY/fits.csv, for the report.\n",
    .options = options, .noptions = FRACAS_COUNT(options), .run = fit,
};
