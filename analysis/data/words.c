/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/words.h"

#include "analysis/data/text.h"

static const struct {
    const char *path, *words;
} names[] = {
#define X(path, words) {path, words},
#include "analysis/data/words.list.h"
#undef X
};

static const char shape_path[] = "strength.shape", modulus_path[] = "derived.strength_modulus";

static const char *listed(const char *path)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(names[i].path, path)) return names[i].words;
    return NULL;
}

fracas_parameter_words fracas_words_of(const char *path)
{
    fracas_parameter_words words = {""};
    const char *dot = strchr(path, '.'), *number = strchr(path, '_');
    const bool several = dot && number && number < dot;
    char first[96]; /* the path with the section's name alone */
    if (several) snprintf(first, sizeof first, "%.*s%s", (int)(number - path), path, dot);
    else snprintf(first, sizeof first, "%s", path);
    const char *found = listed(first);
    snprintf(words.text, sizeof words.text, "%.60s", found ? found : dot ? dot + 1 : path);
    for (char *c = words.text; !found && *c; c++)
        if (*c == '_') *c = ' ';
    if (several)
        fracas_append(words.text, sizeof words.text, "", " of %.*s %.*s", (int)(number - path),
                      path, (int)(dot - number - 1), number + 1);
    return words;
}

/* Whether every shape is the exponent of a law with a modulus. */
static bool is_modulus(const fracas_point_table *table, size_t shape)
{
    const size_t modulus = fracas_point_table_find(table, modulus_path);
    for (size_t p = 0; p < table->npoints && modulus != SIZE_MAX; p++)
        if (isfinite(table->point[p].value[shape].real) &&
            !isfinite(table->point[p].value[modulus].real))
            return false;
    return modulus != SIZE_MAX;
}

fracas_parameter_words fracas_column_words(const fracas_point_table *table, size_t column)
{
    const char *path = table->column[column].path;
    if (!strcmp(path, shape_path) && is_modulus(table, column))
        return (fracas_parameter_words){"Weibull modulus"};
    return fracas_words_of(path);
}
