/* A study as the rest of the room sees it: every point with its statistics. */
#ifndef FRACAS_ANALYSIS_STUDY_STUDY_H
#define FRACAS_ANALYSIS_STUDY_STUDY_H

#include "analysis/analysis.h"
#include "analysis/study/columns.h"
#include "analysis/study/statistics.h"
#include "campaigns/store/store.h"

struct fracas_analysis {
    char *name;                     /* of the study's folder */
    fracas_file_header header;
    const fracas_point_table *table;
    fracas_columns shown;           /* columns that tell the points apart */
    fracas_point_statistics *point; /* table->npoints of them */
    fracas_decision *decision;      /* of each point, the last one on its replicas, replicas 0 where they were given; NULL: at all points */
    fracas_reader *reader;          /* open as long as the analysis: it owns the table */
};

/* Opens STUDY/study.h5; FRACAS_DAMAGED if it is not there (the message says that `fracas run` makes it). */
FRACAS_MUST_USE fracas_err fracas_analysis_open(const char *study, fracas_reader **reader);

/* The last decision on the replicas of a point, NULL if they were given; and what it looks at, "mean-count". */
const fracas_decision *fracas_analysis_decision(const fracas_analysis *analysis, size_t point);
const char *fracas_analysis_quantity(const fracas_decision *decision);

/* "24 replicas in 3 rounds, ...": how the replicas of a point were decided; false, and no text, if they were given. */
bool fracas_analysis_decided(const fracas_analysis *analysis, size_t point, char *text, size_t size);

/* Something a reader must know before trusting a number. */
typedef struct {
    size_t point; /* SIZE_MAX: the study as a whole */
    char text[256];
} fracas_warning;

/* Every warning of the study in the order of its points; *warning freed by the caller with free(). */
FRACAS_MUST_USE fracas_err fracas_analysis_warnings(const fracas_analysis *analysis, fracas_warning **warning,
                                                    size_t *count);

/* True if some point, or every one, is a surface. */
bool fracas_analysis_any_surface(const fracas_analysis *analysis);
bool fracas_analysis_all_surfaces(const fracas_analysis *analysis);

/* "rate 1e4 1/s": the point by what it differs in. */
void fracas_analysis_label(const fracas_analysis *analysis, size_t point, char *text, size_t size);

#endif
