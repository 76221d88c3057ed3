/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Axes of the figures of means: abscissa, series, small multiples; names of parameters in words. */
#include "analysis/data/words.h"
#include "analysis/report/figures.h"
#include "analysis/summary/study.h"
#include "campaigns/file/catalog.h"
#include "tests/support/test.h"

enum { RATES = 2, MODULI = 14, YOUNGS = 2, NPOINTS = RATES * MODULI * YOUNGS, NCOLUMNS = 6 };

static const fracas_column column[NCOLUMNS] = {
    {"derived.strain_rate", "1/s", "", false}, {"derived.strength_modulus", "1", "", false},
    {"geometry.thickness", "m", "", false},    {"loading.rate", "1/s", "", false},
    {"material.young", "Pa", "", false},       {"strength.shape", "1", "", false}};

typedef struct {
    fracas_value value[NPOINTS][NCOLUMNS];
    fracas_point_row row[NPOINTS];
    fracas_point_table table;
    fracas_point_statistics point[NPOINTS];
    fracas_analysis analysis;
} made;

/* Point p of rates by moduli by Young's moduli, the last fastest; its count is 10 + p. */
static void make(size_t rates, size_t moduli, size_t youngs, made *of)
{
    static const double rate[RATES] = {1e3, 1e4}, young[YOUNGS] = {70e9, 370e9};
    const size_t npoints = rates * moduli * youngs;
    *of = (made){.table = {NCOLUMNS, column, npoints, of->row}};
    for (size_t p = 0; p < npoints; p++) {
        const double m = 3 * (double)(1 + p / youngs % moduli), r = rate[p / (youngs * moduli)],
                     real[NCOLUMNS] = {r, m, 1e-4, r, young[p % youngs], m};
        for (size_t c = 0; c < NCOLUMNS; c++) of->value[p][c] = (fracas_value){real[c], ""};
        of->row[p] = (fracas_point_row){.value = of->value[p]};
        of->point[p].rate = r;
        of->point[p].count = (fracas_estimate){4, 10 + (double)p, 1, 2};
        of->point[p].size = (fracas_estimate){4, 1e-3 / (10 + (double)p), 1e-5, 1e-5};
        of->point[p].scales = (fracas_scales){NAN, NAN, NAN, NAN};
    }
    of->analysis = (fracas_analysis){.table = &of->table, .point = of->point};
    OK(fracas_columns_create(&of->table, &of->analysis.shown));
}

static void clear(made *of)
{
    fracas_columns_clear(&of->analysis.shown);
    fracas_means_axes_clear(&of->analysis.axes);
}

static void assert_panels(made *of, const char *x, const char *series, const char *panels,
                          const char *expected)
{
    char text[256];
    OK(fracas_analysis_axes(&of->analysis, x, series, panels));
    const fracas_means_axes *axes = &of->analysis.axes;
    const struct {
        const char *before;
        const fracas_columns *columns;
    } part[] = {{" by ", &axes->series}, {" in ", &axes->panels}, {" apart ", &axes->drawings}};
    FRACAS_PRINT(text, "%s", axes->key);
    for (size_t k = 0; k < FRACAS_COUNT(part); k++)
        for (size_t i = 0; i < part[k].columns->count; i++)
            fracas_append(text, sizeof text, i ? "," : part[k].before, "%s",
                          column[part[k].columns->column[i]].path);
    assert_string_equal(text, expected);
}

static void assert_axes(made *of, const char *x, const char *series, const char *expected)
{
    assert_panels(of, x, series, NULL, expected);
}

static void axes_are_chosen_by_what_varies(void **state)
{
    static made of;
    make(2, 3, 1, &of);
    assert_axes(&of, NULL, NULL, "derived.strain_rate by strength.shape");
    assert_true(of.analysis.axes.rate && of.analysis.axes.log);
    assert_axes(&of, "strength.shape", NULL, "strength.shape by loading.rate");
    assert_string_equal(of.analysis.axes.label, "Weibull modulus");
    assert_true(!of.analysis.axes.rate && !of.analysis.axes.log && of.analysis.axes.value[5] == 9);
    assert_axes(&of, "loading.rate", "strength.shape", "derived.strain_rate by strength.shape");
    assert_axes(&of, "count.mean", NULL, "count.mean");
    assert_string_equal(of.analysis.axes.label, "mean over replicas of the number of fragments");
    assert_true(of.analysis.axes.value[5] == 15);
    assert_axes(&of, "size.mean", "loading.rate", "size.mean by loading.rate");
    assert_true(strstr(of.analysis.axes.label, "[\u00b5m]") != NULL);
    assert_true(fabs(of.analysis.axes.value[0] - 100) < 1e-9); /* um: 1e-3/10 m, two roundings */
    assert_axes(&of, "size", NULL, "size");                    /* as `y` takes it */
    clear(&of);
    make(1, 3, 1, &of); /* no rate varies */
    assert_axes(&of, NULL, NULL, "strength.shape");
    clear(&of);
    make(1, 1, 2, &of);
    assert_axes(&of, NULL, NULL, "material.young");
    assert_string_equal(of.analysis.axes.label, "Young's modulus [GPa]");
    assert_true(of.analysis.axes.value[1] == 370);
    clear(&of);
    make(1, 1, 1, &of); /* one point, and its rate */
    assert_axes(&of, NULL, NULL, "derived.strain_rate");
    clear(&of);
}

static void wrong_keys_name_those_that_vary(void **state)
{
    static made of;
    make(2, 3, 1, &of);
    fracas_analysis *analysis = &of.analysis;
    FAILS(fracas_analysis_axes(analysis, "strength.shap", NULL, NULL), FRACAS_USAGE,
          "`strength.shap`: no parameter of the points and no statistic");
    FAILS(fracas_analysis_axes(analysis, "geometry.thickness", NULL, NULL), FRACAS_USAGE,
          "x of the figures, `geometry.thickness`: it is the same at all points; they differ in "
          "loading.rate, strength.shape");
    FAILS(fracas_analysis_axes(analysis, NULL, "size.mean", NULL), FRACAS_USAGE,
          "series of the figures, `size.mean`: no parameter of the points has this name");
    FAILS(fracas_analysis_axes(analysis, "strength.shape", "strength.shape", NULL), FRACAS_USAGE,
          "both x and series");
    FAILS(fracas_analysis_axes(analysis, NULL, NULL, "strength.shap"), FRACAS_USAGE,
          "panels of the figures, `strength.shap`: no parameter of the points has this name");
    FAILS(fracas_analysis_axes(analysis, NULL, NULL, "material.young"), FRACAS_USAGE,
          "panels of the figures, `material.young`: it is the same at all points");
    FAILS(fracas_analysis_axes(analysis, "loading.rate", NULL, "loading.rate"), FRACAS_USAGE,
          "both x and panels");
    FAILS(fracas_analysis_axes(analysis, NULL, "loading.rate", "loading.rate"), FRACAS_USAGE,
          "both series and panels");
    clear(&of);
}

/* Points of two rates and two Young's moduli against the Weibull modulus: two series in each of two
 * panels with the same axes. Counts grow with the number of a point. */
static void other_parameters_make_small_multiples(void **state)
{
    static made of;
    FRACAS_CLEARED(fracas_charts) charts = {0};
    make(2, 3, 2, &of);
    assert_axes(&of, "strength.shape", "loading.rate",
                "strength.shape by loading.rate in material.young");
    OK(fracas_figure_means(&of.analysis, FRACAS_MEANS_COUNT, &charts));
    assert_true(charts.count == 1 && charts.left_out == 0);
    assert_string_equal(charts.chart->title, "Mean number of fragments against Weibull modulus");
    assert_string_equal(charts.chart->file, "count-against-strength-shape");
    assert_true(strstr(charts.chart->caption, " A panel for each Young's modulus.") != NULL);
    assert_true(charts.chart->npanels == 2 && charts.chart->columns == 2);
    for (size_t d = 0; d < 2; d++) {
        const fracas_panel *panel = &charts.chart->panel[d];
        assert_string_equal(panel->title, d ? "Young's modulus 370 GPa" : "Young's modulus 70 GPa");
        assert_int_equal(panel->nseries, 4); /* marks and the line that joins them */
        assert_true(fabs(panel->x.show[0] - 2.76) < 1e-12 && fabs(panel->x.show[1] - 9.24) < 1e-12);
        assert_true(panel->y.show[0] == 8 && panel->y.show[1] == 23); /* 10 - 2 to 21 + 2 */
        for (size_t s = 0; s < 2; s++) {
            const fracas_series *marks = &panel->series[2 * s], *line = marks + 1;
            assert_true(marks->kind == FRACAS_MARKS && line->kind == FRACAS_CURVE && !*line->name);
            assert_string_equal(marks->name, s ? "rate 1e4 1/s" : "rate 1e3 1/s");
            assert_true(marks->n == 3 && line->n == 3 && marks->look == s && line->look == s);
            for (size_t i = 0; i < 3; i++) {
                const double count = (double)(10 + 6 * s + 2 * i + d);
                assert_true(marks->x[i] == 3 * (double)(1 + i) && marks->y[i] == count);
                assert_true(marks->low[i] == count - 2 && marks->high[i] == count + 2);
                assert_true(line->x[i] == marks->x[i] && line->y[i] == marks->y[i]);
            }
        }
    }
    clear(&of);
}

/* The value of a statistic, and the ends of its interval, at point 0. */
static void assert_ordinate(const made *of, size_t number, const char *key, const char *words,
                            double value, double low, double high)
{
    const fracas_ordinate *ordinate = &of->analysis.ordinate[number];
    double from, to;
    assert_string_equal(ordinate->key, key);
    assert_string_equal(ordinate->words, words);
    assert_true(fracas_ordinate_at(ordinate, of->point, &from, &to) == value);
    assert_true(from == low || (isnan(from) && isnan(low)));
    assert_true(to == high || (isnan(to) && isnan(high)));
}

/* Means of numbers, intervals of pooled fragments, and plain statistics, real and whole. */
static void statistics_are_ordinates(void **state)
{
    static made of;
    make(2, 3, 1, &of);
    of.point->aspect = (fracas_estimate){4, 1.5, 0.1, 0.25};
    of.point->pooled.all.mass_mean = (fracas_interval){2e-3, 1e-3, 4e-3, 0};
    of.point->dust_share = 0.125;
    of.point->usable = 7;
    OK(fracas_analysis_ordinates(&of.analysis, "aspect,fragment.mass_mean,dust_share,usable"));
    assert_int_equal(of.analysis.nordinates, 4);
    assert_ordinate(&of, 0, "aspect", "aspect ratio of the fragments without dust", 1.5, 1.25,
                    1.75);
    assert_ordinate(&of, 1, "fragment.mass_mean", "mean size, weighed by mass, of all fragments",
                    2e-3, 1e-3, 4e-3);
    assert_ordinate(&of, 2, "dust_share", "dust fragments / all fragments", 0.125, NAN, NAN);
    assert_ordinate(&of, 3, "usable", "realizations that ended FRAGMENTED, INTACT or TIME_LIMIT", 7,
                    NAN, NAN);
    assert_true(of.analysis.ordinate[0].over && !of.analysis.ordinate[1].over);
    of.point->pooled.all.mean = (fracas_interval){3e-3, 2e-3, 5e-3,
                                                  0}; /* a key that ends in .mean */
    OK(fracas_analysis_ordinates(&of.analysis, "fragment.mean"));
    assert_ordinate(&of, 0, "fragment.mean", "mean size of all fragments", 3e-3, 2e-3, 5e-3);
    OK(fracas_analysis_ordinates(&of.analysis, "aspect.mean,fragment.mass_mean.value"));
    assert_ordinate(&of, 0, "aspect", "aspect ratio of the fragments without dust", 1.5, 1.25,
                    1.75);
    assert_ordinate(&of, 1, "fragment.mass_mean", "mean size, weighed by mass, of all fragments",
                    2e-3, 1e-3, 4e-3);
    OK(fracas_analysis_ordinates(&of.analysis, NULL)); /* nothing was dissipated */
    assert_int_equal(of.analysis.nordinates, 0);
    of.point[5].dissipated = (fracas_estimate){4, 1e-3, 1e-5, 1e-5};
    OK(fracas_analysis_ordinates(&of.analysis, NULL));
    assert_int_equal(of.analysis.nordinates, 1);
    assert_string_equal(of.analysis.ordinate->key, "dissipated");
    clear(&of);
}

static void wrong_ordinates_are_refused(void **state)
{
    static made of;
    make(2, 3, 1, &of);
    fracas_analysis *analysis = &of.analysis;
    FAILS(fracas_analysis_ordinates(analysis, "aspect,aspct"), FRACAS_USAGE,
          "y of the figures, `aspect,aspct`: `aspct` is no statistic; summary.json has them");
    FAILS(fracas_analysis_ordinates(analysis, "aspect,"), FRACAS_USAGE, "an empty name");
    FAILS(fracas_analysis_ordinates(analysis, "fragment"), FRACAS_USAGE, "is no statistic");
    FAILS(fracas_analysis_ordinates(analysis, "strength.shape"), FRACAS_USAGE, "is no statistic");
    FAILS(fracas_analysis_ordinates(analysis, "size.mean"), FRACAS_USAGE,
          "every report draws `size`; leave it out");
    FAILS(fracas_analysis_ordinates(analysis,
                                    "drift,drift,drift,drift,drift,drift,drift,drift,drift,drift,"
                                    "drift,drift,drift"),
          FRACAS_USAGE, "at most 12 statistics");
    clear(&of);
}

/* Marks with their intervals, joined by a line also against the rate; points without the number
 * have no mark; no mark lies on the frame. */
static void ordinates_have_figures(void **state)
{
    static made of;
    FRACAS_CLEARED(fracas_charts) charts = {0};
    make(2, 3, 1, &of);
    for (size_t p = 0; p < 6; p++)
        of.point[p].onset_time = (fracas_estimate){4, 1e-6 * (double)(p + 1), 1e-7, 1e-7};
    of.point[4].onset_time.mean = NAN;
    assert_axes(&of, NULL, NULL, "derived.strain_rate by strength.shape");
    OK(fracas_analysis_ordinates(&of.analysis, "onset_time"));
    OK(fracas_figure_ordinate(&of.analysis, of.analysis.ordinate, &charts));
    assert_int_equal(charts.count, 1);
    const fracas_chart *chart = charts.chart;
    assert_string_equal(chart->title, "Time of first onset against strain rate");
    assert_string_equal(chart->file, "onset-time-against-rate");
    assert_string_equal(chart->panel->y.label, "time of first onset [\u00b5s]");
    assert_true(strstr(chart->caption, "Mean over replicas of the time of first onset (n = 4)"));
    assert_true(chart->panel->x.log && !chart->panel->y.log);
    assert_true(chart->panel->y.show[0] < 1 && chart->panel->y.show[1] > 6);
    assert_int_equal(chart->panel->nseries, 6);
    for (size_t s = 0; s < 3; s++) {
        const fracas_series *marks = &chart->panel->series[2 * s], *line = marks + 1;
        assert_true(marks->kind == FRACAS_MARKS && line->kind == FRACAS_CURVE);
        assert_int_equal(marks->n, s == 1 ? 1 : 2);
        for (size_t i = 0; i < marks->n; i++) {
            const double value = (double)(s + 3 * i + 1); /* us; three roundings */
            assert_true(fabs(marks->y[i] - value) < 1e-14 * value);
            assert_true(fabs(marks->low[i] - (value - 0.1)) < 1e-14 * value);
            assert_true(fabs(marks->high[i] - (value + 0.1)) < 1e-14 * value);
        }
    }
    clear(&of);
}

/* Series of a panel: their number, and the look of the first. */
static size_t marks_of(const fracas_panel *panel, unsigned *look)
{
    size_t marks = 0;
    for (size_t s = panel->nseries; s-- > 0;) {
        if (panel->series[s].kind != FRACAS_MARKS) continue;
        *look = panel->series[s].look;
        marks++;
    }
    return marks;
}

/* Eight moduli against the rate: eight panels of one series, all in one colour. Of fourteen, twelve
 * panels are in the first drawing and two in the next, all with the same axes. */
static void many_values_make_panels(void **state)
{
    static made of;
    for (size_t moduli = 8; moduli <= MODULI; moduli += 6) {
        FRACAS_CLEARED(fracas_charts) charts = {0};
        make(2, moduli, 1, &of);
        assert_axes(&of, NULL, NULL, "derived.strain_rate in strength.shape");
        OK(fracas_figure_means(&of.analysis, FRACAS_MEANS_SIZE, &charts));
        assert_int_equal(charts.count, moduli > 12 ? 2 : 1);
        for (size_t m = 0; m < moduli; m++) {
            const fracas_chart *chart = &charts.chart[m / 12];
            const fracas_panel *panel = &chart->panel[m % 12];
            char title[64];
            unsigned look;
            FRACAS_PRINT(title, "Weibull modulus %zu", 3 * (1 + m));
            assert_string_equal(panel->title, title);
            assert_true(marks_of(panel, &look) == 1 && look == 0);
            assert_memory_equal(panel->x.show, charts.chart->panel->x.show, sizeof panel->x.show);
            assert_memory_equal(panel->y.show, charts.chart->panel->y.show, sizeof panel->y.show);
        }
        assert_int_equal(charts.chart->npanels, moduli > 12 ? 12 : moduli);
        assert_int_equal(charts.chart->columns, 3);
        if (moduli > 12)
            assert_string_equal(charts.chart[1].title,
                                "Mean fragment size against strain rate, continued");
        clear(&of);
    }
    make(2, 8, 2, &of); /* series by the parameter with few values */
    assert_axes(&of, NULL, NULL, "derived.strain_rate by material.young in strength.shape");
    clear(&of);
}

/* A third axis makes panels although four series would go into one. */
static void a_third_axis_makes_panels(void **state)
{
    static made of;
    make(2, 2, 2, &of);
    assert_axes(&of, NULL, NULL, "derived.strain_rate by material.young in strength.shape");
    assert_panels(&of, NULL, NULL, "material.young",
                  "derived.strain_rate by strength.shape in material.young");
    assert_panels(&of, "strength.shape", NULL, "material.young",
                  "strength.shape by loading.rate in material.young");
    assert_panels(&of, NULL, NULL, "loading.rate",
                  "derived.strain_rate by material.young in loading.rate apart strength.shape");
    of.table.npoints = 3; /* not combined, as cases are */
    assert_axes(&of, "strength.shape", NULL, "strength.shape by material.young");
    clear(&of);
}

/* Eight moduli as series of two panels: six, and two in a second drawing, in their own colours. */
static void six_series_are_the_most(void **state)
{
    static made of;
    FRACAS_CLEARED(fracas_charts) charts = {0};
    make(2, 8, 2, &of);
    assert_panels(&of, NULL, "strength.shape", "material.young",
                  "derived.strain_rate by strength.shape in material.young");
    OK(fracas_figure_means(&of.analysis, FRACAS_MEANS_SIZE, &charts));
    assert_int_equal(charts.count, 2);
    for (size_t d = 0; d < 2; d++) {
        const fracas_chart *chart = &charts.chart[d];
        assert_int_equal(chart->npanels, 2);
        assert_true(strstr(chart->caption, " At most 6 of 8 series: the others follow.") != NULL);
        for (size_t p = 0; p < 2; p++) {
            unsigned look;
            assert_int_equal(marks_of(&chart->panel[p], &look), d ? 2 : 6);
            assert_int_equal(look, 6 * d);
        }
    }
    assert_string_equal(charts.chart[1].title, "Mean fragment size against strain rate, continued");
    clear(&of);
}

/* Those of the list stand for a parameter; all others are words, not keys. */
static void every_parameter_has_words(void **state)
{
    static const char *const listed[] = {
#define X(path, words) path,
#include "analysis/data/words.list.h"
#undef X
    };
    static const struct {
        const char *path, *words;
    } some[] = {{"cohesive.fracture_energy", "fracture energy"},
                {"material.young", "Young's modulus"},
                {"model", "model"},
                {"loading_2.type", "loading of loading 2"},
                {"loading_3.edge", "loaded edge of loading 3"},
                {"loading_2.pressure", "pressure of loading 2"},
                {"unknown", "unknown"}};
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    const fracas_catalog *catalog;
    OK(fracas_catalog_make(memory, &catalog));
    for (size_t i = 0; i < sizeof listed / sizeof *listed; i++)
        if (strncmp(listed[i], "derived.", 8) != 0 && strcmp(listed[i], "case") != 0 &&
            !fracas_catalog_leaf(catalog, listed[i]))
            fail_msg("words.list.h: there is no %s", listed[i]);
    for (size_t i = 0; i < catalog->nleaves; i++) {
        const fracas_parameter_words words = fracas_words_of(catalog->leaf[i].path);
        if (words.text[0] == '\0' || strpbrk(words.text, "_."))
            fail_msg("%s is called \"%s\"", catalog->leaf[i].path, words.text);
    }
    for (size_t i = 0; i < sizeof some / sizeof *some; i++)
        assert_string_equal(fracas_words_of(some[i].path).text, some[i].words);
    static made of;
    make(1, 1, 1, &of);
    assert_string_equal(fracas_column_words(&of.table, 5).text, "Weibull modulus");
    of.value[0][1].real = NAN; /* the shape of another distribution */
    assert_string_equal(fracas_column_words(&of.table, 5).text, "shape of the strengths");
    clear(&of);
}

TESTS(axes_are_chosen_by_what_varies, wrong_keys_name_those_that_vary,
      other_parameters_make_small_multiples, statistics_are_ordinates, wrong_ordinates_are_refused,
      ordinates_have_figures, many_values_make_panels, a_third_axis_makes_panels,
      six_series_are_the_most, every_parameter_has_words)
