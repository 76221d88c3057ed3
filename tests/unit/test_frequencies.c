/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frequencies kept from one model to the next change no model, whichever parameter changes between
 * them, and go to another process to the last bit. */
#include "engine/integrator/frequencies.h"

#include "engine/mesh/body.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

#include <float.h>

typedef struct {
    int made, refused;
} tally;

/* A model with the kept pairs has the time steps of one without. */
static void compare(const fracas_spec *spec, fracas_frequencies *kept, tally *count)
{
    OWN(fracas_model) alone = NULL;
    OWN(fracas_model) model = NULL;
    fracas_spec with = *spec;
    with.frequencies = kept;
    if (fracas_model_create(spec, &alone)) {
        FAILS(fracas_model_create(&with, &model), FRACAS_USAGE, "");
        count->refused++;
        return;
    }
    OK(fracas_model_create(&with, &model));
    assert_true(model->critical_closed == alone->critical_closed);
    assert_true(model->critical_cracked == alone->critical_cracked);
    assert_true(model->time_step == alone->time_step);
    assert_null(model->spec.frequencies);
    count->made++;
}

/* Other values: a seventh more, the next number, every choice. */
static void vary_param(const fracas_spec *base, size_t section, const fracas_param *param,
                       fracas_frequencies *kept, tally *count)
{
    fracas_spec spec = *base;
    void *at = (char *)&spec + fracas_engine_sections[section]->offset;
    const double before = fracas_param_get(param, at);
    if (param->type == FRACAS_ATTACHMENT) return;
    if (param->type != FRACAS_CHOICE) {
        fracas_param_set(param, at, param->type == FRACAS_REAL ? before * 8 / 7 : before + 1);
        compare(&spec, kept, count);
        return;
    }
    for (size_t c = 0; c < param->nchoices; c++) {
        fracas_param_set(param, at, (double)c);
        compare(&spec, kept, count);
    }
}

static void vary(const fracas_spec *base, tally *count)
{
    OWN(fracas_frequencies) kept = NULL;
    OK(fracas_frequencies_create(&kept));
    compare(base, kept, count);
    for (size_t s = 1; s < fracas_engine_nsections; s++) {
        const fracas_section *section = fracas_engine_sections[s];
        for (size_t p = 0; p < section->nparams; p++)
            vary_param(base, s, &section->params[p], kept, count);
        if (!section->selector) continue;
        const fracas_kind *kind = *(const fracas_kind *const *)((const char *)base +
                                                                section->offset +
                                                                section->kind_offset);
        for (size_t p = 0; kind && p < kind->nparams; p++) /* a second loading is none */
            vary_param(base, s, &kind->params[p], kept, count);
        for (size_t k = 0; k < section->nkinds; k++) { /* with the same parameters */
            fracas_spec spec = *base;
            *(const fracas_kind **)((char *)&spec + section->offset +
                                    section->kind_offset) = section->kinds[k];
            if (section != &fracas_geometry_section) compare(&spec, kept, count);
        }
    }
}

static void whatever_changes(void **state)
{
    tally count = {0};
    for (int which = 0; which < BODIES; which += CASE_STRIDE) {
        const fracas_spec spec = body_of(which, 3);
        vary(&spec, &count);
    }
    fracas_spec shell = shell_spec(&fracas_shape_sphere);
    shell.mesh.divisions = 3;
    vary(&shell, &count);
    shell.geometry.part = &fracas_part_octant;
    vary(&shell, &count);
    assert_true(count.made > 200 && count.refused < count.made / 2);
}

/* A second model takes its pair from the first, which another process may have told. */
static void another_process(void **state)
{
    OWN(fracas_frequencies) first = NULL;
    OWN(fracas_frequencies) second = NULL;
    OWN(fracas_model) computed = NULL;
    OWN(fracas_model) told = NULL;
    OK(fracas_frequencies_create(&first));
    OK(fracas_frequencies_create(&second));
    fracas_spec spec = body_of(1, 4);
    spec.frequencies = first;
    OK(fracas_model_create(&spec, &computed));
    OWNED char *text = fracas_frequencies_write(first);
    assert_non_null(text);
    /* The pressed operator's frequency twice as high shows its source; then a wrong pair. */
    char changed[200], hash[FRACAS_HASH_HEX];
    double whole, pressed;
    assert_int_equal(sscanf(text, "%32[0-9a-f]:%la:%la,", hash, &whole, &pressed), 3);
    snprintf(changed, sizeof changed, "%s:%a:%a,00:", hash, whole, 2 * pressed);
    OK(fracas_frequencies_read(second, changed));
    spec.frequencies = second;
    OK(fracas_model_create(&spec, &told));
    assert_true(told->critical_closed == computed->critical_closed);
    assert_true(told->critical_cracked == computed->critical_cracked / 2);
    OWNED char *again = fracas_frequencies_write(second);
    assert_int_equal(strlen(again), strlen(text));
}

/* As many as a variable of the environment holds; each to the last bit. */
static void many(void **state)
{
    enum { MANY = 1200, WRITTEN = 1000 };
    OWN(fracas_frequencies) from = NULL;
    OWN(fracas_frequencies) to = NULL;
    OK(fracas_frequencies_create(&from));
    OK(fracas_frequencies_create(&to));
    OWNED char *none = fracas_frequencies_write(from);
    assert_string_equal(none, "");
    for (uint32_t i = 0; i < MANY; i++) {
        const fracas_hash body = fracas_hash_of(&i, sizeof i);
        const fracas_frequency_pair pair = {1e8 / (3 + i), DBL_MAX / (3 + i)};
        OK(fracas_frequencies_keep(from, &body, &pair));
    }
    OWNED char *text = fracas_frequencies_write(from);
    assert_true(strlen(text) < 128 * 1024);
    OK(fracas_frequencies_read(to, "00000000000000000000000000000000:0x1p+0:nan,"));
    OWNED char *still = fracas_frequencies_write(to);
    assert_string_equal(still, "");
    OK(fracas_frequencies_read(to, text));
    for (uint32_t i = 0; i < MANY; i++) {
        const fracas_hash body = fracas_hash_of(&i, sizeof i);
        fracas_frequency_pair pair = {0};
        assert_int_equal(fracas_frequencies_find(to, &body, &pair), i < WRITTEN);
        if (i < WRITTEN)
            assert_true(pair.whole == 1e8 / (3 + i) && pair.pressed == DBL_MAX / (3 + i));
    }
}

int fracas_test(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whatever_changes),
                                       cmocka_unit_test(another_process), cmocka_unit_test(many)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
