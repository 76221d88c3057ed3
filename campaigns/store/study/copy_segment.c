/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Copies of segments. */
#include "base/file.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/study/segments.h"

#include <inttypes.h>
#include <stdlib.h>
#include <unistd.h>

static fracas_err copy_bytes(int from, int to, const char *path)
{
    enum { BLOCK = 1 << 20 };
    OWNED char *block = malloc(BLOCK);
    if (!block) return fracas_no_memory("a copy");
    size_t got = BLOCK;
    for (uint64_t at = 0; got == BLOCK; at += got) {
        if (!fracas_disk_read(from, at, block, BLOCK, &got))
            return fracas_disk_fail("read for", path);
        if (!fracas_disk_write(to, at, block, got)) return fracas_disk_fail("write", path);
    }
    return FRACAS_OK;
}

/* A copy of the right checksum, synced. */
static fracas_err copy_to(int from, const fracas_file_seal *seal, const char *temporary,
                          const char *path)
{
    fracas_file_seal copied;
    OWN_FD to = fracas_file_create(temporary);
    if (to < 0) return fracas_disk_fail("create", temporary);
    TRY(copy_bytes(from, to, path));
    TRY(fracas_disk_seal(to, path, &copied));
    if (copied.bytes != seal->bytes || copied.checksum != seal->checksum)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "the copy of a segment to %s came out as %" PRIu64
                           " bytes of checksum %016" PRIx64 ", not %" PRIu64 " of %016" PRIx64
                           "; look after the disk, then run again",
                           path, copied.bytes, copied.checksum, seal->bytes, seal->checksum);
    return fsync(to) < 0 ? fracas_disk_fail("sync", path) : FRACAS_OK;
}

fracas_err fracas_segment_copy(int from, const fracas_file_seal *seal, const char *path)
{
    OWNED char *temporary = NULL;
    TRY(fracas_disk_temporary(path, &temporary));
    fracas_err err = copy_to(from, seal, temporary, path);
    if (!err && rename(temporary, path) < 0) err = fracas_disk_fail("rename to", path);
    if (err) unlink(temporary);
    TRY(err);
    return fracas_disk_sync_folder(path);
}
