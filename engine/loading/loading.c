#include "engine/loading/loading.h"

static const fracas_param imposed_rate[] = {
    {"rate", FRACAS_REAL, "1/s", "strain rate; velocities start as rate x", FRACAS_REQUIRED, 0, INFINITY, true,
     offsetof(fracas_loading, rate)},
};
const fracas_kind fracas_loading_imposed_rate = {
    .name = "imposed-rate", .doc = "uniform stretching at a constant strain rate",
    .params = imposed_rate, .nparams = FRACAS_COUNT(imposed_rate)};

static const fracas_kind *const loadings[] = {&fracas_loading_imposed_rate};

const fracas_section fracas_loading_section = {
    .name = "loading", .doc = "What stretches the body", .selector = "type", .kinds = loadings,
    .nkinds = FRACAS_COUNT(loadings), .kind_offset = offsetof(fracas_loading, type),
    .offset = offsetof(fracas_spec, loading), .hashed = true,
};
