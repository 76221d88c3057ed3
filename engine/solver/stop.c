#include "engine/solver/stop.h"

const fracas_kind fracas_stop_time = {.name = "time", .doc = "at the set time `end`"};

static const fracas_param settled[] = {
    {"quiet", FRACAS_REAL, "s", "how long nothing may crack or break, and little dissipate, for the body to be settled",
     FRACAS_REQUIRED, 0, INFINITY, true, offsetof(fracas_time, quiet)},
    {"quiet_fraction", FRACAS_REAL, "1", "largest share of the dissipated energy that may be added in that time", 1e-3, 0,
     1, true, offsetof(fracas_time, quiet_fraction)},
};
const fracas_kind fracas_stop_settled = {
    .name = "settled", .doc = "once the cracks have settled (armed by the first onset), at `end` at the latest",
    .params = settled, .nparams = FRACAS_COUNT(settled)};

static const fracas_kind *const stops[] = {&fracas_stop_time, &fracas_stop_settled};

static const fracas_param time_params[] = {
    {"end", FRACAS_REAL, "s", "set time, or the cap of other stop rules", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_time, end)},
    {"safety", FRACAS_REAL, "1", "time step as a fraction of the critical one", 0.25, 0, 1, true,
     offsetof(fracas_time, safety)},
};
static fracas_err check_time(const void *section)
{
    const fracas_time *time = section;
    if (time->stop == &fracas_stop_settled && time->quiet > time->end)
        return fracas_fail(FRACAS_USAGE, "quiet is %g s, but end is %g s already: nothing could settle; let quiet be a fraction "
                           "of end", time->quiet, time->end);
    return FRACAS_OK;
}

const fracas_section fracas_time_section = {
    .name = "time", .doc = "Time integration (central difference) and its end", .selector = "stop", .kinds = stops,
    .nkinds = FRACAS_COUNT(stops), .kind_offset = offsetof(fracas_time, stop), .params = time_params,
    .nparams = FRACAS_COUNT(time_params), .offset = offsetof(fracas_spec, time), .hashed = true, .check = check_time,
};

bool fracas_stop_check(fracas_stop *stop, const fracas_time *rule, double time, double dissipated, int64_t cracked,
                       int64_t broken, fracas_outcome *outcome)
{
    *outcome = broken > 0 ? FRACAS_FRAGMENTED : FRACAS_INTACT;
    if (rule->stop == &fracas_stop_settled) {
        if (cracked + broken > stop->events || dissipated - stop->dissipated > rule->quiet_fraction * dissipated)
            *stop = (fracas_stop){time, dissipated, cracked + broken};
        if (cracked > 0 && time - stop->time >= rule->quiet) return true;
        if (cracked > 0 && time >= rule->end) *outcome = FRACAS_TIME_LIMIT;
    }
    return time >= rule->end;
}
