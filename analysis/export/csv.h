/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of a study as CSV: names in the first line, numbers to 15 digits in SI, nothing for a
 * missing value. */
#ifndef FRACAS_ANALYSIS_EXPORT_CSV_H
#define FRACAS_ANALYSIS_EXPORT_CSV_H

#include "analysis/data/field.h"
#include "analysis/summary/study.h"

enum { FRACAS_TABLE_KEY = 3 };

enum { FRACAS_TABLE_PARTS = 3 };

typedef struct fracas_csv_table {
    const char *name;                      /* for the file, before ".csv" */
    const char *doc;                       /* meaning of a line */
    const char *key[FRACAS_TABLE_KEY];     /* columns identifying a line, then NULL */
    const struct fracas_csv_table *parent; /* the first columns are its key; NULL: none */
    const fracas_fields *columns[FRACAS_TABLE_PARTS]; /* one after the other, NULL behind them */
    void (*fields)(const struct fracas_csv_table *table, const fracas_analysis *analysis,
                   fracas_field_visit *visit, void *context); /* without `columns` */
    fracas_err (*rows)(const struct fracas_csv_table *table, const fracas_analysis *analysis,
                       FILE *out);   /* reads the study again, in its order, where it must */
    int set;                         /* fracas_set_name of a table of records, ... */
    unsigned parts;                  /* ... the part of a result to read for it, ... */
    const char *number, *number_doc; /* ... and the column of its place there; NULL: none */
} fracas_csv_table;

/* A line a point: index and hash, every parameter, every statistic (the keys of the JSON summary),
 * outcomes. A line a realization, a fragment, a moment of a history, of a probe: the datasets of
 * study.h5. A line a statistic of a point, with its unit. */
extern const fracas_csv_table fracas_csv_table_points, fracas_csv_table_realizations,
    fracas_csv_table_fragments, fracas_csv_table_histories, fracas_csv_table_probes,
    fracas_csv_table_reactions, fracas_csv_table_statistics;

/* A line a time of a point: its energies, mean and band; a number of replicas: the headline numbers
 * from the first 4, 8, 16, ... and from all; a slope of mean size against strain rate: `kind` line,
 * through all points of a series, or window, between two rates. */
extern const fracas_csv_table fracas_csv_table_energies, fracas_csv_table_convergence,
    fracas_csv_table_slopes;
/* A line a change of means from one value of a parameter to the next: in all settings of the
 * others, and in each. */
extern const fracas_csv_table fracas_csv_table_effects;
/* A line a crack, and a line a break, of surfaces that keep their interfaces. */
extern const fracas_csv_table fracas_csv_table_cracks, fracas_csv_table_breaks;

/* Every column. */
void fracas_csv_fields(const fracas_csv_table *table, const fracas_analysis *analysis,
                       fracas_field_visit *visit, void *context);

/* The head and the lines of a table as folder/NAME.csv, whole or not there; equal bytes for equal
 * study.h5. */
FRACAS_MUST_USE fracas_err fracas_csv_file(const fracas_csv_table *table,
                                           const fracas_analysis *analysis, const char *folder);

/* FRACAS_USAGE if the folder has a file of one of these tables, up to a NULL, and no report or
 * export wrote it (fracas_output_free). */
FRACAS_MUST_USE fracas_err fracas_csv_free(const fracas_csv_table *const *table,
                                           const char *folder);

#endif
