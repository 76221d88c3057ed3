/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A simulated farm as its seed draws it: campaign, options, how long realizations take and which
 * fail, and what befalls it. */
#ifndef FRACAS_TESTS_SIMULATOR_FARM_H
#define FRACAS_TESTS_SIMULATOR_FARM_H

#include "tests/simulator/world.h"

#include "campaigns/campaign.h"
#include "campaigns/scheduler/types/options.h"

/* A cursed realization does the same at every attempt. */
typedef enum { SOUND, CRASHES, LACKS_MEMORY, NEVER_ENDS } curse;

enum { MOST_CAMPAIGNS = 9 };

/* A campaign, and study.h5 of its undisturbed run. */
typedef struct {
    const char *text; /* the campaign file */
    double cursed;    /* part of its realizations */
    char *resolved;   /* as the study keeps it */
    fracas_campaign *read, *reread;
    uint64_t checksum; /* of study.h5 */
    size_t bytes;
} campaign_kind;

extern campaign_kind farm_campaign[MOST_CAMPAIGNS];

extern struct farm {
    campaign_kind *kind;
    fracas_run_options options;
    int hosts;
    double seconds; /* of a realization, about */
    int64_t faults; /* still to come, at most */
    bool jumped;    /* the clock, far enough to end every lease */
    double jumps;   /* of the clock, together [s] */
} farm;

/* The host of a process; 0: that of the user. */
int farm_host(const process *p);
/* By the campaign alone. */
curse farm_curse(uint64_t point, int64_t replica);
uint64_t farm_hash(uint64_t point, int64_t replica, uint64_t purpose);

/* Reads the campaigns. */
void farm_prepare(void);
/* The user's process has ended; the power has failed. */
void farm_user_ended(const process *p);
void farm_power_failed(void);
/* One farm to its end, or broken(): `workers` 0 leaves their number to the seed. `faults`: at most
 * so many, -1: as the seed says. Returns a hash of all that happened. */
uint64_t farm_run(uint64_t seed, int workers, int64_t faults, bool tracing);

#endif
