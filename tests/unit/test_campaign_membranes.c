/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaign files of membranes: shapes, keys that only this model has, meshes drawn from the seed,
 * plans. */
#include "tests/support/strengths.h"
#include "tests/support/campaign_text.h"

#include "campaigns/plan/forecast.h"
#include "campaigns/plan/plan.h"
#include "campaigns/plan/point_model.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"
#include "tests/support/cracks.h"
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

static fracas_campaign *read_membrane(const char *find, const char *put)
{
    OWNED char *text = replace(membrane_campaign, find, put);
    fracas_campaign *campaign = read_text(text);
    return campaign;
}

static fracas_model *model_of(const fracas_campaign *campaign, size_t point)
{
    fracas_model *model;
    OK(fracas_point_model_create(campaign, point, &model));
    return model;
}

/* ---- what a file says ---- */

/* Every value of a plate, as it names the point; the same text gives the same name whatever the
 * program. */
static void test_plate(void **state)
{
    static const char text[] =
        "cohesive.beta=5\ncohesive.coupling=1\ncohesive.critical_opening=0\ncohesive.fracture_"
        "energy=150\ncohesive.friction=0\ncohesive.law=nitsche\n"
        "cohesive.onset=mean\ngeometry.bottom=free\ngeometry.height=0.005\ngeometry.left="
        "free\ngeometry.right=free\n"
        "geometry.shape=plate\ngeometry.thickness=0.0001\ngeometry.top=free\ngeometry.width=0."
        "01\nloading.rate=10000\n"
        "loading.ratio=1\nloading.start=moving\nloading.type=expansion\nmaterial.density="
        "3900\nmaterial.poisson=0.25\n"
        "material.young=370000000000\nmesh.amplitude=0\nmesh.divisions=4\nmesh.order=1\nmesh.size="
        "0\nmesh.spacing=triangles\n"
        "model=membrane\nstrength.distribution=weibull\nstrength.minimum=264000000\nstrength.scale="
        "50000000\nstrength.shape=2\n"
        "time.end=1e-07\ntime.integrator=central-difference\ntime.mass=lumped\ntime.safety=0."
        "25\ntime.spectral_radius=0.95\n"
        "time.stop=time\n";
    OWN(fracas_campaign) campaign = read_membrane("", "");
    const fracas_hash hash = fracas_hash_of(text, strlen(text));
    assert_true(fracas_hash_equal(&campaign->point[0].hash, &hash));
    assert_true(at(campaign, 0, "derived.strain_rate")->real == 1e4);
    assert_true(at(campaign, 0, "derived.surface")->real == 1);
    assert_true(at(campaign, 0, "derived.lattice")->real == 0);
    assert_true(isnan(at(campaign, 0, "derived.length")->real));
    OWN(fracas_model) model = model_of(campaign, 0);
    assert_int_equal(fracas_model_elements(model), 2 * 8 * 4);
    assert_int_equal(fracas_model_interfaces(model),
                     8 * 3 + 4 * 7 + 8 * 4); /* lines between squares, diagonals */
    OWN(fracas_campaign) spun = read_membrane(
        "loading: {rate: 1e4 1/s}", "loading: {type: centrifugal, speed: 1e3 rad/s, ramp: 1 us}");
    assert_true(isnan(at(spun, 0, "derived.strain_rate")->real));
}

static void test_annulus(void **state)
{
    OWN(fracas_campaign) campaign = read_membrane(
        "geometry: {width: 10 mm, height: 5 mm, ",
        "geometry: {shape: annulus, inner: 5 mm, outer: 10 mm, outer_edge: held, ");
    const fracas_geometry *geometry = &campaign->point[0].spec.geometry;
    assert_true(geometry->inner == 0.005 && geometry->outer == 0.01 && geometry->thickness == 1e-4);
    assert_ptr_equal(geometry->edge[1], &fracas_edge_free);
    assert_ptr_equal(geometry->edge[2], &fracas_edge_held);
    OWN(fracas_model) model = model_of(campaign, 0);
    fracas_surface_measures all;
    fracas_surface_measure(fracas_model_surface(model), &all);
    assert_true(fabs(all.area / (M_PI * 75e-6) - 1) <
                0.02); /* of 4 layers: chords cut some 1 % off */
}

/* The mean strength of flaws is that of the mean volume: thickness (area)/(3 squares) on a plate of
 * squares cut in two. */
static void test_mean_strength(void **state)
{
    OWN(fracas_campaign) campaign = read_membrane(
        "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}",
        "strength: {distribution: flaws, flaw_density: 1e11 1/m3, minimum: 100 MPa, maximum: 400 "
        "MPa, exponent: 2}\n"
        "sweep:\n  - mesh.divisions: [4, 2]\n  - loading.rate: [1, 2]");
    for (size_t p = 0; p < 4; p++) {
        const double squares = p < 2 ? 4 * 8 : 2 * 4, volume = 1e-4 * 50e-6 / (3 * squares);
        const double expected = mean_of_strength(&campaign->point[p].strength, volume);
        /* the mean moves by less than the volume does, which is within some 40 roundings */
        assert_true(fabs(at(campaign, p, "derived.strength_mean")->real / expected - 1) <
                    40 * 0x1p-53);
    }
    assert_true(at(campaign, 0, "derived.strength_mean")->real >
                at(campaign, 2, "derived.strength_mean")->real);
}

/* ---- keys of some models only ---- */

/* A bar and a membrane of one material: what only the membrane has is the membrane's, and the bar
 * is the one of a campaign of its own. The sections give poisson, coupling and integrator, for the
 * points that have them. */
static void test_swept_model(void **state)
{
    char *text = replace(plain_campaign, "  density: 2750 kg/m3\n",
                         "  density: 2750 kg/m3\n  poisson: 0.25\n");
    OWNED char *sliding = replace(text, "  law: nitsche\n", "  law: nitsche\n  coupling: 2\n");
    free(text);
    text = replace(sliding, "  quiet: 100 ns\n", "  quiet: 100 ns\n  integrator: hulbert-chung\n");
    OWNED char *swept = replace(
        text, "",
        "sweep:\n  - cases:\n      - {name: bar}\n      - {name: plate, model: membrane, time: "
        "{stop: time}, geometry: {shape: plate, width: 1, height: 1, thickness: 1}, mesh: "
        "{divisions: 2}, loading: {type: expansion, rate: 1e4}}\n");
    free(text);
    /* `model: bar` in the file, or no model: the same points */
    OWNED char *unnamed = replace(swept, "model: bar\n", "");
    OWN(fracas_campaign) campaign = read_text(swept), *same = read_text(unnamed),
                         *alone = read_text(plain_campaign);
    assert_true(fracas_hash_equal(&campaign->hash, &same->hash));
    assert_true(fracas_hash_equal(&campaign->point[0].hash, &alone->point[0].hash));
    assert_true(isnan(at(campaign, 0, "material.poisson")->real) &&
                at(campaign, 1, "material.poisson")->real == 0.25);
    assert_true(isnan(at(campaign, 0, "cohesive.coupling")->real) &&
                at(campaign, 1, "cohesive.coupling")->real == 2);
    assert_string_equal(at(campaign, 0, "time.integrator")->text, "");
    assert_string_equal(at(campaign, 1, "time.integrator")->text, "hulbert-chung");
    assert_true(isnan(at(campaign, 1, "mesh.elements")->real) &&
                isnan(at(campaign, 1, "geometry.area")->real));
    for (size_t c = 0; c < alone->table.ncolumns; c++) /* none of a bar's own is new */
        assert_null(strstr(alone->table.column[c].path, "poisson"));
    check_round_trip(campaign);
}

/* Keys that all kinds of a membrane have stay when its kind changes: a law's beta and friction, a
 * shape's thickness. */
static void test_inherited(void **state)
{
    fracas_campaign *campaign = read_membrane(
        "  fracture_energy: 150 J/m2\n",
        "  fracture_energy: 150 J/m2\n  beta: 10\n  friction: 0.5\nsweep:\n  - cohesive.law: "
        "[nitsche, camacho-ortiz-standard, camacho-ortiz]\n  - geometry: [{width: 20 mm}, {shape: "
        "annulus, inner: 1 mm, outer: 2 mm}]\n");
    assert_int_equal(campaign->npoints, 6);
    for (size_t p = 0; p < 6; p++) {
        const fracas_spec *spec = &campaign->point[p].spec;
        assert_true(spec->cohesive.beta == 10 && spec->cohesive.friction == 0.5 &&
                    spec->geometry.thickness == 1e-4);
        assert_true(p % 2 ? spec->geometry.outer == 2e-3 : spec->geometry.width == 0.02);
    }
    check_round_trip(campaign);
    fracas_campaign_destroy(campaign);
    /* a bar's area and number of elements are a ring's too, as they always were */
    campaign = read_replaced(
        "  length: 50 mm\n",
        "  length: 50 mm\n  area: 3 mm2\nsweep:\n  - cases:\n      - {name: bar}\n"
        "      - {model: ring, geometry: {shape: ring, radius: 1 cm}}\n");
    for (size_t p = 0; p < 2; p++) {
        const fracas_spec *spec = &campaign->point[p].spec;
        assert_true(spec->geometry.area == 3e-6 && spec->mesh.elements == 100);
    }
    check_round_trip(campaign);
    fracas_campaign_destroy(campaign);
}

/* ---- the mesh ---- */

/* Sum of squares of the moves of nodes between the meshes of two models that are alike; how many
 * have moved. */
static size_t count_moved(const fracas_model *a, const fracas_model *b)
{
    const fracas_surface *s = fracas_model_surface(a), *t = fracas_model_surface(b);
    size_t moved = 0;
    assert_int_equal(s->nnodes, t->nnodes);
    for (size_t n = 0; n < s->nnodes; n++)
        moved += memcmp(s->node[n], t->node[n], sizeof s->node[n]) != 0;
    return moved;
}

/* The seed and the point say where nodes are, for all realizations of the point. Of 9 x 5 vertices
 * 7 x 3 are inside. */
static void test_perturbed(void **state)
{
    static const char mesh[] =
        "  divisions: 4\n  amplitude: 0.3\nsweep:\n  - loading.rate: [1e4, 2e4]\n";
    OWNED char *text = replace(membrane_campaign, "  divisions: 4\n", mesh),
               *reseeded = replace(text, "seed: 7", "seed: 8");
    OWN(fracas_campaign) campaign = read_text(text), *again = read_text(text),
                         *other = read_text(reseeded), *regular = read_membrane("", "");
    OWN(fracas_model) first = model_of(campaign, 0), *same = model_of(again, 0),
                      *second = model_of(campaign, 1), *seeded = model_of(other, 0),
                      *plain = model_of(regular, 0);
    assert_int_equal(count_moved(first, plain), 7 * 3);
    assert_int_equal(count_moved(first, same), 0);
    assert_int_equal(count_moved(first, second), 7 * 3);
    assert_int_equal(count_moved(first, seeded), 7 * 3);
    size_t count;
    OK(fracas_mesh_noise_count(&campaign->point[0].spec, &count));
    assert_int_equal(count, 2 * 9 * 5);
    OK(fracas_mesh_noise_count(&regular->point[0].spec, &count));
    assert_int_equal(count, 0);
}

/* ---- plans ---- */

/* A correlation length that was meant in mm, or is far below an element. */
static void test_plan_of_fields(void **state)
{
    static const char strength[] = "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}";
    static const struct {
        const char *length, *words; /* no words: no warning */
    } table[] = {
        {"2", "strength.correlation_length is 2 m, more than the 0.0"},
        {"1e-6",
         "strength.correlation_length is 1e-06 m, less than a third of an element of 0.001"},
        {"2e-3", NULL},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char section[200];
        snprintf(section, sizeof section,
                 "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2, covariance: matern, "
                 "correlation_length: %s}",
                 table[i].length);
        OWN(fracas_campaign) campaign = read_membrane(strength, section);
        OWNED char *text = plan_text(campaign, 1, false);
        if (table[i].words) assert_has(text, table[i].words);
        else assert_null(strstr(text, "correlation_length"));
        assert_null(strstr(text, "size effect"));
    }
    OWN(fracas_campaign) campaign = read_membrane(
        strength, "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2, covariance: matern, "
                  "correlation_length: 2e-3, reference_volume: 1e-3 mm3}");
    OWNED char *text = plan_text(campaign, 1, false);
    assert_has(text,
               "strengths are correlated, and their size effect is that of independent flaws");
}

/* A shell three times as thick as its edges are long: bending waves make the step 7 times as short,
 * and the plan says so within a quarter. */
static void test_plan_of_thick_shells(void **state)
{
    static const char text[] =
        "name: t\nseed: 7\nmodel: shell\ngeometry: {shape: sphere, part: octant, radius: 1 mm, "
        "thickness: 0.2 mm}\nmesh: {divisions: 24}\nmaterial: {young: 370e9, poisson: 0.25, "
        "density: 3900}\ncohesive: {fracture_energy: 100}\nstrength: {minimum: 264e6, scale: "
        "50e6, shape: 2}\nloading: {rate: 1e5}\ntime: {end: 1e-7%s}\nreplicas: 1\n";
    double step[2], said = 0;
    for (int rotary = 0; rotary < 2; rotary++) {
        char whole[700];
        snprintf(whole, sizeof whole, text, rotary ? ", rotary_inertia: 1" : "");
        OWN(fracas_campaign) campaign = read_text(whole);
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        step[rotary] = forecast.time_step;
        OWNED char *plan = plan_text(campaign, 1, false), *json = plan_text(campaign, 1, true);
        const char *found = strstr(plan, "time.rotary_inertia: 1 makes it about ");
        assert_int_equal(found != NULL, !rotary);
        if (found) assert_int_equal(sscanf(found, "%*s 1 makes it about %lf times", &said), 1);
        assert_has(json, "\"memory\": ");
    }
    print_message("%.1f times as long, said %.1f\n", step[1] / step[0], said);
    assert_true(step[1] / step[0] > 4 && fabs(said / (step[1] / step[0]) - 1) < 0.25);
}

/* A column, and a line of the plan, where some point has such a law: else the table stays as it is.
 */
static void test_open_ledger(void **state)
{
    static const char text[] =
        "name: t\nseed: 7\nmodel: shell\ngeometry: {shape: plate, width: 1 mm, height: 1 mm, "
        "thickness: 0.1 mm}\nmesh: {divisions: 4}\nmaterial: {young: 370e9, poisson: 0.25, "
        "density: 3900}\ncohesive: {fracture_energy: 100}\nstrength: {minimum: 264e6, scale: "
        "50e6, shape: 2}\nloading: {rate: 1e5}\ntime: {end: 1e-7}\nreplicas: 1\nsweep:\n  - "
        "cohesive.law: [nitsche%s]\n";
    for (int open = 0; open < 2; open++) {
        char whole[700];
        snprintf(whole, sizeof whole, text, open ? ", becker-noels" : "");
        OWN(fracas_campaign) campaign = read_text(whole);
        OWNED char *plan = plan_text(campaign, 1, false);
        assert_int_equal(strstr(plan, "warning: point 1: law becker-noels gains") != NULL, open);
        assert_int_equal(
            fracas_point_table_find(&campaign->table, "derived.open_ledger") != SIZE_MAX, open);
        if (!open) continue;
        assert_true(isnan(at(campaign, 0, "derived.open_ledger")->real));
        assert_true(at(campaign, 1, "derived.open_ledger")->real == 1);
    }
}

/* A regular plate of strength 300 MPa cracks along lines; with E rate t/(1 - nu) = 493 MPa it does
 * crack. E G_c/sigma_c^2 is 206 um, the mean edge of squares of 1.25 mm cut in two (24 + 28 sides
 * and 32 diagonals of 84) 1.25 mm (52 + 32 sqrt 2)/84 = 1.447 mm: 7.04 of it, 14.1 times too much.
 */
static void test_plan(void **state)
{
    static const char lines[] = "warning: point 0: interfaces are equally strong and the mesh is "
                                "regular, so that cracks follow its lines";
    static const char strength[] = "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}";
    OWN(fracas_campaign) campaign = read_membrane(
        strength, "strength: {distribution: constant, value: 300 MPa}");
    fracas_forecast forecast;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    assert_int_equal(forecast.elements, 64);
    assert_int_equal(forecast.interfaces, 84);
    assert_true(
        fabs(forecast.coarseness / (1.25e-3 * (52 + 32 * sqrt(2)) / 84 / (370e9 * 150 / 9e16)) -
             1) < 1e-12);
    assert_true(fabs(forecast.bound / (370e9 * 1e4 * 1e-7 / 0.75) - 1) < 1e-12);
    assert_true(fabs(forecast.step_stress / (370e9 * 1e4 * forecast.time_step) - 1) < 1e-12);
    OWNED char *text = plan_text(campaign, 1, false), *json = plan_text(campaign, 1, true);
    assert_has(text, lines);
    assert_has(text, "a crack's softening is not resolved: raise mesh.divisions to 19");
    assert_null(strstr(text, "until time.end the stress stays"));
    assert_has(json, "\"elements\": 64");
    OWNED char *constant = replace(membrane_campaign, strength,
                                   "strength: {distribution: constant, value: 300 MPa}");
    OWNED char *moved = replace(constant, "  divisions: 4\n", "  size: 1 mm\n  amplitude: 0.2\n");
    OWN(fracas_campaign) irregular = read_text(moved);
    OWNED char *of_irregular = plan_text(irregular, 1, false);
    assert_null(strstr(of_irregular, "follow its lines"));
    assert_has(of_irregular, "lower mesh.size to ");
    OWN(fracas_campaign) slow = read_membrane("rate: 1e4 1/s", "rate: 1e3 1/s"); /* 49 MPa */
    OWNED char *of_slow = plan_text(slow, 1, false);
    assert_null(strstr(of_slow, "follow its lines")); /* of scattered strength */
    assert_has(of_slow, "until time.end the stress stays below 49.3 MPa");
}

/* Rows of interfaces take what they take, 6 x 84 more numbers than there are none. */
static void test_bytes(void **state)
{
    OWN(fracas_campaign) without = read_membrane("", ""),
                         *with = read_membrane("", "output: {interfaces: true}\n");
    fracas_forecast a, b;
    OK(fracas_forecast_all(without, 1, false, &a));
    OK(fracas_forecast_all(with, 1, false, &b));
    assert_true(b.bytes - a.bytes == 2.0 * 84 * sizeof(fracas_interface_row));
    assert_true(a.speed > 0 && a.time == 64.0 * (double)a.steps * 2 / a.speed);
}

/* No stress exceeds the bound, and even stretching reaches it: plates of strength 1.05 bound stay
 * whole until 0.5, 1 and 1.5 times the time in which a wave passes half of them (0.5 us), and until
 * the first crack with 0.9 bound. (Before a wave has passed three elements, the mesh lets it
 * overshoot by 10 %.) Shear counts by coupling 0.5 where it is largest, on the diagonals of ratio
 * -1: as much as the stress along the sides, E/(1 + nu), of a bound of E/0.5. */
static void test_bound(void **state)
{
    static const struct {
        const char *loading, *coupling;
        double stress; /* by E rate t */
    } table[] = {
        {"rate: 1e4", "1", 1 / 0.75},
        {"rate: 1e4, ratio: 0.5", "1", 1.125 / 0.9375},
        {"rate: 1e4, ratio: 0", "1", 1 / 0.9375},
        {"rate: 1e4, ratio: 3", "1", 3.25 / 0.9375},
        {"rate: 1e4, ratio: -1", "1", 1},
        {"rate: -1e4, ratio: -1", "0.5", 2},
    };
    static const double times[] = {2.5e-7, 5e-7, 8e-7};
    for (size_t i = 0; i < FRACAS_COUNT(table); i++)
        for (int t = 0; t < 3; t++) {
            char text[200], law[100];
            snprintf(text, sizeof text, "loading: {%s}\ntime: {end: %.2g, safety: 0.5}\n",
                     table[i].loading, times[t]);
            snprintf(law, sizeof law, "  fracture_energy: 1e9\n  coupling: %s\n",
                     table[i].coupling);
            OWNED char *loaded = replace(membrane_campaign,
                                         "loading: {rate: 1e4 1/s}\ntime: {end: 0.1 us}\n", text);
            OWNED char *lawful = replace(loaded, "  fracture_energy: 150 J/m2\n", law),
                       *square = replace(lawful, "height: 5 mm", "height: 10 mm");
            OWNED char *fine = replace(square, "divisions: 4", "divisions: 12\n  amplitude: 0.2");
            OWN(fracas_campaign) campaign = read_text(fine);
            fracas_forecast forecast;
            OK(fracas_forecast_make(campaign, 0, &forecast));
            assert_true(fabs(forecast.bound / (370e9 * 1e4 * times[t] * table[i].stress) - 1) <
                        1e-12);
            OWN(fracas_model) model = model_of(campaign, 0);
            if (cracks(model, 1.05 * forecast.bound))
                fail_msg("%s until %g: above", table[i].loading, times[t]);
            if (t == 0 && i < 4 && !cracks(model, 0.9 * forecast.bound))
                fail_msg("%s: below", table[i].loading);
        }
}

/* A step adds E rate dt; of strengths uniform over w, 98 of 100 are within 0.98 w. The plan warns
 * where the one is over a quarter of the other, for laws that soften from the stress which a step
 * has reached. */
static void test_steps_that_pass_strengths(void **state)
{
    static const struct {
        double widths; /* w by what a step adds */
        bool warned;
        const char *law;
    } table[] = {{3.9, true, "camacho-ortiz-standard"},
                 {4.3, false, "camacho-ortiz-standard"},
                 {3.9, false, "nitsche"}};
    fracas_campaign *campaign = read_membrane("", "");
    fracas_forecast forecast;
    OK(fracas_forecast_make(campaign, 0, &forecast));
    fracas_campaign_destroy(campaign);
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        char law[100], strength[200];
        snprintf(law, sizeof law, "cohesive:\n  law: %s\n", table[i].law);
        snprintf(strength, sizeof strength,
                 "strength: {distribution: uniform, minimum: 300 MPa, maximum: %.17g}",
                 300e6 + table[i].widths * forecast.step_stress);
        OWNED char *lawful = replace(membrane_campaign, "cohesive:\n", law);
        OWNED char *strong = replace(
            lawful, "strength: {minimum: 264 MPa, scale: 50 MPa, shape: 2}", strength);
        campaign = read_text(strong);
        OWNED char *text = plan_text(campaign, 1, false);
        assert_true((strstr(text, "interfaces that a step passes together") != NULL) ==
                    table[i].warned);
        fracas_campaign_destroy(campaign);
    }
}

/* Where stress concentrates, at holes, held corners and shocks, it is at least 4 times as large
 * (INFINITY here); a centrifugal load stretches by w^2 t^2/2. */
static void test_bounds_of_others(void **state)
{
    static const struct {
        const char *find, *put;
        double bound;
    } table[] = {
        {"thickness: 0.1 mm",
         "thickness: 0.1 mm, left: held, right: held, top: held, bottom: sliding",
         370e9 * 1e-3 / 0.75},
        {"thickness: 0.1 mm", "thickness: 0.1 mm, left: sliding", 370e9 * 1e-3 / 0.75},
        {"thickness: 0.1 mm", "thickness: 0.1 mm, left: held", INFINITY},
        {"thickness: 0.1 mm", "thickness: 0.1 mm, left: fixed", INFINITY},
        {"width: 10 mm, height: 5 mm", "shape: annulus, inner: 1 mm, outer: 2 mm", INFINITY},
        {"rate: 1e4 1/s", "type: centrifugal, speed: 1e5 rad/s", 370e9 * 0.5e10 * 1e-14 / 0.75},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        OWN(fracas_campaign) campaign = read_membrane(table[i].find, table[i].put);
        fracas_forecast forecast;
        OK(fracas_forecast_make(campaign, 0, &forecast));
        const bool more = isinf(table[i].bound) && isfinite(forecast.bound) &&
                          forecast.bound > 3.999 * 370e9 * 1e-3 / 0.75;
        if (!(more || fabs(forecast.bound / table[i].bound - 1) < 1e-12))
            fail_msg("%s: %g", table[i].put, forecast.bound);
    }
    static const char *const still[] = {"thickness: 0.1 mm", "thickness: 0.1 mm, left: fixed"};
    for (size_t i = 0; i < FRACAS_COUNT(still); i++) {
        OWNED char *edges = replace(membrane_campaign, still[0], still[i]);
        OWNED char *text = replace(edges, "rate: 1e4 1/s", "rate: 1e4 1/s, start: rest");
        OWN(fracas_campaign) campaign = read_text(text);
        fracas_forecast forecast;
        FAILS(fracas_forecast_make(campaign, 0, &forecast), FRACAS_USAGE,
              "nothing would ever move");
    }
}

TESTS_ALL(read_file, free_file, test_plate, test_annulus, test_mean_strength, test_swept_model,
          test_inherited, test_perturbed, test_plan, test_plan_of_thick_shells, test_open_ledger,
          test_plan_of_fields, test_bytes, test_bound, test_steps_that_pass_strengths,
          test_bounds_of_others)
