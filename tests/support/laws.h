/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths by hand, for tests of their laws. */
#ifndef FRACAS_TESTS_SUPPORT_LAWS_H
#define FRACAS_TESTS_SUPPORT_LAWS_H

#include "sampler/api/sampler.h"
#include "tests/support/kinds.h"
#include "tests/support/test.h"

/* Strengths of a law, by its name. */
#define STRENGTH(law, ...) \
    ((fracas_strength){.distribution = kind_of(&fracas_strength_section, law), __VA_ARGS__})

static inline const fracas_param *param_of(const fracas_kind *law, const char *key)
{
    for (size_t p = 0; p < law->nparams; p++)
        if (strcmp(law->params[p].name, key) == 0) return &law->params[p];
    abort();
}

/* A strength as a campaign file gives it: what is not given is NaN, or the default. */
static inline fracas_strength law_blank(const char *name)
{
    fracas_strength strength = {.distribution = kind_of(&fracas_strength_section, name)};
    const fracas_section *section = &fracas_strength_section;
    for (size_t p = 0; p < strength.distribution->nparams; p++) {
        const fracas_param *param = &strength.distribution->params[p];
        if (param->optional) fracas_param_clear(param, &strength);
        else if (param->type != FRACAS_ATTACHMENT)
            fracas_param_set(param, &strength, param->fallback);
    }
    for (size_t p = 0; p < section->nparams; p++)
        fracas_param_clear(&section->params[p], &strength);
    return strength;
}

/* Its mean and standard deviation given, above `minimum` for a Weibull law; of a normal law, of
 * what is kept. */
static inline fracas_strength law_by_moments(const char *name, double minimum, double mean,
                                             double deviation)
{
    fracas_strength strength = law_blank(name);
    if (strcmp(name, "weibull") == 0) strength.minimum = minimum;
    if (strcmp(name, "normal") == 0) {
        strength.own[0] = mean;
        strength.own[1] = deviation;
    } else {
        strength.mean = mean;
        strength.deviation = deviation;
    }
    return strength;
}

/* A file of measured strengths, or a table. */
static inline fracas_strength law_of_file(const fracas_attachment *file, bool steps)
{
    fracas_strength strength = law_blank("empirical");
    fracas_param_set(param_of(strength.distribution, "interpolation"), &strength, steps ? 1 : 0);
    strength.file = file;
    return strength;
}

/* A file named by a campaign. */
static inline fracas_attachment attached(const char *path, const char *text)
{
    return (fracas_attachment){.path = path, .text = text, .size = strlen(text), .digest = "0"};
}

#define FILE_OF(name, content)                                                    \
    {                                                                             \
        .path = name, .text = content, .size = sizeof(content) - 1, .digest = "0" \
    }

#endif
