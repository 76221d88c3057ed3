/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths by the columns of a study: the warning of the mesh, and the scales of uniform ones. */
#include "analysis/summary/statistics.h"
#include "analysis/summary/study.h"
#include "base/param.h"
#include "tests/support/test.h"

#include <math.h>

/* A bar of 50 mm, 1 mm2 and 2500 elements: 0.02 mm3 an interface. Without a rate, as at e = 0.3,
 * counts fall by 0.75/(1 + 4.5 0.3^(2/3)) = 0.2486 deviation/mean where elements are halved, where
 * it is known that strengths have no least value; from 1 % on that is said, unless the strengths
 * know a volume. At e = 3 they fall by 0.0724 of it. */
static void strengths_that_the_mesh_changes(void **state)
{
    enum { NCOLUMNS = 12, VARIED = 6 };
    static const fracas_column column[NCOLUMNS] = {
        {"derived.length", "m", "", false},
        {"derived.strength_mean", "Pa", "", false},
        {"geometry.area", "m2", "", false},
        {"mesh.elements", "1", "", false},
        {"strength.distribution", "", "", true},
        {"strength.mean", "Pa", "", false},
        {"derived.strength_modulus", "1", "", false},
        {"strength.deviation", "Pa", "", false},
        {"strength.maximum", "Pa", "", false},
        {"strength.minimum", "Pa", "", false},
        {"strength.sigma", "1", "", false},
        {"strength.reference_volume", "m3", "", false},
    };
    static const struct {
        double varied[VARIED]; /* from derived.strength_modulus on */
        const char *lowers;    /* NULL: no warning */
        const char *distribution;
    } table[] = {
        {{10, NAN, NAN, NAN, NAN, NAN},
         "lowers the count by about 3.0 %: give strength.reference_volume, here 0.02 mm3"},
        {{40, NAN, NAN, NAN, NAN, NAN}, NULL},
        {{10, NAN, NAN, NAN, NAN, 2e-11}, NULL},
        {{NAN, 30e6, NAN, NAN, NAN, NAN}, "moves the count by up to 5 %: give"},
        {{NAN, 30e6, NAN, NAN, NAN, NAN}, "by up to 5 %, mostly up: give", "uniform"},
        {{NAN, 10e6, NAN, NAN, NAN, NAN}, NULL, "uniform"},
        {{10, NAN, NAN, 100e6, NAN, NAN}, "moves the count by up to 5 %: give"},
        {{NAN, 10e6, NAN, NAN, NAN, NAN}, NULL},
        {{NAN, NAN, 301e6, 299e6, NAN, NAN}, NULL},
        {{NAN, NAN, 350e6, 250e6, NAN, NAN}, "by up to 5 %, mostly up: give", "uniform"},
        {{NAN, NAN, 311e6, 289e6, NAN, NAN}, NULL}, /* 22/300/sqrt(12) = 2.1 % */
        {{NAN, NAN, NAN, NAN, 0.1, NAN}, "lowers the count by about 2.5 %:"},
        {{NAN, NAN, NAN, NAN, NAN, NAN}, NULL},
    };
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        const char *distribution = table[i].distribution ? table[i].distribution : "";
        fracas_value value[NCOLUMNS] = {{0.05, ""}, {300e6, ""},         {1e-6, ""},
                                        {2500, ""}, {NAN, distribution}, {300e6, ""}};
        for (size_t c = 0; c < VARIED; c++)
            value[NCOLUMNS - VARIED + c] = (fracas_value){table[i].varied[c], ""};
        fracas_point_row row = {.value = value};
        fracas_point_table points = {
            .ncolumns = NCOLUMNS, .column = column, .npoints = 1, .point = &row};
        fracas_point_statistics point = {
            .size.mean = 1, .realizations = 9, .usable = 9, .outcome = {9}, .elements = 100};
        fracas_analysis analysis = {.table = &points, .point = &point, .header.complete = true};
        OWNED fracas_warning *warning = NULL;
        size_t count;
        OK(fracas_analysis_warnings(&analysis, &warning, &count));
        assert_int_equal(count, table[i].lowers != NULL);
        if (table[i].lowers) assert_has(warning->text, table[i].lowers);
        if (i > 0) continue;
        OWNED fracas_warning *fast = NULL;
        point.rate = 3e5;
        point.scales.rate = 1e5;
        OK(fracas_analysis_warnings(&analysis, &fast, &count));
        assert_int_equal(count, 0); /* 0.87 % */
    }
}

/* Uniform strengths between 200 and 400 MPa are those of mean 300 and deviation 200/sqrt(12) MPa:
 * the scaling laws take the same strength of a piece, and it is not an interface's. */
static void scales_of_uniform_strengths(void **state)
{
    enum { NCOLUMNS = 13 };
    static const fracas_column column[NCOLUMNS] = {
        {"derived.fracture_energy", "J/m2", "", false},
        {"derived.length", "m", "", false},
        {"derived.strength_mean", "Pa", "", false},
        {"geometry.area", "m2", "", false},
        {"material.density", "kg/m3", "", false},
        {"material.young", "Pa", "", false},
        {"mesh.elements", "1", "", false},
        {"strength.deviation", "Pa", "", false},
        {"strength.distribution", "", "", true},
        {"strength.maximum", "Pa", "", false},
        {"strength.mean", "Pa", "", false},
        {"strength.minimum", "Pa", "", false},
        {"strength.reference_volume", "m3", "", false},
    };
    fracas_point_statistics of[2];
    for (int moments = 0; moments < 2; moments++) {
        const fracas_value value[NCOLUMNS] = {
            {100, ""},
            {0.01, ""},
            {350e6, ""},
            {1e-6, ""},
            {2750, ""},
            {275e9, ""},
            {1000, ""},
            {moments ? 200e6 / sqrt(12) : NAN, ""},
            {NAN, "uniform"},
            {moments ? NAN : 400e6, ""},
            {moments ? 300e6 : NAN, ""},
            {moments ? NAN : 200e6, ""},
            {1e-10, ""},
        };
        const fracas_point_row row = {.value = value};
        const fracas_point_table table = {
            .ncolumns = NCOLUMNS, .column = column, .npoints = 1, .point = &row};
        fracas_point_statistics_init(&table, 0, &of[moments]);
        assert_int_equal(of[moments].strength_by, FRACAS_STRENGTH_OF_PIECE);
    }
    assert_true(fabs(of[1].scales.size / of[0].scales.size - 1) < 1e-12);
    assert_true(of[0].scales.size > 1.01 * 275e9 * 100 / (350e6 * 350e6));
}

TESTS(strengths_that_the_mesh_changes, scales_of_uniform_strengths)
