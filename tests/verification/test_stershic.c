/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Stershic's algorithm (docs/theory/ring.md) in states that are set: law, time step, order of
 * opening, zone, bulk damage. */
#include "tests/support/stershic.h"
#include "tests/support/test.h"

/* Traction of link e [Pa] as both of its nodes felt it: in the first step a velocity is forces by
 * half the next time step by dt/2, and unstrained elements exert none. The element's own sum is
 * turned into the link's direction. */
static double felt(const one_run *run, size_t e, bool right)
{
    double n[2];
    const double mass = 0.5 * DENSITY * run->h, kick = 0.5 * run->batch->step.next[0];
    const double *v = right ? at(run, e + 1, RING_V_LEFT) : at(run, e, RING_V_RIGHT);
    normal_of(run, e, n);
    return (right ? -1 : 1) * (v[0] * n[0] + v[1] * n[1]) * mass / kick;
}

typedef struct {
    double damage, q; /* before; in delta_c */
    double traction;  /* exact, by sigma_c */
    double after;     /* damage */
} law_point;

/* Linear softening, secant to the origin, contact of stiffness penalty E/h before and after the
 * break. Displacements of delta_c = 6.7e-7 m at positions of 8 mm: differences of displacements are
 * good to 1e-15 of delta_c or so, stresses of elements that are moved as they are stay 0,
 * directions are good to 1e-16: 1e-13 leaves room. */
static void the_law_at_prescribed_openings(void **unused)
{
    const double sigma_c = 300e6, delta_c = 2 * 100 / sigma_c;
    enum { N = 40, LINK = 7 };
    for (int k = 0; k < 4; k++) {
        fracas_spec spec = at_rest(N);
        if (k & 1) spec.geometry.direction = &fracas_direction_initial;
        if (k & 2) {
            spec.cohesive.fracture_energy = 0;
            spec.cohesive.critical_opening = delta_c;
        }
        spec.cohesive.own[PENALTY] = k & 1 ? 0.75 : 1;
        const double contact = spec.cohesive.own[PENALTY] * YOUNG / (RING_CIRCUMFERENCE / N) *
                               delta_c / sigma_c;
        const law_point points[] = {{0, 0, 1, 0},
                                    {0, 0.25, 0.75, 0.25},
                                    {0.25, 0.5, 0.5, 0.5}, /* loading */
                                    {0.5, 0.25, 0.25, 0.5},
                                    {0.5, 0.125, 0.125, 0.5},
                                    {0.8, 0.4, 0.1, 0.8}, /* on the way to the origin, and back */
                                    {0.5, 0, 0, 0.5},
                                    {0.5, 0.499, 0.499, 0.5},
                                    {0.5, 0.501, 0.499, 0.501},
                                    {0.9, 1.5, 0, 1},
                                    {1, 0.5, 0, 1},
                                    {1, 1.5, 0, 1}, /* breaks; is broken */
                                    {0, -0.01, -0.01 * contact, 0},
                                    {0.5, -0.01, -0.01 * contact, 0.5},
                                    {1, -0.3, -0.3 * contact, 1}};
        for (size_t i = 0; i < FRACAS_COUNT(points); i++) {
            const law_point *p = &points[i];
            one_run run = begin(&spec, sigma_c);
            *link_of(&run, LINK) = RING_LINK_OPEN;
            *at(&run, LINK, RING_DAMAGE) = p->damage;
            set_jump(&run, LINK, p->q * delta_c);
            step_run(&run);
            const fracas_ledger *ledger = &run.batch->lane[0].ledger;
            const double area = spec.geometry.area,
                         stored = 0.5 * area * p->traction * sigma_c * p->q * delta_c;
            for (int right = 0; right < 2; right++)
                assert_true(fabs(felt(&run, LINK, right) / sigma_c - p->traction) < 1e-13);
            assert_true(fabs(*at(&run, LINK, RING_DAMAGE) - p->after) < 1e-13);
            assert_true(fabs(ledger->cohesive - stored) < 1e-13 * area * sigma_c * delta_c);
            assert_true(fabs(ledger->dissipated - area * 100 * p->after) < 1e-13 * area * 100);
            assert_int_equal(run.batch->step.broken[0], p->damage < 1 && p->after == 1);
            clear_run(&run);
        }
    }
}

/* Nodes of a link that is closed or barred share the forces of their two elements; those of an open
 * one feel their own element's, less the traction. Stresses S and 3 S of elements a and b push both
 * nodes by (3 S t_b - S t_a)/2, to round-off of the strain, 1e-16/1e-3 at the elements' length. */
static void closed_links_share_their_elements_forces(void **unused)
{
    const double stress = 50e6;
    enum { N = 40, LINK = 39 }; /* between the last element and the first */
    for (int state = RING_LINK_CLOSED; state <= RING_LINK_BARRED; state++) {
        const fracas_spec spec = at_rest(N);
        one_run run = begin(&spec, 300e6);
        set_stress(&run, LINK, stress);
        set_stress(&run, LINK + 1, 3 * stress);
        *link_of(&run, LINK) = state;
        if (state == RING_LINK_OPEN)
            *at(&run, LINK,
                RING_DAMAGE) = 1; /* broken: what carries no traction carries none here */
        /* the jump that set_stress made is closed, by moving element b as a whole: contact would
         * push */
        for (int i = 0; i < 2; i++) {
            const double jump = *at(&run, LINK + 1, RING_U_LEFT + i) -
                                *at(&run, LINK, RING_U_RIGHT + i);
            *at(&run, LINK + 1, RING_U_LEFT + i) -= jump;
            *at(&run, LINK + 1, RING_U_RIGHT + i) -= jump;
        }
        step_run(&run);
        double a[2], b[2];
        chord_of(&run, LINK, a);
        chord_of(&run, LINK + 1, b);
        const double scale = 0.5 * run.batch->step.next[0] / (0.5 * DENSITY * run.h);
        for (int i = 0; i < 2; i++) {
            const double common = 0.5 * (3 * stress * b[i] - stress * a[i]);
            const double left = state == RING_LINK_OPEN ? -stress * a[i] : common;
            const double right = state == RING_LINK_OPEN ? 3 * stress * b[i] : common;
            assert_true(fabs(*at(&run, LINK, RING_V_RIGHT + i) - scale * left) <
                        1e-11 * scale * stress);
            assert_true(fabs(*at(&run, LINK + 1, RING_V_LEFT + i) - scale * right) <
                        1e-11 * scale * stress);
            if (state != RING_LINK_OPEN)
                assert_true(*at(&run, LINK, RING_V_RIGHT + i) ==
                            *at(&run, LINK + 1, RING_V_LEFT + i));
        }
        clear_run(&run);
    }
}

/* What the first step says of the next, k for base xi^k; xi = 0.3 makes powers that differ. Element
 * stresses around `link` are given as multiples of 100 MPa, from that of element link - 1 to that
 * of link + 2. */
typedef struct {
    const char *what;
    double stress[4];
    ring_link_state state;
    double damage, q; /* in delta_c */
    double strength;  /* of the link, in 100 MPa; others have 30 */
    int zones;
} step_case;

/* For sigma_c = 300 MPa: E/h q = sigma_c (1 - q/delta_c) at q/delta_c = 1/(1 + E delta_c/(h
 * sigma_c)); h = 1.25 mm: 0.67164... */
#define CROSSING (1 / (1 + YOUNG * (200 / 300e6) / (RING_CIRCUMFERENCE / 40 * 300e6)))

static const step_case step_cases[] = {
    {"nothing", {1, 1, 1, 1}, RING_LINK_CLOSED, 0, 0, 3, 0},
    {"a closed link near its strength", {1, 2.9, 2.9, 1}, RING_LINK_CLOSED, 0, 0, 3, 1},
    {"its elements on average", {1, 2.6, 3.2, 1}, RING_LINK_CLOSED, 0, 0, 3, 1},
    {"one element near it, not on average", {1, 2.6, 2.9, 1}, RING_LINK_CLOSED, 0, 0, 3, 0},
    {"a barred link near its strength", {1, 2.9, 2.9, 1}, RING_LINK_BARRED, 0, 0, 3, 0},
    {"a barred link beyond its strength", {1, 4, 4, 1}, RING_LINK_BARRED, 0, 0, 3, 0},
    {"an open link, its elements near its strength", {1, 2.9, 2.9, 1}, RING_LINK_OPEN, 1, 2, 3, 0},
    {"just open", {0, 0, 0, 0}, RING_LINK_OPEN, 0, 0, 3, 1}, /* q = 0 to the last bit */
    {"opening", {1, 1, 1, 1}, RING_LINK_OPEN, 0, 1e-9, 3, 1},
    {"closing", {1, 1, 1, 1}, RING_LINK_OPEN, 0, -1e-9, 3, 1},
    {"softening, steep", {1, 1, 1, 1}, RING_LINK_OPEN, 0.5 * CROSSING, CROSSING *(1 - 1e-9), 3, 1},
    {"softening, less so",
     {1, 1, 1, 1},
     RING_LINK_OPEN,
     0.5 * CROSSING,
     CROSSING *(1 + 1e-9),
     3,
     0},
    {"unloading, steep", {1, 1, 1, 1}, RING_LINK_OPEN, 0.1, 0.05, 3, 0},
    {"broken, apart", {1, 1, 1, 1}, RING_LINK_OPEN, 1, 1.2, 3, 0},
    {"closed and compressed", {1, 0.5, -0.6, 1}, RING_LINK_CLOSED, 0, 0, 3, 1},
    {"one element compressed, not on average", {1, 0.6, -0.5, 1}, RING_LINK_CLOSED, 0, 0, 3, 0},
    {"barred and compressed", {1, 0.5, -0.6, 1}, RING_LINK_BARRED, 0, 0, 3, 1},
    {"open, its elements compressed", {3, -1, -1, 3}, RING_LINK_OPEN, 1, 1.2, 3, 0},
    {"contact, its elements in tension", {1, 1, 1, 1}, RING_LINK_OPEN, 0.5, -0.01, 3, 1},
    {"contact of a broken link", {1, 1, 1, 1}, RING_LINK_OPEN, 1, -0.01, 3, 1},
    {"contact of a link that has never opened", {1, 1, 1, 1}, RING_LINK_OPEN, 0, -0.01, 3, 1},
    {"opening, the next one compressed", {1, 1, 1, -1.5}, RING_LINK_OPEN, 0, 1e-9, 3, 2},
    {"near its strength, the next one compressed", {1, 3, 2.9, -3}, RING_LINK_CLOSED, 0, 0, 3, 2},
};

static void critical_zones_refine_the_time_step(void **unused)
{
    enum { N = 40, LINK = 17 };
    const double xi = 0.3, delta_c = 200 / 300e6;
    for (int around = 0; around < 2; around++)
        for (size_t i = 0; i < FRACAS_COUNT(step_cases); i++) {
            const step_case *it = &step_cases[i];
            const size_t link = around ? N - 1 : LINK;
            fracas_spec spec = at_rest(N);
            spec.cohesive.own[REFINEMENT] = xi;
            one_run run = make(&spec, 3e9);
            bar_set_strength(run.batch, 0, link, 1e8 * it->strength);
            OK(fracas_batch_begin(run.batch));
            for (size_t e = 0; e < N; e++) {
                const size_t place = (e + N + 1 - link) % N; /* 0 .. 3 about the link */
                set_stress(&run, e, 1e8 * (place < 4 ? it->stress[place] : 1));
            }
            *link_of(&run, link) = it->state;
            *at(&run, link, RING_DAMAGE) = it->damage;
            /* undo the jump of the strained elements, then put the one wanted: element link + 1 is
             * moved as it is */
            double n[2], jump = 0;
            normal_of(&run, link, n);
            for (int c = 0; c < 2; c++)
                jump += n[c] *
                        (*at(&run, link + 1, RING_U_LEFT + c) - *at(&run, link, RING_U_RIGHT + c));
            set_jump(&run, link, it->q * delta_c - jump);
            step_run(&run);
            double expected = run.model->time_step;
            for (int k = 0; k < it->zones; k++) expected *= xi;
            if (run.batch->step.next[0] != expected)
                fail_msg("%s: next step is %g of the base, xi^%d expected", it->what,
                         run.batch->step.next[0] / run.model->time_step, it->zones);
            clear_run(&run);
        }
}

/* One step of a ring whose elements all have this stress, but for the last bits; link 5 has this
 * strength. */
static one_run stressed(double stress, double strength)
{
    const fracas_spec spec = at_rest(40);
    one_run run = make(&spec, 3e9);
    bar_set_strength(run.batch, 0, 5, strength);
    OK(fracas_batch_begin(run.batch));
    expand(&run, stress);
    step_run(&run);
    return run;
}

/* A link is in the first zone at 0.95 sigma_c, and opens at sigma_c, both included: to the last
 * bit. */
static void the_edges_of_the_first_zone_and_of_opening(void **unused)
{
    one_run run = stressed(200e6, 1e9);
    const double pull = pull_of(&run, 5);
    assert_true(fabs(pull / (200e6 * cos(3.14159265358979323846 / 40)) - 1) < 1e-11);
    clear_run(&run);
    double edge = pull / 0.95;
    while (0.95 * edge > pull) edge = nextafter(edge, 0);
    while (0.95 * edge < pull) edge = nextafter(edge, INFINITY);
    assert_true(0.95 * edge == pull);
    double above = edge;
    while (0.95 * above <= pull) above = nextafter(above, INFINITY);
    const struct {
        double strength;
        int refined, opened;
    } cases[] = {{edge, 1, 0}, {above, 0, 0}, {pull, 1, 1}, {nextafter(pull, INFINITY), 1, 0}};
    for (size_t i = 0; i < FRACAS_COUNT(cases); i++) {
        run = stressed(200e6, cases[i].strength);
        assert_true(pull_of(&run, 5) == pull);
        assert_true(run.batch->step.next[0] ==
                    run.model->time_step * (cases[i].refined ? 0.25 : 1));
        assert_int_equal(*link_of(&run, 5) == RING_LINK_OPEN, cases[i].opened);
        assert_int_equal(run.batch->step.cracked[0], cases[i].opened);
        clear_run(&run);
    }
}

/* Elements at an angle pull a link apart with S cos(pi/n), the n-part of the mean of their forces
 * (the paper's (12)), which is what the traction sigma_c then holds against: a link whose strength
 * is between that and S would be pulled together as it opens, lose all its traction to contact, and
 * be torn open by that. */
static void a_link_opens_by_the_pull_along_its_normal(void **unused)
{
    const double part = cos(3.14159265358979323846 / 40);
    for (int opens = 0; opens < 2; opens++) {
        one_run run = stressed(200e6, 200e6 * (opens ? part * (1 - 1e-6) : 0.5 * (1 + part)));
        assert_int_equal(run.batch->step.cracked[0], opens);
        if (opens) {
            /* dt^2/2 times the difference of accelerations, 1e-6 of S either side; displacements of
             * 6e-6 m are good to 1e-21 m of 7e-14 */
            const double dt = run.batch->step.next[0],
                         q = 0.5 * dt * dt * 2e-6 * 200e6 * part / (0.5 * DENSITY * run.h);
            step_run(&run);
            assert_true(fabs(*at(&run, 5, RING_DAMAGE) * 200 / (200e6 * part) / q - 1) < 1e-3);
        }
        clear_run(&run);
    }
}

/* The base is 0.8 h/c for an even number of elements; an odd one cannot swing up and down in turn:
 * h/(c cos(pi/(2 n))). The iteration starts in the even ring's mode: measured, up to 1e-9 above.
 * Rings of more than 1024 elements take the step of 1024. */
static void the_base_step_is_the_papers(void **unused)
{
    const int64_t sizes[] = {40, 41, 401, 1000, 1250, 5000};
    for (size_t i = 0; i < FRACAS_COUNT(sizes); i++) {
        const fracas_spec spec = at_rest(sizes[i]);
        OWN(fracas_model) model;
        OK(fracas_model_create(&spec, &model));
        const double paper = 0.8 * RING_CIRCUMFERENCE / (double)sizes[i] / BAR_WAVE_SPEED;
        const double odd = sizes[i] % 2 ? cos(0.5 * 3.14159265358979323846 / (double)sizes[i]) : 1;
        print_message("[  figures ] %5ld elements: time step %.2e beyond 0.8 h/c\n", (long)sizes[i],
                      model->time_step / paper - 1);
        assert_true(fabs(model->time_step * odd / paper - 1) < (sizes[i] % 2 ? 1e-7 : 1e-9));
    }
}

/* ---- order of opening, fracture-limiting zone ---- */

/* A ring of equal stresses S of 200 MPa but for the last bits, and n links whose strengths make
 * (sigma/sigma_c) what it should be: a division by a power of two is exact, so that equal ones are
 * equal bit by bit. Others hold 3 GPa. */
typedef struct {
    size_t link;
    double ratio;
} candidate;

static one_run qualify(int64_t n, double zone, const candidate *candidates, size_t count)
{
    fracas_spec spec = at_rest(n);
    spec.cohesive.own[ZONE] = zone;
    for (int again = 0;; again++) {
        one_run run = begin(&spec, 3e9);
        for (size_t e = 0; e < run.n; e++) set_stress(&run, e, 200e6);
        for (size_t i = 0; again && i < count; i++)
            bar_set_strength(run.batch, 0, candidates[i].link, candidates[i].ratio);
        step_run(&run);
        if (again) return run;
        /* the second run takes strengths from the first one's stresses; C has no arrays of variable
         * length to return */
        static candidate found[8];
        for (size_t i = 0; i < count; i++)
            found[i] = (candidate){candidates[i].link,
                                   pull_of(&run, candidates[i].link) / candidates[i].ratio};
        candidates = found;
        clear_run(&run);
    }
}

/* Every link is open where listed, barred within `reach` of one that is open, closed elsewhere. */
static void assert_links(const one_run *run, size_t reach, const size_t *open, size_t count)
{
    for (size_t e = 0; e < run->n; e++) {
        ring_link_state expected = RING_LINK_CLOSED;
        for (size_t i = 0; i < count; i++) {
            const size_t ahead = (e + run->n - open[i]) % run->n,
                         away = ahead < run->n - ahead ? ahead : run->n - ahead;
            if (away == 0) expected = RING_LINK_OPEN;
            else if (away <= reach && expected == RING_LINK_CLOSED) expected = RING_LINK_BARRED;
        }
        if (*link_of(run, e) != expected)
            fail_msg("link %zu of %zu, zone of %zu elements: state %g, %d expected", e, run->n,
                     reach, *link_of(run, e), (int)expected);
    }
    assert_int_equal(run->batch->step.cracked[0], count);
}

static void links_open_by_stress_over_strength(void **unused)
{
    enum { N = 60, K = 4 };
    const double zone = K * RING_CIRCUMFERENCE / N;
    const struct {
        candidate candidates[5];
        size_t ncandidates, open[5], nopen;
    } cases[] = {
        {{{10, 2}, {14, 4}},
         2,
         {14},
         1}, /* the larger one bars the other, which is first in line */
        {{{10, 4}, {14, 2}}, 2, {10}, 1},
        {{{10, 2}, {14, 2}}, 2, {10}, 1},              /* equal: the lowest */
        {{{10, 2}, {15, 4}}, 2, {10, 15}, 2},          /* not within the zone of each other */
        {{{10, 2}, {14, 4}, {18, 8}}, 3, {10, 18}, 2}, /* 18 bars 14, which then bars nobody */
        {{{10, 2}, {13, 2}, {16, 2}, {19, 2}}, 4, {10, 16}, 2}, /* equal: 10 bars 13, 16 bars 19 */
        {{{10, 2}, {11, 1}, {12, 1.5}}, 3, {10}, 1},
        {{{59, 2}, {3, 4}}, 2, {3}, 1},                      /* around the end: 4 away */
        {{{59, 2}, {4, 4}}, 2, {59, 4}, 2},                  /* 5 away */
        {{{59, 2}, {3, 2}}, 2, {3}, 1},                      /* equal: 3 is the lowest */
        {{{56, 2}, {0, 2}, {1, 4}, {57, 1}}, 4, {1, 56}, 2}, /* 1 bars 0 and 57, not 56 */
    };
    for (size_t i = 0; i < FRACAS_COUNT(cases); i++) {
        one_run run = qualify(N, zone, cases[i].candidates, cases[i].ncandidates);
        assert_links(&run, K, cases[i].open, cases[i].nopen);
        clear_run(&run);
        /* without a zone all of them open */
        size_t all[5];
        for (size_t c = 0; c < cases[i].ncandidates; c++) all[c] = cases[i].candidates[c].link;
        run = qualify(N, 0, cases[i].candidates, cases[i].ncandidates);
        assert_links(&run, 0, all, cases[i].ncandidates);
        clear_run(&run);
    }
}

/* A zone of k elements bars links k away and none k + 1 away, whatever k h/h is in floating point:
 * rounded below k for some of these. A zone of half the ring or more bars every other link once, a
 * hair less than k elements bars k - 1. */
static void a_zone_is_as_long_as_it_says(void **unused)
{
    int below = 0;
    for (int64_t n = 3; n <= 120; n += n < 12 ? 1 : 27)
        for (size_t k = 1; k < (size_t)n + 2; k += k < 8 ? 1 : 5) {
            const double h = 2 * 3.14159265358979323846 * RING_RADIUS / (double)n,
                         length = RING_CIRCUMFERENCE / (double)n * (double)k;
            const size_t link[2] = {0, (size_t)n - 1};
            below += length / h < (double)k;
            for (int end = 0; end < 2; end++) {
                one_run run = qualify(n, length, &(candidate){link[end], 2}, 1);
                assert_links(&run, k, &link[end], 1);
                clear_run(&run);
            }
            if (k == 1) { /* a zone shorter than an element is refused */
                fracas_spec spec = at_rest(n);
                fracas_model *model;
                spec.cohesive.own[ZONE] = length * (1 - 1e-9);
                assert_int_equal(fracas_model_create(&spec, &model), FRACAS_USAGE);
                continue;
            }
            one_run run = qualify(n, length * (1 - 1e-9), &(candidate){link[1], 2}, 1);
            assert_links(&run, k - 1, &link[1], 1);
            clear_run(&run);
        }
    print_message("[  figures ] %d zones of k elements are less than k h by rounding\n", below);
    assert_true(below > 0);
    for (int i = 0; i < 3; i++) { /* far longer than the ring */
        one_run run = qualify(30 + i, (double[]){1, 1e9, 1e300}[i], &(candidate){4, 2}, 1);
        assert_links(&run, 40, (size_t[]){4}, 1);
        clear_run(&run);
    }
}

/* A link that is barred does not open later either. */
static void barred_links_stay_barred(void **unused)
{
    fracas_spec spec = at_rest(40);
    one_run run = begin(&spec, 100e6);
    for (size_t e = 0; e < run.n; e++) {
        set_stress(&run, e, 200e6);
        *link_of(&run, e) = RING_LINK_BARRED;
    }
    step_run(&run);
    assert_int_equal(run.batch->step.cracked[0], 0);
    for (size_t e = 0; e < run.n; e++) assert_true(*link_of(&run, e) == RING_LINK_BARRED);
    assert_true(run.batch->step.next[0] == run.model->time_step);
    clear_run(&run);
}

/* ---- bulk damage ---- */

/* Elements suffer damage from when both their links are barred, whichever opening barred the second
 * one: zones that meet from either side, around the end of the ring, and of one opening alone. */
static void elements_between_barred_links_are_watched(void **unused)
{
    enum { N = 60, K = 4 };
    const double zone = K * RING_CIRCUMFERENCE / N;
    /* opened in this order, by their ratios; -1: none */
    const int cases[][2] = {{20, -1}, {20, 29}, {29, 20}, {20, 28}, {28, 20}, {20, 30},
                            {30, 20}, {58, 7},  {7, 58},  {3, 54},  {54, 3},  {0, 9},
                            {9, 0},   {59, 50}, {50, 59}, {59, 8},  {8, 59}};
    for (size_t i = 0; i < FRACAS_COUNT(cases); i++) {
        const candidate both[2] = {{(size_t)cases[i][0], 4},
                                   {(size_t)(cases[i][1] < 0 ? 0 : cases[i][1]), 2}};
        const size_t open[2] = {both[0].link, both[1].link}, count = cases[i][1] < 0 ? 1 : 2;
        one_run run = qualify(N, zone, both, count);
        assert_links(&run, K, open, count);
        for (size_t e = 0; e < N; e++) {
            const bool expected = *link_of(&run, e) == RING_LINK_BARRED &&
                                  *link_of(&run, e + N - 1) == RING_LINK_BARRED;
            const double largest = *at(&run, e, RING_STRAIN);
            if (expected ? fabs(largest * YOUNG / 200e6 - 1) > 1e-11 : largest != -1)
                fail_msg("links %d, then %d open: element %zu, %s barred links, has eps_d %g",
                         cases[i][0], cases[i][1], e, expected ? "between two" : "not between two",
                         largest);
        }
        clear_run(&run);
    }
}

typedef struct {
    double strain, largest; /* of the element, in eps_y; eps_d before the step, in eps_y */
    double stress, after;   /* in sigma_y; eps_d after it */
} damage_point;

/* Element 12 of a ring at rest lies between barred links of 280 and 320 MPa, so that it yields at
 * 300. Strain is good to 1e-13 (of 1e-3, at the length of an element). Dissipated is A h sigma_y
 * (eps_d - eps_y)/2 = A h sigma_y^2/(2 E) D/(1 - D). */
static void the_bulk_law_at_prescribed_strains(void **unused)
{
    enum { N = 40, AT = 12 };
    const double yield = 300e6, eps_y = yield / YOUNG;
    const damage_point points[] = {{0.5, 0, 0.5, 0.5},   {1, 0.5, 1, 1},
                                   {0.5, 0.9, 0.5, 0.9}, /* not damaged */
                                   {1.5, 0, 1, 1.5},     {2, 1.5, 1, 2},
                                   {1.5, 1.5, 1, 1.5}, /* yields */
                                   {1.5, 2, 0.75, 2},    {0.5, 2, 0.25, 2},
                                   {1.99, 2, 0.995, 2}, /* unloads, with E (1 - D) = E/2 */
                                   {0.5, 4, 0.125, 4},   {0, 2, 0, 2},
                                   {-0.5, 2, -0.5, 2},   {-0.5, 0, -0.5, 0},
                                   {-3, 1.5, -3, 1.5},  /* compression, with E */
                                   {1.5, -1, 1.5, -1}}; /* never barred: E */
    for (size_t i = 0; i < FRACAS_COUNT(points); i++) {
        const damage_point *p = &points[i];
        fracas_spec spec = at_rest(N);
        spec.cohesive.own[ZONE] = 1.3e-3;
        one_run run = make(&spec, 1e9);
        bar_set_strength(run.batch, 0, AT - 1, 280e6);
        bar_set_strength(run.batch, 0, AT, 320e6);
        OK(fracas_batch_begin(run.batch));
        *link_of(&run, AT - 1) = *link_of(&run, AT) = RING_LINK_BARRED;
        *at(&run, AT, RING_STRAIN) = p->largest < 0 ? -1 : p->largest * eps_y;
        set_stress(&run, AT, p->strain * yield);
        step_run(&run);
        const fracas_ledger *ledger = &run.batch->lane[0].ledger;
        const double unit = spec.geometry.area * run.h * yield * eps_y,
                     d = 1 - 1 / fmax(1, p->after);
        assert_true(fabs(*at(&run, AT, RING_STRESS) / yield - p->stress) < 1e-11);
        assert_true(p->largest < 0 ? *at(&run, AT, RING_STRAIN) == -1
                                   : fabs(*at(&run, AT, RING_STRAIN) / eps_y - p->after) < 1e-11);
        assert_true(fabs(ledger->elastic / unit - 0.5 * p->stress * p->strain) < 1e-10);
        assert_true(fabs(ledger->dissipated / unit - 0.5 * d / (1 - d)) < 1e-11);
        /* its links feel it: each of their nodes half of its stress */
        const double scale = 0.5 * run.batch->step.next[0] / (0.5 * DENSITY * run.h);
        double t[2];
        chord_of(&run, AT, t);
        const double pushed = *at(&run, AT, RING_V_LEFT) * t[0] +
                              *at(&run, AT, RING_V_LEFT + 1) * t[1];
        assert_true(fabs(pushed / (0.5 * scale * yield) - p->stress) < 1e-10);
        clear_run(&run);
    }
}

/* An element that is barred beyond its yield falls back on it, eps_y = 250 MPa/E from `stress`:
 * what it loses is created, negative, and all energies together are what they were without the
 * zone. Its links are closed as long as their other elements pull them less. */
static void what_is_barred_beyond_its_yield_is_booked(void **unused)
{
    enum { N = 40, WEAK = 10, AT = 13 };
    const double stress = 300e6, yield = 250e6;
    double held[2], created[2];
    for (int zone = 0; zone < 2; zone++) {
        fracas_spec spec = at_rest(N);
        spec.cohesive.own[ZONE] = zone * 5 * RING_CIRCUMFERENCE / N;
        one_run run = make(&spec, yield);
        bar_set_strength(run.batch, 0, WEAK, 90e6);
        OK(fracas_batch_begin(run.batch));
        for (size_t e = 0; e < N; e++) set_stress(&run, e, e == AT ? stress : 100e6);
        step_run(&run);
        assert_links(&run, zone * 5, (size_t[]){WEAK}, 1);
        const fracas_step *s = &run.batch->step;
        held[zone] = s->elastic[0] + s->dissipated[0] + s->cohesive[0];
        created[zone] = s->created[0];
        if (zone)
            assert_true(fabs(s->dissipated[0] / (0.5 * spec.geometry.area * run.h * yield *
                                                 (stress - yield) / YOUNG) -
                             1) < 1e-10);
        clear_run(&run);
    }
    const double beyond = (stress - yield) / YOUNG,
                 exact = -0.5 * YOUNG * beyond * beyond * 1e-6 * RING_CIRCUMFERENCE / N;
    assert_true(created[0] == 0);
    assert_true(fabs(created[1] / exact - 1) < 1e-10);
    assert_true(fabs((held[1] - held[0]) / exact - 1) <
                1e-10); /* 1e-13 of each of 40 elements' energy, which is 1 to 8 times this */
}

/* A link opens at the time when its stress passed its strength, whichever way its elements have
 * turned. A ring of 190 MPa that expands by 20 MPa a time step swings as 190 cos(w t) + 20 sin(w
 * t)/(w dt), w = c/R_n: 203 MPa after 0.65 dt, but for the force inward, and for the 203/cos(pi/n)
 * it takes to pull with 203 along a link's normal. Within the step the time is taken as linear in
 * the stress, which is off by 190 (w dt)^2/8 MPa at most: 1.9e-4 dt. */
static void the_onset_is_within_the_step(void **unused)
{
    enum { N = 400 };
    const double pi = 3.14159265358979323846, h = RING_CIRCUMFERENCE / N,
                 radius = h / (2 * sin(pi / N)), w = BAR_WAVE_SPEED / radius;
    const double dt = 0.8 * h / BAR_WAVE_SPEED, rate = 20e6 / YOUNG / dt;
    double exact = 0.65 * dt;
    for (int i = 0; i < 20; i++)
        exact += (203 / cos(pi / N) - 190 * cos(w * exact) - 20 * sin(w * exact) / (w * dt)) /
                 (20 / dt);
    for (int turn = 0; turn < 6; turn++) {
        const double angle = turn * pi / 3, c = cos(angle), s = sin(angle);
        const fracas_spec spec = at_rest(N);
        one_run run = begin(&spec, 203e6);
        for (size_t e = 0; e < N; e++)
            for (size_t side = 0; side < 2; side++) {
                const double theta = 2 * pi * (double)((e + side) % N) / N,
                             from[2] = {radius * cos(theta), radius * sin(theta)};
                const double to[2] = {c * from[0] - s * from[1], s * from[0] + c * from[1]};
                for (int i = 0; i < 2; i++) {
                    *at(&run, e, (side ? RING_U_RIGHT : RING_U_LEFT) + i) =
                        (1 + 190e6 / YOUNG) * to[i] - from[i];
                    *at(&run, e, (side ? RING_V_RIGHT : RING_V_LEFT) + i) = rate * to[i];
                }
            }
        while (!run.batch->step.cracked[0]) step_run(&run);
        if (fabs(run.batch->step.first_onset[0] - exact) > 2e-4 * dt)
            fail_msg("turned by %.3f: onset after %.6f of a time step, exact %.6f", angle,
                     run.batch->step.first_onset[0] / dt, exact / dt);
        clear_run(&run);
    }
}

TESTS(the_law_at_prescribed_openings, closed_links_share_their_elements_forces,
      critical_zones_refine_the_time_step, the_edges_of_the_first_zone_and_of_opening,
      a_link_opens_by_the_pull_along_its_normal, the_base_step_is_the_papers,
      links_open_by_stress_over_strength, a_zone_is_as_long_as_it_says, barred_links_stay_barred,
      elements_between_barred_links_are_watched, the_bulk_law_at_prescribed_strains,
      what_is_barred_beyond_its_yield_is_booked, the_onset_is_within_the_step)
