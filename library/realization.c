/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Realizations of a point and their tables, for libfracas. */
#include "library/fracas.h"

#include "campaigns/file/words.h"
#include "campaigns/plan/point_model.h"
#include "campaigns/plan/realize.h"
#include "campaigns/store/file/schema.h"

#include <inttypes.h>

/* ---- realizers ---- */

int fracas_realizer_open(const fracas_campaign *campaign, size_t point, fracas_realizer **realizer)
{
    TRY(fracas_campaign_has(campaign, point));
    OWNED fracas_realizer *made = calloc(1, sizeof *made);
    if (!made) return fracas_no_memory("a point");
    TRY(fracas_realizer_init(campaign, point, made));
    *realizer = made;
    made = NULL;
    return 0;
}

void fracas_realizer_close(fracas_realizer *realizer)
{
    if (!realizer) return;
    fracas_realizer_clear(realizer);
    free(realizer);
}

size_t fracas_realizer_elements(const fracas_realizer *realizer)
{
    return fracas_model_elements(realizer->model);
}

size_t fracas_realizer_interfaces(const fracas_realizer *realizer)
{
    return fracas_model_interfaces(realizer->model);
}

size_t fracas_realizer_strengths(const fracas_realizer *realizer)
{
    return fracas_model_strengths(realizer->model);
}

double fracas_realizer_time_step(const fracas_realizer *realizer)
{
    return fracas_model_time_step(realizer->model);
}

int fracas_realizer_positions(const fracas_realizer *realizer, double *position)
{
    const size_t n = fracas_model_strengths(realizer->model);
    OWNED double(*found)[3] = malloc((n + 1) * sizeof *found);
    if (!found) return fracas_no_memory("the interfaces of a mesh");
    fracas_model_interface_positions(realizer->model, found);
    memcpy(position, found, n * sizeof *found);
    return 0;
}

static fracas_err check_replica(int64_t replica)
{
    if (replica >= 0) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE, "replica %" PRId64 "; replicas are counted from 0", replica);
}

int fracas_realizer_draw(const fracas_realizer *realizer, int64_t replica, double *strength)
{
    TRY(check_replica(replica));
    return fracas_realizer_sample(realizer, replica, 1, strength);
}

/* ---- realizations ---- */

enum { MOST_THREADS = 1024 };

struct fracas_realization {
    fracas_stored_realization row; /* with the rows of its parts */
};

void fracas_realization_close(fracas_realization *realization)
{
    if (!realization) return;
    fracas_record_clear(&realization->row.record);
    free(realization);
}

/* At most FRACAS_LANES_MAX of them. */
static fracas_err compute(const fracas_realizer *realizer, const int64_t *replica, size_t count,
                          const double *strength, const fracas_batch_options *options,
                          fracas_realization **realization)
{
    fracas_record record[FRACAS_LANES_MAX];
    fracas_err err = FRACAS_OK;
    for (size_t l = 0; l < count; l++) fracas_record_init(&record[l]);
    for (size_t l = 0; l < count && !err; l++) {
        realization[l] = calloc(1, sizeof **realization);
        err = realization[l] ? check_replica(replica[l]) : fracas_no_memory("a realization");
    }
    if (!err) err = fracas_realize(realizer, replica, count, strength, options, record);
    for (size_t l = 0; l < count; l++) {
        if (err) fracas_record_clear(&record[l]);
        else
            realization[l]->row = (fracas_stored_realization){
                .point = (int64_t)realizer->point, .replica = replica[l], .record = record[l]};
    }
    return err;
}

int fracas_realizer_compute(const fracas_realizer *realizer, const int64_t *replica, size_t count,
                            const double *strength, int threads, fracas_realization **realization)
{
    fracas_batch_options options = fracas_campaign_batch(realizer->campaign);
    const size_t n = fracas_model_strengths(realizer->model);
    fracas_err err = FRACAS_OK;
    if (threads < 0 || threads > MOST_THREADS)
        return fracas_fail(FRACAS_USAGE, "%d threads; it must be 0 (as the campaign says) to %d",
                           threads, MOST_THREADS);
    options.parts = threads ? threads : (int)realizer->campaign->parallel.parts;
    for (size_t l = 0; l < count; l++) realization[l] = NULL;
    for (size_t done = 0, batch; done < count && !err; done += batch) {
        batch = count - done < FRACAS_LANES_MAX ? count - done : FRACAS_LANES_MAX;
        err = compute(realizer, replica + done, batch, strength ? strength + done * n : NULL,
                      &options, realization + done);
    }
    for (size_t l = 0; l < count && err; l++) {
        fracas_realization_close(realization[l]);
        realization[l] = NULL;
    }
    return err;
}

int fracas_compute_one(const fracas_campaign *campaign, size_t point, int64_t replica,
                       fracas_realization **realization)
{
    FRACAS_CLEARED(fracas_realizer) realizer = {0};
    TRY(fracas_campaign_has(campaign, point));
    TRY(fracas_realizer_init(campaign, point, &realizer));
    return fracas_realizer_compute(&realizer, &replica, 1, NULL, 0, realization);
}

/* ---- tables ---- */

static const char *const names[FRACAS_TABLES] = {
    [FRACAS_TABLE_REALIZATION] = "realization",
    [FRACAS_TABLE_FRAGMENT] = "fragment",
    [FRACAS_TABLE_HISTORY] = "history",
    [FRACAS_TABLE_INTERFACE] = "interface",
    [FRACAS_TABLE_PROBE] = "probe",
    [FRACAS_TABLE_REACTION] = "reaction",
};

static bool is_table(int table)
{
    return table >= 0 && table < FRACAS_TABLES;
}

/* The columns of a table of ours: those of the store. */
static const fracas_store_set *set_of(int table)
{
    return &fracas_store_sets[table == FRACAS_TABLE_REALIZATION
                                  ? FRACAS_SET_REALIZATION
                                  : fracas_record_parts[table - 1].offsets + 1];
}

const char *fracas_table_name(int table)
{
    return is_table(table) ? names[table] : NULL;
}

size_t fracas_table_columns(int table)
{
    return is_table(table) ? set_of(table)->ncolumns : 0;
}

static fracas_err find_column(int table, size_t i, const fracas_store_column **column)
{
    if (!is_table(table))
        return fracas_fail(FRACAS_USAGE, "there is no table %d; they are 0 to %d", table,
                           FRACAS_TABLES - 1);
    if (i >= set_of(table)->ncolumns)
        return fracas_fail(FRACAS_USAGE, "table %s has no column %zu; it has %zu, from 0 on",
                           names[table], i, set_of(table)->ncolumns);
    *column = &set_of(table)->column[i];
    return FRACAS_OK;
}

static const char *short_name(const fracas_store_column *column)
{
    return strrchr(column->path, '/') + 1;
}

int fracas_table_column_at(int table, size_t i, fracas_table_column *column)
{
    const fracas_store_column *of;
    TRY(find_column(table, i, &of));
    *column = (fracas_table_column){.name = short_name(of),
                                    .type = fracas_stored_type_name[of->type],
                                    .unit = of->unit,
                                    .meaning = of->description,
                                    .width = of->width,
                                    .bytes = fracas_stored_size(of)};
    return 0;
}

int fracas_table_find(int table, const char *name, size_t *i)
{
    const fracas_store_column *column;
    fracas_words words;
    TRY(find_column(table, 0, &column));
    fracas_words_init(&words, name);
    for (size_t c = 0; c < set_of(table)->ncolumns; c++) {
        const char *known = short_name(&set_of(table)->column[c]);
        if (!strcmp(known, name)) {
            *i = c;
            return 0;
        }
        fracas_words_add(&words, known);
    }
    return fracas_fail(FRACAS_USAGE, "table %s has no column `%s`%s", names[table], name,
                       fracas_words_hint(&words, "it has"));
}

/* ---- values ---- */

/* The rows of a table in memory, and their number. */
static const void *rows_of(const fracas_realization *realization, int table, size_t *count)
{
    *count = 1;
    if (table == FRACAS_TABLE_REALIZATION) return &realization->row;
    return fracas_ragged_get(&fracas_record_parts[table - 1], &realization->row.record, count);
}

size_t fracas_realization_rows(const fracas_realization *realization, int table)
{
    size_t count = 0;
    if (is_table(table)) rows_of(realization, table, &count);
    return count;
}

int fracas_realization_get(const fracas_realization *realization, int table, size_t i, void *values,
                           size_t size)
{
    const fracas_store_column *column;
    size_t count;
    TRY(find_column(table, i, &column));
    const void *rows = rows_of(realization, table, &count);
    const size_t needed = count * fracas_stored_size(column);
    if (size != needed)
        return fracas_fail(FRACAS_USAGE, "%s of this realization needs %zu bytes, not %zu",
                           column->path, needed, size);
    if (fracas_rows_store(column, rows, set_of(table)->row_size, count, values))
        return fracas_fail(FRACAS_BUG, "%s has values too large for its type", column->path);
    return 0;
}

int fracas_realization_number(const fracas_realization *realization, const char *name,
                              double *number)
{
    size_t i;
    int64_t integer;
    TRY(fracas_table_find(FRACAS_TABLE_REALIZATION, name, &i));
    const fracas_store_column *column = &set_of(FRACAS_TABLE_REALIZATION)->column[i];
    if (column->width > 1)
        return fracas_fail(FRACAS_USAGE,
                           "`%s` has %zu values, not one; take it by fracas_realization_get", name,
                           column->width);
    const char *value = (const char *)&realization->row + column->offset;
    if (column->type == FRACAS_FLOAT64) {
        memcpy(number, value, sizeof *number);
        return 0;
    }
    memcpy(&integer, value, sizeof integer);
    *number = (double)integer;
    return 0;
}
