/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Small runs: by processes of this program, and by mpirun. */
#include "cli/doctor.h"

#include "base/own.h"
#include "base/text.h"
#include "campaigns/scheduler/launch/allocation.h"
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/mailbox.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- a program and its output ---- */

typedef struct {
    int status; /* exit status; -1: it took too long, or died */
    double seconds;
    char said[2048]; /* the end of its output */
} outcome;

static _Noreturn void become(char *const *argv, const char *mpirun, int out)
{
    setpgid(0, 0);
    setenv("FRACAS_MPIRUN", mpirun, 1);
    unsetenv(FRACAS_LAUNCHER_MARK);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(argv[0], argv);
    _exit(errno == ENOENT ? 127 : 126);
}

/* Reads until the end or the deadline; keeps the last bytes. */
static bool listen_to(int in, double until, outcome *to)
{
    size_t used = 0;
    struct pollfd from = {in, POLLIN, 0};
    for (double left; (left = until - fracas_now()) > 0;) {
        if (poll(&from, 1, (int)(1e3 * left) + 1) <= 0) continue;
        if (used > sizeof to->said / 2) {
            memmove(to->said, to->said + used / 2, used - used / 2);
            used -= used / 2;
        }
        const ssize_t n = read(in, to->said + used, sizeof to->said - 1 - used);
        if (n <= 0) return true;
        used += (size_t)n;
        to->said[used] = '\0';
    }
    return false;
}

static outcome run(char *const *argv, const char *mpirun)
{
    enum { SECONDS = 60 };
    outcome of = {.status = -1};
    int pipe_of[2], status;
    const double began = fracas_now();
    if (pipe2(pipe_of, O_CLOEXEC)) return of;
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) become(argv, mpirun, pipe_of[1]);
    close(pipe_of[1]);
    const bool ended = pid > 0 && listen_to(pipe_of[0], began + SECONDS, &of);
    close(pipe_of[0]);
    if (pid > 0 && !ended) kill(-pid, SIGKILL);
    while (pid > 0 && waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
    of.seconds = fracas_now() - began;
    if (ended && WIFEXITED(status)) of.status = WEXITSTATUS(status);
    return of;
}

/* The last line that says something. */
static const char *last_line(char *text)
{
    for (char *end = strrchr(text, '\n'); end; end = strrchr(text, '\n')) {
        *end = '\0';
        if (end[1]) return end + 1;
    }
    return *text ? text : "nothing was said";
}

/* ---- a run of two processes ---- */

static const char campaign[] =
    "name: doctor\nseed: 1\nmodel: bar\ngeometry: {ends: periodic, length: 1 mm, area: 1 mm2}\n"
    "mesh: {elements: 50}\nmaterial: {young: 275 GPa, density: 2750 kg/m3}\n"
    "cohesive: {law: nitsche, fracture_energy: 100 J/m2, beta: 4}\n"
    "strength: {distribution: uniform, minimum: 299 MPa, maximum: 301 MPa}\n"
    "loading: {type: imposed-rate, rate: 1e5 1/s}\n"
    "time: {stop: quiet, end: 300 ns, quiet: 50 ns, safety: 0.25}\nreplicas: 2\n";

static void look_at_run_by(fracas_patient *patient, const char *by, const char *mpirun)
{
    char self[] = "/proc/self/exe", program[PATH_MAX] = "", file[PATH_MAX + 64],
         study[PATH_MAX + 64];
    if (!*patient->own) {
        fracas_patient_say(patient, FRACAS_NOTED, "not tried, for want of a folder");
        return;
    }
    if (readlink(self, program, sizeof program - 1) < 0)
        snprintf(program, sizeof program, "fracas");
    snprintf(file, sizeof file, "%s/doctor.yaml", patient->own);
    snprintf(study, sizeof study, "%s/by-%s", patient->own, by);
    if (!fracas_patient_write(patient, "doctor.yaml", campaign)) {
        fracas_patient_say(patient, FRACAS_WRONG, "cannot write %s: %s%s", file, strerror(errno),
                           fracas_remedy(errno));
        return;
    }
    char word_run[] = "run", word_study[] = "--study", word_jobs[] = "--jobs", two[] = "2";
    char *const argv[] = {program, word_run, file, word_study, study, word_jobs, two, NULL};
    outcome of = run(argv, mpirun);
    if (of.status == 0)
        fracas_patient_say(patient, FRACAS_SOUND,
                           "%s starts two ranks, which compute two bodies and end in %.1f s", by,
                           of.seconds);
    else
        fracas_patient_say(patient, FRACAS_WRONG,
                           "a run of two ranks by %s ended with %d after %.1f s: %s", by, of.status,
                           of.seconds, last_line(of.said));
}

static void look_at_run(fracas_patient *patient)
{
    look_at_run_by(patient, "fracas", "0");
}

static void look_at_mpirun(fracas_patient *patient)
{
    char word[] = "mpirun", version[] = "--version", library[128];
    char *const argv[] = {word, version, NULL};
    outcome of = run(argv, "0");
    fracas_mailbox_version(library, sizeof library);
    if (of.status == 0) {
        of.said[strcspn(of.said, "\n")] = '\0';
        fracas_patient_say(patient, FRACAS_SOUND, "%s; fracas has %s", of.said, library);
    } else
        fracas_patient_say(patient, fracas_allocation_spreads() ? FRACAS_WRONG : FRACAS_NOTED,
                           "%s: a run on this machine does without it, one on several needs it; "
                           "install Debian's openmpi-bin, or load the module of your cluster",
                           of.status == 127 ? "no mpirun in PATH" : "mpirun does not start");
}

static void look_at_ranks(fracas_patient *patient)
{
    char word[] = "mpirun", version[] = "--version";
    char *const argv[] = {word, version, NULL};
    if (run(argv, "0").status == 0) look_at_run_by(patient, "mpirun", "1");
    else fracas_patient_say(patient, FRACAS_NOTED, "not tried, for want of mpirun");
}

const fracas_checkup fracas_checkups_run[] = {
    {"run", look_at_run}, {"mpirun", look_at_mpirun}, {"ranks by MPI", look_at_ranks}, {0}};
