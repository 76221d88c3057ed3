/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bytes of a file that is not written yet. */
#include "campaigns/store/file/schema.h"
#include "campaigns/store/file/table.h"

#include <math.h>

/* Bytes of HDF5 for a dataset, with its unit and description, and for a chunk, with its checksum,
 * as measured on studies of all models (tests/unit/plan_sizes.sh). */
enum { DATASET = 810, CHUNK = 18 };

static double column_bytes(double rows, size_t chunk, size_t row)
{
    return DATASET + ceil(rows / (double)chunk) * (double)(chunk * row + CHUNK);
}

double fracas_file_bytes(const double rows[FRACAS_NSETS], const fracas_point_table *table)
{
    const double points = (double)table->npoints;
    double bytes = column_bytes(points, FRACAS_POINT_CHUNK, fracas_store_point_hash.width) +
                   column_bytes(points, FRACAS_POINT_CHUNK, sizeof(int64_t));
    for (size_t c = 0; c < table->ncolumns; c++) {
        const size_t row = table->column[c].text ? fracas_table_text_width(table, c)
                                                 : sizeof(double);
        bytes += column_bytes(points, FRACAS_POINT_CHUNK, row);
    }
    for (int s = 0; s < FRACAS_NSETS; s++) {
        const fracas_store_set *set = &fracas_store_sets[s];
        for (size_t c = 0; rows[s] > 0 && c < set->ncolumns; c++)
            bytes += column_bytes(rows[s], set->chunk, fracas_stored_size(&set->column[c]));
    }
    return bytes;
}

double fracas_row_bytes(fracas_set_name set)
{
    double bytes = 0;
    for (size_t c = 0; c < fracas_store_sets[set].ncolumns; c++)
        bytes += (double)fracas_stored_size(&fracas_store_sets[set].column[c]);
    return bytes;
}
