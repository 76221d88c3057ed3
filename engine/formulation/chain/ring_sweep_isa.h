/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instruction set's kernels: the templates in its widths. Include with RING_KERNELS defined as
 * the name of the table. */
#include "engine/formulation/chain/ring_sweep.h"

#include <math.h>

#define RING_PASTE_(a, b, c) a##_##b##_##c
#define RING_PASTE(a, b, c) RING_PASTE_(a, b, c)
#define RING_SWEEP(law) RING_PASTE(sweep, law, LANES)

#define LANES 1
#include "engine/formulation/chain/ring_templates.h"
#undef LANES
#ifdef __AVX2__
#define LANES 4
#include "engine/formulation/chain/ring_templates.h"
#undef LANES
#endif
#ifdef __AVX512F__
#define LANES 8
#include "engine/formulation/chain/ring_templates.h"
#undef LANES
#endif

const fracas_ring_kernels RING_KERNELS = {
    .nitsche[0] = sweep_nitsche_1,
    .stershic[0] = sweep_stershic_1,
#ifdef __AVX2__
    .nitsche[1] = sweep_nitsche_4,
    .stershic[1] = sweep_stershic_4,
#endif
#ifdef __AVX512F__
    .nitsche[2] = sweep_nitsche_8,
    .stershic[2] = sweep_stershic_8,
#endif
};
