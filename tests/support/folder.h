/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A folder of a test program's own, made before its tests and removed after them: group fixtures of
 * cmocka. Define FOLDER, its name before the random part, first. */
#ifndef FRACAS_TESTS_SUPPORT_FOLDER_H
#define FRACAS_TESTS_SUPPORT_FOLDER_H

#include "tests/support/test.h"

static char folder[] = "/tmp/" FOLDER "-XXXXXX";

static inline int make_folder(void **state)
{
    return mkdtemp(folder) ? 0 : -1;
}

static inline int remove_folder(void **state)
{
    char command[100];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return system(command);
}

#endif
