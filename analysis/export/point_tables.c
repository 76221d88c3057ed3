/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is known of each point: points.csv, a column a number, and statistics.csv, a line a number.
 */
#include "analysis/export/csv.h"

#include <inttypes.h>
#include <stdio.h>

/* "outcome.FAILED": how many realizations of the point ended so. */
static const char *outcome_key(int outcome, char key[32])
{
    snprintf(key, 32, "outcome.%s", fracas_outcome_name(outcome));
    return key;
}

static const char outcome_doc[] = "realizations of the point that ended so";

static void put_statistic(const fracas_point_statistics *statistics, const fracas_statistic *what,
                          FILE *out)
{
    const void *value = (const char *)statistics + what->offset;
    if (what->integer) fprintf(out, ",%" PRId64, *(const int64_t *)value);
    else fracas_csv_real(*(const double *)value, out);
}

static void point_fields(const fracas_analysis *analysis, fracas_field_sink *sink, void *context)
{
    const fracas_point_table *table = analysis->table;
    sink(context,
         &(fracas_field){"point", FRACAS_FIELD_INTEGER, "1",
                         "number of the point, from 0: its row in /point of study.h5", false});
    sink(context,
         &(fracas_field){"hash", FRACAS_FIELD_TEXT, "",
                         "hash of the point's resolved values, 32 hexadecimal digits", false});
    sink(context, &(fracas_field){"replicas", FRACAS_FIELD_INTEGER, "1",
                                  "replicas planned at the point", false});
    for (size_t c = 0; c < table->ncolumns; c++) {
        const fracas_column *column = &table->column[c];
        sink(context,
             &(fracas_field){column->path, column->text ? FRACAS_FIELD_TEXT : FRACAS_FIELD_NUMBER,
                             column->unit, column->doc, false});
    }
    for (size_t i = 0; i < fracas_nstatistics; i++) {
        const fracas_statistic *what = &fracas_statistics[i];
        sink(context,
             &(fracas_field){what->key, what->integer ? FRACAS_FIELD_INTEGER : FRACAS_FIELD_NUMBER,
                             what->unit, what->doc, false});
    }
    for (int o = 0; o < FRACAS_NOUTCOMES; o++) {
        char key[32];
        sink(context,
             &(fracas_field){outcome_key(o, key), FRACAS_FIELD_INTEGER, "1", outcome_doc, false});
    }
}

static void put_parameter(const fracas_point_table *table, size_t p, size_t c, FILE *out)
{
    if (!table->column[c].text) {
        fracas_csv_real(table->point[p].value[c].real, out);
        return;
    }
    putc(',', out);
    fracas_csv_text(table->point[p].value[c].text, out);
}

static fracas_err point_rows(const fracas_analysis *analysis, FILE *out)
{
    const fracas_point_table *table = analysis->table;
    for (size_t p = 0; p < table->npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        char hash[FRACAS_HASH_HEX];
        fracas_hash_hex(&table->point[p].hash, hash);
        fprintf(out, "%zu,%s,%" PRId64, p, hash, table->point[p].replicas);
        for (size_t c = 0; c < table->ncolumns; c++) put_parameter(table, p, c, out);
        for (size_t i = 0; i < fracas_nstatistics; i++)
            put_statistic(statistics, &fracas_statistics[i], out);
        for (int o = 0; o < FRACAS_NOUTCOMES; o++)
            fprintf(out, ",%" PRId64, statistics->outcome[o]);
        putc('\n', out);
    }
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_points = {
    .name = "points",
    .doc = "A line a point: its parameters as resolved, its statistics over realizations, and how "
           "many ended how",
    .key = {"point"},
    .fields = point_fields,
    .rows = point_rows,
};

static void statistic_fields(const fracas_analysis *analysis, fracas_field_sink *sink,
                             void *context)
{
    (void)analysis;
    sink(context,
         &(fracas_field){"point", FRACAS_FIELD_INTEGER, "1", "number of the point, from 0", false});
    sink(context, &(fracas_field){"key", FRACAS_FIELD_TEXT, "",
                                  "which number: a column of points.csv", false});
    sink(context, &(fracas_field){"value", FRACAS_FIELD_NUMBER, "",
                                  "its value, in the unit beside it", false});
    sink(context, &(fracas_field){"unit", FRACAS_FIELD_TEXT, "",
                                  "its unit as UDUNITS-2 reads it, 1 of a pure number", false});
}

static fracas_err statistic_rows(const fracas_analysis *analysis, FILE *out)
{
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_point_statistics *statistics = &analysis->point[p];
        for (size_t i = 0; i < fracas_nstatistics; i++) {
            fprintf(out, "%zu,%s", p, fracas_statistics[i].key);
            put_statistic(statistics, &fracas_statistics[i], out);
            fprintf(out, ",%s\n", fracas_statistics[i].unit);
        }
        for (int o = 0; o < FRACAS_NOUTCOMES; o++) {
            char key[32];
            fprintf(out, "%zu,%s,%" PRId64 ",1\n", p, outcome_key(o, key), statistics->outcome[o]);
        }
    }
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_statistics = {
    .name = "statistics",
    .doc = "A line a statistic of a point: the same numbers as in points.csv, with their units",
    .key = {"point", "key"},
    .parent = &fracas_csv_table_points,
    .fields = statistic_fields,
    .rows = statistic_rows,
};
