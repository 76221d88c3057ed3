/* SPDX-License-Identifier: GPL-3.0-or-later */
/* time.end of a point that gives none, for stop rules that need it as a cap alone. */
#ifndef FRACAS_CAMPAIGNS_FILE_CAP_H
#define FRACAS_CAMPAIGNS_FILE_CAP_H

#include "campaigns/campaign.h"

/* The cap [s], to two digits
 *   t_onset + 6 K L/c,   t_onset = sigma/(E rate),   c = sqrt(E/rho)           (settled.10)
 * for K = time.transits, sigma the mean strength (at the reference size, where there is one) and
 * fragments of size L = E G_c/sigma^2 4.5/(1 + 4.5 e^(2/3)), e = rate/edot0  (scaling-laws.6).
 * NaN of a load without a strain rate, and where no mean strength is known. */
double fracas_point_cap(const fracas_point *point);

#endif
