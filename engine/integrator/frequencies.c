/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/frequencies.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WRITTEN = 1000 }; /* pairs: Linux allows 128 KiB in a variable of the environment */

typedef struct {
    fracas_hash body;
    fracas_frequency_pair pair;
} kept;

struct fracas_frequencies {
    size_t count, room;
    kept *entry;
};

/* "<32 digits of the hash>:<whole>:<pressed>,", the frequencies in hexadecimal, so to the last bit.
 */
enum { TEXT = 33 + 2 * 32 };

fracas_err fracas_frequencies_create(fracas_frequencies **frequencies)
{
    *frequencies = calloc(1, sizeof **frequencies);
    return *frequencies ? FRACAS_OK : fracas_no_memory("the critical time steps");
}

void fracas_frequencies_destroy(fracas_frequencies *frequencies)
{
    if (!frequencies) return;
    free(frequencies->entry);
    free(frequencies);
}

bool fracas_frequencies_find(const fracas_frequencies *frequencies, const fracas_hash *body,
                             fracas_frequency_pair *pair)
{
    for (size_t i = 0; i < frequencies->count; i++) {
        if (!fracas_hash_equal(&frequencies->entry[i].body, body)) continue;
        *pair = frequencies->entry[i].pair;
        return true;
    }
    return false;
}

fracas_err fracas_frequencies_keep(fracas_frequencies *frequencies, const fracas_hash *body,
                                   const fracas_frequency_pair *pair)
{
    if (frequencies->count == frequencies->room) {
        const size_t room = 2 * frequencies->room + 8;
        kept *entry = realloc(frequencies->entry, room * sizeof *entry);
        if (!entry) return fracas_no_memory("the critical time steps");
        frequencies->entry = entry;
        frequencies->room = room;
    }
    frequencies->entry[frequencies->count++] = (kept){*body, *pair};
    return FRACAS_OK;
}

char *fracas_frequencies_write(const fracas_frequencies *frequencies)
{
    const size_t count = frequencies->count < WRITTEN ? frequencies->count : WRITTEN;
    char *text = malloc(count * TEXT + 1), *end = text;
    if (!text) return NULL;
    *end = '\0';
    for (size_t i = 0; i < count; i++) {
        const kept *entry = &frequencies->entry[i];
        end += sprintf(end, "%s:%a:%a,", fracas_hash_hex(&entry->body).text, entry->pair.whole,
                       entry->pair.pressed);
    }
    return text;
}

static bool is_frequency(double omega)
{
    return omega > 0 && isfinite(omega);
}

fracas_err fracas_frequencies_read(fracas_frequencies *frequencies, const char *text)
{
    while (*text) {
        char hex[FRACAS_HASH_HEX];
        fracas_hash body;
        fracas_frequency_pair pair;
        int length = 0;
        if (sscanf(text, "%32[0-9a-f]:%la:%la,%n", hex, &pair.whole, &pair.pressed, &length) != 3 ||
            length == 0 || !fracas_hash_parse(hex, &body) || !is_frequency(pair.whole) ||
            !is_frequency(pair.pressed))
            return FRACAS_OK;
        TRY(fracas_frequencies_keep(frequencies, &body, &pair));
        text += length;
    }
    return FRACAS_OK;
}
