/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instruction sets of this CPU, and the kernels that this program has for them.
 *
 * A kernel is a source NAME_kernel.c (base/lanes.h). The build compiles it once for each
 * instruction set and number of lanes, with LANES and ISA defined; the option FRACAS_KERNELS lists
 * the pairs. Such a unit exports one constant or function, LANES_UNIT(name), and everything else in
 * it is static. */
#ifndef FRACAS_BASE_ISA_H
#define FRACAS_BASE_ISA_H

#include "base/err.h"
#include "base/kernels.h" /* FRACAS_EACH_KERNEL: written by CMake from FRACAS_KERNELS */

enum { FRACAS_LANES_MAX = 8 }; /* realizations of the widest batch, lanes of the widest register */

/* All give the same bits. */
typedef enum {
    FRACAS_ISA_BASELINE,
    FRACAS_ISA_AVX2,
    FRACAS_ISA_AVX512,
    FRACAS_ISA_BEST
} fracas_isa;
#define FRACAS_NISAS FRACAS_ISA_BEST
extern const char *const fracas_isa_name[FRACAS_NISAS]; /* "baseline", "avx2", "avx512" */

/* *isa = wanted, or the best that this CPU and this program have for FRACAS_ISA_BEST; FRACAS_USAGE
 * if either lacks the one wanted. */
FRACAS_MUST_USE fracas_err fracas_isa_choose(fracas_isa wanted, fracas_isa *isa);

/* The compiler of this program, "gcc 12.2.0". */
extern const char *const fracas_compiler;

/* The widest kernel of an instruction set that fracas_isa_choose returned, of at most `width`
 * lanes: 1, 4 or 8. A wider batch takes its lanes in groups. */
int fracas_isa_lanes(fracas_isa isa, int width);

/* Declares a kernel's units and defines `name`, the table of pointers to them, by instruction set
 * and lanes: name[isa][fracas_isa_lanes(isa, width)]. `type` is that of a unit: a function type or
 * a const one. */
#define FRACAS_KERNEL_TABLE(type, name)                             \
    FRACAS_EACH_KERNEL(FRACAS_KERNEL_DECLARE_, type, name)          \
    static type *const name[FRACAS_NISAS][FRACAS_LANES_MAX + 1] = { \
        FRACAS_EACH_KERNEL(FRACAS_KERNEL_ENTRY_, type, name)}
#define FRACAS_KERNEL_DECLARE_(type, name, isa, ISA, lanes) extern type name##_##isa##_##lanes;
#define FRACAS_KERNEL_ENTRY_(type, name, isa, ISA, lanes) \
    [FRACAS_ISA_##ISA][lanes] = &name##_##isa##_##lanes,

#endif
