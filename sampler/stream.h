/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams of random numbers by name. */
#ifndef FRACAS_SAMPLER_STREAM_H
#define FRACAS_SAMPLER_STREAM_H

#include <stddef.h>
#include <stdint.h>

/* The name of a stream of random numbers: a value depends on this and its site, on nothing else. */
typedef struct {
    uint64_t seed;     /* the campaign's */
    uint64_t purpose;  /* FRACAS_PURPOSE_... */
    uint64_t point[2]; /* point hash; 0 for draws common to all points */
    uint64_t replica;
} fracas_stream;

#define FRACAS_PURPOSE_STRENGTH 1u
#define FRACAS_PURPOSE_MESH 2u
#define FRACAS_PURPOSE_DESIGN 3u

/* The site of Gauss point `point` of interface `interface`. */
static inline uint64_t fracas_stream_site(uint64_t interface, uint64_t point)
{
    return interface + (point << 48);
}

/* u in (0, 1): word 0 of Philox4x64-10 with key (seed, purpose) and counter (site, replica, point),
 * as ((x >> 12) + 1/2) 2^-52.
 * u and 1 - u are both exact, from 2^-53 to 1 - 2^-53 (with 53 bits of x, u could round to 1). */
double fracas_stream_uniform(const fracas_stream *stream, uint64_t site);

/* u[j] belongs to site first + j, 0 <= j < n. */
void fracas_stream_fill(const fracas_stream *stream, uint64_t first, size_t n, double *u);

#endif
