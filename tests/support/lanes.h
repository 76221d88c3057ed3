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
    assert_memory_equal(a->reaction, b->reaction, a->nreaction * sizeof *a->reaction);
    assert_memory_equal(a->probe, b->probe, a->nprobe * sizeof *a->probe);
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
    int parts;       /* of a surface, computed by a thread each */
} lane_batch;

static inline void poison_lane(fracas_batch *batch, size_t slot, size_t back)
{
    size_t stride;
    double *strength = fracas_batch_strength(batch, slot, &stride) + 17 * stride;
    *strength = *(strength - back * (size_t)batch->step.lanes) = NAN;
}

static inline fracas_batch *batch_of_plan(const fracas_model *model, const lane_kind *kind,
                                          const lane_batch *plan)
{
    fracas_batch *batch = batch_with(model, plan->count,
                                     (fracas_batch_options){.history = 20,
                                                            .interfaces = true,
                                                            .width = plan->width,
                                                            .isa = plan->isa,
                                                            .parts = plan->parts});
    for (size_t l = 0; l < plan->count; l++) {
        bar_draw(batch, l, kind->scatter, plan->first + l);
        for (size_t k = 0;
             kind->fourth > 0 && (plan->first + l) % 4 == 3 && k < strengths_of(model); k++)
            bar_set_strength(batch, l, k, kind->fourth);
    }
    OK(fracas_batch_begin(batch));
    return batch;
}

static inline void run_lanes(const fracas_model *model, const lane_kind *kind,
                             const lane_batch *plan, fracas_record *record)
{
    OWN(fracas_batch) batch = batch_of_plan(model, kind, plan);
    for (size_t l = 0; l < plan->count; l++) fracas_record_init(&record[l]);
    for (size_t running = plan->count; running > 0;) {
        if (batch->lane[0].steps == 40 && plan->poisoned < plan->count)
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

/* ---- lanes that go on in another batch ---- */

/* States of lanes, one after another. */
typedef struct {
    char *byte;
    size_t size, at;
} lane_tape;

static inline fracas_err put_on_tape(void *context, void *bytes, size_t size)
{
    lane_tape *tape = context;
    tape->byte = realloc(tape->byte, tape->size + size + 1);
    memcpy(tape->byte + tape->size, bytes, size);
    tape->size += size;
    return FRACAS_OK;
}

static inline fracas_err get_from_tape(void *context, void *bytes, size_t size)
{
    lane_tape *tape = context;
    assert_true(tape->at + size <= tape->size);
    memcpy(bytes, tape->byte + tape->at, size);
    tape->at += size;
    return FRACAS_OK;
}

/* Replicas of `from` compute for so many steps; then those of `to`, which has them all and one
 * more, go on with their states, and that one begins. */
static inline void compare_moved(const fracas_model *model, const lane_kind *kind,
                                 const lane_batch *from, const lane_batch *to, int64_t steps,
                                 const fracas_record alone[8])
{
    fracas_record record[9];
    lane_tape tape = {0};
    size_t running = from->count, last = from->first + from->count - to->first;
    for (size_t l = 0; l < to->count; l++) fracas_record_init(&record[l]);
    fracas_batch *batch = batch_of_plan(model, kind, from);
    for (int64_t s = 0; s < steps && running > 0; s++)
        OK(fracas_batch_step(batch, record + (from->first - to->first), &running));
    for (size_t l = 0; l < from->count; l++) OK(fracas_batch_save(batch, l, put_on_tape, &tape));
    fracas_batch_destroy(batch);
    batch = batch_of_plan(model, kind, to);
    for (size_t l = from->first - to->first; l < last; l++)
        OK(fracas_batch_load(batch, l, get_from_tape, &tape));
    assert_int_equal(tape.at, tape.size);
    for (running = 1; running > 0;) OK(fracas_batch_step(batch, record, &running));
    fracas_batch_destroy(batch);
    free(tape.byte);
    for (size_t l = 0; l < to->count; l++) {
        assert_same_record(&alone[to->first + l], &record[l]);
        fracas_record_clear(&record[l]);
    }
}

/* All instruction sets, widths and numbers of parts against what run_alone left, which is cleared.
 */
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
    for (int parts = 2; parts < 8; parts += parts / 2 + 1)
        compare_lanes(model, kind, (lane_batch){0, 8, 8, FRACAS_ISA_BEST, 0, parts}, alone);
    compare_lanes(model, kind, (lane_batch){4, 1, 1, FRACAS_ISA_BEST, 0, 2}, alone);
    const lane_batch one = {5, 1, 1, FRACAS_ISA_BASELINE, 1}, four = {4, 3, 4, FRACAS_ISA_BEST, 3},
                     eight = {3, 5, 8, FRACAS_ISA_BEST, 5},
                     divided = {3, 5, 8, FRACAS_ISA_BEST, 5, 3};
    const int64_t half = alone[5].steps / 2, nearly = alone[5].steps - 1;
    compare_moved(model, kind, &one, &four, half, alone);
    compare_moved(model, kind, &four, &eight, nearly, alone);
    compare_moved(model, kind, &one, &divided, half, alone);
    compare_moved(model, kind, &divided, &eight, nearly, alone);
    compare_moved(model, kind, &one, &one, 0, alone);
    for (size_t r = 0; r < 8; r++) fracas_record_clear(&alone[r]);
}

#endif
