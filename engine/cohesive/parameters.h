/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters that laws share, and the head of a law's table; for law.c. */
#ifndef FRACAS_ENGINE_COHESIVE_PARAMETERS_H
#define FRACAS_ENGINE_COHESIVE_PARAMETERS_H

#include "engine/cohesive/law.h"

/* Head of fracas_law_NAME, whose parameters are NAME_params. */
#define FRACAS_LAW_HEAD(law, name_, doc_) \
    .number = FRACAS_LAW_##law,           \
    .kind = {.name = name_, .doc = doc_, FRACAS_PARAMS(law##_params), .only = law##_models}

/* A number, by its key and its member: own[...] of a law's own. */
#define FRACAS_LAW_NUMBER(key, member, si, otherwise, least, most, open, models, text)            \
    FRACAS_BRACES(.name = key, .type = FRACAS_REAL, .unit = si, .doc = text,                      \
                  .fallback = otherwise, .minimum = least, .maximum = most, .minimum_open = open, \
                  .offset = offsetof(fracas_cohesive, member), .only = models)

/* One whose member has its name. */
#define FRACAS_LAW_REAL(key, ...) FRACAS_LAW_NUMBER(#key, key, __VA_ARGS__)

/* Parameters of laws for surfaces, whose interfaces slide, too ... */
#define FRACAS_SURFACE_LAW FRACAS_SURFACE_SHAPED("strength delta_c/2")

/* ... of another G_c by delta_c ... */
#define FRACAS_SURFACE_SHAPED(energy)                                          \
    FRACAS_SURFACE_OPENING(energy), FRACAS_SURFACE_INTERFACE,                  \
        FRACAS_LAW_REAL(friction, "1", 0, 0, 10, false, FRACAS_GROUP_SURFACES, \
                        "Coulomb's coefficient of friction between closed faces, mu_c")

/* ... without friction. */
#define FRACAS_SURFACE_FRICTIONLESS \
    FRACAS_SURFACE_OPENING("strength delta_c/2"), FRACAS_SURFACE_INTERFACE

#define FRACAS_SURFACE_OPENING(energy)                                                             \
    FRACAS_LAW_REAL(fracture_energy, "J/m2", 0, 0, INFINITY, false, FRACAS_GROUP_SURFACES,         \
                    "fracture energy G_c, the same at every interface; or give critical_opening"), \
        FRACAS_LAW_REAL(critical_opening, "m", 0, 0, INFINITY, false, FRACAS_GROUP_SURFACES,       \
                        "opening delta_c at which an interface is broken, the same at every one: " \
                        "its G_c is " energy "; or give fracture_energy")

#define FRACAS_SURFACE_INTERFACE                                                                   \
    FRACAS_LAW_REAL(beta, "1", 5, 1.3, 1e4, false, FRACAS_GROUP_MEMBRANE,                          \
                    "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element "     \
                    "by its edge; 1.3 or more, 2.3 with quadratic triangles"),                     \
        FRACAS_LAW_REAL(beta, "1", 5, 2.3, 1e4, false, FRACAS_GROUP_SHELL,                         \
                        "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element " \
                        "by its edge"),                                                            \
        FRACAS_LAW_REAL(beta_shear, "1", 1, 0, 1e4, true, FRACAS_GROUP_SHELL,                      \
                        "stiffness that keeps faces from shearing off across the shell: "          \
                        "beta_shear E thickness/(2 (1 + nu) h) by length of the edge"),            \
        {FRACAS_ONE_OF("onset", onsets, offsetof(fracas_cohesive, onset),                          \
                       "what is held against the strength"),                                       \
         .only = FRACAS_GROUP_SURFACES},                                                           \
        FRACAS_LAW_REAL(coupling, "1", 1, 0.01, 100, false, FRACAS_GROUP_SURFACES,                 \
                        "shear strength by normal strength, beta_c")

#endif
