/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/lines.h"

#include "base/units.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

fracas_lines fracas_lines_begin(const fracas_attachment *file)
{
    static const char mark[] = "\xef\xbb\xbf"; /* some programs put it before UTF-8 */
    const size_t skip = strncmp(file->text, mark, 3) == 0 ? 3 : 0;
    return (fracas_lines){.file = file, .at = file->text + skip, .end = file->text + file->size};
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

bool fracas_lines_next(fracas_lines *lines)
{
    const bool begun = lines->start != NULL;
    while (lines->at < lines->end) {
        const char *start = lines->at, *stop = memchr(start, '\n', (size_t)(lines->end - start));
        if (!stop) stop = lines->end;
        lines->at = stop < lines->end ? stop + 1 : stop;
        lines->line++;
        while (start < stop && is_blank(*start)) start++;
        while (start < stop && is_blank(stop[-1])) stop--;
        if (start == stop || *start == '#') continue;
        lines->start = start;
        lines->stop = stop;
        lines->first = !begun;
        return true;
    }
    return false;
}

static void take(const char *start, const char *stop, char field[FRACAS_FIELD])
{
    const size_t length = (size_t)(stop - start),
                 kept = length < FRACAS_FIELD ? length : FRACAS_FIELD - 1;
    memcpy(field, start, kept);
    field[kept] = '\0';
    if (strlen(field) != kept) field[0] = '\0';
}

void fracas_lines_last_field(const fracas_lines *lines, char field[FRACAS_FIELD])
{
    const char *start = lines->stop;
    while (start > lines->start && start[-1] != ',' && !is_blank(start[-1])) start--;
    take(start, lines->stop, field);
}

void fracas_lines_field(fracas_lines *lines, char field[FRACAS_FIELD])
{
    const char *stop = lines->start;
    while (stop < lines->stop && *stop != ',' && !is_blank(*stop)) stop++;
    take(lines->start, stop, field);
    while (stop < lines->stop && is_blank(*stop)) stop++;
    if (stop < lines->stop && *stop == ',') stop++;
    while (stop < lines->stop && is_blank(*stop)) stop++;
    lines->start = stop;
}

/* A comma between digits. */
static bool is_inner(const fracas_lines *lines, const char *c)
{
    return *c == ',' && c > lines->start && c + 1 < lines->stop && isdigit((unsigned char)c[-1]) &&
           isdigit((unsigned char)c[1]);
}

/* A part of a line between blanks, semicolons and commas that are not between digits. */
typedef struct {
    size_t commas;
    bool number;  /* it is one, or several with its commas */
    bool point;   /* it has a decimal point */
    bool leading; /* a 0 and more digits come after a comma, as in 1,05 */
} word;

static word next_word(const fracas_lines *lines, const char **at)
{
    word of = {.number = true};
    const char *c = *at, *from = c;
    for (; c < lines->stop && !is_blank(*c) && *c != ';'; c++) {
        if (*c != ',') continue;
        if (!is_inner(lines, c)) break;
        of.commas++;
        of.leading = of.leading ||
                     (c[1] == '0' && c + 2 < lines->stop && isdigit((unsigned char)c[2]));
    }
    for (const char *d = from; d < c; d++) {
        of.point = of.point || *d == '.';
        of.number = of.number && (isdigit((unsigned char)*d) || memchr(",.+-eE", *d, 6));
    }
    while (c < lines->stop && (is_blank(*c) || *c == ';' || *c == ',')) c++;
    *at = c;
    return of;
}

static size_t count_fields(const fracas_lines *lines)
{
    fracas_lines ahead = *lines;
    char field[FRACAS_FIELD];
    size_t count = 0;
    for (; ahead.start < ahead.stop; count++) fracas_lines_field(&ahead, field);
    return count;
}

bool fracas_lines_is_decimal_comma(const fracas_lines *lines, size_t numbers)
{
    size_t words = 0, decimals = 0, readable = 0;
    bool sure = false, many = false;
    const bool semicolon = memchr(lines->start, ';', (size_t)(lines->stop - lines->start));
    if (lines->headings > 0 && count_fields(lines) <= lines->headings) return false;
    for (const char *at = lines->start; at < lines->stop; words++) {
        const word of = next_word(lines, &at);
        const bool decimal = of.number && !of.point && of.commas == 1;
        sure = sure || (of.number && !of.point && of.leading) || (decimal && semicolon);
        many = many || (numbers > 1 && of.number && !of.point && of.commas >= numbers);
        if (words >= numbers && numbers > 1) continue;
        decimals += decimal;
        readable += of.number && of.commas <= 1;
    }
    return sure || many || (decimals > 0 && (numbers == 1 || readable >= numbers));
}

fracas_err fracas_lines_check_commas(const fracas_lines *lines, size_t numbers,
                                     const char *headings)
{
    char line[FRACAS_FIELD], expected[200];
    if (!fracas_lines_is_decimal_comma(lines, numbers)) return FRACAS_OK;
    snprintf(line, sizeof line, "%.*s", (int)(lines->stop - lines->start), lines->start);
    snprintf(expected, sizeof expected,
             "a decimal point, not a comma, in a %s; or, if the comma ends a column, the names of "
             "all columns in a first line (`%s`)",
             numbers == 1 ? "strength" : "number", headings);
    return fracas_lines_refuse(lines, line, expected);
}

fracas_err fracas_lines_refuse(const fracas_lines *lines, const char *found, const char *expected)
{
    return fracas_fail(FRACAS_USAGE, "%s:%" PRId64 ": found %s%s%s; expected %s", lines->file->path,
                       lines->line, *found ? "`" : "no text there", found, *found ? "`" : "",
                       expected);
}

fracas_err fracas_lines_number(fracas_lines *lines, const char *name, const char *form,
                               double *value)
{
    char field[FRACAS_FIELD];
    fracas_lines_field(lines, field);
    if (!fracas_number_read(field, value)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s:%" PRId64 ": found %s%s%s as %s; a line begins with %s, numbers without "
                       "units after commas or blanks",
                       lines->file->path, lines->line, *field ? "`" : "nothing", field,
                       *field ? "`" : "", name, form);
}

void fracas_lines_name(fracas_lines *lines)
{
    for (const char *c = lines->start; c < lines->stop; c++) lines->headings += *c == ',';
    if (lines->headings > 0) lines->headings++;
}

bool fracas_lines_next_row(fracas_lines *lines)
{
    char field[FRACAS_FIELD];
    if (!fracas_lines_next(lines)) return false;
    if (!lines->first) return true;
    fracas_lines ahead = *lines;
    fracas_lines_field(&ahead, field);
    if (!fracas_lines_is_heading(field)) return true;
    fracas_lines_name(lines);
    return fracas_lines_next(lines);
}

bool fracas_lines_is_heading(const char *field)
{
    static const char *const words[] = {"nan", "inf", "infinity"};
    for (size_t w = 0; w < FRACAS_COUNT(words); w++)
        if (strcasecmp(field, words[w]) == 0) return false;
    return *field && !strchr("0123456789+-.", *field);
}

/* Multiples of m, s and Pa that people write into headings. UDUNITS-2 takes F(t), too. */
static bool is_multiple(const char *unit)
{
    static const char *const known[] = {"mm",  "cm",    "um",    "\u00b5m", "\u03bcm", "km",
                                        "nm",  "in",    "ms",    "us",      "\u00b5s", "\u03bcs",
                                        "ns",  "kPa",   "MPa",   "GPa",     "psi",     "ksi",
                                        "bar", "N/mm2", "N/mm^2"};
    for (size_t k = 0; k < FRACAS_COUNT(known); k++)
        if (!strcmp(unit, known[k])) return true;
    return false;
}

/* A multiple in brackets between `at` and `stop`. */
static bool find_unit(const char *at, const char *stop, char unit[FRACAS_FIELD])
{
    for (; at < stop; at++) {
        if (*at != '(' && *at != '[') continue;
        const char *from = at + 1, *end = memchr(at, *at == '(' ? ')' : ']', (size_t)(stop - at));
        if (!end) continue;
        const char *to = end;
        while (from < to && is_blank(*from)) from++;
        while (to > from && is_blank(to[-1])) to--;
        take(from, to, unit);
        if (is_multiple(unit)) return true;
    }
    *unit = '\0';
    return false;
}

/* The first heading is `interface`. */
static bool counts_interfaces(const fracas_lines *lines)
{
    fracas_lines ahead = *lines;
    char field[FRACAS_FIELD];
    fracas_lines_field(&ahead, field);
    return ahead.start < ahead.stop && !strcasecmp(field, "interface");
}

fracas_lines_doubts fracas_lines_doubt(const fracas_attachment *file, bool last)
{
    fracas_lines_doubts of = {"", 0};
    fracas_lines lines = fracas_lines_begin(file), ahead;
    char field[FRACAS_FIELD];
    if (!fracas_lines_next(&lines)) return of;
    ahead = lines;
    fracas_lines_field(&ahead, field);
    if (!fracas_lines_is_heading(field)) return of;
    const char *from = lines.start;
    for (const char *c = lines.start; last && c < lines.stop; c++)
        if (*c == ',' || *c == ';' || *c == '\t') from = c;
    find_unit(from, lines.stop, of.unit);
    if (!last || !counts_interfaces(&lines)) return of;
    double number, before = NAN;
    while (fracas_lines_next(&lines)) {
        ahead = lines;
        fracas_lines_field(&ahead, field);
        if (fracas_number_read(field, &number)) return of;
        if (number != before + 1 && !isnan(before)) of.line = lines.line;
        if (of.line) return of;
        before = number;
    }
    return of;
}
