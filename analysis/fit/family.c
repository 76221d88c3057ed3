/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/family.h"

#include <string.h>

const fracas_family *const fracas_families[FRACAS_NFAMILIES] = {
    &fracas_family_exponential, &fracas_family_rayleigh,          &fracas_family_shifted_rayleigh,
    &fracas_family_weibull,     &fracas_family_weibull3,          &fracas_family_lognormal,
    &fracas_family_gamma,       &fracas_family_generalised_gamma, &fracas_family_power_law,
    &fracas_family_mott,
};

const fracas_family *fracas_family_find(const char *name)
{
    for (size_t f = 0; f < FRACAS_NFAMILIES; f++)
        if (!strcmp(fracas_families[f]->name, name)) return fracas_families[f];
    return NULL;
}

bool fracas_family_within(const fracas_family *special, const fracas_family *general)
{
    const size_t length = strlen(general->name);
    for (const char *at = special->general; *at; at += strspn(at, " ")) {
        const size_t word = strcspn(at, " ");
        if (word == length && !strncmp(at, general->name, word)) return true;
        at += word;
    }
    return false;
}
