/* SPDX-License-Identifier: GPL-3.0-or-later */
/* HDF5 as the store uses it: files through a driver of our own, columns, attributes, errors as
 * messages.
 *
 * The driver reads and writes a file descriptor that we opened, keeps the errno of the first
 * failure, and takes no HDF5 file locks (they fail on network filesystems, and STUDY/lock does that
 * work). After a failed write it lets HDF5 go on as if all was well, because HDF5 1.10 cannot close
 * a file whose flush fails; the owner looks at `error` and throws the file away. Private to the
 * store. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_H5_H
#define FRACAS_CAMPAIGNS_STORE_FILE_H5_H

#include "base/err.h"
#include "campaigns/store/file/schema.h"

#include <hdf5.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    hid_t id, driver;
    int fd;
    int error; /* errno of the first failed read or write, 0 if none */
    bool writing;
    uint64_t bytes;   /* size when it was opened */
    const char *path; /* for messages; must outlive this */
} fracas_h5;

#define FRACAS_H5_CLOSED ((fracas_h5){.id = H5I_INVALID_HID, .driver = H5I_INVALID_HID, .fd = -1})

/* Creates `name` anew; `path` is its name in messages. fracas_h5_close after an error,
 * too. */
FRACAS_MUST_USE fracas_err fracas_h5_create(fracas_h5 *h5, const char *name, const char *path);
/* Opens `path` to read. FRACAS_DAMAGED if it is not there or no HDF5 file. */
FRACAS_MUST_USE fracas_err fracas_h5_open(fracas_h5 *h5, const char *path);
/* Closes HDF5's side, so that every byte is handed to the system; the descriptor stays open. */
FRACAS_MUST_USE fracas_err fracas_h5_flush_close(fracas_h5 *h5);
/* Closes the file; bytes written but not flushed are lost. */
void fracas_h5_close(fracas_h5 *h5);

/* Turns HDF5's error stack into our message about `what` (a dataset, an attribute):
 * FRACAS_ENVIRONMENT if the system failed, else FRACAS_DAMAGED for a file being read, FRACAS_BUG
 * for one being written. */
FRACAS_MUST_USE fracas_err fracas_h5_fail(const fracas_h5 *h5, const char *what);
/* An object of HDF5, closed at the end of its scope: after fracas_h5_fail, for any call of HDF5
 * forgets the errors before it. */
#define OWN_ID __attribute__((cleanup(fracas_h5_let_go))) hid_t
void fracas_h5_let_go(const hid_t *id);

#define FRACAS_PROVENANCE "provenance" /* attribute of the root group of a segment */

/* Scalar attributes. `object` is a path in the file. */
FRACAS_MUST_USE fracas_err fracas_h5_put_text(const fracas_h5 *h5, const char *object,
                                              const char *name, const char *text);
FRACAS_MUST_USE fracas_err fracas_h5_put_integer(const fracas_h5 *h5, const char *object,
                                                 const char *name, hid_t file_type, uint64_t value);
/* *text freed by the caller. FRACAS_DAMAGED if it is missing, no text or longer than 4096 bytes. */
FRACAS_MUST_USE fracas_err fracas_h5_get_text(const fracas_h5 *h5, const char *object,
                                              const char *name, char **text);
/* True if there is one of that name. */
FRACAS_MUST_USE fracas_err fracas_h5_has_attribute(const fracas_h5 *h5, const char *object,
                                                   const char *name, bool *has);
FRACAS_MUST_USE fracas_err fracas_h5_get_integer(const fracas_h5 *h5, const char *object,
                                                 const char *name, hid_t file_type,
                                                 uint64_t *value);

FRACAS_MUST_USE fracas_err fracas_h5_create_group(const fracas_h5 *h5, const char *path);
/* Names of the *count links of a group in byte order, at most `most`, each freed by the caller,
 * after an error too. FRACAS_DAMAGED if there are more. */
FRACAS_MUST_USE fracas_err fracas_h5_link_names(const fracas_h5 *h5, const char *group, size_t most,
                                                char **name, size_t *count);
/* Bytes of the texts of a dataset, at most those of the file; 0 if it holds none. */
FRACAS_MUST_USE fracas_err fracas_h5_text_width(const fracas_h5 *h5, const char *path,
                                                size_t *width);

/* Datasets. A new one has no rows. */
FRACAS_MUST_USE fracas_err fracas_h5_create_column(const fracas_h5 *h5,
                                                   const fracas_store_column *column, size_t chunk,
                                                   hid_t *dataset);
/* FRACAS_DAMAGED unless type, shape, chunk and filters are those of the schema and the rows are in
 * the file. */
FRACAS_MUST_USE fracas_err fracas_h5_open_column(const fracas_h5 *h5,
                                                 const fracas_store_column *column, size_t chunk,
                                                 hid_t *dataset, uint64_t *rows);
/* Writes `count` rows behind the first `start`, which become the dataset's all but last. */
FRACAS_MUST_USE fracas_err fracas_h5_append_rows(const fracas_h5 *h5,
                                                 const fracas_store_column *column, hid_t dataset,
                                                 uint64_t start, size_t count, const void *stored);
FRACAS_MUST_USE fracas_err fracas_h5_read_rows(const fracas_h5 *h5,
                                               const fracas_store_column *column, hid_t dataset,
                                               uint64_t start, size_t count, void *stored);

#endif
