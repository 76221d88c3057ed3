/* SPDX-License-Identifier: GPL-3.0-or-later */
#define MEMBRANE_KERNELS fracas_membrane_kernels_baseline
#include "engine/formulation/surface/membrane_isa.h"
