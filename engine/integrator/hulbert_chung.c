/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/hulbert_chung.h"

#include <math.h>

/* (membrane.14), (membrane.15) */
fracas_hulbert_chung fracas_hulbert_chung_of(double r)
{
    const double alpha_m = (2 * r - 1) / (1 + r);
    return (fracas_hulbert_chung){.alpha_m = alpha_m,
                                  .beta = (5 - 3 * r) / ((1 + r) * (1 + r) * (2 - r)),
                                  .gamma = 1.5 - alpha_m,
                                  .limit = sqrt(12 * (1 + r) * (2 - r) / (10 - 5 * r + r * r))};
}
