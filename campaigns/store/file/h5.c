/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Attributes, columns and error messages of HDF5. */
#include "campaigns/store/file/h5.h"

#include "base/param.h"

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
    error_walk walk = {.text = "it is not as it should be"};
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

void fracas_h5_let_go(bool good, herr_t (*close)(hid_t id), hid_t id)
{
    if (id < 0) return;
    hid_t errors = good ? H5I_INVALID_HID : H5Eget_current_stack();
    (void)close(id);
    if (errors >= 0) (void)H5Eset_current_stack(errors);
}

/* ---- attributes ---- */

enum { MOST_TEXT = 4096 }; /* bytes of a text that a reader accepts */

/* Text of exactly `size` bytes, padded with NUL. */
static hid_t text_type(size_t size)
{
    hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && H5Tset_size(type, size) >= 0 && H5Tset_strpad(type, H5T_STR_NULLPAD) >= 0 &&
        H5Tset_cset(type, H5T_CSET_UTF8) >= 0)
        return type;
    fracas_h5_let_go(false, H5Tclose, type);
    return H5I_INVALID_HID;
}

static fracas_err put_attribute(const fracas_h5 *h5, const char *object, const char *name,
                                hid_t file_type, hid_t memory_type, const void *value)
{
    hid_t space = H5Screate(H5S_SCALAR), attribute = H5I_INVALID_HID;
    if (space >= 0)
        attribute = H5Acreate_by_name(h5->id, object, name, file_type, space, H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT);
    bool ok = attribute >= 0 && H5Awrite(attribute, memory_type, value) >= 0;
    fracas_err err = ok ? FRACAS_OK : fracas_h5_fail(h5, name);
    if (attribute >= 0) H5Aclose(attribute);
    if (space >= 0) H5Sclose(space);
    return err;
}

fracas_err fracas_h5_put_text(const fracas_h5 *h5, const char *object, const char *name,
                              const char *text)
{
    size_t length = strlen(text);
    if (length > MOST_TEXT)
        return fracas_fail(FRACAS_BUG, "%s of %s is longer than %d bytes", name, object, MOST_TEXT);
    hid_t type = text_type(length ? length : 1);
    fracas_err err = type < 0 ? fracas_h5_fail(h5, name)
                              : put_attribute(h5, object, name, type, type, text);
    if (type >= 0) H5Tclose(type);
    return err;
}

fracas_err fracas_h5_put_integer(const fracas_h5 *h5, const char *object, const char *name,
                                 hid_t file_type, uint64_t value)
{
    return put_attribute(h5, object, name, file_type, H5T_NATIVE_UINT64, &value);
}

/* Opens a scalar attribute and its type. */
static fracas_err open_attribute(const fracas_h5 *h5, const char *object, const char *name,
                                 hid_t *attribute, hid_t *type)
{
    *type = H5I_INVALID_HID;
    *attribute = H5Aopen_by_name(h5->id, object, name, H5P_DEFAULT, H5P_DEFAULT);
    hid_t space = *attribute >= 0 ? H5Aget_space(*attribute) : H5I_INVALID_HID;
    bool scalar = space >= 0 && H5Sget_simple_extent_type(space) == H5S_SCALAR;
    if (scalar) *type = H5Aget_type(*attribute);
    fracas_h5_let_go(*type >= 0, H5Sclose, space);
    return *type >= 0 ? FRACAS_OK : fracas_h5_fail(h5, name);
}

static void close_attribute(hid_t attribute, hid_t type)
{
    if (type >= 0) H5Tclose(type);
    if (attribute >= 0) H5Aclose(attribute);
}

/* Bytes of a text of fixed length, 1 to MOST_TEXT; 0 if `type` is no such text. */
static size_t text_size(hid_t type)
{
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return 0;
    size_t size = H5Tget_size(type);
    return size <= MOST_TEXT ? size : 0;
}

fracas_err fracas_h5_get_text(const fracas_h5 *h5, const char *object, const char *name,
                              char **text)
{
    hid_t attribute, type;
    *text = NULL;
    fracas_err err = open_attribute(h5, object, name, &attribute, &type);
    size_t size = err ? 0 : text_size(type);
    if (!err && size == 0) err = fracas_h5_fail(h5, name);
    if (!err && !(*text = calloc(1, size + 1))) err = fracas_no_memory("an attribute");
    if (!err && H5Aread(attribute, type, *text) < 0) err = fracas_h5_fail(h5, name);
    close_attribute(attribute, type);
    if (err) free(*text), *text = NULL;
    return err;
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
    hid_t attribute, type;
    fracas_err err = open_attribute(h5, object, name, &attribute, &type);
    if (!err &&
        (H5Tequal(type, file_type) <= 0 || H5Aread(attribute, H5T_NATIVE_UINT64, value) < 0))
        err = fracas_h5_fail(h5, name);
    close_attribute(attribute, type);
    return err;
}

/* ---- groups and columns ---- */

fracas_err fracas_h5_create_group(const fracas_h5 *h5, const char *path)
{
    hid_t creation = H5Pcreate(H5P_GROUP_CREATE), group = H5I_INVALID_HID;
    if (creation >= 0 && H5Pset_obj_track_times(creation, false) >= 0)
        group = H5Gcreate2(h5->id, path, H5P_DEFAULT, creation, H5P_DEFAULT);
    fracas_err err = group < 0 ? fracas_h5_fail(h5, path) : FRACAS_OK;
    if (group >= 0) H5Gclose(group);
    if (creation >= 0) H5Pclose(creation);
    return err;
}

fracas_err fracas_h5_text_width(const fracas_h5 *h5, const char *path, size_t *width)
{
    hid_t dataset = H5Dopen2(h5->id, path, H5P_DEFAULT), type = H5I_INVALID_HID;
    if (dataset >= 0) type = H5Dget_type(dataset);
    fracas_err err = type < 0 ? fracas_h5_fail(h5, path) : FRACAS_OK;
    *width = err ? 0 : text_size(type);
    if (type >= 0) H5Tclose(type);
    if (dataset >= 0) H5Dclose(dataset);
    return err;
}

static hid_t column_type(const fracas_store_column *column, bool in_file)
{
    switch (column->type) {
    case FRACAS_INT8: return H5Tcopy(in_file ? H5T_STD_I8LE : H5T_NATIVE_INT8);
    case FRACAS_INT32: return H5Tcopy(in_file ? H5T_STD_I32LE : H5T_NATIVE_INT32);
    case FRACAS_INT64: return H5Tcopy(in_file ? H5T_STD_I64LE : H5T_NATIVE_INT64);
    case FRACAS_FLOAT64: return H5Tcopy(in_file ? H5T_IEEE_F64LE : H5T_NATIVE_DOUBLE);
    case FRACAS_TEXT: break;
    }
    return text_type(column->width);
}

/* One dimension, or two if a row is a vector. */
static int column_rank(const fracas_store_column *column)
{
    return column->type != FRACAS_TEXT && column->width > 1 ? 2 : 1;
}

/* Shuffle is there for whoever repacks the file with compression; Fletcher32 finds flipped bytes.
 * Neither is optional: HDF5 leaves out an optional filter that finds no memory, and the file would
 * have other bytes. */
static hid_t creation_list(const fracas_store_column *column, size_t chunk)
{
    hsize_t shape[2] = {chunk, column->width};
    hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    if (list >= 0 && H5Pset_chunk(list, column_rank(column), shape) >= 0 &&
        H5Pset_filter(list, H5Z_FILTER_SHUFFLE, H5Z_FLAG_MANDATORY, 0, NULL) >= 0 &&
        H5Pset_fletcher32(list) >= 0 && H5Pset_obj_track_times(list, false) >= 0 &&
        H5Pset_fill_time(list, H5D_FILL_TIME_ALLOC) >= 0)
        return list;
    fracas_h5_let_go(false, H5Pclose, list);
    return H5I_INVALID_HID;
}

/* No chunk cache: rows are written and read by whole chunks. */
static hid_t dataset_access_list(void)
{
    hid_t list = H5Pcreate(H5P_DATASET_ACCESS);
    if (list >= 0 && H5Pset_chunk_cache(list, 1, 0, 1.0) < 0) {
        fracas_h5_let_go(false, H5Pclose, list);
        list = H5I_INVALID_HID;
    }
    return list;
}

fracas_err fracas_h5_create_column(const fracas_h5 *h5, const fracas_store_column *column,
                                   size_t chunk, hid_t *dataset)
{
    hsize_t none[2] = {0, column->width}, most[2] = {H5S_UNLIMITED, column->width};
    hid_t type = column_type(column, true); /* no call after one that failed: it would forget why */
    hid_t space = type < 0 ? H5I_INVALID_HID : H5Screate_simple(column_rank(column), none, most);
    hid_t creation = space < 0 ? H5I_INVALID_HID : creation_list(column, chunk);
    hid_t access = creation < 0 ? H5I_INVALID_HID : dataset_access_list();
    *dataset = H5I_INVALID_HID;
    if (type >= 0 && space >= 0 && creation >= 0 && access >= 0)
        *dataset = H5Dcreate2(h5->id, column->path, type, space, H5P_DEFAULT, creation, access);
    fracas_err err = *dataset < 0 ? fracas_h5_fail(h5, column->path) : FRACAS_OK;
    if (access >= 0) H5Pclose(access);
    if (creation >= 0) H5Pclose(creation);
    if (space >= 0) H5Sclose(space);
    if (type >= 0) H5Tclose(type);
    if (!err) err = fracas_h5_put_text(h5, column->path, "unit", column->unit);
    if (!err) err = fracas_h5_put_text(h5, column->path, "description", column->description);
    return err;
}

static bool right_type(hid_t dataset, const fracas_store_column *column)
{
    hid_t found = H5Dget_type(dataset),
          wanted = found < 0 ? H5I_INVALID_HID : column_type(column, true);
    bool right = found >= 0 && wanted >= 0 && H5Tequal(found, wanted) > 0;
    fracas_h5_let_go(right, H5Tclose, found);
    fracas_h5_let_go(right, H5Tclose, wanted);
    return right;
}

static bool right_shape(hid_t dataset, const fracas_store_column *column, uint64_t *rows)
{
    hid_t space = H5Dget_space(dataset);
    hsize_t shape[2] = {0, 1};
    int rank = column_rank(column);
    bool right = space >= 0 && H5Sget_simple_extent_ndims(space) == rank &&
                 H5Sget_simple_extent_dims(space, shape, NULL) == rank &&
                 (rank == 1 || shape[1] == column->width);
    fracas_h5_let_go(right, H5Sclose, space);
    *rows = shape[0];
    return right;
}

static bool right_storage(hid_t dataset, const fracas_store_column *column, size_t chunk)
{
    hsize_t shape[2] = {0, 0};
    hid_t list = H5Dget_create_plist(dataset);
    int rank = column_rank(column);
    bool right = list >= 0 && H5Pget_layout(list) == H5D_CHUNKED &&
                 H5Pget_chunk(list, 2, shape) == rank && shape[0] == chunk &&
                 (rank == 1 || shape[1] == column->width) && H5Pget_nfilters(list) == 2;
    static const H5Z_filter_t filters[2] = {H5Z_FILTER_SHUFFLE, H5Z_FILTER_FLETCHER32};
    for (unsigned f = 0; right && f < FRACAS_COUNT(filters); f++) {
        unsigned flags;
        size_t none = 0;
        right = H5Pget_filter2(list, f, &flags, &none, NULL, 0, NULL, NULL) == filters[f];
    }
    fracas_h5_let_go(right, H5Pclose, list);
    return right;
}

fracas_err fracas_h5_open_column(const fracas_h5 *h5, const fracas_store_column *column,
                                 size_t chunk, hid_t *dataset, uint64_t *rows)
{
    hid_t access = dataset_access_list();
    *dataset = access >= 0 ? H5Dopen2(h5->id, column->path, access) : H5I_INVALID_HID;
    fracas_h5_let_go(*dataset >= 0, H5Pclose, access);
    if (*dataset < 0) return fracas_h5_fail(h5, column->path);
    /* Nothing is compressed, so rows that are there take their bytes: this bounds every allocation
     * to come. */
    bool right = right_type(*dataset, column) && right_shape(*dataset, column, rows) &&
                 right_storage(*dataset, column, chunk) && *rows <= h5->bytes &&
                 *rows * fracas_stored_size(column) <= H5Dget_storage_size(*dataset) &&
                 H5Dget_storage_size(*dataset) <= h5->bytes;
    if (right) return FRACAS_OK;
    fracas_err err = fracas_h5_fail(h5, column->path);
    H5Dclose(*dataset);
    *dataset = H5I_INVALID_HID;
    return err;
}

typedef enum { READ_ROWS, WRITE_ROWS } direction;

static bool transfer(const fracas_store_column *column, hid_t dataset, uint64_t start, size_t count,
                     direction way, void *stored)
{
    int rank = column_rank(column);
    hsize_t from[2] = {start, 0}, size[2] = {count, column->width};
    hid_t type = column_type(column, false);
    hid_t memory = type < 0 ? H5I_INVALID_HID
                            : H5Screate_simple(
                                  rank, size,
                                  NULL); /* no call after one that failed: it would forget why */
    hid_t space = memory < 0 ? H5I_INVALID_HID : H5Dget_space(dataset);
    bool ok = type >= 0 && memory >= 0 && space >= 0 &&
              H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, size, NULL) >= 0;
    if (ok && way == WRITE_ROWS)
        ok = H5Dwrite(dataset, type, memory, space, H5P_DEFAULT, stored) >= 0;
    if (ok && way == READ_ROWS)
        ok = H5Dread(dataset, type, memory, space, H5P_DEFAULT, stored) >= 0;
    fracas_h5_let_go(ok, H5Sclose, space);
    fracas_h5_let_go(ok, H5Sclose, memory);
    fracas_h5_let_go(ok, H5Tclose, type);
    return ok;
}

fracas_err fracas_h5_append_rows(const fracas_h5 *h5, const fracas_store_column *column,
                                 hid_t dataset, uint64_t start, size_t count, const void *stored)
{
    hsize_t extent[2] = {start + count, column->width};
    bool ok = H5Dset_extent(dataset, extent) >= 0 &&
              transfer(column, dataset, start, count, WRITE_ROWS, (void *)(uintptr_t)stored);
    return ok && !h5->error ? FRACAS_OK : fracas_h5_fail(h5, column->path);
}

fracas_err fracas_h5_read_rows(const fracas_h5 *h5, const fracas_store_column *column,
                               hid_t dataset, uint64_t start, size_t count, void *stored)
{
    return transfer(column, dataset, start, count, READ_ROWS, stored)
               ? FRACAS_OK
               : fracas_h5_fail(h5, column->path);
}
