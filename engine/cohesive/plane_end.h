/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undefines the names of cohesive/plane.h, plane_nitsche.h and plane_extrinsic.h, so that they can
 * be included for another width. */
#undef plane_interface
#undef plane_input
#undef plane_result
#undef plane_abs
#undef plane_max
#undef plane_min
#undef plane_effective
#undef plane_onset
#undef plane_energy
#undef plane_nitsche
#undef plane_nitsche_state
#undef plane_friction
#undef plane_rub
#undef plane_extrinsic
#undef plane_extrinsic_state
