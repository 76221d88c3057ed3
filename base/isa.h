/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instruction sets of this CPU that kernels are compiled for. */
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

/* *isa = wanted, or the best that this CPU has for FRACAS_ISA_BEST; FRACAS_USAGE if it lacks the
 * one wanted. */
FRACAS_MUST_USE fracas_err fracas_isa_choose(fracas_isa wanted, fracas_isa *isa);

#endif
