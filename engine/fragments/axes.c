/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/axes.h"

#include <math.h>

enum { SWEEPS = 10 }; /* each squares the rest beside the diagonal: six are enough for 3 x 3 */

void fracas_axes_find(double a[3][3], double axis[3][3])
{
    for (int i = 0; i < 9; i++) axis[i / 3][i % 3] = i % 4 == 0;
    for (int turn = 0; turn < 3 * SWEEPS; turn++) {
        const int p = turn % 3, q = (p + 1) % 3;
        if (a[p][q] == 0) continue;
        const double slope = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double tangent = (slope < 0 ? -1 : 1) / (fabs(slope) + sqrt(slope * slope + 1));
        const double cosine = 1 / sqrt(tangent * tangent + 1), sine = tangent * cosine;
        for (int k = 0; k < 3; k++) {
            const double left = a[k][p], right = a[k][q], first = axis[k][p], second = axis[k][q];
            a[k][p] = cosine * left - sine * right;
            a[k][q] = sine * left + cosine * right;
            axis[k][p] = cosine * first - sine * second;
            axis[k][q] = sine * first + cosine * second;
        }
        for (int k = 0; k < 3; k++) {
            const double left = a[p][k], right = a[q][k];
            a[p][k] = cosine * left - sine * right;
            a[q][k] = sine * left + cosine * right;
        }
        a[p][q] = a[q][p] = 0;
    }
}
