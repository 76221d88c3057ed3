/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The bar on elements of different lengths: lengths, waves, events, fragments. */
#include "tests/support/bar_state.h"
#include "tests/support/test.h"

/* ---- lengths ---- */

/* h_e of a progression is L ratio^(e/(n-1)) over the sum: ten roundings of the exponent (e ln
 * ratio/(n-1), 7 at most) and of exp, and one of each addition: (16 + n) 2^-53. */
static void lengths_of_a_graded_mesh_are_a_progression(void **unused)
{
    const double ratios[] = {1e-3, 0.5, 1, 100, 1e3};
    const size_t counts[] = {2, 17, MOST};
    for (int r = 0; r < 5; r++)
        for (int c = 0; c < 3; c++) {
            const size_t n = counts[c];
            fracas_spec spec = bar_reference((int64_t)n, 1e4, 1e-6);
            bar_grade(&spec, ratios[r]);
            OWN(fracas_model) model = make_model(&spec);
            long double total = 0, sum = 0;
            for (size_t e = 0; e < n; e++)
                total += powl((long double)ratios[r], (long double)e / (long double)(n - 1));
            for (size_t e = 0; e < n; e++) {
                long double exact =
                    0.05L * powl((long double)ratios[r], (long double)e / (long double)(n - 1)) /
                    total;
                assert_true(fabsl(model->sizes[e] / exact - 1) < (16 + (long double)n) * 0x1p-53L);
                sum += model->sizes[e];
            }
            assert_true(fabsl(sum / 0.05L - 1) < (16 + (long double)n) * 0x1p-53L);
            assert_true(model->longest == fmax(model->sizes[0], model->sizes[n - 1]));
        }
}

/* Node i is at i L/n + amplitude (L/n) z_i, both ends where they were: lengths are a difference of
 * three numbers of the size of L/n, 4 roundings each. Without numbers there is no mesh. */
static void nodes_of_a_perturbed_mesh_are_moved_by_their_numbers(void **unused)
{
    enum { N = 500 };
    const double h = 0.05 / N, amplitudes[] = {1e-3, 0.2, 0.45};
    for (int a = 0; a < 3; a++) {
        double noise[N + 1];
        fracas_spec spec = bar_reference(N, 1e4, 1e-6);
        bar_perturb(&spec, amplitudes[a], (uint64_t)a, noise);
        fracas_model *model = make_model(&spec);
        long double node = 0;
        double longest = 0;
        for (size_t e = 0; e < N; e++) {
            const double *size = model->sizes;
            assert_true(size[e] >= h * (1 - 2 * amplitudes[a]) &&
                        size[e] <= h * (1 + 2 * amplitudes[a]));
            longest = fmax(longest, size[e]);
            node += size[e];
            const double move = e + 1 < N ? amplitudes[a] * noise[e + 1] : 0;
            assert_true(fabsl(node - (long double)h * ((long double)e + 1 + move)) <
                        4 * (long double)h * 0x1p-53L * (e + 1));
        }
        assert_true(model->longest == longest && longest > h * (1 + amplitudes[a]));
        fracas_model_destroy(model);
        spec.mesh.noise = NULL;
        assert_int_equal(fracas_model_create(&spec, &model), FRACAS_BUG);
    }
}

/* The longest element decides what strength a mesh bears: K delta_c > sigma_c with the K of two of
 * them, (cohesive.7), or the contact penalty (cohesive.9) below their stiffness. The lengths of the
 * formulas are exact to 1e-12. */
static void the_longest_element_bounds_the_strength(void **unused)
{
    for (int i = 0; i < BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(200, 1e4, 1);
        spec.geometry.length = 0.01;
        set_listed_law(&spec, i);
        OWN(fracas_model) model = model_on(&spec, i / BAR_LAWS);
        double longest = 0;
        for (size_t e = 0; e < 200; e++) longest = fmax(longest, model->sizes[e]);
        const double offset = 4.5 * pow(1e4, 2.0 / 3) * 275e9 * pow(100, 2.0 / 3) *
                              pow(2750, 1.0 / 3);
        const fracas_law *law = fracas_law_of(&spec);
        if (!law->flux && !law->contact_by_strength) continue;
        const double most = law->flux ? sqrt(2 * 4 * 275e9 * 100 / longest /
                                             fracas_law_steepest(&spec.cohesive))
                                      : sqrt(4.5 * 100 * 275e9 / longest - offset);
        OK(fracas_model_check_strength(model, most * (1 - 1e-12)));
        assert_int_equal(fracas_model_check_strength(model, most * (1 + 1e-12)), FRACAS_USAGE);
    }
}

static fracas_record run_to_fragments(fracas_spec *spec, double time_step)
{
    OWN(fracas_model) model = make_model(spec);
    fracas_record record;
    assert_true(fabs(model->time_step / time_step - 1) <
                1e-6); /* iterations end at 1e-9 a step, of 12 */
    model->time_step = time_step;
    run_replicas(model, 5, 1, 0.1, (fracas_batch_options){.isa = FRACAS_ISA_BEST}, &record);
    return record;
}

/* Lengths that are alike to 1e-14 fragment as one length does: with a law in series with the flux
 * all is continuous, and 1e-14 has grown to 1e-12 when all is broken; 1e-10 is the bound. A rigid
 * link is not: the traction of an open link jumps at q = 0, so that roundings decide (strengths
 * that differ by 1e-14 on one uniform mesh change energies by 1e-3 too). Its counts are the same,
 * its energies within 1e-2; on a progression of ratio 1, whose lengths are those of the uniform
 * mesh, it is held to 1e-10 as well. */
static void nearly_equal_lengths_give_the_uniform_run(void **unused)
{
    double noise[501];
    for (int i = 0; i < 2 * BAR_LAWS; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(500, 1e5, 2e-7);
        spec.geometry.length = 5e-3;
        set_listed_law(&spec, i);
        OWN(fracas_model) model = make_model(&spec);
        const double time_step = model->time_step;
        FRACAS_CLEARED(fracas_record) uniform = run_to_fragments(&spec, time_step);
        if (i / BAR_LAWS) bar_perturb(&spec, 1e-14, 1, noise);
        else bar_grade(&spec, 1);
        FRACAS_CLEARED(fracas_record) varied = run_to_fragments(&spec, time_step);
        assert_int_equal(varied.cracked, uniform.cracked);
        assert_int_equal(varied.broken, uniform.broken);
        assert_int_equal(varied.fragments, uniform.fragments);
        assert_true(uniform.fragments > 10);
        const double total = uniform.kinetic + uniform.elastic + uniform.dissipated;
        const double differences[] = {
            varied.kinetic - uniform.kinetic,   varied.elastic - uniform.elastic,
            varied.cohesive - uniform.cohesive, varied.dissipated - uniform.dissipated,
            varied.created - uniform.created,   varied.work - uniform.work};
        double worst = 0;
        for (int d = 0; d < 6; d++) worst = fmax(worst, fabs(differences[d]) / total);
        print_message("[  figures ] %s %s: %lld fragments, energies differ by %.1e\n",
                      spec.cohesive.law->name, spec.mesh.spacing->name,
                      (long long)uniform.fragments, worst);
        assert_true(worst < (i / BAR_LAWS && !has_flux(&spec) ? 1e-2 : 1e-10));
    }
}

/* ---- consistency ---- */

/* Under imposed rate every element has the same stress, to the bit, and no interface a jump:
 * nothing moves before onset, and the first onset is when the background reaches the strength. */
static void a_uniform_stretch_moves_nothing(void **unused)
{
    const double onset = 300e6 / (275e9 * 1e4);
    for (int i = 0; i < 2 * BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(400, 1e4, 2 * onset);
        spec.geometry.length = 0.02;
        set_listed_law(&spec, i);
        spec.geometry.ends = ends[i / BAR_LAWS % 2];
        OWN(fracas_model) model = model_on(&spec, i / (2 * BAR_LAWS));
        OWN(fracas_batch) batch = begun_with(model, 300e6);
        RECORD(record);
        model->time_step = fmin(model->time_step, onset / 500);
        while (batch->step.cracked[0] == 0) {
            for (size_t e = 0; e < 400; e++)
                for (int f = BAR_W_LEFT; f <= BAR_V_RIGHT; f++)
                    assert_true(*field(batch, e, f) == 0.0);
            assert_true(batch->step.kinetic[0] == 0.0);
            step(batch, &record);
        }
        assert_int_equal(batch->step.cracked[0], model->interfaces);
        assert_true(fabs(batch->step.first_onset[0] / onset - 1) < 1e-12);
    }
}

/* w = strain x is the same stretch, this time made of nodes: strains of elements are then (x_right
 * - x_left)/h, one rounding of x (L at most) over h, so that forces are 2 E strain (L/h) 2^-53 at
 * most, twice that for N and T each, and the kick of a unit step by mass leaves rho h/2 times that.
 */
static void a_stretch_of_the_nodes_moves_no_inner_node(void **unused)
{
    const double strain = 5e-4, stress = 275e9 * strain;
    for (int i = 0; i < BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(400, 1e4, 1);
        spec.geometry.length = 0.02;
        set_listed_law(&spec, i);
        spec.geometry.ends = &fracas_ends_held;
        OWN(fracas_model) model = model_on(&spec, i / BAR_LAWS);
        OWN(fracas_batch) batch = begun_with(model, 300e6);
        double x = 0, least = 1;
        for (size_t e = 0; e < 400; e++) {
            *field(batch, e, BAR_W_LEFT) = strain * x;
            x += model->sizes[e];
            *field(batch, e, BAR_W_RIGHT) = strain * x;
            least = fmin(least, model->sizes[e]);
        }
        batch->step.time[0] = batch->step.drift[0] = 0;
        batch->step.kick[0] = 1;
        model->formulation->advance(model, &batch->step);
        double largest = 0;
        for (size_t e = 0; e < 400; e++)
            for (int f = BAR_V_LEFT; f <= BAR_V_RIGHT; f++)
                largest = fmax(largest, fabs(*field(batch, e, f)) * 0.5 * 2750 * model->sizes[e]);
        assert_true(largest < 8 * stress * 0.02 / least * 0x1p-53);
        assert_true(fabs(batch->step.elastic[0] / (0.5 * stress * strain * 0.02 * 1e-6) - 1) <
                    1e-9);
    }
}

/* ---- waves ---- */

/* A progression of one ratio over more elements is the same map of a finer mesh: the slope is 2
 * within 0.1. The numbers of a perturbed mesh are others on each, and move its error by some 10 %:
 * 0.3. */
static void waves_converge_with_order_two(void **unused)
{
    static const double bound[MESHES] = {0.1, 0.1, 0.3};
    for (int i = 0; i < BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(64, 1e-9, 1);
        spec.geometry.ends = &fracas_ends_held;
        set_listed_law(&spec, i);
        spec.time.safety = 0.9;
        check_waves(spec, i / BAR_LAWS, M_PI / 0.05, bound[i / BAR_LAWS]);
    }
}

/* ---- what a run leaves ---- */

/* Both sides of an uncracked rigid link have one displacement and one velocity, to the bit, until
 * it cracks. */
static void tied_nodes_stay_together(void **unused)
{
    for (int i = 0; i < 2 * MESHES; i++) {
        fracas_spec spec = bar_reference(300, 1e5, 1);
        spec.geometry.length = 6e-3;
        spec.cohesive.law = &fracas_law_rigid_link.kind;
        spec.geometry.ends = ends[i % 2];
        OWN(fracas_model) model = model_on(&spec, i / 2);
        OWN(fracas_batch) batch = begun_with(model, 300e6);
        bar_draw(batch, 0, 0.3, 1);
        RECORD(record);
        int moved = 0, closed = 0, open = 0;
        double momentum = 0, scale = 0;
        for (int s = 0; batch->step.broken[0] < 5; s++) {
            step(batch, &record);
            closed = open = 0;
            momentum = scale = 0;
            for (size_t e = 0; e < 300; e++) {
                const size_t next = (e + 1) % 300;
                const double *w = field(batch, e, BAR_W_RIGHT), *v = field(batch, e, BAR_V_RIGHT);
                for (int f = BAR_V_LEFT; f <= BAR_V_RIGHT; f++) {
                    momentum += model->sizes[e] * *field(batch, e, f);
                    scale += model->sizes[e] * fabs(*field(batch, e, f));
                }
                if (e >= model->interfaces || *field(batch, e, BAR_LAW) > 0) {
                    open += e < model->interfaces;
                    continue;
                }
                closed++;
                moved += *w != 0;
                assert_true(*field(batch, next, BAR_W_LEFT) == *w &&
                            *field(batch, next, BAR_V_LEFT) == *v);
            }
            /* a held end gives momentum; each step rounds each node's by 2^-53 a few times */
            if (i % 2 == 0) assert_true(fabs(momentum) <= scale * 4 * 0x1p-53 * (s + 300));
        }
        assert_true(moved > 1000 && closed > 50 && open > 10 && scale > 0);
    }
}

/* What reaches sigma_c at onset: m + K q in series with the flux, m of a link; at a break it is K
 * delta_c, or q reaches delta_c. */
static double crossing_of(fracas_batch *batch, size_t e, bool onset)
{
    const fracas_model *model = batch->model;
    const size_t next = (e + 1) % model->elements;
    const double left = 275e9 / model->sizes[e], right = 275e9 / model->sizes[next],
                 sigma_c = *field(batch, e, BAR_STRENGTH);
    const double delta_c = fracas_spec_critical_opening(&model->spec, sigma_c);
    const double q = *field(batch, next, BAR_W_LEFT) - *field(batch, e, BAR_W_RIGHT),
                 spring = 2 * (left + right);
    const double mean =
        275e9 * model->spec.loading.rate * batch->step.time[0] +
        0.5 * (left * (*field(batch, e, BAR_W_RIGHT) - *field(batch, e, BAR_W_LEFT)) +
               right * (*field(batch, next, BAR_W_RIGHT) - *field(batch, next, BAR_W_LEFT)));
    if (!has_flux(&model->spec)) return onset ? mean - sigma_c : q - delta_c;
    return mean + spring * q - (onset ? sigma_c : spring * delta_c);
}

/* It is linear in time within a step, so that the crossing is where a line through both ends of the
 * step has it: 1e-8 of the step, as roundings are 1e-16 of 3e8 Pa and of what it moves in a step,
 * 1e5 Pa and more. */
static void events_are_timed_inside_their_steps(void **unused)
{
    enum { N = 300 };
    for (int i = 0; i < BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(N, 1e5, 1);
        spec.geometry.length = 6e-3;
        set_listed_law(&spec, i);
        OWN(fracas_model) model = model_on(&spec, i / BAR_LAWS);
        OWN(fracas_batch) batch = lane_of(model, 0.1, 4, 0);
        OK(fracas_batch_begin(batch));
        RECORD(record);
        double before[2][N] = {{0}}, last = 0;
        bool seen[2][N] = {{false}};
        int count[2] = {0, 0};
        while (count[1] < 15) {
            step(batch, &record);
            for (size_t e = 0; e < N; e++)
                for (int k = 0; k < 2; k++) { /* onset, break */
                    const double now = crossing_of(batch, e, k == 0),
                                 at = (k ? batch->step.break_time : batch->step.onset_time)[e];
                    if (!seen[k][e] && !isnan(at)) {
                        const double time = batch->step.time[0], dt = time - last;
                        assert_true(fabs(at - (time - dt * now / (now - before[k][e]))) <
                                    1e-8 * dt);
                        seen[k][e] = true;
                        count[k]++;
                    }
                    before[k][e] = now;
                }
            last = batch->step.time[0];
        }
        assert_true(count[0] > 20);
    }
}

typedef struct {
    long double mass, size, position, velocity;
    int64_t elements;
} piece;

/* Element e of a bar taken `back` by this length [m], its left node at `x`, joins the piece. */
static void join(piece *p, fracas_batch *batch, size_t e, long double x, long double back)
{
    const long double h = batch->model->sizes[e], middle = x + h / 2 - back,
                      rate = batch->model->spec.loading.rate;
    const long double w =
        ((long double)*field(batch, e, BAR_W_LEFT) + *field(batch, e, BAR_W_RIGHT)) / 2;
    const long double v =
        ((long double)*field(batch, e, BAR_V_LEFT) + *field(batch, e, BAR_V_RIGHT)) / 2;
    p->elements++;
    p->size += h;
    p->mass += 2750 * 1e-6L * h;
    p->position += h * (middle * (1 + rate * batch->step.time[0]) + w);
    p->velocity += h * (rate * middle + v);
}

/* The pieces between broken interfaces, walked from the first element on; those after the last
 * break belong to the first. */
static size_t walk(fracas_batch *batch, piece *pieces)
{
    const fracas_model *model = batch->model;
    const bool ring = model->interfaces == model->elements;
    const long double length = model->spec.geometry.length;
    size_t last = model->elements, count = 1;
    while (ring && last > 0 && *field(batch, last - 1, BAR_DAMAGE) < 1) last--;
    long double x = 0;
    pieces[0] = (piece){0};
    for (size_t e = 0; e < model->elements; x += model->sizes[e], e++) {
        const bool wraps = e >= last;
        if (e > 0 && !wraps && *field(batch, e - 1, BAR_DAMAGE) >= 1) pieces[count++] = (piece){0};
        join(&pieces[wraps ? 0 : count - 1], batch, e, x, wraps ? length : 0);
    }
    for (size_t p = 0; p < count; p++) {
        pieces[p].position /= pieces[p].size;
        pieces[p].velocity /= pieces[p].size;
        if (!ring || pieces[p].position >= 0) continue;
        pieces[p].position += length *
                              (1 + model->spec.loading.rate * (long double)batch->step.time[0]);
        pieces[p].velocity += model->spec.loading.rate * length;
    }
    return count;
}

/* Each rounds once an element in each of its sums, 400 elements: 1e-13 of the body's mass, length,
 * and fastest end. */
static void fragments_are_sums_over_their_elements(void **unused)
{
    for (int i = 0; i < 2 * BAR_LAWS * MESHES; i += CASE_STRIDE) {
        fracas_spec spec = bar_reference(400, 1e5, 2e-7);
        spec.geometry.length = 8e-3;
        set_listed_law(&spec, i);
        spec.geometry.ends = ends[i / BAR_LAWS % 2];
        OWN(fracas_model) model = model_on(&spec, i / (2 * BAR_LAWS));
        OWN(fracas_batch) batch = begun_with(model, 300e6);
        bar_draw(batch, 0, 0.05, 2);
        RECORD(record);
        run_to_end(batch, &record);
        static piece pieces[401];
        assert_int_equal(record.nfragment, walk(batch, pieces));
        assert_true(record.nfragment > 5);
        double mass = 0, size = 0, momentum = 0, fastest = 1e5 * 8e-3;
        for (size_t f = 0; f < record.nfragment; f++) {
            const fracas_fragment *got = &record.fragment[f];
            assert_int_equal(got->elements, pieces[f].elements);
            assert_int_equal(got->dust, pieces[f].elements == 1);
            assert_true(fabsl(got->mass - pieces[f].mass) < 1e-13L * record.mass);
            assert_true(fabsl(got->size - pieces[f].size) < 1e-13L * 8e-3L);
            assert_true(fabsl(got->position[0] - pieces[f].position) < 1e-13L * 8e-3L);
            assert_true(fabsl(got->velocity[0] - pieces[f].velocity) < 1e-13L * fastest);
            mass += got->mass;
            size += got->size;
        }
        for (size_t e = 0; e < 400; e++)
            momentum += 0.5 * 2750e-6 * model->sizes[e] *
                        (*field(batch, e, BAR_V_LEFT) + *field(batch, e, BAR_V_RIGHT));
        assert_true(fabs(size / 8e-3 - 1) < 1e-13 && fabs(mass / record.mass - 1) < 1e-13);
        assert_true(fabs(record.mass / (2750e-6 * 8e-3) - 1) < 1e-15);
        assert_true(fabs(record.momentum[0] - momentum) < 1e-13 * fastest * record.mass);
        if (i / BAR_LAWS % 2 ==
            0) /* closed: none; leapfrog's v is that of sqrt(2 T/m) on average */
            assert_true(fabs(record.momentum[0]) <
                        sqrt(2 * record.kinetic * record.mass) * 1e-16 * (double)record.steps);
    }
}

TESTS(lengths_of_a_graded_mesh_are_a_progression,
      nodes_of_a_perturbed_mesh_are_moved_by_their_numbers, the_longest_element_bounds_the_strength,
      nearly_equal_lengths_give_the_uniform_run, a_uniform_stretch_moves_nothing,
      a_stretch_of_the_nodes_moves_no_inner_node, waves_converge_with_order_two,
      tied_nodes_stay_together, events_are_timed_inside_their_steps,
      fragments_are_sums_over_their_elements)
