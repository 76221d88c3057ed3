/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/scratch.h"

#include "base/file.h"
#include "base/own.h"
#include "base/param.h"
#include "campaigns/plan/plan.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#define PREFIX ".fracas-mpi-"
#define SHARED "FRACAS_SHARED"
#define SURROUNDING "FRACAS_TMPDIR"

/* Locks this user's folder; -1: it cannot be, or, with LOCK_NB, another process has it. */
static int lock_folder(const char *path, int wait)
{
    struct stat now, then;
    const int fd = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd >= 0 && !fstat(fd, &then) && then.st_uid == geteuid() && !flock(fd, LOCK_EX | wait) &&
        !lstat(path, &now) && now.st_ino == then.st_ino)
        return fd;
    if (fd >= 0) close(fd);
    return -1;
}

/* Removes the folders of killed runs: nobody holds their locks. */
static void sweep(const char *base)
{
    DIR *all = opendir(base);
    if (!all) return;
    for (const struct dirent *entry; (entry = readdir(all));) {
        char path[4096];
        if (strncmp(entry->d_name, PREFIX, strlen(PREFIX)) ||
            snprintf(path, sizeof path, "%s/%s", base, entry->d_name) >= (int)sizeof path)
            continue;
        OWN_FD lock = lock_folder(path, LOCK_NB);
        if (lock >= 0) fracas_folder_remove(path);
    }
    closedir(all);
}

/* A sweep of another run may take the folder before it is locked. */
static int make_folder(const char *base, char *path, size_t size)
{
    sweep(base);
    for (int tries = 0; tries < 3; tries++) {
        errno = ENAMETOOLONG;
        if (snprintf(path, size, "%s/" PREFIX "XXXXXX", base) >= (int)size || !mkdtemp(path)) break;
        const int lock = lock_folder(path, 0);
        if (lock >= 0) return lock;
    }
    *path = '\0';
    return -1;
}

/* Folder of temporary files; *named: by this variable. Open MPI would make one that is not there,
 * and leave it. */
static const char *surrounding(const char **named)
{
    static const char *const variable[] = {"OMPI_MCA_orte_tmpdir_base", "TMPDIR", "TEMP", "TMP"};
    for (size_t i = 0; i < FRACAS_COUNT(variable); i++) {
        const char *folder = getenv(variable[i]);
        *named = variable[i];
        if (folder && *folder && (!access(folder, F_OK) || errno != ENOENT)) return folder;
    }
    *named = "TMPDIR names no folder";
    return "/tmp";
}

/* Measured: Open MPI 4.1.4 fills 8.2 MB of the session's folder, and hangs with less. */
static fracas_err check_session(const fracas_scratch *scratch, int reason)
{
    static const double need = 10e6;
    char have[FRACAS_SIZE_TEXT];
    const char *named, *base = surrounding(&named);
    struct statvfs disk;
    if (!*scratch->session.path)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "MPI cannot make a folder for its own files in %s (%s): %s; set TMPDIR "
                           "to a folder where you may write, with 10 MB free",
                           base, named, strerror(reason));
    const bool known = !statvfs(scratch->session.path, &disk);
    const double room = known ? (double)disk.f_bavail * (double)disk.f_frsize : need;
    if (room >= need) return FRACAS_OK;
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "MPI needs 10 MB for its own files in %s (%s), but the disk has %s free; "
                       "free some, or set TMPDIR to a folder with more",
                       base, named, fracas_size_write(room, have));
}

fracas_err fracas_scratch_create(fracas_scratch *scratch)
{
    const char *nodes = getenv("SLURM_JOB_NUM_NODES"), *named;
    *scratch = (fracas_scratch)FRACAS_SCRATCH_NONE;
    if (nodes && atoi(nodes) > 1) return FRACAS_OK; /* nobody would remove those of other nodes */
    scratch->shared.lock = make_folder("/dev/shm", scratch->shared.path,
                                       sizeof scratch->shared.path);
    scratch->session.lock = make_folder(surrounding(&named), scratch->session.path,
                                        sizeof scratch->session.path);
    return check_session(scratch, errno);
}

void fracas_scratch_export(const fracas_scratch *scratch)
{
    const char *named;
    if (*scratch->shared.path) setenv(SHARED, scratch->shared.path, 1);
    if (!*scratch->session.path) return;
    setenv(SURROUNDING, surrounding(&named), 1);
    setenv("TMPDIR", scratch->session.path, 1);
    unsetenv("OMPI_MCA_orte_tmpdir_base");
}

void fracas_scratch_import(void)
{
    const char *before = getenv(SURROUNDING), *shared = getenv(SHARED);
    if (before) setenv("TMPDIR", before, 1); /* for the other libraries */
    if (!shared || access(shared, W_OK)) return;
    setenv("OMPI_MCA_btl_vader_backing_directory", shared, 0);
    setenv("OMPI_MCA_btl_sm_backing_directory", shared, 0); /* vader's name in Open MPI 5 */
}

void fracas_scratch_remove(fracas_scratch *scratch)
{
    if (*scratch->session.path) fracas_folder_remove(scratch->session.path);
    if (*scratch->shared.path) fracas_folder_remove(scratch->shared.path);
    if (scratch->session.lock >= 0) close(scratch->session.lock);
    if (scratch->shared.lock >= 0) close(scratch->shared.lock);
    *scratch = (fracas_scratch)FRACAS_SCRATCH_NONE;
}
