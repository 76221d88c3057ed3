/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Broken surfaces: their state at a time, cracks through the width, their pictures, and what
 * `fracas picture` refuses. Meshes are made by hand: grids of squares of 1 m, cut in two. Bars and
 * rings as strips. */
#include "tests/support/store_sample.h"
#include "tests/support/stored_mesh.h"
#include "tests/support/svg_path.h"

#include "analysis/data/strip.h"
#include "analysis/draw/facets.h"
#include "analysis/draw/surface_picture.h"
#include "base/hash.h"

static const grid_shape plate = {.nx = 6, .ny = 4}, ring = {.nx = 12, .ny = 3, .rolled = true};

/* Breaks the vertical line at column `i` from row `from` to row `to`: the interface above row j at
 * time start + j. */
static void crack_up(const grid_shape *shape, const fracas_stored_mesh *mesh, fracas_record *record,
                     size_t i, size_t from, size_t to, double start)
{
    for (size_t j = from; j < to; j++)
        assert_true(grid_crack(mesh, record, grid_vertex(shape, i, j), grid_vertex(shape, i, j + 1),
                               start + (double)j - 0.5, start + (double)j));
}

/* The horizontal line at row `j`, likewise. */
static void crack_across(const grid_shape *shape, const fracas_stored_mesh *mesh,
                         fracas_record *record, size_t j, size_t from, size_t to, double start)
{
    for (size_t i = from; i < to; i++)
        assert_true(grid_crack(mesh, record, grid_vertex(shape, i, j), grid_vertex(shape, i + 1, j),
                               start + (double)i - 0.5, start + (double)i));
}

static void assert_state(const fracas_stored_mesh *mesh, const fracas_record *record, double time,
                         size_t fragments, size_t cracked, size_t broken)
{
    FRACAS_CLEARED(fracas_surface_state) state;
    OK(fracas_surface_state_create(mesh, record, time, &state));
    assert_int_equal(state.nfragments, fragments);
    assert_int_equal(state.ncracked, cracked);
    assert_int_equal(state.nbroken, broken);
    size_t sum = 0;
    for (size_t f = 0; f < state.nfragments; f++) sum += state.elements[f];
    assert_int_equal(sum, mesh->nelements);
}

/* A vertical cut at column 2 makes pieces of 2 by 4 and 4 by 4 squares; one along row 1 then 4 of
 * them. */
static void a_plate_is_cut_in_two_and_in_four(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_surface_state) now;
    fracas_surface_times times;
    grid_make(&plate, &mesh);
    assert_null(fracas_stored_mesh_fault(&mesh));
    assert_int_equal(mesh.ninterfaces, 6 * 4 + 5 * 4 + 6 * 3);
    grid_record(&mesh, 100, &record);
    OK(fracas_surface_times_of(&mesh, &record, &times));
    assert_true(isnan(times.onset) && isnan(times.broken) && isnan(times.through[0]) &&
                isnan(times.through[1]));
    assert_state(&mesh, &record, 100, 1, 0, 0);
    crack_up(&plate, &mesh, &record, 2, 0, 4, 10);     /* breaks at 10, 11, 12, 13 */
    crack_across(&plate, &mesh, &record, 1, 0, 6, 20); /* at 20 to 25 */
    assert_state(&mesh, &record, 9.4, 1, 0, 0);
    assert_state(&mesh, &record, 9.5, 1, 1, 0); /* cracked from the very time on */
    assert_state(&mesh, &record, 10, 1, 0, 1);
    assert_state(&mesh, &record, 12.5, 1, 1, 3);
    assert_state(&mesh, &record, 13, 2, 0, 4);
    assert_state(&mesh, &record, 21, 3, 0, 6); /* the left half is cut through first */
    assert_state(&mesh, &record, 25, 4, 0, 10);
    OK(fracas_surface_state_create(&mesh, &record, 13, &now));
    for (size_t e = 0; e < mesh.nelements; e++)
        assert_int_equal(now.fragment[e], e / 2 % plate.nx >= 2);
    assert_int_equal(now.elements[0], 2 * 2 * 4);
    assert_int_equal(now.ndust, 0);
    OK(fracas_surface_times_of(&mesh, &record, &times));
    assert_true(times.onset == 9.5 && times.broken == 10);
    assert_true(times.through[1] == 13); /* bottom to top */
    assert_true(times.through[0] == 25); /* left to right */
}

/* One element cut out, or two that are neighbours: dust. Three are none. Elements 0 and 1 are a
 * square, 3 is beside 0, and 2 beside 3. */
static void small_pieces_are_dust(void **state)
{
    static const struct {
        unsigned cut; /* bit e: element e is cut out */
        size_t fragments, dust;
    } expected[] = {
        {1, 2, 1}, {1 | 2, 2, 1}, {1 | 2 | 4, 3, 2}, {1 | 2 | 8, 2, 0}, {1 | 2 | 4 | 8, 2, 0}};
    for (size_t k = 0; k < sizeof expected / sizeof *expected; k++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh;
        FRACAS_CLEARED(fracas_record) record;
        FRACAS_CLEARED(fracas_surface_state) now;
        grid_make(&plate, &mesh);
        grid_record(&mesh, 1, &record);
        for (size_t i = 0; i < mesh.ninterfaces; i++) {
            const int64_t *element = mesh.interface[i].element;
            bool inside[2];
            for (int side = 0; side < 2; side++)
                inside[side] = element[side] < 4 && expected[k].cut >> element[side] & 1;
            if (inside[0] != inside[1]) record.interface[i].break_time = 0.5;
        }
        OK(fracas_surface_state_create(&mesh, &record, 1, &now));
        assert_int_equal(now.nfragments, expected[k].fragments);
        assert_int_equal(now.ndust, expected[k].dust);
    }
}

/* Inner and outer edge are connected by the last of the broken interfaces, wherever it is and
 * whatever breaks elsewhere. */
static void a_ring_cracks_through(void **state)
{
    static const int64_t width[2] = {1, 2}, nowhere[2] = {1, 7};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    double time;
    grid_make(&ring, &mesh);
    assert_null(fracas_stored_mesh_fault(&mesh));
    grid_record(&mesh, 100, &record);
    crack_up(&ring, &mesh, &record, 3, 0, 2, 1); /* from within, but not to the end */
    crack_up(&ring, &mesh, &record, 7, 1, 3, 1); /* from the outside, elsewhere */
    crack_across(&ring, &mesh, &record, 1, 8, 12, 5);
    OK(fracas_surface_through(&mesh, &record, width, &time));
    assert_true(isnan(time));
    crack_across(&ring, &mesh, &record, 2, 3, 7, 40); /* joins both: at 46 */
    OK(fracas_surface_through(&mesh, &record, width, &time));
    assert_true(time == 46);
    assert_state(&mesh, &record, 46, 1, 0,
                 12); /* through, yet in one piece: a ring is cut by two such cracks */
    assert_true(grid_crack(&mesh, &record, grid_vertex(&ring, 4, 2), grid_vertex(&ring, 5, 2), 2,
                           NAN)); /* cracked, not broken */
    OK(fracas_surface_through(&mesh, &record, width, &time));
    assert_true(isnan(time));
    OK(fracas_surface_through(&mesh, &record, nowhere, &time));
    assert_true(isnan(time));
    record.ninterface--;
    FAILS(fracas_surface_through(&mesh, &record, width, &time), FRACAS_DAMAGED,
          "has 95 interfaces, the mesh of its point 96");
}

/* A plate whose left and lower edge meet in a corner: every crack from there would reach both. */
static void edges_that_meet_have_no_width(void **state)
{
    static const int64_t corner[2] = {1, 3};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    double time;
    grid_make(&plate, &mesh);
    grid_record(&mesh, 100, &record);
    crack_up(&plate, &mesh, &record, 2, 0, 4, 10);
    crack_across(&plate, &mesh, &record, 1, 0, 6, 20);
    OK(fracas_surface_through(&mesh, &record, corner, &time));
    assert_true(isnan(time));
}

/* Against a second algorithm: at every break time, walk from the inner edge over all interfaces
 * broken by then. */
static bool walk_through(const fracas_stored_mesh *mesh, const fracas_record *record, double time)
{
    bool reached[512] = {false}, grown = true;
    assert_true(mesh->nnodes <= 512);
    for (size_t i = 0; i < mesh->ninterfaces; i++)
        for (size_t b = 0; record->interface[i].break_time <= time && b < mesh->nborders; b++)
            for (int k = 0; k < 4; k++)
                if (mesh->border[b].tag == 1 &&
                    mesh->border[b].node[k / 2] == mesh->interface[i].node[k % 2])
                    reached[mesh->border[b].node[k / 2]] = true;
    while (grown) {
        grown = false;
        for (size_t i = 0; i < mesh->ninterfaces; i++) {
            const int64_t *node = mesh->interface[i].node;
            if (!(record->interface[i].break_time <= time) || reached[node[0]] == reached[node[1]])
                continue;
            reached[node[0]] = reached[node[1]] = grown = true;
        }
    }
    for (size_t b = 0; b < mesh->nborders; b++)
        if (mesh->border[b].tag == 2 &&
            (reached[mesh->border[b].node[0]] || reached[mesh->border[b].node[1]]))
            return true;
    return false;
}

static void crack_through_against_a_walk(void **state)
{
    static const int64_t width[2] = {1, 2};
    uint64_t random = 11;
    size_t through = 0;
    for (int round = 0; round < 60; round++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh;
        FRACAS_CLEARED(fracas_record) record;
        double found, least = NAN;
        grid_make(round % 2 ? &plate : &ring, &mesh);
        grid_record(&mesh, 100, &record);
        for (size_t i = 0; i < mesh.ninterfaces; i++)
            if (sample_bits(&random) % 100 < 35)
                record.interface[i].break_time = (double)(sample_bits(&random) % 50);
        for (int time = 49; time >= 0; time--)
            if (walk_through(&mesh, &record, time)) least = time;
        OK(fracas_surface_through(&mesh, &record, width, &found));
        assert_true(isnan(least) ? isnan(found) : found == least);
        through += !isnan(found);
    }
    assert_true(through > 10 && through < 60); /* both happen */
}

static void moments_end_at_the_end(void **state)
{
    fracas_record record;
    double time[6];
    size_t count = 6;
    fracas_interface_row row[14];
    fracas_record_init(&record);
    record.onset_time = 2;
    record.end_time = 14;
    OK(fracas_surface_moments(&record, time, &count));
    assert_int_equal(count, 6);
    for (int k = 0; k < 6; k++)
        assert_true(time[k] == 4 + 2 * k); /* multiples of 1/6 of 12 round to these */
    record.interface = row;
    record.ninterface = sizeof row / sizeof *row;
    for (int i = 0; i < 14; i++) /* 12 times, of these 3 twice, and one that never comes */
        row[i].break_time = i == 13 ? NAN : 3 + 0.1 * (i < 1 ? 0 : i - 1);
    OK(fracas_surface_moments(&record, time, &count));
    for (int k = 0; k < 5; k++) assert_true(time[k] == 3 + 0.1 * (2 * k + 1));
    assert_true(count == 6 && time[5] == 14);
    record.onset_time = NAN;
    OK(fracas_surface_moments(&record, time, &count));
    assert_int_equal(count, 1);
    assert_true(time[0] == 14);
}

/* ---- pictures ---- */

typedef struct {
    double area;      /* inside loops, square units */
    double moment[2]; /* sum of the middles of edges */
    size_t lines, edges;
} path_measures;

static char *draw(const fracas_stored_mesh *mesh, const fracas_record *record, double time,
                  fracas_surface_show show)
{
    FRACAS_CLEARED(fracas_surface_state) now;
    FILE *out = text_begin();
    OK(fracas_surface_state_create(mesh, record, time, &now));
    const fracas_surface_picture picture = {"a & b", show, 800, true};
    OK(fracas_surface_picture_write(mesh, &now, &picture, out));
    return text_end(out);
}

/* Of the path with this class; all 0 if there is none. As y is down in a drawing, loops with the
 * inside to the left are counted positive. */
static path_measures measure(const char *svg, const char *class)
{
    char start[64];
    path_measures path = {0};
    svg_edge edge;
    snprintf(start, sizeof start, "<path class=\"%s\"", class);
    const char *found = strstr(svg, start);
    if (!found) return path;
    svg_pen pen = svg_begin(found);
    while (svg_next(&pen, &edge)) {
        path.area -= svg_area(&edge);
        path.edges += !edge.closes;
        for (int i = 0; i < 2 && !edge.closes; i++)
            path.moment[i] += (edge.from[i] + edge.to[i]) / 2;
    }
    path.lines = pen.lines;
    return path;
}

/* The plate is 784 pixels wide: a square has sides of 1306.67 units, and a corner is at most 0.71
 * of one from where it belongs: areas are right to 0.71/1306 of a square for each side of the
 * outline, of which there are 30 at most: 0.02. */
static void fragments_are_filled(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    const double square = 7840.0 / 6 * 7840.0 / 6;
    grid_make(&plate, &mesh);
    grid_record(&mesh, 100, &record);
    crack_up(&plate, &mesh, &record, 2, 0, 4, 10);
    crack_across(&plate, &mesh, &record, 1, 0, 6, 20);
    const int64_t a = grid_vertex(&plate, 5, 3), b = grid_vertex(&plate, 6, 3),
                  c = grid_vertex(&plate, 5, 4);
    assert_true(grid_crack(&mesh, &record, a, b, 29, 30) &&
                grid_crack(&mesh, &record, a, c, 29, 30)); /* the upper right square */
    char *svg = draw(&mesh, &record, 100, FRACAS_SHOW_FRAGMENTS);
    static const double area[] = {11, 6, 4, 2}; /* the largest first, and no two of one tint */
    for (int t = 0; t < 4; t++) {
        const char class[] = {'t', (char)('0' + t), '\0'};
        assert_true(fabs(measure(svg, class).area / square - area[t]) < 0.02);
        assert_int_equal(measure(svg, class).lines, 1);
    }
    assert_int_equal(measure(svg, "t4").lines, 0);
    assert_true(fabs(measure(svg, "dust-fill").area / square - 1) < 0.02);
    assert_int_equal(measure(svg, "broken").edges, 4 + 6 + 2);
    assert_has(svg, "s: 5 fragments (dust: 1)</text>");
    assert_has(svg, ">1000 mm</text>"); /* 0.3 of 800 pixels are 1837 mm */
    assert_has(svg, "class=\"broken\"");
    assert_null(strstr(svg, "class=\"cracked\""));
    free(svg);
    svg = draw(&mesh, &record, 9.7, FRACAS_SHOW_MESH); /* one interface cracked, none broken */
    assert_has(svg, "class=\"cracked\"");
    assert_has(svg, "class=\"mesh\"");
    assert_null(strstr(svg, "class=\"broken\""));
    assert_true(fabs(measure(svg, "t0").area / square - 24) < 0.02);
    assert_int_equal(measure(svg, "cracked").edges, 1);
    assert_int_equal(measure(svg, "mesh").edges, mesh.ninterfaces - 1);
    assert_int_equal(measure(svg, "outline").edges, mesh.nborders);
    double moment[2] = {
        0, 0}; /* of the interfaces that are not cracked yet, from the coordinates of the mesh */
    for (size_t i = 0; i < mesh.ninterfaces; i++)
        for (int end = 0; end < 2 && !(record.interface[i].onset_time <= 9.7); end++) {
            moment[0] += (80 + 7840.0 / 6 * mesh.node[mesh.interface[i].node[end]].position[0]) / 2;
            moment[1] +=
                (80 + 7840.0 / 6 * (4 - mesh.node[mesh.interface[i].node[end]].position[1])) / 2;
        }
    for (int i = 0; i < 2; i++) /* half a unit for each rounding at most */
        assert_true(fabs(measure(svg, "mesh").moment[i] - moment[i]) <
                    0.5 * (double)mesh.ninterfaces);
    free(svg);
}

/* A polygon with 12 sides from radius 2 to 5, in 784 pixels from -5 to 5 both ways: area 12/2
 * sin(30 deg) (25 - 4) = 63. Its coordinates are wrong by 0.71/784 m at most along outlines of 12
 * sides, 45 m long altogether. */
static void holes_stay_holes(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    grid_make(&ring, &mesh);
    grid_record(&mesh, 100, &record);
    OWNED char *svg = draw(&mesh, &record, 1, FRACAS_SHOW_CRACKS);
    assert_true(fabs(measure(svg, "body").area / (784.0 * 784.0) - 63) < 0.05);
    assert_int_equal(measure(svg, "body").lines, 2);
    assert_null(strstr(svg, "class=\"t0\""));
}

/* Middles that lie in the middle change nothing; one that is 0.1 m to the right makes its edge a
 * parabola, in both fragments beside it, and what is left of it by 2/3 of 0.1 squares larger. */
static void curved_edges_are_curved(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) straight, curved;
    FRACAS_CLEARED(fracas_record) record;
    grid_shape shape = plate;
    grid_make(&shape, &straight);
    shape.middles = true;
    grid_make(&shape, &curved);
    assert_null(fracas_stored_mesh_fault(&curved));
    grid_record(&straight, 100, &record);
    crack_up(&plate, &straight, &record, 2, 0, 4, 10);
    char *a = draw(&straight, &record, 50, FRACAS_SHOW_MESH),
         *b = draw(&curved, &record, 50, FRACAS_SHOW_MESH);
    assert_string_equal(a, b);
    free(b);
    for (size_t i = 0; i < curved.ninterfaces; i++) {
        const fracas_stored_interface *interface = &curved.interface[i];
        if (record.interface[i].break_time == 11)
            curved.node[interface->node[2]].position[0] += 0.1;
    }
    b = draw(&curved, &record, 50, FRACAS_SHOW_FRAGMENTS);
    size_t parabolas = 0;
    for (const char *at = strstr(b, "<path"); at && *at; at++) parabolas += *at == 'q';
    assert_int_equal(parabolas, 3); /* two fragments and the crack itself */
    const double square = 7840.0 / 6 * 7840.0 / 6;
    assert_true(fabs(measure(b, "t0").area / square - (16 - 0.2 / 3)) <
                0.01); /* roundings as above, 20 sides */
    assert_true(fabs(measure(b, "t1").area / square - (8 + 0.2 / 3)) < 0.01);
    free(a);
    free(b);
}

/* The bytes of flat pictures, after their style, are known: whole numbers all but the words below.
 */
static void flat_pictures_stay_as_they_are(void **state)
{
    static const uint64_t expected[] = {0x9f9276d860474914, 0x37a851630856d185, 0xab1fd9954f4da2d2};
    uint64_t random = 3;
    const grid_shape curved = {.nx = 12, .ny = 3, .rolled = true, .middles = true};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    grid_make(&curved, &mesh);
    grid_record(&mesh, 100, &record);
    for (size_t i = 0; i < mesh.ninterfaces; i++) {
        const int64_t *node = mesh.interface[i].node;
        if (node[2] >= 0) mesh.node[node[2]].position[0] += 0.05;
        record.interface[i].onset_time = (double)(sample_bits(&random) % 100);
        if (sample_bits(&random) % 2)
            record.interface[i].break_time = record.interface[i].onset_time + 5;
    }
    for (int show = FRACAS_SHOW_CRACKS; show <= FRACAS_SHOW_MESH; show++) {
        OWNED char *svg = draw(&mesh, &record, 60, (fracas_surface_show)show);
        const char *drawing = strstr(svg, "</style>");
        assert_non_null(drawing);
        assert_int_equal(fracas_checksum_of(drawing, strlen(drawing)), expected[show]);
    }
}

/* Neighbours differ, whatever breaks: planar graphs need no more than four tints, and there are
 * seven. */
static void neighbours_have_different_tints(void **state)
{
    uint64_t random = 5;
    const grid_shape large = {.nx = 30, .ny = 20};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    fracas_record record;
    grid_make(&large, &mesh);
    for (int round = 0; round < 20; round++) {
        FRACAS_CLEARED(fracas_surface_state) now;
        OWNED uint8_t *tint;
        grid_record(&mesh, 1, &record);
        for (size_t i = 0; i < mesh.ninterfaces; i++)
            if (sample_bits(&random) % 100 < 55) record.interface[i].break_time = 0.5;
        OK(fracas_surface_state_create(&mesh, &record, 1, &now));
        assert_true(now.nfragments > 20);
        OK(fracas_tint_fragments(&mesh, &now, &tint));
        for (size_t f = 0; f < now.nfragments; f++)
            assert_int_equal(tint[f] == FRACAS_TINT_DUST, now.elements[f] <= 2);
        for (size_t i = 0; i < mesh.ninterfaces; i++) {
            const uint32_t a = now.fragment[mesh.interface[i].element[0]],
                           b = now.fragment[mesh.interface[i].element[1]];
            if (a != b && tint[a] != FRACAS_TINT_DUST) assert_int_not_equal(tint[a], tint[b]);
        }
        fracas_record_clear(&record);
    }
}

/* Of 30 000 elements, everything broken: the largest picture that such a mesh makes. */
static void pictures_stay_small(void **state)
{
    uint64_t random = 7;
    const grid_shape huge = {.nx = 150, .ny = 100};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    FRACAS_CLEARED(fracas_record) record;
    grid_make(&huge, &mesh);
    grid_record(&mesh, 1, &record);
    for (size_t i = 0; i < mesh.ninterfaces; i++) record.interface[i].break_time = 0.1;
    char *svg = draw(&mesh, &record, 1, FRACAS_SHOW_FRAGMENTS);
    assert_true(strlen(svg) < 1000000);
    free(svg);
    for (size_t i = 0; i < mesh.ninterfaces; i++)
        record.interface[i].break_time = sample_bits(&random) % 2 ? 0.1 : NAN;
    svg = draw(&mesh, &record, 1, FRACAS_SHOW_FRAGMENTS);
    assert_true(strlen(svg) < 1000000);
    free(svg);
}

/* ---- strips of bars and rings ---- */

/* A record of `between` interfaces and fragments of these elements and sizes [m]. */
static void chain_record(size_t between, size_t fragments, const int64_t *elements,
                         const double *size, fracas_record *record)
{
    fracas_record_init(record);
    record->outcome = FRACAS_FRAGMENTED;
    record->end_time = 10;
    record->nfragment = fragments;
    record->fragment = calloc(fragments, sizeof *record->fragment);
    record->ninterface = between;
    record->interface = calloc(between, sizeof *record->interface);
    if (!record->fragment || !record->interface) abort();
    for (size_t f = 0; f < fragments; f++) {
        record->fragment[f].elements = elements[f];
        record->fragment[f].size = size[f];
    }
    for (size_t i = 0; i < between; i++)
        record->interface[i] = (fracas_interface_row){1e8, 0, NAN, NAN};
}

static void crack(fracas_record *record, size_t i, double onset, double broken)
{
    record->interface[i].onset_time = onset;
    record->interface[i].break_time = broken;
}

/* Elements of the chain from `first` to `last` are in fragment f. */
static void assert_piece(const fracas_surface_state *now, size_t first, size_t last, uint32_t f)
{
    for (size_t e = 2 * first; e <= 2 * last + 1; e++) assert_int_equal(now->fragment[e], f);
}

/* 2, 1 and 4 elements of 0.1, 0.3 and 0.2 m; its ends are borders, the sections at the ends of its
 * elements are where their lengths add up to, to rounding. */
static void a_bar_is_a_strip(void **state)
{
    static const double at[] = {0, 0.1, 0.2, 0.5, 0.7, 0.9, 1.1, 1.3};
    FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_surface_state) now;
    chain_record(6, 3, (const int64_t[]){2, 1, 4}, (const double[]){0.2, 0.3, 0.8}, &record);
    crack(&record, 2, 1, 3);
    crack(&record, 1, 2, 4);
    crack(&record, 4, 5, NAN);
    OK(fracas_strip_create(&record, &mesh));
    assert_null(fracas_stored_mesh_fault(&mesh));
    assert_int_equal(mesh.nelements, 14);
    assert_int_equal(mesh.nborders, 16);
    assert_int_equal(mesh.ninterfaces, 13);
    assert_int_equal(record.ninterface, 13);
    for (size_t n = 0; n < 16; n++) {
        assert_true(fabs(mesh.node[n].position[0] - at[n / 2]) < 1e-15);
        assert_true(fabs(mesh.node[n].position[1] - (n % 2 ? 0 : 1.3 / 12)) < 1e-15);
    }
    assert_state(&mesh, &record, 2.5, 1, 2, 0);
    assert_state(&mesh, &record, 3, 2, 1, 1);
    assert_state(&mesh, &record, 10, 3, 1, 2);
    OK(fracas_surface_state_create(&mesh, &record, 10, &now));
    assert_piece(&now, 0, 1, 0);
    assert_piece(&now, 2, 2, 1);
    assert_piece(&now, 3, 6, 2);
    assert_int_equal(now.ndust, 1); /* one element */
    char *svg = draw(&mesh, &record, 10, FRACAS_SHOW_FRAGMENTS);
    assert_int_equal(measure(svg, "broken").edges, 2);
    assert_int_equal(measure(svg, "cracked").edges, 1);
    assert_has(svg, "s: 3 fragments (dust: 1)</text>");
    free(svg);
}

/* 8 elements; broken between 1 and 2, 5 and 6: the first fragment goes over the seam. Its elements
 * are 1 m long, those of the other 3 m: the circle has 16 m. */
static void a_ring_is_a_circle(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
    FRACAS_CLEARED(fracas_record) record;
    FRACAS_CLEARED(fracas_surface_state) now;
    static const double at[] = {0, 1, 2, 5, 8, 11, 14, 15, 16};
    chain_record(8, 2, (const int64_t[]){4, 4}, (const double[]){4, 12}, &record);
    crack(&record, 1, 1, 3);
    crack(&record, 5, 2, 4);
    OK(fracas_strip_create(&record, &mesh));
    assert_null(fracas_stored_mesh_fault(&mesh));
    assert_int_equal(mesh.nborders, 16);
    for (size_t n = 0; n < 32; n++) {
        const size_t e = n % 16 / 2;
        const double along = n < 16 ? at[e] : (at[e] + at[e + 1]) / 2,
                     angle = 2 * M_PI * along / 16,
                     radius = 16 / (2 * M_PI) * (n % 2 ? 1.05 : 0.95);
        assert_true(fabs(mesh.node[n].position[0] - radius * cos(angle)) < 1e-14);
        assert_true(fabs(mesh.node[n].position[1] - radius * sin(angle)) < 1e-14);
    }
    assert_state(&mesh, &record, 3.5, 1, 1, 1); /* broken once, a ring is whole */
    OK(fracas_surface_state_create(&mesh, &record, 10, &now));
    assert_int_equal(now.nfragments, 2);
    assert_piece(&now, 0, 1, 0);
    assert_piece(&now, 2, 5, 1);
    assert_piece(&now, 6, 7, 0);
}

static void a_strip_needs_its_interfaces(void **state)
{
    FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
    FRACAS_CLEARED(fracas_record) record;
    chain_record(3, 1, (const int64_t[]){5}, (const double[]){1}, &record);
    FAILS(fracas_strip_create(&record, &mesh), FRACAS_DAMAGED,
          "3 interfaces are not those between the 5 elements");
}

TESTS(a_bar_is_a_strip, a_ring_is_a_circle, a_strip_needs_its_interfaces,
      a_plate_is_cut_in_two_and_in_four, small_pieces_are_dust, a_ring_cracks_through,
      edges_that_meet_have_no_width, crack_through_against_a_walk, moments_end_at_the_end,
      fragments_are_filled, holes_stay_holes, curved_edges_are_curved,
      flat_pictures_stay_as_they_are, neighbours_have_different_tints, pictures_stay_small)
