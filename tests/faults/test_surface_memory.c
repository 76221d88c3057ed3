/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Making and reading a surface when the k-th allocation fails, for every k: an error, never a
 * crash. */
#include "engine/mesh/surface/capsule.h"
#include "tests/support/gmsh.h"

#ifdef __SANITIZE_ADDRESS__
/* AddressSanitizer owns malloc; this program has nothing to do there. */
int fracas_test(void)
{
    return 0;
}
#else

#include "tests/support/fail_each.h"

#include <limits.h>

static const double (*shift)[2];
static size_t nshifts;

static fracas_err make_octant(const void *context)
{
    (void)context;
    const fracas_surface_fineness fineness = {
        .divisions = 3, .order = 2, .amplitude = 0.2, .shift = shift, .nshifts = nshifts};
    const fracas_surface *s = NULL;
    const fracas_err err = fracas_surface_octant(1.0, &fineness, &s);
    fracas_surface_destroy(s);
    return err;
}

static fracas_err make_capsule(const void *context)
{
    (void)context;
    const fracas_surface_fineness fineness = {.divisions = 2, .order = 1};
    const fracas_surface *s = NULL;
    const fracas_err err = fracas_surface_capsule(1.0, 1.0, 0, &fineness, &s);
    fracas_surface_destroy(s);
    return err;
}

static fracas_err read_mesh(const void *context)
{
    const gmsh_file *f = context;
    const fracas_surface *s = NULL;
    const fracas_err err = fracas_surface_read_gmsh(f->bytes, f->size, 1, false, &s);
    fracas_surface_destroy(s);
    return err;
}

static void test_made(void **state)
{
    static const double numbers[10][2] = {{0.5, -0.5}};
    shift = numbers;
    nshifts = 10;
    fail_each_of(make_octant, NULL, LONG_MAX);
    fail_each_of(make_capsule, NULL, LONG_MAX);
}

static void test_read(void **state)
{
    for (int order = 1; order <= 2; order++) {
        const fracas_surface_fineness fineness = {.divisions = 2, .order = order};
        const fracas_surface *s = NULL;
        OK(fracas_surface_rectangle(1.0, 1.0, &fineness, &s));
        for (int which = 0; which < 4; which++) {
            gmsh_file f = gmsh_write(s, which % 2, which / 2, false);
            fail_each_of(read_mesh, &f, LONG_MAX);
            free(f.bytes);
        }
        fracas_surface_destroy(s);
    }
}

TESTS(test_made, test_read)

#endif
