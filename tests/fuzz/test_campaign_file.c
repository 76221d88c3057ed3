/* Damaged campaign files: thousands of deterministic mutations of the example are either read or refused with a message
 * that has a place; never a crash or a hang. What is read must survive writing and reading back. */
#include "campaigns/file/read.h"
#include "tests/support/campaign_text.h"

#include <stdint.h>
#include <stdio.h>
#include <sys/mman.h>
#include <time.h>

enum { LARGEST = 1 << 14 };

static uint64_t next_random(uint64_t *x)
{
    *x = *x * 6364136223846793005u + 1442695040888963407u;
    return *x >> 33;
}

/* Pieces that mean something to YAML, to numbers, to units or to a sweep. */
static const char *const pieces[] = {
    "[", "]", "{", "}", ": ", "- ", "\n", "  ", "\t", "#", "&a ", "*a", "!!", "\"", "'", "|\n", ">", "---\n", "...",
    "%", "@", "?", "1e", "1e308", "-", "0", "nan", "1e-400", "99999999999999999999", " MPa", " s since 1", " (((",
    "^", "\xff", "\xc2", "\xe2\x82", "sweep:\n", "zip:", "cases:", "from: 1", "points: 50", "name: a", "strength",
    "shape: 1", ".", "..", ",", "<<: ", "\\x00", "\r",
};

static size_t replace_bytes(unsigned char *text, size_t size, size_t at, size_t cut, const void *put, size_t length)
{
    if (at + cut > size) cut = size - at;
    if (size - cut + length > LARGEST) return size;
    memmove(text + at + length, text + at + cut, size - at - cut);
    memcpy(text + at, put, length);
    return size - cut + length;
}

static size_t mutate(unsigned char *text, size_t size, uint64_t *x)
{
    size_t at = size ? next_random(x) % size : 0, other = size ? next_random(x) % size : 0;
    unsigned char byte = (unsigned char)next_random(x), copy[64];
    const char *piece = pieces[next_random(x) % FRACAS_COUNT(pieces)];
    size_t length = next_random(x) % sizeof copy;
    switch (next_random(x) % 6) {
    case 0: return replace_bytes(text, size, at, 1, &byte, 1);
    case 1: return replace_bytes(text, size, at, 0, piece, strlen(piece));
    case 2: return replace_bytes(text, size, at, strlen(piece), piece, strlen(piece));
    case 3: return replace_bytes(text, size, at, length, "", 0);
    case 4: return next_random(x) % 4 ? size : at; /* cut short */
    default: break;
    }
    if (other + length > size) length = size - other;
    memcpy(copy, text + other, length);
    return replace_bytes(text, size, at, 0, copy, length);
}

static void check_round_trip(const fracas_units *units, const fracas_campaign *campaign, const char *path)
{
    char *text = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    assert_int_equal(fracas_campaign_write(campaign, out), FRACAS_OK);
    assert_int_equal(fclose(out), 0);
    write_bytes(path, text, size);
    fracas_campaign *back = NULL;
    if (fracas_campaign_read_with(units, path, &back)) fail_msg("%s\n%s", fracas_message(), text);
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    fracas_campaign_destroy(back);
    free(text);
}

/* Processor time: other processes do not count. */
static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void test_mutations(void **state)
{
    (void)state;
    static unsigned char example[LARGEST], text[LARGEST];
    FILE *in = fopen(FRACAS_SOURCE_DIR "/campaigns/examples/bar-rate-sweep.yaml", "rb");
    assert_non_null(in);
    size_t example_size = fread(example, 1, sizeof example, in), tried = 0, accepted = 0;
    fclose(in);
    char path[40], place[44];
    int file = memfd_create("campaign", 0); /* a file that needs no disk */
    assert_true(file >= 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", file);
    fracas_units *units;
    assert_int_equal(fracas_units_create(&units), FRACAS_OK);
    snprintf(place, sizeof place, "%s:", path);
    uint64_t x = 20261121;
    double slowest = 0.0, start = seconds();
    for (; tried < 6000 && seconds() - start < 2.0; tried++) {
        memcpy(text, example, example_size);
        size_t size = example_size;
        for (uint64_t n = 1 + next_random(&x) % 4; n > 0; n--) size = mutate(text, size, &x);
        write_bytes(path, text, size);
        fracas_campaign *campaign = NULL;
        double before = seconds();
        fracas_err err = fracas_campaign_read_with(units, path, &campaign);
        if (seconds() - before > slowest) slowest = seconds() - before;
        if (err && (err != FRACAS_USAGE || campaign || strncmp(fracas_message(), place, strlen(place)) != 0))
            fail_msg("mutation %zu: %d %s", tried, err, fracas_message());
        if (err) continue;
        accepted++;
        check_round_trip(units, campaign, path);
        fracas_campaign_destroy(campaign);
    }
    close(file);
    fracas_units_destroy(units);
    print_message("%zu mutations, %zu still a campaign, slowest %.1f ms\n", tried, accepted, 1e3 * slowest);
    /* Fewer would mean that reading had become a hundred times slower than it is (0.2 ms). */
    assert_true(tried > 100 && accepted > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_mutations)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
