/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* ctest-timeout: 1800 */
/* The commands for studies, with every call that changes the disk failing, and killed at every one
 * of them: the study is sound after each, and the same command completes. */
#include "campaigns/store/study.h"
#include "tests/support/upkeep.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/syscall.h>

/* HDF5 1.10 forgets an object header whose checksum is wrong; it is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

/* ---- calls that fail, or end the process; these stand before those of the C library ---- */

typedef enum { FAIL, DIE, NWAYS } way;

static long calls;        /* so far */
static long stop_at = -1; /* the one that fails or kills; -1: none */
static way how;
static bool links = true; /* false: another filesystem */

static bool stops(void)
{
    if (calls++ != stop_at) return false;
    if (how == DIE) kill(getpid(), SIGKILL);
    errno = EIO;
    return true;
}

#define STOPPABLE(type, name, parameters, ...)            \
    type name parameters                                  \
    {                                                     \
        return stops() ? -1 : (type)syscall(__VA_ARGS__); \
    }
STOPPABLE(int, fsync, (int fd), SYS_fsync, fd)
STOPPABLE(int, fdatasync, (int fd), SYS_fdatasync, fd)
STOPPABLE(int, rename, (const char *from, const char *to), SYS_renameat, AT_FDCWD, from, AT_FDCWD,
          to)
STOPPABLE(int, unlink, (const char *path), SYS_unlinkat, AT_FDCWD, path, 0)
STOPPABLE(int, rmdir, (const char *path), SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR)
STOPPABLE(int, mkdir, (const char *path, mode_t mode), SYS_mkdirat, AT_FDCWD, path, mode)
STOPPABLE(int, ftruncate, (int fd, off_t size), SYS_ftruncate, fd, size)
STOPPABLE(int, ftruncate64, (int fd, off64_t size), SYS_ftruncate, fd, size)
STOPPABLE(ssize_t, pwrite, (int fd, const void *bytes, size_t size, off_t at), SYS_pwrite64, fd,
          bytes, size, at)
STOPPABLE(ssize_t, pwrite64, (int fd, const void *bytes, size_t size, off64_t at), SYS_pwrite64, fd,
          bytes, size, at)
STOPPABLE(ssize_t, write, (int fd, const void *bytes, size_t size), SYS_write, fd, bytes, size)

int remove(const char *path)
{
    if (stops()) return -1;
    const int code = (int)syscall(SYS_unlinkat, AT_FDCWD, path, 0);
    return code < 0 && errno == EISDIR ? (int)syscall(SYS_unlinkat, AT_FDCWD, path, AT_REMOVEDIR)
                                       : code;
}

int link(const char *from, const char *to)
{
    if (stops()) return -1;
    if (links) return (int)syscall(SYS_linkat, AT_FDCWD, from, AT_FDCWD, to, 0);
    errno = EXDEV;
    return -1;
}

/* ---- the commands, on a study `study` and another one within it ---- */

static fracas_err index_anew(void)
{
    const fracas_file_header header = sample_header();
    said_text[0] = '\0';
    return fracas_study_reindex(study, &header, &table, &said);
}

static void ignore_item(void *context, const fracas_collected *item)
{
    (void)context, (void)item;
}

static fracas_err collect(void)
{
    uint64_t freed;
    OWN(fracas_index) index = NULL;
    TRY(fracas_index_open(study, true, &index));
    return fracas_study_collect(study, index, &(fracas_collect_options){.found = ignore_item},
                                &freed);
}

static fracas_err retry(void)
{
    int64_t rows;
    OWN(fracas_index) index = NULL;
    TRY(fracas_index_open(study, true, &index));
    return fracas_index_retry(index, NULL, &rows);
}

/* As a command does it: after the sweep, and compared. */
static fracas_err join(void)
{
    fracas_joined joined;
    int64_t both;
    const char *from = sample_path(study, "other");
    const fracas_file_header header = sample_header();
    OWN(fracas_index) index = NULL;
    OWN(fracas_index) theirs = NULL;
    OWNED char *report = NULL;
    TRY(fracas_index_open(study, true, &index));
    TRY(fracas_study_recover(study, index, &header, &table, &report));
    TRY(fracas_index_open(from, false, &theirs));
    TRY(fracas_study_compare(study, index, from, theirs, &header, &table, &both));
    return fracas_study_join(study, index, from, theirs, &table, &joined);
}

static fracas_err merge_all(void)
{
    const fracas_file_header header = sample_header();
    OWN(fracas_index) index = NULL;
    TRY(fracas_index_open(study, true, &index));
    return fracas_study_merge(study, index, &header, &table, NULL, NULL);
}

/* ---- the studies that they are tried on ---- */

static void commit_range(const char *name, size_t point, int64_t first, int64_t end)
{
    sample_realization what[REPLICAS];
    for (int64_t r = first; r < end; r++) what[r - first] = (sample_realization){point, r};
    commit_segment(name, what, (size_t)(end - first));
}

static void make_incomplete(void)
{
    commit_range("a.h5", 0, 0, 4);
    commit_range("b.h5", 1, 0, 4);
    OK(fracas_index_fail(index_, &point_row[0].hash, 30, "signal 9", true));
    OK(fracas_index_fail(index_, &point_row[2].hash, 30, "signal 9", true));
}

static void make_damaged(void)
{
    make_incomplete();
    fracas_index_close(index_);
    index_ = NULL;
    write_bytes(sample_path(study, "index.sqlite"), "no database, but long enough to be looked at",
                44);
}

static void make_garbage(void)
{
    make_incomplete();
    sql("UPDATE realization SET status = 'planned', outcome = NULL, segment = NULL, row = NULL, "
        "fragments = NULL, fragments_dust = NULL, steps = NULL, dissipated = NULL, "
        "residual = NULL, size = NULL WHERE segment = 2");
    write_bytes(sample_path(study, "segments/.x.h5.tmp-12"), "abc", 3);
    write_bytes(sample_path(study, "index.sqlite.before-20260101T000000.1"), "abc", 3);
    assert_int_equal(mkdir(sample_path(study, ".reindex"), 0777) |
                         mkdir(sample_path(study, "attachments"), 0777),
                     0);
    write_bytes(sample_path(study, ".reindex/index.sqlite"), "abc", 3);
    write_bytes(sample_path(study, "attachments/00000000000000000000000000000002"), "abc", 3);
}

static void make_two(void)
{
    commit_range("a.h5", 0, 0, 4);
    fracas_index_close(index_);
    char *kept = study, *other;
    assert_true(asprintf(&other, "%s/other", kept) > 0);
    assert_int_equal(mkdir(other, 0777) | mkdir(sample_path(other, "segments"), 0777), 0);
    study = other;
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &table));
    commit_range("a.h5", 1, 0, 4);
    commit_range("b.h5", 0, 2, 8);
    OK(fracas_index_fail(index_, &point_row[2].hash, 30, "signal 9", true));
    fracas_index_close(index_);
    index_ = NULL;
    study = kept;
    free(other);
}

static void make_whole(void)
{
    commit_everything(0);
}

/* ---- one command ---- */

typedef struct {
    const char *name;
    void (*make)(void);
    fracas_err (*run)(void);
    int64_t computed[SAMPLE_POINTS]; /* replicas 0 to this number - 1 are, at the end */
    int64_t lost;                    /* failures without a record */
    bool again;                      /* failed ones are planned at the end */
    bool copies;                     /* links do not work */
    bool damaged; /* the study is not sound before, so it may not be after a failure */
    bool pending; /* study.h5 may be missing or without its seal after one */
    long each;    /* of more calls than these only some are tried; 0: all */
} trial;

static trial trials[] = {
    {"reindex", make_incomplete, index_anew, {4, 4}, .lost = 2},
    {"reindex of a damaged one", make_damaged, index_anew, {4, 4}, .damaged = true},
    {"gc", make_garbage, collect, {4}, .lost = 2},
    {"retry", make_incomplete, retry, {4, 4}, .again = true},
    {"merge-studies by links", make_two, join, {8, 4}, .lost = 1},
    {"merge-studies by copies", make_two, join, {8, 4}, .lost = 1, .copies = true},
    {"merge", make_whole, merge_all, {40, 40, 40}, .pending = true, .each = 16}};

static char template_folder[300];

static void shell(const char *format, ...) FRACAS_PRINTF(1, 2);
static void shell(const char *format, ...)
{
    char command[1200];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(command, sizeof command, format, arguments);
    va_end(arguments);
    assert_int_equal(system(command), 0);
}

static void restore(void)
{
    stop_at = -1;
    shell("rm -rf %s && cp -a %s %s", study, template_folder, study);
}

static bool is_pending(const char *problem)
{
    return strstr(problem, "every realization is computed") || strstr(problem, "has no seal");
}

static void keep_unless_pending(void *context, const char *problem)
{
    if (!is_pending(problem)) keep_problem(context, problem);
}

static void is_sound(const trial *t, long k)
{
    char text[8192] = "";
    int64_t problems;
    if (t->damaged) return;
    const fracas_verify_options how_to = {
        .full = true, .say = t->pending ? keep_unless_pending : keep_problem, .context = text};
    OK(fracas_study_verify(study, &how_to, &problems));
    if (*text)
        fail_msg("%s, %s at call %ld: %s", t->name, how == DIE ? "killed" : "failing", k, text);
}

/* Some computed records have the outcome FAILED. */
static fracas_index_counts counts_of(const trial *t)
{
    int64_t done = 0, failed = t->lost;
    for (size_t p = 0; p < SAMPLE_POINTS; p++)
        for (int64_t r = 0; r < t->computed[p]; r++) {
            FRACAS_CLEARED(fracas_record) record;
            sample_record(p, r, MOST, &record);
            if (record.outcome == FRACAS_FAILED) failed++;
            else done++;
        }
    return (fracas_index_counts){.done = done,
                                 .failed = t->again ? 0 : failed,
                                 .planned = ALL - done - (t->again ? 0 : failed)};
}

static void completes(const trial *t, long k)
{
    fracas_err err = t->run();
    if (err)
        fail_msg("%s after %s at call %ld: %d %s", t->name, how == DIE ? "a death" : "a failure", k,
                 err, fracas_message());
    OK(fracas_index_open(study, true, &index_));
    const fracas_index_counts counts = count_all(), wanted = counts_of(t);
    char text[8192];
    if (verify(text)) fail_msg("%s, repeated after call %ld: %s", t->name, k, text);
    fracas_index_close(index_);
    index_ = NULL;
    if (counts.done != wanted.done || counts.failed != wanted.failed ||
        counts.planned != wanted.planned)
        fail_msg("%s, %s at call %ld: %d done, %d failed, %d planned", t->name,
                 how == DIE ? "killed" : "failing", k, (int)counts.done, (int)counts.failed,
                 (int)counts.planned);
    assert_int_equal(sample_files(study, ".reindex"), 0);
    assert_int_equal(sample_files(sample_path(study, "segments"), "tmp"), 0);
}

/* Runs it with call k failing, or in a process that dies there. False when it has fewer calls. */
static bool runs_into(const trial *t, long k)
{
    int status;
    if (how == FAIL) {
        calls = 0;
        stop_at = k;
        fracas_err err = t->run();
        stop_at = -1;
        /* What fails may not matter (a log that is not removed), but if it does it is the disk's
         * fault. */
        if (err && err != FRACAS_ENVIRONMENT)
            fail_msg("%s, call %ld: %d %s", t->name, k, err, fracas_message());
        return calls > k;
    }
    pid_t child = fork();
    if (child == 0) {
        calls = 0;
        stop_at = k;
        _exit(t->run() ? 1 : 0);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    if (WIFEXITED(status)) assert_int_equal(WEXITSTATUS(status), 0);
    return WIFSIGNALED(status);
}

static void try_every_call(void **state)
{
    const trial *t = *state;
    t->make();
    fracas_index_close(index_);
    index_ = NULL;
    links = !t->copies;
    snprintf(template_folder, sizeof template_folder, "%s.template", study);
    shell("cp -a %s %s", study, template_folder);
    for (how = FAIL; how < NWAYS; how++)
        for (long k = 0;; k += t->each && k > t->each ? k / 8 : 1) {
            restore();
            const bool met = runs_into(t, k);
            is_sound(t, k);
            completes(t, k);
            if (met) continue;
            assert_true(k > 5); /* there were calls */
            break;
        }
    links = true;
    shell("rm -rf %s", template_folder);
}

int fracas_test(void)
{
    if (access("/dev/shm", W_OK) == 0)
        setenv("TMPDIR", "/dev/shm", 0); /* syncing to a disk would take minutes */
    struct CMUnitTest tests[FRACAS_COUNT(trials)];
    for (size_t t = 0; t < FRACAS_COUNT(trials); t++)
        tests[t] = (struct CMUnitTest){trials[t].name, try_every_call, set_up, tear_down,
                                       &trials[t]};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
