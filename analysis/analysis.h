/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Statistics of a study, point by point, beside the scaling laws; the table, the exports and the
 * report. */
#ifndef FRACAS_ANALYSIS_ANALYSIS_H
#define FRACAS_ANALYSIS_ANALYSIS_H

#include "base/err.h"
#include "base/hash.h"
#include "base/own.h"
#include "campaigns/points.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef struct fracas_analysis fracas_analysis;

/* Reads the results of STUDY, complete or not, and computes every statistic. `campaign` and
 * `table`, which must outlive the analysis, are hash and points of STUDY/campaign.yaml, both NULL:
 * STUDY/study.h5 as it is. Errors as fracas_results_open. */
FRACAS_MUST_USE fracas_err fracas_analysis_create(const char *study, const fracas_hash *campaign,
                                                  const fracas_point_table *table,
                                                  fracas_analysis **analysis);
void fracas_analysis_destroy(fracas_analysis *analysis); /* NULL is allowed */
FRACAS_OWNER(fracas_analysis, fracas_analysis_destroy)

/* Says that the points have common random numbers: means of two settings are not independent. */
void fracas_analysis_share_numbers(fracas_analysis *analysis);

/* Draws the means of the report against this parameter or statistic, in series by this parameter
 * and panels by that; NULL: chosen by what varies. FRACAS_USAGE for a key that is unknown, does not
 * vary, or is given twice. */
FRACAS_MUST_USE fracas_err fracas_analysis_axes(fracas_analysis *analysis, const char *x,
                                                const char *series, const char *panels);
/* FRACAS_USAGE if two of them are the same. */
FRACAS_MUST_USE fracas_err fracas_analysis_check_axes(const char *x, const char *series,
                                                      const char *panels);

/* Draws these statistics, "aspect,fragment.mass_mean", beside mean size and count; NULL: those that
 * every report draws, where they make few drawings. FRACAS_USAGE, with the part that is wrong, for
 * anything else. */
FRACAS_MUST_USE fracas_err fracas_analysis_ordinates(fracas_analysis *analysis, const char *list);

/* The same check without a study; NULL: none. */
FRACAS_MUST_USE fracas_err fracas_analysis_check_ordinates(const char *list);
/* True of a key of the summary's statistics, with or without ".mean" or ".value". */
bool fracas_analysis_is_statistic(const char *key);

/* Points with figures of their own: "3,17,200-210", or "all"; else all of few points, of many a
 * choice. FRACAS_USAGE, with the part that is wrong, for anything else. */
FRACAS_MUST_USE fracas_err fracas_analysis_points(fracas_analysis *analysis, const char *list);

/* The result table, one line a point, for a terminal of so many columns; 0: as wide as it is. */
void fracas_analysis_print_table(const fracas_analysis *analysis, int columns, FILE *out);
/* The same numbers, all other statistics and the fits of STUDY/fits.csv as one JSON document. */
FRACAS_MUST_USE fracas_err fracas_analysis_write_json(const fracas_analysis *analysis,
                                                      const char *study, FILE *out);

/* In `folder`, NULL: STUDY/report, made if it is not there: index.html (self-contained),
 * points.csv, fragments.csv, summary.json and one SVG file a figure (and one CSV file a crack
 * pattern of a ring). `refresh`: the page loads itself again after so many seconds; 0: never. */
FRACAS_MUST_USE fracas_err fracas_report_write(const fracas_analysis *analysis, const char *study,
                                               const char *folder, int refresh);

/* Further tables of a package. */
typedef struct {
    bool histories; /* histories.csv */
    bool cracks;    /* cracks.csv and breaks.csv, of surfaces that keep their interfaces */
} fracas_export_more;

/* FRACAS_USAGE if the folder has a file that fracas_export_write would replace, and no report or
 * export wrote it. */
FRACAS_MUST_USE fracas_err fracas_export_free(const fracas_analysis *analysis, const char *folder,
                                              fracas_export_more more);

/* A Frictionless Data Package in `folder`, made if it is not there: points.csv, realizations.csv,
 * fragments.csv, statistics.csv, energies.csv, convergence.csv, of a study with probes probes.csv,
 * `more`, and at last datapackage.json, the schema of each (docs/formats/export.md). Equal bytes
 * for equal study.h5. FRACAS_USAGE if `folder` is a file, or for cracks of a study without them,
 * FRACAS_ENVIRONMENT if it cannot be made or written.
 */
FRACAS_MUST_USE fracas_err fracas_export_write(const fracas_analysis *analysis, const char *folder,
                                               fracas_export_more more);

/* Realizations as they move, for ParaView. */
typedef struct {
    size_t point;       /* SIZE_MAX: all */
    int64_t replica;    /* -1: the report's of each point */
    size_t count;       /* times */
    const double *time; /* s, of each; NULL: as fracas_flight_moments */
    const char *folder; /* made if it is not there; NULL: STUDY/vtk */
} fracas_grids_request;

/* Writes for each realization and time, K from 1:
 * - point-P-replica-R-body-K.hdf: elements where their fragments have moved, each with nodes of its
 *   own (displacement [m], velocity [m/s]; fragment, its elements, fragment_mass [kg]);
 * - point-P-replica-R-interfaces-K.hdf: interfaces half-way between their sides (state: 0 closed, 1
 *   cracked, 2 broken; strength [Pa], damage_at_end, onset_time and break_time [s], NaN: never);
 * and a .hdf.series of each, with the times. Prints their names on `out`. FRACAS_USAGE, with the
 * choices there are, for an unknown point, a study without interfaces, files of these names in a
 * folder of somebody's, and where nothing is written; FRACAS_INTERRUPTED if it is not complete. */
FRACAS_MUST_USE fracas_err fracas_export_grids(const fracas_analysis *analysis, const char *study,
                                               const fracas_grids_request *request, FILE *out);

/* The keys of a point's "statistics" in the JSON summary: the table of docs/formats/summary.md. */
void fracas_analysis_reference(FILE *out);

/* ---- pictures of broken surfaces ---- */

typedef enum { FRACAS_SHOW_CRACKS, FRACAS_SHOW_FRAGMENTS, FRACAS_SHOW_MESH } fracas_surface_show;

enum { FRACAS_MOMENTS = 6, FRACAS_FRAMES = 24 }; /* times of a row of pictures, of a film */

/* Where the reader is, far away, z upward: from x toward y by the azimuth, above the plane of both
 * by the elevation [degrees]. */
typedef struct {
    double azimuth, elevation;
} fracas_view;

#define FRACAS_VIEW_DEFAULT    \
    {                          \
        45, 35.264389682754654 \
    } /* in the direction (1, 1, 1) */

typedef struct {
    const fracas_hash *campaign; /* study.h5 must be of this campaign; NULL: of any */
    size_t point;
    int64_t replica;
    size_t count;       /* pictures */
    const double *time; /* s, of each; NULL: after even shares of the breaks, and at the end */
    fracas_surface_show show;
    const fracas_view *view; /* NULL: a flat surface as it lies, any other by FRACAS_VIEW_DEFAULT */
    double explode;     /* >= 0: fragments moved by this times (their centroid - that of all) */
    bool table;         /* the first times of all replicas as CSV, too */
    bool film;          /* a page that plays the motion in the place of pictures */
    bool dots;          /* pictures, as PNG, too */
    const char *folder; /* made if it is not there; NULL: STUDY/pictures */
} fracas_picture_request;

/* Writes surface-point-P-replica-R-K.svg for K from 1 (`film`: surface-point-P-replica-R.html),
 * with `table` also times-point-P.csv. Prints on `out` their names and the times at which the
 * realization first cracked, broke, and cracked through (surfaces). FRACAS_USAGE, with the choices
 * there are, for an unknown point, replica or time, and a study without interfaces. FRACAS_DAMAGED
 * if study.h5 is missing or of another campaign: only a complete study has the meshes. */
FRACAS_MUST_USE fracas_err fracas_pictures_write(const char *study,
                                                 const fracas_picture_request *request, FILE *out);

#endif
