/* SPDX-License-Identifier: GPL-3.0-or-later */
/* malloc and its like, of which the k-th can be made to fail. Not under AddressSanitizer, which
 * owns malloc. */
#ifndef FRACAS_TESTS_SUPPORT_FAILING_MALLOC_H
#define FRACAS_TESTS_SUPPORT_FAILING_MALLOC_H

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>

/* glibc's own names of what is replaced below. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *old);

/* Volatile: the compiler believes that malloc changes nothing of ours. */
static volatile long countdown;           /* allocations until one fails; 0: none does */
static volatile bool has_failed, lasting; /* lasting: after the first failure all fail */
static volatile long held;                /* allocations not yet freed */

static bool fails(void)
{
    if (countdown == 0 || --countdown > 0) return false;
    has_failed = true;
    if (lasting) countdown = 1;
    errno = ENOMEM;
    return true;
}

void *malloc(size_t size)
{
    if (fails()) return NULL;
    held++;
    return __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    if (fails()) return NULL;
    held++;
    return __libc_calloc(count, size);
}

void *realloc(void *old, size_t size)
{
    if (fails()) return NULL;
    held += !old;
    return __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size)
{
    if (fails()) return NULL;
    held++;
    return __libc_memalign(alignment, size);
}

void free(void *old)
{
    held -= old != NULL;
    __libc_free(old);
}

#endif
