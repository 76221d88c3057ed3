/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/output.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

fracas_err fracas_output_folder(const char *folder)
{
    struct stat what;
    if (!mkdir(folder, 0777)) return FRACAS_OK;
    const int reason = errno;
    if (reason == EEXIST && !stat(folder, &what) && S_ISDIR(what.st_mode)) return FRACAS_OK;
    if (reason == EEXIST) return fracas_fail(FRACAS_USAGE, "%s is no folder; name another", folder);
    return fracas_fail_system(reason, "cannot make the folder %s", folder);
}

fracas_err fracas_output_open(const char *folder, const char *name, fracas_output_file *output)
{
    *output = (fracas_output_file){0};
    if (asprintf(&output->path, "%s/%s", folder, name) < 0) output->path = NULL;
    if (asprintf(&output->temporary, "%s/.%s.%ld", folder, name, (long)getpid()) < 0)
        output->temporary = NULL;
    fracas_err err = FRACAS_OK;
    if (!output->path || !output->temporary) {
        err = fracas_no_memory("a path");
    } else {
        output->file = fopen(output->temporary, "w");
        if (!output->file) err = fracas_fail_system(errno, "cannot write %s", output->temporary);
    }
    if (!err) return FRACAS_OK;
    free(output->path);
    free(output->temporary);
    *output = (fracas_output_file){0};
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
