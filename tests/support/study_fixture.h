/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study in a folder of its own, planned, and what tests do with it. */
#ifndef FRACAS_TESTS_SUPPORT_STUDY_FIXTURE_H
#define FRACAS_TESTS_SUPPORT_STUDY_FIXTURE_H

#include "tests/support/store_sample.h"

#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"
#include "campaigns/store/study.h"

#include <sys/wait.h>

/* Replicas of a point, and rows of a part of a record. */
#ifndef STUDY_REPLICAS
#define STUDY_REPLICAS 40
#define STUDY_ROWS 30
#endif
enum { REPLICAS = STUDY_REPLICAS, ALL = SAMPLE_POINTS * REPLICAS, MOST = STUDY_ROWS };

static char *study;
static fracas_point_row point_row[SAMPLE_POINTS];
static fracas_point_table table;
static fracas_index *index_;

/* A planned study without segments, in the folder. */
static inline void begin_study(void)
{
    assert_int_equal(mkdir(sample_path(study, "segments"), 0777), 0);
    OK(fracas_index_open(study, true, &index_));
    OK(fracas_index_plan(index_, &table));
}

static inline int set_up(void **state)
{
    study = sample_folder();
    table = sample_table(point_row, REPLICAS);
    begin_study();
    return 0;
}

/* Forgets the segments and the index. */
static inline void begin_study_again(void)
{
    fracas_index_close(index_);
    sample_remove_tree(sample_path(study, "segments"));
    unlink(sample_path(study, "index.sqlite"));
    begin_study();
}

/* Sets study.h5 aside, for study_is_the_first(). */
static inline void keep_first(void)
{
    assert_int_equal(rename(sample_path(study, "study.h5"), sample_path(study, "first")), 0);
}

static inline bool study_is_the_first(void)
{
    return sample_same_file(sample_path(study, "study.h5"), sample_path(study, "first"));
}

static inline int tear_down(void **state)
{
    fracas_index_close(index_);
    sample_remove(study);
    return 0;
}

/* ---- helpers ---- */

/* Writes and commits one segment. */
static inline void commit_segment(const char *name, const sample_realization *what, size_t count)
{
    fracas_file_seal seal;
    fracas_segment_row row[ALL];
    sample_segment(study, name, &table, what, count, MOST, &seal, row);
    OK(fracas_index_commit(index_, name, &seal, row, count, SAMPLE_PROVENANCE));
}

/* Every realization in an order that `seed` shuffles, in segments of a size that it chooses. */
static inline void commit_everything(uint64_t seed)
{
    sample_realization what[ALL];
    for (size_t i = 0; i < ALL; i++)
        what[i] = (sample_realization){i / REPLICAS, (int64_t)(i % REPLICAS)};
    for (size_t i = ALL; seed && i > 1; i--) {
        size_t j = sample_bits(&seed) % i;
        sample_realization other = what[j];
        what[j] = what[i - 1];
        what[i - 1] = other;
    }
    for (size_t first = 0, number = 0; first < ALL; number++) {
        size_t size = seed ? 1 + sample_bits(&seed) % 40 : ALL, rest = ALL - first;
        char name[32];
        snprintf(name, sizeof name, "s%zu.h5", number);
        if (size > rest) size = rest;
        commit_segment(name, what + first, size);
        first += size;
    }
}

static inline void sql(const char *text)
{
    char *message = NULL;
    if (sqlite3_exec(index_->db, text, NULL, NULL, &message) != SQLITE_OK)
        fail_msg("%s: %s", text, message);
}

/* The number found by a query of the index. */
static inline int64_t number(const char *query)
{
    sqlite3_stmt *statement;
    assert_int_equal(sqlite3_prepare_v2(index_->db, query, -1, &statement, NULL), SQLITE_OK);
    assert_int_equal(sqlite3_step(statement), SQLITE_ROW);
    const int64_t value = sqlite3_column_int64(statement, 0);
    sqlite3_finalize(statement);
    return value;
}

/* Computes what is planned (again). */
static inline void compute_planned(const char *name)
{
    OWNED fracas_index_row *row;
    size_t count, missing = 0;
    sample_realization what[ALL];
    OK(fracas_index_rows(index_, &table, &row, &count));
    for (size_t i = 0; i < count; i++)
        if (row[i].status == FRACAS_PLANNED)
            what[missing++] = (sample_realization){row[i].point, row[i].replica};
    if (missing) commit_segment(name, what, missing);
}

static inline fracas_index_counts count_all(void)
{
    fracas_index_counts counts;
    OK(fracas_index_count(index_, &counts));
    return counts;
}

static inline void merge(void)
{
    fracas_file_header header = sample_header();
    OK(fracas_study_merge(study, index_, &header, &table, NULL, NULL));
}

static inline void keep_problem(void *context, const char *problem)
{
    char *text = context;
    snprintf(text + strlen(text), 8192 - strlen(text), "%s\n", problem);
}

/* The index is closed meanwhile, as for `fracas verify`. *text: the problems, one a line, and after
 * them the notes if they are wanted. */
static inline int64_t verify_as(bool full, bool notes, char text[8192])
{
    int64_t problems;
    const fracas_verify_options how = {
        .full = full, .say = keep_problem, .note = notes ? keep_problem : NULL, .context = text};
    text[0] = '\0';
    fracas_index_close(index_);
    OK(fracas_study_verify(study, &how, &problems));
    OK(fracas_index_open(study, true, &index_));
    return problems;
}

static inline int64_t verify(char text[8192])
{
    return verify_as(true, false, text);
}

static inline void verify_finds_as(bool full, int64_t wanted, const char *part)
{
    char text[8192];
    int64_t problems = verify_as(full, false, text);
    if (problems != wanted || !strstr(text, part))
        print_error("%lld problems:\n%s", (long long)problems, text);
    assert_int_equal(problems, wanted);
    assert_has(text, part);
}

static inline void verify_finds(int64_t wanted, const char *part)
{
    verify_finds_as(true, wanted, part);
}

/* Its report must contain `part`. */
static inline void recover_says(const char *part)
{
    OWNED char *report = NULL;
    fracas_file_header header = sample_header();
    OK(fracas_study_recover(study, index_, &header, &table, &report));
    if (!report || !strstr(report, part))
        fail_msg("no \"%s\" in the report:\n%s", part, report ? report : "");
    if (!*part) assert_string_equal(report, "");
}

static inline void flip_byte(const char *path, size_t at)
{
    size_t size;
    unsigned char *bytes = whole_bytes(path, &size);
    bytes[at % size] ^= 0x10;
    write_bytes(path, bytes, size);
    free(bytes);
}

static inline bool is_sealed(void)
{
    bool sealed;
    OK(fracas_study_sealed(study, index_, &sealed));
    return sealed;
}

#endif
