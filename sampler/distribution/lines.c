/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/lines.h"

#include "base/units.h"

#include <ctype.h>
#include <inttypes.h>
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

bool fracas_lines_is_decimal_comma(const fracas_lines *lines)
{
    const size_t length = (size_t)(lines->stop - lines->start);
    const char *comma = memchr(lines->start, ',', length);
    if (lines->columns || !comma || comma == lines->start || comma + 1 == lines->stop) return false;
    if (!isdigit((unsigned char)comma[-1]) || !isdigit((unsigned char)comma[1]) ||
        memchr(comma + 1, ',', (size_t)(lines->stop - comma - 1)))
        return false;
    const char *from = comma, *to = comma;
    while (from > lines->start && !is_blank(from[-1])) from--;
    while (to < lines->stop && !is_blank(*to)) to++;
    return !memchr(from, '.', (size_t)(to - from));
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

bool fracas_lines_next_row(fracas_lines *lines)
{
    char field[FRACAS_FIELD];
    if (!fracas_lines_next(lines)) return false;
    if (!lines->first) return true;
    fracas_lines ahead = *lines;
    fracas_lines_field(&ahead, field);
    return !fracas_lines_is_heading(field) || fracas_lines_next(lines);
}

bool fracas_lines_is_heading(const char *field)
{
    static const char *const words[] = {"nan", "inf", "infinity"};
    for (size_t w = 0; w < FRACAS_COUNT(words); w++)
        if (strcasecmp(field, words[w]) == 0) return false;
    return *field && !strchr("0123456789+-.", *field);
}

fracas_err fracas_lines_summarize(const fracas_attachment *file, fracas_lines_reader *read,
                                  fracas_lines_summary *summary)
{
    fracas_lines lines = fracas_lines_begin(file);
    *summary = (fracas_lines_summary){.smallest = INFINITY};
    for (;;) {
        bool found;
        double strength;
        TRY(read(&lines, &strength, &found));
        if (!found) break;
        const double before = summary->count > 0 ? strength - summary->sum / (double)summary->count
                                                 : 0.0;
        summary->count++;
        summary->sum += strength;
        summary->squares += before * (strength - summary->sum / (double)summary->count);
        summary->smallest = fmin(summary->smallest, strength);
        summary->largest = fmax(summary->largest, strength);
    }
    if (summary->count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s has no strength; expected one in Pa on each line",
                       file->path);
}
