/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What exports are made of: the digest that packages name, and the page of the summary's keys.
 * Packages as a whole: tests/unit/export.sh, and tests/support/check_export.py on the studies of
 * tests/unit/test_analysis_*.c. */
#include "tests/support/report.h"

#include "analysis/data/field.h"
#include "analysis/export/sha256.h"

/* A file of so many bytes, all values among them; sha256sum must find what we find. */
static void same_as_sha256sum(size_t bytes)
{
    char path[512], command[600], hex[FRACAS_SHA256_HEX], wanted[FRACAS_SHA256_HEX] = "";
    uint64_t size;
    snprintf(path, sizeof path, "%s/file", report_root);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < bytes; i++) putc((int)((i * i + 7 * i) % 257), file);
    assert_int_equal(fclose(file), 0);
    OK(fracas_sha256_of_file(path, hex, &size));
    assert_int_equal(size, bytes);
    snprintf(command, sizeof command, "sha256sum '%s'", path);
    FILE *other = popen(command, "r");
    assert_non_null(other);
    assert_non_null(fgets(wanted, sizeof wanted, other));
    assert_int_equal(pclose(other) & 0x7f, 0);
    assert_string_equal(hex, wanted);
}

/* Nothing, less than what is read at once, that, and more. */
static void digests_are_those_of_sha256sum(void **state)
{
    static const size_t bytes[] = {0, 1, 65535, 65536, 65537, 300000};
    for (size_t i = 0; i < sizeof bytes / sizeof *bytes; i++) same_as_sha256sum(bytes[i]);
}

static void file_that_is_not_there(void **state)
{
    char hex[FRACAS_SHA256_HEX];
    uint64_t size;
    FAILS(fracas_sha256_of_file("/nonexistent", hex, &size), FRACAS_ENVIRONMENT, "/nonexistent");
    assert_int_equal(fracas_sha256_of_file("/", hex, &size),
                     FRACAS_ENVIRONMENT); /* opens, and cannot be read */
}

/* No text is a formula to a spreadsheet; numbers are as they were. */
static void texts_are_no_formulas(void **state)
{
    static const char *const pairs[][2] = {{"plain", "plain"},
                                           {"", ""},
                                           {"a,b", "\"a,b\""},
                                           {"a=b", "a=b"},
                                           {"@SUM(1)", "\"'@SUM(1)\""},
                                           {"=1+1", "\"'=1+1\""},
                                           {"+1", "\"'+1\""},
                                           {"-1", "\"'-1\""},
                                           {"\tx", "\"'\tx\""},
                                           {"\r=1", "\"'\r=1\""},
                                           {"=\"a\"", "\"'=\"\"a\"\"\""}};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        FILE *out = text_begin();
        fracas_csv_text(pairs[i][0], out);
        OWNED char *text = text_end(out);
        assert_string_equal(text, pairs[i][1]);
    }
    FILE *out = text_begin();
    fracas_csv_real(-1.5, out);
    OWNED char *text = text_end(out);
    assert_string_equal(text, ",-1.5");
}

static void page_shows_every_key(void **state)
{
    FILE *out = text_begin();
    fracas_analysis_reference(out);
    OWNED char *wanted = text_end(out);
    const size_t size = strlen(wanted);
    static const char begin[] = "<!-- generated: fracas reference --statistics -->\n\n",
                      end[] = "\n<!-- end of generated -->\n";
    OWNED char *page = report_contents(FRACAS_SOURCE_DIR, "docs/formats/summary.md");
    const char *shown = strstr(page, begin);
    assert_non_null(shown);
    shown += strlen(begin);
    if (strncmp(shown, wanted, size) || strcmp(shown + size, end))
        fprintf(stderr,
                "docs/formats/summary.md must have between its markers, and nothing else, what "
                "`fracas reference --statistics` prints:\n%s",
                wanted);
    assert_memory_equal(shown, wanted, size);
    assert_string_equal(shown + size, end);
}

TESTS_ALL(report_make_root, report_remove_root, digests_are_those_of_sha256sum,
          texts_are_no_formulas, file_that_is_not_there, page_shows_every_key)
