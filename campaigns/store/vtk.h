/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Unstructured grids for ParaView and VTK: the VTKHDF format, in double precision. A file of one
 * grid has version 1.0, one of many instants version 2.0. */
#ifndef FRACAS_CAMPAIGNS_STORE_VTK_H
#define FRACAS_CAMPAIGNS_STORE_VTK_H

#include "base/err.h"

#include "base/own.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* VTK's numbers of shapes of cells. */
enum {
    FRACAS_VTK_VERTEX = 1,
    FRACAS_VTK_LINE = 3,
    FRACAS_VTK_TRIANGLE = 5,
    FRACAS_VTK_QUADRATIC_LINE = 21,
    FRACAS_VTK_QUADRATIC_TRIANGLE = 22
};

/* VTK's shapes by the number of nodes: of elements (2, 3, 6), of interfaces (1, 2, 3). */
extern const uint8_t fracas_vtk_shapes[2][7];

/* Values of each cell, or of each point: one of the two. */
typedef struct {
    const char *name;
    const double *real;
    const int64_t *integer;
    size_t components; /* values each; 0: 1 */
    bool still;        /* the same at all instants */
} fracas_vtk_array;

typedef struct {
    size_t npoints, ncells, narrays;
    const double (*point)[3]; /* m */
    size_t corners;           /* points of a cell */
    const int64_t *corner;    /* [ncells][corners], from 0, in VTK's order */
    uint8_t shape;            /* every cell has it */
    const fracas_vtk_array *array;
    size_t npoint_arrays; /* arrays are of cells but for these */
    const fracas_vtk_array *point_array;
} fracas_vtk_grid;

/* Bytes of the values of a file, which has some kB besides; of those that are the same at all
 * instants: cells and still arrays. */
double fracas_vtk_bytes(const fracas_vtk_grid *grid);
double fracas_vtk_still_bytes(const fracas_vtk_grid *grid);

/* Writes a file, whole under another name and renamed. FRACAS_ENVIRONMENT if it cannot. */
FRACAS_MUST_USE fracas_err fracas_vtk_write(const char *path, const fracas_vtk_grid *grid);

/* True of a file of a grid whose cells have this array. */
bool fracas_vtk_has(const char *path, const char *array);

/* True of a file that begins as a series of ours. */
bool fracas_vtk_is_series(const char *path);
/* Writes FOLDER/NAME.hdf.series, which lists NAME-1.hdf, NAME-2.hdf, ... with their times [s],
 * likewise: by this ending ParaView 5.11 knows them. */
FRACAS_MUST_USE fracas_err fracas_vtk_write_series(const char *folder, const char *name,
                                                   const double *time, size_t count);

/* A file of a grid at several instants. Its cells, whose points move, are stored once. */
typedef struct fracas_vtk_film fracas_vtk_film;
/* Begins PATH under another name. `count` instants at most; path and the grid's names must outlive
 * it. Errors as fracas_vtk_write, here and below. */
FRACAS_MUST_USE fracas_err fracas_vtk_film_create(const char *path, const fracas_vtk_grid *grid,
                                                  size_t count, fracas_vtk_film **film);
/* Adds the grid as it is at `time` [s], which rises. */
FRACAS_MUST_USE fracas_err fracas_vtk_film_add(fracas_vtk_film *film, const fracas_vtk_grid *grid,
                                               double time);
/* Ends the file and gives it its name. */
FRACAS_MUST_USE fracas_err fracas_vtk_film_finish(fracas_vtk_film *film);
/* Removes a file that is not finished. NULL is allowed. */
void fracas_vtk_film_destroy(fracas_vtk_film *film);
FRACAS_OWNER(fracas_vtk_film, fracas_vtk_film_destroy)

#endif
