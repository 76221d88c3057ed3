/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/study.h5 from the segments, in plan order. */
#include "campaigns/store/file/disk.h"
#include "campaigns/store/study.h"
#include "campaigns/store/study/segments.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
    const fracas_point_table *table;
    fracas_writer *writer;
    bool complete; /* no realization failed */
} merging;

static fracas_err append(void *context, fracas_visit *visit)
{
    merging *m = context;
    const fracas_result *result = &visit->result;
    const fracas_row_status status = visit->place.status;
    if (status == FRACAS_PLANNED || status == FRACAS_LEASED) {
        return fracas_fail(
            FRACAS_INTERRUPTED,
            "replica %" PRId64 " of point %s is not computed yet; run again to go on",
            result->replica, fracas_hash_hex(&m->table->point[result->point].hash).text);
    }
    if (status != FRACAS_DONE) m->complete = false;
    return fracas_writer_append(m->writer, result->point, result->replica, &result->record);
}

/* After all records, point by point, of the points whose replicas a rule decides. */
static fracas_err append_decisions(const merging *m, fracas_index *index)
{
    for (size_t p = 0; p < m->table->npoints; p++) {
        OWNED fracas_decision *decision = NULL;
        size_t count;
        if (!m->table->point[p].most) continue;
        TRY(fracas_index_decisions(index, &m->table->point[p].hash, &decision, &count));
        for (size_t d = 0; d < count; d++) decision[d].point = (int64_t)p;
        TRY(fracas_writer_decisions(m->writer, decision, count));
    }
    return FRACAS_OK;
}

/* After all records, point by point: the order depends on nothing else. */
static fracas_err append_meshes(const merging *m, const fracas_mesh_source *meshes)
{
    for (size_t p = 0; p < m->table->npoints; p++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
        TRY(meshes->get(meshes->context, p, &mesh));
        TRY(fracas_writer_mesh(m->writer, &mesh));
    }
    return FRACAS_OK;
}

/* After a merge that found damage: sets damaged segments aside, and FRACAS_INTERRUPTED says so.
 * Without any, the message of the merge stands. */
static fracas_err plan_damaged_again(const char *study, fracas_index *index)
{
    char before[1024];
    OWNED char *text = NULL;
    size_t size;
    int64_t rows = 0;
    snprintf(before, sizeof before, "%s", fracas_message());
    FILE *report = open_memstream(&text, &size);
    if (!report) return fracas_no_memory("a report");
    fracas_err err = fracas_segments_sweep(study, index, true, report, &rows);
    if (fclose(report) != 0 && !err) err = fracas_no_memory("a report");
    TRY(err);
    if (*text) TRY(fracas_index_event(index, "recovered", text));
    if (!rows) return fracas_fail(FRACAS_DAMAGED, "%s", before);
    return fracas_fail(FRACAS_INTERRUPTED,
                       "damage was found when study.h5 was to be made: %sthe same command computes "
                       "them",
                       text);
}

/* No segment is open on return. */
static fracas_err merge(const char *study, fracas_index *index, const fracas_file_header *header,
                        const fracas_point_table *table, const fracas_mesh_source *meshes,
                        const fracas_campaign_copy *campaign)
{
    OWNED char *path = NULL;
    OWN(fracas_segments) segments = NULL;
    OWN(fracas_writer) writer = NULL;
    fracas_identity identity;
    fracas_file_seal seal;
    fracas_identity_of(header, &identity);
    TRY(fracas_disk_join(study, "study.h5", &path));
    TRY(fracas_segments_create(study, index, &identity, false, &segments));
    TRY(fracas_writer_create(path, header, table, &writer));
    merging m = {.table = table, .writer = writer, .complete = true};
    const fracas_want want = {
        .table = table, .parts = FRACAS_READ_ALL, .visit = append, .context = &m};
    TRY(fracas_study_each_planned(segments, index, &want));
    TRY(append_decisions(&m, index));
    if (meshes && header->interfaces) TRY(append_meshes(&m, meshes));
    if (campaign) TRY(fracas_writer_campaign(writer, campaign));
    /* A death from here on leaves no seal: merged again. */
    TRY(fracas_index_seal_study(index, NULL));
    writer = NULL;
    TRY(fracas_writer_finish(m.writer, m.complete, &seal));
    return fracas_index_seal_study(index, &seal);
}

fracas_err fracas_study_merge(const char *study, fracas_index *index,
                              const fracas_file_header *header, const fracas_point_table *table,
                              const fracas_mesh_source *meshes,
                              const fracas_campaign_copy *campaign)
{
    const fracas_err err = merge(study, index, header, table, meshes, campaign);
    return err == FRACAS_DAMAGED ? plan_damaged_again(study, index) : err;
}

fracas_err fracas_study_file_sealed(const char *study, fracas_index *index, bool *sealed)
{
    OWNED char *path = NULL;
    fracas_file_seal seal;
    TRY(fracas_index_study_seal(index, sealed, &seal));
    if (!*sealed) return FRACAS_OK;
    TRY(fracas_disk_join(study, "study.h5", &path));
    return fracas_disk_has_size(path, seal.bytes, sealed);
}

fracas_err fracas_study_sealed(const char *study, fracas_index *index, bool *sealed)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    TRY(fracas_study_file_sealed(study, index, sealed));
    if (!*sealed) return FRACAS_OK;
    TRY(fracas_index_segments_by_id(index, &known));
    for (size_t s = 0; *sealed && s < known.count; s++)
        TRY(fracas_segment_is_there(study, &known.segment[s], sealed));
    return FRACAS_OK;
}
