/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/cpu.h"

#include "base/own.h"

#include <stdio.h>
#include <string.h>

void fracas_cpu_name(char *name, size_t size)
{
    snprintf(name, size, "unknown");
    OWN(FILE) file = fopen("/proc/cpuinfo", "r");
    char line[256];
    while (file && fgets(line, sizeof line, file)) {
        const char *value = strchr(line, ':');
        if (strncmp(line, "model name", 10) || !value) continue;
        line[strcspn(line, "\n")] = '\0';
        snprintf(name, size, "%s", value + 1 + strspn(value + 1, " "));
        return;
    }
}
