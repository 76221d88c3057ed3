/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/isa.h"

#include <stdbool.h>

const char *const fracas_isa_name[FRACAS_NISAS] = {"baseline", "avx2", "avx512"};

#ifdef __clang__
const char *const fracas_compiler = __VERSION__; /* names itself */
#else
const char *const fracas_compiler = "gcc " __VERSION__;
#endif

#define BUILT(type, name, isa, ISA, lanes) [FRACAS_ISA_##ISA][lanes] = true,
static const bool built[FRACAS_NISAS][FRACAS_LANES_MAX + 1] = {FRACAS_EACH_KERNEL(BUILT, , )};

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

int fracas_isa_lanes(fracas_isa isa, int width)
{
    while (width > 0 && !built[isa][width]) width--;
    return width;
}

fracas_err fracas_isa_choose(fracas_isa wanted, fracas_isa *isa)
{
    *isa = wanted;
    if (wanted == FRACAS_ISA_BEST) {
        *isa = FRACAS_ISA_AVX512;
        while (*isa > FRACAS_ISA_BASELINE && !(has_isa(*isa) && fracas_isa_lanes(*isa, 1))) --*isa;
    }
    if (!has_isa(*isa))
        return fracas_fail(FRACAS_USAGE,
                           "this CPU has no %s: choose a lower instruction set or leave it out",
                           fracas_isa_name[*isa]);
    if (!fracas_isa_lanes(*isa, 1))
        return fracas_fail(FRACAS_USAGE,
                           "this program has no kernels for %s: leave the instruction set out, or "
                           "build it with the option FRACAS_KERNELS as it is by default",
                           fracas_isa_name[*isa]);
    return FRACAS_OK;
}
