/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study as large as the report is made for, written through the store without computing anything:
 * rings in fragments at ten rates, and more points of other fracture energies. */
#ifndef FRACAS_TESTS_SUPPORT_LARGE_STUDY_H
#define FRACAS_TESTS_SUPPORT_LARGE_STUDY_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/index.h"
#include "tests/support/test.h"

enum { LARGE_COLUMNS = 12, LARGE_MOST_POINTS = 1000, LARGE_HISTORY = 100, LARGE_RATES = 10 };

typedef struct {
    size_t points;
    int64_t replicas;  /* of each point */
    int64_t fragments; /* of each realization, on average */
    fracas_value value[LARGE_MOST_POINTS][LARGE_COLUMNS];
    fracas_point_row point[LARGE_MOST_POINTS];
    fracas_point_table table;
    fracas_file_header header;
} large_study;

static const fracas_column large_column[LARGE_COLUMNS] = {
    {"cohesive.fracture_energy", "J/m2", "fracture energy", false},
    {"derived.fracture_energy", "J/m2", "fracture energy", false},
    {"derived.length", "m", "length", false},
    {"derived.strain_rate", "1/s", "strain rate", false},
    {"derived.strength_mean", "Pa", "mean strength", false},
    {"geometry.area", "m2", "area", false},
    {"geometry.radius", "m", "radius", false},
    {"loading.radial", "m/s", "velocity outward", false},
    {"material.density", "kg/m3", "density", false},
    {"material.young", "Pa", "modulus", false},
    {"mesh.elements", "1", "elements", false},
    {"model", "", "model", true},
};

static inline void large_study_init(large_study *study, size_t points, int64_t replicas,
                                    int64_t fragments)
{
    *study = (large_study){.points = points, .replicas = replicas, .fragments = fragments};
    for (size_t p = 0; p < points; p++) {
        const double rate = 1e4 * pow(1.2, (double)(p % LARGE_RATES)), radius = 8e-3;
        const double real[LARGE_COLUMNS] = {100 + (double)(p / LARGE_RATES),
                                            100 + (double)(p / LARGE_RATES),
                                            2 * M_PI * radius,
                                            rate,
                                            300e6,
                                            1e-6,
                                            radius,
                                            rate * radius,
                                            2750,
                                            275e9,
                                            100.0 * (double)fragments,
                                            NAN};
        for (size_t c = 0; c < LARGE_COLUMNS; c++)
            study->value[p][c] = (fracas_value){real[c], large_column[c].text ? "ring" : ""};
        study->point[p] = (fracas_point_row){
            .hash = fracas_hash_of(&p, sizeof p), .replicas = replicas, .value = study->value[p]};
    }
    study->table = (fracas_point_table){LARGE_COLUMNS, large_column, points, study->point};
    study->header = (fracas_file_header){.campaign = fracas_hash_of("large", 5),
                                         .seed = 1,
                                         .history = LARGE_HISTORY,
                                         .version = "0.1.0",
                                         .complete = true};
}

/* Arcs between cuts near every hundredth interface, each flying as such a piece does. */
static inline bool large_fragments(const large_study *study, double speed, uint64_t *state,
                                   fracas_record *record)
{
    const double radius = 8e-3, circumference = 2 * M_PI * radius, area = 1e-6, density = 2750;
    const int64_t elements = 100 * study->fragments;
    int64_t last = 0;
    record->fragment = calloc(record->nfragment, sizeof *record->fragment);
    if (!record->fragment) return false;
    for (int64_t k = 0; k < record->fragments; k++) {
        const double at = ((double)k + 1 + 0.9 * (random_share(state) - 0.5)) * (double)elements /
                          (double)record->fragments;
        const int64_t cut = k + 1 == record->fragments ? elements : llrint(at);
        const double angle = M_PI * (double)(cut + last) / (double)elements,
                     half = M_PI * (double)(cut - last) / (double)elements;
        const double centre = sin(half) / half,
                     outward = speed * centre * (1 + 0.01 * random_share(state)),
                     along = random_share(state) - 0.5;
        fracas_fragment *f = &record->fragment[k];
        *f = (fracas_fragment){.size = circumference * (double)(cut - last) / (double)elements,
                               .elements = cut - last};
        f->mass = density * area * f->size;
        f->position[0] = radius * 1.1 * centre * cos(angle);
        f->position[1] = radius * 1.1 * centre * sin(angle);
        f->velocity[0] = outward * cos(angle) - along * sin(angle);
        f->velocity[1] = outward * sin(angle) + along * cos(angle);
        f->spin[2] = 1e3 * (random_share(state) - 0.5);
        f->angular_momentum[2] = f->mass * radius * radius * (1 - centre * centre) * f->spin[2];
        last = cut;
    }
    return true;
}

static inline bool large_history(fracas_record *record)
{
    record->nhistory = LARGE_HISTORY;
    record->history = calloc(record->nhistory, sizeof *record->history);
    if (!record->history) return false;
    for (size_t i = 0; i < record->nhistory; i++) {
        const double part = (double)i / (double)(record->nhistory - 1);
        record->history[i] = (fracas_history_row){
            .time = part * record->end_time,
            .kinetic = record->kinetic * (1 - 0.1 * part),
            .elastic = 0.1 * record->kinetic * part * (1 - part),
            .dissipated = record->dissipated * part * part,
            .residual = record->residual * part,
            .fragments = record->fragments};
    }
    return true;
}

/* A function of (point, replica) alone; false without memory. */
static inline bool large_record(const large_study *study, size_t p, int64_t replica,
                                fracas_record *record)
{
    uint64_t state = 1000003 * p + (uint64_t)replica;
    const double speed = study->value[p][7].real;
    for (int i = 0; i < 4; i++) random_share(&state);
    fracas_record_init(record);
    record->outcome = FRACAS_FRAGMENTED;
    record->fragments = study->fragments +
                        llrint(0.2 * (double)study->fragments * (random_share(&state) - 0.5));
    record->nfragment = (size_t)record->fragments;
    record->broken = record->cracked = record->fragments;
    record->steps = 1000;
    record->onset_time = 1e-6 * (1 + 0.1 * random_share(&state));
    record->end_time = 1e-5;
    record->time_step = 1e-8;
    record->mass = 2750 * 1e-6 * 2 * M_PI * 8e-3;
    record->kinetic = record->work = 0.5 * record->mass * speed * speed;
    record->dissipated = 1e-4 * (double)record->fragments * (1 + 0.02 * random_share(&state));
    record->elastic = record->cohesive = record->friction = record->damped = record->created =
        record->dissipated_bending = record->residual_end = 0;
    record->residual = 1e-5 * record->dissipated;
    for (int i = 0; i < 3; i++) record->momentum[i] = 0;
    return large_fragments(study, speed, &state, record) && large_history(record);
}

/* Appends the realizations of these numbers, counted through all points in plan order. */
static inline fracas_err large_append(const large_study *study, fracas_writer *writer,
                                      int64_t number, fracas_segment_row *row)
{
    const size_t p = (size_t)(number / study->replicas);
    const int64_t replica = number % study->replicas;
    fracas_record record;
    if (!large_record(study, p, replica, &record)) {
        fracas_record_clear(&record);
        return fracas_no_memory("a record");
    }
    fracas_err err = fracas_writer_append(writer, p, replica, &record);
    if (row)
        *row = (fracas_segment_row){.point = study->point[p].hash,
                                    .replica = replica,
                                    .summary = fracas_summary_of(&record)};
    fracas_record_clear(&record);
    return err;
}

/* study.h5 at `path`. */
static inline fracas_err large_write(const large_study *study, const char *path)
{
    fracas_writer *writer;
    fracas_file_seal seal;
    TRY(fracas_writer_create(path, &study->header, &study->table, &writer));
    fracas_err err = FRACAS_OK;
    for (int64_t n = 0; !err && n < (int64_t)study->points * study->replicas; n++)
        err = large_append(study, writer, n, NULL);
    if (!err) return fracas_writer_finish(writer, true, &seal);
    fracas_writer_abandon(writer);
    return err;
}

/* Segment `s` of `segments` in `folder`, committed: realizations s, s + segments, ..., as far from
 * plan order as can be. */
static inline fracas_err large_segment(const large_study *study, fracas_index *index,
                                       const char *folder, int64_t s, int64_t segments)
{
    const int64_t all = (int64_t)study->points * study->replicas;
    char name[32], path[640];
    size_t count = 0;
    fracas_writer *writer;
    fracas_file_seal seal;
    OWNED fracas_segment_row *row = calloc((size_t)(all / segments + 1), sizeof *row);
    if (!row) return fracas_no_memory("the rows of a segment");
    snprintf(name, sizeof name, "%06lld.h5", (long long)s);
    snprintf(path, sizeof path, "%s/segments/%s", folder, name);
    fracas_err err = fracas_writer_create(path, &study->header, &study->table, &writer);
    for (int64_t n = s; !err && n < all; n += segments) {
        err = large_append(study, writer, n, &row[count]);
        row[count].row = (int64_t)count;
        count++;
    }
    if (err) fracas_writer_abandon(writer);
    else err = fracas_writer_finish(writer, false, &seal);
    if (!err) err = fracas_index_commit(index, name, &seal, row, count, "{}");
    return err;
}

/* The index, and `written` of `segments` segments, in the study's folder, in which there is a
 * folder for them. */
static inline fracas_err large_write_segments(const large_study *study, const char *folder,
                                              int64_t segments, int64_t written)
{
    fracas_index *index;
    TRY(fracas_index_open(folder, true, &index));
    fracas_err err = fracas_index_claim(index, &study->header);
    if (!err) err = fracas_index_plan(index, &study->table);
    for (int64_t s = 0; !err && s < written; s++)
        err = large_segment(study, index, folder, s, segments);
    fracas_index_close(index);
    return err;
}

#endif
