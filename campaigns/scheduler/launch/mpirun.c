/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/mpirun.h"

#include "base/own.h"
#include "base/param.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/scheduler/status/channel.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

static void set_environment(void)
{
    static const struct {
        const char *name, *value;
    } quiet[] = {
        {FRACAS_LAUNCHER_MARK, "1"},
        /* Containers lack the ptrace permission for copies between processes: Open MPI warns. */
        {"OMPI_MCA_btl_vader_single_copy_mechanism", "none"},
        /* No warning where a fast network is compiled in and not there. */
        {"OMPI_MCA_btl_base_warn_component_unused", "0"},
        {"OMPI_MCA_orte_base_help_aggregate", "1"},
        /* A crashed rank dies at once: the backtrace of Open MPI hung where memory was short. */
        {"OMPI_MCA_opal_signal", ""},
        /* hwloc warns of contradictory firmware tables; nothing is bound here. */
        {"HWLOC_HIDE_ERRORS", "2"},
    };
    for (size_t i = 0; i < FRACAS_COUNT(quiet); i++) setenv(quiet[i].name, quiet[i].value, 1);
    setenv("PATH", "/usr/local/bin:/usr/bin:/bin", 0); /* mpirun fails without any */
    if (geteuid() == 0) { /* mpirun refuses to run as root without both */
        setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
        setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    }
}

static _Noreturn void become_mpirun(char **arguments, const fracas_scratch *scratch)
{
    static const int reset[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE};
    for (size_t i = 0; i < FRACAS_COUNT(reset); i++) signal(reset[i], SIG_DFL);
    set_environment();
    fracas_scratch_export(scratch);
    execvp(arguments[0], arguments);
    _exit(FRACAS_MPIRUN_MISSING);
}

/* Runs `mpirun -n jobs <this program> argv[1] ...`. */
static fracas_err start(const fracas_ranks *ranks, fracas_scratch *scratch, fracas_starter *starter)
{
    char self[4096], count[16], colon[] = "./:";
    char *const before[] = {"mpirun", "--oversubscribe", "--bind-to", "none", "-n", count, self};
    const size_t given = ranks->argc > 1 ? (size_t)ranks->argc - 1 : 0;
    OWNED char **arguments = calloc(FRACAS_COUNT(before) + given + 1, sizeof *arguments);
    if (!arguments) return fracas_no_memory("the arguments of mpirun");
    memcpy(arguments, before, sizeof before);
    for (size_t i = 0; i < given; i++) { /* a lone colon separates programs for mpirun */
        char *one = ranks->argv[i + 1];
        arguments[FRACAS_COUNT(before) + i] = strcmp(one, ":") ? one : colon;
    }
    snprintf(count, sizeof count, "%d", ranks->jobs);
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    if (n < 0)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot find this program: /proc/self/exe: %s",
                           strerror(errno));
    self[n] = '\0';
    TRY(fracas_scratch_create(scratch));
    TRY(fracas_starter_fork(starter));
    if (starter->pid == 0) become_mpirun(arguments, scratch);
    return FRACAS_OK;
}

/* Measured: Open MPI 4.1.4 hung with fewer than 24 + 4 jobs files, and with files below 4.2 MB, its
 * shared memory. */
static fracas_err check(int jobs)
{
    enum { FILES = 40, FILES_A_JOB = 5, FILE_SIZE = 8 << 20, MOST_JOBS = 1024 /* on a machine */ };
    struct rlimit limit;
    TRY(fracas_starter_raise_files(
        FILES + FILES_A_JOB * (unsigned long)(jobs > MOST_JOBS ? MOST_JOBS : jobs)));
    if (!getrlimit(RLIMIT_FSIZE, &limit) && limit.rlim_cur < FILE_SIZE)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "a file may have %llu bytes, MPI needs %d for its shared memory; raise "
                           "the limit on the size of files (`ulimit -f`)",
                           (unsigned long long)limit.rlim_cur, FILE_SIZE);
    return FRACAS_OK;
}

const fracas_starter_kind fracas_starter_mpirun = {"mpirun", check, start};

/* The first line of `output` with `key` in it; key NULL: with any letter. */
static bool find_line(const char *output, const char *key, char *text, size_t size)
{
    for (const char *line = output; *line;) {
        const size_t length = strcspn(line, "\n"), blank = strspn(line, " \t*");
        snprintf(text, size, "%.*s", (int)(length - blank < size ? length - blank : size - 1),
                 line + blank);
        if (key ? strstr(text, key) != NULL : strpbrk(text, "abcdefghijklmnopqrstuvwxyz") != NULL)
            return true;
        line += length + (line[length] == '\n');
    }
    *text = '\0';
    return false;
}

bool fracas_mpirun_hopeless(const char *output, char *text, size_t size)
{
    char framework[64], component[64];
    if (!find_line(output, "requested component was not found", text, size) ||
        !find_line(output, "Framework: ", framework, sizeof framework) ||
        !find_line(output, "Component: ", component, sizeof component))
        return false;
    const char *of = framework + strlen("Framework: ");
    snprintf(text, size,
             "Open MPI has no component `%s` of `%s`: correct OMPI_MCA_%s, or take it out of the "
             "environment (or of ~/.openmpi/mca-params.conf)",
             component + strlen("Component: "), of, of);
    return true;
}

void fracas_mpirun_reason(const char *output, char *text, size_t size)
{
    static const char *const telling[] = {"noticed that",
                                          "MPI_ABORT was invoked",
                                          "lost communication with",
                                          "not enough slots",
                                          "fracas: ",
                                          "ended with status",
                                          "unable to",
                                          "failed",
                                          "rror",
                                          NULL};
    for (size_t i = 0; i < FRACAS_COUNT(telling); i++)
        if (find_line(output, telling[i], text, size)) break;
    for (size_t end = strlen(text); end > 0 && strchr(" .", text[end - 1]); end--)
        text[end - 1] = '\0';
}
