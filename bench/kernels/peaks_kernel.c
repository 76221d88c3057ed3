/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loops that do one thing as often as the CPU can: a kernel. */
#include "base/lanes.h"
#include "bench/kernels/peaks.h"

#define EACH_CHAIN _Pragma("GCC unroll 12") for (int i = 0; i < FRACAS_PEAK_CHAINS; i++)

/* A number that depends on all chains: none may be left out. */
LANES_FUNCTION double first_of(const vd *chain)
{
    vd sum = lanes_set(0.0);
    double of[LANES];
    EACH_CHAIN sum += chain[i];
    memcpy(of, &sum, sizeof of);
    return of[0];
}

static double multiply_add(int64_t rounds)
{
    const vd factor = lanes_set(0.75), more = lanes_set(0.25); /* they approach 1 */
    vd chain[FRACAS_PEAK_CHAINS];
    EACH_CHAIN chain[i] = lanes_set(1.5 + i);
    for (int64_t round = 0; round < rounds; round++) EACH_CHAIN chain[i] = chain[i] * factor + more;
    return first_of(chain);
}

static double divide(int64_t rounds)
{
    const vd one = lanes_set(1.1);
    vd chain[FRACAS_PEAK_CHAINS];
    EACH_CHAIN chain[i] = lanes_set(1.3 + i);
    for (int64_t round = 0; round < rounds; round++) EACH_CHAIN chain[i] = one / chain[i];
    return first_of(chain);
}

static double read_all(const double *from, size_t size)
{
    vu chain[8] = {0};
    vd found;
    double of[LANES];
    for (size_t at = 0; at < size; at += 8 * LANES)
        _Pragma("GCC unroll 8") for (int i = 0; i < 8; i++)
            chain[i] ^= lanes_bits(lanes_load(from + at + (size_t)i * LANES));
    for (int i = 1; i < 8; i++) chain[0] ^= chain[i];
    found = lanes_double(chain[0]);
    memcpy(of, &found, sizeof of);
    return of[0];
}

const fracas_peak_kernel LANES_UNIT(fracas_peak) = {
    .multiply_add = multiply_add, .divide = divide, .read = read_all};
