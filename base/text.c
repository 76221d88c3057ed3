/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/text.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

enum { NOT_UTF8 = -1, LONGEST = 4 }; /* bytes of a character */

/* Bytes of a character by its first one; 0: none begins so. */
static size_t length_by(unsigned char first)
{
    if (first < 0x80) return 1;
    if (first < 0xc2 || first > 0xf4) return 0;
    return first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
}

size_t fracas_text_character(const char *text, int32_t *code)
{
    static const int32_t least[LONGEST + 1] = {0, 0, 0x80, 0x800, 0x10000};
    const unsigned char first = (unsigned char)text[0];
    const size_t length = length_by(first);
    *code = length < 2 ? first : first & (0x7f >> length);
    for (size_t i = 1; i < length; i++) {
        const unsigned char next = (unsigned char)text[i];
        if ((next & 0xc0) != 0x80) {
            *code = NOT_UTF8;
            return 1;
        }
        *code = *code << 6 | (next & 0x3f);
    }
    const bool surrogate = *code >= 0xd800 && *code < 0xe000;
    if (length > 0 && *code >= least[length] && *code <= 0x10ffff && !surrogate) return length;
    *code = NOT_UTF8;
    return 1;
}

bool fracas_text_is_hidden(int32_t code)
{
    return (code < 0x20 && code != '\t' && code != '\n') || (code >= 0x7f && code < 0xa0) ||
           (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
}

size_t fracas_text_show_character(const char *text, char shown[FRACAS_TEXT_SHOWN])
{
    int32_t code;
    const size_t length = fracas_text_character(text, &code);
    const bool hidden = fracas_text_is_hidden(code);
    for (size_t i = 0; i < length; i++)
        shown += sprintf(shown, hidden ? "\\x%02x" : "%c", (unsigned char)text[i]);
    return length;
}

void fracas_text_show(const char *text, char *shown, size_t size)
{
    char character[FRACAS_TEXT_SHOWN];
    size_t used = 0;
    while (*text) {
        text += fracas_text_show_character(text, character);
        const size_t more = strlen(character);
        if (used + more >= size) break;
        memcpy(shown + used, character, more);
        used += more;
    }
    shown[used] = '\0';
}

/* How a word must be written for a shell. */
typedef enum { PLAIN, QUOTED, ESCAPED } manner;

static manner manner_of(const char *text)
{
    manner found = *text && *text != '~' ? PLAIN : QUOTED;
    int32_t code;
    for (; *text; text += fracas_text_character(text, &code)) {
        fracas_text_character(text, &code);
        if (fracas_text_is_hidden(code) || code == '\n' || code == '\t') return ESCAPED;
        if (code < 0x80 && !isalnum(code) && !strchr("_-./:,+@%=~", code)) found = QUOTED;
        if (code >= 0x80) found = QUOTED; /* blanks of Unicode among them */
    }
    return found;
}

/* The next bytes of a word: at most FRACAS_TEXT_SHOWN. */
static size_t put_byte(manner how, char byte, char *to)
{
    if (how == QUOTED && byte == '\'') return (size_t)sprintf(to, "'\\''");
    if (how == ESCAPED && (byte == '\'' || byte == '\\')) return (size_t)sprintf(to, "\\%c", byte);
    if (how == ESCAPED && byte == '\n') return (size_t)sprintf(to, "\\n");
    if (how == ESCAPED && (byte < 0x20 || byte == 0x7f))
        return (size_t)sprintf(to, "\\%03o", (unsigned char)byte);
    return (size_t)sprintf(to, "%c", byte);
}

fracas_shell_word fracas_shell_path(const char *folder, const char *name)
{
    fracas_shell_word word;
    char path[8192];
    static const char *const before[] = {"", "'", "$'"}, *const after[] = {"", "'", "'"};
    const int length = snprintf(path, sizeof path, "%s%s%s%s", *folder == '-' ? "./" : "", folder,
                                name ? "/" : "", name ? name : "");
    const manner how = manner_of(path);
    size_t at = (size_t)sprintf(word.text, "%s", before[how]);
    for (const char *c = path; *c && at < sizeof word.text - 8; c++)
        at += put_byte(how, *c, word.text + at);
    sprintf(word.text + at, "%s", after[how]);
    if ((size_t)length >= sizeof path || at >= sizeof word.text - 8) *word.text = '\0';
    return word;
}

void fracas_text_wrap(const char *text, int indent, int columns, FILE *out)
{
    int at = indent;
    for (bool first = true; *text; first = false) {
        const int length = (int)strcspn(text, " ");
        const bool breaks = !first && columns && at + 1 + length >= columns;
        if (breaks) fprintf(out, "\n%*s", indent, "");
        else if (!first) putc(' ', out);
        at = (breaks ? indent : at + !first) + length;
        fprintf(out, "%.*s", length, text);
        text += length;
        text += strspn(text, " ");
    }
    putc('\n', out);
}

/* ---- stdout ---- */

typedef struct {
    FILE *beneath;
    char begun[LONGEST + 1]; /* a character of which more bytes may come, and a NUL */
    size_t count;
} guard;

static void put_begun(guard *g)
{
    char shown[FRACAS_TEXT_SHOWN];
    for (size_t done = 0; done < g->count; fputs(shown, g->beneath))
        done += fracas_text_show_character(g->begun + done, shown);
    g->count = 0;
    memset(g->begun, 0, sizeof g->begun);
}

static ssize_t guard_write(void *cookie, const char *text, size_t size)
{
    guard *g = cookie;
    for (size_t i = 0; i < size; i++) {
        const unsigned char byte = (unsigned char)text[i];
        if (g->count > 0 && (byte & 0xc0) != 0x80) put_begun(g);
        if (byte >= 0x20 && byte < 0x7f) {
            putc(byte, g->beneath);
            continue;
        }
        g->begun[g->count++] = (char)byte;
        if (g->count >= length_by((unsigned char)g->begun[0])) put_begun(g);
    }
    return fflush(g->beneath) ? 0 : (ssize_t)size;
}

static int guard_close(void *cookie)
{
    guard *g = cookie;
    put_begun(g);
    const int status = fclose(g->beneath);
    free(g);
    return status;
}

void fracas_text_guard_stdout(void)
{
    const cookie_io_functions_t functions = {.write = guard_write, .close = guard_close};
    guard *g = calloc(1, sizeof *g);
    FILE *guarded = g ? fopencookie(g, "w", functions) : NULL;
    if (!guarded) {
        free(g);
        return;
    }
    g->beneath = stdout;
    if (isatty(STDOUT_FILENO)) setvbuf(guarded, NULL, _IOLBF, BUFSIZ);
    stdout = guarded;
}
