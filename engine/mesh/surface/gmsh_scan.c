/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/mesh/surface/gmsh_scan.h"

#include "base/units.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

fracas_err fracas_gmsh_fail(const fracas_gmsh_scan *scan, const char *format, ...)
{
    char what[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    if (scan->is_binary) return fracas_fail(FRACAS_USAGE, "byte %zu: %s", scan->at, what);
    size_t line = 1;
    for (size_t i = 0; i < scan->at; i++) line += scan->text[i] == '\n';
    return fracas_fail(FRACAS_USAGE, "line %zu: %s", line, what);
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool fracas_gmsh_at_end(fracas_gmsh_scan *scan)
{
    while (scan->at < scan->size && is_blank(scan->text[scan->at])) scan->at++;
    return scan->at == scan->size;
}

fracas_err fracas_gmsh_word(fracas_gmsh_scan *scan, char word[FRACAS_GMSH_WORD])
{
    if (fracas_gmsh_at_end(scan))
        return fracas_gmsh_fail(scan, "the file ends here, in the middle of a section");
    size_t length = 0;
    while (scan->at + length < scan->size && !is_blank(scan->text[scan->at + length])) {
        const char c = scan->text[scan->at + length];
        if (c < ' ' || c > '~')
            return fracas_gmsh_fail(scan, "a byte that is no text, %d", (unsigned char)c);
        word[length++] = c;
        if (length == FRACAS_GMSH_WORD) {
            word[20] = '\0';
            return fracas_gmsh_fail(scan, "`%s...` is no word of a mesh", word);
        }
    }
    word[length] = '\0';
    scan->at += length;
    return FRACAS_OK;
}

fracas_err fracas_gmsh_expect(fracas_gmsh_scan *scan, const char *expected)
{
    char word[FRACAS_GMSH_WORD];
    TRY(fracas_gmsh_word(scan, word));
    if (strcmp(word, expected) == 0) return FRACAS_OK;
    return fracas_gmsh_fail(scan, "expected %s, not `%s`", expected, word);
}

fracas_err fracas_gmsh_line_end(fracas_gmsh_scan *scan)
{
    while (scan->at < scan->size && scan->text[scan->at] != '\n' && is_blank(scan->text[scan->at]))
        scan->at++;
    if (scan->at == scan->size || scan->text[scan->at] != '\n')
        return fracas_gmsh_fail(scan, "expected the end of the line");
    scan->at++;
    return FRACAS_OK;
}

fracas_err fracas_gmsh_skip(fracas_gmsh_scan *scan, const char *name)
{
    char end[FRACAS_GMSH_WORD + 8];
    snprintf(end, sizeof end, "$End%s", name);
    const char *from = scan->text + scan->at;
    const char *found = memmem(from, scan->size - scan->at, end, strlen(end));
    if (!found)
        return fracas_gmsh_fail(scan, "section $%s has no %s: the file is cut short", name, end);
    scan->at += (size_t)(found - from) + strlen(end);
    return FRACAS_OK;
}

/* The next `size` bytes of a binary file, in the byte order of this machine. */
static fracas_err read_bytes(fracas_gmsh_scan *scan, size_t size, void *value)
{
    if (scan->size - scan->at < size) return fracas_gmsh_fail(scan, "the file is cut short");
    unsigned char bytes[8];
    for (size_t i = 0; i < size; i++)
        bytes[i] = (unsigned char)scan->text[scan->at + (scan->is_swapped ? size - 1 - i : i)];
    memcpy(value, bytes, size);
    scan->at += size;
    return FRACAS_OK;
}

/* False if the word is no whole number of 64 bits. */
static bool parse_integer(const char *word, int64_t *value)
{
    const bool is_negative = *word == '-';
    int64_t sum = 0;
    word += is_negative;
    if (*word == '\0') return false;
    for (; *word; word++) {
        if (*word < '0' || *word > '9' || __builtin_mul_overflow(sum, 10, &sum) ||
            __builtin_add_overflow(sum, *word - '0', &sum))
            return false;
    }
    *value = is_negative ? -sum : sum;
    return true;
}

fracas_err fracas_gmsh_integer(fracas_gmsh_scan *scan, size_t bytes, int64_t *value)
{
    if (scan->is_binary && bytes == 8) return read_bytes(scan, 8, value);
    if (scan->is_binary) {
        int32_t narrow = 0;
        TRY(read_bytes(scan, 4, &narrow));
        *value = narrow;
        return FRACAS_OK;
    }
    char word[FRACAS_GMSH_WORD];
    TRY(fracas_gmsh_word(scan, word));
    if (parse_integer(word, value) && (bytes == 8 || (*value >= INT32_MIN && *value <= INT32_MAX)))
        return FRACAS_OK;
    return fracas_gmsh_fail(scan, "`%s` is not a whole number of %zu bits", word, 8 * bytes);
}

fracas_err fracas_gmsh_ints(fracas_gmsh_scan *scan, size_t count, int32_t *value)
{
    for (size_t i = 0; i < count; i++) {
        int64_t wide;
        TRY(fracas_gmsh_integer(scan, 4, &wide));
        value[i] = (int32_t)wide;
    }
    return FRACAS_OK;
}

/* Fortran writes 1.0D-03. */
static bool parse_real(const char *word, double *value)
{
    char plain[FRACAS_GMSH_WORD];
    size_t i = 0;
    for (; word[i]; i++) plain[i] = word[i] == 'D' || word[i] == 'd' ? 'e' : word[i];
    plain[i] = '\0';
    return !fracas_number_read(plain, value);
}

fracas_err fracas_gmsh_reals(fracas_gmsh_scan *scan, size_t count, double *value)
{
    char word[FRACAS_GMSH_WORD];
    for (size_t i = 0; i < count; i++) {
        if (scan->is_binary) {
            TRY(read_bytes(scan, 8, &value[i]));
            continue;
        }
        TRY(fracas_gmsh_word(scan, word));
        if (!parse_real(word, &value[i]))
            return fracas_gmsh_fail(scan, "`%s` is not a number%s", word,
                                    strchr(word, ',') ? ": decimals follow a point" : "");
    }
    return FRACAS_OK;
}

fracas_err fracas_gmsh_fits(const fracas_gmsh_scan *scan, int64_t count, size_t numbers)
{
    const size_t least = numbers * (scan->is_binary ? 4 : 2); /* bytes: a digit and a blank */
    if (count >= 0 && (size_t)count <= (scan->size - scan->at) / least) return FRACAS_OK;
    return fracas_gmsh_fail(
        scan, "a count of %" PRId64 " things, which the rest of the file cannot hold", count);
}
