/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/bounds.h"

#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/notch.h"

#include <math.h>

static double wave_speed(const fracas_spec *spec)
{
    return sqrt(spec->material.young / spec->material.density);
}

/* Upper bound of the stress in an uncracked chain until t [Pa]. Radially u'' + w^2 u = a with w =
 * c/R and sigma = E u/R (docs/theory/ring.md):
 *
 *   radial velocity v            min(E v t/R, E v/c)
 *   radial acceleration <= a     min(E a t^2/(2 R), 2 R rho a)
 *   circumferential velocity v   the same with a = v^2/R */
static double chain_stress_bound(const fracas_spec *spec, double t)
{
    const fracas_ring_maxima drive = fracas_loading_traits_of(spec)->ring(spec, t);
    const double radius = spec->geometry.radius;
    if (drive.outward == 0 && drive.along == 0) return drive.stress;
    return drive.stress +
           fmin(spec->material.young * t * t / (2 * radius), 2 * radius * spec->material.density) *
               (drive.outward + drive.along * drive.along / radius);
}

/* How the edges of a surface are held. */
typedef struct {
    bool any;     /* one is held */
    bool against; /* ... against the motion */
    bool corners; /* a free edge may meet a held one, whose corner concentrates stress */
} holding;

static holding holding_of(const fracas_spec *spec, const fracas_stretch *stretch)
{
    holding of = {0};
    bool fast = false, released = false;
    for (int tag = fracas_shape_of(spec)->from_file ? 0 : 1; tag < FRACAS_EDGES; tag++) {
        if (!spec->geometry.edge[tag] || fracas_shape_edge(spec, tag)) continue;
        const fracas_edge *edge = fracas_edge_of(spec->geometry.edge[tag]);
        const bool held = fracas_edge_is_held(edge);
        of.any = of.any || held;
        of.against = of.against || (held && !(edge->moving && stretch->moving));
        fast = fast || (held && !edge->plane);
        released = released || !held;
    }
    of.corners = fast && released;
    return of;
}

/* Largest stress by that of a body which stretches evenly. Where edges of an annulus are free, a
 * hole's is below 4 for any ratio. In a mesh of elements h a notch as long as the body L has less
 * than 3 sqrt(L/h). */
static double concentration_of(const fracas_spec *spec, const holding *held, double ratio,
                               const fracas_body_size *size)
{
    const fracas_shape *shape = fracas_shape_of(spec);
    const double notch = fmax(10, 3 * sqrt(size->extent / size->element));
    if (shape->from_file || held->corners || held->against || fracas_notch_has_line(&spec->notch))
        return notch;
    if (shape->even) return 1;
    return shape->concentration ? shape->concentration(ratio) : 4;
}

/* The ratio of the sides' strains farthest from 1. */
static double ratio_of(const fracas_stretch *stretch)
{
    const bool along_z = fabs(stretch->ratio_z - 1) > fabs(stretch->ratio - 1); /* NaN: no */
    return along_z ? stretch->ratio_z : stretch->ratio;
}

/* Largest strain along x of a surface until t. Edges held against the motion, and those that start
 * it, send a shock v/c with v = d strain/dt L/2, doubled where it is reflected. A free body swings
 * back, unless loads push on. */
static double strain_bound(const fracas_spec *spec, const fracas_stretch *stretch,
                           const holding *held, const fracas_body_size *size)
{
    const double t = spec->time.end, transit = size->extent / wave_speed(spec),
                 rate = fabs(fracas_spec_strain_rate(spec));
    double strain = stretch->strain;
    if (held->against || stretch->shock) return strain * (1 + 4 * transit / t);
    if (stretch->whole > 0) strain = fmin(strain, stretch->whole);
    if (held->any || isnan(rate) || !fracas_loading_is_alone(spec)) return strain;
    const fracas_shape *shape = fracas_shape_of(spec);
    const bool other_along_z = fabs(stretch->ratio_z - 1) > 0; /* NaN: no */
    if (shape->swing && other_along_z) return strain;
    return fmin(strain, rate * (shape->swing ? shape->swing(spec, stretch->ratio) : 4 * transit));
}

/* Largest of E' (a + nu b) and of the uniaxial stress over pairs of sides, by E'; E' = E/(1 - nu^2)
 * and strain along x 1. */
static double largest_of(const fracas_stretch *stretch, double nu)
{
    const double side[3] = {1, stretch->ratio, stretch->ratio_z};
    double largest = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < i; j++) {
            if (isnan(side[i])) continue;
            const double most = fmax(fabs(side[i]), fabs(side[j])) * (1 - nu * nu);
            largest = fmax(largest, fmax(most, fmax(fabs(side[j] + nu * side[i]),
                                                    fabs(nu * side[j] + side[i]))));
        }
    return largest;
}

/* Planes of symmetry, in which the shape holds its edges. */
static bool has_planes(const fracas_spec *spec)
{
    for (int tag = 1; tag < FRACAS_EDGES; tag++)
        if (fracas_shape_edge(spec, tag)) return true;
    return false;
}

/* A free body with one velocity has no stress. A strain without held edges swings back, and its
 * waves may meet. */
static double initial_stress_bound(const fracas_spec *spec, const holding *held, double factor)
{
    const fracas_initial *initial = &spec->initial;
    if (fracas_initial_moves(initial) &&
        (held->any || has_planes(spec) || fracas_initial_parts(initial)))
        return INFINITY;
    return 2 * factor * fracas_initial_stress(spec);
}

/* It stretches by (1, ratio) a with a = rate t or w^2 t^2/2; the bound is the larger stress along
 * its sides, E a/(1 - nu) for ratio 1. A free edge only relieves it. In any direction, traction and
 * shear/beta_c together are at most max(1, 1/beta_c) times the bound. A body that spins has at most
 * rho w^2 r^2, twice that if it starts at once. */
static double surface_stress_bound(const fracas_spec *spec, const fracas_body_size *size)
{
    const fracas_loading_traits *load = fracas_loading_traits_of(spec);
    const fracas_stretch stretch = fracas_loading_stretch(spec, spec->time.end);
    const holding held = holding_of(spec, &stretch);
    const double nu = spec->material.poisson,
                 factor = concentration_of(spec, &held, ratio_of(&stretch), size);
    const double largest = largest_of(&stretch, nu);
    double stress = factor * spec->material.young * strain_bound(spec, &stretch, &held, size) *
                    largest / (1 - nu * nu);
    if (load->body_force && fracas_loading_is_alone(spec)) {
        const double rim = spec->loading.speed * size->reach;
        stress = fmin(stress, 2 * spec->material.density * rim * rim * (held.any ? factor : 1));
    }
    return (stress + initial_stress_bound(spec, &held, factor)) *
           fmax(1.0, 1.0 / spec->cohesive.coupling);
}

double fracas_stress_bound(const fracas_spec *spec, const fracas_body_size *size)
{
    return fracas_spec_is_surface(spec) ? surface_stress_bound(spec, size)
                                        : chain_stress_bound(spec, spec->time.end);
}

/* c e t by the strain that a crack sets free and its waves: in a plate stretched both ways (1 + nu)
 * e, at sqrt(E/(rho (1 - nu^2))). */
static double surface_opening_bound(const fracas_spec *spec, double extent)
{
    const double t = spec->time.end, nu = spec->material.poisson;
    const fracas_stretch stretch = fracas_loading_stretch(spec, t);
    const double wave = wave_speed(spec) * t * (1 + nu) / sqrt(1 - nu * nu);
    const bool sudden = stretch.shock; /* edges open at their own velocity from the start */
    const double most = fmax(1, fmax(fabs(stretch.ratio), fabs(stretch.ratio_z))); /* not NaN */
    if (fracas_initial_moves(&spec->initial)) return INFINITY;
    /* a crack in a strained body opens by both faces from the start */
    return stretch.strain * most * (sudden ? extent : fmin(wave, extent)) +
           2 * fracas_initial_stress(spec) / spec->material.young * fmin(wave, extent);
}

double fracas_opening_bound(const fracas_spec *spec, double stress, double extent)
{
    if (fracas_spec_is_surface(spec)) return surface_opening_bound(spec, extent);
    const fracas_loading_traits *load = fracas_loading_traits_of(spec);
    const fracas_ring_maxima drive = load->ring(spec, spec->time.end);
    const double strain = stress / spec->material.young, wave = wave_speed(spec) * spec->time.end;
    const bool grows = drive.outward == 0 && drive.along == 0 && !load->released;
    return grows ? strain * fmin(wave, fracas_spec_length(spec)) : 2 * strain * wave;
}

/* ---- fragments ---- */

double fracas_grady_size(const fracas_spec *spec, double strength)
{
    const double rate = fracas_spec_strain_rate(spec);
    return cbrt(24 * fracas_spec_fracture_energy(spec, strength) /
                (spec->material.density * rate * rate));
}

double fracas_expected_transits(const fracas_spec *spec, double strength)
{
    const fracas_material *material = &spec->material;
    const double onset = strength / (material->young * fabs(fracas_spec_strain_rate(spec)));
    return (spec->time.end - onset) * wave_speed(spec) / fracas_grady_size(spec, strength);
}
