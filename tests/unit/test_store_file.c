/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writer and reader of segments and studies. */
#include "tests/support/store_sample.h"
#include "tests/support/stored_mesh.h"

#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/schema.h"

#include <malloc.h>

enum {
    REPLICAS = 300,
    MOST = 40
}; /* 900 realizations and some 15000 rows a set: many chunks, none full at the end */

static char *folder;

static int set_up(void **state)
{
    folder = sample_folder();
    return 0;
}

static int tear_down(void **state)
{
    sample_remove(folder);
    return 0;
}

/* Point 1 a surface; none if shape is NULL. */
static void write_meshes(fracas_writer *writer, const grid_shape *shape)
{
    for (size_t p = 0; shape && p < SAMPLE_POINTS; p++) {
        FRACAS_CLEARED(fracas_stored_mesh) mesh = {0};
        if (p == 1) grid_make(shape, &mesh);
        OK(fracas_writer_mesh(writer, &mesh));
    }
}

/* What is written is read, in one piece or two; a file without any has no group, and one out of
 * range is damage. */
static void decisions_come_back(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, 0);
    fracas_file_header header = sample_header();
    for (size_t wanted = 0; wanted <= SAMPLE_DECISIONS + 1;
         wanted++) { /* the last round: the wrong one */
        fracas_decision wrong = sample_decision[0], *found;
        fracas_writer *writer;
        fracas_reader *reader;
        fracas_file_seal seal;
        size_t count;
        wrong.stop = 3;
        OK(fracas_writer_create(path, &header, &table, &writer));
        OK(fracas_writer_decisions(writer, sample_decision, wanted > 1 ? 1 : 0));
        OK(fracas_writer_decisions(writer, sample_decision + (wanted > 1),
                                   wanted > SAMPLE_DECISIONS ? 0 : wanted - (wanted > 1)));
        if (wanted > SAMPLE_DECISIONS) OK(fracas_writer_decisions(writer, &wrong, 1));
        OK(fracas_writer_finish(writer, true, &seal));
        OK(fracas_reader_open(path, &reader));
        if (wanted > SAMPLE_DECISIONS) {
            FAILS(fracas_reader_decisions(reader, &found, &count), FRACAS_DAMAGED, "/decision");
        } else {
            OK(fracas_reader_decisions(reader, &found, &count));
            assert_int_equal(count, wanted);
            for (size_t d = 0; d < count; d++)
                assert_true(fracas_decision_same(&found[d], &sample_decision[d]));
            free(found);
        }
        fracas_reader_close(reader);
    }
    for (size_t a = 0; a < SAMPLE_DECISIONS; a++)
        for (size_t b = 0; b < SAMPLE_DECISIONS; b++)
            assert_int_equal(fracas_decision_same(&sample_decision[a], &sample_decision[b]),
                             a == b);
}

static fracas_file_seal write_file_of(const char *path, int64_t replicas, size_t most,
                                      bool interfaces, const grid_shape *shape)
{
    fracas_file_seal seal;
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, replicas);
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    header.interfaces = interfaces;
    header.reactions = shape != NULL; /* no rows of these, nor of the probe */
    if (shape) header.probes = (fracas_probes){1, {{"tip", {0.1, 0, 0}}}};
    OK(fracas_writer_create(path, &header, &table, &writer));
    for (size_t p = 0; p < SAMPLE_POINTS; p++)
        for (int64_t r = 0; r < replicas; r++) {
            FRACAS_CLEARED(fracas_record) record;
            sample_record(p, r, most, &record);
            OK(fracas_writer_append(writer, p, r, &record));
        }
    if (shape) OK(fracas_writer_decisions(writer, sample_decision, SAMPLE_DECISIONS));
    write_meshes(writer, shape);
    OK(fracas_writer_finish(writer, true, &seal));
    return seal;
}

static fracas_file_seal write_file(const char *path, int64_t replicas, size_t most)
{
    return write_file_of(path, replicas, most, true, NULL);
}

static fracas_reader *reader_of(const char *path)
{
    fracas_reader *reader;
    OK(fracas_reader_open(path, &reader));
    return reader;
}

/* A file with so many replicas of each point, read again. */
static fracas_reader *written(int64_t replicas, size_t most)
{
    const char *path = sample_path(folder, "a.h5");
    write_file(path, replicas, most);
    return reader_of(path);
}

/* Name, and a value as the digits of its 64 bits. */
static void tell_bits(const char *what, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, 8);
    printf("%s %016llx", what, (unsigned long long)bits);
}

/* A line for each element, interface, border and node. */
static void tell_mesh(const fracas_stored_mesh *mesh)
{
    for (size_t e = 0; e < mesh->nelements; e++) {
        printf("element");
        for (int k = 0; k < 6; k++) printf(" %lld", (long long)mesh->element[e].node[k]);
        printf("\n");
    }
    for (size_t i = 0; i < mesh->ninterfaces; i++) {
        const fracas_stored_interface *of = &mesh->interface[i];
        printf("interface %lld %lld %lld %lld %lld\n", (long long)of->element[0],
               (long long)of->element[1], (long long)of->node[0], (long long)of->node[1],
               (long long)of->node[2]);
    }
    for (size_t b = 0; b < mesh->nborders; b++) {
        const fracas_stored_border *of = &mesh->border[b];
        printf("border %lld %lld %lld %lld %lld\n", (long long)of->element, (long long)of->node[0],
               (long long)of->node[1], (long long)of->node[2], (long long)of->tag);
    }
    for (size_t n = 0; n < mesh->nnodes; n++) {
        printf("node");
        for (int i = 0; i < 3; i++) tell_bits("", mesh->node[n].position[i]);
        printf("\n");
    }
}

/* For tests/unit/store_independent.sh: a file, and on standard output what another reader must find
 * in it, values as the digits of their 64 bits. */
static void write_and_tell(const char *path)
{
    enum { SOME = 5, ROWS = 7 };
    static const grid_shape shape = {.nx = 3, .ny = 2, .rolled = true, .middles = true};
    FRACAS_CLEARED(fracas_stored_mesh) mesh;
    write_file_of(path, SOME, ROWS, true, &shape);
    for (size_t i = 0; i < SAMPLE_POINTS * SOME; i++) {
        FRACAS_CLEARED(fracas_record) r;
        sample_record(i / SOME, (int64_t)(i % SOME), ROWS, &r);
        sample_make_canonical(&r);
        printf("%zu %zu %d %lld %lld", i / SOME, i % SOME, (int)r.outcome, (long long)r.fragments,
               (long long)r.steps);
        tell_bits("", r.end_time);
        for (size_t f = 0; f < r.nfragment; f++) {
            printf(" f %lld %d", (long long)r.fragment[f].elements, (int)r.fragment[f].dust);
            tell_bits("", r.fragment[f].velocity[2]);
            tell_bits("", r.fragment[f].spin[1]);
            tell_bits("", r.fragment[f].axis[1][1]);
            tell_bits("", r.fragment[f].crack_area);
        }
        for (size_t h = 0; h < r.nhistory; h++) {
            printf(" h %lld", (long long)r.history[h].broken);
            tell_bits("", r.history[h].residual);
        }
        for (size_t k = 0; k < r.ninterface; k++) tell_bits(" i", r.interface[k].damage);
        printf("\n");
    }
    grid_make(&shape, &mesh);
    tell_mesh(&mesh);
}

static void check_row(fracas_reader *reader, size_t row, int64_t replicas, size_t most,
                      unsigned parts)
{
    FRACAS_CLEARED(fracas_record) wanted, found;
    size_t point;
    int64_t replica;
    fracas_record_init(&found);
    OK(fracas_reader_record(reader, row, parts, &point, &replica, &found));
    assert_int_equal(point, row / (size_t)replicas);
    assert_int_equal(replica, (int64_t)row % replicas);
    sample_record(point, replica, most, &wanted);
    sample_make_canonical(&wanted);
    if (!(parts & FRACAS_READ_FRAGMENTS)) wanted.nfragment = 0;
    if (!(parts & FRACAS_READ_HISTORY)) wanted.nhistory = 0;
    if (!(parts & FRACAS_READ_INTERFACES)) wanted.ninterface = 0;
    assert_true(sample_equal(&wanted, &found));
}

static void check_all(fracas_reader *reader, int64_t replicas, size_t most)
{
    const size_t rows = SAMPLE_POINTS * (size_t)replicas;
    assert_int_equal(fracas_reader_realizations(reader), rows);
    for (size_t row = 0; row < rows; row++) check_row(reader, row, replicas, most, FRACAS_READ_ALL);
}

static void records_come_back_bit_by_bit(void **state)
{
    OWN(fracas_reader) reader = written(REPLICAS, MOST);
    check_all(reader, REPLICAS, MOST);
    uint64_t random = 5; /* any order, any parts */
    for (int i = 0; i < 200; i++)
        check_row(reader, sample_bits(&random) % (SAMPLE_POINTS * REPLICAS), REPLICAS, MOST,
                  (unsigned)sample_bits(&random) & FRACAS_READ_ALL);
    RECORD(record);
    size_t point;
    int64_t replica;
    FAILS(fracas_reader_record(reader, SAMPLE_POINTS * REPLICAS, 0, &point, &replica, &record),
          FRACAS_BUG, "row 900");
}

/* A record with `rows` times of two probes. */
static void probed_record(int64_t replica, size_t rows, fracas_record *record)
{
    uint64_t state = 77 + (uint64_t)replica;
    fracas_record_init(record);
    record->outcome = FRACAS_INTACT;
    record->nprobe = 2 * rows;
    record->probe = calloc(record->nprobe + 1, sizeof *record->probe);
    for (size_t i = 0; i < record->nprobe; i++) {
        record->probe[i].time = (double)(i / 2);
        record->probe[i].probe = (int64_t)(i % 2);
        sample_reals(&state, record->probe[i].displacement, 6);
        sample_canonical(record->probe[i].displacement, 6);
    }
}

static fracas_err read_probed(const char *path, const fracas_probes *wanted)
{
    OWN(fracas_reader) reader = NULL;
    size_t point;
    int64_t replica;
    TRY(fracas_reader_open(path, &reader));
    const fracas_file_header *header = fracas_reader_header(reader);
    assert_memory_equal(&header->probes, wanted, sizeof *wanted);
    for (size_t row = 0; row < 6; row++) {
        FRACAS_CLEARED(fracas_record) found, made;
        fracas_record_init(&found);
        TRY(fracas_reader_record(reader, row, FRACAS_READ_PROBES, &point, &replica, &found));
        probed_record(replica, 300 * row, &made);
        assert_int_equal(found.nprobe, made.nprobe);
        assert_memory_equal(found.probe, made.probe, made.nprobe * sizeof *made.probe);
    }
    return FRACAS_OK;
}

static void probes_come_back(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_point_row row[SAMPLE_POINTS];
    const fracas_point_table table = sample_table(row, 6);
    fracas_file_header header = sample_header();
    header.probes = (fracas_probes){2, {{"tip", {0.1, -2e-300, 3}}, {"a-b_C", {0, 1.0 / 3, 0}}}};
    header.probes.probe[1].place[1] = 0.333333333333333; /* 15 digits, as a campaign has */
    for (int64_t wrong = 0; wrong < 2; wrong++) {
        fracas_writer *writer;
        fracas_file_seal seal;
        OK(fracas_writer_create(path, &header, &table, &writer));
        for (int64_t r = 0; r < 6; r++) {
            FRACAS_CLEARED(fracas_record) record;
            probed_record(r, 300 * (size_t)r, &record);
            if (wrong && r == 3) record.probe[500].probe = 2;
            record.fragments = record.nfragment = 1;
            record.fragment = calloc(1, sizeof *record.fragment);
            OK(fracas_writer_append(writer, 0, r, &record));
        }
        OK(fracas_writer_finish(writer, true, &seal));
        if (wrong)
            FAILS(read_probed(path, &header.probes), FRACAS_DAMAGED, "no probe of that number");
        else OK(read_probed(path, &header.probes));
    }
}

static void probes_are_texts(void **state)
{
    static const char *const wrong[] = {"none",      "a",         "a 1 2",   "a 1 2 3;b 1 2 3",
                                        "a 1 2 3; ", "a 1 2 3 4", "a. 1 2 3"};
    fracas_probes most = {FRACAS_MOST_PROBES}, back;
    char text[FRACAS_PROBES_TEXT];
    for (size_t p = 0; p < most.count; p++) { /* the longest there are */
        snprintf(most.probe[p].name, FRACAS_PROBE_NAME, "%031zu", p);
        for (int i = 0; i < 3; i++) most.probe[p].place[i] = -1.23456789012345e-100;
    }
    fracas_probes_write(&most, text);
    assert_true(strlen(text) < FRACAS_PROBES_TEXT - 1 && fracas_probes_parse(text, &back));
    assert_memory_equal(&most, &back, sizeof most);
    assert_true(fracas_probes_parse("", &back) && back.count == 0);
    for (size_t w = 0; w < sizeof wrong / sizeof *wrong; w++)
        assert_false(fracas_probes_parse(wrong[w], &back));
}

static void header_and_points_come_back(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    write_file_of(path, 2, 3, false, NULL);
    OWN(fracas_reader) reader = reader_of(path);
    fracas_file_header wanted = sample_header();
    const fracas_file_header *header = fracas_reader_header(reader);
    assert_true(fracas_hash_equal(&header->campaign, &wanted.campaign));
    assert_true(header->seed == wanted.seed);
    assert_int_equal(header->history, 100);
    assert_false(header->interfaces);
    assert_string_equal(header->version, "0.1.0");
    assert_true(header->complete);
    const fracas_point_table *table = fracas_reader_points(reader);
    assert_int_equal(table->npoints, SAMPLE_POINTS);
    assert_int_equal(table->ncolumns, 3);
    for (size_t c = 0; c < 3; c++) {
        assert_string_equal(table->column[c].path, sample_column[c].path);
        assert_string_equal(table->column[c].unit, sample_column[c].unit);
        assert_string_equal(table->column[c].doc, sample_column[c].doc);
        assert_int_equal(table->column[c].text, sample_column[c].text);
    }
    for (size_t p = 0; p < SAMPLE_POINTS; p++) {
        fracas_hash hash = fracas_hash_of(&(int){(int)p}, sizeof(int));
        assert_true(fracas_hash_equal(&table->point[p].hash, &hash));
        assert_int_equal(table->point[p].replicas, 2);
        for (size_t c = 0; c < 3; c++) {
            assert_string_equal(table->point[p].value[c].text, sample_value[p][c].text);
            assert_true(isnan(sample_value[p][c].real)
                            ? isnan(table->point[p].value[c].real)
                            : table->point[p].value[c].real == sample_value[p][c].real);
        }
    }
    assert_true(signbit(table->point[2].value[2].real) != 0);
}

/* The second file is written with another heap and beside another open file. */
static void same_calls_give_same_bytes(void **state)
{
    char *a = sample_path(folder, "a.h5"), *b = sample_path(folder, "b.h5"),
         *c = sample_path(folder, "c.h5");
    const fracas_file_seal first = write_file(a, 77, MOST);
    void *holes[64];
    for (size_t i = 0; i < 64; i++) holes[i] = memset(malloc(1000 * i + 1), 0xa5, 1000 * i + 1);
    for (size_t i = 0; i < 64; i += 2) free(holes[i]);
    OWN(fracas_reader) reader = reader_of(a);
    const fracas_file_seal second = write_file(b, 77, MOST);
    for (size_t i = 1; i < 64; i += 2) free(holes[i]);
    assert_true(sample_same_file(a, b));
    assert_true(first.bytes == second.bytes && first.checksum == second.checksum);
    const fracas_file_seal third = write_file(c, 77, MOST - 1); /* other records: other bytes */
    assert_false(sample_same_file(a, c));
    assert_true(first.checksum != third.checksum);
}

static void seal_is_that_of_the_bytes(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    const fracas_file_seal seal = write_file(path, 5, MOST);
    fracas_file_seal again;
    size_t size;
    OWNED unsigned char *bytes = whole_bytes(path, &size);
    assert_true(seal.bytes == size && seal.checksum == fracas_checksum_of(bytes, size));
    OK(fracas_disk_seal_path(path, &again));
    assert_true(again.bytes == size && again.checksum == seal.checksum);
}

/* No record at all, and none with rows. */
static void empty_files_are_files(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_point_table none = {0, NULL, 0, NULL};
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    OK(fracas_writer_create(path, &header, &none, &writer));
    OK(fracas_writer_finish(writer, false, &seal));
    OWN(fracas_reader) reader = reader_of(path);
    assert_int_equal(fracas_reader_realizations(reader), 0);
    assert_int_equal(fracas_reader_points(reader)->npoints, 0);
    assert_false(fracas_reader_header(reader)->complete);
    OWN(fracas_reader) without_rows = written(4, 0);
    check_all(without_rows, 4, 0);
}

/* One realization larger than several blocks of the reader and chunks of the writer. */
static void large_records_are_cut_and_joined(void **state)
{
    OWN(fracas_reader) reader = written(3, 20000);
    for (size_t row = 9; row-- > 0;) check_row(reader, row, 3, 20000, FRACAS_READ_ALL);
}

/* Lists, spaces and types of HDF5 that nobody closes stay reachable, so no leak checker sees them;
 * but the heap grows: by megabytes in 20 rounds with one of them forgotten, else by the few
 * kilobytes that malloc keeps for itself. */
static void nothing_is_left_open(void **state)
{
    size_t used = 0;
    for (int round = 0; round < 30; round++) {
        fracas_reader *reader = written(4, MOST);
        check_all(reader, 4, MOST);
        fracas_reader_close(reader);
        if (round == 9) used = mallinfo2().uordblks;
    }
    assert_true(mallinfo2().uordblks < used + 65536);
}

static void nothing_unfinished_has_the_final_name(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, 1);
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    OK(fracas_writer_create(path, &header, &table, &writer));
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(sample_files(folder, ".a.h5.tmp-"), 1);
    fracas_writer_abandon(writer);
    assert_int_equal(sample_files(folder, "a.h5"), 0);
    fracas_writer_abandon(NULL);
}

static void contradicting_records_are_refused(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, 1);
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_record record;
    OK(fracas_writer_create(path, &header, &table, &writer));
    fracas_record_init(&record);
    FAILS(fracas_writer_append(writer, SAMPLE_POINTS, 0, &record), FRACAS_BUG, "point 3");
    record.outcome = FRACAS_INTACT;
    record.fragments = 1; /* and no row */
    FAILS(fracas_writer_append(writer, 0, 0, &record), FRACAS_BUG, "contradicts");
    record.fragments = 0;
    record.outcome = FRACAS_NOUTCOMES;
    FAILS(fracas_writer_append(writer, 0, 0, &record), FRACAS_BUG, "contradicts");
    fracas_fragment fragment = {.dust = 300};
    record.outcome = FRACAS_INTACT;
    record.fragments = 1;
    record.nfragment = 1;
    record.fragment = &fragment;
    FAILS(fracas_writer_append(writer, 0, 0, &record), FRACAS_BUG, "/fragment/dust");
    fracas_writer_abandon(writer);
}

static void other_files_are_refused(void **state)
{
    const char *path = sample_path(folder, "a.h5");
    fracas_reader *reader;
    FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED, "a.h5 is not there");
    assert_null(reader);
    write_bytes(path, "", 0);
    FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED, "a.h5");
    write_bytes(path, "campaign: x\n", 12);
    FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED, "a.h5");
    FAILS(fracas_reader_open(folder, &reader), FRACAS_ENVIRONMENT, folder);
}

/* HDF5 1.10 frees what it never set where it sorts links and one is damaged: memory that is not
 * zero shows it. */
static void a_damaged_name_of_a_column_is_told(void **state)
{
    enum {
        COLUMNS = 40
    }; /* above 8 links HDF5 keeps the names in a heap, these in several blocks */
    const char *path = sample_path(folder, "a.h5");
    char name[COLUMNS][16];
    fracas_column column[COLUMNS];
    fracas_value value[COLUMNS] = {0};
    for (int c = 0; c < COLUMNS; c++) {
        snprintf(name[c], sizeof name[c], "name%d", c);
        column[c] = (fracas_column){name[c], "", "", false};
    }
    fracas_point_row row = {fracas_hash_of("point", 5), 1, value};
    fracas_point_table table = {COLUMNS, column, 1, &row};
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    OK(fracas_writer_create(path, &header, &table, &writer));
    OK(fracas_writer_finish(writer, false, &seal));
    size_t size;
    unsigned char *bytes = whole_bytes(path, &size);
    unsigned char *first = memmem(bytes, size, "name39", 6);
    assert_non_null(first);
    mallopt(M_PERTURB, 0x5a);
    for (int bit = 0; bit < 64 * 8; bit++) {
        first[bit / 8] ^= 1 << bit % 8;
        write_bytes(path, bytes, size);
        first[bit / 8] ^= 1 << bit % 8;
        fracas_reader *reader;
        FAILS(fracas_reader_open(path, &reader), FRACAS_DAMAGED, "a.h5");
    }
    mallopt(M_PERTURB, 0);
    free(bytes);
}

static void records_survive_packing(void **state)
{
    for (int64_t replica = 0; replica < 50; replica++) {
        FRACAS_CLEARED(fracas_record) record, back;
        sample_record(1, replica, 9, &record);
        size_t size = fracas_record_packed_size(&record);
        OWNED char *bytes = malloc(size + 1);
        fracas_record_pack(&record, bytes);
        fracas_record_init(&back);
        OK(fracas_record_unpack(bytes, size, &back));
        assert_true(sample_equal(&record, &back));
        FAILS(fracas_record_unpack(bytes, size - 1, &back), FRACAS_BUG, "does not fit");
        FAILS(fracas_record_unpack(bytes, size + 1, &back), FRACAS_BUG, "does not fit");
        FAILS(fracas_record_unpack(bytes, 10, &back), FRACAS_BUG, "does not fit");
        ((fracas_record *)(void *)bytes)->nhistory = SIZE_MAX / sizeof(fracas_history_row) +
                                                     2; /* wraps around */
        FAILS(fracas_record_unpack(bytes, size, &back), FRACAS_BUG, "does not fit");
    }
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int fracas_test(void)
{
    if (test_argument) {
        write_and_tell(test_argument);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        TEST(records_come_back_bit_by_bit),
        TEST(probes_come_back),
        TEST(probes_are_texts),
        TEST(header_and_points_come_back),
        TEST(same_calls_give_same_bytes),
        TEST(seal_is_that_of_the_bytes),
        TEST(empty_files_are_files),
        TEST(large_records_are_cut_and_joined),
        TEST(nothing_is_left_open),
        TEST(nothing_unfinished_has_the_final_name),
        TEST(contradicting_records_are_refused),
        TEST(decisions_come_back),
        TEST(other_files_are_refused),
        TEST(a_damaged_name_of_a_column_is_told),
        TEST(records_survive_packing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
