/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stershic's algorithm: a lane's record depends on its own strengths alone, though each lane has a
 * time step of its own and opens its links one by one. */
#include "tests/support/ring.h"

#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/test.h"

enum { ELEMENTS = 200, POISONED_LINK = 17 };

typedef struct {
    const char *what;
    double zone; /* in elements */
    int driven, settled;
} ring_case;

static const ring_case cases[] = {
    {"free, zone", 3.5, 0, 0}, {"driven, zone, until settled", 2, 1, 1}, {"free", 0, 0, 0}};

static fracas_model *model_of(const ring_case *it)
{
    const double radius = 6e-3 / (2 * 3.14159265358979323846);
    fracas_spec spec = ring_stershic(ELEMENTS, 2e4, 4e-7);
    spec.geometry.radius = radius;
    spec.loading.radial = 2e4 * radius;
    spec.loading.circumferential = 20;
    spec.cohesive.refinement = 0.3;
    spec.time.safety = 0.3;
    spec.cohesive.zone = it->zone * 6e-3 / ELEMENTS;
    if (it->driven)
        spec.loading = (fracas_loading){.type = &fracas_loading_imposed_rate, .rate = 2e4};
    if (it->settled) spec.time.stop = &fracas_stop_settled;
    spec.time.quiet = 4e-8;
    spec.time.quiet_fraction = 0.02;
    fracas_model *model;
    OK(fracas_model_create(&spec, &model));
    return model;
}

typedef struct {
    size_t first, count; /* replicas first .. first + count - 1, in slots 0 .. count - 1 */
    int width;
    fracas_isa isa;
    size_t poisoned; /* slot that goes NaN in its 40th step, or SIZE_MAX */
} batch_plan;

/* A number of one lane's state. */
static double *value(const fracas_batch *batch, size_t lane, size_t element, int field)
{
    const size_t lanes = (size_t)batch->step.lanes;
    return batch->step.state + lane / lanes * lanes * ELEMENTS * RING_FIELDS_STERSHIC +
           (element * RING_FIELDS_STERSHIC + (size_t)field) * lanes + lane % lanes;
}

/* Steps in which two lanes had different time steps. */
static int64_t run(const fracas_model *model, const batch_plan *plan, fracas_record *record)
{
    const fracas_batch_options options = {
        .history = 20, .interfaces = true, .width = plan->width, .isa = plan->isa};
    OWN(fracas_batch) batch;
    OK(fracas_batch_create(model, plan->count, &options, &batch));
    for (size_t l = 0; l < plan->count; l++) {
        bar_draw(batch, l, 0.1, plan->first + l);
        fracas_record_init(&record[l]);
    }
    OK(fracas_batch_begin(batch));
    int64_t different = 0;
    for (size_t running = plan->count; running > 0;) {
        if (batch->steps == 40 && plan->poisoned < plan->count)
            *value(batch, plan->poisoned, POISONED_LINK,
                   RING_V_LEFT) = *value(batch, plan->poisoned, POISONED_LINK, RING_STRENGTH) = NAN;
        OK(fracas_batch_step(batch, record, &running));
        for (size_t l = 1; l < plan->count; l++)
            different += batch->step.next[l] != batch->step.next[0];
    }
    if (plan->poisoned < plan->count)
        assert_int_equal(record[plan->poisoned].outcome, FRACAS_NONFINITE);
    return different;
}

static void assert_same(const fracas_record *a, const fracas_record *b)
{
    /* every scalar, then every row, byte by byte; pointers apart */
    assert_memory_equal(a, b, offsetof(fracas_record, fragment));
    assert_memory_equal(a->fragment, b->fragment, a->nfragment * sizeof *a->fragment);
    assert_memory_equal(a->history, b->history, a->nhistory * sizeof *a->history);
    assert_memory_equal(a->interface, b->interface, a->ninterface * sizeof *a->interface);
}

/* All batches of one width and instruction set: none poisoned, the first, the last. */
static void compare_batches(const fracas_model *model, int width, fracas_isa isa,
                            const fracas_record *alone)
{
    fracas_record together[8];
    const size_t count = (size_t)width, poisoned[] = {SIZE_MAX, 0, count - 1};
    for (size_t p = 0; p < (width > 1 ? 3u : 1u); p++) {
        const batch_plan plan = {0, count, width, isa, poisoned[p]};
        const int64_t different = run(model, &plan, together);
        if (width > 1) assert_true(different > 50); /* or nothing is shown */
        for (size_t l = 0; l < count; l++) {
            if (l != poisoned[p]) assert_same(&alone[l], &together[l]);
            fracas_record_clear(&together[l]);
        }
    }
}

static void a_lane_is_its_run_alone(void **unused)
{
    const int widths[] = {1, 4, 8};
    for (size_t k = 0; k < FRACAS_COUNT(cases); k++) {
        OWN(fracas_model) model = model_of(&cases[k]);
        fracas_record alone[8], other[8];
        for (size_t r = 0; r < 8; r++)
            run(model, &(batch_plan){r, 1, 1, FRACAS_ISA_BASELINE, SIZE_MAX}, &alone[r]);
        print_message("[  figures ] %s: %ld, %ld, %ld fragments in %ld, %ld, %ld steps\n",
                      cases[k].what, (long)alone[0].fragments, (long)alone[1].fragments,
                      (long)alone[2].fragments, (long)alone[0].steps, (long)alone[1].steps,
                      (long)alone[2].steps);
        assert_true(alone[0].broken > 5 && alone[0].steps != alone[1].steps);
        for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++) {
            fracas_isa has;
            if (fracas_isa_choose(isa, &has)) {
                print_message("[  skipped ] this CPU lacks %s\n", fracas_isa_name[isa]);
                continue;
            }
            for (int w = 0; w < 3; w++) compare_batches(model, widths[w], isa, alone);
        }
        /* another slot: replica r in slot r - 3 */
        run(model, &(batch_plan){3, 5, 8, FRACAS_ISA_BEST, SIZE_MAX}, other);
        for (size_t l = 0; l < 5; l++) {
            assert_same(&alone[l + 3], &other[l]);
            fracas_record_clear(&other[l]);
        }
        for (size_t r = 0; r < 8; r++) fracas_record_clear(&alone[r]);
    }
}

TESTS(a_lane_is_its_run_alone)
