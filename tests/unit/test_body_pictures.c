/* Surfaces in space: which of their elements show, where and in what order, against closed forms and a search for what is nearest.
 * Spheres and octants of 1 m, broken along the borders of Voronoi cells. */
#include "tests/support/body.h"
#include "tests/support/store_sample.h"

#include "analysis/report/facets.h"
#include "analysis/report/surface_picture.h"

typedef struct {
    fracas_stored_mesh mesh;
    fracas_record record;
    fracas_surface_state now;
    uint32_t *cell;
} body;

/* cells: 0 for none broken. */
static void make_body(bool octant, size_t divisions, int order, size_t cells, bool late, body *b)
{
    const fracas_surface_fineness fineness = {.divisions = divisions, .order = order};
    const fracas_surface *surface;
    if (octant) OK(fracas_surface_octant(1, &fineness, &surface));
    else OK(fracas_surface_sphere(1, &fineness, &surface));
    body_copy(surface, &b->mesh);
    assert_null(fracas_stored_mesh_fault(&b->mesh));
    b->cell = body_break(&b->mesh, cells ? cells : 1, octant, late, &b->record);
    OK(fracas_surface_state_create(&b->mesh, &b->record, 5, &b->now));
    assert_true(late || b->now.nfragments >= (cells ? cells / 2 : 1));
}

static void clear_body(body *b)
{
    fracas_surface_state_clear(&b->now);
    fracas_record_clear(&b->record);
    fracas_stored_mesh_clear(&b->mesh);
    free(b->cell);
}

static fracas_facets look(const body *b, double azimuth, double elevation, double explode, double thickness)
{
    const fracas_facets_form form = {{azimuth, elevation}, explode, thickness};
    fracas_facets facets;
    OK(fracas_facets_create(&b->mesh, &b->now, &form, &facets));
    OK(fracas_facets_hide(&facets));
    return facets;
}

static double turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static const double *corner(const fracas_facets *facets, size_t f, int k)
{
    return facets->node[facets->facet[f].node[k]];
}

static double area_of(const fracas_facets *facets, size_t f)
{
    return turn(corner(facets, f, 0), corner(facets, f, 1), corner(facets, f, 2)) / 2;
}

/* Largest circumradius of an element: the planes of the elements are at least sqrt(1 - that^2) from the centre. */
static double widest(const fracas_stored_mesh *mesh)
{
    double largest = 0;
    for (size_t e = 0; e < mesh->nelements; e++) {
        double edge[3], s = 0;
        for (int k = 0; k < 3; k++) {
            const double *a = mesh->node[mesh->element[e].node[k]].position, *b = mesh->node[mesh->element[e].node[(k + 1) % 3]].position;
            edge[k] = hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
            s += edge[k] / 2;
        }
        const double area = sqrt(s * (s - edge[0]) * (s - edge[1]) * (s - edge[2]));
        largest = fmax(largest, edge[0] * edge[1] * edge[2] / (4 * area));
    }
    return largest;
}

/* The mesh has a centre, and no element is seen edge on: of each pair across it one faces the reader. The polyhedron is between the
 * sphere that its planes touch at least and its own: so is what it covers, to rounding. */
static void half_of_a_sphere_shows(void **state)
{
    (void)state;
    static const double view[][2] = {{45, 35.264389682754654}, {20, 30}, {-100, -70}, {0.3, 89.1}, {-90, 90}};
    body b;
    make_body(false, 8, 2, 30, false, &b);
    const double c = widest(&b.mesh);
    for (size_t v = 0; v < sizeof view / sizeof *view; v++) {
        fracas_facets facets = look(&b, view[v][0], view[v][1], 0, 0);
        size_t shown = 0, outer = 0;
        double area = 0;
        assert_int_equal(facets.nfacets, b.mesh.nelements);
        for (size_t f = 0; f < facets.nfacets; f++) {
            if (fabs(area_of(&facets, f)) < 1e-12) continue; /* the last two views look along edges of the icosahedron */
            outer += facets.facet[f].kind == FRACAS_FACET_OUTER;
            shown += facets.facet[f].layer == 0;
            assert_int_equal(facets.facet[f].layer, facets.facet[f].kind == FRACAS_FACET_OUTER ? 0 : -1);
            if (facets.facet[f].layer >= 0) area += area_of(&facets, f);
        }
        if (v < 3) assert_int_equal(2 * outer, b.mesh.nelements);
        assert_int_equal(outer, shown);
        assert_true(area < M_PI && area > M_PI * (1 - c * c));
        fracas_facets_clear(&facets);
    }
    assert_true(c < 0.15);
    clear_body(&b);
}

/* From (1, 1, 1) all of its outer skin, from (-1, -1, -1) all of the inner one. The arcs of its borders are ellipses there, each
 * triangle from the centre pi/4 / sqrt(3); straight edges lose h^2/6 of a sector's area, h = pi/2/20. */
static void all_of_an_octant_shows(void **state)
{
    (void)state;
    body b;
    make_body(true, 20, 1, 20, false, &b);
    const double h = M_PI / 2 / 20, exact = 3 * M_PI / 4 / sqrt(3);
    for (int side = 1; side >= -1; side -= 2) {
        fracas_facets facets = look(&b, side > 0 ? 45 : 225, side * 35.264389682754654, 0, 0);
        double area = 0;
        for (size_t f = 0; f < facets.nfacets; f++) {
            assert_int_equal(facets.facet[f].kind, side > 0 ? FRACAS_FACET_OUTER : FRACAS_FACET_INNER);
            assert_int_equal(facets.facet[f].layer, 0);
            assert_true(area_of(&facets, f) > 0);
            area += area_of(&facets, f);
        }
        assert_true(area < exact && area > exact * (1 - h * h / 6 - 1e-12));
        fracas_facets_clear(&facets);
    }
    clear_body(&b);
}

/* The view along z has x to the right and y upward; from (1, 0, 0) these are y and z; turning keeps lengths. */
static void views_turn(void **state)
{
    (void)state;
    static const fracas_view view[] = {{-90, 90}, {0, 0}, {45, 35.264389682754654}};
    static const double expected[][3] = {{1, 2, 3}, {2, 3, 1}, {0.70710678118654757, 1.2247448713915889, 3.4641016151377544}};
    const double vector[3] = {1, 2, 3};
    for (int v = 0; v < 3; v++) {
        double turned[3];
        fracas_view_turn(&view[v], vector, turned);
        for (int i = 0; i < 3; i++) assert_true(fabs(turned[i] - expected[v][i]) < 4e-15); /* 9 roundings of numbers up to 4 */
    }
}

/* ---- what is before what ---- */

/* How near a facet is at a point, -INFINITY beside it; `close` is set where the point is on an edge, to 1e-6 of the facet. */
static double depth_at(const fracas_facets *facets, size_t f, const double point[2], bool *close)
{
    double share[3], depth = 0;
    for (int k = 0; k < 3; k++) {
        share[k] = turn(corner(facets, f, (k + 1) % 3), corner(facets, f, (k + 2) % 3), point) / (2 * area_of(facets, f));
        if (!(share[k] > -1e-6)) return -INFINITY;
        if (share[k] < 1e-6) *close = true;
        depth += share[k] * corner(facets, f, k)[2];
    }
    return depth;
}

/* What is drawn last at a point is what is nearest there: a search over all facets. Points are spread at random. */
static void assert_nearest_last(const fracas_facets *facets, size_t at_least)
{
    uint64_t x = 5;
    size_t wrong = 0, seen = 0;
    const size_t points = 4000;
    for (size_t p = 0; p < points; p++) {
        double point[2], nearest = -INFINITY;
        size_t front = SIZE_MAX, last = SIZE_MAX;
        bool close = false;
        for (int i = 0; i < 2; i++)
            point[i] = facets->least[i] + (facets->largest[i] - facets->least[i]) * (double)(sample_bits(&x) >> 11) * 0x1p-53;
        for (size_t f = 0; f < facets->nfacets; f++) {
            const double depth = depth_at(facets, f, point, &close);
            if (depth == -INFINITY) continue;
            if (depth > nearest) nearest = depth, front = f;
            const int32_t layer = facets->facet[f].layer;
            if (layer < 0) continue;
            if (last == SIZE_MAX || layer < facets->facet[last].layer) last = f;
        }
        if (close || front == SIZE_MAX) continue;
        seen++;
        wrong += front != last;
    }
    assert_true(seen >= at_least);
    assert_int_equal(wrong, 0);
}

static void the_nearest_is_drawn_last(void **state)
{
    (void)state;
    static const struct {
        bool octant;
        double view[2], explode, thickness;
    } looks[] = {
        {true, {225, -35}, 0, 0},      {true, {225, -35}, 0.2, 0.02}, {true, {100, -10}, 0, 0.02}, {true, {-30, 10}, 0.15, 0.05},
        {false, {45, 35}, 0.15, 0.01}, {false, {10, 0}, 0.4, 0},      {false, {200, -50}, 1, 0.1}};
    for (size_t l = 0; l < sizeof looks / sizeof *looks; l++) {
        body b;
        make_body(looks[l].octant, looks[l].octant ? 16 : 8, 2, 25, false, &b);
        fracas_facets facets = look(&b, looks[l].view[0], looks[l].view[1], looks[l].explode, looks[l].thickness);
        size_t hidden = 0;
        for (size_t f = 0; f < facets.nfacets; f++) hidden += facets.facet[f].layer < 0;
        if (!looks[l].octant) assert_true(hidden > 50); /* through gaps some of the inner side shows */
        assert_true(facets.nlayers < 32);
        assert_nearest_last(&facets, 1000);
        fracas_facets_clear(&facets);
        clear_body(&b);
    }
}

/* ---- fragments apart, and the thickness ---- */

/* A fragment moves as a whole: what its facets move by is 0.3 of the way from the centroid of all to its own, of straight triangles,
 * to the rounding of a few hundred sums. */
static void fragments_move_apart(void **state)
{
    (void)state;
    body b;
    make_body(true, 12, 2, 9, false, &b);
    fracas_facets still = look(&b, 45, 35, 0, 0), apart = look(&b, 45, 35, 0.3, 0);
    const fracas_view view = {45, 35};
    const size_t nfragments = b.now.nfragments;
    double (*centre)[4] = calloc(nfragments + 1, sizeof *centre); /* the last one of all */
    assert_non_null(centre);
    for (size_t e = 0; e < b.mesh.nelements; e++) {
        const double *p[3];
        double n[3], middle[3], turned[3];
        for (int k = 0; k < 3; k++) p[k] = b.mesh.node[b.mesh.element[e].node[k]].position;
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            n[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
            middle[i] = (p[0][i] + p[1][i] + p[2][i]) / 3;
        }
        const double area = hypot(hypot(n[0], n[1]), n[2]);
        fracas_view_turn(&view, middle, turned);
        for (size_t to = b.now.fragment[e];; to = nfragments) {
            for (int i = 0; i < 3; i++) centre[to][i] += area * turned[i];
            centre[to][3] += area;
            if (to == nfragments) break;
        }
    }
    for (size_t f = 0; f < still.nskin; f++)
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++) {
                const double *own = centre[still.facet[f].fragment], *all = centre[nfragments];
                const double moved = corner(&apart, f, k)[i] - corner(&still, f, k)[i];
                assert_true(fabs(moved - 0.3 * (own[i] / own[3] - all[i] / all[3])) < 1e-13);
                if (i < 2) assert_true(corner(&apart, f, k)[i] >= apart.least[i] && corner(&apart, f, k)[i] <= apart.largest[i]);
            }
    for (int i = 0; i < 2; i++) /* the frame is that of any time */
        assert_true(fabs((apart.largest[i] - apart.least[i]) - 1.3 * (still.largest[i] - still.least[i])) < 1e-14);
    free(centre);
    fracas_facets_clear(&still);
    fracas_facets_clear(&apart);
    clear_body(&b);
}

/* From (-1, 0, 0) the cut at x = 0 lies across the view: a quarter of the ring from 1 - t/2 to 1 + t/2, of area pi/2 t. Straight edges
 * lose h^2/6 of it; a normal at a border is the mean of one side alone, up to h/2 aside, which loses h^2/8: 0.2 % with h = 0.08. */
static void the_thickness_shows_at_borders(void **state)
{
    (void)state;
    body b;
    make_body(true, 20, 1, 0, false, &b);
    const double t = 0.04, exact = M_PI / 2 * t;
    fracas_facets back = look(&b, 225, -35.264389682754654, 0, t), front = look(&b, 45, 35.264389682754654, 0, t);
    fracas_facets side = look(&b, 180, 0, 0, t);
    double area = 0;
    size_t lines = 0;
    for (size_t f = back.nskin; f < back.nfacets; f++) {
        assert_int_equal(back.facet[f].kind, FRACAS_FACET_CUT);
        for (int k = 0; k < 3; k++) lines += back.facet[f].side[k] == FRACAS_SIDE_EDGE;
    }
    assert_int_equal(back.nfacets - back.nskin, 2 * b.mesh.nborders); /* two halves each */
    assert_int_equal(lines, b.mesh.nborders); /* along the far skin; that which faces the reader has its own */
    assert_int_equal(front.nfacets, front.nskin); /* cuts are turned away */
    for (size_t f = side.nskin; f < side.nfacets; f++) {
        bool there = true;
        for (int k = 0; k < 3; k++) there = there && fabs(corner(&side, f, k)[2]) < t * 0.08;
        if (there) area += area_of(&side, f);
        if (there) assert_int_equal(side.facet[f].layer, 0);
    }
    assert_true(fabs(area / exact - 1) < 0.002);
    fracas_facets_clear(&back);
    fracas_facets_clear(&front);
    fracas_facets_clear(&side);
    clear_body(&b);
}

/* ---- drawings ---- */

static char *draw(const body *b, const fracas_view *view, double explode, double thickness, fracas_surface_show show)
{
    char *text;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    const fracas_surface_picture picture = {"a body", show, 800, true, view, explode, thickness};
    OK(fracas_surface_picture_write(&b->mesh, &b->now, &picture, out));
    fclose(out);
    return text;
}

/* Length of the straight lines of all paths with this class, in units; how many edges. */
static double length_of(const char *svg, const char *class, size_t *edges)
{
    char start[64];
    double length = 0;
    *edges = 0;
    snprintf(start, sizeof start, "<path class=\"%s\"", class);
    for (const char *found = strstr(svg, start); found; found = strstr(found + 1, start)) {
        char command = 0;
        for (const char *d = strstr(found, " d=\"") + 4; *d != '"';) {
            if (*d == 'M' || *d == 'l' || *d == 'z') {
                command = *d++;
                continue;
            }
            char *end;
            const double x = strtod(d, &end), y = strtod(end, (char **)&d);
            while (*d == ' ') d++;
            if (command == 'l') length += hypot(x, y), ++*edges;
        }
    }
    return length;
}

/* Edges along which a sphere is cracked and whose two elements face (1, 1, 1): how many, and how long in the plane across, in m. On the
 * silhouette they are outlines. */
static size_t cracks_of(const body *b, fracas_interface_state state, double *length)
{
    const double r = sqrt(1.0 / 3);
    size_t count = 0;
    *length = 0;
    for (size_t i = 0; i < b->mesh.ninterfaces; i++) {
        const fracas_stored_interface *interface = &b->mesh.interface[i];
        const double *p = b->mesh.node[interface->node[0]].position, *q = b->mesh.node[interface->node[1]].position;
        bool both = b->now.interface[i] == state;
        for (int side = 0; side < 2; side++) { /* an element of the sphere faces where its corners are */
            double toward = 0;
            for (int k = 0; k < 3; k++)
                for (int c = 0; c < 3; c++) toward += b->mesh.node[b->mesh.element[interface->element[side]].node[k]].position[c];
            both = both && toward > 0;
        }
        double square = 0, along = 0;
        for (int c = 0; c < 3; c++) square += (q[c] - p[c]) * (q[c] - p[c]), along += r * (q[c] - p[c]);
        if (both) *length += sqrt(square - along * along), count++;
    }
    return count;
}

/* Each end of an edge is rounded by at most 0.71 units. */
static void cracks_have_their_length(void **state)
{
    (void)state;
    static const struct {
        fracas_interface_state state;
        const char *class;
    } kinds[] = {{FRACAS_INTERFACE_BROKEN, "broken"}, {FRACAS_INTERFACE_CRACKED, "cracked"}, {FRACAS_INTERFACE_CLOSED, "mesh"}};
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
    assert_non_null(strstr(svg, "text-anchor=\"middle\">z</text>"));
    free(svg);
    svg = draw(&b, NULL, 0, 0, FRACAS_SHOW_CRACKS);
    assert_true(length_of(svg, "broken", &edges) == drawn[0] && length_of(svg, "cracked", &edges) == drawn[1]);
    assert_null(strstr(svg, "class=\"t0\""));
    assert_null(strstr(svg, "class=\"mesh\""));
    assert_non_null(strstr(svg, "class=\"body\""));
    free(svg);
    svg = draw(&b, NULL, 0.2, 0.01, FRACAS_SHOW_FRAGMENTS);
    assert_non_null(strstr(svg, ", fragments apart: 0.2</text>"));
    free(svg);
    clear_body(&b);
}

/* Area inside the loops of all paths with these classes, in square units; a parabola has 2/3 of its triangle beside its chord. */
static double filled(const char *svg, const char *classes)
{
    double sum = 0;
    for (const char *found = strstr(svg, "<path class=\""); found; found = strstr(found + 1, "<path class=\"")) {
        if (!strchr(classes, found[13]) || found[14] < '0' || found[14] > '9') continue;
        double x = 0, y = 0, first[2] = {0, 0}, control[2], area = 0;
        char command = 0;
        bool half = false;
        for (const char *d = strstr(found, " d=\"") + 4; *d != '"';) {
            if (strchr("Mlqz", *d)) {
                command = *d++;
                if (command == 'z') area += (x * first[1] - first[0] * y) / 2;
                continue;
            }
            char *end;
            const double a = strtod(d, &end), c = strtod(end, (char **)&d);
            while (*d == ' ') d++;
            if (command == 'M') {
                x = first[0] = a, y = first[1] = c;
            } else if (command == 'q' && !half) {
                control[0] = a, control[1] = c, half = true;
            } else {
                if (half) area += 2.0 / 3 * (control[0] * c - control[1] * a) / 2;
                area += (x * (y + c) - (x + a) * y) / 2;
                x += a, y += c, half = false;
            }
        }
        sum += fabs(area);
    }
    return sum;
}

/* A coarse octant of quadratic triangles, from before and from behind: its parabolas make the area that its arcs have, 3 pi/4/sqrt(3),
 * to 0.01 %: of a parabola through the ends and the middle of an arc of h = pi/2/6, whose height above the chord is wrong by
 * h^2/16 of that, h^2/12 of the area: h^4/192. Rounding: 0.71 units along an outline of some 3 widths. */
static void curved_edges_are_curved(void **state)
{
    (void)state;
    static const fracas_view views[] = {{45, 35.264389682754654}, {225, -35.264389682754654}};
    body b;
    make_body(true, 6, 2, 4, false, &b);
    for (int v = 0; v < 2; v++) {
        char *svg = draw(&b, &views[v], 0, 0, FRACAS_SHOW_FRAGMENTS);
        const double scale = 7840 / sqrt(2), exact = 3 * M_PI / 4 / sqrt(3) * scale * scale; /* from x = 1 to y = 1 */
        assert_true(fabs(filled(svg, "t") / exact - 1) < 1e-4 + 0.71 * 3 * 7840 / exact);
        free(svg);
    }
    clear_body(&b);
}

/* A plate that lies flat, seen from above by a view of its own, has its fragments where the flat picture has them; from below it
 * shows its other side, upside down. The lamp is 0.8 of its length toward the reader: the share 0.45 + 0.55 0.8 = 0.89 of the light comes
 * back from above, which is 6 shades of 0.98 (0.886), and 0.6 of that from the inner side, 31 shades (0.535). */
static void flat_surfaces_can_be_looked_at_too(void **state)
{
    (void)state;
    static const fracas_view above = {-90, 90}, below = {-90, -90};
    const grid_shape plate = {.nx = 6, .ny = 4};
    body b = {.cell = NULL};
    size_t edges, flat_edges;
    grid_make(&plate, &b.mesh);
    grid_record(&b.mesh, 10, &b.record);
    for (size_t j = 0; j < 4; j++)
        assert_true(grid_crack(&b.mesh, &b.record, grid_vertex(&plate, 2, j), grid_vertex(&plate, 2, j + 1), 1, 2));
    OK(fracas_surface_state_create(&b.mesh, &b.record, 5, &b.now));
    char *flat = draw(&b, NULL, 0, 0, FRACAS_SHOW_FRAGMENTS);
    const double length = length_of(flat, "broken", &flat_edges);
    assert_null(strstr(flat, "shade"));
    for (int side = 0; side < 2; side++) {
        char *svg = draw(&b, side ? &below : &above, 0, 0, FRACAS_SHOW_FRAGMENTS);
        assert_true(fabs(length_of(svg, "broken", &edges) - length) <= 4);
        assert_int_equal(edges, flat_edges);
        assert_non_null(strstr(svg, side ? "fill-opacity=\"0.465\"" : "fill-opacity=\"0.114\""));
        assert_non_null(strstr(svg, "M2693 ")); /* 8 + 784/3 pixels from the left, either way up */
        free(svg);
    }
    free(flat);
    clear_body(&b);
}

/* 20 000 elements: in cells, broken at random, and all of them apart, with the thickness of the sphere that was broken first. */
static void pictures_of_bodies_stay_small(void **state)
{
    (void)state;
    uint64_t random = 7;
    body b;
    make_body(false, 31, 2, 60, false, &b);
    for (unsigned share = 0; share <= 100; share += 50) {
        for (size_t i = 0; share > 0 && i < b.mesh.ninterfaces; i++)
            b.record.interface[i].break_time = sample_bits(&random) % 100 < share ? 1 : NAN;
        fracas_surface_state_clear(&b.now);
        OK(fracas_surface_state_create(&b.mesh, &b.record, 5, &b.now));
        for (int apart = 0; apart < 2; apart++) {
            char *svg = draw(&b, NULL, 0.15 * apart, 0.01, FRACAS_SHOW_FRAGMENTS);
            assert_true(strlen(svg) < (apart ? 2000000 : 1000000));
            free(svg);
        }
    }
    clear_body(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_of_a_sphere_shows),
        cmocka_unit_test(all_of_an_octant_shows),
        cmocka_unit_test(views_turn),
        cmocka_unit_test(the_nearest_is_drawn_last),
        cmocka_unit_test(fragments_move_apart),
        cmocka_unit_test(the_thickness_shows_at_borders),
        cmocka_unit_test(cracks_have_their_length),
        cmocka_unit_test(curved_edges_are_curved),
        cmocka_unit_test(flat_surfaces_can_be_looked_at_too),
        cmocka_unit_test(pictures_of_bodies_stay_small),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
