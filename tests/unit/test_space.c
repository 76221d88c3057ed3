/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The checks before a run, under limits of the process. */
#include "base/param.h"
#include "campaigns/scheduler/launch/starter.h"
#include "campaigns/scheduler/session/space.h"
#include "tests/support/campaign_text.h"
#include "tests/support/study_fixture.h"

#include <sys/resource.h>

static fracas_campaign *campaign;
static fracas_run_options options;

/* Sets the soft limit, unless it is RLIM_INFINITY. */
static void set_limit(int what, rlim_t soft)
{
    struct rlimit limit;
    assert_int_equal(getrlimit(what, &limit), 0);
    limit.rlim_cur = soft;
    if (soft != RLIM_INFINITY) assert_int_equal(setrlimit(what, &limit), 0);
}

static fracas_err check(const char *folder, double bytes)
{
    return fracas_space_check(folder, campaign, &options, &bytes);
}

static void a_study_has_to_fit(void **state)
{
    char path[4200];
    struct rlimit before;
    study = sample_folder();
    campaign = read_replaced("replicas: 3", "replicas: 1000");
    fracas_run_options_init(&options);
    options.jobs = 2;
    OK(check(study, 1000));
    OK(check("/no/such/folder", 1000)); /* the disk of its first existing ancestor */
    OK(check("/no", 1000));
    OK(check("no/such/folder", 1000));
    memset(path, 'x', sizeof path);
    path[sizeof path - 1] = '\0';
    OK(check(path, 1000)); /* which fails where it is made */
    FAILS(check(study, 1e15), FRACAS_ENVIRONMENT, "will need about", "--ignore-space");
    options.ignore_space = true;
    OK(check(study, 1e15));
    options.ignore_space = false;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    set_limit(RLIMIT_FSIZE, 10000000);
    OK(check(study, 1000)); /* 1.4 MB */
    FAILS(check(study, 20000), FRACAS_ENVIRONMENT, "study.h5 will have about", "`ulimit -f`");
    options.part = 1;
    options.parts = 8;
    OK(check(study, 20000)); /* a part makes no study.h5 */
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    options.parts = 0;
    write_bytes(sample_path(study, "index.sqlite"), "no index", 8);
    OK(check(study, 1000)); /* which fails where it is opened */
    fracas_campaign_destroy(campaign);
    sample_remove(study);
}

static void a_start_needs_files(void **state)
{
    static const struct {
        const fracas_starter_kind *kind;
        int jobs;
        rlim_t files, most, bytes; /* soft and hard limit of open files, size of a file */
        const char *said;          /* NULL: nothing is wrong */
    } each[] = {
        {&fracas_starter_mpirun, 2, 1000, 1000, RLIM_INFINITY, NULL},
        {&fracas_starter_mpirun, 2, 49, 1000, RLIM_INFINITY, NULL}, /* raised */
        {&fracas_starter_mpirun, 2, 49, 60, RLIM_INFINITY, NULL},
        {&fracas_starter_mpirun, 2, 49, 49, RLIM_INFINITY, "may open 49 files, this run needs 50"},
        {&fracas_starter_mpirun, 100000, 1000, 1000, RLIM_INFINITY,
         "this run needs 5160"}, /* as 1024, all of one machine */
        {&fracas_starter_mpirun, 2, 1000, 1000, 8 << 20, NULL},
        {&fracas_starter_mpirun, 2, 1000, 1000, (8 << 20) - 1, "a file may have 8388607 bytes"},
        {&fracas_starter_local, 2, 45, 60, (8 << 20) - 1, NULL},
        {&fracas_starter_local, 100, 300, 300, RLIM_INFINITY, "this run needs 340"},
    };
    for (size_t i = 0; i < FRACAS_COUNT(each); i++) {
        int status;
        fflush(NULL);
        const pid_t pid = fork();
        if (pid == 0) {
            const struct rlimit files = {each[i].files, each[i].most};
            if (setrlimit(RLIMIT_NOFILE, &files)) _exit(2);
            set_limit(RLIMIT_FSIZE, each[i].bytes);
            const fracas_err err = each[i].kind->check(each[i].jobs);
            struct rlimit now;
            getrlimit(RLIMIT_NOFILE, &now);
            _exit(each[i].said
                      ? err != FRACAS_ENVIRONMENT || !strstr(fracas_message(), each[i].said)
                      : err || now.rlim_cur < 46);
        }
        assert_int_equal(waitpid(pid, &status, 0), pid);
        if (status) fail_msg("case %zu: %x", i, (unsigned)status);
    }
}

TESTS(a_study_has_to_fit, a_start_needs_files)
