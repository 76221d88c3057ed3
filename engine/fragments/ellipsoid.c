/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/ellipsoid.h"

#include "engine/fragments/axes.h"

#include <math.h>
#include <string.h>

/* Row and column of each of the six second moments. */
static const int row_of[6] = {0, 1, 2, 1, 2, 0}, column_of[6] = {0, 1, 2, 2, 0, 1};

void fracas_fragment_matter_add(fracas_fragment_matter *matter, double mass, const double x[3],
                                const double spread[6])
{
    double y[3];
    if (!matter->started) memcpy(matter->origin, x, sizeof matter->origin);
    matter->started = 1;
    matter->mass += mass;
    for (int i = 0; i < 3; i++) {
        y[i] = x[i] - matter->origin[i];
        matter->first[i] += mass * y[i];
    }
    for (int s = 0; s < 6; s++)
        matter->second[s] += mass * y[row_of[s]] * y[column_of[s]] + spread[s];
}

void fracas_fragment_spread(const double d[3], double along, double across, double spread[6])
{
    for (int s = 0; s < 6; s++)
        spread[s] = (along - across) * d[row_of[s]] * d[column_of[s]] + (s < 3 ? across : 0);
}

/* +1 or -1, by which its largest component becomes positive. */
static double sign_of(const double axis[3][3], int a)
{
    int largest = 0;
    for (int i = 1; i < 3; i++)
        if (fabs(axis[i][a]) > fabs(axis[largest][a])) largest = i;
    return axis[largest][a] < 0 ? -1 : 1;
}

/* (fragments.7) */
void fracas_fragment_set_ellipsoid(const fracas_fragment_matter *matter, fracas_fragment *fragment)
{
    double moment[3][3], axis[3][3], total = 0;
    for (int s = 0; s < 6; s++) {
        const int i = row_of[s], j = column_of[s];
        moment[i][j] = moment[j][i] = matter->second[s] -
                                      matter->first[i] * matter->first[j] / matter->mass;
        total += moment[i][j];
    }
    for (int i = 0; i < 9; i++) fragment->axis[i / 3][i % 3] = NAN;
    for (int a = 0; a < 3; a++) fragment->semi_axis[a] = NAN;
    if (!isfinite(total)) return;
    fracas_axes_find(moment, axis);
    int order[3] = {0, 1, 2};
    for (int pass = 0; pass < 3; pass++) /* equal ones stay in their order */
        for (int a = pass % 2; a < 2; a += 2)
            if (moment[order[a]][order[a]] < moment[order[a + 1]][order[a + 1]]) {
                const int other = order[a];
                order[a] = order[a + 1];
                order[a + 1] = other;
            }
    double(*to)[3] = fragment->axis;
    for (int a = 0; a < 3; a++) {
        fragment->semi_axis[a] = sqrt(5 * fmax(moment[order[a]][order[a]], 0) / matter->mass);
        const double sign = sign_of((const double(*)[3])axis, order[a]);
        for (int i = 0; i < 3; i++) to[a][i] = sign * axis[i][order[a]];
    }
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        to[2][i] = to[0][j] * to[1][k] - to[0][k] * to[1][j];
    }
}
