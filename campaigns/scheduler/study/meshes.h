/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The meshes of a campaign's surfaces, for its study. */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_STUDY_MESHES_H
#define FRACAS_CAMPAIGNS_SCHEDULER_STUDY_MESHES_H

#include "campaigns/campaign.h"
#include "campaigns/store/mesh.h"

/* Each is that of the engine's model of the point, built anew. `campaign` must outlive it. */
fracas_mesh_source fracas_campaign_meshes(const fracas_campaign *campaign);

#endif
