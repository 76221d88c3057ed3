/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/file.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* 0 for a file, else why it is none. */
static int fault_of(mode_t mode)
{
    return S_ISREG(mode) ? 0 : S_ISDIR(mode) ? EISDIR : S_ISLNK(mode) ? ELOOP : ENXIO;
}

/* O_NONBLOCK: a pipe opens at once, and a file takes no notice of it. */
static int open_file(const char *path, int flags)
{
    struct stat info;
    const int fd = open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    if (fd < 0) return -1;
    const int fault = fstat(fd, &info) ? errno : fault_of(info.st_mode);
    if (!fault) return fd;
    close(fd);
    errno = fault;
    return -1;
}

int fracas_file_open(const char *path)
{
    return open_file(path, O_RDONLY);
}

int fracas_file_open_own(const char *path)
{
    return open_file(path, O_RDWR | O_CREAT | O_NOFOLLOW);
}

int fracas_file_create(const char *path)
{
    const int fd = open_file(path, O_RDWR | O_CREAT | O_EXCL);
    if (fd >= 0 || errno != EEXIST || unlink(path)) return fd;
    return open_file(path, O_RDWR | O_CREAT | O_EXCL);
}

FILE *fracas_file_stream(int fd, const char *mode)
{
    if (fd < 0) return NULL;
    FILE *stream = fdopen(fd, mode);
    const int reason = errno;
    if (!stream) close(fd);
    errno = reason;
    return stream;
}

bool fracas_file_begins(const char *path, const char *text)
{
    char start[100] = "";
    struct stat info;
    const size_t wanted = strlen(text);
    if (stat(path, &info) || !S_ISREG(info.st_mode) || info.st_size == 0) return true;
    FILE *in = fracas_file_stream(fracas_file_open(path), "r");
    const bool same = in && wanted <= sizeof start && fread(start, 1, wanted, in) == wanted &&
                      memcmp(start, text, wanted) == 0;
    if (in) fclose(in);
    return same;
}

bool fracas_file_same(const char *one, const char *other)
{
    struct stat a, b;
    return !stat(one, &a) && !stat(other, &b) && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

bool fracas_file_is_own(const char *path)
{
    struct stat info;
    if (lstat(path, &info)) return errno == ENOENT;
    errno = fault_of(info.st_mode);
    return !errno;
}

bool fracas_folder_is_own(const char *path)
{
    struct stat info;
    if (lstat(path, &info)) return errno == ENOENT;
    errno = S_ISDIR(info.st_mode) ? 0 : S_ISLNK(info.st_mode) ? ELOOP : ENOTDIR;
    return !errno;
}

bool fracas_folder_create(const char *path)
{
    return !mkdir(path, 0777) || (errno == EEXIST && fracas_folder_is_own(path));
}

fracas_err fracas_file_set_aside(const char *path, char **aside)
{
    char stamp[32];
    struct tm utc;
    const time_t now = time(NULL);
    strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", gmtime_r(&now, &utc));
    TRY(fracas_path(aside, "%s.before-%s-%ld", path, stamp, (long)getpid()));
    if (!rename(path, *aside)) return FRACAS_OK;
    const int reason = errno;
    free(*aside);
    *aside = NULL;
    return reason == ENOENT ? FRACAS_OK : fracas_fail_system(reason, "cannot rename %s", path);
}

static int remove_one(const char *path, const struct stat *info, int type, struct FTW *place)
{
    (void)info, (void)type, (void)place;
    remove(path);
    return 0; /* the rest is removed all the same */
}

void fracas_folder_remove(const char *path)
{
    nftw(path, remove_one, 8, FTW_DEPTH | FTW_PHYS | FTW_MOUNT);
}
