/* SPDX-License-Identifier: GPL-3.0-or-later */
#define RING_KERNELS fracas_ring_kernels_avx2
#include "engine/formulation/chain/ring_sweep_isa.h"
