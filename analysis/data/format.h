/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as people read them. */
#ifndef FRACAS_ANALYSIS_DATA_FORMAT_H
#define FRACAS_ANALYSIS_DATA_FORMAT_H

#include "analysis/data/estimate.h"
#include "analysis/data/text.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    char text[48];
} fracas_number_text;

/* "1e4", "2500", "0.33": the shorter of plain and exponent notation, to six digits; "-" if not
 * finite. */
void fracas_format_short(double value, char *text, size_t size);
/* "0.890", "2.0e-3": so many significant digits, zeros kept; "-" if not finite. */
void fracas_format_digits(double value, int digits, char *text, size_t size);
/* The same by value. */
fracas_number_text fracas_digits(double value, int digits);

/* Two significant digits, or as many more (up to five) as show on which side of the limit the value
 * is. */
fracas_number_text fracas_beside(double value, double limit);
/* "1.23 us": a number with so many digits and its unit; "\u00b5s" with `unicode`. */
fracas_number_text fracas_with_unit(double value, int digits, const char *unit, bool unicode);

/* "442.3 +- 5.6": the half width to two digits and the mean to the same place, both times `factor`.
 * Without a half width (one replica, or equal values) the mean to four digits, and "+- -" or "+-
 * 0". "-" without a mean. */
void fracas_format_estimate(const fracas_estimate *estimate, double factor, const char *plus_minus,
                            char *text, size_t size);

/* The mean of an estimate alone, times `factor`, to the same place; without a half width to three
 * digits. */
void fracas_format_mean(const fracas_estimate *estimate, double factor, char *text, size_t size);

/* "0.0851 [0.066, 0.109]" to the place of the second digit of half the interval's width. "1.24e5
 * [1.10e5, 1.39e5]" where this place is above the point or the value below 0.01. An end above 0
 * that rounds to 0 gets the digit it needs. Without an interval, or with one within rounding, the
 * value to three digits, and " [-]" without one. "-" without a value. */
void fracas_format_interval(double value, double low, double high, char *text, size_t size);

/* A power of 1000 for a unit: shown value = factor * SI value. */
typedef struct {
    double factor;
    const char *symbol; /* "u" in ASCII */
    const char *sign;   /* "\u00b5" in UTF-8 */
} fracas_prefix;

/* The prefix (nano to giga) in which the geometric mean of the least and the greatest positive
 * value is between 1 and 1000. */
fracas_prefix fracas_prefix_for(const double *value, size_t count);
/* The same of `count` values, each `stride` bytes after the last. */
fracas_prefix fracas_prefix_over(const double *value, size_t stride, size_t count);
/* The prefix of fracas_prefix_for where the unit takes one. It takes none without a symbol in front
 * ("1", "1/s"), with the prefix of kg, where its first symbol has a power (1 km2 is 1e6 m2), and of
 * an acceleration: nobody reads Mm/s2. */
fracas_prefix fracas_prefix_in(const char *unit, const double *value, size_t count);

#endif
