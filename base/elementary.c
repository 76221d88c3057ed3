/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Own elementary functions: + - * / and integer operations in a fixed order, few branches, no
 * tables. Each can be written over lanes as it stands; log and exp are, in base/elementary_lanes.h.
 * Coefficients interpolate in Chebyshev points, computed with 90 digits. The error of each
 * polynomial stands beside it, relative to the function it serves. */
#include "base/elementary.h"

#include "base/elementary_terms.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static inline uint64_t bits_of(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double double_of(uint64_t bits)
{
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* c[0] + c[1] x + c[2] x^2 + c[3] x^3 */
static inline double poly4(const double *c, double x)
{
    return (c[0] + c[1] * x) + (x * x) * (c[2] + c[3] * x);
}

/* c[0] + ... + c[7] x^7 */
static inline double poly8(const double *c, double x)
{
    double x2 = x * x;
    return poly4(c, x) + (x2 * x2) * poly4(c + 4, x);
}

/* x = 2^k m with sqrt(1/2) <= m < sqrt(2), for finite x > 0. */
static inline double split_exponent(double x, double *k)
{
    double shift = x < DBL_MIN ? 54.0 : 0.0;
    uint64_t bits = bits_of(x < DBL_MIN ? x * 0x1p54 : x);
    int64_t exponent = (int64_t)(bits - sqrt_half) >> 52;
    *k = (double)exponent - shift;
    return double_of(bits - ((uint64_t)exponent << 52));
}

/* (sampling.11) ln x = k ln 2 + ln(1 + f). With s = f/(2 + f), ln(1 + f) = 2 artanh s = 2 s + s
 * R(s^2); as 2 s = f - s f and s (f + f^2/2) = f^2/2 this is f - (f^2/2 - s (f^2/2 + R)), where f
 * is exact and only the small rest is rounded before the last sum. */
double fracas_log(double x)
{
    if (!(x > 0.0 && x < INFINITY)) return x == 0.0 ? -INFINITY : x < 0.0 ? NAN : x;
    double k;
    double f = split_exponent(x, &k) - 1.0;
    double s = f / (2.0 + f);
    double z = s * s;
    double half_square = 0.5 * f * f;
    return k * ln2_hi -
           ((half_square - (s * (half_square + z * poly8(log_rest, z)) + k * ln2_lo)) - f);
}

/* (sampling.12) e^(hi + lo) for |lo| << |hi|. hi = k ln 2 + r (Cody and Waite), e^r = 1 + r + r^2
 * P(r), times 2^k in two steps because k is outside the range of exponents when the result is
 * subnormal or near the largest double. */
static inline double exp_sum(double hi, double lo)
{
    if (hi > 710.0 || hi < -746.0) { /* infinity and 0 all the same, and k fits */
        hi = hi > 0.0 ? 710.0 : -746.0;
        lo = 0.0;
    }
    double shifted = hi * log2_e + to_integer;
    int64_t k = (int64_t)(bits_of(shifted) - bits_of(to_integer));
    double kd = shifted - to_integer;
    double exact = hi - kd * ln2_hi;
    double rest = kd * ln2_lo - lo;
    double r = exact - rest;
    double r_lo = (exact - r) - rest;
    double r2 = r * r;
    double r8 = (r2 * r2) * (r2 * r2);
    double sum = 1.0 + r;
    double sum_lo = ((1.0 - sum) + r) + r_lo;
    double y = sum + (sum_lo + r2 * (poly8(exp_rest, r) + r8 * poly4(exp_rest + 8, r)));
    int64_t half = k >> 1;
    return y * double_of((uint64_t)(1023 + half) << 52) *
           double_of((uint64_t)(1023 + k - half) << 52);
}

double fracas_exp(double x)
{
    return exp_sum(x, 0.0);
}

/* (distributions.1) */
double fracas_expm1(double x)
{
    if (fabs(x) > 0.6931) return fracas_exp(x) - 1.0;
    const double r = fabs(x) > 0.3466 ? 0.5 * x : x, r2 = r * r, r8 = (r2 * r2) * (r2 * r2);
    const double y = r + r2 * (poly8(exp_rest, r) + r8 * poly4(exp_rest + 8, r));
    return r == x ? y : y * (2.0 + y);
}

/* (distributions.2) Adds back the rounding error of 1 + x. */
double fracas_log1p(double x)
{
    const double w = 1.0 + x;
    return w > 0.0 && w < INFINITY ? fracas_log(w) + (x - (w - 1.0)) / w : fracas_log(w);
}

/* a b = product + low, to 2^-104 relative, without FMA: a and b are cut into 26 + 27 bits. */
static inline double two_product(double a, double b, double *low)
{
    const uint64_t upper = ~(uint64_t)0x7ffffff;
    double ah = double_of(bits_of(a) & upper), al = a - ah;
    double bh = double_of(bits_of(b) & upper), bl = b - bh;
    double product = a * b;
    *low = ((ah * bh - product) + (ah * bl + al * bh)) + al * bl;
    return product;
}

/* ln x = *value + *low, to 2^-63 relative, for finite x > 0: 2 artanh s = 2 s (1 + s^2/3 + s^4
 * T(s^2)) with s, s^2/3 and the sum in two doubles each. The last term is so small: one double
 * suffices. */
static inline double log_sum(double x, double *low)
{
    static const double t[8] = {
        /* (artanh(s)/s - 1 - s^2/3)/s^4 in s^2 <= 0.0295: 2^-66 */
        0x1.999999999999ap-3, 0x1.2492492492521p-3, 0x1.c71c71c6eaa10p-4, 0x1.745d177a96056p-4,
        0x1.3b1395d2190c1p-4, 0x1.1118c7e4b0917p-4, 0x1.df7cc8e5fa539p-5, 0x1.e02e6fff27908p-5,
    };
    const double third = 0x1.5555555555555p-2, third_lo = 0x1.5555555555555p-56;
    double k;
    double m = split_exponent(x, &k);
    double f = m - 1.0;
    double d = m + 1.0, d_lo = m - (d - 1.0);
    double s = f / d, product_lo;
    double product = two_product(s, d, &product_lo);
    double s_lo = (((f - product) - product_lo) - s * d_lo) / d;
    double z_lo;
    double z = two_product(s, s, &z_lo);
    z_lo += 2.0 * (s * s_lo);
    double cubic_lo;
    double cubic = two_product(z, third, &cubic_lo);
    cubic_lo += z * third_lo + z_lo * third;
    double tail = (z * z) * poly8(t, z);
    double g = cubic + tail;
    double g_lo = ((cubic - g) + tail) + cubic_lo;
    double correction_lo;
    double correction = two_product(s, g, &correction_lo);
    double sum = s + correction;
    double sum_lo = ((s - sum) + correction) + (correction_lo + (s_lo + (s * g_lo + s_lo * g)));
    double value = k * ln2_hi + 2.0 * sum;
    *low = ((k * ln2_hi - value) + 2.0 * sum) + (k * ln2_lo + 2.0 * sum_lo);
    return value;
}

/* (sampling.13) e^(y ln x) with the logarithm and the product in two doubles: 2^-63 of ln x becomes
 * 2^-53.5 of the power where |y ln x| is largest, 745. */
double fracas_pow(double x, double y)
{
    if (x == 1.0 || y == 0.0) return 1.0;
    if (!(x > 0.0 && x < INFINITY)) return fracas_exp(y * fracas_log(x));
    double log_lo, product_lo;
    double log_x = log_sum(x, &log_lo);
    double product = two_product(y, log_x, &product_lo);
    return exp_sum(product, product_lo + y * log_lo);
}

/* (sampling.14) 1/Gamma is entire: w = 1/Gamma - 1 is a polynomial about 1.5 on [1, 2], below 0.13
 * there, and its rounding errors hardly count in Gamma = 1 - w/(1 + w). The rest by Gamma(x) = (x -
 * 1) Gamma(x - 1). */
double fracas_gamma(double x)
{
    static const double c[16] = {
        /* 1/Gamma(1.5 + v) - 1 in |v| <= 1/2: 2^-56 */
        0x1.06eba8214db69p-3,  -0x1.514d3d90584b3p-5, -0x1.0da5a671c048cp-1,
        0x1.669be41a93892p-3,  0x1.a18540be33653p-5,  -0x1.5955cc3972186p-5,
        0x1.b16203e548491p-8,  0x1.15f7f0609c138p-9,  -0x1.232bd852d67ecp-10,
        0x1.3f84605541cc3p-13, 0x1.a96374da02946p-16, -0x1.d24cdaed928e6p-17,
        0x1.2172c2ddcbee9p-19, 0x1.f2ae41d5b51adp-25, -0x1.82a4ea6702998p-24,
        0x1.21263fe0d7581p-26,
    };
    if (!(x >= 1.0 && x <= 171.0)) return NAN;
    double product = 1.0;
    while (x > 2.0) {
        x -= 1.0;
        product *= x;
    }
    double v = x - 1.5;
    double v2 = v * v;
    double v8 = (v2 * v2) * (v2 * v2);
    double w = poly8(c, v) + v8 * poly8(c + 8, v);
    return product * (1.0 - w / (1.0 + w));
}

/* ---- sine and cosine of pi x ---- */

/* x = n/2 + r, exactly, |r| <= 1/4; n modulo 4, as C's conversion and masks give it, names the
 * quadrant. */
static inline double quarter_of(double x, uint64_t *quadrant)
{
    double n = rint(2.0 * x);
    *quadrant = (uint64_t)(int64_t)n & 3u;
    return x - 0.5 * n;
}

/* sin(pi r) = pi r + r^3 S(r^2), |r| <= 1/4: with pi r in two doubles only the rest, at most a
 * tenth of it, is rounded before the last sum. Below 2^-30, pi r is all: pi is rounded by at most
 * 0.36 ulp, the product by 0.5. */
static inline double sine(double r)
{
    static const double s[8] = {
        /* (sin(pi r)/r - pi)/r^2 in r^2 <= 1/16: 2^-57 */
        -0x1.4abbce625be53p+2, 0x1.466bc6775aae2p+1,  -0x1.32d2cce62bd85p-1,  0x1.50783487ee37dp-4,
        -0x1.e3074fdd8bbb6p-8, 0x1.e8f432b4ce4c9p-12, -0x1.6fab3c3eb25c4p-16, 0x1.a7da70b1f459cp-21,
    };
    const double pi = 0x1.921fb54442d18p+1, pi_lo = 0x1.1a62633145c07p-53;
    if (fabs(r) < 0x1p-30) return pi * r;
    double z = r * r, low;
    double line = two_product(pi, r, &low);
    return line + (low + r * (pi_lo + z * poly8(s, z)));
}

/* cos(pi r) = 1 - pi^2/2 r^2 + r^4 C(r^2), |r| <= 1/4: the first two terms and their difference in
 * two doubles. */
static inline double cosine(double r)
{
    static const double c[8] = {
        /* (cos(pi r) - 1 + pi^2/2 r^2)/r^4 in r^2 <= 1/16: 2^-59 */
        0x1.03c1f081b5ac4p+2,  -0x1.55d3c7e3cbffap+0,  0x1.e1f506891babap-3,
        -0x1.a6d1f2a204805p-6, 0x1.f9d38a36c4ef0p-10,  -0x1.b6e24df1af831p-14,
        0x1.20c49b569566dp-18, -0x1.281e7c45b8040p-23,
    };
    const double half_square = 0x1.3bd3cc9be45dep+2, half_square_lo = 0x1.692b71366cc04p-52;
    double z_lo, low;
    double z = two_product(r, r, &z_lo);
    double fall = two_product(half_square, z, &low); /* pi^2/2 r^2 */
    low += half_square * z_lo + half_square_lo * z;
    double sum = 1.0 - fall;
    return sum + (((1.0 - sum) - fall) + ((z * z) * poly8(c, z) - low));
}

/* (sampling.15) The bound of x keeps n an integer within a double's range. */
double fracas_sinpi(double x)
{
    if (!(fabs(x) <= 0x1p52)) return NAN;
    uint64_t quadrant;
    double r = quarter_of(x, &quadrant);
    double y = quadrant & 1u ? cosine(r) : sine(r);
    return quadrant & 2u ? -y : y;
}

/* (sampling.15) cos(pi x) = sin(pi (x + 1/2)): one quadrant further. */
double fracas_cospi(double x)
{
    if (!(fabs(x) <= 0x1p52)) return NAN;
    uint64_t quadrant;
    double r = quarter_of(x, &quadrant);
    double y = quadrant & 1u ? sine(r) : cosine(r);
    return (quadrant + 1u) & 2u ? -y : y;
}
