/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/file/faults.h"

#include <stdio.h>
#include <string.h>

typedef struct {
    int line, column;
    char text[1024];
} fault;

/* Place of an error of a point. */
typedef struct {
    int line, column;
    size_t point;
} place;

struct fracas_faults {
    fracas_campaign_memory *memory;
    int line, column; /* the place of the error returned next */
    bool told;
    size_t noted, count;
    fault shown[FRACAS_FAULTS_SHOWN]; /* the first of `count` by place */
    size_t point;                     /* from 1; 0: the file itself is read */
    place *of_points;
    size_t nplaces, room;
};

fracas_faults *fracas_faults_create(fracas_campaign_memory *memory)
{
    fracas_faults *made = fracas_memory_take(memory, 1, sizeof *made);
    if (made) made->memory = memory;
    return made;
}

void fracas_faults_place(fracas_faults *faults, int line, int column, bool told)
{
    faults->line = line;
    faults->column = column;
    faults->told = told;
}

bool fracas_faults_is_told(const fracas_faults *faults)
{
    return faults->told;
}

void fracas_faults_point(fracas_faults *faults, size_t point)
{
    faults->point = point + 1;
}

size_t fracas_faults_noted(const fracas_faults *faults)
{
    return faults->noted;
}

/* True if an earlier point has told of this place. Notes that this one does. */
static fracas_err is_repeated(fracas_faults *faults, bool *repeated)
{
    *repeated = false;
    for (size_t i = 0; i < faults->nplaces && !*repeated; i++) {
        const place *one = &faults->of_points[i];
        *repeated = one->line == faults->line && one->column == faults->column &&
                    one->point != faults->point;
    }
    if (*repeated || faults->point == 0) return FRACAS_OK;
    if (faults->nplaces == faults->room) {
        const size_t room = 2 * faults->room + 64;
        place *grown = fracas_memory_take(faults->memory, room, sizeof *grown);
        if (!grown) return fracas_no_memory("the errors of the campaign file");
        if (faults->nplaces) memcpy(grown, faults->of_points, faults->nplaces * sizeof *grown);
        faults->of_points = grown;
        faults->room = room;
    }
    faults->of_points[faults->nplaces++] = (place){faults->line, faults->column, faults->point};
    return FRACAS_OK;
}

/* A message behind its place. */
static const char *said(const char *message, int line, int column)
{
    char before[32];
    snprintf(before, sizeof before, ":%d:%d: ", line, column);
    const char *at = strstr(message, before);
    return at ? at + strlen(before) : message;
}

/* True if the same is shown of this line, as of several values in a list. */
static bool is_shown(const fracas_faults *faults, size_t shown)
{
    const char *now = said(fracas_message(), faults->line, faults->column);
    for (size_t i = 0; i < shown; i++) {
        const fault *one = &faults->shown[i];
        if (one->line == faults->line && !strcmp(said(one->text, one->line, one->column), now))
            return true;
    }
    return false;
}

/* Puts the present message among those shown, behind all of its place and before it. */
static void insert(fracas_faults *faults)
{
    const size_t full = faults->count < FRACAS_FAULTS_SHOWN ? faults->count : FRACAS_FAULTS_SHOWN;
    size_t at = full;
    if (is_shown(faults, full)) return;
    for (; at > 0; at--) {
        const fault *before = &faults->shown[at - 1];
        if (before->line < faults->line ||
            (before->line == faults->line && before->column <= faults->column))
            break;
    }
    faults->count++;
    if (at == FRACAS_FAULTS_SHOWN) return;
    const size_t behind = (full < FRACAS_FAULTS_SHOWN ? full : full - 1) - at;
    memmove(&faults->shown[at + 1], &faults->shown[at], behind * sizeof(fault));
    faults->shown[at].line = faults->line;
    faults->shown[at].column = faults->column;
    snprintf(faults->shown[at].text, sizeof faults->shown[at].text, "%s", fracas_message());
}

fracas_err fracas_faults_note(fracas_faults *faults, fracas_err err)
{
    const bool told = faults->told;
    bool repeated;
    if (err != FRACAS_USAGE) return err;
    faults->noted++;
    faults->told = false;
    if (told) return FRACAS_OK;
    TRY(is_repeated(faults, &repeated));
    if (!repeated) insert(faults);
    return FRACAS_OK;
}

fracas_err fracas_faults_report(const fracas_faults *faults, const char *name)
{
    const size_t shown = faults->count < FRACAS_FAULTS_SHOWN ? faults->count : FRACAS_FAULTS_SHOWN;
    if (faults->noted == 0) return FRACAS_OK;
    if (shown == 0) return fracas_fail(FRACAS_BUG, "%s: an error without a message", name);
    fracas_err err = fracas_fail(FRACAS_USAGE, "%s", faults->shown[0].text);
    for (size_t i = 1; i < shown; i++) err = fracas_fail_also(err, faults->shown[i].text);
    if (faults->count == shown) return err;
    char more[1024];
    snprintf(more, sizeof more, "%.900s: and %zu more", name, faults->count - shown);
    return fracas_fail_also(err, more);
}
