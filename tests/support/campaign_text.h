/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaigns from strings, for tests. */
#ifndef FRACAS_TESTS_UNIT_CAMPAIGN_TEXT_H
#define FRACAS_TESTS_UNIT_CAMPAIGN_TEXT_H

#include "campaigns/campaign.h"
#include "campaigns/plan/plan.h"
#include "tests/support/test.h"

#include <unistd.h>

/* A complete campaign without a sweep; tests replace parts of it. */
static const char plain_campaign[] = "name: test\n"                  /* 1 */
                                     "seed: 7\n"                     /* 2 */
                                     "model: bar\n"                  /* 3 */
                                     "geometry:\n"                   /* 4 */
                                     "  ends: periodic\n"            /* 5 */
                                     "  length: 50 mm\n"             /* 6 */
                                     "mesh:\n"                       /* 7 */
                                     "  elements: 100\n"             /* 8 */
                                     "material:\n"                   /* 9 */
                                     "  young: 275 GPa\n"            /* 10 */
                                     "  density: 2750 kg/m3\n"       /* 11 */
                                     "cohesive:\n"                   /* 12 */
                                     "  law: nitsche\n"              /* 13 */
                                     "  fracture_energy: 100 J/m2\n" /* 14 */
                                     "strength:\n"                   /* 15 */
                                     "  distribution: uniform\n"     /* 16 */
                                     "  minimum: 299 MPa\n"          /* 17 */
                                     "  maximum: 301 MPa\n"          /* 18 */
                                     "loading:\n"                    /* 19 */
                                     "  rate: 1e4 1/s\n"             /* 20 */
                                     "time:\n"                       /* 21 */
                                     "  stop: settled\n"             /* 22 */
                                     "  end: 500 ns\n"               /* 23 */
                                     "  quiet: 100 ns\n"             /* 24 */
                                     "replicas: 3\n"                 /* 25 */
                                     "output:\n"                     /* 26 */
                                     "  history: 10\n"               /* 27 */
                                     ""; /* 28: where `sweep:` is appended */

/* `text` with its one `find` replaced by `put`; an empty `find` appends. Freed by the caller. */
static inline char *replace(const char *text, const char *find, const char *put)
{
    const char *at = *find ? strstr(text, find) : text + strlen(text);
    if (!at || (*find && strstr(at + 1, find)))
        fail_msg("the text has not exactly one \"%s\"", find);
    size_t before = (size_t)(at - text), size = strlen(text) + strlen(put) + 1;
    char *made = malloc(size);
    if (!made) abort();
    snprintf(made, size, "%.*s%s%s", (int)before, text, put, at + strlen(find));
    return made;
}

/* The campaign as resolved. Freed by the caller. */
static inline char *write_text(const fracas_campaign *campaign)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    OK(fracas_campaign_write(campaign, out));
    assert_int_equal(fclose(out), 0);
    return text;
}

/* What `fracas plan` prints for so many processes. Freed by the caller. (Inlined, gcc takes what it
 * returns for the address of a local.) */
__attribute__((noinline, unused)) static char *plan_text(const fracas_campaign *campaign, int jobs,
                                                         bool json)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    if (fracas_plan_print(campaign, jobs, out, json)) fail_msg("%s", fracas_message());
    assert_int_equal(fclose(out), 0);
    return text;
}

/* Writes `size` bytes to `path`. */
static inline void write_bytes(const char *path, const void *bytes, size_t size)
{
    FILE *out = fopen(path, "wb");
    assert_non_null(out);
    assert_int_equal(fwrite(bytes, 1, size, out), size);
    assert_int_equal(fclose(out), 0);
}

/* A temporary file's name in `path`; the file exists. */
static inline void make_path(char path[40])
{
    strcpy(path, "/tmp/fracas-test-XXXXXX");
    int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
}

/* The campaign in the text; the test fails if it is refused. */
static inline fracas_campaign *read_text(const char *text)
{
    char path[40];
    fracas_campaign *campaign = NULL;
    make_path(path);
    write_bytes(path, text, strlen(text));
    fracas_err err = fracas_campaign_read(path, &campaign);
    unlink(path);
    if (err) fail_msg("%s\n%s", fracas_message(), text);
    return campaign;
}

/* What a point has at a path. */
static inline const fracas_value *at(const fracas_campaign *campaign, size_t point,
                                     const char *path)
{
    size_t column = fracas_point_table_find(&campaign->table, path);
    if (column == SIZE_MAX) fail_msg("no column %s", path);
    return &campaign->table.point[point].value[column];
}

static inline double real(const fracas_campaign *campaign, size_t point, const char *path)
{
    return at(campaign, point, path)->real;
}

/* The plain campaign with `find` replaced by `put`. */
static inline fracas_campaign *read_replaced(const char *find, const char *put)
{
    OWNED char *text = replace(plain_campaign, find, put);
    fracas_campaign *campaign = read_text(text);
    return campaign;
}

#endif
