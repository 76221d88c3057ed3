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

fracas_err fracas_csv_write(const fracas_csv_table *table, const fracas_analysis *analysis,
                            FILE *out)
{
    head of = {out, true};
    table->fields(analysis, put_name, &of);
    putc('\n', out);
    return table->rows(analysis, out);
}

fracas_err fracas_csv_file(const fracas_csv_table *table, const fracas_analysis *analysis,
                           const char *folder)
{
    char name[64];
    fracas_output_file output;
    FRACAS_PRINT(name, "%s.csv", table->name);
    TRY(fracas_output_open(folder, name, &output));
    return fracas_output_close(&output, fracas_csv_write(table, analysis, output.file));
}
