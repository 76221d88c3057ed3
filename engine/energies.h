/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The energies of a realization, each named once. A new one is a line of FRACAS_EACH_ENERGY and the
 * code for it. The table makes the members of a step, ledger, history row and record, the balance
 * (bar.14) with its residual, and the datasets of study.h5 with their descriptions. */
#ifndef FRACAS_ENGINE_ENERGIES_H
#define FRACAS_ENGINE_ENERGIES_H

/* Role of an energy in the balance (bar.14). */
typedef enum {
    FRACAS_ROLE_KINETIC, /* + */
    FRACAS_ROLE_STORED,  /* + */
    FRACAS_ROLE_SINK,    /* +, lost so far */
    FRACAS_ROLE_PART,    /* 0, part of the energy above it */
    FRACAS_ROLE_DAMPING, /* +, lost so far by the time integration: no measure of other energies */
    FRACAS_ROLE_SOURCE,  /* -, put in by the method so far */
    FRACAS_ROLE_LOAD     /* -, work of the load so far, integrated by the ledger (bar.13) */
} fracas_energy_role;

/* X(key, role, unit, meaning). Kinetic energy comes first; sums follow the order of the lines. */
#define FRACAS_EACH_ENERGY(X)                                                     \
    X(kinetic, KINETIC, "J", "kinetic energy")                                    \
    X(elastic, STORED, "J", "elastic energy of bulk and interfaces")              \
    X(cohesive, STORED, "J", "energy stored in openings and contact")             \
    X(dissipated, SINK, "J", "energy dissipated by opening cracks")               \
    X(dissipated_bending, PART, "J", "part of bending in `dissipated`")           \
    X(friction, SINK, "J", "energy dissipated by friction of closed cracks")      \
    X(damped, DAMPING, "J", "energy damped by the time integration")              \
    X(created, SOURCE, "J", "energy that the method put in at onsets and breaks") \
    X(work, LOAD, "J", "work of the loading")

#define FRACAS_ENERGY_PLACE(key, role, unit, meaning) FRACAS_ENERGY_##key,
enum { FRACAS_EACH_ENERGY(FRACAS_ENERGY_PLACE) FRACAS_ENERGIES }; /* FRACAS_ENERGY_kinetic, ... */

/* Members of a struct: each energy as `key`, and as energy[i] with i in the table's order [J]. */
#define FRACAS_ENERGY_MEMBER(key, role, unit, meaning) double key;
#define FRACAS_ENERGY_MEMBERS                        \
    union {                                          \
        struct {                                     \
            FRACAS_EACH_ENERGY(FRACAS_ENERGY_MEMBER) \
        };                                           \
        double energy[FRACAS_ENERGIES];              \
    }

/* The balance in words: "kinetic + elastic + ... - work - E(0)". */
#define FRACAS_TERM_KINETIC(key) #key
#define FRACAS_TERM_STORED(key) " + " #key
#define FRACAS_TERM_SINK(key) " + " #key
#define FRACAS_TERM_PART(key) ""
#define FRACAS_TERM_DAMPING(key) " + " #key
#define FRACAS_TERM_SOURCE(key) " - " #key
#define FRACAS_TERM_LOAD(key) " - " #key
#define FRACAS_ENERGY_TERM(key, role, unit, meaning) FRACAS_TERM_##role(key)
#define FRACAS_ENERGY_BALANCE FRACAS_EACH_ENERGY(FRACAS_ENERGY_TERM) " - E(0)"

typedef struct {
    const char *key, *unit, *meaning;
    fracas_energy_role role;
} fracas_energy_descriptor;

/* The table: fracas_energies[i] describes energy[i] of a record, a history row, a ledger. */
extern const fracas_energy_descriptor fracas_energies[FRACAS_ENERGIES];

/* Sum of the energies with role KINETIC, STORED or SINK, from line `first` on [J]. */
double fracas_energy_held(const double energy[FRACAS_ENERGIES], int first);

/* Sum of the sinks [J]: energy lost so far. */
double fracas_energy_lost(const double energy[FRACAS_ENERGIES]);

/* residual = held + damping - sources - load - initial [J], with held = fracas_energy_held(energy,
 * 0) (bar.14) */
double fracas_energy_residual(const double energy[FRACAS_ENERGIES], double initial);

#endif
