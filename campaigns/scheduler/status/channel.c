/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/status/channel.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char mark[] = "@fracas ";

static void replace(char *text, char from, char to)
{
    for (; *text; text++)
        if (*text == from) *text = to;
}

void fracas_channel_init(fracas_channel *channel)
{
    *channel = (fracas_channel){.launcher = getenv(FRACAS_LAUNCHER_MARK) != NULL};
    fracas_progress_init(&channel->progress, stderr);
}

void fracas_channel_progress(fracas_channel *channel, const fracas_counts *counts)
{
    if (!channel->launcher) {
        fracas_progress_update(&channel->progress, counts);
        return;
    }
    dprintf(STDOUT_FILENO, "%sprogress %lld %lld %lld %lld %.9g\n", mark, (long long)counts->total,
            (long long)counts->done, (long long)counts->memory, (long long)counts->failed,
            counts->work);
}

void fracas_channel_message(fracas_channel *channel, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (size_t end = strlen(text); end > 0 && text[end - 1] == '\n'; end--) text[end - 1] = '\0';
    if (!channel->launcher) {
        fracas_progress_message(&channel->progress, text);
        return;
    }
    replace(text, '\n', '\v');
    dprintf(STDOUT_FILENO, "%ssay %s\n", mark, text);
}

void fracas_channel_end(fracas_channel *channel, fracas_err err, bool ran)
{
    if (!channel->launcher) {
        fracas_progress_end(&channel->progress);
        return;
    }
    char text[1024];
    snprintf(text, sizeof text, "%s", err ? fracas_message() : "");
    replace(text, '\n', '\v');
    dprintf(STDOUT_FILENO, "%send %d %d %d %s\n", mark, err, ran, channel->again, text);
}

bool fracas_channel_receive(char *line, fracas_progress *progress, fracas_ending *ending)
{
    if (strncmp(line, mark, strlen(mark))) return false;
    line += strlen(mark);
    long long total, done, memory, failed;
    double work;
    int code, ran, again, text = 0;
    if (sscanf(line, "progress %lld %lld %lld %lld %lg", &total, &done, &memory, &failed, &work) ==
        5) {
        fracas_progress_update(progress, &(fracas_counts){total, done, memory, failed, work});
    } else if (!strncmp(line, "say ", 4)) {
        replace(line, '\v', '\n');
        fracas_progress_message(progress, line + 4);
    } else if (sscanf(line, "end %d %d %d%n", &code, &ran, &again, &text) == 3) {
        replace(line, '\v', '\n');
        *ending = (fracas_ending){
            .ended = true, .ran = ran != 0, .again = again != 0, .err = (fracas_err)code};
        snprintf(ending->text, sizeof ending->text, "%s", line[text] == ' ' ? line + text + 1 : "");
    }
    return true;
}
