/* What one point of a campaign asks of the engine: every physical parameter, resolved, in SI. */
#ifndef FRACAS_ENGINE_SPEC_H
#define FRACAS_ENGINE_SPEC_H

#include "base/param.h"

#include <stddef.h>
#include <stdint.h>

typedef struct {
    const fracas_kind *ends; /* periodic, held */
    double length;           /* m */
    double area;             /* m2 */
} fracas_geometry;

typedef struct {
    int64_t elements;
} fracas_mesh;

typedef struct {
    double young;   /* Pa */
    double density; /* kg/m3 */
} fracas_material;

typedef struct {
    const fracas_kind *law;
    double fracture_energy; /* J/m2 */
    double beta;            /* interface stiffness K = beta E/h; 1 */
} fracas_cohesive;

typedef struct {
    const fracas_kind *type;
    double rate; /* 1/s */
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

/* Registry of the engine: `model` is the section of that name without parameters of its own, and the
 * others follow in the order of the struct; offsets are into fracas_spec. */
extern const fracas_section *const fracas_engine_sections[];
extern const size_t fracas_engine_nsections;

#endif
