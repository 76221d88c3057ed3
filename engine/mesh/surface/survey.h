/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A look at a mesh from a file, for warnings before a run. */
#ifndef FRACAS_ENGINE_MESH_SURFACE_SURVEY_H
#define FRACAS_ENGINE_MESH_SURFACE_SURVEY_H

#include "engine/mesh/surface/surface.h"

/* Remedy for nodes that are in one position, but not one. */
#define FRACAS_SURFACE_JOIN                                                                     \
    "make one node of them: `Coherence Mesh;` at the end of the .geo file, or gmsh -setnumber " \
    "Geometry.AutoCoherence 1"

typedef struct {
    double box[3];  /* sides of the box around all nodes [m] */
    size_t parts;   /* elements joined over common edges */
    size_t doubled; /* positions, within 1e-9 of the body, that nodes of several parts have */
    size_t hanging; /* corners of the border on edges of it that end elsewhere: the body is slit */
    size_t turned;  /* elements that went round against the others in the file */
    double steered; /* flat: part of the length of the edges between elements that lies in the three
                       directions, 15 degrees wide, that have most of it; else 0 */
    bool round;     /* a sphere about the origin, or a part of one */
} fracas_surface_survey;

/* The unit in which a body with this largest side [m] was likely drawn. */
static inline const char *fracas_surface_likely_unit(double side)
{
    return side >= 1000 ? "um" : "mm";
}

FRACAS_MUST_USE fracas_err fracas_surface_survey_make(const fracas_surface *surface,
                                                      fracas_surface_survey *survey);

/* FRACAS_USAGE for several elements of which no two have an edge in common. */
FRACAS_MUST_USE fracas_err fracas_surface_check_whole(const fracas_surface *surface);

#endif
