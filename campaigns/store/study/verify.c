/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The check of a study: segments against the index, study.h5 against the segments. */
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/study/segments.h"

#include "base/file.h"
#include "base/param.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/pack.h"
#include "campaigns/store/study.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct {
    const char *study;
    fracas_index *index;
    fracas_segments *segments;
    fracas_identity identity; /* the study's */
    fracas_reader *merged;    /* study.h5, NULL if it is not there or not sound */
    bool there;               /* study.h5 is there */
    bool held;                /* a run has the study */
    fracas_record record;     /* as read last */
    size_t row;               /* next one of study.h5 */
    const fracas_verify_options *options;
    int64_t problems;
} verification;

#define REINDEX "`fracas reindex` makes it anew from the segments"
#define REMAKE "remove it, and `fracas merge` writes it again"

/* A problem is damage; anything else stops the verification. */
static fracas_err problem(verification *v, fracas_err err)
{
    if (err != FRACAS_DAMAGED) return err;
    v->options->say(v->options->context, fracas_message());
    v->problems++;
    return FRACAS_OK;
}

static fracas_err found(verification *v, const char *format, ...) FRACAS_PRINTF(2, 3);
static fracas_err found(verification *v, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return problem(v, fracas_fail(FRACAS_DAMAGED, "%s", text));
}

/* ---- the database itself ---- */

/* Each row of a checking pragma is a problem, but "ok". */
static fracas_err check_database(verification *v, const char *pragma)
{
    OWN(sqlite3_stmt) s = NULL;
    fracas_err err;
    TRY(fracas_sql_start(v->index, pragma, NULL, 0, &s));
    while (fracas_sql_next(v->index, s, &err)) {
        const char *text = (const char *)sqlite3_column_text(s, 0);
        if (text && strcmp(text, "ok") != 0)
            TRY(found(v, "%s: %s: %s; " REINDEX, v->index->path, pragma, text));
    }
    return err;
}

/* Rows that no run leaves in the index, each counted by a query. */
static const struct {
    const char *query, *what;
} never[] = {
    {"SELECT count(*) FROM realization WHERE status = 'done' AND (segment IS NULL OR row IS NULL "
     "OR coalesce(outcome, -1) NOT BETWEEN 0 AND 4)",
     "realizations that are done without a segment, a row or an outcome"},
    {"SELECT count(*) FROM realization WHERE status IN ('failed', 'quarantined') AND outcome IS "
     "NOT 5",
     "realizations that failed with another outcome"},
    {"SELECT count(*) FROM realization WHERE status IN ('planned', 'leased') AND (segment IS NOT "
     "NULL OR outcome IS NOT NULL)",
     "realizations that are planned, but have results"},
    {"SELECT count(*) FROM (SELECT segment, count(*) AS n, count(DISTINCT row) AS places, min(row) "
     "AS first, max(row) AS last FROM realization WHERE segment IS NOT NULL GROUP BY segment) g "
     "JOIN segment s ON s.id = g.segment WHERE g.places < g.n OR g.first < 0 OR g.last >= s.rows",
     "segments with realizations in the same row, or in rows that they have not"},
    {"SELECT count(*) FROM point WHERE replicas < (SELECT count(*) FROM realization r WHERE "
     "r.point "
     "= point.id)",
     "points with more realizations than they were planned to have"},
    {"SELECT count(*) FROM (SELECT min(replica) AS first, max(replica) AS last, count(*) AS n FROM "
     "realization GROUP BY point) WHERE first <> 0 OR last + 1 <> n",
     "points that lack replicas"},
};

static fracas_err check_consistency(verification *v)
{
    for (size_t q = 0; q < FRACAS_COUNT(never); q++) {
        int64_t count;
        TRY(fracas_sql_numbers(v->index, never[q].query, NULL, 0, &count, NULL));
        if (count)
            TRY(found(v, "%s: %" PRId64 " %s; " REINDEX, v->index->path, count, never[q].what));
    }
    return FRACAS_OK;
}

/* ---- places ---- */

/* Links and other things in the place of files and folders of ours. */
static fracas_err check_places(verification *v)
{
    static const char *const name[] = {"lock",        "segments", FRACAS_CHECKPOINTS,
                                       "attachments", "report",   "fields"};
    for (size_t n = 0; n < FRACAS_COUNT(name); n++) {
        OWNED char *path = NULL;
        TRY(fracas_disk_join(v->study, name[n], &path));
        if (!(n ? fracas_folder_is_own : fracas_file_is_own)(path))
            TRY(problem(v, fracas_disk_fail("write", path)));
    }
    return FRACAS_OK;
}

/* ---- leftovers of an interrupted run, which are no damage ---- */

static void note(const verification *v, const char *format, ...) FRACAS_PRINTF(2, 3);
static void note(const verification *v, const char *format, ...)
{
    char text[FRACAS_HOLDER_TEXT + 512];
    va_list arguments;
    if (!v->options->note) return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    v->options->note(v->options->context, text);
}

static fracas_err note_lock(verification *v)
{
    char holder[FRACAS_HOLDER_TEXT];
    fracas_lock_state state;
    TRY(fracas_study_lock_state(v->study, &state, holder));
    switch (state) {
    case FRACAS_LOCK_FREE: break;
    case FRACAS_LOCK_HELD:
        v->held = true;
        note(v, "%s is being computed: %s", v->study, holder);
        break;
    case FRACAS_LOCK_LEFT:
        note(v, "%s/lock: left by a run that died: %s; the next run takes it over", v->study,
             holder);
        break;
    case FRACAS_LOCK_ELSEWHERE:
        note(v,
             "%s/lock: left by another host, where the run may live: %s; if it is gone, `fracas "
             "run --force` takes it over",
             v->study, holder);
        break;
    }
    return FRACAS_OK;
}

typedef struct {
    const verification *v;
    bool inner; /* the folder of segments */
    fracas_known_segments known;
} leftovers;

static fracas_err note_file(void *context, const char *path, const char *name)
{
    const leftovers *l = context;
    if (fracas_disk_is_temporary(name))
        note(l->v, "%s: half written; the next run removes it", path);
    else if (fracas_disk_ends(name, ".damaged"))
        note(l->v, "%s: set aside because it was damaged; nothing needs it", path);
    else if (l->inner && fracas_disk_ends(name, ".h5") && !fracas_segment_of_name(&l->known, name))
        note(l->v, "%s: not in the index; the next run adopts it", path);
    return FRACAS_OK;
}

static fracas_err note_leftovers(verification *v)
{
    OWNED char *folder = NULL;
    leftovers l = {.v = v};
    TRY(note_lock(v));
    if (v->held) return FRACAS_OK; /* its files come and go */
    TRY(problem(v, fracas_index_segments_by_name(v->index, &l.known)));
    fracas_err err = fracas_disk_join(v->study, "segments", &folder);
    if (!err) err = fracas_disk_each(v->study, note_file, &l);
    l.inner = true;
    if (!err) err = fracas_disk_each(folder, note_file, &l);
    fracas_known_segments_clear(&l.known);
    return err;
}

/* ---- segments against the index ---- */

/* For a record read but not compared, and a damaged one, reported with its segment. */
static fracas_err pass(void *context, fracas_result *result)
{
    (void)context, (void)result;
    return FRACAS_OK;
}

/* Facts of a file beside its records, which reports and exports use. */
static fracas_err check_facts(const verification *v, fracas_reader *reader)
{
    TRY(fracas_reader_check_schema(reader));
    return v->options->table ? fracas_reader_check_points(reader, v->options->table) : FRACAS_OK;
}

static fracas_err check_segment(verification *v, int64_t id)
{
    fracas_reader *reader;
    TRY(fracas_segments_open(v->segments, id, &reader));
    fracas_err err = check_facts(v, reader);
    const bool whole = fracas_segment_is_study(fracas_segments_name(v->segments, id));
    if (!err && fracas_reader_header(reader)->complete && !whole)
        err = fracas_fail(FRACAS_DAMAGED, "it says that it is complete, as no segment is");
    if (err == FRACAS_DAMAGED)
        return fracas_fail_within(err,
                                  "to compute its realizations again, move segment %s away and run "
                                  "again",
                                  fracas_segments_name(v->segments, id));
    /* also rows of the index from another segment */
    return err || !v->options->full ? err : fracas_reader_each(reader, FRACAS_READ_ALL, pass, NULL);
}

static fracas_err check_segments(verification *v)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    TRY(fracas_index_segments_by_id(v->index, &known));
    for (size_t s = 0; s < known.count; s++) TRY(problem(v, check_segment(v, known.segment[s].id)));
    return FRACAS_OK;
}

/* One row of the index against its record. */
static fracas_err check_row(void *context, const fracas_hash *point, int64_t replica,
                            const fracas_row_place *place)
{
    verification *v = context;
    if (!point) return found(v, "%s: a point has no valid hash", v->index->path);
    if (fracas_segments_is_bad(v->segments, place->segment)) return FRACAS_OK; /* said already */
    return problem(
        v, fracas_segments_record(v->segments, place, point, replica, FRACAS_READ_ALL, &v->record));
}

/* ---- study.h5 against the segments ---- */

/* Interfaces of a record, where any are kept, are those of its point's mesh. */
static fracas_err check_mesh_fits(verification *v, size_t row, size_t point)
{
    size_t interfaces;
    TRY(fracas_reader_mesh_interfaces(v->merged, point, &interfaces));
    if (!interfaces || !v->record.ninterface || interfaces == v->record.ninterface)
        return FRACAS_OK;
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s/study.h5: row %zu has %zu interfaces, the mesh of its point %zu; " REMAKE, v->study,
        row, v->record.ninterface, interfaces);
}

static fracas_err check_meshes(verification *v)
{
    for (size_t p = 0; p < fracas_reader_points(v->merged)->npoints; p++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
        TRY(problem(v, fracas_reader_mesh(v->merged, p, &mesh)));
    }
    return FRACAS_OK;
}

/* The next row of study.h5 against the row that merge would write there. */
static fracas_err check_merged_row(void *context, fracas_visit *visit)
{
    verification *v = context;
    size_t point, row = v->row++;
    int64_t replica;
    fracas_err err = fracas_reader_record(v->merged, row, FRACAS_READ_ALL, &point, &replica,
                                          &v->record);
    if (err) return problem(v, err);
    if (point != visit->result.point || replica != visit->result.replica)
        return found(v, "%s/study.h5: row %zu is not in plan order; " REMAKE, v->study, row);
    TRY(problem(v, check_mesh_fits(v, row, point)));
    if (visit->damaged) return FRACAS_OK; /* said already */
    const bool computed = visit->place.status != FRACAS_PLANNED &&
                          visit->place.status != FRACAS_LEASED;
    if (!computed && v->record.outcome == FRACAS_FAILED) return FRACAS_OK; /* to retry */
    if (!computed)
        return found(
            v, "%s/study.h5: row %zu is in no segment any more; `fracas run` computes it again",
            v->study, row);
    if (fracas_record_same(&v->record, &visit->result.record)) return FRACAS_OK;
    return found(v, "%s/study.h5: row %zu differs from its segment; " REMAKE, v->study, row);
}

static fracas_err check_merged_rows(verification *v)
{
    const fracas_point_table *table = fracas_reader_points(v->merged);
    uint64_t planned = 0;
    for (size_t p = 0; p < table->npoints; p++) planned += (uint64_t)table->point[p].replicas;
    if (planned != fracas_reader_realizations(v->merged))
        return found(
            v, "%s/study.h5 has %zu realizations, but %" PRIu64 " in its /point/replicas; " REMAKE,
            v->study, fracas_reader_realizations(v->merged), planned);
    const fracas_want want = {.table = table,
                              .parts = FRACAS_READ_ALL,
                              .damaged = pass,
                              .visit = check_merged_row,
                              .context = v};
    return fracas_study_each_planned(v->segments, v->index, &want);
}

static bool same_rule(const fracas_decision *a, const fracas_decision *b)
{
    return a->quantity == b->quantity && a->minimum == b->minimum && a->maximum == b->maximum &&
           a->relative_half_width == b->relative_half_width && a->confidence == b->confidence;
}

/* Decisions of one point: study.h5 from *next on against the index. Decisions in the index by
 * another rule are of an extended campaign: study.h5 is sound then, but older. */
static fracas_err check_decisions_of(verification *v, size_t p, const fracas_decision *merged,
                                     size_t nmerged, size_t *next)
{
    OWNED fracas_decision *recorded = NULL;
    size_t count, same = 0, first = *next;
    const fracas_point_row *point = &fracas_reader_points(v->merged)->point[p];
    while (*next < nmerged && merged[*next].point == (int64_t)p) ++*next;
    if (*next == first) return FRACAS_OK;
    TRY(fracas_index_decisions(v->index, &point->hash, &recorded, &count));
    for (size_t d = 0; d < count && d < *next - first; d++) {
        recorded[d].point = (int64_t)p;
        same += fracas_decision_same(&recorded[d], &merged[first + d]);
    }
    if (count > 0 && !same_rule(&recorded[0], &merged[first])) return FRACAS_OK;
    const fracas_decision *last = &merged[*next - 1];
    if (same == count && count == *next - first && last->stop && last->replicas == point->replicas)
        return FRACAS_OK;
    return found(v,
                 "%s/study.h5: the decisions on the replicas of point %zu are not those that the "
                 "index recorded; " REMAKE,
                 v->study, p);
}

static fracas_err check_decisions(verification *v)
{
    OWNED fracas_decision *merged = NULL;
    size_t count, next = 0;
    TRY(fracas_reader_decisions(v->merged, &merged, &count));
    for (size_t p = 0; p < fracas_reader_points(v->merged)->npoints; p++)
        TRY(problem(v, check_decisions_of(v, p, merged, count, &next)));
    if (next == count) return FRACAS_OK;
    return found(v, "%s/study.h5: its decisions are not in plan order; " REMAKE, v->study);
}

/* When everything is computed, study.h5 must be there with all of it. */
static fracas_err check_merged_whole(verification *v)
{
    fracas_index_counts counts;
    TRY(fracas_index_count(v->index, &counts));
    if (counts.planned || counts.leased || !counts.realizations || v->held) return FRACAS_OK;
    if (!v->merged || (int64_t)fracas_reader_realizations(v->merged) != counts.realizations)
        return found(v,
                     "%s: every realization is computed, but study.h5 is not there or older; "
                     "`fracas merge` writes it",
                     v->study);
    bool complete = fracas_reader_header(v->merged)->complete;
    if (complete == (counts.failed == 0)) return FRACAS_OK;
    return found(v, "%s/study.h5: its attribute `complete` is wrong; " REMAKE, v->study);
}

/* ---- all of it ---- */

/* Its bytes before HDF5 sees them, for a flipped one can crash it. */
static fracas_err check_merged_seal(verification *v, const char *path)
{
    bool sealed;
    fracas_file_seal wanted;
    TRY(fracas_index_study_seal(v->index, &sealed, &wanted));
    if (v->held && (!sealed || fracas_disk_check_seal(path, &wanted) == FRACAS_DAMAGED))
        return fracas_fail(FRACAS_IN_USE,
                           "%s is not as its seal says: the run that has the study may be writing "
                           "it; verify again when it has ended",
                           path);
    if (!sealed)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s has no seal: its merge was interrupted, or the index is newer; "
                           "`fracas merge` writes it again",
                           path);
    fracas_err err = fracas_disk_check_seal(path, &wanted);
    return err == FRACAS_DAMAGED
               ? fracas_fail_within(err, "to make it again, remove %s, and `fracas merge` it", path)
               : err;
}

static fracas_err check_merged_header(verification *v)
{
    fracas_identity has;
    char text[FRACAS_DIFFERENCE_TEXT];
    fracas_identity_of(fracas_reader_header(v->merged), &has);
    if (fracas_identity_differs(&has, &v->identity, text))
        return found(v, "%s/study.h5: not of this study: %s; " REMAKE, v->study, text);
    const fracas_err err = check_facts(v, v->merged);
    return problem(v, err == FRACAS_DAMAGED
                          ? fracas_fail_within(err,
                                               "to make it again, remove %s/study.h5, and "
                                               "`fracas merge` it",
                                               v->study)
                          : err);
}

static fracas_err open_merged(verification *v)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_join(v->study, "study.h5", &path));
    v->there = access(path, F_OK) == 0;
    if (!v->there) return errno == ENOENT ? FRACAS_OK : fracas_disk_fail("open", path);
    TRY(check_merged_seal(v, path));
    return fracas_reader_open(path, &v->merged);
}

/* campaign.yaml has the seed and output with which the study was begun. */
static fracas_err check_campaign(verification *v)
{
    fracas_identity campaign;
    char text[FRACAS_DIFFERENCE_TEXT];
    fracas_identity_of(v->options->header, &campaign);
    *campaign.value[0] = '\0'; /* any program looks at it */
    if (!fracas_identity_differs(&campaign, &v->identity, text)) return FRACAS_OK;
    return found(v, "%s/campaign.yaml: %s, with which the study was begun; put it back", v->study,
                 text);
}

/* Points and replicas in the index against the campaign, which a run may be extending. */
static fracas_err check_plan(verification *v)
{
    const fracas_point_table *table = v->options->table;
    if (!table || v->held) return FRACAS_OK;
    TRY(problem(v, fracas_index_check_points(v->index, table)));
    for (size_t p = 0; p < table->npoints; p++) {
        const fracas_point_row *point = &table->point[p];
        int64_t replicas, known;
        TRY(fracas_sql_numbers(v->index, "SELECT replicas, 1 FROM point WHERE hash = ?1",
                               SQL_VALUES(SQL_HASH(&point->hash)), &replicas, &known));
        if (known && replicas > (point->most ? point->most : point->replicas))
            TRY(found(v,
                      "%s: point %zu has %" PRId64
                      " replicas, more than the campaign asks for; " REINDEX,
                      v->index->path, p, replicas));
    }
    return FRACAS_OK;
}

/* Within a transaction: a run may be at work. */
static fracas_err verify_all(verification *v)
{
    const bool full = v->options->full;
    TRY(problem(v, check_database(v, full ? "PRAGMA integrity_check" : "PRAGMA quick_check")));
    TRY(problem(v, check_database(v, "PRAGMA foreign_key_check")));
    TRY(problem(v, check_consistency(v)));
    TRY(note_leftovers(v));
    TRY(check_places(v));
    TRY(check_plan(v));
    TRY(fracas_index_identity(v->index, &v->identity));
    if (v->options->header) TRY(check_campaign(v));
    TRY(problem(v, open_merged(v)));
    if (v->merged) TRY(check_merged_header(v));
    TRY(fracas_segments_create(v->study, v->index, &v->identity, false, &v->segments));
    TRY(problem(v, check_segments(v)));
    if (full) TRY(problem(v, fracas_index_each_by_segment(v->index, check_row, v)));
    if (full && v->merged) TRY(problem(v, check_merged_rows(v)));
    if (v->merged) TRY(problem(v, check_decisions(v)));
    if (full && v->merged) TRY(check_meshes(v));
    return v->there && !v->merged ? FRACAS_OK : check_merged_whole(v); /* said already */
}

/* A run may end, or begin, between the look at its lock and the moment of the index: it counts if
 * it has the study before that moment or after it (note_lock). */
static fracas_err verify(verification *v)
{
    char holder[FRACAS_HOLDER_TEXT];
    fracas_lock_state state;
    TRY(fracas_index_open(v->study, false, &v->index));
    TRY(fracas_study_lock_state(v->study, &state, holder));
    v->held = state == FRACAS_LOCK_HELD;
    TRY(fracas_index_begin_reading(v->index));
    return fracas_index_end(v->index, verify_all(v));
}

fracas_err fracas_study_verify(const char *study, const fracas_verify_options *options,
                               int64_t *problems)
{
    verification v = {.study = study, .options = options};
    fracas_err err = problem(&v, verify(&v));
    fracas_record_clear(&v.record);
    fracas_segments_destroy(v.segments);
    fracas_reader_close(v.merged);
    fracas_index_close(v.index);
    *problems = v.problems;
    return err;
}
