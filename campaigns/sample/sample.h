/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The strength field of one realization, drawn as a run would draw it: what `fracas sample` shows.
 */
#ifndef FRACAS_CAMPAIGNS_SAMPLE_SAMPLE_H
#define FRACAS_CAMPAIGNS_SAMPLE_SAMPLE_H

#include "campaigns/campaign.h"
#include "engine/engine.h"

#include <stdio.h>

typedef struct {
    const fracas_campaign *campaign;
    size_t point;
    int64_t replica;
    fracas_model *model;
    size_t n, points;      /* strengths; of each interface */
    double *strength;      /* [n] Pa: k = interface*points + Gauss point */
    double (*position)[3]; /* [n] m, at the start */
    double error;          /* fracas_field_error */
    fracas_extent extent;  /* what a strength stands for, on average */
} fracas_sample;

/* The strengths of replica `replica` >= 0 at a point: the values that a run gives its kernel, to
 * the last bit. Replicas that the campaign does not ask for have theirs too. `campaign` must
 * outlive the sample. FRACAS_USAGE for a point that there is not, or if its parameters do not go
 * together; FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sample_draw(const fracas_campaign *campaign, size_t point,
                                              int64_t replica, fracas_sample *sample);
void fracas_sample_clear(fracas_sample *sample); /* all zero is allowed */

/* One line a strength: interface, Gauss point, x, y, z [m], strength [Pa]; strengths with 17
 * digits, which read back to the same bits. */
void fracas_sample_write_csv(const fracas_sample *sample, FILE *out);

/* Legacy VTK, ASCII, for ParaView: a cell a strength, with the cell data `strength` [Pa]; an
 * interface of a surface is the line of its edge, one of a chain, and a Gauss point, a vertex. */
void fracas_sample_write_vtk(const fracas_sample *sample, FILE *out);

/* What there is to say of it: how many, mean, standard deviation (with n - 1), quantiles, the
 * weakest and where it is; as JSON with `json`. FRACAS_ENVIRONMENT without memory. */
FRACAS_MUST_USE fracas_err fracas_sample_summarize(const fracas_sample *sample, bool json,
                                                   FILE *out);

#endif
