/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every law of the list at one point, in every form in which models use it and with its own numbers
 * at both ends of their ranges: onset, energy of a break, unloading, contact, damage, lanes.
 *
 * A law that gets its line in laws.list.h is tested here without more. What may differ is said by
 * traits: `flux`, `fullness`, `steepest`, `shares_of_onset`. */
#include "tests/support/law_point.h"
#include "tests/support/listed_laws.h"
#include "tests/support/test.h"

FRACAS_KERNEL_TABLE(law_unit, law_call);

#define EPS 0x1p-52
#define STRENGTH 100e6 /* Pa */
#define ENERGY 50.0    /* J/m2 */

/* ---- cases ---- */

typedef struct {
    law_case kind;
    const fracas_law *law;
    double delta_c; /* m */
    bool slides;
} subject;

/* `stiff` times the least stiffness of the law; `beta_c` of what slides. */
static subject make_subject(const fracas_law *law, law_form form, int own, double stiff,
                            double beta_c)
{
    fracas_spec spec = {.material = {.young = 275e9, .density = 2750, .poisson = 0.3},
                        .loading = {.rate = 1e4},
                        .cohesive = {.law = &law->kind,
                                     .fracture_energy = ENERGY,
                                     .beta = 4,
                                     .beta_shear = 1,
                                     .coupling = beta_c}};
    set_own_numbers(&spec.cohesive, own);
    const double k = stiff * fracas_law_steepest(&spec.cohesive) * STRENGTH * STRENGTH /
                     (2 * ENERGY);
    subject s = {.law = law,
                 .delta_c = fracas_spec_critical_opening(&spec, STRENGTH),
                 .slides = form == LAW_PLANE || form == LAW_RESULTANTS,
                 .kind = {.law = law->number,
                          .form = form,
                          .k_n = k,
                          .k_t = beta_c * beta_c * k,
                          .beta_c = beta_c,
                          .sigma_c = STRENGTH,
                          .energy = ENERGY,
                          .thickness = 1e-4}};
    if (form == LAW_LINE && law->constant)
        s.kind.constant = law->constant(&spec.cohesive, k, STRENGTH);
    fracas_law_own(&spec, s.kind.own);
    return s;
}

static law_form form_of(law_use use)
{
    return use == USE_FLUX    ? LAW_LINE
           : use == USE_RIGID ? LAW_LINK
           : use == USE_YES   ? LAW_PLANE
                              : LAW_RESULTANTS;
}

/* Calls `check` for every law, form, own numbers, a soft and a stiff interface, shear stronger and
 * weaker than tension. */
static void for_each_subject(void (*check)(const subject *))
{
    static const double stiff[] = {2.5, 60}, beta_c[] = {1.4, 0.8};
    int count = 0;
    for (int l = 0; l < FRACAS_LAWS; l++)
        for (int m = 0; m < MODELS; m++) {
            const law_use use = listed_laws[l].use[m];
            bool seen = use == USE_NO;
            for (int other = 0; other < m; other++) seen |= listed_laws[l].use[other] == use;
            for (int v = 0; v < 4 * OWN_WAYS && !seen; v++) {
                const subject s = make_subject(listed_laws[l].law, form_of(use), v / 4,
                                               stiff[v % 2], beta_c[v / 2 % 2]);
                check(&s);
                count++;
            }
        }
    assert_true(count >= 4 * OWN_WAYS * FRACAS_LAWS);
}

#define FAIL(s, ...) fail_msg_of((s), __LINE__, __VA_ARGS__)
__attribute__((format(printf, 3, 4))) static void fail_msg_of(const subject *s, int line,
                                                              const char *format, ...)
{
    char text[300];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    fail_msg("line %d: law %s, form %d, own %g %g, k_n %g, beta_c %g: %s", line, s->law->kind.name,
             (int)s->kind.form, s->kind.own[0], s->kind.own[1], s->kind.k_n, s->kind.beta_c, text);
}

/* ---- walks ---- */

/* The work of T on q and of s on m by the trapezoid rule. Its error in a step of length h is at
 * most h/4 times the second differences at both ends; `slack` collects twice that, as
 * tests/support/plane.h derives. Roundings: some ten of each step's energies, 1e-14. */
typedef struct {
    const subject *of;
    law_case kind;
    law_memory memory;
    law_at at;
    law_out out;
    double work, created, slack, scale, t_before[2], s_before[2], step_before;
    double cracked_at; /* effective jump of the onset's step [m] */
    long steps;
    int cracks, breaks;
} walk;

static void call_alone(const law_case *kind, const law_at *at, law_memory *memory, law_out *out)
{
    law_call[FRACAS_ISA_BASELINE][1](&kind, at, memory, out);
}

static walk begin_walk(const subject *s)
{
    walk w = {.of = s, .kind = s->kind};
    call_alone(&w.kind, &w.at, &w.memory, &w.out);
    return w;
}

/* D grows or stays, and is 1 exactly from the break on, which comes where the opening is that of
 * the break: 1e-9, rounding of a softening that is 1e4 times as long as the flux's part. */
static void check_damage(const walk *w, const law_out *old)
{
    const law_out *now = &w->out;
    if (!(now->damage >= old->damage && now->damage <= 1))
        FAIL(w->of, "D from %.17g to %.17g", old->damage, now->damage);
    if (now->breaks != (now->damage >= 1 && old->damage < 1) || (now->breaks && now->damage != 1))
        FAIL(w->of, "break %d at D %.17g after %.17g", now->breaks, now->damage, old->damage);
    if (now->breaks && !(now->opening > 1 - 1e-9)) FAIL(w->of, "break at %.17g", now->opening);
    if (now->cracked && now->damage < 1 && !(now->opening < 1 + 1e-9))
        FAIL(w->of, "no break at %.17g", now->opening);
    if (!isfinite(now->t_n + now->t_t + now->flux + now->stored + now->dissipated + now->created))
        FAIL(w->of, "not finite");
    if (!(now->dissipated >= old->dissipated * (1 - 4 * EPS)))
        FAIL(w->of, "dissipated %.17g after %.17g", now->dissipated, old->dissipated);
}

static void walk_step(walk *w, law_at to)
{
    const law_out old = w->out;
    const law_at from = w->at;
    call_alone(&w->kind, &to, &w->memory, &w->out);
    const law_out *now = &w->out;
    check_damage(w, &old);
    w->at = to;
    const double dq[2] = {to.q_n - from.q_n, to.q_t - from.q_t},
                 dm[2] = {to.m_n - from.m_n, to.m_t - from.m_t};
    w->work += 0.5 * ((old.t_n + now->t_n) * dq[0] + (old.t_t + now->t_t) * dq[1]) +
               0.5 * ((old.s_n + now->s_n) * dm[0] + (old.s_t + now->s_t) * dm[1]);
    const double t[2] = {now->t_n - old.t_n, now->t_t - old.t_t},
                 s[2] = {now->s_n - old.s_n, now->s_t - old.s_t}, path = hypot(dq[0], dq[1]),
                 longer = fmax(path, w->step_before);
    w->slack += 0.5 * longer * hypot(t[0] - w->t_before[0], t[1] - w->t_before[1]) +
                0.5 * hypot(dm[0], dm[1]) * hypot(s[0] - w->s_before[0], s[1] - w->s_before[1]);
    memcpy(w->t_before, t, sizeof t);
    memcpy(w->s_before, s, sizeof s);
    w->step_before = path;
    w->created += now->created;
    w->scale = fmax(w->scale, fabs(w->work) + fabs(now->flux) + fabs(now->stored) +
                                  now->dissipated + fabs(w->created));
    w->steps++;
    w->cracks += now->cracks;
    if (now->cracks) w->cracked_at = hypot(to.q_n, w->kind.beta_c * to.q_t);
    w->breaks += now->breaks;
}

static void walk_to(walk *w, law_at to, int steps)
{
    const law_at from = w->at;
    for (int i = 1; i <= steps; i++) {
        const double x = (double)i / steps, y = 1 - x;
        walk_step(w, i == steps ? to
                                : (law_at){y * from.m_n + x * to.m_n, y * from.m_t + x * to.m_t,
                                           y * from.q_n + x * to.q_n, y * from.q_t + x * to.q_t});
    }
}

static double tolerance_of(const walk *w)
{
    return w->slack + 1e-14 * (double)(w->steps + 10) * w->scale;
}

/* The effective opening r along the angle from tension to shear, means 0. */
static law_at opened(const subject *s, double r, double angle)
{
    return (law_at){.q_n = r * cos(angle), .q_t = r * sin(angle) / s->kind.beta_c};
}

/* ---- checks ---- */

/* Onset at the strength, exactly but for roundings of squares and a root, 16 eps: of the mean, and
 * of the flux, in tension, shear, both, and shear under pressure. The traction does not jump there.
 */
static void check_onset(const subject *s)
{
    static const double angle[] = {0, 0.5, 1.5707963267948966};
    for (int a = 0; a < (s->slides ? 4 : 1); a++)
        for (int mean = 0; mean < (s->slides ? 2 : 1); mean++)
            for (int above = 0; above < 2; above++) {
                walk w = begin_walk(s);
                w.kind.onset_mean = mean;
                const double t = STRENGTH * (above ? 1 + 16 * EPS : 1 - 16 * EPS);
                const law_at to = a == 3
                                      ? (law_at){.m_n = -0.3 * STRENGTH, .m_t = -s->kind.beta_c * t}
                                      : (law_at){.m_n = t * cos(angle[a]),
                                                 .m_t = s->kind.beta_c * t * sin(angle[a])};
                if (s->kind.form == LAW_LINK) return; /* its onset is the body's */
                walk_step(&w, to);
                if (w.out.cracked != above || w.out.cracks != above || (w.out.peak > 0) < above)
                    FAIL(s, "angle %d, mean %d: cracked %d at %.17g of the strength", a, mean,
                         w.out.cracked, t / STRENGTH);
                /* a normal law in tension or pressure: 1e-13, roundings of k q - k q_0 */
                if (!(fabs(w.out.t_n - to.m_n) + fabs(w.out.t_t - to.m_t) < 1e-13 * STRENGTH))
                    FAIL(s, "angle %d: %g, %g Pa at the onset, not %g, %g", a, w.out.t_n, w.out.t_t,
                         to.m_n, to.m_t);
            }
}

/* A link's first traction is its strength. */
static void check_first_traction(const subject *s)
{
    if (s->kind.form != LAW_LINK) return;
    const walk w = begin_walk(s);
    if (w.out.t_n != STRENGTH) FAIL(s, "%g Pa at no opening", w.out.t_n);
}

/* The work to open the interface all the way, with what onset and break put in, is G_c: along a
 * straight path at means 0, judged by the flux, in mode I, II and between. `created` makes up for
 * what a law that leaves the flux takes along. Traction and stored energy are then 0. By the shares
 * of an onset at the angle a, G_c (cos^3 + sin^3) (docs/theory/cohesive.md). */
static void check_energy(const subject *s)
{
    static const double angle[] = {0, 1.5707963267948966, 0.4, 1.1};
    const double reach = 1.2 * (s->delta_c + STRENGTH / s->kind.k_n);
    for (int a = 0; a < (s->slides ? 4 : 1); a++) {
        walk w = begin_walk(s);
        walk_to(&w, opened(s, reach, angle[a]), 6000);
        const double c = cos(angle[a]), b = sin(angle[a]);
        const double expected = ENERGY * (s->law->shares_of_onset ? c * c * c + b * b * b : 1);
        const double missing = fabs(w.work + w.created - expected), most = tolerance_of(&w);
        assert_true(most < 2e-3 * ENERGY); /* a per cent is seen */
        if (!(missing <= most))
            FAIL(s, "angle %g: work %g, created %g, expected %g J/m2, to %g", angle[a], w.work,
                 w.created, expected, most);
        if (w.breaks != 1 || w.out.damage != 1 || w.out.t_n != 0 || w.out.t_t != 0 ||
            w.out.flux != 0 || w.out.stored != 0 || fabs(w.out.dissipated / ENERGY - 1) > 4 * EPS)
            FAIL(s, "angle %g: broken %d times, D %.17g, T %g %g, energies %g %g %g", angle[a],
                 w.breaks, w.out.damage, w.out.t_n, w.out.t_t, w.out.flux, w.out.stored,
                 w.out.dissipated);
    }
}

static void judge(const walk *w, int path)
{
    const double held = w->out.flux + w->out.stored + w->out.dissipated, most = tolerance_of(w);
    assert_true(most < 1e-2 * ENERGY);
    if (!(fabs(w->work + w->created - held) <= most))
        FAIL(w->of, "path %d: work %g, created %g, held %g, to %g", path, w->work, w->created, held,
             most);
}

/* The ledger closes half-way and at the end of a path with means, in pure modes; where a law keeps
 * no shares of the onset also from one mode to the other. */
static void check_ledger(const subject *s)
{
    const double r = s->delta_c, b = s->kind.beta_c;
    for (int path = 0; path < (s->slides ? s->law->shares_of_onset ? 2 : 4 : 1); path++) {
        walk w = begin_walk(s);
        w.kind.onset_mean = path % 2;
        const bool shears = path == 1;
        const double m = s->kind.form == LAW_LINK ? 0 : 1.001 * STRENGTH;
        const law_at on = {.m_n = shears ? 0 : m, .m_t = shears ? b * m : 0};
        walk_to(&w, on, 3000);
        law_at half = opened(s, 0.6 * r, shears ? 1.5707963267948966 : 0);
        half.m_n = 0.5 * on.m_n, half.m_t = 0.5 * on.m_t;
        walk_to(&w, half, 3000);
        walk_to(&w, w.at, 2);
        judge(&w, path);
        walk_to(&w, (law_at){.q_n = 0.3 * half.q_n, .q_t = 0.3 * half.q_t}, 1000);
        if (path > 1) walk_to(&w, opened(s, 0.5 * r, 1.2), 2000);
        walk_to(&w, opened(s, 2 * r, path > 1 ? 1.2 : shears ? 1.5707963267948966 : 0), 3000);
        walk_to(&w, w.at, 2); /* second differences need the step that follows */
        judge(&w, path);
        if (w.breaks != 1) FAIL(s, "path %d: %d breaks", path, w.breaks);
    }
}

/* Unloading and reloading lie on one straight line, towards no opening of the crack: D stays, and
 * no work is gained. Values of T are sums and products of some ten roundings: 1e-13 of the
 * strength, and of k q where that is more. */
static void check_secant(const subject *s)
{
    const double k = s->kind.k_n, close = 1e-13 * (STRENGTH + k * s->delta_c),
                 onset = s->kind.form == LAW_LINK ? 0 : STRENGTH / k,
                 whole = s->delta_c - (s->law->flux ? onset : 0); /* the crack's part of q */
    for (int shear = 0; shear < (s->slides ? 2 : 1); shear++)
        for (int far = 1; far < 8; far++) {
            const double r = onset + far / 8.0 * whole, angle = shear ? 1.5707963267948966 : 0,
                         by = shear ? s->kind.beta_c : 1;
            walk w = begin_walk(s);
            walk_to(&w, opened(s, r, angle), 500);
            const law_out there = w.out;
            if (!(there.damage > 0 && there.damage < 1)) FAIL(s, "D %g", there.damage);
            const double from = (shear ? there.t_t : there.t_n) / by;
            const double start = s->law->flux || s->kind.form == LAW_LINK ? onset : w.cracked_at,
                         lower = s->law->flux ? from * start / r : 0;
            w.work = w.slack = 0;
            walk_to(&w, opened(s, 0.5 * (r + start), angle), 300);
            const double middle = (shear ? w.out.t_t : w.out.t_n) / by;
            if (!(fabs(middle - 0.5 * (from + lower)) < close))
                FAIL(s, "shear %d, %d/8: %.17g Pa, not between %.17g and %.17g", shear, far, middle,
                     from, lower);
            walk_to(&w, opened(s, start, angle), 300);
            const double low = (shear ? w.out.t_t : w.out.t_n) / by;
            if (!(fabs(low - lower) < close)) FAIL(s, "%.17g Pa closed, not %.17g", low, lower);
            walk_to(&w, opened(s, r, angle), 500);
            /* the way back may end a rounding beyond where it began */
            if (!(w.out.damage - there.damage < 1e-12) ||
                !(fabs((shear ? w.out.t_t : w.out.t_n) / by - from) < close))
                FAIL(s, "shear %d, %d/8: D %.17g, T %.17g after %.17g, %.17g", shear, far,
                     w.out.damage, w.out.t_n, there.damage, from);
            for (int i = 1; i < 100; i++) /* D does not fall by roundings */
                walk_step(&w, opened(s, r * (1 + i * EPS), angle));
            if (!(fabs(w.work) <= tolerance_of(&w)))
                FAIL(s, "shear %d, %d/8: work %g in a cycle, to %g", shear, far, w.work,
                     tolerance_of(&w));
        }
}

/* Faces that meet push back, by no less than the stiffness k, cracked or broken, and keep nothing
 * of it: the way in and out takes no work and leaves the energies as they were. */
static void check_contact(const subject *s)
{
    const double k = s->kind.k_n, start = STRENGTH / k;
    for (int broken = 0; broken < 2; broken++) {
        walk w = begin_walk(s);
        walk_to(&w, opened(s, start + (broken ? 1.1 : 0.5) * s->delta_c, 0), 500);
        walk_to(&w, opened(s, start, 0), 300);
        const law_out before = w.out;
        w.work = w.slack = w.created = 0;
        walk_to(&w, opened(s, -0.5 * s->delta_c, 0), 800);
        const double most = -k * 0.5 * s->delta_c * (1 - 1e-12);
        if (!(w.out.t_n <= most)) FAIL(s, "broken %d: %g Pa in contact", broken, w.out.t_n);
        const double pressed = w.out.flux + w.out.stored - before.flux - before.stored;
        if (!(fabs(w.work - pressed) <= tolerance_of(&w)))
            FAIL(s, "broken %d: work %g for %g J/m2 in contact", broken, w.work, pressed);
        walk_to(&w, opened(s, start, 0), 800);
        const double energy = fabs(w.out.flux + w.out.stored - before.flux - before.stored);
        if (w.out.damage != before.damage || w.out.dissipated != before.dissipated ||
            w.out.created != 0 || !(energy <= 1e-12 * w.scale) ||
            !(fabs(w.work) <= tolerance_of(&w)))
            FAIL(s, "broken %d: D %.17g after %.17g, work %g to %g, energy %g", broken,
                 w.out.damage, before.damage, w.work, tolerance_of(&w), energy);
    }
}

/* ---- lanes ---- */

/* Lanes at other strengths, on paths of their own: opening, sliding, closing, means that come and
 * go. */
static law_at place_of(const subject *s, int lane, int step)
{
    const double x = step / 100.0, wave = sin(7 * x + lane), r = 1.6 * s->delta_c * x;
    const double side = s->slides ? 0.5 * s->delta_c * x * cos(3 * x + 2 * lane) : 0;
    const double mean = s->kind.form == LAW_LINK ? 0 : 0.6 * STRENGTH * (1 - x);
    return (law_at){.m_n = mean,
                    .m_t = s->slides ? 0.3 * mean * wave : 0,
                    .q_n = r * (0.7 + 0.6 * wave) - 0.05 * s->delta_c * (lane % 3),
                    .q_t = side};
}

static law_case case_of(const subject *s, int lane)
{
    law_case kind = s->kind;
    const double weaker = 1 - 0.02 * lane;
    kind.sigma_c *= weaker;
    kind.constant = (kind.constant + STRENGTH) / weaker -
                    kind.sigma_c; /* of nitsche; any will do */
    return kind;
}

/* Every unit gives the bits of one lane alone, whatever the others do: also beside one that is
 * NaN. */
static void check_lanes_of(const subject *s, law_unit *unit, int lanes, int poisoned)
{
    law_case kinds[FRACAS_LANES_MAX];
    const law_case *kind[FRACAS_LANES_MAX];
    law_memory memory[2][FRACAS_LANES_MAX] = {{{{0}}}};
    for (int l = 0; l < lanes; l++) {
        kinds[l] = case_of(s, l);
        kind[l] = &kinds[l];
    }
    for (int step = 0; step < 150; step++) {
        law_at at[FRACAS_LANES_MAX];
        law_out out[2][FRACAS_LANES_MAX];
        memset(out, 0, sizeof out);
        for (int l = 0; l < lanes; l++) {
            at[l] = place_of(s, l, step);
            call_alone(kind[l], &at[l], &memory[0][l], &out[0][l]);
        }
        if (step > 20 && poisoned >= 0) at[poisoned].q_n = NAN;
        unit(kind, at, memory[1], out[1]);
        for (int l = 0; l < lanes; l++)
            if (l != poisoned && (memcmp(&out[0][l], &out[1][l], sizeof **out) != 0 ||
                                  memcmp(&memory[0][l], &memory[1][l], sizeof **memory) != 0))
                FAIL(s, "lane %d of %d differs at step %d", l, lanes, step);
    }
}

static void check_lanes(const subject *s)
{
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++) {
        fracas_isa had;
        if (fracas_isa_choose(isa, &had)) continue;
        for (int lanes = 1; lanes <= FRACAS_LANES_MAX; lanes++) {
            if (!law_call[isa][lanes]) continue;
            check_lanes_of(s, law_call[isa][lanes], lanes, -1);
            check_lanes_of(s, law_call[isa][lanes], lanes, lanes / 2);
        }
    }
}

static void onset_is_at_the_strength(void **unused)
{
    for_each_subject(check_onset);
    for_each_subject(check_first_traction);
}
static void a_break_takes_the_fracture_energy(void **unused)
{
    for_each_subject(check_energy);
}
static void ledger_closes(void **unused)
{
    for_each_subject(check_ledger);
}
static void unloading_is_by_the_secant(void **unused)
{
    for_each_subject(check_secant);
}
static void contact_keeps_no_energy(void **unused)
{
    for_each_subject(check_contact);
}
static void a_lane_is_its_law_alone(void **unused)
{
    for_each_subject(check_lanes);
}

TESTS(onset_is_at_the_strength, a_break_takes_the_fracture_energy, ledger_closes,
      unloading_is_by_the_secant, contact_keeps_no_energy, a_lane_is_its_law_alone)
