/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Rings: arcs, the motion of fragments, where they are drawn, series by radius, and the report of a
 * study of rings. */
#include "tests/support/campaign_text.h"
#include "tests/support/report.h"

#include "analysis/report/figures.h"
#include "analysis/draw/picture.h"
#include "analysis/data/ring.h"
#include "base/param.h"
#include "base/version.h"

/* ---- arcs ---- */

/* Midpoint rule over the arc, error of the order 1/PARTS^2 = 1e-10 of the value. */
static void arcs(void **state)
{
    enum { PARTS = 100000 };
    const double half[] = {0.3, 1, M_PI / 2, 2.5, M_PI};
    for (size_t i = 0; i < sizeof half / sizeof *half; i++) {
        double x = 0, inertia = 0;
        for (int k = 0; k < PARTS; k++) x += cos(half[i] * (2 * (k + 0.5) / PARTS - 1)) / PARTS;
        for (int k = 0; k < PARTS; k++) {
            double angle = half[i] * (2 * (k + 0.5) / PARTS - 1), dx = cos(angle) - x,
                   dy = sin(angle);
            inertia += (dx * dx + dy * dy) / PARTS;
        }
        assert_true(fabs(fracas_arc_centre(half[i]) - x) < 1e-9);
        assert_true(fabs(fracas_arc_inertia(half[i]) - inertia) < 1e-9);
    }
    assert_true(fracas_arc_centre(0) == 1 && fracas_arc_inertia(0) == 0);
    /* A straight rod of length 2a has a^2/3; at both sides of the switch to the series the two
     * agree: 1 - c^2 rounds to 2e-16/3e-5. */
    assert_true(fabs(fracas_arc_inertia(1e-6) / (1e-12 / 3) - 1) < 1e-12);
    double below = nextafter(1e-2, 0), centre = sin(below) / below;
    assert_true(fabs(fracas_arc_inertia(below) / (1 - centre * centre) - 1) < 1e-10);
}

/* ---- motion ---- */

/* Fragments of a ring of radius R in which everything moves by `push` and at `speed` along its own
 * radius: their centres of mass do so by sin(a)/a of that. size: share of the circumference. */
static void expanded_ring(double radius, double push, double speed, const double *share, size_t n,
                          fracas_fragment *fragment)
{
    double begin = 0.4;
    for (size_t i = 0; i < n; i++) {
        double half = M_PI * share[i], angle = begin + half, out = sin(half) / half;
        fragment[i] = (fracas_fragment){
            .mass = share[i],
            .size = 2 * M_PI * radius * share[i],
            .elements = 2,
            .position = {(radius + push) * out * cos(angle), (radius + push) * out * sin(angle), 0},
            .velocity = {speed * out * cos(angle), speed * out * sin(angle), 0}};
        begin += 2 * half;
    }
}

/* Quarters and an eighth moving as one, then one of them with a kick along the ring and a spin. */
static void motion_of_fragments(void **state)
{
    enum { N = 4 };
    const double share[N] = {0.25, 0.25, 0.25, 0.25}, radius = 8e-3;
    fracas_fragment fragment[N];
    expanded_ring(radius, 1e-4, 80, share, N, fragment);
    fracas_record record = {.nfragment = N, .fragment = fragment};
    double out = sin(M_PI / 4) / (M_PI / 4);
    fracas_ring_motion motion = fracas_ring_motion_of(&record, radius);
    assert_true(fabs(motion.radial - 80 * out) < 1e-12);
    assert_true(motion.scatter < 1e-12 && motion.circumferential < 1e-12 && motion.spin == 0);
    double angle = atan2(fragment[2].position[1], fragment[2].position[0]);
    fragment[2].velocity[0] += 3 * cos(angle) -
                               8 * sin(angle); /* 3 m/s outward and 8 m/s along the ring */
    fragment[2].velocity[1] += 3 * sin(angle) + 8 * cos(angle);
    fragment[2].angular_momentum[2] = -0.25 * radius * radius * (1 - out * out) *
                                      5e3; /* at 5000 rad/s */
    motion = fracas_ring_motion_of(&record, radius);
    assert_true(fabs(motion.radial - 80 * out - 0.75) < 1e-12);
    assert_true(fabs(motion.scatter - sqrt((3 * 0.75 * 0.75 + 2.25 * 2.25) / 4)) < 1e-12);
    assert_true(fabs(motion.circumferential - 4) < 1e-12);
    assert_true(fabs(motion.spin - 1250) < 1e-9);
    fragment[3].mass = 0.75; /* masses 1, 1, 1, 3 */
    motion = fracas_ring_motion_of(&record, radius);
    assert_true(fabs(motion.radial - 80 * out - 0.5) < 1e-12);
    record.nfragment = 1;
    assert_true(isnan(fracas_ring_motion_of(&record, radius).radial));
}

/* Under a uniform expansion every displacement is push sin(a)/a and nothing moves beside it. */
static void pattern_of_uniform_expansion(void **state)
{
    enum { N = 5 };
    const double share[N] = {0.4, 0.05, 0.3, 0.05, 0.2}, radius = 16e-3, push = 5e-5;
    fracas_fragment fragment[N];
    expanded_ring(radius, push, 120, share, N, fragment);
    fragment[3].dust = 1;
    fracas_record record = {.nfragment = N, .fragment = fragment, .end_time = 2e-6};
    FRACAS_CLEARED(fracas_ring_pattern) pattern;
    OK(fracas_ring_pattern_create(&record, radius, &pattern));
    assert_int_equal(pattern.n, N);
    assert_true(pattern.time == 2e-6 && fabs(pattern.expansion - 120) < 1e-11);
    for (size_t i = 0; i < N; i++) {
        const fracas_ring_piece *piece = &pattern.piece[i];
        double half = M_PI * share[piece->fragment], out = sin(half) / half;
        assert_true(fabs(piece->half_angle - half) < 1e-14);
        assert_true(fabs(piece->displacement - push * out) <
                    1e-16); /* radius times 1e-16, and some */
        assert_true(fabs(piece->velocity[0] - 120 * out) < 1e-11 &&
                    fabs(piece->velocity[1]) < 1e-11);
        assert_true(fabs(piece->relative[0]) < 1e-11 && fabs(piece->relative[1]) < 1e-11);
        assert_true(i == 0 || piece->angle > pattern.piece[i - 1].angle);
        assert_int_equal(piece->dust, piece->fragment == 3);
    }
    /* Mean displacement push sum(share sin(a)/a) = 0.84 push, 4.2e-5 of 6.4e-3: 152 times, so 100.
     */
    assert_true(fracas_picture_exaggeration(&pattern) == 100);
    for (size_t i = 0; i < N; i++) pattern.piece[i].displacement = 0.08 * radius; /* 5 exactly */
    assert_true(fracas_picture_exaggeration(&pattern) == 5);
    pattern.piece[0].displacement = 0.3 * radius; /* 0.8/0.3 = 2.7: 2; the mean would allow more */
    pattern.piece[0].size = 0;
    assert_true(fracas_picture_exaggeration(&pattern) == 2);
    for (size_t i = 0; i < N; i++) pattern.piece[i].displacement = 1e-16 * radius;
    assert_true(fracas_picture_exaggeration(&pattern) == 1);
    for (size_t i = 0; i < N; i++) pattern.piece[i].displacement = -0.01 * radius;
    assert_true(fracas_picture_exaggeration(&pattern) == 1);
}

/* ---- a study of rings ---- */

enum { NCOLUMNS = 15, NPOINTS = 9, REPLICAS = 6, ELEMENTS = 2400 };

static const fracas_column column[NCOLUMNS] = {
    {"cohesive.fracture_energy", "J/m2", "fracture energy", false},
    {"derived.fracture_energy", "J/m2", "fracture energy", false},
    {"derived.lattice", "m", "lattice", false},
    {"derived.length", "m", "circumference", false},
    {"derived.radius", "m", "radius", false},
    {"derived.strain_rate", "1/s", "strain rate", false},
    {"derived.strength_mean", "Pa", "mean strength", false},
    {"geometry.area", "m2", "area", false},
    {"geometry.radius", "m", "radius", false},
    {"loading.radial", "m/s", "velocity", false},
    {"loading.type", "", "loading", true},
    {"material.density", "kg/m3", "density", false},
    {"material.young", "Pa", "modulus", false},
    {"mesh.elements", "1", "elements", false},
    {"model", "", "model", true},
};

typedef struct {
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row row[NPOINTS];
    fracas_point_table table;
} made_table;

static double radius_of(size_t p)
{
    return p % 2 ? 16e-3 : 8e-3;
}
static double speed_of(size_t p)
{
    return (p % 2 ? 50 : 25) * pow(2.2, (double)(p / 2));
}
static int64_t fragments_of(size_t p)
{
    return (int64_t)((p % 2 ? 16 : 8) * pow(2.2, (double)(p / 2)));
}

static void make_table(made_table *made)
{
    for (size_t p = 0; p < NPOINTS; p++) {
        const double radius = radius_of(p), speed = speed_of(p);
        const double round = 2 * M_PI * radius;
        const double real[NCOLUMNS] = {100,   100,      round / ELEMENTS,
                                       round, radius,   speed / radius,
                                       3e8,   1e-6,     radius,
                                       speed, NAN,      2750,
                                       275e9, ELEMENTS, NAN};
        for (size_t c = 0; c < NCOLUMNS; c++)
            made->value[p][c] = (fracas_value){.real = real[c],
                                               .text = column[c].text ? "initial-velocity" : ""};
        made->value[p][NCOLUMNS - 1].text = "ring";
        made->row[p] = (fracas_point_row){
            .hash = fracas_hash_of(&p, sizeof p), .replicas = REPLICAS, .value = made->value[p]};
    }
    made->table = (fracas_point_table){
        .ncolumns = NCOLUMNS, .column = column, .npoints = NPOINTS, .point = made->row};
}

/* Sizes near the mean, one dust in each ring; all thrown outward, with some scatter. */
static void make_fragments(size_t p, uint64_t *state, fracas_record *record)
{
    double radius = radius_of(p), speed = speed_of(p);
    int64_t n = record->fragments, last = 0;
    record->fragment = zeroed((size_t)n, sizeof *record->fragment);
    record->nfragment = (size_t)n;
    for (int64_t k = 0; k < n; k++) {
        int64_t cut = llrint(((double)k + 1 + 0.9 * (random_share(state) - 0.5)) * ELEMENTS /
                             (double)n);
        if (k == 2) cut = last + 1;
        if (k + 1 == n) cut = ELEMENTS;
        fracas_fragment *fragment = &record->fragment[k];
        double turn = 2 * M_PI / ELEMENTS, half = turn * (double)(cut - last) / 2,
               out = sin(half) / half;
        double angle = turn * (double)(cut + last) / 2 + 2e-3 * (random_share(state) - 0.5);
        double scatter = 0.06 * speed * (random_share(state) - 0.5),
               along = 0.06 * speed * (random_share(state) - 0.5);
        double distance = (radius + (speed + scatter) * record->end_time / 2) * out;
        fragment->elements = cut - last;
        fragment->dust = cut - last == 1;
        fragment->size = 2 * half * radius;
        fragment->mass = 2750e-6 * fragment->size;
        fragment->position[0] = distance * cos(angle);
        fragment->position[1] = distance * sin(angle);
        fragment->velocity[0] = (speed * out + scatter) * cos(angle) - along * sin(angle);
        fragment->velocity[1] = (speed * out + scatter) * sin(angle) + along * cos(angle);
        fragment->angular_momentum[2] = fragment->mass * radius * radius * half * half / 3 * 2e4 *
                                        (random_share(state) - 0.5);
        for (int i = 0; i < 3; i++) fragment->spin[i] = 1e4 * (random_share(state) - 0.5);
        record->fragments_dust += fragment->dust;
        last = cut;
    }
}

/* Point 0: INTACT but for its last replica, which is TIME_LIMIT; point 1: its first replica is not
 * FRAGMENTED. Replicas 3 and 4 of point 2 drift. */
static void make_record(const void *context, size_t p, int64_t replica, fracas_record *record)
{
    fracas_record_init(record);
    uint64_t state = 1000 * p + (uint64_t)replica + 77;
    record->outcome = p == 0 ? (replica == REPLICAS - 1 ? FRACAS_TIME_LIMIT : FRACAS_INTACT)
                      : p == 1 && replica == 0 ? FRACAS_TIME_LIMIT
                                               : FRACAS_FRAGMENTED;
    bool intact = record->outcome == FRACAS_INTACT;
    record->fragments = intact ? 1
                               : fragments_of(p) + (replica % 3 - 1) * (1 + fragments_of(p) / 20);
    record->fragments_dust = 0;
    record->broken = record->fragments;
    record->cracked = 2 * record->fragments;
    record->steps = 1000;
    record->onset_time = intact ? NAN : 1e-7;
    record->end_time = 40e-6 * radius_of(p) / speed_of(p);
    record->time_step = record->end_time / 1000;
    record->mass = 2750e-6 * 2 * M_PI * radius_of(p);
    record->dissipated = intact ? 0 : 1.2e-4 * (double)record->fragments;
    record->kinetic = record->mass * speed_of(p) * speed_of(p) / 2;
    record->elastic = record->cohesive = record->friction = record->damped = record->created =
        record->work = record->dissipated_bending = 0;
    double largest = fmax(record->kinetic, record->dissipated);
    record->residual = (p == 2 && (replica == 3 || replica == 4) ? 0.012 : 0.9e-4) * largest;
    record->residual_end = record->residual;
    record->momentum[0] = record->momentum[1] = record->momentum[2] = 0;
    make_fragments(p, &state, record);
    record->nhistory = 2;
    record->history = zeroed(2, sizeof *record->history);
    for (size_t i = 0; i < 2; i++)
        record->history[i] = (fracas_history_row){.time = (double)i * record->end_time,
                                                  .kinetic = record->kinetic,
                                                  .elastic = (double)i * 1e-3 * record->kinetic,
                                                  .residual = (double)i * record->residual};
}

static void report_of_rings(void **state)
{
    static made_table made;
    make_table(&made);
    char folder[512];
    snprintf(folder, sizeof folder, "%s/rings", report_root);
    fracas_file_header header = {.campaign = fracas_hash_of("rings", 5),
                                 .seed = 1,
                                 .version = FRACAS_VERSION,
                                 .complete = true};
    report_write_study(folder, &header, &made.table, make_record, NULL);
    report_analyse(folder);
    OWNED char *table = report_contents(folder, "table.txt"),
               *page = report_contents(folder, "report/index.html");
    assert_has(table, "radius  radial  strain rate");
    assert_has(table, "  [mm]   [m/s]        [1/s]");
    assert_has(table, "     8      25         3125");
    assert_has(table,
               "energy drift above 1 %: 2 of 6 usable realizations, their |residual| up to 1.2 %");
    assert_has(page, "Replica 1, the first that ended FRAGMENTED");
    assert_null(strstr(page, "pattern-point-0.svg"));
    assert_has(page, "radius 8 mm");
    report_check(folder);
}

/* ---- columns ---- */

/* The columns that tell points apart and those of them that make series, as "radius,radial|radius".
 * Each point: radius, radial, elements. */
static void assert_columns(const double real[][3], size_t npoints, const char *expected)
{
    static const fracas_column columns[] = {{"geometry.radius", "m", "", false},
                                            {"loading.radial", "m/s", "", false},
                                            {"mesh.elements", "1", "", false}};
    fracas_value value[6][3];
    fracas_point_row row[6];
    for (size_t p = 0; p < npoints; p++) {
        for (size_t c = 0; c < 3; c++) value[p][c] = (fracas_value){.real = real[p][c], .text = ""};
        row[p] = (fracas_point_row){.value = value[p]};
    }
    fracas_point_table table = {.ncolumns = 3, .column = columns, .npoints = npoints, .point = row};
    FRACAS_CLEARED(fracas_columns) shown, others;
    char text[128] = "";
    OK(fracas_columns_create(&table, &shown));
    OK(fracas_columns_without_rate(&table, &shown, &others));
    for (size_t i = 0; i < shown.count; i++)
        strcat(strcat(text, fracas_columns_name(&table, &shown, i)), ",");
    strcat(text, "|");
    for (size_t i = 0; i < others.count; i++)
        strcat(strcat(text, fracas_columns_name(&table, &others, i)), ",");
    assert_string_equal(text, expected);
}

static void columns_of_rings(void **state)
{
    assert_columns((double[][3]){{8, 80, 100}, {8, 160, 100}, {16, 80, 100}, {16, 160, 100}}, 4,
                   "radius,radial,|radius,");
    /* Velocities that no two radii share: the radius still makes series. */
    assert_columns((double[][3]){{8, 80, 100}, {8, 90, 100}, {16, 100, 200}, {16, 120, 200}}, 4,
                   "radius,radial,|radius,");
    assert_columns((double[][3]){{8, 80, 100}, {8, 160, 200}}, 2,
                   "radial,|"); /* elements zipped to the velocity */
    assert_columns((double[][3]){{8, 80, 100}, {8, 80, 200}, {8, 90, 100}, {8, 90, 200}}, 4,
                   "radial,elements,|elements,");
    assert_columns((double[][3]){{8, 80, 100}}, 1, "radial,|");
}

/* Two radii: two series of marks, named by the radius; sizes over the strain rate v/R. */
static void figure_of_rings(void **state)
{
    static made_table made;
    static fracas_point_statistics point[NPOINTS];
    make_table(&made);
    for (size_t p = 0; p < NPOINTS; p++) {
        fracas_point_statistics_init(&made.table, p, &point[p]);
        assert_true(fabs(point[p].length - 2 * M_PI * radius_of(p)) < 1e-15);
        point[p].size = (fracas_estimate){
            .n = 4, .mean = 1e-3, .deviation = 1e-4, .half_width = 1e-4};
    }
    fracas_analysis analysis = {.table = &made.table, .point = point};
    OK(fracas_columns_create(&made.table, &analysis.shown));
    FRACAS_CLEARED(fracas_charts) charts = {0};
    OK(fracas_means_axes_create(&analysis, NULL, NULL, NULL, &analysis.axes));
    OK(fracas_figure_means(&analysis, FRACAS_MEANS_SIZE, &charts));
    assert_int_equal(charts.count, 1);
    fracas_chart chart = charts.chart[0];
    assert_string_equal(chart.panel[0].x.label, "strain rate [1/s]");
    const char *const expected[] = {"radius 8 mm", "radius 16 mm"};
    size_t marks = 0;
    for (size_t s = 0; s < chart.panel[0].nseries; s++) {
        const fracas_series *series = &chart.panel[0].series[s];
        if (series->kind != FRACAS_MARKS) continue;
        assert_true(marks < 2);
        assert_string_equal(series->name, expected[marks]);
        assert_int_equal(series->n, marks ? 4 : 5);
        for (size_t i = 0; i < series->n; i++)
            assert_true(series->x[i] == speed_of(2 * i + marks) / radius_of(2 * i + marks));
        marks++;
    }
    assert_int_equal(marks, 2);
    fracas_charts_clear(&charts);
    for (size_t p = 0; p < NPOINTS; p++)
        point[p].rate = p % 4 == 1 ? 1e4 * (double)p : 0; /* a ring that only spins has none */
    marks = 0;
    OK(fracas_analysis_axes(&analysis, NULL, NULL, NULL));
    OK(fracas_figure_means(&analysis, FRACAS_MEANS_SIZE, &charts));
    chart = charts.chart[0];
    for (size_t s = 0; s < chart.panel[0].nseries; s++)
        for (size_t i = 0; i < chart.panel[0].series[s].n; i++) {
            assert_true(chart.panel[0].series[s].x[i] > 0);
            marks += chart.panel[0].series[s].kind == FRACAS_MARKS;
        }
    assert_int_equal(marks, 2);
    fracas_means_axes_clear(&analysis.axes);
    fracas_columns_clear(&analysis.shown);
}

/* A law is drawn for a series of one material, and for none that mixes them, as a design does. */
static void laws_of_mixed_series(void **state)
{
    static made_table made;
    static fracas_point_statistics point[NPOINTS];
    static const struct {
        double even, odd; /* by how much s0 grows from point to point, in each of the two series */
        double even_modulus, odd_modulus;
        size_t curves;
        const char *caption;
    } table[] = {
        {0, 0, NAN, NAN, FRACAS_SCALING_LAWS - 1, " Lines: scaling laws of"}, /* all but Mott's */
        {0, 0, 10, 10, FRACAS_SCALING_LAWS, " Lines: scaling laws of"},
        {0, 0, 10, 20, FRACAS_SCALING_LAWS - 1, " Lines: scaling laws of"},
        {0, 1e-5, 10, 10, 1, " Lines: ZMR law with the material"},
        {1e-5, 1e-5, NAN, NAN, 0, " Lines: ZMR law with the material"},
    };
    make_table(&made);
    fracas_analysis analysis = {.table = &made.table, .point = point};
    OK(fracas_columns_create(&made.table, &analysis.shown));
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        for (size_t p = 0; p < NPOINTS; p++) {
            fracas_point_statistics_init(&made.table, p, &point[p]);
            point[p].size = (fracas_estimate){
                .n = 4, .mean = 1e-3, .deviation = 1e-4, .half_width = 1e-4};
            point[p].scales.rate = 1e5;
            point[p].scales.modulus = p % 2 ? table[i].odd_modulus : table[i].even_modulus;
            point[p].scales.size = 1e-4 + (p % 2 ? table[i].odd : table[i].even) * (double)p;
        }
        FRACAS_CLEARED(fracas_charts) charts = {0};
        OK(fracas_analysis_axes(&analysis, NULL, NULL, NULL));
        OK(fracas_figure_means(&analysis, FRACAS_MEANS_SIZE, &charts));
        const fracas_chart chart = charts.chart[0];
        size_t curves = 0;
        for (size_t s = 0; s < chart.panel[0].nseries; s++)
            curves += chart.panel[0].series[s].kind == FRACAS_CURVE;
        assert_int_equal(curves, table[i].curves);
        assert_has(chart.caption, table[i].caption);
    }
    fracas_means_axes_clear(&analysis.axes);
    fracas_columns_clear(&analysis.shown);
}

static void assert_pictures(size_t npoints, size_t without, const size_t *expected, size_t count)
{
    fracas_point_statistics point[12];
    for (size_t p = 0; p < npoints; p++)
        point[p] = (fracas_point_statistics){.radius = 8e-3,
                                             .broken_replica = p == without ? -1 : 3};
    fracas_point_table table = {.npoints = npoints};
    fracas_analysis analysis = {.table = &table, .point = point};
    size_t chosen[FRACAS_MAX_PICTURES];
    assert_int_equal(fracas_picture_points(&analysis, chosen), count);
    for (size_t i = 0; i < count; i++) assert_int_equal(chosen[i], expected[i]);
    for (size_t p = 0; p < npoints; p++) point[p].radius = NAN; /* bars */
    assert_int_equal(fracas_picture_points(&analysis, chosen), 0);
}

static void points_with_pictures(void **state)
{
    assert_pictures(1, 9, (size_t[]){0}, 1);
    assert_pictures(4, 2, (size_t[]){0, 1, 3}, 3);
    assert_pictures(6, 9, (size_t[]){0, 1, 2, 3, 4, 5}, 6);
    assert_pictures(8, 9, (size_t[]){0, 1, 3, 4, 6, 7}, 6); /* 0, 1.4, 2.8, 4.2, 5.6, 7 */
    assert_pictures(11, 99, (size_t[]){0, 2, 4, 6, 8, 10}, 6);
    assert_pictures(12, 0, (size_t[]){1, 3, 5, 7, 9, 11}, 6);
}

/* A critical opening stands for the fracture energy that it makes with the mean strength: delta_c
 * sigma_c/2. */
static void scales_of_critical_opening(void **state)
{
    static const char text[] =
        "name: r\nseed: 1\nmodel: ring\ngeometry: {radius: 8 mm}\nmesh: {elements: 100}\nmaterial: "
        "{young: 275 GPa, density: 2750 kg/m3}\n"
        "cohesive: {law: stershic}\nstrength: {distribution: uniform, minimum: 290 MPa, maximum: "
        "310 MPa}\n"
        "loading: {type: initial-velocity, radial: 80 m/s}\ntime: {end: 100 ns}\nreplicas: 1\n"
        "sweep:\n  - cohesive: [{critical_opening: 0.6 um}, {fracture_energy: 90 J/m2}]\n";
    OWN(fracas_campaign) campaign = read_text(text);
    fracas_point_statistics opening, energy;
    fracas_point_statistics_init(&campaign->table, 0, &opening);
    fracas_point_statistics_init(&campaign->table, 1, &energy);
    assert_true(fabs(opening.scales.size / energy.scales.size - 1) < 1e-14); /* a few roundings */
    for (int law = 0; law < FRACAS_SCALING_LAWS; law++)
        if (law != FRACAS_LAW_MOTT)
            assert_true(fabs(opening.law[law] / energy.law[law] - 1) < 1e-13);
    assert_true(isnan(opening.law[FRACAS_LAW_MOTT]) &&
                opening.without_mott); /* of uniform strengths */
    assert_true(fabs(energy.scales.size / (275e9 * 90 / 9e16) - 1) < 1e-13);
}

TESTS_ALL(report_make_root, report_remove_root, scales_of_critical_opening, arcs,
          motion_of_fragments, pattern_of_uniform_expansion, report_of_rings, columns_of_rings,
          figure_of_rings, laws_of_mixed_series, points_with_pictures)
