/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/probes.h"

#include <stdlib.h>
#include <string.h>

static fracas_err find_edges(const fracas_model *model, fracas_spots *spots)
{
    const fracas_formulation *body = model->formulation;
    spots->edges = body->held_edges ? body->held_edges(model, spots->edge) : 0;
    if (spots->edges > 0) return FRACAS_OK;
    return fracas_fail(
        FRACAS_USAGE,
        "output.reactions asks for the forces of held edges and nodes, but %s; leave it out%s",
        body->held_edges ? "none is held" : "surfaces alone have edges",
        body->held_edges ? ", or hold one" : "");
}

fracas_err fracas_spots_find(const fracas_model *model, const fracas_probes *probes, bool reactions,
                             fracas_spots *spots)
{
    *spots = (fracas_spots){.count = probes ? probes->count : 0};
    if (reactions) TRY(find_edges(model, spots));
    for (size_t p = 0; p < spots->count; p++) {
        const fracas_probe *probe = &probes->probe[p];
        fracas_spot *spot = &spots->spot[p];
        model->formulation->locate(model, probe->place, spot);
        if (spot->distance <= model->element_size) continue;
        return fracas_fail(FRACAS_USAGE,
                           "probe %s at (%.6g, %.6g, %.6g) m is %.3g m away from the body, whose "
                           "nearest point is (%.6g, %.6g, %.6g) m; elements are %.3g m long: move "
                           "it there",
                           probe->name, probe->place[0], probe->place[1], probe->place[2],
                           spot->distance, spot->place[0], spot->place[1], spot->place[2],
                           model->element_size);
    }
    return FRACAS_OK;
}

fracas_err fracas_model_check_probes(const fracas_model *model, const fracas_probes *probes,
                                     bool reactions)
{
    fracas_spots spots;
    return fracas_spots_find(model, probes, reactions, &spots);
}

void fracas_spots_look(const fracas_spots *spots, const fracas_model *model,
                       const fracas_step *step, int lane, double value[FRACAS_SPOTS_VALUES])
{
    for (size_t p = 0; p < spots->count; p++, value += FRACAS_SPOT_VALUES)
        model->formulation->motion_at(model, step, lane, &spots->spot[p], value, value + 3);
    double force[FRACAS_HOLDERS][3];
    if (spots->edges == 0) return;
    model->formulation->reactions(model, step, lane, force);
    memcpy(value, force, spots->edges * sizeof *force);
}

fracas_err fracas_spots_take(const fracas_spots *spots, const double *value, fracas_record *record)
{
    const size_t rows = record->nhistory;
    if (spots->count > 0) record->probe = malloc(rows * spots->count * sizeof *record->probe);
    if (spots->edges > 0) record->reaction = malloc(rows * spots->edges * sizeof *record->reaction);
    if ((spots->count > 0 && !record->probe) || (spots->edges > 0 && !record->reaction))
        return fracas_no_memory("the probes of a realization");
    for (size_t i = 0; i < rows; i++) {
        const double time = record->history[i].time;
        for (size_t p = 0; p < spots->count; p++, value += FRACAS_SPOT_VALUES) {
            fracas_probe_row *row = &record->probe[record->nprobe++];
            *row = (fracas_probe_row){.time = time, .probe = (int64_t)p};
            memcpy(row->displacement, value, sizeof row->displacement);
            memcpy(row->velocity, value + 3, sizeof row->velocity);
        }
        for (size_t n = 0; n < spots->edges; n++, value += 3) {
            fracas_reaction_row *row = &record->reaction[record->nreaction++];
            *row = (fracas_reaction_row){.time = time, .edge = spots->edge[n]};
            memcpy(row->force, value, sizeof row->force);
        }
    }
    return FRACAS_OK;
}
