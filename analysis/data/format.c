/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/format.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* "2.75e+11" -> "2.75e11" */
static void trim_exponent(char *text)
{
    char *e = strchr(text, 'e');
    if (!e) return;
    char *to = e + 1, *from = e + 1;
    if (*from == '-') *to++ = *from++;
    while (*from == '+' || *from == '0') from++;
    memmove(to, from, strlen(from) + 1);
}

/* "2.50000e3" -> "2.5e3" */
static void trim_mantissa(char *text)
{
    char *e = strchr(text, 'e'), *end = e;
    if (!strchr(text, '.')) return;
    while (end[-1] == '0') end--;
    if (end[-1] == '.') end--;
    memmove(end, e, strlen(e) + 1);
}

void fracas_format_short(double value, char *text, size_t size)
{
    if (!isfinite(value)) {
        snprintf(text, size, "-");
        return;
    }
    char plain[64], exponent[64];
    FRACAS_PRINT(plain, "%.6g", value);
    trim_exponent(plain);
    FRACAS_PRINT(exponent, "%.5e", value);
    trim_exponent(exponent);
    trim_mantissa(exponent);
    snprintf(text, size, "%s", strlen(exponent) < strlen(plain) ? exponent : plain);
}

static int exponent_of(double value)
{
    return (int)floor(log10(fabs(value)));
}

/* Decimals for `digits` significant digits of the value, after rounding. */
static int decimals_for(double value, int digits)
{
    if (value == 0) return 0;
    char rounded[64];
    FRACAS_PRINT(rounded, "%.*e", digits - 1, value);
    int decimals = digits - 1 - exponent_of(strtod(rounded, NULL));
    return decimals > 0 ? decimals : 0;
}

void fracas_format_digits(double value, int digits, char *text, size_t size)
{
    if (!isfinite(value)) {
        snprintf(text, size, "-");
    } else if (value != 0 && (fabs(value) < 1e-2 || fabs(value) >= 1e6)) {
        snprintf(text, size, "%.*e", digits - 1, value);
        trim_exponent(text);
    } else {
        snprintf(text, size, "%.*f", decimals_for(value, digits), value);
    }
}

fracas_number_text fracas_digits(double value, int digits)
{
    fracas_number_text number;
    fracas_format_digits(value, digits, number.text, sizeof number.text);
    return number;
}

fracas_number_text fracas_beside(double value, double limit)
{
    int digits = 2;
    while (digits < 5 && isfinite(value) &&
           (strtod(fracas_digits(value, digits).text, NULL) > limit) != (value > limit))
        digits++;
    return fracas_digits(value, digits);
}

fracas_number_text fracas_with_unit(double value, int digits, const char *unit, bool unicode)
{
    const fracas_prefix prefix = fracas_prefix_for(&(double){fabs(value)}, 1);
    fracas_number_text text;
    FRACAS_PRINT(text.text, "%.32s %s%s", fracas_digits(value * prefix.factor, digits).text,
                 unicode ? prefix.sign : prefix.symbol, unit);
    return text;
}

enum { UNKNOWN = 3 }; /* digits of a value without interval beside values with one */
static const double round_off = 1e-12; /* relative: values closer than this have no interval */

void fracas_format_mean(const fracas_estimate *estimate, double factor, char *text, size_t size)
{
    const double mean = estimate->mean * factor, half_width = estimate->half_width * factor;
    if (isfinite(mean) && half_width > round_off * fabs(mean))
        snprintf(text, size, "%.*f", decimals_for(half_width, 2), mean);
    else fracas_format_digits(mean, UNKNOWN, text, size);
}

/* The number with a given power of ten, "12.4e5"; without one where the exponent is 0. */
static void format_power(double value, int exponent, int decimals, char *text, size_t size)
{
    if (exponent == 0) snprintf(text, size, "%.*f", decimals, value);
    else snprintf(text, size, "%.*fe%d", decimals, value * pow(10, -exponent), exponent);
}

void fracas_format_interval(double value, double low, double high, char *text, size_t size)
{
    const double half_width = (high - low) / 2;
    char part[3][32];
    if (!isfinite(value)) {
        snprintf(text, size, "-");
        return;
    }
    if (!(half_width > round_off * fabs(value))) {
        fracas_format_digits(value, UNKNOWN, part[0], sizeof part[0]);
        snprintf(text, size, "%s%s", part[0], isfinite(half_width) ? "" : " [-]");
        return;
    }
    char rounded[64];
    FRACAS_PRINT(rounded, "%.1e", half_width);
    const int place = exponent_of(strtod(rounded, NULL)) - 1; /* the last digit shown */
    const bool large = place > 0, small = value != 0 && fabs(value) < 1e-2;
    const int exponent = large || small ? exponent_of(value) : 0;
    const double ends[3] = {value, low, high};
    for (int i = 0; i < 3; i++) {
        const bool vanishes = ends[i] > 0 &&
                              ends[i] < 0.5 * pow(10, place); /* an end above 0 is not shown as 0 */
        const int last = vanishes ? exponent_of(ends[i]) : place;
        format_power(ends[i], exponent, exponent > last ? exponent - last : 0, part[i],
                     sizeof part[i]);
    }
    snprintf(text, size, "%s [%s, %s]", part[0], part[1], part[2]);
}

void fracas_format_estimate(const fracas_estimate *estimate, double factor, const char *plus_minus,
                            char *text, size_t size)
{
    double mean = estimate->mean * factor, half_width = estimate->half_width * factor;
    if (half_width <= round_off * fabs(mean)) half_width = 0;
    if (!isfinite(mean)) {
        snprintf(text, size, "-");
    } else if (half_width > 0) {
        int decimals = decimals_for(half_width, 2);
        snprintf(text, size, "%.*f %s %.*f", decimals, mean, plus_minus, decimals, half_width);
    } else {
        char value[64];
        fracas_format_digits(mean, 4, value, sizeof value);
        snprintf(text, size, "%s %s %s", value, plus_minus, half_width == 0 ? "0" : "-");
    }
}

fracas_prefix fracas_prefix_over(const double *value, size_t stride, size_t count)
{
    static const fracas_prefix prefix[] = {
        {1e9, "n", "n"},  {1e6, "u", "\u00b5"}, {1e3, "m", "m"},  {1, "", ""},
        {1e-3, "k", "k"}, {1e-6, "M", "M"},     {1e-9, "G", "G"},
    };
    const int last = (int)(sizeof prefix / sizeof *prefix) - 1, none = 3;
    double least = INFINITY, greatest = 0;
    for (size_t i = 0; i < count; i++) {
        const double at = *(const double *)(const void *)((const char *)value + i * stride);
        if (!isfinite(at) || at <= 0) continue;
        least = fmin(least, at);
        greatest = fmax(greatest, at);
    }
    if (greatest <= 0) return prefix[none];
    double middle = (log10(least) + log10(greatest)) / 2;
    int thousands = (int)floor(middle / 3 + 1e-9); /* log10 rounds */
    int i = none + thousands;
    return prefix[i < 0 ? 0 : i > last ? last : i];
}

fracas_prefix fracas_prefix_for(const double *value, size_t count)
{
    return fracas_prefix_over(value, sizeof *value, count);
}

fracas_prefix fracas_prefix_in(const char *unit, const double *value, size_t count)
{
    const size_t symbol = strcspn(unit, " /0123456789");
    const bool takes = symbol > 0 && !isdigit((unsigned char)unit[symbol]) &&
                       strncmp(unit, "kg", 2) != 0 && strcmp(unit, "m/s2") != 0;
    return takes ? fracas_prefix_for(value, count) : (fracas_prefix){1, "", ""};
}
