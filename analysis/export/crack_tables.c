/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cracks of surfaces over time, where a realization keeps its interfaces. */
#include "analysis/export/csv.h"

#include "analysis/data/cracks.h"

#include <inttypes.h>
#include <stdio.h>

#define REALIZATION                                                                            \
    {"point", FRACAS_FIELD_INDEX, "1", "number of the point, from 0"},                         \
    {                                                                                          \
        "replica", FRACAS_FIELD_INTEGER, "1", "number of the realization at its point, from 0" \
    }
static const fracas_field crack_place[] = {
    REALIZATION,
    {"number", FRACAS_FIELD_INDEX, "1", "number of the crack in its realization, from 0"},
};
static const fracas_field break_place[] = {
    REALIZATION,
    {"row", FRACAS_FIELD_INDEX, "1", "number of the break in its realization, from 0"},
};
static const fracas_fields of_crack = FRACAS_FIELDS(crack_place),
                           of_break = FRACAS_FIELDS(break_place);

/* With the mesh of the last point. */
typedef struct {
    const fracas_csv_table *table;
    fracas_results *results;
    FILE *out;
    size_t point; /* SIZE_MAX: none */
    fracas_stored_mesh mesh;
} crack_printer;

/* Chains have no mesh. */
static fracas_err read_mesh(crack_printer *to, size_t point)
{
    if (to->point == point) return FRACAS_OK;
    fracas_stored_mesh_clear(&to->mesh);
    to->mesh = (fracas_stored_mesh){0};
    to->point = point;
    size_t interfaces;
    TRY(fracas_results_mesh_interfaces(to->results, point, &interfaces));
    return interfaces > 0 ? fracas_results_mesh(to->results, point, &to->mesh) : FRACAS_OK;
}

static fracas_err print_cracks(void *context, fracas_result *result)
{
    crack_printer *to = context;
    FRACAS_CLEARED(fracas_cracks) cracks = {0};
    TRY(read_mesh(to, result->point));
    if (to->mesh.nelements == 0 || result->record.ninterface == 0) return FRACAS_OK;
    TRY(fracas_cracks_find(&to->mesh, &result->record, &cracks));
    const bool breaks = to->table == &fracas_csv_table_breaks;
    for (size_t i = 0; i < (breaks ? cracks.nbreaks : cracks.ncracks); i++) {
        fprintf(to->out, "%zu,%" PRId64 ",%zu", result->point, result->replica, i);
        if (breaks) fracas_fields_csv(&fracas_crack_break_fields, &cracks.broke[i], to->out);
        else fracas_fields_csv(&fracas_crack_fields, &cracks.crack[i], to->out);
        putc('\n', to->out);
    }
    return FRACAS_OK;
}

static fracas_err crack_rows(const fracas_csv_table *table, const fracas_analysis *analysis,
                             FILE *out)
{
    crack_printer printer = {table, analysis->results, out, SIZE_MAX, {0}};
    const fracas_err err = fracas_results_walk(
        analysis->results, FRACAS_READ_INTERFACES | FRACAS_READ_FRAGMENTS, print_cracks, &printer);
    fracas_stored_mesh_clear(&printer.mesh);
    return err;
}

const fracas_csv_table fracas_csv_table_cracks = {
    .name = "cracks",
    .doc = "A line a crack of a surface's realization: where it began, how far and fast it ran",
    .key = {"point", "replica", "number"},
    .parent = &fracas_csv_table_realizations,
    .columns = {&of_crack, &fracas_crack_fields},
    .rows = crack_rows,
};
const fracas_csv_table fracas_csv_table_breaks = {
    .name = "breaks",
    .doc = "A line an interface that broke in a surface's realization, in the order of times: the "
           "length of all cracks, the tip that it moved, and its speed",
    .key = {"point", "replica", "row"},
    .parent = &fracas_csv_table_realizations,
    .columns = {&of_break, &fracas_crack_break_fields},
    .rows = crack_rows,
};
