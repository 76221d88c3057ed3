/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instruction set's kernels: the template in its widths, for both laws, for elements of one
 * length and of many. Include with BAR_KERNELS defined as the name of the table. */
#include "engine/formulation/chain/bar_sweep.h"

#include <math.h>

#define BAR_PASTE_(a, b, c) a##_##b##_##c
#define BAR_PASTE(a, b, c) BAR_PASTE_(a, b, c)
#define BAR_SWEEP(law) BAR_PASTE(sweep, law, LANES)

#define LANES 1
#include "engine/formulation/chain/bar_sweep_template.h"
#undef LANES
#ifdef __AVX2__
#define LANES 4
#include "engine/formulation/chain/bar_sweep_template.h"
#undef LANES
#define BAR_IF_4(sweep) sweep
#else
#define BAR_IF_4(sweep) NULL
#endif
#ifdef __AVX512F__
#define LANES 8
#include "engine/formulation/chain/bar_sweep_template.h"
#undef LANES
#define BAR_IF_8(sweep) sweep
#else
#define BAR_IF_8(sweep) NULL
#endif

const fracas_bar_kernels BAR_KERNELS = {
    .sweep = {{{sweep_varied_rigid_link_1, BAR_IF_4(sweep_varied_rigid_link_4),
                BAR_IF_8(sweep_varied_rigid_link_8)},
               {sweep_varied_nitsche_1, BAR_IF_4(sweep_varied_nitsche_4),
                BAR_IF_8(sweep_varied_nitsche_8)}},
              {{sweep_rigid_link_1, BAR_IF_4(sweep_rigid_link_4), BAR_IF_8(sweep_rigid_link_8)},
               {sweep_nitsche_1, BAR_IF_4(sweep_nitsche_4), BAR_IF_8(sweep_nitsche_8)}}}};
