/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Moments of a power of an exponential variable, the core of the Weibull distribution; same bits on
 * every CPU. */
#ifndef FRACAS_SAMPLER_WEIBULL_SHAPE_H
#define FRACAS_SAMPLER_WEIBULL_SHAPE_H

/* Variance over squared mean of t^x, t exponential: Gamma(1 + 2x)/Gamma(1 + x)^2 - 1, 0 < x <= 10,
 * to 5e-14 relative. */
double fracas_weibull_variation(double x);

/* The x = 1/shape in [least, most] with fracas_weibull_variation(x) = variation; an end if it is
 * beyond. To 1e-13 relative. */
double fracas_weibull_shape_inverse(double variation, double least, double most);

#endif
