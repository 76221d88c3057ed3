/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/foreign.h"

#include "analysis/data/output.h"
#include "base/file.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

static fracas_err add(fracas_foreign *names, const char *name, size_t size)
{
    TRY(fracas_grow(&names->name, sizeof *names->name, names->count, &names->room,
                    "the files of a report"));
    if (!(names->name[names->count] = strndup(name, size)))
        return fracas_no_memory("the files of a report");
    names->count++;
    return FRACAS_OK;
}

static void sort(fracas_foreign *names)
{
    if (names->count) qsort(names->name, names->count, sizeof *names->name, by_name);
}

void fracas_foreign_clear(fracas_foreign *foreign)
{
    for (size_t i = 0; i < foreign->count; i++) free(foreign->name[i]);
    free(foreign->name);
    *foreign = (fracas_foreign){0};
}

bool fracas_foreign_has(const fracas_foreign *foreign, const char *name)
{
    return foreign && foreign->count &&
           bsearch(&name, foreign->name, foreign->count, sizeof *foreign->name, by_name);
}

/* The targets of the page's links, and the page. */
static fracas_err read_page(const char *folder, fracas_foreign *named)
{
    static const char link[] = "href=\"";
    OWNED char *path = NULL;
    OWNED char *line = NULL;
    size_t room = 0;
    TRY(add(named, FRACAS_OUTPUT_PAGE, strlen(FRACAS_OUTPUT_PAGE)));
    TRY(fracas_path(&path, "%s/" FRACAS_OUTPUT_PAGE, folder));
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "r");
    while (in && getline(&line, &room, in) >= 0)
        for (const char *at = line; (at = strstr(at, link));) {
            at += strlen(link);
            TRY(add(named, at, strcspn(at, "\"")));
        }
    sort(named);
    return FRACAS_OK;
}

fracas_err fracas_foreign_find(const char *folder, fracas_foreign *foreign)
{
    FRACAS_CLEARED(fracas_foreign) named = {0};
    const bool page = fracas_output_has_page(folder);
    fracas_err err = FRACAS_OK;
    if (page) TRY(read_page(folder, &named));
    else if (fracas_output_is_ours(folder)) return FRACAS_OK;
    DIR *found = opendir(folder);
    for (const struct dirent *entry; found && !err && (entry = readdir(found));)
        if (*entry->d_name != '.' && !fracas_foreign_has(&named, entry->d_name))
            err = add(foreign, entry->d_name, strlen(entry->d_name));
    if (found) closedir(found);
    sort(foreign);
    return err;
}

fracas_err fracas_foreign_aside(const fracas_foreign *foreign, const char *folder, const char *name)
{
    OWNED char *path = NULL;
    OWNED char *aside = NULL;
    if (!fracas_foreign_has(foreign, name)) return FRACAS_OK;
    TRY(fracas_path(&path, "%s/%s", folder, name));
    TRY(fracas_file_set_aside(path, &aside));
    if (aside) fprintf(stderr, "fracas: %s was of no report; it is %s now\n", path, aside);
    return FRACAS_OK;
}
