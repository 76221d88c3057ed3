/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sums of a surface over its blocks of elements. */
#include "engine/formulation/surface/surface.h"

#include "engine/loading/loading.h"

#include <math.h>

double fracas_surface_spin(const fracas_surface_constants *c, double time)
{
    const double share = c->ramp > 0 ? fmax(0.0, fmin(1.0, time / c->ramp)) : 1.0,
                 w = c->speed * share;
    return w * w;
}

double fracas_surface_path(const fracas_surface_constants *c, int motion, double time)
{
    const fracas_loading *loading = c->moving[motion];
    const fracas_loading_traits *traits = loading->type->traits;
    return traits->load->path(loading, &c->tables->history[c->tables->motion[motion]], time);
}

/* Adds blocks of `size` sums in pairs, pairs of pairs, ...: the first one holds them all then. */
static void add_blocks(double *sums, size_t blocks, size_t size)
{
    for (size_t apart = 1; apart < blocks; apart *= 2)
        for (size_t b = 0; b + apart < blocks; b += 2 * apart)
            for (size_t i = 0; i < size; i++) sums[b * size + i] += sums[(b + apart) * size + i];
}

/* Work of the body force since the step before [J]: exactly the mean of the forces of both steps
 * times the change of displacements. */
static double work_of(const fracas_surface_constants *c, const fracas_step *step, int l,
                      double moment)
{
    const double before = fracas_surface_spin(c, step->time[l] - step->drift[l]);
    return step->drift[l] * 0.5 * (before + step->spin[l]) * moment;
}

/* Work of moved nodes since the step before [J], by the mean of their forces  (loads.8) */
static double work_of_motions(const fracas_surface_constants *c, fracas_step *step, int l,
                              const double *force)
{
    double work = 0;
    for (int m = 0; m < c->tables->motions; m++) {
        const double before = fracas_surface_path(c, m, step->time[l] - step->drift[l]);
        work += 0.5 * (step->driven[m][l] + force[m]) * (step->path[m][l] - before);
        step->driven[m][l] = force[m];
    }
    return work;
}

/* (membrane.8), (shell.11) */
static void set_totals(const fracas_surface_constants *c, fracas_step *step, int l,
                       const double sum[SURFACE_SUMS])
{
    step->kinetic[l] = 0.5 * sum[SURFACE_KINETIC];
    step->elastic[l] = 0.5 * (sum[SURFACE_STRAIN] + (sum[SURFACE_FLUX] + sum[SURFACE_RIMS]));
    step->cohesive[l] = 0.5 * sum[SURFACE_STORED];
    step->dissipated[l] = sum[SURFACE_DISSIPATED];
    step->dissipated_bending[l] += sum[SURFACE_BENDING];
    step->created[l] += sum[SURFACE_CREATED];
    step->friction[l] += sum[SURFACE_RUBBED];
    step->damped[l] += sum[SURFACE_DAMPED];
    step->power[l] = sum[SURFACE_POWER];
    step->work[l] = sum[SURFACE_WORK]; /* (loads.10) */
    if (c->tables->position) step->work[l] += work_of(c, step, l, sum[SURFACE_MOMENT]);
    if (!c->tables->moved) return;
    step->power[l] = 0;
    step->work[l] += work_of_motions(c, step, l, sum + SURFACE_POWER);
}

void fracas_surface_totals(const fracas_surface_constants *c, fracas_step *step)
{
    const fracas_surface_division *division = step->division.plan;
    for (int first = 0; first < step->width; first += step->lanes) {
        double *sums = fracas_surface_field(step, division->sums, first);
        add_blocks(sums, fracas_surface_blocks(c->tables), (size_t)(SURFACE_SUMS * step->lanes));
        for (int l = 0; l < step->lanes; l++) {
            double sum[SURFACE_SUMS];
            for (int s = 0; s < SURFACE_SUMS; s++) sum[s] = sums[s * step->lanes + l];
            set_totals(c, step, first + l, sum);
        }
    }
}
