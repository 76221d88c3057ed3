/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both sweeps of the ring over lanes: a kernel. */
#include "engine/formulation/chain/ring_nitsche.h"
#include "engine/formulation/chain/ring_stershic.h"

#define RING_SWEEP(name, law, balanced)                                               \
    static void name(const fracas_ring_constants *ring, fracas_step *step, int first) \
    {                                                                                 \
        ring_flux(ring, step, first, law, balanced);                                  \
    }
#define RING_FLUX(name)                           \
    RING_SWEEP(ring_##name, FRACAS_LAW_##name, 0) \
    RING_SWEEP(ring_balanced_##name, FRACAS_LAW_##name, 1)
#define RING_RIGID(name)
#define RING_NO(name)
#define FRACAS_LAW(name, bar, ring, membrane, shell) RING_##ring(name)
#include "engine/cohesive/laws.list.h"
#undef RING_FLUX
#undef RING_RIGID

#define RING_FLUX(name) [FRACAS_LAW_##name] = {ring_##name, ring_balanced_##name},
#define RING_RIGID(name) [FRACAS_LAW_##name] = {ring_rigid, ring_rigid},
const fracas_ring_kernel LANES_UNIT(fracas_ring) = {.sweep = {
#include "engine/cohesive/laws.list.h"
                                                    }};
