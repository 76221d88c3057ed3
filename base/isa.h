/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The CPU's instruction sets for which kernels are compiled. */
#ifndef FRACAS_BASE_ISA_H
#define FRACAS_BASE_ISA_H

#include "base/err.h"

/* All give the same bits. */
typedef enum {
    FRACAS_ISA_BASELINE,
    FRACAS_ISA_AVX2,
    FRACAS_ISA_AVX512,
    FRACAS_ISA_BEST
} fracas_isa;
#define FRACAS_NISAS FRACAS_ISA_BEST
extern const char *const fracas_isa_name[FRACAS_NISAS]; /* "baseline", "avx2", "avx512" */

/* *isa = wanted; for FRACAS_ISA_BEST the best one of this CPU. FRACAS_USAGE if the CPU lacks the
 * one wanted. */
FRACAS_MUST_USE fracas_err fracas_isa_choose(fracas_isa wanted, fracas_isa *isa);

#endif
