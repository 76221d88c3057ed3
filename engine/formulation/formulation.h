/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A formulation: bulk and interface kernels of one kind of body, behind one table of functions. The
 * solver owns clocks, ledger, stop rules and histories; a formulation owns the state of its degrees
 * of freedom and advances it by one step for all lanes. */
#ifndef FRACAS_ENGINE_FORMULATION_FORMULATION_H
#define FRACAS_ENGINE_FORMULATION_FORMULATION_H

#include "base/team.h"
#include "engine/engine.h"
#include "engine/fields.h"
#include "engine/fragments/ellipsoid.h"
#include "engine/fragments/fragments.h"
#include "engine/fragments/rest.h"

typedef struct fracas_formulation fracas_formulation;

struct fracas_model {
    const fracas_formulation *formulation;
    fracas_spec spec;
    size_t elements, interfaces;
    size_t bytes;                     /* all arrays together */
    size_t strengths;                 /* per interface: 1 unless model_init says more */
    double mass;                      /* kg */
    double element_size, longest;     /* m: mean and largest length h of an element */
    double wave_speed;                /* m/s, of longitudinal waves */
    double *table;                    /* the formulation's own; freed with the model */
    const struct fracas_chain *chain; /* fields of a chain's state; NULL of a surface */
    uint32_t *notch; /* interfaces that are broken from the start, rising; freed with the model */
    size_t nnotch;
    double *sizes; /* m, a chain's elements; NULL: all element_size; freed with the model */
    const struct fracas_surface *surface;     /* NULL of a chain; destroyed with the model */
    void *plan;                               /* the formulation's own, freed by plan_destroy */
    double critical_closed, critical_cracked; /* s: all interfaces uncracked; broken, in contact */
    double critical_step;                     /* s, the smaller of the two */
    double time_step;                         /* s */
    double tolerance;                         /* 1, of the energy guard: 0.05; tests have others */
    double own[FRACAS_LAW_OWN];               /* the law's own numbers, as its kernels read them */
    fracas_motion rigid_part; /* the body's motion that can never become strain energy */
};

#define FRACAS_ENERGY_LANES(key, role, unit, meaning) double key[FRACAS_LANES_MAX];

/* Fragments of a lane. */
typedef struct {
    int64_t all, held; /* held: with nodes that a load moves, which never stops */
    double size;       /* m, of a mean one of the others: length, or square root of the area */
} fracas_census;

/* How the parts of a body are computed at once: the formulation's own plan. */
typedef struct {
    bool reactions; /* in: reactions are asked for */
    size_t parts;   /* 1: it is not divided */
    size_t fields;  /* doubles of a lane's memory: its state, then room within a step */
    void *plan;     /* freed by division_destroy; NULL: none */
} fracas_division;

/* A point of the body: an element's, by the values of its shape functions there. */
typedef struct {
    size_t element;
    double weight[6]; /* by node */
    double place[3];  /* m, before any motion */
    double distance;  /* m, from what was asked for */
} fracas_spot;

/* One step of a batch, and the sums of its lanes so far. Arrays are [lane]. */
typedef struct {
    int width; /* lanes of the batch: 1, 4, 8 */
    int lanes; /* lanes of one kernel; the batch is width/lanes such groups */
    fracas_isa isa;
    bool balanced; /* crossings are balanced in some lane */
    double *state; /* owned by the batch, laid out by the formulation, group after group */
    fracas_division division;
    fracas_team *team;          /* one member a part */
    fracas_partition partition; /* one lane at a time, found anew for each use */
    double *onset_time;         /* [interface][lane], s; NULL unless interfaces are kept */
    double *break_time;         /* the same */
    /* in: time of the step, the time step that led to it (0 in the first), and that of velocities
     */
    _Alignas(64) double time[FRACAS_LANES_MAX], drift[FRACAS_LANES_MAX], kick[FRACAS_LANES_MAX];
    /* in, out: the next time step: the model's, unless the formulation refines it */
    double next[FRACAS_LANES_MAX];
    /* in: 1 where crossings are balanced (balance.5), else 0 */
    double balance[FRACAS_LANES_MAX];
    /* out: energies [J] at this time (engine/energies.h). `created`, `friction` and `damped`
     * accumulate;
     * `work` is the load's since the step before, beside its `power` [W] now. */
    union {
        struct {
            FRACAS_EACH_ENERGY(FRACAS_ENERGY_LANES)
        };
        double energy[FRACAS_ENERGIES][FRACAS_LANES_MAX];
    };
    double power[FRACAS_LANES_MAX];
    /* the formulation's own: power of the drive at the velocities after the step before [W], of
     * each motion of nodes the force along its path [N]; square of the angular velocity [1/s2] */
    double driven[FRACAS_LOADINGS][FRACAS_LANES_MAX];
    _Alignas(64) double spin[FRACAS_LANES_MAX];
    /* the same: amplitudes of loads now, a step before  (loads.2) */
    _Alignas(64) double amplitude[FRACAS_LOADINGS][FRACAS_LANES_MAX];
    _Alignas(64) double amplitude_before[FRACAS_LOADINGS][FRACAS_LANES_MAX];
    /* the same: path of each motion of nodes now and a step later [m]  (loads.6) */
    _Alignas(64) double path[FRACAS_LOADINGS][FRACAS_LANES_MAX];
    _Alignas(64) double path_next[FRACAS_LOADINGS][FRACAS_LANES_MAX];
    /* accumulated: counts of interfaces, time of the first onset [s, NaN] */
    double first_onset[FRACAS_LANES_MAX];
    int64_t cracked[FRACAS_LANES_MAX], broken[FRACAS_LANES_MAX];
} fracas_step;

struct fracas_formulation {
    fracas_kind kind; /* first: a registry entry */
    double safety;    /* largest with which the ledger stays closed for long (balance.md) */
    bool flat;        /* a surface in a plane z = const */
    /* Fills the model's sizes, mass, table and critical steps from its spec. */
    fracas_err (*model_init)(fracas_model *model);
    /* Takes contact away from the model's notch; NULL: all notches have it. */
    void (*part_notch)(fracas_model *model);
    /* Checks strengths, positive and finite already [Pa]. */
    fracas_err (*check_strength)(const fracas_model *model, double strength);
    /* Volume of the body that an interface stands for [m3]. */
    double (*interface_volume)(const fracas_model *model, size_t interface);
    /* As fracas_model_interface_positions; NULL of surfaces, whose mesh says it. */
    void (*interface_positions)(const fracas_model *model, double (*position)[3]);
    /* Frees the model's plan; NULL: it has none. */
    void (*plan_destroy)(void *plan);
    /* Doubles that a lane's state takes. */
    size_t (*state_size)(const fracas_model *model);
    /* The most parts into which the body can be divided; NULL: 1. */
    size_t (*parts_most)(const fracas_model *model);
    /* Divides the body into `parts`, or fewer. NULL: it is not divided. */
    fracas_err (*divide)(const fracas_model *model, size_t parts, fracas_division *division);
    void (*division_destroy)(void *plan);
    /* First strength of a lane in the state, and the distance to the next. */
    double *(*strength)(const fracas_model *model, const fracas_step *step, int lane,
                        size_t *stride);
    /* Prepares the state of one lane for the first step, its strengths being there. */
    void (*lane_init)(const fracas_model *model, const fracas_step *step, int lane);
    /* Drift, forces, energies, events, kick of all lanes. */
    void (*advance)(const fracas_model *model, fracas_step *step);
    /* Counts the fragments of a lane after a step. */
    fracas_err (*count)(const fracas_model *model, fracas_step *step, int lane,
                        fracas_census *census);
    /* Labels the fragment of each element in the step's partition; returns their number. */
    size_t (*partition)(const fracas_model *model, fracas_step *step, int lane);
    /* Adds nodes and strain energies of all elements to the sums of their fragments, by the
     * partition's labels; velocities less the fragments' motions, unless those are NULL. */
    void (*add_up)(const fracas_model *model, const fracas_step *step, int lane,
                   const fracas_fragment_motion *motion, fracas_fragment_sums *sums);
    /* Gradient of the motion left out by velocities of add_up [1/s]; NULL: 0. */
    double (*background)(const fracas_model *model, double time);
    /* Breaks still to come, by the energy of each fragment of the partition [J] and the sums of
     * each element; NULL: unknown. */
    fracas_err (*rest)(const fracas_model *model, const fracas_step *step, int lane,
                       const double *energy, const fracas_fragment_sums *element,
                       fracas_rest *rest);
    /* Fragments, momentum and (if kept) interface rows of one lane, into the record; leaves the
     * labels of its partition. */
    fracas_err (*harvest)(const fracas_model *model, fracas_step *step, int lane,
                          fracas_record *record);
    size_t (*element_nodes)(const fracas_model *model);
    /* Adds the matter of a fragment's `count` elements, their numbers rising, where it is; fills
     * `node` with their nodes [m]. */
    void (*add_matter)(const fracas_model *model, const fracas_step *step, int lane,
                       const uint32_t *element, size_t count, fracas_fragment_matter *matter,
                       double (*node)[3]);
    /* Adds the area of each broken interface, before any motion [m2], to both sides' fragments. */
    void (*add_cracks)(const fracas_model *model, const fracas_step *step, int lane,
                       fracas_fragment *fragment);
    fracas_stress_array stress[FRACAS_STRESSES]; /* an element's; fewer: the last has no name */
    size_t (*interface_nodes)(const fracas_model *model);
    /* The point of the body nearest to a place before any motion [m]; on interfaces, the element of
     * the lowest number. */
    void (*locate)(const fracas_model *model, const double place[3], fracas_spot *spot);
    /* Displacement [m], the background's included, and velocity there [m/s], after a step. */
    void (*motion_at)(const fracas_model *model, const fracas_step *step, int lane,
                      const fracas_spot *spot, double displacement[3], double velocity[3]);
    /* Edges that hold the body, by their tags, rising; returns their number. NULL: it has none. */
    size_t (*held_edges)(const fracas_model *model, int64_t tag[FRACAS_HOLDERS]);
    /* Forces of these edges on the body after a step [N], where the division has `reactions`. */
    void (*reactions)(const fracas_model *model, const fracas_step *step, int lane,
                      double (*force)[3]);
    /* Fills all of a lane's fields after a step but fragments. */
    void (*fields)(const fracas_model *model, const fracas_step *step, int lane,
                   fracas_fields *fields);
};

extern const fracas_formulation fracas_formulation_bar, fracas_formulation_ring,
    fracas_formulation_membrane, fracas_formulation_shell;

#endif
