/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The critical time step of bars on elements of any lengths, against a dense eigenvalue
 * solver and by running. */
#include "engine/formulation/chain/chain.h"
#include "tests/support/bar_state.h"
#include "tests/support/dense.h"

typedef struct {
    const fracas_model *model;
    bool ring, held, walls, flux, broken;
    double contact; /* K of a broken interface / mean of both elements' E/h */
    size_t size;
    double *stiffness; /* of all nodes, left and right of each element */
} dense_operator;

static void add_product(dense_operator *o, const size_t *at, const double *a, const double *b,
                        double factor)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            o->stiffness[at[i] * o->size + at[j]] += factor * (a[i] * b[j] + b[i] * a[j]);
}

/* Second derivatives of (bar.4) with delta = 0, or of elements and contact springs: bulk (E/2h) (b
 * - a)^2; m q + K q^2/2. */
static void assemble(dense_operator *o)
{
    const size_t n = o->model->elements;
    const fracas_model *model = o->model;
    o->size = 2 * n;
    o->stiffness = vector_of(o->size * o->size);
    for (size_t e = 0; e < n; e++) {
        const size_t at[4] = {2 * e, 2 * e + 1, 2 * e, 2 * e + 1};
        const double strain[4] = {-1, 1, 0, 0};
        add_product(o, at, strain, strain, 0.5 * 275e9 / length_of(model, e));
    }
    for (size_t l = 0; l < (o->ring ? n : n - 1); l++) {
        const size_t r = (l + 1) % n, at[4] = {2 * l, 2 * l + 1, 2 * r, 2 * r + 1};
        const double left = 275e9 / length_of(model, l), right = 275e9 / length_of(model, r),
                     jump[4] = {0, -1, 1, 0};
        const double mean[4] = {-0.5 * left, 0.5 * left, -0.5 * right, 0.5 * right};
        if (o->broken || o->flux)
            add_product(o, at, jump, jump, 0.25 * o->contact * (left + right));
        if (!o->broken && o->flux) add_product(o, at, mean, jump, 1);
    }
    for (size_t i = 0; o->walls && i < 2; i++) {
        const size_t node = i ? o->size - 1 : 0;
        o->stiffness[node * o->size + node] += o->contact * 275e9 / length_of(model, node / 2);
    }
}

/* Which degree of freedom a node belongs to: tied ones share one, held ones have none (-1). */
static size_t number_nodes(const dense_operator *o, int *number)
{
    const bool tied = !o->broken && !o->flux;
    size_t count = 0;
    for (size_t i = 0; i < o->size; i++) number[i] = -1;
    for (size_t i = 0; i < o->size; i++) {
        if (o->held && (i == 0 || i == o->size - 1)) continue;
        if (number[i] < 0) number[i] = (int)count++;
        if (tied && i % 2 == 1 && (o->ring || i + 1 < o->size))
            number[(i + 1) % o->size] =
                number[i]; /* a right node and the left one of the next element */
    }
    if (tied && o->ring) { /* node 0 came first, and is tied to the last one */
        const int last = number[o->size - 1];
        number[0] = last;
        for (size_t i = 0; i < o->size; i++) number[i]--; /* the number 0 is free */
        count--;
    }
    return count;
}

/* 2/omega_max [s] by GSL's QR algorithm, for M^-1/2 K M^-1/2. */
static double dense_step(const fracas_model *model, bool broken)
{
    dense_operator o = {.model = model,
                        .ring = model->interfaces == model->elements,
                        .held = model->spec.geometry.ends == &fracas_ends_held,
                        .walls = fracas_chain_gap(model) >= 0,
                        .flux = has_flux(&model->spec),
                        .broken = broken,
                        .contact = fracas_chain_contact_factor(&model->spec)};
    assemble(&o);
    int number[2 * MOST];
    const size_t n = number_nodes(&o, number);
    double mass[2 * MOST] = {0};
    for (size_t i = 0; i < o.size; i++)
        if (number[i] >= 0) mass[number[i]] += 0.5 * 2750 * length_of(model, i / 2);
    OWNED double *matrix = vector_of(n * n);
    for (size_t i = 0; i < o.size; i++)
        for (size_t j = 0; j < o.size; j++)
            if (number[i] >= 0 && number[j] >= 0)
                matrix[(size_t)number[i] * n + (size_t)number[j]] +=
                    o.stiffness[i * o.size + j] / sqrt(mass[number[i]] * mass[number[j]]);
    OWNED double *value = eigenvalues_of(matrix, n);
    /* stiff in every direction, at every beta > 1 */
    assert_true(value[0] > -1e-10 * value[n - 1]);
    free(o.stiffness);
    return 2 / sqrt(value[n - 1]);
}

/* Steps above the true critical one by less than 1e-7 whatever the mesh, and below it by round-off
 * alone. Frequencies are densest, and the iteration is slowest, where elements are nearly equal
 * (the last meshes). */
static void critical_step_is_that_of_the_dense_operator(void **unused)
{
    static const double ratios[] = {1.001, 3, 100, 1e3, 1e-3},
                        amplitudes[] = {0.45, 0.3, 0.1, 0.01, 0.001};
    static const double betas[] = {1.05, 4, 30};
    double above[BAR_LAWS][2] = {{0}}, below = 0, noise[301];
    for (int i = 0; i < 122; i++) {
        const bool large = i >= 120; /* two of 300 elements */
        const int64_t n = large ? 300 : i % 12 == 0 ? 3 : 20 + (i * 7) % 41;
        fracas_spec spec = bar_reference(n, 1e4, 1e-6);
        spec.geometry.length = (double)n * 2e-5;
        set_ends(&spec, i / 2 % ENDS, 0);
        set_listed_law(&spec, i);
        spec.cohesive.beta = betas[i / 16 % 3];
        if (i / 8 % 2 && !large) bar_grade(&spec, ratios[i % 5]);
        else bar_perturb(&spec, large ? 0.01 : amplitudes[i % 5], (uint64_t)i, noise);
        OWN(fracas_model) model = make_model(&spec);
        for (int broken = 0; broken < 2; broken++) {
            const double found = broken ? model->critical_cracked : model->critical_closed;
            const double error = found / dense_step(model, broken) - 1;
            above[i % BAR_LAWS][broken] = fmax(above[i % BAR_LAWS][broken], error);
            below = fmin(below, error);
        }
        assert_true(model->critical_step == fmin(model->critical_closed, model->critical_cracked));
    }
    for (int i = 0; i < 2 * BAR_LAWS; i++) {
        print_message("[  figures ] %s %s: step above the critical one by %.1e at most\n",
                      law_of_model(MODEL_BAR, i / 2)->kind.name, i % 2 ? "broken" : "uncracked",
                      above[i / 2][i % 2]);
        assert_true(above[i / 2][i % 2] < 1e-7);
    }
    assert_true(below > -1e-9);
}

/* All interfaces broken and pressed together: uniform stress sigma = E (rate t + strain) = K q, of
 * a bar that keeps its length. Rigid links get the strengths that make them as stiff as the time
 * step takes them to be. */
static void press_together(const fracas_model *model, fracas_batch *batch)
{
    const size_t n = model->elements;
    const bool flux = has_flux(&model->spec);
    const double offset = 4.5 * pow(model->spec.loading.rate, 2.0 / 3) * 275e9 * pow(100, 2.0 / 3) *
                          pow(2750, 1.0 / 3);
    double stiffness[MOST], give = model->spec.geometry.length / 275e9, left = 0;
    for (size_t e = 0; e < model->interfaces; e++) {
        const double mean = 0.5 * 275e9 *
                            (1 / length_of(model, e) + 1 / length_of(model, (e + 1) % n));
        stiffness[e] = flux ? 4 * mean : mean;
        give += 1 / stiffness[e];
        *field(batch, e, BAR_DAMAGE) = 1;
        if (flux) continue;
        *field(batch, e, BAR_STRENGTH) = sqrt(4.5 * 100 * mean - offset);
        *field(batch, e, BAR_LAW) = 2;
    }
    batch->step.time[0] = -1e-8; /* pressed by a background of -1e-4 */
    const double load = model->spec.loading.rate * batch->step.time[0],
                 stress = load * model->spec.geometry.length / give;
    for (size_t e = 0; e < n; e++) {
        *field(batch, e, BAR_W_LEFT) = left;
        *field(batch, e, BAR_W_RIGHT) = left += (stress / 275e9 - load) * length_of(model, e);
        if (e < model->interfaces) left += stress / stiffness[e];
    }
}

/* 100 steps of `factor` times the critical one from a nm/s of noise at every node: the largest
 * velocity after them [m/s]. */
static double march(const fracas_model *model, bool broken, double factor)
{
    const size_t n = model->elements;
    OWN(fracas_batch) batch = begun_with(model, 3e8);
    uint64_t seed = 3;
    batch->step.time[0] = 0;
    if (broken) press_together(model, batch);
    for (size_t e = 0; e < n; e++) { /* tied nodes start together */
        *field(batch, e, BAR_V_RIGHT) = 1e-9 * random_noise(&seed);
        *field(batch, (e + 1) % n, BAR_V_LEFT) = has_flux(&model->spec)
                                                     ? 1e-9 * random_noise(&seed)
                                                     : *field(batch, e, BAR_V_RIGHT);
    }
    if (model->interfaces < n) *field(batch, 0, BAR_V_LEFT) = *field(batch, n - 1, BAR_V_RIGHT) = 0;
    batch->step.drift[0] = batch->step.kick[0] = factor * dense_step(model, broken);
    double largest = 0;
    for (int s = 0; s < 100; s++) model->formulation->advance(model, &batch->step);
    for (size_t e = 0; e < n; e++)
        for (int f = BAR_V_LEFT; f <= BAR_V_RIGHT; f++)
            largest = fmax(largest, fabs(*field(batch, e, f)));
    return largest;
}

/* Below it, omega dt = 1.98, noise is magnified by 1/sqrt(1 - 0.99^2) = 7 in the worst mode; above
 * it, omega dt = 2.02, by e^(2 arcosh 1.01) = 1.33 a step, until interfaces open. */
static void steps_blow_up_above_the_critical_one_only(void **unused)
{
    for (int i = 0; i < 4 * BAR_LAWS * (MESHES + 1); i++) {
        fracas_spec spec = bar_reference(60, 1e4, 1);
        spec.geometry.length = 60 * 2e-5;
        set_listed_law(&spec, i);
        spec.geometry.ends = ends[i / BAR_LAWS % 2];
        OWN(fracas_model) model = model_on(&spec, i / (4 * BAR_LAWS));
        const double stays = march(model, i / (2 * BAR_LAWS) % 2, 0.99),
                     grows = march(model, i / (2 * BAR_LAWS) % 2, 1.01);
        if (!(stays < 1e-7) || !(grows > 1e-5))
            fail_msg("%s, %s, %s, %s: %g m/s below, %g m/s above", spec.cohesive.law->name,
                     ends[i / BAR_LAWS % 2]->name, i / (2 * BAR_LAWS) % 2 ? "broken" : "uncracked",
                     mesh_name[i / (4 * BAR_LAWS)], stays, grows);
    }
}

TESTS(critical_step_is_that_of_the_dense_operator, steps_blow_up_above_the_critical_one_only)
