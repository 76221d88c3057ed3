#include "campaigns/store/pool.h"

#include "campaigns/store/disk.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Open at once: as many workers write side by side, so many segments a run of the plan is spread over. A reader
 * takes about a megabyte. */
enum { MOST_OPEN = 64 };

typedef struct {
    fracas_reader *reader; /* NULL if closed */
    uint64_t used;         /* when it was asked for last */
    bool checked, bad;
} pool_entry;

struct fracas_pool {
    const char *study;
    const fracas_file_header *header;
    fracas_known_segment *segment; /* by id */
    pool_entry *entry;             /* of each segment */
    size_t count;
    size_t open[MOST_OPEN]; /* entries with a reader */
    size_t nopen;
    uint64_t clock;
};

fracas_err fracas_pool_create(const char *study, fracas_index *index, const fracas_file_header *header,
                              fracas_pool **pool)
{
    *pool = calloc(1, sizeof **pool);
    if (!*pool) return fracas_no_memory("the segments");
    (*pool)->study = study;
    (*pool)->header = header;
    fracas_err err = fracas_index_segments(index, &(*pool)->segment, &(*pool)->count);
    if (!err && !((*pool)->entry = calloc((*pool)->count + 1, sizeof *(*pool)->entry)))
        err = fracas_no_memory("the segments");
    if (!err) return FRACAS_OK;
    fracas_pool_destroy(*pool);
    *pool = NULL;
    return err;
}

void fracas_pool_destroy(fracas_pool *pool)
{
    if (!pool) return;
    for (size_t o = 0; o < pool->nopen; o++) fracas_reader_close(pool->entry[pool->open[o]].reader);
    fracas_index_segments_free(pool->segment, pool->count);
    free(pool->entry);
    free(pool);
}

static int compare_id(const void *id, const void *segment)
{
    int64_t a = *(const int64_t *)id, b = ((const fracas_known_segment *)segment)->id;
    return (a > b) - (a < b);
}

/* Place of the segment in the pool, SIZE_MAX if the index has none of that id. */
static size_t find(const fracas_pool *pool, int64_t id)
{
    const fracas_known_segment *found =
        pool->count ? bsearch(&id, pool->segment, pool->count, sizeof *found, compare_id) : NULL;
    return found ? (size_t)(found - pool->segment) : SIZE_MAX;
}

bool fracas_pool_is_bad(const fracas_pool *pool, int64_t segment)
{
    size_t s = find(pool, segment);
    return s != SIZE_MAX && pool->entry[s].bad;
}

/* Room for one more reader: the one that was not asked for longest goes. */
static void make_room(fracas_pool *pool)
{
    if (pool->nopen < MOST_OPEN) return;
    size_t oldest = 0;
    for (size_t o = 1; o < pool->nopen; o++)
        if (pool->entry[pool->open[o]].used < pool->entry[pool->open[oldest]].used) oldest = o;
    pool_entry *entry = &pool->entry[pool->open[oldest]];
    fracas_reader_close(entry->reader);
    entry->reader = NULL;
    pool->open[oldest] = pool->open[--pool->nopen];
}

static fracas_err check_seal(const fracas_known_segment *segment, const char *path)
{
    fracas_file_seal seal;
    TRY(fracas_disk_seal_path(path, &seal));
    if (seal.bytes == segment->seal.bytes && seal.checksum == segment->seal.checksum) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "%s: damaged: it has %" PRIu64 " bytes of checksum %016" PRIx64
                       ", the index says %" PRIu64 " of %016" PRIx64, path, seal.bytes, seal.checksum,
                       segment->seal.bytes, segment->seal.checksum);
}

static fracas_err check_header(const fracas_pool *pool, const fracas_reader *reader, const char *path)
{
    const fracas_file_header *wanted = pool->header, *found = fracas_reader_header(reader);
    if (!wanted) return FRACAS_OK;
    if (found->seed != wanted->seed)
        return fracas_fail(FRACAS_DAMAGED, "%s: its seed is %" PRIu64 ", the study's is %" PRIu64, path, found->seed,
                           wanted->seed);
    if (strcmp(found->version, wanted->version) != 0)
        return fracas_fail(FRACAS_DAMAGED, "%s: written by fracas %s, the study by %s", path, found->version,
                           wanted->version);
    return FRACAS_OK;
}

static fracas_err open_segment(fracas_pool *pool, size_t s)
{
    char *path;
    pool_entry *entry = &pool->entry[s];
    TRY(fracas_disk_segment(pool->study, pool->segment[s].name, &path));
    fracas_err err = entry->checked ? FRACAS_OK : check_seal(&pool->segment[s], path);
    make_room(pool);
    if (!err) err = fracas_reader_open(path, &entry->reader);
    if (!err) pool->open[pool->nopen++] = s;
    if (!err) err = check_header(pool, entry->reader, path);
    entry->checked = true;
    if (err == FRACAS_DAMAGED) {
        entry->bad = true;
        err = fracas_fail_within(err, "to compute its realizations again, remove %s and run again", path);
    }
    free(path);
    return err;
}

fracas_err fracas_pool_segment(fracas_pool *pool, int64_t segment, fracas_reader **reader)
{
    size_t s = find(pool, segment);
    if (s == SIZE_MAX) return fracas_fail(FRACAS_DAMAGED, "the index has no segment %" PRId64, segment);
    pool_entry *entry = &pool->entry[s];
    if (entry->bad) return fracas_fail(FRACAS_DAMAGED, "segment %s is damaged", pool->segment[s].name);
    if (!entry->reader) TRY(open_segment(pool, s));
    entry->used = ++pool->clock;
    *reader = entry->reader;
    return FRACAS_OK;
}

fracas_err fracas_pool_record(fracas_pool *pool, const fracas_place *place, const fracas_hash *point, int64_t replica,
                              fracas_record *record)
{
    fracas_reader *reader;
    TRY(fracas_pool_segment(pool, place->segment, &reader));
    const char *name = pool->segment[find(pool, place->segment)].name;
    if (place->row < 0 || (uint64_t)place->row >= fracas_reader_realizations(reader))
        return fracas_fail(FRACAS_DAMAGED, "segment %s has no row %" PRId64 ", which the index names", name, place->row);
    size_t found_point;
    int64_t found_replica;
    TRY(fracas_reader_record(reader, (size_t)place->row, FRACAS_READ_ALL, &found_point, &found_replica, record));
    if (fracas_hash_equal(&fracas_reader_points(reader)->point[found_point].hash, point) && found_replica == replica)
        return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED, "segment %s: row %" PRId64 " is another realization than the index says", name,
                       place->row);
}
