/* SPDX-License-Identifier: GPL-3.0-or-later */
/* engine/mesh/surface/gmsh: files of our own writer and of Gmsh 4.8 itself, refusals, damaged
 * files. */
#include "engine/mesh/surface/parts.h"
#include "tests/support/gmsh.h"
#include "tests/support/surface_measures.h"

#include <time.h>

enum { VARIANTS = 6 };

static gmsh_file variant(const fracas_surface *s, int which)
{
    return gmsh_write(s, which % 2, which / 2 > 0, which / 2 == 2);
}

static a_surface *rectangle(size_t divisions, int order)
{
    const fracas_surface_fineness fineness = {.divisions = divisions, .order = order};
    return surface_of(SHAPE_RECTANGLE, (const double[2]){2.0, 1.0}, &fineness);
}

/* The element of `s` that was given as `number`. */
static size_t place_of(const fracas_surface *s, int64_t number)
{
    for (size_t e = 0; e < s->nelements; e++)
        if (s->given[e] == number) return e;
    fail_msg("no element %lld", (long long)number);
    return 0;
}

static int32_t tag_of(const fracas_surface *s, size_t element, size_t edge)
{
    for (size_t b = 0; b < s->nborders; b++)
        if (s->border[b].element == element && s->border[b].edge == edge) return s->border[b].tag;
    return -1;
}

static void test_round_trip(void **state)
{
    for (int which = 0; which < VARIANTS; which++)
        for (int order = 1; order <= 2; order++) {
            OWN(a_surface) s = rectangle(3, order), *back = NULL;
            gmsh_file f = variant(s, which);
            if (fracas_surface_read_gmsh(f.bytes, f.size, 1, false, &back))
                fail_msg("variant %d: %s", which, fracas_message());
            assert_int_equal(back->order, order);
            assert_int_equal(back->nnodes, s->nnodes);
            assert_int_equal(back->nelements, s->nelements);
            assert_int_equal(back->nborders, s->nborders);
            check_edges(back);
            for (size_t e = 0; e < s->nelements; e++) {
                const size_t there = place_of(back, gmsh_element(e));
                for (size_t k = 0; k < s->corners; k++)
                    assert_memory_equal(s->node[corner_of(s, e, k)],
                                        back->node[corner_of(back, there, k)], sizeof *s->node);
                for (size_t k = 0; k < 3; k++)
                    assert_int_equal(tag_of(s, e, k), tag_of(back, there, k));
            }
            free(f.bytes);
        }
}

/* Fortran programs write exponents by D. */
static void test_exponents_by_d(void **state)
{
    static const char text[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n"
                               "2 2.5D-01 0 0\n3 0 1d0 0\n$EndNodes\n$Elements\n1\n"
                               "1 2 0 1 2 3\n$EndElements\n";
    OWN(a_surface) s = NULL;
    OK(fracas_surface_read_gmsh(text, strlen(text), 1, false, &s));
    assert_true(s->area[0] == 0.125);
}

/* What Gmsh 4.8.4 made of tests/data/gmsh/plate.geo, a plate of 2 x 1 with a quarter of a hole of
 * radius 1/2. */
static const char *const plates[] = {
    "order1-msh22-text",   "order1-msh22-binary", "order1-msh41-text",
    "order1-msh41-binary", "order2-msh22-text",   "order2-msh22-binary",
    "order2-msh41-text",   "order2-msh41-binary", "parametric"};

static char *read_plate(size_t which, size_t *size)
{
    char path[300];
    snprintf(path, sizeof path, FRACAS_SOURCE_DIR "/tests/data/gmsh/plate-%s.msh", plates[which]);
    return (char *)whole_bytes(path, size);
}

static void test_plates(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(plates); i++) {
        size_t size;
        OWNED char *bytes = read_plate(i, &size);
        OWN(a_surface) s = NULL;
        if (fracas_surface_read_gmsh(bytes, size, 1, false, &s))
            fail_msg("%s: %s", plates[i], fracas_message());
        check_edges(s);
        assert_int_equal(euler(s), 1);
        assert_int_equal(s->order, i < 4 ? 1 : 2);
        double left = 0.0, hole = 0.0;
        fracas_surface_measures all;
        fracas_surface_measure(s, &all);
        for (size_t b = 0; b < s->nborders; b++) {
            const double length = fracas_surface_length(s, s->border[b].element, s->border[b].edge);
            left += s->border[b].tag == 11 ? length : 0.0;
            hole += s->border[b].tag == 12 ? length : 0.0;
            assert_true(s->border[b].tag == 0 || s->border[b].tag == 11 || s->border[b].tag == 12);
        }
        /* Two edges go round the hole: each of pi/4 as a chord, or as a parabola, whose error is
         * some h^4/1000 of it. Gmsh computes places on a curve to 1e-9 or so. */
        const double quarter = asin(1.0), chords = 4.0 * 0.5 * sin(0.25 * quarter),
                     cut = 0.25 * sin(0.5 * quarter);
        assert_true(fabs(left - 0.5) < 1e-8);
        if (s->order == 1)
            assert_true(fabs(hole - chords) < 1e-8 && fabs(all.area - (2.0 - cut)) < 1e-8);
        else
            assert_true(fabs(hole - 0.5 * quarter) < 2e-3 &&
                        fabs(all.area - (2.0 - 0.125 * quarter)) < 2e-3);
    }
}

/* All eight variants are one mesh. */
static void test_plates_agree(void **state)
{
    for (size_t i = 0; i < 8; i++) {
        size_t size;
        char *bytes = read_plate(i, &size);
        OWN(a_surface) s = NULL, *first = NULL;
        OK(fracas_surface_read_gmsh(bytes, size, 1, false, &s));
        free(bytes);
        bytes = read_plate(i / 4 * 4, &size);
        OK(fracas_surface_read_gmsh(bytes, size, 1, false, &first));
        free(bytes);
        assert_int_equal(s->nnodes, first->nnodes);
        assert_int_equal(s->nelements, first->nelements);
        assert_memory_equal(s->element, first->element,
                            s->nelements * s->corners * sizeof *s->element);
        assert_memory_equal(s->border, first->border, s->nborders * sizeof *s->border);
        /* Text has 16 digits. */
        for (size_t n = 0; n < s->nnodes; n++)
            for (int k = 0; k < 3; k++)
                assert_true(fabs(s->node[n][k] - first->node[n][k]) < 1e-15);
    }
}

#define HEAD "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
#define NODES "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1 0\n$EndNodes\n"
#define HEAD_4 "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"

static const struct {
    const char *text, *message;
} refused[] = {
    {"", "line 1: an empty file"},
    {" \n\n", "line 3: an empty file"},
    {"solid cube\n", "line 1: expected $MeshFormat, not `solid`: no Gmsh mesh"},
    {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "line 2: a mesh of format 4: save it as 4.1 or 2.2"},
    {"$MeshFormat\n2.2 0 4\n$EndMeshFormat\n", "expected 0 or 1, and 8"},
    {"$MeshFormat\n2.2 1 8\n\1\1\1\1\n$EndMeshFormat\n",
     "the number that tells the byte order is 16843009, not 1"},
    {"$MeshFormat\n2.2 0 8 3\n$EndMeshFormat\n", "expected $EndMeshFormat, not `3`"},
    {HEAD, "line 4: the file ends without a section $Nodes"},
    {HEAD NODES, "without a section $Elements"},
    {HEAD NODES NODES, "a second section $Nodes"},
    {HEAD NODES "$Elements\n0\n$EndElements\n", "the file has no triangles"},
    {HEAD NODES "$Elements\n0\n$EndElements\n$Elements\n0\n$EndElements\n",
     "a second section $Elements"},
    {HEAD NODES "$Elements\n1\n1 3 2 0 1 1 2 4 3\n$EndElements\n",
     "line 13: 4-node quadrangles (Gmsh's type 3): a surface has 3- or 6-node triangles: mesh it "
     "without Recombine"},
    {HEAD NODES "$Elements\n1\n1 4 2 0 1 1 2 4 3\n$EndElements\n", "4-node tetrahedra"},
    {HEAD NODES "$Elements\n1\n1 77 2 0 1 1 2 4 3\n$EndElements\n", "elements of Gmsh's type 77"},
    {HEAD NODES "$Elements\n1\n1 2 2 0 1 1 2 9\n$EndElements\n",
     "element 1 names node 9, which the file does not have"},
    {HEAD NODES "$Elements\n2\n1 2 2 0 1 1 2 3\n2 9 2 0 1 1 2 3 1 2 3\n$EndElements\n",
     "element 2 is a 6-node triangle"},
    {HEAD "$Nodes\n5\n1 1 0 0\n2 -0.5 0.9 0.2\n3 -0.5 -0.9 -0.1\n4 1 0.1 0.2\n5 -0.5 0.8 "
          "-0.4\n$EndNodes\n"
          "$Elements\n5\n1 2 0 1 2 3\n2 2 0 2 4 3\n3 2 0 3 4 5\n4 2 0 4 1 5\n5 2 0 5 1 2\n"
          "$EndElements\n",
     "go round against each other however one turns them: the surface has one side only"},
    {HEAD NODES "$Elements\n2\n5 2 2 0 1 1 2 3\n6 1 2 9 1 2 4\n$EndElements\n",
     "line 6 of the physical group 9 has node 4"},
    {HEAD NODES "$Elements\n3\n5 2 0 1 2 3\n7 2 0 2 4 3\n6 1 2 9 1 1 4\n$EndElements\n",
     "tag 9 is for nodes 1 and 4"},
    {HEAD NODES "$Elements\n1\n1 2 2 0 1 1 2 3.5\n$EndElements\n",
     "line 13: `3.5` is not a whole number of 32 bits"},
    {HEAD NODES "$Elements\n1\n1 2 2 99999999999 1 1 2 3\n$EndElements\n",
     "`99999999999` is not a whole number of 32 bits"},
    {HEAD NODES "$Elements\n1\n1 1 1 -2147483648 1 2\n$EndElements\n",
     "in the physical group -2147483648"},
    {HEAD NODES "$Elements\n999999999999\n1 2 2 0 1 1 2 3\n$EndElements\n",
     "a count of 999999999999 things"},
    {HEAD NODES "$Elements\n1\n1 2 -1 0 1 1 2 3\n$EndElements\n", "a count of -1 things"},
    {HEAD NODES "$Elements\n1\n1 2 2 0 1 1 2 3\n",
     "line 14: the file ends here, in the middle of a section"},
    {HEAD NODES "$Elements\n1\n1 2 2 0 1 1 2 3\n4\n$EndElements\n",
     "expected $EndElements, not `4`"},
    {HEAD "$Nodes\n2\n1 0 0 0\n1 1 0 0\n$EndNodes\n", "node 1 comes twice"},
    {HEAD "$Nodes\n1\n1 0 nan 0\n$EndNodes\n", "line 6: `nan` is not a number"},
    {HEAD "$Nodes\n1\n1 0 1,5 0\n$EndNodes\n",
     "line 6: `1,5` is not a number: decimals follow a point"},
    {HEAD "$Nodes 1\n1 0 \xff 0\n$EndNodes\n", "a byte that is no text, 255"},
    {HEAD "$Nodes\n1 1 0 0 0\n$EndNodes\n", "expected the end of the line"},
    {HEAD
     "$Nodes\n1\n1 0 0000000000000000000000000000000000000000000000000000000000000000000000 0\n",
     "is no word of a mesh"},
    {HEAD "Nodes\n", "expected a section, which begins with $, not `Nodes`"},
    {HEAD "$Comments\nno end\n", "section $Comments has no $EndComments"},
    {HEAD_4 "$PartitionedEntities\n2\n0\n0 1 0 0\n3 1 1 1 2 0 0 0 1 1 1 2 1 4 0\n",
     "curve 3 is in the physical groups 1 and 4"},
    {HEAD_4 "$Entities\n0 1 0 0\n3 0 0 0 1 1 1 2 1 4 0\n$EndEntities\n",
     "curve 3 is in the physical groups 1 and 4"},
    {HEAD_4 "$Entities\n0 2 0 0\n3 0 0 0 1 1 1 0 0\n3 0 0 0 1 1 1 0 0\n$EndEntities\n",
     "curve 3 comes twice"},
    {HEAD_4 "$Entities\n0 0 0 0\n$EndEntities\n$Entities\n0 0 0 0\n$EndEntities\n",
     "a second section of entities"},
    {HEAD_4 "$Nodes\n1 1 1 1\n4 1 0 1\n1\n0 0 0\n$EndNodes\n",
     "nodes of an entity of 4 dimensions"},
    {HEAD_4 "$Nodes\n1 1 1 1\n2 1 0 2\n1\n0 0 0\n$EndNodes\n",
     "2 nodes in a block, but 1 are left"},
    {HEAD_4 "$Nodes\n2 1 1 2\n2 1 0 1\n1\n0 0 0\n2 1 0 1\n2\n0 0 0\n$EndNodes\n",
     "1 nodes in a block, but 0 are left"},
    {HEAD_4 "$Elements\n2 1 1 2\n2 1 2 1\n1 1 2 3\n2 1 2 1\n2 1 2 3\n$EndElements\n",
     "1 elements in a block, but 0 are left"},
    {HEAD_4 "$Elements\n1 1 1 1\n2 1 2 2\n1 1 2 3\n$EndElements\n",
     "2 elements in a block, but 1 are left"},
};

/* The right half of the square 1, 2, 4, 3 is turned as `node` says. */
static void read_turned(const char *node, double z, bool flat, a_surface **s)
{
    char text[400];
    snprintf(text, sizeof text,
             HEAD "$Nodes\n4\n1 0 0 0\n2 1 0 %.17g\n3 0 1 0\n4 1 1 0\n$EndNodes\n"
                  "$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 %s\n$EndElements\n",
             z, node);
    OK(fracas_surface_read_gmsh(text, strlen(text), 1, flat, s));
}

/* Elements that go round against the others are turned; those that agree stay, but in a plane. */
static void test_turned(void **state)
{
    static const struct {
        const char *node;
        size_t turned;
    } other[] = {{"2 4 3", 0}, {"2 3 4", 1}, {"4 2 3", 1}};
    for (size_t i = 0; i < FRACAS_COUNT(other); i++) {
        OWN(a_surface) s = NULL;
        read_turned(other[i].node, 0, true, &s);
        assert_int_equal(s->turned, other[i].turned);
        check_edges(s);
        assert_int_equal(s->ninterfaces, 1);
        for (size_t e = 0; e < 2; e++) {
            double normal[3];
            fracas_surface_normal(fracas_surface_node(s, e, 0), fracas_surface_node(s, e, 1),
                                  fracas_surface_node(s, e, 2), normal);
            assert_true(normal[2] > 0);
        }
    }
    /* All clockwise: a shell may have its normal there, a membrane has +z. */
    static const char clockwise[] = HEAD NODES
        "$Elements\n2\n1 2 0 1 3 2\n2 2 0 2 3 4\n$EndElements\n";
    for (int flat = 0; flat <= 1; flat++) {
        OWN(a_surface) s = NULL;
        OK(fracas_surface_read_gmsh(clockwise, strlen(clockwise), 1, flat, &s));
        assert_int_equal(s->turned, flat ? 2 : 0);
    }
}

/* Turned at random, of either order, in all formats: the surface is that of the file as it was,
 * seen from one side. */
static void test_turned_at_random(void **state)
{
    uint64_t x = 20261127;
    for (int which = 0; which < VARIANTS; which++)
        for (int order = 1; order <= 2; order++) {
            OWN(a_surface) s = rectangle(4, order), *back = NULL;
            uint32_t *element = (uint32_t *)(uintptr_t)s->element; /* the test's own */
            size_t turned = 0;
            for (size_t e = 0; e < s->nelements; e++) {
                uint32_t *node = element + s->corners * e, was = node[1];
                if (next_share(&x) < 0.4) continue;
                node[1] = node[2], node[2] = was;
                if (order == 2) was = node[3], node[3] = node[5], node[5] = was;
                turned++;
            }
            OWN(a_surface) plain = rectangle(4, order);
            for (size_t b = 0; b < s->nborders; b++) /* lines of the borders as they were */
                ((fracas_surface_border *)(uintptr_t)s->border)[b].tag = 0;
            gmsh_file f = variant(s, which);
            OK(fracas_surface_read_gmsh(f.bytes, f.size, 1, true, &back));
            assert_int_equal(back->turned, turned);
            check_edges(back);
            assert_int_equal(back->ninterfaces, plain->ninterfaces);
            for (size_t e = 0; e < plain->nelements; e++)
                assert_true(fabs(plain->area[e] - back->area[place_of(back, gmsh_element(e))]) <
                            1e-15);
            free(f.bytes);
        }
}

/* Round-off in z is none in a flat body; a hundred times as much bends it. */
static void test_round_off(void **state)
{
    static const double z[] = {3e-19, 1e-9, 1e-7};
    for (size_t i = 0; i < FRACAS_COUNT(z); i++)
        for (int flat = 0; flat <= 1; flat++) {
            OWN(a_surface) s = NULL;
            double side[3];
            read_turned("2 4 3", z[i], flat, &s);
            fracas_surface_box(s, side);
            assert_true(side[2] == (flat && i < 2 ? 0 : z[i]));
            assert_true(s->node[0][2] == (flat && i < 2 ? z[i] / 4 : s->node[0][2]));
        }
}

/* A plate in two partitions of Gmsh: the lines between them are a piece of the surface, whose
 * physical group is no edge's. */
static void test_partitions(void **state)
{
    static const char text[] = HEAD_4
        "$Entities\n0 1 1 0\n4 0 0 0 1 0 0 1 7 0\n1 0 0 0 1 1 0 1 2 0\n$EndEntities\n"
        "$PartitionedEntities\n2\n1\n9 1\n1 3 0 0\n5 2 1 2 1 2 0 0 0 1 2\n"
        "11 1 4 1 1 0 0 0 1 0 0 1 7 0\n12 2 1 2 1 2 0 0 0 1 1 0 1 2 0\n13 1 4 1 2 0 1 0 1 1 0 1 7 "
        "0\n"
        "$EndPartitionedEntities\n"
        "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n$EndNodes\n"
        "$Elements\n5 5 1 5\n1 11 1 1\n1 1 2\n1 12 1 1\n2 2 3\n1 13 1 1\n3 3 4\n"
        "2 21 2 1\n4 1 2 3\n2 22 2 1\n5 2 4 3\n$EndElements\n";
    OWN(a_surface) s = NULL;
    OK(fracas_surface_read_gmsh(text, strlen(text), 1, true, &s));
    assert_int_equal(s->nelements, 2);
    assert_int_equal(s->ninterfaces, 1);
    assert_int_equal(s->interface[0].tag, 0);
    assert_int_equal(tag_of(s, place_of(s, 4), 0), 7);
    assert_int_equal(tag_of(s, place_of(s, 5), 1), 7);
    assert_int_equal(tag_of(s, place_of(s, 5), 0), 0);
}

/* MSH 4 names the groups of a curve; those of a surface, with their own numbers, are others. */
static void test_groups_of_a_curve(void **state)
{
    static const char text[] = HEAD_4
        "$Entities\n0 1 1 0\n4 0 0 0 1 0 0 2 6 3 0\n1 0 0 0 1 1 0 2 7 8 0\n$EndEntities\n"
        "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n"
        "$Elements\n2 2 1 2\n1 4 1 1\n1 1 2\n2 1 2 1\n2 1 2 3\n$EndElements\n";
    OWN(a_surface) s = NULL;
    OK(fracas_surface_read_gmsh(text, strlen(text), 1, true, &s));
    assert_int_equal(tag_of(s, 0, 0), 3);
    assert_int_equal(s->passed, 1u << 6);
}

/* Programs write more than the mesh; versions before 2.2 are alike. */
static void test_read_alike(void **state)
{
    static const char *const head[] = {"$Comments\nby hand\n$EndComments\n", "\xef\xbb\xbf", "",
                                       ""};
    static const char *const version[] = {"2.2", "2.2", "2", "2.1"};
    for (size_t i = 0; i < FRACAS_COUNT(head); i++) {
        char text[700];
        OWN(a_surface) s = NULL;
        snprintf(text, sizeof text,
                 "%s$MeshFormat\n%s 0 8\n$EndMeshFormat\n$Comments\nso\n$EndComments\n" NODES
                 "$Elements\n2\n1 2 0 1 2 3\n2 2 0 2 4 3\n$EndElements\n\n\n"
                 "$Periodic\n1\n1 1 2\n1\n1 2\n$EndPeriodic\n",
                 head[i], version[i]);
        OK(fracas_surface_read_gmsh(text, strlen(text), 1, false, &s));
        assert_int_equal(s->nelements, 2);
    }
}

/* MSH 2 has what is in two physical groups twice. Of a line's the lesser counts, by its number or
 * by its name; `passed` has the other, if it is one with a key. */
static void test_groups(void **state)
{
    static const struct {
        const char *names, *groups[2];
        int32_t tag;
        unsigned passed;
    } of[] = {{"1\n1 7 \"a wall\"", {"7", "8"}, 7, 1u << 8},
              {"1\n1 8 \"edge_3\"", {"7", "8"}, 3, 1u << 7},
              {"1\n2 7 \"edge_3\"", {"9", "2"}, 2, 0},
              {"x\ny \"", {"2", "2"}, 2, 0},
              {"1\n1 1 \"edge_11\"", {"1", "9"}, 1, 0},
              {"1\n1 12 \"edge_6\"", {"11", "12"}, 6, 0}};
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        char text[700];
        OWN(a_surface) s = NULL;
        snprintf(text, sizeof text,
                 HEAD "$PhysicalNames\n%s\n$EndPhysicalNames\n" NODES
                      "$Elements\n6\n1 1 2 %s 1 1 2\n2 1 2 %s 1 2 1\n3 2 2 1 1 1 2 3\n"
                      "4 2 2 1 1 2 4 3\n5 2 2 2 1 1 2 3\n6 2 2 2 1 2 4 3\n$EndElements\n",
                 of[i].names, of[i].groups[0], of[i].groups[1]);
        OK(fracas_surface_read_gmsh(text, strlen(text), 1, false, &s));
        assert_int_equal(s->nelements, 2);
        assert_int_equal(tag_of(s, place_of(s, 3), 0), of[i].tag);
        assert_int_equal(s->passed, of[i].passed);
        if (i < 2) assert_true(s->ngroups == 1 && !strcmp(s->group->name, i ? "edge_3" : "a wall"));
    }
}

static void test_refused(void **state)
{
    for (size_t i = 0; i < FRACAS_COUNT(refused); i++) {
        OWN(a_surface) s = NULL;
        assert_int_equal(
            fracas_surface_read_gmsh(refused[i].text, strlen(refused[i].text), 1, false, &s),
            FRACAS_USAGE);
        assert_null(s);
        if (!strstr(fracas_message(), refused[i].message))
            fail_msg("expected \"%s\" in \"%s\"", refused[i].message, fracas_message());
    }
}

/* Binary blocks that announce more than there is. */
static void test_refused_binary(void **state)
{
    OWN(a_surface) s = rectangle(1, 1), *back = NULL;
    gmsh_file f = variant(s, 2);
    char *at = memmem(f.bytes, f.size, "$Elements\n", 10);
    assert_non_null(at);
    at += 10;
    while (*at++ != '\n') continue;
    memcpy(at + 4, &(int32_t){1000}, 4); /* type, how many follow, tags */
    FAILS(fracas_surface_read_gmsh(f.bytes, f.size, 1, false, &back), FRACAS_USAGE,
          "1000 elements in a block");
    assert_true(strncmp(fracas_message(), "byte ", 5) == 0);
    free(f.bytes);
}

/* Reads an exact copy, so that the sanitizer sees a byte too far. */
static bool survives(const char *bytes, size_t size)
{
    OWNED char *copy = taken(size + (size == 0));
    memcpy(copy, bytes, size);
    OWN(a_surface) s = NULL;
    fracas_err err = fracas_surface_read_gmsh(copy, size, 1, false, &s);
    if (err ? err != FRACAS_USAGE || s || !*fracas_message() : !s)
        fail_msg("%d: %s", err, fracas_message());
    if (!err) check_edges(s);
    return !err;
}

/* Cut short at every byte: refused until the last section is complete. */
static void test_cut(void **state)
{
    OWN(a_surface) s = rectangle(1, 2);
    for (int which = 0; which < VARIANTS; which++) {
        gmsh_file f = variant(s, which);
        const char *end = memmem(f.bytes, f.size, "$EndElements", 12);
        assert_non_null(end);
        for (size_t size = 0; size <= f.size; size++) {
            const bool has_all = size >= (size_t)(end - f.bytes) + 12;
            const bool is_cut = size > (size_t)(end - f.bytes) + 13 &&
                                size < f.size - 1; /* within $NodeData */
            assert_int_equal(survives(f.bytes, size), has_all && !is_cut);
        }
        free(f.bytes);
    }
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static size_t mutate(char *bytes, size_t size, uint64_t *x)
{
    static const char *const piece[] = {"-1",
                                        "999999999",
                                        "1e308",
                                        "$End",
                                        "\n",
                                        " ",
                                        "0",
                                        "2",
                                        "nan",
                                        "$Nodes\n",
                                        "\xff\xff\xff\xff",
                                        "\0\0\0\0",
                                        "\x7f\xff\xff\xff\xff\xff\xff\xff",
                                        "\1\0\0\0"};
    static const size_t length[] = {2, 9, 5, 4, 1, 1, 1, 1, 3, 7, 4, 4, 8, 4};
    const size_t at = (size_t)(next_share(x) * (double)size),
                 which = (size_t)(next_share(x) * (double)FRACAS_COUNT(piece));
    switch ((int)(next_share(x) * 4.0)) {
    case 0: bytes[at] = (char)(256.0 * next_share(x)); return size;
    case 1: bytes[at] ^= (char)(1 << (int)(8.0 * next_share(x))); return size;
    case 2: {
        const size_t cut = (size_t)(next_share(x) * 16.0);
        if (at + cut > size) return size;
        memmove(bytes + at, bytes + at + cut, size - at - cut);
        return size - cut;
    }
    default:
        if (at + length[which] <= size) memcpy(bytes + at, piece[which], length[which]);
        return size;
    }
}

static void test_mutations(void **state)
{
    const fracas_surface *s[2] = {rectangle(2, 1), rectangle(1, 2)};
    size_t tried = 0, accepted = 0;
    uint64_t x = 20261121;
    double slowest = 0.0;
    const double start = seconds();
    for (; tried < 40000 && seconds() - start < 3.0; tried++) {
        gmsh_file f = variant(s[tried % 2], (int)(tried / 2 % VARIANTS));
        size_t size = f.size;
        for (int n = 1 + (int)(3.0 * next_share(&x)); n > 0; n--) size = mutate(f.bytes, size, &x);
        const double before = seconds();
        accepted += survives(f.bytes, size);
        slowest = fmax(slowest, seconds() - before);
        free(f.bytes);
    }
    print_message("%zu mutations, %zu still a mesh, slowest %.1f ms\n", tried, accepted,
                  1e3 * slowest);
    assert_true(tried > 1000 && accepted > 0 && accepted < tried);
    fracas_surface_destroy(s[0]);
    fracas_surface_destroy(s[1]);
}

TESTS(test_exponents_by_d, test_round_trip, test_plates, test_plates_agree, test_turned,
      test_turned_at_random, test_round_off, test_partitions, test_read_alike, test_groups,
      test_groups_of_a_curve, test_refused, test_refused_binary, test_cut, test_mutations)
