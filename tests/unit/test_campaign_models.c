/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What goes with what: kinds and defaults by the model, on tables of this test's own with two
 * models. */
#include "campaigns/file/resolve.h"
#include "tests/support/test.h"

typedef struct {
    const fracas_kind *model;
    const fracas_kind *law;
    double energy, size, depth, grip;
} body;

#define PARAM(key, otherwise)                                                                     \
    {                                                                                             \
        .name = #key, .unit = "1", .doc = "a number", .fallback = otherwise, .maximum = INFINITY, \
        .offset = offsetof(body, key)                                                             \
    }

/* Every law has an energy, only two have a size. */
static const fracas_param of_soft[] = {PARAM(energy, FRACAS_REQUIRED), PARAM(size, 1)};
static const fracas_param of_hard[] = {PARAM(energy, 7), PARAM(size, 2),
                                       PARAM(depth, FRACAS_REQUIRED)};
static const fracas_param of_odd[] = {PARAM(energy, 8)};
static const fracas_kind soft = {.name = "soft", .params = of_soft, .nparams = 2},
                         hard = {.name = "hard", .params = of_hard, .nparams = 3},
                         odd = {.name = "odd", .params = of_odd, .nparams = 1};
static const fracas_kind *const laws[] = {&soft, &hard, &odd};
static const fracas_kind *const with_rod[] = {&soft, &odd}, *const with_disc[] = {&hard, &odd};
static const fracas_kind rod = {.name = "rod", .goes_with = with_rod, .ngoes_with = 2},
                         disc = {.name = "disc",
                                 .goes_with = with_disc,
                                 .ngoes_with = 2,
                                 .groups = 1},
                         cloud = {.name = "cloud", .groups = 2};
static const fracas_kind *const models[] = {&rod, &disc, &cloud};
static const fracas_section model_section = {
    .name = "model", .kinds = models, .nkinds = 3, .kind_offset = offsetof(body, model)};
/* Whatever the law, but not at a rod. */
static const fracas_param of_all[] = {{.name = "grip",
                                       .unit = "1",
                                       .doc = "a number",
                                       .fallback = 9,
                                       .maximum = INFINITY,
                                       .offset = offsetof(body, grip),
                                       .only = 1 | 2}};
static const fracas_section law_section = {.name = "cohesive",
                                           .selector = "law",
                                           .kinds = laws,
                                           .nkinds = 3,
                                           .kind_offset = offsetof(body, law),
                                           .params = of_all,
                                           .nparams = 1};
static const fracas_file_section sections[] = {{&model_section, 0}, {&law_section, 0}};

enum { DEPTH, ENERGY, GRIP, LAW, SIZE, MODEL, LEAVES };
static const fracas_leaf leaves[LEAVES] = {{&sections[1], "cohesive.depth", "depth", &of_hard[2]},
                                           {&sections[1], "cohesive.energy", "energy", &of_soft[0]},
                                           {&sections[1], "cohesive.grip", "grip", &of_all[0]},
                                           {&sections[1], "cohesive.law", "law", NULL},
                                           {&sections[1], "cohesive.size", "size", &of_soft[1]},
                                           {&sections[0], "model", "model", NULL}};
static const fracas_catalog catalog = {2, sections, LEAVES, leaves};
static const fracas_node root = {.type = FRACAS_MAP, .line = 1, .column = 1};
static const fracas_file file = {.name = "f", .catalog = &catalog, .root = &root};

/* What the base (line 1..) and the sweep (line 11..) say: a kind, or a number where one is not 0.
 */
typedef struct {
    const fracas_kind *model, *law;
    double energy, size, depth, grip;
} said;

typedef struct {
    fracas_node node[LEAVES];
    fracas_setting setting[LEAVES];
    const fracas_setting *slot[LEAVES];
} layer;

static void lay(const said *what, int line, layer *made)
{
    *made = (layer){0};
    const double number[LEAVES] = {
        [DEPTH] = what->depth, [ENERGY] = what->energy, [SIZE] = what->size, [GRIP] = what->grip};
    const fracas_kind *const kind[LEAVES] = {[LAW] = what->law, [MODEL] = what->model};
    for (int i = 0; i < LEAVES; i++) {
        if (!kind[i] && number[i] == 0.0) continue;
        made->node[i] = (fracas_node){.line = line + i, .column = 3, .text = "text"};
        made->setting[i] = (fracas_setting){
            .leaf = &leaves[i], .node = &made->node[i], .kind = kind[i], .value = number[i]};
        made->slot[i] = &made->setting[i];
    }
}

static fracas_err resolve(const said *base, const said *swept, body *made)
{
    layer below, above;
    lay(base, 1, &below);
    lay(swept, 11, &above);
    const fracas_draft draft = {below.slot, above.slot};
    *made = (body){0};
    TRY(fracas_draft_check_base(&file, &draft));
    for (int s = 0; s < 2; s++) TRY(fracas_draft_resolve(&file, &draft, &sections[s], made));
    return FRACAS_OK;
}

static void good(said base, said swept, body expected)
{
    body made;
    OK(resolve(&base, &swept, &made));
    assert_ptr_equal(made.model, expected.model);
    assert_ptr_equal(made.law, expected.law);
    assert_true(made.energy == expected.energy && made.size == expected.size &&
                made.depth == expected.depth);
    assert_true(made.grip == (made.model == &rod ? 0
                              : swept.grip       ? swept.grip
                              : base.grip        ? base.grip
                                                 : 9)); /* 9: its default */
}

static void bad(said base, said swept, const char *message)
{
    body made;
    assert_int_equal(resolve(&base, &swept, &made), FRACAS_USAGE);
    assert_string_equal(fracas_message(), message);
}

static void defaults_go_by_the_model(void **state)
{
    good((said){.energy = 5}, (said){0}, (body){&rod, &soft, 5, 1, 0, 0});
    good((said){.model = &disc, .depth = 3}, (said){0}, (body){&disc, &hard, 7, 2, 3, 0});
    good((said){.model = &cloud, .energy = 5}, (said){0},
         (body){&cloud, &soft, 5, 1, 0, 0}); /* restricts nothing */
    good((said){.model = &cloud, .law = &hard, .depth = 3}, (said){0},
         (body){&cloud, &hard, 7, 2, 3, 0});
    good((said){.model = &disc, .law = &odd}, (said){0}, (body){&disc, &odd, 8, 0, 0, 0});
}

/* The model's change changes the kind that no one names: its keys are dropped, but for those that
 * every kind has. */
static void a_swept_model_changes_the_default(void **state)
{
    good((said){.energy = 5, .size = 6}, (said){.model = &disc, .depth = 3},
         (body){&disc, &hard, 5, 2, 3, 0});
    good((said){.energy = 5, .size = 6}, (said){.model = &cloud},
         (body){&cloud, &soft, 5, 6, 0, 0});
    good((said){.model = &rod, .energy = 5, .size = 6}, (said){.model = &disc, .law = &odd},
         (body){&disc, &odd, 5, 0, 0, 0});
    good((said){.law = &odd, .energy = 5}, (said){.model = &disc}, (body){&disc, &odd, 5, 0, 0, 0});
    /* hard does not go with the default model: no point has that */
    good((said){.law = &hard, .energy = 5, .size = 6, .depth = 3}, (said){.model = &disc},
         (body){&disc, &hard, 5, 6, 3, 0});
}

/* What only some models have holds at points of these, also where the base names another and the
 * sweep changes the kind; at others nothing is set. Whether any point has it is seen when all are
 * there (test_campaign_errors). */
static void some_models_have_it(void **state)
{
    good((said){.energy = 5, .grip = 3}, (said){0},
         (body){.model = &rod, .law = &soft, .energy = 5, .size = 1});
    good((said){.energy = 5, .grip = 3}, (said){.model = &disc, .depth = 3},
         (body){&disc, &hard, 5, 2, 3, 3});
    good((said){.model = &rod, .energy = 5, .grip = 3}, (said){.model = &disc, .law = &odd},
         (body){&disc, &odd, 5, 0, 0, 3});
    good((said){.model = &disc, .law = &odd}, (said){.grip = 4}, (body){&disc, &odd, 8, 0, 0, 4});
    good((said){.model = &disc, .law = &odd, .grip = 4}, (said){.model = &rod},
         (body){&rod, &odd, 8, 0, 0, 0});
    bad((said){.energy = 5}, (said){.grip = 4},
        "f:13:3: `grip` belongs to model disc or cloud; this is rod, the default, as no `model` is "
        "given");
    bad((said){.model = &rod, .energy = 5}, (said){.grip = 4},
        "f:13:3: `grip` belongs to model disc or cloud; this is rod (line 6)");
    bad((said){.model = &disc, .law = &odd}, (said){.model = &rod, .grip = 4},
        "f:13:3: `grip` belongs to model disc or cloud; this is rod (line 16)");
}

static void others_are_refused(void **state)
{
    bad((said){.law = &hard, .depth = 1}, (said){0},
        "f:4:3: `law`: hard cannot be combined with model rod, which takes soft or odd");
    bad((said){.model = &disc, .law = &soft, .energy = 1}, (said){.law = &odd},
        "f:4:3: `law`: soft cannot be combined with model disc, which takes hard or odd; the model "
        "is chosen at line 6");
    bad((said){.law = &soft, .energy = 1}, (said){.model = &disc},
        "f:4:3: `law`: soft cannot be combined with model disc, which takes hard or odd; the model "
        "is chosen at line 16");
    bad((said){.energy = 1}, (said){.law = &hard, .depth = 1},
        "f:14:3: `law`: hard cannot be combined with model rod, which takes soft or odd");
    bad((said){.energy = 1}, (said){.depth = 1},
        "f:11:3: `depth` belongs to law hard; this is soft, the default, as no `law` is given");
    bad((said){.model = &disc}, (said){0},
        "f:1:1: cohesive with law hard (the default) needs `depth` (a number): a pure number");
}

TESTS(defaults_go_by_the_model, a_swept_model_changes_the_default, some_models_have_it,
      others_are_refused)
