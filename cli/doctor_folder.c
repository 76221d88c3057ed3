/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The folder for studies: what its file system does. */
#include "cli/doctor.h"

#include "base/own.h"
#include "campaigns/plan/plan.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <unistd.h>

static void look_at_folder(fracas_patient *patient)
{
    bool local;
    if (!*patient->own) {
        char probe[PATH_MAX];
        snprintf(probe, sizeof probe, "%s/.fracas-doctor-XXXXXX", patient->folder);
        const int reason = mkdtemp(probe) ? EEXIST : errno;
        fracas_patient_say(patient, FRACAS_WRONG,
                           "no study can be made in %s: %s; choose a folder where you may write "
                           "(`fracas run --study DIR`)",
                           patient->folder, strerror(reason));
        return;
    }
    if (fracas_patient_fails(patient, fracas_disk_is_local(patient->own, &local))) return;
    if (local)
        fracas_patient_say(patient, FRACAS_SOUND, "%s is on a file system of this machine",
                           patient->folder);
    else
        fracas_patient_say(patient, FRACAS_NOTED,
                           "%s is on a network file system, or one that is not known: while a run "
                           "has a study, only that run reads its index; others wait (`fracas "
                           "status --watch`)",
                           patient->folder);
}

/* False: without a folder there is nothing to look at. */
static bool has_folder(fracas_patient *patient)
{
    if (!*patient->own)
        fracas_patient_say(patient, FRACAS_NOTED, "not tried, for want of a folder");
    return *patient->own != '\0';
}

static void refuse(fracas_patient *patient, const char *doing)
{
    fracas_patient_say(patient, FRACAS_WRONG, "cannot %s in %s: %s; choose another folder", doing,
                       patient->folder, strerror(errno));
}

/* ---- locks ---- */

static int lock_of(const char *path)
{
    const struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    const int fd = open(path, O_RDWR | O_CLOEXEC);
    if (fd < 0) return errno;
    return fcntl(fd, F_SETLK, &lock) ? errno : 0;
}

/* The answer of another process: errno of its lock. */
static int lock_of_another(const char *path)
{
    int status;
    const pid_t pid = fork();
    if (pid == 0) _exit(lock_of(path));
    while (pid > 0 && waitpid(pid, &status, 0) < 0)
        if (errno != EINTR) return ECHILD;
    return pid > 0 && WIFEXITED(status) ? WEXITSTATUS(status) : ECHILD;
}

static void look_at_locks(fracas_patient *patient)
{
    char path[PATH_MAX + 64];
    if (!has_folder(patient)) return;
    snprintf(path, sizeof path, "%s/lock", patient->own);
    if (!fracas_patient_write(patient, "lock", "")) {
        refuse(patient, "write a file");
        return;
    }
    const int mine = lock_of(path), other = mine ? 0 : lock_of_another(path);
    if (mine)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "no locks (fcntl): %s; two runs could take one study: mount the file "
                           "system with locks, or choose another folder",
                           strerror(mine));
    else if (other != EACCES && other != EAGAIN)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "locks (fcntl) keep nobody out: a second process got the lock of the "
                           "first; mount the file system with locks, or choose another folder");
    else fracas_patient_say(patient, FRACAS_SOUND, "locks (fcntl) keep another process out");
}

/* ---- sync and rename ---- */

static void look_at_sync(fracas_patient *patient)
{
    enum { SIZE = 1 << 20 };
    static char block[SIZE]; /* zeros */
    char path[PATH_MAX + 64];
    if (!has_folder(patient)) return;
    snprintf(path, sizeof path, "%s/sync", patient->own);
    const double began = fracas_now();
    OWN_FD fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0 || write(fd, block, SIZE) != SIZE || fsync(fd)) {
        refuse(patient, "write and sync 1 MB");
        return;
    }
    if (fracas_patient_fails(patient, fracas_disk_sync_folder(path))) return;
    const double took = 1e3 * (fracas_now() - began);
    if (took > 500)
        fracas_patient_say(patient, FRACAS_NOTED,
                           "1 MB is on disk after %.0f ms: segments would keep the workers "
                           "waiting; write fewer by --segment-age 60, or choose another folder",
                           took);
    else fracas_patient_say(patient, FRACAS_SOUND, "1 MB is on disk after %.0f ms (fsync)", took);
}

static void look_at_rename(fracas_patient *patient)
{
    char from[PATH_MAX + 64], to[PATH_MAX + 64], text[8] = "";
    size_t got;
    if (!has_folder(patient)) return;
    snprintf(from, sizeof from, "%s/new", patient->own);
    snprintf(to, sizeof to, "%s/old", patient->own);
    OWN_FD fd = -1;
    if (!fracas_patient_write(patient, "new", "new") ||
        !fracas_patient_write(patient, "old", "old") || rename(from, to) ||
        (fd = open(to, O_RDONLY | O_CLOEXEC)) < 0 || !fracas_disk_read(fd, 0, text, 3, &got))
        refuse(patient, "replace a file by rename");
    else if (strcmp(text, "new") || !access(from, F_OK))
        fracas_patient_say(patient, FRACAS_WRONG,
                           "rename left the old file in place: a study could be lost; choose "
                           "another folder");
    else fracas_patient_say(patient, FRACAS_SOUND, "rename replaces a file");
}

static void look_at_space(fracas_patient *patient)
{
    static const double least = 5e7, little = 1e9;
    char room[FRACAS_SIZE_TEXT];
    struct statvfs disk;
    if (statvfs(patient->folder, &disk)) {
        refuse(patient, "see the space");
        return;
    }
    const double bytes = (double)disk.f_bavail * (double)disk.f_frsize;
    const bool no_files = disk.f_files > 0 && disk.f_favail < 100;
    fracas_size_write(bytes, room);
    if (bytes < least || no_files)
        fracas_patient_say(patient, FRACAS_WRONG,
                           "the disk of %s has %s and %llu more files: free some, or choose "
                           "another folder",
                           patient->folder, room, (unsigned long long)disk.f_favail);
    else
        fracas_patient_say(patient, bytes < little ? FRACAS_NOTED : FRACAS_SOUND,
                           "%s free; `fracas plan FILE` says how much a campaign takes", room);
}

const fracas_checkup fracas_checkups_folder[] = {
    {"folder", look_at_folder}, {"locks", look_at_locks}, {"sync", look_at_sync},
    {"rename", look_at_rename}, {"space", look_at_space}, {0}};
