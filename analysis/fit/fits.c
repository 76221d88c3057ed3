/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/fits.h"

#include "analysis/fit/point.h"
#include "analysis/summary/study.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void fracas_fits_destroy(fracas_fits *fits)
{
    if (!fits) return;
    free(fits->row);
    free(fits);
}

fracas_err fracas_fits_append(fracas_fits *fits, const fracas_fits_row *row)
{
    TRY(fracas_grow(&fits->row, sizeof *fits->row, fits->n, &fits->room, "the fits of a study"));
    fits->row[fits->n++] = *row;
    return FRACAS_OK;
}

typedef struct {
    fracas_fits *fits;
    int64_t point;
    char hash[FRACAS_HASH_HEX];
    const char *family;
    fracas_err err;
} rows;

static void put(rows *to, const char *quantity, const char *unit, const fracas_interval *value,
                const char *note)
{
    fracas_fits_row row = {.point = to->point,
                           .value = value->value,
                           .low = value->low,
                           .high = value->high,
                           .resamples = value->resamples};
    memcpy(row.hash, to->hash, sizeof row.hash);
    FRACAS_PRINT(row.family, "%s", to->family);
    FRACAS_PRINT(row.quantity, "%s", quantity);
    FRACAS_PRINT(row.unit, "%s", unit);
    FRACAS_PRINT(row.note, "%s", note);
    for (char *at = row.note; (at = strchr(at, ',')); at++)
        *at = ';'; /* the file has commas between its fields alone */
    if (!to->err) to->err = fracas_fits_append(to->fits, &row);
}

static void put_number(rows *to, const char *quantity, const char *unit, double value,
                       int64_t resamples, const char *note)
{
    const fracas_interval alone = {.value = value, .low = NAN, .high = NAN, .resamples = resamples};
    put(to, quantity, unit, &alone, note);
}

/* Fingerprint of the data of a fit: equal for the same realizations, wherever they were read from.
 */
static fracas_hash fingerprint_of(const fracas_ensemble *ensemble)
{
    const uint64_t count[] = {ensemble->nrealizations, ensemble->nfragments, ensemble->surface};
    const size_t n = ensemble->nrealizations, fragments = ensemble->nfragments;
    const fracas_hash part[] = {
        fracas_hash_of(count, sizeof count),
        fracas_hash_of(&ensemble->lattice, sizeof ensemble->lattice),
        fracas_hash_of(ensemble->replica, n * sizeof *ensemble->replica),
        fracas_hash_of(ensemble->first, n ? (n + 1) * sizeof *ensemble->first : 0),
        fracas_hash_of(ensemble->size, fragments * sizeof *ensemble->size),
        fracas_hash_of(ensemble->elements, fragments * sizeof *ensemble->elements),
    };
    return fracas_hash_of(part, sizeof part);
}

/* A body of one piece says only that it did not break. The sizes of the others are fitted, and the
 * number of whole bodies is told. */
static void put_whole(rows *to, const fracas_fit_sample *sample)
{
    char note[160] = "";
    if (sample->whole > 0)
        FRACAS_PRINT(
            note,
            "of %zu realizations are of one piece: the body; left out of the fits, which are "
            "of bodies that break; give this share with them or load harder",
            sample->whole + sample->nrealizations);
    put_number(to, "whole", "1", (double)sample->whole, 0, note);
}

static void put_data(rows *to, const fracas_ensemble *ensemble, const fracas_point_fits *fits)
{
    const fracas_fit_sample *sample = &fits->sample;
    const fracas_hash fingerprint = fingerprint_of(ensemble);
    to->family = "data";
    put_number(to, "fingerprint", "", NAN, 0, fracas_hash_hex(&fingerprint).text);
    put_number(to, "realizations", "1", (double)ensemble->nrealizations, 0, "usable");
    put_whole(to, sample);
    put_number(to, "fragments", "1", (double)sample->fragments, 0, "of these");
    put_number(to, "above_cut", "1", sample->total, 0, "fragments that are fitted");
    put_number(to, "cut", "m", sample->cut, 0, "sizes above are fitted");
    put_number(to, "lattice", "m", sample->lattice, 0, "every size is a multiple; 0: they are not");
    put_number(to, "cells", "1", (double)sample->ncells, 0,
               "of size; in which fragments are counted");
    put(to, "mean", "m", &fits->mean, "of the sizes above the cut");
    put(to, "cv", "1", &fits->cv, "their deviation/mean");
}

static void put_parameters(rows *to, const fracas_family *family, const fracas_family_fit *fit,
                           const fracas_fit_sample *sample)
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
        FRACAS_PRINT(name, "%s/mean", parameter->name);
        if (parameter->length)
            put(to, name, "1", &relative, "over the mean of the sizes above the cut");
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
        put_number(to, "ks", "1", goodness->distance.ks, 0,
                   "largest distance of the distributions");
        put_number(to, "ks_p", "1", goodness->ks_p, goodness->resamples,
                   "share of resamples under the fit that are as far");
        put_number(to, "ad", "1", goodness->distance.ad * fits->sample.total, 0,
                   "Anderson-Darling");
        put_number(to, "ad_p", "1", goodness->ad_p, goodness->resamples,
                   "share of resamples under the fit that are as far");
    }
    put_parameters(to, fits->families[f], fit, &fits->sample);
}

static void put_comparison(rows *to, const fracas_point_fits *fits)
{
    if (fits->nfits < 2) return;
    const fracas_fit_comparison *comparison = &fits->comparison;
    const char *first = fits->families[fits->best[0]]->name,
               *second = fits->families[fits->best[1]]->name;
    const bool told = comparison->p < 0.05,
               first_special = fracas_family_within(fits->families[fits->best[0]],
                                                    fits->families[fits->best[1]]);
    char note[160];
    if (!isfinite(comparison->p))
        FRACAS_PRINT(note, "%s and %s cannot be compared: too few realizations or refits", first,
                     second);
    else if (comparison->nested)
        FRACAS_PRINT(note, "%s is a special case of %s and %s", first_special ? first : second,
                     first_special ? second : first, told ? "does not suffice" : "suffices");
    else
        FRACAS_PRINT(note, told ? "%s is closer than %s" : "%s and %s cannot be told apart", first,
                     second);
    to->family = "comparison";
    put_number(to, comparison->nested ? "likelihood_ratio" : "vuong", "1", comparison->statistic, 0,
               note);
    put_number(to, "p", "1", comparison->p, comparison->resamples, note);
}

fracas_hash fracas_fits_fingerprint(const fracas_analysis *analysis, size_t point)
{
    return fingerprint_of(&analysis->point[point].ensemble);
}

fracas_err fracas_fits_add_point(const fracas_analysis *analysis, size_t p, int64_t resamples,
                                 fracas_fits *fits)
{
    FRACAS_CLEARED(fracas_point_fits) found;
    uint64_t word[2];
    rows to = {.fits = fits, .point = (int64_t)p};
    fracas_hash_words(&analysis->table->point[p].hash, word);
    memcpy(to.hash, fracas_hash_hex(&analysis->table->point[p].hash).text, FRACAS_HASH_HEX);
    size_t nfamilies;
    const fracas_family *const *families = fracas_point_families(analysis->point[p].surface,
                                                                 &nfamilies);
    TRY(fracas_point_fits_of(&analysis->point[p].ensemble, families, nfamilies, resamples, word[0],
                             &found));
    put_data(&to, &analysis->point[p].ensemble, &found);
    for (size_t f = 0; f < nfamilies; f++) put_family(&to, f, &found);
    put_comparison(&to, &found);
    return to.err;
}

fracas_err fracas_fits_begin(const fracas_analysis *analysis, fracas_fits **fits)
{
    *fits = calloc(1, sizeof **fits);
    if (!*fits) return fracas_no_memory("the fits of a study");
    memcpy((*fits)->campaign, fracas_hash_hex(&analysis->header.campaign).text, FRACAS_HASH_HEX);
    (*fits)->realizations = (int64_t)fracas_results_realizations(analysis->results);
    return FRACAS_OK;
}

fracas_err fracas_fits_create(const fracas_analysis *analysis, size_t point, int64_t resamples,
                              fracas_fits **fits)
{
    const size_t npoints = analysis->table->npoints;
    if (point != SIZE_MAX && point >= npoints)
        return fracas_fail(FRACAS_USAGE, "point %zu: the study has points 0 to %zu", point,
                           npoints - 1);
    OWN(fracas_fits) made = NULL;
    TRY(fracas_fits_begin(analysis, &made));
    for (size_t p = 0; p < npoints; p++)
        if (point == SIZE_MAX || p == point)
            TRY(fracas_fits_add_point(analysis, p, resamples, made));
    *fits = made;
    made = NULL;
    return FRACAS_OK;
}

/* The point of this hash, SIZE_MAX if there is none; `near` is tried first. */
static size_t point_of(const fracas_analysis *analysis, const char *hash, size_t near)
{
    const size_t npoints = analysis->table->npoints;
    for (size_t k = 0; k <= npoints; k++) {
        const size_t p = k ? k - 1 : near;
        if (p >= npoints) continue;
        if (!strcmp(fracas_hash_hex(&analysis->table->point[p].hash).text, hash)) return p;
    }
    return SIZE_MAX;
}

/* Whether rows `begin` to `end` - 1 of one point are from the realizations of point p of the
 * analysis. */
static bool is_of(const fracas_fits *fits, size_t begin, size_t end,
                  const fracas_analysis *analysis, size_t p)
{
    if (p == SIZE_MAX) return false;
    const fracas_hash fingerprint = fingerprint_of(&analysis->point[p].ensemble);
    for (size_t i = begin; i < end; i++)
        if (!strcmp(fits->row[i].quantity, "fingerprint"))
            return !strcmp(fits->row[i].note, fracas_hash_hex(&fingerprint).text);
    return false;
}

void fracas_fits_keep(fracas_fits *fits, const fracas_analysis *analysis, size_t *stale)
{
    size_t kept = 0;
    *stale = 0;
    for (size_t begin = 0, end; begin < fits->n; begin = end) {
        const fracas_fits_row *first = &fits->row[begin];
        for (end = begin + 1; end < fits->n && !strcmp(fits->row[end].hash, first->hash);) end++;
        const size_t p = point_of(analysis, first->hash, (size_t)first->point);
        if (!is_of(fits, begin, end, analysis, p)) {
            ++*stale;
            continue;
        }
        for (size_t i = begin; i < end; i++) {
            fits->row[kept] = fits->row[i];
            fits->row[kept++].point = (int64_t)p;
        }
    }
    fits->n = kept;
}

fracas_err fracas_shown_fits_read(const char *study, const fracas_analysis *analysis,
                                  fracas_shown_fits *shown)
{
    *shown = (fracas_shown_fits){0};
    if (!fracas_fits_read(study, &shown->fits)) {
        if (shown->fits) fracas_fits_keep(shown->fits, analysis, &shown->stale);
        return FRACAS_OK;
    }
    return fracas_path(&shown->left_out, "the fits are left out: %s", fracas_message());
}

void fracas_shown_fits_clear(fracas_shown_fits *shown)
{
    fracas_fits_destroy(shown->fits);
    free(shown->left_out);
    *shown = (fracas_shown_fits){0};
}

fracas_err fracas_fits_complete(fracas_fits *fits, const fracas_fits *older)
{
    const size_t own = fits->n;
    for (size_t i = 0; i < older->n; i++) {
        bool known = false;
        for (size_t k = 0; k < own && !known; k++)
            known = fits->row[k].point == older->row[i].point;
        if (!known) TRY(fracas_fits_append(fits, &older->row[i]));
    }
    return FRACAS_OK;
}

const fracas_fits_row *fracas_fits_find(const fracas_fits *fits, int64_t point, const char *family,
                                        const char *quantity)
{
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        if (row->point == point && !strcmp(row->family, family) && !strcmp(row->quantity, quantity))
            return row;
    return NULL;
}

double fracas_fits_value(const fracas_fits *fits, int64_t point, const char *family,
                         const char *quantity)
{
    const fracas_fits_row *row = fracas_fits_find(fits, point, family, quantity);
    return row ? row->value : NAN;
}

const char *fracas_fits_ranked(const fracas_fits *fits, int64_t point, int rank)
{
    for (const fracas_fits_row *row = fits->row; row < fits->row + fits->n; row++)
        if (row->point == point && !strcmp(row->quantity, "rank") && row->value == rank)
            return row->family;
    return NULL;
}
