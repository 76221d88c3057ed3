/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The sampler's door: random strength fields by inverse transform from counter-based streams. */
#ifndef FRACAS_SAMPLER_SAMPLER_H
#define FRACAS_SAMPLER_SAMPLER_H

#include "sampler/field/field.h"
#include "sampler/strength.h"
#include "sampler/stream.h"

#endif
