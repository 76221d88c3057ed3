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
                                     "  stop: quiet\n"               /* 22 */
                                     "  end: 500 ns\n"               /* 23 */
                                     "  quiet: 100 ns\n"             /* 24 */
                                     "replicas: 3\n"                 /* 25 */
                                     "output:\n"                     /* 26 */
                                     "  history: 10\n"               /* 27 */
                                     ""; /* 28: where `sweep:` is appended */

/* The text of tests/data/campaigns/NAME.yaml. Freed by the caller. */
static inline char *campaign_file(const char *name)
{
    char path[300];
    snprintf(path, sizeof path, FRACAS_SOURCE_DIR "/tests/data/campaigns/%s.yaml", name);
    return whole_file(path);
}

/* `text` with its one `find` replaced by `put`; an empty `find` appends. Freed by the caller. */
static inline char *replace(const char *text, const char *find, const char *put)
{
    const char *at = *find ? strstr(text, find) : text + strlen(text);
    if (!at || (*find && strstr(at + 1, find)))
        fail_msg("the text has not exactly one \"%s\"", find);
    char *made = taken(strlen(text) + strlen(put) + 1);
    sprintf(made, "%.*s%s%s", (int)(at - text), text, put, at + strlen(find));
    return made;
}

/* Makes \n, \t, \xHH and any other character after a backslash what they are in C. */
static inline void unescape(char *text)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        unsigned code = (unsigned char)*from;
        if (code == '\\' && *++from == 'x') {
            assert_int_equal(sscanf(from + 1, "%2x", &code), 1);
            from += 2;
        } else if (code == '\\')
            code = (unsigned char)(*from == 'n' ? '\n' : *from == 't' ? '\t' : *from);
        *to++ = (char)code;
    }
    *to = '\0';
}

/* The campaign as resolved. Freed by the caller. */
static inline char *write_text(const fracas_campaign *campaign)
{
    FILE *out = text_begin();
    OK(fracas_campaign_write(campaign, out));
    return text_end(out);
}

/* The output of `fracas plan` for so many processes. Freed by the caller. */
static inline char *plan_text(const fracas_campaign *campaign, int jobs, bool json)
{
    FILE *out = text_begin();
    OK(fracas_plan_print(campaign, &(fracas_plan_options){.jobs = jobs, .json = json}, out));
    return text_end(out);
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

/* The campaign as it is written is the same, and is written the same. */
static inline void check_round_trip(const fracas_campaign *campaign)
{
    OWNED char *text = write_text(campaign);
    OWN(fracas_campaign) back = read_text(text);
    OWNED char *again = write_text(back);
    assert_string_equal(text, again);
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    assert_string_equal(campaign->name, back->name);
    assert_int_equal(campaign->npoints, back->npoints);
    assert_int_equal(campaign->table.ncolumns, back->table.ncolumns);
    for (size_t p = 0; p < campaign->npoints; p++) {
        const fracas_point *a = &campaign->point[p], *b = &back->point[p];
        assert_true(fracas_hash_equal(&a->hash, &b->hash) && a->replicas == b->replicas);
        assert_memory_equal(&a->spec, &b->spec, sizeof a->spec);
        assert_memory_equal(&a->strength, &b->strength, sizeof a->strength);
    }
    OK(fracas_campaign_extends(campaign, back));
}

/* Whether a campaign goes on with a study of another; if not, the message has the words, up to the
 * first NULL. */
static inline void check_extends(const fracas_campaign *now, const fracas_campaign *before,
                                 const char *const words[3])
{
    if (words[0])
        test_fails("extends", fracas_campaign_extends(now, before), FRACAS_DAMAGED, words, 3);
    else OK(fracas_campaign_extends(now, before));
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
