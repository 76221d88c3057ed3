/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every place in the program that calls the C library, SQLite or HDF5, and those calls failing. A
 * place is a call and the functions that led to it; a run that only watches finds them. Libraries'
 * own calls are theirs: failing_libraries.c, which is linked with this, tells them apart. */
#ifndef FRACAS_TESTS_SUPPORT_EACH_PLACE_H
#define FRACAS_TESTS_SUPPORT_EACH_PLACE_H

#include "tests/support/failing_calls.h"
#include "tests/support/test.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <unistd.h>

/* Ways in which a call fails beside the errors of the system. */
enum {
    HALF = -1, /* reads or writes a half, and succeeds */
    GONE = -2  /* somebody else removed the file just before: ENOENT */
};

enum { MOST_WAYS = 5 };

/* 0: no other. A call of a library or an allocation has the one way of its class. */
static const struct {
    const char *name;
    int way[MOST_WAYS];
} ways[] = {{"open", {EMFILE, EACCES}},
            {"scandir", {EMFILE}},
            {"fopen", {EMFILE}},
            {"pread", {EIO, EINTR, HALF}},
            {"pwrite", {ENOSPC, EINTR, HALF}},
            {"ftruncate", {ENOSPC, EINTR}},
            {"fsync", {EIO, EINVAL, EROFS}},
            {"rename", {EIO}},
            {"unlink", {EIO, GONE}},
            {"remove", {EIO, GONE}},
            {"rmdir", {EBUSY}},
            {"mkdir", {ENOSPC}},
            {"link", {EXDEV}},
            {"lstat", {EACCES}},
            {"stat", {EACCES}},
            {"fstat", {EIO}},
            {"access", {EACCES}},
            {"faccessat", {EACCES}},
            {"statfs", {EIO}},
            {"gethostname", {EPERM}},
            {"fcntl", {ENOLCK, EIO, ENOSYS, EOPNOTSUPP, EACCES}},
            {"fclose", {ENOMEM}}};

/* ---- places ---- */

typedef struct {
    uint64_t key;
    const char *call;
    failing_class class;
    long first, last; /* numbers of its calls in the run that watches, from 0 */
} call_place;

static struct {
    bool on, watches;
    long calls, fail_at;
    int way;
    bool failed;
    call_place *place;          /* of all runs so far */
    size_t count, room, before; /* before: those of earlier runs */
} each;

extern char __executable_start, etext;

bool failing_by_program(const void *caller)
{
    return (const char *)caller >= &__executable_start && (const char *)caller < &etext;
}

/* The call, its place, and the places of the calls that led to it: two, but one to HDF5, which
 * has most of them. */
__attribute__((noinline)) static uint64_t place_key(const char *call, failing_class class)
{
    enum { DEEP = 60, OURS = 4 /* this function, and those that led here */ };
    const int frames = OURS + (class == FAILING_HDF5 ? 2 : 3);
    void *frame[DEEP];
    uint64_t key = 14695981039346656037u;
    const int found = backtrace(frame, DEEP);
    for (const char *c = call; *c; c++) key = (key ^ (unsigned char)*c) * 1099511628211u;
    for (int f = 0, n = 0; f < found && n < frames; f++)
        if (failing_by_program(frame[f])) key = (key ^ (uintptr_t)frame[f]) * 1099511628211u, n++;
    return key;
}

__attribute__((noinline)) static void watch(const char *call, failing_class class, long number)
{
    const uint64_t key = place_key(call, class);
    for (size_t p = 0; p < each.count; p++)
        if (each.place[p].key == key) {
            each.place[p].last = number;
            return;
        }
    assert_int_equal(fracas_grow(&each.place, sizeof *each.place, each.count, &each.room, "places"),
                     FRACAS_OK);
    each.place[each.count++] = (call_place){key, call, class, number, number};
}

failing_verdict failing_call(failing_class class, const char *what, const char *on)
{
    (void)on;
    if (!each.on) return FAILING_NOT;
    const long number = each.calls++;
    if (each.watches) {
        each.on = false;
        watch(what, class, number);
        each.on = true;
    }
    if (number != each.fail_at) return FAILING_NOT;
    each.failed = true;
    return FAILING_NOW;
}

/* ---- the C library; these stand before its own functions ---- */

#define MISSES(class, what)                                                                \
    (failing_by_program(__builtin_return_address(0)) && failing_call(class, what, NULL) && \
     each.way != HALF && (errno = each.way == GONE ? ENOENT : each.way, true))

#define REAL(type, name, ...)         \
    static type (*real)(__VA_ARGS__); \
    if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name)

#define SYSTEM_CALL(type, name, parameters, types, arguments)           \
    type name parameters                                                \
    {                                                                   \
        REAL(type, name, types);                                        \
        return MISSES(FAILING_DISK, #name) ? (type)-1 : real arguments; \
    }
#define LIST(...) __VA_ARGS__
SYSTEM_CALL(int, fsync, (int fd), LIST(int), (fd))
SYSTEM_CALL(int, ftruncate, (int fd, off_t size), LIST(int, off_t), (fd, size))
SYSTEM_CALL(int, mkdir, (const char *path, mode_t mode), LIST(const char *, mode_t), (path, mode))
SYSTEM_CALL(int, rmdir, (const char *path), LIST(const char *), (path))
SYSTEM_CALL(int, link, (const char *from, const char *to), LIST(const char *, const char *),
            (from, to))
SYSTEM_CALL(int, rename, (const char *from, const char *to), LIST(const char *, const char *),
            (from, to))
SYSTEM_CALL(int, lstat, (const char *path, struct stat *info), LIST(const char *, struct stat *),
            (path, info))
SYSTEM_CALL(int, stat, (const char *path, struct stat *info), LIST(const char *, struct stat *),
            (path, info))
SYSTEM_CALL(int, fstat, (int fd, struct stat *info), LIST(int, struct stat *), (fd, info))
SYSTEM_CALL(int, access, (const char *path, int mode), LIST(const char *, int), (path, mode))
SYSTEM_CALL(int, faccessat, (int at, const char *path, int mode, int flags),
            LIST(int, const char *, int, int), (at, path, mode, flags))
SYSTEM_CALL(int, statfs, (const char *path, struct statfs *info),
            LIST(const char *, struct statfs *), (path, info))
SYSTEM_CALL(int, gethostname, (char *name, size_t size), LIST(char *, size_t), (name, size))
SYSTEM_CALL(int, scandir,
            (const char *folder, struct dirent ***list, int (*wanted)(const struct dirent *),
             int (*order)(const struct dirent **, const struct dirent **)),
            LIST(const char *, struct dirent ***, int (*)(const struct dirent *),
                 int (*)(const struct dirent **, const struct dirent **)),
            (folder, list, wanted, order))

/* GONE: it is, before the call says so. */
#define REMOVING_CALL(name, parameters, types, path, arguments)                         \
    int name parameters                                                                 \
    {                                                                                   \
        REAL(int, name, types);                                                         \
        const bool misses = MISSES(FAILING_DISK, #name);                                \
        const int reason = errno;                                                       \
        if (misses && each.way == GONE) (void)syscall(SYS_unlinkat, AT_FDCWD, path, 0); \
        errno = reason;                                                                 \
        return misses ? -1 : real arguments;                                            \
    }
REMOVING_CALL(unlink, (const char *path), LIST(const char *), path, (path))
REMOVING_CALL(remove, (const char *path), LIST(const char *), path, (path))

#define TRANSFER(name, buffer)                                                                     \
    ssize_t name(int fd, buffer bytes, size_t size, off_t at)                                      \
    {                                                                                              \
        REAL(ssize_t, name, int, buffer, size_t, off_t);                                           \
        const bool failed = each.failed;                                                           \
        if (MISSES(FAILING_DISK, #name)) return -1;                                                \
        return real(fd, bytes, !failed && each.failed && each.way == HALF ? (size + 1) / 2 : size, \
                    at);                                                                           \
    }
TRANSFER(pread, void *)
TRANSFER(pwrite, const void *)

int open(const char *path, int flags, ...)
{
    va_list more;
    REAL(int, open, const char *, int, ...);
    if (MISSES(FAILING_DISK, "open")) return -1;
    va_start(more, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(more, mode_t) : 0;
    va_end(more);
    return real(path, flags, mode);
}

int fcntl(int fd, int command, ...)
{
    va_list more;
    REAL(int, fcntl, int, int, ...);
    if (MISSES(FAILING_DISK, "fcntl")) return -1;
    va_start(more, command);
    void *argument = va_arg(more, void *); /* an int comes in the same register */
    va_end(more);
    return real(fd, command, argument);
}

/* ---- memory ---- */

#define ALLOCATOR(type, name, parameters, types, arguments)           \
    type name parameters                                              \
    {                                                                 \
        REAL(type, name, types);                                      \
        return MISSES(FAILING_MEMORY, #name) ? NULL : real arguments; \
    }
#undef strdup
#undef strndup
ALLOCATOR(char *, strdup, (const char *text), LIST(const char *), (text))
ALLOCATOR(char *, strndup, (const char *text, size_t size), LIST(const char *, size_t),
          (text, size))
ALLOCATOR(FILE *, fopen, (const char *path, const char *mode), LIST(const char *, const char *),
          (path, mode))
ALLOCATOR(FILE *, open_memstream, (char **text, size_t *size), LIST(char **, size_t *),
          (text, size))

int vasprintf(char **text, const char *format, va_list arguments)
{
    REAL(int, vasprintf, char **, const char *, va_list);
    return MISSES(FAILING_MEMORY, "vasprintf") ? -1 : real(text, format, arguments);
}

/* It closes the stream. */
int fclose(FILE *stream)
{
    REAL(int, fclose, FILE *);
    const bool misses = MISSES(FAILING_MEMORY, "fclose");
    const int reason = errno, result = real(stream);
    errno = reason;
    return misses ? EOF : result;
}

#ifndef __SANITIZE_ADDRESS__ /* which owns malloc */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

void *malloc(size_t size)
{
    return MISSES(FAILING_MEMORY, "malloc") ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return MISSES(FAILING_MEMORY, "calloc") ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size)
{
    return MISSES(FAILING_MEMORY, "realloc") ? NULL : __libc_realloc(old, size);
}
#endif

/* ---- runs ---- */

/* No call fails from here to the end of the block. */
#define EACH_LEAVES_OUT                                                        \
    __attribute__((cleanup(each_goes_on), unused)) bool each_was_on = each.on; \
    each.on = false

static void each_goes_on(const bool *was_on)
{
    each.on = *was_on;
}

/* Runs `work` and finds its places; the new ones stand from each.before on. */
static fracas_err each_watch(fracas_err (*work)(void))
{
    each.before = each.count;
    each.calls = 0;
    each.fail_at = -1;
    each.watches = each.on = true;
    const fracas_err err = work();
    each.watches = each.on = false;
    return err;
}

/* Runs `work` with its call `number` failing in this way. */
static fracas_err each_fail(fracas_err (*work)(void), long number, int way)
{
    each.calls = 0;
    each.fail_at = number;
    each.way = way;
    each.failed = false;
    each.on = true;
    const fracas_err err = work();
    each.on = false;
    return err;
}

/* *way: the n-th of this call; false if it has none. */
static bool each_way(const call_place *place, size_t n, int *way)
{
    *way = place->class == FAILING_MEMORY ? ENOMEM : 0;
    for (size_t w = 0; w < sizeof ways / sizeof *ways; w++)
        if (strcmp(ways[w].name, place->call) == 0) {
            *way = n < MOST_WAYS ? ways[w].way[n] : 0;
            return *way != 0;
        }
    return n == 0;
}

#endif
