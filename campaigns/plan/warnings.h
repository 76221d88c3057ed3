/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings about a point before its run. */
#ifndef FRACAS_CAMPAIGNS_PLAN_WARNINGS_H
#define FRACAS_CAMPAIGNS_PLAN_WARNINGS_H

#include "campaigns/plan/forecast.h"

/* Writes a warning; false, with any text, if it does not apply. */
typedef bool fracas_plan_warning(const fracas_point *point, const fracas_forecast *forecast,
                                 char *text, size_t size);

enum { FRACAS_PLAN_WARNINGS = 15 };
extern fracas_plan_warning *const fracas_plan_warnings[FRACAS_PLAN_WARNINGS];

#endif
