/* The bar on elements of different lengths: lengths, waves, critical step, fragments, and no bias of what it counts. */
#include "tests/support/bar.h"

#include <gsl/gsl_eigen.h>
#include <math.h>
#include <stdlib.h>

enum { W_LEFT, W_RIGHT, V_LEFT, V_RIGHT, DAMAGE, STRENGTH, LAW, FIELDS }; /* as in engine/formulation/bar_sweep.h */
enum { MOST = 2000 };                                                     /* elements */

static const fracas_kind *const laws[] = {&fracas_law_nitsche, &fracas_law_rigid_link};
static const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held};

/* The meshes of most tests: graded either way, moved by the most that is allowed. */
enum { MESHES = 3 };
static void lay_mesh(fracas_spec *spec, int mesh, double *noise)
{
    if (mesh == 0) bar_grade(spec, 100);
    if (mesh == 1) bar_grade(spec, 0.01);
    if (mesh == 2) bar_perturb(spec, 0.45, 1, noise);
}

static fracas_model *model_on(fracas_spec *spec, int mesh)
{
    double noise[MOST + 1];
    fracas_model *model;
    lay_mesh(spec, mesh, noise);
    assert_ok(fracas_model_create(spec, &model));
    return model;
}

static fracas_batch *batch_of(const fracas_model *model, double sigma_c)
{
    fracas_batch *batch;
    const fracas_batch_options options = {.width = 1, .isa = FRACAS_ISA_BEST};
    assert_ok(fracas_batch_create(model, 1, &options, &batch));
    for (size_t i = 0; i < fracas_model_interfaces(model); i++) bar_set_strength(batch, 0, i, sigma_c);
    assert_ok(fracas_batch_begin(batch));
    return batch;
}

static double *field(fracas_batch *batch, size_t element, int which)
{
    return batch->step.state + element * FIELDS + (size_t)which;
}

static double random_number(uint64_t *state) /* in [-1/2, 1/2) */
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53 - 0.5;
}

static void step(fracas_batch *batch, fracas_record *record)
{
    size_t running;
    assert_ok(fracas_batch_step(batch, record, &running));
}

/* ---- lengths ---- */

/* h_e of a progression is L ratio^(e/(n-1)) over the sum: ten roundings of the exponent (e ln ratio/(n-1), 7 at most) and
 * of exp, and one of each addition: (16 + n) 2^-53. */
static void lengths_of_a_graded_mesh_are_a_progression(void **unused)
{
    (void)unused;
    const double ratios[] = {1e-3, 0.5, 1, 100, 1e3};
    const size_t counts[] = {2, 17, MOST};
    for (int r = 0; r < 5; r++)
        for (int c = 0; c < 3; c++) {
            const size_t n = counts[c];
            fracas_spec spec = bar_reference((int64_t)n, 1e4, 1e-6);
            bar_grade(&spec, ratios[r]);
            fracas_model *model;
            assert_ok(fracas_model_create(&spec, &model));
            long double total = 0, sum = 0;
            for (size_t e = 0; e < n; e++) total += powl((long double)ratios[r], (long double)e / (long double)(n - 1));
            for (size_t e = 0; e < n; e++) {
                long double exact = 0.05L * powl((long double)ratios[r], (long double)e / (long double)(n - 1)) / total;
                assert_true(fabsl(model->table[e] / exact - 1) < (16 + (long double)n) * 0x1p-53L);
                sum += model->table[e];
            }
            assert_true(fabsl(sum / 0.05L - 1) < (16 + (long double)n) * 0x1p-53L);
            assert_true(model->longest == fmax(model->table[0], model->table[n - 1]));
            fracas_model_destroy(model);
        }
}

/* Node i is at i L/n + amplitude (L/n) z_i, both ends where they were: lengths are a difference of three numbers of the size
 * of L/n, 4 roundings each. Without numbers there is no mesh. */
static void nodes_of_a_perturbed_mesh_are_moved_by_their_numbers(void **unused)
{
    (void)unused;
    enum { N = 500 };
    const double h = 0.05 / N, amplitudes[] = {1e-3, 0.2, 0.45};
    for (int a = 0; a < 3; a++) {
        double noise[N + 1];
        fracas_spec spec = bar_reference(N, 1e4, 1e-6);
        bar_perturb(&spec, amplitudes[a], (uint64_t)a, noise);
        fracas_model *model;
        assert_ok(fracas_model_create(&spec, &model));
        long double node = 0;
        double longest = 0;
        for (size_t e = 0; e < N; e++) {
            const double *size = model->table;
            assert_true(size[e] >= h * (1 - 2 * amplitudes[a]) && size[e] <= h * (1 + 2 * amplitudes[a]));
            longest = fmax(longest, size[e]);
            node += size[e];
            const double move = e + 1 < N ? amplitudes[a] * noise[e + 1] : 0;
            assert_true(fabsl(node - (long double)h * ((long double)e + 1 + move)) < 4 * (long double)h * 0x1p-53L * (e + 1));
        }
        assert_true(model->longest == longest && longest > h * (1 + amplitudes[a]));
        fracas_model_destroy(model);
        spec.mesh.noise = NULL;
        assert_int_equal(fracas_model_create(&spec, &model), FRACAS_BUG);
    }
}

static fracas_record run_to_fragments(fracas_spec *spec, double time_step)
{
    const fracas_batch_options options = {.width = 1, .isa = FRACAS_ISA_BEST};
    fracas_model *model;
    fracas_batch *batch;
    fracas_record record;
    assert_ok(fracas_model_create(spec, &model));
    assert_true(fabs(model->time_step / time_step - 1) < 1e-6); /* power iterations end at 1e-9 a step, of 20 */
    model->time_step = time_step;
    assert_ok(fracas_batch_create(model, 1, &options, &batch));
    bar_draw(batch, 0, 0.1, 5);
    fracas_record_init(&record);
    assert_ok(fracas_batch_run(batch, &record));
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
    return record;
}

/* Lengths that are alike to 1e-14 fragment as one length does: with the law nitsche all is continuous, and 1e-14 has grown to
 * 1e-12 when all is broken; 1e-10 is the bound. rigid-link is not: the traction of an open link jumps at q = 0, so that roundings
 * decide (strengths that differ by 1e-14 on one uniform mesh change energies by 1e-3 too). Its counts are the same, its energies
 * within 1e-2; on a progression of ratio 1, whose lengths are those of the uniform mesh, it is held to 1e-10 as well. */
static void nearly_equal_lengths_give_the_uniform_run(void **unused)
{
    (void)unused;
    double noise[501];
    for (int i = 0; i < 4; i++) {
        fracas_spec spec = bar_reference(500, 1e5, 2e-7);
        spec.geometry.length = 5e-3;
        spec.cohesive.law = laws[i % 2];
        fracas_model *model;
        assert_ok(fracas_model_create(&spec, &model));
        const double time_step = model->time_step;
        fracas_model_destroy(model);
        fracas_record uniform = run_to_fragments(&spec, time_step);
        if (i / 2) bar_perturb(&spec, 1e-14, 1, noise);
        else bar_grade(&spec, 1);
        fracas_record varied = run_to_fragments(&spec, time_step);
        assert_int_equal(varied.cracked, uniform.cracked);
        assert_int_equal(varied.broken, uniform.broken);
        assert_int_equal(varied.fragments, uniform.fragments);
        assert_true(uniform.fragments > 10);
        const double total = uniform.kinetic + uniform.elastic + uniform.dissipated;
        const double differences[] = {varied.kinetic - uniform.kinetic, varied.elastic - uniform.elastic,
                                      varied.cohesive - uniform.cohesive, varied.dissipated - uniform.dissipated,
                                      varied.created - uniform.created, varied.work - uniform.work};
        double worst = 0;
        for (int d = 0; d < 6; d++) worst = fmax(worst, fabs(differences[d]) / total);
        print_message("[  figures ] %s %s: %lld fragments, energies differ by %.1e\n", laws[i % 2]->name, spec.mesh.spacing->name,
                      (long long)uniform.fragments, worst);
        assert_true(worst < (i == 3 ? 1e-2 : 1e-10));
        fracas_record_clear(&uniform);
        fracas_record_clear(&varied);
    }
}

/* ---- consistency ---- */

/* Under imposed rate every element has the same stress, to the bit, and no interface a jump: nothing moves before onset, and
 * the first onset is when the background reaches the strength. */
static void a_uniform_stretch_moves_nothing(void **unused)
{
    (void)unused;
    const double onset = 300e6 / (275e9 * 1e4);
    for (int i = 0; i < 4 * MESHES; i++) {
        fracas_spec spec = bar_reference(400, 1e4, 2 * onset);
        spec.geometry.length = 0.02;
        spec.cohesive.law = laws[i % 2];
        spec.geometry.ends = ends[i / 2 % 2];
        fracas_model *model = model_on(&spec, i / 4);
        fracas_batch *batch = batch_of(model, 300e6);
        fracas_record record;
        fracas_record_init(&record);
        model->time_step = fmin(model->time_step, onset / 500);
        while (batch->step.cracked[0] == 0) {
            for (size_t e = 0; e < 400; e++)
                for (int f = W_LEFT; f <= V_RIGHT; f++) assert_true(*field(batch, e, f) == 0.0);
            assert_true(batch->step.kinetic[0] == 0.0);
            step(batch, &record);
        }
        assert_int_equal(batch->step.cracked[0], model->interfaces);
        assert_true(fabs(batch->step.first_onset[0] / onset - 1) < 1e-12);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
}

/* w = strain x is the same stretch, this time made of nodes: strains of elements are then (x_right - x_left)/h, one rounding
 * of x (L at most) over h, so that forces are 2 E strain (L/h) 2^-53 at most, twice that for N and T each, and the kick of a
 * unit step by mass leaves rho h/2 times that. */
static void a_stretch_of_the_nodes_moves_no_inner_node(void **unused)
{
    (void)unused;
    const double strain = 5e-4, stress = 275e9 * strain;
    for (int i = 0; i < 2 * MESHES; i++) {
        fracas_spec spec = bar_reference(400, 1e4, 1);
        spec.geometry.length = 0.02;
        spec.cohesive.law = laws[i % 2];
        spec.geometry.ends = &fracas_ends_held;
        fracas_model *model = model_on(&spec, i / 2);
        fracas_batch *batch = batch_of(model, 300e6);
        double x = 0, least = 1;
        for (size_t e = 0; e < 400; e++) {
            *field(batch, e, W_LEFT) = strain * x;
            x += model->table[e];
            *field(batch, e, W_RIGHT) = strain * x;
            least = fmin(least, model->table[e]);
        }
        batch->step.time[0] = batch->step.drift[0] = 0;
        batch->step.kick[0] = 1;
        model->formulation->advance(model, &batch->step);
        double largest = 0;
        for (size_t e = 0; e < 400; e++)
            for (int f = V_LEFT; f <= V_RIGHT; f++)
                largest = fmax(largest, fabs(*field(batch, e, f)) * 0.5 * 2750 * model->table[e]);
        assert_true(largest < 8 * stress * 0.02 / least * 0x1p-53);
        assert_true(fabs(batch->step.elastic[0] / (0.5 * stress * strain * 0.02 * 1e-6) - 1) < 1e-9);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
}

/* ---- waves ---- */

/* Held bar, no load: v = sin(pi x/L) at the start, so that after a quarter of a period w = L/(pi c) sin(pi x/L). */
static double wave_error(int law, int mesh, int64_t elements)
{
    const double length = 0.05, k = M_PI / length, quarter = 0.5 * length / BAR_WAVE_SPEED;
    fracas_spec spec = bar_reference(elements, 1e-9, 10 * quarter);
    spec.geometry.ends = &fracas_ends_held;
    spec.cohesive.law = laws[law];
    spec.time.safety = 0.9;
    fracas_model *model = model_on(&spec, mesh);
    const double steps = ceil(quarter / model->time_step);
    model->time_step = quarter / steps;
    fracas_batch *batch = batch_of(model, 5e7);
    double x = 0, sum = 0, norm = 0;
    for (size_t e = 0; e < model->elements; e++) { /* w(0) = 0, so v(-dt/2) = v(0) to second order */
        *field(batch, e, V_LEFT) = e > 0 ? *field(batch, e - 1, V_RIGHT) : 0;
        x += model->table[e];
        *field(batch, e, V_RIGHT) = e + 1 < model->elements ? sin(k * x) : 0;
    }
    fracas_record record;
    fracas_record_init(&record);
    for (int s = 0; s <= (int)steps; s++) step(batch, &record);
    x = 0;
    for (size_t e = 0; e < model->elements; e++) {
        for (int g = 0; g < 2; g++) { /* two Gauss points */
            double h = model->table[e], xi = 0.5 + (g ? 0.5 : -0.5) / sqrt(3);
            double w = (1 - xi) * *field(batch, e, W_LEFT) + xi * *field(batch, e, W_RIGHT);
            double exact = sin(k * (x + xi * h)) / (k * BAR_WAVE_SPEED);
            sum += h * (w - exact) * (w - exact);
            norm += h * exact * exact;
        }
        x += model->table[e];
    }
    assert_int_equal(batch->step.cracked[0], 0);
    fracas_batch_destroy(batch);
    fracas_model_destroy(model);
    return sqrt(sum / norm);
}

/* L2 error of linear elements: order 2 in h. A progression of one ratio over more elements is the same map of a finer mesh:
 * the slope is 2 within 0.1. The numbers of a perturbed mesh are others on each, and move its error by some 10 %: 0.3. */
static void waves_converge_with_order_two(void **unused)
{
    (void)unused;
    static const double bound[MESHES] = {0.1, 0.1, 0.3};
    for (int i = 0; i < 2 * MESHES; i++) {
        double coarse = wave_error(i % 2, i / 2, 64), middle = wave_error(i % 2, i / 2, 128), fine = wave_error(i % 2, i / 2, 256);
        print_message("[  figures ] %s mesh %d: L2 errors %.3e %.3e %.3e, slopes %.3f %.3f\n", laws[i % 2]->name, i / 2, coarse,
                      middle, fine, log2(coarse / middle), log2(middle / fine));
        assert_true(fabs(log2(coarse / middle) - 2) < bound[i / 2]);
        assert_true(fabs(log2(middle / fine) - 2) < bound[i / 2]);
    }
}

/* ---- critical step ---- */

typedef struct {
    const fracas_model *model;
    bool ring, nitsche, broken;
    double contact; /* K of a broken interface / mean of both elements' E/h */
    size_t size;
    gsl_matrix *stiffness; /* of all nodes, left and right of each element */
} dense_operator;

static void add_product(dense_operator *o, const size_t *at, const double *a, const double *b, double factor)
{
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++) *gsl_matrix_ptr(o->stiffness, at[i], at[j]) += factor * (a[i] * b[j] + b[i] * a[j]);
}

/* Second derivatives of (bar.4) with delta = 0, or of elements and contact springs: bulk (E/2h) (b - a)^2; m q + K q^2/2. */
static void assemble(dense_operator *o)
{
    const size_t n = o->model->elements;
    const double *h = o->model->table;
    o->size = 2 * n;
    o->stiffness = gsl_matrix_calloc(o->size, o->size);
    for (size_t e = 0; e < n; e++) {
        const size_t at[4] = {2 * e, 2 * e + 1, 2 * e, 2 * e + 1};
        const double strain[4] = {-1, 1, 0, 0};
        add_product(o, at, strain, strain, 0.5 * 275e9 / h[e]);
    }
    for (size_t l = 0; l < (o->ring ? n : n - 1); l++) {
        const size_t r = (l + 1) % n, at[4] = {2 * l, 2 * l + 1, 2 * r, 2 * r + 1};
        const double left = 275e9 / h[l], right = 275e9 / h[r], jump[4] = {0, -1, 1, 0};
        const double mean[4] = {-0.5 * left, 0.5 * left, -0.5 * right, 0.5 * right};
        if (o->broken || o->nitsche) add_product(o, at, jump, jump, 0.25 * o->contact * (left + right));
        if (!o->broken && o->nitsche) add_product(o, at, mean, jump, 1);
    }
}

/* Which degree of freedom a node belongs to: tied ones share one, held ones have none (-1). */
static size_t number_nodes(const dense_operator *o, int *number)
{
    const bool tied = !o->broken && !o->nitsche;
    size_t count = 0;
    for (size_t i = 0; i < o->size; i++) number[i] = -1;
    for (size_t i = 0; i < o->size; i++) {
        if (!o->ring && (i == 0 || i == o->size - 1)) continue;
        if (number[i] < 0) number[i] = (int)count++;
        if (tied && i % 2 == 1) number[(i + 1) % o->size] = number[i]; /* a right node and the left one of the next element */
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
    const bool nitsche = model->spec.cohesive.law == &fracas_law_nitsche;
    dense_operator o = {.model = model, .ring = model->interfaces == model->elements, .nitsche = nitsche, .broken = broken,
                        .contact = nitsche ? model->spec.cohesive.beta : 1.0};
    assemble(&o);
    int number[2 * MOST];
    const size_t n = number_nodes(&o, number);
    double mass[2 * MOST] = {0};
    for (size_t i = 0; i < o.size; i++)
        if (number[i] >= 0) mass[number[i]] += 0.5 * 2750 * model->table[i / 2];
    gsl_matrix *matrix = gsl_matrix_calloc(n, n);
    for (size_t i = 0; i < o.size; i++)
        for (size_t j = 0; j < o.size; j++)
            if (number[i] >= 0 && number[j] >= 0)
                *gsl_matrix_ptr(matrix, (size_t)number[i], (size_t)number[j]) +=
                    gsl_matrix_get(o.stiffness, i, j) / sqrt(mass[number[i]] * mass[number[j]]);
    gsl_vector *value = gsl_vector_alloc(n);
    gsl_eigen_symm_workspace *work = gsl_eigen_symm_alloc(n);
    assert_int_equal(gsl_eigen_symm(matrix, value, work), 0);
    const double omega_squared = gsl_vector_max(value);
    assert_true(gsl_vector_min(value) > -1e-10 * omega_squared); /* stiff in every direction, at every beta > 1 */
    gsl_eigen_symm_free(work);
    gsl_vector_free(value);
    gsl_matrix_free(matrix);
    gsl_matrix_free(o.stiffness);
    return 2 / sqrt(omega_squared);
}

/* Steps above the true critical one by less than 1e-3 whatever the mesh, and below it hardly at all: power iteration ends
 * within 1e-3 where frequencies are dense, which is where elements are nearly alike (the last meshes). */
static void critical_step_is_that_of_the_dense_operator(void **unused)
{
    (void)unused;
    static const double ratios[] = {1.001, 3, 100, 1e3, 1e-3}, amplitudes[] = {0.45, 0.3, 0.1, 0.01, 0.001};
    static const double betas[] = {1.05, 4, 30};
    double above[2][2] = {{0}}, below = 0, noise[301];
    for (int i = 0; i < 122; i++) {
        const bool large = i >= 120; /* two of 300 elements */
        const int64_t n = large ? 300 : i % 12 == 0 ? 3 : 20 + (i * 7) % 41;
        fracas_spec spec = bar_reference(n, 1e4, 1e-6);
        spec.geometry.length = (double)n * 2e-5;
        spec.geometry.ends = ends[i / 2 % 2];
        spec.cohesive.law = laws[i % 2];
        spec.cohesive.beta = betas[i / 8 % 3];
        if (i / 4 % 2 && !large) bar_grade(&spec, ratios[i % 5]);
        else bar_perturb(&spec, large ? 0.01 : amplitudes[i % 5], (uint64_t)i, noise);
        fracas_model *model;
        assert_ok(fracas_model_create(&spec, &model));
        for (int broken = 0; broken < 2; broken++) {
            const double found = broken ? model->critical_cracked : model->critical_closed;
            const double error = found / dense_step(model, broken) - 1;
            above[i % 2][broken] = fmax(above[i % 2][broken], error);
            below = fmin(below, error);
        }
        assert_true(model->critical_step == fmin(model->critical_closed, model->critical_cracked));
        fracas_model_destroy(model);
    }
    for (int i = 0; i < 4; i++) {
        print_message("[  figures ] %s %s: step above the critical one by %.1e at most\n", laws[i / 2]->name,
                      i % 2 ? "broken" : "uncracked", above[i / 2][i % 2]);
        assert_true(above[i / 2][i % 2] < 1e-3);
    }
    assert_true(below > -1e-3);
}

/* All interfaces broken and pressed together: uniform stress sigma = E (rate t + strain) = K q, of a bar that keeps its
 * length. Rigid links get the strengths that make them as stiff as the time step takes them to be. */
static void press_together(const fracas_model *model, fracas_batch *batch)
{
    const size_t n = model->elements;
    const bool nitsche = model->spec.cohesive.law == &fracas_law_nitsche;
    const double offset = 4.5 * pow(model->spec.loading.rate, 2.0 / 3) * 275e9 * pow(100, 2.0 / 3) * pow(2750, 1.0 / 3);
    double stiffness[MOST], give = model->spec.geometry.length / 275e9, left = 0;
    for (size_t e = 0; e < model->interfaces; e++) {
        const double mean = 0.5 * 275e9 * (1 / model->table[e] + 1 / model->table[(e + 1) % n]);
        stiffness[e] = nitsche ? 4 * mean : mean;
        give += 1 / stiffness[e];
        *field(batch, e, DAMAGE) = 1;
        if (nitsche) continue;
        *field(batch, e, STRENGTH) = sqrt(4.5 * 100 * mean - offset);
        *field(batch, e, LAW) = 2;
    }
    batch->step.time[0] = -1e-8; /* pressed by a background of -1e-4 */
    const double load = model->spec.loading.rate * batch->step.time[0], stress = load * model->spec.geometry.length / give;
    for (size_t e = 0; e < n; e++) {
        *field(batch, e, W_LEFT) = left;
        *field(batch, e, W_RIGHT) = left += (stress / 275e9 - load) * model->table[e];
        if (e < model->interfaces) left += stress / stiffness[e];
    }
}

/* 100 steps of `factor` times the critical one from a nm/s of noise at every node: the largest velocity after them [m/s]. */
static double march(const fracas_model *model, bool broken, double factor)
{
    const size_t n = model->elements;
    fracas_batch *batch = batch_of(model, 3e8);
    uint64_t seed = 3;
    batch->step.time[0] = 0;
    if (broken) press_together(model, batch);
    for (size_t e = 0; e < n; e++) { /* tied nodes start together */
        *field(batch, e, V_RIGHT) = 1e-9 * random_number(&seed);
        *field(batch, (e + 1) % n, V_LEFT) = *field(batch, e, V_RIGHT);
    }
    if (model->interfaces < n) *field(batch, 0, V_LEFT) = *field(batch, n - 1, V_RIGHT) = 0;
    batch->step.drift[0] = batch->step.kick[0] = factor * dense_step(model, broken);
    double largest = 0;
    for (int s = 0; s < 100; s++) model->formulation->advance(model, &batch->step);
    for (size_t e = 0; e < n; e++)
        for (int f = V_LEFT; f <= V_RIGHT; f++) largest = fmax(largest, fabs(*field(batch, e, f)));
    fracas_batch_destroy(batch);
    return largest;
}

/* Below it, omega dt = 1.98, noise is magnified by 1/sqrt(1 - 0.99^2) = 7 in the worst mode; above it, omega dt = 2.02, by
 * e^(2 arcosh 1.01) = 1.33 a step, until interfaces open. */
static void steps_blow_up_above_the_critical_one_only(void **unused)
{
    (void)unused;
    for (int i = 0; i < 8 * MESHES; i++) {
        fracas_spec spec = bar_reference(60, 1e4, 1);
        spec.geometry.length = 60 * 2e-5;
        spec.cohesive.law = laws[i % 2];
        spec.geometry.ends = ends[i / 2 % 2];
        fracas_model *model = model_on(&spec, i / 8);
        const double stays = march(model, i / 4 % 2, 0.99), grows = march(model, i / 4 % 2, 1.01);
        if (!(stays < 1e-7) || !(grows > 1e-5))
            fail_msg("%s, %s, %s, mesh %d: %g m/s below, %g m/s above", laws[i % 2]->name, ends[i / 2 % 2]->name,
                     i / 4 % 2 ? "broken" : "uncracked", i / 8, stays, grows);
        fracas_model_destroy(model);
    }
}

/* ---- what a run leaves ---- */

/* Both sides of an uncracked rigid link have one displacement and one velocity, to the bit, until it cracks. */
static void tied_nodes_stay_together(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2 * MESHES; i++) {
        fracas_spec spec = bar_reference(300, 1e5, 1);
        spec.geometry.length = 6e-3;
        spec.cohesive.law = &fracas_law_rigid_link;
        spec.geometry.ends = ends[i % 2];
        fracas_model *model = model_on(&spec, i / 2);
        fracas_batch *batch = batch_of(model, 300e6);
        bar_draw(batch, 0, 0.3, 1);
        fracas_record record;
        fracas_record_init(&record);
        int moved = 0, closed = 0, open = 0;
        double momentum = 0, scale = 0;
        for (int s = 0; batch->step.broken[0] < 5; s++) {
            step(batch, &record);
            closed = open = 0;
            momentum = scale = 0;
            for (size_t e = 0; e < 300; e++) {
                const size_t next = (e + 1) % 300;
                const double *w = field(batch, e, W_RIGHT), *v = field(batch, e, V_RIGHT);
                for (int f = V_LEFT; f <= V_RIGHT; f++) {
                    momentum += model->table[e] * *field(batch, e, f);
                    scale += model->table[e] * fabs(*field(batch, e, f));
                }
                if (e >= model->interfaces || *field(batch, e, LAW) > 0) {
                    open += e < model->interfaces;
                    continue;
                }
                closed++;
                moved += *w != 0;
                assert_true(*field(batch, next, W_LEFT) == *w && *field(batch, next, V_LEFT) == *v);
            }
            /* a held end gives momentum; each step rounds each node's by 2^-53 a few times */
            if (i % 2 == 0) assert_true(fabs(momentum) <= scale * 4 * 0x1p-53 * (s + 300));
        }
        assert_true(moved > 1000 && closed > 50 && open > 10 && scale > 0);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
}

typedef struct {
    long double mass, size, position, velocity;
    int64_t elements;
} piece;

/* Element e of a bar taken `back` by this length [m], its left node at `x`, joins the piece. */
static void join(piece *p, fracas_batch *batch, size_t e, long double x, long double back)
{
    const long double h = batch->model->table[e], middle = x + h / 2 - back, rate = batch->model->spec.loading.rate;
    const long double w = ((long double)*field(batch, e, W_LEFT) + *field(batch, e, W_RIGHT)) / 2;
    const long double v = ((long double)*field(batch, e, V_LEFT) + *field(batch, e, V_RIGHT)) / 2;
    p->elements++;
    p->size += h;
    p->mass += 2750 * 1e-6L * h;
    p->position += h * (middle * (1 + rate * batch->step.time[0]) + w);
    p->velocity += h * (rate * middle + v);
}

/* The pieces between broken interfaces, walked from the first element on; those after the last break belong to the first. */
static size_t walk(fracas_batch *batch, piece *pieces)
{
    const fracas_model *model = batch->model;
    const bool ring = model->interfaces == model->elements;
    const long double length = model->spec.geometry.length;
    size_t last = model->elements, count = 1;
    while (ring && last > 0 && *field(batch, last - 1, DAMAGE) < 1) last--;
    long double x = 0;
    pieces[0] = (piece){0};
    for (size_t e = 0; e < model->elements; x += model->table[e], e++) {
        const bool wraps = e >= last;
        if (e > 0 && !wraps && *field(batch, e - 1, DAMAGE) >= 1) pieces[count++] = (piece){0};
        join(&pieces[wraps ? 0 : count - 1], batch, e, x, wraps ? length : 0);
    }
    for (size_t p = 0; p < count; p++) {
        pieces[p].position /= pieces[p].size;
        pieces[p].velocity /= pieces[p].size;
        if (!ring || pieces[p].position >= 0) continue;
        pieces[p].position += length * (1 + model->spec.loading.rate * (long double)batch->step.time[0]);
        pieces[p].velocity += model->spec.loading.rate * length;
    }
    return count;
}

/* Each rounds once an element in each of its sums, 400 elements: 1e-13 of the body's mass, length, and fastest end. */
static void fragments_are_sums_over_their_elements(void **unused)
{
    (void)unused;
    for (int i = 0; i < 4 * MESHES; i++) {
        fracas_spec spec = bar_reference(400, 1e5, 2e-7);
        spec.geometry.length = 8e-3;
        spec.cohesive.law = laws[i % 2];
        spec.geometry.ends = ends[i / 2 % 2];
        fracas_model *model = model_on(&spec, i / 4);
        fracas_batch *batch = batch_of(model, 300e6);
        bar_draw(batch, 0, 0.05, 2);
        fracas_record record;
        fracas_record_init(&record);
        for (size_t running = 1; running > 0;) assert_ok(fracas_batch_step(batch, &record, &running));
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
            momentum += 0.5 * 2750e-6 * model->table[e] * (*field(batch, e, V_LEFT) + *field(batch, e, V_RIGHT));
        assert_true(fabs(size / 8e-3 - 1) < 1e-13 && fabs(mass / record.mass - 1) < 1e-13);
        assert_true(fabs(record.mass / (2750e-6 * 8e-3) - 1) < 1e-15);
        assert_true(fabs(record.momentum[0] - momentum) < 1e-13 * fastest * record.mass);
        if (i / 2 % 2 == 0) /* closed: none; leapfrog's v is that of sqrt(2 T/m) on average */
            assert_true(fabs(record.momentum[0]) < sqrt(2 * record.kinetic * record.mass) * 1e-16 * (double)record.steps);
        fracas_record_clear(&record);
        fracas_batch_destroy(batch);
        fracas_model_destroy(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_of_a_graded_mesh_are_a_progression),
        cmocka_unit_test(nodes_of_a_perturbed_mesh_are_moved_by_their_numbers),
        cmocka_unit_test(nearly_equal_lengths_give_the_uniform_run),
        cmocka_unit_test(a_uniform_stretch_moves_nothing),
        cmocka_unit_test(a_stretch_of_the_nodes_moves_no_inner_node),
        cmocka_unit_test(waves_converge_with_order_two),
        cmocka_unit_test(critical_step_is_that_of_the_dense_operator),
        cmocka_unit_test(steps_blow_up_above_the_critical_one_only),
        cmocka_unit_test(tied_nodes_stay_together),
        cmocka_unit_test(fragments_are_sums_over_their_elements),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
