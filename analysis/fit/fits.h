/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The fits of a study as rows: the contents of STUDY/fits.csv (docs/formats/study.md), for terminal
 * and report. */
#ifndef FRACAS_ANALYSIS_FIT_FITS_H
#define FRACAS_ANALYSIS_FIT_FITS_H

#include "analysis/analysis.h"
#include "analysis/fit/family.h"
#include "base/err.h"
#include "base/hash.h"
#include "base/own.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* One number. */
typedef struct {
    int64_t point;              /* in the study */
    char hash[FRACAS_HASH_HEX]; /* for the point */
    char family[24];            /* or "data", "comparison" */
    char quantity[24], unit[8];
    double value, low, high; /* NaN: none */
    int64_t resamples;       /* behind the interval or the p-value; 0: none */
    char note[160];          /* no comma, no line feed */
} fracas_fits_row;

typedef struct {
    char campaign[FRACAS_HASH_HEX]; /* for the study that was fitted */
    int64_t realizations;           /* it had then */
    size_t n, room;
    fracas_fits_row *row; /* point by point */
} fracas_fits;

enum { FRACAS_FITS_RESAMPLES = 999 };
#define FRACAS_FITS_FILE "fits.csv"

/* Fits every point of the analysis, whole or partial, or `point` alone (else SIZE_MAX).
 * Deterministic: seeds are of the points' hashes. FRACAS_USAGE for an unknown point. */
FRACAS_MUST_USE fracas_err fracas_fits_create(const fracas_analysis *analysis, size_t point,
                                              int64_t resamples, fracas_fits **fits);
/* Fits of the analysis, without a row. */
FRACAS_MUST_USE fracas_err fracas_fits_begin(const fracas_analysis *analysis, fracas_fits **fits);
/* Appends the rows of one point. */
FRACAS_MUST_USE fracas_err fracas_fits_add_point(const fracas_analysis *analysis, size_t point,
                                                 int64_t resamples, fracas_fits *fits);

/* How the points of a study are fitted. */
typedef struct {
    int jobs;          /* processes at a time, 1 or more: the fits are the same */
    const char *study; /* its folder, for what is saved on the way */
    /* Told at the beginning, and after each point: so many of all are done, `saved` of them by an
     * earlier call. NULL: nobody. */
    void (*progress)(void *context, size_t done, size_t saved, size_t all);
    void *context;
} fracas_fits_work;

/* Fits every point, each in a process of its own. Each point is saved in STUDY/fits.csv.part when
 * it is done, and taken from there by a later call of the same version with the same realizations
 * and resamples: an interrupted call loses only what it was computing. FRACAS_ENVIRONMENT while
 * another process does the same. fracas_fits_forget_part, once the fits are written. */
FRACAS_MUST_USE fracas_err fracas_fits_create_by(const fracas_analysis *analysis, int64_t resamples,
                                                 const fracas_fits_work *work, fracas_fits **fits);
#define FRACAS_FITS_PART FRACAS_FITS_FILE ".part"
void fracas_fits_forget_part(const char *study);

/* A hash of the realizations of a point that fits are of. */
fracas_hash fracas_fits_fingerprint(const fracas_analysis *analysis, size_t point);

/* A row as a line of the file, and back: *row is changed, false for a line that is none. */
void fracas_fits_put_row(const fracas_fits_row *row, FILE *out);
bool fracas_fits_take_row(char *line, fracas_fits_row *row);

void fracas_fits_destroy(fracas_fits *fits); /* NULL is allowed */
FRACAS_OWNER(fracas_fits, fracas_fits_destroy)

/* Adds a copy of the row behind the others; fits to begin with may be {0}. FRACAS_ENVIRONMENT
 * without memory. */
FRACAS_MUST_USE fracas_err fracas_fits_append(fracas_fits *fits, const fracas_fits_row *row);

/* STUDY/fits.csv, whole: temporary, synced, renamed. */
FRACAS_MUST_USE fracas_err fracas_fits_write(const fracas_fits *fits, const char *study);
/* *fits: NULL if there is no file. FRACAS_DAMAGED for a file unlike its seal, and for
 * one of an older version, which nothing can check. */
FRACAS_MUST_USE fracas_err fracas_fits_read(const char *study, fracas_fits **fits);
/* True of a file that no fit wrote: not empty, with neither our first line nor a seal. A link is
 * none, and replaced. */
bool fracas_fits_foreign(const char *study);
/* True if there is a file of an older version, without a seal. */
bool fracas_fits_older(const char *study);
/* Keeps the rows of points of the analysis, by hash and under their numbers in it, if their usable
 * realizations are the fitted ones; the others go. *stale: fitted points that are gone. It does not
 * matter whether the study is complete, where its realizations were read from and which other
 * points it has. */
void fracas_fits_keep(fracas_fits *fits, const fracas_analysis *analysis, size_t *stale);
/* The fits of a study as its reports show them. */
typedef struct {
    fracas_fits *fits; /* fracas_fits_keep; NULL if there are none */
    size_t stale;
    char *left_out; /* why the file is left out, with the remedy; NULL: it is not */
} fracas_shown_fits;

/* Reads them; a file unreadable or unlike its seal is left out. Cleared by the caller. */
FRACAS_MUST_USE fracas_err fracas_shown_fits_read(const char *study,
                                                  const fracas_analysis *analysis,
                                                  fracas_shown_fits *shown);
void fracas_shown_fits_clear(fracas_shown_fits *shown);

/* Takes over the rows of `older` for points without rows in `fits`; both must be of the same
 * analysis. */
FRACAS_MUST_USE fracas_err fracas_fits_complete(fracas_fits *fits, const fracas_fits *older);

/* NULL if there is no such row. */
const fracas_fits_row *fracas_fits_find(const fracas_fits *fits, int64_t point, const char *family,
                                        const char *quantity);
/* The number of this row; NaN if there is none. */
double fracas_fits_value(const fracas_fits *fits, int64_t point, const char *family,
                         const char *quantity);
/* The family of this rank by AICc, from 1, at the point; NULL for none. */
const char *fracas_fits_ranked(const fracas_fits *fits, int64_t point, int rank);

#endif
