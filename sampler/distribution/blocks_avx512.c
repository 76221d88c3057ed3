#define ISA avx512
#define LANES 8
#include "sampler/distribution/blocks_template.h"
