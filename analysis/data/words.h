/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters by the words of the field. */
#ifndef FRACAS_ANALYSIS_DATA_WORDS_H
#define FRACAS_ANALYSIS_DATA_WORDS_H

#include "campaigns/points.h"

/* "Weibull modulus" for strength.shape; the path itself if it has no words (words.list.h). */
const char *fracas_words_of(const char *path);
/* The same for a column of the table. A shape is a Weibull modulus only where all strengths with
 * a shape have a modulus. */
const char *fracas_column_words(const fracas_point_table *table, size_t column);

#endif
