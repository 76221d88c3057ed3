/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/plan/forecast.h"

#include "engine/cohesive/law.h"
#include "engine/loading/initial.h"
#include "engine/loading/loading.h"
#include "engine/mesh/body.h"
#include "engine/mesh/make.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Largest resolved element size over E G_c/sigma_c^2, the softening length of a crack. */
#define COARSE 0.5
/* Wave speeds sqrt(E/rho) of solids, from rubber to diamond [m/s]. */
#define SLOWEST 10.0
#define FASTEST 2.5e4
/* Largest turn of a ring with initial opening directions [rad]: 1 - cos is 5e-5. */
#define TURNED 0.01

/* Remedy for a load too weak to crack the body. */
static const char *harder(const fracas_point *point, const fracas_forecast *forecast)
{
    if (fracas_loading_is_idle(&point->spec)) return "raise what initial gives, or load the body";
    if (!fracas_loading_traits_of(&point->spec)->released)
        return forecast->stress_grows ? "load it harder, or longer"
                                      : "load it harder; a longer run does not help";
    return point->spec.time.end < forecast->turn ? "raise its velocity or time.end"
                                                 : "a free ring swings back: raise its velocity";
}

typedef struct {
    char text[80];
} remedy;

/* Remedy for a mesh too coarse for a crack's softening. */
static remedy finer(const fracas_spec *spec, const fracas_forecast *forecast)
{
    const double times = forecast->coarseness / COARSE;
    remedy made;
    if (!fracas_spec_is_surface(spec))
        snprintf(made.text, sizeof made.text, "raise mesh.elements to %.0f",
                 ceil((double)forecast->elements * times));
    else if (fracas_spacing_of(spec)->from_file)
        snprintf(made.text, sizeof made.text, "give a mesh with edges %.3g times shorter", times);
    else if (spec->mesh.size > 0)
        snprintf(made.text, sizeof made.text, "lower mesh.size to %.2g m", spec->mesh.size / times);
    else
        snprintf(made.text, sizeof made.text, "raise mesh.divisions to %.0f",
                 ceil((double)spec->mesh.divisions * times));
    return made;
}

static double wave_speed(const fracas_material *material)
{
    return sqrt(material->young / material->density);
}

/* A fracas_plan_warning: its condition, how bad it is (> 0), and its text as printf writes it. */
#define WARNING(name, condition, badness, ...)                                                 \
    static double name(const fracas_point *point, const fracas_forecast *forecast, char *text, \
                       size_t size)                                                            \
    {                                                                                          \
        (void)point, (void)forecast;                                                           \
        if (!(condition)) return 0;                                                            \
        snprintf(text, size, __VA_ARGS__);                                                     \
        return badness;                                                                        \
    }

WARNING(
    warn_coarse, forecast->coarseness > COARSE, forecast->coarseness,
    "elements are %.3g E G_c/sigma_c^2 long, above %.1g a crack's softening is not resolved: %s",
    forecast->coarseness, COARSE, finer(&point->spec, forecast).text)

WARNING(warn_uniform, forecast->uniform, 1,
        "%s interfaces %sare equally strong and qualify at once; where the body breaks is then up "
        "to mesh and rounding: give the strength a scatter%s",
        forecast->equal ? "all" : "half of the", forecast->equal ? "" : "or more ",
        fracas_strength_scatter_remedy(&point->strength))

WARNING(warn_lines, forecast->lines, 1,
        "interfaces are equally strong and the mesh is regular, so that cracks follow its lines: "
        "give mesh.amplitude, for instance 0.2")

/* Fracture energies of ceramics, glasses, rocks and brittle polymers are below it [J/m2]; metals
 * have 5e3 to 1e5, most of it plastic work. */
#define TOUGH 2e3

static double toughness(const fracas_point *point, const fracas_forecast *forecast)
{
    return fracas_spec_fracture_energy(&point->spec, forecast->mean);
}

WARNING(
    warn_tough, toughness(point, forecast) > TOUGH, toughness(point, forecast) / TOUGH,
    "a fracture energy of %.3g kJ/m2 is a metal's or a tough polymer's, and nothing flows here: "
    "bodies are elastic until they crack (docs/limits.md): is cohesive.%s in the unit meant?",
    1e-3 * toughness(point, forecast),
    point->spec.cohesive.fracture_energy > 0 ? "fracture_energy" : "critical_opening")

/* Both ends of a notch are given, and in one place. y and z of models without them are 0. */
static bool notch_is_a_point(const fracas_notch *notch)
{
    bool given = !isnan(notch->to[0]);
    for (int i = 0; i < 3; i++) {
        const double from = isnan(notch->from[i]) ? 0 : notch->from[i];
        if (!isnan(notch->to[i]) && notch->to[i] != from) return false;
        given = given || (!isnan(notch->to[i]) && notch->to[i] != 0);
    }
    return given;
}

WARNING(warn_notch, notch_is_a_point(&point->spec.notch), 1,
        "both ends of the notch are in one place, so that nothing is broken from the start: move "
        "them apart (a bar or ring breaks the interface nearest to the line between them)")

/* Finds wrong units of young and density, which no other check compares. */
WARNING(warn_wave,
        wave_speed(&point->spec.material) < SLOWEST || wave_speed(&point->spec.material) > FASTEST,
        fabs(log(wave_speed(&point->spec.material) / sqrt(SLOWEST * FASTEST))),
        "waves go at sqrt(young/density) = %.3g m/s, in solids at %.3g to %.3g: are material.young "
        "[Pa] and material.density [kg/m3] in the units meant? A bare number is SI",
        wave_speed(&point->spec.material), SLOWEST, FASTEST)

/* Outward speed of a ring or sphere [m/s]; NaN of others. */
static double expansion(const fracas_spec *spec)
{
    return fabs(fracas_spec_strain_rate(spec)) *
           (spec->geometry.radius > 0 ? spec->geometry.radius : NAN);
}

WARNING(warn_fast, expansion(&point->spec) > wave_speed(&point->spec.material),
        expansion(&point->spec) / wave_speed(&point->spec.material),
        "the body grows at %.3g m/s, faster than waves go in it, %.3g m/s: are geometry.radius, "
        "loading and material in the units meant? A bare number is SI",
        expansion(&point->spec), wave_speed(&point->spec.material))

WARNING(
    warn_weak_load, forecast->bound < forecast->mean, forecast->mean - forecast->bound,
    "until time.end the stress stays below %.3g MPa, the mean strength is %.3g MPa: the weakest "
    "interfaces will crack, or none: %s",
    1e-6 * forecast->bound, 1e-6 * forecast->mean, harder(point, forecast))

WARNING(warn_repeated, forecast->repeated, (double)point->replicas,
        "its strengths are those of a file, so all its %" PRId64
        " replicas are equal: give it replicas: 1",
        point->replicas)

WARNING(
    warn_folds, forecast->folds, 1,
    "the whole ring comes under compression, where it folds, with next to no bending stiffness: "
    "what breaks then means nothing: load it outward, and end a free ring that stays whole by "
    "%.3g s",
    2 * forecast->turn)

WARNING(warn_zone, forecast->zone_covers_ring, fracas_law_zone(&point->spec.cohesive),
        "cohesive.zone is longer than half of the ring: once an interface opens, none else can: "
        "shorten it to less than a quarter of a fragment")

/* Laws without flux soften from the stress at the end of the step:
 * docs/decisions/onset-of-surfaces.md. */
WARNING(warn_passed, forecast->spread > 0 && forecast->step_stress > 0.25 * forecast->spread,
        forecast->step_stress / forecast->spread,
        "one time step adds %.3g Pa of stress, and nearly all strengths lie within %.3g Pa: "
        "interfaces that a step passes together are equally strong; lower time.safety %.2g times",
        forecast->step_stress, forecast->spread, 4 * forecast->step_stress / forecast->spread)

WARNING(
    warn_step, forecast->step_stress > forecast->mean, forecast->step_stress / forecast->mean,
    "one time step adds %.3g Pa of stress, more than the mean strength of %.3g Pa: are strength, "
    "material and loading in the units meant? A bare number is SI",
    forecast->step_stress, forecast->mean)

WARNING(warn_turned, forecast->turned > TURNED, forecast->turned,
        "the ring turns by %.2g rad until time.end, and geometry.direction is initial: interfaces "
        "that open along directions it no longer has are off from %.2g rad on: leave direction "
        "out, for current",
        forecast->turned, TURNED)

WARNING(
    warn_short,
    point->strength.covariance && point->strength.correlation_length < forecast->element / 3,
    forecast->element / point->strength.correlation_length,
    "strength.correlation_length is %.3g m, less than a third of an element of %.3g m: strengths "
    "are as good as independent: is that in m? A bare number is SI",
    point->strength.correlation_length, forecast->element)

WARNING(warn_long,
        point->strength.covariance && point->strength.correlation_length > forecast->extent,
        point->strength.correlation_length / forecast->extent,
        "strength.correlation_length is %.3g m, more than the %.3g m of the body: strengths of a "
        "replica are much alike, and differ from replica to replica: is that in m? A bare number "
        "is SI",
        point->strength.correlation_length, forecast->extent)

WARNING(warn_flat, forecast->flat, 1,
        "strength.factor is the same at all interfaces: the body does not reach where %s changes "
        "along %s: are its coordinates in m?",
        point->strength.factor->path, point->strength.factor_along->name)

/* It cracks, and no strength of the weakest part breaks. */
static bool never_breaks(const fracas_forecast *forecast)
{
    return forecast->unbroken && !(forecast->bound < forecast->mean);
}

/* delta_c in words. */
static const char *opening_of(const fracas_point *point)
{
    if (point->spec.cohesive.critical_opening > 0) return "critical_opening";
    return fracas_law_fullness(&point->spec.cohesive) == 0.5
               ? "2 fracture_energy/strength"
               : "delta_c, by fracture_energy and the law,";
}

WARNING(
    warn_never, never_breaks(forecast) && !forecast->whole, forecast->opening / forecast->available,
    "where strength.factor is %.2g interfaces break at an opening of %s "
    "= %.2g m, and until time.end the load opens none by more than %.2g m: they crack and never "
    "break: raise the least factor to %.2g%s, or give a smaller fracture_energy",
    forecast->factor, opening_of(point), forecast->opening, forecast->available,
    forecast->factor * forecast->opening / forecast->available,
    forecast->opening_grows ? ", or time.end" : "")

/* The key of the first load: how hard it is, by its first number. */
static remedy load_key(const fracas_spec *spec)
{
    remedy made = {"what initial gives"};
    int n = 0;
    while (n < FRACAS_LOADINGS &&
           !(fracas_loading_at(spec, n) && fracas_loading_at(spec, n)->type->nparams > 0))
        n++;
    if (n == FRACAS_LOADINGS) return made;
    const fracas_kind *load = fracas_loading_at(spec, n)->type;
    size_t k = 0;
    while (k + 1 < load->nparams && load->params[k].type != FRACAS_REAL) k++;
    snprintf(made.text, sizeof made.text, "%s.%s", fracas_loading_sections[n].name,
             load->params[k].name);
    return made;
}

WARNING(
    warn_whole, never_breaks(forecast) && forecast->whole, forecast->opening / forecast->available,
    "interfaces break at an opening of %s = %.2g m, and until time.end the load opens none by more "
    "than %.2g m: they crack and never break: is %s meant? A bare number is SI; or raise "
    "%s%s",
    opening_of(point), forecast->opening, forecast->available,
    point->spec.cohesive.fracture_energy > 0 ? "cohesive.fracture_energy in the unit (J/m2, kJ/m2)"
                                             : "cohesive.critical_opening in the unit (m, um)",
    forecast->opening_grows ? "time.end or " : "", load_key(&point->spec).text)

double fracas_plan_warn_unbroken(const fracas_point *point, const fracas_forecast *forecast,
                                 char *text, size_t size)
{
    return warn_whole(point, forecast, text, size);
}

/* A warning has said why already. */
static bool is_explained(const fracas_forecast *forecast)
{
    return forecast->bound < forecast->mean || forecast->unbroken;
}

WARNING(warn_intact,
        forecast->tried > 0 && forecast->intact == forecast->tried && !is_explained(forecast), 1,
        "nothing breaks in %d realization%s computed just now: load it harder or longer, unless "
        "that is meant: is %s in its unit? A bare number is SI",
        forecast->tried, forecast->tried == 1 ? "" : "s", load_key(&point->spec).text)

WARNING(warn_lost, forecast->tried > 0 && forecast->lost == forecast->tried, 1,
        "%d realization%s computed just now end%s without a result: is %s in "
        "its unit? A bare number is SI; or lower time.safety",
        forecast->tried, forecast->tried == 1 ? "" : "s", forecast->tried == 1 ? "s" : "",
        load_key(&point->spec).text)

/* Largest size of fragments over an element's at which a weak part breaks everywhere: 45 % of its
 * interfaces at 0.36 (13 % of the others), 10 % at 0.8, on a plate with a strip across. */
#define CRUSHED 0.5

WARNING(
    warn_shatters,
    point->spec.cohesive.critical_opening > 0 && forecast->pieces < CRUSHED * forecast->element &&
        forecast->pieces >= CRUSHED * cbrt(forecast->factor) * forecast->element,
    forecast->element / forecast->pieces,
    "where strength.factor is %.2g the fracture energy, strength critical_opening/2, is as many "
    "times smaller: fragments of %.2g m, less than half an element of %.2g m: that part "
    "shatters: give fracture_energy, which stays the same, or raise the least factor to %.2g",
    forecast->factor, forecast->pieces, forecast->element,
    pow(CRUSHED * forecast->element / forecast->pieces, 3) * forecast->factor)

#define OF_THE_MESH                                                            \
    "set strength.reference_volume: %.6g mm3, an interface's, with which the " \
    "strengths of this mesh stay as they are"

WARNING(
    warn_mesh_effect, forecast->mesh_effect > FRACAS_MESH_EFFECT_NOTABLE, forecast->mesh_effect,
    "strengths scatter by %.2g %% from interface to interface without a reference size: halving "
    "the elements lowers the count by about %.1f %%: " OF_THE_MESH,
    100 * forecast->scatter, 100 * forecast->mesh_effect, 1e9 * forecast->volume)

WARNING(
    warn_mesh_effect_bounded, forecast->mesh_effect_bounded > 0, forecast->scatter,
    "strengths scatter by %.2g %% above a least strength from interface to interface without a "
    "reference size: halving the elements moves the count by up to %.0f %%, of `uniform` mostly "
    "up: " OF_THE_MESH,
    100 * forecast->scatter, 100 * forecast->mesh_effect_bounded, 1e9 * forecast->volume)

/* Fewer resolve no wave, let alone a crack. */
#define FEW_STEPS 10

WARNING(warn_few_steps, forecast->steps < FEW_STEPS, 1 / (1.0 + (double)forecast->steps),
        "time.end %g s is reached in %" PRId64 " time step%s of %.3g s: are time.end, material and "
        "lengths in the units meant? A bare number is SI",
        point->spec.time.end, forecast->steps, forecast->steps == 1 ? "" : "s", forecast->time_step)

#define MANY_STEPS 100000000

WARNING(warn_many_steps, forecast->steps > MANY_STEPS, (double)forecast->steps,
        "time.end %g s takes up to %.2g time steps of %.3g s: are time.end, material and lengths "
        "in the units meant? A bare number is SI",
        point->spec.time.end, (double)forecast->steps, forecast->time_step)

WARNING(warn_bending, fracas_bending_steps(&point->spec, forecast->element) > 2,
        fracas_bending_steps(&point->spec, forecast->element),
        "elements of %.2g m are small against the thickness of %.2g m, and bending waves limit the "
        "time step: time.rotary_inertia: 1 makes it about %.1f times as long",
        forecast->element, point->spec.geometry.thickness,
        fracas_bending_steps(&point->spec, forecast->element))

/* Correlated neighbours leave the body fewer independent flaws than its volume suggests. */
WARNING(warn_weakest,
        fracas_strength_has_size_effect(&point->strength) && point->strength.covariance, 1,
        "strengths are correlated, and their size effect is that of independent flaws: the body "
        "gets stronger as its mesh is refined: leave one of the two out, or compare on one mesh")

WARNING(warn_open, fracas_law_of(&point->spec)->open_ledger, 1,
        "law %s gains or loses energy on mixed paths: its ledger does not close, and no "
        "ENERGY_DRIFT ends its runs: it is for comparison; for results give law: nitsche",
        point->spec.cohesive.law->name)

/* Transits of a fragment from which counts are looked at as final  (settled.7). */
#define LONG_RUN 20

WARNING(warn_heats,
        fracas_law_of(&point->spec)->flux && forecast->transits > LONG_RUN &&
            point->spec.time.safety > forecast->long_safety,
        point->spec.time.safety / forecast->long_safety,
        "until time.end a wave crosses a fragment some %.2g times; in so long a run steps of %g of "
        "the critical one heat the fragments: time.safety: %g keeps the energy balance, at %.2g "
        "times the steps",
        forecast->transits, point->spec.time.safety, forecast->long_safety,
        point->spec.time.safety / forecast->long_safety)

WARNING(warn_undivided, !forecast->estimated && forecast->parts > (int64_t)forecast->parts_most,
        (double)forecast->parts / (double)forecast->parts_most,
        "a body of %" PRId64 " elements is computed in %zu part%s at most, and parallel.parts is "
        "%" PRId64 ": cores stay idle: leave parallel.parts out",
        forecast->elements, forecast->parts_most, forecast->parts_most == 1 ? "" : "s",
        forecast->parts)

/* ---- mesh files ---- */

typedef struct {
    char text[140];
} group_name;

static group_name name_of(const fracas_surface_group *group)
{
    group_name made;
    const char *quote = *group->name ? "\"" : "";
    snprintf(made.text, sizeof made.text, "%" PRId32 "%s%s%s%s", group->number,
             *group->name ? " " : "", quote, group->name, quote);
    return made;
}

/* "5 "top" and 2 more" */
static group_name loose_names(const fracas_forecast *forecast)
{
    group_name made = name_of(&forecast->loose);
    const size_t length = strlen(made.text);
    if (forecast->nloose > 1)
        snprintf(made.text + length, sizeof made.text - length, " and %zu more",
                 forecast->nloose - 1);
    return made;
}

WARNING(
    warn_loose, forecast->loose.number, 1,
    "edges of the mesh file's physical group %s are held as geometry.edges says: the keys "
    "edge_1 to edge_8, and names, are those of the groups 1 to 8: hold the group by its own, or "
    "give it one of these numbers",
    loose_names(forecast).text)

WARNING(warn_unheld, forecast->unheld, 1,
        "geometry.edges, `%s`, holds no edge: all are of the mesh file's physical groups 1 to 8, "
        "which have keys of their own, by name or edge_1 to edge_8",
        point->spec.geometry.edge[0]->name)

WARNING(warn_heading, forecast->doubted && * forecast->doubts.unit, 1,
        "%s: a heading has the unit `%s`, but the numbers are taken as SI, in m, s or Pa: convert "
        "them, or mend the heading",
        forecast->doubted, forecast->doubts.unit)

WARNING(warn_shuffled, forecast->doubted && forecast->doubts.line > 0, 1,
        "%s:%" PRId64 ": the column `interface` is not in order, and is not read: strengths are "
        "those of the interfaces line by line: sort the lines",
        forecast->doubted, forecast->doubts.line)

WARNING(
    warn_inner, forecast->inner.number, 1,
    "lines of the mesh file's physical group %s lie inside the body: their edges are "
    "interfaces as all others, on which the group has no effect: a line-force or point-force can "
    "load it by its key edge_1 to edge_8; for a notch, double its nodes: Gmsh's Plugin(Crack)",
    name_of(&forecast->inner).text)

typedef struct {
    char text[200];
} doubled;

static doubled doubled_of(const fracas_surface_survey *mesh)
{
    doubled made = {"if it is to be one body, mesh it as one"};
    if (mesh->doubled)
        snprintf(made.text, sizeof made.text,
                 "%zu node%s of different parts are in one position: " FRACAS_SURFACE_JOIN,
                 mesh->doubled, mesh->doubled == 1 ? "" : "s");
    return made;
}

WARNING(warn_parts, forecast->mesh.parts > 1, (double)forecast->mesh.parts,
        "the mesh file has %zu parts without a common edge, so the body is in as many pieces "
        "before anything breaks; %s",
        forecast->mesh.parts, doubled_of(&forecast->mesh).text)

WARNING(warn_hanging, forecast->mesh.hanging, (double)forecast->mesh.hanging,
        "%zu node%s of the mesh file hang%s on edges of elements that do not have %s: the body is "
        "slit there: refine both sides of an edge, or mesh the body anew",
        forecast->mesh.hanging, forecast->mesh.hanging == 1 ? "" : "s",
        forecast->mesh.hanging == 1 ? "s" : "", forecast->mesh.hanging == 1 ? "it" : "them")

/* Largest side of a body that may be meant in mm [m]. */
#define LARGE 0.5

static double largest_side(const fracas_surface_survey *mesh)
{
    return fmax(mesh->box[0], fmax(mesh->box[1], mesh->box[2]));
}

WARNING(warn_unit, !point->spec.geometry.unit && largest_side(&forecast->mesh) >= LARGE,
        largest_side(&forecast->mesh),
        "the mesh file makes a body of %.4g by %.4g by %.4g m: is it in %s? Then give "
        "geometry.unit: %s, else geometry.unit: m",
        forecast->mesh.box[0], forecast->mesh.box[1], forecast->mesh.box[2],
        fracas_surface_likely_unit(largest_side(&forecast->mesh)),
        fracas_surface_likely_unit(largest_side(&forecast->mesh)))

/* 25 % of the edges of an isotropic mesh lie in three of twelve directions. */
#define STEERED 0.45
#define FEW_EDGES 200 /* an isotropic mesh of fewer may have so many in three directions */

WARNING(warn_steered, forecast->mesh.steered > STEERED && forecast->interfaces >= FEW_EDGES,
        forecast->mesh.steered,
        "%.0f %% of the length of the mesh file's edges lies in three directions 15 degrees wide: "
        "cracks will follow them: mesh it anew, by Gmsh's Mesh.Algorithm = 5",
        100 * forecast->mesh.steered)

/* An expansion whose third rate nobody has chosen. */
static bool stretches_alike(const fracas_spec *spec)
{
    const fracas_stretch stretch = fracas_loading_stretch(spec, 0);
    return stretch.moving && isnan(stretch.ratio_z);
}

WARNING(warn_stretch,
        forecast->mesh.box[2] > 0 && !forecast->mesh.round && stretches_alike(&point->spec), 1,
        "the load moves each point by its place, along x, y and z, and the mesh file's body is no "
        "sphere about the origin: of %.3g by %.3g by %.3g m it grows along all three, a cylinder "
        "along its axis as well: give loading.ratio or ratio_z, 0 for none along y or z",
        forecast->mesh.box[0], forecast->mesh.box[1], forecast->mesh.box[2])

/* Share of the initial stress on outer edges to be let go without a word, as in corners. */
#define LET_GO 0.1

WARNING(
    warn_released, forecast->released > LET_GO,
    forecast->released *fracas_initial_stress(&point->spec),
    "the body starts with a stress of %.3g MPa, and no edge keeps %.0f %% of its tractions on the "
    "outer edges: there it springs back, and waves swing between that and its opposite: hold "
    "edges (geometry) along and across it, or load them",
    1e-6 * fracas_initial_stress(&point->spec), 100 * forecast->released)

/* Strains are small: docs/limits.md. */
#define LARGE_STRAIN 0.2

WARNING(warn_strained,
        fracas_spec_is_surface(&point->spec) &&
            fracas_initial_largest_strain(&point->spec) >= LARGE_STRAIN,
        fracas_initial_largest_strain(&point->spec),
        "the body starts with a strain of %.3g %%, and fracas takes strains as small, below %.0f "
        "%%: are strain, stress or temperature of initial, and material.young, in the units meant? "
        "A bare number is SI",
        100 * fracas_initial_largest_strain(&point->spec), 100 * LARGE_STRAIN)

/* Strain v/(2 c) of waves from the rim of a region with velocity v; 0 without a rim. */
static double rim_strain(const fracas_point *point, const fracas_forecast *forecast)
{
    return fracas_initial_parts(&point->spec.initial)
               ? forecast->started / (2 * wave_speed(&point->spec.material))
               : 0;
}

WARNING(warn_started,
        forecast->started > wave_speed(&point->spec.material) ||
            rim_strain(point, forecast) >= LARGE_STRAIN,
        forecast->started / wave_speed(&point->spec.material),
        "the body starts at up to %.3g m/s, and waves go in it at %.3g m/s: where that velocity "
        "ends, or an edge is held, it strains by %.0f %% and more, and fracas takes strains as "
        "small: are velocity, radial or spin of initial, and material, in the units meant? A bare "
        "number is SI",
        forecast->started, wave_speed(&point->spec.material),
        50 * forecast->started / wave_speed(&point->spec.material))

WARNING(
    warn_begun,
    fracas_spec_is_surface(&point->spec) && fracas_initial_effective(&point->spec) > forecast->mean,
    fracas_initial_effective(&point->spec) / forecast->mean,
    "the body starts with %.3g MPa on its interfaces, the mean strength is %.3g MPa: interfaces "
    "crack at once, and the energy that falls off then is in no ledger: start below, and load "
    "it further",
    1e-6 * fracas_initial_effective(&point->spec), 1e-6 * forecast->mean)

fracas_plan_warning *const fracas_plan_warnings[FRACAS_PLAN_WARNINGS] = {
    warn_parts,       warn_unit,
    warn_hanging,     warn_coarse,
    warn_uniform,     warn_lines,
    warn_weak_load,   warn_repeated,
    warn_folds,       warn_zone,
    warn_step,        warn_turned,
    warn_passed,      warn_short,
    warn_long,        warn_flat,
    warn_weakest,     warn_wave,
    warn_bending,     warn_few_steps,
    warn_never,       warn_shatters,
    warn_mesh_effect, warn_open,
    warn_heats,       warn_undivided,
    warn_loose,       warn_inner,
    warn_steered,     warn_stretch,
    warn_fast,        warn_whole,
    warn_many_steps,  warn_mesh_effect_bounded,
    warn_tough,       warn_notch,
    warn_released,    warn_begun,
    warn_strained,    warn_started,
    warn_unheld,      warn_heading,
    warn_shuffled,    warn_intact,
    warn_lost};
