/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/err.h"

#include "base/text.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The one mutable object outside the callers' storage, as errno is. A message belongs to the thread
 * of its failure and lives until the next failure there. */
static _Thread_local char message[23 << 10];
enum { LINE = 1024 }; /* bytes of one failure */

fracas_err fracas_fail(fracas_err code, const char *format, ...)
{
    char text[LINE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fracas_text_show(text, message, LINE);
    return code;
}

fracas_err fracas_fail_also(fracas_err code, const char *text)
{
    const size_t used = strlen(message), room = sizeof message - used;
    snprintf(message + used, room, "\n%s", text);
    return code;
}

fracas_err fracas_fail_within(fracas_err code, const char *format, ...)
{
    char context[LINE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context, sizeof context, format, arguments);
    va_end(arguments);
    return fracas_fail(code, "%s: %s", context, message);
}

const char *fracas_remedy(int reason)
{
    switch (reason) {
    case ENOSPC:
        return "; free some space (or files, if `df -i` says that those ran out) and run again";
    case EDQUOT:
        return "; your quota on that disk is used up (`quota -s`): free some space, or ask for "
               "more, and run again";
    case EFBIG: return "; raise the limit on the size of files (`ulimit -f`) and run again";
    case EMFILE: return "; raise the limit on open files (`ulimit -n`) and run again";
    case ENFILE:
        return "; this machine has no more files to open: end other programs, or raise "
               "fs.file-max, and run again";
    case EIO:
        return "; the disk reports a fault: look at `dmesg`, copy the study to a sound one, and "
               "run again there";
    case EROFS:
        return "; mount it to be written (`dmesg` says if a fault has made it read-only), or copy "
               "the study to where you may write";
    case EACCES:
    case EPERM: return "; make it accessible to you, or copy the study to where you may write";
    case ENOMEM: return "; free some memory, or use fewer --jobs, and run again";
    case EAGAIN:
        return "; raise the limits on processes (`ulimit -u`), or use fewer --jobs, and run again";
    case ELOOP:
        return "; nothing is written through links: remove it, or put in its place what it leads "
               "to";
    case ENXIO: return "; move it away";
    case ESTALE:
        return "; the network filesystem has lost it: look whether it is mounted, and run again";
    default: return "";
    }
}

/* A link or a pipe in the place of a file is no fault of the system, whose words for it are about
 * other things. */
static const char *what_is_there(int reason)
{
    switch (reason) {
    case ELOOP: return "it is a symbolic link";
    case ENXIO: return "it is a pipe, a socket or a device, and no file";
    default: return NULL;
    }
}

fracas_err fracas_fail_system(int reason, const char *format, ...)
{
    char text[LINE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const char *there = what_is_there(reason);
    return fracas_fail(there ? FRACAS_DAMAGED : FRACAS_ENVIRONMENT, "%s: %s%s", text,
                       there ? there : strerror(reason), fracas_remedy(reason));
}

fracas_err fracas_no_memory(const char *what)
{
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "no memory for %s; free some, or use fewer --jobs or elements", what);
}

fracas_err fracas_grow(void *array, size_t size, size_t count, size_t *room, const char *what)
{
    void *rows;
    if (count < *room) return FRACAS_OK;
    memcpy(&rows, array, sizeof rows);
    const size_t more = 2 * *room + 16;
    rows = realloc(rows, more * size);
    if (!rows) return fracas_no_memory(what);
    memcpy(array, &rows, sizeof rows);
    *room = more;
    return FRACAS_OK;
}

fracas_err fracas_path(char **path, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const int length = vasprintf(path, format, arguments);
    va_end(arguments);
    if (length >= 0) return FRACAS_OK;
    *path = NULL;
    return fracas_no_memory("a file name");
}

const char *fracas_message(void)
{
    return message;
}
