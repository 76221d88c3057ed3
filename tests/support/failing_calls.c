/* SPDX-License-Identifier: GPL-3.0-or-later */
/* System calls, allocations, processes and MPI; failing_libraries.c has SQLite and HDF5. */
#include "tests/support/failing_calls.h"
#include "tests/support/own_calls.h"

#include <dirent.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <fcntl.h>
#include <mpi.h>
#include <poll.h>
#include <sched.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/wait.h>
#include <ucontext.h>
#include <unistd.h>

static const char *const class_name[FAILING_NCLASSES] = {
    "disk", "read", "sqlite", "hdf5", "mpi", "memory", "process", "wait", "system"};
static const struct {
    const char *name;
    int code;
} errors[] = {{"EIO", EIO},       {"ENOSPC", ENOSPC}, {"EDQUOT", EDQUOT}, {"ENOMEM", ENOMEM},
              {"EAGAIN", EAGAIN}, {"EMFILE", EMFILE}, {"EINTR", EINTR}};

static failing_state *state; /* NULL: nothing is counted */
static failing_class wanted;
static int where, wanted_where; /* failing_state.count */
static uint64_t wanted_at, wanted_site;
static int error;
static bool kills, tears, is_late, is_short, by_site;
static const char *under;

static void die(void)
{
    kill(getpid(), SIGKILL);
    for (;;) pause();
}

/* "what on", cut to fit; without allocating, for this is called from malloc and from a signal
 * handler. */
static void note(const char *what, const char *on)
{
    size_t at = 0;
    for (const char *c = what; *c && at < sizeof state->failed - 2; c++) state->failed[at++] = *c;
    if (on) state->failed[at++] = ' ';
    for (const char *c = on; c && *c && at < sizeof state->failed - 1; c++)
        state->failed[at++] = *c;
    state->failed[at] = '\0';
}

/* The place in the program that calls: its innermost return addresses, so that a function that
 * many call is many places. 0: none. */
static uint64_t site_of_call(void)
{
    enum { INNERMOST = 3, FRAMES = 32 };
    void *frame[FRAMES];
    const int n = backtrace(frame, FRAMES);
    uint64_t key = 0;
    for (int i = 0, found = 0; i < n && found < INNERMOST; i++)
        if (failing_by_program(frame[i])) {
            key = (key ^ failing_in_program(frame[i])) * 0x100000001b3 + 1;
            found++;
        }
    return key;
}

/* How often this place has called now; the first call enters it. */
static uint64_t count_at(uint64_t key)
{
    for (size_t at = key % FAILING_SITES, n = 0; n < FAILING_SITES;
         at = (at + 1) % FAILING_SITES, n++) {
        uint64_t found = 0;
        if (__atomic_compare_exchange_n(&state->site[at].key, &found, key, false, __ATOMIC_SEQ_CST,
                                        __ATOMIC_SEQ_CST) ||
            found == key)
            return __atomic_add_fetch(&state->site[at].count, 1, __ATOMIC_SEQ_CST);
    }
    return 0;
}

/* Counts; true if this is the call. */
static bool is_it(failing_class class, const char *what, const char *on)
{
    if (!state) return false;
    uint64_t number = __atomic_add_fetch(&state->count[where][class], 1, __ATOMIC_SEQ_CST);
    if (class != wanted || where != wanted_where) return false;
    if (by_site) {
        const uint64_t site = site_of_call();
        number = site ? count_at(site) : 0;
        if (site != wanted_site) return false;
    }
    if (number != wanted_at) return false;
    note(what, on);
    return true;
}

failing_verdict failing_call(failing_class class, const char *what, const char *on)
{
    if (!is_it(class, what, on)) return FAILING_NOT;
    if (kills) die();
    return is_late ? FAILING_LATE : FAILING_NOW;
}

/* ---- system calls ---- */

/* Where the path or the descriptor of a call is among its arguments. */
typedef enum { PATH0, PATH1, PATH2, PATH3, FD } about;
static const struct {
    int number;
    const char *name;
    about about;
    bool takes_space;
} calls[] = {{SYS_open, "open", PATH0, true},         {SYS_openat, "open", PATH1, true},
             {SYS_creat, "open", PATH0, true},        {SYS_write, "write", FD, true},
             {SYS_pwrite64, "write", FD, true},       {SYS_ftruncate, "ftruncate", FD, true},
             {SYS_fallocate, "fallocate", FD, true},  {SYS_mkdir, "mkdir", PATH0, true},
             {SYS_mkdirat, "mkdir", PATH1, true},     {SYS_fsync, "fsync", FD, false},
             {SYS_fdatasync, "fdatasync", FD, false}, {SYS_close, "close", FD, false},
             {SYS_rename, "rename", PATH1, false},    {SYS_renameat, "rename", PATH3, false},
             {SYS_renameat2, "rename", PATH3, false}, {SYS_unlink, "unlink", PATH0, false},
             {SYS_unlinkat, "unlink", PATH1, false},  {SYS_read, "read", FD, false},
             {SYS_pread64, "read", FD, false}};
enum { NCALLS = sizeof calls / sizeof *calls };

static bool in_study(about at_place, const long argument[6], char path[512])
{
    path[0] = '\0';
    if (at_place == FD) {
        char link[32] = "/proc/self/fd/", digits[16];
        int n = 0;
        size_t at = strlen(link);
        if (argument[0] < 0) return false;
        for (long fd = argument[0]; fd > 0 || n == 0; fd /= 10) digits[n++] = (char)('0' + fd % 10);
        while (n > 0) link[at++] = digits[--n];
        link[at] = '\0';
        const long size = really(SYS_readlink, (long)link, (long)path, 511, 0, 0);
        path[size > 0 ? size : 0] = '\0';
    } else {
        const char *given = (const char *)argument[at_place - PATH0];
        size_t n = given ? strnlen(given, 511) : 0;
        memcpy(path, given, n);
        path[n] = '\0';
    }
    return strstr(path, under);
}

static failing_class class_of(size_t c, const long argument[6])
{
    const int number = calls[c].number;
    if (number == SYS_read || number == SYS_pread64) return FAILING_READ;
    if (number == SYS_open || number == SYS_openat) {
        const long flags = argument[number == SYS_open ? 1 : 2];
        return (flags & O_ACCMODE) == O_RDONLY && !(flags & O_CREAT) ? FAILING_READ : FAILING_DISK;
    }
    return FAILING_DISK;
}

static long answer(size_t c, const long argument[6])
{
    const long number = calls[c].number;
    char path[512];
    if (!in_study(calls[c].about, argument, path))
        return really(number, argument[0], argument[1], argument[2], argument[3], argument[4]);
    const failing_class class = class_of(c, argument);
    const bool takes_space = calls[c].takes_space && class == FAILING_DISK;
    if (is_it(class, calls[c].name, path)) {
        const bool writes = number == SYS_write || number == SYS_pwrite64;
        if (tears && writes)
            really(number, argument[0], argument[1], argument[2] / 2, argument[3], argument[4]);
        if (kills || tears) die();
        if (error == ENOSPC && takes_space) state->full = 1;
        if (number == SYS_close || is_late)
            really(number, argument[0], argument[1], argument[2], argument[3], argument[4]);
        return -error;
    }
    if (state->full && takes_space) return -ENOSPC;
    return really(number, argument[0], argument[1], argument[2], argument[3], argument[4]);
}

static void on_call(int signal_number, siginfo_t *info, void *context)
{
    (void)signal_number;
    greg_t *r = ((ucontext_t *)context)->uc_mcontext.gregs;
    const long argument[6] = {r[REG_RDI], r[REG_RSI], r[REG_RDX], r[REG_R10], r[REG_R8], r[REG_R9]};
    const int kept = errno;
    for (size_t c = 0; c < NCALLS; c++)
        if (calls[c].number == info->si_syscall) r[REG_RAX] = answer(c, argument);
    errno = kept;
}

/* Every call of the list becomes a SIGSYS, unless it is ours. */
static void watch_calls(void)
{
    enum { HEAD = 1 };
    struct sock_filter filter[HEAD + NCALLS + OWN_TAIL];
    size_t n = 0;
    filter[n++] = (struct sock_filter)BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                                               offsetof(struct seccomp_data, nr));
    for (size_t c = 0; c < NCALLS; c++) /* to the second line of the tail */
        filter[n++] = (struct sock_filter)BPF_JUMP(
            BPF_JMP | BPF_JEQ | BPF_K, (uint32_t)calls[c].number, (uint8_t)(NCALLS - c), 0);
    own_tail(&filter[n]);
    struct sigaction action = {.sa_sigaction = on_call,
                               .sa_flags = SA_SIGINFO | SA_NODEFER | SA_RESTART};
    sigemptyset(&action.sa_mask);
    sigaction(SIGSYS, &action, NULL);
    if (!own_install(filter, n + OWN_TAIL)) {
        perror("failing_calls: no seccomp filter");
        _exit(77);
    }
}

/* ---- allocations ---- */

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);

/* Code whose allocations are ours to survive. Those of Open MPI and UDUNITS-2 are not: they crash
 * by themselves without memory. So does HDF5 1.10 at times: a parent tells of it, but nobody would
 * of a crash of the parent. */
static struct {
    uintptr_t from, to;
} code[32]; /* the program's first: it is mapped lowest */
static size_t ncode;

static void find_code(void)
{
    static const char *const owner[] = {"/fracas",  "/libhdf5",   "/libsqlite3",
                                        "/libyaml", "/libxxhash", "/libgsl."};
    char line[1024];
    FILE *maps = fopen("/proc/self/maps", "r");
    while (maps && fgets(line, sizeof line, maps)) {
        char rights[8];
        uintptr_t from, to;
        if (sscanf(line, "%lx-%lx %7s", &from, &to, rights) != 3 || rights[2] != 'x') continue;
        for (size_t o = 0; o < sizeof owner / sizeof *owner; o++) {
            const bool left_out = by_site ? o > 0 : where == 0 && strcmp(owner[o], "/libhdf5") == 0;
            if (ncode == sizeof code / sizeof *code || left_out || !strstr(line, owner[o]))
                continue;
            code[ncode].from = from;
            code[ncode++].to = to;
            break;
        }
    }
    if (maps) fclose(maps);
}

static bool is_ours(const void *caller)
{
    for (size_t c = 0; c < ncode; c++)
        if ((uintptr_t)caller >= code[c].from && (uintptr_t)caller < code[c].to) return true;
    return false;
}

bool failing_by_program(const void *caller)
{
    return ncode > 0 && (uintptr_t)caller >= code[0].from && (uintptr_t)caller < code[0].to;
}

uint64_t failing_in_program(const void *caller)
{
    return (uintptr_t)caller - code[0].from;
}

static bool no_memory(const char *what, const void *caller)
{
    if (!state || !is_ours(caller) || !failing_call(FAILING_MEMORY, what, NULL)) return false;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size)
{
    return no_memory("malloc", __builtin_return_address(0)) ? NULL : __libc_malloc(size);
}
void *calloc(size_t count, size_t size)
{
    return no_memory("calloc", __builtin_return_address(0)) ? NULL : __libc_calloc(count, size);
}
void *realloc(void *old, size_t size)
{
    return no_memory("realloc", __builtin_return_address(0)) ? NULL : __libc_realloc(old, size);
}

/* Those of the C library that allocate for their caller. */
#define REAL(type, name, ...)         \
    static type (*real)(__VA_ARGS__); \
    if (!real) real = (type(*)(__VA_ARGS__))dlsym(RTLD_NEXT, #name)

#undef strdup
char *strdup(const char *text)
{
    REAL(char *, strdup, const char *);
    return no_memory("strdup", __builtin_return_address(0)) ? NULL : real(text);
}

FILE *fopen(const char *path, const char *mode)
{
    REAL(FILE *, fopen, const char *, const char *);
    return no_memory("fopen", __builtin_return_address(0)) ? NULL : real(path, mode);
}

FILE *open_memstream(char **text, size_t *size)
{
    REAL(FILE *, open_memstream, char **, size_t *);
    return no_memory("open_memstream", __builtin_return_address(0)) ? NULL : real(text, size);
}

/* ---- processes ---- */

static void be_rank(int rank)
{
    if (rank >= FAILING_RANKS) state = NULL;
    if (!state) return;
    where = 1 + rank * FAILING_DEPTHS;
    ncode = 0;
    find_code();
    watch_calls();
}

static bool no_process(const char *what, int code_of)
{
    if (!failing_call(FAILING_PROCESS, what, NULL)) return false;
    errno = code_of;
    return true;
}

pid_t fork(void)
{
    REAL(pid_t, fork, void);
    if (no_process("fork", EAGAIN)) return -1;
    const pid_t pid = real();
    if (pid == 0 && where > 0 && where < FAILING_STARTER &&
        (where - 1) % FAILING_DEPTHS < FAILING_DEPTHS - 1)
        where++;
    return pid;
}

/* The parent's starter and its ranks are known by their names. */
int prctl(int option, ...)
{
    static int (*real)(int, ...);
    if (!real) real = (int (*)(int, ...))dlsym(RTLD_NEXT, "prctl");
    unsigned long argument[4];
    int rank;
    va_list arguments;
    va_start(arguments, option);
    for (size_t a = 0; a < 4; a++) argument[a] = va_arg(arguments, unsigned long);
    va_end(arguments);
    const char *name = option == PR_SET_NAME ? (const char *)argument[0] : "";
    if (strcmp(name, "fracas-starter") == 0) where = FAILING_STARTER;
    if (sscanf(name, "fracas-rank-%d", &rank) == 1) be_rank(rank);
    return real(option, argument[0], argument[1], argument[2], argument[3]);
}

int pipe2(int fd[2], int flags)
{
    REAL(int, pipe2, int[2], int);
    return no_process("pipe2", EMFILE) ? -1 : real(fd, flags);
}

int socketpair(int domain, int type, int protocol, int fd[2])
{
    REAL(int, socketpair, int, int, int, int[2]);
    return no_process("socketpair", EMFILE) ? -1 : real(domain, type, protocol, fd);
}

/* ---- calls that wait, and others that the system may refuse ---- */

/* Of the program's own calls: 0, the error, or SHORT. */
enum { SHORT = -1 };
enum { MAY_WAIT = 1, MAY_FAIL = 2, MAY = MAY_WAIT | MAY_FAIL };
static int refusal(int may, const char *what, const void *caller)
{
    if (!state || !failing_by_program(caller)) return 0;
    if ((may & MAY_WAIT) && failing_call(FAILING_WAIT, what, NULL)) return is_short ? SHORT : EINTR;
    return (may & MAY_FAIL) && failing_call(FAILING_SYSTEM, what, NULL) ? error : 0;
}

/* `bad` is what it returns then; `shorten` what a short call does first. */
#define REFUSED(may, type, bad, name, parameters, arguments, shorten)     \
    type name parameters                                                  \
    {                                                                     \
        static type(*real) parameters;                                    \
        if (!real) real = (type(*) parameters)dlsym(RTLD_NEXT, #name);    \
        const int why = refusal(may, #name, __builtin_return_address(0)); \
        if (why > 0) return errno = why, bad;                             \
        if (why == SHORT) {                                               \
            shorten;                                                      \
        }                                                                 \
        return real arguments;                                            \
    }
#define HALF(size) size -= size / 2
REFUSED(MAY, ssize_t, -1, read, (int fd, void *to, size_t size), (fd, to, size), HALF(size))
REFUSED(MAY, ssize_t, -1, write, (int fd, const void *from, size_t size), (fd, from, size),
        HALF(size))
REFUSED(MAY, ssize_t, -1, send, (int fd, const void *from, size_t size, int flags),
        (fd, from, size, flags), HALF(size))
REFUSED(MAY, ssize_t, -1, sendmsg, (int fd, const struct msghdr *from, int flags),
        (fd, from, flags), )
REFUSED(MAY, ssize_t, -1, recvmsg, (int fd, struct msghdr *to, int flags), (fd, to, flags), )
REFUSED(MAY, int, -1, poll, (struct pollfd * of, nfds_t n, int wait), (of, n, wait), )
REFUSED(MAY, int, -1, ppoll,
        (struct pollfd * of, nfds_t n, const struct timespec *wait, const sigset_t *mask),
        (of, n, wait, mask), )
REFUSED(MAY_WAIT, int, -1, sigwaitinfo, (const sigset_t *of, siginfo_t *info), (of, info), )
REFUSED(MAY_WAIT, pid_t, -1, waitpid, (pid_t pid, int *status, int how), (pid, status, how), )
REFUSED(MAY_WAIT, int, -1, waitid, (idtype_t what, id_t id, siginfo_t *info, int how),
        (what, id, info, how), )
REFUSED(MAY_FAIL, ssize_t, -1, pread, (int fd, void *to, size_t size, off_t at),
        (fd, to, size, at), )
REFUSED(MAY_FAIL, ssize_t, -1, readlink, (const char *path, char *to, size_t size),
        (path, to, size), )
REFUSED(MAY_FAIL, DIR *, NULL, opendir, (const char *path), (path), )
REFUSED(MAY_FAIL, char *, NULL, mkdtemp, (char *path), (path), )
REFUSED(MAY_FAIL, int, -1, statvfs, (const char *path, struct statvfs *info), (path, info), )
REFUSED(MAY_FAIL, int, -1, stat, (const char *path, struct stat *info), (path, info), )
REFUSED(MAY_FAIL, int, -1, lstat, (const char *path, struct stat *info), (path, info), )
REFUSED(MAY_FAIL, int, -1, fstat, (int fd, struct stat *info), (fd, info), )
REFUSED(MAY_FAIL, int, -1, flock, (int fd, int how), (fd, how), )
REFUSED(MAY_FAIL, int, -1, memfd_create, (const char *name, unsigned flags), (name, flags), )
REFUSED(MAY_FAIL, int, -1, ftruncate, (int fd, off_t size), (fd, size), )
REFUSED(MAY_FAIL, int, -1, sched_getaffinity, (pid_t pid, size_t size, cpu_set_t *set),
        (pid, size, set), )
REFUSED(MAY_FAIL, int, -1, getrlimit, (enum __rlimit_resource what, struct rlimit *limit),
        (what, limit), )
REFUSED(MAY_FAIL, int, -1, setrlimit, (enum __rlimit_resource what, const struct rlimit *limit),
        (what, limit), )

/* ---- MPI ---- */

#define MPI(name, parameters, arguments)                                               \
    int MPI_##name parameters                                                          \
    {                                                                                  \
        const failing_verdict verdict = failing_call(FAILING_MPI, "MPI_" #name, NULL); \
        if (verdict == FAILING_NOW) return MPI_ERR_OTHER;                              \
        const int result = PMPI_##name arguments;                                      \
        return verdict == FAILING_LATE ? MPI_ERR_OTHER : result;                       \
    }
MPI(Init, (int *argc, char ***argv), (argc, argv))
MPI(Comm_set_errhandler, (MPI_Comm comm, MPI_Errhandler handler), (comm, handler))
MPI(Comm_rank, (MPI_Comm comm, int *rank), (comm, rank))
MPI(Comm_size, (MPI_Comm comm, int *size), (comm, size))
MPI(Iprobe, (int source, int tag, MPI_Comm comm, int *flag, MPI_Status *status),
    (source, tag, comm, flag, status))
MPI(Get_count, (const MPI_Status *status, MPI_Datatype type, int *count), (status, type, count))
MPI(Isend,
    (const void *buffer, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
     MPI_Request *request),
    (buffer, count, type, to, tag, comm, request))
MPI(Test, (MPI_Request * request, int *flag, MPI_Status *status), (request, flag, status))
MPI(Recv,
    (void *buffer, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
     MPI_Status *status),
    (buffer, count, type, from, tag, comm, status))
MPI(Finalize, (void), ())

/* ---- start ---- */

static void read_how(const char *how)
{
    kills = strcmp(how, "kill") == 0;
    tears = strcmp(how, "torn") == 0;
    is_short = strcmp(how, "short") == 0;
    is_late = strcmp(how, "late") == 0;
    error = EIO;
    for (size_t e = 0; e < sizeof errors / sizeof *errors; e++)
        if (strcmp(how, errors[e].name) == 0) error = errors[e].code;
}

static int where_of(const char *text)
{
    int rank, depth;
    if (strcmp(text, "starter") == 0) return FAILING_STARTER;
    return sscanf(text, "%d.%d", &rank, &depth) == 2 ? 1 + rank * FAILING_DEPTHS + depth : 0;
}

__attribute__((constructor)) static void start(void)
{
    const char *what = getenv("FAILING_CALLS"), *file = getenv("FAILING_STATE"),
               *rank = getenv("OMPI_COMM_WORLD_RANK");
    char class[16], place[16], how[16];
    unsigned long long at, site;
    under = getenv("FAILING_UNDER");
    if (!what || !file || !under || strcmp(program_invocation_short_name, "fracas") != 0) return;
    by_site = sscanf(what, "%15s %15s %llx@%llu %15s", class, place, &site, &at, how) == 5;
    if (!by_site && sscanf(what, "%15s %15s %llu %15s", class, place, &at, how) != 4) return;
    for (int c = 0; c < FAILING_NCLASSES; c++)
        if (strcmp(class, class_name[c]) == 0) wanted = (failing_class)c;
    wanted_where = where_of(place);
    wanted_at = at;
    wanted_site = by_site ? site : 0;
    read_how(how);
    void *none[1];
    if (by_site) backtrace(none, 1); /* which allocates the first time */
    if (rank && atoi(rank) >= FAILING_RANKS) return;
    where = rank ? 1 + atoi(rank) * FAILING_DEPTHS : 0;
    find_code();
    int fd = open(file, O_RDWR | O_CLOEXEC);
    void *mapped = fd < 0 ? MAP_FAILED
                          : mmap(NULL, sizeof *state, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (mapped == MAP_FAILED) _exit(77);
    close(fd);
    state = mapped;
    /* mpirun, which the parent becomes, would inherit the filter, but not the handler. */
    if (where > 0 || getenv("FAILING_ALONE")) watch_calls();
}
