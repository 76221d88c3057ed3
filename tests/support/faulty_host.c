/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linked into the tests of the store and faulty/fracas (ld --wrap): FRACAS_TEST_HOST in the
 * environment stands in for the name of the host, and is then another kernel too. */
#include "campaigns/store/file/disk.h"

void __real_fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT]);
void __wrap_fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT]);

void __wrap_fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT])
{
    const char *asked = getenv("FRACAS_TEST_HOST");
    __real_fracas_disk_host(host, boot);
    if (!asked) return;
    snprintf(host, FRACAS_HOST_TEXT, "%s", asked);
    snprintf(boot, FRACAS_BOOT_TEXT, "%s", asked);
}
