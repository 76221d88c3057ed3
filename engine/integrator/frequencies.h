/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Highest angular frequencies of bodies, kept for models of the same body that are made later, in
 * this process or another: on large meshes nothing else of a model takes so long. */
#ifndef FRACAS_ENGINE_INTEGRATOR_FREQUENCIES_H
#define FRACAS_ENGINE_INTEGRATOR_FREQUENCIES_H

#include "base/err.h"
#include "base/hash.h"
#include "base/own.h"

#include <stdbool.h>

/* Highest frequency with all interfaces whole, and with all broken and pressed together [1/s]. */
typedef struct {
    double whole, pressed;
} fracas_frequency_pair;

typedef struct fracas_frequencies fracas_frequencies;

FRACAS_MUST_USE fracas_err fracas_frequencies_create(fracas_frequencies **frequencies);
void fracas_frequencies_destroy(fracas_frequencies *frequencies); /* NULL is allowed */
FRACAS_OWNER(fracas_frequencies, fracas_frequencies_destroy)

/* The pair kept under `body`, the hash of all tables and constants of its operator. */
bool fracas_frequencies_find(const fracas_frequencies *frequencies, const fracas_hash *body,
                             fracas_frequency_pair *pair);
/* Keeps a pair. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_frequencies_keep(fracas_frequencies *frequencies,
                                                   const fracas_hash *body,
                                                   const fracas_frequency_pair *pair);

/* The pairs as text without blanks, the first 1000 of them; "" for none. The caller frees it; NULL
 * without memory. */
char *fracas_frequencies_write(const fracas_frequencies *frequencies);
/* Keeps the pairs of such a text, up to the first wrong one. FRACAS_ENVIRONMENT without
 * memory. */
FRACAS_MUST_USE fracas_err fracas_frequencies_read(fracas_frequencies *frequencies,
                                                   const char *text);

#endif
