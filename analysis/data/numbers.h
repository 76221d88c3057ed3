/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Table of the numbers of one realization: X(key, unit, meaning). A key is a member of
 * fracas_replica_values (the number) and of fracas_point_statistics (its mean over replicas), and
 * the name in JSON, CSV and comparisons. A new number is a line here, and its value in
 * fracas_point_statistics_add. */
#ifndef FRACAS_ANALYSIS_DATA_NUMBERS_H
#define FRACAS_ANALYSIS_DATA_NUMBERS_H

/* clang-format off */
/* Numbers also tested by `compare`, and judged by `converge`: among all some would move by chance
 * even where a campaign converges. */
#define FRACAS_FIRST_NUMBERS(X)                                                                   \
    X(count, "1", "number of fragments")                                                          \
    X(count_large, "1", "number of fragments without dust")                                       \
    X(size, "m", "mean fragment size (length / fragments; of a surface the mean of sqrt(area))")  \
    X(dissipated, "J", "dissipated energy")                                                       \
    X(dissipated_bending, "J", "part of bending in the dissipated energy")                        \
    X(onset_time, "s", "time of first onset")

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
    X(largest_share, "1", "mass of that / mass of all fragments")                                 \
    X(aspect, "1", "aspect ratio, largest by middle semi-axis, of the fragments without dust")
/* clang-format on */

#define FRACAS_REALIZATION_NUMBERS(X) FRACAS_COMPARED_NUMBERS(X) FRACAS_LARGEST_NUMBERS(X)

#endif
