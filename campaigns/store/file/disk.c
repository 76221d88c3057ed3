/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/disk.h"

#include "base/file.h"
#include "base/param.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <linux/magic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

static const char temporary_mark[] = ".tmp-";

fracas_err fracas_disk_fail(const char *verb, const char *path)
{
    return fracas_fail_system(errno, "cannot %s %s", verb, path);
}

fracas_err fracas_disk_join(const char *folder, const char *name, char **path)
{
    return fracas_path(path, "%s/%s", folder, name);
}

fracas_err fracas_disk_segment(const char *study, const char *name, char **path)
{
    return fracas_path(path, "%s/segments/%s", study, name);
}

fracas_err fracas_disk_temporary(const char *path, char **temporary)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    return fracas_path(temporary, "%.*s.%s%s%ld", (int)(name - path), path, name, temporary_mark,
                       (long)getpid());
}

bool fracas_disk_is_temporary(const char *name)
{
    const char *mark = strstr(name, temporary_mark);
    return name[0] == '.' && mark && isdigit((unsigned char)mark[sizeof temporary_mark - 1]);
}

bool fracas_disk_ends(const char *name, const char *end)
{
    const size_t length = strlen(name), tail = strlen(end);
    return name[0] != '.' && length >= tail && strcmp(name + length - tail, end) == 0;
}

fracas_err fracas_disk_each(const char *folder,
                            fracas_err (*visit)(void *context, const char *path, const char *name),
                            void *context)
{
    struct dirent **entry;
    const int count = scandir(folder, &entry, NULL, alphasort);
    if (count < 0) return errno == ENOENT ? FRACAS_OK : fracas_disk_fail("list", folder);
    fracas_err err = FRACAS_OK;
    for (int e = 0; e < count; e++) {
        const char *name = entry[e]->d_name;
        char *path;
        if (!err && strcmp(name, ".") != 0 && strcmp(name, "..") != 0 &&
            !(err = fracas_disk_join(folder, name, &path))) {
            err = visit(context, path, name);
            free(path);
        }
        free(entry[e]);
    }
    free(entry);
    return err;
}

fracas_err fracas_disk_sync_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    OWNED char *folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path))
                               : strdup(".");
    if (!folder) return fracas_no_memory("a file name");
    OWN_FD fd = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    /* EINVAL: a filesystem that has no syncing of folders, and so nothing to wait for. */
    return fd < 0 || (fsync(fd) < 0 && errno != EINVAL) ? fracas_disk_fail("sync folder", folder)
                                                        : FRACAS_OK;
}

fracas_err fracas_disk_open(const char *path, int *fd)
{
    *fd = fracas_file_open(path);
    if (*fd >= 0) return FRACAS_OK;
    return errno == ENOENT ? fracas_fail(FRACAS_DAMAGED, "%s is not there", path)
                           : fracas_disk_fail("open", path);
}

bool fracas_disk_read(int fd, uint64_t at, void *to, size_t size, size_t *got)
{
    for (*got = 0; *got < size;) {
        const ssize_t more = pread(fd, (char *)to + *got, size - *got, (off_t)(at + *got));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0) return false;
        if (more == 0) break;
        *got += (size_t)more;
    }
    return true;
}

bool fracas_disk_write(int fd, uint64_t at, const void *from, size_t size)
{
    for (size_t put = 0; put < size;) {
        const ssize_t more = pwrite(fd, (const char *)from + put, size - put, (off_t)(at + put));
        if (more < 0 && errno == EINTR) continue;
        if (more < 0) return false;
        put += (size_t)more;
    }
    return true;
}

/* The seal of its first `most` bytes. */
static fracas_err seal_first(int fd, const char *path, uint64_t most, fracas_file_seal *seal)
{
    enum { BLOCK = 1 << 20 };
    OWNED char *block = malloc(BLOCK);
    OWN(fracas_checksum) checksum = NULL;
    *seal = (fracas_file_seal){0};
    if (!block) return fracas_no_memory("a checksum");
    TRY(fracas_checksum_create(&checksum));
    for (size_t got = BLOCK; got > 0; seal->bytes += got) {
        const uint64_t left = most - seal->bytes;
        if (!fracas_disk_read(fd, seal->bytes, block, left < BLOCK ? left : BLOCK, &got))
            return fracas_disk_fail("read", path);
        fracas_checksum_add(checksum, block, got);
    }
    seal->checksum = fracas_checksum_end(checksum); /* = fracas_checksum_of the whole */
    return FRACAS_OK;
}

fracas_err fracas_disk_seal(int fd, const char *path, fracas_file_seal *seal)
{
    return seal_first(fd, path, INT64_MAX, seal);
}

fracas_err fracas_disk_seal_path(const char *path, fracas_file_seal *seal)
{
    OWN_FD fd = -1;
    TRY(fracas_disk_open(path, &fd));
    return fracas_disk_seal(fd, path, seal);
}

fracas_err fracas_disk_check_seal(const char *path, const fracas_file_seal *wanted)
{
    fracas_file_seal seal;
    TRY(fracas_disk_seal_path(path, &seal));
    if (seal.bytes == wanted->bytes && seal.checksum == wanted->checksum) return FRACAS_OK;
    return fracas_fail(FRACAS_DAMAGED,
                       "%s: damaged: it has %" PRIu64 " bytes of checksum %016" PRIx64
                       ", the index says %" PRIu64 " of %016" PRIx64,
                       path, seal.bytes, seal.checksum, wanted->bytes, wanted->checksum);
}

fracas_err fracas_disk_set_aside(const char *path, char **aside)
{
    const char *dot = strrchr(path, '.'), *slash = strrchr(path, '/');
    OWNED char *name = NULL;
    *aside = NULL;
    if (!dot || (slash && dot < slash)) dot = path + strlen(path);
    TRY(fracas_path(&name, "%.*s.damaged", (int)(dot - path), path));
    if (rename(path, name) == 0) TRY(fracas_disk_sync_folder(path));
    else if (errno != ENOENT) return fracas_disk_fail("rename", path);
    *aside = name;
    name = NULL;
    return FRACAS_OK;
}

fracas_err fracas_disk_has_size(const char *path, uint64_t bytes, bool *has)
{
    struct stat info;
    int code = stat(path, &info);
    *has = code == 0 && (uint64_t)info.st_size == bytes;
    return code < 0 && errno != ENOENT ? fracas_disk_fail("look at", path) : FRACAS_OK;
}

fracas_err fracas_disk_is_local(const char *path, bool *local)
{
    /* Those whose locks and shared memory WAL can rely on; all others are taken for network
     * filesystems. */
    static const unsigned long known[] = {EXT4_SUPER_MAGIC,
                                          XFS_SUPER_MAGIC,
                                          BTRFS_SUPER_MAGIC,
                                          TMPFS_MAGIC,
                                          RAMFS_MAGIC,
                                          F2FS_SUPER_MAGIC,
                                          OVERLAYFS_SUPER_MAGIC,
                                          REISERFS_SUPER_MAGIC,
                                          0x2fc12fc1 /* ZFS */,
                                          0xca451a4e /* bcachefs */,
                                          0x3153464a /* JFS */};
    struct statfs info;
    *local = false;
    if (statfs(path, &info) < 0) return fracas_disk_fail("look at", path);
    for (size_t k = 0; k < FRACAS_COUNT(known); k++)
        if ((uint32_t)info.f_type == (uint32_t)known[k]) *local = true;
    return FRACAS_OK;
}

void fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT])
{
    host[FRACAS_HOST_TEXT - 1] = *boot = '\0';
    if (gethostname(host, FRACAS_HOST_TEXT - 1) < 0 || !*host) strcpy(host, "unknown");
    OWN(FILE) in = fopen("/proc/sys/kernel/random/boot_id", "re");
    if (!in || fscanf(in, "%63s", boot) != 1) *boot = '\0';
}

/* ---- the seal at the end of a segment ---- */

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
    return fracas_disk_write(fd, seal.bytes, &own, sizeof own) ? FRACAS_OK
                                                               : fracas_disk_fail("write", path);
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
    if (!fracas_disk_read(fd, 0, start, sizeof start, &got)) return fracas_disk_fail("read", path);
    if (got < sizeof start || memcmp(start, signature, sizeof signature) != 0)
        return damaged(path, "it does not begin as HDF5");
    memcpy(&end, start + END, sizeof end);
    return bytes == end ? FRACAS_OK
                        : damaged(path, "it has no seal at its end, or not the size that it had: "
                                        "cut short, or overwritten");
}

fracas_err fracas_disk_check_own_seal(const char *path)
{
    own_seal own;
    fracas_file_seal found;
    struct stat info;
    size_t got;
    OWN_FD fd = -1;
    TRY(fracas_disk_open(path, &fd));
    if (fstat(fd, &info) < 0) return fracas_disk_fail("look at", path);
    const uint64_t bytes = (uint64_t)info.st_size;
    if (bytes < sizeof own) return damaged(path, "it is too short");
    if (!fracas_disk_read(fd, bytes - sizeof own, &own, sizeof own, &got))
        return fracas_disk_fail("read", path);
    if (got < sizeof own || memcmp(own.mark, mark, sizeof mark) != 0)
        return check_end(fd, path, bytes);
    TRY(seal_first(fd, path, bytes - sizeof own, &found));
    if (own.bytes == found.bytes && own.checksum == found.checksum) return FRACAS_OK;
    return damaged(path, "the seal at its end is not of its bytes");
}
