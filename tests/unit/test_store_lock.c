/* SPDX-License-Identifier: GPL-3.0-or-later */
/* STUDY/lock: who is refused, who takes over, and what the file says. */
#include "campaigns/store/lock.h"
#include "tests/support/store_sample.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <time.h>

static char *study;

static int set_up(void **state)
{
    study = sample_folder();
    unsetenv("FRACAS_TEST_HOST");
    unsetenv("SLURM_JOB_ID");
    unsetenv("SLURM_RESTART_COUNT");
    return 0;
}

static int tear_down(void **state)
{
    sample_remove(study);
    return 0;
}

static int told_of_rest = -1; /* a pipe told of each */
static bool impatient;        /* no rest takes time */

/* Stands before the C library's. */
int nanosleep(const struct timespec *time, struct timespec *rest)
{
    if (told_of_rest >= 0) assert_int_equal(write(told_of_rest, "", 1), 1);
    return impatient ? 0 : (int)syscall(SYS_nanosleep, time, rest);
}

/* One who only looks does not sign: a run waits until that is over, and does not end with "in use".
 */
static void one_who_looks_is_waited_for(void **state)
{
    int ready[2], rests[2], lock;
    char byte;
    assert_int_equal(pipe(ready) | pipe(rests), 0);
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (fracas_study_lock_to_look(study, false, &lock)) _exit(1);
        if (write(ready[1], "", 1) != 1 || read(rests[0], &byte, 1) != 1) _exit(1);
        _exit(write(ready[1], "", 1) != 1);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    told_of_rest = rests[1];
    OK(fracas_study_lock(study, false, &lock));
    told_of_rest = -1;
    fcntl(ready[0], F_SETFL, O_NONBLOCK);
    assert_int_equal(read(ready[0], &byte, 1), 1); /* it was done before */
    assert_int_equal(waitpid(child, NULL, 0), child);
    fracas_study_unlock(lock);
    for (int end = 0; end < 2; end++) close(ready[end]), close(rests[end]);
}

/* What the file says. */
static const char *lock_text(void)
{
    static char text[1024];
    FILE *in = fopen(sample_path(study, "lock"), "r");
    assert_non_null(in);
    text[fread(text, 1, sizeof text - 1, in)] = '\0';
    fclose(in);
    return text;
}

/* A run that takes the lock as `host` in Slurm job `job` (NULL: none), requeued so many times, and
 * dies with it. Returns its pid. */
static pid_t die_with_it(const char *host, const char *job, const char *restarts)
{
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        int lock;
        if (host) setenv("FRACAS_TEST_HOST", host, 1);
        if (job) setenv("SLURM_JOB_ID", job, 1);
        if (restarts) setenv("SLURM_RESTART_COUNT", restarts, 1);
        if (fracas_study_lock(study, true, &lock)) _exit(1);
        kill(getpid(), SIGKILL);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFSIGNALED(status));
    return child;
}

static fracas_lock_state state_is(const char *part)
{
    char text[FRACAS_HOLDER_TEXT];
    fracas_lock_state state;
    OK(fracas_study_lock_state(study, &state, text));
    assert_has(text, part);
    return state;
}

/* Takes it, which must be in order; *over is what it took over, "" if nothing. */
static void take(bool force, char over[FRACAS_HOLDER_TEXT])
{
    int lock;
    OK(fracas_study_lock(study, force, &lock));
    assert_int_equal(fracas_study_took_over(lock, over), *over != '\0');
    fracas_study_unlock(lock);
}

/* ---- one host ---- */

static void a_clean_release_empties_the_file(void **state)
{
    int lock;
    char over[FRACAS_HOLDER_TEXT], pid[32], host[257] = "";
    OK(fracas_study_lock(study, false, &lock));
    gethostname(host, sizeof host - 1);
    snprintf(pid, sizeof pid, "pid=%ld ", (long)getpid());
    assert_has(lock_text(), pid);
    assert_has(lock_text(), host);
    assert_false(fracas_study_took_over(lock, over));
    fracas_study_unlock(lock);
    assert_string_equal(lock_text(), "");
    assert_int_equal(state_is(""), FRACAS_LOCK_FREE);
    fracas_study_unlock(-1);
    OK(fracas_study_lock_to_look(study, false, &lock));
    assert_string_equal(lock_text(), "");
    close(lock);
}

static void second_run_is_refused(void **state)
{
    int lock = -1, ready[2], stop[2];
    char byte, pid[32];
    assert_int_equal(pipe(ready) + pipe(stop), 0);
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        fracas_err err = fracas_study_lock(study, false, &lock);
        pid_t grandchild = fork(); /* inherits the file, must not keep the lock */
        if (grandchild == 0) {
            close(ready[1]);
            (void)!read(stop[0], &byte, 1);
            _exit(0);
        }
        (void)!write(ready[1], err ? "n" : "y", 1);
        pause();
        _exit(1);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(byte, 'y');
    for (int force = 0; force < 2; force++) { /* it lives: force does not help */
        FAILS(fracas_study_lock(study, force, &lock), FRACAS_IN_USE, "another run uses this study");
        snprintf(pid, sizeof pid, "pid %ld, since 20", (long)child);
        assert_has(fracas_message(), pid);
        char host[257] = "";
        gethostname(host, sizeof host - 1);
        assert_has(fracas_message(), host);
        assert_int_equal(lock, -1);
        FAILS(fracas_study_lock_to_look(study, force, &lock), FRACAS_IN_USE, pid);
    }
    assert_int_equal(state_is(pid), FRACAS_LOCK_HELD);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_int_equal(state_is(pid), FRACAS_LOCK_LEFT);
    OK(fracas_study_lock(study, false, &lock)); /* the grandchild still lives */
    char over[FRACAS_HOLDER_TEXT];
    assert_true(fracas_study_took_over(lock, over));
    assert_has(over, pid);
    fracas_study_unlock(lock);
    assert_int_equal(write(stop[1], "x", 1), 1);
    for (int i = 0; i < 2; i++) close(ready[i]), close(stop[i]);
    FAILS(fracas_study_lock("/nowhere/at/all", false, &lock), FRACAS_ENVIRONMENT,
          "/nowhere/at/all/lock");
}

static void to_look_takes_nothing_over(void **state)
{
    int lock;
    die_with_it(NULL, NULL, NULL);
    OK(fracas_study_lock_to_look(study, false, &lock));
    close(lock);
    assert_int_equal(state_is("pid"), FRACAS_LOCK_LEFT);
}

/* The same kernel under another name, as a container that is started again. */
static void a_renamed_host_takes_over_its_own(void **state)
{
    die_with_it(NULL, NULL, NULL);
    char text[1024], host[257] = "", *renamed, over[FRACAS_HOLDER_TEXT] = "?";
    gethostname(host, sizeof host - 1);
    snprintf(text, sizeof text, "%s", lock_text());
    assert_true(asprintf(&renamed, "host=elsewhere%s", text + 5 + strlen(host)) > 0);
    write_bytes(sample_path(study, "lock"), renamed, strlen(renamed));
    assert_int_equal(state_is("host elsewhere"), FRACAS_LOCK_LEFT);
    take(false, over);
    free(renamed);
}

/* The holder lives, but this filesystem has lost its lock. */
static void a_holder_that_lives_is_not_taken_for_dead(void **state)
{
    int lock, ready[2];
    char byte;
    assert_int_equal(pipe(ready), 0);
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        if (fracas_study_lock(study, false, &lock)) _exit(1);
        close(lock); /* which gives the kernel's lock back, and leaves the text */
        (void)!write(ready[1], "y", 1);
        pause();
        _exit(1);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    assert_int_equal(state_is("pid"), FRACAS_LOCK_HELD);
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_IN_USE, "does not keep its lock");
    FAILS(fracas_study_lock(study, true, &lock), FRACAS_IN_USE, "does not keep its lock");
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    OK(fracas_study_lock(study, false, &lock));
    fracas_study_unlock(lock);
    close(ready[0]), close(ready[1]);
}

/* A dead process stays in /proc until its parent asks. */
static void a_zombie_is_dead(void **state)
{
    char over[FRACAS_HOLDER_TEXT] = "?";
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        int lock;
        if (!fracas_study_lock(study, false, &lock)) kill(getpid(), SIGKILL);
        _exit(1);
    }
    siginfo_t info;
    assert_int_equal(waitid(P_PID, (id_t)child, &info, WEXITED | WNOWAIT), 0);
    assert_int_equal(state_is("pid"), FRACAS_LOCK_LEFT);
    take(false, over);
    waitpid(child, NULL, 0);
}

/* A pid that another process has by now is no sign of life. */
static void a_pid_used_again_is_no_holder(void **state)
{
    die_with_it(NULL, NULL, NULL);
    char text[1024], over[FRACAS_HOLDER_TEXT] = "?", *pid, *rest, *other;
    snprintf(text, sizeof text, "%s", lock_text());
    pid = strstr(text, " pid=");
    rest = strstr(text, " since=");
    assert_true(asprintf(&other, "%.*s pid=%ld%s", (int)(pid - text), text, (long)getppid(), rest) >
                0);
    write_bytes(sample_path(study, "lock"), other, strlen(other));
    take(false, over);
    free(other);
}

/* The kernel knows who has it, whoever the file names. */
static void the_kernel_is_believed_before_the_file(void **state)
{
    int lock, ready[2];
    char byte, pid[32];
    static const char other[] = "host=node9 pid=1 since=T start=5 boot=b job=- restart=0\n";
    assert_int_equal(pipe(ready), 0);
    pid_t child = fork();
    if (child == 0) {
        prctl(PR_SET_PDEATHSIG, SIGKILL); /* a test that fails leaves nobody behind */
        if (fracas_study_lock(study, false, &lock) || write(ready[1], "y", 1) != 1) _exit(1);
        pause();
        _exit(1);
    }
    assert_int_equal(read(ready[0], &byte, 1), 1);
    write_bytes(sample_path(study, "lock"), other, strlen(other));
    snprintf(pid, sizeof pid, "pid %ld", (long)child);
    impatient = true;
    FAILS(fracas_study_lock(study, true, &lock), FRACAS_IN_USE, pid);
    impatient = false;
    assert_null(strstr(fracas_message(), "node9"));
    assert_int_equal(state_is(pid), FRACAS_LOCK_HELD);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    close(ready[0]), close(ready[1]);
}

/* A living process with the number of a holder that tells no start, or one of before a reboot. */
static void a_holder_of_before_a_reboot_is_dead(void **state)
{
    char host[257] = "", boot[64] = "", *other, *start;
    int lock;
    gethostname(host, sizeof host - 1);
    OK(fracas_study_lock(study, false, &lock));
    start = strstr(lock_text(), "start=");
    const long long since = atoll(start + 6);
    assert_int_equal(sscanf(strstr(start, "boot="), "boot=%63s", boot), 1);
    fracas_study_unlock(lock);
    for (int k = 0; k < 2; k++) {
        char over[FRACAS_HOLDER_TEXT] = "?";
        assert_true(asprintf(&other, "host=%s pid=%ld since=T start=%lld boot=%s job=- restart=0\n",
                             host, (long)getppid(), k ? since : 0, k ? "before" : boot) > 0);
        write_bytes(sample_path(study, "lock"), other, strlen(other));
        assert_int_equal(state_is(host), FRACAS_LOCK_LEFT);
        take(false, over);
        free(other);
    }
}

/* ---- another host ---- */

static void another_hosts_lock_needs_force(void **state)
{
    int lock;
    char pid[32], over[FRACAS_HOLDER_TEXT] = "?";
    pid_t dead = die_with_it("node7", NULL, NULL);
    snprintf(pid, sizeof pid, "pid %ld", (long)dead);
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_IN_USE, "host node7");
    assert_has(fracas_message(), pid);
    assert_has(fracas_message(), "since 20");
    assert_has(fracas_message(), "--force");
    FAILS(fracas_study_lock_to_look(study, false, &lock), FRACAS_IN_USE, "host node7");
    assert_int_equal(state_is("host node7"), FRACAS_LOCK_ELSEWHERE);
    take(true, over);
    assert_has(over, "node7");
    assert_string_equal(lock_text(), "");
    die_with_it("node7", NULL, NULL); /* its own, when it comes back */
    setenv("FRACAS_TEST_HOST", "node7", 1);
    take(false, over);
}

static void a_requeued_job_takes_over_its_own(void **state)
{
    int lock;
    char over[FRACAS_HOLDER_TEXT] = "?";
    die_with_it("node7", "1234", NULL);
    setenv("SLURM_JOB_ID", "1234", 1);
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_IN_USE,
          "Slurm job 1234"); /* twice in one allocation */
    setenv("SLURM_RESTART_COUNT", "1", 1);
    setenv("SLURM_JOB_ID", "1235", 1);
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_IN_USE, "Slurm job 1234");
    setenv("SLURM_JOB_ID", "1234", 1);
    take(false, over);
    die_with_it("node8", "1234", "2"); /* later than this one */
    FAILS(fracas_study_lock(study, false, &lock), FRACAS_IN_USE, "host node8");
}

/* ---- torn files ---- */

static void torn_files_are_read(void **state)
{
    char over[FRACAS_HOLDER_TEXT] = "?";
    write_bytes(sample_path(study, "lock"), "host=node9 pi",
                13); /* a power cut; no other host has this filesystem */
    take(false, over);
    char zeros[40] = {0};
    write_bytes(sample_path(study, "lock"), zeros, sizeof zeros);
    take(false, over);
    assert_has(over, "host unknown");
}

TESTS_EACH(set_up, tear_down, a_clean_release_empties_the_file, second_run_is_refused,
           one_who_looks_is_waited_for, to_look_takes_nothing_over,
           a_renamed_host_takes_over_its_own, a_holder_that_lives_is_not_taken_for_dead,
           the_kernel_is_believed_before_the_file, a_holder_of_before_a_reboot_is_dead,
           a_zombie_is_dead, a_pid_used_again_is_no_holder, another_hosts_lock_needs_force,
           a_requeued_job_takes_over_its_own, torn_files_are_read)
