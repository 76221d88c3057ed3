/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/csv.h"

#include "analysis/data/output.h"

#include <stdio.h>

typedef struct {
    FILE *out;
    bool first;
} head;

static void put_name(void *context, const fracas_field *field)
{
    head *of = context;
    if (!of->first) putc(',', of->out);
    of->first = false;
    fracas_csv_text(field->key, of->out);
}

void fracas_csv_fields(const fracas_csv_table *table, const fracas_analysis *analysis,
                       fracas_field_visit *visit, void *context)
{
    if (table->fields) table->fields(table, analysis, visit, context);
    for (size_t i = 0; i < FRACAS_TABLE_PARTS && table->columns[i]; i++)
        fracas_fields_walk(table->columns[i], ".", visit, context);
}

fracas_err fracas_csv_file(const fracas_csv_table *table, const fracas_analysis *analysis,
                           const char *folder)
{
    char name[64];
    fracas_output_file output;
    FRACAS_PRINT(name, "%s.csv", table->name);
    TRY(fracas_output_open(folder, name, &output));
    head of = {output.file, true};
    fracas_csv_fields(table, analysis, put_name, &of);
    putc('\n', output.file);
    return fracas_output_close(&output, table->rows(table, analysis, output.file));
}

fracas_err fracas_csv_free(const fracas_csv_table *const *table, const char *folder)
{
    for (; *table; table++) {
        char name[64];
        FRACAS_PRINT(name, "%s.csv", (*table)->name);
        TRY(fracas_output_free(folder, &(const char *){name}, 1));
    }
    return FRACAS_OK;
}
