/* SPDX-License-Identifier: GPL-3.0-or-later */
#define BAR_KERNELS fracas_bar_kernels_avx512
#include "engine/formulation/chain/bar_sweep_isa.h"
