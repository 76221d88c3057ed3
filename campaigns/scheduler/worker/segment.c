/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/segment.h"

#include "campaigns/store/checkpoint.h"

#include "base/cpu.h"
#include "base/isa.h"
#include "base/json.h"
#include "base/version.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/header.h"
#include "campaigns/scheduler/types/mailbox.h"
#include "campaigns/store/pack.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

fracas_err fracas_segment_add(fracas_segment *segment, size_t point, int64_t replica,
                              fracas_packet *record)
{
    fracas_err err = fracas_grow(&segment->entry, sizeof *segment->entry, segment->count,
                                 &segment->capacity, "a segment");
    if (err) free(record);
    TRY(err);
    if (segment->count == 0) {
        segment->began = fracas_now();
        clock_gettime(CLOCK_REALTIME, &segment->clock);
    }
    segment->entry[segment->count++] = (fracas_segment_entry){point, replica, record};
    segment->bytes += record->size;
    return FRACAS_OK;
}

double fracas_segment_wait(const fracas_segment *segment, const fracas_run_options *options)
{
    if (segment->count == 0) return INFINITY;
    if (segment->bytes >= options->segment_bytes) return 0;
    return segment->began + options->segment_age - fracas_now();
}

/* ---- provenance ---- */

static void write_versions(fracas_json *json)
{
    char cpu[256], hdf5[32], mpi[128];
    fracas_cpu_name(cpu, sizeof cpu);
    fracas_hdf5_version(hdf5);
    fracas_mailbox_version(mpi, sizeof mpi);
    fracas_json_text(json, "version", FRACAS_VERSION);
    fracas_json_text(json, "compiler", fracas_compiler);
    fracas_json_text(json, "hdf5", hdf5);
    fracas_json_text(json, "sqlite", fracas_sqlite_version());
    fracas_json_text(json, "mpi", mpi);
    fracas_json_text(json, "cpu", cpu);
}

/* Place, time and program of the computation, one JSON object (docs/formats/study.md): never part
 * of study.h5. *text is freed by the caller. */
static fracas_err make_provenance(const fracas_segment *segment, const char *host,
                                  const fracas_run_options *options, char **text)
{
    fracas_isa isa; /* for this server's batches */
    size_t size;
    TRY(fracas_isa_choose(options->isa, &isa));
    FILE *out = open_memstream(text, &size);
    if (!out) return fracas_no_memory("the provenance of a segment");
    const char *job = getenv("SLURM_JOB_ID");
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "host", host);
    fracas_json_integer(&json, "pid", getpid());
    if (job) fracas_json_text(&json, "slurm_job", job);
    write_versions(&json);
    fracas_json_text(&json, "isa", fracas_isa_name[isa]);
    fracas_json_integer(&json, "lanes_asked", options->width); /* 0: by number of realizations */
    fracas_json_real(&json, "began",
                     (double)segment->clock.tv_sec + 1e-9 * (double)segment->clock.tv_nsec);
    fracas_json_real(&json, "wall_seconds", fracas_now() - segment->began);
    fracas_json_real(&json, "compute_seconds", segment->compute);
    fracas_json_end(&json);
    if (fclose(out) || !*text) return fracas_no_memory("the provenance of a segment");
    return FRACAS_OK;
}

/* ---- the file ---- */

/* "20260131T120000.123456789-HOST-PID-NUMBER.h5" */
static void make_name(const fracas_segment *segment, const char *host, char *name, size_t size)
{
    struct tm utc;
    gmtime_r(&segment->clock.tv_sec, &utc);
    char day[32];
    strftime(day, sizeof day, "%Y%m%dT%H%M%S", &utc);
    snprintf(name, size, "%s.%09ld-%s-%ld-%llu.h5", day, segment->clock.tv_nsec, host,
             (long)getpid(), (unsigned long long)segment->number);
}

/* Appends entry `i` to the file and sets its row for the index. */
static fracas_err append(const fracas_segment *segment, size_t i, const fracas_campaign *campaign,
                         fracas_writer *writer, fracas_segment_row *row)
{
    const fracas_segment_entry *entry = &segment->entry[i];
    fracas_record record;
    fracas_record_init(&record);
    fracas_err err = fracas_record_unpack(entry->record->body, entry->record->size, &record);
    if (!err) err = fracas_writer_append(writer, entry->point, entry->replica, &record);
    *row = (fracas_segment_row){.point = campaign->point[entry->point].hash,
                                .replica = entry->replica,
                                .row = (int64_t)i,
                                .summary = fracas_summary_of(&record)};
    fracas_record_clear(&record);
    return err;
}

static fracas_err write_file(const fracas_segment *segment, const char *path,
                             const fracas_campaign *campaign, const char *provenance,
                             fracas_segment_row *row, fracas_file_seal *seal)
{
    fracas_file_header header = fracas_campaign_header(campaign);
    fracas_writer *writer;
    TRY(fracas_writer_create(path, &header, &campaign->table, &writer));
    fracas_err err = fracas_writer_provenance(writer, provenance);
    for (size_t i = 0; !err && i < segment->count; i++)
        err = append(segment, i, campaign, writer, &row[i]);
    if (!err) return fracas_writer_finish(writer, false, seal);
    fracas_writer_abandon(writer);
    return err;
}

fracas_err fracas_segment_write(fracas_segment *segment, const char *study,
                                const fracas_campaign *campaign, const fracas_run_options *options,
                                fracas_packet **note)
{
    char host[65] = "unknown";
    OWNED char *provenance = NULL, *path = NULL;
    gethostname(host, sizeof host - 1);
    fracas_segment_note head = {.rows = segment->count};
    make_name(segment, host, head.name, sizeof head.name);
    TRY(fracas_path(&path, "%s/segments/%s", study, head.name));
    TRY(make_provenance(segment, host, options, &provenance));
    size_t rows = segment->count * sizeof(fracas_segment_row), text = strlen(provenance) + 1;
    OWNED fracas_packet *made = NULL;
    TRY(fracas_packet_create(FRACAS_PACKET_SEGMENT, NULL, sizeof head + rows + text, &made));
    TRY(write_file(segment, path, campaign, provenance,
                   (fracas_segment_row *)(made->body + sizeof head), &head.seal));
    fracas_checkpoints_remove(study, (fracas_segment_row *)(made->body + sizeof head),
                              segment->count);
    memcpy(made->body, &head, sizeof head);
    memcpy(made->body + sizeof head + rows, provenance, text);
    *note = made;
    made = NULL;
    const uint64_t number = segment->number + 1;
    fracas_segment_clear(segment);
    segment->number = number;
    return FRACAS_OK;
}

void fracas_segment_clear(fracas_segment *segment)
{
    for (size_t i = 0; i < segment->count; i++) free(segment->entry[i].record);
    free(segment->entry);
    *segment = (fracas_segment){0};
}
