#include "engine/cohesive/law.h"

static const fracas_param nitsche[] = {
    {"beta", FRACAS_REAL, "1", "interface stiffness K = beta E/h; above 1 for a positive operator, 1.5 or more in practice", 4, 1, 1e4, true,
     offsetof(fracas_cohesive, beta)},
};
const fracas_kind fracas_law_nitsche = {
    .name = "nitsche", .doc = "linear softening, the opening in series with the discontinuous-Galerkin flux",
    .params = nitsche, .nparams = FRACAS_COUNT(nitsche)};
const fracas_kind fracas_law_rigid_link = {
    .name = "rigid-link", .doc = "linear softening of a link that is rigid until its stress has exceeded its strength, "
                                 "contact by penalty (the algorithm of the code DynFrag1D)"};

static const fracas_kind *const laws[] = {&fracas_law_nitsche, &fracas_law_rigid_link};

static const fracas_param cohesive[] = {
    {"fracture_energy", FRACAS_REAL, "J/m2", "fracture energy G_c", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_cohesive, fracture_energy)},
};
const fracas_section fracas_cohesive_section = {
    .name = "cohesive", .doc = "How interfaces open", .selector = "law", .kinds = laws, .nkinds = FRACAS_COUNT(laws),
    .kind_offset = offsetof(fracas_cohesive, law), .params = cohesive, .nparams = FRACAS_COUNT(cohesive),
    .offset = offsetof(fracas_spec, cohesive), .hashed = true,
};
