/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A model (immutable, shared), and batches of realizations advanced in SIMD lanes. */
#ifndef FRACAS_ENGINE_ENGINE_H
#define FRACAS_ENGINE_ENGINE_H

#include "base/own.h"
#include "base/err.h"
#include "base/isa.h"
#include "engine/record.h"
#include "engine/spec.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct fracas_model fracas_model;
typedef struct fracas_batch fracas_batch;

/* Mesh, operators and critical time step of one point. `spec` is copied. FRACAS_USAGE names
 * parameters that do not go together, FRACAS_ENVIRONMENT means no memory. */
FRACAS_MUST_USE fracas_err fracas_model_create(const fracas_spec *spec, fracas_model **model);
void fracas_model_destroy(fracas_model *model); /* NULL is allowed */
FRACAS_OWNER(fracas_model, fracas_model_destroy)

size_t fracas_model_interfaces(const fracas_model *model);
/* 1, or the Gauss points of an interface with spec.strength_per_point. A realization needs
 * fracas_model_interfaces times as many; strength k = interface*this + g. */
size_t fracas_model_strengths_per_interface(const fracas_model *model);
size_t fracas_model_elements(const fracas_model *model);
/* Mean length of elements, of surfaces of their edges [m]. */
double fracas_model_element_size(const fracas_model *model);
/* Arrays of a model, and of each lane of a batch [bytes]. */
double fracas_model_bytes(const fracas_model *model);
double fracas_model_lane_bytes(const fracas_model *model);
double fracas_model_time_step(const fracas_model *model); /* s, = safety * critical */
int64_t fracas_model_steps(const fracas_model *model);    /* steps to time.end, at most */
/* The most parts in which a realization can be computed at once. */
size_t fracas_model_parts_most(const fracas_model *model);
/* Largest time.safety with which the ledger stays closed for long after break-up: within 1e-3 of
 * the dissipated and 1e-2 of the vibrating energy to 100 times the break-up time. */
double fracas_model_long_safety(const fracas_model *model);

/* The mesh of a surface, which lives as long as the model; NULL for bars and rings. */
const struct fracas_surface *fracas_model_surface(const fracas_model *model);

/* Volume of the body around an interface [m3]: half of its two elements of a chain, a third of its
 * two triangles of a surface. */
double fracas_model_interface_volume(const fracas_model *model, size_t interface);

/* position[k]: initial place of strength k [m]. Interface of a surface: the middle between the ends
 * of its edge; of a bar: x from its left end; of a ring: on its circle, at the angle 2 pi (i +
 * 1)/n. Gauss point: there, on the edge, which may be curved. */
void fracas_model_interface_positions(const fracas_model *model, double (*position)[3]);

/* Area of an interface [m2]: the cross-section of a chain, length times thickness of a surface. */
double fracas_model_interface_area(const fracas_model *model, size_t interface);

/* Length of a bar whose ends are joined [m], 0 of any other body. */
double fracas_model_period(const fracas_model *model);

/* FRACAS_USAGE, with the remedy, for a strength [Pa] at which the law could not dissipate G_c on
 * this mesh (K <= sigma_c/delta_c). */
FRACAS_MUST_USE fracas_err fracas_model_check_strength(const fracas_model *model, double strength);

/* FRACAS_USAGE, with the nearest point of the body, for a probe that is farther from it than an
 * element is long; with `reactions` for a body without a held edge. */
FRACAS_MUST_USE fracas_err fracas_model_check_probes(const fracas_model *model,
                                                     const fracas_probes *probes, bool reactions);

typedef struct {
    int64_t history; /* history rows, at equal intervals of time.end; 0: only the events */
    bool interfaces; /* keep one row an interface */
    int width;       /* lanes: 1, 4, 8; 0 chooses by the number of realizations */
    fracas_isa isa;  /* FRACAS_ISA_BEST: the best this CPU has */
    int parts;       /* threads for a surface, the same bits; 0: 1 */
    const struct fracas_batch_watch *watch; /* NULL: nobody; must outlive the batch */
    const fracas_probes *probes;            /* NULL: none */
    bool reactions;                         /* keep the forces of held edges */
} fracas_batch_options;

/* Lanes of a batch of so many realizations, unless another width is asked for. */
int fracas_batch_width(size_t count);
/* A batch of `count` (1 to 8) realizations of `model`, which must outlive it. It makes all its
 * allocations here. Lanes beyond `count` repeat lane 0 and give no record. FRACAS_USAGE for a width
 * below `count` or an instruction set this CPU lacks. */
FRACAS_MUST_USE fracas_err fracas_batch_create(const fracas_model *model, size_t count,
                                               const fracas_batch_options *options,
                                               fracas_batch **batch);
void fracas_batch_destroy(fracas_batch *batch); /* NULL is allowed */
FRACAS_OWNER(fracas_batch, fracas_batch_destroy)

/* Strengths sigma_c [Pa] of realization `lane` (lane < count), to be filled before the run:
 * strength k (fracas_model_strengths_per_interface) is strength[k*stride]. */
double *fracas_batch_strength(fracas_batch *batch, size_t lane, size_t *stride);

/* Advances every lane to its own stop, once; record[l], l < count, must be initialised
 * (fracas_record_init) and then belongs to the caller. A lane's record depends on its own strengths
 * alone. FRACAS_USAGE as fracas_model_check_strength. */
FRACAS_MUST_USE fracas_err fracas_batch_run(fracas_batch *batch, fracas_record *record);

/* ---- the state of a lane between two steps ---- */

/* Takes the next `size` bytes, or fills them. */
typedef fracas_err fracas_transfer(void *context, void *bytes, size_t size);

/* All of a lane that its next step reads, as bytes of one program on one kind of processor. Loaded
 * into any lane of a batch of the same model and options but width and instruction set, it goes on
 * to the same record. FRACAS_DAMAGED if it is of another history; errors of the transfer. */
FRACAS_MUST_USE fracas_err fracas_batch_save(fracas_batch *batch, size_t lane, fracas_transfer *put,
                                             void *context);
FRACAS_MUST_USE fracas_err fracas_batch_load(fracas_batch *batch, size_t lane, fracas_transfer *get,
                                             void *context);

typedef struct {
    bool running; /* else its record is complete */
    int64_t steps;
    double time, end; /* s; time.end */
} fracas_lane_progress;
fracas_lane_progress fracas_batch_progress(const fracas_batch *batch, size_t lane);

/* A look at a batch that runs; an error ends it. */
typedef struct fracas_batch_watch {
    /* Before the first step: lanes may be loaded, with the records of those that are over. NULL:
     * nothing. */
    fracas_err (*begin)(void *context, fracas_batch *batch, fracas_record *record);
    /* Every 64 steps: whether to look now. NULL: always. */
    bool (*due)(void *context);
    /* Then: lanes may be saved, and their fields taken. */
    fracas_err (*pause)(void *context, fracas_batch *batch, const fracas_record *record);
    void *context;
    int every; /* steps, in the place of 64; 0: 64 */
    /* Once no lane runs any more; lanes that drifted may then run again from their start. NULL:
     * nothing. */
    fracas_err (*end)(void *context, fracas_batch *batch, const fracas_record *record);
} fracas_batch_watch;

#endif
