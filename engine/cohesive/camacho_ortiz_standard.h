/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `camacho-ortiz-standard`: the usual extrinsic law (engine/cohesive/extrinsic.h). */
#if defined FRACAS_LAW
FRACAS_LAW(camacho_ortiz_standard, NO, NO, YES, NO)
#else
#include "engine/cohesive/extrinsic.h"
#if defined FRACAS_LAW_TABLES

static const fracas_param camacho_ortiz_standard_params[] = {FRACAS_SURFACE_LAW};
const fracas_law fracas_law_camacho_ortiz_standard = {
    FRACAS_LAW_HEAD(
        camacho_ortiz_standard, "camacho-ortiz-standard",
        "linear softening of an interface that leaves the discontinuous-Galerkin flux at onset "
        "(the usual extrinsic law): wants a time.safety of 0.05"),
    .fields = {EXTRINSIC_FIELDS, EXTRINSIC_FIELDS_FRICTION}};

#else

LANES_FUNCTION plane_result plane_at_camacho_ortiz_standard(const plane_interface *at,
                                                            const plane_input *in, double *point)
{
    return extrinsic_at(at, in, 1, point);
}

LANES_FUNCTION vd plane_opening_camacho_ortiz_standard(const plane_interface *at,
                                                       const plane_input *in, const double *point)
{
    return extrinsic_opening_at(at, in, point);
}
#endif
#endif
