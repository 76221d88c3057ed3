/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The launcher, the starter of local ranks, and the guard, with ranks and starters made here. */
#define FOLDER "fracas-launcher"
#include "base/param.h"
#include "campaigns/scheduler/launch/guard.h"
#include "campaigns/scheduler/launch/launcher.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/scheduler/types/clock.h"
#include "tests/support/folder.h"
#include "tests/support/test.h"

#include <dirent.h>
#include <poll.h>
#include <signal.h>
#include <sys/pidfd.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

enum { RANKS = 3, PATIENCE = 30000 /* ms: only a broken program needs them */ };

/* Waits for the end of any process; false: it goes on. */
static bool ends(pid_t pid)
{
    struct pollfd end = {.fd = pidfd_open(pid, 0), .events = POLLIN};
    const bool ended = end.fd < 0 || poll(&end, 1, PATIENCE) == 1;
    if (end.fd >= 0) close(end.fd);
    return ended;
}

/* The status of a child, which has to end. */
static int status_of(pid_t child)
{
    int status = -1;
    const bool ended = ends(child);
    if (!ended) kill(child, SIGKILL);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(ended);
    return status;
}

/* Pipes of a test: from its processes, and to them. */
static int from[2], to[2];

static void open_pipes(void)
{
    assert_int_equal(pipe(from), 0);
    assert_int_equal(pipe(to), 0);
}

static void close_pipes(void)
{
    close(from[0]);
    close(to[0]);
    close(to[1]);
}

/* In a process: tells its number, and waits until the test lets it go on. */
static void tell_and_wait(void)
{
    const pid_t mine = getpid();
    char go;
    if (write(from[1], &mine, sizeof mine) != sizeof mine || read(to[0], &go, 1) != 1) _exit(99);
}

static void let_go(int count)
{
    while (count--) assert_int_equal(write(to[1], "", 1), 1);
}

/* In the test: the numbers of `count` processes, which live. */
static void hear(pid_t *pid, int count)
{
    close(from[1]);
    for (int i = 0; i < count; i++)
        assert_int_equal(read(from[0], &pid[i], sizeof *pid), sizeof *pid);
}

/* SIGUSR1 waits until it is asked for. */
static void hold_signals(sigset_t *before)
{
    sigset_t held;
    sigemptyset(&held);
    sigaddset(&held, SIGUSR1);
    sigprocmask(SIG_BLOCK, &held, before);
}

/* ---- the starter of local ranks ---- */

static fracas_starter start(fracas_rank_life *life, int jobs)
{
    static const fracas_run_options none;
    const fracas_ranks ranks = {.options = &none, .life = life, .jobs = jobs};
    fracas_scratch scratch = FRACAS_SCRATCH_NONE;
    fracas_starter starter;
    OK(fracas_starter_local.start(&ranks, &scratch, &starter));
    return starter;
}

/* Takes out the lines of a sanitizer, "==PID==...": one that found a fault ends its process badly.
 * The search for leaks says so where a thread ends under it. */
static void forget_sanitizers(char *said)
{
    char *kept = said;
    for (const char *line = said; *line;) {
        const size_t size = strcspn(line, "\n") + (strchr(line, '\n') != NULL);
        if (strncmp(line, "==", 2) != 0) {
            memmove(kept, line, size);
            kept += size;
        }
        line += size;
    }
    *kept = '\0';
}

/* The status of a starter that ends, and what it wrote to stderr. */
static int end_of(const fracas_starter *starter, char said[256])
{
    const int status = status_of(starter->pid);
    const ssize_t n = read(starter->errors, said, 255);
    said[n > 0 ? n : 0] = '\0';
    forget_sanitizers(said);
    close(starter->out);
    close(starter->errors);
    return status;
}

static fracas_err end_badly(const fracas_run_options *options, const fracas_mailbox *box,
                            fracas_run_facts *facts)
{
    return box->rank == 1 ? FRACAS_DAMAGED : FRACAS_OK;
}

static fracas_err die(const fracas_run_options *options, const fracas_mailbox *box,
                      fracas_run_facts *facts)
{
    if (box->rank == 1) raise(SIGKILL);
    return FRACAS_OK;
}

static fracas_err end_well(const fracas_run_options *options, const fracas_mailbox *box,
                           fracas_run_facts *facts)
{
    return FRACAS_OK;
}

static void a_starter_ends_as_its_ranks(void **state)
{
    char said[256];
    fracas_starter starter = start(end_well, RANKS);
    assert_int_equal(end_of(&starter, said), 0);
    assert_string_equal(said, "");
    starter = start(end_badly, RANKS);
    assert_int_equal(WEXITSTATUS(end_of(&starter, said)), FRACAS_ENVIRONMENT);
    assert_string_equal(said, "rank 1 ended with status 5\n");
    starter = start(die, RANKS);
    assert_int_equal(WEXITSTATUS(end_of(&starter, said)), FRACAS_ENVIRONMENT);
    assert_has(said, "the starter noticed that rank 1 died of signal 9 (Killed");
}

static fracas_err wait_for_go(const fracas_run_options *options, const fracas_mailbox *box,
                              fracas_run_facts *facts)
{
    tell_and_wait();
    return FRACAS_OK;
}

/* Their ends are one signal, if the starter has no time to look at each. */
static void ranks_that_end_together(void **state)
{
    pid_t rank[RANKS];
    char said[256];
    int status;
    open_pipes();
    const fracas_starter starter = start(wait_for_go, RANKS);
    hear(rank, RANKS);
    kill(starter.pid, SIGSTOP);
    assert_int_equal(waitpid(starter.pid, &status, WUNTRACED), starter.pid);
    assert_true(WIFSTOPPED(status));
    let_go(RANKS);
    for (int r = 0; r < RANKS; r++) assert_true(ends(rank[r]));
    kill(starter.pid, SIGCONT);
    assert_int_equal(end_of(&starter, said), 0);
    close_pipes();
}

/* Ends well after the signal to drain alone. */
static fracas_err wait_for_signal(const fracas_run_options *options, const fracas_mailbox *box,
                                  fracas_run_facts *facts)
{
    sigset_t before;
    hold_signals(&before);
    if (sigismember(&before, SIGUSR1)) return FRACAS_BUG;
    tell_and_wait();
    while (!fracas_signals_ask()) sigsuspend(&before);
    return FRACAS_OK;
}

static void signals_reach_every_rank(void **state)
{
    static const int passed[] = {SIGUSR1, SIGUSR2, SIGTERM, SIGINT, SIGHUP};
    for (size_t i = 0; i < FRACAS_COUNT(passed); i++) {
        pid_t rank[RANKS];
        char said[256];
        open_pipes();
        const fracas_starter starter = start(wait_for_signal, RANKS);
        hear(rank, RANKS);
        kill(starter.pid, passed[i]);
        let_go(RANKS);
        assert_int_equal(end_of(&starter, said), 0);
        close_pipes();
    }
}

/* The number of open descriptors. */
static int descriptors(void)
{
    int count = 0;
    DIR *all = opendir("/proc/self/fd");
    while (readdir(all)) count++;
    closedir(all);
    return count;
}

static int before_the_start;

/* stdin has nothing. Beside the three streams there are the sockets of all inboxes, two of each. */
static fracas_err have_own_descriptors(const fracas_run_options *options, const fracas_mailbox *box,
                                       fracas_run_facts *facts)
{
    char none;
    if (read(STDIN_FILENO, &none, 1) != 0) return FRACAS_BUG;
    return descriptors() > before_the_start + 2 * box->size ? FRACAS_BUG : FRACAS_OK;
}

static void ranks_inherit_no_pipe(void **state)
{
    char said[256];
    int given[2];
    assert_int_equal(pipe(given), 0); /* what a user would type */
    assert_int_equal(write(given[1], "typed", 5), 5);
    const int mine = dup(STDIN_FILENO);
    dup2(given[0], STDIN_FILENO);
    before_the_start = descriptors();
    const fracas_starter starter = start(have_own_descriptors, RANKS);
    dup2(mine, STDIN_FILENO);
    assert_int_equal(end_of(&starter, said), 0);
    close(mine);
    close(given[0]);
    close(given[1]);
}

/* ---- the launcher ---- */

static const fracas_run_options quiet = {.quiet = true};
static void (*each_start)(int number); /* of a starter, which counts from 1 */
static int starts;

static fracas_err no_check(int jobs)
{
    return FRACAS_OK;
}

static fracas_err start_one(const fracas_ranks *ranks, fracas_scratch *scratch,
                            fracas_starter *starter)
{
    starts++;
    TRY(fracas_scratch_create(scratch));
    TRY(fracas_starter_fork(starter));
    if (starter->pid == 0) {
        signal(SIGUSR1, SIG_DFL);
        each_start(starts);
        _exit(0);
    }
    return FRACAS_OK;
}

/* Runs the launcher in a process of its own. The words that it says are in said.txt; it leaves
 * neither descriptors nor folders, and a child that it had before. */
static void launched(void (*each)(int number), double walltime, fracas_err wanted,
                     int wanted_starts)
{
    static const fracas_starter_kind made = {"the script", no_check, start_one};
    char path[100];
    snprintf(path, sizeof path, "%s/said.txt", folder);
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        bool ran;
        fracas_run_options options = quiet;
        options.walltime = walltime;
        const fracas_ranks ranks = {.options = &options, .jobs = 1};
        if (!freopen(path, "w", stderr)) _exit(90);
        setenv("TMPDIR", folder, 1);
        each_start = each;
        const pid_t foreign = fork();
        if (foreign == 0) prctl(PR_SET_PDEATHSIG, SIGKILL), pause();
        fracas_signals_catch();
        const int open = descriptors();
        const fracas_err err = fracas_launcher_run(&made, &ranks, fracas_now(), &ran);
        if (err) fprintf(stderr, "fracas: %s\n", fracas_message());
        fflush(stderr);
        const bool left = waitpid(foreign, NULL, WNOHANG) == 0;
        kill(foreign, SIGKILL);
        if (err != wanted || starts != wanted_starts) _exit(91);
        _exit(descriptors() != open ? 92 : !left ? 93 : 0);
    }
    const int status = status_of(pid);
    OWNED char *said = whole_file(path);
    if (status) fail_msg("status %x of the launcher, which says: %s", (unsigned)status, said);
    int files = 0;
    DIR *left = opendir(folder);
    assert_non_null(left);
    while (readdir(left)) files++;
    closedir(left);
    assert_int_equal(files, 3); /* ".", ".." and said.txt */
}

/* As rank 0 speaks. */
static void say(const char *line)
{
    if (write(STDOUT_FILENO, line, strlen(line)) < 0) _exit(99);
}

/* A lost last worker, and a death: each after something was done, so that neither waits. */
static void gain_and_die(int number)
{
    char line[60];
    const char *reason = getenv("FRACAS_RESTARTED");
    snprintf(line, sizeof line, "@fracas progress 9 %d 0 0 0.5\n", number);
    if (number == 1) say("@fracas progress 9 0 0 0 0.5\n");
    say(line);
    if (number == 1) say("@fracas end 6 1 1 no worker is left\n"), _exit(0);
    if (number == 2) _exit(!reason || strcmp(reason, "no worker is left") ? 90 : 7);
    if (number == 3) _exit(!reason || !strstr(reason, "the script ended with status 7") ? 90 : 1);
    if (number < 6) raise(SIGKILL);
    say(reason && strstr(reason, "the script died of signal 9") ? "@fracas end 0 1 0 \n"
                                                                : "@fracas end 9 1 0 \n");
}

static void a_run_goes_on_while_it_gains(void **state)
{
    launched(gain_and_die, 0, FRACAS_OK, 6);
}

/* Rank 0 has spoken, and waits for the signal to drain. */
static void drain_by(void (*event)(void))
{
    sigset_t drain;
    int number;
    hold_signals(&drain);
    sigemptyset(&drain);
    sigaddset(&drain, SIGUSR1);
    say("@fracas progress 9 0 0 0 0.5\n");
    if (event) event();
    if (sigwait(&drain, &number)) _exit(99);
    say("@fracas end 3 1 0 drained\n");
}

static void signal_launcher(void)
{
    kill(getppid(), SIGTERM);
}

static void drained_by_a_signal(int number)
{
    drain_by(signal_launcher);
}

static void drained_by_the_walltime(int number)
{
    drain_by(NULL);
}

/* No rank speaks, and the launcher is asked to end. */
static void silent(int number)
{
    signal_launcher();
}

static void what_asks_for_an_end(void **state)
{
    launched(drained_by_a_signal, 0, FRACAS_INTERRUPTED, 1);
    launched(drained_by_the_walltime, 0.5, FRACAS_INTERRUPTED, 1);
    launched(silent, 0, FRACAS_INTERRUPTED, 1);
}

/* ---- the guard ---- */

/* Begins a guard in a process of its own, whose rank lives as given. */
static pid_t guarded(void (*life)(void))
{
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        signal(SIGSEGV, SIG_DFL); /* cmocka has a handler */
        if (!freopen("/dev/null", "w", stderr) || fracas_guard_begin()) _exit(99);
        life();
        _exit(0);
    }
    return pid;
}

static void start_and_end_with_7(void)
{
    fracas_guard_pass();
    _exit(7);
}

static void crash_before(void)
{
    raise(SIGSEGV);
}

static void crash_after(void)
{
    fracas_guard_pass();
    raise(SIGTERM);
}

static void end_before(void)
{
    _exit(1); /* as Open MPI does */
}

static void end_before_with_trouble(void)
{
    fracas_guard_tell(&(fracas_trouble){.code = FRACAS_USAGE});
    _exit(1);
}

static void a_guard_ends_as_its_rank(void **state)
{
    int status = status_of(guarded(start_and_end_with_7));
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 7);
    status = status_of(guarded(crash_before));
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGSEGV);
    status = status_of(guarded(crash_after));
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGTERM);
    status = status_of(guarded(end_before));
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == FRACAS_ENVIRONMENT);
    status = status_of(guarded(end_before_with_trouble));
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == FRACAS_USAGE);
}

static void end_with_8_by_a_signal(void)
{
    sigset_t before;
    fracas_guard_pass();
    fracas_signals_catch_rank();
    hold_signals(&before);
    tell_and_wait();
    while (!fracas_signals_ask()) sigsuspend(&before);
    _exit(8);
}

static void wait_for_the_end(void)
{
    tell_and_wait();
    pause();
}

static void a_guard_and_its_rank_are_one(void **state)
{
    pid_t rank;
    open_pipes();
    pid_t guard = guarded(end_with_8_by_a_signal);
    hear(&rank, 1);
    assert_int_not_equal(rank, guard);
    kill(guard, SIGUSR1);
    let_go(1);
    int status = status_of(guard);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 8);
    close_pipes();

    open_pipes();
    guard = guarded(wait_for_the_end);
    hear(&rank, 1);
    kill(guard, SIGKILL);
    status = status_of(guard);
    assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
    assert_true(ends(rank)); /* nothing lets it go on */
    close_pipes();
}

TESTS_ALL(make_folder, remove_folder, a_starter_ends_as_its_ranks, ranks_that_end_together,
          signals_reach_every_rank, ranks_inherit_no_pipe, a_run_goes_on_while_it_gains,
          what_asks_for_an_end, a_guard_ends_as_its_rank, a_guard_and_its_rank_are_one)
