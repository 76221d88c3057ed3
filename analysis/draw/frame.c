/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/frame.h"

#include <math.h>

static const double tallest =
    1.3; /* height of the surface as drawn / width of the picture, at most */

void fracas_frame_fit(const double least[2], const double largest[2], int width,
                      fracas_frame *frame)
{
    const double room = width - 2 * FRACAS_FRAME_MARGIN,
                 extent[2] = {largest[0] - least[0], largest[1] - least[1]};
    frame->scale = fmin(room / extent[0], tallest * width / extent[1]);
    frame->width = extent[0] * frame->scale;
    frame->height = extent[1] * frame->scale;
    frame->left = (width - frame->width) / 2;
    frame->corner[0] = least[0];
    frame->corner[1] = largest[1];
}

fracas_spot fracas_frame_place(const fracas_frame *frame, const double *at)
{
    const double x = frame->left + (at[0] - frame->corner[0]) * frame->scale;
    const double y = FRACAS_FRAME_MARGIN + (frame->corner[1] - at[1]) * frame->scale;
    return (fracas_spot){(int32_t)lround(FRACAS_FRAME_UNITS * x),
                         (int32_t)lround(FRACAS_FRAME_UNITS * y)};
}
