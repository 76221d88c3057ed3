/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions of all laws over lanes, for kernels. */
#ifndef FRACAS_ENGINE_COHESIVE_KERNELS_H
#define FRACAS_ENGINE_COHESIVE_KERNELS_H

#include "base/lanes.h"
#include "engine/cohesive/law.h"
#include "engine/cohesive/line.h"
#include "engine/cohesive/plane.h"

#include "engine/cohesive/laws.list.h"

/* Law number `law` at a point of a surface; `point` has its values, brought up to date. */
LANES_FUNCTION plane_result plane_law(int law, const plane_interface *at, const plane_input *in,
                                      double *point)
{
#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    FRACAS_IF_##membrane(if (law == FRACAS_LAW_##name) return plane_at_##name(at, in, point);)
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
    __builtin_unreachable();
}

/* Law number `law` at an interface of a chain. */
LANES_FUNCTION line_result line_law(int law, const line_input *in)
{
#define BAR_FLUX(name) \
    if (law == FRACAS_LAW_##name) return line_##name(in);
#define BAR_RIGID(name)
#define BAR_NO(name)
#define FRACAS_LAW(name, bar, ring, membrane, shell) BAR_##bar(name)
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#undef BAR_FLUX
#undef BAR_RIGID
#undef BAR_NO
    __builtin_unreachable();
}

#endif
