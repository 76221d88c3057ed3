/* What one point of a campaign asks of the engine: every physical parameter, resolved, in SI. */
#ifndef FRACAS_ENGINE_SPEC_H
#define FRACAS_ENGINE_SPEC_H

#include "base/param.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    const fracas_kind *shape;     /* bar, ring */
    const fracas_kind *ends;      /* bar: periodic, held */
    const fracas_kind *direction; /* ring: initial, current; in which its interfaces open */
    double length; /* m, bar */
    double radius; /* m, ring */
    double area;   /* m2 */
} fracas_geometry;

typedef struct {
    const fracas_kind *spacing; /* uniform, graded, perturbed */
    int64_t elements;
    double ratio;        /* graded: size of the last element / size of the first; 1 */
    double amplitude;    /* perturbed: largest move of a node / element size; 1 */
    const double *noise; /* perturbed: [elements + 1] in [-1, 1], move of each node / largest; not a parameter: drawn outside */
} fracas_mesh;

typedef struct {
    double young;   /* Pa */
    double density; /* kg/m3 */
} fracas_material;

typedef struct {
    const fracas_kind *law;
    double fracture_energy;  /* J/m2; stershic: 0 where the critical opening is given */
    double beta;             /* nitsche: interface stiffness K = beta E/h; 1 */
    double critical_opening; /* m, stershic: 0 where the fracture energy is given */
    double penalty;          /* stershic: stiffness of contact / (E/h); 1 */
    double refinement;       /* stershic: factor xi of the time step for each critical zone; 1 */
    const fracas_kind *critical_zone; /* stershic: softening, steep; which open links refine the time step */
    double zone;             /* m, stershic: no interface opens within this distance of an open one; 0: no zone */
} fracas_cohesive;

typedef struct {
    const fracas_kind *type;      /* imposed-rate, initial-velocity, held-velocity, force */
    double rate;                  /* 1/s, imposed-rate */
    double radial, circumferential; /* m/s, initial-velocity */
    const fracas_kind *direction; /* held-velocity, force: radial, circumferential */
    double velocity;              /* m/s, held-velocity */
    double acceleration;          /* m/s2, held-velocity */
    double force;                 /* N/m, force: per length of the ring */
    double force_rate;            /* N/(m s), force */
} fracas_loading;

typedef struct {
    const fracas_kind *stop;
    double end;            /* s: set time, or cap */
    double quiet;          /* s */
    double quiet_fraction; /* 1 */
    double safety;         /* time step / critical time step; 1 */
} fracas_time;

typedef struct {
    const fracas_kind *formulation; /* `model` of the campaign file */
    fracas_geometry geometry;
    fracas_mesh mesh;
    fracas_material material;
    fracas_cohesive cohesive;
    fracas_loading loading;
    fracas_time time;
} fracas_spec;

/* What follows from the parameters alone, without a model. */
double fracas_spec_length(const fracas_spec *spec);           /* m, of the bar or along the ring */
double fracas_spec_interface_volume(const fracas_spec *spec); /* m3 of the body that an interface stands for, on average */
/* Strain rate that the loading begins with [1/s]: the imposed rate, or radial velocity / radius, initial or held; NaN for a
 * loading that gives none (a force, a circumferential velocity). */
double fracas_spec_strain_rate(const fracas_spec *spec);
/* G_c [J/m2] of an interface of this strength [Pa]: as given, or sigma_c delta_c/2. */
double fracas_spec_fracture_energy(const fracas_spec *spec, double strength);

/* Registry of the engine: `model` is the section of that name without parameters of its own, and the
 * others follow in the order of the struct; offsets are into fracas_spec. */
extern const fracas_section *const fracas_engine_sections[];
extern const size_t fracas_engine_nsections;

#endif
