/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/compute.h"
#include "campaigns/store/pack.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

static fracas_err pack(const fracas_record *record, fracas_packet **message)
{
    TRY(fracas_packet_create(FRACAS_PACKET_RECORD, NULL, fracas_record_packed_size(record),
                             message));
    fracas_record_pack(record, (*message)->body);
    return FRACAS_OK;
}

static fracas_err compute(const fracas_computation *computation, const int64_t *replica,
                          size_t count, fracas_packet **message)
{
    fracas_record record[FRACAS_LANES_MAX];
    size_t packed = 0;
    for (size_t lane = 0; lane < count; lane++) fracas_record_init(&record[lane]);
    fracas_err err = fracas_solve(computation, replica, count, record);
    for (size_t lane = 0; lane < count; lane++) {
        if (!err) err = pack(&record[lane], &message[lane]);
        if (!err) packed++;
        fracas_record_clear(&record[lane]);
    }
    while (err && packed) free(message[--packed]);
    return err;
}

/* Bytes of this process in the count of RLIMIT_DATA (with its stack); 0 if unknown. */
static double allocated(void)
{
    unsigned long pages = 0;
    OWN(FILE) file = fopen("/proc/self/statm", "re");
    if (!file || fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1) return 0;
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

/* Lets this process allocate `bytes` more than now; *before is the former limit. */
static void limit_memory(double bytes, struct rlimit *before)
{
    getrlimit(RLIMIT_DATA, before);
    struct rlimit limit = *before;
    const double most = allocated() + bytes;
    if (limit.rlim_cur == RLIM_INFINITY || most < (double)limit.rlim_cur)
        limit.rlim_cur = (rlim_t)most;
    setrlimit(RLIMIT_DATA, &limit);
}

fracas_err fracas_compute_batch(const fracas_computation *computation, size_t from,
                                fracas_packet *record[FRACAS_LANES_MAX], size_t *count)
{
    const size_t width = fracas_run_width(computation->options),
                 left = (size_t)computation->lease->count - from;
    const int64_t *replica = computation->lease->replica + from;
    const double memory = computation->options->memory_limit;
    *count = left < width ? left : width;
    if (!(memory > 0)) return compute(computation, replica, *count, record);
    struct rlimit before;
    limit_memory(memory, &before);
    fracas_err err = compute(computation, replica, *count, record);
    setrlimit(RLIMIT_DATA, &before);
    if (err != FRACAS_ENVIRONMENT) return err;
    return fracas_fail_within(err, "--memory-limit lets a lease allocate %g MB", memory / 1048576);
}
