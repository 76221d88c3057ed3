/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: storm */
/* The operations of an element-step that `fracas bench kernels` counts with are those that the CPU
 * executes: one step of each model in each state, one instruction at a time. */
#include "bench/kernels/cases.h"
#include "bench/kernels/flops.h"
#include "tests/support/test.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <ucontext.h>

static struct {
    int64_t sums, products, quotients, roots;
} counted;

/* Before each instruction: a scalar operation on doubles is F2 [REX] 0F and its code, with AVX
 * (which the unit of the baseline has not) it begins otherwise. */
static void look(int signal, siginfo_t *info, void *context)
{
    (void)signal;
    (void)info;
    const ucontext_t *at = context;
    const uint8_t *code;
    memcpy(&code, &at->uc_mcontext.gregs[REG_RIP], sizeof code);
    if (*code++ != 0xf2) return;
    if ((*code & 0xf0) == 0x40) code++;
    if (*code++ != 0x0f) return;
    counted.sums += *code == 0x58 || *code == 0x5c;
    counted.products += *code == 0x59;
    counted.quotients += *code == 0x5e;
    counted.roots += *code == 0x51;
}

/* The trap flag: the CPU stops after every instruction. */
static void trap(bool on)
{
    uint64_t flags = __builtin_ia32_readeflags_u64();
    __builtin_ia32_writeeflags_u64(on ? flags | 0x100 : flags & ~(uint64_t)0x100);
}

static void count(const fracas_bench_case *wanted, fracas_bench_flops *flops)
{
    struct sigaction action = {.sa_sigaction = look, .sa_flags = SA_SIGINFO}, before;
    fracas_bench_body body;
    double seconds;
    OK(fracas_bench_body_init(wanted, &body));
    memset(&counted, 0, sizeof counted);
    sigaction(SIGTRAP, &action, &before);
    trap(true);
    const fracas_err err = fracas_bench_body_run(&body, 1, &seconds);
    trap(false);
    sigaction(SIGTRAP, &before, NULL);
    OK(err);
    const double elements = (double)fracas_model_elements(body.model);
    *flops = (fracas_bench_flops){
        (double)counted.sums / elements, (double)counted.products / elements,
        (double)counted.quotients / elements, (double)counted.roots / elements};
    fracas_bench_body_clear(&body);
}

/* Compilers share a few products and sums differently: 3 %, or half an operation. */
static void check(const char *model, const char *what, double counts, double table)
{
    if (fabs(counts - table) > 0.03 * table + 0.5)
        fail_msg("%s: %.1f %s an element-step, by bench/kernels/flops.c %.1f", model, counts, what,
                 table);
}

static void operations_are_those_executed(void **unused)
{
    (void)unused;
    for (int model = 0; model < FRACAS_BENCH_MODELS; model++) {
        for (int cracked = 0; cracked < 2; cracked++) {
            const fracas_bench_case wanted = {.model = model,
                                              .elements = 200,
                                              .lanes = 1,
                                              .isa = FRACAS_ISA_BASELINE,
                                              .cracked = cracked};
            const char *name = fracas_bench_model[model];
            const fracas_bench_flops *table = &fracas_bench_flops_of[model][cracked];
            fracas_bench_flops is;
            count(&wanted, &is);
            print_message("%-9s %d {%.1f, %.1f, %.1f, %.1f}\n", name, cracked, is.sums, is.products,
                          is.quotients, is.roots);
            check(name, "sums", is.sums, table->sums);
            check(name, "products", is.products, table->products);
            check(name, "quotients", is.quotients, table->quotients);
            check(name, "roots", is.roots, table->roots);
        }
    }
}

TESTS(operations_are_those_executed)
