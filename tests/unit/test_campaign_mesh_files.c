/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files with mesh files: keys, units, and what a plan says of the mesh. */
#include "tests/support/campaign_text.h"

#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"
#include "engine/mesh/body.h"
#include "tests/support/surface_measures.h"

static char *membrane_campaign; /* tests/data/campaigns/membrane.yaml */

static int read_file(void **state)
{
    membrane_campaign = campaign_file("membrane");
    return 0;
}

static int free_file(void **state)
{
    free(membrane_campaign);
    return 0;
}

static fracas_model *model_of(const fracas_campaign *campaign, size_t point)
{
    fracas_model *model;
    OK(fracas_point_model_create(campaign, point, &model));
    return model;
}

/* Two triangles, the lower of which has an edge in group 2. */
static const char two_triangles[] =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1e-3 0 0\n3 1e-3 1e-3 0\n4 0 1e-3 "
    "0\n$EndNodes\n"
    "$Elements\n4\n1 1 2 2 1 1 2\n2 2 2 9 1 1 2 3\n3 2 2 9 1 1 3 4\n4 1 2 3 1 3 4\n$EndElements\n";

/* Replaces what has another size than the mesh of `path`. */
static char *file_campaign(const char *path, const char *strength)
{
    char geometry[300];
    snprintf(geometry, sizeof geometry,
             "geometry: {shape: file, file: %s, thickness: 1 mm, edge_2: held, edge_3: fixed}\n",
             path);
    char *text = replace(membrane_campaign,
                         "geometry: {width: 10 mm, height: 5 mm, thickness: 0.1 mm}\n", geometry);
    OWNED char *meshed = replace(text, "  divisions: 4\n", "  spacing: given\n");
    free(text);
    text = replace(meshed, "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n", strength);
    return text;
}

static void test_file(void **state)
{
    char path[40];
    make_path(path);
    write_bytes(path, two_triangles, strlen(two_triangles));
    OWNED char *text = file_campaign(path,
                                     "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n");
    OWN(fracas_campaign) campaign = read_text(text);
    const fracas_geometry *geometry = &campaign->point[0].spec.geometry;
    assert_ptr_equal(geometry->edge[0], &fracas_edge_free);
    assert_ptr_equal(geometry->edge[2], &fracas_edge_held);
    assert_ptr_equal(geometry->edge[3], &fracas_edge_fixed);
    const fracas_hash digest = fracas_hash_of(two_triangles, strlen(two_triangles));
    assert_string_equal(at(campaign, 0, "geometry.file")->text,
                        fracas_hash_hex(&digest).text); /* its content names it, not its path */
    OWN(fracas_model) model = model_of(campaign, 0);
    assert_int_equal(fracas_model_elements(model), 2);
    assert_int_equal(fracas_model_interfaces(model), 1);
    assert_true(fabs(fracas_model_interface_volume(model, 0) - 1e-9 / 3) <
                1e-24); /* all of the square, 1 mm thick */
    unlink(path);
}

/* What docs/formats/campaign-file.md shows of a mesh file, of a plate that Gmsh has meshed. */
static void test_page_example(void **state)
{
    OWNED char *page = whole_file(FRACAS_SOURCE_DIR "/docs/formats/campaign-file.md");
    char *begin = strstr(page, "geometry: {shape: file, file: plate.msh"),
         *end = begin ? strstr(begin, "```") : NULL;
    assert_non_null(end);
    *end = '\0';
    OWNED char *found = replace(begin, "plate.msh",
                                FRACAS_SOURCE_DIR "/tests/data/gmsh/plate-order2-msh41-text.msh");
    OWNED char *shown = replace(found, "edge_1: held, edge_2: held", "edges: held");
    OWNED char *text = replace(
        membrane_campaign,
        "geometry: {width: 10 mm, height: 5 mm, thickness: 0.1 mm}\nmesh:\n  divisions: 4\n",
        shown);
    OWN(fracas_campaign) campaign = read_text(text);
    OWN(fracas_model) model = model_of(campaign, 0);
    assert_int_equal(fracas_model_surface(model)->order, 2);
}

/* The name of a group is a key, even a key of another shape; the file's own keys come first. */
static void test_names_of_groups(void **state)
{
    static const struct {
        const char *names, *keys; /* of physical groups, and of the campaign */
        int held;                 /* group; 0: refused */
        const char *said;
    } named[] = {
        {"1 2 \"lower side\"", "lower side: held", 2, NULL},
        {"2 3 \"left\"\n1 4 \"right\"\n1 2 \"left\"", "left: held", 2, NULL},
        {"1 3 \"edge_2\"", "edge_2: held", 2, NULL},
        {"1 2 \"edges\"", "edges: held", 0, NULL}, /* all others */
        {"1 9 \"wall\"", "wall: held", 0,
         "`wall`: the mesh file's physical group of this name has the number 9"},
        {"1 2 \"wall\"", "wall: held, edge_2: free", 0, "given twice"},
        {"1 2 \"wall\"", "wall: helt", 0, "did you mean `held`"},
        {"1 2 \"wall\"", "wal: held", 0, "unknown key `wal` in geometry; did you mean `wall`?"},
        {"1 2 \"wall\"", "left: held", 0, "`left` belongs to shape plate"},
        {"2 2 \"wall\"", "wall: held", 0, "unknown key `wall`"},
        {"1 1 \"edge_2\"\n1 2 \"wall\"", "wall: held", 0, "another physical group for edge_2"},
        {"1 2 \"wall\"\n1 2 \"edge_3\"", "wall: held", 3, NULL},
        {"1 9 \"wall\"\n1 2 \"wall\"", "wall: held", 2, NULL},
        {"1 1 \"wall\"\n1 2 \"wall\"", "wall: held", 0, "another physical group for edge_1"},
        {"1 7 \"wall\"", "wall: held", 7, NULL},
        {"1 9 \"edge_8\"", "edge_8: held", 8, NULL},
        {"1 9 \"wall\"", "wall: held", 0, "those with keys have 1 to 8: in the .geo file"},
        {"1 9 \"wall\"", "edge_9: held", 0, "unknown key `edge_9` in geometry"},
    };
    char path[40];
    make_path(path);
    for (size_t i = 0; i < FRACAS_COUNT(named); i++) {
        char names[200];
        snprintf(names, sizeof names, "$EndMeshFormat\n$PhysicalNames\n%d\n%s\n$EndPhysicalNames\n",
                 i == 1 ? 3 : 1, named[i].names);
        OWNED char *mesh = replace(two_triangles, "$EndMeshFormat\n", names);
        write_bytes(path, mesh, strlen(mesh));
        OWNED char *plain = file_campaign(
            path, "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n");
        OWNED char *text = replace(plain, "edge_2: held, edge_3: fixed", named[i].keys);
        if (named[i].said) {
            fracas_campaign *none;
            char file[40];
            make_path(file);
            write_bytes(file, text, strlen(text));
            FAILS(fracas_campaign_read(file, &none), FRACAS_USAGE, named[i].said);
            unlink(file);
            continue;
        }
        OWN(fracas_campaign) campaign = read_text(text);
        const fracas_geometry *geometry = &campaign->point[0].spec.geometry;
        for (int tag = 0; tag < FRACAS_EDGES; tag++)
            assert_ptr_equal(geometry->edge[tag], tag == named[i].held ? &fracas_edge_held
                                                  : tag < 5            ? &fracas_edge_free
                                                                       : NULL);
    }
    unlink(path);
}

/* A line in the groups 2 and 6: it belongs to 2, and a campaign that uses 6 is refused. */
static void test_line_of_two_groups(void **state)
{
    static const struct {
        const char *keys, *loading;
        bool refused;
    } of[] = {{"edge_2: held", "{rate: 1e4 1/s}", false},
              {"edge_2: held, edges: fixed", "{rate: 1e4 1/s}", false},
              {"edge_6: free", "{rate: 1e4 1/s}", true},
              {"edge_2: held", "{type: traction, edge: edge_6, normal: 1 MPa}", true}};
    OWNED char *six = replace(two_triangles, "$Elements\n4\n", "$Elements\n6\n"),
               *mesh = replace(six, "$EndElements", "5 1 2 6 1 2 1\n6 1 2 6 1 3 2\n$EndElements");
    char path[40];
    make_path(path);
    write_bytes(path, mesh, strlen(mesh));
    OWNED char *plain = file_campaign(path,
                                      "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n");
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        OWNED char *held = replace(plain, "edge_2: held, edge_3: fixed", of[i].keys),
                   *text = replace(held, "{rate: 1e4 1/s}", of[i].loading);
        OWN(fracas_campaign) campaign = read_text(text);
        fracas_model *model = NULL;
        if (of[i].refused)
            FAILS(fracas_point_model_create(campaign, 0, &model), FRACAS_USAGE,
                  "edge_6 is used, but the mesh has lines of the physical group 6 in a group of a "
                  "lesser number, too: an edge has one: take these lines out of one of them");
        else OK(fracas_point_model_create(campaign, 0, &model));
        fracas_model_destroy(model);
    }
    unlink(path);
}

/* ---- names of groups in the sweep and in the loading ---- */

typedef struct {
    char first[40], second[40]; /* paths of two mesh files */
} meshes;

static void write_meshes(meshes *of)
{
    static const char *const names[2] = {"1 2 \"lower side\"\n1 1 \"left\"\n1 3 \"right\"",
                                         "1 1 \"lower side\"\n1 2 \"left\"\n1 3 \"right\""};
    char *const path[2] = {of->first, of->second};
    for (int m = 0; m < 2; m++) {
        char section[200];
        snprintf(section, sizeof section,
                 "$EndMeshFormat\n$PhysicalNames\n3\n%s\n$EndPhysicalNames\n", names[m]);
        OWNED char *mesh = replace(two_triangles, "$EndMeshFormat\n", section);
        make_path(path[m]);
        write_bytes(path[m], mesh, strlen(mesh));
    }
}

/* The first mesh, nothing held but by `keys`, with this loading and sweep, in which @1 and @2 are
 * the two files. */
static char *named_campaign(const meshes *of, const char *keys, const char *loading,
                            const char *sweep)
{
    OWNED char *plain = file_campaign(of->first,
                                      "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n"),
               *held = replace(plain, ", edge_2: held, edge_3: fixed", keys),
               *loaded = replace(held, "loading: {rate: 1e4 1/s}", loading);
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    fputs(loaded, out);
    for (const char *at = sweep; *at; at++)
        if (*at == '@') fputs(*++at == '1' ? of->first : of->second, out);
        else fputc(*at, out);
    fclose(out);
    return text;
}

#define PULLED "loading: {type: edge-motion, edge: right, displacement: 1 um, rise: 1 us}"
#define RATE "loading: {rate: 1e4 1/s}"

/* A name stands for the key of its group, whatever another shape calls so, at each place. */
static void test_names_in_a_sweep(void **state)
{
    static const struct {
        const char *keys, *loading, *sweep;
        const char *path[2], *value[2]; /* of both points */
    } named[] = {
        {"",
         RATE,
         "sweep:\n  - geometry.left: [held, fixed]\n",
         {"geometry.edge_1", "geometry.edge_1"},
         {"held", "fixed"}},
        {"",
         RATE,
         "sweep:\n  - geometry.lower side: [held, fixed]\n",
         {"geometry.edge_2", "geometry.edge_2"},
         {"held", "fixed"}},
        {"",
         RATE,
         "sweep:\n  - geometry: [{left: held}, {lower side: held}]\n",
         {"geometry.edge_1", "geometry.edge_2"},
         {"held", "held"}},
        {", left: held",
         PULLED,
         "sweep:\n  - loading.edge: [left, edge_2]\n",
         {"loading.edge", "loading.edge"},
         {"edge_1", "edge_2"}},
        {"",
         PULLED,
         "sweep:\n  - loading.second_edge: [left, lower side]\n",
         {"loading.edge", "loading.second_edge"},
         {"edge_3", "edge_2"}},
        {"",
         "loading: {type: traction, edge: lower side, normal: 1 MPa}",
         "sweep:\n  - loading.normal: [1, 2]\n",
         {"loading.edge", "loading.edge"},
         {"edge_2", "edge_2"}},
        {"",
         PULLED,
         "sweep:\n  - zip:\n      geometry.left: [held, fixed]\n      loading.edge: [right, "
         "left]\n",
         {"loading.edge", "loading.edge"},
         {"edge_3", "edge_1"}},
        /* beside its own file, a name is that file's; without one, it is one in all */
        {"",
         RATE,
         "sweep:\n  - cases:\n    - {geometry.left: held, geometry.file: @1}\n"
         "    - {geometry: {left: held, file: @2}}\n",
         {"geometry.edge_1", "geometry.edge_2"},
         {"held", "held"}},
        {"",
         "loading: {type: traction, normal: 1 MPa}",
         "sweep:\n  - cases:\n    - {loading.edge: left, geometry.file: @1}\n"
         "    - {geometry.file: @2, loading: {edge: left}}\n",
         {"loading.edge", "loading.edge"},
         {"edge_1", "edge_2"}},
        {"",
         PULLED,
         "sweep:\n  - geometry.file: [@1, @2]\n",
         {"loading.edge", "loading.edge"},
         {"edge_3", "edge_3"}},
    };
    meshes of;
    write_meshes(&of);
    for (size_t i = 0; i < FRACAS_COUNT(named); i++) {
        OWNED char *text = named_campaign(&of, named[i].keys, named[i].loading, named[i].sweep);
        OWN(fracas_campaign) campaign = read_text(text);
        assert_int_equal(campaign->npoints, 2);
        for (size_t p = 0; p < 2; p++)
            assert_string_equal(at(campaign, p, named[i].path[p])->text, named[i].value[p]);
    }
    unlink(of.first);
    unlink(of.second);
}

/* plan's table has the names of a mesh file, and keys where two files have two. */
static void test_names_in_a_plan(void **state)
{
    static const struct {
        const char *sweep, *head, *value;
    } of[] = {
        {"sweep:\n  - geometry.lower side: [held, free]\n", "  geometry.lower side  ", " free  "},
        {"sweep:\n  - loading.edge: [lower side, right]\n", "  loading.edge  ", " lower side  "},
        {"sweep:\n  - cases:\n    - {geometry: {file: @1, lower side: held}}\n"
         "    - {geometry: {file: @2, left: held}}\n    - {geometry: {file: @2}}\n",
         "  geometry.edge_2  ", " held  "},
    };
    meshes files;
    write_meshes(&files);
    for (size_t i = 0; i < FRACAS_COUNT(of); i++) {
        OWNED char *text = named_campaign(
            &files, "", "loading: {type: traction, edge: right, normal: 1 MPa}", of[i].sweep);
        OWN(fracas_campaign) campaign = read_text(text);
        OWNED char *plan = plan_text(campaign, 1, false);
        assert_non_null(strstr(plan, of[i].head));
        assert_non_null(strstr(plan, of[i].value));
    }
    unlink(files.first);
    unlink(files.second);
}

/* A name that no file has, that one file has not, and that is two keys in two files. */
static void test_wrong_names(void **state)
{
    static const struct {
        const char *keys, *loading, *sweep, *said;
    } wrong[] = {
        {"", RATE, "sweep:\n  - geometry.lover side: [held, free]\n",
         "unknown path `geometry.lover side` in the sweep; did you mean `geometry.lower side`? "
         "paths in geometry: geometry.lower side, geometry.left, geometry.right, "},
        {"", "loading: {type: traction, edge: rigth, normal: 1 MPa}", "",
         "unknown edge `rigth`; did you mean `right`? edge can be: lower side, left, right, "
         "bottom, top, "},
        {"", RATE, "sweep:\n  - geometry.left: [held, free]\n  - geometry.file: [@1, @2]\n",
         "`left` is edge_1 in /tmp/"},
        {", left: held", RATE, "sweep:\n  - geometry.file: [@1, @2]\n",
         "`left` is edge_1 in /tmp/"},
        {"", RATE, "sweep:\n  - geometry.left: [held, free]\n  - geometry.edge_1: [held, free]\n",
         "is swept by two axes"},
        {"", RATE, "sweep:\n  - geometry.left: [helt, free]\n", "did you mean `held`"},
        {"", RATE,
         "sweep:\n  - geometry.left: [held, free]\n  - geometry.file: [@1, " FRACAS_SOURCE_DIR
         "/tests/data/gmsh/plate-order1-msh22-text.msh]\n",
         "`left`: the mesh file's physical group of this name has the number 11"},
        {"", RATE, "sweep:\n  - geometry.file: [@1, /none.msh]\n  - geometry.left: [held, free]\n",
         "cannot open /none.msh"},
    };
    meshes of;
    write_meshes(&of);
    for (size_t i = 0; i < FRACAS_COUNT(wrong); i++) {
        OWNED char *text = named_campaign(&of, wrong[i].keys, wrong[i].loading, wrong[i].sweep);
        char path[40];
        fracas_campaign *none;
        make_path(path);
        write_bytes(path, text, strlen(text));
        FAILS(fracas_campaign_read(path, &none), FRACAS_USAGE, wrong[i].said);
        unlink(path);
    }
    OWNED char *text = named_campaign(&of, "",
                                      "loading: {type: traction, edge: bottom, normal: 1 MPa}", "");
    OWN(fracas_campaign) campaign = read_text(text); /* the key of a plate */
    double cost;
    FAILS(fracas_plan_cost(campaign, 0, &cost, NULL), FRACAS_USAGE,
          "has no physical group of curves of this name: it has \"lower side\", \"left\", "
          "\"right\"; name one of them, or edge_1, edge_2");
    unlink(of.first);
    unlink(of.second);
}

/* The plate is 2 by 1 units; its groups 11 and 12 have no key of their own. */
static void test_unit(void **state)
{
    static const char plate[] = FRACAS_SOURCE_DIR "/tests/data/gmsh/plate-order1-msh22-text.msh";
    static const char strength[] = "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n";
    OWNED char *grouped = file_campaign(plate, strength),
               *metres = replace(grouped, "edge_2: held, edge_3: fixed", "edges: held"),
               *microns = replace(metres, "thickness: 1 mm", "unit: um, thickness: 1 mm");
    OWN(fracas_campaign) in_m = read_text(metres), *in_um = read_text(microns);
    OWN(fracas_model) large = model_of(in_m, 0), *small = model_of(in_um, 0);
    /* rounding of 1e-6 and of products */
    assert_true(fabs(fracas_model_interface_volume(small, 0) /
                         (1e-12 * fracas_model_interface_volume(large, 0)) -
                     1) < 1e-14);
    FAILS(fracas_model_check_strength(large, 300e6), FRACAS_USAGE,
          "the mesh file makes a body of 2 by 1 by 0 m: if it is in mm, give geometry.unit: mm");
    OWNED char *plan = plan_text(in_um, 1, false);
    assert_non_null(strstr(plan, "msh22-text.msh: 2e-06 by 1e-06 by 0 m.\n"));
    assert_non_null(strstr(plan, "edges of the mesh file's physical group 11 \"left\" and 1 more "
                                 "are held as "
                                 "geometry.edges says"));
}

/* ---- plans of mesh files ---- */

/* Squares of 0.1 mm cut in two, `nx` by `ny`, each `apart` nodes of its own from column `split` on.
 */
static char *grid_file(int nx, int ny, int split, double size, const char *more)
{
    char *text = NULL;
    size_t bytes;
    FILE *out = open_memstream(&text, &bytes);
    const int row = nx + 2; /* a column twice */
    fprintf(out,
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n1 9 \"notch\"\n"
            "$EndPhysicalNames\n$Nodes\n%d\n",
            row * (ny + 1));
    for (int j = 0; j <= ny; j++)
        for (int i = 0; i < row; i++)
            fprintf(out, "%d %.17g %.17g 0\n", row * j + i + 1, size * (i > split ? i - 1 : i),
                    size * j);
    fprintf(out, "$EndNodes\n$Elements\n%d\n", 2 * nx * ny + (*more ? 1 : 0));
    for (int j = 0; j < ny; j++)
        for (int i = 0; i < nx; i++) {
            const int a = row * j + i + 1 + (i >= split), b = a + row;
            fprintf(out, "%d 2 0 %d %d %d\n%d 2 0 %d %d %d\n", 2 * (nx * j + i) + 1, a, a + 1,
                    b + 1, 2 * (nx * j + i) + 2, a, b + 1, b);
        }
    fprintf(out, "%s$EndElements\n", more);
    fclose(out);
    return text;
}

static char *plan_of_mesh(const char *mesh)
{
    char path[40];
    make_path(path);
    write_bytes(path, mesh, strlen(mesh));
    OWNED char *grouped = file_campaign(path,
                                        "strength: {minimum: 26 kPa, scale: 5 kPa, shape: 2}\n"),
               *text = replace(grouped, "edge_2: held, edge_3: fixed", "edges: free");
    OWN(fracas_campaign) campaign = read_text(text);
    char *plan = plan_text(campaign, 1, false);
    unlink(path);
    return plan;
}

static void test_plan_of_parts(void **state)
{
    OWNED char *halves = grid_file(4, 3, 2, 1e-4, ""), *one = grid_file(4, 3, 0, 1e-4, "");
    OWNED char *warned = plan_of_mesh(halves), *silent = plan_of_mesh(one);
    assert_non_null(strstr(warned, "the mesh file has 2 parts without a common edge"));
    assert_non_null(strstr(warned, "4 nodes of different parts are in one position"));
    assert_non_null(strstr(warned, "Coherence Mesh"));
    assert_null(strstr(silent, "parts"));
}

/* A body of half a metre or more is asked about, and one of lines inside. */
static void test_plan_of_file(void **state)
{
    OWNED char *large = grid_file(4, 3, 0, 0.125, ""), *small = grid_file(4, 3, 0, 0.12, ""),
               *notched = grid_file(4, 3, 0, 1e-4, "99 1 2 9 9 9 15\n"),
               *regular = grid_file(12, 12, 0, 1e-4, "");
    OWNED char *asked = plan_of_mesh(large), *silent = plan_of_mesh(small),
               *told = plan_of_mesh(notched), *steered = plan_of_mesh(regular);
    assert_non_null(strstr(asked, "a body of 0.5 by 0.375 by 0 m: is it in mm?"));
    assert_null(strstr(silent, "in mm"));
    assert_null(strstr(silent, "three directions"));
    assert_non_null(strstr(told, "physical group 9 \"notch\" lie inside the body"));
    assert_non_null(strstr(steered, "100 % of the length of the mesh file's edges lies in three"));
}

/* A file that is no mesh is found out when it is used: by a plan, or where strengths depend on the
 * volume of an interface. */
static void test_no_mesh(void **state)
{
    char path[40], campaign_path[40];
    make_path(path);
    make_path(campaign_path);
    write_bytes(path, "strengths\n", 10);
    char *text = file_campaign(path, "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n");
    fracas_campaign *campaign = read_text(text);
    double cost;
    FAILS(fracas_plan_cost(campaign, 0, &cost, NULL), FRACAS_USAGE, "point 0: mesh file /tmp/");
    fracas_campaign_destroy(campaign);
    free(text);
    text = file_campaign(path, "strength: {distribution: flaws, flaw_density: 1e11 1/m3, minimum: "
                               "100 MPa, maximum: 400 MPa, exponent: 2}\n");
    write_bytes(campaign_path, text, strlen(text));
    FAILS(fracas_campaign_read(campaign_path, &campaign), FRACAS_USAGE,
          ":1:1: `mesh`: point 0: mesh file /tmp/");
    free(text);
    unlink(path);
    unlink(campaign_path);
}

/* Triangles with nodes of their own have no interface. */
static void test_no_interface(void **state)
{
    static const char soup[] =
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 0 0\n"
        "5 0 1 0\n6 1 1 0\n$EndNodes\n$Elements\n2\n1 2 0 1 2 3\n2 2 0 4 6 5\n$EndElements\n";
    char path[40];
    make_path(path);
    write_bytes(path, soup, strlen(soup));
    OWNED char *text = file_campaign(path,
                                     "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}\n");
    OWN(fracas_campaign) campaign = read_text(text);
    double cost;
    FAILS(fracas_plan_cost(campaign, 0, &cost, NULL), FRACAS_USAGE,
          "none of the 2 elements has a neighbour");
    assert_non_null(strstr(fracas_message(), "2 positions have nodes of several elements"));
    unlink(path);
}

/* A plan, and a run before it begins, say what body it is. */
static void test_warnings_of_a_run(void **state)
{
    OWNED char *mesh = grid_file(4, 3, 2, 0.2, "");
    char path[40], *said = NULL;
    size_t size;
    double cost;
    make_path(path);
    write_bytes(path, mesh, strlen(mesh));
    OWNED char *grouped = file_campaign(path,
                                        "strength: {minimum: 26 kPa, scale: 5 kPa, shape: 2}\n"),
               *text = replace(grouped, "edge_2: held, edge_3: fixed", "edges: free");
    OWN(fracas_campaign) campaign = read_text(text);
    OWN(fracas_model) model = model_of(campaign, 0);
    FILE *out = open_memstream(&said, &size);
    fracas_plan_words words = {.out = out};
    OK(fracas_plan_cost_with(campaign, 0, model, &words, &cost, NULL));
    fclose(out);
    assert_non_null(strstr(said, "warning: point 0: the mesh file has 2 parts"));
    assert_non_null(strstr(said, "is it in mm?"));
    free(said);
    unlink(path);
}

TESTS_ALL(read_file, free_file, test_file, test_names_of_groups, test_line_of_two_groups,
          test_names_in_a_sweep, test_names_in_a_plan, test_wrong_names, test_page_example,
          test_unit, test_no_mesh, test_plan_of_parts, test_plan_of_file, test_no_interface,
          test_warnings_of_a_run)
