/* SPDX-License-Identifier: GPL-3.0-or-later */
#define ISA avx2
#define LANES 4
#include "tests/support/elementary_lanes_template.h"
