/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The tables of index.sqlite: the schema and docs/formats/study.md are made of them. */
#include "campaigns/store/index/index.h"

#include "base/param.h"
#include "campaigns/store/file/schema.h"

#include <string.h>

typedef struct {
    const char *name, *sql, *meaning; /* `sql`: type, then constraints */
} column;

static const column meta[] = {
    {"key", "TEXT PRIMARY KEY", "one of the keys below"},
    {"value", "TEXT NOT NULL", "its value"},
};

static const column point[] = {
    {"id", "INTEGER PRIMARY KEY", "number of the point in this database"},
    {"hash", "TEXT NOT NULL UNIQUE", "its hash, as in `/point/hash`"},
    {"replicas", "INTEGER NOT NULL",
     "most replicas ever planned there, or found in segments after a loss of the index"},
};

#define COLUMN(key, type, value, meaning) {#key, #type, meaning},
static const column realization[] = {
    {"point", "INTEGER NOT NULL REFERENCES point(id)", "`point.id`; primary key with `replica`"},
    {"replica", "INTEGER NOT NULL", "number of the replica, from 0"},
    {"status",
     "TEXT NOT NULL CHECK (status IN ('planned', 'leased', 'done', 'failed', 'quarantined'))",
     "`planned`, `leased` (a worker has it), `done` (its bytes are durable), `failed`, "
     "`quarantined`"},
    {"attempts", "INTEGER NOT NULL DEFAULT 0", "attempts that ended without a record"},
    {"reason", "TEXT", "why the last of them did"},
    {"segment", "INTEGER REFERENCES segment(id)", "`segment.id` of its record"},
    {"row", "INTEGER", "row of its record in `/realization` of that segment"},
    FRACAS_EACH_SUMMARY(COLUMN)};

static const column segment[] = {
    {"id", "INTEGER PRIMARY KEY", "number of the segment in this database"},
    {"name", "TEXT NOT NULL UNIQUE", "file name in `segments/`"},
    {"bytes", "INTEGER NOT NULL", "size of the file"},
    {"checksum", "TEXT NOT NULL", "XXH3 of the whole file: 64 bits, 16 hexadecimal digits"},
    {"rows", "INTEGER NOT NULL", "realizations in it"},
    {"provenance", "TEXT NOT NULL CHECK (json_valid(provenance))",
     "JSON, [below](#provenance); `{\"adopted\": true}` for a segment found without any"},
};

static const column decision[] = {
    {"point", "INTEGER NOT NULL REFERENCES point(id)", "`point.id`; primary key with `round`"},
    {"round", "INTEGER NOT NULL", "round of the point, from 0"},
    {"replicas", "INTEGER NOT NULL", "replicas that it had"},
    {"failed", "INTEGER NOT NULL", "those of them that do not count"},
    {"mean", "REAL", "mean of the quantity"},
    {"half_width", "REAL", "half width of its interval"},
    {"relative", "REAL", "half width over the absolute value of the mean"},
    {"stop", "INTEGER NOT NULL", "as in `/decision/stop`"},
    {"reason", "TEXT NOT NULL", "the same in words"},
    {"quantity", "INTEGER NOT NULL", "the rule, as in `/decision`"},
    {"minimum", "INTEGER NOT NULL", "the same"},
    {"maximum", "INTEGER NOT NULL", "the same"},
    {"relative_half_width", "REAL NOT NULL", "the same"},
    {"confidence", "REAL NOT NULL", "the same"},
};

static const column event[] = {
    {"id", "INTEGER PRIMARY KEY", "number of the event"},
    {"time", "TEXT NOT NULL", "time of day, UTC"},
    {"kind", "TEXT NOT NULL", "one of the kinds below"},
    {"text", "TEXT NOT NULL", "what happened"},
};

static const struct {
    const char *name, *key, *options; /* `key`: a primary key of several columns */
    const column *column;
    size_t ncolumns;
} tables[] = {
    {"meta", "", ", WITHOUT ROWID", meta, FRACAS_COUNT(meta)},
    {"point", "", "", point, FRACAS_COUNT(point)},
    {"segment", "", "", segment, FRACAS_COUNT(segment)},
    {"realization", ", PRIMARY KEY (point, replica)", ", WITHOUT ROWID", realization,
     FRACAS_COUNT(realization)},
    {"decision", ", PRIMARY KEY (point, round)", ", WITHOUT ROWID", decision,
     FRACAS_COUNT(decision)},
    {"event", "", "", event, FRACAS_COUNT(event)},
};

void fracas_index_print_schema(FILE *out)
{
    for (size_t t = 0; t < FRACAS_COUNT(tables); t++) {
        fprintf(out, "CREATE TABLE IF NOT EXISTS %s(", tables[t].name);
        for (size_t c = 0; c < tables[t].ncolumns; c++)
            fprintf(out, "%s%s %s", c ? ", " : "", tables[t].column[c].name,
                    tables[t].column[c].sql);
        fprintf(out, "%s) STRICT%s;", tables[t].key, tables[t].options);
    }
}

void fracas_index_print_check(FILE *out)
{
    for (size_t t = 0; t < FRACAS_COUNT(tables); t++) {
        fputs("SELECT ", out);
        for (size_t c = 0; c < tables[t].ncolumns; c++)
            fprintf(out, "%s%s", c ? ", " : "", tables[t].column[c].name);
        fprintf(out, " FROM %s LIMIT 0;", tables[t].name);
    }
}

static void print_tables(FILE *out)
{
    fputs("| table | column | type | meaning |\n|---|---|---|---|\n", out);
    for (size_t t = 0; t < FRACAS_COUNT(tables); t++)
        for (size_t c = 0; c < tables[t].ncolumns; c++) {
            const column *of = &tables[t].column[c];
            fprintf(out, "| %s | %s | %.*s | %s |\n", tables[t].name, of->name,
                    (int)strcspn(of->sql, " "), of->sql, of->meaning);
        }
}

void fracas_study_reference(FILE *out)
{
    fputs("<!-- generated: datasets -->\n", out);
    fracas_schema_reference(out);
    fputs("<!-- end of generated -->\n\n<!-- generated: index -->\n", out);
    print_tables(out);
    fputs("<!-- end of generated -->\n", out);
}
