#define RING_KERNELS fracas_ring_kernels_baseline
#include "engine/formulation/ring_sweep_isa.h"
