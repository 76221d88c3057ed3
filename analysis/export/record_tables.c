/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations, fragments and moments of histories: the datasets of study.h5 as columns, by the
 * store's own table of them. */
#include "analysis/export/csv.h"

#include "campaigns/store/file/schema.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static const char *last_part(const char *path)
{
    return strrchr(path, '/') + 1;
}

static bool is_outcome(const fracas_store_column *column)
{
    return !strcmp(column->path, "/realization/outcome");
}

/* A column of a dataset, or three: momentum_x, momentum_y, momentum_z. */
static void dataset_fields(const fracas_store_column *column, fracas_field_visit *visit,
                           void *context)
{
    const bool outcome = is_outcome(column);
    fracas_field field = {.key = last_part(column->path),
                          .type = outcome                          ? FRACAS_FIELD_TEXT
                                  : column->type == FRACAS_FLOAT64 ? FRACAS_FIELD_NUMBER
                                                                   : FRACAS_FIELD_INTEGER,
                          .unit = outcome ? "" : column->unit,
                          .doc = column->description,
                          .outcome = outcome};
    if (column->width == 1) {
        visit(context, &field);
        return;
    }
    for (size_t i = 0; i < column->width; i++) {
        char name[64];
        FRACAS_PRINT(name, "%s_%c", last_part(column->path), "xyz"[i]);
        field.key = name;
        visit(context, &field);
    }
}

/* A line begins with the first columns of /realization: of which one it is. */
enum { PLACE = 3 }; /* point, replica, outcome */

static void place_fields(const char *number, const char *doc, fracas_field_visit *visit,
                         void *context)
{
    for (size_t c = 0; c < PLACE; c++)
        dataset_fields(&fracas_store_sets[FRACAS_SET_REALIZATION].column[c], visit, context);
    visit(context, &(fracas_field){number, FRACAS_FIELD_INTEGER, "1", doc});
}

static void put_place(const fracas_result *result, FILE *out)
{
    fprintf(out, "%zu,%" PRId64 ",%s", result->point, result->replica,
            fracas_outcome_name(result->record.outcome));
}

/* The values of a row of a set from column `first` on, and the end of the line. */
static void put_values(fracas_set_name set, size_t first, const void *row, FILE *out)
{
    for (size_t c = first; c < fracas_store_sets[set].ncolumns; c++) {
        const fracas_store_column *column = &fracas_store_sets[set].column[c];
        const char *value = (const char *)row + column->offset;
        for (size_t i = 0; i < column->width;
             i++, value += sizeof(int64_t)) { /* in memory integers are int64_t, reals double */
            if (column->type == FRACAS_FLOAT64)
                fracas_csv_real(*(const double *)(const void *)value, out);
            else fprintf(out, ",%" PRId64, *(const int64_t *)(const void *)value);
        }
    }
    putc('\n', out);
}

typedef struct {
    void (*put)(const fracas_result *result, FILE *out);
    FILE *out;
} record_printer;

static fracas_err print_one(void *context, fracas_result *result)
{
    const record_printer *printer = context;
    printer->put(result, printer->out);
    return FRACAS_OK;
}

static fracas_err put_records(const fracas_analysis *analysis, unsigned parts,
                              void (*put)(const fracas_result *result, FILE *out), FILE *out)
{
    record_printer printer = {put, out};
    return fracas_results_walk(analysis->results, parts, print_one, &printer);
}

/* ---- realizations ---- */

static void realization_fields(const fracas_analysis *analysis, fracas_field_visit *visit,
                               void *context)
{
    (void)analysis;
    for (size_t c = 0; c < fracas_store_sets[FRACAS_SET_REALIZATION].ncolumns; c++)
        dataset_fields(&fracas_store_sets[FRACAS_SET_REALIZATION].column[c], visit, context);
}

static void put_realization(const fracas_result *result, FILE *out)
{
    const fracas_stored_realization row = {(int64_t)result->point, result->replica, result->record};
    put_place(result, out);
    put_values(FRACAS_SET_REALIZATION, PLACE, &row, out);
}

static fracas_err realization_rows(const fracas_analysis *analysis, FILE *out)
{
    return put_records(analysis, 0, put_realization, out);
}

const fracas_csv_table fracas_csv_table_realizations = {
    .name = "realizations",
    .doc = "A line a realization, whatever its outcome: how it ended, and its energies",
    .key = {"point", "replica"},
    .parent = &fracas_csv_table_points,
    .fields = realization_fields,
    .rows = realization_rows,
};

/* ---- fragments ---- */

static void fragment_fields(const fracas_analysis *analysis, fracas_field_visit *visit,
                            void *context)
{
    (void)analysis;
    place_fields("fragment", "number of the fragment in its realization, from 0", visit, context);
    for (size_t c = 0; c < fracas_store_sets[FRACAS_SET_FRAGMENT].ncolumns; c++)
        dataset_fields(&fracas_store_sets[FRACAS_SET_FRAGMENT].column[c], visit, context);
}

static void put_fragments(const fracas_result *result, FILE *out)
{
    const fracas_record *record = &result->record;
    for (size_t i = 0; i < record->nfragment; i++) {
        put_place(result, out);
        fprintf(out, ",%zu", i);
        put_values(FRACAS_SET_FRAGMENT, 0, &record->fragment[i], out);
    }
}

static fracas_err fragment_rows(const fracas_analysis *analysis, FILE *out)
{
    return put_records(analysis, FRACAS_READ_FRAGMENTS, put_fragments, out);
}

const fracas_csv_table fracas_csv_table_fragments = {
    .name = "fragments",
    .doc = "A line a fragment at the end of its realization, dust included",
    .key = {"point", "replica", "fragment"},
    .parent = &fracas_csv_table_realizations,
    .fields = fragment_fields,
    .rows = fragment_rows,
};

/* ---- histories ---- */

static void history_fields(const fracas_analysis *analysis, fracas_field_visit *visit,
                           void *context)
{
    (void)analysis;
    place_fields("row", "number of the moment in the history of its realization, from 0", visit,
                 context);
    for (size_t c = 0; c < fracas_store_sets[FRACAS_SET_HISTORY].ncolumns; c++)
        dataset_fields(&fracas_store_sets[FRACAS_SET_HISTORY].column[c], visit, context);
}

static void put_history(const fracas_result *result, FILE *out)
{
    const fracas_record *record = &result->record;
    for (size_t i = 0; i < record->nhistory; i++) {
        put_place(result, out);
        fprintf(out, ",%zu", i);
        put_values(FRACAS_SET_HISTORY, 0, &record->history[i], out);
    }
}

static fracas_err history_rows(const fracas_analysis *analysis, FILE *out)
{
    return put_records(analysis, FRACAS_READ_HISTORY, put_history, out);
}

const fracas_csv_table fracas_csv_table_histories = {
    .name = "histories",
    .doc = "A line a moment of a realization that its history keeps",
    .key = {"point", "replica", "row"},
    .parent = &fracas_csv_table_realizations,
    .fields = history_fields,
    .rows = history_rows,
};
