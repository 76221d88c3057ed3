/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study of which every realization is computed and merged: three segments, two decisions on one
 * point, a mesh of another. */
#ifndef FRACAS_TESTS_SUPPORT_MERGED_STUDY_H
#define FRACAS_TESTS_SUPPORT_MERGED_STUDY_H

#define STUDY_REPLICAS 4
#define STUDY_ROWS 5
#include "tests/support/upkeep.h"

#include "campaigns/store/results.h"
#include "campaigns/store/study.h"
#include "tests/support/stored_mesh.h"

enum { SURFACE = 1, RULED = 2 /* points */, MOST_REPLICAS = 8 };

static inline fracas_err get_mesh(const void *context, size_t point, fracas_stored_mesh *mesh)
{
    if (point == SURFACE) grid_make(&(grid_shape){2, 1}, mesh);
    (void)context;
    return FRACAS_OK;
}

static const fracas_mesh_source meshes = {get_mesh, NULL};

/* Records of the sample, whose interfaces are those of no mesh: so without any. */
static inline void commit_bare(const char *name, size_t point)
{
    const fracas_file_header header = sample_header();
    fracas_segment_row row[REPLICAS];
    fracas_writer *writer;
    fracas_file_seal seal;
    OWNED char *path = NULL;
    OK(fracas_disk_segment(study, name, &path));
    OK(fracas_writer_create(path, &header, &table, &writer));
    OK(fracas_writer_provenance(writer, SAMPLE_PROVENANCE));
    for (int64_t r = 0; r < REPLICAS; r++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(point, r + 50, MOST, &record);
        if (record.outcome == FRACAS_FAILED) record.outcome = FRACAS_INTACT;
        record.ninterface = 0;
        row[r] = (fracas_segment_row){point_row[point].hash, r, r, fracas_summary_of(&record)};
        OK(fracas_writer_append(writer, point, r, &record));
    }
    OK(fracas_writer_finish(writer, false, &seal));
    OK(fracas_index_commit(index_, name, &seal, row, REPLICAS, SAMPLE_PROVENANCE));
}

static char *merged; /* STUDY/study.h5 */

static inline int set_up_merged(void **state)
{
    const fracas_file_header header = sample_header();
    set_up(state);
    OK(fracas_index_claim(index_, &header));
    for (size_t p = 0; p < SAMPLE_POINTS; p++)
        commit_bare((const char *const[]){"a.h5", "b.h5", "c.h5"}[p], p);
    point_row[RULED].most = MOST_REPLICAS;
    OK(fracas_index_begin(index_));
    fracas_err err = FRACAS_OK;
    for (int round = 0; !err && round < 2; round++) {
        const fracas_decision decision = {.round = round,
                                          .replicas = 2 + 2 * round,
                                          .used = 2 + round,
                                          .mean = 1,
                                          .half_width = 0.01,
                                          .stop = round,
                                          .minimum = 2,
                                          .maximum = MOST_REPLICAS,
                                          .relative_half_width = 0.1,
                                          .confidence = 0.95};
        err = fracas_index_decide(index_, &point_row[RULED], &decision, "reason");
    }
    OK(fracas_index_end(index_, err));
    OK(fracas_study_merge(study, index_, &header, &table, &meshes, NULL));
    OK(fracas_disk_join(study, "study.h5", &merged));
    return 0;
}

static inline int tear_down_merged(void **state)
{
    free(merged);
    return tear_down(state);
}

/* ---- one number or text of a file, changed ---- */

static inline void put_text(const char *file_path, const char *name, const char *text)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT), type = H5Tcopy(H5T_C_S1),
          space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, strlen(text));
    assert_true(file >= 0 && H5Adelete(file, name) >= 0);
    hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, type, text) >= 0);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
    assert_true(H5Fclose(file) >= 0);
}

static inline void put_number(const char *file_path, const char *object, const char *name,
                              int64_t value)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT),
          opened = H5Oopen(file, object, H5P_DEFAULT),
          attribute = H5Aopen(opened, name, H5P_DEFAULT);
    assert_true(attribute >= 0 && H5Awrite(attribute, H5T_NATIVE_INT64, &value) >= 0);
    H5Aclose(attribute);
    H5Oclose(opened);
    assert_true(H5Fclose(file) >= 0);
}

/* Adds to row `row` of a column, from the end if it is negative. */
static inline void add_to_row(const char *file_path, const char *column, int64_t row, int64_t add)
{
    hid_t file = H5Fopen(file_path, H5F_ACC_RDWR, H5P_DEFAULT),
          dataset = H5Dopen2(file, column, H5P_DEFAULT);
    int64_t value[64];
    assert_true(dataset >= 0);
    hid_t space = H5Dget_space(dataset);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    assert_true(count > 0 && count <= 64);
    assert_true(H5Dread(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    value[row < 0 ? row + count : row] += add;
    assert_true(H5Dwrite(dataset, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
    assert_true(H5Fclose(file) >= 0);
}

typedef struct {
    const char *column; /* or "attribute of OBJECT" */
    int64_t row, add;   /* an attribute's value */
    const char *text;   /* of an attribute, in place of a number */
    const char *says;   /* "": nothing is wrong */
} contradiction;

static inline void contradict(const char *file_path, const contradiction *c)
{
    const char *of = strstr(c->column, " of ");
    if (!of) {
        add_to_row(file_path, c->column, c->row, c->add);
        return;
    }
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)(of - c->column), c->column);
    if (c->text) put_text(file_path, name, c->text);
    else put_number(file_path, of + 4, name, c->add);
}

static inline fracas_err count_result(void *context, fracas_result *result)
{
    ++*(size_t *)context;
    (void)result;
    return FRACAS_OK;
}

/* As if a merge had written it. */
static inline void seal_merged(void)
{
    fracas_file_seal seal;
    OK(fracas_disk_seal_path(merged, &seal));
    OK(fracas_index_seal_study(index_, &seal));
}

#endif
