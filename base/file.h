/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files by name: nothing waits for a pipe in the place of a file, and nothing is written through a
 * symbolic link, which may lead anywhere (docs/decisions/trust.md).
 *
 * A failure gives errno: ELOOP for a link, ENXIO for a pipe, a socket or a device, EISDIR for a
 * folder, ENOTDIR for anything in the place of a folder; fracas_fail_system has words for them. */
#ifndef FRACAS_BASE_FILE_H
#define FRACAS_BASE_FILE_H

#include "base/err.h"

#include <stdbool.h>
#include <stdio.h>

/* Descriptor of a file, to read; links are followed. -1 and errno. */
int fracas_file_open(const char *path);
/* The same to read and write, and created if it is not there; no link. */
int fracas_file_open_own(const char *path);
/* A new file, to read and write, in place of the file or link of that name. */
int fracas_file_create(const char *path);
/* A stream of such a descriptor, which it takes over; NULL and errno, also for -1. */
FILE *fracas_file_stream(int fd, const char *mode);

/* True of a file that is not there, is empty or begins with `text` (100 bytes at most), and of
 * anything but a file. */
bool fracas_file_begins(const char *path, const char *text);
/* True if both are there and are one file, by whatever names. */
bool fracas_file_same(const char *one, const char *other);

/* Gives a file the name PATH.before-TIME-PID, which *aside has, freed by the caller; NULL: nothing
 * is there. FRACAS_ENVIRONMENT if it cannot. */
FRACAS_MUST_USE fracas_err fracas_file_set_aside(const char *path, char **aside);

/* True where a file may be written: nothing is there, or a file and no link. False, and errno.
 */
bool fracas_file_is_own(const char *path);
/* The same for a folder. */
bool fracas_folder_is_own(const char *path);
/* Makes a folder, which may be there, and is no link. False, and errno. */
bool fracas_folder_create(const char *path);
/* Removes a folder with all in it, as far as it can; links are not followed. */
void fracas_folder_remove(const char *path);

#endif
