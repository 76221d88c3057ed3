/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Both sweeps of the ring for one width; included once a width by ring_sweep_isa.h, with LANES
 * defined. */
#include "base/lanes.h"
#include "engine/formulation/chain/ring_kinematics.h"
#include "engine/formulation/chain/ring_nitsche_template.h"
#include "engine/formulation/chain/ring_stershic_template.h"

#undef ring_vector
#undef ring_add
#undef ring_subtract
#undef ring_scale
#undef ring_dot
#undef ring_element
#undef ring_link
#undef ring_frame
#undef ring_context
#undef ring_read
#undef ring_write
#undef ring_stretch
#undef ring_frame_of
#undef ring_stress_rate
#undef ring_drive_node
#undef ring_drive_work
#undef ring_context_of
#undef nitsche_interface
#undef nitsche_law
#undef rigid_link_law
#undef chain_events
#undef chain_note_events
#undef central_drift
#undef central_kick
#include "base/lanes_end.h"
