/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pictures of docs/theory/meshes.md are those of the meshes as they are now. To write them
 * anew: FRACAS_WRITE_MESHES=docs/theory build/werror/tests/test_unit_surface_pictures */
#include "tests/support/surface.h"
#include "tests/support/test.h"

typedef fracas_err maker(const fracas_surface_fineness *fineness, const fracas_surface **surface);

static fracas_err make_rectangle(const fracas_surface_fineness *fineness,
                                 const fracas_surface **surface)
{
    return fracas_surface_rectangle(1.8, 1.2, fineness, surface);
}

static fracas_err make_annulus(const fracas_surface_fineness *fineness,
                               const fracas_surface **surface)
{
    return fracas_surface_annulus(0.5, 1.0, fineness, surface);
}

static fracas_err make_sphere(const fracas_surface_fineness *fineness,
                              const fracas_surface **surface)
{
    return fracas_surface_sphere(1.0, fineness, surface);
}

static fracas_err make_octant(const fracas_surface_fineness *fineness,
                              const fracas_surface **surface)
{
    return fracas_surface_octant(1.0, fineness, surface);
}

static const struct {
    const char *name;
    maker *make;
    size_t divisions;
    double centre[2], scale;
    bool is_round; /* seen from x = y = z, else from above */
} pictures[] = {
    {"rectangle", make_rectangle, 6, {0.0, 0.0}, 150.0, false},
    {"annulus", make_annulus, 4, {0.0, 0.0}, 140.0, false},
    {"sphere", make_sphere, 4, {0.0, 0.0}, 140.0, true},
    {"octant", make_octant, 8, {0.0, 0.0}, 165.0, true},
};

enum { WIDTH = 300, HEIGHT = 300 };

/* Two coordinates on the paper, and the height above it. */
static void view(size_t picture, const double x[3], double p[3])
{
    const double a = sqrt(0.5), b = sqrt(1.0 / 6.0), c = sqrt(1.0 / 3.0);
    if (pictures[picture].is_round) {
        p[0] = a * (x[1] - x[0]);
        p[1] = b * (2.0 * x[2] - x[0] - x[1]);
        p[2] = c * (x[0] + x[1] + x[2]);
    } else {
        memcpy(p, x, 3 * sizeof *p);
    }
    p[0] = (p[0] - pictures[picture].centre[0]) * pictures[picture].scale + 0.5 * WIDTH;
    p[1] = 0.5 * HEIGHT - (p[1] - pictures[picture].centre[1]) * pictures[picture].scale;
}

/* Elements that face the reader, with their parabolas. */
static void draw(size_t picture, const fracas_surface *s, double right, FILE *out)
{
    for (size_t e = 0; e < s->nelements; e++) {
        double p[6][3];
        for (size_t k = 0; k < 6; k++) {
            view(picture, s->node[corner_of(s, e, k)], p[k]);
            p[k][0] += right;
        }
        const double area = (p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) -
                            (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]);
        if (area >= 0.0) continue; /* downward is positive on paper */
        fprintf(out, "<path d=\"M%.1f %.1f", p[0][0], p[0][1]);
        for (size_t k = 0; k < 3; k++) {
            const double *a = p[k], *b = p[(k + 1) % 3], *m = p[3 + k];
            fprintf(out, "Q%.1f %.1f %.1f %.1f", 2.0 * m[0] - 0.5 * (a[0] + b[0]),
                    2.0 * m[1] - 0.5 * (a[1] + b[1]), b[0], b[1]);
        }
        fputs("Z\"/>\n", out);
    }
}

static char *paint(size_t picture)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    fprintf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\">\n"
        "<title>%s, regular and perturbed by 0.3</title>\n<rect width=\"100%%\" height=\"100%%\" "
        "fill=\"#fff\"/>\n"
        "<g fill=\"#e8eef6\" stroke=\"#35507a\" stroke-width=\"1\" stroke-linejoin=\"round\">\n",
        2 * WIDTH, HEIGHT, 2 * WIDTH, pictures[picture].name);
    fracas_surface_fineness fineness = {.divisions = pictures[picture].divisions, .order = 2};
    const fracas_surface *plain, *moved;
    assert_int_equal(pictures[picture].make(&fineness, &plain), FRACAS_OK);
    double(*shift)[2] = taken(plain->nvertices * sizeof *shift);
    uint64_t x = 4;
    for (size_t v = 0; v < plain->nvertices; v++)
        for (int i = 0; i < 2; i++) shift[v][i] = 2.0 * next_share(&x) - 1.0;
    fineness.amplitude = 0.3;
    fineness.shift = (const double(*)[2])shift;
    fineness.nshifts = plain->nvertices;
    assert_int_equal(pictures[picture].make(&fineness, &moved), FRACAS_OK);
    draw(picture, plain, 0.0, out);
    draw(picture, moved, WIDTH, out);
    fputs("</g>\n</svg>\n", out);
    assert_int_equal(fclose(out), 0);
    fracas_surface_destroy(plain);
    fracas_surface_destroy(moved);
    free(shift);
    return text;
}

static void test_pictures(void **state)
{
    const char *folder = getenv("FRACAS_WRITE_MESHES");
    for (size_t i = 0; i < FRACAS_COUNT(pictures); i++) {
        char path[400];
        snprintf(path, sizeof path, "%s/mesh-%s.svg",
                 folder ? folder : FRACAS_SOURCE_DIR "/docs/theory", pictures[i].name);
        OWNED char *text = paint(i), *there = zeroed(1, 1 << 18);
        FILE *file = fopen(path, folder ? "w" : "r");
        if (!file) fail_msg("cannot open %s", path);
        if (folder) fputs(text, file);
        else assert_true(fread(there, 1, (1 << 18) - 1, file) > 0);
        assert_int_equal(fclose(file), 0);
        if (!folder && strcmp(text, there) != 0)
            fail_msg("%s is not what the mesh looks like", path);
    }
}

TESTS(test_pictures)
