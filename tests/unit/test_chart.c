/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts: what their CSV says, what their drawings have, and drawings as PDF. */
#define FOLDER "fracas-chart"
#include "tests/support/folder.h"

#include "analysis/draw/chart.h"
#include "analysis/report/page.h"
#include "base/param.h"
#include "tests/support/svg_path.h"

#include <sys/stat.h>
#include <unistd.h>

/* A mark without a bar and one that no log axis shows, a line without a name in the look of the
 * marks, and a band with a gap. */
static void make_chart(fracas_chart *chart)
{
    fracas_series *series;
    fracas_chart_init(chart);
    fracas_panel *panel = fracas_chart_add(chart, 200);
    panel->x.log = panel->y.log = true;
    strcpy(panel->x.label, "rate [1/s]");
    strcpy(panel->y.label, "size [mm]");
    OK(fracas_panel_add(panel, FRACAS_CURVE, 0, 2, &series));
    for (size_t i = 0; i < 2; i++) series->x[i] = series->y[i] = i ? 10 : 1;
    OK(fracas_panel_add(panel, FRACAS_MARKS, 0, 3, &series));
    strcpy(series->name, "a \"quoted\", <name>");
    for (size_t i = 0; i < 3; i++) {
        series->x[i] = 1 + (double)i;
        series->y[i] = i == 2 ? -1 : 2;
        series->low[i] = series->high[i] = NAN;
    }
    series->low[0] = -1;
    series->high[0] = 3;
    panel = fracas_chart_add(chart, 80);
    strcpy(panel->x.label, "rate [1/s]");
    strcpy(panel->y.label, "energy [J]");
    panel->bars = "quartiles";
    OK(fracas_panel_add(panel, FRACAS_BAND, 1, 5, &series));
    strcpy(series->name, "band");
    for (size_t i = 0; i < 5; i++) {
        series->x[i] = (double)i;
        series->y[i] = 2;
        series->low[i] = i == 2 ? NAN : 1;
        series->high[i] = 4;
    }
}

/* An axis of names: boxes, a filled mark on them, and an open one, with a line in grey. */
static void make_names(fracas_chart *chart)
{
    static const char *const name[] = {"mesh", "<beta>"};
    fracas_series *series;
    fracas_chart_init(chart);
    fracas_panel *panel = fracas_chart_add(chart, 200);
    panel->x.name = name;
    panel->x.nnames = 2;
    strcpy(panel->x.label, "refined");
    strcpy(panel->y.label, "change [%]");
    OK(fracas_panel_add(panel, FRACAS_BOXES, FRACAS_CHART_GREY, 3, &series));
    strcpy(series->name, "as it is");
    for (size_t i = 0; i < 3; i++) {
        series->x[i] = i < 2 ? 0.8 + (double)i : 2;
        series->low[i] = i == 1 ? NAN : -1;
        series->high[i] = 1;
    }
    for (int open = 0; open < 2; open++) {
        OK(fracas_panel_add(panel, FRACAS_MARKS, 2, 1, &series));
        strcpy(series->name, "a point");
        series->open = open;
        series->x[0] = open ? 2.2 : 0.8;
        series->y[0] = open ? 0.5 : 2;
        series->low[0] = 0;
        series->high[0] = 3;
    }
    OK(fracas_panel_add(panel, FRACAS_CURVE, FRACAS_CHART_GREY + 2, 2, &series));
    for (size_t i = 0; i < 2; i++) series->x[i] = i ? 2.5 : 0.5, series->y[i] = 2;
}

static char *written_of(void (*make)(fracas_chart *chart),
                        void (*write)(const fracas_chart *chart, FILE *out))
{
    FRACAS_CLEARED(fracas_chart) chart;
    FILE *out = text_begin();
    make(&chart);
    write(&chart, out);
    return text_end(out);
}

static char *written(void (*write)(const fracas_chart *chart, FILE *out))
{
    return written_of(make_chart, write);
}

static void the_csv_has_what_is_drawn(void **state)
{
    OWNED char *text = written(fracas_chart_csv);
    assert_string_equal(text, "panel,series,kind,rate [1/s],size [mm] | energy [J],low,high\n"
                              "1,,curve,1,1,,\n"
                              "1,,curve,10,10,,\n"
                              "1,\"a \"\"quoted\"\", <name>\",mark,1,2,-1,3\n"
                              "1,\"a \"\"quoted\"\", <name>\",mark,2,2,,\n"
                              "2,band,band,0,2,1,4\n"
                              "2,band,band,1,2,1,4\n"
                              "2,band,band,2,2,,4\n"
                              "2,band,band,3,2,1,4\n"
                              "2,band,band,4,2,1,4\n");
}

static void write_page(const fracas_chart *chart, FILE *out)
{
    fracas_chart_write(chart, false, out);
}

static void write_linear(const fracas_chart *chart, FILE *out)
{
    fracas_chart_write_axes(chart, FRACAS_AXES_LINEAR, out);
}

static void write_file(const fracas_chart *chart, FILE *out)
{
    fracas_chart_write(chart, true, out);
}

static void drawings_have_marks_bands_and_keys(void **state)
{
    OWNED char *page = written(write_page), *linear = written(write_linear),
               *file = written(write_file);
    assert_int_equal(count_of(page, "class=\"mark\""), 2);
    assert_int_equal(count_of(page, "class=\"bar\""), 1);
    assert_int_equal(count_of(page, "class=\"area\""),
                     3); /* before the gap, after it, and in the legend */
    assert_int_equal(count_of(page, "class=\"series c0\" data-key=\"0.1\""),
                     2); /* the line goes with the marks */
    assert_int_equal(count_of(page, "class=\"entry c0\" data-key=\"0.1\""), 1);
    assert_int_equal(count_of(page, "class=\"entry"), 2);
    assert_has(page, "data-x=\"log 1 10 ");
    assert_has(linear, "data-x=\"linear 0 10 ");
    assert_int_equal(count_of(linear, "class=\"mark\""), 3); /* where it can be below 0 */
    assert_has(page, "a &quot;quoted&quot;, &lt;name&gt;; rate [1/s]: 1.000; size "
                     "[mm]: 2.000 (95 %: -1.000 to 3.000)");
    assert_null(strstr(page, "<style>"));
    assert_has(file, ".c5{color:#56B4E9}");
    assert_null(strstr(file, "data-"));
    assert_null(strstr(file, "class=\"hit\""));
}

/* Where the tick of a name is, pixels. */
static double place_of(const char *drawing, const char *name)
{
    const char *at = strstr(drawing, name);
    assert_non_null(at);
    while (strncmp(at, "<text x=\"", 9) != 0) at--;
    return strtod(at + 9, NULL);
}

static void an_axis_may_have_names(void **state)
{
    OWNED char *page = written_of(make_names, write_page),
               *table = written_of(make_names, fracas_chart_csv);
    assert_string_equal(table, "panel,series,kind,refined,change [%],low,high\n"
                               "1,as it is,box,mesh,0,-1,1\n"
                               "1,as it is,box,<beta>,0,,1\n"
                               "1,as it is,box,<beta>,0,-1,1\n"
                               "1,a point,mark,mesh,2,0,3\n"
                               "1,a point,mark,<beta>,0.5,0,3\n"
                               "1,,curve,mesh,2,,\n"
                               "1,,curve,<beta>,2,,\n");
    assert_int_equal(count_of(page, "class=\"mark\""), 1);
    assert_int_equal(count_of(page, "class=\"mark open\""), 1);
    assert_int_equal(count_of(page, "class=\"area\""),
                     3); /* two, for one has no low end, and in the legend */
    assert_int_equal(count_of(page, "class=\"entry c2\" data-key=\"0.1\""),
                     1); /* both kinds of marks have one entry */
    assert_int_equal(count_of(page, "class=\"series c2\" data-key=\"0.1\""), 2);
    assert_int_equal(count_of(page, "class=\"series cg\""), 2);
    assert_has(page, "data-x=\"names 0.5 2.5 ");
    assert_has(page, "<title>a point; refined: mesh; change [%]: 2.000 (95 %: 0 to 3.000)</title>");
    assert_has(page, "refined: &lt;beta&gt;; ");
    const double mesh = place_of(page, ">mesh</text>"),
                 beta = place_of(page, ">&lt;beta&gt;</text>");
    const char *mark = strstr(page, "class=\"mark open\" d=\"M");
    assert_true(fabs(strtod(mark + strlen("class=\"mark open\" d=\"M"), NULL) -
                     (beta + 0.2 * (beta - mesh))) < 0.2); /* each to 0.05 pixels */
}

/* Three panels beside each other: marks, from the least to the greatest abscissa, and a curve; the
 * last one has no curve. */
static void make_multiples(fracas_chart *chart)
{
    fracas_series *series;
    fracas_chart_init(chart);
    chart->columns = 2;
    chart->width = FRACAS_CHART_MULTIPLES;
    for (size_t p = 0; p < 3; p++) {
        fracas_panel *panel = fracas_chart_add(chart, 190);
        FRACAS_PRINT(panel->title, "modulus %zu", p + 1);
        strcpy(panel->x.label, "rate [1/s]");
        strcpy(panel->y.label, "size [mm]");
        for (int curve = 0; curve < 2 - (p == 2); curve++) {
            OK(fracas_panel_add(panel, curve ? FRACAS_CURVE : FRACAS_MARKS, (unsigned)curve, 2,
                                &series));
            strcpy(series->name, curve ? "law" : "radius 1 mm");
            for (size_t i = 0; i < 2; i++) {
                series->x[i] = i ? 5 : 0;
                series->y[i] = (double)(i + p);
                if (!curve) series->low[i] = series->high[i] = NAN;
            }
        }
    }
    fracas_charts_align(chart, 1);
}

/* Panels share axes, whose numbers and labels are at the edges, and a legend, whose entries act on
 * all of them. Each has its title, also where a value is shown, and in the table. */
static void small_multiples_share_axes_and_legend(void **state)
{
    OWNED char *page = written_of(make_multiples, write_page),
               *table = written_of(make_multiples, fracas_chart_csv);
    assert_int_equal(count_of(page, "<g class=\"panel\" data-x"), 3);
    assert_int_equal(count_of(page, "<g class=\"entry"), 2);
    assert_int_equal(count_of(page, "data-key=\"0.0\""), 4); /* with its entry */
    assert_int_equal(count_of(page, "data-key=\"0.1\""), 3);
    assert_int_equal(count_of(page, ">rate [1/s]</text>"), 1);
    assert_int_equal(count_of(page, ">size [mm]</text>"), 1);
    assert_int_equal(count_of(page, "data-x=\"linear 0 5 "), 3);
    assert_int_equal(
        count_of(page, "data-y=\"linear 0 4 ") + count_of(page, "data-y=\"linear 0 3 "), 3);
    assert_int_equal(count_of(page, ">modulus 2</text>"), 1);
    assert_int_equal(count_of(page, ">4</text>"), 2); /* below the last panel of each column */
    assert_has(page, "<title>modulus 2; radius 1 mm; rate [1/s]: 0; size [mm]: 1.000</title>");
    assert_has(table, "panel,series,kind,rate [1/s],size [mm],low,high,title\n"
                      "1,radius 1 mm,mark,0,0,,,modulus 1\n");
    assert_has(table, "\n3,radius 1 mm,mark,5,3,,,modulus 3\n");
}

/* The frame is beyond the ends of the scales, which have marks. */
static void no_mark_is_on_the_frame(void **state)
{
    OWNED char *page = written_of(make_multiples, write_page);
    const char *x = strstr(page, "data-x=\"linear 0 5 "), *y = strstr(page, "data-y=\"linear 0 ");
    char frame[64];
    char *end;
    const double left = strtod(x + strlen("data-x=\"linear 0 5 "), &end), right = strtod(end, NULL);
    const double bottom = strtod(y + strlen("data-y=\"linear 0 3 "), &end), top = strtod(end, NULL);
    FRACAS_PRINT(frame, "d=\"M%.1f %.1fV%.1fH%.1f\"", left - 7, top - 7, bottom + 7, right + 7);
    assert_has(page, frame);
}

/* ---- PDF ---- */

static void put_file(const char *name, const char *text)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    write_bytes(path, text, strlen(text));
}

static void fails_with(char (*name)[FRACAS_DRAWING], const char *message)
{
    FAILS(fracas_convert(folder, name, 1, FRACAS_DRAWING_PDF), FRACAS_ENVIRONMENT, message);
}

static void drawings_become_pdf(void **state)
{
    if (!fracas_convert_possible) {
        print_message("skipped: built without librsvg\n");
        skip();
    }
    char names[2][FRACAS_DRAWING] = {"chart", "again"}, path[512], *svg = written(write_file);
    put_file("chart.svg", svg);
    put_file("again.svg", svg);
    free(svg);
    OK(fracas_convert(folder, names, 2, FRACAS_DRAWING_PDF));
    for (int i = 0; i < 2; i++) {
        snprintf(path, sizeof path, "%s/%s.pdf", folder, names[i]);
        OWNED char *pdf = whole_file(path);
        assert_memory_equal(pdf, "%PDF-", 5);
    }
    char missing[1][FRACAS_DRAWING] = {"missing"}, torn[1][FRACAS_DRAWING] = {"torn"},
         taken[1][FRACAS_DRAWING] = {"taken"};
    fails_with(missing, "missing.svg to make a pdf of it");
    put_file("torn.svg",
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"><path");
    fails_with(torn, "torn.svg");
    put_file("taken.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"9\"/>");
    snprintf(path, sizeof path, "%s/taken.pdf", folder);
    assert_int_equal(mkdir(path, 0777), 0);
    fails_with(taken, "taken.pdf");
    OK(fracas_convert(folder, NULL, 0, FRACAS_DRAWING_PDF));
}

/* A drawing of 9 by 5 pixels has 18 by 10 dots: both numbers follow the head of a PNG, the first
 * byte the highest. */
static void drawings_become_png(void **state)
{
    if (!fracas_convert_possible) {
        print_message("skipped: built without librsvg\n");
        skip();
    }
    char name[1][FRACAS_DRAWING] = {"dots"}, path[512];
    put_file("dots.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9\" height=\"5\"/>");
    OK(fracas_convert(folder, name, 1, FRACAS_DRAWING_PNG));
    snprintf(path, sizeof path, "%s/dots.png", folder);
    OWNED char *png = whole_file(path);
    assert_memory_equal(png, "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x12\0\0\0\x0a", 24);
}

TESTS_ALL(make_folder, remove_folder, the_csv_has_what_is_drawn, drawings_have_marks_bands_and_keys,
          an_axis_may_have_names, small_multiples_share_axes_and_legend, no_mark_is_on_the_frame,
          drawings_become_pdf, drawings_become_png)
