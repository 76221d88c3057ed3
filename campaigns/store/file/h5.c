/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Attributes, columns and error messages of HDF5. */
#include "campaigns/store/file/h5.h"

#include "base/own.h"
#include "base/param.h"

#include <errno.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* ---- errors ---- */

typedef struct {
    char text[128];
    bool memory;
} error_walk;

static herr_t look_at_error(unsigned n, const H5E_error2_t *error, void *context)
{
    error_walk *walk = context;
    if (n == 0 && error->desc) snprintf(walk->text, sizeof walk->text, "%s", error->desc);
    if (error->maj_num == H5E_RESOURCE || error->min_num == H5E_NOSPACE ||
        error->min_num == H5E_CANTALLOC)
        walk->memory = true;
    /* Default properties miss only for want of memory; no file has a say in them. */
    if (n == 0 && error->maj_num == H5E_PLIST && error->min_num == H5E_NOTFOUND)
        walk->memory = true;
    return 0;
}

fracas_err fracas_h5_fail(const fracas_h5 *h5, const char *what)
{
    /* malloc says so in errno, and nothing resets it: HDF5 may find out later, and otherwise. */
    error_walk walk = {.text = "it is not as it should be", .memory = errno == ENOMEM};
    (void)H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, look_at_error, &walk);
    (void)H5Eclear2(H5E_DEFAULT);
    if (h5->error)
        return fracas_fail_system(h5->error, "cannot %s %s (%s)", h5->writing ? "write" : "read",
                                  h5->path, what);
    if (walk.memory) return fracas_no_memory(h5->path);
    if (h5->writing)
        return fracas_fail(FRACAS_BUG, "%s: %s: HDF5 refuses: %s", h5->path, what, walk.text);
    return fracas_fail(FRACAS_DAMAGED, "%s: %s: damaged, or no file of fracas: %s", h5->path, what,
                       walk.text);
}

void fracas_h5_let_go(const hid_t *id)
{
    if (*id >= 0) (void)H5Idec_ref(*id);
}

/* ---- attributes ---- */

enum { MOST_TEXT = 4096 }; /* bytes of an attribute that a reader accepts */

/* Text of exactly `size` bytes, padded with NUL; closed by the caller, after an error too. */
static bool make_text_type(size_t size, hid_t *type)
{
    *type = H5Tcopy(H5T_C_S1);
    return *type >= 0 && H5Tset_size(*type, size) >= 0 &&
           H5Tset_strpad(*type, H5T_STR_NULLPAD) >= 0 && H5Tset_cset(*type, H5T_CSET_UTF8) >= 0;
}

static fracas_err put_attribute(const fracas_h5 *h5, const char *object, const char *name,
                                hid_t file_type, hid_t memory_type, const void *value)
{
    OWN_ID attribute = H5I_INVALID_HID;
    OWN_ID space = H5Screate(H5S_SCALAR);
    if (space >= 0)
        attribute = H5Acreate_by_name(h5->id, object, name, file_type, space, H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT);
    const bool ok = attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0;
    return ok ? FRACAS_OK : fracas_h5_fail(h5, name);
}

fracas_err fracas_h5_put_text(const fracas_h5 *h5, const char *object, const char *name,
                              const char *text)
{
    size_t length = strlen(text);
    if (length > MOST_TEXT)
        return fracas_fail(FRACAS_BUG, "%s of %s is longer than %d bytes", name, object, MOST_TEXT);
    OWN_ID type = H5I_INVALID_HID;
    if (!make_text_type(length ? length : 1, &type)) return fracas_h5_fail(h5, name);
    return put_attribute(h5, object, name, type, type, text);
}

fracas_err fracas_h5_put_integer(const fracas_h5 *h5, const char *object, const char *name,
                                 hid_t file_type, uint64_t value)
{
    return put_attribute(h5, object, name, file_type, H5T_NATIVE_UINT64, &value);
}

/* Opens a scalar attribute and its type; both closed by the caller, after an error too. */
static fracas_err open_attribute(const fracas_h5 *h5, const char *object, const char *name,
                                 hid_t *attribute, hid_t *type)
{
    *attribute = H5Aopen_by_name(h5->id, object, name, H5P_DEFAULT, H5P_DEFAULT);
    OWN_ID space = *attribute >= 0 ? H5Aget_space(*attribute) : H5I_INVALID_HID;
    if (space >= 0 && H5Sget_simple_extent_type(space) == H5S_SCALAR)
        *type = H5Aget_type(*attribute);
    return *type >= 0 ? FRACAS_OK : fracas_h5_fail(h5, name);
}

/* Bytes of a text of fixed length, 1 to `most`; 0 if `type` is no such text. */
static size_t text_size(hid_t type, uint64_t most)
{
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return 0;
    size_t size = H5Tget_size(type);
    return size <= most ? size : 0;
}

fracas_err fracas_h5_get_text(const fracas_h5 *h5, const char *object, const char *name,
                              char **text)
{
    OWN_ID attribute = H5I_INVALID_HID;
    OWN_ID type = H5I_INVALID_HID;
    *text = NULL;
    TRY(open_attribute(h5, object, name, &attribute, &type));
    const size_t size = text_size(type, MOST_TEXT);
    if (!size) return fracas_h5_fail(h5, name);
    OWNED char *found = calloc(1, size + 1);
    if (!found) return fracas_no_memory("an attribute");
    if (H5Aread(attribute, type, found) < 0) return fracas_h5_fail(h5, name);
    *text = found;
    found = NULL;
    return FRACAS_OK;
}

fracas_err fracas_h5_has_attribute(const fracas_h5 *h5, const char *object, const char *name,
                                   bool *has)
{
    const htri_t found = H5Aexists_by_name(h5->id, object, name, H5P_DEFAULT);
    *has = found > 0;
    return found < 0 ? fracas_h5_fail(h5, name) : FRACAS_OK;
}

fracas_err fracas_h5_get_integer(const fracas_h5 *h5, const char *object, const char *name,
                                 hid_t file_type, uint64_t *value)
{
    OWN_ID attribute = H5I_INVALID_HID;
    OWN_ID type = H5I_INVALID_HID;
    TRY(open_attribute(h5, object, name, &attribute, &type));
    const bool ok = H5Tequal(type, file_type) > 0 &&
                    H5Aread(attribute, H5T_NATIVE_UINT64, value) >= 0;
    return ok ? FRACAS_OK : fracas_h5_fail(h5, name);
}

/* ---- groups and columns ---- */

fracas_err fracas_h5_create_group(const fracas_h5 *h5, const char *path)
{
    OWN_ID group = H5I_INVALID_HID;
    OWN_ID creation = H5Pcreate(H5P_GROUP_CREATE);
    if (creation >= 0 && H5Pset_obj_track_times(creation, false) >= 0)
        group = H5Gcreate2(h5->id, path, H5P_DEFAULT, creation, H5P_DEFAULT);
    return group < 0 ? fracas_h5_fail(h5, path) : FRACAS_OK;
}

typedef struct {
    char **name;
    size_t count, most;
    bool no_memory;
} link_names;

static herr_t take_link(hid_t group, const char *name, const H5L_info_t *info, void *taken)
{
    (void)group, (void)info;
    link_names *names = taken;
    if (names->count == names->most) return -1;
    names->no_memory = !(names->name[names->count] = strdup(name));
    if (names->no_memory) return -1;
    names->count++;
    return 0;
}

static int by_bytes(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

fracas_err fracas_h5_link_names(const fracas_h5 *h5, const char *group, size_t most, char **name,
                                size_t *count)
{
    link_names names = {name, 0, most, false};
    /* HDF5 1.10 sorts links in a table, and frees what it never set there once a link is damaged.
     */
    const herr_t status = H5Literate_by_name(h5->id, group, H5_INDEX_NAME, H5_ITER_NATIVE, NULL,
                                             take_link, &names, H5P_DEFAULT);
    *count = names.count;
    if (names.no_memory) return fracas_no_memory("the names of a group");
    if (status < 0) return fracas_h5_fail(h5, group);
    qsort(name, names.count, sizeof *name, by_bytes);
    return FRACAS_OK;
}

fracas_err fracas_h5_text_width(const fracas_h5 *h5, const char *path, size_t *width)
{
    OWN_ID dataset = H5Dopen2(h5->id, path, H5P_DEFAULT);
    OWN_ID type = dataset >= 0 ? H5Dget_type(dataset) : H5I_INVALID_HID;
    *width = type < 0 ? 0 : text_size(type, h5->bytes);
    return type < 0 ? fracas_h5_fail(h5, path) : FRACAS_OK;
}

/* The type of a column; closed by the caller, after an error too. */
static bool make_type(const fracas_store_column *column, bool in_file, hid_t *type)
{
    switch (column->type) {
    case FRACAS_INT8: *type = H5Tcopy(in_file ? H5T_STD_I8LE : H5T_NATIVE_INT8); break;
    case FRACAS_INT32: *type = H5Tcopy(in_file ? H5T_STD_I32LE : H5T_NATIVE_INT32); break;
    case FRACAS_INT64: *type = H5Tcopy(in_file ? H5T_STD_I64LE : H5T_NATIVE_INT64); break;
    case FRACAS_FLOAT64: *type = H5Tcopy(in_file ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE); break;
    case FRACAS_TEXT: return make_text_type(column->width, type);
    }
    return *type >= 0;
}

/* One dimension, or two if a row is a vector. */
static int column_rank(const fracas_store_column *column)
{
    return column->type != FRACAS_TEXT && column->width > 1 ? 2 : 1;
}

/* Shuffle is there for whoever repacks the file with compression; Fletcher32 finds flipped bytes.
 * Neither is optional: HDF5 leaves out an optional filter that finds no memory, and the file would
 * have other bytes. */
static bool make_creation(const fracas_store_column *column, size_t chunk, hid_t *list)
{
    hsize_t shape[2] = {chunk, column->width};
    *list = H5Pcreate(H5P_DATASET_CREATE);
    return *list >= 0 && H5Pset_chunk(*list, column_rank(column), shape) >= 0 &&
           H5Pset_filter(*list, H5Z_FILTER_SHUFFLE, H5Z_FLAG_MANDATORY, 0, NULL) >= 0 &&
           H5Pset_fletcher32(*list) >= 0 && H5Pset_obj_track_times(*list, false) >= 0 &&
           H5Pset_fill_time(*list, H5D_FILL_TIME_ALLOC) >= 0;
}

/* No chunk cache: rows are written and read by whole chunks. */
static bool make_access(hid_t *list)
{
    *list = H5Pcreate(H5P_DATASET_ACCESS);
    return *list >= 0 && H5Pset_chunk_cache(*list, 1, 0, 1.0) >= 0;
}

fracas_err fracas_h5_create_column(const fracas_h5 *h5, const fracas_store_column *column,
                                   size_t chunk, hid_t *dataset)
{
    hsize_t none[2] = {0, column->width}, most[2] = {H5S_UNLIMITED, column->width};
    OWN_ID type = H5I_INVALID_HID;
    OWN_ID space = H5I_INVALID_HID;
    OWN_ID creation = H5I_INVALID_HID;
    OWN_ID access = H5I_INVALID_HID;
    *dataset = H5I_INVALID_HID;
    if (make_type(column, true, &type) && /* no call after one that failed: it would forget why */
        (space = H5Screate_simple(column_rank(column), none, most)) >= 0 &&
        make_creation(column, chunk, &creation) && make_access(&access))
        *dataset = H5Dcreate2(h5->id, column->path, type, space, H5P_DEFAULT, creation, access);
    if (*dataset < 0) return fracas_h5_fail(h5, column->path);
    TRY(fracas_h5_put_text(h5, column->path, "unit", column->unit));
    return fracas_h5_put_text(h5, column->path, "description", column->description);
}

/* Type, shape, chunk and filters are those of the schema, and the rows are in the file. Nothing is
 * compressed, so rows that are there take their bytes: this bounds every allocation to come. */
static fracas_err check_column(const fracas_h5 *h5, const fracas_store_column *column, size_t chunk,
                               hid_t dataset, uint64_t *rows)
{
    static const H5Z_filter_t filters[2] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_FLETCHER32};
    const int rank = column_rank(column);
    hsize_t shape[2] = {0, 1}, chunks[2] = {0, 0};
    OWN_ID wanted = H5I_INVALID_HID;
    OWN_ID list = H5I_INVALID_HID;
    OWN_ID space = H5I_INVALID_HID;
    OWN_ID found = H5Dget_type(dataset);
    bool right = found >= 0 && make_type(column, true, &wanted) && H5Tequal(found, wanted) > 0 &&
                 (space = H5Dget_space(dataset)) >= 0 &&
                 H5Sget_simple_extent_ndims(space) == rank &&
                 H5Sget_simple_extent_dims(space, shape, NULL) == rank &&
                 (rank == 1 || shape[1] == column->width) &&
                 (list = H5Dget_create_plist(dataset)) >= 0 && H5Pget_layout(list) == H5D_CHUNKED &&
                 H5Pget_chunk(list, 2, chunks) == rank && chunks[0] == chunk &&
                 (rank == 1 || chunks[1] == column->width) && H5Pget_nfilters(list) == 2;
    for (unsigned f = 0; right && f < FRACAS_COUNT(filters); f++) {
        unsigned flags;
        size_t none = 0;
        right = H5Pget_filter2(list, f, &flags, &none, NULL, 0, NULL, NULL) == filters[f];
    }
    *rows = shape[0];
    right = right && *rows <= h5->bytes &&
            *rows * fracas_stored_size(column) <= H5Dget_storage_size(dataset) &&
            H5Dget_storage_size(dataset) <= h5->bytes;
    return right ? FRACAS_OK : fracas_h5_fail(h5, column->path);
}

fracas_err fracas_h5_open_column(const fracas_h5 *h5, const fracas_store_column *column,
                                 size_t chunk, hid_t *dataset, uint64_t *rows)
{
    OWN_ID access = H5I_INVALID_HID;
    OWN_ID opened = make_access(&access) ? H5Dopen2(h5->id, column->path, access) : H5I_INVALID_HID;
    *dataset = H5I_INVALID_HID;
    if (opened < 0) return fracas_h5_fail(h5, column->path);
    TRY(check_column(h5, column, chunk, opened, rows));
    *dataset = opened;
    opened = H5I_INVALID_HID;
    return FRACAS_OK;
}

typedef enum { READ_ROWS, WRITE_ROWS } direction;

static fracas_err transfer(const fracas_h5 *h5, const fracas_store_column *column, hid_t dataset,
                           uint64_t start, size_t count, direction way, void *stored)
{
    hsize_t from[2] = {start, 0}, size[2] = {count, column->width};
    OWN_ID type = H5I_INVALID_HID;
    OWN_ID memory = H5I_INVALID_HID;
    OWN_ID space = H5I_INVALID_HID;
    bool ok = make_type(column, false, &type) &&
              (memory = H5Screate_simple(column_rank(column), size, NULL)) >= 0 &&
              (space = H5Dget_space(dataset)) >= 0 &&
              H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, size, NULL) >= 0;
    if (ok && way == WRITE_ROWS)
        ok = H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, stored) >= 0 && !h5->error;
    else if (ok) ok = H5Dread(dataset, type, memory, space, H5P_DEFAULT, stored) >= 0;
    return ok ? FRACAS_OK : fracas_h5_fail(h5, column->path);
}

fracas_err fracas_h5_append_rows(const fracas_h5 *h5, const fracas_store_column *column,
                                 hid_t dataset, uint64_t start, size_t count, const void *stored)
{
    hsize_t extent[2] = {start + count, column->width};
    if (H5Dset_extent(dataset, extent) < 0) return fracas_h5_fail(h5, column->path);
    return transfer(h5, column, dataset, start, count, WRITE_ROWS, (void *)(uintptr_t)stored);
}

fracas_err fracas_h5_read_rows(const fracas_h5 *h5, const fracas_store_column *column,
                               hid_t dataset, uint64_t start, size_t count, void *stored)
{
    return transfer(h5, column, dataset, start, count, READ_ROWS, stored);
}
