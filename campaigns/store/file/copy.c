/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/copy.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char resolved[] = FRACAS_COPY_GROUP "/resolved",
                  attachments[] = FRACAS_COPY_GROUP "/attachments", count_of[] = "attachments";

typedef char file_path[sizeof attachments + FRACAS_HASH_HEX];

/* The dataset of a file: one text, with the file's bytes as they are. */
static fracas_store_column column_of(const char *path, size_t size, const char *description)
{
    return (fracas_store_column){.path = path,
                                 .type = FRACAS_TEXT,
                                 .width = size ? size : 1, /* HDF5 has no empty type */
                                 .unit = "",
                                 .description = description};
}

/* ---- writing ---- */

static fracas_err write_file(const fracas_h5 *h5, const char *path, const char *description,
                             const char *bytes, size_t size)
{
    const fracas_store_column column = column_of(path, size, description);
    OWN_ID dataset = H5I_INVALID_HID;
    TRY(fracas_h5_create_column(h5, &column, 1, &dataset));
    return fracas_h5_append_rows(h5, &column, dataset, 0, 1, bytes);
}

fracas_err fracas_copy_write(const fracas_h5 *h5, const fracas_campaign_copy *copy)
{
    TRY(fracas_h5_create_group(h5, FRACAS_COPY_GROUP));
    TRY(fracas_h5_put_integer(h5, FRACAS_COPY_GROUP, count_of, H5T_STD_I64LE, copy->nfiles));
    TRY(write_file(h5, resolved, "the campaign as resolved: campaign.yaml", copy->text,
                   copy->size));
    if (copy->nfiles) TRY(fracas_h5_create_group(h5, attachments));
    for (size_t i = 0; i < copy->nfiles; i++) {
        file_path path;
        snprintf(path, sizeof path, "%s/%s", attachments, copy->file[i].digest);
        TRY(write_file(h5, path, "a file that the campaign names, by the digest of its content",
                       copy->file[i].text, copy->file[i].size));
    }
    return FRACAS_OK;
}

/* ---- reading ---- */

/* *bytes: the file and a NUL behind it; freed by the caller, after an error too. */
static fracas_err read_file(const fracas_h5 *h5, const char *path, char **bytes, size_t *size)
{
    OWN_ID dataset = H5I_INVALID_HID;
    uint64_t rows;
    TRY(fracas_h5_text_width(h5, path, size));
    const fracas_store_column column = column_of(path, *size, "");
    TRY(fracas_h5_open_column(h5, &column, 1, &dataset, &rows));
    if (rows != 1)
        return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged: it is not one text", h5->path, path);
    *bytes = calloc(1, *size + 1);
    if (!*bytes) return fracas_no_memory("the campaign of a study");
    return fracas_h5_read_rows(h5, &column, dataset, 0, 1, *bytes);
}

/* Puts a file behind those of copy->content, `used` bytes. */
static fracas_err add_file(const fracas_h5 *h5, const char *digest, size_t *used,
                           fracas_campaign_copy *copy)
{
    file_path path;
    fracas_hash hash;
    OWNED char *bytes = NULL;
    fracas_attachment *file = &copy->file[copy->nfiles];
    if (!fracas_hash_parse(digest, &hash))
        return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged: `%.40s` is no digest", h5->path,
                           attachments, digest);
    snprintf(path, sizeof path, "%s/%s", attachments, digest);
    TRY(read_file(h5, path, &bytes, &file->size));
    char *longer = realloc(copy->content, *used + file->size + 1);
    if (!longer) return fracas_no_memory("the campaign of a study");
    copy->content = longer;
    memcpy(copy->content + *used, bytes, file->size + 1);
    *used += file->size + 1;
    memcpy(file->digest, fracas_hash_hex(&hash).text, FRACAS_HASH_HEX);
    copy->nfiles++;
    return FRACAS_OK;
}

static fracas_err read_files(const fracas_h5 *h5, char **link, size_t count,
                             fracas_campaign_copy *copy)
{
    size_t used = 0;
    for (size_t i = 0; i < count; i++) TRY(add_file(h5, link[i], &used, copy));
    used = 0;
    for (size_t i = 0; i < count; i++) {
        copy->file[i].text = copy->content + used;
        used += copy->file[i].size + 1;
    }
    return FRACAS_OK;
}

fracas_err fracas_copy_read(const fracas_h5 *h5, fracas_campaign_copy *copy)
{
    uint64_t files;
    size_t count = 0;
    TRY(read_file(h5, resolved, &copy->text, &copy->size));
    TRY(fracas_h5_get_integer(h5, FRACAS_COPY_GROUP, count_of, H5T_STD_I64LE, &files));
    if (files > h5->bytes) return fracas_h5_fail(h5, attachments);
    OWNED char **link = calloc(files + 1, sizeof *link);
    copy->file = calloc(files + 1, sizeof *copy->file);
    if (!link || !copy->file) return fracas_no_memory("the campaign of a study");
    fracas_err err = files ? fracas_h5_link_names(h5, attachments, files, link, &count) : FRACAS_OK;
    if (!err && count != files)
        err = fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged: it has %zu files, not %llu", h5->path,
                          attachments, count, (unsigned long long)files);
    if (!err) err = read_files(h5, link, count, copy);
    for (size_t i = 0; i < count; i++) free(link[i]);
    return err;
}
