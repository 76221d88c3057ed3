/* SPDX-License-Identifier: GPL-3.0-or-later */
#define ISA avx512
#define LANES 8
#include "tests/support/elementary_lanes_template.h"
