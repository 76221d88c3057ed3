/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the tests of the store share: a point table, random records, folders, comparing files. */
#ifndef FRACAS_TESTS_STORE_SAMPLE_H
#define FRACAS_TESTS_STORE_SAMPLE_H

#include "campaigns/store/datafile.h"
#include "campaigns/store/decision.h"
#include "campaigns/store/index.h"
#include "campaigns/store/pack.h"
#include "tests/support/test.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- three points; the second has no strength.shape, the third no law text ---- */

enum { SAMPLE_POINTS = 3 };

static const fracas_column sample_column[] = {
    {"cohesive.law", "", "Law of the interfaces", true},
    {"material.young", "Pa", "Young's modulus", false},
    {"strength.shape", "1", "Shape of the Weibull distribution", false},
};

static const fracas_value sample_value[SAMPLE_POINTS][3] = {
    {{NAN, "nitsche"}, {275e9, ""}, {12.5, ""}},
    {{NAN, "linear"}, {70e9, ""}, {NAN, ""}},
    {{NAN, ""}, {1.0 / 3.0, ""}, {-0.0, ""}},
};

/* Fills caller's storage: the table with so many replicas a point. */
static inline fracas_point_table sample_table(fracas_point_row row[SAMPLE_POINTS], int64_t replicas)
{
    for (int p = 0; p < SAMPLE_POINTS; p++)
        row[p] = (fracas_point_row){fracas_hash_of(&p, sizeof p), replicas, sample_value[p]};
    return (fracas_point_table){3, sample_column, SAMPLE_POINTS, row};
}

static inline fracas_file_header sample_header(void)
{
    return (fracas_file_header){.campaign = fracas_hash_of("campaign", 8),
                                .seed = UINT64_MAX - 4,
                                .history = 100,
                                .interfaces = true,
                                .version = "0.1.0"};
}

/* Three decisions about two of the points: point, round, replicas, used; mean, half width; stop;
 * quantity, minimum, maximum, relative half width and confidence of the rule. */
enum { SAMPLE_DECISIONS = 3 };

static const fracas_decision sample_decision[SAMPLE_DECISIONS] = {
    {0, 0, 8, 7, 0.1, NAN, 0, 2, 8, 1000000000, 0.02, 0.95},
    {0, 1, 16, 16, -1e300, 5e-324, 1, 1, 8, 16, 1, 0.5},
    {2, 0, 9, 0, NAN, NAN, 2, 0, 9, 9, 1e-9, 0.999},
};

/* ---- random records ---- */

/* splitmix64 */
static inline uint64_t sample_bits(uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

/* Any double: often NaN (of any bit pattern), zero of either sign, infinite or subnormal. */
static inline double sample_real(uint64_t *state)
{
    uint64_t bits = sample_bits(state);
    switch (sample_bits(state) % 8) {
    case 0: bits |= 0x7ff0000000000001u; break; /* NaN */
    case 1: bits &= 0x8000000000000000u; break; /* 0 or -0 */
    case 2: bits = (bits & 0x8000000000000000u) | 0x7ff0000000000000u; break;
    case 3: bits &= 0x800fffffffffffffu; break;
    default: break;
    }
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline int64_t sample_count(uint64_t *state, uint64_t below)
{
    return (int64_t)(sample_bits(state) % below);
}

static inline void sample_reals(uint64_t *state, double *value, size_t count)
{
    for (size_t i = 0; i < count; i++) value[i] = sample_real(state);
}

/* Reals of a fragment's shape, which lie in a row. */
enum { SAMPLE_SHAPE = (sizeof(fracas_fragment) - offsetof(fracas_fragment, volume)) / 8 };

/* The record of a realization, a function of (point, replica) alone. At most `most` rows in a part.
 */
static inline void sample_record(size_t point, int64_t replica, size_t most, fracas_record *record)
{
    uint64_t state = point * 1000003u + (uint64_t)replica;
    uint64_t reals = ~state; /* their own: how many there are changes nothing else */
    fracas_record_init(record);
    record->outcome = sample_count(&state, FRACAS_NOUTCOMES);
    if (record->outcome == FRACAS_FAILED) return;
    sample_reals(&reals, &record->onset_time, FRACAS_ENERGIES + 6); /* to residual_end, in a row */
    sample_reals(&state, record->momentum, 3);
    record->nfragment = record->outcome == FRACAS_INTACT ? 1 : sample_bits(&state) % (most + 1);
    record->nhistory = sample_bits(&state) % (most + 1);
    record->ninterface = sample_bits(&state) % (most + 1);
    record->fragments = (int64_t)record->nfragment;
    record->fragments_dust = sample_count(&state, record->nfragment + 1);
    record->broken = sample_count(&state, 1u << 20);
    record->cracked = sample_count(&state, UINT64_C(1) << 40);
    record->steps = INT64_MAX - sample_count(&state, 1000);
    record->fragment = calloc(record->nfragment + 1, sizeof *record->fragment);
    record->history = calloc(record->nhistory + 1, sizeof *record->history);
    record->interface = calloc(record->ninterface + 1, sizeof *record->interface);
    for (size_t i = 0; i < record->nfragment; i++) {
        fracas_fragment *f = &record->fragment[i];
        *f = (fracas_fragment){.elements = sample_count(&state, UINT64_C(1) << 33),
                               .dust = sample_count(&state, 2)};
        f->mass = sample_real(&state);
        f->size = sample_real(&state);
        sample_reals(&state, f->position, 3);
        sample_reals(&state, f->velocity, 3);
        sample_reals(&state, f->angular_momentum, 3);
        sample_reals(&state, f->spin, 3);
        sample_reals(&reals, &f->volume, SAMPLE_SHAPE);
    }
    for (size_t i = 0; i < record->nhistory; i++) {
        sample_reals(&state, &record->history[i].time, FRACAS_ENERGIES + 2); /* to residual */
        record->history[i].fragments = sample_count(&state, 1000);
        record->history[i].broken = sample_count(&state, 1000);
    }
    for (size_t i = 0; i < record->ninterface; i++)
        sample_reals(&state, &record->interface[i].strength, 4);
}

/* ---- comparing ---- */

static inline void sample_canonical(double *value, size_t count)
{
    static const uint64_t nan_bits = 0x7ff8000000000000u;
    for (size_t i = 0; i < count; i++)
        if (isnan(value[i])) memcpy(&value[i], &nan_bits, 8);
}

/* The record as the store gives it back: NaNs in their one pattern. */
static inline void sample_make_canonical(fracas_record *record)
{
    sample_canonical(&record->onset_time, FRACAS_ENERGIES + 6);
    sample_canonical(record->momentum, 3);
    for (size_t i = 0; i < record->nfragment; i++) {
        sample_canonical(&record->fragment[i].mass, 2);
        sample_canonical(record->fragment[i].position, 12); /* to spin they lie in a row */
        sample_canonical(&record->fragment[i].volume, SAMPLE_SHAPE);
    }
    for (size_t i = 0; i < record->nhistory; i++)
        sample_canonical(&record->history[i].time, FRACAS_ENERGIES + 2);
    for (size_t i = 0; i < record->ninterface; i++)
        sample_canonical(&record->interface[i].strength, 4);
}

/* True if every bit is the same. */
static inline bool sample_equal(const fracas_record *a, const fracas_record *b)
{
    size_t size = fracas_record_packed_size(a);
    if (size != fracas_record_packed_size(b)) return false;
    OWNED char *bytes_a = malloc(size), *bytes_b = malloc(size);
    fracas_record_pack(a, bytes_a);
    fracas_record_pack(b, bytes_b);
    return memcmp(bytes_a, bytes_b, size) == 0;
}

static inline bool sample_same_file(const char *a, const char *b)
{
    size_t size_a, size_b;
    unsigned char *bytes_a = whole_bytes(a, &size_a), *bytes_b = whole_bytes(b, &size_b);
    bool same = size_a == size_b && memcmp(bytes_a, bytes_b, size_a) == 0;
    free(bytes_a);
    free(bytes_b);
    return same;
}

/* ---- folders ---- */

/* A new folder; freed by sample_remove. */
static inline char *sample_folder(void)
{
    const char *base = getenv("TMPDIR");
    char *path;
    assert_true(asprintf(&path, "%s/fracas-store-XXXXXX", base ? base : "/tmp") > 0);
    assert_non_null(mkdtemp(path));
    return path;
}

/* FOLDER/NAME, until eight more were asked for. */
static inline char *sample_path(const char *folder, const char *name)
{
    enum { AT_ONCE = 8 };
    static char path[AT_ONCE][512];
    static int next;
    char text[512]; /* `folder` may itself be one of them */
    snprintf(text, sizeof text, "%s/%s", folder, name);
    next = (next + 1) % AT_ONCE;
    return strcpy(path[next], text);
}

static inline void sample_remove_tree(const char *path)
{
    struct stat info;
    if (lstat(path, &info)) return;
    DIR *folder = S_ISDIR(info.st_mode) ? opendir(path) : NULL; /* never through a link */
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char *inner;
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, "..")) continue;
        assert_true(asprintf(&inner, "%s/%s", path, entry->d_name) > 0);
        sample_remove_tree(inner);
        free(inner);
    }
    if (folder) closedir(folder);
    remove(path);
}

static inline void sample_remove(char *folder)
{
    sample_remove_tree(folder);
    free(folder);
}

/* Number of files whose name contains `part`. */
static inline int sample_files(const char *folder, const char *part)
{
    int count = 0;
    DIR *open_folder = opendir(folder);
    assert_non_null(open_folder);
    for (struct dirent *entry; (entry = readdir(open_folder));)
        count += strstr(entry->d_name, part) != NULL;
    closedir(open_folder);
    return count;
}

/* ---- a segment and its rows in the index ---- */

typedef struct {
    size_t point;
    int64_t replica;
} sample_realization;

#define SAMPLE_PROVENANCE "{\"host\": \"a\"}"

/* Writes these realizations to a segment of STUDY (which must have a folder `segments`); row: one a
 * realization. */
static inline void sample_segment(const char *study, const char *name,
                                  const fracas_point_table *table, const sample_realization *what,
                                  size_t count, size_t most, fracas_file_seal *seal,
                                  fracas_segment_row *row)
{
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    char path[512];
    snprintf(path, sizeof path, "%s/segments/%s", study, name);
    OK(fracas_writer_create(path, &header, table, &writer));
    OK(fracas_writer_provenance(writer, SAMPLE_PROVENANCE));
    for (size_t i = 0; i < count; i++) {
        FRACAS_CLEARED(fracas_record) record;
        sample_record(what[i].point, what[i].replica, most, &record);
        row[i] = (fracas_segment_row){table->point[what[i].point].hash, what[i].replica, (int64_t)i,
                                      fracas_summary_of(&record)};
        OK(fracas_writer_append(writer, what[i].point, what[i].replica, &record));
    }
    OK(fracas_writer_finish(writer, false, seal));
}

#endif
