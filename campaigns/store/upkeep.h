/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Upkeep of a study: index made anew, needless files removed, two studies joined, failures retried.
 *
 * The caller holds the lock of every study, and has opened its index. After a death at any moment
 * the study is as before or as after, or the same command goes on. */
#ifndef FRACAS_CAMPAIGNS_STORE_UPKEEP_H
#define FRACAS_CAMPAIGNS_STORE_UPKEEP_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"

/* Calls `line` with each line for people, without its end. */
typedef struct {
    void (*line)(void *context, const char *text);
    void *context;
} fracas_said;

/* Each line of `text`. */
void fracas_say_lines(const fracas_said *said, const char *text);

/* ---- the index ---- */

#define FRACAS_REINDEX_FOLDER ".reindex" /* in the study, in which a new index grows */

/* Makes STUDY/index.sqlite anew from the segments, which are read whole (fracas_study_recover). If
 * the one before can be read and is of this study, then the attempts and reasons of realizations,
 * failures, provenance and events are taken over from it; if not, it stays as
 * index.sqlite.before-TIME. The new one grows in STUDY/.reindex and takes the place of the old when
 * it is durable. The seal of study.h5 and decisions are not taken over: a merge makes the one, the
 * realizations the others. Nobody may have the index open. FRACAS_DAMAGED, naming file and
 * versions, if the segments are of another format version. */
FRACAS_MUST_USE fracas_err fracas_study_reindex(const char *study, const fracas_file_header *header,
                                                const fracas_point_table *table,
                                                const fracas_said *said);

/* Plans the failed realizations (of `point`, NULL: of all) again, with 0 attempts, and deletes the
 * decisions made with them; one transaction, durable on return. *rows counts them. */
FRACAS_MUST_USE fracas_err fracas_index_retry(fracas_index *index, const fracas_hash *point,
                                              int64_t *rows);

/* ---- needless files ---- */

/* One file or folder on the way of fracas_study_collect. */
typedef struct {
    const char *path; /* STUDY/... */
    uint64_t bytes;
    const char *why; /* it is removed, or left */
    bool removed;
} fracas_collected;

typedef struct {
    const char *const *attachment; /* digests of the campaign's files */
    size_t nattachments;
    bool dry; /* removes nothing, only calls `found` */
    void (*found)(void *context, const fracas_collected *item);
    void *context;
} fracas_collect_options;

/* Removes temporaries, leftovers of interrupted commands, segments without a row in the index and
 * attachments without a name in the campaign; gives free pages of the index back to the system.
 * Unknown files stay; `found` is called for both. A segment leaves the index before its file goes,
 * so that a death in between leaves a file to adopt. *freed: bytes. */
FRACAS_MUST_USE fracas_err fracas_study_collect(const char *study, fracas_index *index,
                                                const fracas_collect_options *options,
                                                uint64_t *freed);

/* Makes study.h5 the segment of every realization, by a second name in segments/, so that
 * fracas_study_collect removes all others. Before that every byte is compared with the seal, and
 * every record, read with its checksums, with the index. A death at any instant leaves every
 * realization in a segment of the index. FRACAS_INTERRUPTED without a sealed study.h5 of results
 * alone; FRACAS_DAMAGED; FRACAS_ENVIRONMENT on a filesystem without second names. */
FRACAS_MUST_USE fracas_err fracas_study_fold(const char *study, fracas_index *index,
                                             const fracas_file_header *header);

/* Copies a study.h5 into STUDY/segments, durable on return: the next run or merge adopts it as the
 * segment of all its realizations (fracas_study_recover). */
FRACAS_MUST_USE fracas_err fracas_study_bring(const char *file, const char *study);

/* ---- two studies of one campaign ---- */

/* Reads every record of `from` in `table` with the checksums of their segments, and compares the
 * records in both studies: FRACAS_DAMAGED names the first realization with a different bit, or a
 * damaged segment. *both counts the compared ones. Writes nothing. */
FRACAS_MUST_USE fracas_err fracas_study_compare(const char *into, fracas_index *into_index,
                                                const char *from, fracas_index *from_index,
                                                const fracas_file_header *header,
                                                const fracas_point_table *table, int64_t *both);

/* FRACAS_DAMAGED names the first segment that is missing or at odds with its seal. */
FRACAS_MUST_USE fracas_err fracas_study_check_segments(const char *study, fracas_index *index);

typedef struct {
    int64_t realizations; /* new in `into` */
    int64_t segments;     /* taken over */
    int64_t failed;       /* realizations failed in `from`, planned in `into` */
} fracas_joined;

/* Takes segments of `from` with realizations not done in `into` (all planned there) over into it,
 * by link or by copy (of the target of a symbolic link), and their rows; then the failures of
 * realizations not done there. Only after fracas_study_compare. `table`: of `from`. */
FRACAS_MUST_USE fracas_err fracas_study_join(const char *into, fracas_index *into_index,
                                             const char *from, fracas_index *from_index,
                                             const fracas_point_table *table,
                                             fracas_joined *joined);

#endif
