/* Durable files: names, seals and the syncing of folders. Private to the store. */
#ifndef FRACAS_CAMPAIGNS_STORE_DISK_H
#define FRACAS_CAMPAIGNS_STORE_DISK_H

#include "campaigns/store/store.h"

/* FOLDER/NAME; *path freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_disk_join(const char *folder, const char *name, char **path);
/* STUDY/segments/NAME. */
FRACAS_MUST_USE fracas_err fracas_disk_segment(const char *study, const char *name, char **path);
/* The temporary name of `path` in this process, .NAME.tmp-PID in the same folder; freed by the caller. */
FRACAS_MUST_USE fracas_err fracas_disk_temporary(const char *path, char **temporary);
/* True for such a name (without its folder). */
bool fracas_disk_is_temporary(const char *name);

/* Makes the names in the folder of `path` durable. */
FRACAS_MUST_USE fracas_err fracas_disk_sync_folder(const char *path);
/* Size and checksum of an open file, read in blocks; `path` is for the message. */
FRACAS_MUST_USE fracas_err fracas_disk_seal(int fd, const char *path, fracas_file_seal *seal);
/* The same of a closed one; FRACAS_DAMAGED if it is not there. */
FRACAS_MUST_USE fracas_err fracas_disk_seal_path(const char *path, fracas_file_seal *seal);

/* FRACAS_DAMAGED, with sizes and checksums, unless the file is there and is what the seal says. */
FRACAS_MUST_USE fracas_err fracas_disk_check_seal(const char *path, const fracas_file_seal *wanted);
/* Renames a damaged FOLDER/NAME.h5 to FOLDER/NAME.damaged, durable on return; *aside is that, freed by the caller. One that is not
 * there is no error. */
FRACAS_MUST_USE fracas_err fracas_disk_set_aside(const char *path, char **aside);

/* True if `path` is there and has so many bytes. */
FRACAS_MUST_USE fracas_err fracas_disk_has_size(const char *path, uint64_t bytes, bool *has);

/* True if `path` lies on a filesystem of this machine, false on a network one or one that we do not know. */
FRACAS_MUST_USE fracas_err fracas_disk_is_local(const char *path, bool *local);

/* FRACAS_ENVIRONMENT: "cannot VERB PATH: reason" from errno. */
FRACAS_MUST_USE fracas_err fracas_disk_fail(const char *verb, const char *path);

#endif
