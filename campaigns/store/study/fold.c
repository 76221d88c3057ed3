/* SPDX-License-Identifier: GPL-3.0-or-later */
/* study.h5 in the place of all segments: a second name in segments/ makes it one. */
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

typedef struct {
    const char *path; /* study.h5 */
    fracas_index *index;
    const fracas_point_table *points; /* those of the file */
    fracas_segment_row *row;
} folding;

/* A record of study.h5 must be that of the index. */
static fracas_err fold_row(void *context, fracas_result *result)
{
    folding *f = context;
    fracas_segment_row *row = &f->row[result->row];
    fracas_row_place place;
    *row = (fracas_segment_row){.point = f->points->point[result->point].hash,
                                .replica = result->replica,
                                .row = (int64_t)result->row,
                                .summary = fracas_summary_of(&result->record)};
    TRY(fracas_index_place(f->index, &row->point, row->replica, &place));
    if (place.status == FRACAS_DONE && fracas_place_fits(&place, &result->record, true))
        return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: replica %" PRId64 " of point %s is not as the index has it; `fracas "
                       "merge` the study, and nothing is removed until then",
                       f->path, row->replica, fracas_hash_hex(&row->point).text);
}

/* Only a whole study.h5 stands for all segments: sealed, of every realization, none of them failed.
 */
static fracas_err check_complete(const char *study, fracas_index *index)
{
    fracas_index_counts counts;
    bool sealed;
    TRY(fracas_study_sealed(study, index, &sealed));
    TRY(fracas_index_count(index, &counts));
    if (sealed && counts.done == counts.realizations) return FRACAS_OK;
    return fracas_fail(FRACAS_INTERRUPTED,
                       "%s keeps its segments: study.h5 has %" PRId64 " of %" PRId64
                       " realizations as results%s; `fracas run` or `fracas retry` the rest first",
                       study, counts.done, counts.realizations,
                       sealed ? "" : ", or is not merged yet");
}

static const char prefix[] = "study-"; /* names of other segments begin with the date */

bool fracas_segment_is_study(const char *name)
{
    return strncmp(name, prefix, sizeof prefix - 1) == 0;
}

/* The name of a segment with these bytes. */
static fracas_err name_of(const char *study, const fracas_file_seal *seal, char name[40],
                          char **path)
{
    snprintf(name, 40, "%s%016" PRIx64 ".h5", prefix, seal->checksum);
    return fracas_disk_segment(study, name, path);
}

fracas_err fracas_study_bring(const char *file, const char *study)
{
    OWNED char *path = NULL;
    OWN_FD from = -1;
    fracas_file_seal seal;
    char name[40];
    TRY(fracas_disk_open(file, &from));
    TRY(fracas_disk_seal(from, file, &seal));
    TRY(name_of(study, &seal, name, &path));
    return fracas_segment_copy(from, &seal, path);
}

/* A second name, durable on return, of the file whose bytes are durable. It takes the place of a
 * copy under that name, which has the same bytes. */
static fracas_err give_name(const char *from, const char *path)
{
    OWNED char *temporary = NULL;
    struct stat here, there;
    if (stat(from, &here) < 0) return fracas_disk_fail("look at", from);
    const bool has = lstat(path, &there) == 0 && here.st_ino == there.st_ino &&
                     here.st_dev == there.st_dev;
    TRY(fracas_disk_temporary(path, &temporary));
    if (!has && link(from, temporary) < 0)
        return fracas_fail_system(errno,
                                  "%s cannot have a second name, %s, so that all segments "
                                  "stay",
                                  from, path);
    if (!has && rename(temporary, path) < 0) {
        const int reason = errno;
        unlink(temporary);
        return fracas_fail_system(reason, "cannot rename to %s", path);
    }
    return fracas_disk_sync_folder(path);
}

fracas_err fracas_study_fold(const char *study, fracas_index *index,
                             const fracas_file_header *header)
{
    OWNED char *path = NULL;
    OWNED char *segment = NULL;
    OWN(fracas_reader) reader = NULL;
    bool sealed;
    char name[40], differs[FRACAS_DIFFERENCE_TEXT];
    fracas_file_seal seal;
    fracas_identity ours, found;
    TRY(check_complete(study, index));
    TRY(fracas_index_study_seal(index, &sealed, &seal));
    TRY(fracas_disk_join(study, "study.h5", &path));
    TRY(fracas_disk_check_seal(path, &seal));
    TRY(fracas_reader_open(path, &reader));
    fracas_identity_of(header, &ours);
    fracas_identity_of(fracas_reader_header(reader), &found);
    if (fracas_identity_differs(&found, &ours, differs))
        return fracas_fail(FRACAS_DAMAGED, "%s: not of this study: %s", path, differs);
    const size_t count = fracas_reader_realizations(reader);
    OWNED fracas_segment_row *row = calloc(count + 1, sizeof *row);
    if (!row) return fracas_no_memory("the rows of study.h5");
    folding f = {path, index, fracas_reader_points(reader), row};
    TRY(fracas_reader_each(reader, FRACAS_READ_ALL, fold_row, &f));
    TRY(name_of(study, &seal, name, &segment));
    TRY(give_name(path, segment));
    return fracas_index_fold(index, name, &seal, row, count);
}
