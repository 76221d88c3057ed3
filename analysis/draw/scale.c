/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/scale.h"

#include "analysis/data/text.h"

#include <math.h>
#include <stdio.h>

double fracas_scale_nice(double value, bool up)
{
    static const double series[] = {1, 2, 5, 10};
    double power = pow(10, floor(log10(value)));
    if (up) {
        for (int i = 0; i < 4; i++)
            if (series[i] * power >= value * (1 - 1e-9)) return series[i] * power;
        return 10 * power;
    }
    for (int i = 3; i > 0; i--)
        if (series[i] * power <= value * (1 + 1e-9)) return series[i] * power;
    return power;
}

static double linear_step(double low, double high)
{
    return fracas_scale_nice((high - low) / 5 * 0.7, true); /* four to seven ticks */
}

void fracas_scale_fit(fracas_scale *scale, bool log, double least, double greatest)
{
    scale->log = log;
    if (log) {
        scale->low = fracas_scale_nice(least, false);
        scale->high = fracas_scale_nice(greatest, true);
        if (scale->low >= scale->high) {
            scale->low /= 10;
            scale->high *= 10;
        }
        return;
    }
    if (least >= greatest) {
        double apart = least != 0 ? fabs(least) / 2 : 1;
        least -= apart;
        greatest += apart;
    }
    const double over = 0.02; /* steps: the last time of a history is a little past its end */
    for (int pass = 0; pass < 2; pass++) { /* the wider scale may have wider steps */
        const double step = linear_step(least, greatest);
        least = floor(least / step + over) * step;
        greatest = ceil(greatest / step - over) * step;
    }
    scale->low = least;
    scale->high = greatest;
}

bool fracas_scale_decade(double value)
{
    return value > 0 && fabs(log10(value) - round(log10(value))) < 1e-9;
}

double fracas_scale_place(const fracas_scale *scale, double value)
{
    double part = scale->log ? log10(value / scale->low) / log10(scale->high / scale->low)
                             : (value - scale->low) / (scale->high - scale->low);
    return scale->from + part * (scale->to - scale->from);
}

static void add(fracas_tick *tick, size_t *count, double value, const char *label)
{
    if (*count == FRACAS_MAX_TICKS) return;
    tick[*count].value = value;
    snprintf(tick[*count].label, sizeof tick->label, "%s", label);
    (*count)++;
}

/* "10" with the exponent raised, after "2\u00b7" for a mantissa other than one. */
static void power_label(double mantissa, int exponent, char *text, size_t size)
{
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char digits[16];
    FRACAS_PRINT(digits, "%d", exponent);
    if (mantissa != 1) snprintf(text, size, "%.6g\u00b710", mantissa);
    else snprintf(text, size, "10");
    for (const char *d = digits; *d; d++)
        fracas_append(text, size, "", "%s", *d == '-' ? "\u207b" : raised[*d - '0']);
}

static size_t log_ticks(const fracas_scale *scale, fracas_tick *tick)
{
    double span = log10(scale->high / scale->low);
    int first = (int)floor(log10(scale->low) + 1e-9), last = (int)ceil(log10(scale->high) - 1e-9);
    bool plain = scale->low > 0.9e-3 && scale->high < 1.1e4;
    double most = fmin(7, fmax(2, fabs(scale->to - scale->from) / 26));
    int stride = (int)ceil(span / most);
    size_t count = 0;
    for (int exponent = first; exponent <= last; exponent++) {
        for (int mantissa = 1; mantissa < 10; mantissa++) {
            double value = mantissa * pow(10, exponent);
            if (value < scale->low * (1 - 1e-9) || value > scale->high * (1 + 1e-9)) continue;
            bool decade = mantissa == 1 && exponent % stride == 0;
            bool between = span < 1.9 && (mantissa == 2 || mantissa == 5 || mantissa == 1);
            if (span > 8 && mantissa > 1) continue;
            char label[32] = "";
            if (decade || between) {
                if (plain) FRACAS_PRINT(label, "%g", value);
                else power_label(mantissa, exponent, label, sizeof label);
            }
            add(tick, &count, value, label);
        }
    }
    return count;
}

static size_t linear_ticks(const fracas_scale *scale, fracas_tick *tick)
{
    double step = linear_step(scale->low, scale->high);
    int decimals = (int)fmax(0, -floor(log10(step) + 1e-9));
    long first = lround(scale->low / step), last = lround(scale->high / step);
    const double most = fmax(fabs(scale->low), fabs(scale->high));
    const int exponent = most >= 1e6 ? (int)floor(log10(most) + 1e-9) : 0;
    size_t count = 0;
    for (long k = first; k <= last; k++) {
        char label[32];
        if (exponent > 0 && k != 0)
            power_label((double)k * step / pow(10, exponent), exponent, label, sizeof label);
        else FRACAS_PRINT(label, "%.*f", decimals, (double)k * step);
        add(tick, &count, (double)k * step, label);
    }
    return count;
}

size_t fracas_scale_ticks(const fracas_scale *scale, fracas_tick *tick)
{
    return scale->log ? log_ticks(scale, tick) : linear_ticks(scale, tick);
}
