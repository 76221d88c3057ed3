/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Tables and paragraphs on terminals narrower than they are; a terminal and its refusals. */
#include "base/json.h"
#include "base/sheet.h"
#include "base/terminal.h"
#include "base/text.h"
#include "tests/support/test.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static char *said;
static size_t size;

static FILE *begin(void)
{
    free(said);
    said = NULL;
    FILE *out = open_memstream(&said, &size);
    assert_non_null(out);
    return out;
}

#define SAYS(out, text)                  \
    do {                                 \
        fclose(out);                     \
        assert_string_equal(said, text); \
    } while (0)

static const char *const cells[] = {"rate",  "count", "size", "outcomes",          /**/
                                    "1e4",   "12",    "3.5",  "all of them broke", /**/
                                    "100e4", "1",     "0.35", ""};

static const char *cell(const void *of, size_t row, size_t column)
{
    return ((const char *const *)of)[4 * row + column];
}

static const char *gap(const void *of, size_t column)
{
    (void)of;
    return column ? "  " : "";
}

static void a_table_has_parts_where_it_is_too_wide(void **unused)
{
    const fracas_sheet sheet = {.rows = 3,
                                .columns = 4,
                                .keys = 1,
                                .left = 8,
                                .indent = ".",
                                .cell = cell,
                                .gap = gap,
                                .of = cells};
    FILE *out = begin();
    fracas_sheet_print(&sheet, 0, out);
    SAYS(out, ". rate  count  size  outcomes\n"
              ".  1e4     12   3.5  all of them broke\n"
              ".100e4      1  0.35\n");
    out = begin();
    fracas_sheet_print(&sheet, 38, out); /* one column of the terminal stays free */
    SAYS(out, ". rate  count  size\n.  1e4     12   3.5\n.100e4      1  0.35\n\n"
              ". rate  outcomes\n.  1e4  all of them broke\n.100e4\n");
    out = begin();
    fracas_sheet_print(&sheet, 39, out);
    SAYS(out, ". rate  count  size  outcomes\n"
              ".  1e4     12   3.5  all of them broke\n"
              ".100e4      1  0.35\n");
    out = begin();
    fracas_sheet_print(&sheet, 16, out);
    SAYS(out, ". rate  count\n.  1e4     12\n.100e4      1\n\n"
              ". rate  size\n.  1e4   3.5\n.100e4  0.35\n\n"
              ". rate  outcomes\n.  1e4  all of\n        them\n        broke\n.100e4\n");
}

static void a_text_is_broken_at_spaces(void **unused)
{
    static const char *const legend[] = {"one two", "three", NULL};
    FILE *out = begin();
    fracas_text_wrap("one two three four", 2, 11, out);
    SAYS(out, "one two\n  three\n  four\n");
    out = begin();
    fracas_text_wrap("unbreakable word", 0, 5, out);
    SAYS(out, "unbreakable\nword\n");
    out = begin();
    fracas_text_wrap("one two", 4, 0, out);
    SAYS(out, "one two\n");
    out = begin();
    fracas_sheet_legend(legend, 0, out);
    SAYS(out, "one two\nthree\n");
    out = begin();
    fracas_sheet_legend(legend, 20, out);
    SAYS(out, "one two three\n");
    out = begin();
    fracas_sheet_warning("raise the end", 17, out);
    SAYS(out, "warning: raise\n         the end\n");
}

static void json_fits_in_a_line(void **unused)
{
    fracas_json json;
    FILE *out = begin();
    fracas_json_begin(&json, out);
    json.line = true;
    fracas_json_array(&json, "a");
    fracas_json_integer(&json, NULL, 1);
    fracas_json_integer(&json, NULL, 2);
    fracas_json_end(&json);
    SAYS(out, "{\"a\": [1,2]}\n");
}

static void a_terminal_says_what_it_takes(void **unused)
{
    const int master = posix_openpt(O_RDWR | O_NOCTTY);
    assert_true(master >= 0 && !grantpt(master) && !unlockpt(master));
    const int fd = open(ptsname(master), O_RDWR | O_NOCTTY), null = open("/dev/null", O_WRONLY);
    unsetenv("NO_COLOR");
    setenv("TERM", "xterm", 1);
    fracas_terminal found = fracas_terminal_of(fd);
    assert_true(found.draws && found.colour && found.columns == 80 && found.rows == 24);
    setenv("NO_COLOR", "", 1);
    assert_true(fracas_terminal_of(fd).colour);
    setenv("NO_COLOR", "1", 1);
    found = fracas_terminal_of(fd);
    assert_true(found.draws && !found.colour);
    unsetenv("NO_COLOR");
    setenv("TERM", "dumb", 1);
    found = fracas_terminal_of(fd);
    assert_true(!found.draws && !found.colour && found.columns == 80);
    found = fracas_terminal_of(null);
    assert_true(!found.draws && !found.colour && found.columns == 0);
    assert_string_equal(fracas_colour_code(false, FRACAS_RED), "");
    assert_string_equal(fracas_colour_code(true, FRACAS_RED), "\033[31m");
    close(null);
    close(fd);
    close(master);
    free(said);
}

TESTS(a_table_has_parts_where_it_is_too_wide, a_text_is_broken_at_spaces, json_fits_in_a_line,
      a_terminal_says_what_it_takes)
