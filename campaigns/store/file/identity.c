/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/identity.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

const char *const fracas_identity_name[FRACAS_IDENTITY_VALUES] = {"program_version", "seed",
                                                                  "history", "interfaces"};

void fracas_identity_of(const fracas_file_header *header, fracas_identity *identity)
{
    snprintf(identity->value[0], FRACAS_IDENTITY_TEXT, "%s", header->version);
    snprintf(identity->value[1], FRACAS_IDENTITY_TEXT, "%" PRIu64, header->seed);
    snprintf(identity->value[2], FRACAS_IDENTITY_TEXT, "%" PRId64, header->history);
    snprintf(identity->value[3], FRACAS_IDENTITY_TEXT, "%d", header->interfaces);
}

bool fracas_identity_differs(const fracas_identity *found, const fracas_identity *wanted,
                             char text[FRACAS_DIFFERENCE_TEXT])
{
    for (int v = 0; v < FRACAS_IDENTITY_VALUES; v++) {
        const char *a = found->value[v], *b = wanted->value[v];
        if (!*a || !*b || strcmp(a, b) == 0) continue;
        snprintf(text, FRACAS_DIFFERENCE_TEXT, "%s %s, not %s", fracas_identity_name[v], a, b);
        return true;
    }
    return false;
}
