/* STUDY/study.h5 from the segments, in plan order. */
#include "campaigns/store/disk.h"
#include "campaigns/store/pool.h"

#include <inttypes.h>
#include <stdlib.h>

/* One realization from its segment; an empty record if it failed. */
static fracas_err merge_one(fracas_index *index, fracas_pool *pool, const fracas_point_row *point, int64_t replica,
                            fracas_record *record, bool *failed)
{
    fracas_place place;
    char hex[FRACAS_HASH_HEX];
    fracas_record_clear(record);
    TRY(fracas_index_place(index, &point->hash, replica, &place));
    switch (place.status) {
    case FRACAS_DONE: return fracas_pool_record(pool, &place, &point->hash, replica, record);
    case FRACAS_FAILED_ROW:
    case FRACAS_QUARANTINED: *failed = true; return FRACAS_OK;
    case FRACAS_PLANNED:
    case FRACAS_LEASED: break;
    }
    fracas_hash_hex(&point->hash, hex);
    return fracas_fail(FRACAS_INTERRUPTED, "replica %" PRId64 " of point %s is not computed yet; run again to go on",
                       replica, hex);
}

static fracas_err merge_all(fracas_index *index, fracas_pool *pool, const fracas_point_table *table,
                            fracas_writer *writer, bool *complete)
{
    fracas_record record;
    fracas_err err = FRACAS_OK;
    fracas_record_init(&record);
    for (size_t p = 0; !err && p < table->npoints; p++)
        for (int64_t replica = 0; !err && replica < table->point[p].replicas; replica++) {
            bool failed = false;
            err = merge_one(index, pool, &table->point[p], replica, &record, &failed);
            if (!err) err = fracas_writer_append(writer, p, replica, &record);
            if (failed) *complete = false;
        }
    fracas_record_clear(&record);
    return err;
}

fracas_err fracas_study_merge(const char *study, fracas_index *index, const fracas_file_header *header,
                              const fracas_point_table *table, bool interfaces)
{
    char *path;
    bool complete = true;
    fracas_pool *pool = NULL;
    fracas_writer *writer = NULL;
    fracas_file_seal seal;
    TRY(fracas_disk_join(study, "study.h5", &path));
    fracas_err err = fracas_pool_create(study, index, header, &pool);
    if (!err) err = fracas_writer_create(path, header, table, interfaces, &writer);
    if (!err) err = merge_all(index, pool, table, writer, &complete);
    if (err) fracas_writer_abandon(writer);
    else err = fracas_writer_finish(writer, complete, &seal);
    fracas_pool_destroy(pool);
    free(path);
    return err;
}
