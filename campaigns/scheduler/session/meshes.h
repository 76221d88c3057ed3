/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Meshes of a campaign's surfaces, for study.h5. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_SESSION_MESHES_H
#define FRACAS_CAMPAIGNS_SCHEDULER_SESSION_MESHES_H

#include "campaigns/campaign.h"
#include "campaigns/store/mesh.h"

/* Builds the engine's model of a point for its mesh. `campaign` must outlive it. */
fracas_mesh_source fracas_campaign_meshes(const fracas_campaign *campaign);

#endif
