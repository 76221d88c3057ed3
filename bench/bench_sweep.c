/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of a sweep, alone or program beside program: element-steps (elements x lanes x steps) a
 * second of processor time, ledger included, interfaces cracked (bench/kernels/cases.h).
 *
 *   bench_sweep [--model bar|ring|stershic|linear|quadratic|shell] [--elements N] [--lanes 1|4|8]
 *               [--isa baseline|avx2|avx512|best] [--seconds S] [--broken SHARE] [--turns STEPS]
 *
 * It prints one line a case: model, elements, lanes, instruction set, cracked interfaces, median
 * and range of five blocks. Processor time makes other work on the machine count little.
 *
 * --broken starts the clock when that share of the first lane's cracks are broken, too. With
 * --turns it runs a block of that many steps for each line that it reads, and prints its rate; at
 * the end it prints a digest of all energies. So bench/compare_sweeps.py runs programs in turn. */
#include "base/hash.h"
#include "bench/bench.h"
#include "bench/kernels/cases.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Element-steps of a batch a second, of blocks that last `seconds` or have `steps` steps. */
static double rate_of(fracas_bench_body *body, int64_t steps, double seconds)
{
    double spent = 0, more;
    int64_t done = 0;
    do {
        demand(fracas_bench_body_run(body, steps, &more));
        spent += more;
        done += steps;
    } while (spent < seconds);
    return (double)done * (double)fracas_model_elements(body->model) * body->batch->step.width /
           spent;
}

/* A block for each line read. */
static void take_turns(fracas_bench_body *body, int64_t steps)
{
    puts("ready");
    fflush(stdout);
    for (int c; (c = getchar()) != EOF;) {
        if (c != '\n') continue;
        printf("%.5g\n", rate_of(body, steps, 0));
        fflush(stdout);
    }
    const fracas_step *step = &body->batch->step;
    const fracas_hash digest = fracas_hash_of(step->energy, sizeof step->energy);
    printf("%lld cracked %lld broken %s\n", (long long)step->cracked[0], (long long)step->broken[0],
           fracas_hash_hex(&digest).text);
}

static int model_of(const char *name)
{
    for (int m = 0; m < FRACAS_BENCH_MODELS; m++)
        if (strcmp(name, fracas_bench_model[m]) == 0) return m;
    fprintf(stderr, "bench_sweep: no model `%s`; there are", name);
    for (int m = 0; m < FRACAS_BENCH_MODELS; m++)
        fprintf(stderr, "%s %s", m ? "," : "", fracas_bench_model[m]);
    fputc('\n', stderr);
    exit(2);
}

int main(int argc, char **argv)
{
    fracas_bench_case wanted = {
        .elements = 2500, .lanes = 8, .isa = FRACAS_ISA_BEST, .cracked = true};
    int64_t turns = 0;
    double seconds = 1;
    static const struct option known[] = {
        {"model", 1, 0, 'm'},   {"elements", 1, 0, 'n'}, {"lanes", 1, 0, 'l'}, {"isa", 1, 0, 'i'},
        {"seconds", 1, 0, 's'}, {"broken", 1, 0, 'b'},   {"turns", 1, 0, 't'}, {0}};
    for (int o; (o = getopt_long(argc, argv, "", known, NULL)) != -1;) {
        if (o == 'm') wanted.model = model_of(optarg);
        else if (o == 'n') wanted.elements = atoll(optarg);
        else if (o == 'l') wanted.lanes = atoi(optarg);
        else if (o == 's') seconds = atof(optarg);
        else if (o == 'b') wanted.broken = atof(optarg);
        else if (o == 't') turns = atoll(optarg);
        else if (o == 'i') {
            fracas_isa isa = 0;
            while (isa < FRACAS_NISAS && strcmp(optarg, fracas_isa_name[isa]) != 0) isa++;
            if (isa == FRACAS_ISA_BEST && strcmp(optarg, "best") != 0) return 2;
            wanted.isa = isa;
        } else return 2;
    }
    fracas_bench_body body;
    demand(fracas_bench_body_init(&wanted, &body));
    double rate[5] = {0};
    if (turns) take_turns(&body, turns);
    for (int block = 0; block < 5 && !turns; block++) rate[block] = rate_of(&body, 16, seconds / 5);
    qsort(rate, 5, sizeof *rate, by_value);
    if (!turns)
        printf(
            "%-9s %zu elements %d lanes %-8s %3.0f %% cracked %.4g element-steps/s %.4g to %.4g\n",
            fracas_bench_model[wanted.model], fracas_model_elements(body.model), wanted.lanes,
            fracas_isa_name[body.batch->step.isa],
            100.0 * (double)body.batch->step.cracked[0] /
                (double)fracas_model_interfaces(body.model),
            rate[2], rate[0], rate[4]);
    fracas_bench_body_clear(&body);
    return 0;
}
