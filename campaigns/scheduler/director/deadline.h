/* SPDX-License-Identifier: GPL-3.0-or-later */
#ifndef FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_DEADLINE_H
#define FRACAS_CAMPAIGNS_SCHEDULER_DIRECTOR_DEADLINE_H

#include "campaigns/scheduler/director/state.h"

/* The worker is predicted not to end its next lease before the deadline with time to write it. */
bool fracas_director_too_late(const fracas_director *director, size_t worker, double time);

#endif
