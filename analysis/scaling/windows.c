/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/scaling/windows.h"

#include "analysis/estimate/weights.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* (size-laws.11), (size-laws.12), (size-laws.13). */
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
                     high->replicas < FRACAS_REPLICAS_OWN; /* alike by chance */
    if (a + b > 0)
        window.half_width = gsl_cdf_tdist_Pinv(0.975, window.freedom) * window.standard_error;
    else window.half_width = few ? NAN : window.standard_error;
    return window;
}

static void add_series(const fracas_size_series *series, fracas_size_window *list, size_t *count)
{
    for (size_t i = 0; i + 1 < series->n; i++) {
        const fracas_size_point *low = &series->point[i], *high = low + 1;
        fracas_size_window made = {.point = {low->point, high->point},
                                   .rate = {low->rate, high->rate},
                                   .scales = series->scales,
                                   .window = fracas_window_of(low, high)};
        if (low->whole || high->whole || !isfinite(made.window.slope))
            continue; /* the length of a body is no fragment size */
        snprintf(made.name, sizeof made.name, "%s", series->name);
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
