/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "analysis/data/text.h"

#include "base/text.h"

#include <stdarg.h>
#include <string.h>

void fracas_append(char *text, size_t size, const char *separator, const char *format, ...)
{
    size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    if (used > 0) used += (size_t)snprintf(text + used, size - used, "%s", separator);
    if (used < size) vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

static void put_escaped(const char *text, FILE *out)
{
    while (*text) {
        char shown[FRACAS_TEXT_SHOWN];
        text += fracas_text_show_character(text, shown);
        switch (*shown) {
        case '&': fputs("&amp;", out); break;
        case '<': fputs("&lt;", out); break;
        case '>': fputs("&gt;", out); break;
        case '"': fputs("&quot;", out); break;
        default: fputs(shown, out);
        }
    }
}

void fracas_markup(FILE *out, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    for (const char *at; (at = strstr(format, "%s")); format = at + 2) {
        fwrite(format, 1, (size_t)(at - format), out);
        put_escaped(va_arg(arguments, const char *), out);
    }
    fputs(format, out);
    va_end(arguments);
}
