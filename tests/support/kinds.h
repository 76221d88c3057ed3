/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Kinds of a section by their names. */
#ifndef FRACAS_TESTS_SUPPORT_KINDS_H
#define FRACAS_TESTS_SUPPORT_KINDS_H

#include "base/param.h"
#include "tests/support/test.h"

static inline const fracas_kind *kind_of(const fracas_section *section, const char *name)
{
    for (size_t k = 0; k < section->nkinds; k++)
        if (strcmp(section->kinds[k]->name, name) == 0) return section->kinds[k];
    fail_msg("no %s in %s", name, section->name);
    return NULL;
}

/* An uncertain parameter of a distribution, by its name. */
#define UNCERTAIN(distribution, ...) \
    ((fracas_uncertain){.kind = kind_of(&fracas_uncertain_section, distribution), __VA_ARGS__})

#endif
