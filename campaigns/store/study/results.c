/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/results.h"

#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/schema.h"
#include "campaigns/store/lock.h"
#include "campaigns/store/study/segments.h"

#include <errno.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A done or failed realization, as in the index. */
typedef struct {
    size_t point;
    int64_t replica;
    fracas_row_place place;
    bool lost; /* it could not be read */
} entry;

struct fracas_results {
    fracas_reader *reader; /* study.h5; NULL of partial ones */
    fracas_file_header header;
    fracas_point_table table;
    fracas_decision *decision;
    size_t ndecisions, decision_room;
    size_t nrows, room;
    entry *row;              /* from here to `segments` for partial ones */
    fracas_point_row *point; /* the table's, with the replicas so far */
    int64_t *missing;        /* at each point */
    fracas_segments *segments;
    char **note;
    size_t nnotes, note_room;
    int64_t *named; /* segments that a note names */
    size_t nnamed, named_room;
};

FRACAS_PRINTF(2, 3) static fracas_err take_note(fracas_results *results, const char *format, ...)
{
    char *text;
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(&text, format, arguments);
    va_end(arguments);
    if (length < 0) return fracas_no_memory("a note");
    fracas_err err = fracas_grow(&results->note, sizeof *results->note, results->nnotes,
                                 &results->note_room, "a note");
    if (err) free(text);
    else results->note[results->nnotes++] = text;
    return err;
}

/* ---- study.h5 ---- */

static fracas_err open_file(const char *study, bool old, fracas_reader **reader)
{
    OWNED char *path = NULL;
    TRY(fracas_disk_join(study, "study.h5", &path));
    if (access(path, F_OK) && errno == ENOENT)
        return fracas_fail(FRACAS_DAMAGED, "%s is not there; `fracas run` makes it", path);
    return old ? fracas_reader_open_old(path, reader) : fracas_reader_open(path, reader);
}

/* Names the columns of later format versions. */
static fracas_err note_format(fracas_results *results)
{
    const fracas_file_header *header = fracas_reader_header(results->reader);
    char lacking[512] = "";
    if (header->format == FRACAS_FORMAT_VERSION) return FRACAS_OK;
    fracas_store_lacks(header->format, lacking, sizeof lacking);
    return take_note(results,
                     "study.h5 is of fracas %s, format version %" PRId64
                     ", which had no %s: what needs these is missing",
                     header->version, header->format, lacking);
}

/* Takes study.h5 if it has every realization of the index; else leaves results->reader NULL. */
static fracas_err take_file(const char *study, fracas_index *index, const fracas_hash *campaign,
                            fracas_results *results)
{
    bool sealed;
    fracas_index_counts counts;
    OWN(fracas_reader) reader = NULL;
    TRY(fracas_study_file_sealed(study, index, &sealed));
    if (!sealed) return FRACAS_OK;
    TRY(fracas_index_count(index, &counts));
    if (counts.planned || counts.leased) return FRACAS_OK;
    TRY(open_file(study, false, &reader));
    if (!fracas_hash_equal(&fracas_reader_header(reader)->campaign, campaign) ||
        (int64_t)fracas_reader_realizations(reader) != counts.realizations)
        return FRACAS_OK;
    results->reader = reader;
    reader = NULL;
    return FRACAS_OK;
}

/* Without an index, whose message is the present one: study.h5, if it is of this campaign. */
static fracas_err take_file_alone(const char *study, const fracas_hash *campaign,
                                  fracas_results *results)
{
    OWNED char *why = strdup(fracas_message());
    OWNED char *path = NULL;
    if (!why) return fracas_no_memory("a message");
    TRY(fracas_disk_join(study, "study.h5", &path));
    if (access(path, F_OK) && errno == ENOENT)
        return fracas_fail(FRACAS_DAMAGED, "%s; and there is no %s/study.h5", why, study);
    TRY(open_file(study, false, &results->reader));
    if (!fracas_hash_equal(&fracas_reader_header(results->reader)->campaign, campaign))
        return fracas_fail(FRACAS_DAMAGED,
                           "%s; and %s/study.h5 is of another campaign than %s/campaign.yaml, from "
                           "before it was extended",
                           why, study, study);
    return take_note(results, "%s; study.h5 is taken as it is", why);
}

/* ---- the index ---- */

static fracas_err add_row(fracas_results *results, size_t p, int64_t replica,
                          const fracas_row_place *place)
{
    TRY(fracas_grow(&results->row, sizeof *results->row, results->nrows, &results->room,
                    "the realizations of a study"));
    results->row[results->nrows++] = (entry){.point = p, .replica = replica, .place = *place};
    return FRACAS_OK;
}

/* The rows of a point, without replicas beyond the campaign's. */
static fracas_err read_rows(fracas_results *results, fracas_index *index, size_t p)
{
    fracas_point_row *point = &results->point[p];
    const int64_t most = point->most ? point->most : point->replicas;
    int64_t given = 0;
    fracas_err err;
    OWN(sqlite3_stmt) s = NULL;
    TRY(fracas_sql_start(index,
                         "SELECT replica, " FRACAS_PLACE_COLUMNS
                         " FROM realization WHERE point = (SELECT id FROM point WHERE hash = ?1) "
                         "ORDER BY replica",
                         SQL_VALUES(SQL_HASH(&point->hash)), &s));
    while (fracas_sql_next(index, s, &err)) {
        const int64_t replica = sqlite3_column_int64(s, 0);
        if (replica < 0 || replica >= most) continue;
        given++;
        const fracas_row_place place = fracas_place_read(s, 1);
        if (place.status != FRACAS_PLANNED && place.status != FRACAS_LEASED)
            TRY(add_row(results, p, replica, &place));
    }
    if (point->most && given) point->replicas = given;
    return err;
}

static fracas_err read_decisions(fracas_results *results, fracas_index *index)
{
    for (size_t p = 0; p < results->table.npoints; p++) {
        OWNED fracas_decision *decision = NULL;
        size_t count;
        int64_t id;
        if (!results->point[p].most) continue;
        TRY(fracas_index_find_point(index, &results->point[p].hash, &id));
        if (!id) continue; /* it is not planned yet */
        TRY(fracas_index_decisions(index, &results->point[p].hash, &decision, &count));
        for (size_t d = 0; d < count; d++) {
            TRY(fracas_grow(&results->decision, sizeof *results->decision, results->ndecisions,
                            &results->decision_room, "the decisions of a study"));
            decision[d].point = (int64_t)p;
            results->decision[results->ndecisions++] = decision[d];
        }
    }
    return FRACAS_OK;
}

/* The header of its segments, from the identity of the study. */
static fracas_err read_header(const fracas_index *index, const fracas_identity *identity,
                              const fracas_hash *campaign, fracas_file_header *header)
{
    *header = (fracas_file_header){.campaign = *campaign};
    snprintf(header->version, sizeof header->version, "%.31s", identity->value[0]);
    header->seed = strtoull(identity->value[1], NULL, 10);
    header->history = strtoll(identity->value[2], NULL, 10);
    header->interfaces = !strcmp(identity->value[3], "1");
    header->reactions = !strcmp(identity->value[5], "1");
    if (!fracas_probes_parse(identity->value[4], &header->probes)) /* "none", or none known */
        header->probes = (fracas_probes){0};
    if (header->history >= 0 && header->history <= FRACAS_MOST_HISTORY) return FRACAS_OK;
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s: its history, `%s`, is out of range; `fracas reindex` makes it anew from "
        "the segments",
        index->path, identity->value[2]);
}

/* The points of the index are the campaign's, unless a run is extending it at this moment. */
static fracas_err check_points(const char *study, fracas_index *index,
                               const fracas_results *results)
{
    char holder[FRACAS_HOLDER_TEXT];
    fracas_lock_state state;
    TRY(fracas_study_lock_state(study, &state, holder));
    return state == FRACAS_LOCK_HELD ? FRACAS_OK
                                     : fracas_index_check_points(index, &results->table);
}

/* Within a transaction, at one moment. */
static fracas_err read_index(const char *study, fracas_index *index, const fracas_hash *campaign,
                             fracas_results *results)
{
    fracas_identity identity;
    TRY(take_file(study, index, campaign, results));
    if (results->reader) return FRACAS_OK;
    TRY(check_points(study, index, results));
    TRY(fracas_index_identity(index, &identity));
    TRY(read_header(index, &identity, campaign, &results->header));
    for (size_t p = 0; p < results->table.npoints; p++) TRY(read_rows(results, index, p));
    TRY(read_decisions(results, index));
    return fracas_segments_create(study, index, &identity, true, &results->segments);
}

/* ---- opening ---- */

/* Facts of study.h5 and of partial results. */
static fracas_err read_facts(fracas_results *results)
{
    results->header = *fracas_reader_header(results->reader);
    results->table = *fracas_reader_points(results->reader);
    results->nrows = fracas_reader_realizations(results->reader);
    return fracas_reader_decisions(results->reader, &results->decision, &results->ndecisions);
}

static fracas_err copy_table(const fracas_point_table *table, fracas_results *results)
{
    results->table = *table;
    results->table.point = results->point = malloc((table->npoints + 1) * sizeof *results->point);
    results->missing = calloc(table->npoints + 1, sizeof *results->missing);
    if (!results->point || !results->missing) return fracas_no_memory("the points of a study");
    memcpy(results->point, table->point, table->npoints * sizeof *table->point);
    return FRACAS_OK;
}

static fracas_err check_any(const char *study, const fracas_results *results)
{
    if (results->reader || results->nrows) return FRACAS_OK;
    int64_t planned = 0;
    for (size_t p = 0; p < results->table.npoints; p++) planned += results->point[p].replicas;
    return fracas_fail(FRACAS_INTERRUPTED,
                       "no realization of %s is done yet, of %" PRId64
                       ": there is nothing to report; `fracas run` with the campaign file goes on",
                       study, planned);
}

static fracas_err open_by_index(const char *study, const fracas_hash *campaign,
                                fracas_results *results)
{
    OWN(fracas_index) index = NULL;
    fracas_err err = fracas_index_open(study, false, &index);
    if (err == FRACAS_DAMAGED) return take_file_alone(study, campaign, results);
    if (!err) err = fracas_index_begin_reading(index);
    if (!err) err = fracas_index_end(index, read_index(study, index, campaign, results));
    if (err == FRACAS_IN_USE)
        err = fracas_fail_within(
            err,
            "the index of %s cannot be read now: on a network filesystem nobody else can while a "
            "run has it; try again when the run has ended",
            study);
    return err ? err : check_any(study, results);
}

fracas_err fracas_results_open(const char *study, const fracas_hash *campaign,
                               const fracas_point_table *table, fracas_results **results)
{
    OWN(fracas_results) new = calloc(1, sizeof *new);
    *results = NULL;
    if (!new) return fracas_no_memory("the results of a study");
    if (campaign && table) {
        TRY(copy_table(table, new));
        TRY(open_by_index(study, campaign, new));
    } else {
        TRY(open_file(study, true, &new->reader));
        TRY(note_format(new));
    }
    if (new->reader) TRY(read_facts(new));
    *results = new;
    new = NULL;
    return FRACAS_OK;
}

void fracas_results_close(fracas_results *results)
{
    if (!results) return;
    fracas_reader_close(results->reader);
    fracas_segments_destroy(results->segments);
    for (size_t n = 0; n < results->nnotes; n++) free(results->note[n]);
    free(results->note);
    free(results->named);
    free(results->point);
    free(results->missing);
    free(results->row);
    free(results->decision);
    free(results);
}

/* ---- one realization ---- */

/* Leaves a row out; the present message says why. Its segment is named once. */
static fracas_err lose(fracas_results *results, entry *row)
{
    const int64_t id = row->place.segment;
    row->lost = true;
    results->missing[row->point]++;
    for (size_t n = 0; n < results->nnamed; n++)
        if (results->named[n] == id) return FRACAS_OK;
    TRY(fracas_grow(&results->named, sizeof *results->named, results->nnamed, &results->named_room,
                    "a note"));
    results->named[results->nnamed++] = id;
    OWNED char *why = strdup(fracas_message());
    if (!why) return fracas_no_memory("a note");
    return take_note(results, "segment %s is left out (`fracas verify` checks the study): %s",
                     fracas_segments_name(results->segments, id), why);
}

static fracas_err read_entry(fracas_results *results, const entry *row, unsigned parts,
                             fracas_record *record)
{
    fracas_record_clear(record);
    if (row->place.status != FRACAS_DONE) return FRACAS_OK; /* it failed: nothing is known of it */
    return fracas_segments_record(results->segments, &row->place, &results->point[row->point].hash,
                                  row->replica, parts, record);
}

fracas_err fracas_results_record(fracas_results *results, size_t row, unsigned parts, size_t *point,
                                 int64_t *replica, fracas_record *record)
{
    if (results->reader)
        return fracas_reader_record(results->reader, row, parts, point, replica, record);
    if (row >= results->nrows)
        return fracas_fail(FRACAS_BUG, "there are %zu realizations by now; row %zu was asked for",
                           results->nrows, row);
    *point = results->row[row].point;
    *replica = results->row[row].replica;
    return read_entry(results, &results->row[row], parts, record);
}

/* Rows are in plan order. */
fracas_err fracas_results_find(fracas_results *results, size_t point, int64_t replica, size_t *row)
{
    FRACAS_CLEARED(fracas_record) record;
    fracas_record_init(&record);
    size_t low = 0, high = results->nrows;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        size_t p;
        int64_t r;
        if (results->reader) {
            TRY(fracas_reader_record(results->reader, middle, 0, &p, &r, &record));
        } else {
            p = results->row[middle].point;
            r = results->row[middle].replica;
        }
        if (p == point && r == replica) {
            *row = middle;
            return FRACAS_OK;
        }
        if (p < point || (p == point && r < replica)) low = middle + 1;
        else high = middle;
    }
    *row = results->nrows;
    return FRACAS_OK;
}

/* ---- all of them ---- */

typedef struct {
    fracas_results *results;
    fracas_result_visit *visit;
    void *context;
} walk;

static fracas_err next_row(void *context, fracas_visit *visit, bool *more)
{
    const fracas_results *results = context;
    *more = visit->result.row < results->nrows;
    if (!*more) return FRACAS_OK;
    const entry *row = &results->row[visit->result.row];
    visit->result.point = row->point;
    visit->result.replica = row->replica;
    visit->place = row->place;
    visit->damaged = row->lost;
    return FRACAS_OK;
}

static fracas_err lose_row(void *context, fracas_result *result)
{
    const walk *w = context;
    return lose(w->results, &w->results->row[result->row]);
}

static fracas_err visit_row(void *context, fracas_visit *visit)
{
    const walk *w = context;
    return visit->damaged ? FRACAS_OK : w->visit(w->context, &visit->result);
}

fracas_err fracas_results_walk(fracas_results *results, unsigned parts, fracas_result_visit *visit,
                               void *context)
{
    walk w = {results, visit, context};
    const fracas_want want = {.table = &results->table,
                              .parts = parts,
                              .next = next_row,
                              .source = results,
                              .damaged = lose_row,
                              .visit = visit_row,
                              .context = &w};
    return results->reader ? fracas_reader_each(results->reader, parts, visit, context)
                           : fracas_study_each(results->segments, &want);
}

/* ---- facts about them ---- */

bool fracas_results_partial(const fracas_results *results)
{
    return results && !results->reader;
}

const fracas_file_header *fracas_results_header(const fracas_results *results)
{
    return &results->header;
}

const fracas_point_table *fracas_results_points(const fracas_results *results)
{
    return &results->table;
}

size_t fracas_results_realizations(const fracas_results *results)
{
    return results->nrows;
}

int64_t fracas_results_missing(const fracas_results *results, size_t point)
{
    return fracas_results_partial(results) ? results->missing[point] : 0;
}

bool fracas_results_decided(const fracas_results *results, size_t point)
{
    bool decided = !fracas_results_partial(results) || !results->point[point].most;
    for (size_t d = 0; !decided && d < results->ndecisions; d++)
        decided = results->decision[d].point == (int64_t)point && results->decision[d].stop != 0;
    return decided;
}

size_t fracas_results_notes(const fracas_results *results)
{
    return results ? results->nnotes : 0;
}
const char *fracas_results_note(const fracas_results *results, size_t note)
{
    return results->note[note];
}

const fracas_decision *fracas_results_decisions(const fracas_results *results, size_t *count)
{
    *count = results->ndecisions;
    return results->decision;
}

fracas_err fracas_results_mesh_interfaces(fracas_results *results, size_t point, size_t *interfaces)
{
    *interfaces = 0;
    return results->reader ? fracas_reader_mesh_interfaces(results->reader, point, interfaces)
                           : FRACAS_OK;
}

fracas_err fracas_results_mesh(fracas_results *results, size_t point, fracas_stored_mesh *mesh)
{
    *mesh = (fracas_stored_mesh){0};
    return results->reader ? fracas_reader_mesh(results->reader, point, mesh) : FRACAS_OK;
}
