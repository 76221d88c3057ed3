/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/rest.h"

#include "base/elementary.h"

#include <stdlib.h>

static int by_size(const void *a, const void *b)
{
    const double left = *(const double *)a, right = *(const double *)b;
    return (left > right) - (left < right);
}

/* Probability of a break by e = energy/least cost, fitted to 20 cases of bars  (settled.5) */
static double probability(double e)
{
    return e > 1.2 ? -fracas_expm1((1.2 - e) / 3.5) : 0;
}

/* (settled.5), (settled.6) */
void fracas_rest_add(fracas_rest *rest, double energy, double *cost, size_t count, double parting)
{
    size_t paid = 0;
    double left = energy;
    qsort(cost, count, sizeof *cost, by_size);
    while (paid < count && left >= cost[paid]) left -= cost[paid++];
    const double breaks = parting > 1 ? 1 : paid > 0 ? probability(energy / cost[0]) : 0;
    rest->mean += breaks;
    rest->variance += breaks * (1 - breaks);
    rest->bound += (double)paid;
}
