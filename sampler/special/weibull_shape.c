/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/special/weibull_shape.h"

#include "base/elementary.h"

#include <stddef.h>

/* (distributions.3) For small x the two gamma functions would cancel: there by the series of
 * ln Gamma(1 + 2x) - 2 ln Gamma(1 + x). */
double fracas_weibull_variation(double x)
{
    static const double c[29] = {
        /* (-1)^k zeta(k) (2^k - 2)/k, k = 2 ... 30: at x = 1/8 the next term is 2^-61 of the sum */
        0x1.a51a6625307d3p+0,   -0x1.33ba004f00621p+1,  0x1.e4e17caddba7ep+1,
        -0x1.8e2e2562fbb35p+2,  0x1.5066c4b78bceep+3,   -0x1.2267935576920p+4,
        0x1.fe1240844e59fp+4,   -0x1.c63e69fcea837p+5,  0x1.9934e294130dfp+6,
        -0x1.742f1004881a4p+7,  0x1.554028d77d73dp+8,   -0x1.3b09e546539bfp+9,
        0x1.248dbacc24acfp+10,  -0x1.110ef02a16226p+11, 0x1.fffe00c59a431p+11,
        -0x1.e1e0f12f1599ep+12, 0x1.c71c001399708p+13,  -0x1.af2835eb401cbp+14,
        0x1.99998001f6f50p+15,  -0x1.86185555f5208p+16, 0x1.745d11748ff6dp+17,
        -0x1.642c82c869456p+18, 0x1.55555400052f8p+19,  -0x1.47ae13d70be66p+20,
        0x1.3b13b0ec4f4d2p+21,  -0x1.2f684bb42618cp+22, 0x1.249249124932ap+23,
        -0x1.1a7b9608d3e13p+24, 0x1.1111110cccce4p+25,
    };
    if (x > 0.125) {
        const double mean = fracas_gamma(1.0 + x);
        return fracas_gamma(1.0 + 2.0 * x) / (mean * mean) - 1.0;
    }
    double sum = c[28];
    for (size_t k = 28; k-- > 0;) sum = sum * x + c[k];
    return fracas_expm1(x * x * sum);
}

/* (distributions.4) It grows with x: halving the interval cannot fail, and 80 gamma functions,
 * once, cost nothing. */
double fracas_weibull_shape_inverse(double variation, double least, double most)
{
    for (;;) {
        const double middle = 0.5 * (least + most);
        if (middle <= least || middle >= most) return middle;
        if (fracas_weibull_variation(middle) < variation) least = middle;
        else most = middle;
    }
}
