/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The shell's sweep over lanes: a kernel.
 *
 * An element is drifted and strained when its turn comes, then its edges that hold the director and
 * the interfaces with elements before it are visited; once an element has all its interfaces it
 * gets its forces and is kicked. Interfaces see an element through the displacements of its nodes
 * and the resultants at its bulk points, and give back forces and strains at those. */
#include "base/lanes.h"
#include "engine/formulation/shell/shell_sweep.h"
#include "engine/formulation/surface/sweep_template.h"

#include <math.h>

typedef struct {
    const fracas_shell_constants *shell;
    const fracas_shell_tables *tables;
    fracas_step *step;
    int first;                         /* lane of the step that is lane 0 here */
    double *elements, *joints, *slots; /* of these lanes */
    const double *strengths;
    size_t element_size, joint_size;      /* doubles */
    size_t strengths_size, strength_step; /* doubles: of an interface; from one Gauss point to the
                                             next, 0 where they share one */
    vd drift, kick;                       /* s */
    int begins;                           /* the first step of all */
    /* sums over the body, for the ledger: twice the energies, dissipated [J]; power [W] */
    vd strain_energy, flux, stored, kinetic, dissipated, power;
} shell_context;

LANES_FUNCTION vd shell_dot(const double *a, const vd *b)
{
    return lanes_set(a[0]) * b[0] + lanes_set(a[1]) * b[1] + lanes_set(a[2]) * b[2];
}

LANES_FUNCTION void shell_load(const double *from, vd u[SHELL_UNKNOWNS])
{
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++) u[i] = lanes_load(from + i * LANES);
}

/* Resultants and energy of element e  (shell.4); its slot is cleared of what it held before. */
LANES_FUNCTION void shell_strain(shell_context *c, size_t e)
{
    static const double shape[3][6][2] = FRACAS_TRIANGLE_DERIVATIVES_2,
                        second[3][6] = FRACAS_TRIANGLE_SECOND_2;
    const vd zero = lanes_set(0.0);
    const fracas_shell_constants *s = c->shell;
    double *slot = c->slots + (e & c->tables->visits.window) * (size_t)(SHELL_SLOT * LANES);
    const double *bulk = c->tables->bulk + e * (size_t)(SHELL_BULK * SHELL_BULK_TABLE);
    const vd c11 = lanes_set(s->c11), c12 = lanes_set(s->c12), c33 = lanes_set(s->c33);
    const vd d11 = lanes_set(s->d11), d12 = lanes_set(s->d12), d33 = lanes_set(s->d33);
    vd u[SHELL_UNKNOWNS], bent[3][3];
    shell_load(c->elements + e * c->element_size, u);
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int i = 0; i < 3; i++) {
            bent[b][i] = zero;
            UNROLL_FOR (int k = 0; k < SHELL_NODES; k++)
                if (second[b][k] != 0.0) bent[b][i] += lanes_set(second[b][k]) * u[3 * k + i];
        }
    UNROLL_FOR (int g = 0; g < SHELL_BULK; g++, bulk += SHELL_BULK_TABLE) {
        vd by_xi[3], by_eta[3], by_x[3], by_y[3];
        UNROLL_FOR (int i = 0; i < 3; i++) {
            by_xi[i] = by_eta[i] = zero;
            UNROLL_FOR (int k = 0; k < SHELL_NODES; k++) {
                if (shape[g][k][0] != 0.0) by_xi[i] += lanes_set(shape[g][k][0]) * u[3 * k + i];
                if (shape[g][k][1] != 0.0) by_eta[i] += lanes_set(shape[g][k][1]) * u[3 * k + i];
            }
            by_x[i] = lanes_set(bulk[SHELL_XI_X]) * by_xi[i] +
                      lanes_set(bulk[SHELL_ETA_X]) * by_eta[i];
            by_y[i] = lanes_set(bulk[SHELL_XI_Y]) * by_xi[i] +
                      lanes_set(bulk[SHELL_ETA_Y]) * by_eta[i];
        }
        const vd xx = shell_dot(bulk + SHELL_X, by_x), yy = shell_dot(bulk + SHELL_Y, by_y);
        const vd xy = shell_dot(bulk + SHELL_X, by_y) + shell_dot(bulk + SHELL_Y, by_x);
        const vd out[5] = {shell_dot(bulk + SHELL_T, bent[0]), shell_dot(bulk + SHELL_T, bent[1]),
                           shell_dot(bulk + SHELL_T, bent[2]), shell_dot(bulk + SHELL_T, by_xi),
                           shell_dot(bulk + SHELL_T, by_eta)};
        vd rho[3];
        UNROLL_FOR (int ij = 0; ij < 3; ij++) {
            rho[ij] = shell_dot(bulk + SHELL_SECOND + 3 * ij, out);
            rho[ij] += lanes_set(bulk[SHELL_FIRST + 2 * ij]) * out[3] +
                       lanes_set(bulk[SHELL_FIRST + 2 * ij + 1]) * out[4];
        }
        const vd resultant[SHELL_RESULTANTS] = {
            c11 * xx + c12 * yy,         c12 * xx + c11 * yy,         c33 * xy,
            d11 * rho[0] + d12 * rho[1], d12 * rho[0] + d11 * rho[1], d33 * rho[2]};
        c->strain_energy +=
            lanes_set(bulk[SHELL_WEIGHT]) *
            ((resultant[0] * xx + resultant[1] * yy + resultant[2] * xy) +
             (resultant[3] * rho[0] + resultant[4] * rho[1] + resultant[5] * rho[2]));
        UNROLL_FOR (int i = 0; i < SHELL_RESULTANTS; i++)
            lanes_store(surface_at(slot, SHELL_RESULTANTS * g + i), resultant[i]);
    }
    UNROLL_FOR (int i = SHELL_SLOT_EXTRA; i < SHELL_SLOT; i++)
        lanes_store(surface_at(slot, i), zero);
}

#include "engine/formulation/shell/shell_interface_template.h"

/* Internal forces of element e: its own, what symmetrisation adds to its resultants, and its
 * interfaces'  (shell.10). */
LANES_FUNCTION void shell_forces(const shell_context *c, size_t e, vd force[SHELL_UNKNOWNS])
{
    static const double shape[3][6][2] = FRACAS_TRIANGLE_DERIVATIVES_2,
                        second[3][6] = FRACAS_TRIANGLE_SECOND_2;
    const fracas_shell_constants *s = c->shell;
    double *slot = c->slots + (e & c->tables->visits.window) * (size_t)(SHELL_SLOT * LANES);
    const double *bulk = c->tables->bulk + e * (size_t)(SHELL_BULK * SHELL_BULK_TABLE);
    const vd c11 = lanes_set(s->c11), c12 = lanes_set(s->c12), c33 = lanes_set(s->c33);
    const vd d11 = lanes_set(s->d11), d12 = lanes_set(s->d12), d33 = lanes_set(s->d33);
    vd bent[3][3];
    shell_load(surface_at(slot, SHELL_SLOT_FORCE), force);
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int i = 0; i < 3; i++) bent[b][i] = lanes_set(0.0);
    UNROLL_FOR (int g = 0; g < SHELL_BULK; g++, bulk += SHELL_BULK_TABLE) {
        vd r[SHELL_RESULTANTS], x[SHELL_RESULTANTS];
        const vd weight = lanes_set(bulk[SHELL_WEIGHT]);
        UNROLL_FOR (int j = 0; j < SHELL_RESULTANTS; j++) {
            r[j] = weight * lanes_load(surface_at(slot, SHELL_RESULTANTS * g + j));
            x[j] = lanes_load(surface_at(slot, SHELL_SLOT_EXTRA + SHELL_RESULTANTS * g + j));
        }
        r[0] += c11 * x[0] + c12 * x[1];
        r[1] += c12 * x[0] + c11 * x[1];
        r[2] += c33 * x[2];
        r[3] += d11 * x[3] + d12 * x[4];
        r[4] += d12 * x[3] + d11 * x[4];
        r[5] += d33 * x[5];
        const vd xi_x = lanes_set(bulk[SHELL_XI_X]), xi_y = lanes_set(bulk[SHELL_XI_Y]);
        const vd eta_x = lanes_set(bulk[SHELL_ETA_X]), eta_y = lanes_set(bulk[SHELL_ETA_Y]);
        vd by_second[3], by_first[2];
        UNROLL_FOR (int b = 0; b < 3; b++)
            by_second[b] = lanes_set(bulk[SHELL_SECOND + b]) * r[3] +
                           lanes_set(bulk[SHELL_SECOND + 3 + b]) * r[4] +
                           lanes_set(bulk[SHELL_SECOND + 6 + b]) * r[5];
        UNROLL_FOR (int a = 0; a < 2; a++)
            by_first[a] = lanes_set(bulk[SHELL_FIRST + a]) * r[3] +
                          lanes_set(bulk[SHELL_FIRST + 2 + a]) * r[4] +
                          lanes_set(bulk[SHELL_FIRST + 4 + a]) * r[5];
        UNROLL_FOR (int i = 0; i < 3; i++) {
            const vd x_i = lanes_set(bulk[SHELL_X + i]), y_i = lanes_set(bulk[SHELL_Y + i]),
                     t_i = lanes_set(bulk[SHELL_T + i]);
            const vd along_x = r[0] * x_i + r[2] * y_i, along_y = r[2] * x_i + r[1] * y_i;
            const vd along_xi = xi_x * along_x + xi_y * along_y + t_i * by_first[0];
            const vd along_eta = eta_x * along_x + eta_y * along_y + t_i * by_first[1];
            UNROLL_FOR (int b = 0; b < 3; b++) bent[b][i] += t_i * by_second[b];
            UNROLL_FOR (int k = 0; k < SHELL_NODES; k++) {
                if (shape[g][k][0] != 0.0) force[3 * k + i] += lanes_set(shape[g][k][0]) * along_xi;
                if (shape[g][k][1] != 0.0)
                    force[3 * k + i] += lanes_set(shape[g][k][1]) * along_eta;
            }
        }
    }
    UNROLL_FOR (int b = 0; b < 3; b++)
        UNROLL_FOR (int k = 0; k < SHELL_NODES; k++)
            UNROLL_FOR (int i = 0; i < 3; i++)
                if (second[b][k] != 0.0) force[3 * k + i] += lanes_set(second[b][k]) * bent[b][i];
}

/* Forces and kick of element e, and its share of kinetic energy. */
LANES_FUNCTION void shell_kick(shell_context *c, int law, size_t e)
{
    const fracas_shell_tables *t = c->tables;
    const unsigned held = t->held[e];
    const double *mass = t->mass + e * (size_t)(2 * SHELL_NODES);
    double *at = c->elements + e * c->element_size;
    vd force[SHELL_UNKNOWNS], v[SHELL_UNKNOWNS], a[SHELL_UNKNOWNS], after[SHELL_UNKNOWNS];
    shell_forces(c, e, force);
    shell_load(surface_at(at, SURFACE_V * SHELL_UNKNOWNS), v);
    UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++) a[i] = lanes_set(-mass[i / 3]) * force[i];
    if (__builtin_expect(held != 0, 0))
        for (int i = 0; i < SHELL_UNKNOWNS; i++) {
            if (!(held >> i & 1)) continue;
            a[i] = lanes_set(0.0);
            c->power += force[i] * v[i]; /* (membrane.11) */
        }
    if (law == SURFACE_OPERATOR) {
        UNROLL_FOR (int i = 0; i < SHELL_UNKNOWNS; i++)
            lanes_store(surface_at(at, SURFACE_V * SHELL_UNKNOWNS + i), a[i]);
        return;
    }
    surface_kick(&c->shell->motion, c->kick, c->begins, SHELL_UNKNOWNS, at, a, v, after);
    UNROLL_FOR (int k = 0; k < SHELL_NODES;
                k++) { /* leapfrog: v_{n-1/2} M v_{n+1/2}  (membrane.9) */
        const vd m = lanes_set(mass[SHELL_NODES + k]);
        c->kinetic += m * (v[3 * k] * after[3 * k] + v[3 * k + 1] * after[3 * k + 1] +
                           v[3 * k + 2] * after[3 * k + 2]);
    }
}

/* Sums to energies [J], those of the potential  (shell.11), and power [W]. */
LANES_FUNCTION void shell_totals(const shell_context *c)
{
    fracas_step *step = c->step;
    const vd half = lanes_set(0.5);
    const int first = c->first;
    lanes_store(step->kinetic + first, half * c->kinetic);
    lanes_store(step->elastic + first, half * (c->strain_energy + c->flux));
    lanes_store(step->cohesive + first, half * c->stored);
    lanes_store(step->dissipated + first, c->dissipated + lanes_load(step->rubbed + first));
    lanes_store(step->power + first, c->power);
    lanes_store(step->work + first, lanes_set(0.0));
}

LANES_FUNCTION void shell_run(const fracas_shell_constants *s, fracas_step *step, int first,
                              int law)
{
    const vd zero = lanes_set(0.0);
    const fracas_shell_tables *t = s->tables;
    double *state = step->state + (size_t)first * fracas_shell_state_fields(s);
    shell_context context = {.shell = s,
                             .tables = t,
                             .step = step,
                             .first = first,
                             .elements = state,
                             .joints = state + fracas_shell_joints_at(s) * LANES,
                             .slots = state + fracas_shell_slots_at(s) * LANES,
                             .element_size = fracas_shell_element_fields(s) * LANES,
                             .joint_size = fracas_shell_joint_fields(s) * LANES,
                             .strengths = state + fracas_shell_strengths_at(s) * LANES,
                             .strengths_size = (size_t)s->strengths * LANES,
                             .strength_step = s->strengths > 1 ? LANES : 0,
                             .drift = lanes_load(step->drift + first),
                             .kick = lanes_load(step->kick + first),
                             .begins = !(step->drift[first] > 0),
                             .strain_energy = zero,
                             .flux = zero,
                             .stored = zero,
                             .kinetic = zero,
                             .dissipated = zero,
                             .power = zero};
    shell_context *c = &context;
    for (size_t e = 0; e < t->nelements; e++) {
        if (law != SURFACE_OPERATOR)
            surface_drift(&s->motion, c->drift, SHELL_UNKNOWNS, c->elements + e * c->element_size);
        shell_strain(c, e);
        for (size_t r = t->rim_from[e]; r < t->rim_from[e + 1]; r++) shell_rim(c, e, r);
        for (size_t j = t->visits.join_from[e]; j < t->visits.join_from[e + 1]; j++)
            shell_join(c, law, t->visits.join[j]);
        for (size_t f = t->visits.finish_from[e]; f < t->visits.finish_from[e + 1]; f++)
            shell_kick(c, law, t->visits.finish[f]);
    }
    if (law != SURFACE_OPERATOR) shell_totals(c);
}

#define SHELL_SWEEP(name, law)                                                                  \
    static void sweep_##name(const fracas_shell_constants *shell, fracas_step *step, int first) \
    {                                                                                           \
        shell_run(shell, step, first, law);                                                     \
    }
#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    FRACAS_IF_##shell(SHELL_SWEEP(name, FRACAS_LAW_##name))
#include "engine/cohesive/laws.list.h"
#undef FRACAS_LAW
#if LANES == 1
SHELL_SWEEP(operator, SURFACE_OPERATOR)
#endif

#define FRACAS_LAW(name, bar, ring, membrane, shell) \
    FRACAS_IF_##shell([FRACAS_LAW_##name] = sweep_##name, )
const fracas_shell_kernel LANES_UNIT(fracas_shell) = {.sweep = {
#include "engine/cohesive/laws.list.h"
#if LANES == 1
                                                          [SURFACE_OPERATOR] = sweep_operator,
#endif
                                                      }};
