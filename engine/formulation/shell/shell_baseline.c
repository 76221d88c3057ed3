/* SPDX-License-Identifier: GPL-3.0-or-later */
#define SHELL_KERNELS fracas_shell_kernels_baseline
#include "engine/formulation/shell/shell_isa.h"
