/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From a log: the files that were whole under their names, and what the index promised when. */
#ifndef FRACAS_TESTS_SUPPORT_POWER_TRUTH_H
#define FRACAS_TESTS_SUPPORT_POWER_TRUTH_H

#include "tests/support/disk_model.h"

/* A realization: "HASH REPLICA". */
enum { POWER_LINE = 64 };
typedef char power_line[POWER_LINE];

/* Content that a file had under a durable name: a segment, study.h5, campaign.yaml ... */
typedef struct {
    char name[256];
    unsigned char *bytes;
    size_t size;
    power_line *row; /* realizations of a segment */
    size_t nrows;
} power_file;

typedef struct {
    power_file *file;
    size_t nfiles;
    const char *reference; /* study.h5 of an undisturbed run */
} power_truth;

/* Every record of a segment is compared with that in `reference`; ends the program if one differs.
 * `folder`: for scratch files. */
void power_truth_make(const disk_log *log, const char *reference, const char *folder,
                      power_truth *truth);

/* The next content of this name after `from` (NULL: the first), NULL: no more. */
const power_file *power_truth_next(const power_truth *truth, const char *name,
                                   const power_file *from);
/* True if the file at `path` has one of the contents of this name. */
bool power_truth_has(const power_truth *truth, const char *name, const char *path);

/* Lines of the last promise of a study before change `at` of the log that the next one repeats:
 * "HASH REPLICA done|failed" and "study.h5 BYTES CHECKSUM". Freed by the caller with its lines in
 * one block. */
char **power_promised(const disk_log *log, const char *study, size_t at, size_t *count);

#endif
