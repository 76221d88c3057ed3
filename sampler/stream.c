/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Streams of random numbers by name: Philox4x64-10 (Salmon et al., SC11, 2011). */
#include "sampler/stream.h"

#include <Random123/philox.h>

/* (sampling.1), (sampling.2) */
static inline double uniform(const fracas_stream *stream, uint64_t site)
{
    philox4x64_key_t key = {{stream->seed, stream->purpose}};
    philox4x64_ctr_t counter = {{site, stream->replica, stream->point[0], stream->point[1]}};
    uint64_t word = philox4x64(counter, key).v[0];
    return ((double)(word >> 12) + 0.5) * 0x1p-52;
}

double fracas_stream_uniform(const fracas_stream *stream, uint64_t site)
{
    return uniform(stream, site);
}

void fracas_stream_fill(const fracas_stream *stream, uint64_t first, size_t n, double *u)
{
    for (size_t j = 0; j < n; j++) u[j] = uniform(stream, first + j);
}
