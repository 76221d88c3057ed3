/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/pairs.h"

#include <stdio.h>

static bool is_given(const fracas_pair_key *key)
{
    return key->value > 0.0;
}

/* FRACAS_USAGE: the pairs to choose from, and the remedy. */
static fracas_err refuse(const char *distribution, const fracas_pair_key own[2],
                         const fracas_pair_key moments[2], const char *remedy)
{
    return fracas_fail(FRACAS_USAGE, "distribution %s needs `%s` and `%s`, or `%s` and `%s`; %s",
                       distribution, own[0].key, own[1].key, moments[0].key, moments[1].key,
                       remedy);
}

fracas_err fracas_pairs_choose(const char *distribution, const fracas_pair_key own[2],
                               const fracas_pair_key moments[2], bool *by_moments)
{
    const int nown = is_given(&own[0]) + is_given(&own[1]),
              nmoments = is_given(&moments[0]) + is_given(&moments[1]);
    *by_moments = nmoments == 2;
    if (nown + nmoments == 2 && nown != 1) return FRACAS_OK;
    if (nown + nmoments == 0)
        return refuse(distribution, own, moments,
                      "none of them is given: add one of the two pairs");
    const fracas_pair_key *pair = nown >= nmoments ? own : moments,
                          *other = pair == own ? moments : own;
    const fracas_pair_key *excess = is_given(&other[0])   ? &other[0]
                                    : is_given(&other[1]) ? &other[1]
                                                          : NULL;
    const fracas_pair_key *lacks = !is_given(&pair[0])   ? &pair[0]
                                   : !is_given(&pair[1]) ? &pair[1]
                                                         : NULL;
    char remedy[200];
    if (excess && lacks)
        snprintf(remedy, sizeof remedy, "parts of both are given: take out `%s` and add `%s`",
                 excess->key, lacks->key);
    else if (excess)
        snprintf(remedy, sizeof remedy, "`%s` and `%s` say all: take out `%s`%s%s%s", pair[0].key,
                 pair[1].key, excess->key, nmoments + nown == 4 ? " and `" : "",
                 nmoments + nown == 4 ? other[1].key : "", nmoments + nown == 4 ? "`" : "");
    else snprintf(remedy, sizeof remedy, "add `%s`", lacks->key);
    return refuse(distribution, own, moments, remedy);
}

fracas_err fracas_pairs_check(const char *distribution, const char *name, double ratio,
                              double least, double most)
{
    if (ratio >= least && ratio <= most) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is %.6g; a %s distribution has it from %.6g to %.6g: change one of the "
                       "two, or take another distribution",
                       name, ratio, distribution, least, most);
}
