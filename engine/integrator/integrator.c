/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/integrator/integrator.h"

const fracas_kind fracas_integrator_central_difference = {
    .name = "central-difference", .doc = "leapfrog: second order, damps nothing"};
const fracas_kind fracas_integrator_hulbert_chung = {
    .name = "hulbert-chung",
    .doc = "explicit generalised alpha: second order, damps high frequencies"};

const fracas_kind fracas_mass_lumped = {
    .name = "lumped",
    .doc = "diagonal; of quadratic triangles by the rule of Hinton, Rock and Zienkiewicz"};
const fracas_kind fracas_mass_consistent = {
    .name = "consistent",
    .doc = "the integral of the shape functions' products, inverted element by element"};
