/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A look in the text format of Prometheus 0.0.4, for the textfile collector of its node exporter.
 * Units are in the names; a number that is not known has no sample. */
#include "cli/look.h"

#include "analysis/data/output.h"
#include "base/file.h"
#include "base/param.h"
#include "base/text.h"

#include <inttypes.h>
#include <libgen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- samples ---- */

typedef struct {
    FILE *out;
    const fracas_look *look;
} metrics;

static void put_head(const metrics *m, const char *name, const char *doc)
{
    fprintf(m->out, "# HELP fracas_%s %s\n# TYPE fracas_%s gauge\n", name, doc, name);
}

/* A label's value: quote, backslash and line break are escaped, and nothing is outside UTF-8. */
static void put_label(FILE *out, const char *text)
{
    char shown[1024];
    fracas_text_show(text, shown, sizeof shown);
    for (const char *c = shown; *c; c++)
        if (*c == '\n') fputs("\\n", out);
        else if (*c == '"' || *c == '\\') fprintf(out, "\\%c", *c);
        else putc(*c, out);
}

/* Further labels, `,point="3"`, in `more`. */
static void put_sample(const metrics *m, const char *name, const char *more, double value)
{
    if (!isfinite(value)) return;
    fprintf(m->out, "fracas_%s{study=\"", name);
    put_label(m->out, m->look->study);
    fprintf(m->out, "\"%s} %.17g\n", more, value);
}

static void put_number(const metrics *m, const char *name, const char *doc, double value)
{
    put_head(m, name, doc);
    put_sample(m, name, "", value);
}

/* ---- families ---- */

static void put_states(const metrics *m)
{
    static const struct {
        const char *name;
        size_t place;
    } state[] = {
        {"planned", offsetof(fracas_index_counts, planned)},
        {"leased", offsetof(fracas_index_counts, leased)},
        {"done", offsetof(fracas_index_counts, done)},
        {"failed", offsetof(fracas_index_counts, failed)},
    };
    put_head(m, "realizations", "Realizations of a point by their state; all are their sum.");
    for (size_t p = 0; p < m->look->running.npoints; p++)
        for (size_t s = 0; s < FRACAS_COUNT(state); s++) {
            char more[96];
            const fracas_index_counts *counts = &m->look->running.point[p].counts;
            snprintf(more, sizeof more, ",point=\"%zu\",state=\"%s\"", p, state[s].name);
            put_sample(
                m, "realizations", more,
                (double)*(const int64_t *)(const void *)((const char *)counts + state[s].place));
        }
}

/* One number of each point. */
static void put_points(const metrics *m, const char *name, const char *doc, size_t place)
{
    put_head(m, name, doc);
    for (size_t p = 0; p < m->look->running.npoints; p++) {
        char more[48];
        const char *point = (const char *)&m->look->running.point[p];
        snprintf(more, sizeof more, ",point=\"%zu\"", p);
        put_sample(m, name, more, *(const double *)(const void *)(point + place));
    }
}

static void put_means(const metrics *m)
{
#define AT(member) offsetof(fracas_unfinished_point, member)
    put_points(m, "fragments_mean", "Mean number of fragments over the usable realizations.",
               AT(count.mean));
    put_points(m, "fragments_half_width", "Half width of the 95 % interval of that mean.",
               AT(count.half_width));
    put_points(m, "fragment_size_mean_meters", "Mean fragment size over the usable realizations.",
               AT(size.mean));
    put_points(m, "fragment_size_half_width_meters",
               "Half width of the 95 % interval of that mean.", AT(size.half_width));
#undef AT
}

static void put_long_ones(const metrics *m)
{
    static const char *const name[][2] = {
        {"checkpoint_simulated_seconds", "Simulated time of a realization that computes for long."},
        {"checkpoint_end_seconds", "Simulated time at which that ends at the latest."},
        {"checkpoint_age_seconds", "Age of its checkpoint."}};
    for (size_t n = 0; n < FRACAS_COUNT(name); n++) {
        put_head(m, name[n][0], name[n][1]);
        for (size_t i = 0; i < m->look->nlong; i++) {
            const fracas_long_one *one = &m->look->long_one[i];
            const double value[] = {one->head.time, one->head.end, one->age};
            char more[96];
            snprintf(more, sizeof more, ",point=\"%zu\",replica=\"%" PRId64 "\"", one->point,
                     one->head.replica);
            put_sample(m, name[n][0], more, value[n]);
        }
    }
}

static void put_all(const metrics *m)
{
    const fracas_look *look = m->look;
    put_number(m, "running", "1 while a run computes the study, else 0.",
               fracas_look_going(look) ? 1 : 0);
    put_number(m, "complete", "1 if everything is computed and merged, else 0.",
               look->complete ? 1 : 0);
    put_number(m, "look_timestamp_seconds", "Time of this look, since 1970.", (double)time(NULL));
    put_number(m, "realizations_per_second", "Realizations that the run computes in a second.",
               look->rate);
    put_number(m, "left_seconds", "Time until everything is computed, at that pace.", look->left);
    put_number(m, "segments", "Files of results so far.", (double)look->running.all.segments);
    put_number(m, "segments_bytes", "Their size.", (double)look->running.all.bytes);
    put_states(m);
    put_means(m);
    put_long_ones(m);
}

fracas_err fracas_look_write_prometheus(const fracas_look *look, const char *path)
{
    OWNED char *folder = strdup(path);
    OWNED char *name = strdup(path);
    fracas_output_file output;
    if (!folder || !name) return fracas_no_memory("the name of a file");
    if (!fracas_file_begins(path, "# HELP fracas_"))
        return fracas_fail(FRACAS_USAGE,
                           "status: --prometheus %s is there already, and no `fracas status` wrote "
                           "it: name another file, or move it away",
                           path);
    TRY(fracas_output_open(dirname(folder), basename(name), &output));
    put_all(&(metrics){output.file, look});
    return fracas_output_close(&output, FRACAS_OK);
}
