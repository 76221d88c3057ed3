/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elementary functions with the same bits on every CPU and with every compiler.
 *
 * The C library's log and exp change with the CPU (they use FMA where there is one), so stored
 * numbers may not depend on them. These use + - * / and integer operations only, in a fixed order;
 * the build switches contraction off. The rounding mode is the default one, to nearest. ulp:
 * distance of the two doubles around the exact result. Bounds hold over the whole range, subnormal
 * arguments and results included; tests/unit/test_elementary.c measures them by long double. */
#ifndef FRACAS_BASE_ELEMENTARY_H
#define FRACAS_BASE_ELEMENTARY_H

#define FRACAS_PI 0x1.921fb54442d18p+1

/* Natural logarithm, error below 1 ulp. 0 gives -infinity, x < 0 and NaN NaN, infinity itself. */
double fracas_log(double x);

/* e^x, error below 1 ulp. +infinity from 709.79 on, 0 from -745.14 down; NaN gives NaN. */
double fracas_exp(double x);

/* e^x - 1, error below 3 ulp, below 1 ulp for |x| < 0.34. -1 from -37.5 down, +infinity from 709.79
 * on; NaN gives NaN. */
double fracas_expm1(double x);

/* ln(1 + x), error below 2 ulp. -1 gives -infinity; x < -1 and NaN give NaN; infinity itself. */
double fracas_log1p(double x);

/* x^y for x >= 0, error below 2 ulp, below 1 ulp where |y ln x| < 100. x^0 = 1 and 1^y = 1 for
 * every x and y, as in C; x < 0 gives NaN (also for whole y, unlike C), and so does a NaN in any
 * other place. */
double fracas_pow(double x, double y);

/* Gamma function for 1 <= x <= 171, error below 1.5 ulp up to x = 2, below x ulp above; NaN
 * elsewhere. */
double fracas_gamma(double x);

/* sin(pi x), cos(pi x) for |x| <= 2^52, error below 1 ulp; exact at whole and half x; NaN for other
 * x. */
double fracas_sinpi(double x);
double fracas_cospi(double x);

#endif
