/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Segments and studies that were not written by fracas, or not like this: everything in them is
 * read, or refused as damaged with a message that names the file. The input is a script: its first
 * byte chooses a sound file, the rest changes it, by the HDF5 library itself (so that every
 * checksum fits: values, sizes, types, attributes, links) and then in its bytes. What is read can
 * be written again. For libFuzzer (tools/fuzz), and the corpus as a test.
 *
 * Bytes are changed without making the checksums of HDF5 fit again: HDF5 1.10 can be crashed that
 * way, and fracas lets it see a segment only after a checksum over all of it
 * (campaigns/store/file/disk.h). */
#include "tests/fuzz/fuzz.h"

#include "campaigns/store/file/h5.h"
#include "tests/support/store_sample.h"
#include "tests/support/stored_mesh.h"

/* HDF5 1.10 forgets an object header whose checksum is wrong; it is no leak of ours. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libhdf5";
}

enum { NBASES = 4, REPLICAS = 2, MOST = 5, MOST_OPERATIONS = 24, MOST_DATASETS = 256 };

typedef struct {
    unsigned char *bytes;
    size_t size;
} image;

static char folder[64], path[80], other[80];
static image base[NBASES];
static const char *dataset[MOST_DATASETS];
static size_t ndatasets;

/* ---- sound files ---- */

static void write_meshes(fracas_writer *writer)
{
    static const grid_shape shape = {.nx = 2, .ny = 1, .middles = true};
    for (size_t p = 0; p < SAMPLE_POINTS; p++) {
        fracas_stored_mesh mesh = {0};
        if (p == 1) grid_make(&shape, &mesh);
        FUZZ_OK(fracas_writer_mesh(writer, &mesh));
        fracas_stored_mesh_clear(&mesh);
    }
}

static char campaign_text[] = "name: small\n";
static fracas_attachment campaign_files[] = {
    {.text = "3\n", .size = 2, .digest = "0123456789abcdef0123456789abcdef"},
    {.text = "4", .size = 1, .digest = "abcdef0123456789abcdef0123456789"}};
static const fracas_campaign_copy campaign = {
    .text = campaign_text, .size = sizeof campaign_text - 1, .nfiles = 2, .file = campaign_files};

/* 0: with interfaces; 1: without; 2: with decisions, meshes and campaign; 3: without realizations.
 */
static void write_base(int which)
{
    fracas_point_row row[SAMPLE_POINTS];
    fracas_point_table table = sample_table(row, which == 3 ? 0 : REPLICAS);
    fracas_file_header header = sample_header();
    fracas_writer *writer;
    fracas_file_seal seal;
    header.interfaces = which != 1;
    FUZZ_OK(fracas_writer_create(path, &header, &table, &writer));
    for (size_t i = 0; which != 3 && i < SAMPLE_POINTS * REPLICAS; i++) {
        fracas_record record;
        sample_record(i / REPLICAS, (int64_t)(i % REPLICAS), MOST, &record);
        FUZZ_DEMAND(fracas_writer_append(writer, i / REPLICAS, (int64_t)(i % REPLICAS), &record) ==
                        FRACAS_OK,
                    fracas_message());
        fracas_record_clear(&record);
    }
    if (which == 2) {
        FUZZ_OK(fracas_writer_decisions(writer, sample_decision, SAMPLE_DECISIONS));
        write_meshes(writer);
        FUZZ_OK(fracas_writer_campaign(writer, &campaign));
    }
    FUZZ_OK(fracas_writer_finish(writer, true, &seal));
    base[which].bytes = whole_bytes(path, &base[which].size);
}

static void start(void)
{
    if (ndatasets) return;
    fuzz_folder(folder);
    snprintf(path, sizeof path, "%s/a.h5", folder);
    snprintf(other, sizeof other, "%s/b.h5", folder);
    for (int which = 0; which < NBASES; which++) write_base(which);
    static const char *const points[] = {"/point/hash", "/point/replicas", "/point/cohesive.law",
                                         "/point/material.young", "/point/strength.shape"};
    for (size_t p = 0; p < sizeof points / sizeof *points; p++) dataset[ndatasets++] = points[p];
    for (int s = 0; s < FRACAS_NSETS; s++)
        for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++)
            dataset[ndatasets++] = fracas_store_sets[s].column[c].path;
    dataset[ndatasets++] = "/campaign/resolved";
    dataset[ndatasets++] = "/campaign/attachments/0123456789abcdef0123456789abcdef";
    FUZZ_DEMAND(ndatasets <= MOST_DATASETS, "room for the names of datasets");
}

/* ---- the script ---- */

typedef struct {
    const uint8_t *at;
    size_t left;
} script;

static uint64_t take(script *s, size_t bytes) /* little-endian; zeros after its end */
{
    uint64_t value = 0;
    for (size_t b = 0; b < bytes && s->left > 0; b++, s->at++, s->left--)
        value |= (uint64_t)*s->at << 8 * b;
    return value;
}

static const char *take_object(script *s)
{
    static const char *const group[] = {"/",         "/point",   "/realization",
                                        "/fragment", "/history", "/interface",
                                        "/decision", "/mesh",    "/campaign"};
    const size_t ngroups = sizeof group / sizeof *group, n = take(s, 1) % (ndatasets + ngroups);
    return n < ndatasets ? dataset[n] : group[n - ndatasets];
}

/* Attributes that a file has, and one that it has not. */
static const char *take_attribute(script *s)
{
    static const char *const name[] = {
        "format_version", "campaign", "seed", "history",     "interfaces",   "program_version",
        "complete",       "columns",  "unit", "description", "of no meaning"};
    return name[take(s, 1) % (sizeof name / sizeof *name)];
}

static hid_t take_type(script *s, bool *text)
{
    const uint64_t which = take(s, 1) % 9;
    const hid_t type[] = {H5T_STD_I8LE,   H5T_STD_I32LE,  H5T_STD_I64LE, H5T_STD_U64LE,
                          H5T_IEEE_F64LE, H5T_IEEE_F32LE, H5T_STD_I64BE};
    *text = which >= 7;
    if (which < 7) return H5Tcopy(type[which]);
    hid_t made = H5Tcopy(H5T_C_S1);
    (void)H5Tset_size(made, which == 7 ? 1 + (size_t)take(s, 2) % 5000 : H5T_VARIABLE);
    if (take(s, 1) & 1)
        (void)H5Tset_strpad(made, H5T_STR_NULLPAD), (void)H5Tset_cset(made, H5T_CSET_UTF8);
    return made;
}

/* ---- changes by HDF5 ---- */

/* One value of a dataset, whatever its type: its first bytes. */
static void set_value(hid_t file, script *s)
{
    const char *name = dataset[take(s, 1) % ndatasets];
    hsize_t row[2] = {take(s, 2), 0}, count[2] = {1, 1}, shape[2] = {0, 1}, one = 1;
    const uint64_t value = take(s, 1 + take(s, 1) % 8);
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), type = H5Dget_type(set),
          space = H5Dget_space(set);
    char bytes[5000] = "";
    memcpy(bytes, &value, sizeof value);
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank >= 1 && rank <= 2 && H5Sget_simple_extent_dims(space, shape, NULL) == rank &&
        shape[0] > 0 && shape[1] > 0 && H5Tget_size(type) <= sizeof bytes &&
        H5Tis_variable_str(type) <= 0) {
        row[1] = row[0] / shape[0] % shape[1];
        row[0] %= shape[0];
        hid_t memory = H5Screate_simple(1, &one, NULL);
        if (H5Sselect_hyperslab(space, H5S_SELECT_SET, row, NULL, count, NULL) >= 0)
            (void)H5Dwrite(set, type, memory, space, H5P_DEFAULT, bytes);
        H5Sclose(memory);
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
}

static void set_rows(hid_t file, script *s)
{
    const char *name = dataset[take(s, 1) % ndatasets];
    hsize_t shape[2] = {0, 1};
    hid_t set = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(set);
    if (H5Sget_simple_extent_ndims(space) <= 2) (void)H5Sget_simple_extent_dims(space, shape, NULL);
    const uint64_t rows = take(s, 2);
    shape[0] = rows & 0x8000 ? UINT64_C(256) << (rows & 15)
                             : rows & 0xfff; /* a chunk that was never written takes no room */
    (void)H5Dset_extent(set, shape);
    H5Sclose(space);
    H5Dclose(set);
}

static void set_attribute(hid_t file, script *s)
{
    const char *object = take_object(s), *name = take_attribute(s);
    bool text;
    hid_t type = take_type(s, &text);
    hsize_t two = 2;
    hid_t space = take(s, 1) & 1 ? H5Screate_simple(1, &two, NULL) : H5Screate(H5S_SCALAR);
    (void)H5Adelete_by_name(file, object, name, H5P_DEFAULT);
    hid_t attribute = H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT,
                                        H5P_DEFAULT);
    char value[2 * 5008] = "";
    for (size_t b = 0; b < 40 && s->left > 0; b++) value[b] = (char)take(s, 1);
    if (attribute >= 0 && H5Tis_variable_str(type) <= 0) (void)H5Awrite(attribute, type, value);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(type);
}

/* A dataset in the place of an old one, or beside it: type, shape, chunks and filters by the
 * script. */
static void make_dataset(hid_t file, script *s)
{
    static const char *const fresh[] = {"/point/a", "/point/0", "/mesh", "/decision", "/interface"};
    const uint64_t which = take(s, 1), how = take(s, 2);
    const char *name = which % 2 ? fresh[which / 2 % 5] : dataset[which % ndatasets];
    bool text;
    hsize_t shape[3] = {take(s, 2) & 0xfff, 1 + (how & 3), 1},
            most[3] = {H5S_UNLIMITED, shape[1], 1};
    const hsize_t chunk[3] = {how & 4    ? 256
                              : how & 8  ? 64
                              : how & 16 ? 1024
                                         : 1 + (how >> 8),
                              shape[1], 1};
    const int rank = how & 32 ? 2 : how & 64 ? 3 : 1;
    hid_t type = take_type(s, &text), space = H5Screate_simple(rank, shape, most),
          list = H5Pcreate(H5P_DATASET_CREATE);
    hid_t links = H5Pcreate(H5P_LINK_CREATE);
    (void)H5Pset_create_intermediate_group(links, 1);
    (void)H5Pset_chunk(list, rank, chunk);
    if (how & 128) (void)H5Pset_shuffle(list);
    if (how & 128) (void)H5Pset_fletcher32(list);
    (void)H5Ldelete(file, name, H5P_DEFAULT);
    hid_t set = H5Dcreate2(file, name, type, space, links, list, H5P_DEFAULT);
    if (set >= 0 && !text && shape[0] > 0) { /* rows that are there */
        char *zeros = calloc(shape[0] * shape[1], 8);
        (void)H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, zeros);
        free(zeros);
    }
    H5Dclose(set);
    H5Pclose(links);
    H5Pclose(list);
    H5Sclose(space);
    H5Tclose(type);
}

static void move_link(hid_t file, script *s)
{
    const char *from = take_object(s), *to = take_object(s);
    const uint64_t how = take(s, 1);
    if (how % 4 == 0) (void)H5Ldelete(file, from, H5P_DEFAULT);
    if (how % 4 == 1)
        (void)H5Ldelete(file, to, H5P_DEFAULT),
            (void)H5Lcreate_hard(file, from, file, to, H5P_DEFAULT, H5P_DEFAULT);
    if (how % 4 == 2)
        (void)H5Ldelete(file, to, H5P_DEFAULT),
            (void)H5Lcreate_soft(from, file, to, H5P_DEFAULT, H5P_DEFAULT);
    if (how % 4 == 3)
        (void)H5Ldelete(file, to, H5P_DEFAULT),
            (void)H5Lmove(file, from, file, to, H5P_DEFAULT, H5P_DEFAULT);
}

static void by_hdf5(script *s, uint64_t operations)
{
    hid_t list = H5Pcreate(H5P_FILE_ACCESS);
    (void)H5Pset_libver_bounds(list, H5F_LIBVER_V110, H5F_LIBVER_V110);
    (void)H5Pset_fclose_degree(list, H5F_CLOSE_STRONG);
    hid_t file = H5Fopen(path, H5F_ACC_RDWR, list);
    FUZZ_DEMAND(file >= 0, "a sound file opens");
    static void (*const operation[])(hid_t file, script * s) = {
        set_value, set_value, set_value, set_rows, set_attribute, make_dataset, move_link};
    while (operations-- > 0 && s->left > 0) operation[take(s, 1) % 7](file, s);
    H5Fclose(file);
    H5Pclose(list);
}

/* ---- changes of bytes ---- */

static void by_bytes(script *s)
{
    size_t size;
    unsigned char *bytes = whole_bytes(path, &size);
    for (int n = 0; n < MOST_OPERATIONS && s->left > 0 && size > 0; n++) {
        const uint64_t at = take(s, 3) % size, length = take(s, 1);
        if (length == 0) size = at; /* cut short */
        for (uint64_t b = at; b < at + length % 64 && b < size && s->left > 0; b++)
            bytes[b] = (unsigned char)take(s, 1);
    }
    write_bytes(path, bytes, size);
    free(bytes);
}

/* ---- reading ---- */

static void demand_damaged(fracas_err err)
{
    FUZZ_DEMAND(err == FRACAS_DAMAGED && strstr(fracas_message(), path), fracas_message());
}

/* Reads every record; writes them again with `writer`, unless that is NULL. */
static fracas_err read_records(fracas_reader *reader, fracas_writer *writer)
{
    fracas_record record;
    fracas_err err = FRACAS_OK;
    fracas_record_init(&record);
    for (size_t row = 0; !err && row < fracas_reader_realizations(reader); row++) {
        size_t point;
        int64_t replica;
        err = fracas_reader_record(reader, row, FRACAS_READ_ALL, &point, &replica, &record);
        if (err) break;
        FUZZ_DEMAND(point < fracas_reader_points(reader)->npoints && replica >= 0,
                    "a realization of no point");
        void *packed = malloc(fracas_record_packed_size(&record));
        fracas_record_pack(&record, packed); /* touches every row */
        free(packed);
        if (writer) FUZZ_OK(fracas_writer_append(writer, point, replica, &record));
    }
    fracas_record_clear(&record);
    return err;
}

static fracas_err read_meshes(fracas_reader *reader)
{
    for (size_t p = 0; p < fracas_reader_points(reader)->npoints; p++) {
        fracas_stored_mesh mesh;
        size_t interfaces;
        TRY(fracas_reader_mesh_interfaces(reader, p, &interfaces));
        TRY(fracas_reader_mesh(reader, p, &mesh));
        FUZZ_DEMAND(mesh.ninterfaces == interfaces, "interfaces of a mesh");
        fracas_stored_mesh_clear(&mesh);
    }
    return FRACAS_OK;
}

static fracas_err read_parts(fracas_reader *reader, fracas_writer *writer)
{
    fracas_decision *found;
    size_t count;
    TRY(read_records(reader, writer));
    TRY(read_meshes(reader));
    TRY(fracas_reader_decisions(reader, &found, &count));
    free(found);
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    return fracas_reader_campaign(reader, &copy);
}

/* Everything in the file; where `again`, it is also written to another one. */
static void read_all(bool again)
{
    fracas_reader *reader;
    fracas_writer *writer = NULL;
    uint64_t version;
    fracas_err err = fracas_file_version(path, &version);
    if (err) demand_damaged(err);
    err = fracas_reader_open(path, &reader);
    if (err) {
        demand_damaged(err);
        return;
    }
    if (again)
        err = fracas_writer_create(other, fracas_reader_header(reader),
                                   fracas_reader_points(reader), &writer);
    FUZZ_DEMAND(!err, fracas_message());
    err = read_parts(reader, writer);
    if (err) demand_damaged(err);
    fracas_writer_abandon(writer);
    fracas_reader_close(reader);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    start();
    fuzz_limit();
    script s = {data, size};
    const uint64_t how = take(&s, 1);
    const image *of = &base[how % NBASES];
    write_bytes(path, of->bytes, of->size);
    if (how & 0x80) by_bytes(&s);
    else by_hdf5(&s, 1 + (how >> 2) % MOST_OPERATIONS);
    read_all(how & 0x40);
    FUZZ_DEMAND(H5Fget_obj_count((hid_t)H5F_OBJ_ALL, H5F_OBJ_ALL) == 0,
                "what was opened is closed");
    return 0;
}
