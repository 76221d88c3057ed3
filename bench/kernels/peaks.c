/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/kernels/peaks.h"

#include "base/own.h"
#include "bench/kernels/timing.h"

#include <math.h>

FRACAS_KERNEL_TABLE(const fracas_peak_kernel, fracas_peak);

const size_t fracas_peak_bytes[FRACAS_PEAK_READS] = {512 << 10, 16 << 20, 128 << 20};

static volatile double kept; /* results, so that no loop may be left out */

/* Rounds a second of a loop that takes about `seconds`. */
static double rounds_of(double (*loop)(int64_t rounds), double seconds)
{
    int64_t rounds = 100, done = 0;
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    double spent;
    do {
        kept = loop(rounds);
        done += rounds;
        rounds *= 2;
    } while ((spent = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start) < 0.5 * seconds);
    return (double)done / spent;
}

double fracas_peak_multiply_add(fracas_isa isa, int lanes, double seconds)
{
    return 2.0 * FRACAS_PEAK_CHAINS * lanes *
           rounds_of(fracas_peak[isa][lanes]->multiply_add, seconds);
}

/* Bytes a second, of `bytes` bytes read again and again for 2 ms at least. */
static double read_of(const fracas_peak_kernel *kernel, const double *from, size_t bytes)
{
    const double start = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
    double spent, done = 0;
    do { /* the clock is a system call: 1 MiB at least between two looks at it */
        for (size_t read = 0; read < 1 << 20; read += bytes) {
            kept = kernel->read(from, bytes / sizeof *from);
            done += (double)bytes;
        }
    } while ((spent = seconds_of(CLOCK_PROCESS_CPUTIME_ID) - start) < 2e-3);
    return done / spent;
}

static fracas_err allocate(size_t bytes, double **memory)
{
    *memory = aligned_alloc(64, bytes);
    if (!*memory) return fracas_no_memory("the memory that a benchmark reads");
    for (size_t i = 0; i < bytes / sizeof **memory; i++) (*memory)[i] = (double)i; /* own pages */
    return FRACAS_OK;
}

fracas_err fracas_peak_read(fracas_isa isa, int lanes, double bytes, double *rate)
{
    const size_t size = ((size_t)bytes / 512 + 1) * 512; /* whole turns of the loop */
    OWNED double *memory = NULL;
    TRY(allocate(size, &memory));
    *rate = 0;
    for (int turn = 0; turn < 5; turn++)
        *rate = fmax(*rate, read_of(fracas_peak[isa][lanes], memory, size));
    return FRACAS_OK;
}

fracas_err fracas_peaks_measure(fracas_isa isa, int lanes, fracas_peaks *peaks)
{
    const fracas_peak_kernel *kernel = fracas_peak[isa][lanes];
    const size_t most = fracas_peak_bytes[FRACAS_PEAK_READS - 1];
    OWNED double *memory = NULL;
    TRY(allocate(most, &memory));
    *peaks = (fracas_peaks){0};
    for (int turn = 0; turn < 5; turn++) {
        peaks->multiply_add = fmax(peaks->multiply_add, fracas_peak_multiply_add(isa, lanes, 4e-3));
        peaks->divide = fmax(peaks->divide,
                             (double)FRACAS_PEAK_CHAINS * lanes * rounds_of(kernel->divide, 4e-3));
        peaks->load = fmax(peaks->load, read_of(kernel, memory, 16 << 10));
        for (int i = 0; i < FRACAS_PEAK_READS; i++)
            peaks->read[i] = fmax(peaks->read[i], read_of(kernel, memory, fracas_peak_bytes[i]));
    }
    return FRACAS_OK;
}
