/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawings of surfaces in space, read again: what is painted last where, lengths of lines, areas,
 * bytes. Spheres and octants of 1 m, broken along the borders of Voronoi cells. */
#include "tests/support/body.h"
#include "tests/support/svg_path.h"

#include "analysis/draw/trail.h"
#include "analysis/draw/facets.h"

static char *draw(const body *b, const fracas_view *view, double explode, double thickness,
                  fracas_surface_show show)
{
    FILE *out = text_begin();
    const fracas_surface_picture picture = {"a body", show, 800, true, view, explode, thickness};
    OK(fracas_surface_picture_write(&b->mesh, &b->now, &picture, out));
    return text_end(out);
}

/* Length of the straight lines of all paths with this class, in units; how many edges. */
static double length_of(const char *svg, const char *class, size_t *edges)
{
    char start[64];
    double length = 0;
    *edges = 0;
    snprintf(start, sizeof start, "<path class=\"%s\"", class);
    for (const char *found = strstr(svg, start); found; found = strstr(found + 1, start)) {
        svg_pen pen = svg_begin(found);
        for (svg_edge edge; svg_next(&pen, &edge);) {
            length += hypot(edge.to[0] - edge.from[0], edge.to[1] - edge.from[1]);
            *edges += !edge.closes;
        }
    }
    return length;
}

/* ---- what a reader sees at a point ---- */

typedef struct {
    svg_edge edge;
    size_t path;
} stroke;

typedef struct {
    size_t npaths, count;
    uint8_t tint[512]; /* of each path */
    stroke stroke[200000];
} painting;

/* The opaque areas of a drawing of straight lines, in the order in which they are painted. */
static painting *read_areas(const char *svg)
{
    painting *all = zeroed(1, sizeof *all);
    for (const char *found = strstr(svg, "<path class=\""); found;
         found = strstr(found + 1, "<path class=\"")) {
        const char *class = found + strlen("<path class=\"");
        const bool dust = !strncmp(class, "dust-fill", 9),
                   tinted = class[0] == 't' && class[2] == '"';
        if (!dust && !tinted) continue;
        assert_true(all->npaths < 512);
        all->tint[all->npaths] = dust ? FRACAS_TINT_DUST : (uint8_t)(class[1] - '0');
        svg_pen pen = svg_begin(found);
        for (svg_edge edge; svg_next(&pen, &edge);) {
            assert_true(all->count < 200000);
            all->stroke[all->count++] = (stroke){edge, all->npaths};
        }
        all->npaths++;
    }
    return all;
}

/* The tint of the last area around a point by the even-odd rule, 99 where there is none, 100 within
 * 2 units of a line: rounding moves lines by 0.71. */
static uint8_t tint_at(const painting *all, const double point[2])
{
    bool inside[512] = {false};
    for (size_t s = 0; s < all->count; s++) {
        const double *a = all->stroke[s].edge.from, *b = all->stroke[s].edge.to,
                     square = pow(b[0] - a[0], 2) + pow(b[1] - a[1], 2);
        double share =
            square > 0
                ? ((point[0] - a[0]) * (b[0] - a[0]) + (point[1] - a[1]) * (b[1] - a[1])) / square
                : 0;
        share = fmin(fmax(share, 0), 1);
        if (hypot(a[0] + share * (b[0] - a[0]) - point[0],
                  a[1] + share * (b[1] - a[1]) - point[1]) < 2)
            return 100;
        if ((a[1] > point[1]) == (b[1] > point[1])) continue;
        if (a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]) > point[0])
            inside[all->stroke[s].path] = !inside[all->stroke[s].path];
    }
    for (size_t p = all->npaths; p > 0; p--)
        if (inside[p - 1]) return all->tint[p - 1];
    return 99;
}

/* The tint of the nearest facet, 99 beside all. */
static uint8_t nearest_tint(const fracas_facets *facets, const uint8_t *tint, const double point[2])
{
    double nearest = -INFINITY;
    uint8_t found = 99;
    bool close;
    for (size_t f = 0; f < facets->nfacets; f++) {
        const double depth = depth_at(facets, f, point, &close);
        if (depth > nearest) nearest = depth, found = tint[facets->facet[f].fragment];
    }
    return found;
}

/* The drawing itself, read again: at every point the fragment that is nearest there was painted
 * last. */
static void drawings_show_the_nearest(void **state)
{
    static const struct {
        bool octant;
        fracas_view view;
        double explode, thickness;
    } looks[] = {{false, {45, 35}, 0.15, 0.01},
                 {false, {200, -50}, 1, 0.1},
                 {true, {100, -10}, 0, 0.02},
                 {true, {-30, 10}, 0.15, 0.05}};
    for (size_t l = 0; l < sizeof looks / sizeof *looks; l++) {
        body b;
        uint8_t *tint;
        uint64_t x = 9;
        size_t seen = 0;
        fracas_frame frame;
        make_body(looks[l].octant, looks[l].octant ? 16 : 8, 1, 25, false, &b);
        FRACAS_CLEARED(fracas_facets)
        facets = look(&b, looks[l].view.azimuth, looks[l].view.elevation, looks[l].explode,
                      looks[l].thickness);
        OK(fracas_tint_fragments(&b.mesh, &b.now, &tint));
        OWNED char *svg = draw(&b, &looks[l].view, looks[l].explode, looks[l].thickness,
                               FRACAS_SHOW_FRAGMENTS);
        OWNED painting *all = read_areas(svg);
        fracas_frame_fit(facets.least, facets.largest, 800, &frame);
        for (int p = 0; p < 1500; p++) {
            const double pixel[2] = {800 * (double)(sample_bits(&x) >> 11) * 0x1p-53,
                                     frame.height * (double)(sample_bits(&x) >> 11) * 0x1p-53};
            const double unit[2] = {10 * pixel[0], 10 * pixel[1]};
            const double point[2] = {frame.corner[0] + (pixel[0] - frame.left) / frame.scale,
                                     frame.corner[1] - (pixel[1] - 8) / frame.scale};
            const uint8_t painted = tint_at(all, unit);
            if (painted == 100) continue;
            assert_int_equal(painted, nearest_tint(&facets, tint, point));
            seen += painted != 99;
        }
        assert_true(seen > 400);
        free(tint);
        clear_body(&b);
    }
}

/* Edges along which a sphere is cracked and whose two elements face (1, 1, 1): how many, and how
 * long in the plane across, in m. On the silhouette they are outlines. */
static size_t cracks_of(const body *b, fracas_interface_state state, double *length)
{
    const double r = sqrt(1.0 / 3);
    size_t count = 0;
    *length = 0;
    for (size_t i = 0; i < b->mesh.ninterfaces; i++) {
        const fracas_stored_interface *interface = &b->mesh.interface[i];
        const double *p = b->mesh.node[interface->node[0]].position,
                     *q = b->mesh.node[interface->node[1]].position;
        bool both = b->now.interface[i] == state;
        for (int side = 0; side < 2;
             side++) { /* an element of the sphere faces where its corners are */
            double toward = 0;
            for (int k = 0; k < 3; k++)
                for (int c = 0; c < 3; c++)
                    toward +=
                        b->mesh.node[b->mesh.element[interface->element[side]].node[k]].position[c];
            both = both && toward > 0;
        }
        double square = 0, along = 0;
        for (int c = 0; c < 3; c++)
            square += (q[c] - p[c]) * (q[c] - p[c]), along += r * (q[c] - p[c]);
        if (both) *length += sqrt(square - along * along), count++;
    }
    return count;
}

/* Each end of an edge is rounded by at most 0.71 units. */
static void cracks_have_their_length(void **state)
{
    static const struct {
        fracas_interface_state state;
        const char *class;
    } kinds[] = {{FRACAS_INTERFACE_BROKEN, "broken"},
                 {FRACAS_INTERFACE_CRACKED, "cracked"},
                 {FRACAS_INTERFACE_CLOSED, "mesh"}};
    body b;
    make_body(false, 8, 1, 30, true, &b);
    double least = INFINITY, largest = -INFINITY, exact, drawn[3];
    size_t edges;
    for (size_t n = 0; n < b.mesh.nnodes; n++) {
        const double *p = b.mesh.node[n].position;
        least = fmin(least, (p[1] - p[0]) / sqrt(2));
        largest = fmax(largest, (p[1] - p[0]) / sqrt(2));
    }
    const double scale = 7840 / (largest - least);
    char *svg = draw(&b, NULL, 0, 0, FRACAS_SHOW_MESH);
    for (int k = 0; k < 3; k++) {
        const size_t expected = cracks_of(&b, kinds[k].state, &exact);
        drawn[k] = length_of(svg, kinds[k].class, &edges);
        assert_true(expected > 40);
        assert_int_equal(edges, expected);
        assert_true(fabs(drawn[k] - scale * exact) < 1.42 * (double)expected);
    }
    assert_has(svg, "text-anchor=\"middle\">z</text>");
    free(svg);
    svg = draw(&b, NULL, 0, 0, FRACAS_SHOW_CRACKS);
    assert_true(length_of(svg, "broken", &edges) == drawn[0] &&
                length_of(svg, "cracked", &edges) == drawn[1]);
    assert_null(strstr(svg, "class=\"t0\""));
    assert_null(strstr(svg, "class=\"mesh\""));
    assert_has(svg, "class=\"body\"");
    free(svg);
    svg = draw(&b, NULL, 0.2, 0.01, FRACAS_SHOW_FRAGMENTS);
    assert_has(svg, ", fragments apart: 0.2</text>");
    free(svg);
    clear_body(&b);
}

/* Area inside the loops of all paths with these classes, in square units. */
static double filled(const char *svg, const char *classes)
{
    double sum = 0;
    for (const char *found = strstr(svg, "<path class=\""); found;
         found = strstr(found + 1, "<path class=\"")) {
        if (!strchr(classes, found[13]) || found[14] < '0' || found[14] > '9') continue;
        double area = 0;
        svg_pen pen = svg_begin(found);
        for (svg_edge edge; svg_next(&pen, &edge);) area += svg_area(&edge);
        sum += fabs(area);
    }
    return sum;
}

/* A coarse octant of quadratic triangles, from before and from behind: its parabolas make the area
 * that its arcs have, 3 pi/4/sqrt(3), to 0.01 %: of a parabola through the ends and the middle of
 * an arc of h = pi/2/6, whose height above the chord is wrong by h^2/16 of that, h^2/12 of the
 * area: h^4/192. Rounding: 0.71 units along an outline of some 3 widths. */
static void curved_edges_are_curved(void **state)
{
    static const fracas_view views[] = {{45, 35.264389682754654}, {225, -35.264389682754654}};
    body b;
    make_body(true, 6, 2, 4, false, &b);
    for (int v = 0; v < 2; v++) {
        OWNED char *svg = draw(&b, &views[v], 0, 0, FRACAS_SHOW_FRAGMENTS);
        const double scale = 7840 / sqrt(2),
                     exact = 3 * M_PI / 4 / sqrt(3) * scale * scale; /* from x = 1 to y = 1 */
        assert_true(fabs(filled(svg, "t") / exact - 1) < 1e-4 + 0.71 * 3 * 7840 / exact);
    }
    clear_body(&b);
}

/* From behind, each of the three planes in which an octant is cut has a shade of its own, at once.
 */
static void cuts_are_shaded(void **state)
{
    static const fracas_view behind = {225, -35.264389682754654};
    body b;
    make_body(true, 10, 1, 0, false, &b);
    OWNED char *thin = draw(&b, &behind, 0, 0, FRACAS_SHOW_FRAGMENTS),
               *thick = draw(&b, &behind, 0, 0.02, FRACAS_SHOW_FRAGMENTS);
    assert_true(count_of(thick, " fill-opacity=\"0.") >= count_of(thin, " fill-opacity=\"0.") + 3);
    clear_body(&b);
}

/* A plate that lies flat, seen from above by a view of its own, has its fragments where the flat
 * picture has them; from below it shows its other side, upside down. The lamp is 0.8 of its length
 * toward the reader: the share 0.45 + 0.55 0.8 = 0.89 of the light comes back from above, which is
 * 6 shades of 0.98 (0.886), and 0.6 of that from the inner side, 31 shades (0.535). */
static void flat_surfaces_can_be_looked_at_too(void **state)
{
    static const fracas_view above = {-90, 90}, below = {-90, -90};
    const grid_shape plate = {.nx = 6, .ny = 4};
    body b = {.cell = NULL};
    size_t edges, flat_edges;
    grid_make(&plate, &b.mesh);
    grid_record(&b.mesh, 10, &b.record);
    for (size_t j = 0; j < 4; j++)
        assert_true(grid_crack(&b.mesh, &b.record, grid_vertex(&plate, 2, j),
                               grid_vertex(&plate, 2, j + 1), 1, 2));
    OK(fracas_surface_state_create(&b.mesh, &b.record, 5, &b.now));
    OWNED char *flat = draw(&b, NULL, 0, 0, FRACAS_SHOW_FRAGMENTS);
    const double length = length_of(flat, "broken", &flat_edges);
    assert_null(strstr(flat, "shade"));
    for (int side = 0; side < 2; side++) {
        OWNED char *svg = draw(&b, side ? &below : &above, 0, 0, FRACAS_SHOW_FRAGMENTS);
        assert_true(fabs(length_of(svg, "broken", &edges) - length) <= 4);
        assert_int_equal(edges, flat_edges);
        assert_has(svg, side ? "fill-opacity=\"0.465\"" : "fill-opacity=\"0.114\"");
        assert_has(svg, "M2693 "); /* 8 + 784/3 pixels from the left, either way up */
    }
    clear_body(&b);
}

/* 20 000 elements: in cells, broken at random, and all of them apart, with the thickness of the
 * sphere that was broken first. */
static void pictures_of_bodies_stay_small(void **state)
{
    uint64_t random = 7;
    body b;
    make_body(false, 31, 2, 60, false, &b);
    for (unsigned share = 0; share <= 100; share += 50) {
        for (size_t i = 0; share > 0 && i < b.mesh.ninterfaces; i++)
            b.record.interface[i].break_time = sample_bits(&random) % 100 < share ? 1 : NAN;
        fracas_surface_state_clear(&b.now);
        OK(fracas_surface_state_create(&b.mesh, &b.record, 5, &b.now));
        for (int apart = 0; apart < 2; apart++) {
            OWNED char *svg = draw(&b, NULL, 0.15 * apart, 0.01, FRACAS_SHOW_FRAGMENTS);
            assert_true(strlen(svg) < (apart ? 2000000 : 1000000));
        }
    }
    clear_body(&b);
}

TESTS(drawings_show_the_nearest, cracks_have_their_length, curved_edges_are_curved, cuts_are_shaded,
      flat_surfaces_can_be_looked_at_too, pictures_of_bodies_stay_small)
