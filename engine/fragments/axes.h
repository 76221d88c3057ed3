/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_ENGINE_FRAGMENTS_AXES_H
#define FRACAS_ENGINE_FRAGMENTS_AXES_H

/* Jacobi's rotations: leaves the eigenvalues of the symmetric matrix a on its diagonal, their
 * directions in the columns of axis. */
void fracas_axes_find(double a[3][3], double axis[3][3]);

#endif
