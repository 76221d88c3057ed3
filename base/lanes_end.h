/* Undefines the names of base/lanes.h, so that it can be included again with another LANES. */
#undef vd
#undef vmask
#undef lanes_load
#undef lanes_store
#undef lanes_set
#undef lanes_lt
#undef lanes_le
#undef lanes_and
#undef lanes_or
#undef lanes_any
#undef lanes_select
#undef lanes_get
#undef lanes_sqrt
#undef LANES_FUNCTION
#undef LANES_NAME
#undef LANES_JOIN
#undef LANES_JOIN_
