/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The cohesive laws, one line each; the first is the default (engine/cohesive/law.h). */
#include "engine/cohesive/nitsche.h"
#include "engine/cohesive/rigid_link.h"
#include "engine/cohesive/stershic.h"
#include "engine/cohesive/camacho_ortiz_standard.h"
#include "engine/cohesive/camacho_ortiz.h"
#include "engine/cohesive/becker_noels.h"
#include "engine/cohesive/trapezoid.h"
#include "engine/cohesive/exponential.h"
