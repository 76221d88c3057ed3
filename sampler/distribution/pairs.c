/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/pairs.h"

#include <stdio.h>

/* The given key of the pair, or the missing one; NULL: there is none. */
static const char *key_of(const fracas_param pair[2], const fracas_strength *strength, bool given)
{
    for (int k = 0; k < 2; k++)
        if ((fracas_param_get(&pair[k], strength) > 0.0) == given) return pair[k].name;
    return NULL;
}

static int count(const fracas_param pair[2], const fracas_strength *strength)
{
    return (fracas_param_get(&pair[0], strength) > 0.0) +
           (fracas_param_get(&pair[1], strength) > 0.0);
}

fracas_err fracas_pairs_choose(const fracas_strength *strength, const fracas_param pairs[4],
                               bool *by_moments)
{
    const int own = count(pairs, strength), moments = count(pairs + 2, strength);
    *by_moments = moments == 2;
    if (own + moments == 2 && own != 1) return FRACAS_OK;
    const fracas_param *pair = own >= moments ? pairs : pairs + 2,
                       *other = own >= moments ? pairs + 2 : pairs;
    const char *excess = key_of(other, strength, true), *lacks = key_of(pair, strength, false);
    const bool all = own + moments == 4;
    char remedy[200] = "none of them is given: add one of the two pairs";
    if (excess && lacks)
        snprintf(remedy, sizeof remedy, "parts of both are given: take out `%s` and add `%s`",
                 excess, lacks);
    else if (excess)
        snprintf(remedy, sizeof remedy, "`%s` and `%s` say all: take out `%s`%s%s%s", pair[0].name,
                 pair[1].name, excess, all ? " and `" : "", all ? other[1].name : "",
                 all ? "`" : "");
    else if (own + moments > 0) snprintf(remedy, sizeof remedy, "add `%s`", lacks);
    return fracas_fail(FRACAS_USAGE, "distribution %s needs `%s` and `%s`, or `%s` and `%s`; %s",
                       strength->distribution->name, pairs[0].name, pairs[1].name, pairs[2].name,
                       pairs[3].name, remedy);
}

fracas_err fracas_pairs_check(const fracas_strength *strength, const char *name, double ratio,
                              double least, double most)
{
    if (ratio >= least && ratio <= most) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is %.6g; a %s distribution has it from %.6g to %.6g: change one of the "
                       "two, or take another distribution",
                       name, ratio, strength->distribution->name, least, most);
}
