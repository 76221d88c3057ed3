/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "sampler/distribution/blocks.h"

FRACAS_KERNEL_TABLE(const fracas_block_kernel, fracas_blocks);

fracas_block_quantile *fracas_block_quantile_of(fracas_block block, fracas_isa isa, int width)
{
    return fracas_blocks[isa][fracas_isa_lanes(isa, width)]->quantile[block];
}
