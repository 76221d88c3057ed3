/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/types/options.h"

#include "campaigns/scheduler/types/lease.h"
#include "campaigns/store/file/schema.h"

const char *const fracas_isolation_name[2] = {"lease", "none"};

void fracas_run_options_init(fracas_run_options *options)
{
    *options = (fracas_run_options){.isa = FRACAS_ISA_BEST,
                                    .segment_age = FRACAS_SEGMENT_AGE,
                                    .segment_bytes = FRACAS_SEGMENT_BYTES,
                                    .lease_seconds = 1,
                                    .checkpoint_seconds = 120};
}

size_t fracas_run_width(const fracas_run_options *options)
{
    return options->width ? (size_t)options->width : FRACAS_LANES_MAX;
}
