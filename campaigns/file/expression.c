/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/expression.h"

#include "base/elementary.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const fracas_units *units;
    const char *text, *at; /* the whole, and what is still to be read */
    fracas_expression_lookup *lookup;
    void *context;
} reading;

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_\xc2\xb5\xce"
                              "\xbc",
                  key_letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";

size_t fracas_expression_path(const char *text)
{
    size_t length = strspn(text, key_letters);
    bool dotted = false;
    if (!strspn(text, letters)) return 0;
    while (text[length] == '.' && strspn(text + length + 1, letters) > 0) {
        length += 1 + strspn(text + length + 1, key_letters);
        dotted = true;
    }
    return dotted ? length : 0;
}

static char next(reading *r)
{
    r->at += strspn(r->at, " ");
    return *r->at;
}

static bool take(reading *r, char c)
{
    if (next(r) != c) return false;
    r->at++;
    return true;
}

static fracas_err unexpected(reading *r, const char *expected)
{
    const bool end = !next(r);
    return fracas_fail(FRACAS_USAGE, "`%s`: expected %s%s%s%s", r->text, expected,
                       end ? " at its end" : " where `", end ? "" : r->at, end ? "" : "` stands");
}

bool fracas_magnitude_same(const fracas_magnitude *a, const fracas_magnitude *b)
{
    for (int i = 0; i < 4; i++)
        if (fabs(a->dimension.power[i] - b->dimension.power[i]) > 1e-9) return false;
    return true;
}

static fracas_err need_same(const reading *r, const fracas_magnitude *a, const fracas_magnitude *b)
{
    if (fracas_magnitude_same(a, b)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "`%s` adds or compares quantities of different dimensions: give all of them "
                       "in units of the same kind",
                       r->text);
}

static fracas_err multiply(const reading *r, fracas_magnitude *a, const fracas_magnitude *b,
                           int sign)
{
    if (sign < 0 && b->value == 0) return fracas_fail(FRACAS_USAGE, "`%s` divides by 0", r->text);
    a->value = sign > 0 ? a->value * b->value : a->value / b->value;
    for (int i = 0; i < 4; i++) a->dimension.power[i] += sign * b->dimension.power[i];
    return FRACAS_OK;
}

/* ---- functions ---- */

/* Whole numbers of quotients that rounding has moved off one, 50 mm/20 um. */
static double ceil_of(double x)
{
    return ceil(fracas_number_round(x));
}
static double floor_of(double x)
{
    return floor(fracas_number_round(x));
}
static double round_of(double x)
{
    return floor(fracas_number_round(x) + 0.5);
}

static const struct {
    const char *name;
    double (*of)(double);
    double power;                  /* makes the dimension's; 0: takes a pure number */
    double (*two)(double, double); /* takes two or more of one dimension */
} functions[] = {
    {"ceil", ceil_of, 0, NULL}, {"floor", floor_of, 0, NULL}, {"round", round_of, 0, NULL},
    {"sqrt", sqrt, 0.5, NULL},  {"abs", fabs, 1, NULL},       {"min", NULL, 1, fmin},
    {"max", NULL, 1, fmax},
};
enum { NFUNCTIONS = sizeof functions / sizeof *functions };

static fracas_err read_sum(reading *r, fracas_magnitude *made);

static fracas_err call(reading *r, size_t f, fracas_magnitude *made)
{
    static const fracas_magnitude pure;
    TRY(read_sum(r, made));
    while (functions[f].two && take(r, ',')) {
        fracas_magnitude other;
        TRY(read_sum(r, &other));
        TRY(need_same(r, made, &other));
        made->value = functions[f].two(made->value, other.value);
    }
    if (!take(r, ')')) return unexpected(r, functions[f].two ? "`,` or `)`" : "`)`");
    if (functions[f].two) return FRACAS_OK;
    if (functions[f].power == 0 && !fracas_magnitude_same(made, &pure))
        return fracas_fail(FRACAS_USAGE,
                           "`%s`: %s takes a pure number: divide by a value of the same dimension",
                           r->text, functions[f].name);
    made->value = functions[f].of(made->value);
    for (int i = 0; i < 4; i++) made->dimension.power[i] *= functions[f].power;
    return FRACAS_OK;
}

/* ---- atoms ---- */

/* A name without a dot: a function, pi, a unit. */
static fracas_err read_name(reading *r, fracas_magnitude *made)
{
    const size_t name = strspn(r->at, letters);
    for (size_t f = 0; f < NFUNCTIONS; f++)
        if (strlen(functions[f].name) == name && !strncmp(functions[f].name, r->at, name) &&
            r->at[name] == '(') {
            r->at += name + 1;
            return call(r, f, made);
        }
    *made = (fracas_magnitude){.value = FRACAS_PI};
    if (name == 2 && !strncmp(r->at, "pi", 2)) {
        r->at += 2;
        return FRACAS_OK;
    }
    char unit[40];
    const size_t length = name + strspn(r->at + name, "0123456789");
    snprintf(unit, sizeof unit, "%.*s", (int)length, r->at);
    fracas_err err = fracas_units_parse(r->units, unit, &made->value, &made->dimension);
    if (err)
        return err != FRACAS_USAGE
                   ? err
                   : fracas_fail(err,
                                 "`%s`: `%s` is no unit, key or function; keys are written with "
                                 "their section, as `geometry.length`",
                                 r->text, unit);
    r->at += length;
    return FRACAS_OK;
}

static fracas_err read_number(reading *r, fracas_magnitude *made)
{
    char number[FRACAS_NUMBER_TEXT + 200];
    const size_t length = fracas_number_length(r->at);
    snprintf(number, sizeof number, "%.*s", (int)length, r->at);
    *made = (fracas_magnitude){0};
    TRY(fracas_number_read(number, &made->value));
    r->at += length;
    if (next(r) == '1' && r->at[1] == '/') r->at++; /* 1e4 1/s */
    if (!strspn(r->at, letters)) return FRACAS_OK;
    fracas_magnitude unit;
    if (fracas_expression_path(r->at)) return unexpected(r, "an operator");
    TRY(read_name(r, &unit));
    return multiply(r, made, &unit, 1);
}

static fracas_err read_atom(reading *r, fracas_magnitude *made)
{
    if (take(r, '(')) {
        TRY(read_sum(r, made));
        return take(r, ')') ? FRACAS_OK : unexpected(r, "`)`");
    }
    const size_t path = fracas_expression_path(r->at);
    if (path) {
        TRY(r->lookup(r->context, r->at, path, made));
        r->at += path;
        return FRACAS_OK;
    }
    if (strspn(r->at, letters)) return read_name(r, made);
    if (strspn(r->at, ".0123456789") && fracas_number_length(r->at)) return read_number(r, made);
    return unexpected(r, "a number, a key or a function");
}

static fracas_err read_power(reading *r, fracas_magnitude *made)
{
    const int sign = take(r, '-') ? -1 : 1;
    TRY(read_atom(r, made));
    if (take(r, '^')) {
        fracas_magnitude exponent;
        TRY(read_atom(r, &exponent));
        const fracas_magnitude base = *made;
        if (exponent.value != floor(exponent.value) || !(exponent.value <= 9))
            return fracas_fail(FRACAS_USAGE, "`%s`: exponents are whole numbers from 0 to 9",
                               r->text);
        made->value = 1;
        for (int k = 0; k < (int)exponent.value; k++) made->value *= base.value;
        for (int i = 0; i < 4; i++) made->dimension.power[i] *= exponent.value;
    }
    made->value *= sign;
    return FRACAS_OK;
}

static fracas_err read_product(reading *r, fracas_magnitude *made)
{
    TRY(read_power(r, made));
    for (;;) {
        fracas_magnitude factor;
        const bool times = take(r, '*');
        if (!times && !take(r, '/')) return FRACAS_OK;
        TRY(read_power(r, &factor));
        TRY(multiply(r, made, &factor, times ? 1 : -1));
    }
}

static fracas_err read_sum(reading *r, fracas_magnitude *made)
{
    TRY(read_product(r, made));
    for (;;) {
        fracas_magnitude term;
        const bool plus = take(r, '+');
        if (!plus && !take(r, '-')) return FRACAS_OK;
        TRY(read_product(r, &term));
        TRY(need_same(r, made, &term));
        made->value += plus ? term.value : -term.value;
    }
}

fracas_err fracas_expression_evaluate(const fracas_units *units, const char *text,
                                      fracas_expression_lookup *lookup, void *context,
                                      fracas_magnitude *quantity)
{
    reading r = {.units = units, .text = text, .at = text, .lookup = lookup, .context = context};
    TRY(read_sum(&r, quantity));
    if (next(&r)) return unexpected(&r, "an operator");
    if (isfinite(quantity->value)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "`%s` is no finite number", text);
}
