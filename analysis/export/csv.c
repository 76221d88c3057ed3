#include "analysis/export/csv.h"

#include "analysis/laws/slope.h"
#include "analysis/laws/windows.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void fracas_csv_real(double value, FILE *out)
{
    putc(',', out);
    if (value == 0 && !signbit(value)) putc('0', out); /* most of a bar's columns: %g takes longer than all else of a report */
    else if (isfinite(value)) fprintf(out, "%.15g", value);
}

static void put_text(const char *text, FILE *out)
{
    bool quote = strpbrk(text, ",\"\n") != NULL;
    if (quote) putc('"', out);
    for (; *text; text++) {
        if (*text == '"') putc('"', out);
        putc(*text, out);
    }
    if (quote) putc('"', out);
}

static void points_head(const fracas_point_table *table, FILE *out)
{
    fputs("point,hash,replicas", out);
    for (size_t c = 0; c < table->ncolumns; c++) fprintf(out, ",%s", table->column[c].path);
    for (size_t i = 0; i < fracas_nstatistics; i++) fprintf(out, ",%s", fracas_statistics[i].key);
    for (int o = 0; o < FRACAS_NOUTCOMES; o++) fprintf(out, ",outcome.%s", fracas_outcome_name(o));
    putc('\n', out);
}

static void point_line(const fracas_analysis *analysis, size_t p, FILE *out)
{
    const fracas_point_table *table = analysis->table;
    const fracas_point_statistics *statistics = &analysis->point[p];
    char hash[FRACAS_HASH_HEX];
    fracas_hash_hex(&table->point[p].hash, hash);
    fprintf(out, "%zu,%s,%" PRId64, p, hash, table->point[p].replicas);
    for (size_t c = 0; c < table->ncolumns; c++) {
        if (!table->column[c].text) {
            fracas_csv_real(table->point[p].value[c].real, out);
            continue;
        }
        putc(',', out);
        put_text(table->point[p].value[c].text, out);
    }
    for (size_t i = 0; i < fracas_nstatistics; i++) {
        const void *value = (const char *)statistics + fracas_statistics[i].offset;
        if (fracas_statistics[i].integer) fprintf(out, ",%" PRId64, *(const int64_t *)value);
        else fracas_csv_real(*(const double *)value, out);
    }
    for (int o = 0; o < FRACAS_NOUTCOMES; o++) fprintf(out, ",%" PRId64, statistics->outcome[o]);
    putc('\n', out);
}

void fracas_csv_points(const fracas_analysis *analysis, FILE *out)
{
    points_head(analysis->table, out);
    for (size_t p = 0; p < analysis->table->npoints; p++) point_line(analysis, p, out);
}

fracas_err fracas_csv_slopes(const fracas_analysis *analysis, FILE *out)
{
    fracas_size_slope *line;
    fracas_size_window *window;
    size_t lines, windows;
    TRY(fracas_size_slopes(analysis, &line, &lines));
    fracas_err err = fracas_size_windows(analysis, &window, &windows);
    fputs("series,kind,points,from_rate,to_rate,slope,standard_error,half_width,chi2\n", out);
    for (size_t i = 0; i < lines && !err; i++) {
        put_text(line[i].name, out);
        fprintf(out, ",line,%" PRId64 ",,", line[i].slope.n);
        const double value[] = {line[i].slope.slope, line[i].slope.standard_error, line[i].slope.half_width, line[i].slope.chi2};
        for (size_t v = 0; v < sizeof value / sizeof *value; v++) fracas_csv_real(value[v], out);
        putc('\n', out);
    }
    for (size_t i = 0; i < windows && !err; i++) {
        put_text(window[i].name, out);
        fputs(",window,2", out);
        const double value[] = {window[i].rate[0], window[i].rate[1], window[i].window.slope, window[i].window.standard_error,
                                window[i].window.half_width, NAN};
        for (size_t v = 0; v < sizeof value / sizeof *value; v++) fracas_csv_real(value[v], out);
        putc('\n', out);
    }
    free(line);
    free(window);
    return err;
}

fracas_err fracas_csv_fragments(const fracas_analysis *analysis, FILE *out)
{
    fputs("point,replica,outcome,fragment,mass,size,elements,dust,position_x,position_y,position_z,"
          "velocity_x,velocity_y,velocity_z,spin_x,spin_y,spin_z\n", out);
    fracas_record record;
    fracas_record_init(&record);
    fracas_err err = FRACAS_OK;
    size_t rows = fracas_reader_realizations(analysis->reader);
    for (size_t row = 0; row < rows && !err; row++) {
        size_t point;
        int64_t replica;
        err = fracas_reader_record(analysis->reader, row, FRACAS_READ_FRAGMENTS, &point, &replica, &record);
        for (size_t i = 0; i < record.nfragment && !err; i++) {
            const fracas_fragment *fragment = &record.fragment[i];
            fprintf(out, "%zu,%" PRId64 ",%s,%zu", point, replica, fracas_outcome_name(record.outcome), i);
            fracas_csv_real(fragment->mass, out);
            fracas_csv_real(fragment->size, out);
            fprintf(out, ",%" PRId64 ",%" PRId64, fragment->elements, fragment->dust);
            for (int axis = 0; axis < 3; axis++) fracas_csv_real(fragment->position[axis], out);
            for (int axis = 0; axis < 3; axis++) fracas_csv_real(fragment->velocity[axis], out);
            for (int axis = 0; axis < 3; axis++) fracas_csv_real(fragment->spin[axis], out);
            putc('\n', out);
        }
        fracas_record_clear(&record);
    }
    return err;
}
