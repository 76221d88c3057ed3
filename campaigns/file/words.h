/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Hints after an unknown word: the known words and the nearest one. */
#ifndef FRACAS_CAMPAIGNS_FILE_WORDS_H
#define FRACAS_CAMPAIGNS_FILE_WORDS_H

#include <stddef.h>

/* A list of words, "a, b, c", as far as there is room. */
typedef struct {
    const char *found;
    const char *nearest; /* to `found`; NULL: none is near */
    size_t distance;
    size_t used;
    char list[400];
} fracas_words;

void fracas_words_init(fracas_words *words, const char *found);
void fracas_words_add(fracas_words *words, const char *word);
/* "; did you mean `nearest`? LABEL: a, b, c", without the question if nothing is near. */
const char *fracas_words_hint(const fracas_words *words, const char *label, char text[600]);

/* Number of inserted, deleted, replaced letters and swapped neighbours between two words. */
size_t fracas_word_distance(const char *a, const char *b);

#endif
