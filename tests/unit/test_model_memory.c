/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Told memory of a model and a lane beside the bytes of malloc. */
#include "engine/solver/batch.h"
#include "tests/support/bar.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/ring.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

#include <malloc.h>

static double taken_so_far(void)
{
    const struct mallinfo2 info = mallinfo2();
    return (double)(info.uordblks + info.hblkhd);
}

/* Arrays in all: within 1 % and the few kB of single structs for a model; a batch has its slots,
 * sums and order of visits, too: up to 15 % of eight lanes, of one lane of a linear membrane as
 * much as that lane. */
static void check(const fracas_spec *spec, double slack)
{
    OWN(fracas_model) model = NULL;
    const double before = taken_so_far();
    OK(fracas_model_create(spec, &model));
    const double made = taken_so_far() - before, said = fracas_model_bytes(model);
    print_message("%s of %zu elements: %.0f bytes, said %.0f", model->formulation->kind.name,
                  model->elements, made, said);
    assert_true(fabs(made - said) < 0.01 * said + 4096);
    for (int width = 1; width <= 8; width *= 8) {
        OWN(fracas_batch) batch = NULL;
        const double empty = taken_so_far();
        const fracas_batch_options options = {.width = width};
        OK(fracas_batch_create(model, 1, &options, &batch));
        const double lanes = taken_so_far() - empty - sizeof *batch,
                     told = width * fracas_model_lane_bytes(model);
        print_message("; %d lanes: %.0f, said %.0f", width, lanes, told);
        assert_true(lanes > told && lanes < told * (1 + slack * (width == 1 ? 7 : 1)) + 8192);
    }
    print_message("\n");
}

static void all_bodies(void **state)
{
    fracas_spec spec = bar_reference(20000, 1e5, 1e-7);
    check(&spec, 0.15);
    bar_grade(&spec, 3);
    check(&spec, 0.15);
    spec = ring_reference(20000, 1e5, 1e-7);
    check(&spec, 0.15);
    spec = body_of(0, 40);
    check(&spec, 0.15);
    spec = body_of(1, 40);
    spec.time.mass = &fracas_mass_consistent;
    check(&spec, 0.15);
    spec = shell_spec(&fracas_shape_sphere);
    spec.mesh.divisions = 12;
    check(&spec, 0.15);
    spec.time.rotary_inertia = 1;
    check(&spec, 0.15);
}

int fracas_test(void)
{
#ifdef __SANITIZE_ADDRESS__
    return 0; /* it owns malloc */
#endif
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_bodies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
