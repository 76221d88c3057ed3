/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files of cylinders: names of points, parts that other shapes have not, edges, plans. */
#include "tests/support/campaign_text.h"

#include "campaigns/plan/forecast.h"
#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"
#include "engine/mesh/body.h"
#include "tests/support/cracks.h"

static const char tube[] =
    "name: t\nseed: 7\nmodel: shell\n"
    "geometry: {shape: cylinder, part: quarter, radius: 1 mm, length: 3 mm, thickness: 0.1 mm}\n"
    "mesh: {divisions: 4}\nmaterial: {young: 370e9, poisson: 0.25, density: 3900}\n"
    "cohesive: {fracture_energy: 100}\nstrength: {minimum: 264e6, scale: 50e6, shape: 2}\n"
    "loading: {rate: 1e5, ratio: 0}\ntime: {end: 1e-7}\nreplicas: 1\n";

static fracas_campaign *tube_with(const char *find, const char *put)
{
    OWNED char *text = replace(tube, find, put);
    return read_text(text);
}

static void refused(const char *find, const char *put, const char *message)
{
    char path[40];
    fracas_campaign *campaign = NULL;
    OWNED char *text = replace(tube, find, put);
    make_path(path);
    write_bytes(path, text, strlen(text));
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, message);
    unlink(path);
}

/* The same text gives the same name whatever the program. */
static void test_name(void **state)
{
    static const char text[] =
        "cohesive.beta=5\ncohesive.beta_shear=1\ncohesive.coupling=1\ncohesive.critical_opening=0\n"
        "cohesive.fracture_energy=100\ncohesive.friction=0\ncohesive.law=nitsche\n"
        "cohesive.onset=mean\ngeometry.bottom=free\ngeometry.length=0.003\ngeometry.part=quarter\n"
        "geometry.radius=0.001\ngeometry.shape=cylinder\ngeometry.thickness=0.0001\n"
        "geometry.top=free\nloading.rate=100000\nloading.ratio=0\nloading.start=moving\n"
        "loading.type=expansion\nmaterial.density=3900\nmaterial.poisson=0.25\n"
        "material.young=370000000000\nmesh.amplitude=0\nmesh.divisions=4\nmesh.order=2\n"
        "mesh.size=0\nmesh.spacing=triangles\nmodel=shell\nstrength.distribution=weibull\n"
        "strength.minimum=264000000\nstrength.scale=50000000\nstrength.shape=2\ntime.end=1e-07\n"
        "time.integrator=central-difference\ntime.safety=0.25\n"
        "time.spectral_radius=0.95\ntime.stop=time\n";
    OWN(fracas_campaign) campaign = tube_with("", "");
    const fracas_hash hash = fracas_hash_of(text, strlen(text));
    assert_true(fracas_hash_equal(&campaign->point[0].hash, &hash));
    assert_true(isnan(at(campaign, 0, "derived.radius")->real)); /* that of a ring */
    check_round_trip(campaign);
}

/* Each shape has parts of its own, of one key; a sweep gives each its own. */
static void test_parts(void **state)
{
    OWN(fracas_campaign) campaign = tube_with(
        "", "sweep:\n  - cases:\n      - {name: half, geometry.part: half}\n      - {name: octant, "
            "geometry.part: octant}\n      - {name: whole, geometry.part: whole}\n      - {name: "
            "sphere, geometry: {shape: sphere, part: octant, radius: 1e-3}}\n      - {name: ball, "
            "geometry: {shape: sphere, radius: 1e-3}}\n");
    static const char *const part[] = {"half", "octant", "whole", "octant", "whole"};
    assert_int_equal(campaign->npoints, 5);
    for (size_t p = 0; p < 5; p++) {
        assert_string_equal(campaign->point[p].spec.geometry.part->name, part[p]);
        assert_string_equal(at(campaign, p, "geometry.part")->text, part[p]);
    }
    assert_int_equal(strcmp(at(campaign, 4, "geometry.top")->text, ""), 0);
    refused("shape: cylinder, part: quarter, radius: 1 mm, length: 3 mm",
            "shape: sphere, part: quarter, radius: 1 mm",
            "`part` cannot be `quarter` here; part can be: whole, octant");
    refused("part: quarter", "part: quartet",
            "unknown part `quartet`; did you mean `quarter`? part can be: whole, octant, half, "
            "quarter");
    refused("", "sweep:\n  - geometry.shape: [cylinder, sphere]\n", "length");
    refused("part: quarter,", "part: octant, bottom: clamped,",
            "bottom is clamped, but part: octant ends in the plane y = 0");
    refused("part: quarter,", "left: free,", "`left` belongs to shape plate");
    refused("part: quarter,", "inner_edge: free,", "`inner_edge` belongs to shape annulus");
}

/* Ends are as the file says; where the tube is cut it is its own mirror image. */
static void test_edges(void **state)
{
    OWN(fracas_campaign) campaign = tube_with("part: quarter",
                                              "part: quarter, bottom: diaphragm, top: clamped");
    const fracas_spec *spec = &campaign->point[0].spec;
    assert_ptr_equal(spec->geometry.edge[3], &fracas_edge_diaphragm);
    assert_ptr_equal(spec->geometry.edge[4], &fracas_edge_clamped);
    for (int32_t tag = 0; tag < FRACAS_EDGES; tag++)
        assert_ptr_equal(fracas_shape_edge(spec, tag), tag < 3 ? &fracas_edge_symmetry : NULL);
    OWN(fracas_campaign) octant = tube_with("part: quarter", "part: octant");
    assert_ptr_equal(fracas_shape_edge(&octant->point[0].spec, 3), &fracas_edge_symmetry);
    assert_ptr_equal(fracas_shape_edge(&octant->point[0].spec, 4), NULL);
    OWN(fracas_model) model = NULL;
    OK(fracas_point_model_create(campaign, 0, &model)); /* edges are as such edges must be */
    OWN(fracas_campaign) sliding = tube_with("part: quarter", "part: quarter, top: sliding");
    OWN(fracas_model) none = NULL;
    FAILS(
        fracas_point_model_create(sliding, 0, &none), FRACAS_USAGE,
        "an edge with tag 4 is `sliding`, which edges of a shell cannot be: let it be free, held, "
        "fixed, clamped, symmetry or diaphragm");
}

/* A quarter of 4 by 8 squares: elements; interfaces are the lines between squares, and diagonals.
 * The mean volume of an interface is that of a third of two elements. */
static void test_plan(void **state)
{
    OWN(fracas_campaign) campaign = tube_with("", "");
    fracas_forecast forecast;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    assert_int_equal(forecast.elements, 2 * 4 * 8);
    assert_int_equal(forecast.interfaces, 3 * 8 + 4 * 7 + 4 * 8);
    const double area = M_PI_2 * 1e-3 * 3e-3;
    assert_true(fabs(forecast.volume / (1e-4 * area * 2 / 3 / 64) - 1) < 1e-4);
    OWNED char *text = plan_text(campaign, 1, false);
    assert_has(text, "64");
}

/* A free tube stays below the bound until long after it has swung back; growing away from its axis
 * it reaches a half of it. */
static void test_bound(void **state)
{
    static const struct {
        const char *ratio, *end;
        double reached; /* of the bound, at least; 0: unknown */
    } table[] = {{"0", "1e-7", 0.5}, {"0", "6e-7", 0.5}, {"1", "6e-7", 0}, {"-0.5", "3e-7", 0}};
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char loading[100];
        snprintf(loading, sizeof loading, "ratio: %s}\ntime: {end: %s}", table[i].ratio,
                 table[i].end);
        OWNED char *tough = replace(tube, "fracture_energy: 100", "fracture_energy: 1e9");
        OWNED char *loaded = replace(tough, "ratio: 0}\ntime: {end: 1e-7}", loading);
        OWNED char *uneven = replace(loaded, "divisions: 4", "divisions: 6, amplitude: 0.2");
        OWN(fracas_campaign) campaign = read_text(uneven);
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        OWN(fracas_model) model = NULL;
        OK(fracas_point_model_create(campaign, 0, &model));
        assert_false(cracks(model, forecast.bound));
        if (table[i].reached > 0) assert_true(cracks(model, table[i].reached * forecast.bound));
    }
}

TESTS(test_name, test_parts, test_edges, test_plan, test_bound)
