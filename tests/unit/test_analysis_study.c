/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study of known truth, written through the store, analysed, and checked by a script that shares
 * no code with us. */
#include "tests/support/report.h"

#include "base/version.h"

enum { NCOLUMNS = 13, NPOINTS = 4, HISTORY = 50 };

/* What a synthetic study is made of. */
typedef struct {
    const char *name;
    int64_t replicas[NPOINTS];
    int64_t fragments[NPOINTS], elements[NPOINTS];
    int64_t spread; /* replicas alternate between fragments - spread and fragments + spread */
    bool endings;   /* points 1 to 3 end in other outcomes too */
    bool materials; /* points 2 and 3 are of another material, at the rates of points 0 and 1 */
} truth;

static const truth sweep = {
    .name = "sweep",
    .replicas = {32, 32, 32, 8},
    .fragments = {58, 112, 378, 1600},
    .elements = {1250, 2500, 8000, 32000},
    .spread = 3,
};
static const truth awkward = {
    .name = "awkward <&\"",
    .replicas = {1, 4, 3, 2},
    .fragments = {60, 300, 110, 350},
    .elements = {1250, 2400, 2500, 8000},
    .spread = 2,
    .endings = true,
    .materials = true,
};

static const fracas_column column[NCOLUMNS] = {
    {"cohesive.fracture_energy", "J/m2", "fracture energy", false},
    {"cohesive.law", "", "law", true},
    {"derived.fracture_energy", "J/m2", "fracture energy", false},
    {"derived.lattice", "m", "lattice", false},
    {"derived.length", "m", "length", false},
    {"derived.strain_rate", "1/s", "strain rate", false},
    {"derived.strength_mean", "Pa", "mean strength", false},
    {"geometry.length", "m", "length", false},
    {"loading.rate", "1/s", "strain rate", false},
    {"material.density", "kg/m3", "density", false},
    {"material.young", "Pa", "modulus", false},
    {"mesh.elements", "1", "elements", false},
    {"time.end", "s", "end", false},
};

typedef struct {
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row point[NPOINTS];
    fracas_point_table table;
} made_table;

static void make_table(const truth *of, made_table *made)
{
    for (size_t p = 0; p < NPOINTS; p++) {
        bool other = of->materials && p >= 2;
        double rate = of->materials ? (p % 2 ? 1e5 : 1e4) : 1e3 * pow(10, (double)p);
        const double elements = (double)of->elements[p], lattice = 50e-3 / elements,
                     young = other ? 70e9 : 275e9, end = 5e-3 / rate;
        const double real[NCOLUMNS] = {100,   NAN,  100,  lattice, 50e-3,    rate, 300e6,
                                       50e-3, rate, 2750, young,   elements, end};
        for (size_t c = 0; c < NCOLUMNS; c++)
            made->value[p][c] = (fracas_value){.real = real[c],
                                               .text = column[c].text ? "nitsche" : ""};
        made->point[p] = (fracas_point_row){.hash = fracas_hash_of(&p, sizeof p),
                                            .replicas = of->replicas[p],
                                            .value = made->value[p]};
    }
    made->table = (fracas_point_table){
        .ncolumns = NCOLUMNS, .column = column, .npoints = NPOINTS, .point = made->point};
}

static int64_t outcome_of(const truth *of, size_t p, int64_t replica)
{
    if (!of->endings) return FRACAS_FRAGMENTED;
    if (p == 1) return replica == 3 ? FRACAS_FAILED : FRACAS_TIME_LIMIT;
    if (p == 2) return replica == 2 ? FRACAS_INTACT : FRACAS_FRAGMENTED;
    if (p == 3) return replica == 0 ? FRACAS_NONFINITE : FRACAS_ENERGY_DRIFT;
    return FRACAS_FRAGMENTED;
}

/* Fragments between cuts near every (elements/fragments)-th interface: their sizes add up to the
 * length. */
static void make_fragments(const truth *of, size_t p, uint64_t *state, fracas_record *record)
{
    int64_t n = record->fragments, elements = of->elements[p], last = 0;
    record->fragment = zeroed((size_t)n, sizeof *record->fragment);
    record->nfragment = (size_t)n;
    for (int64_t k = 0; k < n; k++) {
        double place = ((double)k + 1 + 0.9 * (random_share(state) - 0.5)) * (double)elements /
                       (double)n;
        int64_t cut = k + 1 == n ? elements : llrint(place);
        fracas_fragment *fragment = &record->fragment[k];
        fragment->elements = cut - last;
        fragment->size = 50e-3 * (double)fragment->elements / (double)elements;
        fragment->mass = 2750 * 1e-6 * fragment->size;
        fragment->dust = fragment->elements == 1;
        fragment->position[0] = 50e-3 * (double)(cut + last) / 2 / (double)elements;
        fragment->velocity[0] = 1e4 * fragment->position[0];
        record->fragments_dust += fragment->dust;
        last = cut;
    }
}

static void make_history(double end, fracas_record *record)
{
    record->history = zeroed(HISTORY, sizeof *record->history);
    record->nhistory = HISTORY;
    for (size_t i = 0; i < HISTORY; i++) {
        double part = (double)i / (HISTORY - 1), after = fmax(0, part - 0.4) / 0.6;
        fracas_history_row *row = &record->history[i];
        row->time = part * end;
        row->dissipated = record->dissipated * (1 - exp(-5 * after));
        row->elastic = 2 * record->dissipated * (part < 0.4 ? part * part / 0.16 : exp(-8 * after));
        row->kinetic = 0.6 * record->dissipated * (1 - exp(-4 * after)) *
                       (1 + 0.2 * sin(30 * after));
        row->cohesive = 0.3 * record->dissipated * after * exp(-9 * after);
        row->work = row->dissipated + row->elastic + row->kinetic + row->cohesive;
        row->residual = record->residual * after * sin(40 * part);
        row->fragments = record->fragments;
    }
}

static void make_record(const truth *of, size_t p, int64_t replica, fracas_record *record)
{
    fracas_record_init(record);
    record->outcome = outcome_of(of, p, replica);
    if (record->outcome == FRACAS_FAILED) return;
    uint64_t state = 1000 * p + (uint64_t)replica;
    bool intact = record->outcome == FRACAS_INTACT;
    record->fragments = intact ? 1 : of->fragments[p] + (replica % 2 ? of->spread : -of->spread);
    record->fragments_dust = 0;
    record->broken = intact ? 0 : record->fragments;
    record->cracked = 2 * record->broken;
    record->steps = 1000;
    double end = 5e-3 / (of->materials ? (p % 2 ? 1e5 : 1e4) : 1e3 * pow(10, (double)p));
    record->onset_time = intact ? NAN : 0.4 * end * (1 + 0.01 * random_share(&state));
    record->end_time = end;
    record->time_step = end / 1000;
    record->mass = 2750 * 1e-6 * 50e-3;
    record->dissipated =
        intact ? 0 : 1.7e-4 * (double)record->fragments * (1 + 0.02 * random_share(&state));
    record->dissipated_bending = record->friction = record->damped = 0;
    record->created = 1e-3 * (p == 2 ? 14 : 1) * record->dissipated;
    record->residual = (p == 1 && of->endings ? 2e-3 : 2e-4) * record->dissipated *
                       (1 + (double)replica / 100);
    record->residual_end = record->residual / 2;
    record->kinetic = record->elastic = record->cohesive = 0;
    record->work = record->dissipated;
    record->momentum[0] = record->momentum[1] = record->momentum[2] = 0;
    make_fragments(of, p, &state, record);
    make_history(end, record);
}

static void make_any_record(const void *context, size_t p, int64_t replica, fracas_record *record)
{
    make_record(context, p, replica, record);
}

static void write_study(const truth *of, const char *folder)
{
    made_table made;
    make_table(of, &made);
    fracas_file_header header = {.campaign = fracas_hash_of(of->name, strlen(of->name)),
                                 .seed = UINT64_MAX,
                                 .version = FRACAS_VERSION,
                                 .complete = !of->endings};
    report_write_study(folder, &header, &made.table, make_any_record, of);
}

static void make_study(const truth *of, char *folder, size_t size)
{
    snprintf(folder, size, "%s/%s", report_root, of->name);
    write_study(of, folder);
    report_analyse(folder);
}

/* 32 replicas at n - 3 and n + 3: mean n, deviation 3 sqrt(32/31), half width t_(0.975, 31)
 * 3/sqrt(31) with the tabulated t = 2.0395: 1.0989, printed to two digits. Sizes: L/55 = 909.09 um
 * and L/61 = 819.67 um have the mean 864.38 um, and 2.0395 (909.09 - 819.67)/2/sqrt(31) = 16.38 um.
 */
static void table_of_a_sweep(void **state)
{
    char folder[512];
    make_study(&sweep, folder, sizeof folder);
    OWNED char *table = report_contents(folder, "table.txt");
    assert_has(table, "58.0 +- 1.1");
    assert_has(table, "1600.0 +- 2.7"); /* 8 replicas: t = 2.3646, 2.3646 3/sqrt(7) = 2.681 */
    assert_has(table, " 864 +- 16 ");
    assert_has(table, "32 FRAGMENTED\n");
    size_t lines = 0;
    for (const char *line = table; *line != '\n';
         line += strcspn(line, "\n") + 1) { /* up to the empty line */
        assert_true(strcspn(line, "\n") <= 120);
        lines++;
    }
    assert_int_equal(lines, 2 + NPOINTS);
    report_check(folder);
}

/* One replica; FAILED and TIME_LIMIT; INTACT; a point without any usable realization; two
 * materials. */
static void table_of_awkward_points(void **state)
{
    char folder[512];
    make_study(&awkward, folder, sizeof folder);
    OWNED char *table = report_contents(folder, "table.txt");
    assert_has(table, "58.00 +- -"); /* one replica: 60 - 2 */
    assert_has(table, "3 TIME_LIMIT, 1 FAILED");
    assert_has(table, "2 FRAGMENTED, 1 INTACT");
    assert_has(table, "1 NONFINITE, 1 ENERGY_DRIFT");
    assert_has(table, "no usable realization");
    assert_has(table,
               "warning: rate 1e5 1/s, Young's modulus 275 GPa: ledger residual up to 2.0e-3");
    report_check(folder);
}

/* Texts of a study.h5 made by hand: neither markup nor control characters. */
static void texts_of_a_file_are_no_markup(void **state)
{
    char folder[512];
    made_table made;
    fracas_file_header header = {.version = "<svg onload=alert(1)>\x1b[2J\xff", .complete = true};
    make_table(&sweep, &made);
    for (size_t p = 0; p < NPOINTS; p++) made.value[p][1].text = "\u202e<b>\x01";
    snprintf(folder, sizeof folder, "%s/by hand", report_root);
    report_write_study(folder, &header, &made.table, make_any_record, &sweep);
    report_analyse(folder);
    static const char *const written[] = {"report/index.html", "report/summary.json",
                                          "report/size-against-rate.svg"};
    for (size_t i = 0; i < sizeof written / sizeof *written; i++) {
        OWNED char *text = report_contents(folder, written[i]);
        for (const char *c = text; *c; c++) assert_true((unsigned char)*c >= 0x20 || *c == '\n');
        assert_null(strstr(text, "\u202e"));
        assert_null(strchr(text, '\xff'));
        if (i == 1) continue;
        assert_null(strstr(text, "<svg onload"));
        assert_null(strstr(text, "<b>\\x01"));
    }
    OWNED char *page = report_contents(folder, "report/index.html");
    assert_has(page, ", fracas &lt;svg onload=alert(1)&gt;\\x1b[2J\\xff.</span>");
    assert_has(page, "law \\xe2\\x80\\xae&lt;b&gt;\\x01");
}

static void study_that_is_not_there(void **state)
{
    fracas_analysis *analysis;
    assert_int_equal(fracas_analysis_create("/nonexistent", NULL, NULL, &analysis), FRACAS_DAMAGED);
    assert_null(analysis);
    FAILS(fracas_analysis_create(report_root, NULL, NULL, &analysis), FRACAS_DAMAGED, "fracas run");
}

static void report_that_cannot_be_written(void **state)
{
    char folder[512], blocker[520];
    snprintf(folder, sizeof folder, "%s/blocked", report_root);
    write_study(&awkward, folder);
    snprintf(blocker, sizeof blocker, "%s/report", folder);
    write_bytes(blocker, "", 0); /* where the folder should be */
    OWN(fracas_analysis) analysis;
    OK(fracas_analysis_create(folder, NULL, NULL, &analysis));
    FAILS(fracas_report_write(analysis, folder, NULL, 0), FRACAS_USAGE,
          "blocked/report is no folder");
}

TESTS_ALL(report_make_root, report_remove_root, table_of_a_sweep, table_of_awkward_points,
          texts_of_a_file_are_no_markup, study_that_is_not_there, report_that_cannot_be_written)
