/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/director/state.h"

#include <stdlib.h>

void fracas_director_fail(fracas_director *director, const fracas_trouble *trouble)
{
    if (!director->trouble.code) director->trouble = *trouble;
    fracas_director_stop(director);
}

void fracas_director_check(fracas_director *director, fracas_err err)
{
    if (!err) return;
    fracas_trouble trouble;
    fracas_trouble_take(err, &trouble);
    fracas_director_fail(director, &trouble);
}

fracas_err fracas_director_post(fracas_director *director, size_t worker, fracas_packet_kind kind,
                                const void *body, size_t size)
{
    OWNED fracas_packet *message = NULL;
    TRY(fracas_packet_create(kind, body, size, &message));
    return director->setup.send(director->setup.context, worker, message);
}

void fracas_director_stop_worker(fracas_director *director, size_t worker)
{
    const int32_t kill = director->needless || director->overtime;
    director->phase[worker] = STOPPING;
    fracas_director_check(
        director, fracas_director_post(director, worker, FRACAS_PACKET_STOP, &kill, sizeof kill));
}

void fracas_director_stop(fracas_director *director)
{
    if (director->stopping) return;
    director->stopping = true;
    director->stopped_at = director->setup.now();
    for (size_t worker = 0; worker < director->setup.workers; worker++)
        if (director->phase[worker] == WORKING) fracas_director_stop_worker(director, worker);
}

void fracas_director_end_worker(fracas_director *director, size_t worker)
{
    if (director->phase[worker] == ENDED) return;
    director->phase[worker] = ENDED;
    director->nended++;
    fracas_scheduler_lost(director->scheduler, worker); /* nothing, if it ended in order */
}

fracas_err fracas_director_announce(fracas_director *director, const char *kind, const char *text)
{
    fracas_channel_message(director->setup.channel, "%s", text);
    return fracas_index_event(director->index, kind, text);
}

bool fracas_director_computed(const fracas_director *director)
{
    return fracas_scheduler_computed_all(director->scheduler) && director->rounds.open == 0;
}

bool fracas_director_durable(const fracas_director *director)
{
    return fracas_director_computed(director) &&
           fracas_scheduler_count(director->scheduler).memory == 0;
}

void fracas_director_drain(fracas_director *director)
{
    if (director->drained) return;
    director->drained = true;
    fracas_director_stop(director);
}

void fracas_director_note(fracas_director *director, const char *kind, const char *text)
{
    fracas_director_check(director, fracas_index_event(director->index, kind, text));
}

bool fracas_director_over(const fracas_director *director)
{
    return director->nended == director->setup.workers;
}
