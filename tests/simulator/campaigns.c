/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The campaigns of simulated farms, read once for all, and what the system tells of itself. */
#include "tests/simulator/disk.h"
#include "tests/simulator/farm.h"

#include "campaigns/scheduler/director/timings.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/session/space.h"
#include "campaigns/scheduler/status/progress.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CAMPAIGN(replicas, sweep)                                                  \
    "name: farm\nseed: 7\nmodel: bar\ngeometry: {ends: periodic, length: 50 mm}\n" \
    "mesh: {elements: 100}\nmaterial: {young: 275 GPa, density: 2750 kg/m3}\n"     \
    "cohesive: {law: nitsche, fracture_energy: 100 J/m2}\n"                        \
    "strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}\n"      \
    "loading: {rate: 1e4 1/s}\ntime: {stop: quiet, end: 500 ns, quiet: 100 ns}\n"  \
    "replicas: " replicas "\n" sweep

#define SWEEP(...) "sweep:\n  - loading.rate: [" #__VA_ARGS__ "]\n"
#define RULE(most, part)                                                                         \
    "{minimum: 8, maximum: " #most ", until: {quantity: dissipated, relative-half-width: " #part \
    "}}"

campaign_kind farm_campaign[MOST_CAMPAIGNS] = {
    {.text = CAMPAIGN("24", "")},
    {.text = CAMPAIGN("8", SWEEP(1e3, 1e4, 2e4))},
    {.text = CAMPAIGN("16", SWEEP(1e3, 1e4)), .cursed = 0.08},
    {.text = CAMPAIGN(RULE(40, 0.2), "")},
    {.text = CAMPAIGN("2", SWEEP(1e3, 2e3, 3e3, 4e3, 5e3, 6e3, 7e3, 8e3, 9e3, 1e4))},
    {.text = CAMPAIGN("100", "")},
    {.text = CAMPAIGN(RULE(24, 0.3), SWEEP(1e3, 1e4, 2e4)), .cursed = 0.04},
    {.text = CAMPAIGN("3", "")},
    {.text = CAMPAIGN("3000", "")}, /* of farms of a thousand workers */
};

static bool disturbed; /* the campaigns are read */

uint64_t farm_hash(uint64_t point, int64_t replica, uint64_t purpose)
{
    uint64_t x = (point << 40) + ((uint64_t)replica << 8) + purpose + 0x9e3779b97f4a7c15u;
    for (int round = 0; round < 2; round++) {
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        x ^= x >> 31;
    }
    return x;
}

curse farm_curse(uint64_t point, int64_t replica)
{
    const uint64_t hash = farm_hash(point, replica, 100);
    if ((double)(hash >> 11) * 0x1p-53 >= farm.kind->cursed) return SOUND;
    return (curse)(1 + hash % 3);
}

/* ---- reading ---- */

fracas_err __real_fracas_campaign_read(const char *path, fracas_campaign **campaign);
fracas_err __wrap_fracas_campaign_read(const char *path, fracas_campaign **campaign)
{
    if (!disturbed) return __real_fracas_campaign_read(path, campaign);
    const node *n = disk_find(path);
    const campaign_kind *kind = farm.kind;
    call("reads the campaign");
    if (n && n->size == strlen(kind->text) && !memcmp(n->data, kind->text, n->size))
        *campaign = kind->read;
    else if (n && n->size == strlen(kind->resolved) && !memcmp(n->data, kind->resolved, n->size))
        *campaign = kind->reread;
    else return fracas_fail(FRACAS_USAGE, "%s is no campaign file", path);
    return FRACAS_OK;
}

/* Once read, they are for all processes. */
void __wrap_fracas_campaign_destroy(fracas_campaign *campaign)
{
    (void)campaign;
}

fracas_err __real_fracas_campaign_write(const fracas_campaign *campaign, FILE *out);
fracas_err __wrap_fracas_campaign_write(const fracas_campaign *campaign, FILE *out)
{
    if (!disturbed) return __real_fracas_campaign_write(campaign, out);
    return fputs(farm.kind->resolved, out) < 0 ? fracas_fail_system(28, "cannot write") : FRACAS_OK;
}

static fracas_campaign *read_text(const char *text)
{
    char path[] = "/tmp/fracas-simulator-XXXXXX";
    fracas_campaign *campaign;
    const int fd = mkstemp(path);
    if (fd < 0 || write(fd, text, strlen(text)) != (ssize_t)strlen(text) ||
        fracas_campaign_read(path, &campaign)) {
        fprintf(stderr, "simulator: %s\n", fracas_message());
        exit(70);
    }
    close(fd);
    unlink(path);
    return campaign;
}

void farm_prepare(void)
{
    for (size_t k = 0; k < MOST_CAMPAIGNS; k++) {
        campaign_kind *kind = &farm_campaign[k];
        size_t size;
        kind->read = read_text(kind->text);
        FILE *out = open_memstream(&kind->resolved, &size);
        if (!out || fracas_campaign_write(kind->read, out) || fclose(out)) abort();
        kind->reread = read_text(kind->resolved);
    }
    disturbed = true;
}

/* ---- answers of the system ---- */

fracas_err __wrap_fracas_allocation_jobs(int wanted, int64_t parts, int *jobs)
{
    *jobs = wanted;
    return FRACAS_OK;
}

fracas_err __wrap_fracas_space_check(const char *study, const fracas_campaign *campaign,
                                     const fracas_run_options *options, const double *bytes)
{
    (void)study, (void)campaign, (void)options, (void)bytes;
    return FRACAS_OK;
}

fracas_err __wrap_fracas_costs_create(const fracas_campaign *campaign,
                                      const fracas_run_options *options, FILE *warn, double **cost,
                                      double **bytes)
{
    (void)options, (void)warn;
    *cost = malloc(campaign->npoints * sizeof **cost);
    *bytes = calloc(campaign->npoints, sizeof **bytes);
    if (!*cost || !*bytes) abort();
    for (size_t p = 0; p < campaign->npoints; p++) (*cost)[p] = 1e4 * (double)(p + 1);
    return FRACAS_OK;
}

/* The text has the processor time of this process. */
fracas_err __wrap_fracas_timings_note(const fracas_timings *timings, fracas_index *index)
{
    (void)timings, (void)index;
    return FRACAS_OK;
}

/* ---- the user's view ---- */

void __wrap_fracas_progress_init(fracas_progress *progress, FILE *out)
{
    *progress = (fracas_progress){.out = out};
}

void __wrap_fracas_progress_update(fracas_progress *progress, const fracas_counts *counts)
{
    progress->last = *counts;
    progress->any = true;
}

void __wrap_fracas_progress_message(fracas_progress *progress, const char *text)
{
    (void)progress;
    trace("SAYS %s", text);
}

void __wrap_fracas_progress_end(fracas_progress *progress)
{
    (void)progress;
}
