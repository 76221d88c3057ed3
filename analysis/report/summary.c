/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The first section: campaign, results, warnings. */
#include "analysis/report/page.h"

#include "analysis/scaling/scaling.h"
#include "analysis/data/format.h"
#include "base/own.h"

#include <ctype.h>
#include <inttypes.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

/* ---- the campaign ---- */

static void put_term(FILE *out, const char *term, const char *value)
{
    fprintf(out, "<dt>%s</dt><dd>", term);
    fracas_markup(out, "%s</dd>\n", value);
}

/* "nitsche, tied": the words of a column, each once; "" where no point has one. */
static void words_of(const fracas_point_table *table, size_t c, char *text, size_t size)
{
    text[0] = '\0';
    for (size_t p = 0; p < table->npoints; p++) {
        const char *word = table->point[p].value[c].text;
        size_t first = 0;
        while (strcmp(table->point[first].value[c].text, word) != 0) first++;
        if (*word && first == p) fracas_append(text, size, ", ", "%s", word);
    }
}

/* "275 GPa", "1e3 to 1e6 1/s": the numbers of a column; "" where no point has one. */
static void numbers_of(const fracas_point_table *table, size_t c, char *text, size_t size)
{
    const char *unit = table->column[c].unit;
    double least = INFINITY, most = -INFINITY;
    for (size_t p = 0; p < table->npoints; p++) {
        const double value = table->point[p].value[c].real;
        if (isnan(value)) continue;
        least = fmin(least, value);
        most = fmax(most, value);
    }
    text[0] = '\0';
    if (least > most) return;
    const bool scales = !strcmp(unit, "m") || !strcmp(unit, "Pa") || !strcmp(unit, "s"),
               pure = !strcmp(unit, "1");
    const fracas_prefix prefix = scales ? fracas_prefix_for((double[]){least, most}, 2)
                                        : (fracas_prefix){1, "", ""};
    char from[32], to[32];
    fracas_format_short(least * prefix.factor, from, sizeof from);
    fracas_format_short(most * prefix.factor, to, sizeof to);
    snprintf(text, size, "%s%s%s%s%s%s", from, least < most ? " to " : "", least < most ? to : "",
             pure ? "" : " ", prefix.sign, pure ? "" : unit);
}

static void values_of(const fracas_point_table *table, size_t c, char *text, size_t size)
{
    if (table->column[c].text) words_of(table, c, text, size);
    else numbers_of(table, c, text, size);
}

static void put_parameters(const fracas_page *page, const char *term, const char *prefix)
{
    const fracas_point_table *table = page->analysis->table;
    char line[1024] = "";
    for (size_t c = 0; c < table->ncolumns; c++) {
        char text[192];
        const size_t length = strlen(prefix);
        if (strncmp(table->column[c].path, prefix, length)) continue;
        values_of(table, c, text, sizeof text);
        if (*text)
            fracas_append(line, sizeof line, ", ", "%s %s", table->column[c].path + length, text);
    }
    if (*line) put_term(page->out, term, line);
}

static void put_replicas(const fracas_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    int64_t least = INT64_MAX, most = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const int64_t n = analysis->point[p].realizations;
        if (n < least) least = n;
        if (n > most) most = n;
    }
    char text[96];
    if (least >= most)
        FRACAS_PRINT(text, "%zu of %" PRId64 " replicas each", analysis->table->npoints, most);
    else
        FRACAS_PRINT(text, "%zu of %" PRId64 " to %" PRId64 " replicas", analysis->table->npoints,
                     least, most);
    put_term(page->out, "points", text);
}

static void put_campaign(const fracas_page *page)
{
    static const struct {
        const char *term, *prefix;
    } group[] = {{"body", "geometry."},     {"mesh", "mesh."},         {"material", "material."},
                 {"cohesive", "cohesive."}, {"strength", "strength."}, {"loading", "loading."},
                 {"load 2", "loading_2."},  {"load 3", "loading_3."},  {"time", "time."}};
    const fracas_file_header *header = &page->analysis->header;
    char text[128];
    fputs("<h3>What was run</h3>\n<dl>\n", page->out);
    put_replicas(page);
    const fracas_point_table *table = page->analysis->table;
    const size_t model = fracas_point_table_find(table, "model");
    if (model != SIZE_MAX) {
        values_of(table, model, text, sizeof text);
        put_term(page->out, "model", text);
    }
    for (size_t g = 0; g < sizeof group / sizeof *group; g++)
        put_parameters(page, group[g].term, group[g].prefix);
    put_term(page->out, "campaign", fracas_hash_hex(&header->campaign).text);
    FRACAS_PRINT(text, "%" PRIu64, header->seed);
    put_term(page->out, "seed", text);
    FRACAS_PRINT(text, "fracas %s", header->version);
    put_term(page->out, "program", text);
    fputs("</dl>\n", page->out);
}

/* ---- headline numbers ---- */

enum { HEADLINES = 12 }; /* points in the table of the summary */

/* The label of a point; its number, where the study has one point. */
static void point_text(const fracas_analysis *analysis, size_t p, const void *row, char *text)
{
    fracas_cell_label(analysis, p, row, text);
    if (!*text) snprintf(text, FRACAS_CELL, "%zu", p);
}

enum { RATIO = 4 }; /* the column of size/ZMR, which surfaces have not */

/* All points, or HEADLINES of them, evenly spread, the first and the last among them. */
static fracas_err make_headlines(const fracas_analysis *analysis, fracas_result_table *table)
{
#define AT(member) offsetof(fracas_point_statistics, member)
    static const fracas_table_column column[] = {
        {"point", "", FRACAS_CELL_FORMAT, .format = point_text},
        {"n", "", FRACAS_CELL_INTEGER, AT(usable)},
        {"fragments", "", FRACAS_CELL_ESTIMATE, AT(count)},
        {"mean size", "m", FRACAS_CELL_ESTIMATE, AT(size), .prefixed = true},
        [RATIO] = {"size", "/ZMR", FRACAS_CELL_ESTIMATE, AT(size), 0, AT(law[FRACAS_LAW_ZMR])},
    };
#undef AT
    const fracas_table_rows rows = {analysis->point, analysis->table->npoints,
                                    sizeof *analysis->point, analysis, NULL};
    const size_t columns = fracas_analysis_all_surfaces(analysis) ? RATIO : RATIO + 1;
    TRY(fracas_table_make(column, columns, &rows, true, table));
    for (size_t i = 0; rows.count > HEADLINES && i < HEADLINES; i++)
        memmove(fracas_result_table_cell(table, FRACAS_RESULT_TABLE_HEAD + i, 0),
                fracas_result_table_cell(
                    table, FRACAS_RESULT_TABLE_HEAD + i * (rows.count - 1) / (HEADLINES - 1), 0),
                columns * sizeof *table->cell);
    if (rows.count > HEADLINES) table->rows = FRACAS_RESULT_TABLE_HEAD + HEADLINES;
    return FRACAS_OK;
}

static fracas_err put_headlines(fracas_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    char legend[256];
    const bool all = analysis->table->npoints <= HEADLINES;
    fracas_result_table table = {0};
    const fracas_err built = make_headlines(analysis, &table);
    FRACAS_PRINT(legend,
                 "Means over n realizations with the half widths of their 95 %% intervals "
                 "(Student\u2019s t).%s%s%s",
                 fracas_analysis_any_surface(analysis)
                     ? " Size of a piece of a surface: the square root of its area."
                     : "",
                 table.columns > RATIO ? " ZMR: the law of Zhou, Molinari and Ramesh." : "",
                 all ? "" : " A selection of the points.");
    return fracas_page_table(page, "headline", "Headline numbers", false, &table,
                             (const char *const[]){legend, NULL}, built);
}

/* Exponents of the theories, where they speak of the body. */
static const char *theories_of(const fracas_size_slope *slope)
{
    if (!isfinite(slope->mott)) return "";
    return slope->mott < 0 ? " (Mott: -1, Grady: -2/3)" : " (Mott: 1, Grady: 2/3)";
}

enum { NAMED = 6 };

/* "The mean size goes with the strain rate to the power -0.6 +- 0.1 (m 10), ...": the slopes of
 * `count` series. */
static void put_powers(const fracas_page *page, const char *what, const fracas_size_slope *list,
                       size_t count)
{
    for (size_t i = 0; i < count && i < NAMED; i++) {
        if (i) fputs(", ", page->out);
        else fprintf(page->out, "%s goes with the strain rate to the power ", what);
        fprintf(page->out, "%s (", fracas_slope_text(&list[i].slope).text);
        fracas_markup(page->out, "%s)", list[i].name);
    }
    if (count > NAMED) fprintf(page->out, " and so on in %zu series more", count - NAMED);
}

/* Slopes of series, and of the line through all their points, named as such. */
static void put_mixed_slopes(const fracas_page *page, const fracas_size_slope *list, size_t count)
{
    const fracas_size_slope *all = &list[count - 1];
    fputs("<p>", page->out);
    put_powers(page, "The mean size", list, count - 1);
    if (count > 1) fprintf(page->out, "%s.", theories_of(all));
    else fputs("No series has the points for a slope.", page->out);
    fprintf(page->out,
            " A line through all %" PRId64 " points, of the power %s, mixes %" PRId64
            " series, which differ in more than the strain rate (<a href=\"#slopes\">slopes</a>)"
            ".</p>\n",
            all->slope.n, fracas_slope_text(&all->slope).text, all->mixes);
}

/* The slope of the only series: "Over 3 points the mean size goes ...". */
static void put_power(const fracas_page *page, const char *what, const fracas_size_slope *of,
                      const char *table)
{
    const fracas_slope *slope = &of->slope;
    fprintf(page->out,
            "<p>Over %" PRId64 " points %c%s goes with the strain rate to the power %s%s", slope->n,
            tolower(*what), what + 1, fracas_slope_text(slope).text, theories_of(of));
    if (slope->misfit < FRACAS_MISFIT_LIMIT)
        fprintf(page->out,
                ", but they are not on one line: their scatter about it is %s times what their "
                "errors explain (<a href=\"#%s\">slopes</a>)",
                fracas_digits(sqrt(slope->chi2 / slope->freedom), 2).text, table);
    fputs(".</p>\n", page->out);
}

static fracas_err put_slope(const fracas_page *page)
{
    OWNED fracas_size_slope *list = NULL;
    size_t count;
    TRY(fracas_size_slopes(page->analysis, &list, &count));
    if (count > 0 && list[count - 1].mixes > 1) put_mixed_slopes(page, list, count);
    else if (count > 0) put_power(page, "The mean size", &list[count - 1], "slopes");
    return FRACAS_OK;
}

/* Without dust the summary has the slope of an only series; the tables have all. */
static fracas_err put_count_slope(const fracas_page *page, bool dust, const char *what,
                                  const char *table)
{
    OWNED fracas_size_slope *list = NULL;
    size_t count;
    TRY(fracas_count_slopes(page->analysis, dust, &list, &count));
    if (count > 1 && list[count - 1].mixes > 1 && dust) {
        fputs("<p>", page->out);
        put_powers(page, what, list, count - 1);
        fprintf(page->out, " (<a href=\"#%s\">slopes</a>).</p>\n", table);
    } else if (count > 0 && list[count - 1].mixes == 1) {
        put_power(page, what, &list[count - 1], table);
    }
    return FRACAS_OK;
}

/* Where the sizes of a study of one series bend, if they do. */
static fracas_err put_crossover(const fracas_page *page)
{
    OWNED fracas_size_crossover *list = NULL;
    fracas_size_series *series;
    size_t count;
    TRY(fracas_size_series_create(page->analysis, &series, &count));
    fracas_size_series_free(series, count);
    if (count != 1) return FRACAS_OK; /* fits to many series take a while */
    TRY(fracas_size_crossovers(page->analysis, true, &list, &count));
    if (count == 1 && !*list->reason && list->rate.low > 0) {
        char rate[96], exponent[96];
        fracas_format_interval(list->rate.value, list->rate.low, list->rate.high, rate,
                               sizeof rate);
        fracas_format_interval(list->exponent.value, list->exponent.low, list->exponent.high,
                               exponent, sizeof exponent);
        fprintf(page->out,
                "<p>A curve that is level at low rates bends at %s /s, to the power %s at high "
                "ones (<a href=\"#crossovers\">crossover</a>).</p>\n",
                rate, exponent);
    }
    return FRACAS_OK;
}

static void put_precision(const fracas_page *page)
{
    const fracas_analysis *analysis = page->analysis;
    size_t worst = SIZE_MAX;
    double part = 0; /* 0: all replicas of a point are alike, as where every body stays whole */
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_estimate *count = &analysis->point[p].count;
        const double here = count->half_width / count->mean;
        if (!(here > part)) continue;
        part = here;
        worst = p;
    }
    if (worst == SIZE_MAX) return;
    const fracas_label label = fracas_analysis_label(analysis, worst);
    fprintf(page->out, "<p>The mean number of fragments is known to \u00b1 %s %% or better",
            fracas_digits(100 * part, 2).text);
    if (analysis->table->npoints > 1) {
        fracas_markup(page->out, ", of the points with two replicas or more (the least well: %s",
                      label.text);
        putc(')', page->out);
    }
    fputs(".</p>\n", page->out);
}

/* ---- effects ---- */

static void put_effect(void *context, const char *line)
{
    fracas_markup(context, "<li>%s</li>\n", line);
}

/* The list is left out where it is empty. */
static fracas_err put_effects(const fracas_page *page)
{
    OWNED char *list = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&list, &size);
    if (!out) return fracas_no_memory("the effects of parameters");
    const fracas_err err = fracas_effects_say(page->analysis, put_effect, out);
    if (fclose(out)) return fracas_no_memory("the effects of parameters");
    if (err || size == 0) return err;
    fprintf(page->out,
            "<h3>What each parameter does, all others being equal "
            "(<a href=\"#effects\">effects</a>)</h3>\n<ul>\n%s</ul>\n",
            list);
    return FRACAS_OK;
}

/* ---- warnings ---- */

static fracas_err put_warnings(const fracas_page *page)
{
    OWNED fracas_warning_line *line = NULL;
    size_t count;
    TRY(fracas_analysis_warning_lines(page->analysis, &line, &count));
    if (count > 1) fprintf(page->out, "<h3 id=\"warnings\">Warnings: %zu</h3>\n", count);
    else fputs("<h3 id=\"warnings\">Warnings</h3>\n", page->out);
    if (count == 0) {
        fputs("<p class=\"fine\">None: no realization failed or was stopped by its time limit; "
              "ledger residuals are below 1e-3 and created energy below 1e-2 of the dissipated "
              "energy, residuals below 1 % of the largest energy; mean fragments have 10 elements "
              "or more; at most 5 % of the fragments are dust; headline numbers are converged with "
              "replicas.</p>\n",
              page->out);
    } else {
        fputs("<ul class=\"warnings\" tabindex=\"0\">\n", page->out);
        for (size_t i = 0; i < count; i++) fracas_markup(page->out, "<li>%s</li>\n", line[i].text);
        fputs("</ul>\n", page->out);
    }
    return FRACAS_OK;
}

fracas_err fracas_section_summary(fracas_page *page)
{
    fputs("<div class=\"summary\">\n<div>\n", page->out);
    TRY(put_headlines(page));
    TRY(put_slope(page));
    TRY(put_count_slope(page, true, "The mean number of fragments", "count-slopes"));
    TRY(put_count_slope(page, false, "Their number without dust", "count-large-slopes"));
    TRY(put_crossover(page));
    put_precision(page);
    TRY(put_effects(page));
    TRY(put_warnings(page));
    fputs("</div>\n<div>\n", page->out);
    put_campaign(page);
    fputs("</div>\n</div>\n", page->out);
    return FRACAS_OK;
}
