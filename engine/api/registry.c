/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The registry: every section of a campaign file that the engine understands, and the kinds it can
 * name. */
#include "engine/spec.h"

#include "engine/cohesive/law.h"
#include "engine/formulation/formulation.h"
#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/material/elastic.h"
#include "engine/mesh/body.h"
#include "engine/mesh/notch.h"
#include "engine/solver/stop.h"

static const fracas_kind *const formulations[] = {
    &fracas_formulation_bar.kind, &fracas_formulation_ring.kind, &fracas_formulation_membrane.kind,
    &fracas_formulation_shell.kind};
static const fracas_section formulation_section = {
    .name = "model",
    .doc = "What is broken up",
    FRACAS_KINDS(formulations),
    .kind_offset = 0,
    .offset = offsetof(fracas_spec, formulation),
    .hashed = true,
};

const fracas_section *const fracas_engine_sections[] = {
    &formulation_section,        &fracas_geometry_section,    &fracas_mesh_section,
    &fracas_material_section,    &fracas_cohesive_section,    &fracas_notch_section,
    &fracas_initial_section,     &fracas_loading_sections[0], &fracas_loading_sections[1],
    &fracas_loading_sections[2], &fracas_time_section,
};
const size_t fracas_engine_nsections = FRACAS_COUNT(fracas_engine_sections);
