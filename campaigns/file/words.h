/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hints after an unknown word: the known words and the nearest one. */
#ifndef FRACAS_CAMPAIGNS_FILE_WORDS_H
#define FRACAS_CAMPAIGNS_FILE_WORDS_H

#include "base/err.h"

/* A list of words, "a, b, c", as far as there is room. */
typedef struct {
    const char *found;
    const char *nearest; /* to `found`; NULL: none is near */
    size_t distance;
    size_t used;
    char list[400];
    char hint[800];
} fracas_words;

void fracas_words_init(fracas_words *words, const char *found);
void fracas_words_add(fracas_words *words, const char *word);
/* "; did you mean `nearest`? LABEL: a, b, c", without the question if nothing is near; the label as
 * printf writes it. A name in absent.list.h gets its sentence instead. */
const char *fracas_words_hint(fracas_words *words, const char *label, ...) FRACAS_PRINTF(2, 3);

#endif
