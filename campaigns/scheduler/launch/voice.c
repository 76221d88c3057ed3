/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/launch/voice.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

static const char mark[] = "@fracas ";

static void replace(char *text, char from, char to)
{
    for (; *text; text++)
        if (*text == from) *text = to;
}

void fracas_voice_init(fracas_voice *voice)
{
    voice->parent = getenv(FRACAS_PARENT_MARK) != NULL;
    fracas_progress_init(&voice->progress, stderr);
}

void fracas_voice_progress(fracas_voice *voice, const fracas_scheduler_counts *counts)
{
    if (!voice->parent) {
        fracas_progress_update(&voice->progress, counts);
        return;
    }
    printf("%sprogress %lld %lld %lld %lld %.9g\n", mark, (long long)counts->total,
           (long long)counts->done, (long long)counts->memory, (long long)counts->failed,
           counts->work);
    fflush(stdout);
}

void fracas_voice_say(fracas_voice *voice, const char *format, ...)
{
    char text[2048];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (size_t end = strlen(text); end > 0 && text[end - 1] == '\n'; end--) text[end - 1] = '\0';
    if (!voice->parent) {
        fracas_progress_say(&voice->progress, text);
        return;
    }
    replace(text, '\n', '\v');
    printf("%ssay %s\n", mark, text);
    fflush(stdout);
}

void fracas_voice_end(fracas_voice *voice, fracas_err err, bool ran)
{
    if (!voice->parent) {
        fracas_progress_end(&voice->progress);
        return;
    }
    char text[1024];
    snprintf(text, sizeof text, "%s", err ? fracas_message() : "");
    replace(text, '\n', '\v');
    printf("%send %d %d %s\n", mark, err, ran, text);
    fflush(stdout);
}

bool fracas_voice_hear(char *line, fracas_progress *progress, fracas_verdict *verdict)
{
    if (strncmp(line, mark, strlen(mark))) return false;
    line += strlen(mark);
    long long total, done, memory, failed;
    double work;
    int code, ran, text = 0;
    if (sscanf(line, "progress %lld %lld %lld %lld %lg", &total, &done, &memory, &failed, &work) ==
        5) {
        fracas_progress_update(progress,
                               &(fracas_scheduler_counts){total, done, memory, failed, work});
    } else if (!strncmp(line, "say ", 4)) {
        replace(line, '\v', '\n');
        fracas_progress_say(progress, line + 4);
    } else if (sscanf(line, "end %d %d%n", &code, &ran, &text) == 2 && text) {
        replace(line, '\v', '\n');
        *verdict = (fracas_verdict){.ended = true, .ran = ran != 0, .err = (fracas_err)code};
        snprintf(verdict->text, sizeof verdict->text, "%s",
                 line[text] == ' ' ? line + text + 1 : "");
    }
    return true;
}
