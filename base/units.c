/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/units.h"

#include <locale.h>
#include <math.h>
#include <regex.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

struct fracas_units {
    ut_system *system;
};

/* Dimensions by the name a reader knows, and how they are written. */
static const struct {
    const char *unit, *what, *write_in;
} dimensions[] = {
    {"1", "a pure number", "no unit, or %"},
    {"m", "a length", "m or mm"},
    {"m2", "an area", "m2 or mm2"},
    {"m3", "a volume", "m3 or mm3"},
    {"1/m3", "a number per volume", "1/m3 or 1/mm3"},
    {"s", "a time", "s or us"},
    {"1/s", "a rate", "1/s"},
    {"rad/s", "an angular velocity", "rad/s or rpm"},
    {"kg", "a mass", "kg or g"},
    {"kg/m3", "a density", "kg/m3 or g/cm3"},
    {"m/s", "a velocity", "m/s"},
    {"m/s2", "an acceleration", "m/s2"},
    {"N", "a force", "N or kN"},
    {"N/m", "a force per length", "N/m or kN/m"},
    {"N/(m s)", "a force per length and time", "N/(m s)"},
    {"Pa", "a stress", "Pa or MPa"},
    {"J", "an energy", "J or mJ"},
    {"J/m2", "an energy per area", "J/m2 or kJ/m2"},
    {"K", "a temperature", "K"},
};
static const size_t ndimensions = sizeof dimensions / sizeof *dimensions;

/* ---- numbers ---- */

/* The "C" locale for this thread while numbers are read or written; glibc keeps it ready, so this
 * allocates nothing. */
static locale_t enter_plain_locale(void)
{
    return uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
}

void fracas_number_write(double value, char text[FRACAS_NUMBER_TEXT])
{
    locale_t before = enter_plain_locale();
    snprintf(text, FRACAS_NUMBER_TEXT, "%.15g", value == 0.0 ? 0.0 : value);
    uselocale(before);
}

double fracas_number_round(double value)
{
    char text[FRACAS_NUMBER_TEXT];
    fracas_number_write(value, text);
    locale_t before = enter_plain_locale();
    double rounded = strtod(text, NULL);
    uselocale(before);
    return rounded;
}

static size_t digits(const char *text)
{
    return strspn(text, "0123456789");
}

size_t fracas_number_length(const char *text)
{
    size_t at = text[0] == '+' || text[0] == '-';
    size_t whole = digits(text + at), fraction = 0;
    at += whole;
    if (text[at] == '.') {
        fraction = digits(text + at + 1);
        at += 1 + fraction;
    }
    if (whole + fraction == 0) return 0;
    if (text[at] == 'e' || text[at] == 'E') {
        size_t sign = text[at + 1] == '+' || text[at + 1] == '-';
        size_t exponent = digits(text + at + 1 + sign);
        if (exponent > 0) at += 1 + sign + exponent;
    }
    return at;
}

/* The double nearest to the number at the start of `text`. */
static fracas_err number_value(const char *text, double *value)
{
    locale_t before = enter_plain_locale();
    double read = strtod(text, NULL);
    uselocale(before);
    if (!isfinite(read))
        return fracas_fail(FRACAS_USAGE, "`%s` is too large for a double-precision number", text);
    bool zero = true; /* as written, not by underflow */
    for (const char *c = text; *c && *c != 'e' && *c != 'E' && *c != ' '; c++)
        if (*c >= '1' && *c <= '9') zero = false;
    if (!zero && fabs(read) < 2.2250738585072014e-308)
        return fracas_fail(FRACAS_USAGE, "`%s` is too small for a double-precision number", text);
    *value = read;
    return FRACAS_OK;
}

fracas_err fracas_number_read(const char *text, double *value)
{
    size_t length = fracas_number_length(text);
    if (length == 0 || text[length] != '\0')
        return fracas_fail(FRACAS_USAGE, "`%s` is not a number", text);
    return number_value(text, value);
}

/* ---- units ---- */

FRACAS_OWNER(ut_unit, ut_free)

fracas_err fracas_units_create(fracas_units **units)
{
    fracas_units *made = malloc(sizeof *made);
    if (!made) return fracas_no_memory("the unit database");
    ut_set_error_message_handler(ut_ignore);
    locale_t before = enter_plain_locale();
    made->system = ut_read_xml(NULL);
    uselocale(before);
    if (!made->system) {
        free(made);
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "cannot load the unit database of UDUNITS-2; install the package "
                           "libudunits2-data, and unset UDUNITS2_XML_PATH if it is set");
    }
    *units = made;
    return FRACAS_OK;
}

void fracas_units_destroy(fracas_units *units)
{
    if (!units) return;
    ut_free_system(units->system);
    free(units);
}

void fracas_units_describe(const char *si, const char **what, const char **write_in)
{
    *what = "a value";
    *write_in = si;
    for (size_t i = 0; i < ndimensions; i++)
        if (strcmp(dimensions[i].unit, si) == 0) {
            *what = dimensions[i].what;
            *write_in = dimensions[i].write_in;
        }
}

/* Products and quotients of powers of names (ASCII letters, the two characters for micro), with at
 * most one level of brackets. */
#define TERM "(1|([a-z]|\xc2\xb5|\xce\xbc)+(\xc2[\xb2\xb3]|\\^?-?[0-9]{1,2})?)"
#define AND "( *[/*.] *| +)"
#define GROUP "(" TERM "|\\(" TERM "(" AND TERM ")*\\))"
static const char plain_unit[] = "^" GROUP "(" AND GROUP ")*$";

/* Words after which UDUNITS-2 reads an origin. */
static const char origin[] = "(^|[^a-z\x80-\xff])(since|from|after|ref|at)([^a-z\x80-\xff]|$)";

/* True if `text` matches the regular expression, whatever the case of its letters. */
static fracas_err match(const char *expression, const char *text, bool *matches)
{
    regex_t compiled;
    if (regcomp(&compiled, expression, REG_EXTENDED | REG_ICASE | REG_NOSUB))
        return fracas_no_memory("a unit");
    *matches = regexec(&compiled, text, 0, NULL, 0) == 0;
    regfree(&compiled);
    return FRACAS_OK;
}

/* The quantity of a unit: one of the table, or its dimension. */
static void name_dimension(ut_system *system, const ut_unit *unit, char *what, size_t size)
{
    for (size_t i = 0; i < ndimensions; i++) {
        OWN(ut_unit) known = ut_parse(system, dimensions[i].unit, UT_UTF8);
        OWN(ut_unit) ratio = known ? ut_divide(unit, known) : NULL;
        if (!ratio || !ut_is_dimensionless(ratio)) continue;
        snprintf(what, size, "%s", dimensions[i].what);
        return;
    }
    char formatted[64];
    int length = ut_format(unit, formatted, sizeof formatted - 1, UT_ASCII);
    formatted[length < 0                        ? 0
              : length >= (int)sizeof formatted ? (int)sizeof formatted - 1
                                                : length] = '\0';
    snprintf(what, size, "a quantity in %s", formatted);
}

static double convert_once(ut_unit *from, ut_unit *to, double value)
{
    cv_converter *converter = ut_get_converter(from, to);
    if (!converter) return NAN;
    double converted = cv_convert_double(converter, value);
    cv_free(converter);
    return converted;
}

/* Factor from `found` to `expected`; NAN when they measure different things, 0 for a unit with an
 * origin of its own. The ratio is taken because ut_are_convertible() holds s and 1/s for
 * convertible (by the reciprocal). */
static double unit_factor(ut_system *system, ut_unit *found, ut_unit *expected)
{
    OWN(ut_unit) ratio = ut_divide(found, expected);
    OWN(ut_unit) one = ut_get_dimensionless_unit_one(system);
    if (!ratio || !one || !ut_is_dimensionless(ratio)) return NAN;
    return convert_once(found, expected, 0.0) == 0.0 ? convert_once(ratio, one, 1.0) : 0.0;
}

/* The unit written as `name`; *found stays NULL if there is none such. */
static fracas_err parse_unit(ut_system *system, const char *name, ut_unit **found)
{
    bool plain, from = false;
    TRY(match(plain_unit, name, &plain));
    if (plain) TRY(match(origin, name, &from));
    plain = plain && !from;
    *found = plain ? ut_parse(system, name, UT_UTF8) : NULL;
    if (!*found && plain && ut_get_status() == UT_OS) return fracas_no_memory("a unit");
    return FRACAS_OK;
}

/* Events a second or a minute, which UDUNITS-2 takes for radians, and others for revolutions. */
static const char events[] = "(hz|hertz(es)?|becquerels?|bq)($|[^a-z])|^1 */ *min(utes?)?$|"
                             "^min(utes?)?\\^?-1$";

/* FRACAS_USAGE for 6 kHz where an angular velocity is expected. As a rate it is 6e3 1/s. */
static fracas_err check_angular(const char *text, const char *name, const char *si)
{
    bool found;
    if (strcmp(si, "rad/s") != 0) return FRACAS_OK;
    TRY(match(events, name, &found));
    if (!found) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "`%s` may mean radians or revolutions; expected an angular velocity, in "
                       "rad/s or rpm",
                       text);
}

/* Factor from the unit written as `name` to `expected`; FRACAS_USAGE names its fault. `text`: the
 * whole value. */
static fracas_err parse_factor(ut_system *system, const char *text, const char *name,
                               const char *si, double *factor)
{
    const char *what, *write_in;
    fracas_units_describe(si, &what, &write_in);
    OWN(ut_unit) expected = ut_parse(system, si, UT_UTF8);
    if (!expected)
        return fracas_fail(FRACAS_BUG, "a parameter table has the unit `%s`, unknown to UDUNITS-2",
                           si);
    OWN(ut_unit) found = NULL;
    TRY(parse_unit(system, name, &found));
    if (!found)
        return fracas_fail(FRACAS_USAGE, "`%s` has an unknown unit, `%s`; expected %s, in %s", text,
                           name, what, write_in);
    TRY(check_angular(text, name, si));
    *factor = unit_factor(system, found, expected);
    if (isnan(*factor)) {
        char is[96];
        name_dimension(system, found, is, sizeof is);
        return fracas_fail(FRACAS_USAGE, "`%s` is %s; expected %s, in %s", text, is, what,
                           write_in);
    }
    if (*factor != 0.0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "`%s` is counted from an origin of its own; expected %s, in %s", text, what,
                       write_in);
}

/* ---- dimensions ---- */

static const char *const base_units[] = {"m", "kg", "s", "K"};

static ut_status visit_product(const ut_unit *unit, int count, const ut_unit *const *basic,
                               const int *powers, void *dimension)
{
    (void)unit;
    for (int b = 0; b < count; b++) {
        if (ut_is_dimensionless(basic[b])) continue; /* an angle */
        const char *symbol = ut_get_symbol(basic[b], UT_ASCII);
        size_t i = 0;
        while (i < 4 && (!symbol || strcmp(base_units[i], symbol) != 0)) i++;
        if (i == 4) return UT_BAD_ARG;
        ((fracas_dimension *)dimension)->power[i] = powers[b];
    }
    return UT_SUCCESS;
}

static ut_status visit_basic(const ut_unit *unit, void *dimension)
{
    return visit_product(unit, 1, &unit, &(int){1}, dimension);
}

static ut_status visit_scaled(const ut_unit *unit, double scale, const ut_unit *of,
                              double origin_at, void *dimension);

static ut_status visit_other(const ut_unit *unit, double of, const ut_unit *reference,
                             void *dimension)
{
    (void)unit, (void)of, (void)reference, (void)dimension;
    return UT_BAD_ARG;
}

static ut_status visit_time(const ut_unit *unit, const ut_unit *of, double origin_at,
                            void *dimension)
{
    return visit_other(unit, origin_at, of, dimension);
}

static const ut_visitor visitor = {visit_basic, visit_product, visit_scaled, visit_time,
                                   visit_other};

static ut_status visit_scaled(const ut_unit *unit, double scale, const ut_unit *of,
                              double origin_at, void *dimension)
{
    (void)unit, (void)scale;
    return origin_at == 0 ? ut_accept_visitor(of, &visitor, dimension) : UT_BAD_ARG;
}

static fracas_err parse_dimension(ut_system *system, const char *name, double *factor,
                                  fracas_dimension *dimension)
{
    OWN(ut_unit) found = NULL;
    TRY(parse_unit(system, name, &found));
    *dimension = (fracas_dimension){{0}};
    if (!found) return fracas_fail(FRACAS_USAGE, "unknown unit `%s`", name);
    if (ut_accept_visitor(found, &visitor, dimension) != UT_SUCCESS)
        return fracas_fail(FRACAS_USAGE, "unit `%s` is none of length, mass, time, temperature",
                           name);
    char si[64];
    snprintf(si, sizeof si, "m%g kg%g s%g K%g", dimension->power[0], dimension->power[1],
             dimension->power[2], dimension->power[3]);
    OWN(ut_unit) expected = ut_parse(system, si, UT_ASCII);
    if (!expected) return fracas_no_memory("a unit");
    *factor = unit_factor(system, found, expected);
    return FRACAS_OK;
}

fracas_err fracas_units_parse(const fracas_units *units, const char *name, double *factor,
                              fracas_dimension *dimension)
{
    locale_t before = enter_plain_locale();
    fracas_err err = parse_dimension(units->system, name, factor, dimension);
    uselocale(before);
    return err;
}

/* Reads the unit `name` after the number in `text`. */
static fracas_err read_factor(const fracas_units *units, const char *text, const char *name,
                              const char *si, double *factor)
{
    if (strcmp(si, "1") == 0) {
        *factor = 0.01;
        if (strcmp(name, "%") == 0) return FRACAS_OK;
        return fracas_fail(FRACAS_USAGE,
                           "`%s` has a unit; expected a pure number, with no unit, or %%", text);
    }
    locale_t before = enter_plain_locale();
    fracas_err err = parse_factor(units->system, text, name, si, factor);
    uselocale(before);
    return err;
}

fracas_err fracas_units_read(const fracas_units *units, const char *text, const char *si,
                             double *value)
{
    const char *what, *write_in;
    fracas_units_describe(si, &what, &write_in);
    size_t length = fracas_number_length(text);
    const char *unit = text + length + strspn(text + length, " ");
    bool apart = unit > text + length || strcmp(unit, "%") == 0;
    const size_t digits = *unit == ',' ? strspn(unit + 1, "0123456789") : 0;
    if (length > 0 && digits == 3 && *text != '0')
        return fracas_fail(FRACAS_USAGE,
                           "`%s` is not a number: it has a comma; if that parts thousands leave it "
                           "out: %.*s%s; if decimals write a point: %.*s.%s",
                           text, (int)length, text, unit + 1, (int)length, text, unit + 1);
    if (length > 0 && digits > 0)
        return fracas_fail(FRACAS_USAGE,
                           "`%s` is not a number: it has a decimal comma; write a point: %.*s.%s",
                           text, (int)length, text, unit + 1);
    if (length > 0 && strncmp(unit, "**", 2) == 0)
        return fracas_fail(FRACAS_USAGE, "`%s` is not a number: write a power of ten as 1e4", text);
    if (length == 0 || (*unit && !apart))
        return fracas_fail(
            FRACAS_USAGE, "`%s` is not a number; expected %s, in %s%s", text, what, write_in,
            length > 0 && strcmp(si, "1") != 0 ? ", with a space before the unit" : "");
    double number, factor = 1.0;
    TRY(number_value(text, &number));
    if (*unit) TRY(read_factor(units, text, unit, si, &factor));
    double converted = number * factor;
    if (!isfinite(converted) || (number != 0.0 && fabs(converted) < 2.2250738585072014e-308))
        return fracas_fail(FRACAS_USAGE, "`%s` is too %s for a double-precision number in %s", text,
                           fabs(converted) > 1.0 ? "large" : "small", si);
    *value = fracas_number_round(converted);
    return FRACAS_OK;
}
