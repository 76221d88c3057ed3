#define ISA baseline
#define LANES 1
#include "sampler/distribution/blocks_template.h"
