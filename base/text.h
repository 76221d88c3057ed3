/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text from files and folder names, as terminals and pages may show it. It can hold anything: bytes
 * outside UTF-8, control characters for a terminal, directions to turn words around.
 */
#ifndef FRACAS_BASE_TEXT_H
#define FRACAS_BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/* Number of bytes of the first character of `text`, which is not empty and ends with a NUL; *code:
 * its code point. A byte outside UTF-8 counts as one, with *code -1. */
size_t fracas_text_character(const char *text, int32_t *code);

/* True of -1, C0 but for tab and newline, DEL, C1, and bidirectional controls (U+202A to U+202E,
 * U+2066 to U+2069). */
bool fracas_text_is_hidden(int32_t code);

/* Writes the first character of `text` into `shown`, each byte of a hidden one as \xNN; returns its
 * number of bytes in `text`. */
enum { FRACAS_TEXT_SHOWN = 17 }; /* four bytes and a NUL */
size_t fracas_text_show_character(const char *text, char shown[FRACAS_TEXT_SHOWN]);

/* Writes `text` into `shown` with each byte of hidden characters as \xNN, cut to `size` bytes. */
void fracas_text_show(const char *text, char *shown, size_t size);

/* Prints a text and a line break, broken at spaces into lines of at most `columns` characters (0:
 * no limit). The first begins behind `indent` characters, the others with so many spaces. */
void fracas_text_wrap(const char *text, int indent, int columns, FILE *out);

/* A path as a word for a shell, to be pasted: FOLDER/NAME, FOLDER alone where `name` is NULL. As it
 * is where a shell takes it so, else in single quotes; with control characters or bytes outside
 * UTF-8 as $'...', which bash, zsh and ksh read. Empty if it is too long. */
enum { FRACAS_SHELL_TEXT = 16400 };
typedef struct {
    char text[FRACAS_SHELL_TEXT];
} fracas_shell_word;
fracas_shell_word fracas_shell_path(const char *folder, const char *name);

/* Replaces stdout by a stream with the same rule, until fclose(stdout).
 * Without memory stdout stays as it is. */
void fracas_text_guard_stdout(void);

#endif
