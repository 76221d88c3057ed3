/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/copy.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/table.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The datasets of one set, and their rows that do not fill a chunk yet. */
typedef struct {
    hid_t dataset[FRACAS_MAX_COLUMNS];
    unsigned char *stored[FRACAS_MAX_COLUMNS]; /* a chunk a column */
    size_t waiting;                            /* rows in `stored` */
    uint64_t written;                          /* rows in the file */
} set_writer;

struct fracas_writer {
    fracas_h5 h5;
    char *path, *temporary;
    size_t npoints;
    bool interfaces; /* has an /interface group */
    bool probes;     /* has a /probe group */
    bool reactions;  /* has a /reaction group */
    bool decisions;  /* has a /decision group */
    bool meshes;     /* has a /mesh group */
    bool own_seal;   /* ends with a seal of its own */
    size_t npassed;  /* points whose mesh was given, or that have none */
    set_writer set[FRACAS_NSETS];
    int64_t end[FRACAS_NSETS]; /* rows of a ragged set so far: the last offset */
};

static bool has_set(const fracas_writer *writer, int set)
{
    if (set >= FRACAS_SET_MESH_NODE_OFFSET) return writer->meshes;
    if (set == FRACAS_SET_DECISION) return writer->decisions;
    if (set >= FRACAS_SET_REACTION_OFFSET) return writer->reactions;
    if (set >= FRACAS_SET_PROBE_OFFSET) return writer->probes;
    return writer->interfaces ||
           (set != FRACAS_SET_INTERFACE_OFFSET && set != FRACAS_SET_INTERFACE);
}

static void writer_free(fracas_writer *writer)
{
    for (int s = 0; s < FRACAS_NSETS; s++)
        for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++) free(writer->set[s].stored[c]);
    fracas_h5_close(&writer->h5);
    free(writer->path);
    free(writer->temporary);
    free(writer);
}

/* ---- rows ---- */

static fracas_err flush(fracas_writer *writer, int s)
{
    set_writer *set = &writer->set[s];
    if (!set->waiting) return FRACAS_OK;
    for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++)
        TRY(fracas_h5_append_rows(&writer->h5, &fracas_store_sets[s].column[c], set->dataset[c],
                                  set->written, set->waiting, set->stored[c]));
    set->written += set->waiting;
    set->waiting = 0;
    return FRACAS_OK;
}

static fracas_err put_rows(fracas_writer *writer, int s, const void *rows, size_t count)
{
    const fracas_store_set *schema = &fracas_store_sets[s];
    set_writer *set = &writer->set[s];
    const char *from = rows;
    while (count > 0) {
        size_t room = schema->chunk - set->waiting, take = count < room ? count : room;
        for (size_t c = 0; c < schema->ncolumns; c++) {
            const fracas_store_column *column = &schema->column[c];
            if (fracas_rows_store(column, from, schema->row_size, take,
                                  set->stored[c] + set->waiting * fracas_stored_size(column)))
                return fracas_fail(FRACAS_BUG, "%s: %s: a value does not fit its type",
                                   writer->path, column->path);
        }
        set->waiting += take;
        from += take * schema->row_size;
        count -= take;
        if (set->waiting == schema->chunk) TRY(flush(writer, s));
    }
    return FRACAS_OK;
}

/* Rows of one realization or point, and where they end in the set of offsets; NULL: the first
 * offset, 0. */
static fracas_err put_ragged(fracas_writer *writer, const fracas_ragged *ragged, const void *owner)
{
    const int s = ragged->offsets + 1;
    size_t count = 0;
    const void *rows = owner ? fracas_ragged_get(ragged, owner, &count) : NULL;
    if (!has_set(writer, s)) return FRACAS_OK;
    TRY(put_rows(writer, s, rows, count));
    writer->end[s] += (int64_t)count;
    return put_rows(writer, ragged->offsets, &writer->end[s], 1);
}

/* ---- start ---- */

static fracas_err write_header(const fracas_h5 *h5, const fracas_file_header *header)
{
    TRY(fracas_h5_put_integer(h5, "/", "format_version", H5T_STD_I32LE, FRACAS_FORMAT_VERSION));
    TRY(fracas_h5_put_text(h5, "/", "campaign", fracas_hash_hex(&header->campaign).text));
    TRY(fracas_h5_put_integer(h5, "/", "seed", H5T_STD_U64LE, header->seed));
    TRY(fracas_h5_put_integer(h5, "/", "history", H5T_STD_I64LE, (uint64_t)header->history));
    TRY(fracas_h5_put_integer(h5, "/", "interfaces", H5T_STD_I8LE, header->interfaces));
    if (header->reactions) TRY(fracas_h5_put_integer(h5, "/", "reactions", H5T_STD_I8LE, 1));
    if (header->probes.count) {
        char text[FRACAS_PROBES_TEXT];
        fracas_probes_write(&header->probes, text);
        TRY(fracas_h5_put_text(h5, "/", "probes", text));
    }
    return fracas_h5_put_text(h5, "/", "program_version", header->version);
}

static fracas_err create_set(fracas_writer *writer, int s)
{
    const fracas_store_set *schema = &fracas_store_sets[s];
    for (size_t c = 0; c < schema->ncolumns; c++) {
        const fracas_store_column *column = &schema->column[c];
        TRY(fracas_h5_create_column(&writer->h5, column, schema->chunk,
                                    &writer->set[s].dataset[c]));
        writer->set[s].stored[c] = malloc(schema->chunk * fracas_stored_size(column));
        if (!writer->set[s].stored[c]) return fracas_no_memory("the columns of a file");
    }
    return FRACAS_OK;
}

static fracas_err create_ragged(fracas_writer *writer, const fracas_ragged *ragged)
{
    TRY(create_set(writer, ragged->offsets));
    TRY(create_set(writer, ragged->offsets + 1));
    return put_ragged(writer, ragged, NULL);
}

static fracas_err create_sets(fracas_writer *writer)
{
    TRY(fracas_h5_create_group(&writer->h5, "/realization"));
    TRY(create_set(writer, FRACAS_SET_REALIZATION));
    for (int p = 0; p < FRACAS_NPARTS; p++) {
        if (!has_set(writer, fracas_record_parts[p].offsets)) continue;
        TRY(fracas_h5_create_group(&writer->h5, fracas_record_parts[p].group));
        TRY(create_ragged(writer, &fracas_record_parts[p]));
    }
    return FRACAS_OK;
}

fracas_err fracas_writer_create(const char *path, const fracas_file_header *header,
                                const fracas_point_table *table, fracas_writer **writer)
{
    OWN(fracas_writer) new = calloc(1, sizeof *new);
    *writer = NULL;
    if (!new) return fracas_no_memory("a file");
    new->h5 = FRACAS_H5_CLOSED;
    new->npoints = table->npoints;
    new->interfaces = header->interfaces;
    new->probes = header->probes.count > 0;
    new->reactions = header->reactions;
    new->path = strdup(path);
    if (!new->path) return fracas_no_memory("a file");
    TRY(fracas_disk_temporary(path, &new->temporary));
    TRY(fracas_h5_create(&new->h5, new->temporary, new->path));
    TRY(write_header(&new->h5, header));
    TRY(fracas_table_write(&new->h5, table));
    TRY(create_sets(new));
    *writer = new;
    new = NULL;
    return FRACAS_OK;
}

/* ---- records and the end ---- */

static bool is_consistent(const fracas_writer *writer, size_t point, int64_t replica,
                          const fracas_record *record)
{
    bool failed = record->outcome == FRACAS_FAILED;
    return point < writer->npoints && point <= INT32_MAX && replica >= 0 && record->outcome >= 0 &&
           record->outcome < FRACAS_NOUTCOMES && record->fragments_dust >= 0 &&
           record->fragments_dust <= record->fragments &&
           (failed || record->nfragment == (uint64_t)record->fragments);
}

fracas_err fracas_writer_append(fracas_writer *writer, size_t point, int64_t replica,
                                const fracas_record *record)
{
    if (!is_consistent(writer, point, replica, record))
        return fracas_fail(
            FRACAS_BUG,
            "%s: point %zu, replica %lld: the record contradicts itself or the point table",
            writer->path, point, (long long)replica);
    fracas_stored_realization row = {(int64_t)point, replica, *record};
    TRY(put_rows(writer, FRACAS_SET_REALIZATION, &row, 1));
    for (int p = 0; p < FRACAS_NPARTS; p++)
        TRY(put_ragged(writer, &fracas_record_parts[p], record));
    return FRACAS_OK;
}

fracas_err fracas_writer_provenance(fracas_writer *writer, const char *provenance)
{
    writer->own_seal = true;
    return fracas_h5_put_text(&writer->h5, "/", FRACAS_PROVENANCE, provenance);
}

/* ---- decisions ---- */

fracas_err fracas_writer_decisions(fracas_writer *writer, const fracas_decision *decision,
                                   size_t count)
{
    if (!count) return FRACAS_OK;
    if (!writer->decisions) { /* a study without them has the bytes that it always had */
        TRY(fracas_h5_create_group(&writer->h5, "/decision"));
        TRY(create_set(writer, FRACAS_SET_DECISION));
        writer->decisions = true;
    }
    return put_rows(writer, FRACAS_SET_DECISION, decision, count);
}

/* ---- meshes ---- */

static fracas_err put_mesh(fracas_writer *writer, const fracas_stored_mesh *mesh)
{
    for (int p = 0; p < FRACAS_NMESH_PARTS; p++)
        TRY(put_ragged(writer, &fracas_mesh_parts[p], mesh));
    return FRACAS_OK;
}

/* The group comes with the first surface, so that a study without one has the bytes that it always
 * had. */
static fracas_err begin_meshes(fracas_writer *writer)
{
    static const fracas_stored_mesh none = {0};
    TRY(fracas_h5_create_group(&writer->h5, fracas_mesh_parts[FRACAS_MESH_NODES].group));
    writer->meshes = true;
    for (int p = 0; p < FRACAS_NMESH_PARTS; p++) TRY(create_ragged(writer, &fracas_mesh_parts[p]));
    for (size_t p = 0; p < writer->npassed; p++) TRY(put_mesh(writer, &none));
    return FRACAS_OK;
}

fracas_err fracas_writer_mesh(fracas_writer *writer, const fracas_stored_mesh *mesh)
{
    const char *fault = fracas_stored_mesh_fault(mesh);
    if (!writer->interfaces) fault = "the file keeps no interfaces";
    if (writer->npassed >= writer->npoints) fault = "every point has had its mesh";
    if (fault)
        return fracas_fail(FRACAS_BUG, "%s: mesh of point %zu: %s", writer->path, writer->npassed,
                           fault);
    if (!writer->meshes && mesh->nelements > 0) TRY(begin_meshes(writer));
    writer->npassed++;
    return writer->meshes ? put_mesh(writer, mesh) : FRACAS_OK;
}

fracas_err fracas_writer_campaign(fracas_writer *writer, const fracas_campaign_copy *copy)
{
    return fracas_copy_write(&writer->h5, copy);
}

static fracas_err finish(fracas_writer *writer, bool complete, fracas_file_seal *seal)
{
    if (writer->meshes && writer->npassed != writer->npoints)
        return fracas_fail(FRACAS_BUG, "%s: %zu of %zu points have had their mesh", writer->path,
                           writer->npassed, writer->npoints);
    for (int s = 0; s < FRACAS_NSETS; s++)
        if (has_set(writer, s)) TRY(flush(writer, s));
    TRY(fracas_h5_put_integer(&writer->h5, "/", "complete", H5T_STD_I8LE, complete));
    TRY(fracas_h5_flush_close(&writer->h5));
    if (writer->own_seal) TRY(fracas_disk_append_seal(writer->h5.fd, writer->path));
    TRY(fracas_disk_seal(writer->h5.fd, writer->path, seal));
    if (fsync(writer->h5.fd) < 0) return fracas_disk_fail("sync", writer->path);
    if (rename(writer->temporary, writer->path) < 0)
        return fracas_disk_fail("rename to", writer->path);
    return fracas_disk_sync_folder(writer->path);
}

fracas_err fracas_writer_finish(fracas_writer *writer, bool complete, fracas_file_seal *seal)
{
    fracas_err err = finish(writer, complete, seal);
    if (err) fracas_writer_abandon(writer);
    else writer_free(writer);
    return err;
}

void fracas_writer_abandon(fracas_writer *writer)
{
    if (!writer) return;
    if (writer->temporary) unlink(writer->temporary); /* gone if only the last sync failed */
    writer_free(writer);
}
