/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of points: parameters and statistics, a line a point, or a statistic. */
#include "analysis/export/csv.h"

#include <inttypes.h>
#include <stdio.h>

/* Descriptor of "outcome.FAILED", a number of the point's realizations. */
static void visit_outcomes(fracas_field_visit *visit, void *context)
{
    for (int o = 0; o < FRACAS_NOUTCOMES; o++) {
        char key[32];
        FRACAS_PRINT(key, "outcome.%s", fracas_outcome_name(o));
        visit(context, &(fracas_field){key, FRACAS_FIELD_INTEGER, "1",
                                       "realizations of the point that ended so",
                                       offsetof(fracas_point_statistics, outcome[o])});
    }
}

static void visit_statistics(fracas_field_visit *visit, void *context)
{
    fracas_fields_walk(&fracas_statistics, ".", visit, context);
    visit_outcomes(visit, context);
}

static void point_fields(const fracas_csv_table *of, const fracas_analysis *analysis,
                         fracas_field_visit *visit, void *context)
{
    (void)of;
    static const fracas_field lead[] = {
        {"point", FRACAS_FIELD_INDEX, "1",
         "number of the point, from 0: its row in /point of study.h5"},
        {"hash", FRACAS_FIELD_TEXT, "",
         "hash of the point's resolved values, 32 hexadecimal digits"},
        {"replicas", FRACAS_FIELD_INTEGER, "1", "replicas planned at the point"},
    };
    static const fracas_fields leading = FRACAS_FIELDS(lead);
    const fracas_point_table *table = analysis->table;
    fracas_fields_walk(&leading, ".", visit, context);
    for (size_t c = 0; c < table->ncolumns; c++) {
        const fracas_column *column = &table->column[c];
        visit(context,
              &(fracas_field){column->path, column->text ? FRACAS_FIELD_TEXT : FRACAS_FIELD_NUMBER,
                              column->unit, column->doc});
    }
    visit_statistics(visit, context);
}

typedef struct {
    const fracas_point_statistics *statistics;
    size_t point;
    FILE *out;
} destination;

static void put_cell(void *context, const fracas_field *leaf)
{
    const destination *to = context;
    putc(',', to->out);
    fracas_field_csv(leaf, to->statistics, to->out);
}

static fracas_err point_rows(const fracas_csv_table *of, const fracas_analysis *analysis, FILE *out)
{
    (void)of;
    const fracas_point_table *table = analysis->table;
    for (size_t p = 0; p < table->npoints; p++) {
        fprintf(out, "%zu,%s,%" PRId64, p, fracas_hash_hex(&table->point[p].hash).text,
                table->point[p].replicas);
        for (size_t c = 0; c < table->ncolumns; c++) {
            const fracas_value *value = &table->point[p].value[c];
            if (!table->column[c].text) {
                fracas_csv_real(value->real, out);
                continue;
            }
            putc(',', out);
            fracas_csv_text(value->text, out);
        }
        visit_statistics(put_cell, &(destination){&analysis->point[p], p, out});
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

static const fracas_field statistic_field[] = {
    {"point", FRACAS_FIELD_INDEX, "1", "number of the point, from 0"},
    {"key", FRACAS_FIELD_TEXT, "", "which number: a column of points.csv"},
    {"value", FRACAS_FIELD_NUMBER, "", "its value, in the unit beside it"},
    {"unit", FRACAS_FIELD_TEXT, "", "its unit as UDUNITS-2 reads it, 1 of a pure number"},
};
static const fracas_fields statistic_fields = FRACAS_FIELDS(statistic_field);

static void put_line(void *context, const fracas_field *leaf)
{
    const destination *to = context;
    fprintf(to->out, "%zu,%s", to->point, leaf->key);
    put_cell(context, leaf);
    fprintf(to->out, ",%s\n", leaf->unit);
}

static fracas_err statistic_rows(const fracas_csv_table *of, const fracas_analysis *analysis,
                                 FILE *out)
{
    (void)of;
    for (size_t p = 0; p < analysis->table->npoints; p++)
        visit_statistics(put_line, &(destination){&analysis->point[p], p, out});
    return FRACAS_OK;
}

const fracas_csv_table fracas_csv_table_statistics = {
    .name = "statistics",
    .doc = "A line a statistic of a point: the same numbers as in points.csv, with their units",
    .key = {"point", "key"},
    .parent = &fracas_csv_table_points,
    .columns = {&statistic_fields},
    .rows = statistic_rows,
};
