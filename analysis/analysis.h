/* Statistics of a study, point by point, beside the size laws; the table, the exports and the report. */
#ifndef FRACAS_ANALYSIS_ANALYSIS_H
#define FRACAS_ANALYSIS_ANALYSIS_H

#include "base/err.h"

#include <stdio.h>

typedef struct fracas_analysis fracas_analysis;

/* Reads STUDY/study.h5 and computes every statistic. FRACAS_DAMAGED if it is not there (the message says that
 * `fracas run` makes it) or is no study. */
FRACAS_MUST_USE fracas_err fracas_analysis_create(const char *study, fracas_analysis **analysis);
void fracas_analysis_destroy(fracas_analysis *analysis); /* NULL is allowed */

/* The result table, one line a point, for a terminal. */
void fracas_analysis_print_table(const fracas_analysis *analysis, FILE *out);
/* The same numbers (and the rest of the statistics) as one JSON document. */
void fracas_analysis_write_json(const fracas_analysis *analysis, FILE *out);

/* STUDY/report/: index.html (self-contained), points.csv, fragments.csv and one SVG file a figure (and one CSV file a
 * crack pattern of a ring). */
FRACAS_MUST_USE fracas_err fracas_report_write(const fracas_analysis *analysis, const char *study);

#endif
