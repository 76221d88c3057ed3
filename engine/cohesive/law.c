/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/cohesive/law.h"

#include "engine/cohesive/parameters.h"

#include <stdio.h>
#include <string.h>

const fracas_kind fracas_onset_mean = {"mean", "the mean of the stresses on both sides"};
const fracas_kind fracas_onset_flux = {"flux", "the traction of the discontinuous-Galerkin flux"};
static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};

bool fracas_onset_by_mean(const fracas_cohesive *cohesive)
{
    return cohesive->onset != &fracas_onset_flux;
}

static const fracas_law *law_of(const fracas_cohesive *cohesive)
{
    return (const fracas_law *)(const void *)cohesive->law;
}

double fracas_law_fullness(const fracas_cohesive *cohesive)
{
    const fracas_law *law = law_of(cohesive);
    return law->fullness ? law->fullness(cohesive) : 0.5;
}

double fracas_law_steepest(const fracas_cohesive *cohesive)
{
    const fracas_law *law = law_of(cohesive);
    return law->steepest ? law->steepest(cohesive) : 1;
}

double fracas_law_zone(const fracas_cohesive *cohesive)
{
    const fracas_law *law = law_of(cohesive);
    return law->zone ? law->zone(cohesive) : 0;
}

void fracas_law_own(const fracas_spec *spec, double own[FRACAS_LAW_OWN])
{
    const fracas_law *law = fracas_law_of(spec);
    memcpy(own, spec->cohesive.own, sizeof spec->cohesive.own);
    if (law->own) law->own(spec, own);
}

/* The models with kernels for each law. */
#define FRACAS_LAW(name, bar, ring, membrane, shell)                                              \
    enum {                                                                                        \
        name##_models = FRACAS_IF_##bar(FRACAS_GROUP_BAR |) FRACAS_IF_##ring(FRACAS_GROUP_RING |) \
            FRACAS_IF_##membrane(FRACAS_GROUP_MEMBRANE |)                                         \
                FRACAS_IF_##shell(FRACAS_GROUP_SHELL |) 0                                         \
    };
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW

#define FRACAS_LAW_TABLES
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW_TABLES

#define FRACAS_LAW(name, bar, ring, membrane, shell) &fracas_law_##name.kind,
static const fracas_kind *const laws[] = {
#include "engine/cohesive/laws.list.h"
};
#undef FRACAS_LAW

/* Some tables leave the choice between two keys; the others demand the fracture energy. */
static fracas_err check_cohesive(const void *section)
{
    const fracas_cohesive *cohesive = section;
    char takes[80];
    snprintf(takes, sizeof takes, "law %s takes", cohesive->law->name);
    return fracas_param_check_either(
        takes, (const char *const[]){"fracture_energy", "critical_opening"},
        (const double[]){cohesive->fracture_energy, cohesive->critical_opening},
        "fracture_energy: 100 J/m2");
}

const fracas_section fracas_cohesive_section = {
    .name = "cohesive",
    .doc = "How interfaces open",
    .selector = "law",
    FRACAS_KINDS(laws),
    .kind_offset = offsetof(fracas_cohesive, law),
    .offset = offsetof(fracas_spec, cohesive),
    .hashed = true,
    .check = check_cohesive,
};
