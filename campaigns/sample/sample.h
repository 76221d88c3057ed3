/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strength field of one realization, as in a run: for `fracas sample`. */
#ifndef FRACAS_CAMPAIGNS_SAMPLE_SAMPLE_H
#define FRACAS_CAMPAIGNS_SAMPLE_SAMPLE_H

#include "campaigns/plan/realize.h"

#include <stdio.h>

typedef struct {
    fracas_realizer realizer; /* at its point */
    int64_t replica;
    size_t n, points;      /* strengths in all, and per interface */
    double *strength;      /* [n] Pa: k = interface*points + Gauss point */
    double (*position)[3]; /* [n] m, at the start */
    double error;          /* fracas_field_error */
    fracas_extent extent;  /* mean extent per strength */
} fracas_sample;

/* The strengths of replica `replica` >= 0 at a point, bit for bit those of a run, also for replicas
 * beyond the campaign's. `campaign` must outlive the sample. FRACAS_USAGE for an unknown point or
 * conflicting parameters; FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sample_draw(const fracas_campaign *campaign, size_t point,
                                              int64_t replica, fracas_sample *sample);
void fracas_sample_clear(fracas_sample *sample); /* all zero is allowed */

/* How the files begin. */
#define FRACAS_SAMPLE_CSV "interface,gauss_point,x_m,y_m,z_m,strength_Pa\n"
#define FRACAS_SAMPLE_VTK "# vtk DataFile Version 3.0\nfracas: strengths of "

/* One line a strength: interface, Gauss point, x, y, z [m], strength [Pa] with 17 digits, enough
 * for the same bits. */
void fracas_sample_write_csv(const fracas_sample *sample, FILE *out);

/* Legacy VTK, ASCII, for ParaView: one cell a strength, with the cell data `strength` [Pa]. An
 * interface of a surface is the line of its edge; an interface of a chain, and a Gauss point, is a
 * vertex. */
void fracas_sample_write_vtk(const fracas_sample *sample, FILE *out);

/* Prints number, mean, standard deviation (with n - 1), quantiles, and the weakest with its place;
 * as JSON with `json`. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sample_summarize(const fracas_sample *sample, bool json,
                                                   FILE *out);

#endif
