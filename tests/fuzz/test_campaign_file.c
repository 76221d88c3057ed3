/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Damaged campaign files: thousands of deterministic mutations of examples (a sweep of bars; a ring
 * with choices, names of kinds that go with each other and files) are either read or refused with a
 * message that has a place; never a crash or a hang. What is read must survive writing and reading
 * back. */
#define FOLDER "fracas-fuzz"
#include "tests/support/folder.h"

#include "tests/support/campaign_text.h"

#include <sys/stat.h>
#include <time.h>

enum { LARGEST = 1 << 14 };

/* Files of strengths beside the campaign file. */
#define STRENGTHS "strengths.csv"

static uint64_t next_random(uint64_t *x)
{
    *x = *x * 6364136223846793005u + 1442695040888963407u;
    return *x >> 33;
}

/* The fuzzer's pieces, with a meaning for YAML, numbers, units or a sweep. */
static char pieces[128][64];
static size_t npieces;

static char *ring; /* tests/data/campaigns/ring-of-files.yaml */

static size_t replace_bytes(unsigned char *text, size_t size, size_t at, size_t cut,
                            const void *put, size_t length)
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
    const char *piece = pieces[next_random(x) % npieces];
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

static void check_written(const fracas_units *units, const fracas_campaign *campaign,
                          const char *path)
{
    char *text = write_text(campaign);
    write_bytes(path, text, strlen(text));
    for (const fracas_attached *a = campaign->attached; a; a = a->next) {
        char copy[80];
        snprintf(copy, sizeof copy, "%s/" FRACAS_ATTACHMENTS "/%s", folder, a->attachment.digest);
        write_bytes(copy, a->attachment.text, a->attachment.size);
    }
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

static const char *in_folder(const char *name)
{
    static char path[80];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

typedef struct {
    size_t tried, accepted;
    double slowest; /* s */
} tally;

/* One mutation of a campaign file, or of the file of strengths beside it. */
static void try_mutation(const fracas_units *units, const unsigned char *example,
                         size_t example_size, bool of_strengths, uint64_t *x, tally *count)
{
    static unsigned char text[LARGEST];
    char path[80], place[84];
    snprintf(path, sizeof path, "%s", in_folder("c.yaml"));
    snprintf(place, sizeof place, "%s:", path);
    memcpy(text, example, example_size);
    size_t size = example_size;
    for (uint64_t n = 1 + next_random(x) % 4; n > 0; n--) size = mutate(text, size, x);
    write_bytes(of_strengths ? in_folder(STRENGTHS) : path, text, size);
    if (of_strengths) write_bytes(path, ring, strlen(ring));
    fracas_campaign *campaign = NULL;
    double before = seconds();
    fracas_err err = fracas_campaign_read_with(units, path, &campaign);
    count->slowest = fmax(count->slowest, seconds() - before);
    count->tried++;
    if (err &&
        (err != FRACAS_USAGE || campaign || strncmp(fracas_message(), place, strlen(place)) != 0))
        fail_msg("mutation %zu: %d %s", count->tried, err, fracas_message());
    if (err) return;
    count->accepted++;
    check_written(units, campaign, path);
    fracas_campaign_destroy(campaign);
}

#ifdef __SANITIZE_ADDRESS__ /* which sees more than crashes */
enum { MUTATIONS = 1500 };
#else
enum { MUTATIONS = 300 };
#endif

/* FRACAS_FUZZ_SECONDS: by time, with another seed. The test itself makes the same mutations on
 * every machine. */
static void test_mutations_of(const unsigned char *example, size_t size, bool of_strengths)
{
    fracas_units *units;
    OK(fracas_units_create(&units));
    const char *longer = getenv("FRACAS_FUZZ_SECONDS");
    const double start = seconds(), most = longer ? strtod(longer, NULL) : 0;
    uint64_t x = longer ? (uint64_t)time(NULL) : 20261121;
    tally count = {0};
    while (longer ? seconds() - start < most : count.tried < MUTATIONS)
        try_mutation(units, example, size, of_strengths, &x, &count);
    fracas_units_destroy(units);
    print_message("%zu mutations, %zu still a campaign, slowest %.1f ms\n", count.tried,
                  count.accepted, 1e3 * count.slowest);
    assert_true(count.accepted > 0);
}

static void test_bars(void **state)
{
    size_t size;
    OWNED unsigned char *example = whole_bytes(
        FRACAS_SOURCE_DIR "/campaigns/examples/bar-rate-sweep.yaml", &size);
    test_mutations_of(example, size, false);
}

static const char strengths[] =
    "# interface, strength\ni, sigma_c (Pa)\n0, 299e6\n1,3.01e8\n\n2\t300000000.5\r\n";

static void test_rings(void **state)
{
    test_mutations_of((const unsigned char *)ring, strlen(ring), false);
}

static void test_strengths(void **state)
{
    test_mutations_of((const unsigned char *)strengths, sizeof strengths - 1, true);
}

static int make_files(void **state)
{
    OWNED char *dictionary = whole_file(FRACAS_SOURCE_DIR "/tests/fuzz/campaign_file.dict");
    for (char *next = dictionary, *line; (line = strsep(&next, "\n"));) {
        if (*line != '"') continue;
        assert_true(npieces < FRACAS_COUNT(pieces) && strlen(line) < sizeof *pieces);
        *strrchr(line, '"') = '\0';
        unescape(strcpy(pieces[npieces++], line + 1));
    }
    ring = campaign_file("ring-of-files");
    if (make_folder(state) || mkdir(in_folder(FRACAS_ATTACHMENTS), 0777)) return -1;
    write_bytes(in_folder(STRENGTHS), strengths, sizeof strengths - 1);
    write_bytes(in_folder(STRENGTHS "2"), "3e8\n", 4);
    return 0;
}

static int remove_files(void **state)
{
    free(ring);
    return remove_folder(state);
}

TESTS_ALL(make_files, remove_files, test_bars, test_rings, test_strengths)
