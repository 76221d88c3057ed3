/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/attach.h"

#include "base/file.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { MOST_MIB = 256 };

/* The name of a copy in a study is the digest of its content: attachments/DIGEST. */
static fracas_err check_copy(const fracas_attachment *read, const char *path)
{
    static const char folder[] = FRACAS_ATTACHMENTS "/";
    const size_t length = strlen(read->path), above = sizeof folder - 1;
    fracas_hash named;
    if (length != above + FRACAS_HASH_HEX - 1 || strncmp(read->path, folder, above) != 0)
        return FRACAS_OK;
    if (!fracas_hash_parse(read->path + above, &named) ||
        strcmp(read->digest, read->path + above) == 0)
        return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s is damaged: its content has the digest %s, its name says another; put "
                       "back the original file",
                       path, read->digest);
}

static fracas_err keep_content(const char *text, size_t size, const char *path,
                               fracas_attachment *made)
{
    made->text = text;
    made->size = size;
    const fracas_hash digest = fracas_hash_of(text, size);
    memcpy(made->digest, fracas_hash_hex(&digest).text, FRACAS_HASH_HEX);
    return check_copy(made, path);
}

/* A wrong name is an error of the campaign file, any other reason one of the system. */
static fracas_err cannot(const char *verb, const char *path)
{
    const int reason = errno;
    const bool absent = reason == ENOENT || reason == ENOTDIR || reason == ENAMETOOLONG ||
                        reason == ELOOP;
    return fracas_fail(absent ? FRACAS_USAGE : FRACAS_ENVIRONMENT, "cannot %s %s: %s", verb, path,
                       strerror(reason));
}

/* The content with a final '\0', in the campaign's memory. */
static fracas_err load_open(const fracas_file *file, const char *path, FILE *in,
                            fracas_attachment *made)
{
    struct stat info;
    if (fstat(fileno(in), &info)) return cannot("read", path);
    if (info.st_size == 0) return fracas_fail(FRACAS_USAGE, "%s is empty", path);
    if (info.st_size > (off_t)MOST_MIB << 20)
        return fracas_fail(FRACAS_USAGE, "%s has %.0f MiB; a file can have at most %d", path,
                           (double)info.st_size / 1048576.0, MOST_MIB);
    const size_t size = (size_t)info.st_size;
    char *text = fracas_memory_take(file->memory, size + 1, 1);
    if (!text) return fracas_no_memory("a file that the campaign names");
    const size_t got = fread(text, 1, size, in);
    if (ferror(in)) return cannot("read", path);
    if (got < size)
        return fracas_fail(FRACAS_ENVIRONMENT, "%s has become shorter while it was read; try again",
                           path);
    return keep_content(text, size, path, made);
}

/* Its path is relative to the folder of the campaign file. */
static fracas_err load(const fracas_file *file, fracas_attachment *made)
{
    const char *slash = strrchr(file->name, '/');
    const int folder = *made->path != '/' && slash ? (int)(slash - file->name) + 1 : 0;
    OWNED char *path = NULL;
    TRY(fracas_path(&path, "%.*s%s", folder, file->name, made->path));
    OWN(FILE) in = fracas_file_stream(fracas_file_open(path), "rb");
    if (in) return load_open(file, path, in, made);
    if (errno == ENXIO || errno == EISDIR)
        return fracas_fail(FRACAS_USAGE, "%s is not a file", path);
    return cannot("open", path);
}

/* The file that a copy of the campaign has in the place of attachments/DIGEST. */
static fracas_err take(const fracas_file *file, fracas_attachment *made)
{
    for (size_t i = 0; i < file->copy->nfiles; i++) {
        const fracas_attachment *from = &file->copy->file[i];
        if (strcmp(fracas_attachment_named(from).text, made->path) != 0) continue;
        char *text = fracas_memory_take(file->memory, from->size + 1, 1);
        if (!text) return fracas_no_memory("a file that the campaign names");
        memcpy(text, from->text, from->size);
        return keep_content(text, from->size, made->path, made);
    }
    return fracas_fail(FRACAS_USAGE,
                       "%s is not in %s, which should have every file that its "
                       "campaign names",
                       made->path, file->name);
}

fracas_err fracas_attachment_read(const fracas_file *file, const char *key, const fracas_node *node,
                                  const void **attachment)
{
    for (const fracas_attached *a = file->campaign->attached; a; a = a->next)
        if (strcmp(a->attachment.path, node->text) == 0) {
            *attachment = &a->attachment;
            return FRACAS_OK;
        }
    fracas_attached *made = fracas_memory_take(file->memory, 1, sizeof *made);
    if (!made) return fracas_no_memory("a file that the campaign names");
    made->attachment.path = node->text; /* as long as the campaign's memory */
    fracas_err err = file->copy ? take(file, &made->attachment) : load(file, &made->attachment);
    if (err) return err == FRACAS_USAGE ? fracas_file_error_within(file, node, key) : err;
    made->next = file->campaign->attached;
    file->campaign->attached = made;
    *attachment = &made->attachment;
    return FRACAS_OK;
}
