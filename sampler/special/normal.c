/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The normal quantile by rational approximation: AS 241, PPND16 (Wichura 1988); the normal tail by
 * a Chebyshev series in (z - 7)/(z + 7), after Shepherd and Laframboise (Math. Comp. 36, 249-253,
 * 1981). */
#include "sampler/special/normal.h"

#include "base/elementary.h"
#include "sampler/special/normal_terms.h"

#include <math.h>

/* (n[0] + ... + n[7] x^7)/(1 + d[1] x + ... + d[7] x^7) */
static double ratio(const double n[8], const double d[8], double x)
{
    double above = n[7], below = d[7];
    for (int i = 6; i >= 0; i--) {
        above = above * x + n[i];
        below = below * x + d[i];
    }
    return above / below;
}

/* (sampling.9) */
double fracas_normal_quantile(fracas_probability p)
{
    double q = p.below <= 0.5 ? p.below - 0.5 : 0.5 - p.above;
    if (fabs(q) <= 0.425) return q * ratio(normal_a, normal_b, 0.180625 - q * q);
    double r = sqrt(-fracas_log(q < 0.0 ? p.below : p.above));
    double z = r <= 5.0 ? ratio(normal_c, normal_d, r - 1.6) : ratio(normal_e, normal_f, r - 5.0);
    return q < 0.0 ? -z : z;
}

/* c[0]/2 T_0(t) + c[1] T_1(t) + ... + c[n-1] T_(n-1)(t) by Clenshaw's recurrence. */
static double chebyshev(const double *c, int n, double t)
{
    double next = 0.0, after = 0.0;
    for (int i = n - 1; i > 0; i--) {
        double here = 2.0 * t * next - after + c[i];
        after = next;
        next = here;
    }
    return t * next - after + 0.5 * c[0];
}

/* e^(-z^2/2): z is cut to 1/16, which makes its square exact; only the small rest is rounded. */
static double bell(double z)
{
    double cut = floor(z * 16.0) * 0.0625;
    return fracas_exp(-0.5 * cut * cut) * fracas_exp(-0.5 * (z - cut) * (z + cut));
}

/* (sampling.17) */
double fracas_normal_upper(double z)
{
    static const double c[25] = {
        /* (1 + z) e^(z^2/2) P(Z > z) in z >= 0: 2^-58 */
        0x1.d36deea4cdb3ap-1,   -0x1.0bc4418d1b038p-4,  0x1.7c0238fbf603bp-9,
        0x1.48c7bf2e330fbp-7,   -0x1.05865b53da31bp-7,  0x1.10421b3f77222p-8,
        -0x1.c4b5596594d1ep-10, 0x1.3dceb05f4176dp-11,  -0x1.801a5ebde5c1ep-13,
        0x1.90bbc2cd1df84p-15,  -0x1.655ecff672d18p-17, 0x1.0944533351bfap-19,
        -0x1.33e822d9ab7eep-22, 0x1.cd1e1ffa7b2d9p-26,  0x1.112080ca7e8fep-33,
        -0x1.40c0faf572e1dp-31, 0x1.c02c0eee4906fp-34,  -0x1.044e9576dd1a2p-38,
        -0x1.039ff560a7a2ep-39, 0x1.922c2afe8449ap-42,  -0x1.95e171c73080fp-51,
        -0x1.509b32d805146p-47, 0x1.3a5472cc91c1dp-50,  0x1.52b9c4b656065p-53,
        -0x1.a636d34e0e5d9p-55,
    };
    double size = fabs(z);
    if (size > 40.0) return z > 0.0 ? 0.0 : 1.0; /* below the smallest double */
    double tail = bell(size) * chebyshev(c, 25, (size - 7.0) / (size + 7.0)) / (1.0 + size);
    return z < 0.0 ? 1.0 - tail : tail;
}

/* (distributions.14) P(Z > z) = density(z)/hazard(z), the hazard a continued fraction: z + 1/(z +
 * 2/(z + 3/(z + ...))), z > 34. Newton on ln P, whose slope is minus the hazard. */
double fracas_normal_far(double t)
{
    const double ln_sqrt_two_pi = 0x1.d67f1c864beb4p-1;
    double z = sqrt(2.0 * t);
    for (int i = 0; i < 4; i++) { /* error below 0.2 at z > 34: at each step squared, over z */
        double hazard = z;
        for (double n = 8.0; n > 0.0; n -= 1.0) hazard = z + n / hazard;
        z -= (0.5 * z * z + ln_sqrt_two_pi + fracas_log(hazard) - t) / hazard;
    }
    return z;
}
