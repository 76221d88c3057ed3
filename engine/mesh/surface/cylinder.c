/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A rectangle of squares cut in two, bent around the y axis. */
#include "engine/mesh/surface/cylinder.h"

#include "base/elementary.h"
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

typedef struct {
    double radius, length;   /* the part's */
    double begin, low;       /* least angle from z to x [pi], least y */
    double quarters, around; /* quarters of the circle, squares along each */
    double along;
} cylinder;

/* (meshes.6) */
static void bend(const cylinder *body, size_t row, double (*node)[3])
{
    for (size_t j = 0; j <= (size_t)body->along; j++)
        for (size_t i = 0; i < row; i++, node++) {
            const double angle = body->begin + (double)i / (2.0 * body->around);
            (*node)[0] = body->radius * fracas_sinpi(angle);
            (*node)[1] = body->low + body->length * ((double)j / body->along);
            (*node)[2] = body->radius * fracas_cospi(angle) + 0.0; /* 0 is none of -0 */
        }
}

static fracas_err divide(const fracas_surface_fineness *fineness, cylinder *body)
{
    const double quarter = 0.5 * FRACAS_PI * body->radius;
    const double shorter = fmin(quarter, body->length), longer = fmax(quarter, body->length);
    double few;
    TRY(fracas_surface_divide(fineness, shorter, FRACAS_SURFACE_LEG, &few));
    const double many = floor(longer * (few / shorter) + 0.5);
    body->around = quarter < body->length ? few : many;
    body->along = quarter < body->length ? many : few;
    return FRACAS_OK;
}

fracas_err fracas_surface_cylinder(double radius, double length, int planes,
                                   const fracas_surface_fineness *fineness,
                                   const fracas_surface **surface)
{
    TRY(fracas_surface_check_length("the radius", radius));
    TRY(fracas_surface_check_length("the length", length));
    const bool closed = planes == 0;
    cylinder body = {.radius = radius,
                     .length = planes < 3 ? length : 0.5 * length,
                     .begin = planes == 1 ? -0.5 : 0.0,
                     .low = planes < 3 ? -0.5 * length : 0.0,
                     .quarters = planes == 0   ? 4.0
                                 : planes == 1 ? 2.0
                                               : 1.0};
    TRY(divide(fineness, &body));
    const double columns = body.quarters * body.around, row = closed ? columns : columns + 1.0;
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(fracas_surface_draft_init(&draft, row * (body.along + 1.0), 2.0 * columns * body.along,
                                  2.0 * columns + (closed ? 0.0 : 2.0 * body.along)));
    draft.round = radius;
    draft.axis = INFINITY;
    for (int t = 0; t < FRACAS_SURFACE_TAGS; t++) draft.radius[t] = radius;
    bend(&body, (size_t)row, draft.node);
    fracas_surface_fill_grid(&draft, (size_t)columns, (size_t)body.along, closed);
    return fracas_surface_draft_finish(&draft, fineness, surface);
}
