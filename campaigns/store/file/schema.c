/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/schema.h"

#include "base/param.h"
#include "campaigns/store/store.h"

#include <stdbool.h>
#include <string.h>

#define OF(member) offsetof(fracas_stored_realization, member)

/* The columns of an energy, in /realization and in /history. */
#define AT_END(key, role, unit, meaning) \
    {"/realization/" #key, FRACAS_FLOAT64, 1, unit, meaning AT_END_##role, OF(record.key)},
#define SO_FAR(key, role, unit, meaning) \
    {"/history/" #key,                   \
     FRACAS_FLOAT64,                     \
     1,                                  \
     unit,                               \
     meaning SO_FAR_##role,              \
     offsetof(fracas_history_row, key)},
#define AT_END_KINETIC " at end_time"
#define AT_END_STORED " at end_time"
#define AT_END_SINK " until end_time"
#define AT_END_PART ""
#define AT_END_SOURCE " until end_time"
#define AT_END_LOAD " until end_time"
#define SO_FAR_KINETIC ""
#define SO_FAR_STORED ""
#define SO_FAR_SINK " so far"
#define SO_FAR_PART ""
#define SO_FAR_SOURCE " so far"
#define SO_FAR_LOAD " so far"

static const fracas_store_column realization[] = {
    {"/realization/point", FRACAS_INT32, 1, "1", "row of the realization's point in /point",
     OF(point)},
    {"/realization/replica", FRACAS_INT64, 1, "1",
     "number of the strength field at the point, from 0", OF(replica)},
    {"/realization/outcome", FRACAS_INT8, 1, "1",
     "how it ended: 0 FRAGMENTED, 1 INTACT (nothing broken), 2 TIME_LIMIT (cap reached with cracks "
     "still running), 3 NONFINITE, 4 ENERGY_DRIFT, 5 FAILED (no result: values NaN, counts 0)",
     OF(record.outcome)},
    {"/realization/fragments", FRACAS_INT64, 1, "1", "fragments, dust included",
     OF(record.fragments)},
    {"/realization/fragments_dust", FRACAS_INT64, 1, "1", "of those, dust",
     OF(record.fragments_dust)},
    {"/realization/broken", FRACAS_INT64, 1, "1",
     "interfaces opened to delta_c at every Gauss point", OF(record.broken)},
    {"/realization/cracked", FRACAS_INT64, 1, "1", "interfaces past onset, broken ones included",
     OF(record.cracked)},
    {"/realization/steps", FRACAS_INT64, 1, "1", "time steps taken", OF(record.steps)},
    {"/realization/onset_time", FRACAS_FLOAT64, 1, "s",
     "time of the first onset, NaN if there was none", OF(record.onset_time)},
    {"/realization/end_time", FRACAS_FLOAT64, 1, "s", "time at which it stopped",
     OF(record.end_time)},
    {"/realization/time_step", FRACAS_FLOAT64, 1, "s", "time step", OF(record.time_step)},
    {"/realization/mass", FRACAS_FLOAT64, 1, "kg", "mass of the body", OF(record.mass)},
    FRACAS_EACH_ENERGY(AT_END){"/realization/residual", FRACAS_FLOAT64, 1, "J",
                               "largest absolute value over the run of " FRACAS_ENERGY_BALANCE,
                               OF(record.residual)},
    {"/realization/residual_end", FRACAS_FLOAT64, 1, "J", "the same sum, signed, at end_time",
     OF(record.residual_end)},
    {"/realization/momentum", FRACAS_FLOAT64, 3, "kg m/s",
     "linear momentum (x, y, z) of the motion beside an imposed rate, half a time step after "
     "end_time",
     OF(record.momentum)},
};

#define OFFSETS(name, path, rows, owners)       \
    static const fracas_store_column name[] = { \
        {path, FRACAS_INT64, 1, "1",            \
         rows " rows offset[i] to offset[i + 1] - 1; one value more than " owners, 0}}
OFFSETS(fragment_offset, "/fragment/offset", "fragments of realization i are", "realizations");

static const fracas_store_column fragment[] = {
    {"/fragment/mass", FRACAS_FLOAT64, 1, "kg", "mass", offsetof(fracas_fragment, mass)},
    {"/fragment/size", FRACAS_FLOAT64, 1, "m", "size: length in 1D, square root of the area in 2D",
     offsetof(fracas_fragment, size)},
    {"/fragment/elements", FRACAS_INT64, 1, "1", "elements", offsetof(fracas_fragment, elements)},
    {"/fragment/dust", FRACAS_INT8, 1, "1",
     "1 if of so few elements that the mesh decides its size (one in 1D, one or two in 2D), else 0",
     offsetof(fracas_fragment, dust)},
    {"/fragment/position", FRACAS_FLOAT64, 3, "m", "centre of mass (x, y, z) at end_time",
     offsetof(fracas_fragment, position)},
    {"/fragment/velocity", FRACAS_FLOAT64, 3, "m/s",
     "velocity (x, y, z) of the centre of mass, background included, half a time step after "
     "end_time",
     offsetof(fracas_fragment, velocity)},
    {"/fragment/angular_momentum", FRACAS_FLOAT64, 3, "kg m2/s",
     "angular momentum (x, y, z) about the centre of mass at end_time",
     offsetof(fracas_fragment, angular_momentum)},
    {"/fragment/spin", FRACAS_FLOAT64, 3, "rad/s",
     "angular velocity (x, y, z) of the rigid body of the same inertia with that angular momentum; "
     "0 about an axis without inertia, and in a bar",
     offsetof(fracas_fragment, spin)},
};

OFFSETS(history_offset, "/history/offset", "history of realization i is", "realizations");

static const fracas_store_column history[] = {
    {"/history/time", FRACAS_FLOAT64, 1, "s", "time of the row's step",
     offsetof(fracas_history_row, time)},
    FRACAS_EACH_ENERGY(SO_FAR){"/history/residual", FRACAS_FLOAT64, 1, "J", FRACAS_ENERGY_BALANCE,
                               offsetof(fracas_history_row, residual)},
    {"/history/fragments", FRACAS_INT64, 1, "1", "fragments, dust included",
     offsetof(fracas_history_row, fragments)},
    {"/history/broken", FRACAS_INT64, 1, "1", "broken interfaces",
     offsetof(fracas_history_row, broken)},
};

OFFSETS(interface_offset, "/interface/offset", "interfaces of realization i are", "realizations");

static const fracas_store_column interface[] = {
    {"/interface/strength", FRACAS_FLOAT64, 1, "Pa", "strength sigma_c",
     offsetof(fracas_interface_row, strength)},
    {"/interface/damage", FRACAS_FLOAT64, 1, "1", "delta_max/delta_c at end_time, 0 to 1",
     offsetof(fracas_interface_row, damage)},
    {"/interface/onset_time", FRACAS_FLOAT64, 1, "s", "time of its onset, NaN if it never cracked",
     offsetof(fracas_interface_row, onset_time)},
    {"/interface/break_time", FRACAS_FLOAT64, 1, "s", "time at which it broke, NaN if it never did",
     offsetof(fracas_interface_row, break_time)},
};

static const fracas_store_column decision[] = {
    {"/decision/point", FRACAS_INT32, 1, "1", "row of the point in /point",
     offsetof(fracas_decision, point)},
    {"/decision/round", FRACAS_INT32, 1, "1", "round of the point, from 0",
     offsetof(fracas_decision, round)},
    {"/decision/replicas", FRACAS_INT64, 1, "1",
     "replicas that the point had, 0 to this - 1, when it was decided",
     offsetof(fracas_decision, replicas)},
    {"/decision/used", FRACAS_INT64, 1, "1",
     "of those, realizations in the mean: FRAGMENTED, INTACT and TIME_LIMIT",
     offsetof(fracas_decision, used)},
    {"/decision/mean", FRACAS_FLOAT64, 1, "1",
     "mean of the quantity over them: 1, m or J by the quantity", offsetof(fracas_decision, mean)},
    {"/decision/half_width", FRACAS_FLOAT64, 1, "1",
     "half width of the t interval of the mean, in the same unit",
     offsetof(fracas_decision, half_width)},
    {"/decision/stop", FRACAS_INT8, 1, "1",
     "0 goes on to the next round, 1 precise enough, 2 at the maximum",
     offsetof(fracas_decision, stop)},
    {"/decision/quantity", FRACAS_INT8, 1, "1", "the rule: 0 mean-count, 1 mean-size, 2 dissipated",
     offsetof(fracas_decision, quantity)},
    {"/decision/minimum", FRACAS_INT64, 1, "1", "the rule: replicas of the first round",
     offsetof(fracas_decision, minimum)},
    {"/decision/maximum", FRACAS_INT64, 1, "1", "the rule: most replicas",
     offsetof(fracas_decision, maximum)},
    {"/decision/relative_half_width", FRACAS_FLOAT64, 1, "1",
     "the rule: half width asked for, as part of the mean",
     offsetof(fracas_decision, relative_half_width)},
    {"/decision/confidence", FRACAS_FLOAT64, 1, "1", "the rule: confidence of the interval",
     offsetof(fracas_decision, confidence)},
};

OFFSETS(mesh_node_offset, "/mesh/node_offset", "nodes of the mesh of point i are", "points");
OFFSETS(mesh_element_offset, "/mesh/element_offset", "elements of the mesh of point i are",
        "points");
OFFSETS(mesh_interface_offset, "/mesh/interface_offset", "interfaces of the mesh of point i are",
        "points");
OFFSETS(mesh_border_offset, "/mesh/border_offset", "borders of the mesh of point i are", "points");

static const fracas_store_column mesh_node[] = {
    {"/mesh/node_position", FRACAS_FLOAT64, 3, "m",
     "position (x, y, z) of a node before any motion", offsetof(fracas_stored_node, position)},
};

static const fracas_store_column mesh_element[] = {
    {"/mesh/element_node", FRACAS_INT32, 6, "1",
     "nodes of a triangle, numbered from 0 in the mesh of its point: three vertices, then the "
     "middles of the edges from each to the next, -1 where there are none",
     offsetof(fracas_stored_element, node)},
};

static const fracas_store_column mesh_interface[] = {
    {"/mesh/interface_element", FRACAS_INT32, 2, "1",
     "the two elements of an interface; interfaces are in the order of those of a realization in "
     "/interface",
     offsetof(fracas_stored_interface, element)},
    {"/mesh/interface_node", FRACAS_INT32, 3, "1",
     "its two ends, as the first element goes round, and its middle, -1 where it has none",
     offsetof(fracas_stored_interface, node)},
};

static const fracas_store_column mesh_border[] = {
    {"/mesh/border_element", FRACAS_INT32, 1, "1", "element of an edge that no other element has",
     offsetof(fracas_stored_border, element)},
    {"/mesh/border_node", FRACAS_INT32, 3, "1",
     "its two ends, as the element goes round, and its middle, -1 where it has none",
     offsetof(fracas_stored_border, node)},
    {"/mesh/border_tag", FRACAS_INT32, 1, "1",
     "tag of the edge, 0: none; plate: 1 smallest x, 2 largest x, 3 smallest y, 4 largest y; "
     "annulus: 1 inner, 2 outer circle",
     offsetof(fracas_stored_border, tag)},
};

/* Chunks are small enough for a segment of one realization (a chunk is never stored in part) and
 * large enough for a study of millions of fragments. They are part of the format: another size is
 * another format version. */
#define SET(columns, rows, type)                           \
    {                                                      \
        columns, FRACAS_COUNT(columns), rows, sizeof(type) \
    }
const fracas_store_set fracas_store_sets[FRACAS_NSETS] = {
    [FRACAS_SET_REALIZATION] = SET(realization, 256, fracas_stored_realization),
    [FRACAS_SET_FRAGMENT_OFFSET] = SET(fragment_offset, 256, int64_t),
    [FRACAS_SET_FRAGMENT] = SET(fragment, 1024, fracas_fragment),
    [FRACAS_SET_HISTORY_OFFSET] = SET(history_offset, 256, int64_t),
    [FRACAS_SET_HISTORY] = SET(history, 512, fracas_history_row),
    [FRACAS_SET_INTERFACE_OFFSET] = SET(interface_offset, 256, int64_t),
    [FRACAS_SET_INTERFACE] = SET(interface, 2048, fracas_interface_row),
    [FRACAS_SET_DECISION] = SET(decision, 64, fracas_decision),
    [FRACAS_SET_MESH_NODE_OFFSET] = SET(mesh_node_offset, 64, int64_t),
    [FRACAS_SET_MESH_NODE] = SET(mesh_node, 1024, fracas_stored_node),
    [FRACAS_SET_MESH_ELEMENT_OFFSET] = SET(mesh_element_offset, 64, int64_t),
    [FRACAS_SET_MESH_ELEMENT] = SET(mesh_element, 1024, fracas_stored_element),
    [FRACAS_SET_MESH_INTERFACE_OFFSET] = SET(mesh_interface_offset, 64, int64_t),
    [FRACAS_SET_MESH_INTERFACE] = SET(mesh_interface, 1024, fracas_stored_interface),
    [FRACAS_SET_MESH_BORDER_OFFSET] = SET(mesh_border_offset, 64, int64_t),
    [FRACAS_SET_MESH_BORDER] = SET(mesh_border, 256, fracas_stored_border),
};
_Static_assert(FRACAS_COUNT(realization) <= FRACAS_MAX_COLUMNS, "FRACAS_MAX_COLUMNS is too small");

#define PART(of, set, group, rows)                                                  \
    {                                                                               \
        FRACAS_SET_##set##_OFFSET, group, offsetof(of, rows), offsetof(of, n##rows) \
    }
#define MESH_PART(set, rows, number)                                                 \
    {                                                                                \
        FRACAS_SET_MESH_##set##_OFFSET, "/mesh", offsetof(fracas_stored_mesh, rows), \
            offsetof(fracas_stored_mesh, number)                                     \
    }
const fracas_ragged fracas_record_parts[FRACAS_NPARTS] = {
    PART(fracas_record, FRAGMENT, "/fragment", fragment),
    PART(fracas_record, HISTORY, "/history", history),
    PART(fracas_record, INTERFACE, "/interface", interface)};
const fracas_ragged fracas_mesh_parts[FRACAS_NMESH_PARTS] = {
    [FRACAS_MESH_NODES] = MESH_PART(NODE, node, nnodes),
    [FRACAS_MESH_ELEMENTS] = MESH_PART(ELEMENT, element, nelements),
    [FRACAS_MESH_INTERFACES] = MESH_PART(INTERFACE, interface, ninterfaces),
    [FRACAS_MESH_BORDERS] = MESH_PART(BORDER, border, nborders)};
_Static_assert(FRACAS_READ_FRAGMENTS == 1 << 0 && FRACAS_READ_HISTORY == 1 << 1 &&
                   FRACAS_READ_INTERFACES == 1 << 2,
               "parts are in the order of their bits");

const void *fracas_ragged_get(const fracas_ragged *ragged, const void *owner, size_t *count)
{
    const void *rows;
    memcpy(&rows, (const char *)owner + ragged->rows, sizeof rows);
    memcpy(count, (const char *)owner + ragged->count, sizeof *count);
    return rows;
}

void fracas_ragged_set(const fracas_ragged *ragged, void *owner, void *rows, size_t count)
{
    memcpy((char *)owner + ragged->rows, &rows, sizeof rows);
    memcpy((char *)owner + ragged->count, &count, sizeof count);
}

const fracas_store_column fracas_store_point_hash = {
    "/point/hash",
    FRACAS_TEXT,
    32,
    "",
    "hash of the point's resolved values, 32 hexadecimal digits",
    0};
const fracas_store_column fracas_store_point_replicas = {
    "/point/replicas", FRACAS_INT64, 1, "1", "replicas planned at the point", 0};

size_t fracas_stored_size(const fracas_store_column *column)
{
    static const size_t size[] = {[FRACAS_INT8] = 1,
                                  [FRACAS_INT32] = 4,
                                  [FRACAS_INT64] = 8,
                                  [FRACAS_FLOAT64] = 8,
                                  [FRACAS_TEXT] = 1};
    return column->width * size[column->type];
}

size_t fracas_rows_store(const fracas_store_column *column, const void *rows, size_t row_size,
                         size_t count, void *stored)
{
    static const uint64_t canonical_nan = 0x7ff8000000000000u;
    size_t width = column->width, misfits = 0;
    int8_t *narrow = stored;
    int32_t *middle = stored;
    for (size_t r = 0; r < count; r++) {
        const char *row = (const char *)rows + r * row_size + column->offset;
        for (size_t w = 0; w < width; w++) {
            int64_t integer;
            double real;
            memcpy(&integer, row + 8 * w, 8);
            memcpy(&real, row + 8 * w, 8);
            size_t at = r * width + w;
            switch (column->type) {
            case FRACAS_INT8:
                narrow[at] = (int8_t)integer;
                misfits += narrow[at] != integer;
                break;
            case FRACAS_INT32:
                middle[at] = (int32_t)integer;
                misfits += middle[at] != integer;
                break;
            case FRACAS_INT64: memcpy((char *)stored + 8 * at, &integer, 8); break;
            case FRACAS_FLOAT64:
                memcpy((char *)stored + 8 * at, real != real ? (const void *)&canonical_nan : &real,
                       8);
                break;
            case FRACAS_TEXT: break; /* only in /point, which has no structs */
            }
        }
    }
    return misfits;
}

void fracas_rows_load(const fracas_store_column *column, const void *stored, size_t count,
                      void *rows, size_t row_size)
{
    size_t width = column->width;
    const int8_t *narrow = stored;
    const int32_t *middle = stored;
    for (size_t r = 0; r < count; r++) {
        char *row = (char *)rows + r * row_size + column->offset;
        for (size_t w = 0; w < width; w++) {
            size_t at = r * width + w;
            int64_t integer = 0;
            switch (column->type) {
            case FRACAS_INT8: integer = narrow[at]; break;
            case FRACAS_INT32: integer = middle[at]; break;
            case FRACAS_INT64:
            case FRACAS_FLOAT64: memcpy(&integer, (const char *)stored + 8 * at, 8); break;
            case FRACAS_TEXT: continue;
            }
            memcpy(row + 8 * w, &integer, 8);
        }
    }
}

static void reference_row(FILE *out, const fracas_store_column *column, size_t chunk)
{
    static const char *const name[] = {[FRACAS_INT8] = "int8",
                                       [FRACAS_INT32] = "int32",
                                       [FRACAS_INT64] = "int64",
                                       [FRACAS_FLOAT64] = "float64"};
    bool text = column->type == FRACAS_TEXT;
    fprintf(out, "| `%s` | ", column->path);
    if (text) fprintf(out, "text%zu | (n)", column->width);
    else if (column->width > 1) fprintf(out, "%s | (n, %zu)", name[column->type], column->width);
    else fprintf(out, "%s | (n)", name[column->type]);
    fprintf(out, " | %zu | %s | %s |\n", chunk, text ? "-" : column->unit, column->description);
}

void fracas_schema_reference(FILE *out)
{
    fputs("| dataset | type | shape | chunk | unit | meaning |\n|---|---|---|---|---|---|\n", out);
    reference_row(out, &fracas_store_point_hash, FRACAS_POINT_CHUNK);
    reference_row(out, &fracas_store_point_replicas, FRACAS_POINT_CHUNK);
    for (int s = 0; s < FRACAS_NSETS; s++)
        for (size_t c = 0; c < fracas_store_sets[s].ncolumns; c++)
            reference_row(out, &fracas_store_sets[s].column[c], fracas_store_sets[s].chunk);
}
