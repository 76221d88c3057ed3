/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `camacho-ortiz`: Becker and Noels' form (engine/cohesive/extrinsic.h). */
#if defined FRACAS_LAW
FRACAS_LAW(camacho_ortiz, NO, NO, YES, NO)
#else
#include "engine/cohesive/extrinsic.h"
#if defined FRACAS_LAW_TABLES

static const fracas_param camacho_ortiz_params[] = {FRACAS_SURFACE_LAW};
const fracas_law fracas_law_camacho_ortiz = {
    FRACAS_LAW_HEAD(
        camacho_ortiz, "camacho-ortiz",
        "the same with normal and shear traction scaled by those at onset (Becker and Noels' "
        "paper); dissipates less than G_c on mixed paths: for comparison"),
    .shares_of_onset = true, .fields = {EXTRINSIC_FIELDS, EXTRINSIC_FIELDS_FRICTION}};

#else

LANES_FUNCTION plane_result plane_at_camacho_ortiz(const plane_interface *at, const plane_input *in,
                                                   double *point)
{
    return extrinsic_at(at, in, 0, point);
}

LANES_FUNCTION vd plane_opening_camacho_ortiz(const plane_interface *at, const plane_input *in,
                                              const double *point)
{
    return extrinsic_opening_at(at, in, point);
}
#endif
#endif
