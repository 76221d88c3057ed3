/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/fit/part.h"

#include "analysis/summary/study.h"
#include "base/file.h"
#include "base/own.h"
#include "base/version.h"
#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static const char BEGIN[] = ",,fits,begin,,,,,,", END[] = ",,fits,end,,,,,,";
enum { SUM = 16 };

void fracas_fits_part_clear(fracas_fits_part *part)
{
    if (part->fd >= 0) close(part->fd);
    free(part->path);
    free(part->saved.row);
    free(part->block);
    *part = (fracas_fits_part){.fd = -1};
}

/* ---- reading ---- */

/* The line at *text, without its line feed, copied; false if it does not end. */
static bool next_line(const char **text, char *line, size_t size)
{
    const char *end = strchr(*text, '\n');
    if (!end || (size_t)(end - *text) + 2 > size) return false;
    snprintf(line, size, "%.*s\n", (int)(end - *text), *text);
    *text = end + 1;
    return true;
}

/* Takes the block at *text; false, and no rows, for one that is not whole. */
static fracas_err take_block(fracas_fits_part *part, const char **text, bool *whole)
{
    char line[1024], sum[SUM + 2];
    const char *at = *text;
    struct fracas_fits_block block = {.begin = part->saved.n};
    *whole = false;
    if (!next_line(&at, line, sizeof line) || strncmp(line, BEGIN, sizeof BEGIN - 1) != 0 ||
        strlen(line) != sizeof BEGIN - 1 + FRACAS_HASH_HEX)
        return FRACAS_OK;
    memcpy(block.key, line + sizeof BEGIN - 1, FRACAS_HASH_HEX - 1);
    for (;;) {
        const size_t length = (size_t)(at - *text);
        fracas_fits_row row;
        if (!next_line(&at, line, sizeof line)) break;
        if (strncmp(line, END, sizeof END - 1)) {
            if (!fracas_fits_take_row(line, &row)) break;
            TRY(fracas_fits_append(&part->saved, &row));
            continue;
        }
        snprintf(sum, sizeof sum, "%016" PRIx64 "\n", fracas_checksum_of(*text, length));
        if (strcmp(line + sizeof END - 1, sum) != 0) break;
        block.end = part->saved.n;
        TRY(fracas_grow(&part->block, sizeof *part->block, part->nblocks, &part->room,
                        "the saved fits"));
        part->block[part->nblocks++] = block;
        *text = at;
        *whole = true;
        return FRACAS_OK;
    }
    part->saved.n = block.begin;
    return FRACAS_OK;
}

/* Reads all whole blocks, and cuts the file behind the last. */
static fracas_err read_blocks(fracas_fits_part *part)
{
    struct stat info;
    size_t size;
    if (fstat(part->fd, &info)) return fracas_fail_system(errno, "cannot read %s", part->path);
    OWNED char *all = calloc((size_t)info.st_size + 1, 1);
    if (!all) return fracas_no_memory("the saved fits");
    if (!fracas_disk_read(part->fd, 0, all, (size_t)info.st_size, &size))
        return fracas_fail_system(errno, "cannot read %s", part->path);
    const char *rest = all;
    for (bool whole = true; whole;) TRY(take_block(part, &rest, &whole));
    if (((off_t)(rest - all) < info.st_size && ftruncate(part->fd, rest - all)) ||
        lseek(part->fd, 0, SEEK_END) < 0)
        return fracas_fail_system(errno, "cannot write %s", part->path);
    return FRACAS_OK;
}

fracas_err fracas_fits_part_open(const char *study, fracas_fits_part *part)
{
    *part = (fracas_fits_part){.fd = -1};
    TRY(fracas_disk_join(study, FRACAS_FITS_PART, &part->path));
    part->fd = fracas_file_open_own(part->path);
    if (part->fd < 0) return fracas_fail_system(errno, "cannot write %s", part->path);
    if (flock(part->fd, LOCK_EX | LOCK_NB)) {
        if (errno == EWOULDBLOCK)
            return fracas_fail(FRACAS_ENVIRONMENT,
                               "another `fracas fit` of %s is at work; wait for it, or stop it",
                               study);
        return fracas_fail_system(errno, "cannot lock %s", part->path);
    }
    return read_blocks(part);
}

/* ---- keys ---- */

fracas_hash fracas_fits_part_key(const fracas_analysis *analysis, size_t point, int64_t resamples)
{
    char text[256];
    const fracas_hash fingerprint = fracas_fits_fingerprint(analysis, point);
    const int length = snprintf(text, sizeof text, "%s %s %s %" PRId64, FRACAS_VERSION,
                                fracas_hash_hex(&analysis->table->point[point].hash).text,
                                fracas_hash_hex(&fingerprint).text, resamples);
    return fracas_hash_of(text, (size_t)length);
}

fracas_err fracas_fits_part_take(const fracas_fits_part *part, const fracas_hash *key, size_t point,
                                 fracas_fits *fits, bool *taken)
{
    *taken = false;
    for (size_t b = 0; b < part->nblocks && !*taken; b++) {
        const struct fracas_fits_block *block = &part->block[b];
        if (strcmp(block->key, fracas_hash_hex(key).text) != 0) continue;
        for (size_t i = block->begin; i < block->end; i++) {
            fracas_fits_row row = part->saved.row[i];
            row.point = (int64_t)point;
            TRY(fracas_fits_append(fits, &row));
        }
        *taken = true;
    }
    return FRACAS_OK;
}

fracas_err fracas_fits_part_save(const fracas_fits_part *part, const fracas_hash *key,
                                 const char *rows, size_t size)
{
    OWNED char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    if (!out) return fracas_no_memory("the saved fits");
    fprintf(out, "%s%s\n", BEGIN, fracas_hash_hex(key).text);
    fwrite(rows, 1, size, out);
    fflush(out);
    const uint64_t sum = fracas_checksum_of(text, length);
    fprintf(out, "%s%016" PRIx64 "\n", END, sum);
    if (fclose(out)) return fracas_no_memory("the saved fits");
    size_t done = 0;
    while (done < length) {
        const ssize_t put = write(part->fd, text + done, length - done);
        if (put < 0 && errno != EINTR)
            return fracas_fail_system(errno, "cannot write %s", part->path);
        if (put > 0) done += (size_t)put;
    }
    if (fsync(part->fd)) return fracas_fail_system(errno, "cannot write %s", part->path);
    return FRACAS_OK;
}

void fracas_fits_forget_part(const char *study)
{
    OWNED char *path = NULL;
    if (!fracas_disk_join(study, FRACAS_FITS_PART, &path)) unlink(path);
}
