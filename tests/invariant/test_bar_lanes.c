/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A lane's record depends on its own strengths alone: not on its slot, its neighbours, the width or
 * the instruction set. */
#include "tests/support/bar.h"
#include "tests/support/test.h"

static fracas_model *model_of(const fracas_kind *law, const fracas_kind *stop, double amplitude)
{
    double noise[601];
    fracas_spec spec = bar_reference(600, 1e5, 1.5e-7);
    if (amplitude > 0) bar_perturb(&spec, amplitude, 1, noise);
    spec.geometry.length = 6e-3;
    spec.cohesive.law = law;
    spec.time.stop = stop;
    spec.time.quiet = 1e-8;
    spec.time.quiet_fraction = 0.05;
    fracas_model *model;
    OK(fracas_model_create(&spec, &model));
    return model;
}

/* Runs `count` replicas from `first` on; replica r is in slot r - first, and slot `poisoned` (if
 * any) goes NaN. */
static void run(const fracas_model *model, uint64_t first, size_t count, int width, fracas_isa isa,
                size_t poisoned, fracas_record *record)
{
    const fracas_batch_options options = {
        .history = 20, .interfaces = true, .width = width, .isa = isa};
    OWN(fracas_batch) batch;
    OK(fracas_batch_create(model, count, &options, &batch));
    for (size_t l = 0; l < count; l++) bar_draw(batch, l, 0.05, first + l);
    for (size_t l = 0; l < count; l++) fracas_record_init(&record[l]);
    if (poisoned < count) {
        OK(fracas_batch_begin(batch));
        size_t stride;
        double *strength = fracas_batch_strength(batch, poisoned, &stride);
        strength[17 * stride] = NAN; /* trial > NaN is false: poison a velocity too (field 3 of the
                                        record, before strength) */
        strength[17 * stride - (size_t)(2 * batch->step.lanes)] = NAN;
        for (size_t running = count; running > 0;) OK(fracas_batch_step(batch, record, &running));
        assert_int_equal(record[poisoned].outcome, FRACAS_NONFINITE);
    } else {
        OK(fracas_batch_run(batch, record));
    }
}

static void assert_same(const fracas_record *a, const fracas_record *b)
{
    /* every scalar, then every row, byte by byte; pointers apart */
    assert_memory_equal(a, b, offsetof(fracas_record, fragment));
    assert_memory_equal(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment);
    assert_memory_equal(a->history, b->history, a->nhistory * sizeof *a->history);
    assert_memory_equal(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}

static void a_lane_is_its_run_alone(void **unused)
{
    const fracas_kind *laws[] = {&fracas_law_nitsche.kind, &fracas_law_rigid_link.kind},
                      *stops[] = {&fracas_stop_time, &fracas_stop_settled};
    const int widths[] = {1, 4, 8};
    for (int k = 0; k < 5; k++) { /* the last two on elements of different lengths */
        fracas_model *model = model_of(laws[k % 3 == 1], stops[k == 2], k < 3 ? 0 : 0.2);
        fracas_record alone[8], together[8];
        for (size_t r = 0; r < 8; r++)
            run(model, r, 1, 1, FRACAS_ISA_BASELINE, SIZE_MAX, &alone[r]);
        assert_int_not_equal(alone[0].fragments,
                             alone[1].fragments + alone[2].fragments); /* they are different */
        assert_true(alone[0].fragments > 5);
        for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++)
            for (int w = 0; w < 3; w++)
                for (size_t poisoned = 0; poisoned <= (size_t)widths[w];
                     poisoned += 1 + (isa == FRACAS_ISA_BASELINE) * 3) {
                    fracas_batch_options probe = {.width = widths[w], .isa = isa};
                    fracas_batch *batch;
                    if (fracas_batch_create(model, 1, &probe, &batch)) {
                        print_message("[  skipped ] this CPU lacks instruction set %d\n", (int)isa);
                        continue;
                    }
                    fracas_batch_destroy(batch);
                    size_t count = (size_t)widths[w];
                    run(model, 0, count, widths[w], isa, poisoned, together);
                    for (size_t l = 0; l < count; l++) {
                        if (l != poisoned) assert_same(&alone[l], &together[l]);
                        fracas_record_clear(&together[l]);
                    }
                }
        /* another slot: replica r in slot r - 3 */
        run(model, 3, 5, 8, FRACAS_ISA_BEST, SIZE_MAX, together);
        for (size_t l = 0; l < 5; l++) {
            assert_same(&alone[l + 3], &together[l]);
            fracas_record_clear(&together[l]);
        }
        for (size_t r = 0; r < 8; r++) fracas_record_clear(&alone[r]);
        fracas_model_destroy(model);
    }
}

TESTS(a_lane_is_its_run_alone)
