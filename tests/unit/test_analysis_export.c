/* What exports are made of: the digest that packages name, and the page of the summary's keys. Packages as a whole: tests/unit/export.sh,
 * and tests/support/check_export.py on the studies of tests/unit/test_analysis_*.c. */
#include "tests/support/report.h"

#include "analysis/export/sha256.h"

static void digest(const char *bytes, size_t times, const char *wanted)
{
    char path[512], hex[FRACAS_SHA256_HEX];
    uint64_t size;
    snprintf(path, sizeof path, "%s/file", report_root);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (size_t i = 0; i < times; i++) fputs(bytes, file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(fracas_sha256_of_file(path, hex, &size), FRACAS_OK);
    assert_string_equal(hex, wanted);
    assert_int_equal(size, times * strlen(bytes));
}

/* The examples of NIST for FIPS 180-4: nothing, one block, two of which the second is padding, a million. */
static void digests_are_those_of_nist(void **state)
{
    (void)state;
    digest("", 1, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    digest("abc", 1, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    digest("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq", 1, "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    digest("a", 1000000, "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

static void file_that_is_not_there(void **state)
{
    (void)state;
    char hex[FRACAS_SHA256_HEX];
    uint64_t size;
    assert_int_equal(fracas_sha256_of_file("/nonexistent", hex, &size), FRACAS_ENVIRONMENT);
    assert_non_null(strstr(fracas_message(), "/nonexistent"));
    assert_int_equal(fracas_sha256_of_file("/", hex, &size), FRACAS_ENVIRONMENT); /* opens, and cannot be read */
}

static void page_shows_every_key(void **state)
{
    (void)state;
    char *wanted;
    size_t size;
    FILE *out = open_memstream(&wanted, &size);
    fracas_analysis_reference(out);
    fclose(out);
    char *page = report_contents(FRACAS_SOURCE_DIR, "docs/formats/summary.md");
    if (!strstr(page, wanted))
        fprintf(stderr, "docs/formats/summary.md must end with what `fracas reference --statistics` prints:\n%s", wanted);
    assert_non_null(strstr(page, wanted));
    free(page);
    free(wanted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(digests_are_those_of_nist),
        cmocka_unit_test(file_that_is_not_there),
        cmocka_unit_test(page_shows_every_key),
    };
    return cmocka_run_group_tests(tests, report_make_root, report_remove_root);
}
