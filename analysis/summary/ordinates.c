/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/summary/ordinates.h"

#include "analysis/summary/numbers.h"
#include "analysis/summary/study.h"

#include <math.h>
#include <string.h>

static double real_at(const fracas_point_statistics *point, size_t place)
{
    double value = NAN;
    if (place != SIZE_MAX) memcpy(&value, (const char *)point + place, sizeof value);
    return value;
}

double fracas_ordinate_at(const fracas_ordinate *ordinate, const fracas_point_statistics *point,
                          double *low, double *high)
{
    int64_t whole;
    double value = real_at(point, ordinate->value);
    memcpy(&whole, (const char *)point + ordinate->value, sizeof whole);
    if (ordinate->whole) value = (double)whole;
    *low = real_at(point, ordinate->low);
    *high = real_at(point, ordinate->high);
    if (ordinate->half_width == SIZE_MAX) return value;
    *low = value - real_at(point, ordinate->half_width);
    *high = value + real_at(point, ordinate->half_width);
    return value;
}

/* ---- finding ---- */

/* "number of fragments", of "number of fragments (...); ...". */
static void take_words(const char *doc, fracas_ordinate *to)
{
    FRACAS_PRINT(to->words, "%.*s", (int)strcspn(doc, "(;"), doc);
    for (char *end = to->words + strlen(to->words); end > to->words && end[-1] == ' ';)
        *--end = '\0';
}

fracas_ordinate fracas_ordinate_of(const fracas_number *number)
{
    fracas_ordinate of = {.over = true,
                          .value = number->mean + offsetof(fracas_estimate, mean),
                          .half_width = number->mean + offsetof(fracas_estimate, half_width),
                          .low = SIZE_MAX,
                          .high = SIZE_MAX};
    FRACAS_PRINT(of.key, "%s", number->key);
    FRACAS_PRINT(of.unit, "%s", number->unit);
    take_words(number->words ? number->words : number->doc, &of);
    return of;
}

typedef struct {
    const char *key; /* not ended: of `length` characters */
    size_t length;
    fracas_ordinate *to;
} wanted_key;

/* Takes the leaf KEY, KEY.mean or KEY.value; the ends of its interval, KEY.half_width or KEY.low
 * and KEY.high, come behind it. */
static void take_leaf(void *context, const fracas_field *leaf)
{
    const wanted_key *wanted = context;
    fracas_ordinate *to = wanted->to;
    const bool whole = leaf->type == FRACAS_FIELD_INTEGER;
    if (strncmp(leaf->key, wanted->key, wanted->length) != 0) return;
    const char *part = leaf->key + wanted->length;
    if (leaf->type != FRACAS_FIELD_NUMBER && !whole) return;
    if (!*part || !strcmp(part, ".mean") || !strcmp(part, ".value")) {
        if (to->value != SIZE_MAX) return;
        to->value = leaf->offset;
        to->whole = whole;
        FRACAS_PRINT(to->unit, "%s", leaf->unit);
        take_words(leaf->doc, to);
    } else if (to->value == SIZE_MAX) return;
    else if (!strcmp(part, ".half_width")) to->half_width = leaf->offset;
    else if (!strcmp(part, ".low")) to->low = leaf->offset;
    else if (!strcmp(part, ".high")) to->high = leaf->offset;
}

static bool find_as(const char *key, size_t length, fracas_ordinate *to)
{
    for (size_t i = 0; i < FRACAS_NNUMBERS; i++) {
        const fracas_number *number = &fracas_realization_numbers[i];
        if (strlen(number->key) != length || strncmp(number->key, key, length) != 0) continue;
        *to = fracas_ordinate_of(number);
        return true;
    }
    *to = (fracas_ordinate){
        .value = SIZE_MAX, .half_width = SIZE_MAX, .low = SIZE_MAX, .high = SIZE_MAX};
    FRACAS_PRINT(to->key, "%.*s", (int)length, key);
    wanted_key wanted = {key, length, to};
    fracas_fields_walk(&fracas_statistics, ".", take_leaf, &wanted);
    return to->value != SIZE_MAX;
}

bool fracas_ordinate_find(const char *key, size_t length, fracas_ordinate *to)
{
    static const char *const ends[] = {".mean", ".value"};
    if (length >= sizeof to->key) return false;
    for (size_t i = 0; i < 2; i++) {
        const size_t end = strlen(ends[i]);
        if (length > end && !strncmp(key + length - end, ends[i], end) &&
            find_as(key, length - end, to))
            return true;
    }
    return find_as(key, length, to);
}

static fracas_err take_key(const char *list, const char *key, size_t length, fracas_ordinate *to)
{
    const int shown = (int)length;
    if (length == 0)
        return fracas_fail(FRACAS_USAGE,
                           "y of the figures, `%s`: an empty name; give statistics as "
                           "aspect,onset_time",
                           list);
    if (!fracas_ordinate_find(key, length, to))
        return fracas_fail(FRACAS_USAGE,
                           "y of the figures, `%s`: `%.*s` is no statistic; summary.json has them, "
                           "as dissipated, aspect or fragment.mass_mean",
                           list, shown, key);
    if (!strcmp(to->key, "count") || !strcmp(to->key, "size"))
        return fracas_fail(FRACAS_USAGE,
                           "y of the figures, `%s`: every report draws `%s`; leave it out", list,
                           to->key);
    return FRACAS_OK;
}

fracas_err fracas_analysis_check_ordinates(const char *list)
{
    fracas_ordinate found[FRACAS_MOST_ORDINATES];
    size_t count;
    return list ? fracas_ordinates_find(NULL, list, found, &count) : FRACAS_OK;
}

bool fracas_analysis_is_statistic(const char *key)
{
    fracas_ordinate found;
    return fracas_ordinate_find(key, strlen(key), &found);
}

fracas_err fracas_ordinates_find(const fracas_analysis *analysis, const char *list,
                                 fracas_ordinate found[FRACAS_MOST_ORDINATES], size_t *count)
{
    *count = 0;
    for (size_t i = 0; i < FRACAS_NNUMBERS && !list; i++) {
        const fracas_number *number = &fracas_realization_numbers[i];
        if (number->drawn &&
            fracas_number_above_0(number, analysis->point, analysis->table->npoints) &&
            *count < FRACAS_MOST_ORDINATES)
            found[(*count)++] = fracas_ordinate_of(number);
    }
    for (const char *key = list; key;) {
        const size_t length = strcspn(key, ",");
        if (*count == FRACAS_MOST_ORDINATES)
            return fracas_fail(FRACAS_USAGE, "y of the figures, `%s`: at most %d statistics", list,
                               FRACAS_MOST_ORDINATES);
        TRY(take_key(list, key, length, &found[*count]));
        ++*count;
        key = key[length] ? key + length + 1 : NULL;
    }
    return FRACAS_OK;
}
