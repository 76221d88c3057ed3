/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanes: realizations side by side in one SIMD register, from one kernel source.
 *
 * Include in a kernel (base/isa.h), whose units have LANES defined as 1, 4 (AVX2) or 8 (AVX-512).
 * A kernel is written with
 *   vd          LANES doubles (a plain double for LANES 1)
 *   vmask       LANES truth values
 *   lanes_load / lanes_store / lanes_set     memory, and one value for all
 *   lanes_lt / lanes_le                      a < b, a <= b (false for NaN)
 *   lanes_and / lanes_or / lanes_any / lanes_all  of masks
 *   lanes_select(m, a, b)                    m ? a : b
 *   lanes_get(m, l)                          truth value of lane l
 *   lanes_max(a, b) / lanes_min(a, b)        a < b ? b : a, b < a ? b : a
 *   lanes_sqrt(a)                            the correctly rounded square root
 *   vu          LANES words of 64 bits (a plain uint64_t for LANES 1)
 *   lanes_quotient(a, b)                     a/b to the 24 bits of a float, several times as fast
 *   lanes_bits(a) / lanes_double(b)          the words that represent the doubles, and back
 * and + - * / of C, for words also & | ^ << >>. Every operation is the IEEE one in every width and
 * instruction set, for the whole build has contraction off. A lane's bits depend on its own values
 * alone. Intrinsics are used only where GNU C has no operator: masks and selection. */
#ifndef FRACAS_BASE_LANES_H
#define FRACAS_BASE_LANES_H

#include <stdint.h>
#include <string.h>
#if defined(__AVX2__) || defined(__AVX512F__)
#include <immintrin.h>
#endif

/* Name of a unit's export: LANES_UNIT(fracas_bar) is fracas_bar_avx2_4 for ISA avx2, LANES 4. */
#define LANES_UNIT(name) LANES_JOIN_(name, ISA, LANES)
#define LANES_JOIN_(name, isa, lanes) LANES_PASTE_(name, isa, lanes)
#define LANES_PASTE_(name, isa, lanes) name##_##isa##_##lanes

#define LANES_FUNCTION __attribute__((unused, always_inline)) static inline

#if LANES == 1

typedef double vd;
typedef int vmask;
typedef uint64_t vu;
LANES_FUNCTION vd lanes_load(const double *from)
{
    return *from;
}
LANES_FUNCTION void lanes_store(double *to, vd x)
{
    *to = x;
}
LANES_FUNCTION vd lanes_set(double x)
{
    return x;
}
LANES_FUNCTION vmask lanes_lt(vd a, vd b)
{
    return a < b;
}
LANES_FUNCTION vmask lanes_le(vd a, vd b)
{
    return a <= b;
}
LANES_FUNCTION vmask lanes_and(vmask a, vmask b)
{
    return a & b;
}
LANES_FUNCTION vmask lanes_or(vmask a, vmask b)
{
    return a | b;
}
LANES_FUNCTION int lanes_any(vmask m)
{
    return m;
}
LANES_FUNCTION int lanes_all(vmask m)
{
    return m;
}
LANES_FUNCTION vd lanes_select(vmask m, vd a, vd b)
{
    return m ? a : b;
}
LANES_FUNCTION int lanes_get(vmask m, int lane)
{
    (void)lane;
    return m;
}
LANES_FUNCTION vd lanes_max(vd a, vd b)
{
    return a < b ? b : a;
}
LANES_FUNCTION vd lanes_min(vd a, vd b)
{
    return b < a ? b : a;
}
LANES_FUNCTION vd lanes_sqrt(vd a)
{
    return __builtin_sqrt(a);
}
LANES_FUNCTION vd lanes_quotient(vd a, vd b)
{
    return (float)a / (float)b;
}

#else

typedef double vd __attribute__((vector_size(8 * LANES)));
typedef uint64_t vu __attribute__((vector_size(8 * LANES)));
typedef float vf __attribute__((vector_size(4 * LANES)));
LANES_FUNCTION vd lanes_quotient(vd a, vd b)
{
    return __builtin_convertvector(__builtin_convertvector(a, vf) / __builtin_convertvector(b, vf),
                                   vd);
}
LANES_FUNCTION vd lanes_load(const double *from)
{
    vd x;
    memcpy(&x, __builtin_assume_aligned(from, sizeof x), sizeof x);
    return x;
}
LANES_FUNCTION void lanes_store(double *to, vd x)
{
    memcpy(__builtin_assume_aligned(to, sizeof x), &x, sizeof x);
}
LANES_FUNCTION vd lanes_set(double x)
{
#if LANES == 4
    return (vd){x, x, x, x};
#else
    return (vd){x, x, x, x, x, x, x, x};
#endif
}

#if LANES == 8 && defined(__AVX512F__)

typedef __mmask8 vmask;
LANES_FUNCTION vmask lanes_lt(vd a, vd b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LT_OQ);
}
LANES_FUNCTION vmask lanes_le(vd a, vd b)
{
    return _mm512_cmp_pd_mask((__m512d)a, (__m512d)b, _CMP_LE_OQ);
}
LANES_FUNCTION vmask lanes_and(vmask a, vmask b)
{
    return (vmask)(a & b);
}
LANES_FUNCTION vmask lanes_or(vmask a, vmask b)
{
    return (vmask)(a | b);
}
LANES_FUNCTION int lanes_any(vmask m)
{
    return m != 0;
}
LANES_FUNCTION int lanes_all(vmask m)
{
    return m == 0xff;
}
LANES_FUNCTION vd lanes_select(vmask m, vd a, vd b)
{
    return (vd)_mm512_mask_blend_pd(m, (__m512d)b, (__m512d)a);
}
LANES_FUNCTION int lanes_get(vmask m, int lane)
{
    return m >> lane & 1;
}
LANES_FUNCTION vd lanes_max(vd a, vd b)
{
    return (vd)_mm512_max_pd((__m512d)b, (__m512d)a); /* the second one of equals and of NaN */
}
LANES_FUNCTION vd lanes_min(vd a, vd b)
{
    return (vd)_mm512_min_pd((__m512d)b, (__m512d)a);
}
LANES_FUNCTION vd lanes_sqrt(vd a)
{
    return (vd)_mm512_sqrt_pd((__m512d)a);
}

#elif LANES == 4 && defined(__AVX2__)

typedef __m256d vmask;
LANES_FUNCTION vmask lanes_lt(vd a, vd b)
{
    return _mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_LT_OQ);
}
LANES_FUNCTION vmask lanes_le(vd a, vd b)
{
    return _mm256_cmp_pd((__m256d)a, (__m256d)b, _CMP_LE_OQ);
}
LANES_FUNCTION vmask lanes_and(vmask a, vmask b)
{
    return _mm256_and_pd(a, b);
}
LANES_FUNCTION vmask lanes_or(vmask a, vmask b)
{
    return _mm256_or_pd(a, b);
}
LANES_FUNCTION int lanes_any(vmask m)
{
    return _mm256_movemask_pd(m) != 0;
}
LANES_FUNCTION int lanes_all(vmask m)
{
    return _mm256_movemask_pd(m) == 0xf;
}
LANES_FUNCTION vd lanes_select(vmask m, vd a, vd b)
{
    return (vd)_mm256_blendv_pd((__m256d)b, (__m256d)a, m);
}
LANES_FUNCTION int lanes_get(vmask m, int lane)
{
    return _mm256_movemask_pd(m) >> lane & 1;
}
LANES_FUNCTION vd lanes_max(vd a, vd b)
{
    return (vd)_mm256_max_pd((__m256d)b, (__m256d)a); /* the second one of equals and of NaN */
}
LANES_FUNCTION vd lanes_min(vd a, vd b)
{
    return (vd)_mm256_min_pd((__m256d)b, (__m256d)a);
}
LANES_FUNCTION vd lanes_sqrt(vd a)
{
    return (vd)_mm256_sqrt_pd((__m256d)a);
}

#else
#error "4 lanes need AVX2, 8 lanes need AVX-512: see docs/decisions/lanes-and-registers.md"
#endif
#endif

LANES_FUNCTION vu lanes_bits(vd a)
{
    vu b;
    memcpy(&b, &a, sizeof b);
    return b;
}
LANES_FUNCTION vd lanes_double(vu b)
{
    vd a;
    memcpy(&a, &b, sizeof a);
    return a;
}

#endif
