/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Studies of known truth, written through the store, analysed, and checked by a script that shares
 * no code with us. */
#ifndef FRACAS_TESTS_SUPPORT_REPORT_H
#define FRACAS_TESTS_SUPPORT_REPORT_H

#include "analysis/analysis.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"
#include "tests/support/test.h"

#include <sys/stat.h>
#include <unistd.h>

/* The record of a realization, a function of these alone. */
typedef void report_record(const void *context, size_t point, int64_t replica,
                           fracas_record *record);

/* index.sqlite as a run leaves it, for docs/examples/table_from_index.sql: everything done in one
 * segment. */
static inline void report_write_index(const char *folder, const fracas_point_table *table,
                                      const fracas_file_seal *seal, report_record *make,
                                      const void *context)
{
    fracas_index *index;
    OK(fracas_index_open(folder, true, &index));
    OK(fracas_index_plan(index, table));
    size_t count = 0, all = 0;
    for (size_t p = 0; p < table->npoints; p++) all += (size_t)table->point[p].replicas;
    OWNED fracas_segment_row *row = zeroed(all, sizeof *row);
    for (size_t p = 0; p < table->npoints; p++) {
        for (int64_t replica = 0; replica < table->point[p].replicas; replica++) {
            FRACAS_CLEARED(fracas_record) record;
            make(context, p, replica, &record);
            row[count] = (fracas_segment_row){.point = table->point[p].hash,
                                              .replica = replica,
                                              .row = (int64_t)count,
                                              .summary = fracas_summary_of(&record)};
            count++;
        }
    }
    OK(fracas_index_commit(index, "one.h5", seal, row, count, "{}"));
    fracas_index_close(index);
}

/* Makes the folder and writes study.h5 and index.sqlite of every realization of the table into it.
 */
static inline void report_write_study(const char *folder, const fracas_file_header *header,
                                      const fracas_point_table *table, report_record *make,
                                      const void *context)
{
    char path[640];
    snprintf(path, sizeof path, "%s/study.h5", folder);
    assert_true(mkdir(folder, 0777) == 0);
    fracas_writer *writer;
    OK(fracas_writer_create(path, header, table, &writer));
    for (size_t p = 0; p < table->npoints; p++) {
        for (int64_t replica = 0; replica < table->point[p].replicas; replica++) {
            FRACAS_CLEARED(fracas_record) record;
            make(context, p, replica, &record);
            OK(fracas_writer_append(writer, p, replica, &record));
        }
    }
    fracas_file_seal seal;
    OK(fracas_writer_finish(writer, header->complete, &seal));
    report_write_index(folder, table, &seal, make, context);
}

/* table.txt, summary.json, report/ and export/ into the study's folder. */
static inline void report_analyse(const char *folder)
{
    OWN(fracas_analysis) analysis;
    OK(fracas_analysis_create(folder, NULL, NULL, &analysis));
    char path[640];
    snprintf(path, sizeof path, "%s/table.txt", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fracas_analysis_print_table(analysis, 0, out);
    assert_int_equal(fclose(out), 0);
    snprintf(path, sizeof path, "%s/summary.json", folder);
    out = fopen(path, "w");
    assert_non_null(out);
    OK(fracas_analysis_write_json(analysis, folder, out));
    assert_int_equal(fclose(out), 0);
    OK(fracas_report_write(analysis, folder, NULL, 0));
    snprintf(path, sizeof path, "%s/export", folder);
    OK(fracas_export_write(analysis, path, (fracas_export_more){.histories = true}));
}

/* The temporary folder of the test. With FRACAS_KEEP set in the environment it is kept, for a look
 * at the page. */
static char report_root[256];

static inline int report_make_root(void **state)
{
    snprintf(report_root, sizeof report_root, "%s/analysis-study-XXXXXX", FRACAS_BINARY_DIR);
    return mkdtemp(report_root) ? 0 : -1;
}

static inline int report_remove_root(void **state)
{
    char command[sizeof report_root + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", report_root);
    return getenv("FRACAS_KEEP") ? 0 : system(command);
}

/* Runs the scripts on the study; status 77 says that python3 with h5py is not there. */
static inline void report_check(const char *folder)
{
    char command[2048];
    snprintf(command, sizeof command,
             "/usr/bin/python3 -c 'import h5py' 2>/dev/null || exit 77; /usr/bin/python3 "
             "'" FRACAS_SOURCE_DIR
             "/tests/support/check_export.py' '%s' && exec /usr/bin/python3 '" FRACAS_SOURCE_DIR
             "/tests/support/check_report.py' '%s' '" FRACAS_SOURCE_DIR "'",
             folder, folder);
    int status = system(command);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) {
        print_message("skipped: python3-h5py is not installed\n");
        skip();
    }
    assert_int_equal(status, 0);
}

static inline char *report_contents(const char *folder, const char *name)
{
    char path[640];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return whole_file(path);
}

#endif
