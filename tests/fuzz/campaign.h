/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What fuzz targets of campaign files and of the files that they name share: a folder with a
 * campaign file in it is read, or refused with messages that have a place; what is read survives
 * writing and reading back, and small points of it make a plan. */
#ifndef FRACAS_TESTS_FUZZ_CAMPAIGN_H
#define FRACAS_TESTS_FUZZ_CAMPAIGN_H

#include "tests/fuzz/fuzz.h"

#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"
#include "engine/mesh/body.h"

#include <math.h>
#include <sys/stat.h>

static fracas_units *units;
static char folder[64], campaign_path[80], place[84];
static size_t nread, nrefused, nplanned, nimpossible; /* campaigns; points */

static inline void in_folder(const char *name, char path[160])
{
    snprintf(path, 160, "%s/%s", folder, name);
}

static inline void write_named(const char *name, const void *bytes, size_t size)
{
    char path[160];
    in_folder(name, path);
    write_bytes(path, bytes, size);
}

static inline void say_counts(void)
{
    fprintf(stderr, "%zu campaigns read, %zu refused; %zu points planned, %zu refused\n", nread,
            nrefused, nplanned, nimpossible);
}

/* Once: the units and the folder. */
static inline void campaign_start(void)
{
    char path[160];
    if (units) return;
    FUZZ_DEMAND(fracas_units_create(&units) == FRACAS_OK, "units");
    fuzz_folder(folder);
    atexit(say_counts);
    in_folder(FRACAS_ATTACHMENTS, path);
    FUZZ_DEMAND(mkdir(path, 0777) == 0, "a folder of attachments");
    snprintf(campaign_path, sizeof campaign_path, "%s/c.yaml", folder);
    snprintf(place, sizeof place, "%s:", campaign_path);
}

/* The campaign, written and read again, is the same. */
static inline void check_round_trip(const fracas_campaign *campaign)
{
    char path[160];
    FILE *out = text_begin();
    FUZZ_OK(fracas_campaign_write(campaign, out));
    OWNED char *text = text_end(out);
    write_bytes(campaign_path, text, strlen(text));
    for (const fracas_attached *a = campaign->attached; a; a = a->next) {
        snprintf(path, sizeof path, "%s/" FRACAS_ATTACHMENTS "/%s", folder, a->attachment.digest);
        write_bytes(path, a->attachment.text, a->attachment.size);
    }
    fracas_campaign *back = NULL;
    FUZZ_DEMAND(fracas_campaign_read_with(units, campaign_path, &back) == FRACAS_OK, text);
    FUZZ_DEMAND(fracas_hash_equal(&campaign->hash, &back->hash), text);
    FUZZ_DEMAND(fracas_campaign_extends(back, campaign) == FRACAS_OK, text);
    fracas_campaign_destroy(back);
    for (const fracas_attached *a = campaign->attached; a; a = a->next) {
        snprintf(path, sizeof path, "%s/" FRACAS_ATTACHMENTS "/%s", folder, a->attachment.digest);
        remove(path);
    }
}

/* A mesh of it is made within the time of an input. */
static inline bool is_small(const fracas_spec *spec)
{
    const fracas_geometry *g = &spec->geometry;
    if (!fracas_spec_is_surface(spec)) return spec->mesh.elements <= 1000;
    if (fracas_shape_of(spec)->from_file) return true;
    const double longest = fmax(fmax(fmax(g->width, g->height), g->length),
                                6 * fmax(g->outer, g->radius)),
                 shortest = g->width > 0    ? fmin(g->width, g->height)
                            : g->outer > 0  ? g->outer - g->inner
                            : g->length > 0 ? fmin(g->radius, g->length)
                                            : g->radius,
                 size = spec->mesh.size > 0 ? spec->mesh.size
                                            : shortest / (double)spec->mesh.divisions;
    return longest <= 30 * fmin(size, shortest) && longest * shortest <= 200 * size * size;
}

/* A large mesh takes longer than an input may, when a campaign is read: its volumes are left out.
 */
fracas_err __real_fracas_mesh_interface_extent(const fracas_spec *spec, double *volume,
                                               double *area);
fracas_err __wrap_fracas_mesh_interface_extent(const fracas_spec *spec, double *volume,
                                               double *area);
fracas_err __wrap_fracas_mesh_interface_extent(const fracas_spec *spec, double *volume,
                                               double *area)
{
    if (is_small(spec)) return __real_fracas_mesh_interface_extent(spec, volume, area);
    *volume = *area = 1e-12;
    return FRACAS_OK;
}

/* A point makes a plan, of a finite cost and size, or is refused by its number. */
static inline void check_plan(const fracas_campaign *campaign, size_t point)
{
    double cost, bytes;
    if (!is_small(&campaign->point[point].spec)) return;
    fracas_err err = fracas_plan_cost(campaign, point, &cost, &bytes);
    nplanned += !err;
    nimpossible += err != FRACAS_OK;
    if (err)
        FUZZ_DEMAND(err == FRACAS_USAGE && strncmp(fracas_message(), "point ", 6) == 0 &&
                        !strchr(fracas_message(), '\n'),
                    fracas_message());
    else FUZZ_DEMAND(isfinite(cost) && cost > 0 && isfinite(bytes) && bytes > 0, "a plan");
}

/* Every line of a refusal has the file's name, and those with a place come in the order of lines.
 */
static inline bool is_refusal(const char *message)
{
    long before = 0;
    int lines = 0;
    for (const char *line = message; line; lines++) {
        if (strncmp(line, place, strlen(place)) != 0) return false;
        const long now = strtol(line + strlen(place), NULL, 10);
        if (now && now < before) return false;
        before = now;
        line = strchr(line, '\n');
        if (line) line++;
    }
    return lines <= 21;
}

/* The folder's content, by the header. */
static inline void check_campaign(void)
{
    enum { MOST_POINTS = 4 };
    fracas_campaign *campaign = NULL;
    fuzz_limit();
    fracas_err err = fracas_campaign_read_with(units, campaign_path, &campaign);
    nread += !err;
    nrefused += err != FRACAS_OK;
    if (err) {
        FUZZ_DEMAND(err == FRACAS_USAGE && !campaign && is_refusal(fracas_message()),
                    fracas_message());
        return;
    }
    check_round_trip(campaign);
    for (size_t p = 0; p < campaign->npoints && p < MOST_POINTS; p++) check_plan(campaign, p);
    fracas_campaign_destroy(campaign);
}

#endif
