/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Every place of the store that calls the C library, SQLite or HDF5, with that call failing: the
 * command says why, or does without; nothing sound is called damaged, nothing is lost, and the same
 * command completes. */
#include "campaigns/store/study.h"
#include "tests/support/store_commands.h"

/* HDF5 1.10 forgets an object header whose checksum is wrong; it is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

/* ---- one command ---- */

typedef struct {
    const char *name;
    void (*make)(void);
    fracas_err (*run)(void);
    bool reads; /* it changes nothing */
    fracas_err ends;
} trial;

/* The quick ones first: a place is tried once. */
static trial trials[] = {
    {"results so far", make_partial, read_results, .reads = true},
    {"results of study.h5", make_merged, read_results, .reads = true},
    {"results without an index", make_without_index, read_results, .reads = true},
    {"a file is checked", make_merged, check_file, .reads = true},
    {"verify", make_littered, verify_all, .reads = true},
    {"a look at all", make_merged, look_at_all, .reads = true},
    {"gc --dry-run", make_littered, collect_dry, .reads = true},
    {"the lock", make_littered, lock_and_look},
    {"a held lock", make_held, lock_in_vain, .reads = true, .ends = FRACAS_IN_USE},
    {"the index", make_partial, use_index},
    {"a checkpoint", make_partial, keep_checkpoint},
    {"gc", make_littered, collect},
    {"a segment is written", make_computed, write_segment},
    {"merge", make_computed, merge_all},
    {"merge of a damaged one", make_damaged, merge_all, .ends = FRACAS_INTERRUPTED},
    {"reindex of an older one", make_old, index_anew, .ends = FRACAS_DAMAGED},
    {"recover", make_hurt, recover},
    {"merge-studies", make_two, join},
    {"reindex", make_hurt, index_anew},
    {"reindex of a damaged one", make_without_index, index_anew},
};

static char *template_folder;

static void copy_tree(const char *from, const char *to)
{
    struct dirent *entry;
    DIR *folder = opendir(from);
    assert_non_null(folder);
    assert_int_equal(mkdir(to, 0777), 0);
    while ((entry = readdir(folder))) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        OWNED char *source = NULL;
        OWNED char *target = NULL;
        OK(fracas_disk_join(from, entry->d_name, &source));
        OK(fracas_disk_join(to, entry->d_name, &target));
        if (entry->d_type == DT_DIR) {
            copy_tree(source, target);
        } else if (entry->d_type == DT_LNK) {
            char to_what[512] = "";
            assert_true(readlink(source, to_what, sizeof to_what - 1) > 0);
            assert_int_equal(symlink(to_what, target), 0);
        } else if (fracas_disk_ends(entry->d_name, ".h5")) { /* nobody changes a written one */
            assert_int_equal(link(source, target), 0);
        } else {
            size_t size;
            OWNED unsigned char *bytes = whole_bytes(source, &size);
            write_bytes(target, bytes, size);
        }
    }
    closedir(folder);
}

static void restore(void)
{
    sample_remove_tree(study);
    copy_tree(template_folder, study);
}

/* What the command read, and what is in the study afterwards. */
static void end_of(const trial *t, char text[MOST_TEXT])
{
    static const char rows[] =
        "SELECT group_concat(x, ';') FROM (SELECT p.hash || ' ' || r.replica || ' ' || r.status || "
        "' ' || coalesce(s.name, '-') || ' ' || coalesce(r.row, '-') || ' ' || coalesce(r.reason, "
        "'') AS x FROM realization r JOIN point p ON p.id = r.point LEFT JOIN segment s ON s.id = "
        "r.segment ORDER BY p.hash, r.replica)";
    static const char seal[] =
        "SELECT group_concat(value, ';') FROM (SELECT value FROM meta ORDER BY key)";
    snprintf(text, MOST_TEXT, "%s\n", found);
    if (t->reads) return;
    OWNED char *places = NULL;
    OWNED char *facts = NULL;
    bool sealed, sound;
    OK(fracas_index_open(study, false, &index_));
    OK(fracas_sql_text(index_, rows, NULL, 0, &places));
    OK(fracas_sql_text(index_, seal, NULL, 0, &facts));
    OK(fracas_study_sealed(study, index_, &sealed));
    OK(fracas_study_sound(study, index_, &sound));
    fracas_index_close(index_);
    index_ = NULL;
    snprintf(text + strlen(text), MOST_TEXT - strlen(text), "%s\n%s\nsealed %d, sound %d", places,
             facts, sealed, sound);
}

static int next_descriptor(void)
{
    const int fd = dup(STDERR_FILENO);
    close(fd);
    return fd;
}

/* The message names the system's reason, the library's, or memory. */
static bool says_why(int way)
{
    const char *const why[] = {"memory", "disk I/O error", "HDF5",
                               way > 0 ? strerror(way) : "memory"};
    for (size_t w = 0; w < FRACAS_COUNT(why); w++)
        if (strstr(fracas_message(), why[w])) return true;
    return false;
}

static void fail_at(const trial *t, const call_place *place, long number, int way,
                    const char *wanted)
{
    const int open_before = next_descriptor();
    char text[MOST_TEXT];
    if (!t->reads) restore();
    found[0] = '\0';
    fracas_err err = each_fail(t->run, number, way);
    if (!each.failed) fail_msg("%s: %s, call %ld, was not reached", t->name, place->call, number);
    if (err && err != t->ends && (err != FRACAS_ENVIRONMENT || !says_why(way)))
        fail_msg("%s, %s (%d), call %ld: %d %s", t->name, place->call, way, number, err,
                 fracas_message());
    assert_int_equal(next_descriptor(), open_before); /* nothing stays open */
    assert_int_equal(H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL), 0);
    if (err && t->reads) return;
    if (err) {
        found[0] = '\0';
        if (t->run() != t->ends)
            fail_msg("%s after %s (%d), call %ld: %s", t->name, place->call, way, number,
                     fracas_message());
    }
    end_of(t, text);
    if (strcmp(text, wanted))
        fail_msg("%s, %s (%d), call %ld, %s:\n%s\nnot\n%s", t->name, place->call, way, number,
                 err ? "done again" : "which it survived", text, wanted);
}

static void try_every_place(void **state)
{
    const trial *t = *state;
    static char wanted[MOST_TEXT];
    table.point = point_row;
    point_row[RULED].most = MOST_REPLICAS;
    t->make();
    fracas_index_close(index_);
    index_ = NULL;
    OK(fracas_path(&template_folder, "%s.template", study));
    copy_tree(study, template_folder);
    found[0] = '\0';
    assert_int_equal(each_watch(t->run), t->ends);
    end_of(t, wanted);
    size_t tried = 0;
    for (size_t p = each.before; p < each.count; p++) {
        const call_place *place = &each.place[p];
        int way;
        for (size_t n = 0; each_way(place, n, &way); n++) {
            fail_at(t, place, place->first, way, wanted), tried++;
            if (!strcmp(place->call, "sqlite3_step") && place->last != place->first)
                fail_at(t, place, place->last, way, wanted), tried++;
        }
    }
    print_message("%s: %zu places of %ld calls, %zu failures\n", t->name, each.count - each.before,
                  each.calls, tried);
    sample_remove(template_folder);
    if (holder > 0) kill(holder, SIGKILL), waitpid(holder, NULL, 0);
    holder = 0;
}

/* ---- codes of SQLite ---- */

static fracas_err add_event(void)
{
    return fracas_index_event(index_, "kind", "text");
}

static void codes_of_sqlite_are_told_apart(void **state)
{
    static const struct {
        int code, last, told; /* SQLite's, errno, system_errno */
        fracas_err err;
        const char *says;
    } wrong[] = {{SQLITE_BUSY, 0, 0, FRACAS_IN_USE, "another process is using it"},
                 {SQLITE_LOCKED, 0, 0, FRACAS_IN_USE, "another process is using it"},
                 {SQLITE_CORRUPT, 0, 0, FRACAS_DAMAGED, "fracas reindex"},
                 {SQLITE_NOTADB, 0, 0, FRACAS_DAMAGED, "fracas reindex"},
                 {SQLITE_FORMAT, 0, 0, FRACAS_DAMAGED, "fracas reindex"},
                 {SQLITE_TOOBIG, 0, 0, FRACAS_DAMAGED, "fracas reindex"},
                 {SQLITE_ERROR, 0, 0, FRACAS_BUG, "SQL logic error"},
                 {SQLITE_CONSTRAINT, 0, 0, FRACAS_BUG, "constraint failed"},
                 {SQLITE_MISUSE, 0, 0, FRACAS_BUG, "index.sqlite"},
                 {SQLITE_RANGE, 0, 0, FRACAS_BUG, "index.sqlite"},
                 {SQLITE_MISMATCH, 0, 0, FRACAS_BUG, "datatype mismatch"},
                 {SQLITE_FULL, 0, 0, FRACAS_ENVIRONMENT, "free some space"},
                 {SQLITE_FULL, EDQUOT, 0, FRACAS_ENVIRONMENT, "quota"},
                 {SQLITE_FULL, EFBIG, 0, FRACAS_ENVIRONMENT, "ulimit -f"},
                 {SQLITE_READONLY, EROFS, 0, FRACAS_ENVIRONMENT, "mount it to be written"},
                 {SQLITE_READONLY, 0, 0, FRACAS_ENVIRONMENT, "make the study writable"},
                 {SQLITE_CANTOPEN, 0, EMFILE, FRACAS_ENVIRONMENT, "ulimit -n"},
                 {SQLITE_CANTOPEN, 0, ENOTDIR, FRACAS_ENVIRONMENT, "make the study writable"},
                 {SQLITE_PERM, 0, 0, FRACAS_ENVIRONMENT, "make the study writable"},
                 {SQLITE_IOERR, EIO, 0, FRACAS_ENVIRONMENT, "dmesg"},
                 {SQLITE_IOERR, EINTR, 0, FRACAS_ENVIRONMENT, "disk I/O error"}};
    OK(add_event());
    for (size_t w = 0; w < FRACAS_COUNT(wrong); w++) {
        failing_sqlite_as = wrong[w].code;
        failing_sqlite_errno = wrong[w].last;
        failing_sqlite_system = wrong[w].told;
        for (long k = 0; k < 3; k++) /* two values, and the step */
            FAILS(each_fail(add_event, k, wrong[w].last), wrong[w].err, "index.sqlite",
                  wrong[w].says);
    }
    failing_sqlite_as = failing_sqlite_errno = failing_sqlite_system = 0;
    assert_int_equal(number("SELECT count(*) FROM event"), 1);
}

int fracas_test(void)
{
    void *frame[2];
    (void)backtrace(frame, 2); /* it loads a library when it is first called */
    if (access("/dev/shm", W_OK) == 0)
        setenv("TMPDIR", "/dev/shm", 0); /* syncing to a disk would take minutes */
    struct CMUnitTest tests[FRACAS_COUNT(trials) + 1] = {
        [FRACAS_COUNT(trials)] = cmocka_unit_test_setup_teardown(codes_of_sqlite_are_told_apart,
                                                                 set_up, tear_down)};
    for (size_t t = 0; t < FRACAS_COUNT(trials); t++)
        tests[t] = (struct CMUnitTest){trials[t].name, try_every_place, set_up, tear_down,
                                       &trials[t]};
    if (test_argument) cmocka_set_test_filter(test_argument); /* one command */
    return cmocka_run_group_tests(tests, NULL, NULL);
}
