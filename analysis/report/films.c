/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/report/films.h"

#include "analysis/film/film.h"
#include "base/own.h"

#include <math.h>
#include <stdlib.h>

static fracas_film_instant body_of(const fracas_flight *flight)
{
    return (fracas_film_instant){.elements = flight->mesh.nelements,
                                 .corners = flight->corners,
                                 .interfaces = flight->mesh.ninterfaces,
                                 .ends = flight->ends};
}

double fracas_flight_film_bytes(const fracas_flight *flight, size_t count)
{
    const fracas_film_instant body = body_of(flight);
    return fracas_film_bytes(&body, count);
}

size_t fracas_flight_film_most(const fracas_flight *flight)
{
    const double one = fracas_flight_film_bytes(flight, 2) - fracas_flight_film_bytes(flight, 1),
                 still = fracas_flight_film_bytes(flight, 0);
    return (size_t)fmax(0, (FRACAS_FILM_BYTES - still) / one);
}

/* 0 closed, 1 broken, half of it while it is cracked. */
static void fill_interfaces(const fracas_flight *flight, const fracas_surface_state *state,
                            int64_t (*between)[2], double *damage)
{
    static const double worth[] = {[FRACAS_INTERFACE_CLOSED] = 0,
                                   [FRACAS_INTERFACE_CRACKED] = 0.5,
                                   [FRACAS_INTERFACE_BROKEN] = 1};
    for (size_t i = 0; i < flight->mesh.ninterfaces; i++) {
        for (int side = 0; side < 2; side++)
            between[i][side] = flight->mesh.interface[i].element[side];
        damage[i] = worth[state->interface[i]];
    }
}

/* Adds the body at a time to the film, which is made by the first of `count`. */
static fracas_err add(const fracas_flight *flight, double time, size_t count, fracas_film **film)
{
    FRACAS_CLEARED(fracas_flight_instant) now = {.mass = NULL};
    fracas_film_instant instant = body_of(flight);
    OWNED int64_t *fragment = malloc((instant.elements + 1) * sizeof *fragment);
    OWNED int64_t(*between)[2] = malloc((instant.interfaces + 1) * sizeof *between);
    OWNED double *damage = malloc((instant.interfaces + 1) * sizeof *damage);
    if (!fragment || !between || !damage) return fracas_no_memory("a film");
    TRY(fracas_flight_at(flight, time, &now));
    for (size_t e = 0; e < instant.elements; e++) fragment[e] = now.state.fragment[e];
    fill_interfaces(flight, &now.state, between, damage);
    instant.time = time;
    instant.place = (const double(*)[3])now.place;
    instant.displacement = (const double(*)[3])now.displacement;
    instant.velocity = (const double(*)[3])now.velocity;
    instant.fragment = fragment;
    instant.between = (const int64_t(*)[2])between;
    instant.damage = damage;
    if (!*film) TRY(fracas_film_create(&instant, count, film));
    return fracas_film_add(*film, &instant);
}

fracas_err fracas_flight_film(const fracas_flight *flight, const double *time, size_t count,
                              const char *folder, const char *name, const char *title)
{
    OWN(fracas_film) film = NULL;
    for (size_t k = 0; k < count; k++) TRY(add(flight, time[k], count, &film));
    return fracas_film_write(film, folder, name, title,
                             "Each fragment is a rigid body, which moves back from its place at "
                             "the end with the velocity and the spin it has there; `fracas replay "
                             "--film` shows it as it was computed.");
}
