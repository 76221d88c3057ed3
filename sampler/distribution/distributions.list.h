/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The distributions of strengths, in the order of the reference page; the first is the default.
 * Each is a file of this folder that defines the object named here. */
FRACAS_DISTRIBUTION(fracas_weibull)
FRACAS_DISTRIBUTION(fracas_uniform)
FRACAS_DISTRIBUTION(fracas_lognormal)
FRACAS_DISTRIBUTION(fracas_constant)
FRACAS_DISTRIBUTION(fracas_normal)
FRACAS_DISTRIBUTION(fracas_gamma_distribution) /* fracas_gamma is the function */
FRACAS_DISTRIBUTION(fracas_flaws)
FRACAS_DISTRIBUTION(fracas_empirical)
FRACAS_DISTRIBUTION(fracas_file_distribution) /* fracas_file is a campaign file */
FRACAS_DISTRIBUTION(fracas_positions)
