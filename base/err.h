/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Errors: a must-use code, and one message set where the fault is found. */
#ifndef FRACAS_BASE_ERR_H
#define FRACAS_BASE_ERR_H

#include <stddef.h>

/* The codes are the program's exit statuses (docs/formats/exit-status.md). */
typedef enum {
    FRACAS_OK = 0,
    FRACAS_SOME_FAILED = 1, /* done, some realizations FAILED */
    FRACAS_USAGE = 2,       /* wrong usage or campaign file */
    FRACAS_INTERRUPTED = 3, /* interrupted, resumable */
    FRACAS_IN_USE = 4,      /* study in use by another run */
    FRACAS_DAMAGED = 5,     /* study damaged, of another campaign or format */
    FRACAS_ENVIRONMENT = 6, /* disk full, permission, memory, MPI */
    FRACAS_BUG = 70         /* our own bug */
} fracas_err;

#define FRACAS_MUST_USE __attribute__((warn_unused_result))
#define FRACAS_PRINTF(f, a) __attribute__((format(printf, f, a)))

/* Passes an error up: returns from the enclosing function when `call` failed. */
#define TRY(call)                        \
    do {                                 \
        fracas_err try_code_ = (call);   \
        if (try_code_) return try_code_; \
    } while (0)

/* Sets this thread's message (which names the value, the place and the remedy), as fracas_text_show
 * writes it, and returns `code`. Messages longer than 1023 bytes are cut. */
FRACAS_MUST_USE fracas_err fracas_fail(fracas_err code, const char *format, ...)
    FRACAS_PRINTF(2, 3);

/* Puts "context: " before the present message and returns `code`. */
FRACAS_MUST_USE fracas_err fracas_fail_within(fracas_err code, const char *format, ...)
    FRACAS_PRINTF(2, 3);

/* Puts `text`, itself a message, on a line of its own below the present message, and returns
 * `code`. The lines together are cut at 23 KiB. */
FRACAS_MUST_USE fracas_err fracas_fail_also(fracas_err code, const char *text);

/* FRACAS_ENVIRONMENT with "<the formatted text>: <strerror(reason)>; <remedy>". The remedies cover
 * the limits of long runs: disk, quota, open files, size of files, memory, a failing or read-only
 * disk. FRACAS_DAMAGED, and in our words, for a link or a pipe in the place of a file
 * (base/file.h). */
FRACAS_MUST_USE fracas_err fracas_fail_system(int reason, const char *format, ...)
    FRACAS_PRINTF(2, 3);
/* The same remedy after a semicolon; "" if there is none to give. */
const char *fracas_remedy(int reason);

/* FRACAS_ENVIRONMENT with "no memory for <purpose>". */
FRACAS_MUST_USE fracas_err fracas_no_memory(const char *what);

/* Gives the array *array of `count` rows of `size` bytes room for one row more: *room rows.
 * fracas_no_memory(what) leaves it as it is. */
FRACAS_MUST_USE fracas_err fracas_grow(void *array, size_t size, size_t count, size_t *room,
                                       const char *what);

/* *path: a file name as printf writes it, freed by the caller. After fracas_no_memory it is NULL.
 */
FRACAS_MUST_USE fracas_err fracas_path(char **path, const char *format, ...) FRACAS_PRINTF(2, 3);

/* The message of the last failure of this thread; "" before the first. Never NULL. */
const char *fracas_message(void);

#endif
