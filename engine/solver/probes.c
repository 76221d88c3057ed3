/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/probes.h"

#include <stdlib.h>
#include <string.h>

fracas_err fracas_spots_find(const fracas_model *model, const fracas_probes *probes,
                             fracas_spots *spots)
{
    spots->count = probes->count;
    for (size_t p = 0; p < probes->count; p++) {
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

fracas_err fracas_model_check_probes(const fracas_model *model, const fracas_probes *probes)
{
    fracas_spots spots;
    return fracas_spots_find(model, probes, &spots);
}

void fracas_spots_look(const fracas_spots *spots, const fracas_model *model,
                       const fracas_step *step, int lane, double value[FRACAS_SPOTS_VALUES])
{
    for (size_t p = 0; p < spots->count; p++, value += FRACAS_SPOT_VALUES)
        model->formulation->motion_at(model, step, lane, &spots->spot[p], value, value + 3);
}

fracas_err fracas_spots_take(const fracas_spots *spots, const double *value, fracas_record *record)
{
    const size_t count = spots->count;
    if (count == 0) return FRACAS_OK;
    record->probe = malloc(record->nhistory * count * sizeof *record->probe);
    if (!record->probe) return fracas_no_memory("the probes of a realization");
    for (size_t i = 0; i < record->nhistory; i++)
        for (size_t p = 0; p < count; p++, value += FRACAS_SPOT_VALUES) {
            fracas_probe_row *row = &record->probe[record->nprobe++];
            *row = (fracas_probe_row){.time = record->history[i].time, .probe = (int64_t)p};
            memcpy(row->displacement, value, sizeof row->displacement);
            memcpy(row->velocity, value + 3, sizeof row->velocity);
        }
    return FRACAS_OK;
}
