/* SPDX-License-Identifier: GPL-3.0-or-later */
/* An order of sites from coarse to fine, and the nearest predecessors of each. */
#ifndef FRACAS_SAMPLER_ORDER_H
#define FRACAS_SAMPLER_ORDER_H

#include "base/err.h"

#include <stddef.h>
#include <stdint.h>

/* order[k], k < n, are the sites: the first is near the middle, and each further one is about as
 * far from all before it as possible. near[(k - first)*m + a], first <= k < n, a < m <= first:
 * places in the order of the m predecessors nearest to site order[k], the nearest first. n < 2^31.
 * Time O(n (m + log n)) where sites lie on a line or surface, or fill a body about evenly.
 * FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_order_sites(size_t n, const double (*position)[3], size_t first,
                                              size_t m, uint32_t *order, uint32_t *near);

#endif
