/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Two studies, point by point: differences of means with intervals, and permutation tests over
 * realizations (docs/theory/compare.md). */
#ifndef FRACAS_ANALYSIS_COMPARE_COMPARE_H
#define FRACAS_ANALYSIS_COMPARE_COMPARE_H

#include "analysis/analysis.h"
#include "analysis/data/estimate.h"
#include "analysis/data/numbers.h"
#include "analysis/data/text.h"

enum { FRACAS_COMPARE_PERMUTATIONS = 9999 };

typedef struct {
    const char *by;       /* "loading.rate,strength.shape"; NULL: see fracas_match_points */
    const char *points;   /* "3,17", "0-2,9-11" or "0,1,2:9,10,11": pairs of points of one study;
                             NULL: partners of two studies */
    bool common;          /* both campaigns have random_numbers: common */
    int64_t permutations; /* 0: FRACAS_COMPARE_PERMUTATIONS */
    uint64_t seed;        /* equal seeds give equal p */
} fracas_compare_options;

/* B - A of one number at one pair of points. */
typedef struct {
    fracas_estimate a, b;         /* means; of pairs over the realizations with a partner */
    double difference, low, high; /* 95 %: Welch's, of pairs Student's; NaN: none */
    double relative, relative_low, relative_high; /* over the mean of A */
    double freedom;                               /* degrees of freedom of both intervals */
    double p;                                     /* by permutation; NaN: no test */
    double p_holm;                                /* corrected over the points */
} fracas_compared_value;

typedef struct {
    size_t a, b;            /* the points */
    fracas_label label;     /* for the point in A */
    char differs[512];      /* "mesh.elements 2500 | 5000": other differences; "": none */
    bool paired;            /* realizations have the same random numbers, replica by replica */
    int64_t used_a, used_b; /* realizations compared */
    fracas_compared_value
        value[FRACAS_COMPARED_VALUES]; /* in the order of fracas_realization_numbers; a.n = b.n = 0:
                                          none */
    double distance;  /* distance of the distributions of fragment sizes (Kolmogorov and Smirnov) */
    double p, p_holm; /* p of the distance */
    int64_t permutations; /* assignments looked at, the observed one among them */
    bool exact;           /* all there are */
} fracas_compared_point;

typedef struct {
    bool listed;   /* points of one study, paired by a list */
    char how[512]; /* columns by which the points were matched, or the list; "": equal hashes */
    size_t npoints;
    fracas_compared_point *point;
    size_t nonly_a, nonly_b;
    size_t *only_a, *only_b; /* points without a partner */
} fracas_comparison;

/* Points matched by fracas_match_points; differences with their intervals (compare.1) to
 * (compare.5); p (compare.6) to (compare.9), corrected over the points for each number by itself
 * (compare.10). Realizations are paired by their replica where seeds are equal, and hashes are or
 * both have common random numbers. FRACAS_USAGE if points cannot be matched.
 *
 * With options->points, b is a, and the points of the first list are compared with those of the
 * second, in their order. FRACAS_USAGE for lists of unequal lengths, and for a point with itself.
 *
 * *comparison is cleared by the caller, after an error too. */
FRACAS_MUST_USE fracas_err fracas_compare(const fracas_analysis *a, const fracas_analysis *b,
                                          const fracas_compare_options *options,
                                          fracas_comparison *comparison);
void fracas_comparison_clear(fracas_comparison *comparison);

/* As a table for a terminal, and as one JSON document. */
FRACAS_MUST_USE fracas_err fracas_comparison_print(const fracas_comparison *comparison,
                                                   const fracas_analysis *a,
                                                   const fracas_analysis *b, int columns,
                                                   FILE *out);
void fracas_comparison_write_json(const fracas_comparison *comparison, const fracas_analysis *a,
                                  const fracas_analysis *b, FILE *out);

#endif
