/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/solver/stop.h"

#include "engine/integrator/integrator.h"

/* Traits of a rule that can end a realization before time.end; `time` has none. */
typedef struct {
    bool (*is_over)(fracas_stop *, const fracas_time *, const fracas_progress *);
    bool waits; /* time.quiet goes by until then */
    bool rests; /* by breaks that are still to come */
} stop_rule;

/* The first parameter of each rule. */
#define END(text, ...)                                                     \
    {                                                                      \
        "end", FRACAS_REAL, "s", text, FRACAS_REQUIRED, 0, INFINITY, true, \
            offsetof(fracas_time, end), __VA_ARGS__                        \
    }
#define CAP "when it ends at the latest"
#define OWN_CAP \
    CAP "; none: fracas reckons it, for a load with a strain rate (docs/theory/settled.md)"

static const fracas_param set_time[] = {
    END("set time, or the cap of other stop rules", .optional = false)};
const fracas_kind fracas_stop_time = {"time", "at the set time `end`", FRACAS_PARAMS(set_time)};

static const fracas_param settled[] = {
    END(OWN_CAP, .optional = true),
    {"transits", FRACAS_REAL, "1",
     "fewest transits of a mean fragment by a longitudinal wave since the first onset", 20, 0,
     INFINITY, false, offsetof(fracas_time, transits), .only = FRACAS_GROUP_CHAINS},
    {"transits", FRACAS_REAL, "1",
     "fewest transits of a mean fragment by a longitudinal wave since the first onset", 60, 0,
     INFINITY, false, offsetof(fracas_time, transits), .only = FRACAS_GROUP_SURFACES},
    {"growth", FRACAS_REAL, "1",
     "largest share of the fragments that the last half of that time may have added", 0.03, 0, 1,
     false, offsetof(fracas_time, growth)},
    {"rest", FRACAS_REAL, "1",
     "largest share of the fragments, or of 15 where there are fewer, that may still come, by the "
     "energies of all",
     0.02, 0, 1, false, offsetof(fracas_time, rest), .only = FRACAS_GROUP_CHAINS},
};
/* (settled.7) */
static bool is_settled(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now)
{
    (void)stop;
    return now->look && now->broken > 0 && now->transits >= rule->transits &&
           now->growth <= rule->growth && now->rest <= rule->rest;
}

const fracas_kind fracas_stop_settled = {
    "settled",
    "once the count of fragments is final (armed by the first break), at `end` at the latest",
    FRACAS_PARAMS(settled), .traits = &(const stop_rule){.is_over = is_settled, .rests = true}};

static const fracas_param transits[] = {
    END(OWN_CAP, .optional = true),
    {"transits", FRACAS_REAL, "1",
     "transits of a mean fragment by a longitudinal wave since the first onset; up to 9 % more", 40,
     0, INFINITY, false, offsetof(fracas_time, transits)},
};
/* (settled.9) */
static bool is_crossed(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now)
{
    (void)stop;
    return now->look && now->broken > 0 && now->transits >= rule->transits;
}

const fracas_kind fracas_stop_transits = {
    "transits",
    "once waves have crossed a mean fragment so many times (armed by the first break), at `end` at "
    "the latest",
    FRACAS_PARAMS(transits), .traits = &(const stop_rule){.is_over = is_crossed}};

static const fracas_param quiet[] = {
    END(CAP, .optional = false),
    {"quiet", FRACAS_REAL, "s", "how long nothing may crack or break, and little dissipate",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_time, quiet)},
    {"quiet_fraction", FRACAS_REAL, "1",
     "largest share of the dissipated energy that may be added in that time", 1e-3, 0, 1, true,
     offsetof(fracas_time, quiet_fraction)},
};
static bool is_quiet(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now)
{
    const int64_t events = now->cracked + now->broken;
    if (events > stop->events ||
        now->dissipated - stop->dissipated > rule->quiet_fraction * now->dissipated) {
        stop->time = now->time;
        stop->dissipated = now->dissipated;
        stop->events = events;
    }
    return now->cracked > 0 && now->time - stop->time >= rule->quiet;
}

const fracas_kind fracas_stop_quiet = {
    "quiet",
    "after a set time without events (armed by the first onset), at `end` at the latest; the count "
    "may be far from final",
    FRACAS_PARAMS(quiet), .traits = &(const stop_rule){.is_over = is_quiet, .waits = true}};

static const fracas_param peak_multiple[] = {
    END(CAP, .optional = false),
    {"multiple", FRACAS_REAL, "1", "end by the time of the first peak of the elastic energy", 2, 1,
     INFINITY, false, offsetof(fracas_time, multiple)},
    {"drop", FRACAS_REAL, "1",
     "share of its largest value that the elastic energy must have lost for that to be a peak",
     0.05, 0, 1, true, offsetof(fracas_time, drop)},
};
static bool is_past_peak(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now)
{
    if (!stop->peaked && now->elastic > stop->peak) {
        stop->peak = now->elastic;
        stop->peak_time = now->time;
    }
    stop->peaked = stop->peaked || now->elastic < (1.0 - rule->drop) * stop->peak;
    return stop->peaked && now->time >= rule->multiple * stop->peak_time;
}

const fracas_kind fracas_stop_peak_multiple = {
    "peak-multiple",
    "at a multiple of the time of the first peak of the elastic energy, at `end` at the latest",
    FRACAS_PARAMS(peak_multiple), .traits = &(const stop_rule){.is_over = is_past_peak}};

static const fracas_kind *const stops[] = {&fracas_stop_time, &fracas_stop_settled,
                                           &fracas_stop_transits, &fracas_stop_quiet,
                                           &fracas_stop_peak_multiple};

static const fracas_kind *const integrators[] = {&fracas_integrator_central_difference,
                                                 &fracas_integrator_hulbert_chung};
static const fracas_kind *const masses[] = {&fracas_mass_lumped, &fracas_mass_consistent};

static const fracas_param time_params[] = {
    {"safety", FRACAS_REAL, "1", "time step as a fraction of the critical one", 0.25, 0, 1, true,
     offsetof(fracas_time, safety)},
    {FRACAS_ONE_OF("integrator", integrators, offsetof(fracas_time, integrator),
                   "scheme of time integration"),
     .only = FRACAS_GROUP_SURFACES},
    {"spectral_radius", FRACAS_REAL, "1",
     "of hulbert-chung, at its bifurcation: the less, the more it damps high frequencies; "
     "central-difference damps nothing",
     0.95, 0, 1, false, offsetof(fracas_time, spectral_radius), .only = FRACAS_GROUP_SURFACES},
    {FRACAS_ONE_OF("mass", masses, offsetof(fracas_time, mass), "mass matrix of an element"),
     .only = FRACAS_GROUP_MEMBRANE},
    {"rotary_inertia", FRACAS_REAL, "1",
     "share of the thickness's rotary inertia that is counted: 1 allows time steps several times "
     "as "
     "long where elements are smaller than the shell is thick; left out, none is",
     FRACAS_REQUIRED, 0, 1, true, offsetof(fracas_time, rotary_inertia), .only = FRACAS_GROUP_SHELL,
     .optional = true},
};
static fracas_err check_time(const void *section)
{
    const fracas_time *time = section;
    const stop_rule *rule = time->stop->traits;
    if (rule && rule->waits && time->quiet > time->end)
        return fracas_fail(FRACAS_USAGE,
                           "quiet is %g s, but end is %g s already: no such time could pass; let "
                           "quiet be a fraction of end",
                           time->quiet, time->end);
    return FRACAS_OK;
}

const fracas_section fracas_time_section = {
    .name = "time",
    .doc = "Time integration and its end",
    .selector = "stop",
    FRACAS_KINDS(stops),
    .kind_offset = offsetof(fracas_time, stop),
    FRACAS_PARAMS(time_params),
    .offset = offsetof(fracas_spec, time),
    .hashed = true,
    .check = check_time,
};

bool fracas_stop_needs_rest(const fracas_time *rule)
{
    const stop_rule *of = rule->stop->traits;
    return of && of->rests;
}

bool fracas_stop_check(fracas_stop *stop, const fracas_time *rule, const fracas_progress *now,
                       fracas_outcome *outcome)
{
    const stop_rule *of = rule->stop->traits;
    *outcome = now->broken > 0 ? FRACAS_FRAGMENTED : FRACAS_INTACT;
    if (of && of->is_over(stop, rule, now)) return true;
    if (of && now->time >= rule->end && now->cracked > 0) *outcome = FRACAS_TIME_LIMIT;
    return now->time >= rule->end;
}
