/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "bench/kernels/kernels.h"

#include "base/cpu.h"
#include "base/json.h"
#include "base/own.h"
#include "base/version.h"
#include "bench/kernels/cases.h"
#include "bench/kernels/flops.h"
#include "bench/kernels/peaks.h"
#include "bench/kernels/timing.h"

#include <math.h>
#include <string.h>

enum { SIZES = 3, UNITS_MOST = 9, NAME_MOST = 64 };
static const double repeat_time = 10e-3; /* s */

/* Elements of chains and of surfaces; the second is that of a short run. */
static const int64_t size_of[2][SIZES] = {{400, 2500, 50000}, {400, 2500, 20000}};
static const bool is_surface[FRACAS_BENCH_MODELS] = {0, 0, 0, 1, 1, 1};

/* Instruction set and lanes, in the order of speed. */
typedef struct {
    fracas_isa isa;
    int lanes;
    fracas_peaks peaks;
} bench_unit;

/* Lower quartile, median, upper quartile. */
typedef struct {
    double low, median, high;
} bench_spread;

typedef struct {
    fracas_bench_case what;
    char name[NAME_MOST];
    const bench_unit *unit;
    int64_t elements;           /* of the mesh */
    fracas_bench_traffic bytes; /* of an element */
    double read;                /* bytes a second, of reading as much memory */
    bench_spread rate;          /* element-steps a second of processor time */
    bench_spread ratio;         /* ... by the operations of the multiply-add loop beside it */
} bench_result;

typedef struct {
    const fracas_bench_options *options;
    FILE *out, *progress;
    fracas_json json;
    bench_unit unit[UNITS_MOST];
    int nunits;
    int done, cases;
} bench;

/* ---- what to run ---- */

static void find_units(bench *b)
{
    static const int lanes[] = {1, 4, 8};
    for (fracas_isa isa = 0; isa < FRACAS_NISAS; isa++) {
        fracas_isa found;
        if (fracas_isa_choose(isa, &found)) continue;
        for (size_t i = 0; i < sizeof lanes / sizeof *lanes; i++)
            if (fracas_isa_lanes(isa, lanes[i]) == lanes[i])
                b->unit[b->nunits++] = (bench_unit){.isa = isa, .lanes = lanes[i]};
    }
}

/* A short run takes the best instruction set, one lane and the most. */
static bool is_short(const bench *b, const bench_unit *unit, int size)
{
    const bench_unit *best = &b->unit[b->nunits - 1];
    return size == 1 && unit->isa == best->isa && (unit->lanes == 1 || unit == best);
}

static void name_case(const fracas_bench_case *what, char *name)
{
    snprintf(name, NAME_MOST, "%s/%lld/%s-%d/%s", fracas_bench_model[what->model],
             (long long)what->elements, fracas_isa_name[what->isa], what->lanes,
             what->cracked ? "cracked" : "uncracked");
}

/* Calls `visit` for each case of this run. */
static fracas_err each_case(bench *b, fracas_err (*visit)(bench *b, bench_result *result))
{
    for (int model = 0; model < FRACAS_BENCH_MODELS; model++)
        for (int size = 0; size < SIZES; size++)
            for (int u = 0; u < b->nunits; u++)
                for (int cracked = 0; cracked < 2; cracked++) {
                    const bench_unit *unit = &b->unit[u];
                    bench_result result = {.what = {.model = model,
                                                    .elements = size_of[is_surface[model]][size],
                                                    .lanes = unit->lanes,
                                                    .isa = unit->isa,
                                                    .cracked = cracked},
                                           .unit = unit};
                    const fracas_bench_options *options = b->options;
                    name_case(&result.what, result.name);
                    if (options->only ? strstr(result.name, options->only) != NULL
                                      : options->full || is_short(b, unit, size))
                        TRY(visit(b, &result));
                }
    return FRACAS_OK;
}

static fracas_err count_case(bench *b, bench_result *result)
{
    b->cases++;
    bench_unit *unit = &b->unit[result->unit - b->unit];
    return unit->peaks.divide > 0 ? FRACAS_OK
                                  : fracas_peaks_measure(unit->isa, unit->lanes, &unit->peaks);
}

/* ---- measuring ---- */

static bench_spread spread_of(double *value, int count)
{
    qsort(value, (size_t)count, sizeof *value, by_value);
    return (bench_spread){value[count / 4], value[count / 2], value[count - 1 - count / 4]};
}

/* Steps of a repeat. */
static fracas_err find_steps(fracas_bench_body *body, int64_t *steps)
{
    double seconds = 0;
    for (*steps = 1; seconds < repeat_time; *steps *= 2)
        TRY(fracas_bench_body_run(body, *steps, &seconds));
    *steps = (int64_t)fmax(1, (double)*steps / 2 * repeat_time / seconds);
    return FRACAS_OK;
}

static fracas_err measure(bench *b, bench_result *result)
{
    const int repeats = b->options->repeats;
    OWNED double *rate = malloc((size_t)repeats * 2 * sizeof *rate);
    if (!rate) return fracas_no_memory("a benchmark");
    FRACAS_CLEARED(fracas_bench_body) body;
    TRY(fracas_bench_body_init(&result->what, &body));
    result->elements = (int64_t)fracas_model_elements(body.model);
    result->bytes = fracas_bench_traffic_of(&body);
    TRY(fracas_peak_read(
        result->what.isa, result->what.lanes,
        (double)result->elements * (result->bytes.read * result->what.lanes + result->bytes.tables),
        &result->read));
    int64_t steps;
    TRY(find_steps(&body, &steps));
    for (int i = 0; i < repeats; i++) {
        const double peak = fracas_peak_multiply_add(result->what.isa, result->what.lanes, 2e-3);
        double seconds;
        TRY(fracas_bench_body_run(&body, steps, &seconds));
        rate[i] = (double)(steps * result->elements * result->what.lanes) / seconds;
        rate[repeats + i] = rate[i] / peak;
    }
    result->rate = spread_of(rate, repeats);
    result->ratio = spread_of(rate + repeats, repeats);
    return FRACAS_OK;
}

/* ---- output ---- */

/* Sums and products of an element-step; bytes read and written; shares of the multiply-add loop, of
 * the divider, of loads near by, and of reading as much memory as the case has. */
typedef struct {
    double flops, divisions, bytes, of_peak, of_divider, of_load, of_read;
} bench_shares;

static bench_shares shares_of(const bench_result *r)
{
    const fracas_bench_flops *flops = &fracas_bench_flops_of[r->what.model][r->what.cracked];
    const fracas_peaks *peaks = &r->unit->peaks;
    const double lanes = r->what.lanes, rate = r->rate.median, tables = r->bytes.tables / lanes;
    bench_shares s = {.flops = flops->sums + flops->products,
                      .divisions = flops->quotients + flops->roots,
                      .bytes = r->bytes.read + r->bytes.written + tables};
    s.of_peak = s.flops * rate / peaks->multiply_add;
    s.of_divider = s.divisions * rate / peaks->divide;
    s.of_load = (r->bytes.read + tables) * rate / peaks->load;
    s.of_read = (r->bytes.read + tables) * rate / r->read;
    return s;
}

static void write_spread(fracas_json *json, const char *key, const bench_spread *spread)
{
    fracas_json_object(json, key);
    fracas_json_real(json, "low", spread->low);
    fracas_json_real(json, "median", spread->median);
    fracas_json_real(json, "high", spread->high);
    fracas_json_close(json);
}

static void write_json(fracas_json *json, const bench_result *r)
{
    const bench_shares s = shares_of(r);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "name", r->name);
    fracas_json_integer(json, "elements", r->elements);
    write_spread(json, "element_steps_per_second", &r->rate);
    write_spread(json, "per_multiply_add", &r->ratio);
    fracas_json_real(json, "sums_and_products", s.flops);
    fracas_json_real(json, "quotients_and_roots", s.divisions);
    fracas_json_real(json, "bytes", s.bytes);
    fracas_json_real(json, "share_of_multiply_add", s.of_peak);
    fracas_json_real(json, "share_of_divider", s.of_divider);
    fracas_json_real(json, "share_of_load", s.of_load);
    fracas_json_real(json, "share_of_read", s.of_read);
    fracas_json_close(json);
}

static void write_line(FILE *out, const bench_result *r)
{
    const bench_shares s = shares_of(r);
    fprintf(out, "%-34s %9.3g  %9.3g to %-9.3g %6.0f %5.1f %6.0f %5.0f %% %5.0f %% %5.0f %%\n",
            r->name, r->rate.median, r->rate.low, r->rate.high, s.flops, s.divisions, s.bytes,
            100 * s.of_peak, 100 * s.of_divider, 100 * s.of_read);
    fflush(out);
}

static fracas_err run_case(bench *b, bench_result *result)
{
    if (b->progress)
        fprintf(b->progress, "\r%d of %d: %-40s\r", b->done + 1, b->cases, result->name);
    TRY(measure(b, result));
    b->done++;
    if (b->options->json) write_json(&b->json, result);
    else write_line(b->out, result);
    return FRACAS_OK;
}

static void write_machine_json(bench *b, const char *cpu)
{
    fracas_json_begin(&b->json, b->out);
    fracas_json_text(&b->json, "version", FRACAS_VERSION);
    fracas_json_text(&b->json, "cpu", cpu);
    fracas_json_integer(&b->json, "repeats", b->options->repeats);
    fracas_json_array(&b->json, "units");
    for (const bench_unit *unit = b->unit; unit < b->unit + b->nunits; unit++) {
        if (!(unit->peaks.divide > 0)) continue;
        fracas_json_object(&b->json, NULL);
        fracas_json_text(&b->json, "instruction_set", fracas_isa_name[unit->isa]);
        fracas_json_integer(&b->json, "lanes", unit->lanes);
        fracas_json_real(&b->json, "multiply_add", unit->peaks.multiply_add);
        fracas_json_real(&b->json, "divide", unit->peaks.divide);
        fracas_json_real(&b->json, "load", unit->peaks.load);
        fracas_json_array(&b->json, "read");
        for (int i = 0; i < FRACAS_PEAK_READS; i++)
            fracas_json_real(&b->json, NULL, unit->peaks.read[i]);
        fracas_json_close(&b->json);
        fracas_json_close(&b->json);
    }
    fracas_json_close(&b->json);
    fracas_json_array(&b->json, "cases");
}

static void write_machine(bench *b, const char *cpu)
{
    fprintf(b->out, "%s, by processor time\n\n%-12s %12s %10s %10s   %s\n", cpu, "unit",
            "multiply-add", "divide", "load", "read 512 KiB, 16 MiB, 128 MiB");
    for (const bench_unit *unit = b->unit; unit < b->unit + b->nunits; unit++) {
        const fracas_peaks *p = &unit->peaks;
        char name[NAME_MOST];
        if (!(p->divide > 0)) continue;
        snprintf(name, sizeof name, "%s-%d", fracas_isa_name[unit->isa], unit->lanes);
        fprintf(b->out, "%-12s %9.3g /s %7.3g /s %5.0f GB/s   %.0f, %.0f, %.0f GB/s\n", name,
                p->multiply_add, p->divide, 1e-9 * p->load, 1e-9 * p->read[0], 1e-9 * p->read[1],
                1e-9 * p->read[2]);
    }
    fprintf(b->out, "\n%-34s %9s  %-22s %6s %5s %6s %7s %7s %7s\n", "body/elements/unit/state",
            "el-steps/s", "quartiles", "flops", "div", "bytes", "of m-a", "of div", "of read");
}

fracas_err fracas_bench_kernels(const fracas_bench_options *options, FILE *out, FILE *progress)
{
    bench b = {.options = options, .out = out, .progress = progress};
    char cpu[256];
    fracas_cpu_name(cpu, sizeof cpu);
    find_units(&b);
    TRY(each_case(&b, count_case));
    if (!b.cases)
        return fracas_fail(
            FRACAS_USAGE, "no case has `%s` in its name; one is ring/2500/%s-%d/cracked",
            options->only, fracas_isa_name[b.unit[b.nunits - 1].isa], b.unit[b.nunits - 1].lanes);
    if (options->json) write_machine_json(&b, cpu);
    else write_machine(&b, cpu);
    TRY(each_case(&b, run_case));
    if (options->json) fracas_json_end(&b.json);
    if (progress) fprintf(progress, "%60s\r", "");
    return FRACAS_OK;
}
