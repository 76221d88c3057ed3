/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/chosen.h"

#include "base/param.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>

/* Traits of a kind; NULL: nothing is chosen. */
typedef struct {
    size_t (*choose)(const fracas_wanted_fields *wanted, fracas_candidate *candidate, size_t n,
                     int64_t *chosen);
} choice;

static size_t choose_first(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                           size_t n, int64_t *chosen)
{
    (void)wanted, (void)n;
    chosen[0] = candidate[0].replica;
    return 1;
}

static bool lists(const fracas_numbers *replicas, int64_t replica)
{
    for (size_t i = 0; i < replicas->n; i++)
        if (replicas->value[i] == replica) return true;
    return false;
}

static size_t choose_listed(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                            size_t n, int64_t *chosen)
{
    size_t count = 0;
    for (size_t i = 0; i < n; i++)
        if (lists(wanted->replicas, candidate[i].replica)) chosen[count++] = candidate[i].replica;
    return count;
}

/* Realizations without a number, as an onset, come last. */
static int by_value(const void *a, const void *b)
{
    const fracas_candidate *x = a, *y = b;
    if (isnan(x->value) != isnan(y->value)) return isnan(x->value) ? 1 : -1;
    if (x->value < y->value || x->value > y->value) return x->value < y->value ? -1 : 1;
    return (x->replica > y->replica) - (x->replica < y->replica);
}

/* Sorts them; returns how many have a number, all where none has. */
static size_t sort(fracas_candidate *candidate, size_t n)
{
    size_t count = 0;
    qsort(candidate, n, sizeof *candidate, by_value);
    while (count < n && !isnan(candidate[count].value)) count++;
    return count ? count : n;
}

static size_t choose_median(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                            size_t n, int64_t *chosen)
{
    (void)wanted;
    chosen[0] = candidate[(sort(candidate, n) - 1) / 2].replica;
    return 1;
}

static size_t choose_extreme(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                             size_t n, int64_t *chosen)
{
    (void)wanted;
    const size_t count = sort(candidate, n);
    chosen[0] = candidate[0].replica;
    if (count == 1) return 1;
    chosen[1] = candidate[count - 1].replica;
    return 2;
}

static const choice first = {choose_first}, median = {choose_median}, extreme = {choose_extreme},
                    listed = {choose_listed};

static const fracas_param listed_params[] = {
    {"replicas", FRACAS_NUMBERS, "1", "their numbers, from 0", FRACAS_REQUIRED, 0, INFINITY, false,
     offsetof(fracas_wanted_fields, replicas)},
};

/* ---- by which number ---- */

typedef double number_of(const fracas_record *record);

static double fragments_of(const fracas_record *record)
{
    return (double)record->fragments;
}

static double broken_of(const fracas_record *record)
{
    return (double)record->broken;
}

static double dissipated_of(const fracas_record *record)
{
    return record->dissipated;
}

static double onset_of(const fracas_record *record)
{
    return record->onset_time;
}

static double end_of(const fracas_record *record)
{
    return record->end_time;
}

static double largest_of(const fracas_record *record)
{
    double mass = 0;
    for (size_t f = 0; f < record->nfragment; f++) mass = fmax(mass, record->fragment[f].mass);
    return mass;
}

/* Traits: a number_of. */
static const struct {
    number_of *of;
} number_fragments = {fragments_of}, number_broken = {broken_of},
  number_dissipated = {dissipated_of}, number_onset = {onset_of}, number_end = {end_of},
  number_largest = {largest_of};
static const fracas_kind
    by_fragments = {.name = "fragments",
                    .doc = "fragments, dust included",
                    .traits = &number_fragments},
    by_largest = {.name = "largest",
                  .doc = "mass of the largest fragment",
                  .traits = &number_largest},
    by_broken = {.name = "broken", .doc = "broken interfaces", .traits = &number_broken},
    by_dissipated = {.name = "dissipated",
                     .doc = "dissipated energy",
                     .traits = &number_dissipated},
    by_onset = {.name = "onset_time", .doc = "time of the first onset", .traits = &number_onset},
    by_end = {.name = "end_time", .doc = "time of the end", .traits = &number_end};
static const fracas_kind *const numbers[] = {&by_fragments,  &by_largest, &by_broken,
                                             &by_dissipated, &by_onset,   &by_end};

static const fracas_param by_params[] = {
    {FRACAS_ONE_OF("by", numbers, offsetof(fracas_wanted_fields, by),
                   "number of a realization by which they are ordered")},
};

static const fracas_kind kind_none = {.name = "none", .doc = "no realization"},
                         kind_first = {.name = "first",
                                       .doc = "of each point the first replica that did not FAIL",
                                       .traits = &first},
                         kind_median = {.name = "median",
                                        .doc = "of each point the replica of the median (of an "
                                               "even number the lower) number `by`",
                                        FRACAS_PARAMS(by_params),
                                        .traits = &median},
                         kind_extreme = {.name = "extreme",
                                         .doc = "of each point the replicas of the least and of "
                                                "the greatest number `by`",
                                         FRACAS_PARAMS(by_params),
                                         .traits = &extreme},
                         kind_listed = {.name = "listed",
                                        .doc = "of each point the replicas of these numbers, but "
                                               "those that FAILED",
                                        FRACAS_PARAMS(listed_params),
                                        .traits = &listed};
static const fracas_kind *const kinds[] = {&kind_none, &kind_first, &kind_median, &kind_extreme,
                                           &kind_listed};

static const fracas_param params[] = {
    {"every", FRACAS_REAL, "s",
     "from 0 on so often; 0: at the first onset, the peak of elastic and cohesive energy, and the "
     "end",
     0, 0, INFINITY, false, offsetof(fracas_wanted_fields, every)},
};

const fracas_section fracas_fields_section = {
    .name = "fields",
    .doc = "Fields for ParaView, which a run writes at its end into STUDY/fields by replays: the "
           "results are the same",
    .selector = "realizations",
    .kinds = kinds,
    .nkinds = FRACAS_COUNT(kinds),
    .kind_offset = offsetof(fracas_wanted_fields, of),
    .params = params,
    .nparams = FRACAS_COUNT(params),
    .run = true,
};

/* Refuses a listed replica beyond those of every point. */
static fracas_err check_listed(const fracas_file *file, const fracas_node *section,
                               const fracas_numbers *replicas, int64_t most)
{
    for (size_t i = 0; i < replicas->n; i++)
        if (replicas->value[i] >= most)
            return fracas_file_error(file, fracas_node_find(section, "replicas"),
                                     "`replicas` of `fields`: no point has a replica %" PRId64
                                     "; the last is %" PRId64,
                                     replicas->value[i], most - 1);
    return FRACAS_OK;
}

fracas_err fracas_fields_check(const fracas_file *file, const fracas_campaign *campaign)
{
    const fracas_wanted_fields *fields = &campaign->fields;
    const fracas_node *section = fracas_node_find(file->root, "fields"),
                      *every = section ? fracas_node_find(section, "every") : NULL;
    double end = 0;
    int64_t most = 0;
    for (size_t p = 0; p < campaign->npoints; p++) {
        end = fmax(end, campaign->point[p].spec.time.end);
        if (fracas_point_most(&campaign->point[p]) > most)
            most = fracas_point_most(&campaign->point[p]);
    }
    if (fields->replicas)
        TRY(fracas_file_note(file, check_listed(file, section, fields->replicas, most)));
    if (!(fields->every > 0)) return FRACAS_OK;
    if (!fracas_fields_wanted(fields))
        return fracas_file_error(file, every,
                                 "`every` of `fields` says when, not of which: add realizations: "
                                 "median, or another of them");
    if (end / fields->every < FRACAS_MOST_INSTANTS) return FRACAS_OK;
    return fracas_file_error(file, every,
                             "every %g s are %.3g instants until time.end, %g s; at most %d are "
                             "written: every %.2g s",
                             fields->every, end / fields->every, end, FRACAS_MOST_INSTANTS,
                             end / (0.9 * FRACAS_MOST_INSTANTS));
}

double fracas_fields_number(const fracas_wanted_fields *wanted, const fracas_record *record)
{
    const fracas_kind *by = wanted->by ? wanted->by : &by_fragments;
    return (*(number_of *const *)by->traits)(record);
}

bool fracas_fields_wanted(const fracas_wanted_fields *wanted)
{
    return wanted->of->traits != NULL;
}

size_t fracas_fields_choose(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                            size_t n, int64_t *chosen)
{
    if (n == 0) return 0;
    return ((const choice *)wanted->of->traits)->choose(wanted, candidate, n, chosen);
}
