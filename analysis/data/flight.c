/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/flight.h"

#include "analysis/data/chain.h"
#include "analysis/data/columns.h"
#include "base/own.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- the fragments of the end ---- */

static const double *node_of(const fracas_flight *flight, size_t e, size_t corner)
{
    return flight->mesh.node[flight->mesh.element[e].node[corner]].position;
}

/* A rule of degree 5 (Radon): area coordinates of a point, and its weight. */
typedef struct {
    double at[3], weight;
} spot;

enum { SPOTS = 7 };
static const spot rule[SPOTS] = {
    {{1.0 / 3, 1.0 / 3, 1.0 / 3}, 0.225},
    {{0.79742698535308731, 0.10128650732345633, 0.10128650732345633}, 0.12593918054482717},
    {{0.10128650732345633, 0.79742698535308731, 0.10128650732345633}, 0.12593918054482717},
    {{0.10128650732345633, 0.10128650732345633, 0.79742698535308731}, 0.12593918054482717},
    {{0.059715871789769892, 0.47014206410511505, 0.47014206410511505}, 0.13239415278850616},
    {{0.47014206410511505, 0.059715871789769892, 0.47014206410511505}, 0.13239415278850616},
    {{0.47014206410511505, 0.47014206410511505, 0.059715871789769892}, 0.13239415278850616},
};

/* Shape functions and place at a spot of a triangle, and its derivatives along the second and third
 * coordinate. */
static void place_at(const fracas_flight *flight, size_t e, const double l[3], double value[6],
                     double x[3], double along[2][3])
{
    double slope[2][6] = {{-1, 1, 0}, {-1, 0, 1}};
    memcpy(value, l, 3 * sizeof *l);
    if (flight->corners == 6)
        for (int k = 0; k < 3; k++) { /* vertices, then the middles from k to k + 1 */
            const int next = (k + 1) % 3;
            for (int d = 0; d < 2; d++) {
                const double of[3] = {-1, d == 0, d == 1};
                slope[d][k] = (4 * l[k] - 1) * of[k];
                slope[d][3 + k] = 4 * (of[k] * l[next] + l[k] * of[next]);
            }
            value[k] = l[k] * (2 * l[k] - 1);
            value[3 + k] = 4 * l[k] * l[next];
        }
    memset(x, 0, 3 * sizeof *x);
    memset(along, 0, 2 * sizeof *along);
    for (size_t k = 0; k < flight->corners; k++)
        for (int i = 0; i < 3; i++) {
            const double node = node_of(flight, e, k)[i];
            x[i] += value[k] * node;
            for (int d = 0; d < 2; d++) along[d][i] += slope[d][k] * node;
        }
}

static void cross(const double a[3], const double b[3], double c[3])
{
    for (int i = 0; i < 3; i++)
        c[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double length_of(const double v[3])
{
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* Masses of nodes of an element of a shell, as of one with the density 1: each in proportion to its
 * own, int N_k^2 dA. Those of flat bodies are coupled: their sums are integrals. */
static void add_lumped(const fracas_flight *flight, size_t e, double *whole, double sum[3])
{
    double own[6] = {0}, all = 0, area = 0;
    for (int s = 0; s < SPOTS; s++) {
        double x[3], along[2][3], normal[3], value[6];
        place_at(flight, e, rule[s].at, value, x, along);
        cross(along[0], along[1], normal);
        const double part = rule[s].weight * length_of(normal) / 2;
        area += part;
        for (size_t k = 0; k < flight->corners; k++) own[k] += part * value[k] * value[k];
    }
    for (size_t k = 0; k < flight->corners; k++) all += own[k];
    *whole += area;
    for (size_t k = 0; k < flight->corners; k++)
        for (int i = 0; i < 3; i++) sum[i] += area * own[k] / all * node_of(flight, e, k)[i];
}

/* Adds the integrals of 1 and of the place over an element. */
static void integrate(const fracas_flight *flight, size_t e, double *whole, double sum[3])
{
    if (!flight->flat) {
        add_lumped(flight, e, whole, sum);
        return;
    }
    if (flight->corners == 2) {
        const double *a = node_of(flight, e, 0), *b = node_of(flight, e, 1);
        const double length = length_of((double[3]){b[0] - a[0], b[1] - a[1], b[2] - a[2]});
        *whole += length;
        for (int i = 0; i < 3; i++) sum[i] += length * (a[i] + b[i]) / 2;
        return;
    }
    for (int k = 0; k < SPOTS; k++) {
        double x[3], along[2][3], normal[3], value[6];
        place_at(flight, e, rule[k].at, value, x, along);
        cross(along[0], along[1], normal);
        const double area = rule[k].weight * length_of(normal) / 2;
        *whole += area;
        for (int i = 0; i < 3; i++) sum[i] += area * x[i];
    }
}

/* A fragment may go through the seam of a bar with periodic ends. */
static void find_seam(fracas_flight *flight)
{
    const uint32_t *of = flight->piece_of;
    if (!(flight->period > 0) || flight->record.nfragment < 2) return;
    while (of[flight->mesh.nelements - 1] == 0 && of[flight->head] == 0) flight->head++;
}

/* Its place is behind the end of the bar, or in front of the start: puts it behind. */
static void put_behind(fracas_flight *flight)
{
    fracas_fragment *f = &flight->record.fragment[0];
    if (flight->head == 0 || f->position[0] > flight->piece[0].centre[0] - flight->period / 2)
        return;
    f->position[0] += flight->period * (1 + flight->rate * flight->record.end_time);
    f->velocity[0] += flight->period * flight->rate;
}

static fracas_err find_centres(fracas_flight *flight)
{
    OWNED double *whole = calloc(flight->record.nfragment + 1, sizeof *whole);
    if (!whole) return fracas_no_memory("the fragments of a realization");
    for (size_t e = 0; e < flight->mesh.nelements; e++) {
        const size_t f = flight->piece_of[e];
        const double before = whole[f];
        integrate(flight, e, &whole[f], flight->piece[f].centre);
        if (e < flight->head) flight->piece[f].centre[0] += flight->period * (whole[f] - before);
    }
    for (size_t f = 0; f < flight->record.nfragment; f++)
        for (int i = 0; i < 3; i++) flight->piece[f].centre[i] /= whole[f];
    return FRACAS_OK;
}

/* A fragment through the seam has unknown parts at both ends of the bar, by which all nodes may be
 * off. The peculiar motion has no momentum: sum m (X - C) = rate T sum m C. */
static void shift_along(fracas_flight *flight)
{
    const double grown = flight->rate * flight->record.end_time;
    double sum = 0, mass = 0;
    if (flight->head == 0) return;
    for (size_t f = 0; f < flight->record.nfragment; f++) {
        const fracas_fragment *end = &flight->record.fragment[f];
        mass += end->mass;
        sum += end->mass * (end->position[0] - (1 + grown) * flight->piece[f].centre[0]);
    }
    const double shift = sum / (mass * (1 + grown));
    if (fabs(shift) < 1e-9 * flight->period) return; /* rounding of equal elements */
    for (size_t f = 0; f < flight->record.nfragment; f++) flight->piece[f].centre[0] += shift;
    for (size_t k = 0; k < flight->mesh.nnodes; k++) flight->mesh.node[k].position[0] += shift;
}

/* Adds a fragment to the second moments C and the angular momentum L about `centre`. */
static void add_turning(const fracas_fragment *f, const double centre[3], const double velocity[3],
                        double C[9], double L[3])
{
    double r[3], v[3], own[3];
    for (int i = 0; i < 3; i++) {
        r[i] = f->position[i] - centre[i];
        v[i] = f->velocity[i] - velocity[i];
    }
    cross(r, v, own);
    for (int i = 0; i < 3; i++) {
        L[i] += f->mass * own[i] + f->angular_momentum[i];
        for (int j = 0; j < 3; j++) {
            C[3 * i + j] += f->mass * r[i] * r[j];
            for (int a = 0; a < 3 && isfinite(f->semi_axis[a]); a++) /* older studies have none */
                C[3 * i + j] += f->mass * f->semi_axis[a] * f->semi_axis[a] / 5 * f->axis[a][i] *
                                f->axis[a][j];
        }
    }
}

/* flight->turn: sum over the principal axes a of all fragments together of a (a . L)/I_a, as
 * (fragments.4). */
static fracas_err find_turn(fracas_flight *flight)
{
    const fracas_record *record = &flight->record;
    double mass = 0, centre[3] = {0}, velocity[3] = {0}, C[9] = {0}, L[3] = {0}, values[3], axes[9];
    for (size_t f = 0; f < record->nfragment; f++) {
        mass += record->fragment[f].mass;
        for (int i = 0; i < 3; i++) {
            centre[i] += record->fragment[f].mass * record->fragment[f].position[i];
            velocity[i] += record->fragment[f].mass * record->fragment[f].velocity[i];
        }
    }
    for (int i = 0; i < 3; i++) {
        centre[i] /= mass;
        velocity[i] /= mass;
    }
    for (size_t f = 0; f < record->nfragment; f++)
        add_turning(&record->fragment[f], centre, velocity, C, L);
    const double trace = C[0] + C[4] + C[8];
    gsl_eigen_symmv_workspace *work = gsl_eigen_symmv_alloc(3);
    if (!work) return fracas_no_memory("the fragments of a realization");
    gsl_matrix_view m = gsl_matrix_view_array(C, 3, 3), vectors = gsl_matrix_view_array(axes, 3, 3);
    gsl_vector_view roots = gsl_vector_view_array(values, 3);
    gsl_eigen_symmv(&m.matrix, &roots.vector, &vectors.matrix, work);
    gsl_eigen_symmv_free(work);
    for (int a = 0; a < 3; a++) {
        const double along = axes[a] * L[0] + axes[3 + a] * L[1] + axes[6 + a] * L[2];
        if (!(trace - values[a] > 1e-9 * trace)) continue; /* a bar about itself */
        for (int i = 0; i < 3; i++)
            flight->turn[i] += axes[3 * i + a] * along / (trace - values[a]);
    }
    return FRACAS_OK;
}

/* Where the centroid of a fragment is at its last break is between its places at the start and at
 * the end, unless it has been pushed since: then it moves evenly from the start. */
static void find_paths(fracas_flight *flight)
{
    for (size_t f = 0; f < flight->record.nfragment; f++) {
        fracas_flight_piece *piece = &flight->piece[f];
        const fracas_fragment *end = &flight->record.fragment[f];
        const double left = flight->record.end_time - piece->loose;
        double then[3], moved[3];
        for (int i = 0; i < 3; i++) {
            moved[i] = end->position[i] - piece->centre[i];
            then[i] = moved[i] - end->velocity[i] * left;
        }
        piece->even = !(piece->loose > 0) || length_of(then) > length_of(moved);
    }
}

static void find_loose(fracas_flight *flight)
{
    const fracas_record *record = &flight->record;
    for (size_t f = 0; f < record->nfragment; f++) flight->piece[f].loose = NAN;
    for (size_t i = 0; i < flight->mesh.ninterfaces; i++) {
        const int64_t *element = flight->mesh.interface[i].element;
        const uint32_t a = flight->piece_of[element[0]], b = flight->piece_of[element[1]];
        if (a == b) continue;
        flight->piece[a].loose = fmax(flight->piece[a].loose, record->interface[i].break_time);
        flight->piece[b].loose = fmax(flight->piece[b].loose, record->interface[i].break_time);
    }
    for (size_t f = 0; f < record->nfragment; f++)
        if (isnan(flight->piece[f].loose)) flight->piece[f].loose = record->end_time;
}

fracas_err fracas_flight_check(const fracas_record *record)
{
    double sum = 0;
    for (size_t f = 0; f < record->nfragment; f++)
        for (int i = 0; i < 3; i++)
            sum += record->fragment[f].position[i] + record->fragment[f].velocity[i] +
                   record->fragment[f].spin[i] + record->fragment[f].angular_momentum[i];
    if (isfinite(sum)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "places or velocities of fragments are no numbers, as where it "
                       "ended NONFINITE: choose another realization");
}

static fracas_err find_pieces(fracas_flight *flight)
{
    FRACAS_CLEARED(fracas_surface_state) end = {0};
    const fracas_record *record = &flight->record;
    TRY(fracas_flight_check(record));
    TRY(fracas_surface_state_create(&flight->mesh, record, INFINITY, &end));
    bool same = end.nfragments == record->nfragment;
    for (size_t f = 0; same && f < end.nfragments; f++)
        same = end.elements[f] == (size_t)record->fragment[f].elements;
    if (!same)
        return fracas_fail(FRACAS_DAMAGED,
                           "the %zu fragments of a realization are not those between its broken "
                           "interfaces; `fracas verify` checks the study",
                           record->nfragment);
    flight->piece_of = end.fragment;
    end.fragment = NULL;
    flight->piece = calloc(record->nfragment + 1, sizeof *flight->piece);
    if (!flight->piece) return fracas_no_memory("the fragments of a realization");
    find_seam(flight);
    TRY(find_centres(flight));
    put_behind(flight);
    shift_along(flight);
    find_loose(flight);
    find_paths(flight);
    return find_turn(flight);
}

static fracas_err place_chain(const fracas_point_table *table, size_t point, fracas_flight *flight)
{
    const bool ring = fracas_columns_real(table, point, "derived.radius") > 0;
    TRY(fracas_chain_mesh(&flight->record, ring, &flight->mesh));
    const fracas_stored_mesh *mesh = &flight->mesh;
    if (ring || mesh->ninterfaces < mesh->nelements) return FRACAS_OK;
    flight->period = mesh->node[mesh->nelements].position[0];
    flight->rate = fracas_columns_real(table, point, "derived.strain_rate");
    return FRACAS_OK;
}

fracas_err fracas_flight_read(fracas_results *results, size_t point, size_t row,
                              fracas_flight *flight)
{
    size_t of;
    int64_t replica;
    *flight = (fracas_flight){0};
    fracas_record_init(&flight->record);
    TRY(fracas_results_mesh(results, point, &flight->mesh));
    TRY(fracas_results_record(results, row, FRACAS_READ_INTERFACES | FRACAS_READ_FRAGMENTS, &of,
                              &replica, &flight->record));
    if (flight->record.ninterface == 0) {
        flight->mesh.nelements = 0;
        return FRACAS_OK;
    }
    flight->corners = 2;
    flight->ends = 1;
    if (flight->mesh.nelements > 0) {
        flight->corners = flight->mesh.element[0].node[3] >= 0 ? 6 : 3;
        flight->ends = flight->corners == 6 ? 3 : 2;
    } else TRY(place_chain(fracas_results_points(results), point, flight));
    flight->flat = true;
    for (size_t k = 0; k < flight->mesh.nnodes; k++)
        if (flight->mesh.node[k].position[2] != flight->mesh.node[0].position[2])
            flight->flat = false;
    return find_pieces(flight);
}

void fracas_flight_clear(fracas_flight *flight)
{
    fracas_stored_mesh_clear(&flight->mesh);
    fracas_record_clear(&flight->record);
    free(flight->piece_of);
    free(flight->piece);
    *flight = (fracas_flight){0};
}

/* ---- a time ---- */

/* v turned by the vector `turn` [rad]: Rodrigues' formula. */
static void rotate(const double turn[3], double v[3])
{
    const double angle = length_of(turn);
    if (!(angle > 0)) return;
    const double c = cos(angle), s = sin(angle),
                 axis[3] = {turn[0] / angle, turn[1] / angle, turn[2] / angle};
    const double along = axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2];
    double across[3];
    cross(axis, v, across);
    for (int i = 0; i < 3; i++) v[i] = c * v[i] + s * across[i] + (1 - c) * along * axis[i];
}

/* How far the centroid of a fragment has moved, and its velocity. */
static void follow(const fracas_flight *flight, size_t f, double time, double moved[3],
                   double velocity[3])
{
    const fracas_flight_piece *piece = &flight->piece[f];
    const fracas_fragment *end = &flight->record.fragment[f];
    const double last = flight->record.end_time, turn = piece->even ? last : piece->loose,
                 then = fmax(time, turn);
    for (int i = 0; i < 3; i++) {
        moved[i] = end->position[i] - end->velocity[i] * (last - then) - piece->centre[i];
        velocity[i] = time < turn ? moved[i] / turn : end->velocity[i];
        if (time < turn) moved[i] *= time / turn;
    }
}

/* How a node of a fragment has moved, and its velocity  (fragments.10): it turns as the whole body,
 * then as the fragment. */
static void move(const fracas_flight *flight, size_t f, double time, const double from[3],
                 double displacement[3], double velocity[3])
{
    const fracas_flight_piece *piece = &flight->piece[f];
    const bool alone = time >= piece->loose;
    const double *spin = alone ? flight->record.fragment[f].spin : flight->turn;
    double arm[3], turned[3], before[3], since[3], moved[3], speed[3];
    for (int i = 0; i < 3; i++) {
        turned[i] = arm[i] = from[i] - piece->centre[i];
        before[i] = flight->turn[i] * fmin(time, piece->loose);
        since[i] = alone ? spin[i] * (time - piece->loose) : 0;
    }
    rotate(before, turned);
    rotate(since, turned);
    cross(spin, turned, velocity);
    follow(flight, f, time, moved, speed);
    for (int i = 0; i < 3; i++) {
        displacement[i] = moved[i] + (turned[i] - arm[i]);
        velocity[i] += speed[i];
    }
}

static fracas_err weigh(const fracas_flight *flight, fracas_flight_instant *now)
{
    OWNED bool *seen = calloc(flight->record.nfragment + 1, sizeof *seen);
    now->mass = calloc(now->state.nfragments + 1, sizeof *now->mass);
    if (!seen || !now->mass) return fracas_no_memory("the fragments of a realization");
    for (size_t e = 0; e < flight->mesh.nelements; e++) {
        const size_t f = flight->piece_of[e];
        if (!seen[f]) now->mass[now->state.fragment[e]] += flight->record.fragment[f].mass;
        seen[f] = true;
    }
    return FRACAS_OK;
}

fracas_err fracas_flight_at(const fracas_flight *flight, double time, fracas_flight_instant *now)
{
    const size_t corners = flight->corners, nodes = flight->mesh.nelements * corners;
    *now = (fracas_flight_instant){0};
    TRY(fracas_surface_state_create(&flight->mesh, &flight->record, time, &now->state));
    TRY(weigh(flight, now));
    now->place = malloc((nodes + 1) * sizeof *now->place);
    now->displacement = malloc((nodes + 1) * sizeof *now->displacement);
    now->velocity = malloc((nodes + 1) * sizeof *now->velocity);
    if (!now->place || !now->displacement || !now->velocity)
        return fracas_no_memory("a realization as it moves");
    for (size_t k = 0; k < nodes; k++) {
        const double *from = node_of(flight, k / corners, k % corners);
        move(flight, flight->piece_of[k / corners], time, from, now->displacement[k],
             now->velocity[k]);
        if (k / corners < flight->head) {
            now->displacement[k][0] -= flight->period * flight->rate * time;
            now->velocity[k][0] -= flight->period * flight->rate;
        }
        for (int i = 0; i < 3; i++) now->place[k][i] = from[i] + now->displacement[k][i];
    }
    return FRACAS_OK;
}

void fracas_flight_instant_clear(fracas_flight_instant *now)
{
    fracas_surface_state_clear(&now->state);
    free(now->mass);
    free(now->place);
    free(now->displacement);
    free(now->velocity);
    *now = (fracas_flight_instant){0};
}

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

fracas_err fracas_flight_moments(const fracas_flight *flight, double *time, size_t count)
{
    size_t shares = (count + 1) / 2;
    TRY(fracas_surface_moments(&flight->record, time, &shares));
    const size_t even = count - shares; /* the end is among the shares */
    for (size_t k = 0; k < even; k++)
        time[shares + k] = flight->record.end_time * (double)k / (double)even;
    qsort(time, count, sizeof *time, by_value);
    return FRACAS_OK;
}
