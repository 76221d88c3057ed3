/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/isa.h"

#include <stdbool.h>

static bool has_isa(fracas_isa isa)
{
    switch (isa) {
    case FRACAS_ISA_AVX512:
        return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
               __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    case FRACAS_ISA_AVX2: return __builtin_cpu_supports("avx2");
    default: return true;
    }
}

const char *const fracas_isa_name[FRACAS_NISAS] = {"baseline", "avx2", "avx512"};

fracas_err fracas_isa_choose(fracas_isa wanted, fracas_isa *isa)
{
    *isa = wanted;
    if (wanted == FRACAS_ISA_BEST)
        *isa = has_isa(FRACAS_ISA_AVX512) ? FRACAS_ISA_AVX512
               : has_isa(FRACAS_ISA_AVX2) ? FRACAS_ISA_AVX2
                                          : FRACAS_ISA_BASELINE;
    if (!has_isa(*isa))
        return fracas_fail(FRACAS_USAGE,
                           "this CPU has no %s: choose a lower instruction set or leave it out",
                           fracas_isa_name[*isa]);
    return FRACAS_OK;
}
