/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where two records of a realization differ, as a file stores them. */
#ifndef FRACAS_CAMPAIGNS_STORE_FILE_DIFFERENCE_H
#define FRACAS_CAMPAIGNS_STORE_FILE_DIFFERENCE_H

#include "engine/record.h"

#include <stdbool.h>

typedef struct {
    const char *column; /* "/fragment/mass"; NULL: the stored bytes are the same */
    size_t row;         /* among the rows of the realization there */
    char value[2][32];  /* the values of a and b */
} fracas_record_difference;

/* The first value, in the order of the columns of a file, that is stored as other bytes; rows of
 * interfaces count in a file with `interfaces`. */
void fracas_record_compare(const fracas_record *a, const fracas_record *b, bool interfaces,
                           fracas_record_difference *difference);

#endif
