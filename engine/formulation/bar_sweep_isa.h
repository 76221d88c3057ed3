/* One instruction set's kernels: the template in its widths and two laws. Include with BAR_KERNELS defined as
 * the name of the table. */
#include "engine/formulation/bar_sweep.h"

#include <math.h>

#define BAR_PASTE_(a, b, c) a##_##b##_##c
#define BAR_PASTE(a, b, c) BAR_PASTE_(a, b, c)
#define BAR_SWEEP(law) BAR_PASTE(sweep, law, LANES)

#define LANES 1
#include "engine/formulation/bar_sweep_template.h"
#undef LANES
#ifdef __AVX2__
#define LANES 4
#include "engine/formulation/bar_sweep_template.h"
#undef LANES
#endif
#ifdef __AVX512F__
#define LANES 8
#include "engine/formulation/bar_sweep_template.h"
#undef LANES
#endif

const fracas_bar_kernels BAR_KERNELS = {
    .nitsche[0] = sweep_nitsche_1, .rigid_link[0] = sweep_rigid_link_1,
#ifdef __AVX2__
    .nitsche[1] = sweep_nitsche_4, .rigid_link[1] = sweep_rigid_link_4,
#endif
#ifdef __AVX512F__
    .nitsche[2] = sweep_nitsche_8, .rigid_link[2] = sweep_rigid_link_8,
#endif
};
