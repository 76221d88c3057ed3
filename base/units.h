/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers and units of a campaign file: strict, independent of the locale, converted to SI by
 * UDUNITS-2. */
#ifndef FRACAS_BASE_UNITS_H
#define FRACAS_BASE_UNITS_H

#include "base/own.h"
#include "base/err.h"

#include <stddef.h>

#define FRACAS_NUMBER_TEXT 32 /* buffer of fracas_number_write, bytes */

/* Rounds to 15 significant decimal digits, as "%.15g" does; -0 becomes 0. Values reached by
 * different conversions are equal then, and their text is exact. */
double fracas_number_round(double value);

/* Writes `value` as "%.15g", with a point in every locale. */
void fracas_number_write(double value, char text[FRACAS_NUMBER_TEXT]);

/* Reads a finite decimal number, all of `text`: [sign] digits [. digits] [e [sign] digits]. No
 * space, "nan", "inf" or hexadecimal. FRACAS_USAGE names the fault. The value is the nearest
 * double, not rounded to 15 digits. */
FRACAS_MUST_USE fracas_err fracas_number_read(const char *text, double *value);

/* The unit database of UDUNITS-2, loaded once. */
typedef struct fracas_units fracas_units;

/* FRACAS_ENVIRONMENT when the database cannot be loaded. Silences UDUNITS-2's own error output. */
FRACAS_MUST_USE fracas_err fracas_units_create(fracas_units **units);
void fracas_units_destroy(fracas_units *units); /* NULL is allowed */
FRACAS_OWNER(fracas_units, fracas_units_destroy)

/* Reads "264 MPa", "1e4 1/s" or a bare number in SI as a value in the unit `si`, rounded to 15
 * digits. `si` is "1" for a pure number, which may be written with %. A unit is a product of powers
 * of names: "J/m2", "J/m^2", "kg m-3", "W/(m2 K)". Dates, logarithms, offsets and further numbers,
 * which UDUNITS-2 would also understand, are refused. FRACAS_USAGE names the text found and the
 * unit expected. */
FRACAS_MUST_USE fracas_err fracas_units_read(const fracas_units *units, const char *text,
                                             const char *si, double *value);

/* Powers of m, kg, s and K. */
typedef struct {
    double power[4];
} fracas_dimension;

/* The unit `name`, a product of powers of names, as `factor` times SI units of this dimension.
 * FRACAS_USAGE, naming it, if it is none, or of another dimension than these four have. */
FRACAS_MUST_USE fracas_err fracas_units_parse(const fracas_units *units, const char *name,
                                              double *factor, fracas_dimension *dimension);

/* Length of the number at the start of `text`; 0 if there is none. */
size_t fracas_number_length(const char *text);

/* Names the quantity of a value in the unit `si` with its article, "a stress", and the units to
 * write, "Pa or MPa"; "a value" and `si` itself for a dimension without a name. */
void fracas_units_describe(const char *si, const char **what, const char **write_in);

#endif
