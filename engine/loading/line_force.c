/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Load `line-force`: on edges inside a body, along a line or of a mesh file's group. */
#include "engine/loading/load.h"

#include <math.h>

enum { FORCE, ACROSS = 3, FROM, TO = 7, WITHIN = 10 }; /* FORCE, FROM, TO: x, y, z */

#define LINE_FORCE(key, place, what, models) \
    FRACAS_LOAD_NUMBER(key, place, "N/m", what ", times its amplitude", models)
#define END(key, place, models, what)                                                     \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_loading, place), .only = models, .optional = true)
#define SHELL FRACAS_GROUP_SHELL

static const fracas_param params[] = {
    LINE_FORCE("force_x", own[FORCE], "force along x by the line's length", 0),
    LINE_FORCE("force_y", own[FORCE + 1], "force along y by the line's length", 0),
    LINE_FORCE("force_z", own[FORCE + 2], "force along z by the line's length", SHELL),
    LINE_FORCE("force_across", own[ACROSS],
               "force along the normal of the mid-surface by the line's length", SHELL),
    END("from_x", own[FROM], 0, "x of one end of the line; none is 0"),
    END("from_y", own[FROM + 1], 0, "y of this end; none is 0"),
    END("from_z", own[FROM + 2], SHELL, "z of this end; none is 0"),
    END("to_x", own[TO], 0, "x of the other end; none is that of the first"),
    END("to_y", own[TO + 1], 0, "y of the other end; none is that of the first"),
    END("to_z", own[TO + 2], SHELL, "z of the other end; none is that of the first"),
    FRACAS_LOAD_LENGTH("within", own[WITHIN],
                       "no loaded edge is farther from the line; none is the mean length of an "
                       "edge"),
    {FRACAS_LOAD_EDGE("edge", edge,
                      "group of a mesh file: its edges inside the body, in place of a line"),
     .optional = true},
    FRACAS_LOAD_AMPLITUDE,
};

static void density(const fracas_spec *spec, const fracas_loading *loading, const fracas_place *at,
                    double density[3])
{
    (void)spec;
    fracas_load_vector(loading, FORCE, at, density);
}

static const char *edge_of(const fracas_loading *loading, int i)
{
    return i == 0 && loading->edge ? loading->edge->name : NULL;
}

static fracas_line line_of(const fracas_loading *loading, const char *section, double size)
{
    const double *own = loading->own;
    return fracas_line_of("line", section, own + FROM, own + TO, own[WITHIN], size);
}

/* A key of other models is 0 at both ends. */
static fracas_err check(const fracas_loading *loading)
{
    const fracas_line line = line_of(loading, "loading", 1);
    if (!loading->edge && !(line.length > 0))
        return fracas_fail(FRACAS_USAGE,
                           "line-force has no line: give its ends, `from_y: -5 mm, to_y: 5 mm`, or "
                           "the group of a mesh file's edges, `edge: NAME`");
    if (loading->edge && (line.length > 0 || loading->own[WITHIN] > 0))
        return fracas_fail(FRACAS_USAGE,
                           "line-force has both a line and the edges %s: leave one out",
                           loading->edge->name);
    return fracas_load_check(loading);
}

static const fracas_load load = {
    .on = FRACAS_LOAD_ON_LINE, .density = density, .edge = edge_of, .line = line_of};

/* Waves reflect, and held bodies bend: no bound is known. */
const fracas_kind fracas_loading_line_force = {
    "line-force", "a force on a line inside a body at rest", FRACAS_PARAMS(params),
    .only = FRACAS_GROUP_SURFACES,
    .traits = &(const fracas_loading_traits){
        .surface = fracas_load_unbounded, .load = &load, .check = check}};
