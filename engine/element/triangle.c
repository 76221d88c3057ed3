/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/element/triangle.h"

/* (membrane.1) */
void fracas_triangle_shape(int order, double xi, double eta, double *value, double (*derivative)[2])
{
    static const double slope[3][2] = {{-1, -1}, {1, 0}, {0, 1}};
    const double l[3] = {1 - xi - eta, xi, eta};
    for (int k = 0; k < 3; k++) {
        const int next = (k + 1) % 3;
        value[k] = order == 1 ? l[k] : l[k] * (2 * l[k] - 1);
        if (order == 2) value[3 + k] = 4 * l[k] * l[next];
        for (int i = 0; i < 2; i++) {
            derivative[k][i] = order == 1 ? slope[k][i] : (4 * l[k] - 1) * slope[k][i];
            if (order == 2)
                derivative[3 + k][i] = 4 * (l[k] * slope[next][i] + l[next] * slope[k][i]);
        }
    }
}

#define A1 0.24928674517091042
#define B1 0.50142650965817915
#define A2 0.063089014491502227
#define B2 0.87382197101699554
#define C1 0.053145049844816947
#define C2 0.31035245103378440
#define C3 0.63650249912139864
#define W1 0.058393137863189684
#define W2 0.025422453185103409
#define W3 0.041425537809186788
const double fracas_triangle_fine[FRACAS_TRIANGLE_FINE][3] = {
    {A1, A1, W1}, {A1, B1, W1}, {B1, A1, W1}, {A2, A2, W2}, {A2, B2, W2}, {B2, A2, W2},
    {C1, C2, W3}, {C2, C1, W3}, {C1, C3, W3}, {C3, C1, W3}, {C2, C3, W3}, {C3, C2, W3},
};
