/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/study/segments.h"

#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

static const char reindex[] = "`fracas reindex` makes the index anew from the segments";

struct fracas_segments {
    const char *study;
    char *index_path; /* for messages, when the index is closed */
    fracas_identity identity;
    uint64_t history;            /* most history rows of a record */
    uint64_t probes;             /* rows of each */
    fracas_known_segments known; /* by id */
    bool *checked, *bad;         /* each of them */
    bool only_records;
    size_t current;        /* the one that is open, */
    unsigned parts;        /* with these parts */
    fracas_reader *reader; /* NULL if none is */
};

fracas_err fracas_segments_create(const char *study, fracas_index *index,
                                  const fracas_identity *identity, bool only_records,
                                  fracas_segments **segments)
{
    OWN(fracas_segments) new = calloc(1, sizeof *new);
    *segments = NULL;
    if (!new) return fracas_no_memory("the segments");
    new->study = study;
    new->identity = *identity;
    new->only_records = only_records;
    new->history = strtoull(identity->value[2], NULL, 10) + 4;
    fracas_probes probes;
    if (fracas_probes_parse(identity->value[4], &probes)) new->probes = probes.count;
    TRY(fracas_index_segments_by_id(index, &new->known));
    new->index_path = strdup(index->path);
    new->checked = calloc(new->known.count + 1, sizeof *new->checked);
    new->bad = calloc(new->known.count + 1, sizeof *new->bad);
    if (!new->index_path || !new->checked || !new->bad) return fracas_no_memory("the segments");
    *segments = new;
    new = NULL;
    return FRACAS_OK;
}

void fracas_segments_destroy(fracas_segments *segments)
{
    if (!segments) return;
    fracas_reader_close(segments->reader);
    fracas_known_segments_clear(&segments->known);
    free(segments->checked);
    free(segments->bad);
    free(segments->index_path);
    free(segments);
}

/* ---- one segment ---- */

/* Its number in the list, SIZE_MAX for an unknown id. */
static size_t find(const fracas_segments *segments, int64_t id)
{
    const fracas_known_segment *found = fracas_segment_of_id(&segments->known, id);
    return found ? (size_t)(found - segments->known.segment) : SIZE_MAX;
}

bool fracas_segments_is_bad(const fracas_segments *segments, int64_t id)
{
    size_t s = find(segments, id);
    return s != SIZE_MAX && segments->bad[s];
}

const char *fracas_segments_name(const fracas_segments *segments, int64_t id)
{
    const fracas_known_segment *segment = fracas_segment_of_id(&segments->known, id);
    return segment ? segment->name : "";
}

uint64_t fracas_segments_size(const fracas_segments *segments, const fracas_row_place *place,
                              unsigned parts)
{
    const fracas_known_segment *segment = fracas_segment_of_id(&segments->known, place->segment);
    uint64_t bytes = 0;
    if (parts & FRACAS_READ_FRAGMENTS)
        bytes += (uint64_t)place->summary.fragments * sizeof(fracas_fragment);
    if (parts & FRACAS_READ_HISTORY) bytes += segments->history * sizeof(fracas_history_row);
    if (parts & FRACAS_READ_PROBES)
        bytes += segments->history * segments->probes * sizeof(fracas_probe_row);
    if (parts & FRACAS_READ_REACTIONS && !strcmp(segments->identity.value[5], "1")) {
        enum { EDGES = 9 }; /* at most */
        bytes += segments->history * EDGES * sizeof(fracas_reaction_row);
    }
    if (parts & FRACAS_READ_INTERFACES && segment) /* they are stored compactly */
        bytes += 2 * segment->seal.bytes / (uint64_t)(segment->rows + 1);
    return bytes;
}

static fracas_err check_identity(const fracas_segments *segments, const char *path)
{
    fracas_identity found;
    char text[FRACAS_DIFFERENCE_TEXT];
    fracas_identity_of(fracas_reader_header(segments->reader), &found);
    if (!fracas_identity_differs(&found, &segments->identity, text)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s: not of this study: %s", path, text);
}

static fracas_err open_reader(fracas_segments *segments, const char *path)
{
    return segments->only_records
               ? fracas_reader_open_records(path, segments->parts, &segments->reader)
               : fracas_reader_open(path, &segments->reader);
}

static fracas_err open_segment(fracas_segments *segments, size_t s)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_segment(segments->study, segments->known.segment[s].name, &path));
    fracas_err err = segments->checked[s]
                         ? FRACAS_OK
                         : fracas_disk_check_seal(path, &segments->known.segment[s].seal);
    if (!err) err = open_reader(segments, path);
    if (!err) err = check_identity(segments, path);
    if (err) fracas_reader_close(segments->reader), segments->reader = NULL;
    segments->checked[s] = true;
    segments->bad[s] = err == FRACAS_DAMAGED;
    if (!segments->bad[s]) return err;
    if (access(path, F_OK) < 0 && errno == ENOENT)
        return fracas_fail_within(err, "index.sqlite names a segment that is missing; run again to "
                                       "compute its realizations again");
    return fracas_fail_within(err, "to compute its realizations again, move %s away and run again",
                              path);
}

static fracas_err open_with(fracas_segments *segments, int64_t id, unsigned parts)
{
    size_t s = find(segments, id);
    if (s == SIZE_MAX)
        return fracas_fail(FRACAS_DAMAGED, "%s has no segment %" PRId64 "; %s",
                           segments->index_path, id, reindex);
    if (segments->bad[s])
        return fracas_fail(FRACAS_DAMAGED, "segment %s is damaged; `fracas verify` says what to do",
                           segments->known.segment[s].name);
    if (segments->reader && segments->current == s && (segments->parts & parts) == parts)
        return FRACAS_OK;
    fracas_reader_close(segments->reader);
    segments->reader = NULL;
    segments->current = s;
    segments->parts = segments->only_records ? parts : FRACAS_READ_ALL;
    return open_segment(segments, s);
}

fracas_err fracas_segments_open(fracas_segments *segments, int64_t id, fracas_reader **reader)
{
    TRY(open_with(segments, id, FRACAS_READ_ALL));
    *reader = segments->reader;
    return FRACAS_OK;
}

fracas_err fracas_segments_record(fracas_segments *segments, const fracas_row_place *place,
                                  const fracas_hash *point, int64_t replica, unsigned parts,
                                  fracas_record *record)
{
    TRY(open_with(segments, place->segment, parts));
    const char *name = segments->known.segment[segments->current].name;
    fracas_reader *reader = segments->reader;
    if (place->row < 0 || (uint64_t)place->row >= fracas_reader_realizations(reader))
        return fracas_fail(FRACAS_DAMAGED,
                           "segment %s has no row %" PRId64 ", which the index names; %s", name,
                           place->row, reindex);
    size_t found_point;
    int64_t found_replica;
    fracas_err err = fracas_reader_record(reader, (size_t)place->row, parts, &found_point,
                                          &found_replica, record);
    if (err == FRACAS_DAMAGED)
        err = fracas_fail_within(err,
                                 "to compute its realizations again, move it away and run again");
    TRY(err);
    if (!fracas_hash_equal(&fracas_reader_points(reader)->point[found_point].hash, point) ||
        found_replica != replica)
        return fracas_fail(FRACAS_DAMAGED,
                           "segment %s: row %" PRId64
                           " is another realization than the index says; %s",
                           name, place->row, reindex);
    if (fracas_place_fits(place, record, parts & FRACAS_READ_FRAGMENTS)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: replica %" PRId64
                       " of point %s: its row differs from its record in segment %s; %s",
                       segments->index_path, replica, fracas_hash_hex(point).text, name, reindex);
}

fracas_err fracas_segments_check_failed(const fracas_segments *segments,
                                        const fracas_row_place *place, int64_t replica)
{
    const bool failed = place->status == FRACAS_FAILED_ROW || place->status == FRACAS_QUARANTINED;
    if (!failed || place->summary.outcome == FRACAS_FAILED) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: replica %" PRId64 " of a point has failed, but has the outcome %" PRId64
                       "; %s",
                       segments->index_path, replica, place->summary.outcome, reindex);
}

/* ---- the walk over the realizations of a study ---- */

/* Realizations read ahead, in the order of the walk. */
typedef struct {
    fracas_visit *item;
    size_t count, room;
} window;

enum { WINDOW_BYTES = 128 << 20 };

typedef struct {
    fracas_index *index;
    const fracas_point_table *table;
    size_t point;
    int64_t replica;
} plan;

static fracas_err next_planned(void *context, fracas_visit *visit, bool *more)
{
    plan *at = context;
    const fracas_point_table *table = at->table;
    while (at->point < table->npoints && at->replica == table->point[at->point].replicas)
        at->point++, at->replica = 0;
    *more = at->point < table->npoints;
    if (!*more) return FRACAS_OK;
    visit->result.point = at->point;
    visit->result.replica = at->replica++;
    return fracas_index_place(at->index, &table->point[at->point].hash, visit->result.replica,
                              &visit->place);
}

/* From row *row on as many as fit; *more: others follow. */
static fracas_err window_fill(window *w, const fracas_segments *segments, const fracas_want *want,
                              size_t *row, bool *more)
{
    for (uint64_t bytes = 0; bytes < WINDOW_BYTES;) {
        TRY(fracas_grow(&w->item, sizeof *w->item, w->count, &w->room, "realizations read ahead"));
        fracas_visit *item = &w->item[w->count];
        *item = (fracas_visit){.result.row = *row};
        fracas_record_init(&item->result.record);
        TRY(want->next(want->source, item, more));
        if (!*more) break;
        w->count++;
        ++*row;
        bytes += sizeof *item + sizeof item +
                 fracas_segments_size(segments, &item->place, want->parts);
    }
    return FRACAS_OK;
}

static int by_place(const void *a, const void *b)
{
    const fracas_row_place *x = &(*(fracas_visit *const *)a)->place,
                           *y = &(*(fracas_visit *const *)b)->place;
    if (x->segment != y->segment) return x->segment < y->segment ? -1 : 1;
    return (x->row > y->row) - (x->row < y->row);
}

static fracas_err window_read(window *w, fracas_segments *segments, const fracas_want *want)
{
    size_t n = 0;
    OWNED fracas_visit **sorted = malloc((w->count + 1) * sizeof *sorted);
    if (!sorted) return fracas_no_memory("realizations read ahead");
    for (size_t i = 0; i < w->count; i++) {
        if (!want->damaged)
            TRY(fracas_segments_check_failed(segments, &w->item[i].place,
                                             w->item[i].result.replica));
        if (w->item[i].place.status == FRACAS_DONE && !w->item[i].damaged)
            sorted[n++] = &w->item[i];
    }
    if (n) qsort(sorted, n, sizeof *sorted, by_place);
    for (size_t i = 0; i < n; i++) {
        fracas_result *result = &sorted[i]->result;
        fracas_err err = fracas_segments_record(segments, &sorted[i]->place,
                                                &want->table->point[result->point].hash,
                                                result->replica, want->parts, &result->record);
        sorted[i]->damaged = err == FRACAS_DAMAGED;
        if (err == FRACAS_DAMAGED && want->damaged) err = want->damaged(want->context, result);
        TRY(err);
    }
    return FRACAS_OK;
}

static void window_empty(window *w)
{
    for (size_t i = 0; i < w->count; i++) fracas_record_clear(&w->item[i].result.record);
    w->count = 0;
}

fracas_err fracas_study_each(fracas_segments *segments, const fracas_want *want)
{
    window w = {0};
    size_t row = 0;
    bool more = true;
    fracas_err err = FRACAS_OK;
    while (!err && more) {
        err = window_fill(&w, segments, want, &row, &more);
        if (!err) err = window_read(&w, segments, want);
        for (size_t i = 0; !err && i < w.count; i++) err = want->visit(want->context, &w.item[i]);
        window_empty(&w);
    }
    free(w.item);
    return err;
}

fracas_err fracas_study_each_planned(fracas_segments *segments, fracas_index *index,
                                     const fracas_want *want)
{
    plan planned = {.index = index, .table = want->table};
    fracas_want all = *want;
    all.next = next_planned;
    all.source = &planned;
    if (!sqlite3_get_autocommit(index->db)) return fracas_study_each(segments, &all);
    TRY(fracas_index_begin_reading(index)); /* one lock for all its look-ups */
    return fracas_index_end(index, fracas_study_each(segments, &all));
}
