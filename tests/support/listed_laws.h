/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The laws of engine/cohesive/laws.list.h, for tests over all of them. */
#ifndef FRACAS_TESTS_SUPPORT_LISTED_LAWS_H
#define FRACAS_TESTS_SUPPORT_LISTED_LAWS_H

#include "engine/cohesive/law.h"
#include "engine/formulation/formulation.h"

/* How a model uses a law: an entry of its line. */
typedef enum { USE_NO, USE_FLUX, USE_RIGID, USE_YES, USE_RESULTANTS } law_use;

enum { MODEL_BAR, MODEL_RING, MODEL_MEMBRANE, MODEL_SHELL, MODELS };
static const fracas_kind *const model_kind[MODELS]
    __attribute__((unused)) = {&fracas_formulation_bar.kind, &fracas_formulation_ring.kind,
                               &fracas_formulation_membrane.kind, &fracas_formulation_shell.kind};

typedef struct {
    const fracas_law *law;
    law_use use[MODELS];
} listed_law;

#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    {&fracas_law_##name, {USE_##bar, USE_##ring, USE_##membrane, USE_##shell}},
static const listed_law listed_laws[FRACAS_LAWS] __attribute__((unused)) = {
#include "engine/cohesive/laws.list.h"
};
#undef FRACAS_LAW

/* How many a model has. */
#define FRACAS_LAW(name, bar, ring, membrane, shell) +(USE_##bar != USE_NO)
enum {
    BAR_LAWS = 0
#include "engine/cohesive/laws.list.h"
};
#undef FRACAS_LAW
#define FRACAS_LAW(name, bar, ring, membrane, shell) +(USE_##membrane != USE_NO)
enum {
    MEMBRANE_LAWS = 0
#include "engine/cohesive/laws.list.h"
};
#undef FRACAS_LAW

/* The k-th law, from 0, that a model has; NULL after the last. */
static inline const fracas_law *law_of_model(int model, int k)
{
    for (int l = 0; l < FRACAS_LAWS; l++)
        if (listed_laws[l].use[model] != USE_NO && k-- == 0) return listed_laws[l].law;
    return NULL;
}

/* Numbers of a law's own, as they are by default, at their least, at their most (1 of those that
 * have none). The section's other values stay. */
enum { OWN_DEFAULT, OWN_LEAST, OWN_MOST, OWN_WAYS };
static inline void set_own_numbers(fracas_cohesive *section, int way)
{
    const fracas_kind *law = section->law;
    for (size_t p = 0; p < law->nparams; p++) {
        const fracas_param *param = &law->params[p];
        const size_t own = offsetof(fracas_cohesive, own);
        if (param->offset < own || param->offset >= own + sizeof section->own) continue;
        const double most = isfinite(param->maximum) ? param->maximum : 1,
                     least = param->minimum_open ? most / 16 : param->minimum;
        const double of[OWN_WAYS] = {
            isnan(param->fallback) ? 0.5 * (least + most) : param->fallback, least, most};
        fracas_param_set(param, section, of[way]);
    }
}

/* Gives a spec the k-th law of its model, with its own numbers by default; k beyond the last starts
 * again with the first. */
static inline void set_listed_law(fracas_spec *spec, int k)
{
    int model = 0;
    while (model_kind[model] != spec->formulation) model++;
    const int count = model == MODEL_BAR ? BAR_LAWS : MEMBRANE_LAWS;
    spec->cohesive.law = &law_of_model(model, k % count)->kind;
    set_own_numbers(&spec->cohesive, OWN_DEFAULT);
}

#endif
