/* SPDX-License-Identifier: GPL-3.0-or-later */
/* time.end of a point without one, for stop rules to which it is a cap alone. */
#ifndef FRACAS_CAMPAIGNS_FILE_CAP_H
#define FRACAS_CAMPAIGNS_FILE_CAP_H

#include "campaigns/campaign.h"

/* The cap [s], rounded to two digits, or to more where they move it by a tenth of the second term
 *   t_onset + 6 max(K, 20) L/c,   t_onset = sigma/(E rate),   c = sqrt(E/rho)
 *   L = sqrt(ZMR max(ZMR, Mott)), at most the length of a chain                (settled.10)
 * for K = time.transits, the sizes by (scaling-laws.6) and (scaling-laws.10). With a size effect
 * sigma is the larger of the mean strengths of an interface and of the reference in t_onset, and
 * the smaller in L.
 * `extent`: of an interface, for strengths with a size effect.
 * NaN where there is no strain rate at the start or no mean strength. */
double fracas_point_cap(const fracas_point *point, fracas_extent extent);

#endif
