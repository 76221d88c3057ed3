/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/film/film.h"

#include "analysis/data/format.h"
#include "analysis/draw/chart.h"
#include "analysis/draw/html.h"
#include "analysis/draw/surface_picture.h"
#include "analysis/export/sha256.h"
#include "base/json.h"
#include "base/param.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SPEED, STRESS, VALUES = STRESS + FRACAS_FILM_STRESSES };
enum { WORDS = 48 };

/* Arrays of all instants, one after another. */
struct fracas_film {
    size_t elements, corners, interfaces, ends, most, count;
    size_t values;                                 /* at most VALUES */
    char name[VALUES][WORDS], unit[VALUES][WORDS]; /* each has its own */
    size_t components[VALUES];                     /* those of the tensor behind it; 0: none is */
    double middle[3];                              /* m, of the nodes before any motion */
    float (*place)[3];    /* [element][corner] m from the middle, before any motion */
    uint32_t *side;       /* [interface][2][end] nodes of its sides; NO_NODE: they are apart */
    double *time;         /* [instant] s */
    size_t *fragments;    /* [instant] */
    float (*moved)[3];    /* [instant][element][corner] m */
    uint32_t *label;      /* [instant][element] first element of its fragment */
    uint8_t *damage;      /* [instant][interface] of 255 */
    float *value[VALUES]; /* [instant][element] in its unit */
    gsl_eigen_symm_workspace *work;
};

#define NO_NODE UINT32_MAX

static size_t nodes_of(const fracas_film *film)
{
    return film->elements * film->corners;
}

/* Bytes of an instant before they are written as text: as put_instant has them. */
static double instant_bytes(const fracas_film_instant *like)
{
    return (double)like->elements * (4 + VALUES + 6 * (double)like->corners) +
           (double)like->interfaces;
}

double fracas_film_bytes(const fracas_film_instant *like, size_t instants)
{
    const double still = (double)like->elements * 12 * (double)like->corners +
                         (double)like->interfaces * 8 * (double)like->ends;
    return (still + (double)instants * instant_bytes(like)) * 4 / 3;
}

/* ---- the body ---- */

/* The seam of a periodic bar: the nodes of two elements that are farthest apart. */
static void find_seam(const fracas_film *film, size_t a, size_t b, uint32_t side[2])
{
    double most = 0;
    for (size_t i = a; i < a + 2; i++)
        for (size_t j = b; j < b + 2; j++) {
            double apart = 0;
            for (size_t k = 0; k < 3; k++)
                apart = fmax(apart, fabs((double)film->place[i][k] - (double)film->place[j][k]));
            if (!(apart > most)) continue;
            most = apart;
            side[0] = (uint32_t)i;
            side[1] = (uint32_t)j;
        }
}

/* Nodes of the two sides of an interface: those which its elements have at one place. */
static void find_sides(fracas_film *film, const int64_t between[2], uint32_t *side)
{
    const size_t n = film->corners, a = (size_t)between[0] * n, b = (size_t)between[1] * n;
    size_t found = 0;
    double size = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < 3; k++)
            size = fmax(size, fabs((double)film->place[a + i][k] - (double)film->place[a][k]));
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n && found < film->ends; j++) {
            double apart = 0;
            for (size_t k = 0; k < 3; k++)
                apart = fmax(apart,
                             fabs((double)film->place[a + i][k] - (double)film->place[b + j][k]));
            if (apart > 1e-3 * size) continue;
            side[found] = (uint32_t)(a + i);
            side[film->ends + found++] = (uint32_t)(b + j);
        }
    if (found == film->ends) return;
    for (size_t i = 0; i < 2 * film->ends; i++) side[i] = NO_NODE;
    if (n == 2) find_seam(film, a, b, side);
}

static void keep_body(fracas_film *film, const fracas_film_instant *first)
{
    const size_t nodes = nodes_of(film);
    for (size_t k = 0; k < 3; k++) { /* from the middle: a body may be far from the origin */
        double sum = 0;
        for (size_t i = 0; i < nodes; i++) sum += first->place[i][k] - first->displacement[i][k];
        film->middle[k] = sum / (double)nodes;
        for (size_t i = 0; i < nodes; i++)
            film->place[i][k] = (float)(first->place[i][k] - first->displacement[i][k] -
                                        film->middle[k]);
    }
    for (size_t i = 0; i < film->interfaces; i++)
        find_sides(film, first->between[i], film->side + i * 2 * film->ends);
}

static void name_values(fracas_film *film, const fracas_film_instant *first)
{
    FRACAS_PRINT(film->name[SPEED], "speed");
    FRACAS_PRINT(film->unit[SPEED], "m/s");
    film->values = STRESS;
    for (size_t s = 0; s < FRACAS_FILM_STRESSES && first->stress[s].name; s++) {
        const size_t v = film->values++;
        FRACAS_PRINT(film->name[v], "%s", first->stress[s].name);
        FRACAS_PRINT(film->unit[v], "%s", first->stress[s].unit);
        film->components[v] = first->stress[s].components;
    }
}

fracas_err fracas_film_create(const fracas_film_instant *first, size_t most, fracas_film **film)
{
    fracas_film *f = *film = calloc(1, sizeof *f);
    if (!f) return fracas_no_memory("a film");
    f->elements = first->elements;
    f->corners = first->corners;
    f->interfaces = first->interfaces;
    f->ends = first->ends;
    f->most = most;
    name_values(f, first);
    f->place = calloc(nodes_of(f), sizeof *f->place);
    f->side = calloc(2 * f->interfaces * f->ends + 1, sizeof *f->side);
    f->time = calloc(most, sizeof *f->time);
    f->fragments = calloc(most, sizeof *f->fragments);
    f->moved = calloc(most * nodes_of(f), sizeof *f->moved);
    f->label = calloc(most * f->elements, sizeof *f->label);
    f->damage = calloc(most * f->interfaces + 1, sizeof *f->damage);
    f->work = gsl_eigen_symm_alloc(3);
    bool lacks = !f->place || !f->side || !f->time || !f->fragments || !f->moved || !f->label ||
                 !f->damage || !f->work;
    for (size_t v = 0; v < f->values; v++) {
        f->value[v] = calloc(most * f->elements, sizeof **f->value);
        lacks = lacks || !f->value[v];
    }
    if (!lacks) {
        keep_body(f, first);
        return FRACAS_OK;
    }
    fracas_film_destroy(f);
    *film = NULL;
    return fracas_no_memory("a film");
}

void fracas_film_destroy(fracas_film *film)
{
    if (!film) return;
    for (int v = 0; v < VALUES; v++) free(film->value[v]);
    gsl_eigen_symm_free(film->work);
    free(film->place);
    free(film->side);
    free(film->time);
    free(film->fragments);
    free(film->moved);
    free(film->label);
    free(film->damage);
    free(film);
}

/* ---- an instant ---- */

/* The principal value of the largest amount. */
static double principal(const fracas_film *film, const double *t, size_t components)
{
    if (components == 1) return t[0];
    double matrix[9] = {t[0], t[3], t[5], t[3], t[1], t[4], t[5], t[4], t[2]}, value[3];
    gsl_matrix_view m = gsl_matrix_view_array(matrix, 3, 3);
    gsl_vector_view v = gsl_vector_view_array(value, 3);
    gsl_eigen_symm(&m.matrix, &v.vector, film->work);
    const double low = fmin(fmin(value[0], value[1]), value[2]),
                 high = fmax(fmax(value[0], value[1]), value[2]);
    return -low > high ? low : high;
}

/* |sum of the nodes' velocities| / their number */
static double speed_of(const fracas_film *film, const double (*velocity)[3])
{
    double sum[3] = {0, 0, 0};
    for (size_t i = 0; i < film->corners; i++)
        for (size_t k = 0; k < 3; k++) sum[k] += velocity[i][k];
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) / (double)film->corners;
}

/* A fragment keeps its label, and thereby its colour, until its first element leaves it: numbers of
 * fragments change with every break. */
static fracas_err keep_labels(fracas_film *film, const int64_t *fragment, uint32_t *label)
{
    OWNED uint32_t *first = malloc(film->elements * sizeof *first);
    size_t count = 0;
    if (!first) return fracas_no_memory("the fragments of a film");
    memset(first, 0xff, film->elements * sizeof *first);
    for (size_t e = 0; e < film->elements; e++) {
        uint32_t *of = &first[fragment[e]];
        if (*of == NO_NODE) {
            *of = (uint32_t)e;
            count++;
        }
        label[e] = *of;
    }
    film->fragments[film->count] = count;
    return FRACAS_OK;
}

fracas_err fracas_film_add(fracas_film *film, const fracas_film_instant *now)
{
    const size_t at = film->count, nodes = nodes_of(film), first = at * film->elements;
    float(*moved)[3] = film->moved + at * nodes;
    for (size_t i = 0; i < nodes; i++)
        for (size_t k = 0; k < 3; k++) moved[i][k] = (float)now->displacement[i][k];
    for (size_t e = 0; e < film->elements; e++) {
        film->value[SPEED][first + e] = (float)speed_of(film, now->velocity + e * film->corners);
        for (size_t v = STRESS; v < film->values; v++) {
            const fracas_film_stress *of = &now->stress[v - STRESS];
            film->value[v][first + e] = (float)principal(film, of->value + e * of->components,
                                                         of->components);
        }
    }
    for (size_t i = 0; i < film->interfaces; i++) /* any damage shows, 255 alone is broken */
        film->damage[at * film->interfaces + i] =
            (uint8_t)(now->damage[i] >= 1 ? 255 : ceil(254 * fmax(now->damage[i], 0)));
    TRY(keep_labels(film, now->fragment, film->label + first));
    film->time[film->count++] = now->time;
    return FRACAS_OK;
}

/* ---- the page ---- */

typedef struct {
    double low, high;
} range;

static void widen(range *of, double value)
{
    of->low = fmin(of->low, value);
    of->high = fmax(of->high, value);
}

/* 0 to `steps` for a value within the range. */
static unsigned step_of(const range *of, double value, double steps)
{
    if (!(of->high > of->low)) return 0;
    return (unsigned)lround(steps * (value - of->low) / (of->high - of->low));
}

typedef struct {
    const fracas_film *film;
    range moved[3], value[VALUES];
    size_t dimension; /* 2: all at one z, at all instants */
} measure;

static void take_measure(const fracas_film *film, measure *of)
{
    const size_t nodes = nodes_of(film);
    *of = (measure){.film = film, .dimension = 3};
    range z = {INFINITY, -INFINITY};
    for (int k = 0; k < 3; k++) of->moved[k] = (range){INFINITY, -INFINITY};
    for (size_t v = 0; v < film->values; v++) of->value[v] = (range){INFINITY, -INFINITY};
    for (size_t i = 0; i < film->count * nodes; i++) {
        for (int k = 0; k < 3; k++) widen(&of->moved[k], (double)film->moved[i][k]);
        widen(&z, (double)film->place[i % nodes][2] + (double)film->moved[i][2]);
    }
    for (size_t v = 0; v < film->values; v++)
        for (size_t e = 0; e < film->count * film->elements; e++)
            widen(&of->value[v], (double)film->value[v][e]);
    range x = {INFINITY, -INFINITY};
    for (size_t i = 0; i < nodes; i++) widen(&x, (double)film->place[i][0]);
    if (z.high - z.low <= 1e-9 * (x.high - x.low)) of->dimension = 2;
}

static void put_value(const measure *of, size_t v, fracas_json *json)
{
    const char *name = of->film->name[v], *unit = of->film->unit[v];
    const range *within = &of->value[v];
    char title[2 * WORDS];
    FRACAS_PRINT(title, "%s%s%s", of->film->components[v] == 6 ? "principal " : "",
                 strlen(name) == 1 ? "resultant " : "", name);
    fracas_json_object(json, NULL);
    fracas_json_text(json, "key", name);
    fracas_json_text(json, "title", title);
    fracas_json_real(json, "least", within->low);
    fracas_json_real(json, "largest", within->high);
    fracas_json_text(json, "low", fracas_with_unit(within->low, 3, unit, true).text);
    fracas_json_text(json, "high", fracas_with_unit(within->high, 3, unit, true).text);
    fracas_json_close(json);
}

static void put_header(const measure *of, const char *stem, FILE *out)
{
    const fracas_film *film = of->film;
    fracas_json json;
    fprintf(out, "<script type=\"application/json\" id=\"film\">");
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "stem", stem);
    fracas_json_integer(&json, "dimension", (int64_t)of->dimension);
    fracas_json_integer(&json, "elements", (int64_t)film->elements);
    fracas_json_integer(&json, "corners", (int64_t)film->corners);
    fracas_json_integer(&json, "interfaces", (int64_t)film->interfaces);
    fracas_json_integer(&json, "ends", (int64_t)film->ends);
    fracas_json_array(&json, "middle");
    for (size_t k = 0; k < 3; k++) fracas_json_real(&json, NULL, film->middle[k]);
    fracas_json_close(&json);
    fracas_json_array(&json, "moved");
    for (size_t k = 0; k < of->dimension; k++) {
        fracas_json_real(&json, NULL, of->moved[k].low);
        fracas_json_real(&json, NULL, of->moved[k].high);
    }
    fracas_json_close(&json);
    fracas_json_array(&json, "values");
    for (size_t v = 0; v < film->values; v++) put_value(of, v, &json);
    fracas_json_close(&json);
    fracas_json_array(&json, "instants");
    for (size_t i = 0; i < film->count; i++) {
        fracas_json_object(&json, NULL);
        fracas_json_real(&json, "time", film->time[i]);
        fracas_json_text(&json, "text", fracas_surface_time(film->time[i], true).text);
        fracas_json_integer(&json, "fragments", (int64_t)film->fragments[i]);
        fracas_json_close(&json);
    }
    fracas_json_end(&json);
    fputs("</script>\n", out);
}

static void put_block(const char *id, const void *bytes, size_t size, FILE *out)
{
    fprintf(out, "<script type=\"text/plain\" id=\"%s\">", id);
    fracas_base64_write(bytes, size, out);
    fputs("</script>\n", out);
}

/* Labels (4 bytes), displacements (2 bytes), damage, values (1 byte), all little-endian. */
static void put_instant(const measure *of, size_t at, uint8_t *bytes, FILE *out)
{
    const fracas_film *film = of->film;
    const size_t nodes = nodes_of(film);
    uint8_t *next = bytes;
    char id[32];
    for (size_t e = 0; e < film->elements; e++)
        for (int b = 0; b < 4; b++)
            *next++ = (uint8_t)(film->label[at * film->elements + e] >> (8 * b));
    for (size_t i = 0; i < nodes; i++)
        for (size_t k = 0; k < of->dimension; k++) {
            const unsigned step = step_of(&of->moved[k], (double)film->moved[at * nodes + i][k],
                                          65535);
            *next++ = (uint8_t)(step & 0xff);
            *next++ = (uint8_t)(step >> 8);
        }
    memcpy(next, film->damage + at * film->interfaces, film->interfaces);
    next += film->interfaces;
    for (size_t v = 0; v < film->values; v++)
        for (size_t e = 0; e < film->elements; e++)
            *next++ = (uint8_t)step_of(&of->value[v],
                                       (double)film->value[v][at * film->elements + e], 255);
    snprintf(id, sizeof id, "instant%zu", at);
    put_block(id, bytes, (size_t)(next - bytes), out);
}

static fracas_err put_body(const fracas_film *film, const char *stem, FILE *out)
{
    measure of;
    const fracas_film_instant like = {
        .elements = film->elements, .corners = film->corners, .interfaces = film->interfaces};
    OWNED uint8_t *bytes = malloc((size_t)instant_bytes(&like) + 1);
    if (!bytes) return fracas_no_memory("the instants of a film");
    take_measure(film, &of);
    fputs("<div id=\"stage\"></div>\n<noscript>This film is drawn by the page's own script: allow "
          "it.</noscript>\n",
          out);
    put_header(&of, stem, out);
    put_block("place", film->place, nodes_of(film) * sizeof *film->place, out);
    put_block("side", film->side, 2 * film->interfaces * film->ends * sizeof *film->side, out);
    for (size_t at = 0; at < film->count; at++) put_instant(&of, at, bytes, out);
    return FRACAS_OK;
}

fracas_err fracas_film_write(const fracas_film *film, const char *folder, const char *name,
                             const char *title, const char *how)
{
    const size_t last = film->count - 1;
    char lead[512];
    OWNED char *body = NULL;
    size_t size;
    char stem[256];
    snprintf(stem, sizeof stem, "%s", name);
    if (strlen(stem) > 5 && !strcmp(stem + strlen(stem) - 5, ".html")) stem[strlen(stem) - 5] = 0;
    for (char *c = stem; *c; c++) /* it stands in a script */
        if (*c == '<' || *c == '>') *c = '_';
    FILE *out = open_memstream(&body, &size);
    if (!out) return fracas_no_memory("a film");
    fracas_err err = put_body(film, stem, out);
    const bool bad = ferror(out);
    if ((fclose(out) || bad) && !err) err = fracas_no_memory("a film");
    if (err) return err;
    FRACAS_PRINT(
        lead,
        "%zu fragment%s at %s, the last instant of %zu. %s Drag to turn or to move the body, "
        "scroll to zoom.",
        film->fragments[last], film->fragments[last] == 1 ? "" : "s",
        fracas_surface_time(film->time[last], true).text, film->count, how);
    return fracas_html_alone(folder, name, title, lead, body, fracas_film_script);
}
