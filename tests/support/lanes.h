/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A lane's record depends on its own strengths alone: not on its slot, its neighbours, the width or
 * the instruction set. */
#ifndef FRACAS_TESTS_SUPPORT_LANES_H
#define FRACAS_TESTS_SUPPORT_LANES_H

#include "tests/support/batch.h"

/* Every scalar, then every row, byte by byte; pointers apart. */
static inline void assert_same_record(const fracas_record *a, const fracas_record *b)
{
    assert_memory_equal(a, b, offsetof(fracas_record, fragment));
    assert_memory_equal(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment);
    assert_memory_equal(a->history, b->history, a->nhistory * sizeof *a->history);
    assert_memory_equal(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}

/* Differences of replicas, and the slot going NaN. */
typedef struct {
    double scatter; /* strengths of 300 MPa (1 +- scatter) ... */
    double fourth;  /* ... but for every fourth replica, which has this [Pa]; 0: none */
    size_t back;    /* from an element's strength to its velocity; 0: no lane is poisoned */
} lane_kind;

/* Replicas first .. first + count - 1, in slots 0 .. count - 1. */
typedef struct {
    uint64_t first;
    size_t count;
    int width;
    fracas_isa isa;
    size_t poisoned; /* slot going NaN in its 40th step, if there is one of this number */
} lane_batch;

static inline void poison_lane(fracas_batch *batch, size_t slot, size_t back)
{
    size_t stride;
    double *strength = fracas_batch_strength(batch, slot, &stride) + 17 * stride;
    *strength = *(strength - back * (size_t)batch->step.lanes) = NAN;
}

static inline void run_lanes(const fracas_model *model, const lane_kind *kind,
                             const lane_batch *plan, fracas_record *record)
{
    OWN(fracas_batch) batch = batch_with(
        model, plan->count,
        (fracas_batch_options){
            .history = 20, .interfaces = true, .width = plan->width, .isa = plan->isa});
    for (size_t l = 0; l < plan->count; l++) {
        bar_draw(batch, l, kind->scatter, plan->first + l);
        for (size_t k = 0;
             kind->fourth > 0 && (plan->first + l) % 4 == 3 && k < strengths_of(model); k++)
            bar_set_strength(batch, l, k, kind->fourth);
        fracas_record_init(&record[l]);
    }
    OK(fracas_batch_begin(batch));
    for (size_t running = plan->count; running > 0;) {
        if (batch->steps == 40 && plan->poisoned < plan->count)
            poison_lane(batch, plan->poisoned, kind->back);
        OK(fracas_batch_step(batch, record, &running));
    }
    if (plan->poisoned < plan->count)
        assert_int_equal(record[plan->poisoned].outcome, FRACAS_NONFINITE);
}

/* Replicas 0 to 7 alone, each in the simplest kernel. */
static inline void run_alone(const fracas_model *model, const lane_kind *kind,
                             fracas_record alone[8])
{
    for (size_t r = 0; r < 8; r++)
        run_lanes(model, kind, &(lane_batch){r, 1, 1, FRACAS_ISA_BASELINE, 1}, &alone[r]);
}

/* None poisoned, the first slot, one in the middle, the last. */
static inline void compare_lanes(const fracas_model *model, const lane_kind *kind, lane_batch plan,
                                 const fracas_record alone[8])
{
    fracas_record together[8];
    const size_t count = plan.count, slots[] = {count, 0, count / 2, count - 1};
    for (size_t p = 0; p < (kind->back ? FRACAS_COUNT(slots) : 1); p++) {
        plan.poisoned = slots[p];
        run_lanes(model, kind, &plan, together);
        for (size_t l = 0; l < count; l++) {
            if (l != plan.poisoned) assert_same_record(&alone[plan.first + l], &together[l]);
            fracas_record_clear(&together[l]);
        }
    }
}

/* All instruction sets and widths against what run_alone left, which is cleared. */
static inline void check_lanes(const fracas_model *model, const lane_kind *kind,
                               fracas_record alone[8])
{
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++) {
        fracas_isa had;
        if (fracas_isa_choose(isa, &had)) {
            print_message("[  skipped ] this CPU has no %s\n", fracas_isa_name[isa]);
            continue;
        }
        compare_lanes(model, kind, (lane_batch){6, 1, 1, isa, 0}, alone);
        compare_lanes(model, kind, (lane_batch){2, 4, 4, isa, 0}, alone);
        compare_lanes(model, kind, (lane_batch){0, 8, 8, isa, 0}, alone);
    }
    /* another place, and lanes repeating the first */
    compare_lanes(model, kind, (lane_batch){3, 5, 8, FRACAS_ISA_BEST, 0}, alone);
    for (size_t r = 0; r < 8; r++) fracas_record_clear(&alone[r]);
}

#endif
