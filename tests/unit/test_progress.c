/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Progress on a terminal and in a file, and lines of the status channel. */
#include "campaigns/scheduler/status/channel.h"
#include "campaigns/scheduler/types/clock.h"
#include "base/param.h"
#include "tests/support/test.h"

#include <fcntl.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>

/* ---- a terminal of so many columns ---- */

static int master;
static fracas_progress progress;

static void open_terminal(unsigned short columns)
{
    const struct winsize size = {.ws_col = columns};
    master = posix_openpt(O_RDWR | O_NOCTTY);
    assert_true(master >= 0 && !grantpt(master) && !unlockpt(master));
    const int fd = open(ptsname(master), O_RDWR | O_NOCTTY);
    assert_true(fd >= 0);
    assert_int_equal(ioctl(fd, TIOCSWINSZ, &size), 0);
    fracas_progress_init(&progress, fdopen(fd, "w"));
    assert_true(progress.terminal);
}

/* The text since the last call; a new line is "\r\n" there. */
static const char *shown(void)
{
    static char text[4096];
    const ssize_t n = read(master, text, sizeof text - 1);
    text[n > 0 ? n : 0] = '\0';
    return text;
}

static void close_terminal(void)
{
    fclose(progress.out);
    close(master);
}

/* Counts that come so many seconds after the first, of which `done` are done then. */
static void come(double seconds, fracas_counts counts)
{
    fracas_progress_update(&progress, &(fracas_counts){.total = counts.total});
    progress.began = fracas_now() - seconds;
    progress.shown = -1e9;
    fracas_progress_update(&progress, &counts);
}

static void a_bar_is_as_long_as_what_is_computed(void **state)
{
    static const struct {
        double seconds;
        fracas_counts counts;
        const char *said;
    } each[] = {
        {100,
         {.total = 8, .done = 4, .work = 0.5},
         "\r[##########..........] 4/8 done, 0 failed, 0.04/s, 1:40 left\033[K"},
        {100,
         {.total = 8, .done = 2, .memory = 1, .failed = 1, .work = 1e-3},
         "\r[##########..........] 2/8 done, 1 more computed, 1 failed, 0.04/s, 27:45:00 "
         "left\033[K"},
        {100,
         {.total = 8, .done = 8, .work = 1},
         "\r[####################] 8/8 done, 0 failed, 0.08/s\033[K"},
        {100, {.total = 8}, "\r[....................] 0/8 done, 0 failed\033[K"},
        {100, {.total = 8, .done = 1}, "\r[##..................] 1/8 done, 0 failed, 0.01/s\033[K"},
        {-100,
         {.total = 8, .done = 4, .work = 0.5},
         "\r[##########..........] 4/8 done, 0 failed\033[K"},
        {100, {.total = 0}, "\r[####################] 0/0 done, 0 failed\033[K"},
    };
    for (size_t i = 0; i < FRACAS_COUNT(each); i++) {
        open_terminal(200);
        come(each[i].seconds, each[i].counts);
        assert_string_equal(shown(), each[i].said);
        close_terminal();
    }
}

static void a_bar_is_cut_to_the_terminal(void **state)
{
    static const fracas_counts half = {.total = 8, .done = 4, .work = 0.5};
    open_terminal(13);
    come(100, half);
    assert_string_equal(shown(), "\r[##########.\033[K");
    close_terminal();
    for (unsigned short columns = 0; columns < 2; columns++) { /* not known: 80 */
        open_terminal(columns);
        come(100, half);
        assert_string_equal(shown(),
                            "\r[##########..........] 4/8 done, 0 failed, 0.04/s, 1:40 left\033[K");
        close_terminal();
    }
}

static void a_message_takes_the_place_of_the_bar(void **state)
{
    open_terminal(80);
    fracas_progress_message(&progress, "first");
    assert_string_equal(shown(), "first\r\n");
    fracas_progress_end(&progress); /* nothing has come */
    come(-1, (fracas_counts){.total = 2, .done = 1});
    assert_has(shown(), "1/2 done");
    fracas_progress_update(&progress, &(fracas_counts){.total = 2, .done = 2}); /* too soon */
    fracas_progress_message(&progress, "second");
    assert_string_equal(shown(), "\r\033[Ksecond\r\n");
    fracas_progress_message(&progress, "third");
    assert_string_equal(shown(), "third\r\n");
    fracas_progress_end(&progress);
    assert_string_equal(shown(), "\r[####################] 2/2 done, 0 failed\033[K\r\n");
    close_terminal();
}

static void a_file_gets_lines(void **state)
{
    FILE *out = tmpfile();
    char line[200];
    fracas_progress_init(&progress, out);
    come(100, (fracas_counts){.total = 8, .done = 4, .memory = 1, .work = 0.5});
    fracas_progress_message(&progress, "a message");
    fracas_progress_end(&progress);
    rewind(out);
    assert_non_null(fgets(line, sizeof line, out));
    assert_string_equal(
        line,
        "4 of 8 realizations done, 1 more computed, not yet stored, 0 failed, 0.05/s, 1:40 left\n");
    assert_non_null(fgets(line, sizeof line, out));
    assert_string_equal(line, "a message\n");
    fclose(out);
}

/* ---- the status channel ---- */

static void a_channel_reads_its_own_lines(void **state)
{
    static const struct {
        const char *line;
        bool is_ours, ended, ran, again;
        fracas_err err;
        const char *text; /* of the ending */
    } each[] = {
        {"a line of MPI", false},
        {"@fracas nonsense", true},
        {"@fracas progress 1 2", true},
        {"@fracas end 4 1", true},
        {"@fracas end 4 1 0", true, true, true, false, (fracas_err)4, ""},
        {"@fracas end 6 0 1 two\vlines", true, true, false, true, (fracas_err)6, "two\nlines"},
    };
    FILE *out = tmpfile();
    fracas_progress_init(&progress, out);
    for (size_t i = 0; i < FRACAS_COUNT(each); i++) {
        char line[100];
        fracas_ending ending = {0};
        snprintf(line, sizeof line, "%s", each[i].line);
        assert_int_equal(fracas_channel_receive(line, &progress, &ending), each[i].is_ours);
        assert_int_equal(ending.ended, each[i].ended);
        assert_int_equal(ending.ran, each[i].ran);
        assert_int_equal(ending.again, each[i].again);
        assert_int_equal(ending.err, each[i].err);
        if (each[i].text) assert_string_equal(ending.text, each[i].text);
    }
    assert_int_equal(ftell(out), 0); /* none of them was to be shown */
    assert_false(progress.any);
    fclose(out);
}

/* The end of a text is no line of its own. */
static void a_message_is_one_line(void **state)
{
    FILE *out = tmpfile();
    char line[100];
    fracas_channel channel = {0};
    fracas_progress_init(&channel.progress, out);
    fracas_channel_message(&channel, "%s", "text\n\n");
    fracas_channel_message(&channel, "%s", "\n");
    rewind(out);
    assert_non_null(fgets(line, sizeof line, out));
    assert_string_equal(line, "text\n");
    assert_non_null(fgets(line, sizeof line, out));
    assert_string_equal(line, "\n");
    assert_null(fgets(line, sizeof line, out));
    fclose(out);
}

TESTS(a_bar_is_as_long_as_what_is_computed, a_bar_is_cut_to_the_terminal,
      a_message_takes_the_place_of_the_bar, a_file_gets_lines, a_channel_reads_its_own_lines,
      a_message_is_one_line)
