/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeping a study after an interruption. */
#include "base/file.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/study.h"
#include "campaigns/store/study/segments.h"
#include "campaigns/store/upkeep.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static fracas_err remove_temporary(void *report, const char *path, const char *name)
{
    if (!fracas_disk_is_temporary(name)) return FRACAS_OK;
    if (unlink(path) < 0 && errno != ENOENT) return fracas_disk_fail("remove", path);
    fprintf(report, "removed %s, half written\n", path);
    return FRACAS_OK;
}

/* Removes half-written files of merges and workers. */
static fracas_err sweep(const void *study, FILE *report)
{
    OWNED char *folder = NULL;
    TRY(fracas_disk_each(study, remove_temporary, report));
    TRY(fracas_disk_join(study, "segments", &folder));
    return fracas_disk_each(folder, remove_temporary, report);
}

/* *report: the text written by `write`, freed by the caller. */
static fracas_err report_of(fracas_err (*write)(const void *context, FILE *report),
                            const void *context, char **report)
{
    OWNED char *text = NULL;
    size_t size;
    *report = NULL;
    FILE *out = open_memstream(&text, &size);
    if (!out) return fracas_no_memory("a report");
    fracas_err err = write(context, out);
    if (fclose(out) != 0 && !err) err = fracas_no_memory("a report");
    TRY(err);
    *report = text;
    text = NULL;
    return FRACAS_OK;
}

fracas_err fracas_study_sweep(const char *study, char **report)
{
    return report_of(sweep, study, report);
}

/* ---- lost segments ---- */

fracas_err fracas_segment_is_there(const char *study, const fracas_known_segment *segment,
                                   bool *there)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_segment(study, segment->name, &path));
    return fracas_disk_has_size(path, segment->seal.bytes, there);
}

/* FRACAS_DAMAGED, naming it, unless its bytes fit the checksum in the index. */
static fracas_err check_segment(const char *study, const fracas_known_segment *segment)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_segment(study, segment->name, &path));
    return fracas_disk_check_seal(path, &segment->seal);
}

/* Out of the way, but kept: no result is removed without a command. */
static fracas_err set_aside(const char *path, FILE *report)
{
    OWNED char *aside = NULL;
    TRY(fracas_disk_set_aside(path, &aside));
    fprintf(report, "; it is %s now\n", aside);
    return FRACAS_OK;
}

/* *lost: its realizations must be computed again. */
static fracas_err sweep_segment(const char *study, const fracas_known_segment *segment, bool seal,
                                FILE *report, bool *lost)
{
    OWNED char *path = NULL;
    bool there;
    TRY(fracas_segment_is_there(study, segment, &there));
    fracas_err err = there && seal ? check_segment(study, segment) : FRACAS_OK;
    *lost = !there || err == FRACAS_DAMAGED;
    if (!*lost) return err;
    TRY(fracas_disk_segment(study, segment->name, &path));
    if (access(path, F_OK) < 0) {
        fprintf(report, "segment %s is missing\n", segment->name);
        return FRACAS_OK;
    }
    if (there) fprintf(report, "%s", fracas_message());
    else fprintf(report, "segment %s has another size than the index says", segment->name);
    return set_aside(path, report);
}

fracas_err fracas_segments_sweep(const char *study, fracas_index *index, bool seals, FILE *report,
                                 int64_t *rows)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    size_t nlost = 0;
    *rows = 0;
    TRY(fracas_index_segments_by_id(index, &known));
    OWNED int64_t *lost = calloc(known.count + 1, sizeof *lost);
    if (!lost) return fracas_no_memory("the list of segments");
    for (size_t s = 0; s < known.count; s++) {
        bool is_lost;
        TRY(sweep_segment(study, &known.segment[s], seals, report, &is_lost));
        if (is_lost) lost[nlost++] = known.segment[s].id;
    }
    TRY(fracas_index_forget(index, lost, nlost, rows));
    if (*rows) fprintf(report, "%" PRId64 " realizations are planned again\n", *rows);
    return FRACAS_OK;
}

/* ---- study.h5 ---- */

/* FRACAS_DAMAGED for a sealed study.h5 that does not fit its seal. */
static fracas_err check_study_file(const char *study, fracas_index *index)
{
    OWNED char *path = NULL;
    bool sealed;
    fracas_file_seal seal;
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    if (!sealed) return FRACAS_OK;
    TRY(fracas_disk_join(study, "study.h5", &path));
    return fracas_disk_check_seal(path, &seal);
}

/* A study.h5 with another checksum than its seal loses the seal, and is merged again. */
static fracas_err unseal_damaged(const char *study, fracas_index *index, FILE *report)
{
    fracas_err err = check_study_file(study, index);
    if (err != FRACAS_DAMAGED) return err;
    fprintf(report, "%s: it is made again\n", fracas_message());
    return fracas_index_seal_study(index, NULL);
}

/* True if every byte is to be read at the start of a run: seconds, but for studies of many
 * gigabytes. In those the merge finds damage. */
static fracas_err is_quick_to_check(fracas_index *index, bool *quick)
{
    static const double most = 2e9; /* bytes: 1 s from memory, some 7 s from a slow disk */
    bool sealed;
    int64_t bytes;
    fracas_file_seal seal;
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    TRY(fracas_sql_numbers(index, "SELECT sum(bytes) FROM segment", NULL, 0, &bytes, NULL));
    *quick = (double)seal.bytes + (double)bytes <= most;
    return FRACAS_OK;
}

static fracas_err forget_lost(const char *study, fracas_index *index, FILE *report)
{
    bool quick;
    int64_t rows;
    TRY(is_quick_to_check(index, &quick));
    TRY(fracas_segments_sweep(study, index, quick, report, &rows));
    return quick ? unseal_damaged(study, index, report) : FRACAS_OK;
}

fracas_err fracas_study_check_segments(const char *study, fracas_index *index)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    TRY(fracas_index_segments_by_id(index, &known));
    for (size_t s = 0; s < known.count; s++) TRY(check_segment(study, &known.segment[s]));
    return FRACAS_OK;
}

fracas_err fracas_study_sound(const char *study, fracas_index *index, bool *sound)
{
    bool quick;
    *sound = true;
    TRY(is_quick_to_check(index, &quick));
    fracas_err err = quick ? check_study_file(study, index) : FRACAS_OK;
    if (quick && !err) err = fracas_study_check_segments(study, index);
    *sound = err != FRACAS_DAMAGED;
    return *sound ? err : FRACAS_OK;
}

bool fracas_study_is_kept(const char *study, fracas_index *index)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    int moved = 0;
    bool there = true;
    if (!sqlite3_file_control(index->db, "main", SQLITE_FCNTL_HAS_MOVED, &moved) && moved)
        return false;
    if (fracas_index_segments_by_id(index, &known)) return true;
    for (size_t s = 0; there && s < known.count; s++)
        if (fracas_segment_is_there(study, &known.segment[s], &there)) there = true;
    return there;
}

/* ---- segments unknown to the index ---- */

/* Finds a realization in the index, or plans it if a rule may have asked for it before the index
 * was lost. */
static fracas_err place_or_plan(fracas_index *index, const fracas_point_table *table,
                                const fracas_hash *point, int64_t replica)
{
    fracas_row_place place;
    fracas_err err = fracas_index_place(index, point, replica, &place);
    for (size_t p = 0; err == FRACAS_DAMAGED && p < table->npoints; p++) {
        fracas_point_row row = table->point[p];
        if (row.most <= replica || !fracas_hash_equal(&row.hash, point)) continue;
        row.replicas = replica + 1;
        err = fracas_index_plan_point(index, &row);
    }
    return err;
}

/* Segments of the folder on their way into the index. */
typedef struct {
    fracas_index *index;
    const fracas_point_table *table;
    const fracas_identity *identity; /* the study's */
    FILE *report;
    fracas_known_segments known; /* by name */
    /* The segment at hand. */
    fracas_reader *reader;
    fracas_segment_row *row;
    bool asked; /* the campaign asks for every realization so far */
    bool sound; /* it was read whole: a later error is not its fault */
} adoption;

static fracas_err read_row(void *context, fracas_result *result)
{
    adoption *a = context;
    fracas_segment_row *row = &a->row[result->row];
    *row = (fracas_segment_row){.point = fracas_reader_points(a->reader)->point[result->point].hash,
                                .replica = result->replica,
                                .row = (int64_t)result->row,
                                .summary = fracas_summary_of(&result->record)};
    fracas_err err = a->asked ? place_or_plan(a->index, a->table, &row->point, row->replica)
                              : FRACAS_OK;
    if (err == FRACAS_DAMAGED) a->asked = false, err = FRACAS_OK;
    return err;
}

/* Commits the rows of a segment read whole. */
static fracas_err commit(adoption *a, const char *path, const char *name,
                         const fracas_file_seal *seal)
{
    const size_t count = fracas_reader_realizations(a->reader);
    OWNED char *provenance = NULL;
    if (!a->asked) {
        fprintf(a->report,
                "left %s, which has realizations that this campaign does not ask for; move it "
                "away, or run the campaign that does\n",
                path);
        return FRACAS_OK;
    }
    TRY(fracas_disk_sync_folder(path)); /* whoever renamed it may have died before this */
    TRY(fracas_reader_provenance(a->reader, &provenance));
    const bool tells = provenance && fracas_index_is_json(a->index, provenance);
    TRY(fracas_index_commit(a->index, name, seal, a->row, count,
                            tells ? provenance : "{\"adopted\": true}"));
    fprintf(a->report, "adopted %s with %zu realizations\n", path, count);
    return FRACAS_OK;
}

/* Every record is read, so that every checksum of the file is looked at. A segment of another
 * program or campaign is left: it is not ours to remove. */
static fracas_err adopt(adoption *a, const char *path, const char *name)
{
    fracas_file_seal seal;
    fracas_identity found;
    char text[FRACAS_DIFFERENCE_TEXT];
    uint64_t version;
    TRY(fracas_file_version(path, &version));
    if (version != FRACAS_FORMAT_VERSION) {
        fprintf(a->report, "left %s, which has format version %" PRIu64 ", not %d; move it away\n",
                path, version, FRACAS_FORMAT_VERSION);
        return FRACAS_OK;
    }
    TRY(fracas_disk_seal_path(path, &seal));
    OWN(fracas_reader) reader = NULL;
    TRY(fracas_reader_open(path, &reader));
    a->reader = reader;
    fracas_identity_of(fracas_reader_header(reader), &found);
    if (fracas_identity_differs(&found, a->identity, text)) {
        fprintf(a->report, "left %s, which is not of this study: %s; move it away\n", path, text);
        return FRACAS_OK;
    }
    OWNED fracas_segment_row *row = calloc(fracas_reader_realizations(reader) + 1, sizeof *row);
    if (!row) return fracas_no_memory("the rows of a segment");
    a->row = row;
    a->asked = true;
    TRY(fracas_reader_each(reader, FRACAS_READ_ALL, read_row, a));
    a->sound = true;
    return commit(a, path, name, &seal);
}

static fracas_err adopt_or_set_aside(void *context, const char *path, const char *name)
{
    adoption *a = context;
    if (!fracas_disk_ends(name, ".h5") || fracas_segment_of_name(&a->known, name)) return FRACAS_OK;
    a->sound = false;
    fracas_err err = adopt(a, path, name);
    if (err != FRACAS_DAMAGED || a->sound) return err;
    fprintf(a->report, "%s", fracas_message());
    return set_aside(path, a->report);
}

static fracas_err adopt_orphans(const char *folder, const fracas_point_table *table,
                                fracas_index *index, const fracas_identity *identity, FILE *report)
{
    adoption a = {.index = index, .table = table, .identity = identity, .report = report};
    fracas_err err = fracas_index_segments_by_name(index, &a.known);
    if (!err) err = fracas_disk_each(folder, adopt_or_set_aside, &a);
    fracas_known_segments_clear(&a.known);
    return err;
}

/* ---- the index itself ---- */

/* Checks the index before anything is computed by it. A large index, where this would take long, is
 * believed here: damage shows at its use, at the latest when the merge compares records. */
static fracas_err check_index(fracas_index *index, const fracas_point_table *table)
{
    enum { MOST = 32 << 20 }; /* bytes: about a second */
    struct stat info;
    if (stat(index->path, &info) == 0 && info.st_size <= MOST) TRY(fracas_index_quick_check(index));
    return fracas_index_check_points(index, table);
}

typedef struct {
    const char *study;
    const fracas_file_header *header;
    const fracas_point_table *table;
    fracas_index *index;
    fracas_identity identity;
} recovery;

static fracas_err recover(const void *context, FILE *report)
{
    const recovery *r = context;
    OWNED char *folder = NULL;
    TRY(fracas_disk_join(r->study, "segments", &folder));
    const bool there = access(folder, F_OK) == 0;
    if (!fracas_folder_create(folder)) return fracas_disk_fail("create", folder);
    if (!there) TRY(fracas_disk_sync_folder(folder));
    TRY(sweep(r->study, report));
    TRY(forget_lost(r->study, r->index, report));
    TRY(adopt_orphans(folder, r->table, r->index, &r->identity, report));
    return fracas_checkpoints_sweep(r->study, r->header, r->index, report);
}

fracas_err fracas_study_recover(const char *study, fracas_index *index,
                                const fracas_file_header *header, const fracas_point_table *table,
                                char **report)
{
    recovery r = {.study = study, .header = header, .table = table, .index = index};
    fracas_identity_of(header, &r.identity);
    *report = NULL;
    TRY(check_index(index, table));       /* before anything is added to it */
    TRY(fracas_index_plan(index, table)); /* before the sweep, which skips unknown realizations */
    return report_of(recover, &r, report);
}
