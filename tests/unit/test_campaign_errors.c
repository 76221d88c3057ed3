/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a wrong campaign file is told: place, what was found, what is allowed, the nearest known
 * key. */
#include "campaigns/file/setting.h"
#include "tests/support/campaign_text.h"

typedef struct {
    char text[1 << 13];
    int lines;
} part;

/* A line more, with its escapes. */
static void append_line(part *to, const char *text)
{
    char *at = to->text + strlen(to->text);
    assert_true((size_t)(at - to->text) + strlen(text) + 2 < sizeof to->text);
    if (to->lines++) *at++ = '\n';
    unescape(strcpy(at, text));
}

/* The first line of *message is at `where`, "LINE:COLUMN word | word", and has the words. Moves on
 * to the next line; NULL: there is none. */
static void check_message(const char *path, const char *put, char *where, const char **message)
{
    char place[80], line[1024], *words = strchr(where, ' ');
    assert_non_null(words);
    *words++ = '\0';
    if (!*message) fail_msg("no message for %s of \"%s\": %s", where, put, fracas_message());
    snprintf(line, sizeof line, "%.*s", (int)strcspn(*message, "\n"), *message);
    snprintf(place, sizeof place, "%s:%s: ", path, where);
    if (strncmp(line, place, strlen(place)) != 0)
        fail_msg("expected %s for \"%s\": %s", where, put, fracas_message());
    for (char *end; words; words = end ? end + strlen(" | ") : NULL) {
        if ((end = strstr(words, " | "))) *end = '\0';
        assert_has(line, words);
    }
    const char *end = strchr(*message, '\n');
    *message = end ? end + 1 : NULL;
}

/* The whole message: `where`, and a line more for each "& " that follows in the file. */
static void check_messages(const char *path, const char *put, char *where, FILE *in)
{
    const char *message = fracas_message();
    char line[4096];
    check_message(path, put, where, &message);
    for (;;) {
        const long here = ftell(in);
        if (!fgets(line, sizeof line, in)) break;
        if (line[0] != '&') {
            assert_int_equal(fseek(in, here, SEEK_SET), 0);
            break;
        }
        line[strcspn(line, "\n")] = '\0';
        check_message(path, put, line + 2, &message);
    }
    if (message) fail_msg("more is said of \"%s\": %s", put, fracas_message());
}

/* Every record of tests/data/campaigns/wrong.txt, which says how it is written. */
static void test_wrong_files(void **state)
{
    FILE *in = fopen(FRACAS_SOURCE_DIR "/tests/data/campaigns/wrong.txt", "r");
    assert_non_null(in);
    char line[4096];
    part find = {0}, put = {0};
    char path[40], *base = strdup(plain_campaign);
    int records = 0;
    make_path(path);
    while (fgets(line, sizeof line, in)) {
        line[strcspn(line, "\n")] = '\0';
        const bool is_base = strncmp(line, "base", 4) == 0;
        if (line[0] == '-') append_line(&find, line + 2);
        else if (line[0] == '+') append_line(&put, line + 2);
        if (!is_base && !(line[0] >= '1' && line[0] <= '9')) continue;
        if (!find.lines && put.lines) append_line(&put, "");
        char *text = replace(is_base ? plain_campaign : base, find.text, put.text);
        if (is_base) {
            free(base);
            if (line[4]) free(text), text = campaign_file(line + 5);
            base = text;
        } else {
            fracas_campaign *campaign = NULL;
            write_bytes(path, text, strlen(text));
            if (fracas_campaign_read_with(*state, path, &campaign) != FRACAS_USAGE || campaign)
                fail_msg("accepted: %s", put.text);
            if (getenv("FRACAS_READ_ALOUD"))
                print_message("%s   (%s)\n", fracas_message() + strlen(path), line);
            check_messages(path, put.text, line, in);
            free(text);
            records++;
        }
        find = put = (part){0};
    }
    assert_int_equal(records, 321);
    free(base);
    unlink(path);
    fclose(in);
}

/* Twenty are printed, the others counted; all by line, whatever the order in which they are found.
 */
static void test_many_errors(void **state)
{
    char path[40], text[4096], expected[200];
    size_t used = 0;
    fracas_campaign *campaign = NULL;
    make_path(path);
    for (int i = 0; i < 24; i++)
        used += (size_t)snprintf(text + used, sizeof text - used, "key%c: 1\n", 'a' + i);
    snprintf(text + used, sizeof text - used, "%s", strstr(plain_campaign, "seed:"));
    write_bytes(path, text, strlen(text));
    assert_int_equal(fracas_campaign_read_with(*state, path, &campaign), FRACAS_USAGE);
    const char *line = fracas_message();
    snprintf(expected, sizeof expected, "%s:1:1: the file has no `name`", path); /* found later */
    assert_has(line, expected);
    for (int i = 0; i < 20; i++, line = strchr(line, '\n') + 1) {
        snprintf(expected, sizeof expected, "%s:%d:1: ", path, i < 2 ? 1 : i);
        if (strncmp(line, expected, strlen(expected)) != 0) fail_msg("%d: %s", i, line);
    }
    snprintf(expected, sizeof expected, "%s: and 5 more", path);
    assert_string_equal(line, expected);
    unlink(path);
}

/* Ranges with no lower limit. */
static void test_any_number(void **state)
{
    fracas_param any = {.name = "v", .unit = "m/s", .minimum = -INFINITY, .maximum = INFINITY},
                 low = any;
    low.maximum = 5;
    const fracas_leaf leaf = {.path = "a.v", .key = "v", .param = &any};
    const fracas_node node = {.text = "6", .line = 2, .column = 3};
    const fracas_file file = {.name = "f"};
    for (double value = -1e100; value <= 1e100; value += 1e100)
        OK(fracas_setting_check(
            &file, &(fracas_setting){.leaf = &leaf, .node = &node, .value = value}, &any));
    const fracas_setting six = {.leaf = &leaf, .node = &node, .value = 6};
    assert_int_equal(fracas_setting_check(&file, &six, &low), FRACAS_USAGE);
    assert_string_equal(fracas_message(),
                        "f:2:3: `v`: 6 is out of range; allowed is any number at most 5 m/s");
}

/* Files that are wrong as a whole. */
static void test_whole_files(void **state)
{
    static const struct {
        const char *text, *words[2];
    } table[] = {
        {"", {":1:1: ", "the file is empty"}},
        {"# nothing\n", {":2:1: ", "the file is empty"}},
        {"- 1\n", {":1:1: ", "found a list"}},
        {"bar\n", {":1:1: ", "found a single value"}},
        {"\xff\xfe"
         "n\0a\0",
         {":1:1: ", "UTF-8"}},
    };
    char path[40];
    fracas_campaign *campaign = NULL;
    make_path(path);
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        write_bytes(path, table[i].text, strlen(table[i].text));
        assert_int_equal(fracas_campaign_read(path, &campaign), FRACAS_USAGE);
        for (int w = 0; w < 2; w++) assert_has(fracas_message(), table[i].words[w]);
    }
    size_t size = (16 << 20) + 1;
    OWNED char *large = taken(size);
    memset(large, '#', size);
    write_bytes(path, large, size);
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, "larger than 16 MiB");
    assert_int_equal(truncate(path, 100 << 20), 0); /* of which the rest is not read */
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, "larger than 16 MiB");
    for (int i = 0; i <= 500; i++) snprintf(large + 9 * i, 10, "k%04u: 1\n", (unsigned)i % 10000);
    write_bytes(path, large, 9 * 501);
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, "more than 500 keys in one place");
    memcpy(large, "a: [", 4);
    for (size_t i = 4; i + 1 < size; i += 2) memcpy(large + i, "1,", 2);
    write_bytes(path, large, size / 4);
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, "more than 1000000 values");
    unlink(path);
    FAILS(fracas_campaign_read(path, &campaign), FRACAS_USAGE, "there is no campaign file");
    assert_int_equal(fracas_campaign_read("/", &campaign), FRACAS_ENVIRONMENT);
    assert_null(campaign);
}

static int load(void **state)
{
    fracas_units *units;
    if (fracas_units_create(&units)) return -1;
    *state = units;
    return 0;
}

static int unload(void **state)
{
    fracas_units_destroy(*state);
    return 0;
}

TESTS_ALL(load, unload, test_wrong_files, test_many_errors, test_any_number, test_whole_files)
