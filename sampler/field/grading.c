/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/field/grading.h"

#include "base/own.h"
#include "sampler/distribution/lines.h"

#include <inttypes.h>
#include <math.h>

/* A line of the file. */
typedef struct {
    double at;     /* m */
    double factor; /* 1 */
} place;

typedef struct {
    place *place;
    size_t count;
} profile;

static void profile_clear(profile *of)
{
    free(of->place);
}

/* The next place; *found is false at the end of the file. */
FRACAS_MUST_USE static fracas_err next_place(fracas_lines *lines, place *p, bool *found)
{
    static const char form[] = "a coordinate [m] and a factor";
    *found = fracas_lines_next_row(lines);
    if (!*found) return FRACAS_OK;
    TRY(fracas_lines_check_commas(lines, 2, "coordinate,factor"));
    TRY(fracas_lines_number(lines, "coordinate", form, &p->at));
    TRY(fracas_lines_number(lines, "factor", form, &p->factor));
    if (p->factor > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "%s:%" PRId64 ": a factor of %g; it must be greater than 0",
                       lines->file->path, lines->line, p->factor);
}

/* Coordinates increase; at a jump there are two places. */
FRACAS_MUST_USE static fracas_err check_order(const fracas_lines *lines, const profile *of,
                                              double at)
{
    const size_t n = of->count;
    if (n > 0 && at < of->place[n - 1].at)
        return fracas_fail(
            FRACAS_USAGE,
            "%s:%" PRId64
            ": the coordinate %.9g m comes after %.9g m; sort the lines by their coordinate",
            lines->file->path, lines->line, at, of->place[n - 1].at);
    if (n > 1 && at == of->place[n - 2].at)
        return fracas_fail(FRACAS_USAGE,
                           "%s:%" PRId64
                           ": the coordinate %.9g m is given a third time; at a jump there are two "
                           "lines, with the factors before and after it",
                           lines->file->path, lines->line, at);
    return FRACAS_OK;
}

/* The caller clears, whatever is returned. */
FRACAS_MUST_USE static fracas_err read_profile(const fracas_attachment *file, profile *of)
{
    fracas_lines lines = fracas_lines_begin(file);
    size_t room = 0;
    for (;;) {
        place p;
        bool found;
        TRY(next_place(&lines, &p, &found));
        if (!found) break;
        TRY(check_order(&lines, of, p.at));
        TRY(fracas_grow(&of->place, sizeof p, of->count, &room, "the profile of a factor"));
        of->place[of->count++] = p;
    }
    if (of->count > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s has no factor; expected lines of a coordinate [m] and a factor",
                       file->path);
}

fracas_err fracas_grading_check(const fracas_strength *strength)
{
    FRACAS_CLEARED(profile) of = {0};
    if (!strength->factor && !strength->factor_along) return FRACAS_OK;
    if (!strength->factor)
        return fracas_fail(FRACAS_USAGE, "strength.factor_along is given without a file `factor`: "
                                         "name its file, or leave out both");
    if (!strength->factor_along)
        return fracas_fail(FRACAS_USAGE,
                           "strength.factor needs `factor_along`: x, y, z or radius, what the "
                           "coordinates of %s are",
                           strength->factor->path);
    return read_profile(strength->factor, &of);
}

/* (grading.1) */
static double coordinate_of(const fracas_kind *along, const double position[3])
{
    if (along == &fracas_along_radius)
        return sqrt(position[0] * position[0] + position[1] * position[1]);
    return position[along == &fracas_along_x ? 0 : along == &fracas_along_y ? 1 : 2];
}

/* (grading.2) */
static double factor_at(const profile *of, double s)
{
    const place *p = of->place;
    if (s < p[0].at) return p[0].factor;
    size_t low = 0, high = of->count; /* p[low].at <= s < p[high].at, infinite beyond the last */
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (p[middle].at <= s) low = middle;
        else high = middle;
    }
    if (high == of->count) return p[low].factor;
    return p[low].factor +
           (p[high].factor - p[low].factor) * ((s - p[low].at) / (p[high].at - p[low].at));
}

fracas_err fracas_grading_create(const fracas_strength *strength, size_t n,
                                 const double (*position)[3], double **factor)
{
    FRACAS_CLEARED(profile) of = {0};
    *factor = NULL;
    TRY(fracas_grading_check(strength));
    if (!strength->factor || n == 0) return FRACAS_OK;
    TRY(read_profile(strength->factor, &of));
    if (!(*factor = malloc(n * sizeof **factor)))
        return fracas_no_memory("the factors of a strength field");
    for (size_t k = 0; k < n; k++)
        (*factor)[k] = factor_at(&of, coordinate_of(strength->factor_along, position[k]));
    return FRACAS_OK;
}
