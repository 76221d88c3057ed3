/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: ci */
/* Files that a campaign names: strengths given line by line, what is said of wrong ones, and what
 * stands for a file in a point. And what is drawn once a point: the moves of a mesh's nodes. */
#define FOLDER "fracas-test"
#include "tests/support/campaign_folder.h"

#include "tests/support/strengths.h"

#include <errno.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* ---- strengths of a file ---- */

static const fracas_kind *file_kind(void)
{
    return kind_of(&fracas_strength_section, "file");
}

static void test_values(void **state)
{
    /* The same three strengths, 3, 1 and 8 Pa: sums and quotients of such numbers are exact. */
    static const char *const texts[] = {
        "3\n1\n8\n",
        "3\n1\n8",
        "3\r\n1\r\n8\r\n",
        "\n\n3\n\n1\n8\n\n",
        "# about\n3\n  # more\n1\n8\n",
        "strength\n3\n1\n8\n",
        "# about\nindex, strength (Pa)\n0, 3\n1, 1\n2, 8\n",
        "interface,x [m],strength [Pa]\n1,0,3\n2,0,1\n3,0,8\n",
        "n,Pa\n0,3\n1,1\n2,8\n",
        "0, 3\n1 ,1\n2,8.0\n", /* no decimal comma has a blank or a point beside it */
        "0,0,3\n1,0,1\n2,0,8\n",
        "0 3\n\t1\t1 \n2 ,8\n",
        "a;b;sigma_c\n3e0\n+1.0\n.08E2\n",
        ("\xef\xbb\xbf"
         "3\n1\n8\n"),
        "\"strength\"\n3\n1\n8\n",
    };
    static const double expected[3] = {3, 1, 8}, volume[4] = {1, 1, 1, 1};
    for (size_t t = 0; t < FRACAS_COUNT(texts); t++) {
        const fracas_attachment file = attached("s.csv", texts[t]);
        const fracas_strength strength = {.distribution = file_kind(), .file = &file};
        if (fracas_strength_check(&strength)) fail_msg("%s\n%s", fracas_message(), texts[t]);
        assert_int_equal(fracas_strength_count(&strength), 3);
        assert_true(mean_of_strength(&strength, 1) == 4);
        assert_true(quantile_of(&strength, 1, 1e-9) == 1 &&
                    quantile_of(&strength, 1, 1 - 1e-9) == 8);
        for (uint64_t replica = 0; replica < 2;
             replica++) { /* whatever the stream, and the stride */
            double got[8] = {0};
            OK(sample_strengths(&strength, &(fracas_stream){.seed = 1, .replica = replica}, 4,
                                volume, NULL, 2, got));
            for (int i = 0; i < 3; i++)
                if (got[2 * i] != expected[i] || got[2 * i + 1] != 0)
                    fail_msg("%g is not %g of:\n%s", got[2 * i], expected[i], texts[t]);
            assert_true(isnan(got[6]));
        }
    }
    const fracas_strength drawn = {.distribution = fracas_strength_section.kinds[0]};
    assert_int_equal(fracas_strength_count(&drawn), 0);
}

static void test_bad_values(void **state)
{
    static const struct {
        const char *text, *message;
    } table[] = {
        {"3\nx\n", "s.csv:2: found `x`; expected a strength in Pa, a number greater than 0"},
        {"strength\nPa\n3\n", "s.csv:2: found `Pa`"},
        {"# a\n\n3\n4,\n", "s.csv:4: found no text there; expected"},
        {"4e8\n3,5e8\n",
         "s.csv:2: found `3,5e8`; expected a decimal point, not a comma, in a strength; or, if "
         "the comma ends a column, the names of all columns in a first line (`number,strength`)"},
        {"0,1 3,5e8\n", "s.csv:1: found `0,1 3,5e8`; expected a decimal point"},
        {"0,02; 3,5e8\n", "s.csv:1: found `0,02; 3,5e8`; expected a decimal point"},
        {"strength\n3,5\n", "s.csv:2: found `3,5`"},
        {"7 3,5e8\n", "s.csv:1: found `7 3,5e8`"},
        {"3e8x\n", "s.csv:1: found `3e8x`"}, /* no heading: it starts like a number */
        {"nan\n3\n", "s.csv:1: found `nan`"},
        {"3\ninf\n", "s.csv:2: found `inf`"},
        {"3\n0\n", "s.csv:2: found `0`"},
        {"3\n-4\n", "s.csv:2: found `-4`"},
        {"3\n1e999\n", "s.csv:2: found `1e999`"},
        {"3\n0x10\n", "s.csv:2: found `0x10`"},
        {"3\n300 MPa\n", "s.csv:2: found `MPa`"},
        {"300 MPa\n3\nMPa\n", "s.csv:3: found `MPa`"},
        {"strength\n# none\n", "s.csv has no strength"},
        {"\n", "s.csv has no strength"},
    };
    for (size_t t = 0; t < FRACAS_COUNT(table); t++) {
        const fracas_attachment file = attached("s.csv", table[t].text);
        const fracas_strength strength = {.distribution = file_kind(), .file = &file};
        FAILS(fracas_strength_check(&strength), FRACAS_USAGE, table[t].message);
    }
    static const char with_nul[] = "3\n4\0junk\n";
    const fracas_attachment file = {.path = "s.csv", .text = with_nul, .size = sizeof with_nul - 1};
    assert_int_equal(
        fracas_strength_check(&(fracas_strength){.distribution = file_kind(), .file = &file}),
        FRACAS_USAGE);
}

/* ---- strengths by position ---- */

/* The corners of a unit square: the spacing is 1, so that a line lies on an interface up to 1e-3
 * away. */
static const double square[4][3] = {{0, 0, 7}, {1, 0, 7}, {0, 1, 7}, {1, 1, 7}};

static fracas_err sample_places(const char *text, size_t n, const double (*position)[3],
                                size_t stride, double *got)
{
    const fracas_attachment file = attached("p.csv", text);
    const fracas_strength strength = STRENGTH("positions", .file = &file);
    TRY(fracas_strength_check(&strength));
    assert_true(fracas_strength_is_placed(&strength) && fracas_strength_is_given(&strength));
    return sample_strengths(&strength, &(fracas_stream){.seed = 1}, n, NULL, position, stride, got);
}

static void test_places(void **state)
{
    static const char *const texts[] = {
        "0,0,1\n1,0,2\n0,1,3\n1,1,4\n", "1 1 4\n0 1 3\n1 0 2\n0 0 1", /* in any order */
        ("x,y,sigma_c,elements\n0 , 0,1,2\n1,0 2 5\n# "
         "away\n9,9,99\n-1e300,0,7,1\n0,1,3,2\n1,1,4,x\n"),        /* other lines are skipped */
        "-9.9e-4,0,1\n1,-9.9e-4,2\n9.9e-4,1,3\n1.0007,1.0007,4\n", /* nearer than 1e-3, on every
                                                                      side */
    };
    for (size_t t = 0; t < FRACAS_COUNT(texts); t++) {
        double got[8] = {0};
        if (sample_places(texts[t], 4, square, 2, got))
            fail_msg("%s\n%s", fracas_message(), texts[t]);
        for (int i = 0; i < 4; i++)
            if (got[2 * i] != i + 1 || got[2 * i + 1] != 0)
                fail_msg("%g at %d of:\n%s", got[2 * i], i, texts[t]);
    }
    double edge[3][3] = {
        {0, 0, 0},
        {0, 0, 0},
        {2, 0, 0}}; /* cells of 1 from -0.002 on: the second is beside the end of one */
    double three[3];
    for (int side = -1; side <= 1; side += 2) {
        char text[100];
        edge[1][0] = 0.998 - 1e-4 * side;
        snprintf(text, sizeof text, "0 0 1\n%g 0 2\n2 0 3\n",
                 0.998 + 5e-4 * side); /* in the other cell */
        OK(sample_places(text, 3, (const double(*)[3])edge, 1, three));
        assert_true(three[0] == 1 && three[1] == 2 && three[2] == 3);
    }
    assert_int_equal(sample_places("0 0 1\n.9975 0 2\n.9985 0 2\n2 0 3\n", 3,
                                   (const double(*)[3])edge, 1, three),
                     FRACAS_USAGE);
    static const double one[1][3] = {{2, 3, 0}},
                        none[1][3] = {{0, 0, 0}}; /* without a spacing: 1e-3 of how far out it is */
    double got;
    OK(sample_places("2.001 3.001 5", 1, one, 1, &got));
    assert_true(got == 5);
    OK(sample_places("0,0,6", 1, none, 1, &got));
    assert_true(got == 6);
    OK(sample_places("0,0,6", 0, NULL, 1, NULL)); /* a single triangle */
    const fracas_attachment file = attached("p.csv", texts[2]);
    const fracas_strength strength = STRENGTH("positions", .file = &file);
    assert_int_equal(fracas_strength_count(&strength), 6); /* all lines */
    assert_true(quantile_of(&strength, 1, 0.1) == 1 && quantile_of(&strength, 1, 0.9) == 99);
    assert_true(mean_of_strength(&strength, 1) == (1 + 2 + 99 + 7 + 3 + 4) / 6.0);
}

static void test_bad_places(void **state)
{
    static const double twice[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}};
    static const struct {
        const char *text, *message;
    } table[] = {
        {"x,y,s\n0,0,1\n1,0,2\n0,z,3\n",
         "p.csv:4: found `z` as y; a line begins with x [m], y [m], strength [Pa]"},
        {"0,0,1\n1,0\n", "p.csv:2: found nothing as strength"},
        {"0,0,1\n1,,3\n", "p.csv:2: found nothing as y"},
        {"0,0,1\nx,0,1\n", "p.csv:2: found `x` as x"},
        {"nan,0,1\n", "p.csv:1: found `nan` as x"},
        {"0,inf,1\n", "p.csv:1: found `inf` as y"},
        {"0,0,300 MPa\n1,0,0\n", "p.csv:2: a strength of 0 Pa"},
        {"0,0,-1\n", "p.csv:1: a strength of -1 Pa"},
        {"# none\n", "p.csv has no strength"},
        {"0,0,1\n1,0,2\n1,1,4\n", "p.csv has no line for 1 of 4 interfaces; interface 2 is at x = "
                                  "0 m, y = 1 m, and the nearest line, 1, is 1 m away"},
        {"0,0,1\n1,0,2\n0,1.0011,3\n1,1,4\n",
         "p.csv has no line for 1 of 4 interfaces; interface 2 is at x = 0 m, y = 1 m, and the "
         "nearest line, 3, is 0.0011 m away"},
        {"0,0,1\n1e3,0,2\n0,1e3,3\n1e3,1e3,4\n",
         "p.csv has no line for 3 of 4 interfaces; interface 1 is at x = 1 m"}, /* in mm */
        {"0,0,1\n1,0,2\n0,1,3\n1,1,4\n1.0009,1,5\n",
         "p.csv: lines 4 and 5 are both at interface 3, x = 1 m, y = 1 m"},
        {"1,1,5\n1,0,2\n0,1,3\n0,0,1\n1,1,5\n", "p.csv: lines 1 and 5 are both at interface 3"},
    };
    double got[4];
    for (size_t t = 0; t < FRACAS_COUNT(table); t++) {
        FAILS(sample_places(table[t].text, 4, square, 1, got), FRACAS_USAGE, table[t].message);
    }
    FAILS(sample_places("0,0,1\n1,0,2\n", 3, twice, 1, got), FRACAS_USAGE,
          "p.csv:1: x = 0 m, y = 0 m is at two interfaces, 0 and 2");
}

/* A jittered grid of 200 by 200 and a ring of 40 000, lines in another order: each finds its own,
 * and soon. */
static void test_many_places(void **state)
{
    enum { SIDE = 200, N = SIDE * SIDE, LINE = 64 };
    static double position[N][3], got[N];
    OWNED char *text = taken((size_t)N * LINE);
    for (int body = 0; body < 2; body++) {
        for (uint64_t i = 0; i < N; i++) {
            const fracas_stream stream = {.seed = 3};
            const double angle = 2 * M_PI * (double)i / N;
            position[i][0] = body
                                 ? cos(angle)
                                 : (double)(i % SIDE) + 0.8 * fracas_stream_uniform(&stream, 2 * i);
            position[i][1] = body ? sin(angle)
                                  : (double)(i / SIDE) +
                                        0.8 * fracas_stream_uniform(&stream, 2 * i + 1);
        }
        char *at = text;
        for (size_t k = 0; k < N; k++) { /* 9973 is prime: every interface once */
            const size_t i = k * 9973 % N;
            at += sprintf(at, "%.9g,%.9g,%zu\n", position[i][0], position[i][1], i + 1);
        }
        const clock_t start = clock();
        OK(sample_places(text, N, (const double(*)[3])position, 1, got));
        print_message("[  figures ] %d strengths by position: %.3f s\n", N,
                      (double)(clock() - start) / CLOCKS_PER_SEC);
        for (size_t i = 0; i < N; i++) assert_true(got[i] == (double)(i + 1));
    }
}

/* ---- campaigns with files, in a folder of their own ---- */

static const char uniform[] = "  distribution: uniform\n  minimum: 299 MPa\n  maximum: 301 MPa\n";

/* The plain campaign, its lines 16 to 18 replaced, and something at its end (line 26 + new lines).
 */
static char *with(const char *strength, const char *end)
{
    OWNED char *text = replace(plain_campaign, uniform, strength);
    return replace(text, "", end);
}

static fracas_campaign *good_with(const char *strength, const char *end)
{
    OWNED char *text = with(strength, end);
    return good(text);
}

static void bad_at(const char *strength, const char *end, int line, int column, const char *words)
{
    char place[300];
    OWNED char *text = with(strength, end);
    snprintf(place, sizeof place, "%s:%d:%d: ", in_folder("c.yaml"), line, column);
    bad(text, words);
    if (strncmp(fracas_message(), place, strlen(place)) != 0)
        fail_msg("not at %d:%d: %s", line, column, fracas_message());
}

#define FROM_FILE "  distribution: file\n  file: " /* line 17, column 9 */

static void test_errors(void **state)
{
    put("s.csv", "3e8\n");
    put("empty.csv", "");
    put("wrong.csv", "strength\n3e8\n4e8 Pa\n");
    put("large.csv", "");
    assert_int_equal(truncate(in_folder("large.csv"), (256 << 20) + 1), 0); /* takes no disk */
    assert_int_equal(mkdir(in_folder("folder"), 0777), 0);
    assert_int_equal(symlink("loop.csv", in_folder("loop.csv")), 0);
    bad_at(FROM_FILE "absent.csv\n", "", 17, 9, "/absent.csv: No such file");
    bad_at(FROM_FILE "loop.csv\n", "", 17, 9, "/loop.csv: Too many levels of symbolic links");
    bad_at(FROM_FILE "folder\n", "", 17, 9, "/folder is not a file");
    bad_at(FROM_FILE "empty.csv\n", "", 17, 9, "/empty.csv is empty");
    bad_at(FROM_FILE "large.csv\n", "", 17, 9,
           "/large.csv has 256 MiB; a file can have at most 256");
    bad_at(FROM_FILE "/dev/null\n", "", 17, 9, "/dev/null is not a file");
    bad_at(FROM_FILE "\n", "", 17, 8, "`file`: found nothing; expected the path of a file");
    bad_at(FROM_FILE "{a: 1}\n", "", 17, 9, "`file`: found a section; expected the path of a file");
    bad_at(FROM_FILE "[s.csv]\n", "", 17, 9, "- strength.file: [...]");
    bad_at(FROM_FILE "wrong.csv\n", "", 17, 9, "`strength`: wrong.csv:3: found `Pa`");
    bad_at("  distribution: file\n", "", 16, 17, "strength with distribution file needs `file` (");
    bad_at("  distribution: constant\n  value: 1 MPa\n  file: s.csv\n", "", 18, 3,
           "`file` belongs to distribution empirical or file or positions");
    bad_at(FROM_FILE "s.csv\n", "sweep:\n  - strength.file: [s.csv, absent.csv]\n", 28, 28,
           "/absent.csv: No such file");
    bad_at(FROM_FILE "s.csv\n", "sweep:\n  - strength.file: {from: 1, to: 2, points: 2}\n", 28, 20,
           "is not a number");
    bad_at(FROM_FILE "s.csv\n", "sweep:\n  - strength.file: [s.csv, ./s.csv]\n", 28, 28,
           "the same values");
}

static void test_empirical(void **state)
{
    put("m.csv", "strength\n3e8\n5e8\n4e8\n");
    put("bad.csv", "3e8\n5e8\n4e8;\n");
    OWN(fracas_campaign) campaign = good_with(
        "  distribution: empirical\n  file: m.csv\n",
        "sweep:\n  - strength.interpolation: [linear, steps]\n");
    const size_t mean = fracas_point_table_find(&campaign->table, "derived.strength_mean");
    assert_true(campaign->table.point[0].value[mean].real == 4e8 &&
                campaign->table.point[1].value[mean].real == 4e8);
    const double u = 0.25;
    assert_true(quantile_of(&campaign->point[0].strength, 1.0, u) == 3.5e8 &&
                quantile_of(&campaign->point[1].strength, 1.0, u) == 3e8);
    assert_false(fracas_strength_is_given(&campaign->point[0].strength));
    bad_at("  distribution: empirical\n  file: bad.csv\n", "", 17, 9,
           "`strength`: bad.csv:3: found `4e8;`");
    bad_at("  distribution: empirical\n", "", 16, 17,
           "strength with distribution empirical needs `file` (");
}

/* The digest was computed by xxhsum -H2. */
static void test_identity(void **state)
{
    static const char digest[] = "283d6f4ee39833eadc24d523322a2ceb";
    put("s.csv", "strength\n300e6\n1, 301e6\n");
    put("t.csv", "strength\n300e6\n1, 301e6\n");
    put("u.csv", "strength\n300e6\n1, 302e6\n");
    OWN(fracas_campaign) one = good_with(FROM_FILE "s.csv\n", ""),
                         *same = good_with(FROM_FILE "t.csv\n", "");
    OWN(fracas_campaign) other = good_with(uniform,
                                           "sweep:\n  - strength: [{distribution: file, file: "
                                           "u.csv}, {distribution: file, file: t.csv}]\n"
                                           "  - loading.rate: [1e4, 2e4]\n");
    const size_t column = fracas_point_table_find(&one->table, "strength.file");
    assert_int_not_equal(column, SIZE_MAX);
    assert_true(one->table.column[column].text);
    assert_string_equal(one->table.column[column].unit, "");
    assert_string_equal(one->table.point[0].value[column].text, digest);
    assert_true(one->table.point[0]
                    .value[fracas_point_table_find(&one->table, "derived.strength_mean")]
                    .real == 300.5e6);
    assert_true(fracas_hash_equal(&one->hash, &same->hash));
    assert_false(fracas_hash_equal(&one->point[0].hash, &other->point[0].hash));
    assert_true(fracas_hash_equal(&one->point[0].hash, &other->point[2].hash));
    assert_ptr_equal(other->point[0].strength.file, other->point[1].strength.file); /* read once */
    assert_string_equal(one->point[0].strength.file->path, "s.csv");
    OK(fracas_campaign_extends(other, one));
    assert_int_equal(fracas_campaign_extends(one, other), FRACAS_DAMAGED);
}

/* What is written reads back to the same points where copies of the files are beside it; a copy
 * that is not what its name says is refused. */
static void test_round_trip(void **state)
{
    put("s.csv", "300e6\n");
    put("t.csv", "301e6\n");
    OWN(fracas_campaign) campaign = good_with(
        uniform, "sweep:\n  - strength: [{distribution: file, file: s.csv}, {distribution: file, "
                 "file: t.csv}, {distribution: constant, value: 5}]\n");
    assert_int_equal(mkdir(in_folder("study"), 0777), 0);
    assert_int_equal(mkdir(in_folder("study/attachments"), 0777), 0);
    char name[80] = "";
    int copies = 0;
    for (const fracas_attached *a = campaign->attached; a; a = a->next, copies++) {
        snprintf(name, sizeof name, "study/attachments/%s", a->attachment.digest);
        put(name, a->attachment.text);
    }
    assert_int_equal(copies, 2);
    OWNED char *text = write_text(campaign);
    put("study/campaign.yaml", text);
    OWN(fracas_campaign) back = NULL;
    OK(fracas_campaign_read(in_folder("study/campaign.yaml"), &back));
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    OWNED char *again = write_text(back);
    assert_string_equal(text, again);
    fracas_campaign *damaged = NULL;
    put(name, "302e6\n");
    FAILS(fracas_campaign_read(in_folder("study/campaign.yaml"), &damaged), FRACAS_USAGE,
          "is damaged: its content has the digest");
}

/* A copy holds the text and the files that it names, the same from the user's file and from the
 * resolved one; the campaign comes back from it when the files are gone. */
static void test_copy(void **state)
{
    put("s.csv", "300e6\n");
    put("same.csv", "300e6\n");
    put("t.csv", "301e6\n");
    put("unused.csv", "302e6\n");
    OWN(fracas_campaign) campaign = good_with(
        FROM_FILE "unused.csv\n",
        "sweep:\n  - cases:\n      - strength.file: s.csv\n      - {strength.file: same.csv, "
        "mesh.elements: 90}\n      - strength.file: t.csv\n");
    FRACAS_CLEARED(fracas_campaign_copy) copy = {0};
    FRACAS_CLEARED(fracas_campaign_copy) again = {0};
    OK(fracas_campaign_copy_make(campaign, &copy));
    OWNED char *text = write_text(campaign);
    assert_string_equal(copy.text, text);
    assert_int_equal(copy.size, strlen(text));
    assert_int_equal(copy.nfiles, 2); /* one content, one file; what no point has is left out */
    assert_true(strcmp(copy.file[0].digest, copy.file[1].digest) < 0);
    assert_null(strstr(copy.text, ".csv"));
    for (size_t i = 0; i < 2; i++)
        assert_true(!strcmp(copy.file[i].text, "300e6\n") || !strcmp(copy.file[i].text, "301e6\n"));

    static const char *const gone[] = {"s.csv", "same.csv", "t.csv", "unused.csv"};
    for (size_t i = 0; i < FRACAS_COUNT(gone); i++) unlink(in_folder(gone[i]));
    OWN(fracas_campaign) back = NULL;
    OK(fracas_campaign_copy_read(&copy, "elsewhere/study.h5", &back));
    assert_true(fracas_hash_equal(&campaign->hash, &back->hash));
    OK(fracas_campaign_copy_make(back, &again));
    assert_string_equal(again.text, copy.text);
    assert_int_equal(again.nfiles, 2);
    for (size_t i = 0; i < 2; i++) {
        assert_string_equal(again.file[i].digest, copy.file[i].digest);
        assert_string_equal(again.file[i].text, copy.file[i].text);
        assert_ptr_not_equal(again.file[i].text, copy.file[i].text);
    }
    fracas_campaign *none = NULL;
    copy.nfiles = 1;
    FAILS(fracas_campaign_copy_read(&copy, "elsewhere/study.h5", &none), FRACAS_USAGE,
          "is not in elsewhere/study.h5");
    copy.nfiles = 2;
    copy.file[1].text = "300e7\n";
    FAILS(fracas_campaign_copy_read(&copy, "elsewhere/study.h5", &none), FRACAS_USAGE,
          "is damaged: its content has the digest");
    assert_null(none);
}

/* ---- the forecast ---- */

static void test_forecast(void **state)
{
    char text[100 * 16] = "";
    fracas_forecast forecast;
    for (int i = 0; i < 99; i++) strcat(text, "300e6\n");
    put("short.csv", text);
    strcat(text, "300e6\n");
    put("equal.csv", text);
    text[strlen(text) - strlen("300e6\n")] = '2';
    put("s.csv", text);
    OWN(fracas_campaign) campaign = good_with(
        FROM_FILE "s.csv\n",
        "sweep:\n  - cases:\n      - {name: a}\n      - {replicas: 1, strength.file: equal.csv}\n"
        "      - strength.file: short.csv\n");
    OK(fracas_forecast_make(campaign, 0, &forecast));
    assert_true(forecast.repeated && !forecast.uniform);
    OK(fracas_forecast_make(campaign, 1, &forecast));
    assert_true(!forecast.repeated && forecast.uniform);
    assert_int_equal(fracas_forecast_make(campaign, 2, &forecast), FRACAS_USAGE);
    assert_string_equal(fracas_message(), "point 2: short.csv has 99 strengths, but the mesh has "
                                          "100 interfaces; each needs one line of the file");
    memcpy(text + 6, "9e20 \n", 6); /* one interface too strong for the mesh is enough */
    put("s.csv", text);
    OWN(fracas_campaign) strong = good_with(FROM_FILE "s.csv\n", "");
    FAILS(fracas_forecast_make(strong, 0, &forecast), FRACAS_USAGE, "the strongest of");
}

/* The model of point 0, and where its interfaces are. */
static fracas_model *model_of(const fracas_campaign *campaign, double (*position)[3])
{
    fracas_model *model;
    OK(fracas_point_model_create(campaign, 0, &model));
    fracas_model_interface_positions(model, position);
    return model;
}

static const char ring[] =
    "name: ring\nseed: 1\nmodel: ring\ngeometry: {radius: 8 mm, area: 1 mm2}\nmesh: {elements: 8}\n"
    "material: {young: 275 GPa, density: 2750 kg/m3}\ncohesive: {fracture_energy: 100 J/m2}\n"
    "strength: {distribution: constant, value: 1 MPa}\nloading: {type: initial-velocity, radial: "
    "80 m/s}\ntime: {end: 1 us}\nreplicas: 1\n";

/* The plain campaign, a periodic bar of 100 elements; a graded one; a ring, whose interfaces are on
 * its circle, 2 pi/8 apart. */
static void test_positions(void **state)
{
    double x[100][3];
    OWN(fracas_campaign) campaign = read_replaced("", "");
    OWN(fracas_model) model = model_of(campaign, x);
    const double length = campaign->point[0].spec.geometry.length;
    for (int i = 0; i < 100; i++)
        assert_true(fabs(x[i][0] - length * (i + 1) / 100) < 1e-15 * length && x[i][1] == 0 &&
                    x[i][2] == 0);
    OWN(fracas_campaign) grading = read_replaced(
        "", "sweep:\n  - mesh: [{elements: 100, spacing: graded, ratio: 4}]\n");
    OWN(fracas_model) graded = model_of(grading, x);
    assert_true(fabs(x[99][0] - length) <
                1e-14 *
                    length); /* elements in geometric progression: so are their ends' distances */
    for (int i = 1; i < 99; i++)
        assert_true(fabs((x[i + 1][0] - x[i][0]) / (x[i][0] - x[i - 1][0]) - pow(4, 1.0 / 99)) <
                    1e-11);
    OWN(fracas_campaign) circle = read_text(ring);
    OWN(fracas_model) round = model_of(circle, x);
    assert_int_equal(fracas_model_interfaces(round), 8);
    for (int i = 0; i < 8; i++)
        assert_true(fabs(x[i][0] - 8e-3 * cos(M_PI_4 * (i + 1))) < 1e-15 * 8e-3 &&
                    fabs(x[i][1] - 8e-3 * sin(M_PI_4 * (i + 1))) < 1e-15 * 8e-3 && x[i][2] == 0);
}

static const char by_position[] =
    "name: by-position\nseed: 1\nmodel: membrane\ngeometry: {shape: plate, width: 2 mm, height: 2 "
    "mm, thickness: 1 mm}\n"
    "mesh: {spacing: triangles, divisions: 2}\nmaterial: {young: 370 GPa, density: 3900 kg/m3, "
    "poisson: 0.22}\n"
    "cohesive: {law: nitsche, fracture_energy: 50 J/m2, beta: 10}\nstrength: {distribution: "
    "positions, file: p.csv}\n"
    "loading: {type: expansion, rate: 1e4 1/s}\ntime: {stop: time, end: 10 ns}\nreplicas: 1\n";

/* Two by two squares of 1 mm, cut in two: eight interfaces, of which four are sides of squares and
 * four diagonals. Written by position with a strength that tells where each is, every interface has
 * its own, drawn and in the plan's check. */
static void test_positions_of_a_surface(void **state)
{
    double x[8][3], got[8];
    char text[1000] = "x,y,strength\n";
    put("p.csv", "0,0,3e8\n");
    OWN(fracas_campaign) campaign = good(by_position);
    OWN(fracas_model) model = model_of(campaign, x);
    assert_int_equal(fracas_model_interfaces(model), 8);
    int sides = 0, diagonals = 0;
    for (int i = 7; i >= 0; i--) { /* middles of sides are at (0, +-0.5), (+-0.5, 0) mm, of
                                      diagonals at (+-0.5, +-0.5) mm */
        const double a = fabs(x[i][0]), b = fabs(x[i][1]);
        sides += fabs(a + b - 0.5e-3) < 1e-15;
        diagonals += fabs(a - 0.5e-3) < 1e-15 && fabs(b - 0.5e-3) < 1e-15;
        sprintf(text + strlen(text), "%.9g,%.9g,%.15g\n", x[i][0], x[i][1],
                3e8 + 1e11 * x[i][0] + 1e10 * x[i][1]);
    }
    assert_true(sides == 4 && diagonals == 4);
    fracas_forecast forecast;
    FAILS(fracas_forecast_make(campaign, 0, &forecast), FRACAS_USAGE,
          "point 0: p.csv has no line for 8 of 8 interfaces");
    put("p.csv", text);
    OWN(fracas_campaign) placed = good(by_position);
    OK(fracas_forecast_make(placed, 0, &forecast));
    OK(sample_strengths(&placed->point[0].strength, &(fracas_stream){0}, 8, NULL,
                        (const double(*)[3])x, 1, got));
    for (int i = 0; i < 8; i++)
        assert_true(fabs(got[i] - (3e8 + 1e11 * x[i][0] + 1e10 * x[i][1])) < 1e-6);
    char *end = strrchr(text, ',');
    strcpy(end, ",9e20\n"); /* one interface too strong for the mesh is enough, and is named: the
                               first, whose line is the last */
    put("p.csv", text);
    OWN(fracas_campaign) strong = good(by_position);
    FAILS(fracas_forecast_make(strong, 0, &forecast), FRACAS_USAGE, "p.csv, interface 0 at x = ");
}

/* ---- the mesh's noise ---- */

static void test_noise(void **state)
{
    enum { N = 1000 };
    OWN(fracas_campaign) campaign = read_replaced(
        "", "sweep:\n  - mesh: [{elements: 50, spacing: perturbed, amplitude: 0.2}, {elements: "
            "200000, spacing: perturbed, amplitude: 0.2}]\n");
    double noise[N], begin[10], sum = 0;
    fracas_point_mesh_noise(campaign, 0, N, noise);
    fracas_point_mesh_noise(campaign, 0, 10, begin);
    fracas_stream stream = {.seed = 7, .purpose = 2};
    fracas_hash_words(&campaign->point[0].hash, stream.point);
    for (uint64_t i = 0; i < N; i++) {
        assert_true(noise[i] == 2.0 * fracas_stream_uniform(&stream, i) - 1.0 &&
                    fabs(noise[i]) <= 1);
        if (i < 10) assert_true(begin[i] == noise[i]);
        sum += noise[i];
    }
    assert_true(fabs(sum / N) <
                5.0 / sqrt(3.0 * N)); /* five standard deviations of the mean, variance 1/3 */
    fracas_point_mesh_noise(campaign, 1, 10, begin);
    assert_true(begin[0] != noise[0]); /* of the point */
    fracas_forecast forecast[2];
    OK(fracas_forecast_all(campaign, 1, false,
                           forecast)); /* which times a shorter mesh of the second */
    assert_int_equal(forecast[1].elements, 200000);
    assert_null(campaign->point[0].spec.mesh.noise);
}

TESTS_ALL(make_folder, remove_folder, test_values, test_bad_values, test_errors, test_empirical,
          test_identity, test_round_trip, test_copy, test_forecast, test_noise, test_places,
          test_bad_places, test_many_places, test_positions, test_positions_of_a_surface)
