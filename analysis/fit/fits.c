#include "analysis/fit/fits.h"

#include "analysis/fit/point.h"
#include "analysis/study/study.h"
#include "campaigns/store/file/disk.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void fracas_fits_destroy(fracas_fits *fits)
{
    if (!fits) return;
    free(fits->row);
    free(fits);
}

/* A new row, zero but for NaNs, at the end; NULL without memory. */
static fracas_fits_row *append(fracas_fits *fits)
{
    if (fits->n == fits->room) {
        const size_t room = fits->room ? 2 * fits->room : 256;
        fracas_fits_row *grown = realloc(fits->row, room * sizeof *grown);
        if (!grown) return NULL;
        fits->row = grown;
        fits->room = room;
    }
    fracas_fits_row *row = &fits->row[fits->n++];
    *row = (fracas_fits_row){.value = NAN, .low = NAN, .high = NAN};
    return row;
}

/* What the rows of a point have in common while they are made. */
typedef struct {
    fracas_fits *fits;
    int64_t point;
    char hash[FRACAS_HASH_HEX];
    const char *family;
    bool full; /* no memory for a row */
} rows;

static void put(rows *to, const char *quantity, const char *unit, const fracas_interval *value, const char *note)
{
    fracas_fits_row *row = append(to->fits);
    to->full |= !row;
    if (!row) return;
    row->point = to->point;
    memcpy(row->hash, to->hash, sizeof row->hash);
    snprintf(row->family, sizeof row->family, "%s", to->family);
    snprintf(row->quantity, sizeof row->quantity, "%s", quantity);
    snprintf(row->unit, sizeof row->unit, "%s", unit);
    snprintf(row->note, sizeof row->note, "%s", note);
    for (char *at = row->note; (at = strchr(at, ',')); at++) *at = ';'; /* the file has commas between its fields alone */
    row->value = value->value;
    row->low = value->low;
    row->high = value->high;
    row->resamples = value->resamples;
}

static void put_number(rows *to, const char *quantity, const char *unit, double value, int64_t resamples, const char *note)
{
    const fracas_interval alone = {.value = value, .low = NAN, .high = NAN, .resamples = resamples};
    put(to, quantity, unit, &alone, note);
}

static void put_data(rows *to, const fracas_point_fits *fits)
{
    const fracas_fit_sample *sample = &fits->sample;
    to->family = "data";
    put_number(to, "realizations", "1", (double)sample->nrealizations, 0, "usable");
    put_number(to, "fragments", "1", (double)sample->fragments, 0, "of these");
    put_number(to, "above_cut", "1", sample->total, 0, "fragments that are fitted");
    put_number(to, "cut", "m", sample->cut, 0, "sizes above are fitted");
    put_number(to, "lattice", "m", sample->lattice, 0, "every size is a multiple; 0: they are not");
    put_number(to, "cells", "1", (double)sample->ncells, 0, "of size; in which fragments are counted");
    put(to, "mean", "m", &fits->mean, "of the sizes above the cut");
    put(to, "cv", "1", &fits->cv, "their deviation/mean");
}

static void put_parameters(rows *to, const fracas_family *family, const fracas_family_fit *fit, const fracas_fit_sample *sample)
{
    for (size_t i = 0; i < family->nparameters; i++) {
        const fracas_family_parameter *parameter = &family->parameter[i];
        fracas_interval value = fit->parameter[i], relative = fit->relative[i];
        if (*fit->fit.why) {
            value.value = fit->fit.parameter[i] * (parameter->length ? sample->mean : 1);
            relative.value = fit->fit.parameter[i];
        }
        put(to, parameter->name, parameter->length ? "m" : "1", &value, parameter->doc);
        char name[24];
        snprintf(name, sizeof name, "%s/mean", parameter->name);
        if (parameter->length) put(to, name, "1", &relative, "over the mean of the sizes above the cut");
    }
}

static void put_family(rows *to, size_t f, const fracas_point_fits *fits)
{
    const fracas_family_fit *fit = &fits->family[f];
    const fracas_fit_goodness *goodness = &fit->goodness;
    to->family = fits->families[f]->name;
    put_number(to, "fitted", "1", !*fit->fit.why, 0, fit->fit.why);
    if (fit->rank > 0) put_number(to, "rank", "1", fit->rank, 0, "by AICc");
    if (!isfinite(fit->fit.log_likelihood)) return;
    put_number(to, "log_likelihood", "1", fit->fit.log_likelihood, 0, "of the counts in cells");
    put_number(to, "aicc", "1", fit->aicc, 0, "");
    put_number(to, "delta_aicc", "1", fit->delta, 0, "above the least of those that are fitted");
    put_number(to, "bic", "1", fit->bic, 0, "");
    if (!*fit->fit.why) {
        put_number(to, "ks", "1", goodness->distance.ks, 0, "largest distance of the distributions");
        put_number(to, "ks_p", "1", goodness->ks_p, goodness->resamples, "share of resamples under the fit that are as far");
        put_number(to, "ad", "1", goodness->distance.ad * fits->sample.total, 0, "Anderson-Darling");
        put_number(to, "ad_p", "1", goodness->ad_p, goodness->resamples, "share of resamples under the fit that are as far");
    }
    put_parameters(to, fits->families[f], fit, &fits->sample);
}

static void put_comparison(rows *to, const fracas_point_fits *fits)
{
    if (fits->nfits < 2) return;
    const fracas_fit_comparison *comparison = &fits->comparison;
    const char *first = fits->families[fits->best[0]]->name, *second = fits->families[fits->best[1]]->name;
    const bool told = comparison->p < 0.05, first_special = fracas_family_within(fits->families[fits->best[0]], fits->families[fits->best[1]]);
    char note[160];
    if (!isfinite(comparison->p))
        snprintf(note, sizeof note, "%s and %s cannot be compared: too few realizations or refits", first, second);
    else if (comparison->nested)
        snprintf(note, sizeof note, "%s is a special case of %s and %s", first_special ? first : second, first_special ? second : first,
                 told ? "does not suffice" : "suffices");
    else
        snprintf(note, sizeof note, told ? "%s is closer than %s" : "%s and %s cannot be told apart", first, second);
    to->family = "comparison";
    put_number(to, comparison->nested ? "likelihood_ratio" : "vuong", "1", comparison->statistic, 0, note);
    put_number(to, "p", "1", comparison->p, comparison->resamples, note);
}

static fracas_err fit_point(const fracas_analysis *analysis, size_t p, int64_t resamples, fracas_fits *fits)
{
    fracas_point_fits found;
    uint64_t word[2];
    rows to = {.fits = fits, .point = (int64_t)p};
    fracas_hash_words(&analysis->table->point[p].hash, word);
    fracas_hash_hex(&analysis->table->point[p].hash, to.hash);
    size_t nfamilies;
    const fracas_family *const *families = fracas_point_families(analysis->point[p].surface, &nfamilies);
    TRY(fracas_point_fits_of(&analysis->point[p].ensemble, families, nfamilies, resamples, word[0], &found));
    put_data(&to, &found);
    for (size_t f = 0; f < nfamilies; f++) put_family(&to, f, &found);
    put_comparison(&to, &found);
    fracas_point_fits_clear(&found);
    return to.full ? fracas_no_memory("the fits of a study") : FRACAS_OK;
}

/* What study.h5 is now. */
static fracas_err stamp(const char *study, fracas_file_seal *seal)
{
    char *path;
    TRY(fracas_disk_join(study, "study.h5", &path));
    fracas_err err = fracas_disk_seal_path(path, seal);
    free(path);
    return err;
}

fracas_err fracas_fits_create(const fracas_analysis *analysis, const char *study, size_t point, int64_t resamples, fracas_fits **fits)
{
    const size_t npoints = analysis->table->npoints;
    fracas_file_seal seal;
    if (point != SIZE_MAX && point >= npoints)
        return fracas_fail(FRACAS_USAGE, "point %zu: the study has points 0 to %zu", point, npoints - 1);
    TRY(stamp(study, &seal));
    fracas_fits *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("the fits of a study");
    fracas_hash_hex(&analysis->header.campaign, made->campaign);
    made->bytes = seal.bytes;
    made->checksum = seal.checksum;
    made->realizations = (int64_t)fracas_results_realizations(analysis->results);
    fracas_err err = FRACAS_OK;
    for (size_t p = 0; p < npoints && !err; p++)
        if (point == SIZE_MAX || p == point) err = fit_point(analysis, p, resamples, made);
    if (err) fracas_fits_destroy(made);
    else *fits = made;
    return err;
}

fracas_err fracas_fits_complete(fracas_fits *fits, const fracas_fits *older)
{
    const size_t own = fits->n;
    for (size_t i = 0; i < older->n; i++) {
        bool known = false;
        for (size_t k = 0; k < own && !known; k++) known = fits->row[k].point == older->row[i].point;
        if (known) continue;
        fracas_fits_row *row = append(fits);
        if (!row) return fracas_no_memory("the fits of a study");
        *row = older->row[i];
    }
    return FRACAS_OK;
}

const fracas_fits_row *fracas_fits_find(const fracas_fits *fits, int64_t point, const char *family, const char *quantity)
{
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        if (row->point == point && !strcmp(row->family, family) && !strcmp(row->quantity, quantity)) return row;
    return NULL;
}

const char *fracas_fits_ranked(const fracas_fits *fits, int64_t point, int rank)
{
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        if (row->point == point && !strcmp(row->quantity, "rank") && row->value == rank) return row->family;
    return NULL;
}
