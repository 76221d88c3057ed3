/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/film.h"

#include "base/file.h"
#include "base/own.h"
#include "campaigns/plan/plan.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

fracas_err fracas_cli_film_open(const char *path, FILE *out, fracas_cli_film *film)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    const size_t length = strlen(name);
    *film = (fracas_cli_film){.path = path, .name = name, .out = out};
    if (length < 6 || strcmp(name + length - 5, ".html") != 0)
        return fracas_fail(FRACAS_USAGE,
                           "replay: --film is `%s`; it must be a file, as film.html, for a browser",
                           path);
    film->folder = slash ? strndup(path, (size_t)(slash - path) + (slash == path)) : strdup(".");
    if (!film->folder) return fracas_no_memory("a film");
    if (access(path, F_OK) == 0)
        return fracas_fail(FRACAS_USAGE, "replay: %s is there already: name another, or remove it",
                           path);
    if (access(film->folder, W_OK | X_OK) < 0)
        return fracas_fail_system(errno, "cannot write a film into the folder %s", film->folder);
    return FRACAS_OK;
}

void fracas_cli_film_clear(fracas_cli_film *film)
{
    fracas_film_destroy(film->film);
    free(film->folder);
    *film = (fracas_cli_film){0};
}

static fracas_film_instant instant_of(const fracas_fields *fields)
{
    static const char *const units[][2] = {{"stress", "Pa"}, {"N", "N/m"}, {"M", "N"}};
    fracas_film_instant now = {
        .elements = fields->elements,
        .corners = fields->corners,
        .interfaces = fields->interfaces,
        .ends = fields->ends,
        .time = fields->time,
        .place = (const double(*)[3])fields->place,
        .displacement = (const double(*)[3])fields->displacement,
        .velocity = (const double(*)[3])fields->velocity,
        .fragment = fields->fragment,
        .between = (const int64_t(*)[2])fields->between,
        .damage = fields->damage,
    };
    for (size_t s = 0; s < FRACAS_STRESSES && fields->name[s]; s++) {
        size_t k = 0;
        while (k + 1 < FRACAS_COUNT(units) && strcmp(units[k][0], fields->name[s]) != 0) k++;
        now.stress[s] = (fracas_film_stress){fields->name[s], units[k][1], fields->stress[s],
                                             fields->components[s]};
    }
    return now;
}

static fracas_err begin(fracas_cli_film *film, const fracas_film_instant *first, size_t most)
{
    char size[FRACAS_SIZE_TEXT];
    film->bytes = fracas_film_bytes(first, most);
    fracas_size_write(film->bytes, size);
    if (!(film->bytes <= FRACAS_FILM_BYTES))
        return fracas_fail(FRACAS_USAGE,
                           "a film of %zu instants would have %s, more than browsers like to hold: "
                           "raise --every, or see --fields in ParaView",
                           most, size);
    if (film->out)
        fprintf(film->out, "film: up to %zu instant%s, %s\n", most, most == 1 ? "" : "s", size);
    if (film->out) fflush(film->out);
    return fracas_film_create(first, most, &film->film);
}

fracas_err fracas_cli_film_show(void *context, const fracas_fields *fields, size_t most)
{
    fracas_cli_film *film = context;
    const fracas_film_instant now = instant_of(fields);
    if (!film->film) TRY(begin(film, &now, most));
    film->count++;
    return fracas_film_add(film->film, &now);
}

fracas_err fracas_cli_film_write(fracas_cli_film *film, const fracas_replay *replay)
{
    char title[256];
    snprintf(title, sizeof title, "%s: point %zu, replica %" PRId64, replay->campaign->name,
             replay->point, replay->replica);
    TRY(fracas_film_write(film->film, film->folder, film->name, title,
                          "Each element is where it has moved."));
    if (film->out)
        fprintf(film->out, "%s: %zu instant%s\n", film->path, film->count,
                film->count == 1 ? "" : "s");
    return FRACAS_OK;
}
