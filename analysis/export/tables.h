/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables of text for a terminal and for the page, made by descriptors of their columns. */
#ifndef FRACAS_ANALYSIS_EXPORT_TABLES_H
#define FRACAS_ANALYSIS_EXPORT_TABLES_H

#include "analysis/fit/fits.h"
#include "analysis/summary/study.h"

enum { FRACAS_CELL = 128, FRACAS_RESULT_TABLE_HEAD = 2 };

typedef struct {
    size_t rows, columns;      /* rows 0 and 1 are names and units */
    size_t keys;               /* first columns, which name a row */
    size_t laws;               /* columns of scaling laws, which stand close together */
    size_t first_law;          /* the first of them */
    char (*cell)[FRACAS_CELL]; /* rows x columns */
} fracas_result_table;

static inline char *fracas_result_table_cell(const fracas_result_table *table, size_t row,
                                             size_t column)
{
    return table->cell[row * table->columns + column];
}

void fracas_result_table_clear(fracas_result_table *table);

typedef enum {
    FRACAS_CELL_INTEGER,    /* int64_t */
    FRACAS_CELL_NUMBER,     /* double to `digits` digits; 0: the shortest notation to six */
    FRACAS_CELL_ESTIMATE,   /* fracas_estimate: mean and half width */
    FRACAS_CELL_MEAN,       /* fracas_estimate: the mean, to the digits of its half width */
    FRACAS_CELL_INTERVAL,   /* fracas_interval: value and ends */
    FRACAS_CELL_PLUS_MINUS, /* double, with its half width at `other` */
    FRACAS_CELL_TEXT,       /* char[] */
    FRACAS_CELL_FORMAT      /* by `format` */
} fracas_cell_kind;

typedef struct fracas_table_column {
    const char *name;
    const char *unit; /* in the second line; of a `prefixed` column the SI unit */
    fracas_cell_kind kind;
    size_t offset; /* in the struct of a row [bytes] */
    int digits;
    size_t other;  /* place of a divisor of the number, or of a half width; 0: none */
    bool prefixed; /* such columns of one unit share the prefix of the first of them */
    void (*format)(const fracas_analysis *analysis, size_t index, const void *row, char *text);
} fracas_table_column;

/* An array of structs, each a row. */
typedef struct {
    const void *first;
    size_t count, size; /* rows, and bytes of each */
    const fracas_analysis *analysis;
    bool (*keep)(const void *row); /* NULL: all */
} fracas_table_rows;

/* The table of these rows; `unicode`: with a plus-minus and a micro sign, else ASCII. *table is
 * cleared by the caller. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_table_make(const fracas_table_column *column, size_t columns,
                                             const fracas_table_rows *rows, bool unicode,
                                             fracas_result_table *table);
/* The same in columns `at` on of a table with room for them. */
void fracas_table_fill(const fracas_result_table *table, size_t at,
                       const fracas_table_column *column, size_t columns,
                       const fracas_table_rows *rows, bool unicode);
/* `count` rows below the head, all empty, with these names of columns. */
FRACAS_MUST_USE fracas_err fracas_table_empty(size_t count, size_t columns, const char *const *name,
                                              fracas_result_table *table);

/* For a terminal of so many columns (fracas_sheet_print), `indent` before each line; bit c of
 * `left`: column c is aligned left. Without `units` the second line is left out. */
void fracas_table_print(const fracas_result_table *table, const char *indent, unsigned left,
                        bool units, int columns, FILE *out);

/* The JSON summary of a study (docs/formats/summary.md); `brief`: of many points, the headline
 * statistics and varying parameters alone. */
void fracas_summary_write(const fracas_analysis *analysis, const fracas_shown_fits *shown,
                          bool brief, FILE *out);

/* Label of a point, as a format. */
void fracas_cell_label(const fracas_analysis *analysis, size_t point, const void *row, char *text);

/* A row a point. The last column is text, the others numbers.
`unicode`: with a plus-minus and a micro sign, else ASCII. */
FRACAS_MUST_USE fracas_err fracas_result_table_create(const fracas_analysis *analysis, bool unicode,
                                                      fracas_result_table *table);

/* Meaning of the columns of the study's table. */
enum { FRACAS_LEGEND_LINES = 6 };
typedef struct {
    const char *line[FRACAS_LEGEND_LINES + 1]; /* paragraphs; ends with NULL */
    char numbers[1024];                        /* the first of them */
} fracas_legend;
void fracas_result_table_legend(const fracas_analysis *analysis, fracas_legend *legend);

/* "Points differ in material.young, too: points.csv has ...": parameters missing in the table;
 * false if there are none. */
bool fracas_result_table_beside(const fracas_analysis *analysis, char *text, size_t size);

/* Tables beside the headline one. A row for each series with a slope and for all points, of the
 * size and of the count; a row for every two neighbouring rates of a series; a row a series: its
 * crossover, or why there is none; a row a ring: velocities of its fragments; a row for every two
 * neighbouring values of a parameter, and one for its whole range. A table without rows has only
 * its head. */
typedef enum {
    FRACAS_SLOPES,
    FRACAS_COUNT_SLOPES,
    FRACAS_COUNT_LARGE_SLOPES,
    FRACAS_WINDOWS,
    FRACAS_CROSSOVERS,
    FRACAS_MOTION,
    FRACAS_EFFECTS,
    FRACAS_EFFECTS_EACH, /* in each setting, over the whole range */
    FRACAS_SIDE_TABLES
} fracas_side_table_name;

typedef struct {
    const char *id, *title;    /* on the page */
    const char *const *legend; /* meaning of the columns, a line each; ends with NULL */
    const fracas_table_column *column;
    size_t columns, size;          /* size: of a row's struct [bytes] */
    bool (*keep)(const void *row); /* as fracas_table_rows has it */
    fracas_err (*list)(const fracas_analysis *analysis, void **rows,
                       size_t *count); /* the rows, freed by the caller; NULL: the points are it */
} fracas_side_table;

extern const fracas_side_table fracas_side_tables[FRACAS_SIDE_TABLES];
/* For a page. */
FRACAS_MUST_USE fracas_err fracas_side_table_create(const fracas_analysis *analysis,
                                                    fracas_side_table_name name,
                                                    fracas_result_table *table);

/* Says what each parameter does over its range, with 95 % intervals, a line each; nothing where
 * points differ in the strain rate alone. */
typedef void fracas_effect_line(void *context, const char *line);
FRACAS_MUST_USE fracas_err fracas_effects_say(const fracas_analysis *analysis,
                                              fracas_effect_line *say, void *context);

/* A row a fitted family of a point, by rank: distances, their p-values, parameters. For
 * a page. */
FRACAS_MUST_USE fracas_err fracas_fit_table_create(const fracas_analysis *analysis,
                                                   const fracas_fits *fits,
                                                   fracas_result_table *table);

/* Meaning of the columns, a line each; ends with NULL. */
extern const char *const fracas_fit_table_legend[];

/* "x is a special case of y and suffices (p = 0.3)": the best two families; false, and no text, if
 * they were not compared. */
bool fracas_fits_format_comparison(const fracas_fits *fits, int64_t point, char *text, size_t size);

/* For a terminal: of each point its families by rank, then the failed ones, and why. */
void fracas_fits_print(const fracas_fits *fits, const fracas_analysis *analysis, int columns,
                       FILE *out);
void fracas_fits_write_json(const fracas_fits *fits, FILE *out);

#endif
