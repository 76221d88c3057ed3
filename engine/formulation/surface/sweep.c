/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/sweep.h"

#include "engine/integrator/hulbert_chung.h"
#include "engine/integrator/integrator.h"

fracas_surface_motion fracas_surface_motion_of(const fracas_time *time)
{
    const fracas_hulbert_chung alpha = fracas_hulbert_chung_of(time->spectral_radius);
    return (fracas_surface_motion){.alpha = time->integrator == &fracas_integrator_hulbert_chung,
                                   .alpha_m = alpha.alpha_m,
                                   .b = alpha.beta,
                                   .g = alpha.gamma};
}
