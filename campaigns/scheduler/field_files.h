/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a realization as it is computed, at some of its instants, as grids for ParaView. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_FIELD_FILES_H
#define FRACAS_CAMPAIGNS_SCHEDULER_FIELD_FILES_H

#include "campaigns/campaign.h"
#include "engine/engine.h"
#include "engine/fields.h"

#include <stdio.h>

typedef struct {
    const char *folder;    /* new or empty; NULL: none is written */
    double every;          /* s, from 0 on; 0: not evenly */
    bool onset, peak, end; /* first onset, largest elastic + cohesive energy, end */
    bool one_file;         /* all instants of a part in one */
    /* Sees each instant, of at most so many; NULL: nobody does. An error ends the run. */
    fracas_err (*show)(void *context, const fracas_fields *fields, size_t most);
    void *context;
} fracas_fields_request;

/* All zero: none. */
typedef struct {
    const fracas_fields_request *request;
    fracas_fields *fields; /* owned, as all below */
    int64_t *corner;       /* 0, 1, 2, ...: no two cells have a common point */
    double *due;           /* [count] s, rising: the next step takes them all */
    size_t count, next;    /* next: the first to come */
    size_t most;           /* as many can be taken: one a step */
    double *taken;         /* [ntaken] s */
    size_t ntaken;
    char *path[2];                   /* files of all instants, where there are such; NULL ... */
    struct fracas_vtk_film *film[2]; /* ... and these too, where there are none */
    fracas_batch_watch watch;        /* for a batch of one lane */
    double
        overlap; /* after the run, of fragments at the last instant (engine/fragments/overlap.h) */
} fracas_field_files;

/* Prepares to write FOLDER/body-K.hdf and FOLDER/interfaces-K.hdf, K from 1, and
 * FOLDER/body.hdf.series, FOLDER/interfaces.hdf.series, which list those that are whole; or
 * FOLDER/body.vtkhdf and FOLDER/interfaces.vtkhdf, which are there once they are whole. The
 * instants are those of the stored record. Prints how many they are at most, and their size, unless
 * `out` is NULL. Without a folder no file is written. FRACAS_USAGE for a folder that is not empty
 * and where there is no instant, FRACAS_ENVIRONMENT for one that cannot be written. `request` must
 * outlive `files`, `files` the batch, and stay where it is. */
FRACAS_MUST_USE fracas_err fracas_field_files_open(const fracas_fields_request *request,
                                                   const fracas_model *model,
                                                   const fracas_record *stored,
                                                   fracas_field_files *files, FILE *out);
/* Bytes of both files of an instant. */
FRACAS_MUST_USE fracas_err fracas_field_files_bytes(const fracas_model *model, double *bytes);
void fracas_field_files_clear(fracas_field_files *files); /* all zero is allowed */
/* Ends the files after the run, and prints their names and how far fragments lie over each other at
 * the last instant, unless `out` is NULL. */
FRACAS_MUST_USE fracas_err fracas_field_files_finish(fracas_field_files *files, FILE *out);

#endif
