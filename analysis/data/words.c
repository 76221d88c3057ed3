/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/words.h"

static const struct {
    const char *path, *words;
} names[] = {
#define X(path, words) {path, words},
#include "analysis/data/words.list.h"
#undef X
};

static const char shape_path[] = "strength.shape", modulus_path[] = "derived.strength_modulus";

const char *fracas_words_of(const char *path)
{
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(names[i].path, path)) return names[i].words;
    return path;
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

const char *fracas_column_words(const fracas_point_table *table, size_t column)
{
    const char *path = table->column[column].path;
    if (!strcmp(path, shape_path) && is_modulus(table, column)) return "Weibull modulus";
    return fracas_words_of(path);
}
