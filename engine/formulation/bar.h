/* The bar: the hoop direction of an expanding ring, one coordinate (theory/bar.md). */
#ifndef FRACAS_ENGINE_FORMULATION_BAR_H
#define FRACAS_ENGINE_FORMULATION_BAR_H

#include "base/param.h"

extern const fracas_kind fracas_bar;

#endif
