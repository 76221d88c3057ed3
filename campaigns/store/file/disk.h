/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Durable files: names, seals and the syncing of folders. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_DISK_H
#define FRACAS_CAMPAIGNS_STORE_FILE_DISK_H

#include "campaigns/store/datafile.h"

/* FOLDER/NAME; *path freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_disk_join(const char *folder, const char *name, char **path);
/* STUDY/segments/NAME. */
FRACAS_MUST_USE fracas_err fracas_disk_segment(const char *study, const char *name, char **path);
/* The temporary name of `path` in this process, .NAME.tmp-PID in the same folder; freed by the
 * caller. */
FRACAS_MUST_USE fracas_err fracas_disk_temporary(const char *path, char **temporary);
/* True for such a name (without its folder). */
bool fracas_disk_is_temporary(const char *name);

/* Calls `visit` with the path and name of every entry of a folder in the order of their names, none
 * if the folder is not there; the first error ends it. */
FRACAS_MUST_USE fracas_err fracas_disk_each(const char *folder,
                                            fracas_err (*visit)(void *context, const char *path,
                                                                const char *name),
                                            void *context);
/* True for a name with this end and without a dot at its beginning. */
bool fracas_disk_ends(const char *name, const char *end);

/* Makes the names in the folder of `path` durable. */
FRACAS_MUST_USE fracas_err fracas_disk_sync_folder(const char *path);
/* Opens a file to read; FRACAS_DAMAGED if it is not there. */
FRACAS_MUST_USE fracas_err fracas_disk_open(const char *path, int *fd);
/* Reads `size` bytes of an open file from `at` on; *got: fewer only at its end. False, and errno,
 * if the system fails. */
FRACAS_MUST_USE bool fracas_disk_read(int fd, uint64_t at, void *to, size_t size, size_t *got);
/* Writes them. */
FRACAS_MUST_USE bool fracas_disk_write(int fd, uint64_t at, const void *from, size_t size);
/* Size and checksum of an open file, read in blocks; `path` is for the message. */
FRACAS_MUST_USE fracas_err fracas_disk_seal(int fd, const char *path, fracas_file_seal *seal);
/* The same of a closed one; FRACAS_DAMAGED if it is not there. */
FRACAS_MUST_USE fracas_err fracas_disk_seal_path(const char *path, fracas_file_seal *seal);

/* FRACAS_DAMAGED, with sizes and checksums, unless the file is there and fits the seal. */
FRACAS_MUST_USE fracas_err fracas_disk_check_seal(const char *path, const fracas_file_seal *wanted);
/* Renames a damaged FOLDER/NAME.h5 to FOLDER/NAME.damaged, durable on return; *aside is the new
 * path, freed by the caller. A missing file is no error. */
FRACAS_MUST_USE fracas_err fracas_disk_set_aside(const char *path, char **aside);

/* True if `path` is there and has so many bytes. */
FRACAS_MUST_USE fracas_err fracas_disk_has_size(const char *path, uint64_t bytes, bool *has);

/* True if `path` lies on a known filesystem of this machine, false on a network one or another. */
FRACAS_MUST_USE fracas_err fracas_disk_is_local(const char *path, bool *local);

enum { FRACAS_HOST_TEXT = 257, FRACAS_BOOT_TEXT = 64 };
/* Names this host, "unknown" if it has no name, and the present boot of its kernel, "" if it does
 * not say. Tests link another one in its place (ld --wrap). */
void fracas_disk_host(char host[FRACAS_HOST_TEXT], char boot[FRACAS_BOOT_TEXT]);

/* FRACAS_ENVIRONMENT: "cannot VERB PATH: reason" from errno. */
FRACAS_MUST_USE fracas_err fracas_disk_fail(const char *verb, const char *path);

/* A segment ends with a seal of its own: FRACAS_OWN_SEAL bytes behind the last of HDF5, which does
 * not look there. A segment unknown to the index is checked by it before HDF5 opens the file, which
 * could crash on damage. The seal is a mark, the number of bytes before it, and their checksum
 * (docs/formats/study.md). */
enum { FRACAS_OWN_SEAL = 32 };
/* Appends it to an open file. */
FRACAS_MUST_USE fracas_err fracas_disk_append_seal(int fd, const char *path);
/* FRACAS_DAMAGED, naming the file, if its seal does not fit the bytes before it. A file without a
 * seal passes if it has the size that HDF5 noted in its first bytes. */
FRACAS_MUST_USE fracas_err fracas_disk_check_own_seal(const char *path);

#endif
