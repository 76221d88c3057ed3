/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/special/student.h"

#include "base/elementary.h"
#include "sampler/special/normal.h"

#include <math.h>
#include <stdbool.h>

/* Above it the expansion about the normal distribution is as good as the sum, and shorter. */
enum { NU_SUM = 1000 };

/* (sequential.4) */
double fracas_student_within(double x, int64_t nu)
{
    const double c = fracas_cospi(x), s = fracas_sinpi(x), c2 = c * c;
    const bool odd = nu % 2 == 1;
    double term = odd ? c : 1, sum = 0;
    for (int64_t k = odd ? 3 : 2; k <= nu; k += 2) {
        sum += term;
        term *= (double)(k - 1) / (double)k * c2;
    }
    return odd ? 2 * x + 2 / M_PI * s * sum : s * sum;
}

/* t = z + g1(z)/nu + g2(z)/nu^2 + ...  (sequential.5) */
static double expand(double z, double nu)
{
    const double w = z * z;
    const double g1 = (w + 1) / 4;
    const double g2 = ((5 * w + 16) * w + 3) / 96;
    const double g3 = (((3 * w + 19) * w + 17) * w - 15) / 384;
    const double g4 = ((((79 * w + 776) * w + 1482) * w - 1920) * w - 945) / 92160;
    return z * (1 + (g1 + (g2 + (g3 + g4 / nu) / nu) / nu) / nu);
}

double fracas_student_quantile(double confidence, int64_t nu)
{
    if (!(confidence > 0 && confidence < 1) || nu < 1) return NAN;
    if (nu > NU_SUM) {
        const double above = (1 - confidence) / 2;
        return expand(-fracas_normal_quantile((fracas_probability){above, 1 - above}), (double)nu);
    }
    double low = 0, high = 0.5; /* bounds of the x sought: halved until no double lies between */
    for (double x; (x = low + (high - low) / 2) > low && x < high;) {
        if (fracas_student_within(x, nu) < confidence) low = x;
        else high = x;
    }
    return sqrt((double)nu) * fracas_sinpi(high) / fracas_cospi(high);
}
