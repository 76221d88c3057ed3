/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One instruction set's kernels: the template in its widths. Include with SHELL_KERNELS defined as
 * the name of the table. */
#include "engine/formulation/shell/shell_sweep.h"

#include <math.h>

#define SHELL_PASTE_(a, b, c) a##_##b##_##c
#define SHELL_PASTE(a, b, c) SHELL_PASTE_(a, b, c)
#define SHELL_SWEEP(name) SHELL_PASTE(sweep, name, LANES)

#define LANES 1
#include "engine/formulation/shell/shell_template.h"
#undef LANES
#ifdef __AVX2__
#define LANES 4
#include "engine/formulation/shell/shell_template.h"
#undef LANES
#endif
#ifdef __AVX512F__
#define LANES 8
#include "engine/formulation/shell/shell_template.h"
#undef LANES
#endif

#ifdef __AVX2__
#define SHELL_FOUR(name) name##_4
#else
#define SHELL_FOUR(name) NULL
#endif
#ifdef __AVX512F__
#define SHELL_EIGHT(name) name##_8
#else
#define SHELL_EIGHT(name) NULL
#endif

const fracas_shell_kernels SHELL_KERNELS = {
    .sweep = {[SHELL_NITSCHE] = {sweep_nitsche_1, SHELL_FOUR(sweep_nitsche),
                                 SHELL_EIGHT(sweep_nitsche)},
              [SHELL_OPERATOR] = {sweep_operator_1}},
};
