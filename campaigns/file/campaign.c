/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/campaign.h"

#include "base/param.h"
#include "base/units.h"
#include "campaigns/file/memory.h"
#include "campaigns/file/replicas.h"
#include "engine/integrator/frequencies.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

void fracas_campaign_destroy(fracas_campaign *campaign)
{
    if (!campaign) return;
    fracas_memory_destroy(campaign->memory);
    fracas_frequencies_destroy(campaign->frequencies);
    free(campaign);
}

fracas_err fracas_campaign_has(const fracas_campaign *campaign, size_t point)
{
    if (point < campaign->npoints) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "there is no point %zu in campaign %s; it has %zu, from 0 on (fracas plan "
                       "FILE lists them)",
                       point, campaign->name, campaign->npoints);
}

/* ---- extending ---- */

static fracas_value value_at(const fracas_point_table *table, size_t point, const char *path)
{
    size_t column = fracas_point_table_find(table, path);
    return column == SIZE_MAX ? (fracas_value){.real = NAN, .text = ""}
                              : table->point[point].value[column];
}

/* A column of a point's identity: not `case`, nor a derived one. */
static bool is_identity(const fracas_column *column)
{
    return strcmp(column->path, "case") != 0 && strncmp(column->path, "derived.", 8) != 0;
}

/* Number of values of point `b` of `before` different at point `n` of `now`, and the first one. A
 * column only in `now` comes with a kind, which differs too. */
static size_t count_differences(const fracas_point_table *now, size_t n,
                                const fracas_point_table *before, size_t b,
                                const fracas_column **first)
{
    size_t count = 0;
    for (size_t c = 0; c < before->ncolumns; c++) {
        const fracas_column *column = &before->column[c];
        fracas_value is = value_at(now, n, column->path);
        if (!is_identity(column) || fracas_value_same(&is, &before->point[b].value[c])) continue;
        if (count++ == 0) *first = column;
    }
    return count;
}

static void write_text(const fracas_column *column, const fracas_value *value, char text[64])
{
    char number[FRACAS_NUMBER_TEXT];
    fracas_number_write(value->real, number);
    const bool pure = strcmp(column->unit, "1") == 0;
    if (column->text) snprintf(text, 64, "%s", *value->text ? value->text : "nothing");
    else if (isnan(value->real)) snprintf(text, 64, "nothing");
    else snprintf(text, 64, "%s%s%s", number, pure ? "" : " ", pure ? "" : column->unit);
}

/* The point with this hash, searched from point `from` on and around; NULL if there is none. */
static const fracas_point *find_point(const fracas_campaign *campaign, const fracas_hash *hash,
                                      size_t from)
{
    for (size_t n = 0; n < campaign->npoints; n++) {
        const fracas_point *point = &campaign->point[(from + n) % campaign->npoints];
        if (fracas_hash_equal(&point->hash, hash)) return point;
    }
    return NULL;
}

static bool is_part(const fracas_campaign *now, const fracas_campaign *before)
{
    for (size_t n = 0; n < now->npoints; n++)
        if (!find_point(before, &now->point[n].hash, n)) return false;
    return true;
}

/* A point of `before` is not in `now`: names its first difference from the nearest point of `now`.
 */
static fracas_err point_missing(const fracas_campaign *now, const fracas_campaign *before, size_t b)
{
    const fracas_column *column = NULL;
    size_t nearest = 0, least = SIZE_MAX;
    if (is_part(now, before))
        return fracas_fail(FRACAS_DAMAGED,
                           "the study has %zu points, and this campaign file only %zu of them, the "
                           "first that is missing being its point %zu; a study keeps its points: "
                           "give them all, or use another --study",
                           before->npoints, now->npoints, b);
    for (size_t n = 0; n < now->npoints; n++) {
        const fracas_column *first = NULL;
        if (find_point(before, &now->point[n].hash, n)) continue; /* it is no change of `b` */
        size_t count = count_differences(&now->table, n, &before->table, b, &first);
        if (count >= least || !first) continue;
        least = count;
        nearest = n;
        column = first;
    }
    if (!column)
        return fracas_fail(FRACAS_DAMAGED,
                           "the study has a point %zu that this campaign file has not; give the "
                           "campaign a new name or another --study",
                           b);
    char was[64], is[64];
    fracas_value value = value_at(&now->table, nearest, column->path);
    write_text(column, &value, is);
    value = value_at(&before->table, b, column->path);
    write_text(column, &value, was);
    return fracas_fail(
        FRACAS_DAMAGED,
        "%s is %s in the study (its point %zu), but %s in this campaign file; a study can be "
        "extended by points and replicas, anything else needs a new name or another --study",
        column->path, was, b, is);
}

static fracas_err check_settings(const fracas_campaign *now, const fracas_campaign *before)
{
    static const char *const random[] = {"independent", "common"},
                             *const boolean[] = {"false", "true"},
                             *const kept[] = {"nothing", "edges"};
    char seed[2][32], history[2][32], probes[2][FRACAS_PROBES_TEXT];
    const fracas_campaign *both[] = {before, now};
    for (int i = 0; i < 2; i++) {
        snprintf(seed[i], sizeof seed[i], "%" PRIu64, both[i]->seed);
        snprintf(history[i], sizeof history[i], "%" PRId64, both[i]->output.history);
        fracas_probes_write(&both[i]->probes, probes[i]);
        if (!*probes[i]) strcpy(probes[i], "nothing");
    }
    const struct {
        const char *path, *was, *is;
    } setting[] = {
        {"seed", seed[0], seed[1]},
        {"random_numbers", random[before->common_random_numbers],
         random[now->common_random_numbers]},
        {"output.history", history[0], history[1]},
        {"output.interfaces", boolean[before->output.interfaces], boolean[now->output.interfaces]},
        {"output.reactions", kept[before->output.reactions != NULL],
         kept[now->output.reactions != NULL]},
        {"probes", probes[0], probes[1]},
    };
    for (size_t i = 0; i < FRACAS_COUNT(setting); i++)
        if (strcmp(setting[i].was, setting[i].is) != 0)
            return fracas_fail(FRACAS_DAMAGED,
                               "%s is %s in the study, but %s in this campaign file; it must stay "
                               "as it is; else give the campaign a new name or another --study",
                               setting[i].path, setting[i].was, setting[i].is);
    return FRACAS_OK;
}

fracas_err fracas_campaign_extends(const fracas_campaign *now, const fracas_campaign *before)
{
    TRY(check_settings(now, before));
    size_t from = 0; /* a campaign is extended in order: the next point is near */
    for (size_t b = 0; b < before->npoints; b++) {
        const fracas_point *found = find_point(now, &before->point[b].hash, from);
        if (!found) return point_missing(now, before, b);
        TRY(fracas_replicas_extend(found, &before->point[b], b));
        from = (size_t)(found - now->point) + 1;
    }
    return FRACAS_OK;
}
