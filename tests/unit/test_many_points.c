/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci slow-sanitize */
/* The report of 1000 points, of two and of three parameters and of a design, in which no two points
 * have the same rate: its page within 3 MB, its files few, its summary short, all within 10 s of
 * processor time (2 to 4 on a busy machine). Points chosen by --points have figures and files,
 * others none. */
#include "tests/support/report.h"

#include "analysis/report/page.h"
#include "tests/support/large_study.h"

#include <dirent.h>
#include <sys/resource.h>

enum { POINTS = 1000, REPLICAS = 4, FRAGMENTS = 20, FILES = 200 };
static const double most_seconds = 10, most_page = 3e6, most_summary = 2.5e6; /* bytes */

static large_study study;
static char folder[512];

/* Processor time of this process and of those that made its PDFs. */
static double seconds(void)
{
    double sum = 0;
    for (int children = 0; children < 2; children++) {
        struct rusage used;
        getrusage(children ? RUSAGE_CHILDREN : RUSAGE_SELF, &used);
        sum += (double)used.ru_utime.tv_sec + (double)used.ru_stime.tv_sec +
               1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    }
    return sum;
}

static double size_of(const char *name)
{
    char path[640];
    struct stat info;
    snprintf(path, sizeof path, "%s/report/%s", folder, name);
    return stat(path, &info) ? NAN : (double)info.st_size;
}

/* Files of the report whose names begin so. */
static size_t files_of(const char *beginning)
{
    char path[640];
    size_t count = 0;
    snprintf(path, sizeof path, "%s/report", folder);
    DIR *in = opendir(path);
    assert_non_null(in);
    for (struct dirent *entry; (entry = readdir(in));)
        count += entry->d_name[0] != '.' && !strncmp(entry->d_name, beginning, strlen(beginning));
    closedir(in);
    return count;
}

static void report(const char *points)
{
    OWN(fracas_analysis) analysis;
    OK(fracas_analysis_create(folder, &study.header.campaign, &study.table, &analysis));
    if (points) OK(fracas_analysis_points(analysis, points));
    OK(fracas_report_write(analysis, folder, NULL, 0));
}

/* Writes the study into a folder of its own, and its report within the limits. */
static void page_within_limits(const char *name)
{
    char path[640];
    snprintf(folder, sizeof folder, "%s/%s", report_root, name);
    assert_int_equal(mkdir(folder, 0777), 0);
    snprintf(path, sizeof path, "%s/study.h5", folder);
    assert_int_equal(large_write(&study, path), FRACAS_OK);
    const double before = seconds();
    report(NULL);
    const double spent = seconds() - before;
    print_message("%s: %.1f s (at most %.0f), page %.2f MB, summary %.2f MB, %zu files\n", name,
                  spent, most_seconds, 1e-6 * size_of("index.html"), 1e-6 * size_of("summary.json"),
                  files_of(""));
    assert_true(spent <= most_seconds);
    assert_true(size_of("index.html") <= most_page);
    assert_true(size_of("summary.json") <= most_summary);
    assert_true(files_of("") <= FILES);
}

enum { ENERGY = 0, RATE = 3, VELOCITY = 7, YOUNG = 9 }; /* columns */

/* Ten rates, ten fracture energies, ten moduli. */
static void page_of_three_factors(void **state)
{
    large_study_init(&study, POINTS, REPLICAS, FRAGMENTS);
    for (size_t p = 0; p < POINTS; p++) {
        study.value[p][ENERGY].real = study.value[p][ENERGY + 1].real = 100 + (double)(p / 10 % 10);
        study.value[p][YOUNG].real = 200e9 + 10e9 * (double)(p / 100);
    }
    page_within_limits("factors");
}

static void page_of_a_design(void **state)
{
    large_study_init(&study, POINTS, REPLICAS, FRAGMENTS);
    for (size_t p = 0; p < POINTS; p++) {
        const double rate = 1e4 * pow(1.003, (double)p);
        study.value[p][RATE].real = rate;
        study.value[p][VELOCITY].real = 8e-3 * rate;
        study.value[p][ENERGY].real = study.value[p][ENERGY + 1].real = 100 + 1e-3 * (double)p;
    }
    page_within_limits("design");
}

/* Ten rates, a hundred fracture energies. */
static void page_of_many_points(void **state)
{
    large_study_init(&study, POINTS, REPLICAS, FRAGMENTS);
    page_within_limits("many");
}

/* Files of the six points that were chosen before are gone. */
static void points_that_are_asked_for(void **state)
{
    report("3,998-999");
    assert_int_equal(files_of("energies-point-"), 3 * (fracas_convert_possible ? 3 : 2));
    assert_true(size_of("energies-point-998.svg") > 0 && size_of("sizes-point-3.csv") > 0);
}

static void wrong_points(void **state)
{
    OWN(fracas_analysis) analysis;
    OK(fracas_analysis_create(folder, &study.header.campaign, &study.table, &analysis));
    FAILS(fracas_analysis_points(analysis, "3,1000"), FRACAS_USAGE,
          "`3,1000`: there is no point 1000: the study has points 0 to 999");
    FAILS(fracas_analysis_points(analysis, "5-3"), FRACAS_USAGE, "`5-3`: `5-3` is no range");
    FAILS(fracas_analysis_points(analysis, "3,x"), FRACAS_USAGE,
          "`3,x`: `x` is no number of a point");
    FAILS(fracas_analysis_points(analysis, ""), FRACAS_USAGE, "is no number of a point");
}

TESTS_ALL(report_make_root, report_remove_root, page_of_three_factors, page_of_a_design,
          page_of_many_points, points_that_are_asked_for, wrong_points)
