/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/signals.h"

#include "base/err.h"
#include "base/param.h"

#include <signal.h>
#include <stddef.h>
#include <unistd.h>

/* Number of SIGINT, SIGTERM and SIGHUP so far, at most 2; SIGUSR1 or SIGUSR2 came. */
static volatile sig_atomic_t ended, drained;

static const int ending[] = {SIGINT, SIGTERM, SIGHUP}, draining[] = {SIGUSR1, SIGUSR2};

static void count(int signal_number)
{
    (void)signal_number;
    if (ended < 2) ended++;
}

static void drain(int signal_number)
{
    (void)signal_number;
    drained = 1;
}

static void leave(int signal_number)
{
    (void)signal_number;
    static const char text[] =
        "fracas: interrupted; what was computed is kept: the same command goes on from there\n";
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0) _exit(FRACAS_INTERRUPTED);
    _exit(FRACAS_INTERRUPTED);
}

/* One handler at a time. */
static void set(const int *number, size_t n, void (*handler)(int))
{
    struct sigaction action = {.sa_handler = handler, .sa_flags = SA_RESTART};
    sigfillset(&action.sa_mask);
    for (size_t i = 0; i < n; i++) {
        struct sigaction before;
        sigaction(number[i], &action, &before);
        if (number[i] == SIGHUP && before.sa_handler == SIG_IGN) sigaction(SIGHUP, &before, NULL);
    }
}

void fracas_signals_catch(void)
{
    ended = drained = 0;
    set(ending, FRACAS_COUNT(ending), count);
    set(draining, FRACAS_COUNT(draining), drain);
    signal(SIGPIPE, SIG_IGN);
}

void fracas_signals_catch_rank(void)
{
    static const int asking[] = {SIGUSR1, SIGUSR2, SIGTERM, SIGINT};
    set(asking, FRACAS_COUNT(asking), drain);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
}

bool fracas_signals_ask(void)
{
    return ended > 0 || drained;
}

bool fracas_signals_insist(void)
{
    return ended > 1;
}

void fracas_signals_end(void)
{
    set(ending, FRACAS_COUNT(ending), leave);
    set(draining, FRACAS_COUNT(draining), SIG_IGN);
    signal(SIGPIPE, SIG_DFL);
}
