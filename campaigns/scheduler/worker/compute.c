/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/compute.h"

#include "campaigns/plan/point_model.h"
#include "campaigns/scheduler/worker/fault.h"
#include "campaigns/scheduler/worker/stand_in.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <unistd.h>

/* Realizations of a lease that are computed side by side. */
typedef struct {
    const int64_t *replica;
    size_t count;
} lanes;

static fracas_err fill_strengths(const fracas_computation *computation, const lanes *realizations,
                                 fracas_batch *batch)
{
    for (size_t lane = 0; lane < realizations->count; lane++) {
        size_t stride;
        double *strength = fracas_batch_strength(batch, lane, &stride);
        const fracas_stream stream = fracas_point_stream(
            computation->campaign, (size_t)computation->lease->point, FRACAS_PURPOSE_STRENGTH,
            (uint64_t)realizations->replica[lane]);
        TRY(fracas_field_sample(computation->field, &stream, stride, strength));
    }
    return FRACAS_OK;
}

static fracas_err solve(const fracas_computation *computation, const lanes *realizations,
                        fracas_record *record)
{
    const fracas_batch_options batch_options = {
        .history = computation->campaign->output.history,
        .interfaces = computation->campaign->output.interfaces,
        .width = computation->options->width,
        .isa = computation->options->isa};
    fracas_batch *batch;
    fracas_log_if_asked(computation->lease->point, realizations->replica, realizations->count);
    TRY(fracas_fault_if_asked(computation->lease->point, realizations->replica,
                              realizations->count));
    TRY(fracas_batch_create(computation->model, realizations->count, &batch_options, &batch));
    fracas_err err = fill_strengths(computation, realizations, batch);
    if (!err) err = fracas_batch_run(batch, record);
    fracas_batch_destroy(batch);
    return err;
}

static fracas_err pack(const fracas_record *record, fracas_packet **message)
{
    size_t size = fracas_record_packed_size(record);
    void *bytes = malloc(size);
    if (!bytes) return fracas_no_memory("a packed record");
    fracas_record_pack(record, bytes);
    fracas_err err = fracas_packet_create(FRACAS_PACKET_RECORD, bytes, size, message);
    free(bytes);
    return err;
}

static fracas_err compute(const fracas_computation *computation, const lanes *realizations,
                          fracas_packet **message)
{
    fracas_record record[FRACAS_BATCH_MAX];
    size_t packed = 0;
    for (size_t lane = 0; lane < realizations->count; lane++) fracas_record_init(&record[lane]);
    fracas_err err = computation->options->stand_in
                         ? fracas_stand_in_compute(computation->options->stand_in,
                                                   computation->lease->point, realizations->replica,
                                                   realizations->count, record)
                         : solve(computation, realizations, record);
    for (size_t lane = 0; lane < realizations->count; lane++) {
        if (!err) err = pack(&record[lane], &message[lane]);
        if (!err) packed++;
        fracas_record_clear(&record[lane]);
    }
    while (err && packed) free(message[--packed]);
    return err;
}

/* Bytes of this process that RLIMIT_DATA counts (with its stack); 0 if they cannot be known. */
static double allocated(void)
{
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "re");
    if (!file) return 0;
    if (fscanf(file, "%*u %*u %*u %*u %*u %lu", &pages) != 1) pages = 0;
    fclose(file);
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

/* Lets this process allocate `bytes` more than it has; *before is what it might until then. */
static void limit_memory(double bytes, struct rlimit *before)
{
    getrlimit(RLIMIT_DATA, before);
    struct rlimit limit = *before;
    const double most = allocated() + bytes;
    if (limit.rlim_cur == RLIM_INFINITY || most < (double)limit.rlim_cur)
        limit.rlim_cur = (rlim_t)most;
    setrlimit(RLIMIT_DATA, &limit);
}

size_t fracas_compute_width(const fracas_run_options *options)
{
    return options->width ? (size_t)options->width : FRACAS_BATCH_MAX;
}

fracas_err fracas_compute_prepare(fracas_computation *computation, fracas_models *models)
{
    return fracas_models_get(models, computation->campaign, (size_t)computation->lease->point,
                             &computation->model, &computation->field);
}

fracas_err fracas_compute_batch(const fracas_computation *computation, size_t from,
                                fracas_packet *record[FRACAS_BATCH_MAX], size_t *count)
{
    const size_t width = fracas_compute_width(computation->options),
                 left = (size_t)computation->lease->count - from;
    const lanes realizations = {computation->lease->replica + from, left < width ? left : width};
    const double memory = computation->options->memory_limit;
    *count = realizations.count;
    if (!(memory > 0)) return compute(computation, &realizations, record);
    struct rlimit before;
    limit_memory(memory, &before);
    fracas_err err = compute(computation, &realizations, record);
    setrlimit(RLIMIT_DATA, &before);
    if (err != FRACAS_ENVIRONMENT) return err;
    return fracas_fail_within(err, "--memory-limit lets a lease allocate %g MB", memory / 1048576);
}
