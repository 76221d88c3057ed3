/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Messages about a campaign file: where, what was found, what is allowed, the nearest known word.
 */
#ifndef FRACAS_CAMPAIGNS_FILE_SAY_H
#define FRACAS_CAMPAIGNS_FILE_SAY_H

#include "campaigns/file/catalog.h"
#include "campaigns/file/node.h"

/* FRACAS_USAGE with "name:line:column: ..." of the node. */
FRACAS_MUST_USE fracas_err fracas_say(const char *name, const fracas_node *at, const char *format,
                                      ...) FRACAS_PRINTF(3, 4);

/* Puts "name:line:column: " and the key before the present message; returns FRACAS_USAGE. */
FRACAS_MUST_USE fracas_err fracas_say_within(const char *name, const fracas_node *at,
                                             const char *key);

/* "`text`" of a scalar, else "a list" or "a section": what was found. */
const char *fracas_say_found(const fracas_node *node, char text[256]);

/* A list of words, "a, b, c", as far as there is room, and the one nearest to the word that was
 * found. */
typedef struct {
    const char *found;
    const char *nearest; /* NULL: none is near */
    size_t distance;
    size_t used;
    char list[400];
} fracas_words;

void fracas_words_init(fracas_words *words, const char *found);
void fracas_words_add(fracas_words *words, const char *word);
/* "; did you mean `nearest`? LABEL: a, b, c", without the question if nothing is near. */
const char *fracas_words_hint(const fracas_words *words, const char *label, char text[600]);

/* FRACAS_USAGE at the first entry of `map` that is none of `keys`, up to a NULL; `what` is how
 * messages call the map, "a range". */
FRACAS_MUST_USE fracas_err fracas_say_unknown(const char *name, const fracas_node *map,
                                              const char *const *keys, const char *what);

/* Number of inserted, deleted, replaced letters and swapped neighbours that turn one word into the
 * other. */
size_t fracas_word_distance(const char *a, const char *b);

#endif
