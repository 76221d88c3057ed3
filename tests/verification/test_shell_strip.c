/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A strip of two triangles that is pulled, bent, sheared and twisted until its only interface is
 * broken, in equilibrium all the way (docs/theory/shell.md): what it costs, what of it is bending,
 * and where the crack is closed. */
#include "tests/support/shell_cracks.h"
#include "tests/support/test.h"

/* Fields of the strip, in amplitudes: strain e and curvature k of both elements, then a jump a of
 * both halves and a turn b of one to the other, each along one direction: across the interface
 * (normal) or along it. */
enum { STRAIN, CURVATURE, JUMP, TURN, FIELDS };

typedef struct {
    fracas_model *model;
    fracas_batch *batch;
    double (*field)[36];             /* [FIELDS]: displacements of unit amplitude */
    double x[FIELDS], force[FIELDS]; /* amplitudes; dPi/dx by length of the interface */
    double length, span[2]; /* m: of the interface; elements' area by it, twice that for twist: it
                               turns all of both sides */
    shell_answer answer;
    /* along the way */
    double work, slack, created, bending, before[FIELDS];
    double traced[2];     /* J: of N on a, of M on b */
    double turned, spent; /* J: dissipated by the share that M's work has in each step; dissipated
                             up to the last step */
} strip;

static double depth(const strip *s)
{
    return s->model->spec.geometry.thickness;
}

/* The diagonal of the square, from one end to the other, and what is across it, to the + side. */
static void directions(const fracas_model *model, double middle[3], double across[3],
                       double along[3])
{
    const fracas_surface_interface *joint = &model->surface->interface[0];
    const double *a = node_at(model, joint->element[0], joint->edge[0]),
                 *b = node_at(model, joint->element[0], (joint->edge[0] + 1) % 3);
    for (int i = 0; i < 3; i++) {
        along[i] = b[i] - a[i];
        middle[i] = 0.5 * (a[i] + b[i]);
    }
    unit3(along);
    cross3(along, (const double[3]){0, 0, 1}, across);
}

static void fill_fields(strip *s, bool sliding)
{
    double middle[3], across[3], along[3];
    directions(s->model, middle, across, along);
    for (size_t i = 0; i < 36; i++) {
        const size_t e = i / 18, k = i % 18 / 3, d = i % 3;
        const double *x = node_at(s->model, e, k),
                     at[3] = {x[0] - middle[0], x[1] - middle[1], x[2] - middle[2]};
        const double n = dot3(at, across), t = dot3(at, along),
                     half = e == s->model->surface->interface[0].element[1] ? 0.5 : -0.5;
        const double out = d == 2, in = sliding ? along[d] : across[d];
        s->field[STRAIN][i] = n * in;
        s->field[CURVATURE][i] = out * (sliding ? -n * t : -0.5 * n * n); /* -w,nt or -w,nn = 1 */
        s->field[JUMP][i] = half * in;
        s->field[TURN][i] = out * half * (sliding ? -t : -n); /* -[w],t or -[w,n] = 1 */
    }
}

static strip strip_of(const fracas_spec *spec, bool sliding, double strength)
{
    strip s = {.model = distorted_model(*spec, 0, 0), .field = calloc(FIELDS, sizeof *s.field)};
    assert_true(s.field && s.model->elements == 2 && s.model->interfaces == 1);
    s.batch = lane_of(s.model, 0, 0, 0);
    bar_set_strength(s.batch, 0, 0, strength);
    OK(fracas_batch_begin(s.batch));
    s.answer.force = zeroed(36, sizeof(double));
    s.length = sqrt(2) * spec->geometry.width;
    s.span[0] = spec->geometry.width * spec->geometry.height / s.length;
    s.span[1] = (sliding ? 2 : 1) * s.span[0];
    fill_fields(&s, sliding);
    return s;
}

static void strip_clear(strip *s)
{
    free(s->field);
    free(s->answer.force);
    fracas_batch_destroy(s->batch);
    fracas_model_destroy(s->model);
}

/* Forces of the fields at amplitudes x; `advances`: damage does. */
static void probe(strip *s, const double x[FIELDS], bool advances, double force[FIELDS])
{
    double u[36] = {0};
    for (int f = 0; f < FIELDS; f++)
        for (int i = 0; i < 36; i++) u[i] += x[f] * s->field[f][i];
    if (advances) evaluate(s->batch, u, &s->answer);
    else look_at(s->batch, u, &s->answer);
    for (int f = 0; f < FIELDS; f++) {
        force[f] = 0;
        for (int i = 0; i < 36; i++) force[f] -= s->answer.force[i] * s->field[f][i] / s->length;
    }
}

/* Ends that are moved by E = span e + a and K = span k + b meet N = F_a and M = F_b. Inside, at
 * given E and K, equilibrium: F_e = span F_a, F_k = span F_b. `no_pull`: N = 0 besides, for which a
 * is free. In units of strength and thickness. */
static void misses(const strip *s, const double force[FIELDS], double sigma, bool no_pull,
                   double miss[3])
{
    const double h = depth(s);
    miss[0] = (force[STRAIN] / s->span[0] - force[JUMP]) / (sigma * h);
    miss[1] = (force[CURVATURE] / s->span[1] - force[TURN]) / (sigma * h * h);
    miss[2] = no_pull ? force[JUMP] / (sigma * h) : 0;
}

static void solve(double a[3][3], double b[3], int n)
{
    for (int c = 0; c < n; c++) {
        int pivot = c;
        for (int r = c + 1; r < n; r++)
            if (fabs(a[r][c]) > fabs(a[pivot][c])) pivot = r;
        for (int j = 0; j < n; j++) {
            const double keep = a[c][j];
            a[c][j] = a[pivot][j];
            a[pivot][j] = keep;
        }
        const double keep = b[c];
        b[c] = b[pivot];
        b[pivot] = keep;
        for (int r = 0; r < n; r++) {
            const double share = a[r][c] / a[c][c];
            if (r == c) continue;
            for (int j = c; j < n; j++) a[r][j] -= share * a[c][j];
            b[r] -= share * b[c];
        }
    }
    for (int c = 0; c < n; c++) b[c] /= a[c][c];
}

/* Amplitudes with ends at E, K. */
static void place(const strip *s, const double end[2], const double opening[2], double x[FIELDS])
{
    for (int f = 0; f < 2; f++) {
        x[f] = (end[f] - opening[f]) / s->span[f];
        x[JUMP + f] = opening[f];
    }
}

static double size_of(const double miss[3])
{
    return fabs(miss[0]) + fabs(miss[1]) + fabs(miss[2]);
}

static double miss_at(strip *s, const double end[2], const double opening[2], double sigma,
                      bool no_pull, double miss[3])
{
    double force[FIELDS], x[FIELDS];
    place(s, end, opening, x);
    probe(s, x, false, force);
    misses(s, force, sigma, no_pull, miss);
    return size_of(miss);
}

/* One step of Newton's iteration for a, b (and E), with slopes by differences of this sign; shorter
 * where an event is in between. False where that brings nothing. */
static bool closer(strip *s, double end[2], double opening[2], double sigma, bool no_pull,
                   double sign)
{
    const double small[3] = {sign * 1e-6 * 200 / sigma, sign * 1e-6 * 200 / sigma / depth(s),
                             sign * 1e-6 * 200 / sigma};
    double *unknown[3] = {&opening[0], &opening[1], &end[0]}, miss[3], moved[3], slope[3][3],
           from[3];
    const int n = no_pull ? 3 : 2;
    const double size = miss_at(s, end, opening, sigma, no_pull, miss);
    for (int j = 0; j < n; j++) {
        from[j] = *unknown[j];
        *unknown[j] += small[j];
        miss_at(s, end, opening, sigma, no_pull, moved);
        for (int i = 0; i < n; i++) slope[i][j] = (moved[i] - miss[i]) / small[j];
        *unknown[j] = from[j];
    }
    solve(slope, miss, n);
    for (double share = 1; share > 1e-3; share *= 0.5) {
        for (int j = 0; j < n; j++) *unknown[j] = from[j] - share * miss[j];
        if (miss_at(s, end, opening, sigma, no_pull, moved) < size) return true;
    }
    for (int j = 0; j < n; j++) *unknown[j] = from[j];
    return false;
}

/* False where there is no equilibrium, as a layer is about to break; a, b (and E) are then where it
 * is missed least. */
static bool balance(strip *s, double end[2], double opening[2], double sigma, bool no_pull)
{
    double miss[3];
    for (int trial = 0; trial < 60; trial++) {
        if (miss_at(s, end, opening, sigma, no_pull, miss) < 1e-10) return true;
        if (!closer(s, end, opening, sigma, no_pull, 1) &&
            !closer(s, end, opening, sigma, no_pull, -1))
            return false;
    }
    return false;
}

/* Takes the strip to amplitudes x. Work by the trapezoid rule: its error in a step is at most a
 * quarter of the second differences at the step's two ends, by the step, of each force; twice that
 * is allowed, as a jump and a corner may share a step. */
static void advance(strip *s, const double x[FIELDS])
{
    double force[FIELDS], part[2] = {0};
    probe(s, x, true, force);
    for (int f = 0; f < FIELDS; f++) {
        const double dx = x[f] - s->x[f], change = force[f] - s->force[f];
        s->work += s->length * dx * 0.5 * (force[f] + s->force[f]);
        s->slack += s->length * fabs(dx) * fabs(change - s->before[f]);
        s->before[f] = change;
        if (f >= JUMP) part[f - JUMP] = s->length * dx * 0.5 * (force[f] + s->force[f]);
    }
    for (int f = 0; f < 2; f++) {
        s->traced[f] += part[f];
        part[f] = fmax(0, part[f]);
    }
    if (part[0] + part[1] > 0)
        s->turned += (s->answer.dissipated - s->spent) * part[1] / (part[0] + part[1]);
    s->spent = s->answer.dissipated;
    s->created += s->answer.created;
    s->bending += s->answer.bending;
    memcpy(s->x, x, sizeof s->x);
    memcpy(s->force, force, sizeof s->force);
}

/* work = stored + dissipated - created. */
static double ledger_error(const strip *s)
{
    const double held = s->answer.elastic + s->answer.cohesive + s->answer.dissipated - s->created;
    return fabs(s->work - held) /
           (s->slack + 1e-11 * fabs(s->answer.dissipated + s->answer.elastic));
}

static double damage_of(const strip *s, int g, int k)
{
    return *surface_point(s->model, &s->batch->step, 0, g * SHELL_LAYERS + k, SURFACE_DAMAGE, 0);
}

/* Loads the elements without a crack until the outer layer is at its strength, with eta = 1 - n0/(h
 * sigma) of bending: n0 = (1 - eta) h sigma, m0 = eta h^2 sigma/6; a crack has begun right after.
 */
static void load(strip *s, double sigma, double eta, bool sliding, int steps)
{
    const fracas_material *m = &s->model->spec.material;
    const double h = depth(s), c = sliding ? m->young / (2 * (1 + m->poisson))
                                           : m->young / (1 - m->poisson * m->poisson);
    for (int i = 1; i <= steps; i++) {
        const double share = (double)i / steps * (1 + 1e-9),
                     twist = sliding ? 0.5 : 1; /* 2 rho_nt = 2 k */
        const double x[FIELDS] = {share * (1 - eta) * sigma / c,
                                  share * twist * 2 * eta * sigma / (c * h), 0, 0};
        advance(s, x);
        assert_int_equal(s->batch->step.cracked[0], i == steps);
        assert_true(fabs(s->force[JUMP] - share * (1 - eta) * h * sigma) < 1e-8 * h * sigma);
        assert_true(fabs(s->force[TURN] - share * eta * h * h * sigma / 6) < 1e-8 * h * h * sigma);
    }
}

static double end_of(const strip *s, int f)
{
    return s->span[f] * s->x[f] + s->x[JUMP + f];
}

/* Moves the ends from where they are to E, K, in equilibrium; or turns them and lets N = 0 find E.
 * Returns the number of steps that ended without equilibrium, as a layer broke. */
static int move_ends(strip *s, double e, double k, double sigma, bool no_pull, int steps)
{
    const double from[2] = {end_of(s, 0), end_of(s, 1)};
    int unbalanced = 0;
    for (int i = 1; i <= steps; i++) {
        const double share = (double)i / steps;
        double end[2] = {no_pull ? end_of(s, 0) : from[0] + share * (e - from[0]),
                         from[1] + share * (k - from[1])},
               opening[2], x[FIELDS];
        memcpy(opening, s->x + JUMP, sizeof opening);
        unbalanced += !balance(s, end, opening, sigma, no_pull);
        place(s, end, opening, x);
        advance(s, x);
    }
    return unbalanced;
}

#define SIGMA 300e6
#define DELTA_C (2 * 200 / SIGMA)

static fracas_spec strip_spec(const fracas_kind *onset)
{
    fracas_spec spec = brittle_shell(&fracas_shape_plate, 1);
    spec.cohesive.onset = onset;
    spec.geometry.width = spec.geometry.height = 3e-4; /* stiffer than a crack softens: no jumps */
    return spec;
}

/* Back to a fifth of where the ends are, and again there: nothing is dissipated, and no work is
 * gained or lost. */
static void unload_and_reload(strip *s)
{
    const double e = end_of(s, 0), k = end_of(s, 1), work = s->work, slack = s->slack,
                 dissipated = s->answer.dissipated;
    int unbalanced = move_ends(s, 0.2 * e, 0.2 * k, SIGMA, false, 50);
    assert_true(fabs(s->answer.dissipated - dissipated) < 1e-12 * dissipated);
    unbalanced += move_ends(s, e, k, SIGMA, false, 50);
    assert_true(unbalanced == 0 && fabs(s->answer.dissipated - dissipated) < 1e-9 * dissipated);
    assert_true(fabs(s->work - work) < s->slack - slack + 1e-9 * dissipated);
}

/* Pressed, faces of a broken interface are springs K in series with the elements; turned until one
 * skin alone is in touch, they turn about it; and all work comes back. */
static void close_and_open(strip *s)
{
    const fracas_material *m = &s->model->spec.material;
    double shearing;
    const double h = depth(s), series = 1 / spring_of(s->model, 0, &shearing) +
                                        s->span[0] * (1 - m->poisson * m->poisson) / m->young;
    const double e = end_of(s, 0), work = s->work, slack = s->slack,
                 dissipated = s->answer.dissipated, pressed = -0.2 * DELTA_C,
                 turned = 0.3 * DELTA_C / h;
    int unbalanced = move_ends(s, pressed, 0, SIGMA, false, 200);
    assert_true(fabs(s->force[JUMP] * series / (h * pressed) - 1) < 1e-8 &&
                fabs(s->force[TURN]) < 1e-8 * h * h * SIGMA);
    unbalanced += move_ends(s, pressed, turned, SIGMA, false, 50);
    assert_true(fabs(s->force[JUMP] * series / (h * pressed) - 1) < 1e-8 &&
                fabs(s->force[TURN] * series * 12 / (h * h * h * turned) - 1) < 1e-8);
    unbalanced += move_ends(s, 0, 4 * turned, SIGMA, false, 50);
    assert_true(s->force[JUMP] < -0.1 * h * SIGMA &&
                fabs(s->force[TURN] / (-0.5 * h * s->force[JUMP]) - 1) < 1e-8);
    unbalanced += move_ends(s, e, 0, SIGMA, false, 200);
    assert_true(unbalanced == 0 && s->answer.dissipated == dissipated &&
                s->answer.elastic + s->answer.cohesive < 1e-9 * dissipated);
    assert_true(fabs(s->work - work) < s->slack - slack + 1e-9 * dissipated &&
                s->slack - slack < 0.01 * dissipated);
}

static void tell(const strip *s, const char *what, double eta, int unbalanced, double cost)
{
    print_message("%-8s eta %.2f, onset %s: dissipated/h G_c - 1 = %.1e, created %.1e; by bending "
                  "%.3f (%.3f by steps), works of N %.3f and M %.3f; %d steps without equilibrium, "
                  "ledger %.2f of what is allowed (%.1e)\n",
                  what, eta, s->model->spec.cohesive.onset->name, s->answer.dissipated / cost - 1,
                  s->created / cost, s->bending / cost, s->turned / cost, s->traced[0] / cost,
                  s->traced[1] / cost, unbalanced, ledger_error(s), s->slack / cost);
}

/* eta as in docs/theory/shell.md: 0 is pulled, 1 bent, 1.07 bent and pressed. Then the halves are
 * pulled apart. What is dissipated is h G_c by length, whatever the way: to round-off. Pulled, N =
 * h sigma (1 - a/delta_c). Each layer that breaks in a bent strip takes the mean stress of its
 * place with it: created, below 2.5e-3 of the cost. */
static void a_full_break_costs_h_times_the_fracture_energy(void **unused)
{
    static const double etas[] = {0, 0.5, 1, 1.07};
    static const fracas_kind *const onsets[] = {&fracas_onset_mean, &fracas_onset_flux};
    for (int which = 0; which < 8; which++) {
        const double eta = etas[which / 2], wide = 0.5 * DELTA_C;
        const fracas_spec spec = strip_spec(onsets[which % 2]);
        strip s = strip_of(&spec, false, SIGMA);
        const double h = depth(&s), cost = h * 200 * s.length;
        load(&s, SIGMA, eta, false, 20);
        int unbalanced = move_ends(&s, wide + 0.5 * end_of(&s, 0),
                                   2 * eta * wide / h + 0.5 * end_of(&s, 1), SIGMA, false, 400);
        if (eta == 0) {
            assert_true(fabs(s.force[JUMP] / (h * SIGMA * (1 - s.x[JUMP] / DELTA_C)) - 1) < 1e-9 &&
                        fabs(s.force[TURN]) < 1e-9 * h * h * SIGMA);
            assert_true(s.bending < 1e-12 * cost);
        } else {
            assert_true(s.bending > 0.03 * s.answer.dissipated &&
                        s.bending < 0.7 * s.answer.dissipated);
        }
        unload_and_reload(&s);
        unbalanced += move_ends(&s, 3 * DELTA_C, 0, SIGMA, false, 1000);
        tell(&s, "pulled", eta, unbalanced, cost);
        assert_true(fabs(s.answer.dissipated / cost - 1) < 1e-13 && s.batch->step.broken[0] == 1);
        assert_true(s.answer.elastic < 1e-12 * cost && s.answer.cohesive == 0 &&
                    fabs(s.created) < 2.5e-3 * cost);
        assert_true(ledger_error(&s) < 1 && s.slack < 0.01 * cost && unbalanced < 5);
        assert_true(fabs(s.bending - s.turned) <
                    0.06 * cost); /* M on all of b, not on its growth: measured */
        close_and_open(&s);
        assert_true(ledger_error(&s) < 1);
        strip_clear(&s);
    }
}

/* Bent without a pull: as long as the outer layer alone opens, by d, a = d/6 and b = 12/h^2 z d/6,
 * so that the faces turn about z = -a/b = -h/6; once it has taken the middle with it, about the
 * inner skin, which is left; two of the three layers are open, 5/6 of the cost, all of it by
 * bending: N is 0 at the end of each step, and halfway through one of 2000 at most what a layer
 * loses in it, half of 1e-3 of the strength, which counts only where M is as small as that: 1 %.
 * The middle's mean stress is N/h = 0: it is its flux that cracks it, for either onset: M is never
 * more than that of all but the inner skin at the strength, (h/6 h + 4 h/6 h/2) sigma = 3 h^2
 * sigma/6. */
static void the_neutral_axis_moves_to_the_inner_skin(void **unused)
{
    for (int which = 0; which < 2; which++) {
        const fracas_spec spec = strip_spec(which ? &fracas_onset_flux : &fracas_onset_mean);
        strip s = strip_of(&spec, false, SIGMA);
        const double h = depth(&s), cost = h * 200 * s.length;
        load(&s, SIGMA, 1, false, 20);
        const double turned = end_of(&s, 1);
        double last = 0, most = 0;
        int unbalanced = 0, alone = 0;
        for (int i = 1; i <= 2000; i++) {
            unbalanced += move_ends(&s, 0, turned + (0.05 + 3 * i / 2000.0) * DELTA_C / h, SIGMA,
                                    true, 1);
            const double axis = -s.x[JUMP] / s.x[TURN] / h;
            if (damage_of(&s, 1, 1) == 0 && damage_of(&s, 1, 2) > 1e-3) {
                assert_true(fabs(axis + 1.0 / 6) < 1e-6);
                alone++;
            }
            assert_true(damage_of(&s, 1, 0) == 0 && axis < -1.0 / 6 + 1e-6 && axis > -0.5 - 1e-3);
            last = axis;
            most = fmax(most, 6 * s.force[TURN] / (h * h * SIGMA));
        }
        tell(&s, "bent", 1, unbalanced, cost);
        print_message("axis at %.6f of the thickness, %d steps with the outer layer alone, M up to "
                      "%.3f of what opens it\n",
                      last, alone, most);
        assert_true(alone > 10 && fabs(last + 0.5) < 1e-6 && unbalanced < 5 && most < 3);
        assert_true(fabs(s.answer.dissipated / cost - 5.0 / 6) < 1e-12 &&
                    s.batch->step.broken[0] == 0);
        assert_true(s.bending > 0.99 * s.answer.dissipated &&
                    s.bending <= s.answer.dissipated * (1 + 1e-12));
        assert_true(ledger_error(&s) < 1 && s.slack < 0.01 * cost);
        strip_clear(&s);
    }
}

/* Sheared (eta 0), or twisted first: faces that twist shear off at their ends, [u].t = -b s along
 * the edge, which costs beta_shear's stiffness; when the last layer breaks that goes, and is
 * booked: created = -1/2 c b^2 length^3/12, c the stiffness by length, but for what layers take
 * with them. */
static void sheared_and_twisted(void **unused)
{
    static const double coupling[] = {1, 0.6, 0.8};
    for (int which = 0; which < 12; which++) {
        fracas_spec spec = strip_spec(which % 2 ? &fracas_onset_flux : &fracas_onset_mean);
        const double eta = which / 6, beta_c = coupling[which / 2 % 3], reach = beta_c * SIGMA,
                     wide = DELTA_C / beta_c;
        spec.cohesive.coupling = beta_c;
        spec.cohesive.beta_shear = which % 2 ? 0.01 : 0.003;
        strip s = strip_of(&spec, true, SIGMA);
        double shearing;
        const double h = depth(&s), cost = h * 200 * s.length;
        spring_of(s.model, 0, &shearing);
        load(&s, reach, eta, true, 20);
        const double k = end_of(&s, 1) + eta * 0.8 * wide / h;
        int unbalanced = move_ends(&s, end_of(&s, 0), k, SIGMA, false, 200);
        if (eta > 0)
            assert_true(damage_of(&s, 1, 0) > 0.01 && damage_of(&s, 1, 2) > 0.01 &&
                        damage_of(&s, 1, 1) == 0 && s.bending > 0.999 * s.answer.dissipated);
        for (int i = 0; i < 2000 && s.batch->step.broken[0] == 0; i++)
            unbalanced += move_ends(&s, end_of(&s, 0) + 0.002 * wide, k, SIGMA, false, 1);
        const double dropped = 0.5 * shearing * s.x[TURN] * s.x[TURN] * pow(s.length, 3) / 12;
        tell(&s, "sheared", eta, unbalanced, cost);
        print_message("sheared off %.3e\n", dropped / cost);
        assert_true(fabs(s.answer.dissipated / cost - 1) < 1e-13 && s.batch->step.broken[0] == 1);
        assert_true(fabs(s.created + dropped) < 2e-3 * cost &&
                    (eta == 0) == (dropped < 1e-12 * cost));
        assert_true(ledger_error(&s) < 1 && s.slack < 0.05 * cost);
        strip_clear(&s);
    }
}

TESTS(a_full_break_costs_h_times_the_fracture_energy, the_neutral_axis_moves_to_the_inner_skin,
      sheared_and_twisted)
