/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"
#include "cli/film.h"

#include "base/json.h"
#include "base/own.h"
#include "base/units.h"
#include "campaigns/file/words.h"
#include "campaigns/scheduler/replay.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const fracas_option options[] = {
    {"fields", "DIR", "write its fields into DIR, new or empty, for ParaView"},
    {"every", "TIME", "fields from 0 on every TIME, as 50ns"},
    {"at", "LIST",
     "fields at these instants: onset (first), peak (of elastic + cohesive energy), end; all "
     "three without --every"},
    {"film", "FILE",
     "write FILE.html, a film for a browser, of 49 instants evenly (fields, too) unless --every or "
     "--at say otherwise"},
    {"one-file", NULL, "all instants in one file, VTKHDF 2, for VTK 9.3, ParaView 5.12 and later"},
    {"json", NULL, "print it as JSON"},
    {0}};

enum { INTERVALS = 48 }; /* between instants of a film */

/* A number from 0 on at *text, which then points behind it; false if there is none. */
static bool read_number(const char **text, int64_t *number)
{
    char *end;
    if (**text < '0' || **text > '9') return false;
    errno = 0;
    *number = strtoll(*text, &end, 10);
    *text = end;
    return errno == 0;
}

/* "3/7" */
static fracas_err read_realization(const char *text, size_t *point, int64_t *replica)
{
    const char *at = text;
    int64_t number;
    if (read_number(&at, &number) && *at++ == '/' && read_number(&at, replica) && !*at) {
        *point = (size_t)number;
        return FRACAS_OK;
    }
    return fracas_fail(FRACAS_USAGE,
                       "replay: POINT/REPLICA is `%s`; it must be two numbers from 0 on, as 3/7",
                       text);
}

static fracas_err read_every(const char *text, double *every)
{
    OWN(fracas_units) units = NULL;
    if (!text) return FRACAS_OK;
    TRY(fracas_units_create(&units));
    fracas_err err = fracas_cli_read_time(units, text, every);
    if (err) return fracas_fail_within(err, "replay: --every is `%s`", text);
    if (*every > 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "replay: --every is `%s`; it must be a time above 0, as 50ns",
                       text);
}

/* "onset,end" */
static fracas_err read_at(const char *text, fracas_fields_request *request)
{
    static const char *const names[] = {"onset", "peak", "end"};
    bool *const wanted[] = {&request->onset, &request->peak, &request->end};
    OWNED char *copy = strdup(text);
    if (!copy) return fracas_no_memory("the instants of fields");
    char *rest = copy;
    for (char *one; (one = strsep(&rest, ","));) {
        fracas_words known;
        fracas_words_init(&known, one);
        size_t k = 0;
        while (k < 3 && strcmp(names[k], one) != 0) fracas_words_add(&known, names[k++]);
        if (k == 3)
            return fracas_fail(FRACAS_USAGE, "replay: --at has `%s`%s", one,
                               fracas_words_hint(&known, "it can have"));
        *wanted[k] = true;
    }
    return FRACAS_OK;
}

/* *request: its folder is NULL where no fields are asked for. */
static fracas_err read_request(const fracas_arguments *arguments, fracas_fields_request *request)
{
    const char *every = fracas_given(arguments, "every"), *at = fracas_given(arguments, "at");
    const bool film = fracas_given(arguments, "film") != NULL;
    const bool one_file = fracas_given(arguments, "one-file") != NULL;
    *request = (fracas_fields_request){.folder = fracas_given(arguments, "fields"),
                                       .one_file = one_file};
    if (!request->folder && one_file)
        return fracas_fail(FRACAS_USAGE, "replay: --one-file is for fields: say --fields DIR, too");
    if (!request->folder && !film && (every || at))
        return fracas_fail(FRACAS_USAGE,
                           "replay: --%s is for fields and films: say --fields DIR or --film FILE, "
                           "too",
                           every ? "every" : "at");
    if (request->folder && !*request->folder)
        return fracas_fail(FRACAS_USAGE, "replay: --fields is empty; it must be a folder");
    TRY(read_every(every, &request->every));
    if (film && !every && !at) return FRACAS_OK; /* see_film */
    return at || !every ? read_at(at ? at : "onset,peak,end", request) : FRACAS_OK;
}

/* Has the film see every instant: those asked for, else evenly from 0 to the end. */
static void see_film(const fracas_replay *replay, fracas_cli_film *film,
                     fracas_fields_request *request)
{
    const bool said = request->every > 0 || request->onset || request->peak || request->end;
    if (!said) request->every = replay->stored.end_time / INTERVALS;
    request->show = fracas_cli_film_show;
    request->context = film;
}

static fracas_err replay(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) campaign = NULL;
    size_t point = 0;
    int64_t replica = 0;
    FRACAS_CLEARED(fracas_replay) replay = {0};
    FRACAS_CLEARED(fracas_cli_film) film = {0};
    fracas_fields_request request;
    const bool as_json = fracas_given(arguments, "json");
    FILE *out = as_json ? stderr : stdout;
    const char *path = fracas_given(arguments, "film");
    TRY(read_realization(arguments->second, &point, &replica));
    TRY(read_request(arguments, &request));
    if (path) TRY(fracas_cli_film_open(path, out, &film));
    TRY(fracas_cli_campaign_of(arguments->operand, &campaign));
    TRY(fracas_replay_find(arguments->operand, campaign, point, replica, &replay));
    if (path) see_film(&replay, &film, &request);
    TRY(fracas_replay_run(&replay, request.folder || path ? &request : NULL, out));
    if (path) TRY(fracas_cli_film_write(&film, &replay));
    const fracas_record *record = &replay.stored;
    if (as_json) {
        fracas_json json;
        fracas_json_begin(&json, stdout);
        fracas_json_text(&json, "study", arguments->operand);
        fracas_json_integer(&json, "point", (int64_t)point);
        fracas_json_integer(&json, "replica", replica);
        fracas_json_boolean(&json, "same", true);
        fracas_json_integer(&json, "fragments", (int64_t)record->nfragment);
        fracas_json_integer(&json, "history", (int64_t)record->nhistory);
        fracas_json_integer(&json, "interfaces", (int64_t)record->ninterface);
        if (request.folder) fracas_json_real(&json, "overlap", replay.overlap);
        fracas_json_end(&json);
        return FRACAS_OK;
    }
    printf("%s %zu/%" PRId64
           ": computed again, the same bytes: %zu fragment%s, %zu rows of history, "
           "%zu interfaces\n",
           arguments->operand, point, replica, record->nfragment, record->nfragment == 1 ? "" : "s",
           record->nhistory, record->ninterface);
    return FRACAS_OK;
}

const fracas_command fracas_command_replay = {
    .name = "replay",
    .operand = "STUDY",
    .second = "POINT/REPLICA",
    .doc = "Computes a realization of STUDY again, and compares it to the byte",
    .more =
        "\nIn this process alone, from the campaign of STUDY, a folder or study.h5 alone, as "
        "`fracas run` does. Its record "
        "must have the bytes of the study's, finished\n"
        "or not; else the first column that differs is named. POINT is the first column of "
        "report/points.csv: 3/7 is its replica 7.\n\n"
        "With --fields, DIR gets body.hdf.series, the moved body with displacement, "
        "velocity, stress and fragments, and\n"
        "interfaces.hdf.series, with damage, opening, strength and onset. How large they "
        "are is said before. Of bars and of bodies in a plane, the share on which fragments lie "
        "over each other\nis said after.\n\n"
        "With --film, FILE is a page that a browser plays: the moved body from any side, coloured "
        "by fragment, speed or stress.\n",
    .options = options,
    .run = replay,
};
