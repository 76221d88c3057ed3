/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Threads that run one task together. */
#include "base/team.h"
#include "tests/support/test.h"

#include <pthread.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

enum { MOST = 7, STAGES = 20 };

typedef struct {
    fracas_team *team;
    size_t members;
    int stage[MOST];
    int behind; /* members found a stage behind after a meeting */
    pthread_t thread[MOST];
} work;

/* After each meeting every member has reached the stage. */
static void stages(void *context, size_t member)
{
    work *w = context;
    w->thread[member] = pthread_self();
    for (int s = 1; s <= STAGES; s++) {
        w->stage[member] = s;
        fracas_team_meet(w->team);
        for (size_t m = 0; m < w->members; m++)
            if (w->stage[m] != s) __atomic_add_fetch(&w->behind, 1, __ATOMIC_RELAXED);
        fracas_team_meet(w->team);
    }
}

static void all_run_and_meet(void **state)
{
    for (size_t members = 1; members <= MOST; members++) {
        work w = {.members = members};
        OK(fracas_team_create(members, &w.team));
        assert_int_equal(w.team != NULL, members > 1);
        for (int again = 0; again < 10; again++) {
            memset(w.stage, 0, sizeof w.stage);
            fracas_team_run(w.team, stages, &w);
            assert_int_equal(w.behind, 0);
            for (size_t m = 0; m < members; m++) {
                assert_int_equal(w.stage[m], STAGES);
                assert_int_equal(pthread_equal(w.thread[m], pthread_self()) != 0, m == 0);
            }
        }
        fracas_team_destroy(w.team);
    }
}

static void look_at_signals(void *context, size_t member)
{
    sigset_t blocked;
    pthread_sigmask(SIG_SETMASK, NULL, &blocked);
    ((int *)context)[member] = sigismember(&blocked, SIGTERM) && sigismember(&blocked, SIGALRM);
}

static void signals_are_the_callers(void **state)
{
    int blocked[3] = {0};
    OWN(fracas_team) team = NULL;
    OK(fracas_team_create(3, &team));
    fracas_team_run(team, look_at_signals, blocked);
    assert_true(!blocked[0] && blocked[1] && blocked[2]);
}

/* Those that have started end again. */
static void no_more_threads(void **state)
{
#ifndef __SANITIZE_ADDRESS__ /* which needs address space */
    struct rlimit before;
    fracas_team *team = NULL;
    unsigned long pages = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    assert_int_equal(fscanf(file, "%lu", &pages), 1);
    fclose(file);
    getrlimit(RLIMIT_AS, &before);
    const struct rlimit little = {pages * (rlim_t)sysconf(_SC_PAGESIZE) + (20 << 20),
                                  before.rlim_max};
    setrlimit(RLIMIT_AS, &little);
    const fracas_err err = fracas_team_create(1000, &team);
    setrlimit(RLIMIT_AS, &before);
    assert_int_equal(err, FRACAS_ENVIRONMENT);
    assert_null(team);
    assert_non_null(strstr(fracas_message(), "of 1000 for one body cannot start"));
#endif
}

TESTS(all_run_and_meet, signals_are_the_callers, no_more_threads)
