/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters by the words of the field. */
#ifndef FRACAS_ANALYSIS_DATA_WORDS_H
#define FRACAS_ANALYSIS_DATA_WORDS_H

#include "campaigns/points.h"

typedef struct {
    char text[96];
} fracas_parameter_words;

/* "Young's modulus" for material.young (words.list.h), or else the key: "fracture energy" for
 * cohesive.fracture_energy; of a section loading_2 those of loading, and " of loading 2". */
fracas_parameter_words fracas_words_of(const char *path);
/* The same for a column of the table. strength.shape is a "Weibull modulus" only where all
 * strengths with a shape have a modulus. */
fracas_parameter_words fracas_column_words(const fracas_point_table *table, size_t column);

#endif
