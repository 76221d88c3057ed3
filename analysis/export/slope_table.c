/* slopes.csv */
#include "analysis/export/csv.h"

#include "analysis/laws/slope.h"
#include "analysis/laws/windows.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

static void fields(const fracas_analysis *analysis, fracas_field_sink *sink, void *context)
{
    (void)analysis;
    static const fracas_field field[] = {
        {"series", FRACAS_FIELD_TEXT, "", "points alike in all that does not make the strain rate", false},
        {"kind", FRACAS_FIELD_TEXT, "", "line: through all points of the series; window: between two neighbouring rates", false},
        {"points", FRACAS_FIELD_INTEGER, "1", "points of the study that it is of", false},
        {"from_rate", FRACAS_FIELD_NUMBER, "1/s", "the lower strain rate of a window", false},
        {"to_rate", FRACAS_FIELD_NUMBER, "1/s", "the higher strain rate of a window", false},
        {"slope", FRACAS_FIELD_NUMBER, "1", "d log(mean size)/d log(strain rate)", false},
        {"standard_error", FRACAS_FIELD_NUMBER, "1", "of the slope", false},
        {"half_width", FRACAS_FIELD_NUMBER, "1", "half width of its 95 % interval", false},
        {"chi2", FRACAS_FIELD_NUMBER, "1", "squared residuals of a line, each over its variance", false},
    };
    for (size_t f = 0; f < sizeof field / sizeof *field; f++) sink(context, &field[f]);
}

static void put_line(const char *series, const char *kind, int64_t points, const double value[6], FILE *out)
{
    fracas_csv_text(series, out);
    fprintf(out, ",%s,%" PRId64, kind, points);
    for (size_t v = 0; v < 6; v++) fracas_csv_real(value[v], out);
    putc('\n', out);
}

static fracas_err rows(const fracas_analysis *analysis, FILE *out)
{
    fracas_size_slope *line;
    fracas_size_window *window;
    size_t lines, windows;
    TRY(fracas_size_slopes(analysis, &line, &lines));
    fracas_err err = fracas_size_windows(analysis, &window, &windows);
    for (size_t i = 0; i < lines && !err; i++) {
        const fracas_slope *s = &line[i].slope;
        put_line(line[i].name, "line", s->n, (double[6]){NAN, NAN, s->slope, s->standard_error, s->half_width, s->chi2}, out);
    }
    for (size_t i = 0; i < windows && !err; i++) {
        const fracas_size_window *w = &window[i];
        put_line(w->name, "window", 2,
                 (double[6]){w->rate[0], w->rate[1], w->window.slope, w->window.standard_error, w->window.half_width, NAN}, out);
    }
    free(line);
    if (!err) free(window);
    return err;
}

const fracas_csv_table fracas_csv_table_slopes = {
    .name = "slopes", .doc = "A line a slope of mean size against strain rate", .key = {"series", "kind", "from_rate"},
    .fields = fields, .rows = rows,
};
