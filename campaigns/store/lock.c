/* STUDY/lock: one run at a time. */
#include "campaigns/store/disk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* "HOST PID" of whoever took the lock last. */
static fracas_err in_use(int fd, const char *path, pid_t holder)
{
    char text[320] = "", host[257] = "an unknown host", pid[32];
    snprintf(pid, sizeof pid, "%ld", (long)holder); /* what the kernel knows; 0 or less across a network */
    if (pread(fd, text, sizeof text - 1, 0) > 0) sscanf(text, "%256s %31s", host, pid);
    return fracas_fail(FRACAS_IN_USE, "%s: another run uses this study: host %s, pid %s; wait for it or stop it", path,
                       host, pid);
}

static fracas_err sign(int fd, const char *path)
{
    char host[257] = "", text[320];
    if (gethostname(host, sizeof host - 1) < 0) strcpy(host, "unknown");
    int length = snprintf(text, sizeof text, "%s %ld\n", host, (long)getpid());
    if (ftruncate(fd, 0) < 0 || pwrite(fd, text, (size_t)length, 0) != length) return fracas_disk_fail("write", path);
    return FRACAS_OK;
}

/* A lock of fcntl's older kind: it belongs to the process and not to the open file, so forked children neither
 * have it nor keep it alive. */
static fracas_err take(int fd, const char *path)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    if (fcntl(fd, F_SETLK, &lock) == 0) return sign(fd, path);
    if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot lock %s: %s; this filesystem has no locks: put the study on one "
                           "that has", path, strerror(errno));
    if (errno != EACCES && errno != EAGAIN) return fracas_disk_fail("lock", path);
    if (fcntl(fd, F_GETLK, &lock) < 0) lock.l_pid = 0;
    return in_use(fd, path, lock.l_pid);
}

fracas_err fracas_study_lock(const char *study, int *lock)
{
    char *path;
    TRY(fracas_disk_join(study, "lock", &path));
    fracas_err err = FRACAS_OK;
    *lock = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (*lock < 0) err = fracas_disk_fail("open", path);
    if (!err) err = take(*lock, path);
    if (err && *lock >= 0) close(*lock), *lock = -1;
    free(path);
    return err;
}

bool fracas_study_held(const char *study)
{
    char *path;
    if (fracas_disk_join(study, "lock", &path)) return false;
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    bool held = fd >= 0 && fcntl(fd, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
    if (fd >= 0) close(fd);
    free(path);
    return held;
}
