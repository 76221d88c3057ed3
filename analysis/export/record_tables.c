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

/* Its numbers are names of the study's probes. */
static bool is_probe(const fracas_store_column *column)
{
    return !strcmp(column->path, "/probe/probe");
}

/* A column of a dataset, or three: momentum_x, momentum_y, momentum_z. */
static void dataset_fields(const fracas_store_column *column, fracas_field_visit *visit,
                           void *context)
{
    const bool outcome = is_outcome(column), text = outcome || is_probe(column);
    fracas_field field = {.key = last_part(column->path),
                          .type = text                             ? FRACAS_FIELD_TEXT
                                  : column->type == FRACAS_FLOAT64 ? FRACAS_FIELD_NUMBER
                                                                   : FRACAS_FIELD_INTEGER,
                          .unit = text ? "" : column->unit,
                          .doc = is_probe(column) ? "name of the probe" : column->description,
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

static void record_fields(const fracas_csv_table *table, const fracas_analysis *analysis,
                          fracas_field_visit *visit, void *context)
{
    (void)analysis;
    for (size_t c = 0; c < PLACE && table->number; c++)
        dataset_fields(&fracas_store_sets[FRACAS_SET_REALIZATION].column[c], visit, context);
    if (table->number)
        visit(context,
              &(fracas_field){table->number, FRACAS_FIELD_INTEGER, "1", table->number_doc});
    for (size_t c = 0; c < fracas_store_sets[table->set].ncolumns; c++)
        dataset_fields(&fracas_store_sets[table->set].column[c], visit, context);
}

static void put_values(const fracas_store_set *set, size_t first, const void *row,
                       const fracas_probes *probes, FILE *out)
{
    for (size_t c = first; c < set->ncolumns; c++) {
        const fracas_store_column *column = &set->column[c];
        const char *value = (const char *)row + column->offset;
        for (size_t i = 0; i < column->width; i++, value += sizeof(int64_t)) {
            if (column->type == FRACAS_FLOAT64)
                fracas_csv_real(*(const double *)(const void *)value, out);
            else if (is_probe(column))
                fprintf(out, ",%s", probes->probe[*(const int64_t *)(const void *)value].name);
            else fprintf(out, ",%" PRId64, *(const int64_t *)(const void *)value);
        }
    }
    putc('\n', out);
}

/* The rows of the table in one realization: itself, or its parts. */
static const void *rows_of(const fracas_csv_table *table, const fracas_stored_realization *of,
                           size_t *count)
{
    for (size_t i = 0; i < FRACAS_NPARTS; i++)
        if (table->parts == 1U << i)
            return fracas_ragged_get(&fracas_record_parts[i], &of->record, count);
    *count = 1;
    return of;
}

typedef struct {
    const fracas_csv_table *table;
    const fracas_probes *probes;
    FILE *out;
} record_printer;

static fracas_err print_rows(void *context, fracas_result *result)
{
    const record_printer *to = context;
    const fracas_record *record = &result->record;
    const fracas_stored_realization whole = {(int64_t)result->point, result->replica, *record};
    const fracas_store_set *set = &fracas_store_sets[to->table->set];
    const bool numbered = to->table->number;
    size_t count;
    const char *row = rows_of(to->table, &whole, &count);
    for (size_t i = 0; i < count; i++) {
        fprintf(to->out, "%zu,%" PRId64 ",%s", result->point, result->replica,
                fracas_outcome_name(record->outcome));
        if (numbered) fprintf(to->out, ",%zu", i);
        put_values(set, numbered ? 0 : PLACE, row + i * set->row_size, to->probes, to->out);
    }
    return FRACAS_OK;
}

static fracas_err record_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                              FILE *out)
{
    record_printer printer = {table, &analysis->header.probes, out};
    return fracas_results_walk(analysis->results, table->parts, print_rows, &printer);
}

const fracas_csv_table fracas_csv_table_realizations = {
    .name = "realizations",
    .doc = "A line a realization, whatever its outcome: how it ended, and its energies",
    .key = {"point", "replica"},
    .parent = &fracas_csv_table_points,
    .fields = record_fields,
    .rows = record_rows,
    .set = FRACAS_SET_REALIZATION,
};
const fracas_csv_table fracas_csv_table_fragments = {
    .name = "fragments",
    .doc = "A line a fragment at the end of its realization, dust included",
    .key = {"point", "replica", "fragment"},
    .parent = &fracas_csv_table_realizations,
    .fields = record_fields,
    .rows = record_rows,
    .set = FRACAS_SET_FRAGMENT,
    .parts = FRACAS_READ_FRAGMENTS,
    .number = "fragment",
    .number_doc = "number of the fragment in its realization, from 0",
};
const fracas_csv_table fracas_csv_table_histories = {
    .name = "histories",
    .doc = "A line a moment of a realization that its history keeps",
    .key = {"point", "replica", "row"},
    .parent = &fracas_csv_table_realizations,
    .fields = record_fields,
    .rows = record_rows,
    .set = FRACAS_SET_HISTORY,
    .parts = FRACAS_READ_HISTORY,
    .number = "row",
    .number_doc = "number of the moment in the history of its realization, from 0",
};
const fracas_csv_table fracas_csv_table_probes = {
    .name = "probes",
    .doc = "A line a probe of a realization at a moment of its history",
    .key = {"point", "replica", "row"},
    .parent = &fracas_csv_table_realizations,
    .fields = record_fields,
    .rows = record_rows,
    .set = FRACAS_SET_PROBE,
    .parts = FRACAS_READ_PROBES,
    .number = "row",
    .number_doc = "number of the line among the probes of its realization, from 0",
};
const fracas_csv_table fracas_csv_table_reactions = {
    .name = "reactions",
    .doc = "A line a held edge of a realization at a moment of its history",
    .key = {"point", "replica", "row"},
    .parent = &fracas_csv_table_realizations,
    .fields = record_fields,
    .rows = record_rows,
    .set = FRACAS_SET_REACTION,
    .parts = FRACAS_READ_REACTIONS,
    .number = "row",
    .number_doc = "number of the line among the reactions of its realization, from 0",
};
