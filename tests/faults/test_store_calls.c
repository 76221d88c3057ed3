/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Every place of the store that calls the C library, SQLite or HDF5, with that call failing: the
 * command says why, or does without; nothing sound is called damaged, nothing is lost, and the same
 * command completes. */
#define STUDY_REPLICAS 4
#define STUDY_ROWS 3
#include "tests/support/upkeep.h"

#include <sys/syscall.h>

#include "campaigns/store/file/schema.h"
#include "campaigns/store/results.h"
#include "campaigns/store/study/segments.h"
#include "tests/support/each_place.h"
#include "tests/support/stored_mesh.h"

/* HDF5 1.10 forgets an object header whose checksum is wrong; it is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

enum { SURFACE = 1, RULED = 2 /* points */, MOST_REPLICAS = 8 };

enum { MOST_TEXT = 8192 };
static char found[MOST_TEXT / 2]; /* what a command read */

static void note_found(void *context, const char *text)
{
    (void)context;
    snprintf(found + strlen(found), sizeof found - strlen(found), "%s\n", text);
}

/* Its memory is a matter of the test. */
static fracas_stored_mesh grid(void)
{
    fracas_stored_mesh mesh;
    EACH_LEAVES_OUT;
    grid_make(&(grid_shape){2, 1, .middles = true}, &mesh);
    return mesh;
}

static fracas_err get_mesh(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    (void)context;
    if (point != SURFACE) return FRACAS_OK;
    FRACAS_CLEARED(fracas_stored_mesh) whole = grid();
    *mesh = (fracas_stored_mesh){.nnodes = whole.nnodes,
                                 .nelements = whole.nelements,
                                 .ninterfaces = whole.ninterfaces,
                                 .nborders = whole.nborders};
    TRY(fracas_stored_mesh_allocate(mesh));
    memcpy(mesh->node, whole.node, whole.nnodes * sizeof *whole.node);
    memcpy(mesh->element, whole.element, whole.nelements * sizeof *whole.element);
    memcpy(mesh->interface, whole.interface, whole.ninterfaces * sizeof *whole.interface);
    memcpy(mesh->border, whole.border, whole.nborders * sizeof *whole.border);
    return FRACAS_OK;
}

static const fracas_mesh_source meshes = {get_mesh, NULL};

static fracas_err open_index(fracas_index **index)
{
    return fracas_index_open(study, true, index);
}

/* ---- the commands ---- */

static void sample(int64_t replica, fracas_record *record)
{
    EACH_LEAVES_OUT;
    sample_record(0, replica, MOST, record);
}

/* As bytes, from one process to another. */
static fracas_err pass_on(fracas_record *record)
{
    static unsigned char bytes[1 << 16];
    const size_t size = fracas_record_packed_size(record);
    assert_true(size <= sizeof bytes);
    fracas_record_pack(record, bytes);
    return fracas_record_unpack(bytes, size, record);
}

static fracas_err write_segment(void)
{
    const fracas_file_header header = sample_header();
    OWN(fracas_writer) writer = NULL;
    fracas_file_seal seal;
    TRY(fracas_writer_create(sample_path(study, "segments/new.h5"), &header, &table, &writer));
    TRY(fracas_writer_provenance(writer, SAMPLE_PROVENANCE));
    for (int64_t r = 0; r < 3; r++) {
        FRACAS_CLEARED(fracas_record) record;
        sample(r, &record);
        TRY(pass_on(&record));
        TRY(fracas_writer_append(writer, 0, r, &record));
    }
    fracas_writer *ending = writer;
    writer = NULL;
    return fracas_writer_finish(ending, false, &seal);
}

static fracas_err merge_all(void)
{
    const fracas_file_header header = sample_header();
    OWN(fracas_index) index = NULL;
    TRY(open_index(&index));
    return fracas_study_merge(study, index, &header, &table, &meshes);
}

static fracas_err verify_all(void)
{
    int64_t problems;
    found[0] = '\0';
    const fracas_verify_options how = {
        .full = true, .table = &table, .say = note_found, .note = note_found};
    return fracas_study_verify(study, &how, &problems);
}

static fracas_err recover(void)
{
    const fracas_file_header header = sample_header();
    OWN(fracas_index) index = NULL;
    OWNED char *report = NULL;
    TRY(open_index(&index));
    return fracas_study_recover(study, index, &header, &table, &report);
}

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
    TRY(open_index(&index));
    return fracas_study_collect(study, index, &(fracas_collect_options){.found = ignore_item},
                                &freed);
}

static fracas_err collect_dry(void)
{
    uint64_t freed;
    OWN(fracas_index) index = NULL;
    TRY(open_index(&index));
    return fracas_study_collect(
        study, index, &(fracas_collect_options){.found = ignore_item, .dry = true}, &freed);
}

static fracas_err join(void)
{
    fracas_joined joined;
    int64_t both;
    const char *from = sample_path(study, "other");
    const fracas_file_header header = sample_header();
    OWN(fracas_index) index = NULL;
    OWN(fracas_index) theirs = NULL;
    TRY(open_index(&index));
    TRY(fracas_index_open(from, false, &theirs));
    TRY(fracas_study_compare(study, index, from, theirs, &header, &table, &both));
    return fracas_study_join(study, index, from, theirs, &table, &joined);
}

static fracas_err visit_result(void *context, fracas_result *result)
{
    char text[120];
    snprintf(text, sizeof text, "%zu %d %d %zu", result->point, (int)result->replica,
             (int)result->record.outcome, result->record.nfragment);
    note_found(context, text);
    return FRACAS_OK;
}

/* As reports do it. */
static fracas_err read_results(void)
{
    const fracas_hash campaign = sample_header().campaign;
    OWN(fracas_results) results = NULL;
    FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
    FRACAS_CLEARED(fracas_record) record;
    char text[300];
    size_t count, point, interfaces;
    int64_t replica;
    found[0] = '\0';
    fracas_record_init(&record);
    TRY(fracas_results_open(study, &campaign, &table, &results));
    TRY(fracas_results_walk(results, FRACAS_READ_ALL, visit_result, NULL));
    const fracas_err one = fracas_results_record(results, 1, FRACAS_READ_ALL, &point, &replica,
                                                 &record);
    if (one != FRACAS_DAMAGED) TRY(one);
    TRY(fracas_results_mesh_interfaces(results, SURFACE, &interfaces));
    TRY(fracas_results_mesh(results, SURFACE, &mesh));
    (void)fracas_results_decisions(results, &count);
    snprintf(text, sizeof text,
             "%zu rows, %zu decisions, %zu interfaces, %d missing, decided %d; %zu notes",
             fracas_results_realizations(results), count, interfaces,
             (int)fracas_results_missing(results, 0), fracas_results_decided(results, RULED),
             fracas_results_notes(results));
    note_found(NULL, text);
    return FRACAS_OK;
}

static fracas_err check_file(void)
{
    OWN(fracas_reader) reader = NULL;
    OWNED char *provenance = NULL;
    TRY(fracas_reader_open(sample_path(study, "study.h5"), &reader));
    TRY(fracas_reader_check_schema(reader));
    TRY(fracas_reader_check_points(reader, &table));
    TRY(fracas_reader_check_meshes(reader, &meshes));
    return fracas_reader_provenance(reader, &provenance);
}

static fracas_err lock_and_look(void)
{
    fracas_lock_state state;
    char text[FRACAS_HOLDER_TEXT];
    int lock;
    TRY(fracas_study_lock_state(study, &state, text));
    TRY(fracas_study_lock(study, true, &lock));
    (void)fracas_study_took_over(lock, text);
    fracas_study_unlock(lock);
    return FRACAS_OK;
}

static void ignore_failure(void *context, const fracas_index_row *row, const char *reason)
{
    (void)context, (void)row, (void)reason;
}

static fracas_err use_index(void)
{
    const fracas_file_header header = sample_header();
    const fracas_hash *first = &point_row[0].hash;
    fracas_index_counts counts, point[SAMPLE_POINTS];
    fracas_place place[REPLICAS];
    size_t count;
    int64_t rows;
    int part, parts;
    OWN(fracas_index) index = NULL;
    OWNED fracas_index_row *row = NULL;
    OWNED fracas_decision *decision = NULL;
    OWNED char *text = NULL;
    TRY(open_index(&index));
    TRY(fracas_index_claim(index, &header));
    TRY(fracas_index_set_part(index, 1, 2));
    TRY(fracas_index_part(index, &part, &parts));
    TRY(fracas_index_plan(index, &table));
    TRY(fracas_index_rows(index, &table, &row, &count));
    TRY(fracas_index_lease(index, first, 0, 2));
    TRY(fracas_index_fail(index, first, 3, "signal 9", true));
    TRY(fracas_index_failures(index, &table, ignore_failure, NULL));
    TRY(fracas_index_retry(index, NULL, &rows));
    TRY(fracas_index_event(index, "kind", "text"));
    TRY(fracas_index_last_event(index, "kind", &text));
    TRY(fracas_index_count_points(index, &table, &counts, point));
    TRY(fracas_index_summaries(index, first, REPLICAS, place));
    TRY(fracas_index_decisions(index, &point_row[RULED].hash, &decision, &count));
    TRY(fracas_index_plan(index, &table)); /* what is leased is planned again */
    snprintf(found, sizeof found, "part %d of %d, %d done, %d failed, %zu decisions, %s, status %d",
             part, parts, (int)counts.done, (int)counts.failed, count, text,
             place[REPLICAS - 1].status);
    return FRACAS_OK;
}

static fracas_err look_at_all(void)
{
    bool sealed, sound;
    OWN(fracas_index) index = NULL;
    OWNED char *report = NULL;
    (void)fracas_index_exists(study); /* without memory it does not */
    TRY(open_index(&index));
    TRY(fracas_study_sealed(study, index, &sealed));
    TRY(fracas_study_sound(study, index, &sound));
    TRY(fracas_study_check_segments(study, index));
    TRY(fracas_study_sweep(study, &report));
    snprintf(found, sizeof found, "%d %d %d", sealed, sound, fracas_study_is_kept(study, index));
    return FRACAS_OK;
}

/* ---- the studies that they are tried on ---- */

static void decide_ruled(void)
{
    const fracas_decision decision = {.replicas = REPLICAS,
                                      .used = REPLICAS,
                                      .mean = 1,
                                      .half_width = 0.01,
                                      .stop = 1,
                                      .minimum = 2,
                                      .maximum = MOST_REPLICAS,
                                      .relative_half_width = 0.1,
                                      .confidence = 0.95};
    OK(fracas_index_begin(index_));
    OK(fracas_index_end(index_,
                        fracas_index_decide(index_, &point_row[RULED], &decision, "reason")));
}

static void commit_range(const char *name, size_t point, int64_t first, int64_t end)
{
    sample_realization what[REPLICAS];
    for (int64_t r = first; r < end; r++) what[r - first] = (sample_realization){point, r};
    commit_segment(name, what, (size_t)(end - first));
}

static void make_computed(void)
{
    commit_range("a.h5", 0, 0, 4);
    commit_range("b.h5", 1, 0, 4);
    commit_range("c.h5", 2, 0, 4);
    decide_ruled();
}

static void make_merged(void)
{
    make_computed();
    const fracas_file_header header = sample_header();
    OK(fracas_study_merge(study, index_, &header, &table, &meshes));
}

/* Beside it things that a run and its death leave. */
static void make_littered(void)
{
    static const char *const name[] = {"segments/.x.h5.tmp-12", ".study.h5.tmp-12",
                                       "segments/d.damaged",    "index.sqlite.before-1",
                                       "campaign.yaml.tmp",     "mine"};
    make_merged();
    for (size_t n = 0; n < FRACAS_COUNT(name); n++)
        write_bytes(sample_path(study, name[n]), "abc", 3);
    write_bytes(sample_path(study, "lock"),
                "host=elsewhere pid=7 since=T start=1 boot=- job=- restart=0\n", 60);
    assert_int_equal(mkdir(sample_path(study, ".reindex"), 0777) |
                         mkdir(sample_path(study, "attachments"), 0777),
                     0);
    write_bytes(sample_path(study, ".reindex/index.sqlite"), "abc", 3);
    write_bytes(sample_path(study, "attachments/00000000000000000000000000000002"), "abc", 3);
    OK(fracas_index_commit(index_, "needless.h5", &(fracas_file_seal){3, 4}, NULL, 0, "{}"));
    write_bytes(sample_path(study, "segments/needless.h5"), "abc", 3);
}

/* One segment damaged, one missing, one unknown to the index, and half of one; study.h5 is damaged
 * too. */
static void make_hurt(void)
{
    make_merged();
    OK(fracas_index_fail(index_, &point_row[0].hash, 3, "signal 9", true));
    flip_byte(sample_path(study, "segments/a.h5"), 20000);
    flip_byte(sample_path(study, "study.h5"), 20000);
    assert_int_equal(unlink(sample_path(study, "segments/b.h5")), 0);
    write_bytes(sample_path(study, "segments/.x.h5.tmp-12"), "abc", 3);
    fracas_file_seal seal;
    fracas_segment_row row[2];
    sample_segment(study, "orphan.h5", &table,
                   (const sample_realization[]){{0, 0}, {RULED, REPLICAS}}, 2, MOST, &seal, row);
    sample_segment(study, "strange.h5", &table, (const sample_realization[]){{0, 100}}, 1, MOST,
                   &seal, row);
}

static void make_damaged(void)
{
    make_computed();
    flip_byte(sample_path(study, "segments/a.h5"), 20000);
}

/* Every segment is of an older format version, and without a seal of its own. */
static void make_old(void)
{
    static const char *const name[] = {"segments/old.h5", "segments/older.h5"};
    const int32_t version = 1;
    const fracas_file_header header = sample_header();
    for (size_t n = 0; n < FRACAS_COUNT(name); n++) {
        fracas_writer *writer;
        fracas_file_seal seal;
        OK(fracas_writer_create(sample_path(study, name[n]), &header, &table, &writer));
        OK(fracas_writer_finish(writer, false, &seal));
        hid_t file = H5Fopen(sample_path(study, name[n]), H5F_ACC_RDWR, H5P_DEFAULT),
              attribute = H5Aopen(file, "format_version", H5P_DEFAULT);
        assert_true(H5Awrite(attribute, H5T_NATIVE_INT32, &version) >= 0);
        H5Aclose(attribute);
        H5Fclose(file);
    }
}

/* Some computed, some failed. */
static void make_partial(void)
{
    commit_range("a.h5", 0, 0, 3);
    commit_range("b.h5", 1, 0, 2);
    commit_range("c.h5", 2, 0, 2);
    decide_ruled();
    OK(fracas_index_fail(index_, &point_row[1].hash, 2, "signal 9", true));
    flip_byte(sample_path(study, "segments/a.h5"), 20000);
}

static void make_without_index(void)
{
    make_merged();
    fracas_index_close(index_);
    index_ = NULL;
    write_bytes(sample_path(study, "index.sqlite"), "no database, but long enough to be looked at",
                44);
}

/* Of the other study one segment is new, one has the name of another of ours, one is there already.
 */
static void make_two(void)
{
    commit_range("a.h5", 0, 0, 3);
    commit_range("b.h5", 1, 0, 2);
    fracas_index_close(index_);
    char *kept = study, *other;
    assert_true(asprintf(&other, "%s/other", kept) > 0);
    assert_int_equal(mkdir(other, 0777) | mkdir(sample_path(other, "segments"), 0777), 0);
    study = other;
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &table));
    commit_range("a.h5", 1, 0, 4);
    commit_range("b.h5", 2, 2, 4);
    OK(fracas_index_fail(index_, &point_row[2].hash, 0, "signal 9", true));
    fracas_index_close(index_);
    index_ = NULL;
    study = kept;
    free(other);
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
    {"the index", make_partial, use_index},
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
