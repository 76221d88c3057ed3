/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/mpirun.h"

#include "base/own.h"
#include "base/param.h"
#include "campaigns/scheduler/status/channel.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
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

/* In the new process: never returns. */
static _Noreturn void become_mpirun(char **arguments, pid_t parent, const fracas_scratch *scratch,
                                    const int out[2], const int errors[2])
{
    static const int reset[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE};
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(FRACAS_INTERRUPTED); /* the parent died before the line above */
    for (size_t i = 0; i < FRACAS_COUNT(reset); i++) signal(reset[i], SIG_DFL);
    set_environment();
    fracas_scratch_export(scratch);
    int null = open("/dev/null", O_RDONLY);
    if (null >= 0) dup2(null, STDIN_FILENO);
    dup2(out[1], STDOUT_FILENO);
    dup2(errors[1], STDERR_FILENO);
    execvp(arguments[0], arguments);
    _exit(FRACAS_MPIRUN_MISSING);
}

fracas_err fracas_mpirun_start(int jobs, int argc, char **argv, const fracas_scratch *scratch,
                               fracas_mpirun *mpirun)
{
    char self[4096], count[16], colon[] = "./:";
    char *const before[] = {"mpirun", "--oversubscribe", "--bind-to", "none", "-n", count, self};
    OWNED char **arguments = calloc(FRACAS_COUNT(before) + (size_t)argc + 1, sizeof *arguments);
    if (!arguments) return fracas_no_memory("the arguments of mpirun");
    memcpy(arguments, before, sizeof before);
    for (int i = 1; i < argc; i++) /* a lone colon separates programs for mpirun */
        arguments[FRACAS_COUNT(before) + (size_t)i - 1] = strcmp(argv[i], ":") ? argv[i] : colon;
    snprintf(count, sizeof count, "%d", jobs);
    ssize_t n = readlink("/proc/self/exe", self, sizeof self - 1);
    if (n < 0)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot find this program: /proc/self/exe: %s",
                           strerror(errno));
    self[n] = '\0';
    int out[2] = {-1, -1}, errors[2] = {-1, -1};
    pid_t parent = getpid(), pid = -1;
    if (!pipe2(out, O_CLOEXEC) && !pipe2(errors, O_CLOEXEC)) pid = fork();
    const int reason = errno;
    if (pid == 0) become_mpirun(arguments, parent, scratch, out, errors);
    fracas_err err = FRACAS_OK;
    if (pid < 0) err = fracas_fail_system(reason, "cannot start mpirun");
    if (out[1] >= 0) close(out[1]);
    if (errors[1] >= 0) close(errors[1]);
    if (err) {
        if (out[0] >= 0) close(out[0]);
        if (errors[0] >= 0) close(errors[0]);
        return err;
    }
    setpgid(pid, pid); /* parent and child both do, whoever comes first */
    *mpirun = (fracas_mpirun){pid, out[0], errors[0]};
    return FRACAS_OK;
}

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
    static const char *const telling[] = {"mpirun noticed that",
                                          "MPI_ABORT was invoked",
                                          "lost communication with",
                                          "not enough slots",
                                          "fracas: ",
                                          "unable to",
                                          "failed",
                                          "rror",
                                          NULL};
    for (size_t i = 0; i < FRACAS_COUNT(telling); i++)
        if (find_line(output, telling[i], text, size)) break;
    for (size_t end = strlen(text); end > 0 && strchr(" .", text[end - 1]); end--)
        text[end - 1] = '\0';
}
