/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Any bytes as a campaign file, with the files beside it that it may name: read, or refused with a
 * message that has a place; what is read survives writing and reading back, and makes a plan. The
 * input: the campaign file, then, where a line
 * "%%% strengths.csv" or "%%% mesh.msh" stands, what those files hold. For libFuzzer (tools/fuzz),
 * and the corpus as a test. */
#include "tests/fuzz/fuzz.h"

#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"

#include <sys/stat.h>

static const char strengths[] = "# interface, strength\n0, 299e6\n1,3.01e8\n\n2\t300000000.5\r\n";
static const char *const beside[] = {"strengths.csv", "mesh.msh"};

static fracas_units *units;
static char folder[64], campaign_path[80], place[84];

static void in_folder(const char *name, char path[160])
{
    snprintf(path, 160, "%s/%s", folder, name);
}

static void write_named(const char *name, const void *bytes, size_t size)
{
    char path[160];
    in_folder(name, path);
    write_bytes(path, bytes, size);
}

static void start(void)
{
    char path[160];
    if (units) return;
    FUZZ_DEMAND(fracas_units_create(&units) == FRACAS_OK, "units");
    fuzz_folder(folder);
    in_folder(FRACAS_ATTACHMENTS, path);
    FUZZ_DEMAND(mkdir(path, 0777) == 0, "a folder of attachments");
    snprintf(campaign_path, sizeof campaign_path, "%s/c.yaml", folder);
    snprintf(place, sizeof place, "%s:", campaign_path);
}

/* What was read is written, and read again from there: the same campaign. */
static void check_round_trip(const fracas_campaign *campaign)
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

/* Where the line "%%% NAME" stands; NULL if there is none. */
static const char *find_mark(const char *text, size_t size, const char *name, size_t *length)
{
    char mark[40];
    *length = (size_t)snprintf(mark, sizeof mark, "\n%%%%%% %s\n", name);
    return memmem(text, size, mark, *length);
}

/* The files of the input into the folder: each from its mark to the next. */
static void lay_out(const char *text, size_t size)
{
    size_t first = size;
    write_named(beside[0], strengths, sizeof strengths - 1);
    write_named("strengths.csv2", "3e8\n", 4);
    write_named(beside[1], "", 0);
    for (int f = 0; f < 2; f++) {
        size_t length, other;
        const char *mark = find_mark(text, size, beside[f], &length),
                   *next = find_mark(text, size, beside[1 - f], &other);
        if (!mark) continue;
        const char *end = next > mark ? next : text + size;
        write_named(beside[f], mark + length,
                    end > mark + length ? (size_t)(end - mark - length) : 0);
        if ((size_t)(mark - text) < first) first = (size_t)(mark - text);
    }
    write_named("c.yaml", text, first < size ? first + 1 : size);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    start();
    fuzz_limit();
    lay_out((const char *)data, size);
    fracas_campaign *campaign = NULL;
    fracas_err err = fracas_campaign_read_with(units, campaign_path, &campaign);
    if (err) {
        FUZZ_DEMAND(err == FRACAS_USAGE && !campaign &&
                        strncmp(fracas_message(), place, strlen(place)) == 0,
                    fracas_message());
        return 0;
    }
    check_round_trip(campaign);
    fracas_campaign_destroy(campaign);
    return 0;
}
