/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Text with anything in it: characters, hidden ones, messages, JSON, stdout. */
#include "base/text.h"

#include "base/err.h"
#include "base/json.h"
#include "tests/support/test.h"

#include <sys/wait.h>
#include <unistd.h>

static void characters_are_those_of_utf8(void **unused)
{
    static const struct {
        const char *text;
        size_t length;
        int32_t code;
    } of[] = {
        {"a", 1, 'a'},
        {"\u00e9x", 2, 0xe9},
        {"\u20acx", 3, 0x20ac},
        {"\U0001f600x", 4, 0x1f600},
        {"\xf4\x8f\xbf\xbf", 4, 0x10ffff},
        {"\x80", 1, -1},             /* no first byte */
        {"\xc3", 1, -1},             /* ends early */
        {"\xe2\x82", 1, -1},         /* the same */
        {"\xe2(", 1, -1},            /* no second byte */
        {"\xc0\xaf", 1, -1},         /* longer than it need be */
        {"\xe0\x80\xaf", 1, -1},     /* the same */
        {"\xf0\x80\x80\xaf", 1, -1}, /* the same */
        {"\xed\xa0\x80", 1, -1},     /* half of a pair of UTF-16 */
        {"\xf4\x90\x80\x80", 1, -1}, /* above the last */
        {"\xff", 1, -1},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        int32_t code;
        assert_int_equal(fracas_text_character(of[i].text, &code), of[i].length);
        assert_int_equal(code, of[i].code);
    }
}

/* The first and the last of each range, and their neighbours. */
static void hidden_are_controls_of_terminals_and_directions(void **unused)
{
    static const int32_t hidden[] = {-1,   0,    8,      11,     0x1f,   0x7f,
                                     0x80, 0x9f, 0x202a, 0x202e, 0x2066, 0x2069},
                         shown[] = {'\t', '\n', ' ', '~', 0xa0, 0x2029, 0x202f, 0x2065, 0x206a};
    for (size_t i = 0; i < sizeof hidden / sizeof *hidden; i++)
        assert_true(fracas_text_is_hidden(hidden[i]));
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++)
        assert_false(fracas_text_is_hidden(shown[i]));
}

static const char awkward[] = "a\x1b[2J\xc2\x9b\u202e\xff \u20ac\n\x7f";
static const char as_shown[] = "a\\x1b[2J\\xc2\\x9b\\xe2\\x80\\xae\\xff \u20ac\n\\x7f";

static void what_is_shown_drives_no_terminal(void **unused)
{
    char shown[64], cut[8];
    fracas_text_show(awkward, shown, sizeof shown);
    assert_string_equal(shown, as_shown);
    fracas_text_show(shown, cut, sizeof cut); /* no half of an escape */
    assert_string_equal(cut, "a\\x1b[2");
    fracas_text_show("\u20ac\u20ac\u20ac", cut, sizeof cut);
    assert_string_equal(cut, "\u20ac\u20ac");
    assert_int_equal(fracas_fail(FRACAS_USAGE, "%s", awkward), FRACAS_USAGE);
    assert_string_equal(fracas_message(), as_shown);
    assert_int_equal(fracas_fail_within(FRACAS_USAGE, "\x1b"), FRACAS_USAGE);
    assert_memory_equal(fracas_message(), "\\x1b: a\\x1b[2J", 14);
}

static void json_is_utf8_without_controls(void **unused)
{
    FILE *out = text_begin();
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "a", awkward);
    fracas_json_end(&json);
    OWNED char *text = text_end(out);
    assert_string_equal(
        text, "{\n  \"a\": \"a\\u001b[2J\\u009b\\u202e\\\\xff \u20ac\\u000a\\u007f\"\n}\n");
}

/* In a process of its own, since stdout is replaced. Characters come in any pieces. */
static void stdout_is_guarded(void **unused)
{
    int ends[2], status;
    assert_int_equal(pipe(ends), 0);
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        fracas_text_guard_stdout();
        for (const char *c = awkward; *c; c++) {
            putchar(*c);
            fflush(stdout);
        }
        fputs("\xe2\x82", stdout); /* an unfinished character */
        _exit(fclose(stdout) != 0);
    }
    close(ends[1]);
    char text[128] = "";
    size_t used = 0;
    for (ssize_t n; (n = read(ends[0], text + used, sizeof text - 1 - used)) > 0;)
        used += (size_t)n;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    assert_memory_equal(text, as_shown, strlen(as_shown));
    assert_string_equal(text + strlen(as_shown), "\\xe2\\x82");
}

TESTS(characters_are_those_of_utf8, hidden_are_controls_of_terminals_and_directions,
      what_is_shown_drives_no_terminal, json_is_utf8_without_controls, stdout_is_guarded)
