/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/facets.h"

#include "analysis/data/room.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* From above on the left, in the frame of the view; of length 1. */
static const double lamp[3] = {-0.36, 0.48, 0.8};

void fracas_view_turn(const fracas_view *view, const double vector[3], double turned[3])
{
    const double a = view->azimuth * M_PI / 180, h = view->elevation * M_PI / 180;
    const double along = cos(a) * vector[0] + sin(a) * vector[1]; /* on the horizontal */
    turned[0] = cos(a) * vector[1] - sin(a) * vector[0];
    turned[1] = cos(h) * vector[2] - sin(h) * along;
    turned[2] = cos(h) * along + sin(h) * vector[2];
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Normal of the triangle through three points, as long as twice its area. */
static void normal_of(const double a[3], const double b[3], const double c[3], double normal[3])
{
    double ab[3], ac[3];
    for (int i = 0; i < 3; i++) ab[i] = b[i] - a[i], ac[i] = c[i] - a[i];
    cross(ab, ac, normal);
}

typedef struct {
    const fracas_stored_mesh *mesh;
    const fracas_surface_state *state;
    const fracas_surface_picture *picture;
    fracas_facets *to;
    fracas_room room;
    bool apart;            /* fragments are drawn apart */
    size_t ngroups;        /* fragments if they are apart, else 1 */
    double (*turned)[3];   /* for each node of the mesh, in the frame of the view */
    double (*normal)[3];   /* for length 1 */
    double (*shift)[3];    /* for each group, then the centroid of all */
    uint32_t (*corner)[6]; /* for each element: its outer nodes, each before its inner one */
    int64_t (*across)[3];  /* for each element: interface at its side k, -1 at the border */
} shaping;

static size_t group_of(const shaping *s, size_t element)
{
    return s->apart ? s->state->fragment[element] : 0;
}

/* ---- where the fragments are ---- */

/* Nodes half way have the normals of their ends: the mean of both. */
static void find_normals(const shaping *s)
{
    const fracas_stored_mesh *mesh = s->mesh;
    for (size_t e = 0; e < mesh->nelements; e++) {
        const int64_t *node = mesh->element[e].node;
        double normal[3];
        normal_of(s->turned[node[0]], s->turned[node[1]], s->turned[node[2]], normal);
        for (int k = 0; k < 6; k++)
            for (int i = 0; i < 3 && node[k] >= 0; i++) s->normal[node[k]][i] += normal[i];
    }
    for (size_t n = 0; n < mesh->nnodes; n++) {
        const double length = sqrt(dot(s->normal[n], s->normal[n]));
        for (int i = 0; i < 3 && length > 0; i++) s->normal[n][i] /= length;
    }
}

/* shift = explode (centroid of the group - centroid of all), of straight triangles. */
static fracas_err find_shifts(shaping *s)
{
    const size_t all = s->ngroups;
    double *area;
    if (!FRACAS_TAKE(&s->room, area, all)) return fracas_no_memory("the fragments of a picture");
    for (size_t e = 0; e < s->mesh->nelements; e++) {
        const int64_t *node = s->mesh->element[e].node;
        double normal[3];
        normal_of(s->turned[node[0]], s->turned[node[1]], s->turned[node[2]], normal);
        const double twice = sqrt(dot(normal, normal));
        const size_t into[2] = {group_of(s, e), all};
        for (int k = 0; k < 2; k++) {
            area[into[k]] += twice;
            for (int c = 0; c < 3; c++)
                for (int i = 0; i < 3; i++)
                    s->shift[into[k]][i] += twice * s->turned[node[c]][i] / 3;
        }
    }
    for (size_t g = 0; g <= all; g++)
        for (int i = 0; i < 3 && area[g] > 0; i++) s->shift[g][i] /= area[g];
    for (size_t g = 0; g < all; g++)
        for (int i = 0; i < 3; i++)
            s->shift[g][i] = s->picture->explode * (s->shift[g][i] - s->shift[all][i]);
    return FRACAS_OK;
}

/* A fragment's centroid is within the convex hull of the surface: all of it stays within the hull
 * enlarged by 1 + explode. */
static void find_room(const shaping *s)
{
    fracas_facets *to = s->to;
    const double *centre = s->shift[s->ngroups], half = s->picture->thickness / 2;
    for (int i = 0; i < 2; i++) {
        to->least[i] = INFINITY;
        to->largest[i] = -INFINITY;
        for (size_t n = 0; n < s->mesh->nnodes; n++) {
            const double at = centre[i] + (1 + s->picture->explode) * (s->turned[n][i] - centre[i]);
            to->least[i] = fmin(to->least[i], at - half);
            to->largest[i] = fmax(to->largest[i], at + half);
        }
    }
}

/* ---- nodes: every group has its own ---- */

static void put_node(const shaping *s, size_t node, size_t group)
{
    for (int skin = 0; skin < 2; skin++) {
        const double out = (skin ? -0.5 : 0.5) * s->picture->thickness;
        double *at = s->to->node[s->to->nnodes++];
        for (int i = 0; i < 3; i++)
            at[i] = s->turned[node][i] + s->shift[group][i] + out * s->normal[node][i];
    }
}

/* copy: for each node of the mesh its copy in the last group with it, SIZE_MAX before. */
static void number_nodes(const shaping *s, const size_t *first, const size_t *of, uint32_t *copy,
                         size_t *last)
{
    for (size_t n = 0; n < s->mesh->nnodes; n++) last[n] = SIZE_MAX;
    for (size_t g = 0; g < s->ngroups; g++)
        for (size_t k = first[g]; k < first[g + 1]; k++) {
            const int64_t *node = s->mesh->element[of[k]].node;
            for (int c = 0; c < 6; c++) {
                if (node[c] < 0) continue;
                if (last[node[c]] != g) {
                    last[node[c]] = g;
                    copy[node[c]] = (uint32_t)s->to->nnodes;
                    put_node(s, (size_t)node[c], g);
                }
                s->corner[of[k]][c] = copy[node[c]];
            }
        }
}

static fracas_err place_nodes(shaping *s)
{
    const fracas_stored_mesh *mesh = s->mesh;
    size_t *group, *first, *of, *last;
    uint32_t *copy;
    const size_t most = 2 * (s->apart ? 6 * mesh->nelements : mesh->nnodes);
    s->to->node = malloc((most + 1) * sizeof *s->to->node);
    if (!s->to->node) return fracas_no_memory("the fragments of a picture");
    FRACAS_TAKE(&s->room, last, mesh->nnodes);
    FRACAS_TAKE(&s->room, copy, mesh->nnodes);
    FRACAS_TAKE(&s->room, group, mesh->nelements);
    TRY(fracas_room_check(&s->room, "the fragments of a picture"));
    for (size_t e = 0; e < mesh->nelements; e++) group[e] = group_of(s, e);
    TRY(fracas_room_groups(&s->room, group, mesh->nelements, s->ngroups, &first, &of));
    number_nodes(s, first, of, copy, last);
    return FRACAS_OK;
}

/* ---- facets ---- */

/* Which side of an element goes from node to node, 3 if none does. */
static int side_of(const fracas_stored_element *element, int64_t from, int64_t to)
{
    int k = 0;
    while (k < 3 && (element->node[k] != from || element->node[(k + 1) % 3] != to)) k++;
    return k;
}

static void find_across(const shaping *s)
{
    for (size_t e = 0; e < s->mesh->nelements; e++)
        for (int k = 0; k < 3; k++) s->across[e][k] = -1;
    for (size_t i = 0; i < s->mesh->ninterfaces; i++)
        for (int end = 0; end < 2; end++) {
            const fracas_stored_interface *interface = &s->mesh->interface[i];
            const int64_t e = interface->element[end];
            const int k = side_of(&s->mesh->element[e], interface->node[end],
                                  interface->node[!end]);
            if (k < 3) s->across[e][k] = (int64_t)i;
        }
}

static double light_on(const double normal[3])
{
    return fmax(0, dot(normal, lamp) / sqrt(dot(normal, normal) + 1e-300));
}

/* Side k of an element is this one of its skin, and the other way round. */
static int side_in_skin(const fracas_facet *skin, int k)
{
    return skin->kind == FRACAS_FACET_INNER ? (4 - k) % 3 : k;
}

/* The skin of an element that faces the reader; the inner one is traversed the other way. */
static void put_skin(const shaping *s, size_t e)
{
    const uint32_t *corner = s->corner[e];
    const int64_t *node = s->mesh->element[e].node;
    fracas_facet *facet = &s->to->facet[e];
    double normal[3], smooth[3];
    normal_of(s->turned[node[0]], s->turned[node[1]], s->turned[node[2]], normal);
    const uint32_t inner = !(normal[2] > 0);
    for (int i = 0; i < 3; i++) {
        smooth[i] = s->normal[node[0]][i] + s->normal[node[1]][i] + s->normal[node[2]][i];
        if (inner) smooth[i] = -smooth[i];
    }
    *facet = (fracas_facet){.kind = inner ? FRACAS_FACET_INNER : FRACAS_FACET_OUTER,
                            .fragment = s->state->fragment[e],
                            .light = (float)light_on(smooth)};
    for (int k = 0; k < 3; k++) {
        const int from = 3 + side_in_skin(facet, k);
        facet->node[k] = corner[inner ? 2 - k : k] + inner;
        facet->middle[k] = node[from] < 0 ? -1 : (int32_t)(corner[from] + inner);
        facet->neighbour[k] = -1;
    }
}

static bool is_parted(const shaping *s, int64_t i)
{
    const int64_t *element = s->mesh->interface[i].element;
    return s->apart && s->state->fragment[element[0]] != s->state->fragment[element[1]];
}

/* Dust moved apart has neither lines nor cuts, which would hide it. */
static bool is_dust(const shaping *s, size_t e)
{
    return s->apart && s->state->elements[s->state->fragment[e]] <= FRACAS_SURFACE_DUST;
}

static void join_skins(const shaping *s)
{
    for (size_t e = 0; e < s->mesh->nelements; e++)
        for (int k = 0; k < 3; k++) {
            fracas_facet *skin = &s->to->facet[e];
            const int side = side_in_skin(skin, k);
            const int64_t i = s->across[e][k];
            skin->side[side] = FRACAS_SIDE_EDGE;
            if (i < 0) continue;
            const int64_t *element = s->mesh->interface[i].element,
                          other = element[element[0] == (int64_t)e];
            if (is_parted(s, i))
                skin->side[side] = is_dust(s, e) ? FRACAS_SIDE_NONE : FRACAS_SIDE_PARTED;
            else if (s->to->facet[other].kind == skin->kind) {
                skin->side[side] = s->state->interface[i];
                skin->neighbour[side] = (int32_t)other;
            }
        }
}

static void facet_normal(const shaping *s, const uint32_t node[3], double normal[3])
{
    double(*at)[3] = s->to->node;
    normal_of(at[node[0]], at[node[1]], at[node[2]], normal);
}

/* The cut at side k of an element, as far as it faces the reader: from its inner skin to its outer
 * one, seen from outside the element, in two halves. Where it meets the skin facing the reader, it
 * shares the line of the skin. */
static void put_cut(const shaping *s, size_t e, int k)
{
    const uint32_t *corner = s->corner[e], a = corner[k], b = corner[(k + 1) % 3];
    const bool curved = s->mesh->element[e].node[3 + k] >= 0,
               inner = s->to->facet[e].kind == FRACAS_FACET_INNER;
    const fracas_side line = s->across[e][k] < 0 ? FRACAS_SIDE_EDGE : FRACAS_SIDE_PARTED;
    const uint32_t node[2][3] = {{a + 1, b + 1, b},
                                 {b, a, a + 1}}; /* the inner edge first, and the outer one */
    double normal[2][3], sum[3];
    for (int half = 0; half < 2; half++) facet_normal(s, node[half], normal[half]);
    for (int i = 0; i < 3; i++) sum[i] = normal[0][i] + normal[1][i];
    for (int half = 0; half < 2; half++) {
        if (!(normal[half][2] > 0)) continue;
        fracas_facet *facet = &s->to->facet[s->to->nfacets++];
        const uint32_t *of = node[half];
        *facet = (fracas_facet){.node = {of[0], of[1], of[2]},
                                .neighbour = {-1, -1, -1},
                                .kind = FRACAS_FACET_CUT,
                                .fragment = s->state->fragment[e],
                                .light = (float)light_on(sum)};
        for (int i = 0; i < 3; i++) facet->middle[i] = -1, facet->side[i] = FRACAS_SIDE_NONE;
        if (curved) facet->middle[0] = (int32_t)corner[3 + k] + !half;
        if (inner == half) facet->side[0] = (uint8_t)line;
    }
    if (normal[0][2] > 0 && normal[1][2] > 0) { /* they share side 2 */
        const int32_t last = (int32_t)s->to->nfacets - 1;
        s->to->facet[last].neighbour[2] = last - 1;
        s->to->facet[last - 1].neighbour[2] = last;
    }
}

static bool is_cut(const shaping *s, size_t e, int k)
{
    return s->picture->thickness > 0 && !is_dust(s, e) &&
           (s->across[e][k] < 0 || is_parted(s, s->across[e][k]));
}

static fracas_err put_facets(const shaping *s)
{
    size_t cuts = 0;
    for (size_t e = 0; e < s->mesh->nelements; e++)
        for (int k = 0; k < 3; k++) cuts += is_cut(s, e, k);
    s->to->nfacets = s->to->nskin = s->mesh->nelements;
    s->to->nlayers = 1;
    s->to->facet = calloc(s->to->nskin + 2 * cuts + 1, sizeof *s->to->facet);
    if (!s->to->facet) return fracas_no_memory("the facets of a picture");
    for (size_t e = 0; e < s->mesh->nelements; e++) put_skin(s, e);
    join_skins(s);
    for (size_t e = 0; e < s->mesh->nelements; e++)
        for (int k = 0; k < 3; k++)
            if (is_cut(s, e, k)) put_cut(s, e, k);
    return FRACAS_OK;
}

static void shaping_clear(shaping *s)
{
    fracas_room_clear(&s->room);
}

fracas_err fracas_facets_create(const fracas_stored_mesh *mesh, const fracas_surface_state *state,
                                const fracas_surface_picture *picture, fracas_facets *facets)
{
    const bool apart = picture->explode > 0;
    FRACAS_CLEARED(shaping)
    s = {.mesh = mesh,
         .state = state,
         .picture = picture,
         .to = facets,
         .apart = apart,
         .ngroups = apart ? state->nfragments : 1};
    *facets = (fracas_facets){0};
    FRACAS_TAKE(&s.room, s.turned, mesh->nnodes);
    FRACAS_TAKE(&s.room, s.normal, mesh->nnodes);
    FRACAS_TAKE(&s.room, s.shift, s.ngroups);
    FRACAS_TAKE(&s.room, s.corner, mesh->nelements);
    FRACAS_TAKE(&s.room, s.across, mesh->nelements);
    TRY(fracas_room_check(&s.room, "a picture"));
    for (size_t n = 0; n < mesh->nnodes; n++)
        fracas_view_turn(picture->view, mesh->node[n].position, s.turned[n]);
    find_normals(&s);
    find_across(&s);
    TRY(find_shifts(&s));
    find_room(&s);
    TRY(place_nodes(&s));
    return put_facets(&s);
}

void fracas_facets_clear(fracas_facets *facets)
{
    free(facets->facet);
    free(facets->node);
    *facets = (fracas_facets){0};
}
