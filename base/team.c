/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/team.h"

#include <pthread.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    fracas_team *team;
    size_t number;
    pthread_t thread;
} team_member;

struct fracas_team {
    pthread_mutex_t lock;
    pthread_cond_t met;
    size_t members, waiting, meetings; /* guarded by the lock */
    fracas_team_task *task;            /* NULL: the members end */
    void *context;
    team_member member[]; /* [members - 1] */
};

/* The members meet before a task, after it, and wherever it says so. */
static void meet(fracas_team *team)
{
    pthread_mutex_lock(&team->lock);
    const size_t meeting = team->meetings;
    if (++team->waiting == team->members) {
        team->waiting = 0;
        team->meetings++;
        pthread_cond_broadcast(&team->met);
    }
    while (team->meetings == meeting) pthread_cond_wait(&team->met, &team->lock);
    pthread_mutex_unlock(&team->lock);
}

static void *member_main(void *argument)
{
    const team_member *member = argument;
    fracas_team *team = member->team;
    for (;;) {
        meet(team);
        if (!team->task) return NULL;
        team->task(team->context, member->number);
        meet(team);
    }
}

/* Signals are for the caller. A small stack, as it counts against --memory-limit. */
static int start(team_member *member)
{
    enum { STACK = 1 << 20 };
    sigset_t all, before;
    pthread_attr_t attributes;
    sigfillset(&all);
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, STACK);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const int status = pthread_create(&member->thread, &attributes, member_main, member);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    pthread_attr_destroy(&attributes);
    return status;
}

fracas_err fracas_team_create(size_t members, fracas_team **out)
{
    *out = NULL;
    if (members < 2) return FRACAS_OK;
    OWN(fracas_team) team = calloc(1, sizeof *team + (members - 1) * sizeof *team->member);
    if (!team) return fracas_no_memory("threads");
    pthread_mutex_init(&team->lock, NULL);
    pthread_cond_init(&team->met, NULL);
    team->members = members;
    for (size_t i = 0; i < members - 1; i++) {
        team->member[i] = (team_member){.team = team, .number = i + 1};
        const int status = start(&team->member[i]);
        if (!status) continue;
        pthread_mutex_lock(&team->lock);
        team->members = i + 1;
        pthread_mutex_unlock(&team->lock);
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "thread %zu of %zu for one body cannot start: %s; raise the limit on "
                           "processes (`ulimit -u`), or give fewer parallel.parts",
                           i + 2, members, strerror(status));
    }
    *out = team;
    team = NULL;
    return FRACAS_OK;
}

void fracas_team_destroy(fracas_team *team)
{
    if (!team) return;
    team->task = NULL;
    meet(team);
    for (size_t i = 0; i < team->members - 1; i++) pthread_join(team->member[i].thread, NULL);
    pthread_cond_destroy(&team->met);
    pthread_mutex_destroy(&team->lock);
    free(team);
}

void fracas_team_run(fracas_team *team, fracas_team_task *task, void *context)
{
    if (!team) {
        task(context, 0);
        return;
    }
    team->task = task;
    team->context = context;
    meet(team);
    task(context, 0);
    meet(team);
}

void fracas_team_meet(fracas_team *team)
{
    if (team) meet(team);
}
