/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/hash.h"

#include <string.h>
#include <xxhash.h>

fracas_hash fracas_hash_of(const void *bytes, size_t size)
{
    fracas_hash hash;
    XXH128_canonical_t canonical;
    XXH128_canonicalFromHash(&canonical, XXH3_128bits(bytes, size));
    memcpy(hash.byte, canonical.digest, sizeof hash.byte);
    return hash;
}

uint64_t fracas_checksum_of(const void *bytes, size_t size)
{
    return XXH3_64bits(bytes, size);
}

/* XXH3_state_t under our name. */
fracas_err fracas_checksum_create(fracas_checksum **checksum)
{
    XXH3_state_t *state = XXH3_createState();
    if (!state) return fracas_no_memory("a checksum");
    XXH3_64bits_reset(state); /* fails only without a state */
    *checksum = (fracas_checksum *)state;
    return FRACAS_OK;
}

void fracas_checksum_add(fracas_checksum *checksum, const void *bytes, size_t size)
{
    XXH3_64bits_update((XXH3_state_t *)checksum, bytes, size);
}

uint64_t fracas_checksum_end(const fracas_checksum *checksum)
{
    return XXH3_64bits_digest((const XXH3_state_t *)checksum);
}

void fracas_checksum_destroy(fracas_checksum *checksum)
{
    XXH3_freeState((XXH3_state_t *)checksum);
}

bool fracas_hash_equal(const fracas_hash *a, const fracas_hash *b)
{
    return memcmp(a->byte, b->byte, sizeof a->byte) == 0;
}

void fracas_hash_words(const fracas_hash *hash, uint64_t word[2])
{
    for (int w = 0; w < 2; w++) {
        word[w] = 0;
        for (int i = 0; i < 8; i++) word[w] = word[w] << 8 | hash->byte[8 * w + i];
    }
}

fracas_hash_text fracas_hash_hex(const fracas_hash *hash)
{
    fracas_hash_text hex;
    static const char digit[] = "0123456789abcdef";
    for (int i = 0; i < 16; i++) {
        hex.text[2 * i] = digit[hash->byte[i] >> 4];
        hex.text[2 * i + 1] = digit[hash->byte[i] & 15];
    }
    hex.text[32] = '\0';
    return hex;
}

bool fracas_hash_parse(const char *text, fracas_hash *hash)
{
    if (strlen(text) != 32) return false;
    for (int i = 0; i < 32; i++) {
        const char *digits = "0123456789abcdef", *at = strchr(digits, text[i]);
        if (!at) return false;
        int value = (int)(at - digits);
        hash->byte[i / 2] = (uint8_t)(i % 2 ? hash->byte[i / 2] | value : value << 4);
    }
    return true;
}
