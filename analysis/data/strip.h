/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A bar or ring as a surface, for its pictures: a strip of two triangles an element, as it was
 * before any motion. */
#ifndef FRACAS_ANALYSIS_DATA_STRIP_H
#define FRACAS_ANALYSIS_DATA_STRIP_H

#include "base/err.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/mesh.h"

/* Triangles 2 e and 2 e + 1 are element e; interface i of the chain stays interface i, and those
 * within elements follow, which never crack. A bar lies along x; a ring, or a bar with periodic
 * ends, is a circle around the origin, of its length. Elements of a fragment are equally long. The
 * record, with its fragments, gets the interfaces of the strip. *mesh is all zero before, and
 * cleared by the caller. FRACAS_DAMAGED if the interfaces are not those between the elements. */
FRACAS_MUST_USE fracas_err fracas_strip_create(fracas_record *record, fracas_stored_mesh *mesh);

#endif
