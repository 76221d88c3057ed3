/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Law `exponential` at prescribed jumps against its closed forms, (cohesive.30) to (cohesive.34) of
 * docs/theory/cohesive.md, which are evaluated here by themselves in long double: the opening by
 * bisection, the dissipated energy by Simpson's rule of the envelope. */
#include "tests/support/law_point.h"
#include "tests/support/test.h"

FRACAS_KERNEL_TABLE(law_unit, law_call);

#define EPS 0x1p-52
#define PEAK 100e6  /* Pa */
#define ENERGY 50.0 /* J/m2 */

typedef struct {
    law_case kind;
    long double e, end, length, y; /* e, V, l [m], k l [Pa] */
} subject;

/* The envelope at an opening of v l [Pa]  (cohesive.30) */
static long double envelope(const subject *s, long double v)
{
    return PEAK * (expl(-v) - s->e) / (1 - s->e);
}

/* Work along the envelope to v, by Simpson's rule in 2^10 steps: its error is below
 * v^5/(2880 2^40) p l < 2e-10 p l [J/m2]. */
static long double work_along(const subject *s, long double v)
{
    enum { STEPS = 1 << 10 };
    long double sum = envelope(s, 0) - envelope(s, v);
    for (int i = 1; i <= STEPS; i++)
        sum += 4 * envelope(s, v * (i - 0.5L) / STEPS) + 2 * envelope(s, v * i / STEPS);
    return s->length * v * sum / (6 * STEPS);
}

/* v at which traction and flux add up to the trial S: the left side grows with v  (cohesive.33) */
static long double place_of(const subject *s, long double trial)
{
    long double low = 0, high = s->end;
    if (trial >= s->y * s->end) return s->end;
    for (int i = 0; i < 100; i++) {
        const long double middle = 0.5L * (low + high);
        if (s->y * middle + envelope(s, middle) < trial) low = middle;
        else high = middle;
    }
    return low;
}

/* `stiff` is y over the steepest slope times l, p/(1 - e); above 1. */
static subject make_subject(law_form form, double cut, double stiff)
{
    subject s = {.e = cut, .end = -logl(cut)};
    const fracas_cohesive cohesive = {
        .law = &fracas_law_exponential.kind, .fracture_energy = ENERGY, .own = {cut}};
    const fracas_spec spec = {.cohesive = cohesive};
    s.length = ENERGY * (1 - s.e) / (PEAK * (1 - s.e - s.e * s.end));
    s.y = (long double)stiff * PEAK / (1 - s.e);
    const double k = (double)(s.y / s.length);
    s.kind = (law_case){.law = fracas_law_exponential.number,
                        .form = form,
                        .k_n = k,
                        .k_t = k,
                        .beta_c = 1,
                        .sigma_c = PEAK,
                        .energy = ENERGY,
                        .constant = fracas_law_exponential.constant(&cohesive, k, PEAK)};
    fracas_law_own(&spec, s.kind.own);
    return s;
}

/* The law at S = `trial` in the first lane of a unit. The others are just above the
 * strength, where y near the slope makes Newton's steps many. */
static law_out call(const subject *s, law_unit *unit, int lanes, double trial, law_memory *memory)
{
    const law_case *kind[FRACAS_LANES_MAX];
    law_at at[FRACAS_LANES_MAX] = {{0}};
    law_out out[FRACAS_LANES_MAX];
    memset(out, 0, sizeof out);
    for (int l = 0; l < lanes; l++) {
        kind[l] = &s->kind;
        at[l].q_n = (l == 0 ? trial : PEAK * (1 + 1e-9 * l)) / s->kind.k_n;
    }
    unit(kind, at, memory, out);
    return out[0];
}

/* Compares one answer. v is off by the roundings of S, y v and r exp(-v), some ten of EPS/2 each of
 * the largest, S, over the slope y - r exp(-v) of their sum; T by r times that; f, of slope below
 * 1/2 (cohesive.32), by it over N >= 0.15, beside its own eight roundings. */
static void compare(const subject *s, double trial, const law_out *out)
{
    const long double v = place_of(s, trial), r = PEAK / (1 - s->e), x = expl(-v),
                      traction = envelope(s, v), area = 1 - s->e - s->e * s->end;
    const double close = (double)(8 * EPS * (trial + s->y * v) / (s->y - r * x)) + 4 * EPS;
    const double damage = (double)(v / s->end);
    if (!(fabs(out->damage - damage) <= close))
        fail_msg("S %.17g Pa: D %.17g, not %.17g to %g", trial, out->damage, damage, close);
    if (!(fabsl(out->t_n - traction) <= r * close))
        fail_msg("S %.17g Pa: T %.17g, not %.17Lg", trial, out->t_n, traction);
    const long double spent = work_along(s, v) - 0.5L * traction * v * s->length;
    const double most = ENERGY * (close / (double)area + 8 * EPS) +
                        4e-10 * PEAK * (double)s->length;
    if (!(fabsl(out->dissipated - spent) <= most))
        fail_msg("S %.17g Pa: %.17g J/m2 dissipated, not %.17Lg", trial, out->dissipated, spent);
}

static const double cuts[] = {1e-6, 1e-3, 0.01, 0.2, 0.5};

/* At once from no damage, and by steps as a load would, from just above the strength to the break;
 * stiffnesses from barely above the steepest slope. Lanes that need fewer of Newton's steps than
 * others have the bits of a lane alone. */
static void opens_as_the_closed_form(void **unused)
{
    const double stiff[] = {1 + 1e-6, 1.01, 2, 60};
    enum { PLACES = 20 };
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa <= FRACAS_ISA_AVX512; isa++) {
        fracas_isa had;
        if (fracas_isa_choose(isa, &had)) continue;
        for (int i = 0; i < 5 * 4 * 2 * FRACAS_LANES_MAX; i++) {
            const int plane = i / 20 % 2, lanes = i / 40 + 1;
            const subject s = make_subject(plane ? LAW_PLANE : LAW_LINE, cuts[i % 5],
                                           fmax(stiff[i / 5 % 4], plane ? 2.0 : 1.0));
            if (!law_call[isa][lanes]) continue;
            law_memory steps[FRACAS_LANES_MAX] = {{{0}}};
            for (int k = 0; k <= PLACES; k++) {
                const double x = (double)k / PLACES,
                             trial = PEAK * (1 + 1e-9) + x * x * x * (double)(s.y * s.end - PEAK);
                law_memory once[FRACAS_LANES_MAX] = {{{0}}}, lone = {{0}};
                const law_out out = call(&s, law_call[isa][lanes], lanes, trial, once),
                              more = call(&s, law_call[isa][lanes], lanes, trial, steps);
                compare(&s, trial, &out);
                compare(&s, trial, &more);
                const law_out one = call(&s, law_call[FRACAS_ISA_BASELINE][1], 1, trial, &lone);
                if (memcmp(&one, &out, sizeof one) != 0)
                    fail_msg("S %.17g Pa: other bits in %d lanes", trial, lanes);
            }
        }
    }
}

/* Just below the opening of the break it holds, at it it is broken and has taken G_c to the bit. */
static void breaks_at_the_end(void **unused)
{
    for (int i = 0; i < 5 * 2; i++) {
        const subject s = make_subject(i / 5 ? LAW_PLANE : LAW_LINE, cuts[i % 5], 3);
        const double last = (double)(s.y * s.end);
        law_memory memory = {{0}};
        law_unit *unit = law_call[FRACAS_ISA_BASELINE][1];
        law_out out = call(&s, unit, 1, last * (1 - 1e-13), &memory);
        assert_true(out.damage < 1 && out.t_n > 0 && !out.breaks);
        out = call(&s, unit, 1, last * (1 + 1e-13), &memory);
        assert_true(out.damage == 1 && out.t_n == 0 && out.breaks && out.created == 0);
        assert_true(out.dissipated == ENERGY && out.stored == 0 && out.flux == 0);
    }
}

/* Fullness and steepest slope, by the integral of the envelope and its derivative at 0; between
 * those of linear softening, 1/2 and 1, and of an exponential, 0 and 2. Some ten roundings, N's
 * terms up to 1/N <= 7 times as large. */
static void ends_between_linear_and_exponential(void **unused)
{
    for (int i = 0; i < 5; i++) {
        const fracas_cohesive cohesive = {.law = &fracas_law_exponential.kind, .own = {cuts[i]}};
        const long double e = cuts[i], end = -logl(e), area = (1 - e - e * end) / (1 - e);
        assert_true(fabsl(fracas_law_fullness(&cohesive) - area / end) < 16 * EPS);
        assert_true(fabsl(fracas_law_steepest(&cohesive) - 2 * area / (1 - e)) < 32 * EPS);
        assert_true(fracas_law_fullness(&cohesive) < 0.5 && fracas_law_steepest(&cohesive) > 1 &&
                    fracas_law_steepest(&cohesive) < 2);
    }
}

TESTS(opens_as_the_closed_form, breaks_at_the_end, ends_between_linear_and_exponential)
