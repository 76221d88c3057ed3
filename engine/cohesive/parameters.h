/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters that laws share, and the head of a law's table; for law.c. */
#ifndef FRACAS_ENGINE_COHESIVE_PARAMETERS_H
#define FRACAS_ENGINE_COHESIVE_PARAMETERS_H

#include "engine/cohesive/law.h"

/* Head of fracas_law_NAME, whose parameters are NAME_params. */
#define FRACAS_LAW_HEAD(law, name_, doc_)                                       \
    .number = FRACAS_LAW_##law, .kind = {.name = name_,                         \
                                         .doc = doc_,                           \
                                         .params = law##_params,                \
                                         .nparams = FRACAS_COUNT(law##_params), \
                                         .only = law##_models}

/* G_c of a chain; `otherwise` is its default. */
#define FRACAS_FRACTURE_ENERGY(least, otherwise, what)                               \
    {                                                                                \
        "fracture_energy", FRACAS_REAL, "J/m2", what, otherwise, 0, INFINITY, least, \
            offsetof(fracas_cohesive, fracture_energy)                               \
    }

/* Parameters of laws for surfaces, whose interfaces slide, too. */
#define FRACAS_SURFACE_LAW                                                                       \
    {"fracture_energy",                                                                          \
     FRACAS_REAL,                                                                                \
     "J/m2",                                                                                     \
     "fracture energy G_c, the same at every interface; or give critical_opening",               \
     0,                                                                                          \
     0,                                                                                          \
     INFINITY,                                                                                   \
     false,                                                                                      \
     offsetof(fracas_cohesive, fracture_energy),                                                 \
     .only = fracas_surface_models},                                                             \
        {"critical_opening",                                                                     \
         FRACAS_REAL,                                                                            \
         "m",                                                                                    \
         "opening delta_c at which an interface is broken, the same at every one: its G_c is "   \
         "strength delta_c/2; or give fracture_energy",                                          \
         0,                                                                                      \
         0,                                                                                      \
         INFINITY,                                                                               \
         false,                                                                                  \
         offsetof(fracas_cohesive, critical_opening),                                            \
         .only = fracas_surface_models},                                                         \
        {"beta",                                                                                 \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element by its edge; " \
         "1.3 or more, 2.3 "                                                                     \
         "with quadratic triangles",                                                             \
         5,                                                                                      \
         1.3,                                                                                    \
         1e4,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, beta),                                                        \
         .only = fracas_membrane_models},                                                        \
        {"beta",                                                                                 \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "interface stiffness K = beta E/((1 - nu^2) h), h the area of an element by its edge",  \
         5,                                                                                      \
         2.3,                                                                                    \
         1e4,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, beta),                                                        \
         .only = fracas_shell_models},                                                           \
        {"beta_shear",                                                                           \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "stiffness that keeps faces from shearing off across the shell: beta_shear E "          \
         "thickness/(2 (1 + nu) h) by "                                                          \
         "length of the edge",                                                                   \
         1,                                                                                      \
         0,                                                                                      \
         1e4,                                                                                    \
         true,                                                                                   \
         offsetof(fracas_cohesive, beta_shear),                                                  \
         .only = fracas_shell_models},                                                           \
        {.name = "onset",                                                                        \
         .type = FRACAS_CHOICE,                                                                  \
         .unit = "1",                                                                            \
         .doc = "what is held against the strength",                                             \
         .choices = onsets,                                                                      \
         .nchoices = FRACAS_COUNT(onsets),                                                       \
         .offset = offsetof(fracas_cohesive, onset),                                             \
         .only = fracas_surface_models},                                                         \
        {"coupling",                                                                             \
         FRACAS_REAL,                                                                            \
         "1",                                                                                    \
         "shear strength by normal strength, beta_c",                                            \
         1,                                                                                      \
         0.01,                                                                                   \
         100,                                                                                    \
         false,                                                                                  \
         offsetof(fracas_cohesive, coupling),                                                    \
         .only = fracas_surface_models},                                                         \
    {                                                                                            \
        "friction", FRACAS_REAL, "1",                                                            \
            "Coulomb's coefficient of friction between closed faces, mu_c", 0, 0, 10, false,     \
            offsetof(fracas_cohesive, friction), .only = fracas_surface_models                   \
    }

#endif
