/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sweep of a campaign file: the points are the product of its axes. */
#ifndef FRACAS_CAMPAIGNS_FILE_SWEEP_H
#define FRACAS_CAMPAIGNS_FILE_SWEEP_H

#include "campaigns/file/replicas.h"
#include "campaigns/file/setting.h"

/* The resolved file of this many points stays within the limits of fracas_node_read. */
#define FRACAS_MAX_POINTS 10000

/* One value of an axis: its settings, and, in `cases`, its name and replicas. */
typedef struct {
    const fracas_node *node;
    fracas_settings settings;
    const char *name;         /* NULL: none */
    fracas_replicas replicas; /* count 0: those of the campaign */
} fracas_choice;

typedef struct {
    size_t nchoices;
    fracas_choice *choice;
} fracas_axis;

typedef struct {
    size_t naxes;
    fracas_axis *axis; /* in file order, the last one fastest */
    size_t npoints;    /* product of the numbers of choices, 1 without axes */
} fracas_sweep;

/* Reads the list `node` (NULL: no sweep) and converts every value. No leaf may be in two axes.
 * Errors are noted; a wrong axis has wrong settings for all that it names. */
FRACAS_MUST_USE fracas_err fracas_sweep_read(const fracas_file *file, const fracas_node *node,
                                             fracas_sweep *sweep);

/* The choice of point `point` in axis `axis`. */
const fracas_choice *fracas_sweep_choice(const fracas_sweep *sweep, size_t point, size_t axis);

/* Target of a path of the sweep: one value of a point, or a section of values. */
typedef struct {
    const fracas_file_section *section; /* a whole section ... */
    const fracas_leaf *leaf;            /* ... or one leaf */
} fracas_target;

/* Finds the target of the path that is the key of `entry`, a part of a point. `also`: other words
 * allowed in its place, a list up to NULL. */
FRACAS_MUST_USE fracas_err fracas_target_find(const fracas_file *file, const fracas_node *entry,
                                              const char *const *also, fracas_target *found);

#endif
