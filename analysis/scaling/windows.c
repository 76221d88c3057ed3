/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/scaling/scaling.h"

#include "analysis/estimate/weights.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define NUMBER(key, unit, doc, member) \
    FRACAS_FIELD(fracas_size_window, NUMBER, key, unit, doc, member)
static const fracas_field fields[] = {
    FRACAS_FIELD(fracas_size_window, CHARS, "series", "", "name of the series", name),
    FRACAS_FIELD(fracas_size_window, INDEX, "from_point", "1", "point of the lower rate", point[0]),
    FRACAS_FIELD(fracas_size_window, INDEX, "to_point", "1", "point of the higher rate", point[1]),
    NUMBER("from_rate", "1/s", "lower strain rate", rate[0]),
    NUMBER("to_rate", "1/s", "higher strain rate", rate[1]),
    NUMBER("from_rate_normalised", "1", "lower strain rate / edot0", normalised[0]),
    NUMBER("to_rate_normalised", "1", "higher strain rate / edot0", normalised[1]),
    NUMBER("slope", "1", "d log(mean size)/d log(strain rate) between the two", window.slope),
    NUMBER("standard_error", "1", "standard error of the slope", window.standard_error),
    NUMBER("freedom", "1", "degrees of freedom of the standard error", window.freedom),
    NUMBER("half_width", "1",
           "half width of the 95 % interval of the slope; null if neither mean scatters and one is "
           "of fewer than eight replicas",
           window.half_width),
};
const fracas_fields fracas_window_fields = FRACAS_FIELDS(fields);

/* (scaling-laws.11), (scaling-laws.12), (scaling-laws.13). */
fracas_window fracas_window_of(const fracas_size_point *low, const fracas_size_point *high)
{
    const double x = log(high->rate / low->rate);
    if (!(fabs(x) > 1e-9)) return (fracas_window){NAN, NAN, NAN, NAN};
    const double a = low->error * low->error, b = high->error * high->error;
    fracas_window window = {.slope = log(high->size / low->size) / x,
                            .standard_error = sqrt(a + b) / fabs(x)};
    window.freedom = (a + b) * (a + b) /
                     (a * a / (double)(low->replicas - 1) + b * b / (double)(high->replicas - 1));
    const bool few = low->replicas < FRACAS_REPLICAS_OWN ||
                     high->replicas < FRACAS_REPLICAS_OWN; /* chance */
    if (a + b > 0)
        window.half_width = gsl_cdf_tdist_Pinv(0.975, window.freedom) * window.standard_error;
    else window.half_width = few ? NAN : window.standard_error;
    return window;
}

static void add_series(const fracas_size_series *series, fracas_size_window *list, size_t *count)
{
    for (size_t i = 0; i + 1 < series->n; i++) {
        const fracas_size_point *low = &series->point[i], *high = low + 1;
        fracas_size_window made = {
            .point = {low->point, high->point},
            .rate = {low->rate, high->rate},
            .normalised = {low->rate / series->scales.rate, high->rate / series->scales.rate},
            .window = fracas_window_of(low, high)};
        if (low->whole || high->whole || !isfinite(made.window.slope))
            continue; /* no fragment size */
        FRACAS_PRINT(made.name, "%s", series->name);
        list[(*count)++] = made;
    }
}

fracas_err fracas_size_windows(const struct fracas_analysis *analysis, fracas_size_window **list,
                               size_t *count)
{
    fracas_size_series *series;
    size_t nseries, most = 1;
    *list = NULL;
    *count = 0;
    TRY(fracas_size_series_create(analysis, &series, &nseries));
    for (size_t i = 0; i < nseries; i++) most += series[i].n;
    *list = calloc(most, sizeof **list);
    for (size_t i = 0; *list && i < nseries; i++) add_series(&series[i], *list, count);
    fracas_size_series_free(series, nseries);
    return *list ? FRACAS_OK : fracas_no_memory("the slopes of the study");
}
