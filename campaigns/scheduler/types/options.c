/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/options.h"

#include "campaigns/scheduler/types/lease.h"

const char *const fracas_isolation_name[2] = {"lease", "none"};

void fracas_run_options_init(fracas_run_options *options)
{
    *options = (fracas_run_options){.isa = FRACAS_ISA_BEST,
                                    .segment_age = 5,
                                    .segment_bytes = 64.0 * 1024 * 1024,
                                    .lease_seconds = 1,
                                    .checkpoint_seconds = 120};
}

size_t fracas_run_width(const fracas_run_options *options)
{
    return options->width ? (size_t)options->width : FRACAS_LANES_MAX;
}
