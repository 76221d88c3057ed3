/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/loading/traits.h"

#include "engine/loading/loading.h"

#include <math.h>

static bool is_radial(const fracas_spec *spec)
{
    return spec->loading.direction == &fracas_axis_radial;
}

/* Mass of a chain per length [kg/m]. */
static double mass_of(const fracas_spec *spec)
{
    return spec->material.density * spec->geometry.area;
}

static fracas_ring_drive rate_ring(const fracas_spec *spec, double t)
{
    return (fracas_ring_drive){.stress = spec->material.young * spec->loading.rate * t};
}

/* A free ring comes to E v/c and swings back (docs/theory/ring.md). */
static fracas_ring_drive velocity_ring(const fracas_spec *spec, double t)
{
    const double young = spec->material.young, radius = spec->geometry.radius,
                 speed = sqrt(young / spec->material.density);
    return (fracas_ring_drive){
        .stress = young * fabs(spec->loading.radial) / radius * fmin(t, radius / speed),
        .along = spec->loading.circumferential};
}

static double velocity_path(const fracas_spec *spec, double t)
{
    return spec->loading.circumferential * t;
}

static bool velocity_folds(const fracas_spec *spec, bool whole, double turn)
{
    const fracas_loading *loading = &spec->loading;
    if (loading->circumferential != 0) return false;
    return loading->radial < 0 || (whole && loading->radial > 0 && spec->time.end > 2 * turn);
}

static fracas_ring_drive held_ring(const fracas_spec *spec, double t)
{
    const double v = spec->loading.velocity, a = spec->loading.acceleration;
    if (!is_radial(spec)) return (fracas_ring_drive){.along = fmax(fabs(v), fabs(v + a * t))};
    return (fracas_ring_drive){.stress = spec->material.young * t / spec->geometry.radius *
                                         (v + 0.5 * t * fmax(0, a))};
}

static double held_path(const fracas_spec *spec, double t)
{
    const fracas_loading *loading = &spec->loading;
    return is_radial(spec) ? 0 : (loading->velocity + 0.5 * loading->acceleration * t) * t;
}

static fracas_ring_drive force_ring(const fracas_spec *spec, double t)
{
    const double f = spec->loading.force, rate = spec->loading.force_rate, mass = mass_of(spec);
    if (is_radial(spec))
        return (fracas_ring_drive){.outward = fmax(fabs(f), fabs(f + rate * t)) / mass};
    return (fracas_ring_drive){.along = t * (fabs(f) + 0.5 * t * fabs(rate)) / mass};
}

static double force_path(const fracas_spec *spec, double t)
{
    const fracas_loading *loading = &spec->loading;
    if (is_radial(spec)) return 0;
    return (0.5 * loading->force + loading->force_rate * t / 6) * t * t / mass_of(spec);
}

static bool force_folds(const fracas_spec *spec, bool whole, double turn)
{
    const fracas_loading *loading = &spec->loading;
    (void)whole, (void)turn;
    return is_radial(spec) &&
           fmin(loading->force, loading->force + loading->force_rate * spec->time.end) < 0;
}

static fracas_stretch expansion_surface(const fracas_spec *spec, double t)
{
    const fracas_loading *loading = &spec->loading;
    return (fracas_stretch){.strain = fabs(loading->rate) * t,
                            .ratio = loading->ratio,
                            .moving = true,
                            .shock = loading->start != &fracas_start_moving};
}

static fracas_stretch centrifugal_surface(const fracas_spec *spec, double t)
{
    const double speed = spec->loading.speed;
    return (fracas_stretch){.strain = 0.5 * speed * speed * t * t, .ratio = 1};
}

static const struct {
    const fracas_kind *type;
    fracas_loading_traits traits;
} table[] = {
    {&fracas_loading_imposed_rate, {.ring = rate_ring}},
    {&fracas_loading_initial_velocity,
     {.ring = velocity_ring, .path = velocity_path, .folds = velocity_folds, .released = true}},
    {&fracas_loading_held_velocity, {.ring = held_ring, .path = held_path}},
    {&fracas_loading_force, {.ring = force_ring, .path = force_path, .folds = force_folds}},
    {&fracas_loading_expansion, {.surface = expansion_surface}},
    {&fracas_loading_centrifugal, {.surface = centrifugal_surface}},
};

const fracas_loading_traits *fracas_loading_traits_of(const fracas_spec *spec)
{
    size_t i = 0;
    while (table[i].type != spec->loading.type) i++;
    return &table[i].traits;
}
