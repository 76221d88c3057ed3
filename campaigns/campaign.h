/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A campaign: the file as read, validated, converted to SI and expanded to points. */
#ifndef FRACAS_CAMPAIGNS_CAMPAIGN_H
#define FRACAS_CAMPAIGNS_CAMPAIGN_H

#include "base/own.h"
#include "base/err.h"
#include "base/hash.h"
#include "base/units.h"
#include "campaigns/points.h"
#include "engine/spec.h"
#include "sampler/api/sampler.h"
#include "sampler/sequential/sequential.h"

#include <stdio.h>

/* Output beside the records. Not part of a point's identity, but of the campaign's hash. */
typedef struct {
    int64_t history; /* equal intervals of time.end */
    bool interfaces; /* /interface group */
} fracas_output;

/* How a run computes: the same results for all values. */
typedef struct {
    int64_t parts; /* threads of a realization on a surface; 0: chosen by the run */
} fracas_parallel;

/* A point, resolved. */
typedef struct {
    fracas_spec spec;
    fracas_strength strength;
    fracas_hash hash; /* over resolved values by sorted path: docs/formats/campaign-file.md */
    int64_t replicas; /* with a rule: of its first round */
    fracas_sequential_rule rule; /* for its replicas; maximum 0: none */
} fracas_point;

/* A file named in the campaign file, as read. */
typedef struct fracas_attached {
    fracas_attachment attachment;
    struct fracas_attached *next;
} fracas_attached;

#define FRACAS_ATTACHMENTS "attachments" /* folder beside a written campaign file */

typedef struct fracas_campaign {
    const char *name;
    uint64_t seed;
    bool common_random_numbers; /* replica r draws the same at every point */
    fracas_output output;       /* the same for all points */
    fracas_parallel parallel;
    size_t npoints;
    fracas_point *point;       /* plan order = file order of the sweep, last axis fastest */
    fracas_point_table table;  /* the same points as columns */
    fracas_attached *attached; /* two may have the same content */
    fracas_hash hash; /* over seed, random numbers, output, hash and replicas of every point */
    struct fracas_campaign_memory *memory;  /* owns all of the above */
    struct fracas_frequencies *frequencies; /* computed so far for its points */
} fracas_campaign;

/* Maximum of a point's replicas. */
static inline int64_t fracas_point_most(const fracas_point *point)
{
    return point->rule.maximum > 0 ? point->rule.maximum : point->replicas;
}

/* Reads a campaign file. FRACAS_USAGE with "file:line:column: finding; allowed values; nearest key"
 * for any error in it, and if the file is not there; FRACAS_ENVIRONMENT if it cannot be opened or
 * read. */
FRACAS_MUST_USE fracas_err fracas_campaign_read(const char *path, fracas_campaign **campaign);
/* The same with a loaded unit database, whose loading takes longer than reading a file. */
FRACAS_MUST_USE fracas_err fracas_campaign_read_with(const fracas_units *units, const char *path,
                                                     fracas_campaign **campaign);
void fracas_campaign_destroy(fracas_campaign *campaign); /* NULL is allowed */
FRACAS_OWNER(fracas_campaign, fracas_campaign_destroy)

/* Gives every point `replicas` (1 to 1e9), as if in the file: the campaign's hash changes, too.
 * FRACAS_USAGE, and no change, if a rule decides the replicas of a point. */
FRACAS_MUST_USE fracas_err fracas_campaign_replicas(fracas_campaign *campaign, int64_t replicas);

/* Writes the campaign as resolved: in SI, with every default. The result is a campaign file of the
 * same points, hashes and replicas, if its attachments are beside it as attachments/DIGEST. */
FRACAS_MUST_USE fracas_err fracas_campaign_write(const fracas_campaign *campaign, FILE *out);

/* FRACAS_OK when `now` extends or equals `before`: the same seed and output, and every point of
 * `before` with at least its replicas. A rule for replicas may only ask for more, so no round stops
 * earlier. Else FRACAS_DAMAGED naming the first difference with its path and both values. */
FRACAS_MUST_USE fracas_err fracas_campaign_extends(const fracas_campaign *now,
                                                   const fracas_campaign *before);

/* The reference page of the campaign file (docs/formats/campaign-file-keys.md), from the parameter
 * tables. FRACAS_ENVIRONMENT without memory, and nothing is printed. */
FRACAS_MUST_USE fracas_err fracas_campaign_reference(FILE *out);
/* Prints the columns of /point that follow from the others, as docs/formats/study.md has them. */
void fracas_derived_reference(FILE *out);

#endif
