/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Squares cut in two along alternating diagonals. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

#define LEG 0.93060485910209960 /* sqrt(sqrt(3)/2): half a square's leg by its triangle's edge */

static void fill(fracas_surface_draft *draft, double width, double height, size_t nx, size_t ny)
{
    const size_t row = nx + 1;
    for (size_t j = 0; j <= ny; j++)
        for (size_t i = 0; i <= nx; i++) {
            double *node = draft->node[row * j + i];
            node[0] = width * ((double)i / (double)nx - 0.5);
            node[1] = height * ((double)j / (double)ny - 0.5);
            node[2] = 0.0;
        }
    uint32_t *put = draft->element;
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0; i < nx; i++) {
            /* Round the square; odd squares start a corner later, so that their diagonal is the
             * other one. */
            const uint32_t a = (uint32_t)(row * j + i), up = (uint32_t)row;
            const uint32_t corner[4] = {a, a + 1, a + up + 1, a + up};
            const size_t turn = (i + j) % 2;
            for (size_t half = 0; half < 2; half++)
                for (size_t k = 0; k < 3; k++) *put++ = corner[(turn + 2 * half + k) % 4];
        }
    fracas_surface_tag *tag = draft->tag;
    const uint32_t top = (uint32_t)(row * ny);
    for (uint32_t i = 0; i < nx; i++) {
        *tag++ = (fracas_surface_tag){.node = {i, i + 1}, .tag = 3};
        *tag++ = (fracas_surface_tag){.node = {top + i, top + i + 1}, .tag = 4};
    }
    for (uint32_t j = 0; j < ny; j++) {
        const uint32_t left = (uint32_t)(row * j), up = (uint32_t)row;
        *tag++ = (fracas_surface_tag){.node = {left, left + up}, .tag = 1};
        *tag++ = (fracas_surface_tag){.node = {left + (uint32_t)nx, left + (uint32_t)nx + up},
                                      .tag = 2};
    }
}

fracas_err fracas_surface_rectangle(double width, double height,
                                    const fracas_surface_fineness *fineness,
                                    const fracas_surface **surface)
{
    TRY(fracas_surface_check_length("the width", width));
    TRY(fracas_surface_check_length("the height", height));
    const double shorter = fmin(width, height), longer = fmax(width, height);
    double few;
    TRY(fracas_surface_divide(fineness, shorter, LEG, &few));
    const double many = floor(longer * (few / shorter) + 0.5);
    const double nx = width < height ? few : many, ny = width < height ? many : few;
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(fracas_surface_draft_init(&draft, (nx + 1.0) * (ny + 1.0), 2.0 * nx * ny, 2.0 * (nx + ny)));
    fill(&draft, width, height, (size_t)nx, (size_t)ny);
    return fracas_surface_draft_finish(&draft, fineness, surface);
}
