#include "campaigns/scheduler/launch/reaper.h"

#include <dirent.h>
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

void fracas_reaper_begin(void)
{
    prctl(PR_SET_CHILD_SUBREAPER, 1);
}

bool fracas_reaper_wait(pid_t pid, int *status)
{
    int one;
    pid_t ended;
    while ((ended = waitpid(-1, &one, WNOHANG)) > 0 || (ended < 0 && errno == EINTR))
        if (ended == pid) *status = one;
    return ended == 0;
}

/* The parent of a process; 0 if it is gone. /proc/PID/stat: "PID (NAME) STATE PARENT ...", NAME may have parentheses. */
static pid_t parent_of(pid_t pid)
{
    char path[64], text[512] = "";
    snprintf(path, sizeof path, "/proc/%ld/stat", (long)pid);
    FILE *file = fopen(path, "r");
    if (!file) return 0;
    const size_t n = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[n] = '\0';
    const char *rest = strrchr(text, ')');
    long parent = 0;
    return rest && sscanf(rest, ") %*c %ld", &parent) == 1 ? (pid_t)parent : 0;
}

void fracas_reaper_kill(void)
{
    DIR *all = opendir("/proc");
    if (!all) return;
    for (const struct dirent *entry; (entry = readdir(all));) {
        const pid_t pid = (pid_t)strtol(entry->d_name, NULL, 10);
        if (pid > 0 && parent_of(pid) == getpid()) kill(pid, SIGKILL);
    }
    closedir(all);
}
