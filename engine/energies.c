/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/energies.h"

#define DESCRIBE(key, role, unit, meaning) {#key, unit, meaning, FRACAS_ROLE_##role},
const fracas_energy_descriptor fracas_energies[FRACAS_ENERGIES] = {FRACAS_EACH_ENERGY(DESCRIBE)};

double fracas_energy_held(const double energy[FRACAS_ENERGIES], int first)
{
    double held = 0;
    for (int e = first; e < FRACAS_ENERGIES; e++)
        if (fracas_energies[e].role <= FRACAS_ROLE_SINK) held += energy[e];
    return held;
}

double fracas_energy_lost(const double energy[FRACAS_ENERGIES])
{
    double lost = 0;
    for (int e = 0; e < FRACAS_ENERGIES; e++)
        if (fracas_energies[e].role == FRACAS_ROLE_SINK) lost += energy[e];
    return lost;
}

/* (bar.14) */
double fracas_energy_residual(const double energy[FRACAS_ENERGIES], double initial)
{
    double residual = fracas_energy_held(energy, 0);
    for (int e = 0; e < FRACAS_ENERGIES; e++) {
        if (fracas_energies[e].role == FRACAS_ROLE_DAMPING) residual += energy[e];
        if (fracas_energies[e].role >= FRACAS_ROLE_SOURCE) residual -= energy[e];
    }
    return residual - initial;
}
