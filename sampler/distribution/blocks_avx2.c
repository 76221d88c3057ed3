#define ISA avx2
#define LANES 4
#include "sampler/distribution/blocks_template.h"
