/* Loads. */
#ifndef FRACAS_ENGINE_LOADING_LOADING_H
#define FRACAS_ENGINE_LOADING_LOADING_H

#include "engine/spec.h"

extern const fracas_section fracas_loading_section;
extern const fracas_kind fracas_loading_imposed_rate;

#endif
