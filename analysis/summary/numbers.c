/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The numbers of one realization (analysis/data/numbers.h): value_KEY is NaN where it has none. */
#include "analysis/summary/numbers.h"

#include "analysis/data/ring.h"
#include "campaigns/store/summary.h"

#include <math.h>

#define NUMBER(id, si, text, ...)                   \
    {#id,                                           \
     si,                                            \
     text,                                          \
     .value = offsetof(fracas_replica_values, id),  \
     .mean = offsetof(fracas_point_statistics, id), \
     __VA_ARGS__},
const fracas_number fracas_realization_numbers[FRACAS_NNUMBERS] = {
    FRACAS_REALIZATION_NUMBERS(NUMBER)};

/* A usable realization. */
typedef struct {
    const fracas_point_statistics *point; /* its parameters */
    const fracas_record *record;          /* with fragments */
    fracas_ring_motion motion;            /* NaN of anything but rings */
    const fracas_fragment *largest;       /* by mass, the first of several; NULL: none */
    double mass;                          /* kg, of all fragments */
} realization;

static double value_count(const realization *of)
{
    return (double)of->record->fragments;
}

static double value_count_large(const realization *of)
{
    return (double)(of->record->fragments - of->record->fragments_dust);
}

static double value_size(const realization *of)
{
    return fracas_point_statistics_size(of->point, of->record->fragments,
                                        fracas_record_mean_size(of->record));
}

static double value_dissipated(const realization *of)
{
    return of->record->dissipated;
}

static double value_dissipated_bending(const realization *of)
{
    return of->record->dissipated_bending;
}

static double value_onset_time(const realization *of)
{
    return of->record->onset_time;
}

static double value_radial_velocity(const realization *of)
{
    return of->motion.radial;
}

static double value_radial_scatter(const realization *of)
{
    return of->motion.scatter;
}

static double value_circumferential_velocity(const realization *of)
{
    return of->motion.circumferential;
}

static double value_angular_velocity(const realization *of)
{
    return of->motion.spin;
}

/* True for a surface in more than one piece. */
static bool flies(const realization *of)
{
    return of->point->surface && of->record->nfragment > 1;
}

/* (estimators.12) */
static double value_translation(const realization *of)
{
    const fracas_fragment *end = of->record->fragment + of->record->nfragment;
    double sum = flies(of) ? 0 : NAN;
    for (const fracas_fragment *f = of->record->fragment; f < end; f++)
        for (int i = 0; i < 3; i++) sum += 0.5 * f->mass * f->velocity[i] * f->velocity[i];
    return sum;
}

/* (estimators.13) */
static double value_rotation(const realization *of)
{
    const fracas_fragment *end = of->record->fragment + of->record->nfragment;
    double sum = flies(of) ? 0 : NAN;
    for (const fracas_fragment *f = of->record->fragment; f < end; f++)
        for (int i = 0; i < 3; i++) sum += 0.5 * f->angular_momentum[i] * f->spin[i];
    return sum;
}

static double value_largest_size(const realization *of)
{
    return of->largest ? of->largest->size : NAN;
}

static double value_largest_share(const realization *of)
{
    return of->largest ? of->largest->mass / of->mass : NAN;
}

/* Mean of s_1/s_2 of the fragments without dust  (fragments.7) */
static double value_aspect(const realization *of)
{
    const fracas_fragment *end = of->record->fragment + of->record->nfragment;
    double sum = 0;
    size_t count = 0;
    for (const fracas_fragment *f = of->record->fragment; f < end; f++) {
        if (f->dust) continue;
        sum += f->semi_axis[0] / f->semi_axis[1];
        count++;
    }
    return count ? sum / (double)count : NAN;
}

fracas_replica_values fracas_numbers_of(const fracas_point_statistics *point,
                                        const fracas_record *record)
{
    const fracas_fragment *end = record->fragment + record->nfragment;
    realization of = {.point = point, .record = record, .motion = {NAN, NAN, NAN, NAN}};
    if (point->radius > 0) of.motion = fracas_ring_motion_of(record, point->radius);
    for (const fracas_fragment *f = record->fragment; f < end; f++) {
        if (!of.largest || f->mass > of.largest->mass) of.largest = f;
        of.mass += f->mass;
    }
#define VALUE(key, unit, doc, ...) .key = value_##key(&of),
    return (fracas_replica_values){FRACAS_REALIZATION_NUMBERS(VALUE)};
}

const fracas_estimate *fracas_number_mean(const fracas_number *number,
                                          const fracas_point_statistics *point)
{
    return (const void *)((const char *)point + number->mean);
}

bool fracas_number_above_0(const fracas_number *number, const fracas_point_statistics *point,
                           size_t npoints)
{
    for (size_t p = 0; p < npoints; p++)
        if (fracas_number_mean(number, &point[p])->mean > 0) return true;
    return false;
}
