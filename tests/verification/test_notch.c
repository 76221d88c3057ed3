/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* Surfaces with interfaces that are broken from the start, against parts that fly, meshes with
 * doubled nodes and the stress intensity of an edge crack (docs/theory/meshes.md). */
#include "engine/mesh/notch.h"
#include "tests/support/listed_laws.h"
#include "tests/support/loads.h"
#include "tests/support/membrane_elastic.h"
#include "tests/support/notched.h"
#include "tests/support/shell.h"
#include "tests/support/test.h"

/* G_c [J/m2] and strength [Pa] of membranes that never crack. */
#define TOUGH 1e6
#define STRONG 5e9

/* `contact: none` */
static void pass_through(fracas_notch *notch)
{
    for (size_t p = 0; p < fracas_notch_section.nparams; p++)
        if (strcmp(fracas_notch_section.params[p].name, "contact") == 0)
            fracas_param_set(&fracas_notch_section.params[p], notch, 1);
    assert_false(fracas_notch_touches(notch));
}

/* ---- a surface cut in two ---- */

typedef struct {
    double momentum[3], scale; /* kg m/s */
    double right;              /* of the right part, along x */
    double moved;              /* largest displacement of the right part [m] */
} motion;

static bool is_right(const fracas_model *model, size_t e)
{
    double x = 0;
    for (size_t k = 0; k < 3; k++) x += node_at(model, e, k)[0];
    return x > 0;
}

static motion motion_of(const fracas_batch *batch)
{
    const fracas_model *model = batch->model;
    const size_t size = element_unknowns(model),
                 dimension = (size_t)tables_of(model)->body->dimension;
    motion m = {.scale = 0};
    for (size_t u = 0; u < unknowns_of(model); u++) {
        const double p = mass_of(model, u) * *value_of(batch, u, SURFACE_V);
        m.momentum[u % size % dimension] += p;
        m.scale += fabs(p);
        if (!is_right(model, u / size)) continue;
        m.moved = fmax(m.moved, fabs(*value_of(batch, u, SURFACE_U)));
        if (u % size % dimension == 0) m.right += p;
    }
    return m;
}

/* The left part of a plate cut at x = 0, all of it, flies away (-1) or against the right one (1).
 */
static motion fly(fracas_spec spec, double way)
{
    fracas_model *model = NULL;
    spec.notch = (fracas_notch){.from = {0, -spec.geometry.height / 2},
                                .to = {0, spec.geometry.height / 2}};
    spec.loading.rate = 0;
    if (way > 1) pass_through(&spec.notch);
    model = distorted_model(spec, 0, 0);
    one_run run = begin_run(model, 1, spec.cohesive.fracture_energy > 1e9 ? 1e6 : STRONG);
    assert_true(model->nnotch >= (size_t)spec.mesh.divisions);
    const double c = model->wave_speed, speed = 1e-4 * c;
    const size_t size = element_unknowns(model),
                 dimension = (size_t)tables_of(model)->body->dimension;
    double pushed = 0;
    for (size_t u = 0; u < unknowns_of(model); u++) {
        if (u % size % dimension != 0 || is_right(model, u / size)) continue;
        *value_of(run.batch, u, SURFACE_V) = way * speed;
        pushed += way * speed * mass_of(model, u);
    }
    const int steps = (int)(spec.geometry.width / c / model->time_step);
    double worst = 0, dissipated = 0;
    motion now = {.scale = 0};
    for (int s = 0; s < steps && run.running; s++) {
        step_run(&run);
        now = motion_of(run.batch);
        worst = fmax(worst, fabs(now.momentum[0] - pushed));
        for (size_t i = 1; i < dimension; i++) worst = fmax(worst, fabs(now.momentum[i]));
        dissipated = fmax(dissipated, fabs(run.batch->lane[0].ledger.dissipated));
    }
    const fracas_ledger *ledger = &run.batch->lane[0].ledger;
    assert_true(run.running && run.batch->step.cracked[0] == 0 && run.batch->step.broken[0] == 0);
    assert_true(run.batch->lane[0].census.all == 2 && dissipated == 0);
    assert_true(worst < 1e-12 * now.scale);
    assert_true(ledger->largest_residual < 0.02 * ledger->initial);
    now.right /= pushed;
    clear_run(&run);
    return now;
}

/* Apart, the right part does not move at all; 2^-400 of contact's stiffness do not move it either.
 * Pressed, it takes all the momentum in the time that a wave needs across both halves, as a bar
 * that hits its like does: plane stress spreads waves, and faces bounce a little, so 0.2 of it may
 * be missing. */
static void check_parts(const char *what, const fracas_spec *spec)
{
    const motion apart = fly(*spec, -1), pressed = fly(*spec, 1), through = fly(*spec, 2);
    print_message("[  figures ] %s, %s, order %d, friction %g: %.3f of the momentum passes on\n",
                  what, spec->cohesive.law->name, (int)spec->mesh.order, spec->cohesive.friction,
                  pressed.right);
    assert_true(apart.moved == 0 && apart.right == 0 && through.moved < 1e-90);
    assert_true(fabs(pressed.right - 1) < 0.2);
}

static void a_cut_plate_is_two_plates(void **unused)
{
    for (int k = 0; k < 4 * MEMBRANE_LAWS; k++) {
        fracas_spec spec = membrane_spec(&fracas_shape_plate, 1 + k / MEMBRANE_LAWS % 2, 6);
        set_listed_law(&spec, k);
        spec.geometry.height = spec.geometry.width;
        spec.cohesive.friction = k < 2 * MEMBRANE_LAWS ? 0 : 0.3;
        spec.cohesive.beta = 5;
        spec.cohesive.fracture_energy = TOUGH;
        spec.time.safety = 0.2;
        spec.time.end = 1;
        check_parts("membrane", &spec);
    }
}

static void a_cut_shell_is_two_shells(void **unused)
{
    for (int k = 0; law_of_model(MODEL_SHELL, k); k++) {
        fracas_spec spec = shell_spec(&fracas_shape_plate);
        spec.mesh.divisions = 6;
        spec.geometry.thickness = 0.02;
        spec.cohesive.law = &law_of_model(MODEL_SHELL, k)->kind;
        set_own_numbers(&spec.cohesive, OWN_DEFAULT);
        spec.time.safety = 0.2;
        check_parts("shell", &spec);
    }
}

/* ---- doubled nodes ---- */

#define TIP (-1e-9) /* of the crack x = 0, y <= 0 */
static bool below(const double a[3], const double b[3])
{
    return fabs(a[0]) < 1e-9 && fabs(b[0]) < 1e-9 && fmax(a[1], b[1]) < 1e-9;
}
static bool beyond(const double middle[3])
{
    return middle[0] > 0;
}
static bool tip(const double node[3])
{
    return node[1] > TIP;
}

/* A plate from a file, which flies apart as if it were whole: its stress grows everywhere alike and
 * opens the crack from the first step on, until waves from its edges are there. Or it shrinks, and
 * the faces of the crack pass through each other. */
static fracas_model *moving_file(const fracas_attachment *mesh, int order, bool shrinks, bool line)
{
    fracas_spec spec = membrane_spec(&fracas_shape_file, order, 0);
    spec.mesh = (fracas_mesh){.spacing = &fracas_spacing_given};
    spec.geometry.file = mesh;
    spec.cohesive.beta = 5;
    spec.cohesive.fracture_energy = TOUGH;
    spec.time.end = 1;
    if (line) spec.notch = (fracas_notch){.from = {0, -5e-3}, .to = {NAN, 0}};
    if (shrinks) spec.loading.rate *= -1;
    if (shrinks) pass_through(&spec.notch);
    return distorted_model(spec, 0, 0);
}

/* Displacements of all elements after `steps`, by their numbers in the file. */
static double *displace(fracas_model *model, int steps, double step, double *energy)
{
    model->time_step = step;
    one_run run = begin_run(model, 1, STRONG);
    const size_t size = element_unknowns(model);
    double *u = zeroed(size * model->elements, sizeof *u);
    double touched = 0;
    for (int s = 0; s < steps; s++) {
        step_run(&run);
        touched = fmax(touched, run.batch->lane[0].ledger.cohesive);
    }
    for (size_t e = 0; e < model->elements; e++)
        for (size_t i = 0; i < size; i++)
            u[size * (size_t)(model->surface->given[e] - 1) + i] = *value_at(run.batch, e,
                                                                             SURFACE_U, i);
    const fracas_ledger *l = &run.batch->lane[0].ledger;
    *energy = l->elastic + l->kinetic;
    assert_true(l->dissipated == 0 && touched < 1e-20 * l->elastic);
    assert_true(run.batch->step.cracked[0] == 0);
    clear_run(&run);
    return u;
}

/* Doubled nodes, a group of lines in the file, a line: the largest difference of displacements. */
static void compare_ways(int order, bool shrinks, double time)
{
    static const char *const name[] = {"notch", "notch", "another"};
    OWN(a_surface) mesh = surface_of(SHAPE_RECTANGLE, (const double[2]){12e-3, 10e-3},
                                     &(fracas_surface_fineness){.divisions = 10, .order = order});
    double *u[3], energy[3], largest = 0, step = 0, off[3] = {0};
    size_t count = 0;
    for (int way = 0; way < 3; way++) {
        char *text = write_cracked(mesh, &(crack_file){below, way == 0, beyond, tip, name[way]});
        const fracas_attachment file = {.path = "mesh", .text = text, .size = strlen(text)};
        fracas_model *model = moving_file(&file, order, shrinks, way == 2);
        free(text);
        assert_int_equal(model->nnotch, way == 0 ? 0 : 5);
        count = unknowns_of(model);
        if (way == 0) step = model->time_step;
        u[way] = displace(model, (int)(time / step), step, &energy[way]);
    }
    for (size_t i = 0; i < count; i++) {
        largest = fmax(largest, fabs(u[0][i]));
        for (int way = 1; way < 3; way++) off[way] = fmax(off[way], fabs(u[way][i] - u[0][i]));
    }
    print_message("[  figures ] order %d, %s: displacements within %.1e, %.1e\n", order,
                  shrinks ? "shrinking" : "growing", off[1] / largest, off[2] / largest);
    for (int way = 1; way < 3; way++) {
        assert_true(off[way] < 1e-11 * largest);
        assert_close(energy[way], energy[0], 1e-11);
    }
    for (int way = 0; way < 3; way++) free(u[way]);
}

/* The same motion of the same triangles. Round-off: sums in another order, over 100 to 400 steps:
 * 1e-11 of the largest displacement. */
static void a_notch_is_doubled_nodes(void **unused)
{
    for (int order = 1; order <= 2; order++) {
        compare_ways(order, false, 0.6e-6);
        compare_ways(order, true, 2e-6);
    }
}

/* ---- stress intensity of an edge crack ---- */

#define WIDTH 20e-3
#define PULL 1e6 /* Pa */

/* Elastic energy of a plate twice as high as wide, its foot fixed, pulled slowly at its top, with a
 * crack of a/WIDTH = depth across the middle of its left side; mean over a period of bending. */
static double energy_with(double depth, int64_t divisions)
{
    static const fracas_kind top = {"top", ""};
    fracas_spec spec = membrane_spec(&fracas_shape_plate, 2, divisions);
    spec.geometry.width = WIDTH;
    spec.geometry.height = 2 * WIDTH;
    spec.geometry.edge[3] = &fracas_edge_fixed;
    spec.cohesive.beta = 5;
    spec.cohesive.fracture_energy = TOUGH;
    spec.time.safety = 0.6;
    spec.notch = (fracas_notch){.from = {-WIDTH / 2}, .to = {(depth - 0.5) * WIDTH}};
    const double passage = WIDTH / sqrt(spec.material.young / spec.material.density),
                 bending = 2 * M_PI / 3.516 * 4 * sqrt(12) * passage, rise = 2 * bending;
    spec.loading = bare_load(&fracas_loading_traction);
    spec.loading.edge = &top;
    *load_number(&spec.loading, "normal") = PULL;
    spec.loading.rise = rise;
    spec.time.end = 1;
    one_run run = begin_run(distorted_model(spec, 0, 0), 1, STRONG);
    double sum = 0, count = 0;
    while (run.batch->step.time[0] < rise + bending) {
        step_run(&run);
        if (run.batch->step.time[0] < rise) continue;
        sum += run.batch->lane[0].ledger.elastic + run.batch->lane[0].ledger.cohesive;
        count++;
    }
    assert_true(run.batch->step.cracked[0] == 0);
    assert_int_equal(run.model->nnotch, lround(depth * (double)divisions));
    clear_run(&run);
    return sum / count;
}

/* K = s sqrt(pi a) F(a/W), F of a strip that may turn, within 0.5 % (Brown and Srawley); energy
 * released by da is K^2/E da, of a plate of thickness 1 mm. */
static double released(double from, double to)
{
    enum { STEPS = 100 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double a = from + (to - from) * (i + 0.5) / STEPS;
        const double f = 1.122 - a * (0.231 - a * (10.55 - a * (21.71 - a * 30.38)));
        sum += PULL * PULL * M_PI * a * WIDTH * f * f / 320e9 * (to - from) * WIDTH / STEPS;
    }
    return sum * 1e-3;
}

/* Under a given load the elastic energy grows by what is released. The singularity costs a share of
 * h/a: the error halves with h, and is 3 % of the difference at h = W/20. */
static void an_edge_crack_releases_energy(void **unused)
{
    const double exact = released(0.2, 0.3);
    double error[2];
    for (int fine = 0; fine < 2; fine++)
        error[fine] =
            (energy_with(0.3, fine ? 20 : 10) - energy_with(0.2, fine ? 20 : 10)) / exact - 1;
    print_message("[  figures ] energy released from a/W = 0.2 to 0.3, less the strip's: %.1f, "
                  "%.1f %%\n",
                  100 * error[0], 100 * error[1]);
    assert_true(fabs(error[1]) < 0.05);
}

TESTS(a_cut_plate_is_two_plates, a_cut_shell_is_two_shells, a_notch_is_doubled_nodes,
      an_edge_crack_releases_energy)
