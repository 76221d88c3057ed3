/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two studies of one campaign, computed in two places, made one. */
#include "base/file.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/pack.h"
#include "campaigns/store/study/segments.h"
#include "campaigns/store/upkeep.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- comparing ---- */

typedef struct {
    const char *into, *from;
    fracas_index *index; /* `into`'s */
    fracas_segments *segments;
    const fracas_point_table *table;
    fracas_record record; /* as `into` has it */
    int64_t both;
} comparison;

/* Where `index` has a realization; status FRACAS_PLANNED if it has not. */
static fracas_err place_of(fracas_index *index, const fracas_hash *point, int64_t replica,
                           fracas_row_place *place)
{
    int64_t id;
    *place = (fracas_row_place){.status = FRACAS_PLANNED};
    TRY(fracas_index_find_point(index, point, &id));
    if (!id) return FRACAS_OK;
    fracas_err err = fracas_index_place(index, point, replica, place);
    return err == FRACAS_DAMAGED ? FRACAS_OK : err;
}

static fracas_err compare(void *context, fracas_visit *visit)
{
    comparison *c = context;
    const fracas_result *result = &visit->result;
    const fracas_hash *point = &c->table->point[result->point].hash;
    fracas_row_place place;
    if (visit->place.status != FRACAS_DONE) return FRACAS_OK;
    TRY(place_of(c->index, point, result->replica, &place));
    if (place.status != FRACAS_DONE) return FRACAS_OK;
    TRY(fracas_segments_record(c->segments, &place, point, result->replica, FRACAS_READ_ALL,
                               &c->record));
    c->both++;
    if (fracas_record_same(&c->record, &result->record)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "replica %" PRId64
                       " of point %zu (%s) is not the same in %s and %s: one of them was computed "
                       "by another build of the program, or on a faulty machine; compute it again "
                       "in both (docs/how-to/two-machines.md)",
                       result->replica, result->point, fracas_hash_hex(point).text, c->into,
                       c->from);
}

fracas_err fracas_study_compare(const char *into, fracas_index *into_index, const char *from,
                                fracas_index *from_index, const fracas_file_header *header,
                                const fracas_point_table *table, int64_t *both)
{
    comparison c = {.into = into, .from = from, .index = into_index, .table = table};
    OWN(fracas_segments) ours = NULL;
    OWN(fracas_segments) theirs = NULL;
    fracas_identity identity;
    fracas_identity_of(header, &identity);
    TRY(fracas_segments_create(into, into_index, &identity, false, &ours));
    TRY(fracas_segments_create(from, from_index, &identity, false, &theirs));
    c.segments = ours;
    const fracas_want want = {
        .table = table, .parts = FRACAS_READ_ALL, .visit = compare, .context = &c};
    fracas_err err = fracas_study_each_planned(theirs, from_index, &want);
    fracas_record_clear(&c.record);
    *both = c.both;
    return err;
}

/* ---- taking over ---- */

typedef struct {
    const char *into, *from;
    fracas_index *index, *theirs;
    fracas_known_segments known; /* `from`'s, by id */
    int64_t id;                  /* the segment at hand, and its rows */
    fracas_segment_row *row;
    size_t nrows, room;
    fracas_joined *joined;
} joining;

/* A file of the folder itself, not a link to a store whose owner may empty it. */
static bool is_plain(const char *path)
{
    struct stat info;
    return lstat(path, &info) == 0 && S_ISREG(info.st_mode);
}

/* A link of their file where both lie on one filesystem, else a copy, whole under a temporary name
 * first; the bytes are `ours` then. FRACAS_DAMAGED unless they have their seal. */
static fracas_err bring(const char *theirs, const fracas_file_seal *seal, const char *ours)
{
    OWN_FD from = -1;
    TRY(fracas_disk_check_seal(theirs, seal));
    TRY(fracas_disk_open(theirs, &from));
    /* It may have come here by a copy that nobody has synced. */
    if (fsync(from) < 0 && errno != EROFS && errno != EINVAL)
        return fracas_disk_fail("sync", theirs);
    if (!is_plain(theirs) || link(theirs, ours) < 0) return fracas_segment_copy(from, seal, ours);
    return fracas_disk_sync_folder(ours);
}

/* Its name in `into`: the same, or another beside a different segment; *there: its bytes are there
 * already. */
static fracas_err choose_name(const joining *j, const fracas_known_segment *segment, char **name,
                              char **path, bool *there)
{
    const char *dot = strrchr(segment->name, '.');
    const int stem = dot ? (int)(dot - segment->name) : (int)strlen(segment->name);
    *name = *path = NULL;
    for (int other = 0; other < 2; other++) {
        fracas_file_seal seal;
        struct stat info;
        free(*name);
        free(*path);
        *path = NULL;
        TRY(other ? fracas_path(name, "%.*s-%016" PRIx64 ".h5", stem, segment->name,
                                segment->seal.checksum)
                  : fracas_path(name, "%s", segment->name));
        TRY(fracas_disk_segment(j->into, *name, path));
        *there = lstat(*path, &info) == 0; /* a link to nowhere, too: it will not be replaced */
        if (!*there) return errno == ENOENT ? FRACAS_OK : fracas_disk_fail("look at", *path);
        TRY(fracas_disk_seal_path(*path, &seal));
        if (seal.bytes == segment->seal.bytes && seal.checksum == segment->seal.checksum)
            return FRACAS_OK;
    }
    return fracas_fail(FRACAS_DAMAGED, "%s is there, but not the segment of %s; move it away",
                       *path, j->from);
}

static fracas_err take_segment(const joining *j, const fracas_known_segment *segment, char **name)
{
    OWNED char *path = NULL;
    OWNED char *theirs = NULL;
    bool there;
    TRY(choose_name(j, segment, name, &path, &there));
    if (there) return FRACAS_OK;
    TRY(fracas_disk_segment(j->from, segment->name, &theirs));
    return bring(theirs, &segment->seal, path);
}

/* Deletes the decisions with this realization as failed. */
static fracas_err undecide(fracas_index *index, const fracas_segment_row *row)
{
    return fracas_sql_do(index,
                         "DELETE FROM decision WHERE replicas > ?2 AND point = (SELECT id FROM "
                         "point WHERE hash = ?1)",
                         SQL_VALUES(SQL_HASH(&row->point), SQL_INTEGER(row->replica)));
}

/* Counts the rows not done in `into`; where one failed there, study.h5 will change. */
static fracas_err count_fresh(joining *j, int64_t *fresh)
{
    *fresh = 0;
    for (size_t r = 0; r < j->nrows; r++) {
        fracas_row_place place;
        TRY(place_of(j->index, &j->row[r].point, j->row[r].replica, &place));
        if (place.status == FRACAS_DONE ||
            (place.status == FRACAS_FAILED_ROW && j->row[r].summary.outcome == FRACAS_FAILED))
            continue;
        ++*fresh;
        if (place.status != FRACAS_FAILED_ROW && place.status != FRACAS_QUARANTINED) continue;
        TRY(fracas_index_seal_study(j->index, NULL));
        TRY(undecide(j->index, &j->row[r]));
    }
    return FRACAS_OK;
}

/* Takes the gathered rows of segment j->id of `from`: its file first, then its rows. */
static fracas_err take_rows(joining *j)
{
    int64_t fresh;
    OWNED char *name = NULL;
    OWNED char *provenance = NULL;
    if (!j->nrows) return FRACAS_OK;
    const fracas_known_segment *segment = fracas_segment_of_id(&j->known, j->id);
    if (!segment)
        return fracas_fail(FRACAS_DAMAGED, "%s has no segment %" PRId64, j->theirs->path, j->id);
    TRY(count_fresh(j, &fresh));
    const size_t nrows = j->nrows;
    j->nrows = 0;
    if (!fresh) return FRACAS_OK;
    TRY(take_segment(j, segment, &name));
    TRY(fracas_sql_text(j->theirs, "SELECT provenance FROM segment WHERE id = ?1",
                        SQL_VALUES(SQL_INTEGER(j->id)), &provenance));
    TRY(fracas_index_commit(j->index, name, &segment->seal, j->row, nrows,
                            provenance ? provenance : "{}"));
    j->joined->realizations += fresh;
    j->joined->segments++;
    return FRACAS_OK;
}

/* Gathers the rows of a segment, and takes those of the one before. */
static fracas_err add_row(void *context, const fracas_hash *point, int64_t replica,
                          const fracas_row_place *place)
{
    joining *j = context;
    if (!point)
        return fracas_fail(FRACAS_DAMAGED, "%s: a point has no valid hash", j->theirs->path);
    if (place->segment != j->id) TRY(take_rows(j));
    j->id = place->segment;
    TRY(fracas_grow(&j->row, sizeof *j->row, j->nrows, &j->room, "the rows of a segment"));
    j->row[j->nrows++] = (fracas_segment_row){*point, replica, place->row, place->summary};
    return FRACAS_OK;
}

/* ---- failures ---- */

typedef struct {
    joining *joining;
    const fracas_point_table *table;
    fracas_err err;
} failing;

static void take_failure(void *context, const fracas_index_row *row, const char *reason)
{
    failing *f = context;
    fracas_index *index = f->joining->index;
    if (f->err) return;
    f->err = fracas_sql_do(
        index,
        "UPDATE realization SET status = 'failed', attempts = ?3, reason = ?4, outcome = ?5 WHERE "
        "point = (SELECT id FROM point WHERE hash = ?1) AND replica = ?2 AND status IN ('planned', "
        "'leased')",
        SQL_VALUES(SQL_HASH(&f->table->point[row->point].hash), SQL_INTEGER(row->replica),
                   SQL_INTEGER(row->attempts), SQL_TEXT(reason), SQL_INTEGER(FRACAS_FAILED)));
    if (!f->err) f->joining->joined->failed += sqlite3_changes(index->db);
}

static fracas_err take_failures(joining *j, const fracas_point_table *table)
{
    failing f = {.joining = j, .table = table};
    TRY(fracas_index_begin(j->index));
    fracas_err err = fracas_index_failures(j->theirs, table, take_failure, &f);
    return fracas_index_end(j->index, err ? err : f.err);
}

fracas_err fracas_study_join(const char *into, fracas_index *into_index, const char *from,
                             fracas_index *from_index, const fracas_point_table *table,
                             fracas_joined *joined)
{
    joining j = {
        .into = into, .from = from, .index = into_index, .theirs = from_index, .joined = joined};
    char text[4400];
    *joined = (fracas_joined){0};
    fracas_err err = fracas_index_segments_by_id(from_index, &j.known);
    if (!err) err = fracas_index_each_by_segment(from_index, add_row, &j);
    if (!err) err = take_rows(&j);
    if (!err) err = take_failures(&j, table);
    fracas_known_segments_clear(&j.known);
    free(j.row);
    if (err || (!joined->realizations && !joined->failed)) return err;
    snprintf(text, sizeof text,
             "%" PRId64 " realizations in %" PRId64 " segments, and %" PRId64 " failures, of %s",
             joined->realizations, joined->segments, joined->failed, from);
    return fracas_index_event(into_index, "joined", text);
}
