/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/notch.h"

#include "base/own.h"
#include "engine/mesh/line.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define END(key, place, models, what)                                                     \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = "m", .doc = what,             \
                  .fallback = FRACAS_REQUIRED, .minimum = -INFINITY, .maximum = INFINITY, \
                  .offset = offsetof(fracas_notch, place), .only = models, .optional = true)
#define FLAT (FRACAS_GROUP_RING | FRACAS_GROUP_SURFACES)

static const fracas_kind contact_law = {"law", "pressed faces touch as those that break do"},
                         contact_none = {"none", "faces pass through each other"};
static const fracas_kind *const contacts[] = {&contact_law, &contact_none};

bool fracas_notch_touches(const fracas_notch *notch)
{
    return notch->contact != &contact_none;
}

static const fracas_param params[] = {
    END("from_x", from[0], 0, "x of one end of the line; none is 0"),
    END("from_y", from[1], FLAT, "y of this end; none is 0"),
    END("from_z", from[2], FRACAS_GROUP_SHELL, "z of this end; none is 0"),
    END("to_x", to[0], 0, "x of the other end; none is that of the first"),
    END("to_y", to[1], FLAT, "y of the other end; none is that of the first"),
    END("to_z", to[2], FRACAS_GROUP_SHELL, "z of the other end; none is that of the first"),
    {.name = "within",
     .type = FRACAS_REAL,
     .unit = "m",
     .doc = "no broken interface is farther from the line; none is the mean length of an "
            "interface, of a bar's or ring's element",
     .fallback = FRACAS_REQUIRED,
     .minimum = 0,
     .maximum = INFINITY,
     .minimum_open = true,
     .offset = offsetof(fracas_notch, within),
     .optional = true},
    {FRACAS_ONE_OF("contact", contacts, offsetof(fracas_notch, contact),
                   "what faces do that are pressed together; none given is `law`"),
     .only = FRACAS_GROUP_SURFACES, .optional = true},
};

/* Keys that the model does not have are 0 at both ends. */
static fracas_err check_notch(const void *section)
{
    const fracas_notch *notch = section;
    bool begins = notch->within > 0, ends = false;
    for (int i = 0; i < 3; i++) {
        if (notch->from[i] == 0 && notch->to[i] == 0) continue;
        begins = begins || !isnan(notch->from[i]);
        ends = ends || !isnan(notch->to[i]);
    }
    if (!begins || ends) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "a notch has no second end: give to_x, to_y or to_z");
}

const fracas_section fracas_notch_section = {
    .name = "notch",
    .doc = "Interfaces along a line that are broken from the start; none without it",
    FRACAS_PARAMS(params),
    .offset = offsetof(fracas_spec, notch),
    .hashed = true,
    .check = check_notch,
};

static fracas_line line_of(const fracas_notch *notch, double size)
{
    return fracas_line_of("notch", "notch", notch->from, notch->to, notch->within, size);
}

/* ---- chains ---- */

static fracas_err find_in_chain(const fracas_line *l, const fracas_notch_places *places,
                                bool *broken)
{
    size_t best = 0;
    double least = INFINITY, middle = INFINITY;
    for (size_t i = 0; i < places->interfaces; i++) {
        double share;
        const double d = fracas_line_distance(l, places->position[i], &share);
        if (d > least || (d == least && fabs(share - 0.5) >= middle)) continue;
        least = d;
        middle = fabs(share - 0.5);
        best = i;
    }
    if (!(least <= l->within)) return fracas_line_too_far(l, "line", "interface", least);
    broken[best] = true;
    return FRACAS_OK;
}

/* NULL: there is none. */
static const fracas_surface_group *group_of(const fracas_surface *surface)
{
    for (size_t g = 0; surface && g < surface->ngroups; g++)
        if (strcmp(surface->group[g].name, FRACAS_NOTCH_GROUP) == 0) return &surface->group[g];
    return NULL;
}

bool fracas_notch_has_line(const fracas_notch *notch)
{
    return line_of(notch, 0).length > 0;
}

fracas_err fracas_notch_find(const fracas_notch *notch, const fracas_notch_places *places,
                             uint32_t **interface, size_t *count)
{
    const fracas_line l = line_of(notch, places->size);
    const fracas_surface_group *group = group_of(places->surface);
    *count = 0;
    if (l.length == 0 && !group) return FRACAS_OK;
    OWNED bool *broken = calloc(places->interfaces + 1, sizeof *broken);
    if (!broken) return fracas_no_memory("the notch of a body");
    if (l.length > 0) {
        if (places->surface) TRY(fracas_line_find(&l, places->surface, broken));
        else TRY(find_in_chain(&l, places, broken));
    }
    for (size_t i = 0; i < places->interfaces; i++) {
        if (group && places->surface->interface[i].tag == group->number) broken[i] = true;
        *count += broken[i];
    }
    if (*count == 0) return FRACAS_OK;
    *interface = malloc(*count * sizeof **interface);
    if (!*interface) return fracas_no_memory("the notch of a body");
    for (size_t i = 0, n = 0; i < places->interfaces; i++)
        if (broken[i]) (*interface)[n++] = (uint32_t)i;
    return FRACAS_OK;
}
