/* SPDX-License-Identifier: GPL-3.0-or-later */
/* libfracas: realizations of a campaign, computed in your own program, to the last bit as `fracas
 * run` computes them. It knows no MPI and writes no file.
 *
 *     fracas_campaign *campaign;
 *     fracas_realization *realization;
 *     double dissipated;
 *     if (fracas_campaign_open("bar.yaml", &campaign) ||
 *         fracas_compute_one(campaign, 0, 7, &realization) ||
 *         fracas_realization_number(realization, "dissipated", &dissipated))
 *         return fprintf(stderr, "%s\n", fracas_error()), 1;
 *
 * Status: every function that returns int returns 0, or after a failure one of the statuses below.
 * fracas_error() then says what is wrong, where, and what to do; results are not set.
 *
 * Ownership: what `open` or `compute` gives is yours; end it with the `close` of its type, which
 * takes NULL, too. Texts returned as `const char *` live as long as the object that they came from;
 * those without an object as long as the program. Arrays are yours.
 *
 * Units: SI everywhere; each column names its unit.
 *
 * Threads: messages belong to the thread. One realizer may compute in several threads at a time,
 * and so may realizers of different campaigns. Calls that take a campaign come one at a time. */
#ifndef FRACAS_H
#define FRACAS_H

#include <stddef.h>
#include <stdint.h>

#ifdef __GNUC__
#define FRACAS_API __attribute__((visibility("default")))
#else
#define FRACAS_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- errors ---- */

/* The exit statuses of the program (docs/formats/exit-status.md). */
enum {
    FRACAS_STATUS_USAGE = 2,       /* a wrong campaign or argument */
    FRACAS_STATUS_ENVIRONMENT = 6, /* no memory, a file that cannot be read */
    FRACAS_STATUS_BUG = 70         /* a fault of fracas */
};

/* The message of the last failure in this thread, "" before the first; until the next failure. The
 * errors of a campaign file have a line each, at most 21 lines; every other message is one line. */
FRACAS_API const char *fracas_error(void);

/* The version of the library, "0.2.1". Numbers are those of a program of this version. */
FRACAS_API const char *fracas_version(void);

/* ---- campaigns: a campaign file as points, each with a number of replicas ---- */

typedef struct fracas_campaign fracas_campaign;

/* Reads and checks a campaign file (docs/formats/campaign-file.md), and the files that it names.
 * USAGE with a line "file:line:column: ..." for each error in it, as the program says them. */
FRACAS_API int fracas_campaign_open(const char *path, fracas_campaign **campaign);

/* The same from `size` bytes of text. `name` stands for the file in messages; the files that the
 * text names are looked for in its folder. */
FRACAS_API int fracas_campaign_open_text(const char *text, size_t size, const char *name,
                                         fracas_campaign **campaign);
FRACAS_API void fracas_campaign_close(fracas_campaign *campaign);

FRACAS_API const char *fracas_campaign_name(const fracas_campaign *campaign);

/* Writes the campaign as resolved, in SI with every default, as campaign.yaml of a study: *text
 * ends with a NUL; end it with fracas_text_close. */
FRACAS_API int fracas_campaign_resolved(const fracas_campaign *campaign, char **text);
FRACAS_API void fracas_text_close(char *text);

/* Number of points; they are counted from 0, in the order of /point in study.h5. */
FRACAS_API size_t fracas_campaign_points(const fracas_campaign *campaign);

/* Replicas of a point: 0 to this - 1 are in a study. Where a rule decides it is their maximum. 0
 * for an unknown point. */
FRACAS_API int64_t fracas_campaign_point_replicas(const fracas_campaign *campaign, size_t point);

/* ---- tables: what a realization and a point consist of ---- */

/* A column, as docs/formats/study.md lists it. */
typedef struct {
    const char *name;    /* "dissipated", "position"; of points the key: "loading.rate" */
    const char *type;    /* "int8", "int32", "int64", "float64"; of points also "text" */
    const char *unit;    /* "J", "m/s"; "1": a pure number; "": text */
    const char *meaning; /* a sentence */
    size_t width;        /* values in a row: 3 for x, y, z */
    size_t bytes;        /* in a row; 0 for text */
} fracas_table_column;

/* The tables of a realization: those of study.h5. */
enum {
    FRACAS_TABLE_REALIZATION, /* one row */
    FRACAS_TABLE_FRAGMENT,    /* a row for each fragment */
    FRACAS_TABLE_HISTORY,     /* a row for each event, and at equal times (output.history) */
    FRACAS_TABLE_INTERFACE,   /* a row for each interface, if output.interfaces asks for them */
    FRACAS_TABLE_PROBE,       /* a row for each row of history and probe */
    FRACAS_TABLE_REACTION,    /* a row for each row of history and held edge (output.reactions) */
    FRACAS_TABLES
};
/* "realization", "fragment" ...: the group in study.h5; NULL for an unknown table. */
FRACAS_API const char *fracas_table_name(int table);
/* Number of columns; 0 of an unknown table. */
FRACAS_API size_t fracas_table_columns(int table);
/* Column `i` of a table. USAGE if there is none. */
FRACAS_API int fracas_table_column_at(int table, size_t i, fracas_table_column *column);
/* The number of the column `name`, for the functions below. USAGE, with the nearest, if there is
 * none. */
FRACAS_API int fracas_table_find(int table, const char *name, size_t *i);

/* The columns of points, by name: /point in study.h5, but for hash and replicas. */
FRACAS_API size_t fracas_campaign_columns(const fracas_campaign *campaign);
FRACAS_API int fracas_campaign_column_at(const fracas_campaign *campaign, size_t i,
                                         fracas_table_column *column);
/* The value of a point in column `i`: *text is "" in a column of numbers, *number NaN in one of
 * text; so is either where the point lacks the value. USAGE for an unknown point or column. */
FRACAS_API int fracas_campaign_value(const fracas_campaign *campaign, size_t point, size_t i,
                                     double *number, const char **text);

/* ---- realizers: a point made ready to compute, with its mesh and operators ---- */

typedef struct fracas_realizer fracas_realizer;
typedef struct fracas_realization fracas_realization;

/* Makes the point ready: seconds on a large surface. The campaign must outlive the realizer. USAGE
 * for an unknown point. */
FRACAS_API int fracas_realizer_open(const fracas_campaign *campaign, size_t point,
                                    fracas_realizer **realizer);
FRACAS_API void fracas_realizer_close(fracas_realizer *realizer);

/* Elements and interfaces of the mesh, and strengths of a realization: strength k belongs to
 * interface k/(strengths/interfaces), at its Gauss point k%(strengths/interfaces). */
FRACAS_API size_t fracas_realizer_elements(const fracas_realizer *realizer);
FRACAS_API size_t fracas_realizer_interfaces(const fracas_realizer *realizer);
FRACAS_API size_t fracas_realizer_strengths(const fracas_realizer *realizer);

/* The time step [s], time.safety times the critical one, 2/omega_max. */
FRACAS_API double fracas_realizer_time_step(const fracas_realizer *realizer);

/* position[3 k + i]: coordinate i of strength k before any motion [m]; 3 strengths values. */
FRACAS_API int fracas_realizer_positions(const fracas_realizer *realizer, double *position);

/* strength[k]: those that `replica` (0 or more, also beyond the campaign's) has in a run [Pa]. */
FRACAS_API int fracas_realizer_draw(const fracas_realizer *realizer, int64_t replica,
                                    double *strength);

/* Computes `count` realizations, eight at a time side by side: realization[l] is that of
 * replica[l]. A realization depends on its own replica alone. With `strength`, realization l has
 * strength[l strengths + k] in place of those drawn; NULL: those of its replica. `threads`
 * for each batch, on surfaces alone: the numbers are the same for any; 0: as the campaign says,
 * else
 * 1. USAGE for a strength at which the law cannot dissipate its fracture energy on this mesh. */
FRACAS_API int fracas_realizer_compute(const fracas_realizer *realizer, const int64_t *replica,
                                       size_t count, const double *strength, int threads,
                                       fracas_realization **realization);

/* One realization of a point, alone: open, compute, close. */
FRACAS_API int fracas_compute_one(const fracas_campaign *campaign, size_t point, int64_t replica,
                                  fracas_realization **realization);

/* ---- realizations: the record of one, as in study.h5 ---- */

FRACAS_API void fracas_realization_close(fracas_realization *realization);

/* Number of rows of a table; 0 of an unknown one. */
FRACAS_API size_t fracas_realization_rows(const fracas_realization *realization, int table);

/* Copies column `i` of a table, rows x width values of its type, row after row: the bytes of that
 * dataset in study.h5. `size`: bytes in `values`. USAGE for an unknown column, or if they do not
 * fit. */
FRACAS_API int fracas_realization_get(const fracas_realization *realization, int table, size_t i,
                                      void *values, size_t size);

/* The value of a column of one value in the table of the realization, by name: "fragments",
 * "end_time". USAGE if there is none. */
FRACAS_API int fracas_realization_number(const fracas_realization *realization, const char *name,
                                         double *number);

#ifdef __cplusplus
}
#endif

#endif
