/* SPDX-License-Identifier: GPL-3.0-or-later */
/* `design: {type, points, parameters, correlation}`: an axis of the sweep whose values are drawn.
 */
#ifndef FRACAS_CAMPAIGNS_FILE_DESIGN_H
#define FRACAS_CAMPAIGNS_FILE_DESIGN_H

#include "campaigns/file/sweep.h"

/* Reads the map `node` and draws its values: a choice of the axis for each point, in SI, rounded to
 * 15 digits, or to a whole number if the leaf is one. Random numbers depend on the campaign's seed
 * and the paths of the parameters. Does not check ranges, which may depend on the kind. */
FRACAS_MUST_USE fracas_err fracas_design_read(const fracas_file *file, const fracas_node *node,
                                              fracas_axis *axis);

#endif
