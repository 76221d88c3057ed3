/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/status/progress.h"

#include "base/terminal.h"
#include "base/text.h"
#include "campaigns/scheduler/types/clock.h"

#include <math.h>
#include <unistd.h>

static const double terminal_interval = 0.2, plain_interval = 5; /* s */

void fracas_progress_init(fracas_progress *progress, FILE *out)
{
    *progress = (fracas_progress){.out = out, .terminal = fracas_terminal_of(fileno(out)).draws};
}

/* The rate counts computed realizations, since done ones come a segment at a time. The time left
 * follows from predicted work, since the longest come first. */
static void describe(const fracas_progress *progress, char *text, size_t size)
{
    const fracas_counts *now = &progress->last, *first = &progress->first;
    const double elapsed = fracas_now() - progress->began;
    const double computed = (double)(now->done + now->memory + now->failed - first->done -
                                     first->memory - first->failed);
    const bool any = computed > 0 && elapsed > 0;
    fracas_counts_describe(
        now, progress->terminal, any ? computed / elapsed : 0,
        any && now->work > 0 && now->work < 1 ? elapsed * (1 - now->work) / now->work : NAN, text,
        size);
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
        char bar[FRACAS_BAR + 1];
        fracas_bar_draw(now->done + now->memory + now->failed, now->total, bar);
        char line[sizeof bar + sizeof text + 4];
        snprintf(line, sizeof line, "[%s] %s", bar, text);
        /* Cut to the terminal, since a wrapped line cannot be updated; erases the rest of a longer
         * line. */
        fprintf(progress->out, "\r%.*s\033[K",
                fracas_terminal_of(fileno(progress->out)).columns - 1, line);
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
    if (progress->quiet) return;
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
    if (!progress->any || progress->quiet) return;
    show(progress);
    if (progress->bar) fprintf(progress->out, "\n");
    progress->bar = false;
}
