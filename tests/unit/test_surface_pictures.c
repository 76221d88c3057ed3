/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The pictures of docs/theory/meshes.md are those of the meshes as they are now. To write them
 * anew: FRACAS_WRITE_MESHES=docs/theory build/werror/tests/test_unit_surface_pictures */
#include "tests/support/surface.h"

static const struct {
    const char *name;
    body_shape shape; /* from spheres on seen from x = y = z, others from above */
    double length[2]; /* m */
    size_t divisions;
    double scale;
} pictures[] = {
    {"rectangle", SHAPE_RECTANGLE, {1.8, 1.2}, 6, 150.0},
    {"annulus", SHAPE_ANNULUS, {0.5, 1.0}, 4, 140.0},
    {"sphere", SHAPE_SPHERE, {1.0}, 4, 140.0},
    {"octant", SHAPE_OCTANT, {1.0}, 8, 165.0},
    {"cylinder", SHAPE_TUBE, {0.6, 1.6}, 6, 140.0},
};

enum { WIDTH = 300, HEIGHT = 300 };

/* Two coordinates on the paper, and the height above it. */
static void view(size_t picture, const double x[3], double p[3])
{
    const double a = sqrt(0.5), b = sqrt(1.0 / 6.0), c = sqrt(1.0 / 3.0);
    if (pictures[picture].shape >= SHAPE_SPHERE) {
        p[0] = a * (x[1] - x[0]);
        p[1] = b * (2.0 * x[2] - x[0] - x[1]);
        p[2] = c * (x[0] + x[1] + x[2]);
    } else {
        memcpy(p, x, 3 * sizeof *p);
    }
    p[0] = p[0] * pictures[picture].scale + 0.5 * WIDTH;
    p[1] = 0.5 * HEIGHT - p[1] * pictures[picture].scale;
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
    FILE *out = text_begin();
    fprintf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" width=\"%d\">\n"
        "<title>%s, regular and perturbed by 0.3</title>\n<rect width=\"100%%\" height=\"100%%\" "
        "fill=\"#fff\"/>\n"
        "<g fill=\"#e8eef6\" stroke=\"#35507a\" stroke-width=\"1\" stroke-linejoin=\"round\">\n",
        2 * WIDTH, HEIGHT, 2 * WIDTH, pictures[picture].name);
    const size_t divisions = pictures[picture].divisions;
    const double *length = pictures[picture].length;
    OWN(a_surface) plain = surface_of(
                       pictures[picture].shape, length,
                       &(fracas_surface_fineness){.divisions = divisions, .order = 2}),
                   *moved = surface_moved(pictures[picture].shape, length, divisions, 2, 4, false);
    draw(picture, plain, 0.0, out);
    draw(picture, moved, WIDTH, out);
    fputs("</g>\n</svg>\n", out);
    return text_end(out);
}

static void test_pictures(void **state)
{
    const char *folder = getenv("FRACAS_WRITE_MESHES");
    for (size_t i = 0; i < FRACAS_COUNT(pictures); i++) {
        char path[400];
        snprintf(path, sizeof path, "%s/mesh-%s.svg",
                 folder ? folder : FRACAS_SOURCE_DIR "/docs/theory", pictures[i].name);
        OWNED char *text = paint(i);
        if (folder) write_bytes(path, text, strlen(text));
        OWNED char *there = whole_file(path);
        if (strcmp(text, there) != 0) fail_msg("%s is not what the mesh looks like", path);
    }
}

TESTS(test_pictures)
