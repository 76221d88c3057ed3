/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fragments/fragments.h"

#include <math.h>
#include <stdlib.h>

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

/* (fragments.1) */
void fracas_fragment_sums_add(fracas_fragment_sums *sums, double mass, const double x[3],
                              const double v[3])
{
    double carried[3];
    begin_node(sums, x);
    for (int i = 0; i < 3; i++) {
        carried[i] = mass * (x[i] - sums->origin[i]);
        sums->momentum[i] += mass * v[i];
        sums->moment[i] += mass * cross(x, v, i);
    }
    add_mass(sums, mass, x, carried);
}

/* (fragments.1) */
void fracas_fragment_sums_add_coupled(fracas_fragment_sums *sums, double mass, const double x[3],
                                      const double carried[3], const double momentum[3])
{
    double from_origin[3];
    begin_node(sums, x);
    for (int i = 0; i < 3; i++) {
        from_origin[i] = carried[i] - mass * sums->origin[i];
        sums->momentum[i] += momentum[i];
        sums->moment[i] += cross(x, momentum, i);
    }
    add_mass(sums, mass, x, from_origin);
}

/* ---- the rigid body ---- */

enum { SWEEPS = 10 }; /* each squares the rest beside the diagonal: six are enough for 3 x 3 */

/* Jacobi's rotations: leaves the eigenvalues of the symmetric matrix a on its diagonal, their
 * directions in the columns of axis. */
static void find_axes(double a[3][3], double axis[3][3])
{
    for (int i = 0; i < 9; i++) axis[i / 3][i % 3] = i % 4 == 0;
    for (int turn = 0; turn < 3 * SWEEPS; turn++) {
        const int p = turn % 3, q = (p + 1) % 3;
        if (a[p][q] == 0) continue;
        const double slope = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const double tangent = (slope < 0 ? -1 : 1) / (fabs(slope) + sqrt(slope * slope + 1));
        const double cosine = 1 / sqrt(tangent * tangent + 1), sine = tangent * cosine;
        for (int k = 0; k < 3; k++) {
            const double left = a[k][p], right = a[k][q], first = axis[k][p], second = axis[k][q];
            a[k][p] = cosine * left - sine * right;
            a[k][q] = sine * left + cosine * right;
            axis[k][p] = cosine * first - sine * second;
            axis[k][q] = sine * first + cosine * second;
        }
        for (int k = 0; k < 3; k++) {
            const double left = a[p][k], right = a[q][k];
            a[p][k] = cosine * left - sine * right;
            a[q][k] = sine * left + cosine * right;
        }
        a[p][q] = a[q][p] = 0;
    }
}

/* Inertia about the centre of mass [kg m2]  (fragments.3) */
static void inertia_of(const fracas_fragment_sums *sums, const double centre[3],
                       double inertia[3][3])
{
    double second[6], arm[3];
    for (int i = 0; i < 3; i++) arm[i] = centre[i] - sums->origin[i];
    for (int s = 0; s < 6; s++)
        second[s] = sums->second[s] - sums->mass * arm[row_of[s]] * arm[column_of[s]];
    for (int s = 0; s < 6; s++) {
        const int i = row_of[s], j = column_of[s];
        inertia[i][j] = inertia[j][i] = i == j ? second[(i + 1) % 3] + second[(i + 2) % 3]
                                               : -second[s];
    }
}

/* Sums leave of an inertia 0 some 1e-16 of the largest, times the root of the number of nodes;
 * places rounded to 1e-16 |X| leave 1e-32 m X.X. */
static const double no_inertia = 1e-12;

/* (fragments.4) */
static void find_spin(const fracas_fragment_sums *sums, fracas_fragment *f)
{
    double inertia[3][3], axis[3][3], largest = 0, away = 0;
    inertia_of(sums, f->position, inertia);
    find_axes(inertia, axis);
    for (int a = 0; a < 3; a++) {
        largest = fmax(largest, inertia[a][a]);
        away += f->position[a] * f->position[a];
    }
    const double least = no_inertia * (largest + no_inertia * f->mass * away);
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
