/* The tables of a report as CSV: names in the first line, numbers to 15 digits in SI, nothing for NaN. */
#ifndef FRACAS_ANALYSIS_EXPORT_CSV_H
#define FRACAS_ANALYSIS_EXPORT_CSV_H

#include "analysis/study/study.h"

/* A comma and the value. */
void fracas_csv_real(double value, FILE *out);

/* A line a point: its index and hash, every parameter and every statistic (the keys of the JSON summary), outcomes. */
void fracas_csv_points(const fracas_analysis *analysis, FILE *out);

/* A line a fragment, read again from the study in its order. */
FRACAS_MUST_USE fracas_err fracas_csv_fragments(const fracas_analysis *analysis, FILE *out);

/* Energies over time of each point: mean and band at each time of its histories. */
void fracas_csv_energies(const fracas_analysis *analysis, FILE *out);
/* The headline numbers of each point from its first 4, 8, 16, ... replicas and from all. */
void fracas_csv_convergence(const fracas_analysis *analysis, FILE *out);

#endif
