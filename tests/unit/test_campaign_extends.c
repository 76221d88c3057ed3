/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which campaigns a study takes after its own. */
#include "tests/support/campaign_text.h"

static void test_extends(void **state)
{
    static const struct {
        const char *find, *put, *words[3]; /* no words: it extends */
    } table[] = {
        {"replicas: 3", "replicas: 4", {NULL}},
        {"name: test", "name: other", {NULL}},
        {"rate: [1e3, 1e4]", "rate: [1e2, 1e3, 2e3, 1e4]", {NULL}},
        {"rate: [1e3, 1e4]", "rate: [1e4, 1e3]", {NULL}},
        {"replicas: 3", "replicas: 2", {"replicas is 3 in the study", "but 2", "only grow"}},
        {"seed: 7", "seed: 7\nrandom_numbers: independent", {NULL}},
        {"seed: 7",
         "seed: 7\nrandom_numbers: common",
         {"random_numbers is independent in the study", "but common", "it must stay"}},
        {"seed: 7", "seed: 8", {"seed is 7 in the study", "but 8"}},
        {"history: 10", "history: 20", {"output.history is 10 in the study", "but 20"}},
        {"history: 10",
         "history: 10\n  interfaces: true",
         {"output.interfaces is false", "but true"}},
        {"rate: [1e3, 1e4]",
         "rate: [1e3, 2e4]",
         {"loading.rate is 10000 1/s in the study (its point 1)", "but 20000 1/s"}},
        {"young: 275 GPa",
         "young: 276 GPa",
         {"material.young is 275000000000 Pa", "but 276000000000 Pa"}},
        {"ends: periodic", "ends: held", {"geometry.ends is periodic", "but held"}},
        {"stop: quiet\n  end: 500 ns\n  quiet: 100 ns",
         "stop: time\n  end: 500 ns",
         {"time.quiet is 1e-07 s", "but nothing"}},
        {"law: nitsche",
         "law: nitsche\n  beta: 3",
         {"cohesive.beta is 4 in the study", "but 3 in"}},
    };
    OWNED char *text = replace(plain_campaign, "", "sweep:\n  - loading.rate: [1e3, 1e4]\n");
    OWN(fracas_campaign) before = read_text(text);
    for (size_t i = 0; i < FRACAS_COUNT(table); i++) {
        OWNED char *changed = replace(text, table[i].find, table[i].put);
        OWN(fracas_campaign) now = read_text(changed);
        check_extends(now, before, table[i].words);
    }
    /* The name of a case is none of its values. */
    OWNED char *named = replace(plain_campaign, "",
                                "sweep:\n  - cases: [{name: a, loading.rate: 1}]"),
               *renamed = replace(named, "a, loading.rate: 1", "b, loading.rate: 2");
    OWN(fracas_campaign) first = read_text(named), *second = read_text(renamed);
    check_extends(second, first,
                  (const char *const[3]){"loading.rate is 1 1/s in the study", "but 2 1/s"});
}

TESTS(test_extends)
