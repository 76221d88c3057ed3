/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undefines the names of sweep_template.h and of what it includes, so that they can be included for
 * another width. */
#undef surface_at
#undef surface_drift
#undef surface_kick
#undef surface_nitsche
#undef UNROLL_FOR
#include "engine/cohesive/plane_end.h"
#undef central_drift
#undef central_kick
#include "base/lanes_end.h"
