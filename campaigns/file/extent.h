/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The extent of an interface of a point, before there is a model. */
#ifndef FRACAS_CAMPAIGNS_FILE_EXTENT_H
#define FRACAS_CAMPAIGNS_FILE_EXTENT_H

#include "campaigns/campaign.h"

/* The latest mesh made for it; all zero: none. */
typedef struct {
    const fracas_spec *spec; /* must outlive it */
    fracas_extent extent;
} fracas_known_extent;

/* known->extent = extent of the point's mean interface. Makes the mesh, a slow step, only if the
 * point's strength has a size effect and its mesh differs from the last one. Errors as
 * fracas_mesh_interface_extent. */
FRACAS_MUST_USE fracas_err fracas_extent_find(const fracas_point *point,
                                              fracas_known_extent *known);

#endif
