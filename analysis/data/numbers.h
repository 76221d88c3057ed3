/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table of the numbers of one realization: X(key, unit, meaning, ...), the last being designated
 * initializers of fracas_number. A key is a member of fracas_replica_values (the number) and of
 * fracas_point_statistics (its mean over replicas), and the name in JSON, CSV, comparisons, and
 * `fracas report --y`. A new number is a line here, and its function value_KEY in
 * analysis/summary/numbers.c. */
#ifndef FRACAS_ANALYSIS_DATA_NUMBERS_H
#define FRACAS_ANALYSIS_DATA_NUMBERS_H

#include <stdbool.h>
#include <stddef.h>

/* clang-format off */
/* Numbers also tested by `compare`, and judged by `converge`: among all some would move by chance
 * even where a campaign converges. */
#define FRACAS_FIRST_NUMBERS(X)                                                                   \
    X(count, "1", "number of fragments", .column = "count")                                       \
    X(count_large, "1", "number of fragments without dust", .column = "no dust",                  \
      .where = FRACAS_WITH_SURFACES)                                                              \
    X(size, "m", "mean fragment size (length / fragments; of a surface the mean of sqrt(area))",  \
      .column = "size")                                                                           \
    X(dissipated, "J", "dissipated energy", .column = "dissipated", .drawn = true)                \
    X(dissipated_bending, "J", "part of bending in the dissipated energy", .column = "bending",   \
      .where = FRACAS_WITH_VALUES, .continuous = true)                                            \
    X(onset_time, "s", "time of first onset", .continuous = true)

/* Numbers also tested by `compare`. */
#define FRACAS_COMPARED_NUMBERS(X)                                                                \
    FRACAS_FIRST_NUMBERS(X)                                                                       \
    X(radial_velocity, "m/s", "mean velocity outward of a ring's fragments")                      \
    X(radial_scatter, "m/s", "standard deviation over a ring's fragments of that velocity")       \
    X(circumferential_velocity, "m/s", "rms velocity along the ring of its fragments")            \
    X(angular_velocity, "rad/s", "|angular velocity| of a ring's fragments")                      \
    X(translation, "J", "kinetic energy of the centres of mass of a surface's fragments")         \
    X(rotation, "J", "kinetic energy of the spins of a surface's fragments")

#define FRACAS_LARGEST_NUMBERS(X)                                                                 \
    X(largest_size, "m", "size of the fragment of most mass")                                     \
    X(largest_share, "1",                                                                         \
      "share of the mass in the largest fragment (its mass over that of all fragments)")          \
    X(aspect, "1", "aspect ratio, largest by middle semi-axis, of the fragments without dust",    \
      .words = "aspect ratio of the fragments without dust")
/* clang-format on */

#define FRACAS_REALIZATION_NUMBERS(X) FRACAS_COMPARED_NUMBERS(X) FRACAS_LARGEST_NUMBERS(X)

#define FRACAS_ONE_MORE(key, unit, doc, ...) +1
enum {
    FRACAS_FIRST_VALUES = FRACAS_FIRST_NUMBERS(FRACAS_ONE_MORE),       /* the first of the table */
    FRACAS_COMPARED_VALUES = FRACAS_COMPARED_NUMBERS(FRACAS_ONE_MORE), /* likewise */
    FRACAS_NNUMBERS = FRACAS_REALIZATION_NUMBERS(FRACAS_ONE_MORE)
};
#undef FRACAS_ONE_MORE

/* The place of a number in fracas_realization_numbers. */
#define FRACAS_PLACE_OF(key, unit, doc, ...) FRACAS_NUMBER_##key,
enum { FRACAS_REALIZATION_NUMBERS(FRACAS_PLACE_OF) };
#undef FRACAS_PLACE_OF

typedef struct {
    const char *key, *unit, *doc;
    const char *words;  /* in titles and on axes; NULL: doc before its bracket or semicolon */
    size_t value;       /* place in fracas_replica_values */
    size_t mean;        /* place of its fracas_estimate in fracas_point_statistics */
    const char *column; /* heading of its column in the result table; NULL: it has none */
    enum {
        FRACAS_ALWAYS,
        FRACAS_WITH_SURFACES, /* in a study with surfaces */
        FRACAS_WITH_VALUES    /* where some mean is above 0 */
    } where;                  /* condition of the column */
    bool drawn;               /* every report has its figure, not only with `--y` */
    bool continuous; /* two values are not alike by chance; others may be multiples of one break */
} fracas_number;

extern const fracas_number
    fracas_realization_numbers[FRACAS_NNUMBERS]; /* analysis/summary/numbers.c */

#endif
