/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/version.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/decision.h"
#include "campaigns/store/file/copy.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/table.h"

#include <stdlib.h>
#include <string.h>

/* The datasets of one set, and a block of their rows. */
typedef struct {
    hid_t dataset[FRACAS_MAX_COLUMNS];
    unsigned char *stored[FRACAS_MAX_COLUMNS];
    uint64_t rows;         /* in the file */
    uint64_t first, count; /* rows in `stored` */
} set_reader;

struct fracas_reader {
    fracas_h5 h5;
    char *path;
    fracas_file_header header;
    fracas_stored_table points;
    bool decisions, meshes; /* has a group /decision, /mesh */
    unsigned parts;         /* parts of records it was opened for */
    set_reader set[FRACAS_NSETS];
};

enum { BLOCK_CHUNKS = 4 }; /* chunks read ahead */

static fracas_err damaged(const fracas_reader *reader, const char *where, const char *what)
{
    return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged: %s", reader->path, where, what);
}

/* ---- opening ---- */

static fracas_err read_text_attribute(fracas_reader *reader, const char *name, size_t size,
                                      char *to)
{
    OWNED char *text = NULL;
    TRY(fracas_h5_get_text(&reader->h5, "/", name, &text));
    if (strlen(text) >= size) return damaged(reader, name, "it is too long");
    memcpy(to, text, strlen(text) + 1);
    return FRACAS_OK;
}

static fracas_err read_truth(fracas_reader *reader, const char *name, bool *truth)
{
    uint64_t value;
    TRY(fracas_h5_get_integer(&reader->h5, "/", name, H5T_STD_I8LE, &value));
    *truth = value == 1;
    return value <= 1 ? FRACAS_OK : damaged(reader, name, "it is neither 0 nor 1");
}

fracas_err fracas_file_version(const char *path, uint64_t *version)
{
    fracas_h5 h5 = FRACAS_H5_CLOSED;
    TRY(fracas_disk_check_own_seal(path));
    fracas_err err = fracas_h5_open(&h5, path);
    if (!err) err = fracas_h5_get_integer(&h5, "/", "format_version", H5T_STD_I32LE, version);
    fracas_h5_close(&h5);
    return err;
}

/* Format versions from `oldest` on. */
static fracas_err read_version(fracas_reader *reader, uint64_t oldest)
{
    uint64_t version;
    char from[24] = "";
    TRY(fracas_h5_get_integer(&reader->h5, "/", "format_version", H5T_STD_I32LE, &version));
    if (oldest < FRACAS_FORMAT_VERSION) snprintf(from, sizeof from, "%d to ", (int)oldest);
    if (version < oldest || version > FRACAS_FORMAT_VERSION)
        return fracas_fail(FRACAS_DAMAGED,
                           "%s has format version %llu; this program reads %s%d: use the program "
                           "version that wrote it, or compute the study again in another folder",
                           reader->path, (unsigned long long)version, from, FRACAS_FORMAT_VERSION);
    reader->header.format = (int64_t)version;
    return FRACAS_OK;
}

/* A file without probes or reactions has no attribute of them. */
static fracas_err read_probes(fracas_reader *reader)
{
    bool has;
    TRY(fracas_h5_has_attribute(&reader->h5, "/", "reactions", &has));
    if (has) TRY(read_truth(reader, "reactions", &reader->header.reactions));
    TRY(fracas_h5_has_attribute(&reader->h5, "/", "probes", &has));
    if (!has) return FRACAS_OK;
    OWNED char *text = NULL;
    TRY(fracas_h5_get_text(&reader->h5, "/", "probes", &text));
    if (fracas_probes_parse(text, &reader->header.probes) && reader->header.probes.count > 0)
        return FRACAS_OK;
    return damaged(reader, "probes", "they are no names with places");
}

static fracas_err read_header(fracas_reader *reader)
{
    uint64_t history;
    char hex[FRACAS_HASH_HEX];
    fracas_file_header *header = &reader->header;
    TRY(read_text_attribute(reader, "campaign", sizeof hex, hex));
    if (!fracas_hash_parse(hex, &header->campaign))
        return damaged(reader, "campaign", "it is no hash");
    TRY(fracas_h5_get_integer(&reader->h5, "/", "seed", H5T_STD_U64LE, &header->seed));
    TRY(fracas_h5_get_integer(&reader->h5, "/", "history", H5T_STD_I64LE, &history));
    if (history > FRACAS_MOST_HISTORY) return damaged(reader, "history", "it is out of range");
    header->history = (int64_t)history;
    TRY(read_truth(reader, "interfaces", &header->interfaces));
    TRY(read_probes(reader));
    TRY(read_text_attribute(reader, "program_version", sizeof header->version, header->version));
    return read_truth(reader, "complete", &header->complete);
}

/* True of a column that files of its format version have not. */
static bool lacks(const fracas_reader *reader, const fracas_store_column *column)
{
    return column->since > reader->header.format;
}

static fracas_err open_set(fracas_reader *reader, int s)
{
    const fracas_store_set *schema = &fracas_store_sets[s];
    set_reader *set = &reader->set[s];
    for (size_t c = 0; c < schema->ncolumns; c++) {
        uint64_t rows;
        if (lacks(reader, &schema->column[c])) continue;
        TRY(fracas_h5_open_column(&reader->h5, &schema->column[c], schema->chunk, &set->dataset[c],
                                  &rows));
        if (c > 0 && rows != set->rows)
            return damaged(reader, schema->column[c].path,
                           "it has another number of rows than its neighbours");
        set->rows = rows;
    }
    return FRACAS_OK;
}

static fracas_err load_rows(fracas_reader *reader, int s, uint64_t first, size_t count, void *rows);

/* Offsets of `owners` things go from 0 to the rows of the set; that they never fall is checked
 * where they are used. */
static fracas_err open_ragged(fracas_reader *reader, uint64_t owners, const fracas_ragged *ragged)
{
    const int offsets = ragged->offsets, s = offsets + 1;
    const char *path = fracas_store_sets[offsets].column->path;
    TRY(open_set(reader, offsets));
    TRY(open_set(reader, s));
    if (reader->set[offsets].rows != owners + 1)
        return damaged(reader, path,
                       "it must have one value more than there are realizations, or points");
    int64_t first, last;
    TRY(load_rows(reader, offsets, owners, 1, &last));
    TRY(load_rows(reader, offsets, 0, 1, &first));
    if (first != 0 || last < 0 || (uint64_t)last != reader->set[s].rows)
        return damaged(reader, path, "it does not go from 0 to the number of rows");
    return FRACAS_OK;
}

static fracas_err is_there(const fracas_reader *reader, const char *group, bool *there)
{
    htri_t found = H5Lexists(reader->h5.id, group, H5P_DEFAULT);
    if (found < 0) return fracas_h5_fail(&reader->h5, group);
    *there = found > 0;
    return FRACAS_OK;
}

static fracas_err open_meshes(fracas_reader *reader)
{
    TRY(is_there(reader, "/mesh", &reader->meshes));
    if (reader->meshes && !reader->header.interfaces)
        return damaged(reader, "/mesh", "there are meshes, but no interfaces");
    for (int p = 0; reader->meshes && p < FRACAS_NMESH_PARTS; p++)
        TRY(open_ragged(reader, reader->points.table.npoints, &fracas_mesh_parts[p]));
    return FRACAS_OK;
}

/* A part of records that the header promises, or not. */
static fracas_err check_part(fracas_reader *reader, bool promised, const char *attribute,
                             const char *group, unsigned part)
{
    bool there = false;
    char fault[80];
    TRY(is_there(reader, group, &there));
    snprintf(fault, sizeof fault, "the group %s is there when it must not be, or missing", group);
    if (promised != there) return damaged(reader, attribute, fault);
    if (!there) reader->parts &= ~part;
    return FRACAS_OK;
}

static fracas_err open_records(fracas_reader *reader, unsigned parts)
{
    const fracas_file_header *header = &reader->header;
    reader->parts = parts;
    TRY(open_set(reader, FRACAS_SET_REALIZATION));
    TRY(check_part(reader, header->interfaces, "interfaces", "/interface", FRACAS_READ_INTERFACES));
    TRY(check_part(reader, header->probes.count > 0, "probes", "/probe", FRACAS_READ_PROBES));
    TRY(check_part(reader, header->reactions, "reactions", "/reaction", FRACAS_READ_REACTIONS));
    for (int p = 0; p < FRACAS_NPARTS; p++)
        if (reader->parts & 1u << p)
            TRY(open_ragged(reader, reader->set[FRACAS_SET_REALIZATION].rows,
                            &fracas_record_parts[p]));
    return FRACAS_OK;
}

static fracas_err open_rest(fracas_reader *reader)
{
    TRY(is_there(reader, "/decision", &reader->decisions));
    if (reader->decisions) TRY(open_set(reader, FRACAS_SET_DECISION));
    return open_meshes(reader);
}

static fracas_err open_file(const char *path, unsigned parts, bool all, int oldest,
                            fracas_reader **reader)
{
    OWN(fracas_reader) new = calloc(1, sizeof *new);
    *reader = NULL;
    if (!new) return fracas_no_memory("a file");
    new->h5 = FRACAS_H5_CLOSED;
    new->path = strdup(path);
    if (!new->path) return fracas_no_memory("a file");
    TRY(fracas_h5_open(&new->h5, new->path));
    TRY(read_version(new, (uint64_t)oldest));
    TRY(read_header(new));
    TRY(all ? fracas_table_read(&new->h5, &new->points)
            : fracas_table_read_points(&new->h5, &new->points));
    TRY(open_records(new, parts));
    if (all) TRY(open_rest(new));
    *reader = new;
    new = NULL;
    return FRACAS_OK;
}

fracas_err fracas_reader_open(const char *path, fracas_reader **reader)
{
    return open_file(path, FRACAS_READ_ALL, true, FRACAS_FORMAT_VERSION, reader);
}

fracas_err fracas_reader_open_old(const char *path, fracas_reader **reader)
{
    return open_file(path, FRACAS_READ_ALL, true, FRACAS_FORMAT_OLDEST, reader);
}

fracas_err fracas_reader_open_records(const char *path, unsigned parts, fracas_reader **reader)
{
    return open_file(path, parts, false, FRACAS_FORMAT_VERSION, reader);
}

void fracas_reader_close(fracas_reader *reader)
{
    if (!reader) return;
    for (int s = 0; s < FRACAS_NSETS; s++)
        for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++) free(reader->set[s].stored[c]);
    fracas_table_clear(&reader->points);
    fracas_h5_close(&reader->h5);
    free(reader->path);
    free(reader);
}

const fracas_file_header *fracas_reader_header(const fracas_reader *reader)
{
    return &reader->header;
}
const fracas_point_table *fracas_reader_points(const fracas_reader *reader)
{
    return &reader->points.table;
}
size_t fracas_reader_realizations(const fracas_reader *reader)
{
    return reader->set[FRACAS_SET_REALIZATION].rows;
}

fracas_err fracas_reader_provenance(const fracas_reader *reader, char **provenance)
{
    bool has;
    *provenance = NULL;
    TRY(fracas_h5_has_attribute(&reader->h5, "/", FRACAS_PROVENANCE, &has));
    return has ? fracas_h5_get_text(&reader->h5, "/", FRACAS_PROVENANCE, provenance) : FRACAS_OK;
}

/* ---- rows ---- */

static fracas_err read_block(fracas_reader *reader, int s, uint64_t row)
{
    const fracas_store_set *schema = &fracas_store_sets[s];
    set_reader *set = &reader->set[s];
    uint64_t block = BLOCK_CHUNKS * schema->chunk, first = row - row % block;
    uint64_t count = set->rows - first < block ? set->rows - first : block;
    set->count = 0;
    for (size_t c = 0; c < schema->ncolumns; c++) {
        const fracas_store_column *column = &schema->column[c];
        if (lacks(reader, column)) continue;
        if (!set->stored[c]) set->stored[c] = malloc(block * fracas_stored_size(column));
        if (!set->stored[c]) return fracas_no_memory("the columns of a file");
        TRY(fracas_h5_read_rows(&reader->h5, column, set->dataset[c], first, count,
                                set->stored[c]));
    }
    set->first = first;
    set->count = count;
    return FRACAS_OK;
}

/* Rows first .. first+count-1, which must be in the set, into structs. */
static fracas_err load_rows(fracas_reader *reader, int s, uint64_t first, size_t count, void *rows)
{
    const fracas_store_set *schema = &fracas_store_sets[s];
    set_reader *set = &reader->set[s];
    char *to = rows;
    while (count > 0) {
        if (first < set->first || first >= set->first + set->count)
            TRY(read_block(reader, s, first));
        uint64_t at = first - set->first, there = set->count - at;
        size_t take = count < there ? count : there;
        for (size_t c = 0; c < schema->ncolumns; c++) {
            const fracas_store_column *column = &schema->column[c];
            if (lacks(reader, column)) fracas_rows_lack(column, take, to, schema->row_size);
            else
                fracas_rows_load(column, set->stored[c] + at * fracas_stored_size(column), take, to,
                                 schema->row_size);
        }
        first += take;
        count -= take;
        to += take * schema->row_size;
    }
    return FRACAS_OK;
}

/* Where the rows of realization or point `row` are in a ragged set. */
static fracas_err find_ragged(fracas_reader *reader, const fracas_ragged *ragged, size_t row,
                              int64_t *begin, size_t *count)
{
    int64_t end;
    TRY(load_rows(reader, ragged->offsets, row, 1, begin));
    TRY(load_rows(reader, ragged->offsets, row + 1, 1, &end));
    if (*begin < 0 || end < *begin || (uint64_t)end > reader->set[ragged->offsets + 1].rows)
        return damaged(reader, fracas_store_sets[ragged->offsets].column->path,
                       "an offset is out of order");
    *count = (size_t)(end - *begin);
    return FRACAS_OK;
}

/* Gives those rows to `owner`. */
static fracas_err load_ragged(fracas_reader *reader, const fracas_ragged *ragged, size_t row,
                              void *owner)
{
    const int s = ragged->offsets + 1;
    int64_t begin;
    size_t count;
    TRY(find_ragged(reader, ragged, row, &begin, &count));
    OWNED void *rows = count ? calloc(count, fracas_store_sets[s].row_size) : NULL;
    if (count && !rows) return fracas_no_memory("a record");
    TRY(load_rows(reader, s, (uint64_t)begin, count, rows));
    fracas_ragged_set(ragged, owner, rows, count);
    rows = NULL;
    return FRACAS_OK;
}

static fracas_err load_parts(fracas_reader *reader, size_t row, unsigned parts,
                             fracas_record *record)
{
    parts &= reader->parts;
    for (int p = 0; p < FRACAS_NPARTS; p++)
        if (parts & 1u << p) TRY(load_ragged(reader, &fracas_record_parts[p], row, record));
    if (parts & FRACAS_READ_FRAGMENTS && record->outcome != FRACAS_FAILED &&
        (uint64_t)record->fragments != record->nfragment)
        return damaged(reader, "/realization/fragments",
                       "it is not the number of rows in /fragment");
    for (size_t i = 0; i < record->nprobe; i++)
        if (record->probe[i].probe < 0 ||
            (uint64_t)record->probe[i].probe >= reader->header.probes.count)
            return damaged(reader, "/probe/probe", "there is no probe of that number");
    return FRACAS_OK;
}

fracas_err fracas_reader_record(fracas_reader *reader, size_t row, unsigned parts, size_t *point,
                                int64_t *replica, fracas_record *record)
{
    fracas_stored_realization stored = {0};
    fracas_record_clear(record);
    if (row >= fracas_reader_realizations(reader))
        return fracas_fail(FRACAS_BUG, "%s has %zu realizations; row %zu was asked for",
                           reader->path, fracas_reader_realizations(reader), row);
    TRY(load_rows(reader, FRACAS_SET_REALIZATION, row, 1, &stored));
    if (stored.point < 0 || (uint64_t)stored.point >= reader->points.table.npoints ||
        stored.replica < 0)
        return damaged(reader, "/realization/point", "a realization is of no point of the file");
    if (stored.record.outcome < 0 || stored.record.outcome >= FRACAS_NOUTCOMES ||
        stored.record.fragments < 0 || stored.record.fragments_dust < 0 ||
        stored.record.fragments_dust > stored.record.fragments)
        return damaged(reader, "/realization/outcome", "an outcome or a count is out of range");
    *point = (size_t)stored.point;
    *replica = stored.replica;
    *record = stored.record;
    fracas_err err = load_parts(reader, row, parts, record);
    if (err) fracas_record_clear(record);
    return err;
}

fracas_err fracas_reader_each(fracas_reader *reader, unsigned parts, fracas_result_visit *visit,
                              void *context)
{
    fracas_result result = {0};
    fracas_err err = FRACAS_OK;
    for (; !err && result.row < fracas_reader_realizations(reader); result.row++) {
        err = fracas_reader_record(reader, result.row, parts, &result.point, &result.replica,
                                   &result.record);
        if (!err) err = visit(context, &result);
    }
    fracas_record_clear(&result.record);
    return err;
}

/* ---- decisions ---- */

fracas_err fracas_reader_decisions(fracas_reader *reader, fracas_decision **decision, size_t *count)
{
    OWNED fracas_decision *found = NULL;
    *decision = NULL;
    *count = reader->decisions ? reader->set[FRACAS_SET_DECISION].rows : 0;
    found = calloc(*count + 1, sizeof *found);
    if (!found) return fracas_no_memory("the decisions of a study");
    TRY(load_rows(reader, FRACAS_SET_DECISION, 0, *count, found));
    for (size_t d = 0; d < *count; d++)
        if (!fracas_decision_valid(&found[d]) || found[d].point < 0 ||
            (uint64_t)found[d].point >= reader->points.table.npoints)
            return damaged(reader, "/decision",
                           "a decision is of no point of the file, or out of range");
    *decision = found;
    found = NULL;
    return FRACAS_OK;
}

/* ---- the campaign ---- */

fracas_err fracas_reader_campaign(fracas_reader *reader, fracas_campaign_copy *copy)
{
    bool there = false;
    *copy = (fracas_campaign_copy){0};
    TRY(is_there(reader, FRACAS_COPY_GROUP, &there));
    return there ? fracas_copy_read(&reader->h5, copy) : FRACAS_OK;
}

/* ---- meshes ---- */

fracas_err fracas_reader_mesh_interfaces(fracas_reader *reader, size_t point, size_t *interfaces)
{
    int64_t begin;
    *interfaces = 0;
    if (!reader->meshes) return FRACAS_OK;
    return find_ragged(reader, &fracas_mesh_parts[FRACAS_MESH_INTERFACES], point, &begin,
                       interfaces);
}

static fracas_err load_mesh(fracas_reader *reader, size_t point, fracas_stored_mesh *mesh)
{
    for (int p = 0; p < FRACAS_NMESH_PARTS; p++)
        TRY(load_ragged(reader, &fracas_mesh_parts[p], point, mesh));
    const char *fault = fracas_stored_mesh_fault(mesh);
    return fault ? damaged(reader, "/mesh", fault) : FRACAS_OK;
}

fracas_err fracas_reader_mesh(fracas_reader *reader, size_t point, fracas_stored_mesh *mesh)
{
    *mesh = (fracas_stored_mesh){0};
    if (point >= reader->points.table.npoints)
        return fracas_fail(FRACAS_BUG, "%s has %zu points; the mesh of point %zu was asked for",
                           reader->path, reader->points.table.npoints, point);
    if (!reader->meshes) return FRACAS_OK;
    fracas_err err = load_mesh(reader, point, mesh);
    if (err) fracas_stored_mesh_clear(mesh);
    return err;
}

fracas_err fracas_reader_check_meshes(fracas_reader *reader, const fracas_mesh_source *meshes)
{
    for (size_t p = 0; reader->header.interfaces && p < reader->points.table.npoints; p++) {
        FRACAS_CLEARED(fracas_stored_mesh) wanted = {0};
        FRACAS_CLEARED(fracas_stored_mesh) found = {0};
        TRY(meshes->get(meshes->context, p, &wanted));
        TRY(fracas_reader_mesh(reader, p, &found));
        if (!fracas_stored_mesh_same(&wanted, &found))
            return fracas_fail(FRACAS_DAMAGED,
                               "%s: the mesh of point %zu is not that of the campaign; remove the "
                               "file and run again",
                               reader->path, p);
    }
    return FRACAS_OK;
}

/* ---- the schema ---- */

static fracas_err check_attribute(const fracas_reader *reader, const fracas_store_column *column,
                                  const char *name, const char *wanted)
{
    OWNED char *found = NULL;
    TRY(fracas_h5_get_text(&reader->h5, column->path, name, &found));
    if (!strcmp(found, wanted)) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s: %s: its %s is `%.40s`, not `%.40s`", reader->path,
                       column->path, name, found, wanted);
}

static fracas_err check_attributes(const fracas_reader *reader, const fracas_store_column *column)
{
    TRY(check_attribute(reader, column, "unit", column->unit));
    if (strcmp(reader->header.version, FRACAS_VERSION) != 0) return FRACAS_OK;
    return check_attribute(reader, column, "description", column->description);
}

fracas_err fracas_reader_check_schema(fracas_reader *reader)
{
    TRY(check_attributes(reader, &fracas_store_point_hash));
    TRY(check_attributes(reader, &fracas_store_point_replicas));
    for (int s = 0; s < FRACAS_NSETS; s++)
        for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++)
            if (reader->set[s].dataset[c] > 0) /* it is in this file */
                TRY(check_attributes(reader, &fracas_store_sets[s].column[c]));
    return FRACAS_OK;
}
