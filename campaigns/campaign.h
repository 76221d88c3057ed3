/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A campaign: the file as read, validated, converted to SI and expanded to points. */
#ifndef FRACAS_CAMPAIGNS_CAMPAIGN_H
#define FRACAS_CAMPAIGNS_CAMPAIGN_H

#include "base/own.h"
#include "base/err.h"
#include "base/hash.h"
#include "base/units.h"
#include "campaigns/points.h"
#include "engine/record.h"
#include "engine/spec.h"
#include "sampler/api/sampler.h"
#include "sampler/sequential/sequential.h"

#include <stdio.h>

/* Output beside the records. Not part of a point's identity, but of the campaign's hash. */
typedef struct {
    int64_t history;              /* equal intervals of time.end */
    bool interfaces;              /* /interface group */
    const fracas_kind *reactions; /* edges: /reaction group; NULL: none */
} fracas_output;

/* How a run computes: the same results for all values. */
typedef struct {
    int64_t parts; /* threads of a realization on a surface; 0: chosen by the run */
} fracas_parallel;

enum { FRACAS_MOST_INSTANTS = 10000 }; /* at which fields of a realization are written */

/* Fields that a run writes at its end, beside the study (campaigns/file/chosen.h). */
typedef struct {
    const fracas_kind *of;          /* which realizations */
    const fracas_numbers *replicas; /* where they are listed */
    const fracas_kind *by;          /* by which number they are ordered; NULL: fragments */
    double every;                   /* s, from 0 on; 0: at onset, peak and end */
} fracas_wanted_fields;

/* Keys of the figures of means in a report; NULL: the report chooses. In no hash. */
typedef struct fracas_report_keys {
    const char *x;      /* on the abscissa: a parameter's path, or a statistic's key */
    const char *series; /* path of the parameter whose values make the series */
    const char *panels; /* path of the parameter whose values make the panels */
    const char *y;      /* keys of statistics, "aspect,onset_time", drawn beside size and count */
} fracas_report_keys;

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

/* A path such as a written campaign file has for it, attachments/DIGEST. */
typedef struct {
    char text[sizeof FRACAS_ATTACHMENTS + 33]; /* a slash, 32 digits, a NUL */
} fracas_attachment_name;
fracas_attachment_name fracas_attachment_named(const fracas_attachment *attachment);

typedef struct fracas_campaign {
    const char *name;
    uint64_t seed;
    bool common_random_numbers; /* replica r draws the same at every point */
    fracas_output output;       /* the same for all points */
    fracas_probes probes;       /* the same */
    fracas_parallel parallel;
    fracas_wanted_fields fields;
    fracas_report_keys report;
    size_t npoints;
    fracas_point *point;       /* plan order = file order of the sweep, last axis fastest */
    fracas_point_table table;  /* the same points as columns */
    fracas_attached *attached; /* two may have the same content */
    fracas_hash
        hash; /* over seed, random numbers, output, probes, hash and replicas of every point */
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
/* The same from `size` bytes of text, which stand for the file `name`. */
FRACAS_MUST_USE fracas_err fracas_campaign_read_text(const char *text, size_t size,
                                                     const char *name, fracas_campaign **campaign);
void fracas_campaign_destroy(fracas_campaign *campaign); /* NULL is allowed */
FRACAS_OWNER(fracas_campaign, fracas_campaign_destroy)

/* FRACAS_USAGE, with the remedy, if there is no point number `point`, from 0. */
FRACAS_MUST_USE fracas_err fracas_campaign_has(const fracas_campaign *campaign, size_t point);

/* Gives every point `replicas` (1 to 1e9), as if in the file: the campaign's hash changes, too.
 * FRACAS_USAGE, and no change, if a rule decides the replicas of a point. */
FRACAS_MUST_USE fracas_err fracas_campaign_replicas(fracas_campaign *campaign, int64_t replicas);

/* Begins every file that fracas_campaign_write makes. */
#define FRACAS_RESOLVED "# A campaign as resolved by fracas: SI units, every default spelled out.\n"

/* Writes the campaign as resolved: in SI, with every default. The result is a campaign file of the
 * same points, hashes and replicas, if its attachments are beside it as attachments/DIGEST. */
FRACAS_MUST_USE fracas_err fracas_campaign_write(const fracas_campaign *campaign, FILE *out);

/* The same as text of *size bytes, and a NUL behind them; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_campaign_text(const fracas_campaign *campaign, char **text,
                                                size_t *size);
/* True if such a text names the file, as attachments/DIGEST. */
bool fracas_campaign_names(const char *text, const fracas_attachment *attachment);

/* The text with the files that it names, which belong to the campaign. Cleared by the caller.
 * Campaigns of one text have one copy, wherever they were read. */
FRACAS_MUST_USE fracas_err fracas_campaign_copy_make(const fracas_campaign *campaign,
                                                     fracas_campaign_copy *copy);
/* The campaign of such a copy, called `name` in messages; it keeps nothing of the copy. No file is
 * read. Errors as of fracas_campaign_read. */
FRACAS_MUST_USE fracas_err fracas_campaign_copy_read(const fracas_campaign_copy *copy,
                                                     const char *name, fracas_campaign **campaign);

/* FRACAS_OK when `now` extends or equals `before`: the same seed and output, and every point of
 * `before` with at least its replicas. A rule for replicas may only ask for more, so no round stops
 * earlier. Else FRACAS_DAMAGED naming the first difference with its path and both values. */
FRACAS_MUST_USE fracas_err fracas_campaign_extends(const fracas_campaign *now,
                                                   const fracas_campaign *before);

/* The reference page of the campaign file (docs/formats/campaign-file-keys.md), from the parameter
 * tables. FRACAS_ENVIRONMENT without memory, and nothing is printed. */
FRACAS_MUST_USE fracas_err fracas_campaign_reference(FILE *out);
/* The JSON schema (2020-12) of campaign files, likewise: a file that it refuses is refused. */
FRACAS_MUST_USE fracas_err fracas_campaign_schema(FILE *out);
/* A campaign file of the model to start from, with all of its keys. FRACAS_USAGE, with the nearest,
 * for an unknown model. */
FRACAS_MUST_USE fracas_err fracas_campaign_template(const char *model, FILE *out);
/* Prints the columns of /point that follow from the others, as docs/formats/study.md has them. */
void fracas_derived_reference(FILE *out);

#endif
