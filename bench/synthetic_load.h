/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations that only wait, for benchmarks of the scheduler. */
#ifndef FRACAS_BENCH_SYNTHETIC_LOAD_H
#define FRACAS_BENCH_SYNTHETIC_LOAD_H

#include <stdint.h>

typedef struct {
    double seconds;      /* a realization's [s] */
    double long_part;    /* fraction of realizations that take long_seconds, 0 to 1 */
    double long_seconds; /* [s] */
} synthetic_load;

/* Seconds of a realization, by its name only, so that every run of a study has the same work:
 * splitmix64 (Steele, Lea and Flood 2014) of point and replica. */
static inline double synthetic_seconds(const synthetic_load *load, uint64_t point, int64_t replica)
{
    uint64_t x = (point << 40) + (uint64_t)replica + 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return (double)(x >> 11) * 0x1p-53 < load->long_part ? load->long_seconds : load->seconds;
}

#endif
