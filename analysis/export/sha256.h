/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SHA-256 and base64 by libcrypto: the digest of files in data packages, as sha256sum has it, and
 * of the script of a page; the data of a film. */
#ifndef FRACAS_ANALYSIS_EXPORT_SHA256_H
#define FRACAS_ANALYSIS_EXPORT_SHA256_H

#include "base/err.h"

#include <stdint.h>
#include <stdio.h>

enum { FRACAS_SHA256_HEX = 65, FRACAS_SHA256_BASE64 = 45 }; /* characters and the end */

/* Digest and size of the file's bytes. FRACAS_ENVIRONMENT if it cannot be read, or without memory.
 */
FRACAS_MUST_USE fracas_err fracas_sha256_of_file(const char *path, char hex[FRACAS_SHA256_HEX],
                                                 uint64_t *bytes);
/* Digest of the text in base64. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sha256_of_text(const char *text,
                                                 char base64[FRACAS_SHA256_BASE64]);

/* Writes the bytes in base64, in one line without an end. */
void fracas_base64_write(const void *bytes, size_t size, FILE *out);

#endif
