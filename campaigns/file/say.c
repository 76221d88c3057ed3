/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/say.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fracas_err fracas_say(const char *name, const fracas_node *at, const char *format, ...)
{
    char what[1024];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    return fracas_fail(FRACAS_USAGE, "%s:%d:%d: %s", name, at->line, at->column, what);
}

fracas_err fracas_say_within(const char *name, const fracas_node *at, const char *key)
{
    return fracas_fail_within(FRACAS_USAGE, "%s:%d:%d: `%s`", name, at->line, at->column, key);
}

const char *fracas_say_found(const fracas_node *node, char text[256])
{
    switch (node->type) {
    case FRACAS_LIST: return "a list";
    case FRACAS_MAP: return "a section";
    case FRACAS_SCALAR: break;
    }
    if (!*node->text) return "nothing";
    snprintf(text, 256, "`%s`", node->text);
    return text;
}

void fracas_words_init(fracas_words *words, const char *found)
{
    *words = (fracas_words){.found = found};
}

void fracas_words_add(fracas_words *words, const char *word)
{
    size_t distance = fracas_word_distance(words->found, word);
    if (distance <= 1 + strlen(word) / 4 && distance < strlen(word) &&
        (!words->nearest || distance < words->distance)) {
        words->nearest = word;
        words->distance = distance;
    }
    int added = snprintf(words->list + words->used, sizeof words->list - words->used, "%s%s",
                         words->used ? ", " : "", word);
    if (added > 0 && words->used + (size_t)added < sizeof words->list) words->used += (size_t)added;
    else words->list[words->used] = '\0';
}

const char *fracas_words_hint(const fracas_words *words, const char *label, char text[600])
{
    if (words->nearest)
        snprintf(text, 600, "; did you mean `%s`? %s: %s", words->nearest, label, words->list);
    else snprintf(text, 600, "; %s: %s", label, words->list);
    return text;
}

enum { LONGEST = 64 };

size_t fracas_word_distance(const char *a, const char *b)
{
    size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST || nb > LONGEST) return na > nb ? na : nb;
    size_t row[3][LONGEST + 1]; /* of the table of distances between beginnings, for i-2, i-1 and i
                                   letters of a */
    for (size_t j = 0; j <= nb; j++) row[0][j] = j;
    for (size_t i = 1; i <= na; i++) {
        size_t *now = row[i % 3];
        const size_t *last = row[(i + 2) % 3], *before = row[(i + 1) % 3];
        now[0] = i;
        for (size_t j = 1; j <= nb; j++) {
            size_t least = last[j - 1] + (a[i - 1] != b[j - 1]);
            if (last[j] + 1 < least) least = last[j] + 1;
            if (now[j - 1] + 1 < least) least = now[j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                before[j - 2] + 1 < least)
                least = before[j - 2] + 1;
            now[j] = least;
        }
    }
    return row[na % 3][nb];
}

fracas_err fracas_say_unknown(const char *name, const fracas_node *map, const char *const *keys,
                              const char *what)
{
    for (const fracas_node *entry = map->first; entry; entry = entry->next) {
        fracas_words words;
        fracas_words_init(&words, entry->key->text);
        bool known = false;
        for (const char *const *key = keys; *key; key++) {
            fracas_words_add(&words, *key);
            known = known || strcmp(*key, entry->key->text) == 0;
        }
        char hint[600], label[80];
        snprintf(label, sizeof label, "keys of %s", what);
        if (!known)
            return fracas_say(name, entry->key, "unknown key `%s` in %s%s", entry->key->text, what,
                              fracas_words_hint(&words, label, hint));
    }
    return FRACAS_OK;
}
