/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/status/progress.h"

#include "base/text.h"
#include "campaigns/scheduler/types/clock.h"

#include <math.h>
#include <sys/ioctl.h>
#include <unistd.h>

enum { BAR = 20 };
static const double terminal_interval = 0.2, plain_interval = 5; /* s */

void fracas_progress_init(fracas_progress *progress, FILE *out)
{
    *progress = (fracas_progress){.out = out, .terminal = isatty(fileno(out))};
}

/* "128 of 512 realizations done, 16 computed, 0 failed, 12.3/s, 0:31 left"; shorter on a terminal.
 * The rate counts computed realizations, since done ones come a segment at a time. The time left
 * follows from predicted work, since the longest come first. */
static void describe(const fracas_progress *progress, char *text, size_t size)
{
    const fracas_counts *now = &progress->last, *first = &progress->first;
    double elapsed = fracas_now() - progress->began;
    double computed = (double)(now->done + now->memory + now->failed - first->done - first->memory -
                               first->failed);
    int n = snprintf(text, size,
                     progress->terminal ? "%lld/%lld done" : "%lld of %lld realizations done",
                     (long long)now->done, (long long)now->total);
    if (now->memory)
        n += snprintf(text + n, size - (size_t)n, ", %lld computed", (long long)now->memory);
    n += snprintf(text + n, size - (size_t)n, ", %lld failed", (long long)now->failed);
    if (computed <= 0 || elapsed <= 0) return;
    n += snprintf(text + n, size - (size_t)n, ", %.3g/s", computed / elapsed);
    double seconds = now->work > 0 ? elapsed * (1 - now->work) / now->work : INFINITY;
    if (now->work < 1 && seconds < 1e8) {
        long long s = (long long)(seconds + 0.5);
        if (s >= 3600)
            snprintf(text + n, size - (size_t)n, ", %lld:%02lld:%02lld left", s / 3600, s / 60 % 60,
                     s % 60);
        else snprintf(text + n, size - (size_t)n, ", %lld:%02lld left", s / 60, s % 60);
    }
}

static int columns(FILE *terminal)
{
    struct winsize size;
    return !ioctl(fileno(terminal), TIOCGWINSZ, &size) && size.ws_col > 1 ? size.ws_col : 80;
}

static void show(fracas_progress *progress)
{
    char text[256];
    describe(progress, text, sizeof text);
    progress->shown = fracas_now();
    if (!progress->terminal) {
        fprintf(progress->out, "%s\n", text);
    } else {
        const fracas_counts *now = &progress->last;
        int full = now->total ? (int)(BAR * (now->done + now->memory + now->failed) / now->total)
                              : BAR;
        char bar[BAR + 1];
        for (int i = 0; i < BAR; i++) bar[i] = i < full ? '#' : '.';
        bar[BAR] = '\0';
        char line[sizeof bar + sizeof text + 4];
        snprintf(line, sizeof line, "[%s] %s", bar, text);
        /* Cut to the terminal, since a wrapped line cannot be updated; erases the rest of a longer
         * line. */
        fprintf(progress->out, "\r%.*s\033[K", columns(progress->out) - 1, line);
        progress->bar = true;
    }
    fflush(progress->out);
}

void fracas_progress_update(fracas_progress *progress, const fracas_counts *counts)
{
    progress->last = *counts;
    if (!progress->any) {
        progress->any = true;
        progress->first = *counts;
        progress->began = progress->shown = fracas_now();
    }
    if (fracas_now() - progress->shown >= (progress->terminal ? terminal_interval : plain_interval))
        show(progress);
}

void fracas_progress_message(fracas_progress *progress, const char *text)
{
    char shown[4096];
    fracas_text_show(text, shown, sizeof shown);
    fprintf(progress->out, "%s%s\n", progress->bar ? "\r\033[K" : "", shown);
    fflush(progress->out);
    progress->bar = false;
}

void fracas_progress_end(fracas_progress *progress)
{
    if (!progress->any) return;
    show(progress);
    if (progress->bar) fprintf(progress->out, "\n");
    progress->bar = false;
}
