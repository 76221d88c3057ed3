/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Local variables that end with their scope, on every return: TRY needs no cleanup after it. */
#ifndef FRACAS_BASE_OWN_H
#define FRACAS_BASE_OWN_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* `OWNED char *text = NULL;`: free(text) at the end of the scope. Set it to NULL to give it away.
 */
#define OWNED __attribute__((cleanup(fracas_own_free), unused))

/* `OWN(fracas_index) index = NULL;`: a pointer, ended by the function that FRACAS_OWNER names.
 * OWN(FILE) closes a file. */
#define OWN(type) __attribute__((cleanup(type##_own_end), unused)) type *
#define FRACAS_OWNER(type, end)                         \
    static inline void type##_own_end(type *const *one) \
    {                                                   \
        end(*one);                                      \
    }

/* `FRACAS_CLEARED(fracas_record) record = {0};`: a value, cleared by fracas_record_clear. */
#define FRACAS_CLEARED(type) __attribute__((cleanup(type##_clear), unused)) type

/* `OWN_FD fd = -1;`: a file descriptor, closed. */
#define OWN_FD __attribute__((cleanup(fracas_own_close), unused)) int

static inline void fracas_own_close(const int *fd)
{
    if (*fd >= 0) close(*fd);
}

static inline void fracas_own_free(void *variable)
{
    void *memory;
    memcpy(&memory, variable, sizeof memory);
    free(memory);
}

static inline void FILE_own_end(FILE *const *one)
{
    if (*one) fclose(*one);
}

#endif
