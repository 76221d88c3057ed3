/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The errors of a campaign file, which is read to its end in spite of them. */
#ifndef FRACAS_CAMPAIGNS_FILE_FAULTS_H
#define FRACAS_CAMPAIGNS_FILE_FAULTS_H

#include "base/err.h"
#include "campaigns/file/memory.h"

#include <stdbool.h>
#include <stddef.h>

/* So many are printed, in the order of lines. */
enum { FRACAS_FAULTS_SHOWN = 20 };

typedef struct fracas_faults fracas_faults;

/* In the campaign's memory; NULL without. */
fracas_faults *fracas_faults_create(fracas_campaign_memory *memory);

/* The place of the error that is returned next. `told`: it follows from one that is noted already,
 * so that nobody needs to hear of it. */
void fracas_faults_place(fracas_faults *faults, int line, int column, bool told);
bool fracas_faults_is_told(const fracas_faults *faults);

/* Notes the present message if `err` is FRACAS_USAGE, so that reading goes on: FRACAS_OK. Every
 * other code is returned. */
FRACAS_MUST_USE fracas_err fracas_faults_note(fracas_faults *faults, fracas_err err);

/* From now on points are resolved, this one next: an error at the place of one of an earlier point
 * is the same error. */
void fracas_faults_point(fracas_faults *faults, size_t point);

/* Number of calls of fracas_faults_note that had something to note. */
size_t fracas_faults_noted(const fracas_faults *faults);

/* FRACAS_USAGE with one line for each error of the file `name`, sorted by line, or FRACAS_OK. */
FRACAS_MUST_USE fracas_err fracas_faults_report(const fracas_faults *faults, const char *name);

#endif
