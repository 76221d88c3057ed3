/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instruction set's kernels: the template in its widths. Include with MEMBRANE_KERNELS defined
 * as the name of the table. */
#include "engine/formulation/surface/membrane_sweep.h"

#include <math.h>

#define MEMBRANE_PASTE_(a, b, c) a##_##b##_##c
#define MEMBRANE_PASTE(a, b, c) MEMBRANE_PASTE_(a, b, c)
#define MEMBRANE_SWEEP(name) MEMBRANE_PASTE(sweep, name, LANES)

#define LANES 1
#include "engine/formulation/surface/membrane_template.h"
#undef LANES
#ifdef __AVX2__
#define LANES 4
#include "engine/formulation/surface/membrane_template.h"
#undef LANES
#endif
#ifdef __AVX512F__
#define LANES 8
#include "engine/formulation/surface/membrane_template.h"
#undef LANES
#endif

#ifdef __AVX2__
#define MEMBRANE_FOUR(name) name##_4
#else
#define MEMBRANE_FOUR(name) NULL
#endif
#ifdef __AVX512F__
#define MEMBRANE_EIGHT(name) name##_8
#else
#define MEMBRANE_EIGHT(name) NULL
#endif
#define MEMBRANE_WIDTHS(name)                               \
    {                                                       \
        name##_1, MEMBRANE_FOUR(name), MEMBRANE_EIGHT(name) \
    }

const fracas_membrane_kernels MEMBRANE_KERNELS = {
    .sweep = {[MEMBRANE_NITSCHE] = {MEMBRANE_WIDTHS(sweep_nitsche_linear),
                                    MEMBRANE_WIDTHS(sweep_nitsche_quadratic)},
              [MEMBRANE_EXTRINSIC] = {MEMBRANE_WIDTHS(sweep_extrinsic_linear),
                                      MEMBRANE_WIDTHS(sweep_extrinsic_quadratic)},
              [MEMBRANE_OPERATOR] = {{sweep_operator_linear_1}, {sweep_operator_quadratic_1}}},
};
