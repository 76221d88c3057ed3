/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The small things of base: messages, hashes, JSON, parameter access. */
#include "base/err.h"
#include "base/hash.h"
#include "base/json.h"
#include "base/param.h"
#include "tests/support/test.h"

static fracas_err fails(int level)
{
    if (level == 0) return fracas_fail(FRACAS_USAGE, "value %d", 7);
    TRY(fails(level - 1));
    return FRACAS_OK;
}

static void an_error_carries_its_message_up(void **unused)
{
    assert_int_equal(fails(3), FRACAS_USAGE);
    assert_string_equal(fracas_message(), "value 7");
    assert_int_equal(fracas_fail_within(FRACAS_USAGE, "file %s", "a.yaml"), FRACAS_USAGE);
    assert_string_equal(fracas_message(), "file a.yaml: value 7");
    OWNED char *huge = taken(5000);
    memset(huge, 'x', 4999);
    huge[4999] = 0;
    assert_int_equal(fracas_fail(FRACAS_BUG, "%s", huge), FRACAS_BUG);
    assert_int_equal(strlen(fracas_message()), 1023);
    assert_int_equal(fracas_fail_within(FRACAS_BUG, "within"), FRACAS_BUG);
    assert_int_equal(strlen(fracas_message()), 1023);
}

/* XXH3-128 of no bytes and of "abc", as xxhsum -H2 prints them. */
static void hashes_are_xxh3(void **unused)
{
    fracas_hash hash = fracas_hash_of("", 0), again;
    assert_string_equal(fracas_hash_hex(&hash).text, "99aa06d3014798d86001c324468d497f");
    hash = fracas_hash_of("abc", 3);
    assert_string_equal(fracas_hash_hex(&hash).text, "06b05ab6733a618578af5f94892f3950");
    assert_true(fracas_hash_parse(fracas_hash_hex(&hash).text, &again));
    assert_true(fracas_hash_equal(&hash, &again));
    uint64_t word[2];
    fracas_hash_words(&hash, word);
    assert_true(word[0] == 0x06b05ab6733a6185u && word[1] == 0x78af5f94892f3950u);
    assert_false(fracas_hash_parse("06b05ab6733a618578af5f94892f395", &again));
    assert_false(fracas_hash_parse("06b05ab6733a618578af5f94892f395g", &again));
    assert_true(fracas_checksum_of("abc", 3) == 0x78af5f94892f3950u);
}

static void json_is_well_formed(void **unused)
{
    FILE *out = text_begin();
    fracas_json json;
    fracas_json_begin(&json, out);
    fracas_json_text(&json, "a \"b\"\n", "\\");
    fracas_json_array(&json, "list");
    fracas_json_real(&json, NULL, 0.1);
    fracas_json_real(&json, NULL, NAN);
    fracas_json_integer(&json, NULL, -3);
    fracas_json_close(&json);
    fracas_json_object(&json, "empty");
    fracas_json_close(&json);
    fracas_json_boolean(&json, "yes", true);
    fracas_json_text(&json, "none", NULL);
    fracas_json_end(&json);
    OWNED char *text = text_end(out);
    assert_string_equal(text, "{\n  \"a \\\"b\\\"\\u000a\": \"\\\\\",\n  \"list\": [\n    "
                              "0.10000000000000001,\n    null,\n    -3\n  ],\n"
                              "  \"empty\": {},\n  \"yes\": true,\n  \"none\": null\n}\n");
}

static void parameters_reach_their_place(void **unused)
{
    struct {
        int64_t n;
        bool b;
        double x;
    } section = {0};
    const fracas_param params[] = {
        {.name = "n",
         .type = FRACAS_INTEGER,
         .offset = (size_t)((char *)&section.n - (char *)&section)},
        {.name = "b",
         .type = FRACAS_BOOLEAN,
         .offset = (size_t)((char *)&section.b - (char *)&section)},
        {.name = "x",
         .type = FRACAS_REAL,
         .offset = (size_t)((char *)&section.x - (char *)&section)},
    };
    const double values[] = {-5, 1, 0.25};
    for (int i = 0; i < 3; i++) {
        fracas_param_set(&params[i], &section, values[i]);
        assert_true(fracas_param_get(&params[i], &section) == values[i]);
    }
    assert_true(section.n == -5 && section.b && section.x == 0.25);
}

static void names_and_files_reach_their_place(void **unused)
{
    static const fracas_kind left = {.name = "left"}, right = {.name = "right"};
    static const fracas_kind *const sides[] = {&left, &right};
    struct named {
        double before;
        const fracas_kind *side;
        const fracas_attachment *file;
    } section = {.before = 1};
    const fracas_param side = {.type = FRACAS_CHOICE,
                               .offset = offsetof(struct named, side),
                               .choices = sides,
                               .nchoices = 2};
    const fracas_param file = {.type = FRACAS_ATTACHMENT, .offset = offsetof(struct named, file)};
    const fracas_attachment attached = {.path = "a", .text = "b", .size = 1, .digest = "0123"};
    assert_true(isnan(fracas_param_get(&side, &section)));
    assert_string_equal(fracas_param_text(&side, &section), "");
    for (int i = 1; i >= 0; i--) {
        fracas_param_set(&side, &section, i);
        assert_true(section.side == sides[i] && fracas_param_get(&side, &section) == i);
        assert_string_equal(fracas_param_text(&side, &section), sides[i]->name);
    }
    assert_string_equal(fracas_param_text(&file, &section), "");
    fracas_param_place(&file, &section, &attached);
    assert_true(section.file == &attached && fracas_param_object(&file, &section) == &attached);
    assert_string_equal(fracas_param_text(&file, &section), "0123");
    assert_true(section.before == 1);
}

static void kinds_know_their_partners(void **unused)
{
    static const fracas_kind a = {.name = "a"}, b = {.name = "b"}, c = {.name = "c"},
                             other = {.name = "other"};
    static const fracas_kind *const kinds[] = {&a, &b, &c}, *const partners[] = {&c, &other, &a};
    const fracas_section section = {.kinds = kinds, .nkinds = 3},
                         elsewhere = {.kinds = partners + 1, .nkinds = 1}, none = {0};
    const fracas_kind picky = {.goes_with = partners, .ngoes_with = 3}, plain = {0};
    assert_true(fracas_kind_partner(&picky, &section, 0) ==
                &c); /* in the order of goes_with, not of the section */
    assert_true(fracas_kind_partner(&picky, &section, 1) == &a);
    assert_null(fracas_kind_partner(&picky, &section, 2));
    assert_true(fracas_kind_partner(&picky, &elsewhere, 0) == &other);
    assert_null(fracas_kind_partner(&picky, &none, 0));
    assert_null(fracas_kind_partner(&plain, &section, 0));
}

TESTS(an_error_carries_its_message_up, hashes_are_xxh3, json_is_well_formed,
      parameters_reach_their_place, names_and_files_reach_their_place, kinds_know_their_partners)
