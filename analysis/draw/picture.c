/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/draw/picture.h"

#include "analysis/data/format.h"
#include "analysis/draw/chart.h"
#include "analysis/draw/scale.h"
#include "analysis/data/field.h"
#include "base/own.h"

#include <math.h>

enum { SIDE = FRACAS_CHART_WIDE, MARGIN = 10, ARROW = 30, LINE_HEIGHT = 19 }; /* pixels */
enum { ARROWS_MOST = 60 };
static const double band = 0.1; /* thickness of the ring as drawn / radius */

size_t fracas_picture_points(const fracas_analysis *analysis, size_t point[FRACAS_MAX_PICTURES])
{
    size_t count = 0, seen = 0, chosen = 0;
    for (size_t p = 0; p < analysis->table->npoints; p++)
        count += analysis->point[p].radius > 0 && analysis->point[p].broken_replica >= 0;
    size_t most = count < FRACAS_MAX_PICTURES ? count : FRACAS_MAX_PICTURES;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        if (!(analysis->point[p].radius > 0) || analysis->point[p].broken_replica < 0) continue;
        size_t wanted = most > 1 ? (2 * chosen * (count - 1) + most - 1) / (2 * (most - 1))
                                 : 0; /* rounded */
        if (seen++ == wanted && chosen < most) point[chosen++] = p;
    }
    return chosen;
}

double fracas_picture_exaggeration(const fracas_ring_pattern *pattern)
{
    double size = 0, moved = 0, largest = 0;
    for (size_t i = 0; i < pattern->n; i++) {
        const fracas_ring_piece *piece = &pattern->piece[i];
        if (!isfinite(piece->displacement)) continue;
        size += piece->size;
        moved += piece->size * piece->displacement;
        largest = fmax(largest, piece->displacement);
    }
    double factor = fmin(0.4 * pattern->radius * size / moved, 0.8 * pattern->radius / largest);
    const double none = 1e9; /* displacements are rounding then */
    if (!(factor > 1 && factor < none)) return 1;
    return fracas_scale_nice(factor, false);
}

/* Greatest speed of fragments beside the uniform expansion. Dust is left out: it may be much
 * faster. */
static double fastest_of(const fracas_ring_pattern *pattern)
{
    double fastest = 0;
    for (size_t i = 0; i < pattern->n; i++)
        if (!pattern->piece[i].dust)
            fastest = fmax(fastest,
                           hypot(pattern->piece[i].relative[0], pattern->piece[i].relative[1]));
    return fastest;
}

static size_t dust_of(const fracas_ring_pattern *pattern)
{
    size_t dust = 0;
    for (size_t i = 0; i < pattern->n; i++) dust += pattern->piece[i].dust != 0;
    return dust;
}

static void write_caption(const fracas_analysis *analysis, size_t point, fracas_picture *picture)
{
    const fracas_ring_pattern *pattern = &picture->pattern;
    char arrows[256] = "";
    const fracas_label label = fracas_analysis_label(analysis, point);
    FRACAS_PRINT(picture->file, "pattern-point-%zu", point);
    FRACAS_PRINT(picture->title, "Crack pattern%s%.159s", *label.text ? ", " : "", label.text);
    if (picture->arrows)
        FRACAS_PRINT(
            arrows,
            "Arrows: velocity of the centre of mass beside the uniform expansion, the longest "
            "%s; none on dust. ",
            fracas_with_unit(picture->fastest, 3, "m/s", true).text);
    FRACAS_PRINT(
        picture->caption,
        "Replica %lld, the first that ended FRAGMENTED; fragments: %zu, of these dust: %zu; "
        "time: %s. Each fragment is where its centre of mass is, its displacement outward "
        "drawn %.0f times as large; its own turning is not recorded and not drawn. %sDots: "
        "dust. Dashes: the ring at its start.",
        (long long)analysis->point[point].broken_replica, pattern->n, dust_of(pattern),
        fracas_with_unit(pattern->time, 3, "s", true).text, picture->exaggeration, arrows);
}

fracas_err fracas_picture_create(const fracas_analysis *analysis, size_t point,
                                 fracas_picture *picture)
{
    const fracas_point_statistics *statistics = &analysis->point[point];
    *picture = (fracas_picture){0};
    FRACAS_CLEARED(fracas_record) record;
    fracas_record_init(&record);
    size_t of;
    int64_t replica;
    TRY(fracas_results_record(analysis->results, statistics->broken_row, FRACAS_READ_FRAGMENTS, &of,
                              &replica, &record));
    TRY(fracas_ring_pattern_create(&record, statistics->radius, &picture->pattern));
    picture->exaggeration = fracas_picture_exaggeration(&picture->pattern);
    picture->fastest = fastest_of(&picture->pattern);
    picture->arrows = picture->pattern.n <= ARROWS_MOST && picture->fastest > 0;
    write_caption(analysis, point, picture);
    return FRACAS_OK;
}

void fracas_picture_clear(fracas_picture *picture)
{
    fracas_ring_pattern_clear(&picture->pattern);
}

/* ---- drawing ---- */

typedef struct {
    const fracas_picture *picture;
    FILE *out;
    double scale; /* pixels a metre */
} canvas;

/* Pixels of the point at `distance` [m] from the middle of an arc's circle in direction `angle`,
 * the circle moved by `push` [m] in direction `outward`. */
static void place(const canvas *on, double distance, double angle, double push, double outward,
                  double at[2])
{
    at[0] = SIDE / 2.0 + on->scale * (distance * cos(angle) + push * cos(outward));
    at[1] = SIDE / 2.0 - on->scale * (distance * sin(angle) + push * sin(outward));
}

static double pixels_per_metre(const fracas_picture *picture)
{
    double reach = picture->pattern.radius;
    for (size_t i = 0; i < picture->pattern.n; i++) {
        double push = picture->exaggeration * picture->pattern.piece[i].displacement;
        if (push > 0) reach = fmax(reach, picture->pattern.radius + push);
    }
    return (SIDE / 2.0 - MARGIN - (picture->arrows ? ARROW : 0)) /
           (reach + band / 2 * picture->pattern.radius);
}

/* Neighbours differ, the last and the first too. */
static size_t colour_of(size_t i, size_t n)
{
    bool closes = i + 1 == n && n > 2 && n % FRACAS_CHART_COLOURS == 1;
    return closes ? 2 : i % FRACAS_CHART_COLOURS;
}

static void draw_title(const canvas *on, const fracas_ring_piece *piece)
{
    fprintf(on->out,
            "<title>fragment %zu%s: %s long, displaced %s, outward %s, along the ring %s</title>",
            piece->fragment, piece->dust ? " (dust)" : "",
            fracas_with_unit(piece->size, 3, "m", true).text,
            fracas_with_unit(piece->displacement, 3, "m", true).text,
            fracas_with_unit(piece->velocity[0], 3, "m/s", true).text,
            fracas_with_unit(piece->velocity[1], 3, "m/s", true).text);
}

static void draw_piece(const canvas *on, size_t i)
{
    const fracas_ring_pattern *pattern = &on->picture->pattern;
    const fracas_ring_piece *piece = &pattern->piece[i];
    const double widest = 0.998 * M_PI; /* a whole circle is no path */
    double half = fmin(piece->half_angle, widest),
           push = on->picture->exaggeration * piece->displacement;
    double outer = pattern->radius * (1 + band / 2), inner = pattern->radius * (1 - band / 2),
           at[4][2];
    place(on, outer, piece->angle - half, push, piece->angle, at[0]);
    place(on, outer, piece->angle + half, push, piece->angle, at[1]);
    place(on, inner, piece->angle + half, push, piece->angle, at[2]);
    place(on, inner, piece->angle - half, push, piece->angle, at[3]);
    int large = 2 * half > M_PI;
    bool edged = 2 * half * pattern->radius * on->scale > 3; /* pixels */
    fprintf(on->out,
            "<path class=\"band c%zu\"%s d=\"M%.2f %.2fA%.2f %.2f 0 %d 0 %.2f %.2fL%.2f %.2fA%.2f "
            "%.2f 0 %d 1 %.2f %.2fz\">",
            colour_of(i, pattern->n), edged ? "" : " style=\"stroke:none\"", at[0][0], at[0][1],
            outer * on->scale, outer * on->scale, large, at[1][0], at[1][1], at[2][0], at[2][1],
            inner * on->scale, inner * on->scale, large, at[3][0], at[3][1]);
    draw_title(on, piece);
    fputs("</path>\n", on->out);
}

static void draw_dust(const canvas *on, const fracas_ring_piece *piece)
{
    double at[2], above = on->picture->pattern.radius * (1 + band / 2) + 5 / on->scale;
    place(on, above, piece->angle, on->picture->exaggeration * piece->displacement, piece->angle,
          at);
    fprintf(on->out, "<circle class=\"dust\" cx=\"%.2f\" cy=\"%.2f\" r=\"1.8\"/>\n", at[0], at[1]);
}

static void draw_arrow(const canvas *on, const fracas_ring_piece *piece)
{
    double speed = hypot(piece->relative[0], piece->relative[1]),
           length = ARROW * speed / on->picture->fastest;
    if (!(length > 1.5)) return; /* pixels: no longer than its line is wide */
    double from[2], direction = piece->angle + atan2(piece->relative[1], piece->relative[0]);
    place(on, on->picture->pattern.radius, piece->angle,
          on->picture->exaggeration * piece->displacement, piece->angle, from);
    double dx = cos(direction), dy = -sin(direction), head = fmin(4, length / 2);
    double to[2] = {from[0] + length * dx, from[1] + length * dy};
    fprintf(on->out,
            "<path class=\"ink\" d=\"M%.2f %.2fL%.2f %.2fM%.2f %.2fL%.2f %.2fL%.2f %.2f\"/>\n",
            from[0], from[1], to[0], to[1], to[0] - head * (dx + 0.6 * dy),
            to[1] - head * (dy - 0.6 * dx), to[0], to[1], to[0] - head * (dx - 0.6 * dy),
            to[1] - head * (dy + 0.6 * dx));
}

static void draw_words(const canvas *on)
{
    const fracas_picture *picture = on->picture;
    char line[3][96];
    FRACAS_PRINT(line[0], "%zu fragment%s", picture->pattern.n, picture->pattern.n == 1 ? "" : "s");
    FRACAS_PRINT(line[1], "at %s", fracas_with_unit(picture->pattern.time, 3, "s", true).text);
    FRACAS_PRINT(line[2], "displacement \u00d7 %.0f", picture->exaggeration);
    for (int i = 0; i < 3; i++)
        fprintf(on->out, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n",
                SIDE / 2.0, SIDE / 2.0 + (i - 1) * LINE_HEIGHT + 4.5, line[i]);
}

void fracas_picture_write(const fracas_picture *picture, bool standalone, FILE *out)
{
    const fracas_ring_pattern *pattern = &picture->pattern;
    canvas on = {.picture = picture, .out = out, .scale = pixels_per_metre(picture)};
    fracas_svg_begin(picture->title, SIDE, SIDE, standalone, out);
    fprintf(
        out,
        "<circle class=\"axis\" stroke-dasharray=\"4 3\" cx=\"%.1f\" cy=\"%.1f\" r=\"%.2f\"/>\n",
        SIDE / 2.0, SIDE / 2.0, pattern->radius * on.scale);
    for (size_t i = 0; i < pattern->n; i++)
        if (isfinite(pattern->piece[i].displacement)) draw_piece(&on, i);
    for (size_t i = 0; i < pattern->n; i++) {
        const fracas_ring_piece *piece = &pattern->piece[i];
        if (!isfinite(piece->displacement)) continue;
        if (piece->dust) draw_dust(&on, piece);
        else if (picture->arrows) draw_arrow(&on, piece);
    }
    draw_words(&on);
    fputs("</svg>\n", out);
}

void fracas_picture_csv(const fracas_picture *picture, FILE *out)
{
    fputs("fragment,dust,size,half_angle,angle,distance,displacement,drawn_displacement,velocity_"
          "radial,velocity_circumferential,relative_radial,relative_circumferential\n",
          out);
    for (size_t i = 0; i < picture->pattern.n; i++) {
        const fracas_ring_piece *piece = &picture->pattern.piece[i];
        const double real[] = {piece->size,         piece->half_angle,
                               piece->angle,        piece->distance,
                               piece->displacement, picture->exaggeration * piece->displacement,
                               piece->velocity[0],  piece->velocity[1],
                               piece->relative[0],  piece->relative[1]};
        fprintf(out, "%zu,%d", piece->fragment, piece->dust != 0);
        for (size_t c = 0; c < sizeof real / sizeof *real; c++) fracas_csv_real(real[c], out);
        putc('\n', out);
    }
}
