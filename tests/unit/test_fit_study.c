/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas fit of a study: its rows, its file, whether they are of the realizations that a study has,
 * and points that cannot be fitted. */
#include "tests/support/report.h"

#include "analysis/export/tables.h"
#include "analysis/summary/study.h"
#include "tests/support/fit_sample.h"

#include <gsl/gsl_errno.h>

enum { NPOINTS = 4, NCOLUMNS = 8, RESAMPLES = 99 };

static const fracas_column column[NCOLUMNS] = {
    {"derived.lattice", "m", "lattice", false},
    {"derived.length", "m", "length", false},
    {"derived.strain_rate", "1/s", "rate", false},
    {"derived.surface", "1", "surface", false},
    {"loading.rate", "1/s", "rate", false},
    {"mesh.elements", "1", "elements", false},
    {"model", "", "model", true},
    {"time.end", "s", "end", false},
};

/* Point 0: shifted Rayleigh on a lattice of 20 um; 1: one realization of three fragments; 2: a
 * surface; 3: nothing usable. */
static const synthetic law[3] = {
    {.family = &fracas_family_shifted_rayleigh,
     .parameter = {200e-6, 200e-6},
     .lattice = 20e-6,
     .realizations = 1,
     .fragments = 60},
    {.family = &fracas_family_exponential,
     .parameter = {400e-6},
     .lattice = 20e-6,
     .realizations = 1,
     .fragments = 4},
    {.family = &fracas_family_lognormal,
     .parameter = {1e-3, 0.4},
     .realizations = 1,
     .fragments = 50},
};

typedef struct {
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row point[NPOINTS];
    fracas_point_table table;
} made_table;

static void make_table(made_table *made, int64_t replicas)
{
    static const int64_t few[NPOINTS] = {0, 1, 0, 2};
    for (size_t p = 0; p < NPOINTS; p++) {
        const bool surface = p == 2;
        const double rate = pow(10, 3 + (double)p);
        const double lattice = surface ? 0 : 20e-6, length = surface ? NAN : 20e-3,
                     elements = surface ? NAN : 1000;
        const double real[NCOLUMNS] = {lattice, length, rate, surface, rate, elements, NAN, 1e-6};
        for (size_t c = 0; c < NCOLUMNS; c++)
            made->value[p][c] = (fracas_value){.real = real[c],
                                               .text = c == 6 ? surface ? "shell" : "bar" : ""};
        made->point[p] = (fracas_point_row){.hash = fracas_hash_of(&p, sizeof p),
                                            .replicas = few[p] ? few[p] : replicas,
                                            .value = made->value[p]};
    }
    made->table = (fracas_point_table){
        .ncolumns = NCOLUMNS, .column = column, .npoints = NPOINTS, .point = made->point};
}

static void make_record(const void *context, size_t point, int64_t replica, fracas_record *record)
{
    gsl_rng *random = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(random, (unsigned long)(1 + 1000 * point) + (unsigned long)replica);
    if (point == 3) fracas_record_init(record);
    else synthetic_realization(&law[point], random, record);
    record->outcome = point == 3 ? FRACAS_NONFINITE : FRACAS_FRAGMENTED;
    gsl_rng_free(random);
}

static void write_study(const char *folder, int64_t replicas)
{
    made_table made;
    make_table(&made, replicas);
    const fracas_file_header header = {
        .campaign = fracas_hash_of(folder, 1), .seed = 1, .version = "test", .complete = true};
    report_write_study(folder, &header, &made.table, make_record, NULL);
}

static fracas_fits *fit(const char *folder, size_t point, FILE *out)
{
    OWN(fracas_analysis) analysis;
    fracas_fits *fits = NULL;
    OK(fracas_analysis_create(folder, NULL, NULL, &analysis));
    OK(fracas_fits_create(analysis, point, RESAMPLES, &fits));
    if (out) fracas_fits_print(fits, analysis, 0, out);
    return fits;
}

static double value_of(const fracas_fits *fits, int64_t point, const char *family,
                       const char *quantity)
{
    const fracas_fits_row *row = fracas_fits_find(fits, point, family, quantity);
    if (!row) fail_msg("no %s of %s at point %lld", quantity, family, (long long)point);
    return row->value;
}

static void same_rows(const fracas_fits *a, const fracas_fits *b)
{
    assert_int_equal(a->n, b->n);
    for (size_t i = 0; i < a->n; i++) {
        const fracas_fits_row *x = &a->row[i], *y = &b->row[i];
        assert_true(x->point == y->point && x->resamples == y->resamples);
        assert_string_equal(x->hash, y->hash);
        assert_string_equal(x->family, y->family);
        assert_string_equal(x->quantity, y->quantity);
        assert_string_equal(x->unit, y->unit);
        assert_string_equal(x->note, y->note);
        assert_true(x->value == y->value || (isnan(x->value) && isnan(y->value)));
        assert_true(x->low == y->low || (isnan(x->low) && isnan(y->low)));
        assert_true(x->high == y->high || (isnan(x->high) && isnan(y->high)));
    }
}

/* The truth is ranked first or beside it (delta below 10; a Weibull with a shift holds it too), and
 * its shift, 200 um, is within four half widths of its interval: eight standard errors of 2400
 * fragments. */
static void fits_of_a_study(void **state)
{
    char folder[320];
    snprintf(folder, sizeof folder, "%s/one", report_root);
    write_study(folder, 40);
    FILE *out = text_begin();
    OWN(fracas_fits) fits = fit(folder, SIZE_MAX, out), *read = NULL;
    OWNED char *text = text_end(out);
    print_message("%s", text);
    assert_has(text, "shifted-rayleigh");
    assert_has(text, "fragments above the cut; 30 are needed");
    const fracas_fits_row *shift = fracas_fits_find(fits, 0, "shifted-rayleigh", "x0");
    assert_true(value_of(fits, 0, "shifted-rayleigh", "delta_aicc") < 10 &&
                value_of(fits, 0, "shifted-rayleigh", "fitted") == 1);
    assert_true(shift->low < shift->value && shift->value < shift->high &&
                shift->resamples > 0.9 * RESAMPLES);
    assert_true(fabs(shift->value - 200e-6) < 2 * (shift->high - shift->low));
    assert_true(fabs(value_of(fits, 0, "data", "cut") - 30e-6) < 1e-12 &&
                value_of(fits, 0, "data", "realizations") == 40);
    assert_true(value_of(fits, 0, "shifted-rayleigh", "ks_p") > 1e-2 &&
                value_of(fits, 0, "exponential", "ks_p") == 1.0 / (RESAMPLES + 1));
    const double relative = value_of(fits, 0, "shifted-rayleigh", "x0/mean") *
                            value_of(fits, 0, "data", "mean");
    assert_true(fabs(relative - shift->value) < 1e-9 * shift->value);
    assert_string_equal(fracas_fits_ranked(fits, 2, 1), "lognormal");
    assert_null(fracas_fits_find(fits, 2, "mott", "fitted")); /* a law of masses */
    assert_null(fracas_fits_ranked(fits, 1, 1));
    assert_true(value_of(fits, 1, "gamma", "fitted") == 0 &&
                value_of(fits, 3, "gamma", "fitted") == 0);
    OK(fracas_fits_read(folder, &read));
    assert_null(read);
    OK(fracas_fits_write(fits, folder));
    OK(fracas_fits_read(folder, &read));
    assert_string_equal(read->campaign, fits->campaign);
    assert_int_equal(read->realizations, 40 + 1 + 40 + 2);
    same_rows(fits, read);
}

/* Rows that are kept of what was fitted in `folder`, in a study of so many replicas. */
static size_t keep(const char *folder, const char *other, size_t *stale, fracas_fits **fits)
{
    OWN(fracas_analysis) analysis;
    OK(fracas_fits_read(folder, fits));
    OK(fracas_analysis_create(other, NULL, NULL, &analysis));
    fracas_fits_keep(*fits, analysis, stale);
    return (*fits)->n;
}

/* Fits are of realizations, not of files: the same in another study are fitted already, and where
 * some points have more, those alone are stale. Points that have changed places keep theirs, under
 * the new number. */
static void fits_of_the_same_realizations(void **state)
{
    char folder[320], other[320];
    size_t stale;
    fracas_fits *kept;
    snprintf(folder, sizeof folder, "%s/kept", report_root);
    snprintf(other, sizeof other, "%s/other", report_root);
    write_study(folder, 12);
    fracas_fits *fits = fit(folder, SIZE_MAX, NULL);
    OK(fracas_fits_write(fits, folder));
    keep(folder, folder, &stale, &kept);
    assert_int_equal(stale, 0);
    same_rows(fits, kept);
    fracas_fits_destroy(kept);
    write_study(other, 13); /* points 0 and 2 have one more */
    assert_true(keep(folder, other, &stale, &kept) < fits->n);
    assert_int_equal(stale, 2);
    assert_true(!fracas_fits_find(kept, 0, "data", "cut") &&
                !fracas_fits_find(kept, 2, "data", "cut"));
    assert_true(fracas_fits_find(kept, 1, "data", "cut") &&
                fracas_fits_find(kept, 3, "data", "cut"));
    fracas_fits_destroy(kept);
    for (size_t i = 0; i < fits->n; i++) fits->row[i].point = NPOINTS - 1 - fits->row[i].point;
    OK(fracas_fits_write(fits, other));
    fracas_fits_destroy(fits);
    fits = fit(folder, SIZE_MAX, NULL);
    keep(other, folder, &stale, &kept);
    assert_int_equal(stale, 0);
    same_rows(fits, kept);
    fracas_fits_destroy(kept);
    for (size_t i = 0; i < fits->n; i++) /* another realization of as many fragments */
        if (fits->row[i].point == 2 && !strcmp(fits->row[i].quantity, "fingerprint"))
            fits->row[i].note[5] ^= 1;
    OK(fracas_fits_write(fits, other));
    keep(other, folder, &stale, &kept);
    assert_int_equal(stale, 1);
    fracas_fits_destroy(kept);
    fracas_fits_destroy(fits);
}

/* A point fitted alone has the same rows as with the others, which are taken over. */
static void one_point(void **state)
{
    char folder[320];
    snprintf(folder, sizeof folder, "%s/two", report_root);
    write_study(folder, 12);
    OWN(fracas_analysis) analysis;
    fracas_fits *all = fit(folder, SIZE_MAX, NULL), *one = fit(folder, 0, NULL);
    assert_true(one->n < all->n && one->row[one->n - 1].point == 0);
    OK(fracas_fits_complete(one, all));
    same_rows(one, all);
    fracas_fits_destroy(one);
    OK(fracas_analysis_create(folder, NULL, NULL, &analysis));
    FAILS(fracas_fits_create(analysis, NPOINTS, RESAMPLES, &one), FRACAS_USAGE,
          "point 4: the study has points 0 to 3");
    fracas_fits_destroy(all);
}

/* Writes these lines with their seal. */
static void write_sealed(const char *path, const char *lines)
{
    char all[600];
    snprintf(all, sizeof all, "%s,,study,seal,,,,,,%016llx\n", lines,
             (unsigned long long)fracas_checksum_of(lines, strlen(lines)));
    write_bytes(path, all, strlen(all));
}

static void damaged_files(void **state)
{
    static const char *const line[] = {
        "point,hash\n",
        "point,hash,family,quantity,unit,value,low,high,resamples,note\n0,aa,gamma,k,1,1.5,,,\n",
        "point,hash,family,quantity,unit,value,low,high,resamples,note\n0,aa,gamma,k,1,1.5x,,,,\n",
        "point,hash,family,quantity,unit,value,low,high,resamples,note\n0,aa,gamma,k,1,1.5,,,-3,\n",
        "point,hash,family,quantity,unit,value,low,high,resamples,note\n0,aa,gamma,k,1,1.5,,,,cut "
        "short",
        "point,hash,family,quantity,unit,value,low,high,resamples,note\n0,aa,a-family-of-more-than-"
        "twenty-three-letters,k,1,1,,,,\n",
    };
    char path[340];
    fracas_fits *fits;
    snprintf(path, sizeof path, "%s/fits.csv", report_root);
    for (size_t i = 0; i < sizeof line / sizeof *line; i++) {
        write_sealed(path, line[i]);
        FAILS(fracas_fits_read(report_root, &fits), FRACAS_DAMAGED,
              i ? "line 2 is none of ours" : "line 1 is not");
        assert_null(fits);
    }
}

/* No flipped bit, lost end or added line of fits.csv passes, and none becomes an older file. */
static void every_flipped_bit_is_found(void **state)
{
    fracas_fits_row row = {.family = "gamma", .quantity = "k", .unit = "1", .value = 1.5e-4};
    fracas_fits made = {.n = 1, .row = &row}, *fits;
    char path[340], bytes[1024];
    memcpy(row.hash, "0123456789abcdef0123456789abcdef", sizeof row.hash);
    snprintf(path, sizeof path, "%s/fits.csv", report_root);
    OK(fracas_fits_write(&made, report_root));
    OK(fracas_fits_read(report_root, &fits));
    assert_true(fits->n == 1 && fits->row->value == 1.5e-4);
    fracas_fits_destroy(fits);
    FILE *in = fopen(path, "r");
    assert_non_null(in);
    const size_t size = fread(bytes, 1, sizeof bytes, in);
    fclose(in);
    for (size_t bit = 0; bit < 8 * size; bit++) {
        bytes[bit / 8] ^= (char)(1 << bit % 8);
        write_bytes(path, bytes, size);
        FAILS(fracas_fits_read(report_root, &fits), FRACAS_DAMAGED, "damaged: its last line");
        assert_false(fracas_fits_older(report_root));
        bytes[bit / 8] ^= (char)(1 << bit % 8);
    }
    for (size_t left = 0; left < size; left++) {
        write_bytes(path, bytes, left);
        FAILS(fracas_fits_read(report_root, &fits), FRACAS_DAMAGED, "fracas fit");
    }
    memcpy(bytes + size, "0,aa,gamma,k,1,2,,,,\n", 21);
    write_bytes(path, bytes, size + 21);
    FAILS(fracas_fits_read(report_root, &fits), FRACAS_DAMAGED, "damaged: its last line");
}

TESTS_ALL(report_make_root, report_remove_root, fits_of_a_study, fits_of_the_same_realizations,
          one_point, damaged_files, every_flipped_bit_is_found)
