/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of a campaign file that follow from other keys, "ceil(geometry.length / 20 um)".
 *
 * sum = product {+|- product}; product = power {*|/ power}; power = [-] atom [^ whole number];
 * atom = number [unit] | unit | pi | section.key | function(sum, ...) | (sum). Functions are ceil,
 * floor, round, sqrt, abs, min and max. Units are names as `um` or `m2`; `10 N/m` is 10 N divided
 * by 1 m, and `1e4 1/s` 1e4 divided by 1 s. */
#ifndef FRACAS_CAMPAIGNS_FILE_EXPRESSION_H
#define FRACAS_CAMPAIGNS_FILE_EXPRESSION_H

#include "base/units.h"

#include <stdbool.h>

/* A number in SI units of a dimension. */
typedef struct {
    double value;
    fracas_dimension dimension;
} fracas_magnitude;

/* Whether both have one dimension. */
bool fracas_magnitude_same(const fracas_magnitude *a, const fracas_magnitude *b);

/* Gives the value of the key at `path`, `length` bytes long; FRACAS_USAGE if it has none. */
typedef fracas_err fracas_expression_lookup(void *context, const char *path, size_t length,
                                            fracas_magnitude *quantity);

/* Evaluates all of `text`; FRACAS_USAGE names the place of a fault, sums of unlike dimensions and
 * quotients by 0 among them. */
FRACAS_MUST_USE fracas_err fracas_expression_evaluate(const fracas_units *units, const char *text,
                                                      fracas_expression_lookup *lookup,
                                                      void *context, fracas_magnitude *quantity);

/* Length of the dotted path at the start of `text`, "geometry.length"; 0 if there is none. */
size_t fracas_expression_path(const char *text);

#endif
