/* The segments of a study, opened when they are needed: merge and verify read records from any of them in any order
 * with bounded memory. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_POOL_H
#define FRACAS_CAMPAIGNS_STORE_POOL_H

#include "campaigns/store/index.h"
#include "campaigns/store/reader.h"

typedef struct fracas_pool fracas_pool;

/* With `header` (NULL: without), a segment of another seed or program version is FRACAS_DAMAGED. `header` and
 * `index` must outlive the pool. */
FRACAS_MUST_USE fracas_err fracas_pool_create(const char *study, fracas_index *index,
                                              const fracas_file_header *header, fracas_pool **pool);
void fracas_pool_destroy(fracas_pool *pool); /* NULL is allowed */

/* A segment by its id, its bytes compared with the index's seal when it is opened first. FRACAS_DAMAGED names it and
 * says what to do; *reader belongs to the pool and lives until the next call. */
FRACAS_MUST_USE fracas_err fracas_pool_segment(fracas_pool *pool, int64_t segment, fracas_reader **reader);
/* True after fracas_pool_segment has found it damaged. */
bool fracas_pool_is_bad(const fracas_pool *pool, int64_t segment);

/* The record in a place, which must be that of this realization; all parts. */
FRACAS_MUST_USE fracas_err fracas_pool_record(fracas_pool *pool, const fracas_place *place, const fracas_hash *point,
                                              int64_t replica, fracas_record *record);

#endif
