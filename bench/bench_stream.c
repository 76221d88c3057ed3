/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Random bits of fracas for a battery of tests: the 52 bits of each word that become a number,
 * without gaps, without end.
 *
 *   bench_stream [one|neighbours] [SEED] | dieharder -a -g 200
 *
 * one          one stream: sites 0, 1, 2, ... of a replica
 * neighbours   16 streams whose names differ by 1 or by one bit, in turn: their words of site 0, of
 * site 1, ... */
#include "sampler/stream.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STREAMS = 16, WORDS = 13, GROUP = 8 }; /* 8 numbers of 52 bits are 13 words of 32 */

static const fracas_stream named = {
    1, FRACAS_PURPOSE_STRENGTH, {0x243f6a8885a308d3, 0x13198a2e03707344}, 0};

/* Added to the name of a stream, and to the site. */
static const struct {
    fracas_stream name;
    uint64_t site;
} differences[STREAMS] = {
    {.site = 0},
    {.name.replica = 1},
    {.name.replica = 2},
    {.name.replica = 3},
    {.name.replica = (uint64_t)1 << 32},
    {.name.seed = 1},
    {.name.seed = 2},
    {.name.seed = (uint64_t)1 << 63},
    {.name.point[0] = 1},
    {.name.point[0] = (uint64_t)1 << 63},
    {.name.point[1] = 1},
    {.name.point[1] = (uint64_t)1 << 63},
    {.name.purpose = FRACAS_PURPOSE_MESH - FRACAS_PURPOSE_STRENGTH},
    {.name.purpose = FRACAS_PURPOSE_DESIGN - FRACAS_PURPOSE_STRENGTH},
    {.site = (uint64_t)1 << 48},
    {.site = (uint64_t)2 << 48},
};

static uint64_t bits_of(size_t s, uint64_t seed, uint64_t site)
{
    const fracas_stream *more = &differences[s].name;
    const fracas_stream stream = {
        seed + more->seed,
        named.purpose + more->purpose,
        {named.point[0] + more->point[0], named.point[1] + more->point[1]},
        named.replica + more->replica};
    return (uint64_t)(fracas_stream_uniform(&stream, site + differences[s].site) *
                      0x1p52); /* the half is cut off */
}

/* The words of 8 numbers, each from its lowest bit. */
static void pack(const uint64_t number[GROUP], uint32_t word[WORDS])
{
    unsigned __int128 waiting = 0;
    unsigned bits = 0, w = 0;
    for (unsigned i = 0; i < GROUP; i++) {
        waiting |= (unsigned __int128)number[i] << bits;
        for (bits += 52; bits >= 32; bits -= 32, waiting >>= 32) word[w++] = (uint32_t)waiting;
    }
}

int main(int argc, char **argv)
{
    const bool neighbours = argc > 1 && strcmp(argv[1], "neighbours") == 0;
    if (argc < 2 || argc > 3 || (!neighbours && strcmp(argv[1], "one") != 0)) {
        fprintf(stderr, "usage: bench_stream one|neighbours [SEED]\n");
        return 1;
    }
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : named.seed,
                   streams = neighbours ? STREAMS : 1;
    uint64_t number[GROUP];
    uint32_t word[WORDS];
    for (uint64_t n = 0;; n += GROUP) {
        for (uint64_t i = n; i < n + GROUP; i++)
            number[i - n] = bits_of((size_t)(i % streams), seed, i / streams);
        pack(number, word);
        if (fwrite(word, sizeof *word, WORDS, stdout) != WORDS)
            return 0; /* whoever reads has enough */
    }
}
