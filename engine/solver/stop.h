/* Stop rules: when a realization is over. */
#ifndef FRACAS_ENGINE_SOLVER_STOP_H
#define FRACAS_ENGINE_SOLVER_STOP_H

#include "engine/spec.h"

extern const fracas_section fracas_time_section;
extern const fracas_kind fracas_stop_time, fracas_stop_settled;

#endif
