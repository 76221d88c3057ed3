/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/fragments.h"

#include "engine/fragments/axes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static double cross(const double a[3], const double b[3], int i)
{
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    return a[j] * b[k] - a[k] * b[j];
}

/* Row and column of each of the six second moments. */
static const int row_of[6] = {0, 1, 2, 1, 2, 0}, column_of[6] = {0, 1, 2, 2, 0, 1};

/* Moments of mass. `carried` is sum of M_kl (x_l - origin). */
static void add_mass(fracas_fragment_sums *sums, double mass, const double x[3],
                     const double carried[3])
{
    double y[3];
    for (int i = 0; i < 3; i++) {
        y[i] = x[i] - sums->origin[i];
        sums->first[i] += mass * x[i];
    }
    for (int s = 0; s < 6; s++) {
        const int i = row_of[s], j = column_of[s];
        sums->second[s] += 0.5 * (y[i] * carried[j] + y[j] * carried[i]);
    }
    sums->mass += mass;
}

static void begin_node(fracas_fragment_sums *sums, const double x[3])
{
    for (int i = 0; i < 3 && sums->nodes == 0; i++) sums->origin[i] = x[i];
    sums->nodes++;
}

static void add_momentum(fracas_fragment_sums *sums, const double x[3], const double v[3],
                         const double momentum[3])
{
    for (int i = 0; i < 3; i++) {
        sums->momentum[i] += momentum[i];
        sums->kinetic += 0.5 * momentum[i] * v[i];
        for (int j = 0; j < 3; j++) sums->flow[i][j] += momentum[i] * (x[j] - sums->origin[j]);
    }
}

/* (fragments.1) */
void fracas_fragment_sums_add(fracas_fragment_sums *sums, double mass, const double x[3],
                              const double v[3])
{
    double carried[3], momentum[3];
    begin_node(sums, x);
    for (int i = 0; i < 3; i++) {
        carried[i] = mass * (x[i] - sums->origin[i]);
        momentum[i] = mass * v[i];
        sums->moment[i] += mass * cross(x, v, i);
    }
    add_momentum(sums, x, v, momentum);
    add_mass(sums, mass, x, carried);
}

/* (fragments.1) */
void fracas_fragment_sums_add_coupled(fracas_fragment_sums *sums, double mass, const double x[3],
                                      const double v[3], const double carried[3],
                                      const double momentum[3])
{
    double from_origin[3];
    begin_node(sums, x);
    for (int i = 0; i < 3; i++) {
        from_origin[i] = carried[i] - mass * sums->origin[i];
        sums->moment[i] += cross(x, momentum, i);
    }
    add_momentum(sums, x, v, momentum);
    add_mass(sums, mass, x, from_origin);
}

/* ---- the rigid body ---- */

/* Second moments about the centre of mass [kg m2]. */
static void second_moments_of(const fracas_fragment_sums *sums, const double centre[3],
                              double second[6])
{
    double arm[3];
    for (int i = 0; i < 3; i++) arm[i] = centre[i] - sums->origin[i];
    for (int s = 0; s < 6; s++)
        second[s] = sums->second[s] - sums->mass * arm[row_of[s]] * arm[column_of[s]];
}

/* Inertia about the centre of mass [kg m2]  (fragments.3) */
static void inertia_of(const fracas_fragment_sums *sums, const double centre[3],
                       double inertia[3][3])
{
    double second[6];
    second_moments_of(sums, centre, second);
    for (int s = 0; s < 6; s++) {
        const int i = row_of[s], j = column_of[s];
        inertia[i][j] = inertia[j][i] = i == j ? second[(i + 1) % 3] + second[(i + 2) % 3]
                                               : -second[s];
    }
}

/* Sums leave of an inertia 0 some 1e-16 of the largest, times the root of the number of nodes;
 * places rounded to 1e-16 |X| leave 1e-32 m X.X. */
static const double no_inertia = 1e-12;

/* The greatest moment on the diagonal to count as 0, of a fragment of this mass and place. */
static double least_moment(const double moment[3][3], double mass, const double centre[3])
{
    double largest = 0, away = 0;
    for (int a = 0; a < 3; a++) {
        largest = fmax(largest, moment[a][a]);
        away += centre[a] * centre[a];
    }
    return no_inertia * (largest + no_inertia * mass * away);
}

/* (fragments.4) */
static void find_spin(const fracas_fragment_sums *sums, fracas_fragment *f)
{
    double inertia[3][3], axis[3][3];
    inertia_of(sums, f->position, inertia);
    fracas_axes_find(inertia, axis);
    const double least = least_moment(inertia, f->mass, f->position);
    for (int a = 0; a < 3; a++) {
        if (inertia[a][a] <= least) continue;
        double along = 0;
        for (int i = 0; i < 3; i++) along += axis[i][a] * f->angular_momentum[i];
        for (int i = 0; i < 3; i++) f->spin[i] += axis[i][a] * (along / inertia[a][a]);
    }
}

/* (fragments.2) */
static fracas_fragment fragment_of(const fracas_fragment_sums *sums, int64_t dust)
{
    fracas_fragment f = {.mass = sums->mass,
                         .size = sums->size,
                         .elements = sums->elements,
                         .dust = sums->elements <= dust};
    for (int i = 0; i < 3; i++) {
        f.position[i] = sums->first[i] / sums->mass;
        f.velocity[i] = sums->momentum[i] / sums->mass;
    }
    for (int i = 0; i < 3; i++)
        f.angular_momentum[i] = sums->moment[i] - f.mass * cross(f.position, f.velocity, i);
    find_spin(sums, &f);
    return f;
}

/* ---- the homogeneous motion ---- */

/* Gradient of the best fit, C^-1 by its principal axes  (fragments.5) */
static void find_gradient(const fracas_fragment_sums *sums, fracas_fragment_motion *motion)
{
    double second[6], moment[3][3], axis[3][3], flow[3][3];
    second_moments_of(sums, motion->centre, second);
    for (int s = 0; s < 6; s++)
        moment[row_of[s]][column_of[s]] = moment[column_of[s]][row_of[s]] = second[s];
    fracas_axes_find(moment, axis);
    const double least = least_moment(moment, sums->mass, motion->centre);
    for (int i = 0; i < 9; i++) {
        const double arm = motion->centre[i % 3] - sums->origin[i % 3];
        flow[i / 3][i % 3] = sums->flow[i / 3][i % 3] - sums->momentum[i / 3] * arm;
    }
    for (int a = 0; a < 3; a++) {
        if (moment[a][a] <= least) continue;
        for (int i = 0; i < 3; i++) {
            double along = 0;
            for (int j = 0; j < 3; j++) along += flow[i][j] * axis[j][a];
            for (int j = 0; j < 3; j++)
                motion->gradient[i][j] += axis[j][a] * (along / moment[a][a]);
        }
    }
}

fracas_fragment_motion fracas_fragment_motion_of(const fracas_fragment_sums *sums,
                                                 fracas_motion kind)
{
    const fracas_fragment f = fragment_of(sums, 0);
    fracas_fragment_motion motion = {{0}};
    if (kind == FRACAS_MOTION_NONE) return motion;
    memcpy(motion.centre, f.position, sizeof motion.centre);
    memcpy(motion.velocity, f.velocity, sizeof motion.velocity);
    for (int i = 0; kind == FRACAS_MOTION_RIGID && i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        motion.gradient[k][j] = f.spin[i];
        motion.gradient[j][k] = -f.spin[i];
    }
    if (kind == FRACAS_MOTION_HOMOGENEOUS) find_gradient(sums, &motion);
    return motion;
}

void fracas_fragment_motion_take_off(const fracas_fragment_motion *motion, const double x[3],
                                     double v[3])
{
    for (int i = 0; i < 3; i++) {
        v[i] -= motion->velocity[i];
        for (int j = 0; j < 3; j++) v[i] -= motion->gradient[i][j] * (x[j] - motion->centre[j]);
    }
}

fracas_err fracas_fragments_take(const fracas_fragment_sums *sums, size_t count, int64_t dust,
                                 fracas_record *record)
{
    record->fragment = malloc((count ? count : 1) * sizeof *record->fragment);
    if (!record->fragment) return fracas_no_memory("the fragments of a realization");
    for (int i = 0; i < 3; i++) record->momentum[i] = 0;
    for (size_t f = 0; f < count; f++) {
        record->fragment[f] = fragment_of(&sums[f], dust);
        record->fragments_dust += record->fragment[f].dust;
        for (int i = 0; i < 3; i++) record->momentum[i] += sums[f].momentum[i];
    }
    record->nfragment = count;
    record->fragments = (int64_t)count;
    return FRACAS_OK;
}
