/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fields of a realization: known motions give known displacements, stresses and openings, and at
 * the end they are those of the record. */
#include "engine/fields.h"
#include "engine/formulation/chain/bar_sweep.h"
#include "engine/formulation/chain/chain.h"
#include "engine/formulation/chain/ring_sweep.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/ring.h"
#include "tests/support/shell.h"

enum { LANES = 3, LANE = 1 }; /* of each batch, and the one that is looked at */

/* Lanes begun with strengths that nothing reaches, each interface its own; no interfaces are kept.
 */
static fracas_batch *strong_batch(const fracas_model *model)
{
    fracas_batch *batch = batch_with(model, LANES, (fracas_batch_options){.isa = FRACAS_ISA_BEST});
    for (size_t l = 0; l < LANES; l++)
        for (size_t k = 0; k < strengths_of(model); k++)
            bar_set_strength(batch, l, k, 1e7 + 10 * (double)k + (double)l);
    OK(fracas_batch_begin(batch));
    return batch;
}

static fracas_fields *fields_of(fracas_batch *batch)
{
    fracas_fields *fields = NULL;
    OK(fracas_fields_create(batch->model, &fields));
    fracas_batch_fields(batch, LANE, fields);
    return fields;
}

/* Nothing has cracked: one fragment of all mass; strengths are those of the lane. */
static void check_whole(const fracas_fields *f, const fracas_model *model)
{
    double mass = 0;
    assert_true(f->elements == model->elements && f->interfaces == model->interfaces);
    for (size_t k = 0; k < f->elements * f->corners; k++) mass += f->mass[k];
    assert_true(fabs(mass / model->mass - 1) < 1e-12);
    for (size_t e = 0; e < f->elements; e++)
        assert_true(f->fragment[e] == 0 && fabs(f->fragment_mass[e] / model->mass - 1) < 1e-12);
    for (size_t i = 0; i < f->interfaces; i++) {
        assert_true(f->damage[i] == 0 && isnan(f->onset_time[i]));
        assert_true(f->strength[i] == 1e7 + 10 * (double)(i * model->strengths) + LANE);
    }
}

static bool is_close(double a, double b, double scale)
{
    return fabs(a - b) <= 1e-12 * scale;
}

/* ---- chains ---- */

/* A bar at rest in its background has that alone, whatever its ends and spacing. */
static void a_bar_in_its_background(void **unused)
{
    const fracas_kind *const ends[] = {&fracas_ends_periodic, &fracas_ends_held, &fracas_ends_free};
    for (int which = 0; which < 6; which++) {
        fracas_spec spec = bar_reference(60, 1e4, 1);
        spec.geometry.ends = ends[which % 3];
        spec.geometry.gap = NAN;
        if (which >= 3) bar_grade(&spec, 3);
        OWN(fracas_model) model = make_model(&spec);
        OWN(fracas_batch) batch = strong_batch(model);
        const double time = 3e-9, middle = which % 3 == 2 ? 0.025 : 0;
        batch->step.time[LANE] = time;
        OWN(fracas_fields) f = fields_of(batch);
        check_whole(f, model);
        assert_true(f->time == time && f->corners == 2 && f->ends == 1 && f->components[0] == 1);
        double x = 0;
        for (size_t node = 0; node < 120;
             x += node % 2 ? 0 : fracas_chain_size(model, node / 2), node++) {
            assert_true(is_close(f->displacement[node][0], 1e4 * time * (x - middle), 2e-6));
            assert_true(is_close(f->place[node][0], x + 1e4 * time * (x - middle), 0.05));
            assert_true(is_close(f->velocity[node][0], 1e4 * (x - middle), 500));
            assert_true(f->place[node][1] == 0 && f->place[node][2] == 0);
        }
        assert_true(is_close(x, 0.05, 0.05));
        for (size_t e = 0; e < 60; e++)
            assert_true(is_close(f->stress[0][e], 275e9 * 1e4 * time, 275e9 * 3e-5));
    }
}

/* One element aside: its interfaces open and close by as much; the closing one of the bar takes its
 * first side. */
static void a_bar_with_an_element_aside(void **unused)
{
    const fracas_spec spec = bar_reference(40, 1e4, 1);
    OWN(fracas_model) model = make_model(&spec);
    OWN(fracas_batch) batch = strong_batch(model);
    for (int side = 0; side < 2; side++)
        *fracas_chain_field(model, &batch->step, 39, BAR_W_LEFT + side, LANE) = 1e-6;
    OWN(fracas_fields) f = fields_of(batch);
    for (size_t i = 0; i < 40; i++) {
        const double moved = i == 38 ? 1e-6 : i == 39 ? -1e-6 : 0;
        assert_true(f->opening[i] == moved);
        assert_true(f->between[i][0] == (int64_t)i && f->between[i][1] == (int64_t)((i + 1) % 40));
        const double middle = i == 39 ? f->place[79][0]
                                      : 0.5 * (f->place[2 * i + 1][0] + f->place[2 * i + 2][0]);
        assert_true(f->middle[i][0] == middle);
    }
    assert_true(is_close(f->middle[39][0], 0.05 + 1e-6, 0.05));
}

static double *ring_value(const fracas_batch *batch, size_t e, int field)
{
    return fracas_chain_field(batch->model, &batch->step, e, field, LANE);
}

/* Every node moves by `share` of its place: the strain is that. Then element 0 moves by d, turned
 * frames or not: its interfaces open by d . n, n between the chords. */
static void a_ring_grown(void **unused)
{
    for (int current = 0; current < 2; current++) {
        fracas_spec spec = ring_reference(36, 1e4, 1);
        if (!current) spec.geometry.direction = &fracas_direction_initial;
        OWN(fracas_model) model = make_model(&spec);
        OWN(fracas_batch) batch = strong_batch(model);
        const double share = 1e-3, radius = model->element_size / (2 * sin(PI / 36)),
                     d[2] = {2e-6, -3e-6};
        for (size_t node = 0; node < 72; node++) {
            const double angle = 2 * PI * (double)(node / 2 + node % 2) / 36,
                         x[2] = {radius * cos(angle), radius * sin(angle)};
            for (int i = 0; i < 2; i++)
                *ring_value(batch, node / 2, (node % 2 ? RING_U_RIGHT : RING_U_LEFT) + i) =
                    share * x[i] + (node / 2 == 0 ? d[i] : 0);
        }
        OWN(fracas_fields) f = fields_of(batch);
        check_whole(f, model);
        for (size_t e = 0; e < 36; e++) {
            assert_true(is_close(f->stress[0][e], 275e9 * share, 275e9 * 1e-3));
            const double angle = 2 * PI * (double)(e + 1) / 36,
                         along = -d[0] * sin(angle) + d[1] * cos(angle);
            assert_true(is_close(f->opening[e], e == 35 ? along : e == 0 ? -along : 0, 1e-3));
            for (int i = 0; i < 3; i++)
                assert_true(is_close(
                    f->middle[e][i],
                    0.5 * (f->place[2 * e + 1][i] + f->place[2 * ((e + 1) % 36)][i]), 1e-2));
            for (int side = 0; side < 2; side++) {
                const double *u = f->displacement[2 * e + (size_t)side],
                             *x = f->place[2 * e + (size_t)side],
                             *v = f->velocity[2 * e + (size_t)side];
                for (int i = 0; i < 2; i++)
                    assert_true(
                        is_close(x[i] * share - u[i] * (1 + share), e == 0 ? -d[i] : 0, 1e-2));
                assert_true(is_close(v[0] * x[1], v[1] * x[0], 100) || e == 0);
                assert_true(u[2] == 0 && x[2] == 0 && v[2] == 0);
            }
        }
    }
}

/* ---- surfaces ---- */

/* Displacements of all nodes, [3] each. */
typedef void move_node(const double x[3], double u[3]);

static void set_motion(fracas_batch *batch, move_node *move, size_t aside, const double d[3])
{
    const fracas_model *model = batch->model;
    const size_t dimension = (size_t)tables_of(model)->body->dimension;
    for (size_t e = 0; e < model->elements; e++)
        for (size_t k = 0; k < model->surface->corners; k++) {
            double u[3];
            move(node_at(model, e, k), u);
            for (size_t i = 0; i < dimension; i++) {
                const double value = u[i] + (e == aside ? d[i] : 0);
                *surface_value(model, &batch->step, e, SURFACE_U, (int)(dimension * k + i),
                               LANE) = value;
                *surface_value(model, &batch->step, e, SURFACE_V, (int)(dimension * k + i),
                               LANE) = 1e6 * value;
            }
        }
}

/* Places, displacements and velocities; interfaces of element `aside` open by d . n of the chord
 * between their ends, in the plane with normal t. */
static void check_motion(const fracas_fields *f, const fracas_model *model, move_node *move,
                         size_t aside, const double d[3], const double t[3])
{
    const fracas_surface *s = model->surface;
    for (size_t e = 0; e < f->elements; e++)
        for (size_t k = 0; k < f->corners; k++) {
            const size_t node = e * f->corners + k;
            const double *x = node_at(model, e, k);
            double u[3];
            move(x, u);
            for (int i = 0; i < 3; i++) {
                const double value = u[i] + (e == aside ? d[i] : 0);
                assert_true(f->displacement[node][i] == value);
                assert_true(f->velocity[node][i] == 1e6 * value);
                assert_true(f->place[node][i] == x[i] + value);
            }
        }
    for (size_t i = 0; i < f->interfaces; i++) {
        const fracas_surface_interface *of = &s->interface[i];
        const size_t e = of->element[0], k = of->edge[0];
        const double *a = node_at(model, e, k), *b = node_at(model, e, (k + 1) % 3);
        double along[3], normal[3];
        for (int j = 0; j < 3; j++) along[j] = b[j] - a[j];
        cross3(along, t, normal);
        const double length = sqrt(dot3(normal, normal)), sign = of->element[1] == aside   ? 1
                                                                 : of->element[0] == aside ? -1
                                                                                           : 0;
        assert_true(is_close(f->opening[i], sign * dot3(d, normal) / length, 1e-2));
        assert_true(f->between[i][0] == of->element[0] && f->between[i][1] == of->element[1]);
        for (size_t n = 0; n < f->ends; n++) { /* ends, then the middle */
            const double *x = node_at(model, e, n < 2 ? (k + n) % 3 : 3 + k);
            double u[3];
            move(x, u);
            for (int j = 0; j < 3; j++)
                assert_true(is_close(f->middle[i * f->ends + n][j],
                                     x[j] + u[j] + (sign != 0 ? 0.5 * d[j] : 0), 1e-2));
        }
    }
}

static const double stretch[2][2] = {{1e-3, -2e-4}, {5e-4, 3e-4}}; /* du_i/dx_j */

static void stretch_plane(const double x[3], double u[3])
{
    for (int i = 0; i < 2; i++) u[i] = 1e-6 + stretch[i][0] * x[0] + stretch[i][1] * x[1];
    u[2] = 0;
}

/* Distorted plates of both orders, with lumped and consistent masses. */
static void a_membrane_stretched(void **unused)
{
    const double t[3] = {0, 0, 1}, d[3] = {1e-6, -2e-6, 0};
    for (int which = 0; which < 4; which++) {
        fracas_spec spec = membrane_spec(&fracas_shape_plate, which % 2 + 1, 4);
        if (which >= 2) spec.time.mass = &fracas_mass_consistent;
        OWN(fracas_model) model = distorted_model(spec, DISTORTION, 3);
        OWN(fracas_batch) batch = strong_batch(model);
        set_motion(batch, stretch_plane, 7, d);
        OWN(fracas_fields) f = fields_of(batch);
        double by[2][2], s[3];
        memcpy(by, stretch, sizeof by);
        hooke(&spec.material, by, s);
        const double tensor[6] = {s[0], s[1], 0, s[2], 0, 0};
        check_whole(f, model);
        check_motion(f, model, stretch_plane, 7, d, t);
        assert_true(f->components[0] == 6 && f->components[1] == 0 && !f->name[1]);
        for (size_t e = 0; e < f->elements; e++)
            for (int j = 0; j < 6; j++)
                assert_true(is_close(f->stress[0][6 * e + (size_t)j], tensor[j], 1e9));
    }
}

/* Columns are the images of x, y, z: rotations about three axes. */
static const double turned[3][3] = {{0.36, 0.48, -0.8}, {-0.8, 0.6, 0}, {0.48, 0.64, 0.6}};
static const double bent[3] = {3e-3, -1e-3, 2e-3}; /* curvatures xx, yy, xy */

static void tilted_map(const void *how, double s, double t, double x[3])
{
    double flat[3];
    flat_map(how, s, t, flat);
    for (int i = 0; i < 3; i++) x[i] = turned[i][0] * flat[0] + turned[i][1] * flat[1];
}

/* Stretched in its plane and bent out of it, u_z = -x.k x/2, in the tilted frame. */
static void bend_tilted(const double x[3], double u[3])
{
    double flat[3] = {0}, moved[3];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 2; j++) flat[j] += turned[i][j] * x[i];
    stretch_plane(flat, moved);
    moved[2] = -0.5 * (bent[0] * flat[0] * flat[0] + bent[1] * flat[1] * flat[1]) -
               bent[2] * flat[0] * flat[1];
    for (int i = 0; i < 3; i++)
        u[i] = turned[i][0] * moved[0] + turned[i][1] * moved[1] + turned[i][2] * moved[2];
}

/* Q s Q^T of a tensor xx, yy, xy in the plane, in the order of the fields. */
static void tilt(const double s[3], double tensor[6])
{
    static const int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}};
    for (int p = 0; p < 6; p++) {
        const double *a = turned[pair[p][0]], *b = turned[pair[p][1]];
        tensor[p] = a[0] * s[0] * b[0] + a[1] * s[1] * b[1] + s[2] * (a[0] * b[1] + a[1] * b[0]);
    }
}

/* N = h sigma and M = h^3/12 times Hooke's law of the curvatures, both turned into space. */
static void a_shell_stretched_and_bent(void **unused)
{
    const double size[2] = {1, 1.2}, t[3] = {turned[0][2], turned[1][2], turned[2][2]},
                 d[3] = {1e-4, 2e-4, -1e-4};
    fracas_spec spec = shell_spec(&fracas_shape_file);
    OWN(fracas_model) model = grid_model(
        &spec, &(shell_grid){.nx = 3, .ny = 3, .map = tilted_map, .how = size, .distortion = 0.2});
    OWN(fracas_batch) batch = strong_batch(model);
    set_motion(batch, bend_tilted, 5, d);
    OWN(fracas_fields) f = fields_of(batch);
    check_whole(f, model);
    check_motion(f, model, bend_tilted, 5, d, t);
    double by[2][2], s[3], m[3], wanted[2][6],
        curved[2][2] = {{bent[0], bent[2]}, {bent[2], bent[1]}};
    memcpy(by, stretch, sizeof by);
    hooke(&spec.material, by, s);
    hooke(&spec.material, curved, m);
    const double h = spec.geometry.thickness;
    for (int j = 0; j < 3; j++) s[j] *= h, m[j] *= h * h * h / 12;
    tilt(s, wanted[0]);
    tilt(m, wanted[1]);
    assert_string_equal(f->name[0], "N");
    assert_string_equal(f->name[1], "M");
    for (size_t e = 0; e < f->elements; e++)
        for (int part = 0; part < 2; part++)
            for (int j = 0; j < 6; j++) /* second derivatives lose two digits more */
                assert_true(fabs(f->stress[part][6 * e + (size_t)j] - wanted[part][j]) <
                            (part ? 1e-10 * 1e-4 : 1e-12 * 0.1));
}

/* ---- while a realization is computed ---- */

typedef struct {
    fracas_fields *fields;
    size_t looks, ends;
    double last; /* s */
} watcher;

static fracas_err see(void *context, fracas_batch *batch, const fracas_record *record)
{
    watcher *w = context;
    const double now = fracas_batch_progress(batch, 0).time;
    (void)record;
    assert_true(w->looks == 0 ? now == 0 : now > w->last);
    w->last = now;
    w->looks++;
    if (w->looks % 50 == 0) fracas_batch_fields(batch, 0, w->fields);
    return FRACAS_OK;
}

static fracas_err see_end(void *context, fracas_batch *batch, const fracas_record *record)
{
    watcher *w = context;
    w->ends++;
    fracas_batch_fields(batch, 0, w->fields);
    return see(context, batch, record);
}

/* Fragments' masses, centres and momenta by the nodes, damage and times of interfaces: those of the
 * record. `skip`: the fragment that closes a bar, which the record has one turn aside. */
static void check_record(const fracas_fields *f, const fracas_record *r, int64_t skip)
{
    assert_true(f->time == r->end_time && r->nfragment > 2 && r->ninterface == f->interfaces);
    OWNED double *sum = zeroed(7 * r->nfragment, sizeof *sum);
    for (size_t e = 0; e < f->elements; e++) {
        double *at = sum + 7 * f->fragment[e];
        assert_true(fabs(f->fragment_mass[e] / r->fragment[f->fragment[e]].mass - 1) < 1e-12);
        for (size_t k = e * f->corners; k < (e + 1) * f->corners; k++) {
            at[0] += f->mass[k];
            for (int i = 0; i < 3; i++) {
                at[1 + i] += f->mass[k] * f->place[k][i];
                at[4 + i] += f->mass[k] * f->velocity[k][i];
            }
        }
    }
    for (size_t n = 0; n < r->nfragment; n++) {
        const fracas_fragment *of = &r->fragment[n];
        assert_true(fabs(sum[7 * n] / of->mass - 1) < 1e-12);
        for (int i = 0; i < 3 && (int64_t)n != skip; i++) {
            assert_true(fabs(sum[7 * n + 1 + (size_t)i] / of->mass - of->position[i]) <
                        1e-12 * 0.05);
            assert_true(fabs(sum[7 * n + 4 + (size_t)i] / of->mass - of->velocity[i]) <
                        1e-12 * 1e3);
        }
    }
    for (size_t i = 0; i < f->interfaces; i++) {
        const fracas_interface_row *row = &r->interface[i];
        const double onset[2] = {f->onset_time[i], row->onset_time};
        assert_true(f->damage[i] == row->damage && f->strength[i] == row->strength);
        assert_memory_equal(&onset[0], &onset[1], sizeof onset[0]);
        assert_true(row->damage < 1 || f->opening[i] > 0 || row->break_time < r->end_time);
    }
}

/* A watch at every step sees each once and the end; with it or without, the record is the same. */
static void check_watched(const fracas_spec *spec, bool closed)
{
    OWN(fracas_model) model = distorted_model(*spec, 0, 0);
    watcher w = {.looks = 0};
    OK(fracas_fields_create(model, &w.fields));
    const fracas_batch_watch watch = {.pause = see, .end = see_end, .context = &w, .every = 1};
    fracas_record record[2];
    for (int watched = 0; watched < 2; watched++) {
        const fracas_batch_options options = {.history = 30,
                                              .interfaces = true,
                                              .isa = FRACAS_ISA_BEST,
                                              .watch = watched ? &watch : NULL};
        run_replicas(model, 4, 1, 0.05, options, &record[watched]);
    }
    assert_true(w.ends == 1 && (int64_t)w.looks == record[0].steps + 1 &&
                w.last == record[0].end_time);
    assert_true(record[0].nhistory == record[1].nhistory &&
                record[0].residual == record[1].residual);
    assert_memory_equal(record[0].history, record[1].history,
                        record[0].nhistory * sizeof *record[0].history);
    assert_memory_equal(record[0].fragment, record[1].fragment,
                        record[0].nfragment * sizeof *record[0].fragment);
    const int64_t first = w.fields->fragment[0], last = w.fields->fragment[model->elements - 1];
    check_record(w.fields, &record[1], closed && first == last ? first : -1);
    fracas_fields_destroy(w.fields);
    for (int watched = 0; watched < 2; watched++) fracas_record_clear(&record[watched]);
}

static void fields_are_of_the_record(void **unused)
{
    fracas_spec spec = bar_reference(200, 1e5, 150e-9);
    check_watched(&spec, true);
    spec.geometry.ends = &fracas_ends_free;
    spec.geometry.gap = NAN;
    check_watched(&spec, false);
    spec = ring_reference(200, 1e5, 150e-9);
    check_watched(&spec, false);
    spec = ring_stershic(200, 1e5, 150e-9);
    check_watched(&spec, false);
    for (int which = 0; which < 4; which++) {
        spec = membrane_spec(&fracas_shape_plate, which % 2 + 1, 6);
        spec.geometry.width = spec.geometry.height = 2e-3;
        spec.loading.rate = 1e5;
        spec.time.safety = 0.5;
        spec.time.end = 300e-9;
        if (which >= 2) spec.time.mass = &fracas_mass_consistent;
        check_watched(&spec, false);
    }
    spec = surface_spec(&fracas_formulation_shell, &fracas_shape_sphere);
    spec.geometry.radius = 1.5e-3;
    spec.geometry.thickness = 3e-4;
    spec.mesh.divisions = 2;
    spec.loading.rate = 1e5;
    spec.time.end = 200e-9;
    check_watched(&spec, false);
}

TESTS(a_bar_in_its_background, a_bar_with_an_element_aside, a_ring_grown, a_membrane_stretched,
      a_shell_stretched_and_bent, fields_are_of_the_record)
