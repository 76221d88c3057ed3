/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study that is being computed, as a map on a terminal: a line a point with the running mean of
 * its fragments and a character a replica, or a few of them. Elsewhere a line a look. */
#include "cli/look.h"

#include "analysis/data/columns.h"
#include "analysis/data/format.h"
#include "base/terminal.h"
#include "base/text.h"
#include "campaigns/scheduler/status/describe.h"
#include "campaigns/store/lock.h"

#include <inttypes.h>
#include <math.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* ---- lines of a frame, none wider than the terminal ---- */

typedef struct {
    FILE *out;
    fracas_terminal terminal;
    int at, lines; /* characters of this line; lines so far */
} canvas;

static FRACAS_PRINTF(3, 4) void put(canvas *on, fracas_colour colour, const char *format, ...)
{
    char text[1024], shown[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fracas_text_show(text, shown, sizeof shown);
    fputs(fracas_colour_code(on->terminal.colour && colour, colour), on->out);
    for (const char *c = shown; *c && on->at < on->terminal.columns - 1; on->at++) {
        int32_t code;
        const size_t length = fracas_text_character(c, &code);
        fwrite(c, 1, length, on->out);
        c += length;
    }
    fputs(fracas_colour_code(on->terminal.colour && colour, FRACAS_PLAIN), on->out);
}

static void end_line(canvas *on)
{
    fputs("\033[K\n", on->out);
    on->at = 0;
    on->lines++;
}

static void pad(canvas *on, int to)
{
    while (on->at < to && on->at < on->terminal.columns - 1) put(on, FRACAS_PLAIN, " ");
}

/* ---- the map ---- */

enum { WHOLE, PARTLY, COMPUTING, BROKEN, PLANNED, KINDS };
static const struct {
    char letter;
    fracas_colour colour;
    const char *doc;
} kind[KINDS] = {{'#', FRACAS_GREEN, "done"},
                 {'+', FRACAS_YELLOW, "partly"},
                 {'o', FRACAS_CYAN, "computing"},
                 {'!', FRACAS_RED, "FAILED"},
                 {'.', FRACAS_DIM, "to come"}};

/* The kind of `count` replicas side by side. */
static int kind_of(const fracas_row_status *state, size_t count)
{
    size_t done = 0, leased = 0;
    for (size_t i = 0; i < count; i++) {
        if (state[i] == FRACAS_FAILED_ROW || state[i] == FRACAS_QUARANTINED) return BROKEN;
        done += state[i] == FRACAS_DONE;
        leased += state[i] == FRACAS_LEASED;
    }
    return done == count ? WHOLE : leased ? COMPUTING : done ? PARTLY : PLANNED;
}

static void put_cells(canvas *on, const fracas_unfinished *running, size_t p, size_t each)
{
    const fracas_unfinished_point *point = &running->point[p];
    const size_t replicas = (size_t)point->counts.realizations;
    for (size_t r = 0; r < replicas; r += each) {
        const size_t left = replicas - r;
        const int is = kind_of(running->state + point->first + r, left < each ? left : each);
        put(on, kind[is].colour, "%c", kind[is].letter);
    }
}

/* Where the columns of the map begin, and how many replicas a character stands for. */
typedef struct {
    int mean, relative, done, cells;
    size_t each;
} layout;

static layout lay_out(const fracas_look *look, const fracas_columns *columns, int width)
{
    enum { NUMBER = 8, MEAN = 17, RELATIVE = 8, DONE = 12, LEAST = 10, GAP = 2 };
    int label = 5;
    size_t most = 1;
    for (size_t p = 0; p < look->running.npoints; p++) {
        char text[256];
        fracas_columns_label(&look->campaign->table, columns, p, text, sizeof text);
        const int length = (int)strlen(text) + 4;
        const size_t replicas = (size_t)look->running.point[p].counts.realizations;
        label = length > label ? length : label;
        most = replicas > most ? replicas : most;
    }
    const int room = width - MEAN - RELATIVE - DONE - LEAST - GAP;
    if (label > room) label = room > NUMBER ? room : NUMBER;
    const layout l = {label + GAP, label + GAP + MEAN, label + GAP + MEAN + RELATIVE,
                      label + GAP + MEAN + RELATIVE + DONE, 0};
    const size_t cells = (size_t)(width - 1 - l.cells > LEAST ? width - 1 - l.cells : LEAST);
    return (layout){l.mean, l.relative, l.done, l.cells, (most + cells - 1) / cells};
}

static void put_head(canvas *on, const layout *l)
{
    put(on, FRACAS_BOLD, "point");
    pad(on, l->mean);
    put(on, FRACAS_BOLD, "fragments");
    pad(on, l->relative);
    put(on, FRACAS_BOLD, "+- [%%]");
    pad(on, l->done);
    put(on, FRACAS_BOLD, "done");
    pad(on, l->cells);
    if (l->each > 1) put(on, FRACAS_BOLD, "replicas, %zu each", l->each);
    else put(on, FRACAS_BOLD, "replicas");
    end_line(on);
}

static void put_point(canvas *on, const fracas_look *look, const fracas_columns *columns,
                      const layout *l, size_t p)
{
    const fracas_unfinished_point *point = &look->running.point[p];
    char label[256], mean[64];
    fracas_columns_label(&look->campaign->table, columns, p, label, sizeof label);
    fracas_format_estimate(&point->count, 1, "+-", mean, sizeof mean);
    put(on, FRACAS_PLAIN, "%zu %.*s", p, l->mean - 5, label);
    pad(on, l->mean);
    put(on, FRACAS_PLAIN, "%.16s", mean);
    pad(on, l->relative);
    put(on, FRACAS_PLAIN, "%.6s",
        fracas_digits(100 * point->count.half_width / point->count.mean, 2).text);
    pad(on, l->done);
    put(on, FRACAS_PLAIN, "%" PRId64 "/%" PRId64, point->counts.done, point->counts.realizations);
    pad(on, l->cells);
    put_cells(on, &look->running, p, l->each);
    end_line(on);
}

static bool is_over(const fracas_unfinished_point *point)
{
    return fracas_index_missing(&point->counts) == 0;
}

/* All points where there is room for them; else those that are not computed come before others. */
static fracas_err put_map(canvas *on, const fracas_look *look, int room)
{
    const size_t points = look->running.npoints;
    FRACAS_CLEARED(fracas_columns) columns = {0};
    TRY(fracas_columns_create(&look->campaign->table, &columns));
    const layout l = lay_out(look, &columns, on->terminal.columns);
    size_t open = 0, place = (size_t)(room > 3 ? room - 2 : 1);
    for (size_t p = 0; p < points; p++) open += !is_over(&look->running.point[p]);
    if (place > points) place = points;
    size_t closed = place > open ? place - open : 0, left = place;
    put_head(on, &l);
    for (size_t p = 0; p < points && left > 0; p++) {
        const bool over = is_over(&look->running.point[p]);
        if (over && closed == 0) continue;
        closed -= over;
        left--;
        put_point(on, look, &columns, &l, p);
    }
    if (place < points) {
        put(on, FRACAS_DIM, "and %zu more points; %zu of %zu are computed", points - place,
            points - open, points);
        end_line(on);
    }
    return FRACAS_OK;
}

/* ---- around the map ---- */

enum { SHOWN = 4 }; /* long realizations, failures */

static void put_long_ones(canvas *on, const fracas_look *look)
{
    for (size_t i = 0; i < look->nlong && i < SHOWN; i++) {
        const fracas_long_one *one = &look->long_one[i];
        put(on, FRACAS_CYAN, "point %zu replica %" PRId64 ": ", one->point, one->head.replica);
        put(on, FRACAS_PLAIN, "%.3g of at most %.3g us (%.0f %%), %.0f s ago", 1e6 * one->head.time,
            1e6 * one->head.end, 100 * one->head.time / one->head.end, one->age);
        end_line(on);
    }
    if (look->nlong > SHOWN) {
        put(on, FRACAS_DIM, "and %zu more that compute for long", look->nlong - SHOWN);
        end_line(on);
    }
}

typedef struct {
    canvas *on;
    int64_t said;
} failures;

static void put_failure(void *context, const fracas_index_row *row, const char *reason)
{
    failures *f = context;
    if (f->said++ >= SHOWN) return;
    put(f->on, FRACAS_RED, "FAILED point %zu replica %" PRId64 ": ", row->point, row->replica);
    put(f->on, FRACAS_PLAIN, "%s", reason);
    end_line(f->on);
}

static fracas_err put_failures(canvas *on, const fracas_look *look)
{
    failures f = {on, 0};
    if (look->running.all.failed)
        TRY(fracas_index_failures(look->index, &look->campaign->table, put_failure, &f));
    if (f.said > SHOWN) {
        put(on, FRACAS_DIM, "and %" PRId64 " more; `fracas status %s` names all", f.said - SHOWN,
            fracas_shell_path(look->study, NULL).text);
        end_line(on);
    }
    return FRACAS_OK;
}

static void put_state(canvas *on, const fracas_look *look)
{
    char state[FRACAS_STATE_TEXT], text[256], bar[FRACAS_BAR + 1];
    const fracas_counts counts = fracas_look_counts(look);
    put(on, FRACAS_BOLD, "%.400s", look->study);
    put(on, FRACAS_PLAIN, ": %.500s", fracas_look_state(look, state));
    if (*look->holder) put(on, FRACAS_DIM, ", %s", look->holder);
    end_line(on);
    fracas_bar_draw(counts.done + counts.failed, counts.total, bar);
    fracas_counts_describe(&counts, true, look->rate, look->left, text, sizeof text);
    put(on, counts.failed ? FRACAS_RED : FRACAS_GREEN, "[%s]", bar);
    put(on, FRACAS_PLAIN, " %s", text);
    if (look->running.all.leased)
        put(on, FRACAS_PLAIN, ", %" PRId64 " computing", look->running.all.leased);
    end_line(on);
    end_line(on);
}

static void put_legend(canvas *on, bool last)
{
    for (int k = 0; k < KINDS; k++) {
        put(on, kind[k].colour, "%c", kind[k].letter);
        put(on, FRACAS_DIM, " %s  ", kind[k].doc);
    }
    if (!last) put(on, FRACAS_DIM, "Ctrl-C ends watching");
    end_line(on);
}

static fracas_err put_frame(canvas *on, const fracas_look *look, bool last)
{
    const int64_t failed = look->running.all.failed;
    const int slow = look->nlong > SHOWN ? SHOWN + 1 : (int)look->nlong,
              lost = failed > SHOWN ? SHOWN + 1 : (int)failed;
    put_state(on, look);
    TRY(put_map(on, look, on->terminal.rows - 5 - slow - lost));
    put_long_ones(on, look);
    TRY(put_failures(on, look));
    put_legend(on, last);
    return FRACAS_OK;
}

/* ---- the terminal ---- */

static const char hide[] = "\033[?25l", show[] = "\033[?25h";

static void write_all(const char *text, size_t size)
{
    for (ssize_t n; size > 0; text += n, size -= (size_t)n)
        if ((n = write(STDOUT_FILENO, text, size)) <= 0) return;
}

/* The cursor comes back before the signal does what it does. */
static void restore(int number)
{
    write_all(show, strlen(show));
    signal(number, SIG_DFL);
    raise(number);
}

static void catch_signals(void)
{
    static const int each[] = {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) signal(each[i], restore);
}

/* Over the last frame; on a terminal that changed its size from the top. */
static void begin_frame(const fracas_watch_view *view, const canvas *on)
{
    fputs(hide, on->out);
    if (view->lines && (view->columns != on->terminal.columns || view->rows != on->terminal.rows))
        fputs("\033[H\033[2J", on->out);
    else if (view->lines) fprintf(on->out, "\033[%dA\r", view->lines);
}

static fracas_err draw(fracas_watch_view *view, fracas_terminal terminal, const fracas_look *look,
                       bool last)
{
    OWNED char *frame = NULL;
    size_t size;
    canvas on = {.out = open_memstream(&frame, &size), .terminal = terminal};
    if (!on.out) return fracas_no_memory("a map");
    catch_signals();
    begin_frame(view, &on);
    fracas_err err = put_frame(&on, look, last);
    fputs("\033[J", on.out);
    if (last || err) fputs(show, on.out);
    if (fclose(on.out) && !err) err = fracas_no_memory("a map");
    fflush(stdout);
    if (frame) write_all(frame, size);
    view->lines = on.lines;
    view->columns = terminal.columns;
    view->rows = terminal.rows;
    return err;
}

/* ---- a line ---- */

/* "mean count to 3.4 % or better at 11 of 12 points" */
static void print_precision(const fracas_unfinished *running)
{
    size_t known = 0;
    double worst = 0;
    for (size_t p = 0; p < running->npoints; p++) {
        const fracas_estimate *count = &running->point[p].count;
        const double part = count->half_width / count->mean;
        if (!(part >= 0)) continue;
        known++;
        worst = fmax(worst, part);
    }
    if (known)
        printf("; mean count to %s %% or better at %zu of %zu points",
               fracas_digits(100 * worst, 2).text, known, running->npoints);
}

static void print_line(const fracas_look *look)
{
    const time_t now = time(NULL);
    const fracas_counts counts = fracas_look_counts(look);
    struct tm utc;
    char clock[32], text[256], state[FRACAS_STATE_TEXT];
    strftime(clock, sizeof clock, "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &utc));
    fracas_counts_describe(&counts, false, look->rate, look->left, text, sizeof text);
    printf("%s %s", clock, text);
    if (look->running.all.leased) printf(", %" PRId64 " being computed", look->running.all.leased);
    print_precision(&look->running);
    for (size_t i = 0; i < look->nlong && i < SHOWN; i++)
        printf("; point %zu replica %" PRId64 " at %.0f %%", look->long_one[i].point,
               look->long_one[i].head.replica,
               100 * look->long_one[i].head.time / look->long_one[i].head.end);
    if (look->lock != FRACAS_LOCK_HELD) printf("; %s", fracas_look_state(look, state));
    putchar('\n');
}

fracas_err fracas_watch_show(void *context, const fracas_look *look, bool last)
{
    fracas_watch_view *view = context;
    const fracas_terminal terminal = fracas_terminal_of(STDOUT_FILENO);
    fracas_err err = FRACAS_OK;
    if (view->json) err = fracas_look_write_json(look, true, stdout);
    else if (terminal.draws) err = draw(view, terminal, look, last);
    else print_line(look);
    if (!err && view->prometheus) err = fracas_look_write_prometheus(look, view->prometheus);
    if (!err && fflush(stdout))
        err = fracas_fail(FRACAS_ENVIRONMENT, "the output could not be written; is the disk full?");
    return err;
}
