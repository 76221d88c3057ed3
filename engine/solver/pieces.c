/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/pieces.h"

#include <stdlib.h>
#include <string.h>

fracas_err fracas_pieces_find(const fracas_model *model, fracas_step *step, int lane,
                              fracas_motion kind, fracas_pieces *pieces)
{
    const fracas_formulation *body = model->formulation;
    const bool whole_velocity = kind == FRACAS_MOTION_RIGID && body->background;
    const double background = whole_velocity ? body->background(model, step->time[lane]) : 0;
    const size_t count = body->partition(model, step, lane);
    *pieces = (fracas_pieces){.count = count,
                              .motion = malloc(count * sizeof *pieces->motion),
                              .beside = calloc(count, sizeof *pieces->beside)};
    if (!pieces->motion || !pieces->beside) return fracas_no_memory("the motion of fragments");
    body->add_up(model, step, lane, NULL, pieces->beside);
    for (size_t f = 0; f < count; f++) {
        pieces->motion[f] = fracas_fragment_motion_of(&pieces->beside[f], kind);
        pieces->motion[f].gradient[0][0] -= background;
    }
    memset(pieces->beside, 0, count * sizeof *pieces->beside);
    body->add_up(model, step, lane, pieces->motion, pieces->beside);
    return FRACAS_OK;
}

void fracas_pieces_clear(fracas_pieces *pieces)
{
    free(pieces->motion);
    free(pieces->beside);
    *pieces = (fracas_pieces){0};
}
