/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What tests of looking after a study share. */
#ifndef FRACAS_TESTS_SUPPORT_UPKEEP_H
#define FRACAS_TESTS_SUPPORT_UPKEEP_H

#include "tests/support/study_fixture.h"

#include "base/param.h"
#include "campaigns/store/file/h5.h"
#include "campaigns/store/upkeep.h"

#include <signal.h>

static char said_text[8192];

static inline void keep_line(void *context, const char *text)
{
    keep_problem(context, text);
}

static const fracas_said said = {keep_line, said_text};

static inline void says(const char *part)
{
    assert_has(said_text, part);
}

static inline void open_again(void)
{
    fracas_index_close(index_);
    index_ = NULL;
    OK(fracas_index_open(study, true, &index_));
}

/* With the index closed; opened again after. */
static inline fracas_err reindex(void)
{
    fracas_file_header header = sample_header();
    fracas_index_close(index_);
    index_ = NULL;
    said_text[0] = '\0';
    fracas_err err = fracas_study_reindex(study, &header, &table, &said);
    if (!err) OK(fracas_index_open(study, true, &index_));
    return err;
}

/* Everything but these, in three segments. */
static inline void commit_all_but(const sample_realization *left, size_t nleft)
{
    sample_realization what[ALL];
    size_t n = 0;
    for (size_t i = 0; i < ALL; i++) {
        bool skip = false;
        for (size_t l = 0; l < nleft; l++)
            skip = skip ||
                   (left[l].point == i / REPLICAS && left[l].replica == (int64_t)(i % REPLICAS));
        if (!skip) what[n++] = (sample_realization){i / REPLICAS, (int64_t)(i % REPLICAS)};
    }
    commit_segment("a.h5", what, 30);
    commit_segment("b.h5", what + 30, 30);
    commit_segment("c.h5", what + 60, n - 60);
}

static inline void note_failure(void *text, const fracas_index_row *row, const char *reason)
{
    if (*reason) /* those of the sample that have a record have none */
        sprintf((char *)text + strlen(text), "%zu:%d %d %s;", row->point, (int)row->replica,
                (int)row->attempts, reason);
}

static inline void failures_are(const char *wanted)
{
    char text[4096] = "";
    OK(fracas_index_failures(index_, &table, note_failure, text));
    assert_string_equal(text, wanted);
}

static const sample_realization left_out[] = {{0, 5}, {1, 7}, {2, 39}};

/* Two that failed (one of them for good) and one that nobody has begun. */
static inline void fail_some(void)
{
    OK(fracas_index_fail(index_, &point_row[0].hash, 5, "signal 11", false));
    OK(fracas_index_fail(index_, &point_row[0].hash, 5, "signal 9", true));
    OK(fracas_index_fail(index_, &point_row[1].hash, 7, "signal 6", false));
    OK(fracas_index_event(index_, "kind", "text"));
}

static inline void decide(int p, int64_t round, int64_t replicas)
{
    const fracas_decision decision = {.round = round,
                                      .replicas = replicas,
                                      .used = replicas,
                                      .mean = 1,
                                      .half_width = 0.5,
                                      .minimum = 8,
                                      .maximum = 100,
                                      .relative_half_width = 0.1,
                                      .confidence = 0.95};
    OK(fracas_index_begin(index_));
    OK(fracas_index_end(index_, fracas_index_decide(index_, &point_row[p], &decision, "reason")));
}

#endif
