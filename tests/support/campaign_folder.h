/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Campaigns with files of their own, in the folder of tests/support/folder.h. */
#ifndef FRACAS_TESTS_SUPPORT_CAMPAIGN_FOLDER_H
#define FRACAS_TESTS_SUPPORT_CAMPAIGN_FOLDER_H

#include "campaigns/plan/forecast.h"
#include "campaigns/plan/point_model.h"
#include "tests/support/campaign_text.h"
#include "tests/support/folder.h"

/* FOLDER/NAME, until one more was asked for. */
static inline const char *in_folder(const char *name)
{
    static char path[2][200];
    static int which;
    which = !which;
    snprintf(path[which], sizeof path[which], "%s/%s", folder, name);
    return path[which];
}

static inline void put(const char *name, const char *text)
{
    write_bytes(in_folder(name), text, strlen(text));
}

static inline fracas_err read_in_folder(const char *text, fracas_campaign **campaign)
{
    put("c.yaml", text);
    *campaign = NULL;
    return fracas_campaign_read(in_folder("c.yaml"), campaign);
}

/* The campaign of the text, with the files of the folder. */
static inline fracas_campaign *good(const char *text)
{
    fracas_campaign *campaign;
    OK(read_in_folder(text, &campaign));
    return campaign;
}

/* The text is refused, with these words, as is no campaign. */
static inline void bad(const char *text, const char *words)
{
    fracas_campaign *campaign;
    FAILS(read_in_folder(text, &campaign), FRACAS_USAGE, words);
    assert_null(campaign);
}

#endif
