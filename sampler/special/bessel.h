/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modified Bessel function of the second kind, same bits on every CPU. */
#ifndef FRACAS_SAMPLER_BESSEL_H
#define FRACAS_SAMPLER_BESSEL_H

/* e^x K_nu(x), 0 <= nu <= 10 and x >= 1e-20, to 1e-13 relative up to x = 1000. */
double fracas_bessel_k_scaled(double nu, double x);

#endif
