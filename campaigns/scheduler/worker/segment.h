/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The current segment of a compute server: records in memory until it is old or big enough to be
 * written. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SEGMENT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SEGMENT_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"
#include "campaigns/scheduler/types/packet.h"

#include <time.h>

typedef struct {
    size_t point;
    int64_t replica;
    fracas_packet *record;
} fracas_segment_entry;

typedef struct {
    fracas_segment_entry *entry;
    size_t count, capacity;
    double bytes;          /* size of the packed records */
    double began;          /* fracas_now of the first record */
    struct timespec clock; /* time of day then */
    double compute;        /* time spent on its leases [s], for the provenance */
    uint64_t number;       /* segments written by this server before */
} fracas_segment;

/* Adds a record, which the segment owns from now on, also on failure. */
FRACAS_MUST_USE fracas_err fracas_segment_add(fracas_segment *segment, size_t point,
                                              int64_t replica, fracas_packet *record);

/* Seconds until it must be written; at most 0: now; INFINITY: it is empty. */
double fracas_segment_wait(const fracas_segment *segment, const fracas_run_options *options);

/* Writes STUDY/segments/NAME and empties the segment; *note is the SEGMENT message for rank 0. NAME
 * is unique by host, process and time. The segment must not be empty. */
FRACAS_MUST_USE fracas_err fracas_segment_write(fracas_segment *segment, const char *study,
                                                const fracas_campaign *campaign,
                                                const fracas_run_options *options,
                                                fracas_packet **note);

void fracas_segment_clear(fracas_segment *segment);

#endif
