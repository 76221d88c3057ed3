/* Fragments: connected sets of elements over unbroken interfaces. */
#ifndef FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H
#define FRACAS_ENGINE_FRAGMENTS_FRAGMENTS_H

#include "base/partition.h"

#endif
