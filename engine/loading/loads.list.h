/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LOAD(name): fracas_loading_NAME, a force on surfaces or a motion of their nodes (load.h), which
 * also acts beside another loading. In the order of the reference; studies describe a key that
 * several have by the words of the first: new ones last. */
LOAD(pressure)
LOAD(body_force)
LOAD(traction)
LOAD(edge_motion)
LOAD(line_force)
LOAD(node_motion)
LOAD(point_force)
