/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/store/file/schema.h"

#include "base/param.h"
#include "campaigns/store/datafile.h"
#include "campaigns/store/decision.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* A column; its values in memory, of 8 bytes each, are a member of the row's struct. */
#define COLUMN(group, name, type, unit, meaning, row, member, since)                          \
    {                                                                                         \
        "/" group "/" #name, FRACAS_##type, sizeof(((row *)NULL)->member) / 8, unit, meaning, \
            offsetof(row, member), since                                                      \
    }
#define REALIZATION(name, type, unit, meaning) \
    COLUMN("realization", name, type, unit, meaning, fracas_stored_realization, name, 0)
#define RECORD_SINCE(since, name, type, unit, meaning) \
    COLUMN("realization", name, type, unit, meaning, fracas_stored_realization, record.name, since)
#define RECORD(name, type, unit, meaning) RECORD_SINCE(0, name, type, unit, meaning)
#define FRAGMENT_SINCE(since, name, type, unit, meaning) \
    COLUMN("fragment", name, type, unit, meaning, fracas_fragment, name, since)
#define FRAGMENT(name, type, unit, meaning) FRAGMENT_SINCE(0, name, type, unit, meaning)
#define SEMI_AXIS(number, meaning)                                                       \
    COLUMN("fragment", semi_axis_##number, FLOAT64, "m", meaning " semi-axis" ELLIPSOID, \
           fracas_fragment, semi_axis[number - 1], SHAPES)
#define AXIS(number, meaning)                                                                      \
    COLUMN("fragment", axis_##number, FLOAT64, "1",                                                \
           "direction (x, y, z) of semi_axis_" #number ", a unit vector" meaning, fracas_fragment, \
           axis[number - 1], SHAPES)
#define ELLIPSOID " of the homogeneous ellipsoid with its second moments at end_time"
#define HISTORY_SINCE(since, name, type, unit, meaning) \
    COLUMN("history", name, type, unit, meaning, fracas_history_row, name, since)
#define HISTORY(name, type, unit, meaning) HISTORY_SINCE(0, name, type, unit, meaning)
#define INTERFACE(name, type, unit, meaning) \
    COLUMN("interface", name, type, unit, meaning, fracas_interface_row, name, 0)
#define PROBE(name, type, unit, meaning) \
    COLUMN("probe", name, type, unit, meaning, fracas_probe_row, name, 0)
#define REACTION(name, type, unit, meaning) \
    COLUMN("reaction", name, type, unit, meaning, fracas_reaction_row, name, 0)
#define DECISION(name, type, stored, meaning) \
    COLUMN("decision", name, stored, "1", meaning, fracas_decision, name, 0),
#define MESH(of, name, type, unit, meaning) \
    COLUMN("mesh", of##_##name, type, unit, meaning, fracas_stored_##of, name, 0)

/* The columns of an energy, in /realization and in /history. */
#define AT_END(key, role, unit, meaning) \
    RECORD_SINCE(SINCE_##role, key, FLOAT64, unit, meaning AT_END_##role),
#define SO_FAR(key, role, unit, meaning) \
    HISTORY_SINCE(SINCE_##role, key, FLOAT64, unit, meaning SO_FAR_##role),
#define AT_END_KINETIC " at end_time"
#define AT_END_STORED " at end_time"
#define AT_END_SINK " until end_time"
#define AT_END_PART ""
#define AT_END_DAMPING " until end_time"
#define AT_END_SOURCE " until end_time"
#define AT_END_LOAD " until end_time"
#define SO_FAR_KINETIC ""
#define SO_FAR_STORED ""
#define SO_FAR_SINK " so far"
#define SO_FAR_PART ""
#define SO_FAR_DAMPING " so far"
#define SO_FAR_SOURCE " so far"
#define SO_FAR_LOAD " so far"
#define SINCE_KINETIC 0
#define SINCE_STORED 0
#define SINCE_SINK 0
#define SINCE_PART 0
#define SINCE_DAMPING SETTLED
#define SINCE_SOURCE 0
#define SINCE_LOAD 0

/* Format versions that brought columns. */
enum { SETTLED = 4, SHAPES = 5 };

static const fracas_store_column realization[] = {
    REALIZATION(point, INT32, "1", "row of the realization's point in /point"),
    REALIZATION(replica, INT64, "1", "number of the strength field at the point, from 0"),
    RECORD(outcome, INT8, "1",
           "how it ended: 0 FRAGMENTED, 1 INTACT (nothing broken), 2 TIME_LIMIT (cap reached with "
           "cracks still running), 3 NONFINITE, 4 ENERGY_DRIFT, 5 FAILED (no result: values NaN, "
           "counts 0)"),
    RECORD(fragments, INT64, "1", "fragments, dust included"),
    RECORD(fragments_dust, INT64, "1", "of those, dust"),
    RECORD_SINCE(
        SETTLED, fragments_held, INT64, "1",
        "of those, pieces on an edge that moves with the load: these never stop breaking off"),
    RECORD(broken, INT64, "1", "interfaces opened to delta_c at every Gauss point"),
    RECORD(cracked, INT64, "1", "interfaces past onset, broken ones included"),
    RECORD(steps, INT64, "1", "time steps taken"),
    RECORD(onset_time, FLOAT64, "s", "time of the first onset, NaN if there was none"),
    RECORD(end_time, FLOAT64, "s", "time at which it stopped"),
    RECORD(time_step, FLOAT64, "s", "time step"),
    RECORD(mass, FLOAT64, "kg", "mass of the body"),
    FRACAS_EACH_ENERGY(AT_END) RECORD(
        residual, FLOAT64, "J", "largest absolute value over the run of " FRACAS_ENERGY_BALANCE),
    RECORD(residual_end, FLOAT64, "J", "the same sum, signed, at end_time"),
    RECORD_SINCE(SETTLED, vibrating, FLOAT64, "J",
                 "elastic + cohesive + kinetic energy beside the rigid motion of each fragment, at "
                 "end_time"),
    RECORD_SINCE(SETTLED, transits, FLOAT64, "1",
                 "transits k of a mean fragment by a longitudinal wave since the first onset; of "
                 "fragments that are not held, as all of these"),
    RECORD_SINCE(SETTLED, growth, FLOAT64, "1",
                 "share Delta of the fragments that the last half of that time has added"),
    RECORD_SINCE(SETTLED, rest, FLOAT64, "1",
                 "breaks R still expected from the energies of the fragments; NaN of surfaces"),
    RECORD_SINCE(SETTLED, rest_variance, FLOAT64, "1", "variance of that number"),
    RECORD_SINCE(SETTLED, rest_bound, FLOAT64, "1", "breaks B that those energies can pay for"),
    RECORD(momentum, FLOAT64, "kg m/s",
           "linear momentum (x, y, z) of the motion beside an imposed rate, half a time step after "
           "end_time"),
};

#define OFFSETS(name, path, rows, owners)       \
    static const fracas_store_column name[] = { \
        {path, FRACAS_INT64, 1, "1",            \
         rows " rows offset[i] to offset[i + 1] - 1; one value more than " owners, 0}}
OFFSETS(fragment_offset, "/fragment/offset", "fragments of realization i are", "realizations");
OFFSETS(history_offset, "/history/offset", "history of realization i is", "realizations");
OFFSETS(interface_offset, "/interface/offset", "interfaces of realization i are", "realizations");
OFFSETS(probe_offset, "/probe/offset", "probes of realization i are", "realizations");
OFFSETS(reaction_offset, "/reaction/offset", "reactions of realization i are", "realizations");
OFFSETS(mesh_node_offset, "/mesh/node_offset", "nodes of the mesh of point i are", "points");
OFFSETS(mesh_element_offset, "/mesh/element_offset", "elements of the mesh of point i are",
        "points");
OFFSETS(mesh_interface_offset, "/mesh/interface_offset", "interfaces of the mesh of point i are",
        "points");
OFFSETS(mesh_border_offset, "/mesh/border_offset", "borders of the mesh of point i are", "points");

static const fracas_store_column fragment[] = {
    FRAGMENT(mass, FLOAT64, "kg", "mass"),
    FRAGMENT(size, FLOAT64, "m",
             "size: length in 1D, square root of the area in 2D, cube root of the volume in 3D"),
    FRAGMENT(elements, INT64, "1", "elements"),
    FRAGMENT(dust, INT8, "1",
             "1 if of so few elements that the mesh decides its size (one in 1D, one or two in "
             "2D), else 0"),
    FRAGMENT(position, FLOAT64, "m", "centre of mass (x, y, z) at end_time"),
    FRAGMENT(velocity, FLOAT64, "m/s",
             "velocity (x, y, z) of the centre of mass, background included, half a time step "
             "after end_time"),
    FRAGMENT(angular_momentum, FLOAT64, "kg m2/s",
             "angular momentum (x, y, z) about the centre of mass at end_time"),
    FRAGMENT(spin, FLOAT64, "rad/s",
             "angular velocity (x, y, z) of the rigid body of the same inertia with that angular "
             "momentum; 0 about an axis without inertia, and in a bar"),
    FRAGMENT_SINCE(SHAPES, volume, FLOAT64, "m3", "volume, before any motion"),
    SEMI_AXIS(1, "largest"),
    SEMI_AXIS(2, "middle"),
    SEMI_AXIS(3, "smallest"),
    AXIS(1, "; its largest component is positive"),
    AXIS(2, "; its largest component is positive"),
    AXIS(3, ", axis_1 x axis_2"),
    FRAGMENT_SINCE(SHAPES, extent, FLOAT64, "m",
                   "largest distance of two of its nodes at end_time"),
    FRAGMENT_SINCE(
        SHAPES, crack_area, FLOAT64, "m2",
        "area of its faces on broken interfaces, before any motion; of surfaces: their length "
        "times the thickness"),
};

static const fracas_store_column history[] = {
    HISTORY(time, FLOAT64, "s", "time of the row's step"),
    FRACAS_EACH_ENERGY(SO_FAR) HISTORY(residual, FLOAT64, "J", FRACAS_ENERGY_BALANCE),
    HISTORY(fragments, INT64, "1", "fragments, dust included"),
    HISTORY(broken, INT64, "1", "broken interfaces"),
};

static const fracas_store_column interface[] = {
    INTERFACE(strength, FLOAT64, "Pa", "strength sigma_c"),
    INTERFACE(damage, FLOAT64, "1", "delta_max/delta_c at end_time, 0 to 1"),
    INTERFACE(onset_time, FLOAT64, "s", "time of its onset, NaN if it never cracked"),
    INTERFACE(break_time, FLOAT64, "s", "time at which it broke, NaN if it never did"),
};

static const fracas_store_column probe[] = {
    PROBE(time, FLOAT64, "s", "time of a row of /history, of which each probe has a row"),
    PROBE(probe, INT8, "1", "number of the probe in the attribute `probes` of the file, from 0"),
    PROBE(displacement, FLOAT64, "m", "displacement (x, y, z) of its point, background included"),
    PROBE(velocity, FLOAT64, "m/s",
          "velocity (x, y, z) of its point, background included, of central difference half a time "
          "step later"),
};

static const fracas_store_column reaction[] = {
    REACTION(time, FLOAT64, "s", "time of a row of /history, of which each held edge has a row"),
    REACTION(edge, INT8, "1", "tag of the edge, as /mesh/border_tag; 0: all others"),
    REACTION(force, FLOAT64, "N", "force (x, y, z) of the edge on the body"),
};

static const fracas_store_column decision[] = {FRACAS_EACH_DECISION(DECISION)};

static const fracas_store_column mesh_node[] = {
    MESH(node, position, FLOAT64, "m", "position (x, y, z) of a node before any motion"),
};

static const fracas_store_column mesh_element[] = {
    MESH(element, node, INT32, "1",
         "nodes of a triangle, numbered from 0 in the mesh of its point: three vertices, then the "
         "middles of the edges from each to the next, -1 where there are none"),
};

static const fracas_store_column mesh_interface[] = {
    MESH(interface, element, INT32, "1",
         "the two elements of an interface; interfaces are in the order of those of a realization "
         "in /interface"),
    MESH(interface, node, INT32, "1",
         "its two ends, as the first element goes round, and its middle, -1 where it has none"),
};

static const fracas_store_column mesh_border[] = {
    MESH(border, element, INT32, "1", "element of an edge that no other element has"),
    MESH(border, node, INT32, "1",
         "its two ends, as the element goes round, and its middle, -1 where it has none"),
    MESH(border, tag, INT32, "1",
         "tag of the edge, 0: none; plate: 1 smallest x, 2 largest x, 3 smallest y, 4 largest y; "
         "annulus: 1 inner, 2 outer circle"),
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
    [FRACAS_SET_PROBE_OFFSET] = SET(probe_offset, 256, int64_t),
    [FRACAS_SET_PROBE] = SET(probe, 512, fracas_probe_row),
    [FRACAS_SET_REACTION_OFFSET] = SET(reaction_offset, 256, int64_t),
    [FRACAS_SET_REACTION] = SET(reaction, 512, fracas_reaction_row),
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
    PART(fracas_record, INTERFACE, "/interface", interface),
    PART(fracas_record, PROBE, "/probe", probe),
    PART(fracas_record, REACTION, "/reaction", reaction)};
const fracas_ragged fracas_mesh_parts[FRACAS_NMESH_PARTS] = {
    [FRACAS_MESH_NODES] = MESH_PART(NODE, node, nnodes),
    [FRACAS_MESH_ELEMENTS] = MESH_PART(ELEMENT, element, nelements),
    [FRACAS_MESH_INTERFACES] = MESH_PART(INTERFACE, interface, ninterfaces),
    [FRACAS_MESH_BORDERS] = MESH_PART(BORDER, border, nborders)};
_Static_assert(FRACAS_READ_FRAGMENTS == 1 << 0 && FRACAS_READ_HISTORY == 1 << 1 &&
                   FRACAS_READ_INTERFACES == 1 << 2 && FRACAS_READ_PROBES == 1 << 3 &&
                   FRACAS_READ_REACTIONS == 1 << 4,
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

const char *const fracas_stored_type_name[] = {[FRACAS_INT8] = "int8",
                                               [FRACAS_INT32] = "int32",
                                               [FRACAS_INT64] = "int64",
                                               [FRACAS_FLOAT64] = "float64",
                                               [FRACAS_TEXT] = "text"};

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
    static const int64_t canonical_nan = 0x7ff8000000000000;
    size_t width = column->width, misfits = 0;
    int8_t *narrow = stored;
    int32_t *middle = stored;
    int64_t *wide = stored;
    for (size_t r = 0; r < count; r++) {
        const char *row = (const char *)rows + r * row_size + column->offset;
        for (size_t w = 0; w < width; w++) {
            int64_t bits, kept;
            double real;
            const size_t at = r * width + w;
            memcpy(&bits, row + 8 * w, 8);
            memcpy(&real, row + 8 * w, 8);
            if (column->type == FRACAS_FLOAT64 && real != real) bits = canonical_nan;
            if (column->type == FRACAS_INT8) kept = narrow[at] = (int8_t)bits;
            else if (column->type == FRACAS_INT32) kept = middle[at] = (int32_t)bits;
            else kept = wide[at] = bits;
            misfits += kept != bits;
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
    const int64_t *wide = stored;
    for (size_t r = 0; r < count; r++) {
        char *row = (char *)rows + r * row_size + column->offset;
        for (size_t w = 0; w < width; w++) {
            const size_t at = r * width + w;
            const int64_t bits = column->type == FRACAS_INT8    ? narrow[at]
                                 : column->type == FRACAS_INT32 ? middle[at]
                                                                : wide[at];
            memcpy(row + 8 * w, &bits, 8);
        }
    }
}

void fracas_rows_lack(const fracas_store_column *column, size_t count, void *rows, size_t row_size)
{
    static const double nan = NAN;
    static const int64_t zero = 0;
    const void *none = column->type == FRACAS_FLOAT64 ? (const void *)&nan : &zero;
    for (size_t r = 0; r < count; r++)
        for (size_t w = 0; w < column->width; w++)
            memcpy((char *)rows + r * row_size + column->offset + 8 * w, none, 8);
}

void fracas_store_lacks(int64_t format, char *text, size_t size)
{
    static const fracas_set_name sets[] = {FRACAS_SET_REALIZATION, FRACAS_SET_FRAGMENT};
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < FRACAS_COUNT(sets); i++)
        for (size_t c = 0; c < fracas_store_sets[sets[i]].ncolumns && used < size; c++) {
            const fracas_store_column *column = &fracas_store_sets[sets[i]].column[c];
            if (column->since > format)
                used += (size_t)snprintf(text + used, size - used, "%s%s", used ? ", " : "",
                                         strrchr(column->path, '/') + 1);
        }
    if (format < 6 && used < size)
        snprintf(text + used, size - used, "%sstrength_deviation, campaign", used ? ", " : "");
}

static void reference_row(FILE *out, const fracas_store_column *column, size_t chunk)
{
    const char *type = fracas_stored_type_name[column->type];
    bool text = column->type == FRACAS_TEXT;
    fprintf(out, "| `%s` | ", column->path);
    if (text) fprintf(out, "%s%zu | (n)", type, column->width);
    else if (column->width > 1) fprintf(out, "%s | (n, %zu)", type, column->width);
    else fprintf(out, "%s | (n)", type);
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
