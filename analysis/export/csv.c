/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/csv.h"

#include "analysis/data/output.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void fracas_csv_real(double value, FILE *out)
{
    putc(',', out);
    if (value == 0 && !signbit(value))
        putc('0', out); /* most of a bar's columns: %g takes longer than all else of a report */
    else if (isfinite(value)) fprintf(out, "%.15g", value);
}

void fracas_csv_text(const char *text, FILE *out)
{
    bool quote = strpbrk(text, ",\"\n\r") != NULL;
    if (quote) putc('"', out);
    for (; *text; text++) {
        if (*text == '"') putc('"', out);
        putc(*text, out);
    }
    if (quote) putc('"', out);
}

typedef struct {
    FILE *out;
    bool first;
} head;

static void put_name(void *context, const fracas_field *field)
{
    head *of = context;
    if (!of->first) putc(',', of->out);
    of->first = false;
    fracas_csv_text(field->name, of->out);
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
    snprintf(name, sizeof name, "%s.csv", table->name);
    TRY(fracas_output_open(folder, name, &output));
    return fracas_output_close(&output, fracas_csv_write(table, analysis, output.file));
}
