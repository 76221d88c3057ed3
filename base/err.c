#include "base/err.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The one mutable object outside the callers' storage, as errno is: a message belongs to the thread
 * that failed and lives until its next failure. */
static _Thread_local char message[1024];

fracas_err fracas_fail(fracas_err code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return code;
}

fracas_err fracas_fail_within(fracas_err code, const char *format, ...)
{
    char inner[sizeof message];
    memcpy(inner, message, sizeof inner);
    va_list arguments;
    va_start(arguments, format);
    int used = vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    if (used >= 0 && (size_t)used < sizeof message)
        snprintf(message + used, sizeof message - (size_t)used, ": %s", inner);
    return code;
}

fracas_err fracas_no_memory(const char *what)
{
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "no memory for %s; free some, or use fewer --jobs or elements", what);
}

const char *fracas_message(void)
{
    return message;
}
