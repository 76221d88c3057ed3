/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/vtk.h"

#include "base/file.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/file/h5.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const uint8_t fracas_vtk_shapes[2][7] = {
    {[2] = FRACAS_VTK_LINE, [3] = FRACAS_VTK_TRIANGLE, [6] = FRACAS_VTK_QUADRATIC_TRIANGLE},
    {[1] = FRACAS_VTK_VERTEX, [2] = FRACAS_VTK_LINE, [3] = FRACAS_VTK_QUADRATIC_LINE}};

#define GROUP "/VTKHDF"

/* Writes a whole dataset, of one column or more, without a time: equal grids have equal files. */
static fracas_err put(const fracas_h5 *h5, const char *path, hid_t file_type, hid_t memory_type,
                      size_t rows, size_t width, const void *values)
{
    const hsize_t shape[2] = {rows, width};
    OWN_ID space = H5Screate_simple(width > 1 ? 2 : 1, shape, NULL);
    OWN_ID creation = H5Pcreate(H5P_DATASET_CREATE);
    OWN_ID dataset = H5I_INVALID_HID;
    if (space >= 0 && creation >= 0 && H5Pset_obj_track_times(creation, false) >= 0)
        dataset = H5Dcreate(h5->id, path, file_type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
    if (dataset < 0 ||
        (rows && H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
        return fracas_h5_fail(h5, path);
    return FRACAS_OK;
}

static fracas_err put_integers(const fracas_h5 *h5, const char *path, size_t rows,
                               const int64_t *values)
{
    return put(h5, path, H5T_STD_I64LE, H5T_NATIVE_INT64, rows, 1, values);
}

static fracas_err put_attribute(const fracas_h5 *h5, const char *name, hid_t type, hid_t space,
                                const void *value)
{
    OWN_ID attribute = H5Acreate_by_name(h5->id, GROUP, name, type, space, H5P_DEFAULT, H5P_DEFAULT,
                                         H5P_DEFAULT);
    return attribute >= 0 && H5Awrite(attribute, type, value) >= 0 ? FRACAS_OK
                                                                   : fracas_h5_fail(h5, name);
}

/* VTK 9.1 reads the type as ASCII of fixed length only. */
static fracas_err put_head(const fracas_h5 *h5, int64_t major)
{
    static const char kind[] = "UnstructuredGrid";
    const int64_t version[2] = {major, 0};
    TRY(fracas_h5_create_group(h5, GROUP));
    TRY(fracas_h5_create_group(h5, GROUP "/CellData"));
    TRY(fracas_h5_create_group(h5, GROUP "/PointData"));
    OWN_ID pair = H5Screate_simple(1, &(hsize_t){2}, NULL);
    OWN_ID one = H5Screate(H5S_SCALAR);
    OWN_ID text = H5Tcopy(H5T_C_S1);
    if (pair < 0 || one < 0 || text < 0 || H5Tset_size(text, sizeof kind - 1) < 0)
        return fracas_h5_fail(h5, GROUP);
    TRY(put_attribute(h5, "Version", H5T_NATIVE_INT64, pair, version));
    return put_attribute(h5, "Type", text, one, kind);
}

static fracas_err put_cells(const fracas_h5 *h5, const fracas_vtk_grid *grid)
{
    const size_t n = grid->ncells;
    OWNED int64_t *offset = malloc((n + 1) * sizeof *offset);
    OWNED uint8_t *shape = malloc(n + 1);
    if (!offset || !shape) return fracas_no_memory("the cells of a grid");
    for (size_t c = 0; c <= n; c++) offset[c] = (int64_t)(c * grid->corners);
    memset(shape, grid->shape, n);
    TRY(put_integers(h5, GROUP "/Connectivity", n * grid->corners, grid->corner));
    TRY(put_integers(h5, GROUP "/Offsets", n + 1, offset));
    return put(h5, GROUP "/Types", H5T_STD_U8LE, H5T_NATIVE_UINT8, n, 1, shape);
}

static size_t width_of(const fracas_vtk_array *array)
{
    return array->components ? array->components : 1;
}

static fracas_err put_arrays(const fracas_h5 *h5, const char *group, size_t rows,
                             const fracas_vtk_array *array, size_t count)
{
    for (const fracas_vtk_array *a = array; a < array + count; a++) {
        char path[120];
        const size_t width = width_of(a);
        snprintf(path, sizeof path, "%s/%s", group, a->name);
        if (a->real) TRY(put(h5, path, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, rows, width, a->real));
        else TRY(put(h5, path, H5T_STD_I64LE, H5T_NATIVE_INT64, rows, width, a->integer));
    }
    return FRACAS_OK;
}

static fracas_err put_counts(const fracas_h5 *h5, const fracas_vtk_grid *grid)
{
    TRY(put_integers(h5, GROUP "/NumberOfPoints", 1, &(int64_t){(int64_t)grid->npoints}));
    TRY(put_integers(h5, GROUP "/NumberOfCells", 1, &(int64_t){(int64_t)grid->ncells}));
    return put_integers(h5, GROUP "/NumberOfConnectivityIds", 1,
                        &(int64_t){(int64_t)(grid->ncells * grid->corners)});
}

static fracas_err put_grid(const fracas_h5 *h5, const fracas_vtk_grid *grid)
{
    TRY(put_head(h5, 1));
    TRY(put_counts(h5, grid));
    TRY(put(h5, GROUP "/Points", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, grid->npoints, 3, grid->point));
    TRY(put_cells(h5, grid));
    TRY(put_arrays(h5, GROUP "/CellData", grid->ncells, grid->array, grid->narrays));
    return put_arrays(h5, GROUP "/PointData", grid->npoints, grid->point_array,
                      grid->npoint_arrays);
}

static fracas_err write_as(const char *temporary, const char *path, const fracas_vtk_grid *grid)
{
    fracas_h5 h5 = FRACAS_H5_CLOSED;
    fracas_err err = fracas_h5_create(&h5, temporary, path);
    if (!err) err = put_grid(&h5, grid);
    if (!err) err = fracas_h5_flush_close(&h5);
    fracas_h5_close(&h5);
    if (!err && rename(temporary, path) < 0) err = fracas_disk_fail("rename to", path);
    if (err) unlink(temporary);
    return err;
}

fracas_err fracas_vtk_write(const char *path, const fracas_vtk_grid *grid)
{
    OWNED char *temporary = NULL;
    TRY(fracas_disk_temporary(path, &temporary));
    return write_as(temporary, path, grid);
}

bool fracas_vtk_has(const char *path, const char *array)
{
    char name[120];
    fracas_h5 h5 = FRACAS_H5_CLOSED;
    snprintf(name, sizeof name, GROUP "/CellData/%s", array);
    const bool has = !fracas_h5_open(&h5, path) && H5Lexists(h5.id, GROUP, H5P_DEFAULT) > 0 &&
                     H5Lexists(h5.id, GROUP "/CellData", H5P_DEFAULT) > 0 &&
                     H5Lexists(h5.id, name, H5P_DEFAULT) > 0;
    fracas_h5_close(&h5);
    return has;
}

static double bytes_of(const fracas_vtk_array *array, size_t count, size_t rows, bool all)
{
    double bytes = 0;
    for (size_t a = 0; a < count; a++)
        if (all || array[a].still) bytes += 8.0 * (double)rows * (double)width_of(&array[a]);
    return bytes;
}

/* Bytes of arrays, and of cells: offsets, shapes, corners. */
static double sum_bytes(const fracas_vtk_grid *grid, bool all)
{
    return (double)grid->ncells * (8.0 + 1.0 + 8.0 * (double)grid->corners) +
           bytes_of(grid->array, grid->narrays, grid->ncells, all) +
           bytes_of(grid->point_array, grid->npoint_arrays, grid->npoints, all);
}

double fracas_vtk_bytes(const fracas_vtk_grid *grid)
{
    return 24.0 * (double)grid->npoints + sum_bytes(grid, true);
}

double fracas_vtk_still_bytes(const fracas_vtk_grid *grid)
{
    return sum_bytes(grid, false);
}

/* ---- series ---- */

static const char series_begin[] = "{\"file-series-version\": \"1.0\", \"files\": [";

bool fracas_vtk_is_series(const char *path)
{
    return fracas_file_begins(path, series_begin);
}

static fracas_err print_series(const char *path, const char *temporary, const char *name,
                               const double *time, size_t count)
{
    FILE *out = fracas_file_stream(fracas_file_create(temporary), "w");
    if (!out) return fracas_disk_fail("create", path);
    fputs(series_begin, out);
    for (size_t k = 0; k < count; k++)
        fprintf(out, "%s\n  {\"name\": \"%s-%zu.hdf\", \"time\": %.17g}", k ? "," : "", name, k + 1,
                time[k]);
    fputs("\n]}\n", out);
    bool bad = ferror(out);
    if (fclose(out)) bad = true; /* buffered output fails here */
    return bad ? fracas_disk_fail("write", path) : FRACAS_OK;
}

fracas_err fracas_vtk_write_series(const char *folder, const char *name, const double *time,
                                   size_t count)
{
    OWNED char *path = NULL;
    OWNED char *temporary = NULL;
    TRY(fracas_path(&path, "%s/%s.hdf.series", folder, name));
    TRY(fracas_disk_temporary(path, &temporary));
    fracas_err err = print_series(path, temporary, name, time, count);
    if (!err && rename(temporary, path) < 0) err = fracas_disk_fail("rename to", path);
    if (err) unlink(temporary);
    return err;
}

/* ---- films ---- */

/* An array that gets its rows instant by instant. */
typedef struct {
    const char *group, *name; /* PointData, CellData; NULL: Points */
    hid_t dataset, type;
    size_t rows, width; /* an instant's */
    bool still;
} film_array;

enum { FILM_ARRAYS = 24 };

struct fracas_vtk_film {
    fracas_h5 h5;
    const char *path;
    char *temporary;
    double *time;
    size_t count; /* instants so far */
    size_t narrays;
    film_array array[FILM_ARRAYS];
};

/* A dataset without rows that grows; a chunk is an instant's rows, or a part of 256 MB of them. */
static fracas_err film_open(fracas_vtk_film *film, film_array array)
{
    const hsize_t none[2] = {0, array.width}, most[2] = {H5S_UNLIMITED, array.width};
    const size_t pieces = array.rows * array.width * 8 / (256u << 20) + 1,
                 piece = (array.rows + pieces - 1) / pieces;
    const hsize_t chunk[2] = {piece ? piece : 1, array.width};
    const int rank = array.width > 1 ? 2 : 1;
    char path[120];
    snprintf(path, sizeof path, GROUP "%s%s/%s", array.group ? "/" : "",
             array.group ? array.group : "", array.name);
    if (film->narrays == FILM_ARRAYS)
        return fracas_fail(FRACAS_BUG, "%s: more than %d arrays", film->path, FILM_ARRAYS);
    OWN_ID space = H5Screate_simple(rank, none, most);
    OWN_ID creation = H5Pcreate(H5P_DATASET_CREATE);
    if (space >= 0 && creation >= 0 && H5Pset_chunk(creation, rank, chunk) >= 0 &&
        H5Pset_obj_track_times(creation, false) >= 0)
        array.dataset = H5Dcreate2(film->h5.id, path, array.type, space, H5P_DEFAULT, creation,
                                   H5P_DEFAULT);
    if (array.dataset < 0) return fracas_h5_fail(&film->h5, path);
    film->array[film->narrays++] = array;
    return FRACAS_OK;
}

static fracas_err film_open_all(fracas_vtk_film *film, const char *group, size_t rows,
                                const fracas_vtk_array *array, size_t count)
{
    for (const fracas_vtk_array *a = array; a < array + count; a++)
        TRY(film_open(film, (film_array){.group = group,
                                         .name = a->name,
                                         .dataset = H5I_INVALID_HID,
                                         .type = a->real ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT64,
                                         .rows = rows,
                                         .width = width_of(a),
                                         .still = a->still}));
    return FRACAS_OK;
}

static fracas_err film_append(const fracas_vtk_film *film, const film_array *array,
                              const void *values)
{
    if ((array->still && film->count > 0) || array->rows == 0) return FRACAS_OK;
    const hsize_t size[2] = {array->rows, array->width},
                  from[2] = {array->still ? 0 : film->count * array->rows, 0},
                  extent[2] = {from[0] + array->rows, array->width};
    OWN_ID memory = H5Screate_simple(array->width > 1 ? 2 : 1, size, NULL);
    if (memory < 0 || H5Dset_extent(array->dataset, extent) < 0)
        return fracas_h5_fail(&film->h5, array->name);
    OWN_ID space = H5Dget_space(array->dataset);
    const bool ok = space >= 0 &&
                    H5Sselect_hyperslab(space, H5S_SELECT_SET, from, NULL, size, NULL) >= 0 &&
                    H5Dwrite(array->dataset, array->type, memory, space, H5P_DEFAULT, values) >=
                        0 &&
                    !film->h5.error;
    return ok ? FRACAS_OK : fracas_h5_fail(&film->h5, array->name);
}

static fracas_err film_begin(fracas_vtk_film *film, const fracas_vtk_grid *grid)
{
    TRY(fracas_disk_temporary(film->path, &film->temporary));
    TRY(fracas_h5_create(&film->h5, film->temporary, film->path));
    TRY(put_head(&film->h5, 2));
    TRY(put_counts(&film->h5, grid));
    TRY(put_cells(&film->h5, grid));
    TRY(film_open(film, (film_array){.name = "Points",
                                     .dataset = H5I_INVALID_HID,
                                     .type = H5T_NATIVE_DOUBLE,
                                     .rows = grid->npoints,
                                     .width = 3}));
    TRY(film_open_all(film, "PointData", grid->npoints, grid->point_array, grid->npoint_arrays));
    return film_open_all(film, "CellData", grid->ncells, grid->array, grid->narrays);
}

fracas_err fracas_vtk_film_create(const char *path, const fracas_vtk_grid *grid, size_t count,
                                  fracas_vtk_film **out)
{
    OWN(fracas_vtk_film) film = calloc(1, sizeof *film);
    if (!film) return fracas_no_memory("a file of fields");
    film->h5 = FRACAS_H5_CLOSED;
    film->path = path;
    film->time = malloc((count + 1) * sizeof *film->time);
    if (!film->time) return fracas_no_memory("a file of fields");
    TRY(film_begin(film, grid));
    *out = film;
    film = NULL;
    return FRACAS_OK;
}

fracas_err fracas_vtk_film_add(fracas_vtk_film *film, const fracas_vtk_grid *grid, double time)
{
    const film_array *array = film->array;
    TRY(film_append(film, array++, grid->point));
    for (size_t a = 0; a < grid->npoint_arrays; a++, array++)
        TRY(film_append(film, array,
                        grid->point_array[a].real ? (const void *)grid->point_array[a].real
                                                  : grid->point_array[a].integer));
    for (size_t a = 0; a < grid->narrays; a++, array++)
        TRY(film_append(film, array,
                        grid->array[a].real ? (const void *)grid->array[a].real
                                            : grid->array[a].integer));
    film->time[film->count++] = time;
    return FRACAS_OK;
}

/* First rows of each instant, `rows` after those of the one before. */
static fracas_err put_offsets(const fracas_vtk_film *film, const char *path, size_t rows)
{
    OWNED int64_t *offset = malloc((film->count + 1) * sizeof *offset);
    if (!offset) return fracas_no_memory("a file of fields");
    for (size_t k = 0; k < film->count; k++) offset[k] = (int64_t)(k * rows);
    return put_integers(&film->h5, path, film->count, offset);
}

/* All instants share one part with its cells, so that those have the offset 0. */
static fracas_err put_steps(const fracas_vtk_film *film)
{
    const fracas_h5 *h5 = &film->h5;
    OWNED int64_t *one = malloc((film->count + 1) * sizeof *one);
    if (!one) return fracas_no_memory("a file of fields");
    for (size_t k = 0; k < film->count; k++) one[k] = 1;
    TRY(fracas_h5_create_group(h5, GROUP "/Steps"));
    TRY(fracas_h5_put_integer(h5, GROUP "/Steps", "NSteps", H5T_STD_I64LE, film->count));
    TRY(put(h5, GROUP "/Steps/Values", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, film->count, 1,
            film->time));
    TRY(put_integers(h5, GROUP "/Steps/NumberOfParts", film->count, one));
    TRY(put_offsets(film, GROUP "/Steps/PartOffsets", 0));
    TRY(put_offsets(film, GROUP "/Steps/PointOffsets", film->array[0].rows));
    TRY(put_offsets(film, GROUP "/Steps/CellOffsets", 0));
    TRY(put_offsets(film, GROUP "/Steps/ConnectivityIdOffsets", 0));
    TRY(fracas_h5_create_group(h5, GROUP "/Steps/PointDataOffsets"));
    TRY(fracas_h5_create_group(h5, GROUP "/Steps/CellDataOffsets"));
    for (const film_array *a = film->array + 1; a < film->array + film->narrays; a++) {
        char path[120];
        snprintf(path, sizeof path, GROUP "/Steps/%sOffsets/%s", a->group, a->name);
        TRY(put_offsets(film, path, a->still ? 0 : a->rows));
    }
    return FRACAS_OK;
}

static void film_close_arrays(fracas_vtk_film *film)
{
    for (size_t a = 0; a < film->narrays; a++) fracas_h5_let_go(&film->array[a].dataset);
    film->narrays = 0;
}

fracas_err fracas_vtk_film_finish(fracas_vtk_film *film)
{
    TRY(put_steps(film));
    film_close_arrays(film);
    TRY(fracas_h5_flush_close(&film->h5));
    fracas_h5_close(&film->h5);
    if (rename(film->temporary, film->path) < 0) return fracas_disk_fail("rename to", film->path);
    free(film->temporary);
    film->temporary = NULL;
    return FRACAS_OK;
}

void fracas_vtk_film_destroy(fracas_vtk_film *film)
{
    if (!film) return;
    film_close_arrays(film);
    fracas_h5_close(&film->h5);
    if (film->temporary) unlink(film->temporary);
    free(film->temporary);
    free(film->time);
    free(film);
}
