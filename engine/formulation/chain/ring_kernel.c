/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both sweeps of the ring over lanes: a kernel. */
#include "engine/formulation/chain/ring_nitsche.h"
#include "engine/formulation/chain/ring_stershic.h"

const fracas_ring_kernel LANES_UNIT(fracas_ring) = {.nitsche = ring_nitsche,
                                                    .stershic = ring_stershic};
