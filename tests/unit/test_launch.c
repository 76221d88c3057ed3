/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Folders of MPI, and signals. */
#include "campaigns/scheduler/launch/scratch.h"
#include "campaigns/scheduler/launch/signals.h"
#include "base/param.h"
#include "tests/support/store_sample.h"
#include "tests/support/test.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

static const char *const variable[] = {"OMPI_MCA_orte_tmpdir_base",
                                       "TMPDIR",
                                       "TEMP",
                                       "TMP",
                                       "SLURM_JOB_NUM_NODES",
                                       "FRACAS_SHARED",
                                       "FRACAS_TMPDIR",
                                       "OMPI_MCA_btl_vader_backing_directory"};

/* In a process of its own, whose environment has only these; its status. */
static int in_child(void (*work)(const char *folder), const char *folder)
{
    int status;
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        for (size_t i = 0; i < FRACAS_COUNT(variable); i++) unsetenv(variable[i]);
        work(folder);
        _exit(0);
    }
    assert_int_equal(waitpid(pid, &status, 0), pid);
    return status;
}

#define must(is)                                                                 \
    do {                                                                         \
        if (!(is)) fprintf(stderr, "%s: %s\n", #is, fracas_message()), _exit(1); \
    } while (0)

/* ---- folders ---- */

static void make_and_remove(const char *base)
{
    fracas_scratch scratch;
    must(fracas_scratch_create(&scratch) == FRACAS_OK);
    must(strncmp(scratch.session.path, base, strlen(base)) == 0 &&
         scratch.session.path[strlen(base)] == '/');
    struct stat found;
    must(stat(scratch.session.path, &found) == 0 && S_ISDIR(found.st_mode));
    fracas_scratch_export(&scratch);
    must(strcmp(getenv("TMPDIR"), scratch.session.path) == 0);
    must(strcmp(getenv("FRACAS_TMPDIR"), base) == 0);
    fracas_scratch_import();
    must(strcmp(getenv("TMPDIR"), base) == 0);
    must(strcmp(getenv("OMPI_MCA_btl_vader_backing_directory"), scratch.shared.path) == 0);
    char session[sizeof scratch.session.path];
    memcpy(session, scratch.session.path, sizeof session);
    fracas_scratch_remove(&scratch);
    must(stat(session, &found) != 0);
}

static void in_the_first_that_is_there(const char *folder)
{
    setenv("OMPI_MCA_orte_tmpdir_base", "", 1);
    char none[100];
    snprintf(none, sizeof none, "%s/none", folder);
    setenv("TMPDIR", none, 1);
    setenv("TEMP", folder, 1);
    make_and_remove(folder);
}

static void where_none_is_named(const char *folder)
{
    make_and_remove("/tmp");
}

/* One that is there and no folder is named, not left out. */
static void in_no_folder(const char *folder)
{
    fracas_scratch scratch;
    setenv("TMPDIR", "/dev/null/x", 1);
    must(fracas_scratch_create(&scratch) == FRACAS_ENVIRONMENT);
    must(strstr(fracas_message(), "in /dev/null/x (TMPDIR): Not a directory"));
    fracas_scratch_remove(&scratch);
}

/* Names of other folders that do not fit below it are left, and no own name is made that does not.
 */
static void in_a_deep_folder(const char *folder)
{
    enum { DEPTH = 4000 };
    char path[4096], part[202];
    fracas_scratch scratch;
    must(chdir(folder) == 0);
    size_t n = (size_t)snprintf(path, sizeof path, "%s", folder);
    while (n < DEPTH) {
        snprintf(part, sizeof part, "%0*d", DEPTH - n > 202 ? 200 : DEPTH - (int)n - 1, 0);
        must(mkdir(part, 0777) == 0 && chdir(part) == 0);
        n += (size_t)snprintf(path + n, sizeof path - n, "/%s", part);
    }
    snprintf(part, sizeof part, ".fracas-mpi-%0188d", 0);
    must(mkdir(part, 0777) == 0);
    setenv("TMPDIR", path, 1);
    must(fracas_scratch_create(&scratch) == FRACAS_OK);
    fracas_scratch_remove(&scratch);
    must(access(part, F_OK) == 0);
    part[4085 - n] = '\0'; /* of 4095 bytes at most */
    must(mkdir(part, 0777) == 0);
    snprintf(path + n, sizeof path - n, "/%s", part);
    setenv("TMPDIR", path, 1);
    must(fracas_scratch_create(&scratch) == FRACAS_ENVIRONMENT);
    fracas_scratch_remove(&scratch);
}

/* Folders of killed runs go, which nobody has locked; those of runs that go on and of others stay.
 */
static void beside_others(const char *folder)
{
    fracas_scratch first, second;
    setenv("TMPDIR", folder, 1);
    must(fracas_scratch_create(&first) == FRACAS_OK);
    must(chdir(folder) == 0 && mkdir(".fracas-mpi-killed", 0777) == 0 && mkdir("mine", 0777) == 0);
    must(fracas_scratch_create(&second) == FRACAS_OK);
    must(access(first.session.path, F_OK) == 0 && access(second.session.path, F_OK) == 0);
    must(access(".fracas-mpi-killed", F_OK) != 0 && access("mine", F_OK) == 0);
    fracas_scratch_remove(&first);
    fracas_scratch_remove(&second);
}

/* Nobody would remove those of other nodes. */
static void on_nodes(const char *folder)
{
    fracas_scratch scratch;
    setenv("TMPDIR", folder, 1);
    setenv("SLURM_JOB_NUM_NODES", "2", 1);
    must(fracas_scratch_create(&scratch) == FRACAS_OK);
    must(!*scratch.session.path && !*scratch.shared.path);
    fracas_scratch_export(&scratch);
    must(strcmp(getenv("TMPDIR"), folder) == 0 && !getenv("FRACAS_SHARED"));
    setenv("FRACAS_SHARED", "/dev/null/x", 1); /* of another machine */
    fracas_scratch_import();
    must(!getenv("OMPI_MCA_btl_vader_backing_directory"));
    fracas_scratch_remove(&scratch);
    setenv("SLURM_JOB_NUM_NODES", "1", 1);
    unsetenv("FRACAS_SHARED");
    make_and_remove(folder);
}

static void folders_of_mpi(void **state)
{
    static void (*const each[])(const char *) = {
        in_the_first_that_is_there, where_none_is_named, in_no_folder,
        in_a_deep_folder,           beside_others,       on_nodes};
    for (size_t i = 0; i < FRACAS_COUNT(each); i++) {
        char *folder = sample_folder();
        assert_int_equal(in_child(each[i], folder), 0);
        sample_remove(folder);
    }
}

/* ---- signals ---- */

static void count_to_two(const char *none)
{
    signal(SIGHUP, SIG_IGN); /* as nohup does */
    fracas_signals_catch();
    raise(SIGHUP);
    must(!fracas_signals_ask());
    raise(SIGUSR1); /* batch systems may send it often */
    raise(SIGUSR2);
    must(fracas_signals_ask() && !fracas_signals_insist());
    fracas_signals_catch();
    raise(SIGINT);
    must(fracas_signals_ask() && !fracas_signals_insist());
    raise(SIGTERM);
    must(fracas_signals_insist());
    raise(SIGINT);
    must(fracas_signals_insist());
}

static void leave_with_a_word(const char *path)
{
    dup2(open(path, O_WRONLY | O_CREAT, 0666), STDERR_FILENO);
    fracas_signals_end();
    raise(SIGTERM);
}

static void leave_without(const char *none)
{
    close(STDERR_FILENO);
    fracas_signals_end();
    raise(SIGINT);
}

static void signals_end_a_run(void **state)
{
    char path[40];
    assert_int_equal(in_child(count_to_two, NULL), 0);
    int status = in_child(leave_without, NULL);
    assert_int_equal(WEXITSTATUS(status), FRACAS_INTERRUPTED);
    strcpy(path, "/tmp/fracas-test-XXXXXX");
    close(mkstemp(path));
    status = in_child(leave_with_a_word, path);
    assert_int_equal(WEXITSTATUS(status), FRACAS_INTERRUPTED);
    OWNED char *said = whole_file(path);
    assert_has(said, "the same command goes on from there");
    unlink(path);
}

TESTS(folders_of_mpi, signals_end_a_run)
