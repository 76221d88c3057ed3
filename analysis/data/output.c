/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/output.h"

#include "base/file.h"
#include "base/own.h"

#include <dirent.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

fracas_err fracas_output_folder(const char *folder)
{
    struct stat what = {0};
    if (!mkdir(folder, 0777)) return FRACAS_OK;
    if (errno == EEXIST && (!stat(folder, &what) || errno == ENOENT || errno == ELOOP)) {
        if (S_ISDIR(what.st_mode)) return FRACAS_OK;
        return fracas_fail(FRACAS_USAGE, "%s is no folder; move it away or name another", folder);
    }
    return fracas_fail_system(errno, "cannot make the folder %s", folder);
}

fracas_err fracas_output_folder_in(const char *wanted, const char *study, const char *name,
                                   char **folder)
{
    TRY(wanted ? fracas_path(folder, "%s", wanted) : fracas_path(folder, "%s/%s", study, name));
    if (!wanted && !fracas_folder_is_own(*folder) && errno == ELOOP)
        return fracas_fail_system(errno, "cannot write into %s", *folder);
    return fracas_output_folder(*folder);
}

/* The first kilobytes of the file have `text`. */
static bool file_has(const char *path, const char *text)
{
    char start[4096];
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "r");
    if (!in) return false;
    start[fread(start, 1, sizeof start - 1, in)] = '\0';
    return strstr(start, text) != NULL;
}

static bool has_text(const char *folder, const char *name, const char *text)
{
    OWNED char *path = NULL;
    return !fracas_path(&path, "%s/%s", folder, name) && file_has(path, text);
}

bool fracas_output_begun(const char *folder, const char *name)
{
    const size_t size = strlen(name);
    DIR *found = opendir(folder);
    bool begun = false;
    for (const struct dirent *entry; found && !begun && (entry = readdir(found));) {
        const char *is = entry->d_name;
        begun = *is == '.' && strncmp(is + 1, name, size) == 0 && is[size + 1] == '.' &&
                is[size + 2] && !is[size + 2 + strspn(is + size + 2, "0123456789")];
    }
    if (found) closedir(found);
    return begun;
}

static const char title_end[] = " \u00b7 fracas</title>";

bool fracas_output_is_page(const char *path)
{
    return file_has(path, title_end);
}

bool fracas_output_has_page(const char *folder)
{
    return has_text(folder, FRACAS_OUTPUT_PAGE, title_end);
}

bool fracas_output_is_ours(const char *folder)
{
    return fracas_output_begun(folder, "datapackage.json") || fracas_output_has_page(folder) ||
           has_text(folder, "summary.json", "\"stale_fits\": ") ||
           has_text(folder, "datapackage.json", "of a campaign of fracas");
}

fracas_err fracas_output_empty(const char *folder)
{
    DIR *found = fracas_output_is_ours(folder) ? NULL : opendir(folder);
    fracas_err err = FRACAS_OK;
    if (!found) return FRACAS_OK; /* ours, or to be made */
    for (const struct dirent *entry; !err && (entry = readdir(found));)
        if (*entry->d_name != '.')
            err = fracas_fail(FRACAS_USAGE,
                              "%s/%s is there already, in a folder without a page of fracas: move "
                              "it away, or name another folder",
                              folder, entry->d_name);
    closedir(found);
    return err;
}

fracas_err fracas_output_refuse(const char *path)
{
    return fracas_fail(FRACAS_USAGE,
                       "%s is there already, and is of no report or export of fracas: name "
                       "another folder, or move it away",
                       path);
}

fracas_err fracas_output_free(const char *folder, const char *const *name, size_t count)
{
    if (fracas_output_is_ours(folder)) return FRACAS_OK;
    for (size_t i = 0; i < count; i++) {
        OWNED char *path = NULL;
        TRY(fracas_path(&path, "%s/%s", folder, name[i]));
        if (access(path, F_OK) && fracas_file_is_own(path)) continue;
        return fracas_output_refuse(path);
    }
    return FRACAS_OK;
}

fracas_err fracas_output_open(const char *folder, const char *name, fracas_output_file *output)
{
    *output = (fracas_output_file){0};
    fracas_err err = fracas_path(&output->path, "%s/%s", folder, name);
    if (!err) err = fracas_path(&output->temporary, "%s/.%s.%ld", folder, name, (long)getpid());
    if (!err) {
        output->file = fracas_file_stream(fracas_file_create(output->temporary), "w");
        if (output->file) return FRACAS_OK;
        err = fracas_fail_system(errno, "cannot write %s", output->temporary);
    }
    free(output->path);
    free(output->temporary);
    return err;
}

fracas_err fracas_output_close(fracas_output_file *output, fracas_err err)
{
    bool bad = ferror(output->file);
    if (fclose(output->file)) bad = true; /* buffered output fails here */
    if (!err && bad) err = fracas_fail_system(errno, "cannot write %s", output->path);
    if (!err && rename(output->temporary, output->path))
        err = fracas_fail_system(errno, "cannot rename %s to %s", output->temporary, output->path);
    if (err) unlink(output->temporary);
    free(output->path);
    free(output->temporary);
    *output = (fracas_output_file){0};
    return err;
}
