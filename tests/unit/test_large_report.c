/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* ctest-timeout: 900 */
/* The report without fits of 1 million fragments in 10 000 realizations: within 30 s and 500 MB,
 * from study.h5 and from 1000 segments whose realizations are as far from plan order as can be;
 * from both, the same numbers. Time is that of the processor, so that other work on the machine
 * does not count; memory is the largest resident set of a process that makes the report and nothing
 * else. */
#include "tests/support/report.h"

#include "tests/support/large_study.h"

#include <sys/resource.h>
#include <sys/wait.h>

enum { POINTS = 10, REPLICAS = 1000, FRAGMENTS = 100, SEGMENTS = 1000 };
static const double most_seconds = 30, most_megabytes = 500;

static large_study study;

static double seconds_of(struct timeval time)
{
    return (double)time.tv_sec + 1e-6 * (double)time.tv_usec;
}

/* What `fracas report` does. */
static int report_of(const char *folder, bool whole)
{
    fracas_analysis *analysis;
    char path[640];
    snprintf(path, sizeof path, "%s/table.txt", folder);
    FILE *out = fopen(path, "w");
    fracas_err err = fracas_analysis_create(folder, whole ? NULL : &study.header.campaign,
                                            whole ? NULL : &study.table, &analysis);
    if (!err) fracas_analysis_print_table(analysis, 0, out);
    if (!err) err = fracas_report_write(analysis, folder, NULL, 0);
    if (err) fprintf(stderr, "%s\n", fracas_message());
    if (!err) fracas_analysis_destroy(analysis);
    fclose(out);
    return err;
}

static void measure(const char *folder, bool whole)
{
    struct rusage used;
    int status;
    fflush(NULL);
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) _exit(report_of(folder, whole));
    assert_int_equal(wait4(child, &status, 0, &used), child);
    assert_int_equal(status, 0);
    const double seconds = seconds_of(used.ru_utime) + seconds_of(used.ru_stime),
                 megabytes = (double)used.ru_maxrss * 1024e-6;
    print_message("%s: %.1f s (at most %.0f), %.0f MB (at most %.0f)\n",
                  folder + strlen(report_root) + 1, seconds, most_seconds, megabytes,
                  most_megabytes);
    assert_true(seconds <= most_seconds);
    assert_true(megabytes <= most_megabytes);
}

static void make_folder(char folder[512], const char *name)
{
    char path[640];
    snprintf(folder, 512, "%s/%s", report_root, name);
    assert_int_equal(mkdir(folder, 0777), 0);
    snprintf(path, sizeof path, "%s/segments", folder);
    assert_int_equal(mkdir(path, 0777), 0);
}

static void same_file(const char *a, const char *b, const char *name)
{
    char command[1400];
    snprintf(command, sizeof command, "cmp '%s/report/%s' '%s/report/%s'", a, name, b, name);
    assert_int_equal(system(command), 0);
}

static void bounds(void **state)
{
    char whole[512], parts[512], path[640];
    large_study_init(&study, POINTS, REPLICAS, FRAGMENTS);
    make_folder(whole, "whole");
    snprintf(path, sizeof path, "%s/study.h5", whole);
    assert_int_equal(large_write(&study, path), FRACAS_OK);
    make_folder(parts, "segments");
    assert_int_equal(large_write_segments(&study, parts, SEGMENTS, SEGMENTS), FRACAS_OK);
    measure(whole, true);
    measure(parts, false);
    same_file(whole, parts, "fragments.csv");
    same_file(whole, parts, "points.csv");
}

TESTS_ALL(report_make_root, report_remove_root, bounds)
