/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A campaign: the file as read, validated, converted to SI and expanded to points. */
#ifndef FRACAS_CAMPAIGNS_CAMPAIGN_H
#define FRACAS_CAMPAIGNS_CAMPAIGN_H

#include "base/err.h"
#include "base/hash.h"
#include "campaigns/points.h"
#include "engine/spec.h"
#include "sampler/sampler.h"
#include "sampler/sequential/sequential.h"

#include <stdio.h>

/* What is written beside the records; not part of a point's identity, but of the campaign's hash.
 */
typedef struct {
    int64_t history; /* equal intervals of time.end */
    bool interfaces; /* /interface group */
} fracas_output;

/* Everything that makes a point: what it resolves to. */
typedef struct {
    fracas_spec spec;
    fracas_strength strength;
    fracas_hash
        hash; /* docs/formats/campaign-file.md: over resolved scalars and enums by sorted path */
    int64_t replicas; /* with a rule: those of its first round */
    fracas_sequential_rule
        rule; /* how many replicas it gets; maximum 0: there is none, it gets `replicas` */
} fracas_point;

/* A file that the campaign file names, as it was read. */
typedef struct fracas_attached {
    fracas_attachment attachment;
    struct fracas_attached *next;
} fracas_attached;

#define FRACAS_ATTACHMENTS "attachments" /* folder beside a written campaign file */

typedef struct fracas_campaign {
    char *name;
    uint64_t seed;
    bool common_random_numbers; /* replica r draws the same at every point; else points are
                                   independent */
    fracas_output output;       /* one for the whole campaign */
    size_t npoints;
    fracas_point *point;       /* plan order = file order of the sweep, last axis fastest */
    fracas_point_table table;  /* the same points as columns */
    fracas_attached *attached; /* all of them; two may have the same content */
    fracas_hash
        hash; /* over seed, random numbers, output, and every point's hash and replicas in order */
    struct fracas_campaign_memory *memory; /* owns what the above points to */
} fracas_campaign;

/* The most replicas that a point can get. */
static inline int64_t fracas_point_most(const fracas_point *point)
{
    return point->rule.maximum > 0 ? point->rule.maximum : point->replicas;
}

/* Reads a campaign file. FRACAS_USAGE with "file:line:column: what was found; what is allowed;
 * nearest key" for anything wrong in it, FRACAS_ENVIRONMENT if it cannot be opened or read. */
FRACAS_MUST_USE fracas_err fracas_campaign_read(const char *path, fracas_campaign **campaign);
void fracas_campaign_destroy(fracas_campaign *campaign); /* NULL is allowed */

/* Gives every point `replicas` (1 to 1e9), as if the file said so: the campaign's hash is then of
 * that number. FRACAS_USAGE, and nothing is changed, where a rule decides the replicas of a point.
 */
FRACAS_MUST_USE fracas_err fracas_campaign_replicas(fracas_campaign *campaign, int64_t replicas);

/* Writes the campaign as resolved: SI, every default spelled out, itself a campaign file that reads
 * back to the same points, hashes and replicas, where the files that the campaign names are beside
 * it, as attachments/DIGEST. */
FRACAS_MUST_USE fracas_err fracas_campaign_write(const fracas_campaign *campaign, FILE *out);

/* FRACAS_OK when `now` has every point of `before` with at least its replicas, and the same seed
 * and output (an extension, or the same): a rule for replicas may only ask for more, so that every
 * round that went on still does. Else FRACAS_DAMAGED naming the first difference by path and both
 * values. */
FRACAS_MUST_USE fracas_err fracas_campaign_extends(const fracas_campaign *now,
                                                   const fracas_campaign *before);

/* The reference page of the campaign file (docs/formats/campaign-file-keys.md), from the parameter
 * tables. */
void fracas_campaign_reference(FILE *out);

#endif
