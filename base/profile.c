/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/profile.h"

#include "base/lines.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

void fracas_profile_clear(fracas_profile *of)
{
    free(of->place);
    *of = (fracas_profile){0};
}

/* The next place; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_place(fracas_lines *lines, const fracas_profile_form *form,
                                             fracas_profile_place *p, bool *found)
{
    char headings[64], line[64];
    *p = (fracas_profile_place){0};
    *found = fracas_lines_next_row(lines);
    if (!*found) return FRACAS_OK;
    snprintf(headings, sizeof headings, "%s,%s", form->at, form->value);
    snprintf(line, sizeof line, "a %s [%s] and a %s", form->at, form->unit, form->value);
    TRY(fracas_lines_check_commas(lines, 2, headings));
    TRY(fracas_lines_number(lines, form->at, line, &p->at));
    TRY(fracas_lines_number(lines, form->value, line, &p->value));
    if (p->value > 0 || !form->positive) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s:%" PRId64 ": a %s of %g; it must be greater than 0",
                       lines->file->path, lines->line, form->value, p->value);
}

/* Coordinates rise; at a jump there are two places. */
FRACAS_MUST_USE static fracas_err check_order(const fracas_lines *lines,
                                              const fracas_profile_form *form,
                                              const fracas_profile *of, double at)
{
    const size_t n = of->count;
    if (n > 0 && at < of->place[n - 1].at)
        return fracas_fail(FRACAS_USAGE,
                           "%s:%" PRId64
                           ": the %s %.9g %s comes after %.9g %s; sort the lines by their %s",
                           lines->file->path, lines->line, form->at, at, form->unit,
                           of->place[n - 1].at, form->unit, form->at);
    if (n > 1 && at == of->place[n - 2].at)
        return fracas_fail(FRACAS_USAGE,
                           "%s:%" PRId64
                           ": the %s %.9g %s is given a third time; at a jump there are two lines, "
                           "with the %ss before and after it",
                           lines->file->path, lines->line, form->at, at, form->unit, form->value);
    return FRACAS_OK;
}

fracas_err fracas_profile_read(const fracas_attachment *file, const fracas_profile_form *form,
                               fracas_profile *of)
{
    fracas_lines lines = fracas_lines_begin(file);
    size_t room = 0;
    *of = (fracas_profile){0};
    for (;;) {
        fracas_profile_place p;
        bool found;
        TRY(next_place(&lines, form, &p, &found));
        if (!found) break;
        TRY(check_order(&lines, form, of, p.at));
        TRY(fracas_grow(&of->place, sizeof p, of->count, &room, "the lines of a file"));
        if (of->count > 0) {
            const fracas_profile_place *last = &of->place[of->count - 1];
            p.integral = last->integral + 0.5 * (p.at - last->at) * (p.value + last->value);
        }
        of->place[of->count++] = p;
    }
    if (of->count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s has no %s; expected lines of a %s [%s] and a %s",
                       file->path, form->value, form->at, form->unit, form->value);
}

/* The last place at or below s, the first of all where there is none. */
static size_t place_below(const fracas_profile *of, double s)
{
    size_t low = 0, high = of->count; /* p[low].at <= s < p[high].at, infinite beyond the last */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (of->place[middle].at <= s) low = middle;
        else high = middle;
    }
    return low;
}

/* (grading.2) */
double fracas_profile_at(const fracas_profile *of, double s)
{
    const fracas_profile_place *p = of->place;
    if (s < p[0].at) return p[0].value;
    const size_t low = place_below(of, s), high = low + 1;
    if (high == of->count) return p[low].value;
    return p[low].value +
           (p[high].value - p[low].value) * ((s - p[low].at) / (p[high].at - p[low].at));
}

/* The integral from the first place to s. */
static double integral_to(const fracas_profile *of, double s)
{
    const fracas_profile_place *p = &of->place[place_below(of, s)];
    return p->integral + 0.5 * (s - p->at) * (p->value + fracas_profile_at(of, s));
}

double fracas_profile_integral(const fracas_profile *of, double s)
{
    return integral_to(of, s) - integral_to(of, 0);
}
