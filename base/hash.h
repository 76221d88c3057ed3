/* SPDX-License-Identifier: GPL-3.0-or-later */
/* 128-bit names of things: XXH3 in its canonical (big-endian) form. */
#ifndef FRACAS_BASE_HASH_H
#define FRACAS_BASE_HASH_H

#include "base/err.h"
#include "base/own.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FRACAS_HASH_HEX 33 /* 32 digits and the end */

typedef struct {
    uint8_t byte[16];
} fracas_hash;

/* XXH3-128 of `size` bytes. */
fracas_hash fracas_hash_of(const void *bytes, size_t size);
/* XXH3-64 of `size` bytes: the checksum of a file's contents, for segments. */
uint64_t fracas_checksum_of(const void *bytes, size_t size);
/* The same for bytes in pieces. */
typedef struct fracas_checksum fracas_checksum;
FRACAS_MUST_USE fracas_err fracas_checksum_create(fracas_checksum **checksum);
void fracas_checksum_add(fracas_checksum *checksum, const void *bytes, size_t size);
uint64_t fracas_checksum_end(const fracas_checksum *checksum);
void fracas_checksum_destroy(fracas_checksum *checksum); /* NULL is allowed */
FRACAS_OWNER(fracas_checksum, fracas_checksum_destroy)

bool fracas_hash_equal(const fracas_hash *a, const fracas_hash *b);
/* word[0] = first eight bytes, word[1] = last eight, read as big-endian numbers. */
void fracas_hash_words(const fracas_hash *hash, uint64_t word[2]);
typedef struct {
    char text[FRACAS_HASH_HEX];
} fracas_hash_text;
/* 32 hexadecimal digits, for `fracas_hash_hex(&hash).text` within an expression. */
fracas_hash_text fracas_hash_hex(const fracas_hash *hash);
/* False when `text` is not 32 hexadecimal digits. */
bool fracas_hash_parse(const char *text, fracas_hash *hash);

#endif
