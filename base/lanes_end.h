/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Undefines the names of base/lanes.h and base/elementary_lanes.h, so that it can be included again
 * with another LANES. */
#undef vd
#undef vmask
#undef vu
#undef lanes_load
#undef lanes_store
#undef lanes_set
#undef lanes_lt
#undef lanes_le
#undef lanes_and
#undef lanes_or
#undef lanes_any
#undef lanes_all
#undef lanes_select
#undef lanes_get
#undef lanes_sqrt
#undef lanes_bits
#undef lanes_double
#undef lanes_poly4
#undef lanes_poly8
#undef lanes_each
#undef lanes_log
#undef lanes_exp
#undef LANES_FUNCTION
#undef LANES_NAME
#undef LANES_JOIN
#undef LANES_JOIN_
