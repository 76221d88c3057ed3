/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/lock: one run at a time.
 *
 * The kernel's lock (fcntl) decides where it can; the text of the file says whose it is, for
 * messages and for the one case in which the kernel does not know: a filesystem whose locks hosts
 * do not share. A clean release empties the file, so text under a lock that could be had is that of
 * a holder that died, or that runs on another such host (docs/decisions/lock.md). */
#include "base/file.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* A holder as the file names it; "" or 0 where it does not. */
typedef struct {
    char host[FRACAS_HOST_TEXT];
    char since[32];              /* UTC */
    char boot[FRACAS_BOOT_TEXT]; /* the kernel's */
    char job[64];                /* SLURM_JOB_ID */
    long pid;
    unsigned long long start; /* the process's, as in /proc/PID/stat */
    int restart;              /* SLURM_RESTART_COUNT: times that the job was requeued */
} holder;

enum { TEXT = 1024 };

/* ---- who is who ---- */

/* Start of a process in ticks since the boot, 0 if there is none, or only its entry until its
 * parent asks how it ended. */
static unsigned long long start_of(long pid)
{
    char path[64], text[TEXT], state = 'X';
    unsigned long long start = 0;
    snprintf(path, sizeof path, "/proc/%ld/stat", pid);
    OWN(FILE) in = fopen(path, "re"); /* its name, in brackets, may hold anything */
    const char *at = in && fgets(text, sizeof text, in) ? strrchr(text, ')') : NULL;
    if (at && sscanf(at + 1, " %c%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%*s%llu",
                     &state, &start) != 2)
        start = 0;
    return state == 'Z' || state == 'X' ? 0 : start;
}

static void cut_word(char *text) /* no spaces within */
{
    text[strcspn(text, " \t\n")] = '\0';
}

static holder this_process(void)
{
    holder self = {.pid = getpid(), .start = start_of(getpid())};
    const char *restart = getenv("SLURM_RESTART_COUNT"), *job = getenv("SLURM_JOB_ID");
    fracas_disk_host(self.host, self.boot);
    snprintf(self.job, sizeof self.job, "%s", job ? job : "");
    cut_word(self.host);
    cut_word(self.job);
    self.restart = restart ? atoi(restart) : 0;
    time_t now = time(NULL);
    struct tm utc;
    strftime(self.since, sizeof self.since, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    return self;
}

/* "host=H pid=N since=T start=N boot=B job=J restart=N", "-" for an unknown value. */
static void parse(const char *text, holder *h)
{
    *h = (holder){0};
    int fields = sscanf(text,
                        "host=%256s pid=%ld since=%31s start=%llu boot=%63s job=%63s restart=%d",
                        h->host, &h->pid, h->since, &h->start, h->boot, h->job, &h->restart);
    if (!strcmp(h->boot, "-")) *h->boot = '\0';
    if (!strcmp(h->job, "-")) *h->job = '\0';
    if (fields != 7) *h = (holder){.host = "unknown"};
}

/* *named: the file says something. False, and errno, if it cannot be read. */
static bool read_holder(int fd, holder *h, bool *named)
{
    char text[TEXT] = "";
    size_t got;
    *h = (holder){0};
    *named = false;
    if (!fracas_disk_read(fd, 0, text, sizeof text - 1, &got)) return false;
    *named = got > 0;
    if (*named) parse(text, h);
    return true;
}

static void describe(const holder *h, char text[FRACAS_HOLDER_TEXT])
{
    char pid[32] = "unknown", job[80] = "";
    if (h->pid > 0) snprintf(pid, sizeof pid, "%ld", h->pid);
    if (*h->job) snprintf(job, sizeof job, ", Slurm job %s", h->job);
    snprintf(text, FRACAS_HOLDER_TEXT, "host %.200s, pid %s%s%s%s", *h->host ? h->host : "unknown",
             pid, *h->since ? ", since " : "", h->since, job);
}

/* One kernel knows of the locks of both: that the lock could be had means that the other is dead.
 */
static bool same_kernel(const holder *a, const holder *b)
{
    return !strcmp(a->host, b->host) || (*a->boot && !strcmp(a->boot, b->boot));
}

/* The same job on another node is the same run: Slurm has ended it there before it began it again
 * here. */
static bool is_requeued(const holder *before, const holder *self)
{
    return *self->job && !strcmp(before->job, self->job) && self->restart > before->restart;
}

/* It runs, though the kernel has no lock of it: on a filesystem that only pretends to lock. */
static bool lives(const holder *h, const holder *self)
{
    return h->pid > 0 && h->pid != self->pid && h->start && same_kernel(h, self) &&
           !strcmp(h->boot, self->boot) && start_of(h->pid) == h->start;
}

/* ---- taking and leaving it ---- */

static fracas_err sign(int fd, const char *path, const holder *before)
{
    char text[TEXT], left[FRACAS_HOLDER_TEXT];
    holder self = this_process();
    int length = snprintf(text, sizeof text,
                          "host=%s pid=%ld since=%s start=%llu boot=%s job=%s restart=%d\n",
                          self.host, self.pid, self.since, self.start, *self.boot ? self.boot : "-",
                          *self.job ? self.job : "-", self.restart);
    if (before) {
        describe(before, left);
        length += snprintf(text + length, sizeof text - (size_t)length, "after %s\n", left);
    }
    if (ftruncate(fd, 0) < 0 || !fracas_disk_write(fd, 0, text, (size_t)length))
        return fracas_disk_fail("write", path);
    return fsync(fd) < 0 ? fracas_disk_fail("sync", path) : FRACAS_OK; /* whole after a power cut */
}

/* Whoever the kernel says has it: `pid` is 0 or less across a network. */
static fracas_err in_use(int fd, const char *path, pid_t pid)
{
    holder h;
    char text[FRACAS_HOLDER_TEXT];
    bool named;
    if (!read_holder(fd, &h, &named)) return fracas_disk_fail("read", path);
    if (pid > 0 && h.pid != pid)
        h = (holder){.pid = pid}, snprintf(h.host, sizeof h.host, "%s", this_process().host);
    describe(&h, text);
    return fracas_fail(FRACAS_IN_USE, "%s: another run uses this study: %s; wait for it or stop it",
                       path, text);
}

/* The kernel gives the lock: is it free? */
static fracas_err judge(const char *path, const holder *before, bool force)
{
    char text[FRACAS_HOLDER_TEXT];
    bool local = false;
    holder self = this_process();
    describe(before, text);
    if (lives(before, &self))
        return fracas_fail(FRACAS_IN_USE,
                           "%s: another run uses this study: %s; it runs, though the filesystem "
                           "does not keep its lock; wait for it or stop it",
                           path, text);
    if (force || same_kernel(before, &self) || is_requeued(before, &self)) return FRACAS_OK;
    if (!strcmp(before->host, "unknown") && !fracas_disk_is_local(path, &local) && local)
        return FRACAS_OK; /* torn by a power cut */
    return fracas_fail(
        FRACAS_IN_USE,
        "%s: another run uses this study, or died without leaving it: %s; whether it lives cannot "
        "be told from here: look on that host, and if it is gone run again with --force",
        path, text);
}

/* Who has it has not signed it: it only looks, or is about to sign. This ends soon. */
static bool is_passing(int fd)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    holder h;
    bool named;
    if (fcntl(fd, F_GETLK, &lock) < 0 || !read_holder(fd, &h, &named)) return false;
    return lock.l_type == F_UNLCK || !named || (lock.l_pid > 0 && h.pid != lock.l_pid);
}

/* False, and errno, if another process has the lock and keeps it. */
static bool try_lock(int fd)
{
    enum { PATIENCE = 250 /* times */ };
    const struct timespec rest = {.tv_nsec = 20000000};
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    for (int t = 0; fcntl(fd, F_SETLK, &lock) < 0; t++) {
        const int reason = errno;
        const bool wait = (reason == EACCES || reason == EAGAIN) && t < PATIENCE && is_passing(fd);
        errno = reason;
        if (!wait) return false;
        nanosleep(&rest, NULL);
    }
    return true;
}

/* A lock of fcntl's older kind: it belongs to the process and not to the open file, so forked
 * children neither have it nor keep it alive. */
static fracas_err take(int fd, const char *path, bool force, bool signing)
{
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET}; /* for F_GETLK */
    holder before;
    if (try_lock(fd)) {
        bool left;
        if (!read_holder(fd, &before, &left)) return fracas_disk_fail("read", path);
        if (left) TRY(judge(path, &before, force));
        return signing ? sign(fd, path, left ? &before : NULL) : FRACAS_OK;
    }
    if (errno == ENOLCK || errno == ENOSYS || errno == EOPNOTSUPP)
        return fracas_fail(
            FRACAS_ENVIRONMENT,
            "cannot lock %s: %s; this filesystem has no locks: put the study on one that has", path,
            strerror(errno));
    if (errno != EACCES && errno != EAGAIN) return fracas_disk_fail("lock", path);
    if (fcntl(fd, F_GETLK, &lock) < 0) lock.l_pid = 0;
    return in_use(fd, path, lock.l_pid);
}

static fracas_err open_and_take(const char *study, bool force, bool signing, int *lock)
{
    OWNED char *path = NULL;
    *lock = -1;
    TRY(fracas_disk_join(study, "lock", &path));
    const int fd = fracas_file_open_own(path); /* it will be emptied */
    if (fd < 0) return fracas_disk_fail("open", path);
    fracas_err err = take(fd, path, force, signing);
    if (err) close(fd);
    else *lock = fd;
    return err;
}

fracas_err fracas_study_lock(const char *study, bool force, int *lock)
{
    return open_and_take(study, force, true, lock);
}

fracas_err fracas_study_lock_to_look(const char *study, bool force, int *lock)
{
    return open_and_take(study, force, false, lock);
}

void fracas_study_unlock(int lock)
{
    if (lock < 0) return;
    while (ftruncate(lock, 0) < 0 && errno == EINTR) /* if this fails: the next run takes over */
        ;
    close(lock);
}

bool fracas_study_took_over(int lock, char text[FRACAS_HOLDER_TEXT])
{
    char all[TEXT] = "";
    *text = '\0';
    if (pread(lock, all, sizeof all - 1, 0) <= 0) return false;
    const char *after = strstr(all, "\nafter ");
    if (after) snprintf(text, FRACAS_HOLDER_TEXT, "%.*s", (int)strcspn(after + 7, "\n"), after + 7);
    return after != NULL;
}

/* ---- looking at it ---- */

fracas_err fracas_study_lock_state(const char *study, fracas_lock_state *state,
                                   char text[FRACAS_HOLDER_TEXT])
{
    OWNED char *path = NULL;
    holder h, self = this_process();
    *state = FRACAS_LOCK_FREE;
    *text = '\0';
    TRY(fracas_disk_join(study, "lock", &path));
    struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET};
    OWN_FD fd = fracas_file_open(path);
    if (fd < 0) {
        if (errno == ENOENT) return FRACAS_OK;
        fracas_err err = fracas_disk_fail("open", path);
        return err == FRACAS_DAMAGED ? FRACAS_OK : err; /* a link in its place is named elsewhere */
    }
    bool held = fcntl(fd, F_GETLK, &lock) == 0 && lock.l_type != F_UNLCK, named;
    if (!read_holder(fd, &h, &named)) return fracas_disk_fail("read", path);
    if (held && lock.l_pid > 0 && h.pid != lock.l_pid) h = (holder){.pid = lock.l_pid};
    if (held || named) describe(&h, text);
    if (held || (named && lives(&h, &self))) *state = FRACAS_LOCK_HELD;
    else if (named) *state = same_kernel(&h, &self) ? FRACAS_LOCK_LEFT : FRACAS_LOCK_ELSEWHERE;
    return FRACAS_OK;
}
