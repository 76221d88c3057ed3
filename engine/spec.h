/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engine's input for one point of a campaign: every physical parameter, resolved, in SI. */
#ifndef FRACAS_ENGINE_SPEC_H
#define FRACAS_ENGINE_SPEC_H

#include "base/param.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FRACAS_EDGES 9 /* tags 1 to 8, and all others */

typedef struct {
    const fracas_kind *shape;      /* bar, ring; plate, annulus, sphere, file: surfaces */
    const fracas_kind *ends;       /* bar: periodic, held, free */
    const fracas_kind *direction;  /* ring: initial, current; in which its interfaces open */
    const fracas_kind *part;       /* sphere: whole, octant */
    double length;                 /* m, bar */
    double gap;                    /* m, bar with free ends: to a wall beyond each; NaN: none */
    double radius;                 /* m, ring, sphere */
    double area;                   /* m2, bar and ring: of the cross-section */
    double width, height;          /* m, plate */
    double inner, outer;           /* m, annulus: radii */
    const fracas_attachment *file; /* file: the mesh */
    const fracas_kind *unit;       /* file: of its coordinates; NULL: m */
    double thickness;              /* m, surfaces */
    const fracas_kind *edge[FRACAS_EDGES]; /* surfaces: edges of each tag; of any other the first */
} fracas_geometry;

typedef struct {
    const fracas_kind *spacing; /* uniform, graded, perturbed; triangles, given: surfaces */
    int64_t elements;           /* bar and ring */
    double ratio;               /* graded: size of the last element / size of the first; 1 */
    double amplitude;           /* perturbed, triangles: largest move of a node / element size; 1 */
    double size;                /* m, triangles: fracas_surface_fineness; or 0 and ... */
    int64_t divisions;          /* ... a number */
    int64_t order;              /* triangles: 1 linear, 2 quadratic */
    const double *noise; /* in [-1, 1], move of each node / largest; no parameter: drawn outside */
    size_t nnoise;       /* fracas_mesh_noise_count */
} fracas_mesh;

typedef struct {
    double young;   /* Pa */
    double density; /* kg/m3 */
    double poisson; /* 1, surfaces */
} fracas_material;

/* Groups of models, by which parameters and laws name those that have them. */
enum {
    FRACAS_GROUP_BAR = 1,
    FRACAS_GROUP_RING = 2,
    FRACAS_GROUP_MEMBRANE = 4,
    FRACAS_GROUP_SHELL = 8,
    FRACAS_GROUP_CHAINS = FRACAS_GROUP_BAR | FRACAS_GROUP_RING,
    FRACAS_GROUP_SURFACES = FRACAS_GROUP_MEMBRANE | FRACAS_GROUP_SHELL
};

enum { FRACAS_LAW_OWN = 4 }; /* numbers of a law's own, at most */

typedef struct {
    const fracas_kind *law;
    double fracture_energy;        /* J/m2; 0 where the critical opening is given */
    double beta;                   /* interface stiffness over E/h; 1 */
    double critical_opening;       /* m; 0 where the fracture energy is given */
    double beta_shear;             /* shells: stiffness against shearing off; 1 */
    const fracas_kind *onset;      /* surfaces: mean, flux; traction compared with the strength */
    double coupling;               /* surfaces: beta_c, shear strength / normal strength; 1 */
    double friction;               /* surfaces: mu_c, Coulomb's coefficient; 1 */
    double own[FRACAS_LAW_OWN];    /* numbers of one law alone: its file names them */
    const fracas_kind *own_choice; /* a choice of one law alone */
} fracas_cohesive;

/* Interfaces that are broken from the start lie along the straight line between two ends. Equal
 * ends: none do. */
typedef struct {
    double from[3], to[3];      /* m; NaN: 0, and `from` */
    double within;              /* m, from it at most; 0, NaN: fracas_notch_find */
    const fracas_kind *contact; /* surfaces: law, none; NULL: law */
} fracas_notch;

enum { FRACAS_LOADINGS = 3 }; /* at most, at a point */
/* Edges of each tag, and sets of nodes, one of a loading, that hold a surface. */
enum { FRACAS_HOLDERS = FRACAS_EDGES + FRACAS_LOADINGS };
enum { FRACAS_LOAD_OWN = 14 }; /* numbers of a load's own, at most */
/* How a surface starts, beside its load. NaN: not given; 0: none. */
typedef struct {
    double velocity[3];      /* m/s */
    double radial;           /* m/s, away from `at` or the axis */
    double spin;             /* rad/s, about an axis along z or `axis` */
    const fracas_kind *axis; /* x, y, z, through `at`; NULL: none */
    double half_waves[3];    /* 1: half waves of a sine from `from` to `to` */
    double at[3], within;    /* m: a place of this axis; nodes so far from it move */
    double from[3], to[3];   /* m: they lie within these limits */
    double strain[3];        /* 1, along x, y, z */
    double strain_xy;        /* 1 */
    double stress[2];        /* Pa, along x, y */
    double stress_xy;        /* Pa */
    double temperature;      /* K */
    double expansion;        /* 1/K */
} fracas_initial;

typedef struct {
    const fracas_kind *type;
    double rate;                    /* 1/s, imposed-rate, expansion */
    double ratio;                   /* 1, expansion: rate along y / rate along x */
    const fracas_kind *start;       /* expansion: moving, rest; the inside */
    double speed;                   /* rad/s, centrifugal */
    double ramp;                    /* s, centrifugal: time to reach it */
    double radial, circumferential; /* m/s, initial-velocity */
    const fracas_kind *direction;   /* held-velocity, force: radial, circumferential; edge-motion:
                                       outward, along, across; node-motion: x, y, z */
    double velocity;                /* m/s, held-velocity, motions; 0 there: displacement */
    double acceleration;            /* m/s2, held-velocity */
    double force;                   /* N/m, force: per length of the ring */
    double force_rate;              /* N/(m s), force */
    double ratio_z;                 /* 1, expansion of shells: as ratio, along z; NaN: 1 */
    const fracas_kind *edge;        /* loads on an edge: this one */
    const fracas_kind *second_edge; /* edge-motion: as the first; NULL: none */
    double displacement;            /* m, motions; 0: velocity */
    const fracas_kind *rise_by;     /* motions: smooth, linear */
    double own[FRACAS_LOAD_OWN];    /* numbers of one load alone: its file names them */
    const fracas_kind *own_choice;  /* a choice of one load alone */
    /* amplitude of loads (engine/loading/load.h), of which motions have
     * rise and history; NaN: not given */
    double rise, decay, duration;     /* s */
    const fracas_attachment *history; /* times [s] and factors; NULL: none */
    double front;                     /* m/s */
    const fracas_kind *front_along;   /* x, y, z; NULL: x */
    double front_at, front_from;      /* m */
    double decay_by_travel;           /* 1 */
    /* place of pressure and body-force; NaN: not given */
    double spot, spot_decay; /* m */
    double spot_at[3];       /* m */
} fracas_loading;

typedef struct {
    const fracas_kind *stop;
    double end;            /* s: set time, or cap */
    double transits;       /* 1, settled and transits: least k */
    double growth;         /* 1, settled: largest Delta */
    double rest;           /* 1, settled, bar and ring: largest R over the count, or 15 */
    double quiet;          /* s */
    double quiet_fraction; /* 1 */
    double multiple;       /* 1, peak-multiple */
    double drop;   /* 1, peak-multiple: least relative fall of the elastic energy after its peak */
    double safety; /* time step / critical time step; 1 */
    const fracas_kind *integrator; /* surfaces: central-difference, hulbert-chung */
    double spectral_radius;        /* 1, hulbert-chung: at the bifurcation */
    const fracas_kind *mass;       /* surfaces: lumped, consistent */
    double rotary_inertia;         /* 1, shells: counted share of rho thickness^3/12; NaN: none */
} fracas_time;

typedef struct {
    const fracas_kind *formulation; /* `model` of the campaign file */
    bool strength_per_point;        /* surfaces: each Gauss point of an interface has a strength */
    fracas_geometry geometry;
    fracas_mesh mesh;
    fracas_material material;
    fracas_cohesive cohesive;
    fracas_notch notch;
    fracas_initial initial;
    fracas_loading loading, also[FRACAS_LOADINGS - 1]; /* `also`: loads; of type NULL: none */
    fracas_time time;
    /* Frequencies of earlier models; this one's are added. No parameter; NULL: none. */
    struct fracas_frequencies *frequencies;
} fracas_spec;

/* Length of the bar or along the ring [m]; NaN for surfaces. */
double fracas_spec_length(const fracas_spec *spec);
/* Strain rate at the start [1/s]: imposed, radial velocity / radius, or along x of an expansion;
 * NaN for other loadings. */
double fracas_spec_strain_rate(const fracas_spec *spec);
/* G_c [J/m2] of an interface of this strength [Pa]: as given, or by delta_c and the law's shape. */
double fracas_spec_fracture_energy(const fracas_spec *spec, double strength);
/* |rate|/edot0 of this strength [Pa]  (scaling-laws.3); NaN as the strain rate. */
double fracas_spec_normalised_rate(const fracas_spec *spec, double strength);
/* Its delta_c [m]: as given, or by G_c and the law's shape. */
double fracas_spec_critical_opening(const fracas_spec *spec, double strength);

/* Registry of the engine: `model` is the section of that name without parameters of its own, and
 * the others follow in the order of the struct; offsets are into fracas_spec. */
extern const fracas_section *const fracas_engine_sections[];
extern const size_t fracas_engine_nsections;

#endif
