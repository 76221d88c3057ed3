/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Names of physical groups, and the keys that they are. */
#include "engine/mesh/surface/gmsh_file.h"

#include "base/own.h"
#include "engine/spec.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool has_key(int32_t group)
{
    return group > 0 && group < FRACAS_EDGES;
}

enum { ALWAYS = 4 }; /* edge_1 to edge_4 have a value in every campaign, the further may have one */

int32_t fracas_gmsh_choose(int32_t a, int32_t b, unsigned *passed)
{
    const int32_t lesser = a < b ? a : b, other = a < b ? b : a;
    if (a == b || lesser <= 0) return other;
    if (other <= ALWAYS) return 0;
    if (has_key(other)) *passed |= 1u << other;
    return lesser;
}

int32_t fracas_gmsh_key_of(const fracas_surface_group *named, size_t count, int32_t group)
{
    const int32_t number = group < 0 && group > INT32_MIN ? -group : group;
    for (size_t g = 0; g < count; g++) {
        const char *name = named[g].name;
        if (named[g].number == number && !strncmp(name, "edge_", 5) && name[5] > '0' &&
            name[5] < '0' + FRACAS_EDGES && !name[6])
            return name[5] - '0';
    }
    return number;
}

bool fracas_gmsh_next_group(const char *text, size_t end, size_t *at, fracas_surface_group *group)
{
    while (*at < end) {
        char line[128];
        int32_t dimension;
        const char *stop = memchr(text + *at, '\n', end - *at);
        const size_t length = stop ? (size_t)(stop - text) - *at : end - *at;
        snprintf(line, sizeof line, "%.*s", (int)(length < sizeof line ? length : sizeof line),
                 text + *at);
        *at += length + 1;
        if (sscanf(line, "%" SCNd32 " %" SCNd32 " \"%63[^\"]", &dimension, &group->number,
                   group->name) == 3 &&
            dimension == 1)
            return true;
    }
    return false;
}

/* The section of names, outside of comments; NULL: there is none. */
static const char *find_names(const char *text, size_t size)
{
    static const char begin[] = "$PhysicalNames", comments[] = "$Comments", end[] = "$EndComments";
    const char *from = text;
    for (;; from++) {
        const size_t left = size - (size_t)(from - text);
        const char *names = memmem(from, left, begin, strlen(begin)),
                   *comment = memmem(from, left, comments, strlen(comments));
        if (!names) return NULL;
        const bool commented = comment && comment < names;
        if (!commented && (names == text || names[-1] == '\n')) return names;
        from = commented ? memmem(comment, size - (size_t)(comment - text), end, strlen(end))
                         : names;
        if (!from) return NULL;
    }
}

/* The lines of the section of names: *at, before *end. False: there is none, or it has no end,
 * which is an error of the mesh. */
static bool names_of(const char *text, size_t size, size_t *at, size_t *end)
{
    static const char last[] = "$EndPhysicalNames";
    const char *from = find_names(text, size);
    if (!from) return false;
    *at = (size_t)(from - text);
    const char *to = memmem(from, size - *at, last, strlen(last));
    *end = to ? (size_t)(to - text) : *at;
    return to;
}

bool fracas_gmsh_group_name(const char *text, size_t size, size_t i, char name[64])
{
    fracas_surface_group group;
    size_t at, end;
    if (!names_of(text, size, &at, &end)) return false;
    do
        if (!fracas_gmsh_next_group(text, end, &at, &group)) return false;
    while (i-- > 0);
    memcpy(name, group.name, sizeof group.name);
    return true;
}

fracas_err fracas_gmsh_group(const char *text, size_t size, const char *name, int32_t *number,
                             bool *shared)
{
    size_t at, end, count = 0;
    *number = 0;
    *shared = false;
    if (!names_of(text, size, &at, &end)) return FRACAS_OK;
    OWNED fracas_surface_group *group = malloc((end - at) / 6 * sizeof *group + sizeof *group);
    if (!group) return fracas_no_memory("the names of a mesh"); /* a line has 6 bytes at least */
    while (fracas_gmsh_next_group(text, end, &at, &group[count])) count++;
    int32_t own = 0;
    for (size_t g = 0; g < count; g++) {
        if (strcmp(group[g].name, name) != 0 || has_key(*number)) continue;
        own = group[g].number;
        *number = fracas_gmsh_key_of(group, count, own);
    }
    for (size_t g = 0; g < count; g++)
        *shared = *shared || (group[g].number != own &&
                              (fracas_gmsh_key_of(group, count, group[g].number) == *number ||
                               (has_key(group[g].number) && strcmp(group[g].name, name) == 0)));
    return FRACAS_OK;
}
