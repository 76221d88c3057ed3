/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cracked interfaces of a shell, whatever its nodes do: tractions, what the flux carries, energies
 * and forces against the law written once more for one layer and kinematics written once more from
 * the nodes (docs/theory/shell.md, docs/theory/cohesive.md). */
#include "tests/support/plane.h"
#include "tests/support/shell_cracks.h"
#include "tests/support/shell_layer.h"
#include "tests/support/test.h"

/* ---- a body ---- */

typedef struct {
    const fracas_model *model;
    shell_sight *unit; /* [interface][Gauss point][36]: of each displacement of the - element, then
                          of the + element */
    layer *memory;     /* [interface][Gauss point][layer] */
    bool *parted;      /* [interface][Gauss point]: all layers broken */
    double *strength, *force; /* [interface][Gauss point], [unknown] */
    double elastic, cohesive, dissipated, created, rubbed, bending;
    long seen[7]; /* layers: intact, loading, unloading, broken, pressed and broken, pressed and
                     cracked, cut */
} twin;

static twin twin_of(const fracas_model *model, const fracas_batch *batch)
{
    const size_t n = model->interfaces * SHELL_EDGE;
    twin t = {.model = model,
              .unit = zeroed(36 * n, sizeof *t.unit),
              .memory = zeroed(SHELL_LAYERS * n, sizeof *t.memory),
              .parted = zeroed(n, sizeof *t.parted),
              .strength = vector_of(n),
              .force = vector_of(unknowns_of(model))};
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < 36; j++) {
            double u[2][SHELL_UNKNOWNS] = {{0}};
            u[j / 18][j % 18] = 1;
            t.unit[36 * i + j] = sight_at(model, i / SHELL_EDGE, (int)(i % SHELL_EDGE),
                                          (const double *const[2]){u[0], u[1]});
        }
    for (size_t i = 0; i < n; i++)
        t.strength[i] = strength_at(batch, 0, i / SHELL_EDGE, i % SHELL_EDGE);
    return t;
}

static void twin_clear(twin *t)
{
    free(t->unit);
    free(t->memory);
    free(t->parted);
    free(t->strength);
    free(t->force);
}

/* K of the bulk times u, by the polarisation of its energy with displacements of `scale`. */
static void bulk_forces(twin *t, const double *u, double scale)
{
    for (size_t e = 0; e < t->model->elements; e++) {
        double v[SHELL_UNKNOWNS];
        const double *from = u + SHELL_UNKNOWNS * e;
        t->elastic += bulk_energy(t->model, e, from);
        for (int j = 0; j < SHELL_UNKNOWNS; j++) {
            double energy[2];
            for (int sign = 0; sign < 2; sign++) {
                memcpy(v, from, sizeof v);
                v[j] += sign ? -scale : scale;
                energy[sign] = bulk_energy(t->model, e, v);
            }
            t->force[SHELL_UNKNOWNS * e + (size_t)j] -= (energy[0] - energy[1]) / (2 * scale);
        }
    }
}

static void count(twin *t, const layer_answer *a)
{
    if (!a->cracked) t->seen[0]++;
    else if (a->broken) t->seen[a->pressed ? 4 : 3]++;
    else t->seen[a->pressed ? 5 : a->loads ? 1 : 2]++;
    t->seen[6] += a->cut;
}

static const double place[SHELL_LAYERS] = {-0.5, 0, 0.5};

/* The layers of Gauss point number `point` of the body. All lose their means in the step in which
 * the last of them breaks: it is found by a trial. */
static layer_beside point_of(twin *t, const layer_law *law, const shell_sight *at, size_t point,
                             layer_answer answer[SHELL_LAYERS])
{
    const double h = t->model->spec.geometry.thickness;
    layer *memory = t->memory + SHELL_LAYERS * point, before[SHELL_LAYERS];
    layer_beside beside = {.are_broken = false};
    memcpy(before, memory, sizeof before);
    for (int k = 0; k < SHELL_LAYERS; k++) beside.opened = beside.opened || memory[k].peak > 0;
    beside.were_broken = t->parted[point];
    beside.are_broken = t->parted[point];
    for (int trial = 0; trial < 2; trial++) {
        memcpy(memory, before, sizeof before);
        bool broken = true;
        for (int k = 0; k < SHELL_LAYERS; k++) {
            double mean[2], q[2];
            for (int d = 0; d < 2; d++) {
                mean[d] = at->n[d] / h + 12 * place[k] * at->m[d] / (h * h);
                q[d] = at->jump[d] + place[k] * h * at->turn[d];
            }
            answer[k] = law->mu_c > 0 ? rubbed_layer(law, memory + k, mean, q, beside)
                                      : layer_of(law, memory + k, mean, q, beside);
            broken = broken && answer[k].broken;
        }
        beside.are_broken = broken;
    }
    t->parted[point] = beside.are_broken;
    return beside;
}

static void twin_point(twin *t, size_t i, int g, const double *u)
{
    static const double weight[SHELL_LAYERS] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
    const fracas_cohesive *cohesive = &t->model->spec.cohesive;
    const double h = t->model->spec.geometry.thickness, beta_c = cohesive->coupling;
    const shell_sight *unit = t->unit + 36 * (3 * i + (size_t)g);
    const uint32_t *element = t->model->surface->interface[i].element;
    double shearing;
    const double spring = spring_of(t->model, i, &shearing) * fmax(1, 1 / (beta_c * beta_c));
    const layer_law law = {.k = {spring, beta_c * beta_c * spring},
                           .sigma_c = t->strength[3 * i + (size_t)g],
                           .beta_c = beta_c,
                           .mu_c = cohesive->friction,
                           .energy = cohesive->fracture_energy,
                           .opening = cohesive->critical_opening,
                           .by_mean = cohesive->onset == &fracas_onset_mean};
    shell_sight at = {.lift = 0};
    for (int j = 0; j < 36; j++) {
        const double x = u[SHELL_UNKNOWNS * element[j / 18] + (size_t)j % 18];
        for (int k = 0; k < 2; k++) {
            at.n[k] += unit[j].n[k] * x;
            at.m[k] += unit[j].m[k] * x;
            at.jump[k] += unit[j].jump[k] * x;
            at.turn[k] += unit[j].turn[k] * x;
        }
        at.lift += unit[j].lift * x;
    }
    double n[2] = {0}, m[2] = {0}, carried_u[2] = {0}, carried_t[2] = {0}, half_n[2] = {0},
           half_m[2] = {0}, spent = 0;
    layer_answer answer[SHELL_LAYERS];
    const layer_beside beside = point_of(t, &law, &at, 3 * i + (size_t)g, answer);
    int breaks = 0;
    for (int k = 0; k < SHELL_LAYERS; k++) {
        const double z = place[k] * h, w = weight[k] * h;
        const layer_answer a = answer[k];
        count(t, &a);
        for (int d = 0; d < 2; d++) {
            n[d] += w * a.t[d];
            m[d] += w * z * a.t[d];
            carried_u[d] += weight[k] * a.s[d];
            carried_t[d] += 12 / (h * h) * weight[k] * z * a.s[d];
            half_n[d] += w * a.midway[d];
            half_m[d] += w * z * a.midway[d];
        }
        t->elastic += unit->length * w * a.flux;
        t->cohesive += unit->length * w * a.stored;
        t->dissipated += unit->length * w * a.dissipated;
        t->created += unit->length * w * a.created;
        t->rubbed += unit->length * w * a.rubbed;
        spent += unit->length * w * a.spent;
        breaks = breaks || a.breaks;
    }
    const bool broken = beside.are_broken;
    const double sheared = 0.5 * unit->length * shearing * at.lift * at.lift;
    if (!broken) t->elastic += sheared;
    if (broken && breaks) t->created -= sheared;
    const double stretched = fmax(0, half_n[0] * at.jump[0] + half_n[1] * at.jump[1]),
                 bent = fmax(0, half_m[0] * at.turn[0] + half_m[1] * at.turn[1]);
    if (spent > 0) t->bending += spent * bent / (stretched + bent);
    for (int j = 0; j < 36; j++) {
        double work = broken ? 0 : shearing * at.lift * unit[j].lift;
        for (int d = 0; d < 2; d++)
            work += n[d] * unit[j].jump[d] + m[d] * unit[j].turn[d] + carried_u[d] * unit[j].n[d] +
                    carried_t[d] * unit[j].m[d];
        t->force[SHELL_UNKNOWNS * element[j / 18] + (size_t)j % 18] -= unit->length * work;
    }
}

static void twin_evaluate(twin *t, const double *u, double scale)
{
    t->elastic = t->cohesive = t->dissipated = t->created = t->rubbed = t->bending = 0;
    memset(t->force, 0, unknowns_of(t->model) * sizeof *t->force);
    bulk_forces(t, u, scale);
    for (size_t i = 0; i < t->model->interfaces; i++)
        for (int g = 0; g < SHELL_EDGE; g++) twin_point(t, i, g, u);
}

/* ---- walks ---- */

enum { SEGMENTS = 5, STEPS = 40 };

/* Forces are the slope of Pi + dissipated, along any direction: central differences over 2e-7 of
 * the displacements, in which Pi is quadratic but for points that turn from loading to unloading (a
 * share of 1e-7 of the force), with 1e-16/1e-7 of round-off. */
static double slope_error(fracas_batch *batch, const double *u, double scale,
                          const fracas_stream *stream, uint64_t *draw)
{
    const size_t n = unknowns_of(batch->model);
    OWNED double *direction = vector_of(n), *moved = vector_of(n), *before = vector_of(n),
                 *after = vector_of(n);
    shell_answer here = {.force = before}, there = {.force = after};
    double energy[2], worst = 0;
    look_at(batch, u, &here);
    for (int trial = 0; trial < 4; trial++) {
        double power = 0, size = 0;
        for (size_t i = 0; i < n; i++)
            direction[i] = 2 * fracas_stream_uniform(stream, (*draw)++) - 1;
        for (int sign = 0; sign < 2; sign++) {
            for (size_t i = 0; i < n; i++)
                moved[i] = u[i] + (sign ? -1 : 1) * 1e-7 * scale * direction[i];
            look_at(batch, moved, &there);
            energy[sign] = there.elastic + there.cohesive + there.dissipated;
            assert_true(there.created == 0 && here.created == 0);
        }
        for (size_t i = 0; i < n; i++) {
            power -= here.force[i] * direction[i];
            size += fabs(here.force[i]);
        }
        worst = fmax(worst, fabs((energy[0] - energy[1]) / (2e-7 * scale) - power) / size);
    }
    return worst;
}

static double relative(double a, double b, double scale)
{
    return fabs(a - b) / scale;
}

/* Straight from one random state to the next, the third of which is a tenth of the second: it
 * unloads. Energies are sums of some thousand terms of which each has, through stresses that are
 * differences of displacements, 1e-13 of it: 1e-11. */
static void walk(const fracas_spec *spec, double scale, double distortion, long seen[7],
                 double worst[3])
{
    OWN(fracas_model) model = distorted_model(*spec, distortion, 3);
    OWN(fracas_batch) batch = lane_of(model, 0.3, 5, 0);
    OK(fracas_batch_begin(batch));
    const size_t n = unknowns_of(model);
    twin t = twin_of(model, batch);
    OWNED double *from = vector_of(n), *to = vector_of(n), *u = vector_of(n), *force = vector_of(n);
    shell_answer answer = {.force = force};
    double size = 0, largest = 0, bending[2] = {0};
    const fracas_stream stream = {.seed = 8, .purpose = FRACAS_PURPOSE_MESH};
    uint64_t draw = 0;
    for (int segment = 0; segment < SEGMENTS; segment++) {
        for (size_t i = 0; i < n; i++)
            to[i] = segment == 2 ? 0.1 * from[i]
                                 : scale * (2 * fracas_stream_uniform(&stream, draw++) - 1);
        for (int step = 1; step <= STEPS; step++) {
            const double x = segment == 0 ? pow((double)step / STEPS, 3)
                                          : (double)step /
                                                STEPS; /* so that onsets are not all in one step */
            for (size_t i = 0; i < n; i++) u[i] = (1 - x) * from[i] + x * to[i];
            evaluate(batch, u, &answer);
            twin_evaluate(&t, u, scale);
            for (size_t i = 0; i < n; i++) largest = fmax(largest, fabs(t.force[i]));
            size = fmax(size, fmax(t.elastic + t.cohesive, t.dissipated + t.rubbed));
            for (size_t i = 0; i < n; i++)
                worst[0] = fmax(worst[0], relative(answer.force[i], t.force[i], largest));
            worst[1] = fmax(worst[1], relative(answer.elastic, t.elastic, size));
            worst[1] = fmax(worst[1], relative(answer.cohesive, t.cohesive, size));
            worst[1] = fmax(worst[1], relative(answer.dissipated, t.dissipated, size));
            worst[1] = fmax(worst[1], relative(answer.rubbed, t.rubbed, size));
            worst[1] = fmax(worst[1], relative(answer.created, t.created, size));
            if (spec->cohesive.friction == 0)
                worst[1] = fmax(worst[1], relative(answer.bending, t.bending, size));
            bending[0] += answer.bending;
            assert_true(answer.bending >= 0);
        }
        memcpy(from, to, n * sizeof *from);
        if (spec->cohesive.friction == 0) {
            for (size_t i = 0; i < n; i++)
                u[i] *= 0.999; /* back a little, and until no layer cracks beside one that has */
            for (int again = 0; again < 3; again++) {
                evaluate(batch, u, &answer);
                twin_evaluate(&t, u, scale);
            }
            worst[2] = fmax(worst[2], slope_error(batch, u, scale, &stream, &draw));
        }
    }
    bending[1] = t.dissipated;
    for (int i = 0; i < 7; i++) seen[i] += t.seen[i];
    print_message(
        "%-7s onset %s, beta_c %.1f, mu_c %.1f, %s, %zu strengths: forces within %.1e, energies "
        "%.1e, slopes %.1e; bending %.2f of it; layers %ld %ld %ld %ld %ld %ld %ld\n",
        spec->geometry.shape->name, spec->cohesive.onset->name, spec->cohesive.coupling,
        spec->cohesive.friction, spec->cohesive.critical_opening > 0 ? "delta_c" : "G_c",
        model->strengths, worst[0], worst[1], worst[2], bending[0] / bending[1], t.seen[0],
        t.seen[1], t.seen[2], t.seen[3], t.seen[4], t.seen[5], t.seen[6]);
    twin_clear(&t);
}

static void interfaces_do_what_their_layers_do(void **unused)
{
    static const fracas_kind *const shapes[] = {&fracas_shape_plate, &fracas_shape_annulus,
                                                &fracas_shape_sphere};
    static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};
    static const double coupling[] = {1, 0.6, 1.7};
    long seen[7] = {0};
    for (int which = 0; which < 24; which += CASE_STRIDE) {
        fracas_spec spec = brittle_shell(shapes[which % 3], 1);
        double worst[3] = {0};
        spec.strength_per_point = which / 12;
        spec.cohesive.onset = onsets[which % 2];
        spec.cohesive.coupling = coupling[(which + which / 3) % 3];
        if (which / 3 % 2) spec.cohesive.friction = 0.4;
        if (which / 6 % 2) {
            spec.cohesive.fracture_energy = 0;
            spec.cohesive.critical_opening = 1.2e-6;
        }
        walk(&spec, 8e-7, which % 3 == 0 ? 0 : 0.1, seen, worst);
        assert_true(worst[0] < 1e-11 && worst[1] < 1e-11 && worst[2] < 1e-6);
    }
    for (int i = 0; i < 7; i++) assert_true(seen[i] > 100);
}

/* ---- when ---- */

/* When an interface cracks and breaks, if every node moves with a velocity of its own: mean
 * tractions and jumps grow as t, but what the law keeps from an onset is that of the step at which
 * it was seen. INFINITY: never. False where a layer breaks in the step of its onset, or slips while
 * it is pressed: then times are not such crossings. */
static bool fate_of(const fracas_batch *batch, size_t i, const double *velocity, double *onset,
                    double *broken)
{
    const fracas_model *model = batch->model;
    const fracas_cohesive *law = &model->spec.cohesive;
    const uint32_t *element = model->surface->interface[i].element;
    const double h = model->spec.geometry.thickness, dt = model->time_step, beta_c = law->coupling;
    double shearing;
    const double k_n = spring_of(model, i, &shearing) * fmax(1, 1 / (beta_c * beta_c)),
                 k_t = beta_c * beta_c * k_n;
    bool ok = true;
    *onset = INFINITY;
    *broken = 0;
    for (int g = 0; g < SHELL_EDGE; g++) {
        const shell_sight r = sight_at(
            model, i, g,
            (const double *const[2]){velocity + 18 * element[0], velocity + 18 * element[1]});
        const bool by_mean = law->onset == &fracas_onset_mean;
        const double strength = strength_at(batch, 0, i, (size_t)g);
        double flux[3][2], opens[3], seen[3], first = INFINITY;
        for (int k = 0; k < 3; k++) {
            const double z = 0.5 * h * (k - 1);
            double mean[2];
            for (int d = 0; d < 2; d++) {
                mean[d] = r.n[d] / h + 12 * z * r.m[d] / (h * h * h);
                flux[k][d] = mean[d] + (d ? k_t : k_n) * (r.jump[d] + z * r.turn[d]);
            }
            opens[k] = strength / judged_of(by_mean ? mean : flux[k], beta_c, law->friction);
            seen[k] = (floor(opens[k] / dt) + 1) * dt;
            first = fmin(first, seen[k]);
            *onset = fmin(*onset, opens[k]);
        }
        for (int k = 0; k < 3; k++) {
            const double judged = judged_of(flux[k], beta_c, law->friction);
            const bool beside = by_mean &&
                                seen[k] >
                                    first; /* a layer that is open: by the flux from then on */
            if (beside) seen[k] = fmax(first + dt, (floor(strength / judged / dt) + 1) * dt);
            const double late = beside ? 0 : strength * (seen[k] / opens[k] - 1);
            const double most = law->critical_opening > 0 ? 0.5 * k_n * law->critical_opening
                                                          : sqrt(k_n * law->fracture_energy);
            const double peak = fmin(most,
                                     by_mean ? fmax(strength, judged * seen[k] - late) : strength);
            const double delta_c = law->critical_opening > 0 ? law->critical_opening
                                                             : 2 * law->fracture_energy / peak;
            const double breaks = isfinite(seen[k]) ? k_n * delta_c / effective_of(flux[k], beta_c)
                                                    : INFINITY;
            *broken = fmax(*broken, breaks);
            ok = ok && (!isfinite(seen[k]) ||
                        (breaks > seen[k] && (law->friction == 0 || flux[k][0] > 0)));
        }
    }
    return ok;
}

/* The mean of an interface's damage by the weights of its points and layers; 1 only when all are.
 */
static double damage_of(const fracas_batch *batch, size_t i)
{
    static const double along[SHELL_EDGE] = {5.0 / 18, 8.0 / 18, 5.0 / 18},
                        across[SHELL_LAYERS] = {1.0 / 6, 2.0 / 3, 1.0 / 6};
    double damage = 0;
    for (int p = 0; p < SHELL_EDGE * SHELL_LAYERS; p++)
        damage += along[p / 3] * across[p % 3] *
                  *surface_point(batch->model, &batch->step, i, p, SURFACE_DAMAGE, 0);
    return damage;
}

/* Every node of a body moves with a velocity of its own, and 100 m/s beside, which does not matter
 * but lets a ledger pass which cannot close with a motion that forces do not change. What is
 * crossed is linear in t: round-off of stresses, which are differences of displacements up to 30
 * times as large as those over an element, and of sums of some 1000 steps, and 1.1e-16 of the
 * displacements by those 100 m/s, which are 1000 times as large: 1e-10 of the time, and ten times
 * that for an onset by what shear has over friction. */
static void check_times(const fracas_spec *spec, double distortion, double worst[2], long counts[2])
{
    OWN(fracas_model) model = distorted_model(*spec, distortion, 3);
    const size_t n = unknowns_of(model);
    const double dt = model->time_step, speed = spec->cohesive.onset == &fracas_onset_flux ||
                                                        spec->cohesive.critical_opening > 0
                                                    ? 2.5
                                                    : 1;
    for (size_t e = 0; e < model->elements; e++)
        tables_of(model)->held[e] = tables_of(model)->fixed[e] = 0x3ffff;
    OWNED double *velocity = zeroed(n, sizeof *velocity);
    const fracas_stream stream = {.seed = 12, .purpose = FRACAS_PURPOSE_MESH};
    for (uint64_t trial = 0; trial < 160 / model->interfaces; trial++) {
        const bool pressed = spec->cohesive.friction > 0 && trial % 2; /* and sheared at random */
        for (size_t i = 0; i < n; i++)
            velocity[i] = speed * (pressed ? 8e-7 : 1e-7) / (200 * dt) *
                          (2 * fracas_stream_uniform(&stream, trial * n + i) - 1);
        for (size_t i = 0; i < n; i++) { /* elements fly apart and stretch, so that much opens */
            const double *element = node_at(model, i / 18, 0), *other = node_at(model, i / 18, 1),
                         *third = node_at(model, i / 18, 2);
            const double centre = (element[i % 3] + other[i % 3] + third[i % 3]) / 3;
            velocity[i] += (pressed ? -0.3 : 1) * speed *
                           (2.1e-3 * centre +
                            1.5e-3 * (node_at(model, i / 18, i % 18 / 3)[i % 3] - centre)) /
                           (200 * dt);
        }
        OWN(fracas_batch) batch = lane_of(model, 0.3, trial, 0);
        double end = 0, onset, broken;
        for (size_t i = 0; i < model->interfaces; i++) {
            if (fate_of(batch, i, velocity, &onset, &broken) && isfinite(broken))
                end = fmax(end, broken);
            if (isfinite(onset)) end = fmax(end, onset);
        }
        model->spec.time.end = fmin(end + 1.5 * dt, 2000 * dt);
        fracas_record record;
        fracas_record_init(&record);
        OK(fracas_batch_begin(batch));
        for (size_t i = 0; i < n; i++) *value_of(batch, i, SURFACE_V) = 100 + velocity[i];
        run_to_end(batch, &record);
        assert_int_equal(record.outcome == FRACAS_ENERGY_DRIFT, 0);
        double first = INFINITY;
        for (size_t i = 0; i < model->interfaces; i++) {
            const fracas_interface_row *row = &record.interface[i];
            const bool breaks = fate_of(batch, i, velocity, &onset, &broken);
            assert_true(row->strength ==
                        fmin(strength_at(batch, 0, i, 0),
                             fmin(strength_at(batch, 0, i, 1), strength_at(batch, 0, i, 2))));
            first = fmin(first, isnan(row->onset_time) ? INFINITY : row->onset_time);
            assert_true(fabs(row->damage - damage_of(batch, i)) < 1e-15 &&
                        (row->damage == 1) == !isnan(row->break_time));
            if (onset > record.end_time) assert_true(isnan(row->onset_time));
            else worst[0] = fmax(worst[0], fabs(row->onset_time / onset - 1)), counts[0]++;
            if (!breaks) continue;
            if (broken > record.end_time) assert_true(isnan(row->break_time) && row->damage < 1);
            else worst[1] = fmax(worst[1], fabs(row->break_time / broken - 1)), counts[1]++;
        }
        assert_true(isinf(first) ? isnan(record.onset_time) : record.onset_time == first);
        fracas_record_clear(&record);
    }
}

static void onsets_and_breaks_come_when_they_must(void **unused)
{
    static const fracas_kind *const shapes[] = {&fracas_shape_plate, &fracas_shape_annulus,
                                                &fracas_shape_sphere};
    static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};
    for (int which = 0; which < 24; which += CASE_STRIDE) {
        fracas_spec spec = brittle_shell(shapes[which % 3], 1);
        double worst[2] = {0};
        long counts[2] = {0};
        spec.strength_per_point = which / 12;
        spec.cohesive.onset = onsets[which % 2];
        spec.cohesive.coupling = which / 3 % 2 ? 0.6 : 1.5;
        spec.cohesive.friction = which / 6 % 2 ? 0.3 : 0;
        spec.time.integrator = which / 3 % 2 ? &fracas_integrator_hulbert_chung
                                             : &fracas_integrator_central_difference;
        if (which / 6 % 2) {
            spec.cohesive.fracture_energy = 0;
            spec.cohesive.critical_opening = 1.2e-6;
        }
        check_times(&spec, which % 3 == 0 ? 0 : 0.1, worst, counts);
        print_message("%-7s onset %s, beta_c %.1f, mu_c %.1f, %s: %ld onsets within %.1e, %ld "
                      "breaks within %.1e\n",
                      spec.geometry.shape->name, spec.cohesive.onset->name, spec.cohesive.coupling,
                      spec.cohesive.friction,
                      spec.strength_per_point ? "3 strengths" : "1 strength", counts[0], worst[0],
                      counts[1], worst[1]);
        assert_true(counts[0] > 100 && counts[1] > 20);
        assert_true(worst[0] < 1e-9 && worst[1] < 1e-10);
    }
}

/* An interface whose last layer is short of its end by the last bit is not broken, however the
 * weights sum. */
static void an_interface_breaks_with_its_last_layer(void **unused)
{
    OWN(fracas_model) model = distorted_model(brittle_shell(&fracas_shape_plate, 1), 0, 0);
    OWN(fracas_batch) batch = lane_of(model, 0, 0, 0);
    OK(fracas_batch_begin(batch));
    for (int last = 0; last <= SHELL_EDGE * SHELL_LAYERS; last++) {
        for (int p = 0; p < SHELL_EDGE * SHELL_LAYERS; p++)
            *surface_point(model, &batch->step, 0, p, SURFACE_DAMAGE, 0) = p == last ? 1 - 0x1p-53
                                                                                     : 1;
        RECORD(record);
        batch->step.broken[0] = 1;
        OK(model->formulation->harvest(model, &batch->step, 0, &record));
        assert_true((record.interface[0].damage == 1) == (last == SHELL_EDGE * SHELL_LAYERS));
        assert_int_equal(record.nfragment, last == SHELL_EDGE * SHELL_LAYERS ? 2 : 1);
    }
}

TESTS(interfaces_do_what_their_layers_do, onsets_and_breaks_come_when_they_must,
      an_interface_breaks_with_its_last_layer)
