/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The start of a surface: its fastest node, and edges at which an initial stress is let go. */
#ifndef FRACAS_CAMPAIGNS_PLAN_START_H
#define FRACAS_CAMPAIGNS_PLAN_START_H

#include "engine/engine.h"

/* Largest initial velocity of a node, before edges hold it [m/s]; 0 of bars and rings. */
double fracas_start_speed(const fracas_model *model);

/* Share of the tractions of the initial stress on outer edges that is at edges which neither hold
 * it nor are loaded: 0 where edges keep it, 1 where none does, or where there is no edge. An edge
 * is outer if it faces away from the middle: no hole, no notch. Planes of symmetry are none. 0
 * without such a stress. */
double fracas_start_released(const fracas_model *model);

#endif
