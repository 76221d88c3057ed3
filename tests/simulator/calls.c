/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/calls.h"

#include "tests/simulator/descriptors.h"
#include "tests/simulator/farm.h"
#include "tests/simulator/machine.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <linux/magic.h>
#include <math.h>
#include <poll.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <time.h>
#include <unistd.h>

/* ---- pipes ---- */

void calls_pair(int fd[2], size_t capacity)
{
    channel *side[2];
    channel_pair(side, capacity);
    for (int s = 0; s < 2; s++) fd[s] = descriptor_new((descriptor){.channel = side[s]});
}

void calls_tell(int fd, const void *bytes, size_t size)
{
    const descriptor *d = descriptor_of(fd);
    if (d && !d->channel->peer->closed) channel_fill(d->channel->peer, bytes, size);
}

/* ---- bytes ---- */

ssize_t __real_read(int fd, void *to, size_t size);
ssize_t __wrap_read(int fd, void *to, size_t size)
{
    if (fd < FIRST_FD) return __real_read(fd, to, size);
    call("read");
    descriptor *d = descriptor_of(fd);
    errno = EBADF;
    if (!d) return -1;
    if (d->file) {
        const ssize_t got = disk_read(d->file, d->at, to, size);
        d->at += (size_t)got;
        return got;
    }
    return channel_read(d->channel, to, size);
}

ssize_t __real_write(int fd, const void *from, size_t size);
ssize_t __wrap_write(int fd, const void *from, size_t size)
{
    if (fd < FIRST_FD) return __real_write(fd, from, size);
    call("write");
    descriptor *d = descriptor_of(fd);
    errno = EBADF;
    if (!d) return -1;
    if (d->channel) return channel_write(d->channel, from, size);
    const ssize_t put = disk_write(d->file, d->at, from, size);
    if (put > 0) d->at += (size_t)put;
    return put;
}

ssize_t __real_pread(int fd, void *to, size_t size, off_t at);
ssize_t __wrap_pread(int fd, void *to, size_t size, off_t at)
{
    if (fd < FIRST_FD) return __real_pread(fd, to, size, at);
    call("pread");
    return disk_read(descriptor_of(fd)->file, (size_t)at, to, size);
}

ssize_t __wrap_pwrite(int fd, const void *from, size_t size, off_t at)
{
    call("pwrite");
    return disk_write(descriptor_of(fd)->file, (size_t)at, from, size);
}

int __real_close(int fd);
int __wrap_close(int fd)
{
    if (fd < FIRST_FD) return __real_close(fd);
    descriptor_shut(fd);
    return 0;
}

int __wrap_ftruncate(int fd, off_t size)
{
    call("ftruncate");
    return disk_truncate(descriptor_of(fd)->file, (size_t)size);
}

int __wrap_fsync(int fd)
{
    call("before fsync");
    return fd < FIRST_FD
               ? 0
               : disk_sync(descriptor_of(fd)->file); /* the folder above is the real one */
}

/* A rank looks for messages of other ranks between two polls of some ms; here one poll lasts until
 * something comes. */
static double end_of_poll(int timeout)
{
    if (timeout < 0) return INFINITY;
    if (world.current->role != RANK) return world.now + 1e-3 * timeout;
    return world.now + (world.current->number == 0 ? 0.25 : 30);
}

int __real_poll(struct pollfd *from, nfds_t count, int timeout);
int __wrap_poll(struct pollfd *from, nfds_t count, int timeout)
{
    if (!world.current) return __real_poll(from, count, timeout);
    call("poll");
    const double end = end_of_poll(timeout);
    for (bool waited = false;; waited = true) {
        int ready = 0;
        for (nfds_t i = 0; i < count; i++) {
            const descriptor *d = descriptor_of(from[i].fd);
            from[i].revents = d && channel_is_ready(d->channel) ? POLLIN : 0;
            ready += from[i].revents != 0;
            if (d) d->channel->reader = world.current;
        }
        const bool woken = waited && world.current->role == RANK;
        if (ready || timeout == 0 || woken || world.now >= end) return ready;
        if (machine_mail()) return 0;
        process_wait(end);
    }
}

/* ---- names ---- */

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...)
{
    if (!disk_has(path)) return __real_open(path, flags, 0666);
    call("open");
    node *n = disk_find(path);
    if (n && flags & O_EXCL) {
        errno = EEXIST;
        return -1;
    }
    if (!n && !(flags & O_CREAT)) return -1;
    if (!n) n = disk_make(path, false);
    if (!n) return -1;
    if (flags & O_TRUNC) disk_truncate(n, 0);
    return descriptor_new((descriptor){.file = n});
}

static int look_at(const node *n, struct stat *info)
{
    if (!n) return -1;
    *info = (struct stat){.st_mode = (n->folder ? S_IFDIR : S_IFREG) | 0666,
                          .st_size = (off_t)n->size,
                          .st_nlink = 1};
    return 0;
}

int __real_stat(const char *path, struct stat *info);
int __wrap_stat(const char *path, struct stat *info)
{
    return disk_has(path) ? look_at(disk_find(path), info) : __real_stat(path, info);
}

int __wrap_lstat(const char *path, struct stat *info)
{
    return look_at(disk_find(path), info);
}

int __real_fstat(int fd, struct stat *info);
int __wrap_fstat(int fd, struct stat *info)
{
    return fd < FIRST_FD ? __real_fstat(fd, info) : look_at(descriptor_of(fd)->file, info);
}

int __wrap_access(const char *path, int mode)
{
    (void)mode;
    return disk_find(path) ? 0 : -1;
}

int __wrap_faccessat(int folder, const char *path, int mode, int flags)
{
    (void)folder, (void)flags;
    return __wrap_access(path, mode);
}

int __wrap_mkdir(const char *path, mode_t mode)
{
    (void)mode;
    call("mkdir");
    if (!disk_find(path)) return disk_make(path, true) ? 0 : -1;
    errno = EEXIST;
    return -1;
}

int __wrap_unlink(const char *path)
{
    call("unlink");
    return disk_unlink(path);
}

int __wrap_rmdir(const char *path)
{
    const node *n = disk_find(path);
    call("rmdir");
    errno = ENOTEMPTY;
    return n && n->nentries ? -1 : disk_unlink(path);
}

int __wrap_rename(const char *from, const char *to)
{
    call("rename");
    const int result = disk_rename(from, to);
    call("after rename");
    return result;
}

int __wrap_scandir(const char *path, struct dirent ***list,
                   int (*wanted)(const struct dirent *entry),
                   int (*order)(const struct dirent **a, const struct dirent **b))
{
    (void)wanted;
    const node *folder = disk_find(path);
    if (!folder) return -1;
    *list = calloc(folder->nentries + 1, sizeof **list);
    for (size_t i = 0; *list && i < folder->nentries; i++) {
        struct dirent *one = (*list)[i] = calloc(1, sizeof *one);
        if (one) snprintf(one->d_name, sizeof one->d_name, "%s", folder->entry[i].name);
    }
    qsort(*list, folder->nentries, sizeof **list, (int (*)(const void *, const void *))order);
    return (int)folder->nentries;
}

int __wrap_statfs(const char *path, struct statfs *info)
{
    (void)path;
    *info = (struct statfs){.f_type = disk.network ? NFS_SUPER_MAGIC : EXT4_SUPER_MAGIC};
    return 0;
}

/* Locks of fcntl belong to a process, and any of its closes of the file ends them. */
int __wrap_fcntl(int fd, int command, ...)
{
    va_list arguments;
    va_start(arguments, command);
    struct flock *lock = va_arg(arguments, struct flock *);
    va_end(arguments);
    call("fcntl");
    node *n = descriptor_of(fd)->file;
    const bool taken = n->locked_by && n->locked_by != world.current;
    if (command == F_GETLK) {
        lock->l_type = taken ? F_WRLCK : F_UNLCK;
        lock->l_pid = taken ? n->locked_by->pid : 0;
        return 0;
    }
    errno = EAGAIN;
    if (taken) return -1;
    n->locked_by = world.current;
    return 0;
}

/* ---- streams ---- */

enum { MOST_STREAMS = 64 };
static struct {
    FILE *stream;
    int fd;
} open_stream[MOST_STREAMS];

static ssize_t stream_read(void *fd, char *to, size_t size)
{
    return __wrap_read((int)(intptr_t)fd, to, size);
}

static ssize_t stream_write(void *fd, const char *from, size_t size)
{
    const ssize_t put = __wrap_write((int)(intptr_t)fd, from, size);
    return put < 0 ? 0 : put;
}

static int stream_close(void *fd)
{
    for (size_t s = 0; s < MOST_STREAMS; s++)
        if (open_stream[s].fd == (int)(intptr_t)fd) open_stream[s].fd = 0;
    return __wrap_close((int)(intptr_t)fd);
}

/* /proc/PID/stat of a simulated process; NULL for all else that the system tells. */
static FILE *open_told(const char *path)
{
    long pid;
    char text[128];
    if (!strcmp(path, "/proc/sys/kernel/random/boot_id")) {
        snprintf(text, sizeof text, "boot-%d\n", world.boots);
    } else {
        if (sscanf(path, "/proc/%ld/stat", &pid) != 1) return NULL;
        const process *p = process_of((int)pid);
        if (!p || !p->alive) return NULL;
        snprintf(text, sizeof text, "%ld (fracas) S 1 1 1 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 %ld", pid,
                 pid);
    }
    FILE *in = fmemopen(NULL, strlen(text) + 1, "w+");
    if (in) fputs(text, in), rewind(in);
    return in;
}

FILE *__real_fopen(const char *path, const char *mode);
FILE *__wrap_fopen(const char *path, const char *mode)
{
    return world.current ? open_told(path) : __real_fopen(path, mode);
}

FILE *__real_fdopen(int fd, const char *mode);
FILE *__wrap_fdopen(int fd, const char *mode)
{
    if (fd < FIRST_FD) return __real_fdopen(fd, mode);
    FILE *stream = fopencookie(
        (void *)(intptr_t)fd, mode,
        (cookie_io_functions_t){.read = stream_read, .write = stream_write, .close = stream_close});
    for (size_t s = 0; s < MOST_STREAMS; s++)
        if (!open_stream[s].fd || !descriptor_of(open_stream[s].fd)) {
            open_stream[s].stream = stream;
            open_stream[s].fd = fd;
            break;
        }
    return stream;
}

int __real_fileno(FILE *stream);
int __wrap_fileno(FILE *stream)
{
    for (size_t s = 0; s < MOST_STREAMS; s++)
        if (open_stream[s].stream == stream && open_stream[s].fd) return open_stream[s].fd;
    return __real_fileno(stream);
}

/* The status channel. */
int __wrap_dprintf(int fd, const char *format, ...)
{
    char text[4096];
    va_list arguments;
    va_start(arguments, format);
    const int length = vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    (void)fd;
    call("printf");
    if (machine_is_heard()) calls_tell(world.current->out, text, strlen(text));
    return length;
}

/* ---- clocks ---- */

double calls_monotonic(void)
{
    return 1000 + world.now + world.skew;
}

double calls_day(void)
{
    return world.day + world.now;
}

int __real_clock_gettime(clockid_t clock, struct timespec *t);
int __wrap_clock_gettime(clockid_t clock, struct timespec *t)
{
    if (!world.current) return __real_clock_gettime(clock, t);
    const double now = clock == CLOCK_REALTIME ? calls_day() : calls_monotonic();
    t->tv_sec = (time_t)now;
    t->tv_nsec = (long)((now - floor(now)) * 1e9);
    return 0;
}

time_t __wrap_time(time_t *t)
{
    (void)t;
    return (time_t)calls_day();
}

/* A resting rank looks for messages; one wakes it. */
int __wrap_nanosleep(const struct timespec *time, struct timespec *left)
{
    (void)left;
    call("nanosleep");
    double seconds = (double)time->tv_sec + 1e-9 * (double)time->tv_nsec;
    if (world.current->role == RANK) seconds = fmax(seconds, 0.02);
    process_wait(world.now + seconds);
    return 0;
}

/* ---- the environment ---- */

void calls_set_environment(process *p, const char *name, const char *value)
{
    for (size_t e = 0; e < NENV; e++)
        if (!strcmp(p->env[e].name, name) || !*p->env[e].name) {
            snprintf(p->env[e].name, sizeof p->env[e].name, "%s", name);
            snprintf(p->env[e].value, sizeof p->env[e].value, "%s", value);
            return;
        }
    abort();
}

char *__real_getenv(const char *name);
char *__wrap_getenv(const char *name)
{
    process *p = world.current;
    if (!p) return __real_getenv(name);
    for (size_t e = 0; e < NENV; e++)
        if (!strcmp(p->env[e].name, name) && *p->env[e].value) return p->env[e].value;
    return NULL;
}

int __wrap_setenv(const char *name, const char *value, int over)
{
    (void)over;
    calls_set_environment(world.current, name, value);
    return 0;
}

int __wrap_unsetenv(const char *name)
{
    calls_set_environment(world.current, name, "");
    return 0;
}

int __wrap_gethostname(char *name, size_t size)
{
    snprintf(name, size, "farm-%d", farm_host(world.current));
    return 0;
}
