/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/fits.csv.part: fits of points, saved one after the other as they are done. A block is
 *
 *     ,,fits,begin,,,,,,KEY
 *     rows, as in fits.csv
 *     ,,fits,end,,,,,,checksum of the lines before, from the beginning of the block on
 *
 * with a key of all that the fits depend on. Blocks behind one that is not whole are cut off. */
#ifndef FRACAS_ANALYSIS_FIT_PART_H
#define FRACAS_ANALYSIS_FIT_PART_H

#include "analysis/fit/fits.h"

typedef struct {
    int fd; /* locked; -1: not open */
    char *path;
    fracas_fits saved; /* the rows of all blocks ... */
    size_t nblocks, room;
    struct fracas_fits_block {
        char key[FRACAS_HASH_HEX];
        size_t begin, end; /* ... and those of each */
    } * block;
} fracas_fits_part;

/* Opens the file, made if it is not there, for this process alone, and reads it. Cleared by the
 * caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_fits_part_open(const char *study, fracas_fits_part *part);
void fracas_fits_part_clear(fracas_fits_part *part);

/* Names version, point, realizations and resamples: all that the fits of a point depend on. */
fracas_hash fracas_fits_part_key(const fracas_analysis *analysis, size_t point, int64_t resamples);
/* Appends the rows saved under the key to the fits, as those of `point`; false if there are none.
 */
FRACAS_MUST_USE fracas_err fracas_fits_part_take(const fracas_fits_part *part,
                                                 const fracas_hash *key, size_t point,
                                                 fracas_fits *fits, bool *taken);
/* Saves rows, durably, as text of `size` bytes. */
FRACAS_MUST_USE fracas_err fracas_fits_part_save(const fracas_fits_part *part,
                                                 const fracas_hash *key, const char *rows,
                                                 size_t size);

#endif
