/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/export/sha256.h"

#include "base/file.h"

#include <errno.h>
#include <openssl/evp.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { BLOCK = 1 << 16, DIGEST = (FRACAS_SHA256_HEX - 1) / 2 };

/* Takes in the file; `reason`: why it cannot be read, as errno has it. False without memory, which
 * is the one way libcrypto has to fail here. */
static bool digest(FILE *file, EVP_MD_CTX *context, unsigned char result[DIGEST], uint64_t *bytes,
                   int *reason)
{
    unsigned char block[BLOCK];
    size_t got;
    bool good = context && EVP_DigestInit_ex(context, EVP_sha256(), NULL);
    *bytes = 0;
    while (good && (got = fread(block, 1, BLOCK, file)) > 0) {
        good = EVP_DigestUpdate(context, block, got);
        *bytes += got;
    }
    *reason = ferror(file) ? errno : 0;
    return good && EVP_DigestFinal_ex(context, result, NULL);
}

fracas_err fracas_sha256_of_file(const char *path, char hex[FRACAS_SHA256_HEX], uint64_t *bytes)
{
    unsigned char result[DIGEST];
    int reason;
    FILE *file = fracas_file_stream(fracas_file_open(path), "r");
    if (!file) return fracas_fail_system(errno, "cannot read %s", path);
    EVP_MD_CTX *context = EVP_MD_CTX_new();
    const bool good = digest(file, context, result, bytes, &reason);
    EVP_MD_CTX_free(context);
    fclose(file);
    if (reason) return fracas_fail_system(reason, "cannot read %s", path);
    if (!good) return fracas_no_memory("a digest");
    for (int i = 0; i < DIGEST; i++) snprintf(hex + 2 * i, 3, "%02x", result[i]);
    return FRACAS_OK;
}

fracas_err fracas_sha256_of_text(const char *text, char base64[FRACAS_SHA256_BASE64])
{
    unsigned char result[DIGEST];
    if (!EVP_Digest(text, strlen(text), result, NULL, EVP_sha256(), NULL))
        return fracas_no_memory("a digest");
    EVP_EncodeBlock((unsigned char *)base64, result, DIGEST);
    return FRACAS_OK;
}

void fracas_base64_write(const void *bytes, size_t size, FILE *out)
{
    enum { PIECE = 3 * 1024 }; /* whole groups of three: no padding but at the end */
    unsigned char text[PIECE / 3 * 4 + 1];
    for (size_t at = 0; at < size; at += PIECE) {
        const size_t n = size - at < PIECE ? size - at : PIECE;
        EVP_EncodeBlock(text, (const unsigned char *)bytes + at, (int)n);
        fputs((const char *)text, out);
    }
}
