/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which interfaces a notch has. */
#include "engine/mesh/notch.h"

#include "tests/support/notched.h"
#include "tests/support/test.h"

#define WIDTH 2.0
#define HEIGHT 1.0
#define DIVISIONS 10
static const double plate[2] = {WIDTH, HEIGHT};

static fracas_notch between(double x1, double y1, double x2, double y2)
{
    return (fracas_notch){.from = {x1, y1, NAN}, .to = {x2, y2, NAN}, .within = NAN};
}

/* The caller frees. */
static uint32_t *find(const fracas_notch *notch, const fracas_surface *surface, size_t *count)
{
    uint32_t *interface = NULL;
    const fracas_notch_places places = {surface, surface->ninterfaces, NULL, 1.0 / DIVISIONS};
    OK(fracas_notch_find(notch, &places, &interface, count));
    return interface;
}

static double off(const fracas_notch *notch, const double *x)
{
    const double dx = notch->to[0] - notch->from[0], dy = notch->to[1] - notch->from[1];
    return fabs((x[0] - notch->from[0]) * dy - (x[1] - notch->from[1]) * dx) / hypot(dx, dy);
}

/* A path: two vertices end it, all others have two of its interfaces. The largest distance of one
 * from the line; its ends are at both ends, within `close`. */
static double follow(const fracas_notch *notch, const fracas_surface *surface, double close,
                     size_t *count)
{
    uint32_t *interface = find(notch, surface, count);
    int *met = zeroed(surface->nnodes, sizeof *met);
    double farthest = 0, nearest[2] = {INFINITY, INFINITY};
    size_t ends = 0, node[3];
    for (size_t n = 0; n < *count; n++) {
        const fracas_surface_interface *of = &surface->interface[interface[n]];
        assert_true(n == 0 || interface[n] > interface[n - 1]);
        edge_ends(surface, of->element[0], of->edge[0], node);
        met[node[0]]++;
        met[node[1]]++;
    }
    for (size_t v = 0; v < surface->nnodes; v++) {
        const double *x = surface->node[v];
        if (met[v]) farthest = fmax(farthest, off(notch, x));
        assert_true(met[v] <= 2);
        if (met[v] != 1) continue;
        ends++;
        nearest[0] = fmin(nearest[0], hypot(x[0] - notch->from[0], x[1] - notch->from[1]));
        nearest[1] = fmin(nearest[1], hypot(x[0] - notch->to[0], x[1] - notch->to[1]));
    }
    assert_int_equal(ends, 2);
    assert_true(nearest[0] < close && nearest[1] < close);
    free(met);
    free(interface);
    return farthest;
}

/* Along a row of a regular mesh it is the row; elsewhere a path beside the line, by less than the
 * vertices are apart: sqrt(2)/DIVISIONS, and 0.3 of that more where they are moved. */
static void a_path_along_the_line(void **unused)
{
    const fracas_notch row = between(-1, 0, 0.2, 0), slanted = between(-1, -0.35, 0.7, 0.4);
    fracas_notch loose = slanted;
    loose.within = 1; /* the line, not this, keeps the path in its place */
    for (int order = 1; order <= 2; order++) {
        size_t count;
        OWN(a_surface) even = surface_of(
            SHAPE_RECTANGLE, plate,
            &(fracas_surface_fineness){.divisions = DIVISIONS, .order = order});
        assert_true(follow(&row, even, 1e-12, &count) < 1e-12);
        assert_int_equal(count, 12);
        assert_true(follow(&slanted, even, 0.75 / DIVISIONS, &count) < 1.0 / DIVISIONS);
        assert_true(follow(&loose, even, 0.75 / DIVISIONS, &count) < 1.0 / DIVISIONS);
        OWN(a_surface) moved = surface_moved(SHAPE_RECTANGLE, plate, DIVISIONS, order, 3, false);
        assert_true(follow(&row, moved, 0.6 / DIVISIONS, &count) < 0.6 / DIVISIONS);
        assert_int_equal(count, 12);
        assert_true(follow(&slanted, moved, 1.0 / DIVISIONS, &count) < 1.0 / DIVISIONS);
    }
}

static void no_length_no_notch(void **unused)
{
    size_t count;
    OWN(a_surface) surface = surface_of(
        SHAPE_RECTANGLE, plate, &(fracas_surface_fineness){.divisions = DIVISIONS, .order = 1});
    const fracas_notch none = {.within = 0}, point = between(0.3, 0.2, 0.3, 0.2),
                       unset = {{NAN, NAN, NAN}, {NAN, NAN, NAN}, NAN};
    assert_null(find(&none, surface, &count));
    assert_null(find(&point, surface, &count));
    assert_null(find(&unset, surface, &count));
    assert_int_equal(count, 0);
}

static void faults_have_distances(void **unused)
{
    size_t count;
    uint32_t *interface = NULL;
    OWN(a_surface) surface = surface_of(
        SHAPE_RECTANGLE, plate, &(fracas_surface_fineness){.divisions = DIVISIONS, .order = 1});
    const fracas_notch_places places = {surface, surface->ninterfaces, NULL, 1.0 / DIVISIONS};
    fracas_notch notch = between(-1.3, 0, 0, 0);
    FAILS(fracas_notch_find(&notch, &places, &interface, &count), FRACAS_USAGE,
          "start is 0.3 m away", "within is 0.1 m", "notch.within");
    notch = between(-1, 0, 0, 2);
    FAILS(fracas_notch_find(&notch, &places, &interface, &count), FRACAS_USAGE,
          "end is 1.5 m away");
    notch = between(0, 0, 0.02, 0);
    FAILS(fracas_notch_find(&notch, &places, &interface, &count), FRACAS_USAGE, "0.02 m long",
          "refine the mesh");
    notch = between(-1, -0.4, 0.7, 0.3);
    notch.within = 0.03;
    FAILS(fracas_notch_find(&notch, &places, &interface, &count), FRACAS_USAGE,
          "no interfaces lead from one end", "within 0.03 m", "raise notch.within");
    assert_null(interface);
    notch = (fracas_notch){{-1, NAN, NAN}, {NAN, NAN, NAN}, NAN};
    FAILS(fracas_notch_section.check(&notch), FRACAS_USAGE, "give to_x, to_y or to_z");
    notch.from[2] = notch.to[2] = 0; /* the model has no z */
    FAILS(fracas_notch_section.check(&notch), FRACAS_USAGE, "give to_x, to_y or to_z");
    notch.to[0] = -1;
    assert_true(fracas_notch_touches(&notch));
    OK(fracas_notch_section.check(&notch));
}

static void a_chain_has_one(void **unused)
{
    const double at[5][3] = {{1}, {2}, {3}, {4}, {5}};
    const fracas_notch_places places = {NULL, 5, at, 1};
    fracas_notch notch = between(1.5, 0, 5.5, 0); /* 2, 3, 4, 5 are on it: 3 and 4 by the middle */
    uint32_t *interface;
    size_t count;
    OK(fracas_notch_find(&notch, &places, &interface, &count));
    assert_true(count == 1 && interface[0] == 2);
    free(interface);
    notch = between(4.6, 0, 4.8, 0);
    OK(fracas_notch_find(&notch, &places, &interface, &count));
    assert_true(count == 1 && interface[0] == 4);
    free(interface);
    notch = between(6.5, 0, 7, 0);
    FAILS(fracas_notch_find(&notch, &places, &interface, &count), FRACAS_USAGE,
          "line is 1.5 m away from the nearest interface");
}

/* Lines of the group within the surface are broken; its borders, which others may have, are not. */
static bool in_middle(const double a[3], const double b[3])
{
    return fabs(a[0]) < 1e-9 && fabs(b[0]) < 1e-9;
}

static void a_group_of_lines(void **unused)
{
    OWN(a_surface) surface = surface_of(
        SHAPE_RECTANGLE, plate, &(fracas_surface_fineness){.divisions = DIVISIONS, .order = 2});
    for (int named = 0; named < 2; named++) {
        char *text = write_cracked(
            surface, &(crack_file){.crack = in_middle, .name = named ? "notch" : "Notch"});
        OWN(a_surface) read = NULL;
        OK(fracas_surface_read_gmsh(text, strlen(text), 1, true, &read));
        free(text);
        size_t count;
        uint32_t *interface = find(&(fracas_notch){.within = 0}, read, &count);
        assert_int_equal(count, named ? DIVISIONS : 0);
        for (size_t n = 0; n < count; n++) assert_true(is_cracked(read, in_middle, interface[n]));
        free(interface);
    }
}

TESTS(a_path_along_the_line, no_length_no_notch, faults_have_distances, a_chain_has_one,
      a_group_of_lines)
