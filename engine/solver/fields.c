/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/fields.h"

#include "engine/solver/batch.h"

#include <stdlib.h>

/* The next `count` doubles of the memory. */
static double *cut(double **memory, size_t count)
{
    double *first = *memory;
    *memory += count;
    return first;
}

static void *cut_vectors(double **memory, size_t count)
{
    return cut(memory, 3 * count);
}

static size_t count_reals(const fracas_fields *f)
{
    size_t stresses = 0;
    for (int s = 0; s < FRACAS_STRESSES; s++) stresses += f->components[s];
    return f->elements * (10 * f->corners + stresses + 1) + f->interfaces * (3 * f->ends + 4);
}

static void lay_out(fracas_fields *f)
{
    const size_t nodes = f->elements * f->corners;
    double *next = f->reals;
    f->place = cut_vectors(&next, nodes);
    f->displacement = cut_vectors(&next, nodes);
    f->velocity = cut_vectors(&next, nodes);
    f->mass = cut(&next, nodes);
    for (int s = 0; s < FRACAS_STRESSES; s++)
        f->stress[s] = cut(&next, f->elements * f->components[s]);
    f->fragment_mass = cut(&next, f->elements);
    f->middle = cut_vectors(&next, f->interfaces * f->ends);
    f->damage = cut(&next, f->interfaces);
    f->opening = cut(&next, f->interfaces);
    f->strength = cut(&next, f->interfaces);
    f->onset_time = cut(&next, f->interfaces);
    f->fragment = f->integers;
    f->between = (void *)(f->integers + f->elements);
}

fracas_err fracas_fields_create(const fracas_model *model, fracas_fields **out)
{
    const fracas_formulation *formulation = model->formulation;
    OWN(fracas_fields) f = calloc(1, sizeof *f);
    if (!f) return fracas_no_memory("the fields of a realization");
    f->elements = model->elements;
    f->interfaces = model->interfaces;
    f->corners = formulation->element_nodes(model);
    f->ends = formulation->interface_nodes(model);
    for (int s = 0; s < FRACAS_STRESSES; s++) {
        f->name[s] = formulation->stress[s].name;
        f->components[s] = formulation->stress[s].components;
    }
    f->reals = malloc(count_reals(f) * sizeof *f->reals);
    f->integers = malloc((f->elements + 2 * f->interfaces) * sizeof *f->integers);
    if (!f->reals || !f->integers) return fracas_no_memory("the fields of a realization");
    lay_out(f);
    *out = f;
    f = NULL;
    return FRACAS_OK;
}

void fracas_fields_destroy(fracas_fields *fields)
{
    if (!fields) return;
    free(fields->reals);
    free(fields->integers);
    free(fields);
}

/* Number and mass of each element's fragment, by the masses of all nodes. */
static void fill_fragments(const fracas_model *model, fracas_step *step, int lane, fracas_fields *f)
{
    const size_t count = model->formulation->partition(model, step, lane);
    const uint32_t *label = step->partition.label;
    double *sum = f->fragment_mass; /* by fragment: they are no more than elements */
    for (size_t n = 0; n < count; n++) sum[n] = 0;
    for (size_t e = 0; e < f->elements; e++) {
        f->fragment[e] = label[e];
        for (size_t k = 0; k < f->corners; k++) sum[label[e]] += f->mass[e * f->corners + k];
    }
    /* Labels rise with the first element that has them: backwards, no sum is lost. */
    for (size_t e = f->elements; e-- > 0;) sum[e] = sum[label[e]];
}

void fracas_batch_fields(fracas_batch *batch, size_t lane, fracas_fields *fields)
{
    fields->time = batch->step.time[lane];
    batch->model->formulation->fields(batch->model, &batch->step, (int)lane, fields);
    fill_fragments(batch->model, &batch->step, (int)lane, fields);
}
