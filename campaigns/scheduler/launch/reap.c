/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/reap.h"

#include "base/own.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* Parent of a process; 0 if it is gone. /proc/PID/stat is "PID (NAME) STATE PARENT ...", and NAME
 * may have parentheses. */
static pid_t parent_of(pid_t pid)
{
    char path[64], text[512] = "";
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)pid);
    OWN(FILE) file = fopen(path, "r");
    if (!file) return 0;
    text[fread(text, 1, sizeof text - 1, file)] = '\0';
    const char *rest = strrchr(text, ')');
    long parent = 0;
    return rest && sscanf(rest, ") %*c %ld", &parent) == 1 ? (pid_t)parent : 0;
}

static size_t place_of(const fracas_reap *reap, pid_t pid)
{
    size_t i = 0;
    while (i < reap->nforeign && reap->foreign[i] != pid) i++;
    return i;
}

/* Calls `act` with each child but foreign ones, and returns their number. */
static size_t each_child(fracas_reap *reap, void (*act)(fracas_reap *reap, pid_t pid))
{
    size_t count = 0;
    DIR *all = opendir("/proc");
    if (!all) return 0;
    for (const struct dirent *entry; (entry = readdir(all));) {
        const pid_t pid = (pid_t)strtol(entry->d_name, NULL, 10);
        if (pid <= 0 || parent_of(pid) != getpid() || place_of(reap, pid) < reap->nforeign)
            continue;
        count++;
        if (act) act(reap, pid);
    }
    closedir(all);
    return count;
}

static void note_foreign(fracas_reap *reap, pid_t pid)
{
    if (reap->nforeign < FRACAS_FOREIGN_MAX) reap->foreign[reap->nforeign++] = pid;
}

void fracas_reap_begin(fracas_reap *reap)
{
    *reap = (fracas_reap){0};
    each_child(reap, note_foreign);
    prctl(PR_SET_CHILD_SUBREAPER, 1);
}

bool fracas_reap_wait(fracas_reap *reap, pid_t pid, int *status)
{
    int one;
    pid_t ended;
    while ((ended = waitpid(-1, &one, WNOHANG)) > 0 || (ended < 0 && errno == EINTR)) {
        if (ended == pid) *status = one;
        const size_t i = place_of(reap, ended);
        if (i < reap->nforeign) reap->foreign[i] = reap->foreign[--reap->nforeign];
    }
    return ended == 0 && (reap->nforeign == 0 || each_child(reap, NULL) > 0);
}

static void kill_child(fracas_reap *reap, pid_t pid)
{
    (void)reap;
    kill(pid, SIGKILL);
}

void fracas_reap_kill(fracas_reap *reap)
{
    each_child(reap, kill_child);
}
