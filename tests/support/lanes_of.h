/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lanes from a field of one struct a lane, and back; for units of kernels, after their headers. */
#ifndef FRACAS_TESTS_LANES_OF_H
#define FRACAS_TESTS_LANES_OF_H

/* Lane l of one field, `step` bytes apart. */
LANES_FUNCTION vd gathered(const double *first, size_t step)
{
    _Alignas(64) double lanes[LANES];
    for (int l = 0; l < LANES; l++) lanes[l] = *(const double *)((const char *)first + l * step);
    return lanes_load(lanes);
}

LANES_FUNCTION void scatter(double *first, size_t step, vd from)
{
    _Alignas(64) double lanes[LANES];
    lanes_store(lanes, from);
    for (int l = 0; l < LANES; l++) *(double *)((char *)first + l * step) = lanes[l];
}

#endif
