/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The seal at the end of a segment. */
#include "campaigns/store/file/disk.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char mark[16] = "fracas segment\r\n"; /* without an end */

/* As they are in the file: little-endian on every machine that fracas runs on. */
typedef struct {
    char mark[sizeof mark];
    uint64_t bytes, checksum;
} own_seal;
_Static_assert(sizeof(own_seal) == FRACAS_OWN_SEAL, "the seal has no gaps");

fracas_err fracas_disk_append_seal(int fd, const char *path)
{
    own_seal own;
    fracas_file_seal seal;
    TRY(fracas_disk_seal(fd, path, &seal));
    memcpy(own.mark, mark, sizeof mark);
    own.bytes = seal.bytes;
    own.checksum = seal.checksum;
    const char *from = (const char *)&own;
    for (size_t put = 0; put < sizeof own;) {
        const ssize_t more = pwrite(fd, from + put, sizeof own - put, (off_t)(seal.bytes + put));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0) return fracas_disk_fail("write", path);
        put += (size_t)more;
    }
    return FRACAS_OK;
}

/* Up to `size` bytes from `at` on; fewer only at the end of the file. */
static fracas_err read_at(int fd, const char *path, uint64_t at, size_t size, void *to, size_t *got)
{
    for (*got = 0; *got < size;) {
        const ssize_t more = pread(fd, (char *)to + *got, size - *got, (off_t)(at + *got));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0) return fracas_disk_fail("read", path);
        if (more == 0) break;
        *got += (size_t)more;
    }
    return FRACAS_OK;
}

static fracas_err damaged(const char *path, const char *why)
{
    return fracas_fail(FRACAS_DAMAGED, "%s: damaged: %s", path, why);
}

/* HDF5 notes in the superblock where the file ends. */
static fracas_err check_end(int fd, const char *path, uint64_t bytes)
{
    static const unsigned char signature[8] = {0x89, 'H', 'D', 'F', '\r', '\n', 0x1a, '\n'};
    enum { END = 28 }; /* offset of the end's address in superblocks of versions 2 and 3 */
    unsigned char start[END + 8];
    uint64_t end;
    size_t got;
    TRY(read_at(fd, path, 0, sizeof start, start, &got));
    if (got < sizeof start || memcmp(start, signature, sizeof signature) != 0)
        return damaged(path, "it does not begin as HDF5");
    memcpy(&end, start + END, sizeof end);
    return bytes == end ? FRACAS_OK
                        : damaged(path, "it has no seal at its end, or not the size that it had: "
                                        "cut short, or overwritten");
}

static fracas_err check_open(int fd, const char *path)
{
    own_seal own;
    fracas_file_seal found;
    struct stat info;
    size_t got;
    if (fstat(fd, &info) < 0) return fracas_disk_fail("look at", path);
    const uint64_t bytes = (uint64_t)info.st_size;
    if (bytes < sizeof own) return damaged(path, "it is too short");
    TRY(read_at(fd, path, bytes - sizeof own, sizeof own, &own, &got));
    if (got < sizeof own || memcmp(own.mark, mark, sizeof mark) != 0)
        return check_end(fd, path, bytes);
    TRY(fracas_disk_seal_first(fd, path, bytes - sizeof own, &found));
    if (own.bytes == found.bytes && own.checksum == found.checksum) return FRACAS_OK;
    return damaged(path, "the seal at its end is not of its bytes");
}

fracas_err fracas_disk_check_own_seal(const char *path)
{
    int fd;
    TRY(fracas_disk_open(path, &fd));
    fracas_err err = check_open(fd, path);
    close(fd);
    return err;
}
