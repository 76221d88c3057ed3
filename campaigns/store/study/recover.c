/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sweeping a study after an interruption. */
#include "campaigns/store/file/disk.h"
#include "campaigns/store/study/segments.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static fracas_err remove_file(const char *path)
{
    return unlink(path) == 0 || errno == ENOENT ? FRACAS_OK : fracas_disk_fail("remove", path);
}

static int no_dots(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

/* Names in a folder, sorted, so that what recover does depends on nothing else. */
static fracas_err list_folder(const char *folder, struct dirent ***entry, int *count)
{
    *count = scandir(folder, entry, no_dots, alphasort);
    return *count < 0 ? fracas_disk_fail("list", folder) : FRACAS_OK;
}

static void free_list(struct dirent **entry, int count)
{
    for (int e = 0; e < count; e++) free(entry[e]);
    if (count >= 0) free(entry);
}

static fracas_err remove_temporaries(const char *folder, FILE *report)
{
    struct dirent **entry;
    int count;
    TRY(list_folder(folder, &entry, &count));
    fracas_err err = FRACAS_OK;
    for (int e = 0; !err && e < count; e++) {
        char *path;
        if (!fracas_disk_is_temporary(entry[e]->d_name)) continue;
        err = fracas_disk_join(folder, entry[e]->d_name, &path);
        if (err) break;
        err = remove_file(path);
        if (!err) fprintf(report, "removed %s, half written\n", path);
        free(path);
    }
    free_list(entry, count);
    return err;
}

/* Of merges, and of segments. */
static fracas_err sweep(const char *study, FILE *report)
{
    char *folder;
    TRY(remove_temporaries(study, report));
    TRY(fracas_disk_join(study, "segments", &folder));
    fracas_err err = remove_temporaries(folder, report);
    free(folder);
    return err;
}

fracas_err fracas_study_sweep(const char *study, char **report)
{
    size_t size;
    *report = NULL;
    FILE *text = open_memstream(report, &size);
    if (!text) return fracas_no_memory("a report");
    fracas_err err = sweep(study, text);
    if (fclose(text) != 0 && !err) err = fracas_no_memory("a report");
    if (err) free(*report), *report = NULL;
    return err;
}

/* ---- segments that the index knows, but the folder has not ---- */

fracas_err fracas_segment_is_there(const char *study, const fracas_known_segment *segment,
                                   bool *there)
{
    char *path;
    TRY(fracas_disk_segment(study, segment->name, &path));
    fracas_err err = fracas_disk_has_size(path, segment->seal.bytes, there);
    free(path);
    return err;
}

fracas_err fracas_segment_check(const char *study, const fracas_known_segment *segment)
{
    char *path;
    TRY(fracas_disk_segment(study, segment->name, &path));
    fracas_err err = fracas_disk_check_seal(path, &segment->seal);
    free(path);
    return err;
}

/* Out of the way, but kept: nothing that was once a result is removed by itself. */
static fracas_err set_aside(const char *path, FILE *report)
{
    char *aside;
    TRY(fracas_disk_set_aside(path, &aside));
    fprintf(report, "; it is %s now\n", aside);
    free(aside);
    return FRACAS_OK;
}

/* *lost: its realizations must be computed again. */
static fracas_err sweep_segment(const char *study, const fracas_known_segment *segment, bool seal,
                                FILE *report, bool *lost)
{
    char *path;
    bool there;
    TRY(fracas_segment_is_there(study, segment, &there));
    fracas_err err = there && seal ? fracas_segment_check(study, segment) : FRACAS_OK;
    *lost = !there || err == FRACAS_DAMAGED;
    if (!*lost) return err;
    TRY(fracas_disk_segment(study, segment->name, &path));
    if (access(path, F_OK) < 0) {
        fprintf(report, "segment %s is missing\n", segment->name);
        err = FRACAS_OK;
    } else {
        if (there) fprintf(report, "%s", fracas_message());
        else fprintf(report, "segment %s has another size than the index says", segment->name);
        err = set_aside(path, report);
    }
    free(path);
    return err;
}

fracas_err fracas_segments_sweep(const char *study, fracas_index *index, bool seals, FILE *report,
                                 int64_t *rows)
{
    fracas_known_segment *segment;
    size_t count, nlost = 0;
    *rows = 0;
    TRY(fracas_index_segments(index, &segment, &count));
    int64_t *lost = calloc(count + 1, sizeof *lost);
    fracas_err err = lost ? FRACAS_OK : fracas_no_memory("the list of segments");
    for (size_t s = 0; !err && s < count; s++) {
        bool is_lost;
        err = sweep_segment(study, &segment[s], seals, report, &is_lost);
        if (!err && is_lost) lost[nlost++] = segment[s].id;
    }
    if (!err) err = fracas_index_forget(index, lost, nlost, rows);
    if (!err && *rows) fprintf(report, "%" PRId64 " realizations are planned again\n", *rows);
    free(lost);
    fracas_index_segments_free(segment, count);
    return err;
}

/* ---- study.h5 ---- */

/* One whose bytes are not those of its seal loses that: it is merged again. */
static fracas_err unseal_damaged(const char *study, fracas_index *index, FILE *report)
{
    char *path;
    bool sealed;
    fracas_file_seal seal;
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    if (!sealed) return FRACAS_OK;
    TRY(fracas_disk_join(study, "study.h5", &path));
    fracas_err err = fracas_disk_check_seal(path, &seal);
    if (err == FRACAS_DAMAGED) {
        fprintf(report, "%s: it is made again\n", fracas_message());
        err = fracas_index_seal_study(index, NULL);
    }
    free(path);
    return err;
}

/* Whether every byte is read at the start of a run: it takes seconds in studies that are not of
 * many gigabytes. In those the merge finds what is damaged. */
static fracas_err is_quick_to_check(fracas_index *index, bool *quick)
{
    static const double most = 2e9; /* bytes: 1 s from memory, some 7 s from a slow disk */
    bool sealed;
    fracas_file_seal seal;
    fracas_known_segment *segment;
    size_t count;
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    TRY(fracas_index_segments(index, &segment, &count));
    double bytes = (double)seal.bytes;
    for (size_t s = 0; s < count; s++) bytes += (double)segment[s].seal.bytes;
    fracas_index_segments_free(segment, count);
    *quick = bytes <= most;
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

fracas_err fracas_study_sound(const char *study, fracas_index *index, bool *sound)
{
    bool sealed, quick;
    fracas_file_seal seal;
    fracas_known_segment *segment;
    char *path;
    size_t count;
    *sound = true;
    TRY(is_quick_to_check(index, &quick));
    if (!quick) return FRACAS_OK;
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    TRY(fracas_disk_join(study, "study.h5", &path));
    fracas_err err = sealed ? fracas_disk_check_seal(path, &seal) : FRACAS_OK;
    free(path);
    if (!err && (err = fracas_index_segments(index, &segment, &count)) == FRACAS_OK) {
        for (size_t s = 0; !err && s < count; s++) err = fracas_segment_check(study, &segment[s]);
        fracas_index_segments_free(segment, count);
    }
    *sound = err != FRACAS_DAMAGED;
    return *sound ? err : FRACAS_OK;
}

/* ---- segments that the folder has, but the index does not know ---- */

/* A realization that the index does not know, but a rule may have asked for before the index was
 * lost, is planned now. */
static fracas_err place_or_plan(fracas_index *index, const fracas_point_table *table,
                                const fracas_hash *point, int64_t replica)
{
    fracas_place place;
    fracas_err err = fracas_index_place(index, point, replica, &place);
    for (size_t p = 0; err == FRACAS_DAMAGED && p < table->npoints; p++) {
        fracas_point_row row = table->point[p];
        if (row.most <= replica || !fracas_hash_equal(&row.hash, point)) continue;
        row.replicas = replica + 1;
        err = fracas_index_plan_point(index, &row);
    }
    return err;
}

/* Reads every record, so that every checksum of the file is looked at. *asked becomes false if one
 * is of no realization here. */
static fracas_err read_rows(fracas_reader *reader, const fracas_point_table *table,
                            fracas_index *index, fracas_segment_row *row, bool *asked)
{
    fracas_record record;
    fracas_err err = FRACAS_OK;
    fracas_record_init(&record);
    for (size_t r = 0; !err && r < fracas_reader_realizations(reader); r++) {
        size_t point;
        err = fracas_reader_record(reader, r, FRACAS_READ_ALL, &point, &row[r].replica, &record);
        if (err) break;
        row[r].point = fracas_reader_points(reader)->point[point].hash;
        row[r].row = (int64_t)r;
        row[r].summary = fracas_summary_of(&record);
        if (*asked) err = place_or_plan(index, table, &row[r].point, row[r].replica);
        if (err == FRACAS_DAMAGED) *asked = false, err = FRACAS_OK;
    }
    fracas_record_clear(&record);
    return err;
}

/* Commits the rows of an open segment, if this campaign asks for all of them; what goes wrong when
 * it is *sound is not its fault. */
static fracas_err adopt(const char *path, const char *name, fracas_reader *reader,
                        const fracas_file_seal *seal, const fracas_point_table *table,
                        fracas_index *index, bool *sound, FILE *report)
{
    size_t count = fracas_reader_realizations(reader);
    bool asked = true;
    char *provenance;
    TRY(fracas_reader_provenance(reader, &provenance));
    const bool tells = provenance && fracas_index_is_json(index, provenance);
    fracas_segment_row *row = calloc(count + 1, sizeof *row);
    fracas_err err = row ? read_rows(reader, table, index, row, &asked)
                         : fracas_no_memory("the rows of a segment");
    *sound = !err;
    if (!err && !asked)
        fprintf(report,
                "left %s, which has realizations that this campaign does not ask for; move it "
                "away, or run the campaign that does\n",
                path);
    if (!err && asked)
        err = fracas_disk_sync_folder(path); /* whoever renamed it may have died before this */
    if (!err && asked)
        err = fracas_index_commit(index, name, seal, row, count,
                                  tells ? provenance : "{\"adopted\": true}");
    free(provenance);
    if (!err && asked) fprintf(report, "adopted %s with %zu realizations\n", path, count);
    free(row);
    return err;
}

/* Adopts a segment, or leaves it: what another program or campaign computed is not ours to remove.
 */
static fracas_err adopt_or_leave(const char *path, const char *name,
                                 const fracas_point_table *table, fracas_index *index,
                                 const fracas_identity *identity, bool *sound, FILE *report)
{
    fracas_reader *reader;
    fracas_file_seal seal;
    fracas_identity found;
    char text[FRACAS_DIFFERENCE_TEXT];
    uint64_t version;
    TRY(fracas_file_version(path, &version));
    if (version != FRACAS_FORMAT_VERSION) {
        fprintf(report, "left %s, which has format version %" PRIu64 ", not %d; move it away\n",
                path, version, FRACAS_FORMAT_VERSION);
        return FRACAS_OK;
    }
    TRY(fracas_disk_seal_path(path, &seal));
    TRY(fracas_reader_open(path, &reader));
    fracas_identity_of(fracas_reader_header(reader), &found);
    fracas_err err = FRACAS_OK;
    if (fracas_identity_differs(&found, identity, text))
        fprintf(report, "left %s, which is not of this study: %s; move it away\n", path, text);
    else err = adopt(path, name, reader, &seal, table, index, sound, report);
    fracas_reader_close(reader);
    return err;
}

static fracas_err adopt_or_set_aside(const char *path, const char *name,
                                     const fracas_point_table *table, fracas_index *index,
                                     const fracas_identity *identity, FILE *report)
{
    bool sound = false;
    fracas_err err = adopt_or_leave(path, name, table, index, identity, &sound, report);
    if (err != FRACAS_DAMAGED || sound) return err;
    fprintf(report, "%s", fracas_message());
    return set_aside(path, report);
}

int fracas_segment_compare_names(const void *a, const void *b)
{
    return strcmp(((const fracas_known_segment *)a)->name, ((const fracas_known_segment *)b)->name);
}

bool fracas_segment_is_known(const fracas_known_segment *segment, size_t count, char *name)
{
    fracas_known_segment wanted = {.name = name};
    return count > 0 &&
           bsearch(&wanted, segment, count, sizeof *segment, fracas_segment_compare_names);
}

static fracas_err adopt_orphans(const char *folder, const fracas_point_table *table,
                                fracas_index *index, const fracas_identity *identity, FILE *report)
{
    struct dirent **entry;
    int count;
    fracas_known_segment *segment;
    size_t nsegments;
    TRY(fracas_index_segments(index, &segment, &nsegments));
    if (nsegments) qsort(segment, nsegments, sizeof *segment, fracas_segment_compare_names);
    fracas_err err = list_folder(folder, &entry, &count);
    for (int e = 0; !err && e < count; e++) {
        char *name = entry[e]->d_name, *dot = strrchr(name, '.');
        char *path;
        if (name[0] == '.' || !dot || strcmp(dot, ".h5") != 0 ||
            fracas_segment_is_known(segment, nsegments, name))
            continue;
        err = fracas_disk_join(folder, name, &path);
        if (err) break;
        err = adopt_or_set_aside(path, name, table, index, identity, report);
        free(path);
    }
    free_list(entry, count);
    fracas_index_segments_free(segment, nsegments);
    return err;
}

/* ---- the index itself ---- */

/* Before anything is computed by it. An index of so many realizations that this would take long is
 * believed here: what is damaged in it is found where it is used, at the latest when rows are
 * compared with records in the merge. */
static fracas_err check_index(fracas_index *index, const fracas_point_table *table)
{
    enum { MOST = 32 << 20 }; /* bytes: about a second */
    struct stat info;
    int64_t points, id, known = 0;
    if (stat(index->path, &info) == 0 && info.st_size <= MOST) TRY(fracas_index_quick_check(index));
    TRY(fracas_index_points(index, &points));
    for (size_t p = 0; p < table->npoints; p++) {
        TRY(fracas_index_find_point(index, &table->point[p].hash, &id));
        known += id != 0;
    }
    if (points <= known) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: %" PRId64 " of its %" PRId64
                       " points are not in the campaign; if campaign.yaml of the study was edited "
                       "put it back, else `fracas reindex` makes the index anew from the segments",
                       index->path, points - known, points);
}

static fracas_err recover(const char *study, const fracas_point_table *table, fracas_index *index,
                          const fracas_identity *identity, FILE *report)
{
    char *folder;
    TRY(fracas_disk_join(study, "segments", &folder));
    fracas_err err = FRACAS_OK;
    if (mkdir(folder, 0777) < 0 && errno != EEXIST) err = fracas_disk_fail("create", folder);
    if (!err) err = sweep(study, report);
    if (!err) err = forget_lost(study, index, report);
    if (!err) err = adopt_orphans(folder, table, index, identity, report);
    free(folder);
    return err;
}

fracas_err fracas_study_recover(const char *study, fracas_index *index,
                                const fracas_file_header *header, const fracas_point_table *table,
                                char **report)
{
    size_t size;
    fracas_identity identity;
    fracas_identity_of(header, &identity);
    *report = NULL;
    TRY(check_index(index, table));       /* before anything is added to it */
    TRY(fracas_index_plan(index, table)); /* before the sweep: a segment of a realization that the
                                             index does not know is left alone */
    FILE *text = open_memstream(report, &size);
    if (!text) return fracas_no_memory("a report");
    fracas_err err = recover(study, table, index, &identity, text);
    if (fclose(text) != 0 && !err) err = fracas_no_memory("a report");
    if (err) free(*report), *report = NULL;
    return err;
}
