/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files of strengths, line by line. */
#ifndef FRACAS_SAMPLER_LINES_H
#define FRACAS_SAMPLER_LINES_H

#include "base/lines.h"

/* The strengths of a file, once read. */
typedef struct {
    size_t count;
    double sum, smallest, largest; /* Pa */
    double squares;                /* Pa2, sum of squared distances from the mean */
} fracas_lines_summary;

/* Reads the strength of the next line; *found is false at the end of the file. */
typedef fracas_err fracas_lines_reader(fracas_lines *lines, double *strength, bool *found);

/* FRACAS_USAGE for a line `read` refuses, or if there is none. */
FRACAS_MUST_USE fracas_err fracas_lines_summarize(const fracas_attachment *file,
                                                  fracas_lines_reader *read,
                                                  fracas_lines_summary *summary);

#endif
