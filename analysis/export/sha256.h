/* SPDX-License-Identifier: GPL-3.0-or-later */
/* SHA-256 of a file, by libcrypto: the digest in data packages, and of sha256sum. */
#ifndef FRACAS_ANALYSIS_EXPORT_SHA256_H
#define FRACAS_ANALYSIS_EXPORT_SHA256_H

#include "base/err.h"

#include <stdint.h>

enum { FRACAS_SHA256_HEX = 65 }; /* 64 digits and the end */

/* Digest and size of the file's bytes. FRACAS_ENVIRONMENT if it cannot be read, or without memory.
 */
FRACAS_MUST_USE fracas_err fracas_sha256_of_file(const char *path, char hex[FRACAS_SHA256_HEX],
                                                 uint64_t *bytes);

#endif
