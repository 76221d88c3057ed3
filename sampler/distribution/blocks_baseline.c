/* SPDX-License-Identifier: GPL-3.0-or-later */
#define ISA baseline
#define LANES 1
#include "sampler/distribution/blocks_template.h"
