/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Strengths drawn over lanes have the bits of the scalar quantiles, on every instruction set of
 * this CPU. */
#include "sampler/distribution/distribution.h"
#include "sampler/api/sampler.h"
#include "tests/support/test.h"

static fracas_strength weibull(double minimum, double shape)
{
    return (fracas_strength){
        .distribution = &fracas_weibull.kind, .minimum = minimum, .scale = 50e6, .shape = shape};
}

static fracas_strength lognormal(double sigma)
{
    return (fracas_strength){
        .distribution = &fracas_lognormal.kind, .median = 300e6, .sigma = sigma};
}

static const fracas_strength uniform = {
    .distribution = &fracas_uniform.kind, .minimum = 264e6, .maximum = 364.1e6};

static bool is_lacking(fracas_isa isa)
{
    fracas_isa had;
    if (!fracas_isa_choose(isa, &had)) return false;
    print_message("[  skipped ] this CPU has no %s\n", fracas_isa_name[isa]);
    return true;
}

/* A block of any u of a stream against the scalar quantile, bit by bit. */
static void assert_block(const fracas_strength *strength, size_t n, const double *u)
{
    enum { MOST = 4096 };
    static double x[MOST] __attribute__((aligned(64)));
    assert_true(n <= MOST);
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa < FRACAS_NISAS; isa++) {
        fracas_isa had;
        if (fracas_isa_choose(isa, &had)) continue;
        for (int lanes = fracas_isa_lanes(isa, FRACAS_LANES_MAX); lanes > 0;
             lanes = fracas_isa_lanes(isa, lanes - 1)) {
            const fracas_block block = fracas_distribution_of(strength)->block;
            fracas_block_quantile_of(block, isa, lanes)(strength, n, u, x);
            for (size_t j = 0; j < n; j++) {
                const double expected = fracas_strength_quantile(
                    strength, (fracas_extent){1.0, 1.0}, fracas_probability_of(u[j]));
                if (memcmp(&x[j], &expected, sizeof expected) != 0)
                    fail_msg("%s, %s, %d lanes, u = %a: %a, one by one %a",
                             strength->distribution->name, fracas_isa_name[isa], lanes, u[j], x[j],
                             expected);
            }
        }
    }
}

/* Three million numbers of streams for each law. */
static void blocks_have_the_scalar_bits(void **state)
{
    enum { N = 4096, BLOCKS = 750 };
    static double u[N] __attribute__((aligned(64)));
    const fracas_strength laws[] = {weibull(0.0, 0.1), weibull(264e6, 2.0), weibull(0.0, 41.7),
                                    lognormal(0.1),    lognormal(10.0),     uniform};
    for (uint64_t b = 0; b < BLOCKS; b += CASE_STRIDE) {
        const fracas_stream stream = {7, FRACAS_PURPOSE_STRENGTH, {8, 9}, b};
        fracas_stream_fill(&stream, b * N, N, u);
        for (size_t k = 0; k < FRACAS_COUNT(laws); k++) assert_block(&laws[k], N, u);
    }
}

/* A number of a stream near u. */
static double drawable(double u)
{
    return (fmin(floor(u * 0x1p52), 0x1p52 - 1.0) + 0.5) * 0x1p-52;
}

/* The ends, the middle, and where the quantiles take another branch: in each lane, among others. */
static void blocks_have_the_scalar_bits_at_the_ends(void **state)
{
    enum { PLACES = 15, N = 64 * PLACES };
    const double r_5 = 1.388794386496402e-11 /* e^-25 */, t_1 = 0.6321205588285577 /* 1 - 1/e */;
    const double places[PLACES] = {0.0,       0x1p-52,       0x1p-51, 0x1p-30, r_5,
                                   1.0 - r_5, 1e-9,          0.075,   0.925,   0.5 - 0x1p-52,
                                   0.5,       1.0 - 0x1p-52, 1.0,     t_1,     0.29};
    static double u[N] __attribute__((aligned(64)));
    const fracas_strength laws[] = {weibull(0.0, 0.1), weibull(264e6, 2.0), weibull(1.0, 1000.0),
                                    lognormal(0.1),    lognormal(10.0),     uniform};
    for (int nudge = -2; nudge <= 2; nudge++) {
        for (size_t j = 0; j < N; j++) u[j] = drawable(0.3 + 1e-4 * (double)j);
        for (size_t p = 0; p < PLACES; p++)
            for (size_t lane = 0; lane < 8; lane++)
                u[(8 * p + lane) * 8 + lane] = drawable(fmax(places[p] + nudge * 0x1p-52, 0.0));
        for (size_t k = 0; k < FRACAS_COUNT(laws); k++) assert_block(&laws[k], N, u);
    }
}

/* Every length and number of points at a stride, against names and scalar quantiles; what lies
 * between and behind stays. */
static void fields_are_drawn_over_lanes(void **state)
{
    enum { MOST = 3 * 1100 * 8 + 8 };
    static double sigma_c[MOST];
    static const size_t numbers[] = {0, 1, 2, 7, 8, 9, 255, 256, 257, 300, 1100},
                        strides[] = {1, 8};
    const fracas_strength laws[] = {weibull(264e6, 2.0), lognormal(0.1), uniform};
    static fracas_extent extent[1100];
    static double position[3 * 1100][3];
    const fracas_stream stream = {3, FRACAS_PURPOSE_STRENGTH, {4, 5}, 6};
    for (fracas_isa isa = FRACAS_ISA_BASELINE; isa < FRACAS_NISAS; isa++) {
        if (is_lacking(isa)) continue;
        for (size_t k = 0;
             k < FRACAS_COUNT(laws) * FRACAS_COUNT(numbers) * 3 * FRACAS_COUNT(strides); k++) {
            const fracas_strength *law = &laws[k % FRACAS_COUNT(laws)];
            const size_t rest = k / FRACAS_COUNT(laws), n = numbers[rest % FRACAS_COUNT(numbers)];
            const size_t points = 1 + rest / FRACAS_COUNT(numbers) % 3,
                         stride = strides[rest / FRACAS_COUNT(numbers) / 3];
            const fracas_sites sites = {.n = n,
                                        .points = points,
                                        .extent = extent,
                                        .position = (const double(*)[3])position};
            fracas_field *field;
            OK(fracas_field_create(law, &sites, &field));
            OK(fracas_field_use(field, isa));
            for (size_t i = 0; i < MOST; i++) sigma_c[i] = -1.0;
            OK(fracas_field_sample(field, &stream, stride, sigma_c));
            for (size_t i = 0; i < MOST; i++) {
                const size_t s = i / stride;
                double expected = -1.0;
                if (i % stride == 0 && s < n * points) {
                    const double u = fracas_stream_uniform(
                        &stream, fracas_stream_site(s / points, s % points));
                    expected = fracas_strength_quantile(law, extent[0], fracas_probability_of(u));
                }
                assert_true(sigma_c[i] == expected);
            }
            fracas_field_destroy(field);
        }
    }
}

TESTS(blocks_have_the_scalar_bits, blocks_have_the_scalar_bits_at_the_ends,
      fields_are_drawn_over_lanes)
