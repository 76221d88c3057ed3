/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Checkpoints: STUDY/checkpoints/POINT-REPLICA, the state of a realization that computes for long
 * (docs/formats/checkpoint.md). A file of that name is whole, or its seal does not fit. */
#ifndef FRACAS_CAMPAIGNS_STORE_CHECKPOINT_H
#define FRACAS_CAMPAIGNS_STORE_CHECKPOINT_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"

#define FRACAS_CHECKPOINTS "checkpoints"

/* Head of a file. */
typedef struct {
    char mark[8];
    char version[32]; /* the program's */
    fracas_hash point;
    int64_t replica;
    uint64_t seed;
    int64_t history, interfaces; /* as fracas_file_header */
    fracas_hash probes;          /* hash of their text */
    int64_t reactions;
    int64_t over; /* 1: only the record is left to be written */
    int64_t steps;
    double time, end; /* s; time.end */
} fracas_checkpoint_head;

typedef struct fracas_checkpoint fracas_checkpoint;

/* Begins the file of `head`, whose mark, version, seed, history, interfaces and probes are set from
 * the header, under a temporary name; creates the folder. */
FRACAS_MUST_USE fracas_err fracas_checkpoint_create(const char *study,
                                                    const fracas_file_header *header,
                                                    fracas_checkpoint_head *head,
                                                    fracas_checkpoint **checkpoint);
/* A fracas_transfer: appends bytes. */
FRACAS_MUST_USE fracas_err fracas_checkpoint_put(void *checkpoint, void *bytes, size_t size);
/* Seals, syncs, renames, syncs the folder. The caller closes. */
FRACAS_MUST_USE fracas_err fracas_checkpoint_finish(fracas_checkpoint *checkpoint);

/* Opens the file of a realization. *checkpoint is NULL if there is none. FRACAS_DAMAGED, with the
 * reason, for one that is damaged or of another program version or study. */
FRACAS_MUST_USE fracas_err fracas_checkpoint_open(const char *study,
                                                  const fracas_file_header *header,
                                                  const fracas_hash *point, int64_t replica,
                                                  fracas_checkpoint_head *head,
                                                  fracas_checkpoint **checkpoint);
/* A fracas_transfer: reads the next bytes; FRACAS_DAMAGED at the end. */
FRACAS_MUST_USE fracas_err fracas_checkpoint_get(void *checkpoint, void *bytes, size_t size);
/* Also without fracas_checkpoint_finish: then no file is left. NULL is allowed. */
void fracas_checkpoint_close(fracas_checkpoint *checkpoint);
FRACAS_OWNER(fracas_checkpoint, fracas_checkpoint_close)

/* Removes the files of realizations whose records are durable. */
void fracas_checkpoints_remove(const char *study, const fracas_segment_row *row, size_t count);
/* Removes all of a study that is computed, and the folder: a copy of a lease may have left one
 * late. */
void fracas_checkpoints_end(const char *study);
/* Removes files that fracas_checkpoint_open refuses, half written ones, and those of realizations
 * that are done or unknown; each is a line of `report`. */
FRACAS_MUST_USE fracas_err fracas_checkpoints_sweep(const char *study,
                                                    const fracas_file_header *header,
                                                    fracas_index *index, FILE *report);
/* Calls `visit` with each file's head and its age [s]; files of other programs are left out. */
FRACAS_MUST_USE fracas_err fracas_checkpoints_each(
    const char *study,
    fracas_err (*visit)(void *context, const fracas_checkpoint_head *head, double age),
    void *context);

#endif
