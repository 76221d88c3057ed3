/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/worker/supervisor.h"

#include "base/param.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/packet.h"
#include "campaigns/scheduler/types/process.h"
#include "campaigns/scheduler/worker/server.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

/* The supervisor sends a connection to a new server, or the reason for its lack or death. The rank
 * answers a death with a byte if it wants a new server. */

static const double PATIENCE = 2; /* for a server to end once its rank has closed it [s] */

/* ---- the two ends of the control socket ---- */

/* Sends `trouble`, and a connection unless it is -1; false if the rank is gone. */
static bool tell(int control, const fracas_trouble *trouble, int connection)
{
    union {
        struct cmsghdr head;
        char room[CMSG_SPACE(sizeof connection)];
    } with = {.head = {.cmsg_len = CMSG_LEN(sizeof connection),
                       .cmsg_level = SOL_SOCKET,
                       .cmsg_type = SCM_RIGHTS}};
    struct iovec body = {(void *)trouble, sizeof *trouble};
    struct msghdr message = {.msg_iov = &body, .msg_iovlen = 1};
    if (connection >= 0) {
        memcpy(CMSG_DATA(&with.head), &connection, sizeof connection);
        message.msg_control = &with;
        message.msg_controllen = sizeof with;
    }
    ssize_t n;
    do n = sendmsg(control, &message, MSG_NOSIGNAL);
    while (n < 0 && errno == EINTR);
    return n == (ssize_t)sizeof *trouble;
}

/* Receives a message of tell(); *connection is -1 if it has none. False if the supervisor is gone.
 */
static bool receive(int control, fracas_trouble *trouble, int *connection)
{
    union {
        struct cmsghdr head;
        char room[CMSG_SPACE(sizeof *connection)];
    } with;
    struct iovec body = {trouble, sizeof *trouble};
    struct msghdr message = {
        .msg_iov = &body, .msg_iovlen = 1, .msg_control = &with, .msg_controllen = sizeof with};
    ssize_t n;
    do n = recvmsg(control, &message, MSG_CMSG_CLOEXEC);
    while (n < 0 && errno == EINTR);
    *connection = -1;
    const struct cmsghdr *head = n > 0 ? CMSG_FIRSTHDR(&message) : NULL;
    if (head) memcpy(connection, CMSG_DATA(head), sizeof *connection);
    return n == (ssize_t)sizeof *trouble;
}

/* ---- the supervisor ---- */

typedef struct {
    const fracas_campaign *campaign;
    const fracas_run_options *options;
    const char *study;
    int control;
    sigset_t mask; /* with SIGCHLD let through */
} supervisor;

static void wake(int signal_number)
{
    (void)signal_number; /* ppoll returns */
}

/* Draining is rank 0's decision: the supervisor, its servers and their children ignore the signals
 * of mpirun and terminals. */
static void set_up_process(supervisor *k)
{
    /* The last two become errors of write. */
    static const int ignored[] = {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGUSR2, SIGPIPE, SIGXFSZ};
    for (size_t i = 0; i < FRACAS_COUNT(ignored); i++) signal(ignored[i], SIG_IGN);
    int null = open("/dev/null", O_RDWR | O_CLOEXEC);
    if (null >= 0) {
        dup2(null, STDIN_FILENO);
        dup2(null, STDOUT_FILENO); /* rank 0's is the status channel */
        if (null > STDERR_FILENO) close(null);
    }
    prctl(PR_SET_CHILD_SUBREAPER, 1);
    sigset_t child;
    sigemptyset(&child);
    sigaddset(&child, SIGCHLD);
    sigprocmask(SIG_BLOCK, &child, &k->mask);
    sigdelset(&k->mask, SIGCHLD);
    signal(SIGCHLD, wake);
}

static fracas_err start_server(supervisor *k, int *connection, pid_t *pid)
{
    int pair[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair))
        return fracas_fail_system(errno, "no connection to a compute server");
    const bool computes = k->options->isolation == FRACAS_ISOLATION_NONE;
    fracas_err err = fracas_process_fork("fracas-server",
                                         computes ? FRACAS_OOM_COMPUTING_SERVER : FRACAS_OOM_SAME,
                                         "a compute server", pid);
    if (*pid == 0) {
        signal(SIGCHLD, SIG_DFL);
        sigprocmask(SIG_SETMASK, &k->mask, NULL);
        close(k->control);
        close(pair[0]);
        fracas_server_run(k->campaign, k->options, k->study, pair[1]);
    }
    if (err) close(pair[0]);
    close(pair[1]);
    *connection = pair[0];
    return err;
}

/* True, and its status, when the server has ended. Reaps orphans of this and earlier servers as
 * well. */
static bool reap(pid_t server, int *status)
{
    bool ended = false;
    int one;
    for (pid_t pid; (pid = waitpid(-1, &one, WNOHANG)) > 0;) {
        if (pid != server) continue;
        ended = true;
        *status = one;
    }
    return ended;
}

/* Waits for the server's end, PATIENCE once the rank has closed its connection. */
static int wait_for_server(const supervisor *k, pid_t pid)
{
    double until = INFINITY;
    int status = 0;
    while (!reap(pid, &status)) {
        const bool closed = !isinf(until);
        const double left = closed ? fmax(until - fracas_now(), 1e-3) : 0;
        const struct timespec timeout = {.tv_sec = (time_t)left,
                                         .tv_nsec = (long)(fmod(left, 1) * 1e9)};
        struct pollfd from = {.fd = k->control, .events = POLLIN};
        /* The rank sends nothing while there is a server: an event is the end of the connection. */
        if (ppoll(&from, closed ? 0 : 1, closed ? &timeout : NULL, &k->mask) > 0)
            until = fracas_now() + PATIENCE;
        if (fracas_now() >= until) kill(pid, SIGKILL);
    }
    return status;
}

/* Main loop: server after server, until the rank wants no more. */
static _Noreturn void supervise(supervisor *k)
{
    char again;
    set_up_process(k);
    do {
        fracas_trouble trouble = {0};
        int connection = -1;
        pid_t pid = 0;
        fracas_err err = start_server(k, &connection, &pid);
        if (err) {
            fracas_trouble_take(err, &trouble);
            tell(k->control, &trouble, -1);
            _exit(FRACAS_ENVIRONMENT);
        }
        if (!tell(k->control, &trouble, connection))
            _exit(FRACAS_ENVIRONMENT); /* the rank is gone, or would wait for ever */
        close(connection);
        const int status = wait_for_server(k, pid);
        trouble.code = FRACAS_ENVIRONMENT;
        fracas_process_end_text(status, trouble.text, sizeof trouble.text);
        if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
            snprintf(trouble.text, sizeof trouble.text,
                     "was killed by its timer: a lease took longer than it may (--lease-limit)");
        tell(k->control, &trouble, -1);
    } while (read(k->control, &again, 1) == 1);
    _exit(0);
}

/* ---- the rank ---- */

static void release(fracas_supervisor *one, int *status)
{
    if (one->server >= 0) close(one->server);
    if (one->control >= 0) close(one->control);
    while (one->pid && waitpid(one->pid, status, 0) < 0 && errno == EINTR)
        ;
    *one = (fracas_supervisor){.control = -1, .server = -1};
}

/* `whose`: subject of the message, which the caller may have written already. */
static fracas_err supervisor_gone(fracas_supervisor *one, const char *whose)
{
    char how[256];
    int status = 0;
    release(one, &status);
    fracas_process_end_text(status, how, sizeof how);
    return fracas_fail(FRACAS_ENVIRONMENT, "%swent with its supervisor, which %s", whose, how);
}

/* The connection to the next server. */
static fracas_err take_server(fracas_supervisor *one)
{
    fracas_trouble trouble;
    if (!receive(one->control, &trouble, &one->server))
        return supervisor_gone(one, "a compute server ");
    if (!trouble.code && one->server >= 0) return FRACAS_OK; /* else the kernel dropped it */
    fracas_supervisor_end(one);
    if (!trouble.code) return fracas_fail_system(EMFILE, "no connection to a compute server");
    return fracas_fail((fracas_err)trouble.code, "%s", trouble.text);
}

fracas_err fracas_supervisor_start(const fracas_campaign *campaign,
                                   const fracas_run_options *options, const char *study,
                                   fracas_supervisor *one)
{
    int pair[2];
    *one = (fracas_supervisor){.control = -1, .server = -1};
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair))
        return fracas_fail_system(errno, "no connection to the supervisor of a compute server");
    pid_t pid;
    fracas_err err = fracas_process_fork("fracas-supervis", FRACAS_OOM_SAME,
                                         "the supervisor of a compute server", &pid);
    if (pid == 0) {
        close(pair[0]);
        supervisor k = {
            .campaign = campaign, .options = options, .study = study, .control = pair[1]};
        supervise(&k);
    }
    close(pair[1]);
    if (err) close(pair[0]);
    TRY(err);
    *one = (fracas_supervisor){.pid = pid, .control = pair[0], .server = -1};
    return take_server(one);
}

fracas_err fracas_supervisor_reap(fracas_supervisor *one, char *how, size_t size)
{
    fracas_trouble trouble;
    int none;
    if (one->server >= 0) close(one->server);
    one->server = -1;
    if (!receive(one->control, &trouble, &none)) return supervisor_gone(one, "");
    snprintf(how, size, "%s", trouble.text);
    return FRACAS_OK;
}

fracas_err fracas_supervisor_restart(fracas_supervisor *one)
{
    if (send(one->control, "", 1, MSG_NOSIGNAL) != 1)
        return supervisor_gone(one, "a compute server ");
    return take_server(one);
}

void fracas_supervisor_end(fracas_supervisor *one)
{
    int status;
    release(one, &status);
}
