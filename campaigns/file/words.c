/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/words.h"

#include "base/param.h"
#include "campaigns/file/absent.list.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST = 96 };

/* Number of inserted, deleted, replaced letters and swapped neighbours between two words, of which
 * `b`, a known one, has at most LONGEST letters. */
static size_t distance_of(const char *a, const char *b)
{
    size_t na = strlen(a), nb = strlen(b);
    if (na > LONGEST) return na;
    /* Rows i-2, i-1 and i of the table of distances between beginnings of i and j letters. */
    size_t row[3][LONGEST + 1];
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

/* Names of the keys in other programs and papers. */
static const struct {
    const char *found, *word;
} other_names[] = {{"E", "young"},
                   {"Young", "young"},
                   {"modulus", "young"},
                   {"modulus", "shape"},
                   {"weibull_modulus", "shape"},
                   {"nu", "poisson"},
                   {"rho", "density"},
                   {"G_c", "fracture_energy"},
                   {"Gc", "fracture_energy"},
                   {"strain_rate", "rate"},
                   {"rod", "bar"}};

static bool is_other_name(const char *found, const char *word)
{
    for (size_t i = 0; i < FRACAS_COUNT(other_names); i++)
        if (!strcmp(other_names[i].found, found) && !strcmp(other_names[i].word, word)) return true;
    return false;
}

/* The first load has no number, later ones have. */
static size_t distance_of_load(const char *found, const char *word)
{
    static const char first[] = "loading_1", section[] = "loading";
    const size_t size = strlen(first);
    const char end = strncmp(found, first, size) ? ' ' : found[size];
    if ((end && end != '.') || strncmp(word, section, strlen(section)) != 0) return SIZE_MAX;
    return distance_of(found + size, word + strlen(section));
}

static size_t distance_to(const char *found, const char *word)
{
    const size_t as_load = distance_of_load(found, word), as_read = distance_of(found, word);
    if (is_other_name(found, word)) return 0;
    return as_load < as_read ? as_load : as_read;
}

/* True if the list has the word: two shapes may have a key of one name. */
static bool is_listed(const fracas_words *words, const char *word)
{
    const size_t size = strlen(word);
    for (const char *at = words->list; words->used && (at = strstr(at, word)) && size; at += size)
        if ((at == words->list || at[-1] == ' ') && (at[size] == ',' || at[size] == '\0'))
            return true;
    return false;
}

void fracas_words_init(fracas_words *words, const char *found)
{
    *words = (fracas_words){.found = found};
}

void fracas_words_add(fracas_words *words, const char *word)
{
    const size_t distance = distance_to(words->found, word);
    if (distance <= 1 + strlen(word) / 4 && distance < strlen(word) &&
        (!words->nearest || distance < words->distance)) {
        words->nearest = word;
        words->distance = distance;
    }
    if (is_listed(words, word)) return;
    int added = snprintf(words->list + words->used, sizeof words->list - words->used, "%s%s",
                         words->used ? ", " : "", word);
    if (words->used + (size_t)added < sizeof words->list) words->used += (size_t)added;
    else words->list[words->used] = '\0';
}

#define ABSENT(words, sentence) {" " words " ", sentence},
static const struct {
    const char *words, *sentence;
} absent[] = {FRACAS_ABSENT(ABSENT)};

/* The sentence about a name in absent.list.h; NULL: it has none. */
static const char *sentence_about(const char *found)
{
    char word[LONGEST + 3] = " ";
    size_t used = 1;
    for (; found[used - 1] && used <= LONGEST; used++)
        word[used] = found[used - 1] == '-' ? '_' : (char)tolower((unsigned char)found[used - 1]);
    if (used == 1 || found[used - 1] || strchr(found, ' ')) return NULL;
    strcpy(word + used, " ");
    for (size_t i = 0; i < FRACAS_COUNT(absent); i++)
        if (strstr(absent[i].words, word)) return absent[i].sentence;
    return NULL;
}

const char *fracas_words_hint(fracas_words *words, const char *label, ...)
{
    char named[80];
    va_list arguments;
    va_start(arguments, label);
    vsnprintf(named, sizeof named, label, arguments);
    va_end(arguments);
    const char *not_there = sentence_about(words->found);
    const bool near = words->nearest && !not_there;
    snprintf(words->hint, sizeof words->hint, "; %s%s%s%s%s%s: %s", near ? "did you mean `" : "",
             near ? words->nearest : "", near ? "`? " : "", not_there ? not_there : "",
             not_there ? " (docs/limits.md). " : "", named, words->list);
    return words->hint;
}
