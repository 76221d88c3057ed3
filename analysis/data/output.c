/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/output.h"

#include "base/file.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
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
