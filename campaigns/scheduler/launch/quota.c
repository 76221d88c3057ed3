/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/quota.h"

#include "base/err.h"
#include "base/own.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* *text: the first line of the file; false: there is none. */
static bool first_line(const char *folder, const char *name, char *text, size_t size)
{
    OWNED char *path = NULL;
    if (fracas_path(&path, "%s/%s", folder, name)) return false;
    OWN(FILE) in = fopen(path, "re");
    return in && fgets(text, (int)size, in);
}

static double share(double quota, double period)
{
    return quota > 0 && period > 0 ? quota / period : INFINITY;
}

/* The quota of one group, of either version [cores]. */
static double quota_of(const char *group)
{
    char quota[64], period[64];
    double q, p;
    if (first_line(group, "cpu.max", quota, sizeof quota))
        return sscanf(quota, "%lf %lf", &q, &p) == 2 ? share(q, p) : INFINITY; /* or "max 100000" */
    if (first_line(group, "cpu.cfs_quota_us", quota, sizeof quota) &&
        first_line(group, "cpu.cfs_period_us", period, sizeof period))
        return share(strtod(quota, NULL), strtod(period, NULL)); /* or -1 */
    return INFINITY;
}

/* The least quota of group `path` below `mount`/`controllers` and of all groups above it. A
 * container may name the host's path and mount its own group as the root: the walk ends there. */
static double least_above(const char *mount, const char *controllers, const char *path)
{
    double least = INFINITY;
    OWNED char *group = NULL;
    if (fracas_path(&group, "%s/%s%s", mount, controllers, path)) return least;
    const size_t root = strlen(mount) + 1 + strlen(controllers);
    for (;;) {
        least = fmin(least, quota_of(group));
        char *slash = strrchr(group, '/');
        if (!slash || (size_t)(slash - group) < root) return least;
        *slash = '\0';
    }
}

static bool has_cpu(const char *controllers)
{
    for (const char *at = controllers; *at;) {
        const size_t length = strcspn(at, ",");
        if (length == strlen("cpu") && !strncmp(at, "cpu", length)) return true;
        at += length + (at[length] == ',');
    }
    return false;
}

/* `line` is "ID:CONTROLLERS:PATH"; version 2 has no controllers there. */
static double least_of(char *line, const char *mount)
{
    line[strcspn(line, "\n")] = '\0';
    char *controllers = strchr(line, ':'),
         *path = controllers ? strchr(controllers + 1, ':') : NULL;
    if (!path) return INFINITY;
    controllers++;
    *path++ = '\0';
    if (!*controllers) /* alone, or beside version 1 */
        return fmin(least_above(mount, "", path), least_above(mount, "unified", path));
    if (!has_cpu(controllers)) return INFINITY;
    return fmin(least_above(mount, controllers, path), least_above(mount, "cpu", path));
}

double fracas_quota_cores(const char *groups, const char *mount)
{
    OWN(FILE) in = fopen(groups, "re");
    OWNED char *line = NULL;
    size_t room = 0;
    double least = INFINITY;
    while (in && getline(&line, &room, in) > 0) least = fmin(least, least_of(line, mount));
    return least;
}
