/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "engine/formulation/surface/division.h"

#include "engine/formulation/surface/surface.h"

#include <stdlib.h>

enum { NONE = UINT32_MAX, LINE = 8 /* doubles of a line of memory */ };

/* Room for the making of one part after another. Turns are numbered within the part. */
typedef struct {
    const fracas_surface_constants *constants;
    size_t begin, end;            /* the part's elements */
    size_t place;                 /* next free field of a group's memory */
    uint32_t *facet_from, *facet; /* interfaces by their second element, in order */
    uint32_t *turn_of;            /* [element]: its turn; NONE */
    uint32_t *last;               /* [turn]: turn of the last interface of its element */
    uint32_t *first, *next;       /* [turn]: chains of turns with the same last one */
    uint32_t *spare;              /* free slots */
    size_t slots, spares;         /* slots so far; free ones */
} maker;

static bool owns(const maker *m, size_t e)
{
    return e >= m->begin && e < m->end;
}

/* ---- room ---- */

static void maker_clear(maker *m)
{
    uint32_t *const owned[] = {m->facet_from, m->facet, m->turn_of, m->last,
                               m->first,      m->next,  m->spare};
    for (size_t i = 0; i < FRACAS_COUNT(owned); i++) free(owned[i]);
}

static fracas_err maker_init(maker *m, const fracas_surface_constants *c)
{
    const fracas_surface_tables *t = c->tables;
    const size_t n = t->nelements, number = sizeof(uint32_t);
    *m = (maker){.constants = c,
                 .place = fracas_surface_state_fields(c),
                 .facet_from = calloc(n + 2, number),
                 .facet = malloc((t->ninterfaces + 1) * number),
                 .turn_of = malloc(n * number),
                 .last = malloc(n * number),
                 .first = malloc(n * number),
                 .next = malloc(n * number),
                 .spare = malloc(n * number)};
    if (!m->facet_from || !m->facet || !m->turn_of || !m->last || !m->first || !m->next ||
        !m->spare)
        return fracas_no_memory("the parts of a body");
    for (size_t i = 0; i < t->ninterfaces; i++) m->facet_from[t->element[i][1] + 2]++;
    for (size_t e = 0; e < n; e++) m->facet_from[e + 1] += m->facet_from[e];
    for (size_t i = 0; i < t->ninterfaces; i++)
        m->facet[m->facet_from[t->element[i][1] + 1]++] = (uint32_t)i;
    return FRACAS_OK;
}

/* ---- one part ---- */

/* Gives turns to the part's elements, its ghosts among them by their numbers. */
static fracas_err give_turns(maker *m, fracas_surface_part *part)
{
    const fracas_surface_tables *t = m->constants->tables;
    for (size_t e = 0; e < t->nelements; e++) m->turn_of[e] = owns(m, e) ? 0 : NONE;
    for (size_t i = 0; i < t->ninterfaces; i++)
        for (int side = 0; side < 2; side++)
            if (owns(m, t->element[i][side])) m->turn_of[t->element[i][1 - side]] = 0;
    size_t facets = 0;
    for (size_t e = 0; e < t->nelements; e++)
        if (m->turn_of[e] != NONE) {
            m->turn_of[e] = (uint32_t)part->turns++;
            facets += m->facet_from[e + 1] - m->facet_from[e];
        }
    part->turn = malloc(part->turns * sizeof *part->turn);
    part->facet = malloc((facets + 1) * sizeof *part->facet);
    part->finish = malloc((m->end - m->begin) * sizeof *part->finish);
    part->copy = malloc((part->turns + facets) * sizeof *part->copy);
    return part->turn && part->facet && part->finish && part->copy
               ? FRACAS_OK
               : fracas_no_memory("the parts of a body");
}

/* A copy of `count` fields at `from`, made before each step: where it is. */
static uint32_t place_copy(maker *m, fracas_surface_part *part, size_t from, size_t count)
{
    const size_t to = m->place;
    part->copy[part->copies++] = (fracas_surface_copy){(uint32_t)from, (uint32_t)to,
                                                       (uint32_t)count};
    m->place += count;
    return (uint32_t)to;
}

/* Interfaces by the turns of their second elements, where an element is the part's own. */
static void order_facets(maker *m, fracas_surface_part *part)
{
    const fracas_surface_constants *c = m->constants;
    const fracas_surface_tables *t = c->tables;
    const size_t fields = fracas_surface_element_fields(c),
                 interface_fields = fracas_surface_interface_fields(c);
    size_t facets = 0, k = 0;
    for (size_t e = 0; e < t->nelements; e++) {
        if (m->turn_of[e] == NONE) continue;
        fracas_surface_turn *turn = &part->turn[k];
        *turn = (fracas_surface_turn){.element = (uint32_t)e, .ghost = !owns(m, e)};
        turn->at = turn->ghost ? place_copy(m, part, e * fields, fields) : (uint32_t)(e * fields);
        m->last[k] = (uint32_t)k;
        for (size_t j = m->facet_from[e]; j < m->facet_from[e + 1]; j++) {
            const uint32_t i = m->facet[j], *pair = t->element[i];
            if (!owns(m, pair[0]) && !owns(m, pair[1])) continue;
            const size_t at = fracas_surface_interfaces_at(c) + i * interface_fields;
            fracas_surface_facet *facet = &part->facet[facets++];
            *facet = (fracas_surface_facet){.interface = i, .edge = {t->edge[i][0], t->edge[i][1]}};
            facet->at = turn->ghost ? place_copy(m, part, at, interface_fields) : (uint32_t)at;
            for (int side = 0; side < 2; side++) {
                const uint32_t of = m->turn_of[pair[side]];
                facet->element[side] = part->turn[of].at;
                facet->slot[side] = of; /* until slots are given */
                m->last[of] = (uint32_t)k;
            }
        }
        turn->facet_end = (uint32_t)facets;
        k++;
    }
}

/* Slots, and finished elements of each turn, whose slots are free from then on. */
static void give_slots(maker *m, fracas_surface_part *part)
{
    size_t facets = 0, finished = 0;
    m->slots = m->spares = 0;
    for (size_t k = 0; k < part->turns; k++) m->first[k] = NONE;
    for (size_t k = part->turns; k-- > 0;) {
        m->next[k] = m->first[m->last[k]];
        m->first[m->last[k]] = (uint32_t)k;
    }
    for (size_t k = 0; k < part->turns; k++) {
        fracas_surface_turn *turn = &part->turn[k];
        turn->slot = m->spares ? m->spare[--m->spares] : (uint32_t)m->slots++;
        for (; facets < turn->facet_end; facets++)
            for (int side = 0; side < 2; side++) {
                uint32_t *slot = &part->facet[facets].slot[side];
                *slot = part->turn[*slot].slot;
            }
        for (uint32_t f = m->first[k]; f != NONE; f = m->next[f]) {
            const fracas_surface_turn *of = &part->turn[f];
            m->spare[m->spares++] = of->slot;
            if (!of->ghost)
                part->finish[finished++] = (fracas_surface_finish){of->element, of->at, of->slot};
        }
        turn->finish_end = (uint32_t)finished;
    }
}

/* From numbers of slots to places. */
static void place_slots(maker *m, fracas_surface_part *part)
{
    const fracas_surface_constants *c = m->constants;
    const uint32_t size = (uint32_t)fracas_surface_slot(c->tables);
    m->place = (m->place + LINE - 1) / LINE * LINE;
    const uint32_t at = (uint32_t)m->place;
    for (size_t k = 0; k < part->turns; k++) part->turn[k].slot = at + part->turn[k].slot * size;
    for (size_t j = 0; j < part->turn[part->turns - 1].facet_end; j++)
        for (int side = 0; side < 2; side++)
            part->facet[j].slot[side] = at + part->facet[j].slot[side] * size;
    for (size_t f = 0; f < m->end - m->begin; f++)
        part->finish[f].slot = at + part->finish[f].slot * size;
    m->place += (m->slots * size + LINE - 1) / LINE * LINE;
}

static fracas_err make_part(maker *m, fracas_surface_part *part)
{
    TRY(give_turns(m, part));
    order_facets(m, part);
    give_slots(m, part);
    place_slots(m, part);
    return FRACAS_OK;
}

/* ---- the whole ---- */

void fracas_surface_division_destroy(void *p)
{
    fracas_surface_division *division = p;
    if (!division) return;
    for (size_t i = 0; division->part && i < division->parts; i++) {
        void *const owned[] = {division->part[i].turn, division->part[i].facet,
                               division->part[i].finish, division->part[i].copy};
        for (size_t k = 0; k < FRACAS_COUNT(owned); k++) free(owned[k]);
    }
    free(division->part);
    free(division->kept_row);
    free(division->hold);
    free(division);
}

/* The first element of a block; the end of all after the last one. */
static size_t first_of(const fracas_surface_tables *t, size_t block)
{
    const size_t e = block * SURFACE_BLOCK;
    return e < t->nelements ? e : t->nelements;
}

/* Rows of held elements behind all else. */
static fracas_err keep_held(const fracas_surface_tables *t, fracas_surface_division *division)
{
    uint32_t rows = 0;
    division->kept = division->fields;
    division->kept_row = calloc(t->nelements, sizeof *division->kept_row);
    if (!division->kept_row) return fracas_no_memory("the reactions of a body");
    for (size_t e = 0; e < t->nelements; e++)
        if (t->held[e]) division->kept_row[e] = ++rows;
    division->fields += 2 * rows * fracas_surface_unknowns(t);
    return FRACAS_OK;
}

static fracas_err make_parts(maker *m, bool reactions, fracas_surface_division *division)
{
    const fracas_surface_tables *t = m->constants->tables;
    const size_t blocks = fracas_surface_blocks(t);
    for (size_t i = 0; i < division->parts; i++) {
        m->begin = m->end;
        m->end = first_of(t, (i + 1) * blocks / division->parts);
        TRY(make_part(m, &division->part[i]));
    }
    division->sums = m->place;
    division->fields = m->place + blocks * SURFACE_SUMS;
    if (reactions) TRY(keep_held(t, division));
    if (division->fields <= UINT32_MAX) return FRACAS_OK;
    return fracas_fail(
        FRACAS_ENVIRONMENT,
        "a realization of %zu elements has more than %u numbers: take a coarser mesh", t->nelements,
        UINT32_MAX);
}

fracas_err fracas_surface_division_create(const fracas_surface_constants *c, size_t parts,
                                          bool reactions, fracas_surface_division **out)
{
    const size_t blocks = fracas_surface_blocks(c->tables);
    fracas_surface_division *division = calloc(1, sizeof *division);
    if (!division) return fracas_no_memory("the parts of a body");
    division->parts = parts < blocks ? parts : blocks;
    division->part = calloc(division->parts, sizeof *division->part);
    maker m;
    fracas_err err = maker_init(&m, c);
    if (!err)
        err = division->part ? make_parts(&m, reactions, division)
                             : fracas_no_memory("the parts of a body");
    maker_clear(&m);
    if (err) fracas_surface_division_destroy(division);
    else *out = division;
    return err;
}
