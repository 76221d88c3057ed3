/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/facets.h"

#include "analysis/data/room.h"
#include "analysis/data/text.h"

#include <math.h>

static const double step = 0.02; /* part of the light below that a shade takes away */
static const double ambient = 0.45, inside = 0.6; /* ambient light; inner skin/outer */
static const char night[] = "#0b1220";            /* facets to shade */

typedef struct {
    const fracas_facets *facets;
    FILE *out;
    fracas_room room;
    fracas_spot *spot;     /* for each node of the facets */
    uint8_t *tint;         /* for each facet */
    uint8_t *shade, *base; /* shades on it, and on all of its piece in this layer */
    uint8_t *least; /* fewest shades of each fragment in this layer, outer skin and inner one */
    int darkest;
    double line;            /* width of a broken interface, units */
    int32_t layer;          /* the layer being drawn */
    size_t *sorted, *first; /* facets by their layer; where each begins */
    size_t count, *member;  /* facets of this layer, and those of nearer layers beside them */
    int32_t *in;            /* for each facet its last layer as a member */
} drawing;

/* ---- members of a layer ---- */

static uint8_t shade_of(const fracas_facet *facet)
{
    const double lit = ambient + (1 - ambient) * (double)facet->light;
    return (uint8_t)lround(log(facet->kind == FRACAS_FACET_INNER ? inside * lit : lit) /
                           log(1 - step));
}

static fracas_err prepare(drawing *d, const fracas_frame *frame, const uint8_t *tint, bool shaded)
{
    const fracas_facets *facets = d->facets;
    const size_t n = facets->nfacets + 1;
    fracas_room *room = &d->room;
    size_t *layer;
    FRACAS_TAKE(room, d->spot, facets->nnodes);
    FRACAS_TAKE(room, d->tint, n);
    FRACAS_TAKE(room, d->shade, n);
    FRACAS_TAKE(room, d->base, n);
    FRACAS_TAKE(room, d->least, 2 * n);
    FRACAS_TAKE(room, layer, n);
    FRACAS_TAKE(room, d->member, 4 * n);
    FRACAS_TAKE(room, d->in, n);
    TRY(fracas_room_check(room, "a picture"));
    for (size_t k = 0; k < facets->nnodes; k++)
        d->spot[k] = fracas_frame_place(frame, facets->node[k]);
    for (size_t f = 0; f < facets->nfacets; f++) {
        const fracas_facet *facet = &facets->facet[f];
        d->tint[f] = tint ? tint[facet->fragment] : 0;
        d->shade[f] = shaded ? shade_of(facet) : 0;
        if (d->shade[f] > d->darkest) d->darkest = d->shade[f];
        d->in[f] = -1;
        layer[f] = facet->layer < 0 ? SIZE_MAX : (size_t)facet->layer;
    }
    return fracas_room_groups(room, layer, facets->nfacets, facets->nlayers, &d->first, &d->sorted);
}

static void join(drawing *d, size_t f)
{
    if (d->in[f] == d->layer) return;
    d->in[f] = d->layer;
    d->member[d->count++] = f;
}

static uint8_t *least_of(const drawing *d, const fracas_facet *facet)
{
    return &d->least[2 * (size_t)facet->fragment + (facet->kind == FRACAS_FACET_INNER)];
}

/* All shades of a cut, which is too narrow for shades with shapes of their own. */
static void find_bases(drawing *d)
{
    const fracas_facet *facet = d->facets->facet;
    for (size_t m = 0; m < d->count; m++) *least_of(d, &facet[d->member[m]]) = UINT8_MAX;
    for (size_t m = 0; m < d->count; m++) {
        const size_t f = d->member[m];
        uint8_t *least = least_of(d, &facet[f]);
        if (facet[f].kind != FRACAS_FACET_CUT && d->shade[f] < *least) *least = d->shade[f];
    }
    for (size_t m = 0; m < d->count; m++) {
        const size_t f = d->member[m];
        d->base[f] = facet[f].kind == FRACAS_FACET_CUT ? d->shade[f] : *least_of(d, &facet[f]);
    }
}

/* The neighbours in nearer layers are drawn later: without them, the background would shine through
 * the joint. */
static void begin_layer(drawing *d, int32_t layer)
{
    d->layer = layer;
    d->count = 0;
    for (size_t k = d->first[layer]; k < d->first[layer + 1]; k++) {
        const fracas_facet *facet = &d->facets->facet[d->sorted[k]];
        join(d, d->sorted[k]);
        for (int side = 0; side < 3; side++) {
            const int32_t other = facet->neighbour[side];
            if (other >= 0 && d->facets->facet[other].layer >= 0 &&
                d->facets->facet[other].layer < layer)
                join(d, (size_t)other);
        }
    }
    find_bases(d);
}

/* ---- areas ---- */

static fracas_err add_side(fracas_trail *trail, const fracas_facet *facet, int side)
{
    const int64_t node[3] = {facet->node[side], facet->node[(side + 1) % 3], facet->middle[side]};
    return fracas_trail_add(trail, node, false);
}

/* Lines or areas, in a group with these attributes; nothing without an edge. */
static fracas_err draw(const drawing *d, const fracas_trail *trail, bool closed,
                       const char *attributes, const char *class)
{
    if (trail->count == 0) return FRACAS_OK;
    fprintf(d->out, "<g%s>\n", attributes);
    TRY(fracas_trail_write(trail, d->spot, closed, class, d->out));
    fputs("</g>\n", d->out);
    return FRACAS_OK;
}

typedef bool choice(const drawing *d, size_t facet, int k);

static bool has_tint(const drawing *d, size_t facet, int k)
{
    return d->tint[facet] == k;
}

static bool has_base(const drawing *d, size_t facet, int k)
{
    return d->base[facet] == k;
}

static bool is_above(const drawing *d, size_t facet, int k)
{
    return d->base[facet] < k && k <= d->shade[facet];
}

static fracas_err fill(const drawing *d, choice *chosen, int k, const char *attributes,
                       const char *class)
{
    FRACAS_CLEARED(fracas_trail) trail = {0};
    for (size_t m = 0; m < d->count; m++) {
        const fracas_facet *facet = &d->facets->facet[d->member[m]];
        for (int side = 0; side < 3 && chosen(d, d->member[m], k); side++) {
            const int32_t other = facet->neighbour[side];
            if (other >= 0 && d->in[other] == d->layer && chosen(d, (size_t)other, k)) continue;
            TRY(add_side(&trail, facet, side));
        }
    }
    return draw(d, &trail, true, attributes, class);
}

static fracas_err draw_tints(const drawing *d, bool tinted)
{
    for (int t = 0; t <= FRACAS_TINT_DUST; t++) {
        char class[16];
        if (t == FRACAS_TINT_DUST) FRACAS_PRINT(class, "dust-fill");
        else if (tinted) FRACAS_PRINT(class, "t%d", t);
        else FRACAS_PRINT(class, "body");
        TRY(fill(d, has_tint, t, "", class));
    }
    return FRACAS_OK;
}

/* First the shades common to a piece, at once. Then one shade upon the other, each with the shape
 * of all facets at least as dark: few lines, and no joints. */
static fracas_err draw_shades(const drawing *d)
{
    char attributes[64];
    for (int k = 1; k <= d->darkest; k++) {
        FRACAS_PRINT(attributes, " fill=\"%s\" fill-opacity=\"%.3f\"", night, 1 - pow(1 - step, k));
        TRY(fill(d, has_base, k, attributes, "shade"));
    }
    FRACAS_PRINT(attributes, " fill=\"%s\" fill-opacity=\"%g\"", night, step);
    for (int k = 1; k <= d->darkest; k++) TRY(fill(d, is_above, k, attributes, "shade"));
    return FRACAS_OK;
}

/* ---- lines ---- */

/* Two facets of one skin have a side in common: the one in the nearer layer draws it, of equals the
 * first. */
static bool draws(const drawing *d, size_t f, int side)
{
    const int32_t other = d->facets->facet[f].neighbour[side];
    if (other < 0) return true;
    const int32_t layer = d->facets->facet[other].layer;
    return layer < 0 || layer > d->layer || (layer == d->layer && f < (size_t)other);
}

static fracas_err draw_sides(const drawing *d, fracas_side what, const char *class, double width)
{
    FRACAS_CLEARED(fracas_trail) trail = {0};
    for (size_t k = d->first[d->layer]; k < d->first[d->layer + 1]; k++) {
        const fracas_facet *facet = &d->facets->facet[d->sorted[k]];
        for (int side = 0; side < 3; side++)
            if (facet->side[side] == what && draws(d, d->sorted[k], side))
                TRY(add_side(&trail, facet, side));
    }
    char attributes[64];
    FRACAS_PRINT(attributes, " stroke-width=\"%.1f\"", width * d->line);
    return draw(d, &trail, false, attributes, class);
}

static fracas_err draw_layer(const drawing *d, bool tinted, bool mesh)
{
    TRY(draw_tints(d, tinted));
    if (mesh) TRY(draw_sides(d, FRACAS_SIDE_CLOSED, "mesh", 0.5));
    TRY(draw_sides(d, FRACAS_SIDE_CRACKED, "cracked", 0.9));
    TRY(draw_shades(d)); /* over faint lines, too, to keep them faint in the dark */
    TRY(draw_sides(d, FRACAS_SIDE_BROKEN, "broken", 1.0));
    TRY(draw_sides(d, FRACAS_SIDE_PARTED, "broken", 0.6));
    return draw_sides(d, FRACAS_SIDE_EDGE, "outline", 1.0);
}

/* A fifth of a mean edge, to show small elements and not only lines; between 0.4 and 1.2 pixels. */
static double line_width(const fracas_facets *facets, const fracas_frame *frame)
{
    double sum = 0;
    for (size_t e = 0; e < facets->nskin; e++)
        for (int k = 0; k < 3; k++) {
            const double *a = facets->node[facets->facet[e].node[k]];
            const double *b = facets->node[facets->facet[e].node[(k + 1) % 3]];
            sum += hypot(hypot(b[0] - a[0], b[1] - a[1]), b[2] - a[2]);
        }
    const double mean = sum / (3 * (double)facets->nskin) * frame->scale;
    return FRACAS_FRAME_UNITS * fmin(fmax(0.2 * mean, 0.4), 1.2);
}

fracas_err fracas_facets_draw(const fracas_facets *facets, const fracas_frame *frame,
                              const uint8_t *tint, bool shaded, fracas_surface_show show, FILE *out)
{
    drawing d = {.facets = facets, .out = out, .line = line_width(facets, frame)};
    fracas_err err = prepare(&d, frame, tint, shaded);
    for (int32_t layer = (int32_t)facets->nlayers - 1; !err && layer >= 0; layer--) {
        begin_layer(&d, layer);
        err = draw_layer(&d, tint != NULL, show == FRACAS_SHOW_MESH);
    }
    fracas_room_clear(&d.room);
    return err;
}
