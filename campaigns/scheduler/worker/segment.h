/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The current segment of a server: records in memory until it is old or big enough to be written.
 */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SEGMENT_H
#define FRACAS_CAMPAIGNS_SCHEDULER_WORKER_SEGMENT_H

#include "campaigns/campaign.h"
#include "campaigns/scheduler/packet.h"
#include "campaigns/scheduler/run.h"

#include <time.h>

typedef struct {
    size_t point;
    int64_t replica;
    fracas_packet *record;
} fracas_segment_entry;

typedef struct {
    fracas_segment_entry *entry;
    size_t count, capacity;
    double bytes;          /* of the packed records */
    double began;          /* fracas_now of the first record */
    struct timespec clock; /* time of day then */
    double compute;        /* s that its leases took, for the provenance */
    uint64_t number;       /* of segments written by this server before */
} fracas_segment;

/* Adds a record (owned by the segment from now on, also on failure). */
FRACAS_MUST_USE fracas_err fracas_segment_add(fracas_segment *segment, size_t point,
                                              int64_t replica, fracas_packet *record);

/* s until it must be written: 0 or less: now. INFINITY while it is empty. */
double fracas_segment_wait(const fracas_segment *segment, const fracas_run_options *options);

/* Writes STUDY/segments/NAME and empties the segment; *note is the message that tells rank 0. NAME
 * is of this host, process and time, so that no other run or server has it. The segment must not be
 * empty. */
FRACAS_MUST_USE fracas_err fracas_segment_write(fracas_segment *segment, const char *study,
                                                const fracas_campaign *campaign,
                                                const fracas_run_options *options,
                                                fracas_packet **note);

void fracas_segment_clear(fracas_segment *segment);

/* Header of the files of a campaign that this program computes. */
fracas_file_header fracas_segment_header(const fracas_campaign *campaign);

#endif
