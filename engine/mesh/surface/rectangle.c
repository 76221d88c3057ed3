/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Squares cut in two along alternating diagonals. */
#include "base/own.h"
#include "engine/mesh/surface/parts.h"

#include <math.h>

void fracas_surface_fill_grid(fracas_surface_draft *draft, size_t nx, size_t ny, bool closed)
{
    const size_t row = closed ? nx : nx + 1;
    const uint32_t up = (uint32_t)row, top = (uint32_t)(row * ny);
    uint32_t *put = draft->element;
    for (size_t j = 0; j < ny; j++)
        for (size_t i = 0; i < nx; i++) {
            /* Round the square; odd squares start a corner later, so that their diagonal is the
             * other one. */
            const uint32_t a = (uint32_t)(row * j + i), b = (uint32_t)(row * j + (i + 1) % row);
            const uint32_t corner[4] = {a, b, b + up, a + up};
            const size_t turn = (i + j) % 2;
            for (size_t half = 0; half < 2; half++)
                for (size_t k = 0; k < 3; k++) *put++ = corner[(turn + 2 * half + k) % 4];
        }
    fracas_surface_tag *tag = draft->tag;
    for (uint32_t i = 0; i < nx; i++) {
        const uint32_t next = (i + 1) % up;
        *tag++ = (fracas_surface_tag){.node = {i, next}, .tag = 3};
        *tag++ = (fracas_surface_tag){.node = {top + i, top + next}, .tag = 4};
    }
    for (uint32_t j = 0; j < ny && !closed; j++) {
        const uint32_t left = up * j;
        *tag++ = (fracas_surface_tag){.node = {left, left + up}, .tag = 1};
        *tag++ = (fracas_surface_tag){.node = {left + (uint32_t)nx, left + (uint32_t)nx + up},
                                      .tag = 2};
    }
}

static void place(fracas_surface_draft *draft, double width, double height, size_t nx, size_t ny)
{
    for (size_t j = 0; j <= ny; j++)
        for (size_t i = 0; i <= nx; i++) {
            double *node = draft->node[(nx + 1) * j + i];
            node[0] = width * ((double)i / (double)nx - 0.5);
            node[1] = height * ((double)j / (double)ny - 0.5);
            node[2] = 0.0;
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
    TRY(fracas_surface_divide(fineness, shorter, FRACAS_SURFACE_LEG, &few));
    const double many = floor(longer * (few / shorter) + 0.5);
    const double nx = width < height ? few : many, ny = width < height ? many : few;
    FRACAS_CLEARED(fracas_surface_draft) draft = {0};
    TRY(fracas_surface_draft_init(&draft, (nx + 1.0) * (ny + 1.0), 2.0 * nx * ny, 2.0 * (nx + ny)));
    place(&draft, width, height, (size_t)nx, (size_t)ny);
    fracas_surface_fill_grid(&draft, (size_t)nx, (size_t)ny, false);
    return fracas_surface_draft_finish(&draft, fineness, surface);
}
