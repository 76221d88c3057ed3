/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Identity of a study: values on which records depend beside their point and replica. The hash of a
 * point does not hold it, so files and the index are compared by it. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_IDENTITY_H
#define FRACAS_CAMPAIGNS_STORE_FILE_IDENTITY_H

#include "campaigns/store/store.h"

enum { FRACAS_IDENTITY_VALUES = 4, FRACAS_IDENTITY_TEXT = 32, FRACAS_DIFFERENCE_TEXT = 128 };

/* Names of the values, as attributes of the root group and as keys of `meta`. */
extern const char *const fracas_identity_name[FRACAS_IDENTITY_VALUES];

/* The values as text; "" where one is not known. */
typedef struct {
    char value[FRACAS_IDENTITY_VALUES][FRACAS_IDENTITY_TEXT];
} fracas_identity;

void fracas_identity_of(const fracas_file_header *header, fracas_identity *identity);
/* True if a value that both know differs; then *text is the first, "NAME FOUND, not WANTED". */
bool fracas_identity_differs(const fracas_identity *found, const fracas_identity *wanted,
                             char text[FRACAS_DIFFERENCE_TEXT]);

#endif
