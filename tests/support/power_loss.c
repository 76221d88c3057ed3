/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Disk states after a power cut, built from a log and opened (docs/decisions/power-loss.md).
 *
 *   power_loss begin LOG ROOT             a log with the files that are below ROOT
 *   power_loss list LOG                   its changes
 *   power_loss kill LOG PID ...           kill -9 while none of them has a change half recorded
 *   power_loss build LOG POINT SEED TO    one state, for a look
 *   power_loss storm LOG STUDY CAMPAIGN REFERENCE FOLDER STATES SEED JOBS
 *   power_loss resume ... COMMAND         the same, ended by this command in every state
 *
 * STUDY: below ROOT. REFERENCE: study.h5 of an undisturbed run. FOLDER: for the states, in memory
 * at best. POINT: number of changes before the cut. */
#include "tests/support/power_truth.h"

#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <inttypes.h>
#include <limits.h>
#include <linux/magic.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/vfs.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- the machine after the power cut ---- */

/* The same host, another boot. */
void __wrap_fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT]);
void __wrap_fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT])
{
    gethostname(host, FRACAS_HOST_TEXT - 1);
    snprintf(boot, FRACAS_BOOT_TEXT, "after-the-power-cut");
}

int statfs(const char *path, struct statfs *info) /* as in disk_recorder.c */
{
    const int code = (int)syscall(SYS_statfs, path, info);
    if (code == 0 && getenv("DISK_NETWORK")) info->f_type = NFS_SUPER_MAGIC;
    return code;
}

/* Loading the database of units takes longer than all else of a state: it is loaded once. */
fracas_err __real_fracas_units_create(fracas_units **units);
fracas_err __wrap_fracas_units_create(fracas_units **units);
fracas_err __wrap_fracas_units_create(fracas_units **units)
{
    static fracas_units *loaded;
    if (!loaded) TRY(__real_fracas_units_create(&loaded));
    *units = loaded;
    return FRACAS_OK;
}

void __wrap_fracas_units_destroy(fracas_units *units);
void __wrap_fracas_units_destroy(fracas_units *units)
{
    (void)units;
}

/* ---- shared by workers ---- */

enum { FAULTS_MAX = 20 };

typedef struct {
    uint64_t states, faults, adopted, complete, promised, torn_locks;
    uint64_t of_style[DISK_NSTYLES];
} tally;

typedef struct {
    disk_log log;
    power_truth truth;
    fracas_campaign *campaign;
    const char *study, *folder, *command;
    size_t states, jobs;
    uint64_t seed;
    uint64_t *sums; /* of weights */
    tally *sum;     /* of all workers */
} storm;

typedef struct {
    const storm *s;
    disk *d;
    size_t point;
    uint64_t state_seed;
    char root[PATH_MAX], pool[PATH_MAX];
} worker;

static void die(const char *what, const char *path)
{
    fprintf(stderr, "power_loss: cannot %s %s: %s\n", what, path, strerror(errno));
    exit(2);
}

FRACAS_PRINTF(2, 3) static bool fault(const worker *w, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; (c = strchr(c, '\n'));) *c = ';';
    printf("FAULT at point %zu of %zu, seed %" PRIu64 " (%s): %s\n", w->point, w->s->log.count,
           w->state_seed, disk_style_text[disk_style_of(w->state_seed)], text);
    fflush(stdout);
    return false;
}

static bool changes_in_place(const char *name)
{
    return strncmp(name, "index.sqlite", 12) == 0 || strcmp(name, "lock") == 0;
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *at)
{
    (void)info, (void)kind, (void)at;
    return remove(path);
}

static void empty(const char *folder)
{
    if (nftw(folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS) < 0 && errno != ENOENT)
        die("remove", folder);
    if (mkdir(folder, 0755) < 0) die("create", folder);
}

/* ---- a study after recovery ---- */

typedef struct {
    char *line;    /* HASH REPLICA STATUS */
    char *segment; /* "" without one */
    int64_t row;
} index_row;

typedef struct {
    index_row *row;
    size_t count;
    char seal[128]; /* "study.h5 BYTES CHECKSUM" */
} index_state;

static int by_line(const void *a, const void *b)
{
    return strcmp(((const index_row *)a)->line, ((const index_row *)b)->line);
}

static bool read_index(const worker *w, fracas_index *index, index_state *state)
{
    OWN(sqlite3_stmt) s = NULL;
    OWNED char *seal = NULL;
    fracas_err err = fracas_sql_start(
        index,
        "SELECT p.hash || ' ' || r.replica || ' ' || r.status, coalesce(g.name, ''), r.row FROM "
        "realization r JOIN point p ON p.id = r.point LEFT JOIN segment g ON g.id = r.segment",
        NULL, 0, &s);
    while (!err && fracas_sql_next(index, s, &err)) {
        state->row = realloc(state->row, (state->count + 1) * sizeof *state->row);
        state->row[state->count++] = (index_row){strdup((const char *)sqlite3_column_text(s, 0)),
                                                 strdup((const char *)sqlite3_column_text(s, 1)),
                                                 sqlite3_column_int64(s, 2)};
    }
    if (!err)
        err = fracas_sql_text(index, "SELECT value FROM meta WHERE key = 'study_seal'", NULL, 0,
                              &seal);
    snprintf(state->seal, sizeof state->seal, "study.h5 %s", seal ? seal : "");
    qsort(state->row, state->count, sizeof *state->row, by_line);
    return !err || fault(w, "the index cannot be read: %s", fracas_message());
}

static void clear_state(index_state *state)
{
    for (size_t r = 0; r < state->count; r++) {
        free(state->row[r].line);
        free(state->row[r].segment);
    }
    free(state->row);
}

static const index_row *find_row(const index_state *state, const char *line)
{
    const index_row wanted = {.line = (char *)line};
    return bsearch(&wanted, state->row, state->count, sizeof wanted, by_line);
}

/* Every done row has its bytes, the right ones. */
static bool check_rows(const worker *w, const index_state *state)
{
    for (size_t r = 0; r < state->count; r++) {
        const index_row *row = &state->row[r];
        char path[PATH_MAX];
        const size_t length = strcspn(row->line, " "),
                     end = length + 1 + strcspn(row->line + length + 1, " ");
        if (strcmp(row->line + end, " done") != 0) continue;
        const power_file *f = power_truth_next(&w->s->truth, row->segment, NULL);
        if (!f || row->row < 0 || (size_t)row->row >= f->nrows ||
            strncmp(f->row[row->row], row->line, end) != 0 || f->row[row->row][end])
            return fault(w, "%s, in row %" PRId64 " of '%s': it is not there", row->line, row->row,
                         row->segment);
        snprintf(path, sizeof path, "%s/segments/%s", w->s->study, row->segment);
        if (!power_truth_has(&w->s->truth, row->segment, path))
            return fault(w, "%s, but %s is not there, or has other bytes", row->line, path);
    }
    return true;
}

static bool check_promises(const worker *w, const index_state *state)
{
    size_t count;
    char **line = power_promised(&w->s->log, w->s->study, w->point, &count);
    bool good = true;
    for (size_t l = 0; good && l < count; l++)
        if (strncmp(line[l], "study.h5 ", 9) == 0 ? strcmp(line[l], state->seal) != 0
                                                  : !find_row(state, line[l]))
            good = fault(w, "promised and lost: %s", line[l]);
    w->s->sum->promised += count > 0;
    free(line);
    return good;
}

typedef struct {
    const worker *w;
    const index_state *state;
    bool good;
} durability;

/* A segment durable under its name at the cut: its realizations are done. */
static void check_durable(void *context, const char *path, size_t node)
{
    durability *c = context;
    char folder[PATH_MAX], line[POWER_LINE + 16];
    (void)node;
    const int length = snprintf(folder, sizeof folder, "%s/segments/", c->w->s->study);
    if (strncmp(path, folder, (size_t)length) != 0) return;
    const power_file *f = power_truth_next(&c->w->s->truth, path + length, NULL);
    for (size_t r = 0; f && c->good && r < f->nrows; r++) {
        snprintf(line, sizeof line, "%s planned", f->row[r]);
        if (find_row(c->state, line)) c->good = fault(c->w, "%s, but %s was durable", line, path);
    }
}

/* study.h5 is whole or absent. */
static bool check_study_file(const worker *w)
{
    char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/study.h5", w->s->study);
    return access(path, F_OK) < 0 || power_truth_has(&w->s->truth, "study.h5", path) ||
           fault(w, "study.h5 has bytes that it never had");
}

static bool is_sound(const worker *w, fracas_index *index)
{
    OWNED char *found = NULL;
    if (fracas_sql_text(index, "PRAGMA integrity_check(1)", NULL, 0, &found))
        return fault(w, "the index: %s", fracas_message());
    return !strcmp(found, "ok") || fault(w, "the index: %s", found);
}

static bool check_study(const worker *w, fracas_index *index)
{
    index_state state = {0};
    bool good = is_sound(w, index) && read_index(w, index, &state) && check_rows(w, &state) &&
                check_promises(w, &state);
    durability durable = {w, &state, true};
    if (good) disk_each_durable(w->d, check_durable, &durable);
    clear_state(&state);
    return good && durable.good && check_study_file(w);
}

static void keep_problem(void *text, const char *problem)
{
    if (strstr(problem, "study.h5 is not there or older")) return; /* the run makes it */
    if (strstr(problem, "has no seal")) return;
    snprintf(text, 1024, "%s", problem);
}

static bool check_verify(const worker *w)
{
    int64_t problems;
    char text[1024] = "";
    const fracas_verify_options options = {.full = true, .say = keep_problem, .context = text};
    const fracas_err err = fracas_study_verify(w->s->study, &options, &problems);
    if (err && err != FRACAS_DAMAGED) return fault(w, "verify: %s", fracas_message());
    return !*text || fault(w, "verify: %s", text);
}

/* ---- one state ---- */

static bool is_good_report(const worker *w, const char *report)
{
    static const char *const bad[] = {"missing", "damaged", "another size", "planned again",
                                      "left"};
    for (size_t b = 0; report && b < FRACAS_COUNT(bad); b++)
        if (strstr(report, bad[b])) return fault(w, "recovery says: %s", report);
    if (report && strstr(report, "adopted")) w->s->sum->adopted++;
    return true;
}

/* As `run` begins: the launcher's part, then rank 0's. */
static bool open_study(const worker *w, bool force)
{
    const storm *s = w->s;
    bool complete;
    int64_t failed;
    int lock = -1;
    OWN(fracas_index) index = NULL;
    OWNED char *report = NULL;
    fracas_err err = fracas_study_examine(s->study, s->campaign, force, &complete, &failed);
    if (!err && complete) {
        s->sum->complete++;
        err = fracas_index_open(s->study, false, &index);
    } else if (!err) {
        err = fracas_study_prepare(s->study, s->campaign, force, &lock, &index, &report);
    }
    if (err == FRACAS_IN_USE && getenv("DISK_NETWORK") && !force) { /* docs/decisions/lock.md */
        s->sum->torn_locks++;
        return open_study(w, true);
    }
    const bool good = err ? fault(w, "status %d: %s", err, fracas_message())
                          : is_good_report(w, report) && check_study(w, index);
    fracas_study_unlock(lock);
    return good;
}

static bool run_command(const worker *w)
{
    char path[PATH_MAX];
    const int status = system(w->s->command);
    if (status) return fault(w, "`%s` ends with %d", w->s->command, WEXITSTATUS(status));
    snprintf(path, sizeof path, "cmp -s %s/study.h5 %s", w->s->study, w->s->truth.reference);
    return system(path) == 0 || fault(w, "study.h5 is not that of the undisturbed run");
}

static bool try_state(const worker *w, uint64_t number)
{
    enum { VERIFIED = 64 };
    disk_build(w->d, w->state_seed, w->root, w->s->command ? NULL : w->pool, changes_in_place);
    if (w->s->command) return run_command(w);
    return open_study(w, false) && (number % VERIFIED || check_verify(w));
}

/* ---- all states ---- */

/* How likely a cut is behind a change. Writes to a file that has its temporary name all its life
 * are many, and of little interest. */
static uint64_t weight_of(const disk_log *log, size_t c)
{
    enum { COMMON = 1, RARE = 20, OF_NAMES = 100 };
    const disk_entry *e = log->change[c].entry;
    if (!e->pid) return 0; /* there from the beginning */
    if (e->kind == DISK_RENAME || e->kind == DISK_REMOVE || e->kind == DISK_LINK) return OF_NAMES;
    while (e->kind == DISK_WRITE && c-- > 0) {
        const disk_change *made = &log->change[c];
        if (made->entry->kind == DISK_CREATE && made->entry->node == e->node)
            return made->name[0] == '.' ? COMMON : RARE;
    }
    return RARE;
}

/* Sums of the weights of all changes before each. */
static uint64_t *weigh(const disk_log *log)
{
    uint64_t *sum = calloc(log->count + 1, sizeof *sum);
    if (!sum) die("allocate", "the points");
    for (size_t c = 0; c < log->count; c++) sum[c + 1] = sum[c] + weight_of(log, c);
    return sum;
}

/* The point of a state: later ones of later states, each of them by its weight. */
static size_t point_of(const storm *s, uint64_t number, size_t from)
{
    const char *fixed = getenv("POWER_POINT"); /* for a close look */
    if (fixed) return strtoull(fixed, NULL, 10);
    const double part = (double)(disk_random(s->seed, number) >> 11) / 9007199254740992.0;
    const double at = ((double)number + part) / (double)s->states * (double)s->sums[s->log.count];
    while (from < s->log.count && (double)s->sums[from + 1] <= at) from++;
    return from + (from < s->log.count); /* behind the change that it falls into */
}

static void work(const storm *s, size_t job)
{
    worker w = {.s = s, .d = disk_create(s->log.root)};
    snprintf(w.root, sizeof w.root, "%s/state-%zu", s->folder, job);
    snprintf(w.pool, sizeof w.pool, "%s/pool-%zu", s->folder, job);
    empty(w.pool);
    for (uint64_t number = job; number < s->states && s->sum->faults < FAULTS_MAX;
         number += s->jobs) {
        const size_t point = point_of(s, number, w.point ? w.point - 1 : 0);
        for (; w.point < point; w.point++) disk_apply(w.d, &s->log.change[w.point]);
        w.state_seed = disk_random(s->seed ^ 0x5eedU, number);
        empty(w.root);
        if (chdir(w.root) < 0) die("go to", w.root);
        if (!try_state(&w, number)) __atomic_add_fetch(&s->sum->faults, 1, __ATOMIC_SEQ_CST);
        __atomic_add_fetch(&s->sum->states, 1, __ATOMIC_SEQ_CST);
        __atomic_add_fetch(&s->sum->of_style[disk_style_of(w.state_seed)], 1, __ATOMIC_SEQ_CST);
    }
    disk_destroy(w.d);
}

static int run_workers(storm *s)
{
    int bad = 0, status;
    for (size_t job = 0; job < s->jobs; job++) {
        const pid_t pid = fork();
        if (pid < 0) die("start", "a process");
        if (pid == 0) {
            work(s, job);
            exit(0);
        }
    }
    for (size_t job = 0; job < s->jobs; job++)
        if (wait(&status) > 0 && status != 0) bad++;
    const tally *t = s->sum;
    printf("%" PRIu64 " states of %zu changes: %" PRIu64 " with promises, %" PRIu64
           " with segments adopted, %" PRIu64 " complete, %" PRIu64 " locks to force; %" PRIu64
           " faults\n",
           t->states, s->log.count, t->promised, t->adopted, t->complete, t->torn_locks, t->faults);
    for (int i = 0; i < DISK_NSTYLES; i++)
        printf("    %8" PRIu64 " %s\n", t->of_style[i], disk_style_text[i]);
    if (bad) printf("%d workers died\n", bad);
    return t->faults || bad ? 1 : 0;
}

static int run_storm(char **argument, const char *command)
{
    storm s = {.study = argument[1],
               .folder = argument[4],
               .command = command,
               .states = strtoull(argument[5], NULL, 10),
               .seed = strtoull(argument[6], NULL, 10),
               .jobs = strtoull(argument[7], NULL, 10)};
    disk_log_open(argument[0], &s.log);
    if (fracas_campaign_read(argument[2], &s.campaign)) {
        fprintf(stderr, "power_loss: %s\n", fracas_message());
        return 2;
    }
    s.sums = weigh(&s.log);
    power_truth_make(&s.log, argument[3], s.folder, &s.truth);
    s.sum = mmap(NULL, sizeof *s.sum, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (s.sum == MAP_FAILED) die("share", "memory");
    return run_workers(&s);
}

/* ---- logs ---- */

static int log_fd;
static uint64_t log_end;

static void put(const void *bytes, size_t size)
{
    if (size && pwrite(log_fd, bytes, size, (off_t)log_end) != (ssize_t)size)
        die("write", "the log");
    log_end += size;
}

static void add(disk_entry entry, const char *name, const char *other, const void *bytes)
{
    const size_t first = name ? strlen(name) + 1 : 0, second = other ? strlen(other) + 1 : 0;
    entry.text = (uint32_t)(first + second);
    put(&entry, sizeof entry);
    put(name, first);
    put(other, second);
    put(bytes, entry.size);
}

/* A file made under another name, filled, synced and renamed. */
static void add_present(const char *path, uint64_t folder, const char *name)
{
    struct stat info;
    OWN_FD fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0 || fstat(fd, &info) < 0) die("open", path);
    OWNED char *bytes = malloc((size_t)info.st_size + 1);
    if (!bytes || read(fd, bytes, (size_t)info.st_size) != info.st_size) die("read", path);
    disk_entry entry = {.kind = DISK_CREATE, .node = info.st_ino, .folder = folder};
    add(entry, ".present", NULL, NULL);
    add((disk_entry){.kind = DISK_WRITE, .node = info.st_ino, .size = (uint32_t)info.st_size}, NULL,
        NULL, bytes);
    add((disk_entry){.kind = DISK_SYNC, .node = info.st_ino}, NULL, NULL, NULL);
    entry.kind = DISK_RENAME;
    entry.other = folder;
    add(entry, ".present", name, NULL);
}

static uint64_t node_of(const char *path)
{
    struct stat info;
    if (lstat(path, &info) < 0) die("look at", path);
    return info.st_ino;
}

static fracas_err add_entry(void *context, const char *path, const char *name)
{
    const uint64_t *folder = context;
    struct stat info;
    if (lstat(path, &info) < 0) die("look at", path);
    if (!S_ISDIR(info.st_mode)) {
        add_present(path, *folder, name);
        return FRACAS_OK;
    }
    uint64_t below = info.st_ino;
    add((disk_entry){.kind = DISK_MKDIR, .node = below, .folder = *folder}, name, NULL, NULL);
    fracas_err err = fracas_disk_each(path, add_entry, &below);
    add((disk_entry){.kind = DISK_SYNC, .node = below}, NULL, NULL, NULL);
    return err;
}

static int begin(const char *path, const char *root)
{
    uint64_t node = node_of(root);
    disk_log_head head = {.mark = DISK_LOG_MARK, .root = node};
    log_fd = open(path, O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (log_fd < 0) die("create", path);
    log_end = sizeof head;
    if (fracas_disk_each(root, add_entry, &node)) die("list", root);
    add((disk_entry){.kind = DISK_SYNC, .node = node}, NULL, NULL, NULL);
    head.end = log_end;
    return pwrite(log_fd, &head, sizeof head, 0) == sizeof head ? 0 : 1;
}

static int list(const char *path)
{
    static const char *const kind[DISK_NKINDS] = {"create",  "mkdir", "write",  "truncate",
                                                  "sync",    "link",  "rename", "remove",
                                                  "promise", "begin", "UNKNOWN"};
    disk_log log;
    disk_log_open(path, &log);
    for (size_t c = 0; c < log.count; c++) {
        const disk_change *change = &log.change[c];
        const disk_entry *e = change->entry;
        size_t lines = 0;
        for (const char *t = change->name; e->kind == DISK_PROMISE && *t; t++) lines += *t == '\n';
        printf("%zu %u %s file %" PRIu64 " folder %" PRIu64 " at %" PRIu64 " size %u", c, e->pid,
               kind[e->kind], e->node, e->folder, e->at, e->size);
        if (e->kind == DISK_PROMISE) printf(" %zu lines\n", lines);
        else printf(" %s %s\n", change->name, change->other);
    }
    return 0;
}

static int build_one(const char *path, const char *point, const char *seed, const char *to)
{
    disk_log log;
    disk_log_open(path, &log);
    disk *d = disk_create(log.root);
    for (size_t c = 0; c < strtoull(point, NULL, 10) && c < log.count; c++)
        disk_apply(d, &log.change[c]);
    empty(to);
    disk_build(d, strtoull(seed, NULL, 10), to, NULL, changes_in_place);
    return 0;
}

static int kill_between(const char *path, char **pid)
{
    OWN_FD fd = open(path, O_RDWR | O_CLOEXEC);
    disk_log_head *head = mmap(NULL, sizeof *head, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (fd < 0 || head == MAP_FAILED) die("open", path);
    const uint32_t self = (uint32_t)getpid();
    for (uint32_t owner = 0; !__atomic_compare_exchange_n(&head->owner, &owner, self, false,
                                                          __ATOMIC_SEQ_CST, __ATOMIC_SEQ_CST);
         owner = 0)
        usleep(10);
    for (; *pid; pid++) kill((pid_t)atoi(*pid), SIGKILL);
    usleep(20000); /* until they are dead */
    __atomic_store_n(&head->owner, 0, __ATOMIC_SEQ_CST);
    return 0;
}

int main(int argc, char **argv)
{
    const char *what = argc > 1 ? argv[1] : "";
    if (argc == 4 && !strcmp(what, "begin")) return begin(argv[2], argv[3]);
    if (argc == 3 && !strcmp(what, "list")) return list(argv[2]);
    if (argc > 3 && !strcmp(what, "kill")) return kill_between(argv[2], argv + 3);
    if (argc == 6 && !strcmp(what, "build")) return build_one(argv[2], argv[3], argv[4], argv[5]);
    if (argc == 10 && !strcmp(what, "storm")) return run_storm(&argv[2], NULL);
    if (argc == 11 && !strcmp(what, "resume")) return run_storm(&argv[2], argv[10]);
    fprintf(stderr, "power_loss: see the head of power_loss.c\n");
    return 2;
}
