/* SPDX-License-Identifier: GPL-3.0-or-later */
#define ISA avx2
#define LANES 4
#include "sampler/distribution/blocks_template.h"
