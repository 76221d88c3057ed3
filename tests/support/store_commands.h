/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The commands of the store, and studies on which they have much to do: some of it computed,
 * damaged, lost or left behind. */
#ifndef FRACAS_TESTS_SUPPORT_STORE_COMMANDS_H
#define FRACAS_TESTS_SUPPORT_STORE_COMMANDS_H

#define STUDY_REPLICAS 4
#define STUDY_ROWS 3
#include "tests/support/upkeep.h"

#include "campaigns/store/checkpoint.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/results.h"
#include "campaigns/store/study.h"
#include "tests/support/each_place.h"
#include "tests/support/stored_mesh.h"

#include <sys/prctl.h>

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
    return fracas_study_merge(study, index, &header, &table, &meshes, NULL);
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
    fracas_row_place place[REPLICAS];
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

static fracas_err note_checkpoint(void *context, const fracas_checkpoint_head *head, double age)
{
    (void)age;
    ++*(int *)context;
    return head->steps == 7 ? FRACAS_OK : fracas_fail(FRACAS_BUG, "other steps");
}

/* As a computation writes it, and the next run takes it up. */
static fracas_err keep_checkpoint(void)
{
    const fracas_file_header header = sample_header();
    fracas_checkpoint_head head = {.point = point_row[0].hash, .replica = 3, .steps = 7, .end = 1};
    int number = 5, count = 0;
    OWN(fracas_index) index = NULL;
    OWN(fracas_checkpoint) written = NULL;
    OWN(fracas_checkpoint) taken_up = NULL;
    TRY(open_index(&index));
    TRY(fracas_checkpoint_create(study, &header, &head, &written));
    TRY(fracas_checkpoint_put(written, &number, sizeof number));
    TRY(fracas_checkpoint_finish(written));
    TRY(fracas_checkpoints_sweep(study, &header, index, stderr));
    TRY(fracas_checkpoint_open(study, &header, &point_row[0].hash, 3, &head, &taken_up));
    number = 0;
    if (taken_up) TRY(fracas_checkpoint_get(taken_up, &number, sizeof number));
    TRY(fracas_checkpoints_each(study, note_checkpoint, &count));
    snprintf(found, sizeof found, "%d %d", number, count);
    const fracas_segment_row row = {.point = point_row[0].hash, .replica = 3};
    fracas_checkpoints_remove(study, &row, 1); /* what stays is removed by the next sweep */
    fracas_checkpoints_end(study);
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
    OK(fracas_study_merge(study, index_, &header, &table, &meshes, NULL));
}

/* Beside it things that a run and its death leave. */
static void make_littered(void)
{
    static const char *const name[] = {
        "segments/.x.h5.tmp-12", ".study.h5.tmp-12",
        "segments/d.damaged",    "index.sqlite.before-20260101T000000.1",
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
    /* One of theirs is a link to an archive: copied, not linked. */
    const char *theirs = sample_path(study, "other/segments/b.h5");
    assert_int_equal(
        rename(theirs, sample_path(study, "other/b.archive")) | symlink("../b.archive", theirs), 0);
    free(other);
}

static pid_t holder;

/* Another process has it. */
static void make_held(void)
{
    int ready[2], lock;
    char byte;
    assert_int_equal(pipe(ready), 0);
    holder = fork();
    assert_true(holder >= 0);
    if (holder == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        if (fracas_study_lock(study, true, &lock) || write(ready[1], "y", 1) != 1) _exit(1);
        pause();
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    close(ready[0]), close(ready[1]);
}

static fracas_err lock_in_vain(void)
{
    int lock;
    return fracas_study_lock(study, true, &lock);
}

#endif
