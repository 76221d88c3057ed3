/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/chosen.h"

#include "base/param.h"

#include <inttypes.h>
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

static int by_fragments(const void *a, const void *b)
{
    const fracas_candidate *x = a, *y = b;
    if (x->fragments != y->fragments) return x->fragments < y->fragments ? -1 : 1;
    return (x->replica > y->replica) - (x->replica < y->replica);
}

static size_t choose_median(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                            size_t n, int64_t *chosen)
{
    (void)wanted;
    qsort(candidate, n, sizeof *candidate, by_fragments);
    chosen[0] = candidate[(n - 1) / 2].replica;
    return 1;
}

static size_t choose_extreme(const fracas_wanted_fields *wanted, fracas_candidate *candidate,
                             size_t n, int64_t *chosen)
{
    (void)wanted;
    qsort(candidate, n, sizeof *candidate, by_fragments);
    chosen[0] = candidate[0].replica;
    if (n == 1) return 1;
    chosen[1] = candidate[n - 1].replica;
    return 2;
}

static const choice first = {choose_first}, median = {choose_median}, extreme = {choose_extreme},
                    listed = {choose_listed};

static const fracas_param listed_params[] = {
    {"replicas", FRACAS_NUMBERS, "1", "their numbers, from 0", FRACAS_REQUIRED, 0, INFINITY, false,
     offsetof(fracas_wanted_fields, replicas)},
};

static const fracas_kind kind_none = {.name = "none", .doc = "no realization"},
                         kind_first = {.name = "first",
                                       .doc = "of each point the first replica that did not FAIL",
                                       .traits = &first},
                         kind_median = {.name = "median",
                                        .doc = "of each point the replica of the median (of an "
                                               "even number the lower) number of fragments",
                                        .traits = &median},
                         kind_extreme = {.name = "extreme",
                                         .doc = "of each point the replicas of the fewest and of "
                                                "the most fragments",
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
