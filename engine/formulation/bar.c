#include "engine/formulation/bar.h"

const fracas_kind fracas_bar = {.name = "bar", .doc = "a bar stretched at a uniform rate: the hoop direction of an expanding ring"};
