/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A shared object that is loaded into `fracas` (LD_PRELOAD), and by it into mpirun and ranks: it
 * adds every change of files below one folder to a log, in one order for all processes.
 *
 *   DISK_LOG      a log with its head (power_loss begin)
 *   DISK_ROOT     the folder: a path without links
 *   DISK_SWALLOW  an fsync of a path like this pattern (fnmatch) does nothing: a fault
 *   DISK_NETWORK  set: all filesystems are of the network
 *
 * A seccomp filter stops the calls, whoever makes them: C library, SQLite, HDF5. After each COMMIT
 * of the index a promise follows: one line for each row that is done or failed, one for the seal of
 * study.h5. index.sqlite-shm is left out: SQLite makes it anew. */
#include "tests/support/disk_log.h"
#include "tests/support/own_calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fnmatch.h>
#include <limits.h>
#include <linux/magic.h>
#include <sched.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <sys/vfs.h>
#include <ucontext.h>
#include <unistd.h>

static disk_log_head *head; /* NULL: nothing is recorded */
static int file = -1;
static const char *root, *swallowed;

/* ---- the log ---- */

static void take(void)
{
    const uint32_t self = (uint32_t)really(SYS_gettid, 0, 0, 0, 0, 0);
    for (uint64_t tries = 1;; tries++) {
        uint32_t owner = 0;
        if (__atomic_compare_exchange_n(&head->owner, &owner, self, false, __ATOMIC_SEQ_CST,
                                        __ATOMIC_SEQ_CST))
            return;
        if (tries % 100000 == 0 && really(SYS_kill, owner, 0, 0, 0, 0) == -ESRCH) /* killed */
            __atomic_compare_exchange_n(&head->owner, &owner, 0, false, __ATOMIC_SEQ_CST,
                                        __ATOMIC_SEQ_CST);
        really(SYS_sched_yield, 0, 0, 0, 0, 0);
    }
}

static void leave(void)
{
    __atomic_store_n(&head->owner, 0, __ATOMIC_SEQ_CST);
}

static void put(uint64_t *at, const void *bytes, size_t size)
{
    for (size_t put = 0; put < size;) {
        const long more = really(SYS_pwrite64, file, (long)bytes + (long)put, (long)(size - put),
                                 (long)*at, 0);
        if (more <= 0) _exit(77);
        put += (size_t)more;
        *at += (uint64_t)more;
    }
}

/* With the log taken. Up to two names. */
static void add(disk_entry entry, const char *name, const char *other, const void *bytes)
{
    uint64_t at = head->end;
    const size_t first = name ? strlen(name) + 1 : 0, second = other ? strlen(other) + 1 : 0;
    entry.pid = (uint32_t)really(SYS_getpid, 0, 0, 0, 0, 0);
    entry.text = (uint32_t)(first + second);
    put(&at, &entry, sizeof entry);
    if (first) put(&at, name, first);
    if (second) put(&at, other, second);
    if (entry.size) put(&at, bytes, entry.size);
    head->end = at;
}

/* ---- places ---- */

/* The path of an open file; false if it is not below the folder. */
static bool path_of(long fd, char path[PATH_MAX])
{
    char link[32] = "/proc/self/fd/", digits[16];
    int n = 0;
    size_t at = strlen(link);
    if (fd < 0) return false;
    for (long d = fd; d > 0 || n == 0; d /= 10) digits[n++] = (char)('0' + d % 10);
    while (n > 0) link[at++] = digits[--n];
    link[at] = '\0';
    const long size = really(SYS_readlink, (long)link, (long)path, PATH_MAX - 1, 0, 0);
    path[size > 0 ? size : 0] = '\0';
    const size_t length = strlen(root);
    return strncmp(path, root, length) == 0 && (path[length] == '/' || path[length] == '\0');
}

static bool is_shared_memory(const char *path)
{
    const char *end = strstr(path, "-shm");
    return end && (!end[4] || end[4] == ' ');
}

/* The path of a recorded file. */
static bool is_recorded(long fd, char path[PATH_MAX])
{
    return path_of(fd, path) && !is_shared_memory(path);
}

static uint64_t node_of(long fd)
{
    struct stat info;
    return really(SYS_fstat, fd, (long)&info, 0, 0, 0) < 0 ? 0 : info.st_ino;
}

/* A path of a call: its folder, and the name in it. */
typedef struct {
    uint64_t folder, node; /* 0: not there */
    bool ours;
    char name[NAME_MAX + 1];
} place;

static place look(long at, const char *path)
{
    place p = {0};
    char folder[PATH_MAX] = ".", whole[PATH_MAX];
    const char *slash = path ? strrchr(path, '/') : NULL, *name = slash ? slash + 1 : path;
    struct stat info;
    if (!path || strlen(path) >= PATH_MAX || strlen(name) > NAME_MAX || !*name) return p;
    if (slash) {
        const size_t length = slash == path ? 1 : (size_t)(slash - path);
        memcpy(folder, path, length);
        folder[length] = '\0';
    }
    strcpy(p.name, name);
    const long fd = really(SYS_openat, at, (long)folder, O_PATH | O_DIRECTORY | O_CLOEXEC, 0, 0);
    if (fd < 0) return p;
    p.ours = path_of(fd, whole) && !is_shared_memory(name);
    p.folder = node_of(fd);
    if (really(SYS_newfstatat, fd, (long)name, (long)&info, AT_SYMLINK_NOFOLLOW, 0) == 0)
        p.node = info.st_ino;
    really(SYS_close, fd, 0, 0, 0, 0);
    return p;
}

/* ---- calls ---- */

typedef struct {
    long number, a[6];
} call;

static long go_on(const call *c)
{
    return really(c->number, c->a[0], c->a[1], c->a[2], c->a[3], c->a[4]);
}

/* The model does not know this call on a file below the folder. */
static long unknown(const call *c, const char *name)
{
    take();
    add((disk_entry){.kind = DISK_UNKNOWN, .at = (uint64_t)c->number}, name, NULL, NULL);
    leave();
    return go_on(c);
}

static long opens(const call *c, long at, const char *path, long flags)
{
    take();
    const place p = look(at, path);
    const long fd = go_on(c);
    if (fd >= 0 && p.ours && !p.node)
        add((disk_entry){.kind = DISK_CREATE, .node = node_of(fd), .folder = p.folder}, p.name,
            NULL, NULL);
    else if (fd >= 0 && p.ours && (flags & O_TRUNC))
        add((disk_entry){.kind = DISK_TRUNCATE, .node = node_of(fd)}, NULL, NULL, NULL);
    leave();
    return fd;
}

static long writes(const call *c)
{
    char path[PATH_MAX];
    if (!is_recorded(c->a[0], path)) return go_on(c);
    take();
    const long size = go_on(c);
    uint64_t at = (uint64_t)c->a[3];
    if (c->number == SYS_write)
        at = (uint64_t)(really(SYS_lseek, c->a[0], 0, SEEK_CUR, 0, 0) - size);
    if (size > 0)
        add(
            (disk_entry){
                .kind = DISK_WRITE, .node = node_of(c->a[0]), .at = at, .size = (uint32_t)size},
            NULL, NULL, (const void *)c->a[1]);
    leave();
    return size;
}

static long syncs(const call *c)
{
    char path[PATH_MAX];
    if (!is_recorded(c->a[0], path)) return go_on(c);
    if (swallowed && fnmatch(swallowed, path, 0) == 0) return 0;
    take();
    const long result = go_on(c);
    if (result == 0)
        add((disk_entry){.kind = DISK_SYNC, .node = node_of(c->a[0])}, NULL, NULL, NULL);
    leave();
    return result;
}

static long truncates(const call *c)
{
    char path[PATH_MAX];
    if (!is_recorded(c->a[0], path)) return go_on(c);
    take();
    const long result = go_on(c);
    if (result == 0)
        add((disk_entry){.kind = DISK_TRUNCATE, .node = node_of(c->a[0]), .at = (uint64_t)c->a[1]},
            NULL, NULL, NULL);
    leave();
    return result;
}

static long renames(const call *c, long from_at, long from_path, long to_at, long to_path)
{
    take();
    const place from = look(from_at, (const char *)from_path);
    const place to = look(to_at, (const char *)to_path);
    const long result = go_on(c);
    if (result == 0 && (from.ours || to.ours))
        add(
            (disk_entry){
                .kind = DISK_RENAME, .node = from.node, .folder = from.folder, .other = to.folder},
            from.name, to.name, NULL);
    leave();
    return result;
}

static long links(const call *c)
{
    const bool plain = c->number == SYS_link;
    take();
    const place from = look(plain ? AT_FDCWD : c->a[0], (const char *)c->a[plain ? 0 : 1]);
    const place to = look(plain ? AT_FDCWD : c->a[2], (const char *)c->a[plain ? 1 : 3]);
    const long result = go_on(c);
    if (result == 0 && to.ours)
        add((disk_entry){.kind = DISK_LINK, .node = from.node, .folder = to.folder}, to.name, NULL,
            NULL);
    leave();
    return result;
}

static long removes(const call *c, long at, long path)
{
    take();
    const place p = look(at, (const char *)path);
    const long result = go_on(c);
    if (result == 0 && p.ours)
        add((disk_entry){.kind = DISK_REMOVE, .node = p.node, .folder = p.folder}, p.name, NULL,
            NULL);
    leave();
    return result;
}

static long makes_folder(const call *c, long at, long path)
{
    take();
    const long result = go_on(c);
    const place p = look(at, (const char *)path);
    if (result == 0 && p.ours)
        add((disk_entry){.kind = DISK_MKDIR, .node = p.node, .folder = p.folder}, p.name, NULL,
            NULL);
    leave();
    return result;
}

/* Calls by a descriptor that the model does not have. Those of six arguments have no room for our
 * mark: whoever wants them does without. */
static long others(const call *c)
{
    char path[PATH_MAX];
    if (c->number == SYS_copy_file_range || c->number == SYS_pwritev2) return -ENOSYS;
    return is_recorded(c->a[0], path) ? unknown(c, path) : go_on(c);
}

/* Calls by a path, unknown to the model. */
static long others_by_path(const call *c, long at, long path)
{
    const place p = look(at, (const char *)path);
    return p.ours ? unknown(c, p.name) : go_on(c);
}

static long answer(const call *c)
{
    const long *a = c->a;
    switch (c->number) {
    case SYS_open: return opens(c, AT_FDCWD, (const char *)a[0], a[1]);
    case SYS_creat: return opens(c, AT_FDCWD, (const char *)a[0], O_TRUNC);
    case SYS_openat: return opens(c, a[0], (const char *)a[1], a[2]);
    case SYS_write:
    case SYS_pwrite64: return writes(c);
    case SYS_fsync:
    case SYS_fdatasync: return syncs(c);
    case SYS_ftruncate: return truncates(c);
    case SYS_rename: return renames(c, AT_FDCWD, a[0], AT_FDCWD, a[1]);
    case SYS_renameat:
    case SYS_renameat2: return renames(c, a[0], a[1], a[2], a[3]);
    case SYS_link:
    case SYS_linkat: return links(c);
    case SYS_unlink:
    case SYS_rmdir: return removes(c, AT_FDCWD, a[0]);
    case SYS_unlinkat: return removes(c, a[0], a[1]);
    case SYS_mkdir: return makes_folder(c, AT_FDCWD, a[0]);
    case SYS_mkdirat: return makes_folder(c, a[0], a[1]);
    case SYS_truncate: return others_by_path(c, AT_FDCWD, a[0]);
    case SYS_symlink: return others_by_path(c, AT_FDCWD, a[1]);
    case SYS_symlinkat: return others_by_path(c, a[1], a[2]);
    default: return others(c);
    }
}

static const int by_number[] = {
    SYS_creat,     SYS_write,    SYS_pwrite64, SYS_fsync,           SYS_fdatasync,
    SYS_ftruncate, SYS_rename,   SYS_renameat, SYS_renameat2,       SYS_link,
    SYS_linkat,    SYS_unlink,   SYS_unlinkat, SYS_rmdir,           SYS_mkdir,
    SYS_mkdirat,   SYS_truncate, SYS_symlink,  SYS_symlinkat,       SYS_fallocate,
    SYS_writev,    SYS_pwritev,  SYS_pwritev2, SYS_copy_file_range, SYS_sendfile};
enum { NCALLS = sizeof by_number / sizeof *by_number };

static void on_call(int signal_number, siginfo_t *info, void *context)
{
    (void)signal_number;
    greg_t *r = ((ucontext_t *)context)->uc_mcontext.gregs;
    const call c = {info->si_syscall,
                    {r[REG_RDI], r[REG_RSI], r[REG_RDX], r[REG_R10], r[REG_R8], r[REG_R9]}};
    const int kept = errno;
    r[REG_RAX] = head ? answer(&c) : go_on(&c);
    errno = kept;
}

/* mpirun would handle our signal itself. */
int sigaction(int number, const struct sigaction *action, struct sigaction *before)
{
    static int (*real)(int, const struct sigaction *, struct sigaction *);
    if (!real)
        real = (int (*)(int, const struct sigaction *, struct sigaction *))dlsym(RTLD_NEXT,
                                                                                 "sigaction");
    return head && number == SIGSYS ? 0 : real(number, action, before);
}

/* No signal comes between a call and its entry. */
static void handle_calls(void)
{
    struct sigaction action = {.sa_sigaction = on_call, .sa_flags = SA_SIGINFO | SA_RESTART};
    sigfillset(&action.sa_mask);
    sigaction(SIGSYS, &action, NULL);
}

/* Only opening that changes something: a program that starts loads its libraries before it handles
 * the signal. */
static void watch_calls(void)
{
    enum { OPENS = 6, CHANGES = O_CREAT | O_TRUNC };
    struct sock_filter filter[1 + NCALLS + OPENS + OWN_TAIL];
    size_t n = 0;
    const struct sock_filter opening[OPENS] = {
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_openat, 0, 2),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[2])),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CHANGES, 4, 3),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_open, 0, 2),
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(struct seccomp_data, args[1])),
        BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K, CHANGES, 1, 0)};
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                                               offsetof(struct seccomp_data, nr));
    for (size_t c = 0; c < NCALLS; c++) /* to the second line of the tail */
        filter[n++] = (struct sock_filter)BPF_JUMP(
            BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)by_number[c], (uint8_t)(NCALLS - c + OPENS), 0);
    memcpy(&filter[n], opening, sizeof opening);
    n += OPENS;
    own_tail(&filter[n]);
    if (!own_install(filter, n + OWN_TAIL)) {
        perror("disk_recorder: no seccomp filter");
        _exit(77);
    }
}

/* ---- beside the calls ---- */

/* Memory of a file, visible to others. */
void *mmap64(void *at, size_t size, int rights, int flags, int fd, off_t offset)
    __attribute__((alias("mmap")));
void *mmap(void *at, size_t size, int rights, int flags, int fd, off_t offset)
{
    char path[PATH_MAX];
    static void *(*real)(void *, size_t, int, int, int, off_t);
    if (!real) real = (void *(*)(void *, size_t, int, int, int, off_t))dlsym(RTLD_NEXT, "mmap");
    if (head && (flags & MAP_SHARED) && (rights & PROT_WRITE) && is_recorded(fd, path)) {
        take();
        add((disk_entry){.kind = DISK_UNKNOWN, .at = SYS_mmap}, path, NULL, NULL);
        leave();
    }
    return real(at, size, rights, flags, fd, offset);
}

/* A thread blocking our signal would die of it: Open MPI's block all. */
int pthread_sigmask(int how, const sigset_t *given, sigset_t *before)
{
    static int (*real)(int, const sigset_t *, sigset_t *);
    if (!real)
        real = (int (*)(int, const sigset_t *, sigset_t *))dlsym(RTLD_NEXT, "pthread_sigmask");
    sigset_t mask;
    if (!given || how == SIG_UNBLOCK) return real(how, given, before);
    mask = *given;
    sigdelset(&mask, SIGSYS);
    return real(how, &mask, before);
}

int sigprocmask(int how, const sigset_t *given, sigset_t *before)
{
    const int code = pthread_sigmask(how, given, before);
    if (code) errno = code;
    return code ? -1 : 0;
}

int statfs(const char *path, struct statfs *info)
{
    const int code = (int)syscall(SYS_statfs, path, info);
    if (code == 0 && getenv("DISK_NETWORK")) info->f_type = NFS_SUPER_MAGIC;
    return code;
}

static int (*step)(sqlite3_stmt *statement);

/* Adds the lines of a query to a text; false without memory. */
static bool collect(sqlite3 *db, const char *query, char **text)
{
    sqlite3_stmt *rows = NULL;
    bool good = sqlite3_prepare_v2(db, query, -1, &rows, NULL) == SQLITE_OK;
    while (good && step(rows) == SQLITE_ROW) {
        char *longer = NULL;
        good = asprintf(&longer, "%s%s\n", *text, (const char *)sqlite3_column_text(rows, 0)) > 0;
        if (!good) break;
        free(*text);
        *text = longer;
    }
    sqlite3_finalize(rows);
    return good;
}

static void promise(sqlite3 *db, const char *path)
{
    char *text = strdup("");
    if (collect(
            db,
            "SELECT p.hash || ' ' || r.replica || ' ' || r.status FROM realization r JOIN point "
            "p ON p.id = r.point WHERE r.status IN ('done', 'failed')",
            &text) &&
        collect(db, "SELECT 'study.h5 ' || value FROM meta WHERE key LIKE 'study%'", &text)) {
        take();
        add((disk_entry){.kind = DISK_PROMISE}, text, path, NULL);
        leave();
    }
    free(text);
}

/* The path of an index from the folder on; NULL: of none, or one that grows beside it. */
static const char *index_of(sqlite3 *db, char found[PATH_MAX])
{
    const char *path = sqlite3_db_filename(db, "main");
    const size_t length = strlen(root);
    const bool is = path && realpath(path, found) && strncmp(found, root, length) == 0 &&
                    strstr(found, "/index.sqlite") && !strstr(found, "/.reindex/");
    return is ? found + length + 1 : NULL;
}

int sqlite3_step(sqlite3_stmt *statement)
{
    if (!step) step = (int (*)(sqlite3_stmt *))dlsym(RTLD_NEXT, "sqlite3_step");
    const int code = step(statement);
    sqlite3 *db = sqlite3_db_handle(statement);
    const char *text = sqlite3_sql(statement);
    if (!head || code != SQLITE_DONE || !sqlite3_get_autocommit(db) || !text) return code;
    if (strncmp(text, "COMMIT", 6) != 0 && sqlite3_stmt_readonly(statement)) return code;
    char found[PATH_MAX];
    const char *path = index_of(db, found);
    if (path) promise(db, path);
    return code;
}

/* ---- start ---- */

__attribute__((constructor)) static void start(void)
{
    const char *log = getenv("DISK_LOG"), *filtered = getenv("DISK_FILTERED");
    root = getenv("DISK_ROOT");
    swallowed = getenv("DISK_SWALLOW");
    if (!log || !root) return;
    handle_calls(); /* the filter outlives exec, the handler does not */
    file = open(log, O_RDWR | O_CLOEXEC);
    void *mapped = file < 0 ? MAP_FAILED
                            : (void *)syscall(SYS_mmap, NULL, sizeof *head, PROT_READ | PROT_WRITE,
                                              MAP_SHARED, file, 0);
    if (mapped == MAP_FAILED) {
        perror(log);
        _exit(77);
    }
    head = mapped;
    if (!filtered) {
        setenv("DISK_FILTERED", "1", 1);
        watch_calls();
    }
    take();
    add((disk_entry){.kind = DISK_BEGIN}, program_invocation_short_name, NULL, NULL);
    leave();
}
