/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Edges of a mesh file, by the names of its groups: which of them hold a body, move it or load it,
 * and with what force (docs/theory/probes.md). */
#include "tests/support/batch.h"
#include "tests/support/campaign_text.h"

#include "campaigns/plan/point_model.h"

enum { STRIPS = 7, COLUMNS = 3, PERIODS = 25 };
#define LENGTH 40e-3
#define THICKNESS 1e-3
#define GRAVITY 9.81
#define PULL 3000.0

static double width(int strip)
{
    return (4 + strip) * 1e-3;
}

/* Strips side by side, parts of one body, along x: the wall of strip k, at its left end, is in the
 * group k, "wall k", and of the last one in `last`. The right end of that one is "pull", 8. */
static char *strips_file(int last)
{
    FILE *out = text_begin();
    const int row = COLUMNS + 1, cells = 2 * COLUMNS * STRIPS;
    fprintf(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%d\n", STRIPS + 1);
    for (int k = 1; k <= STRIPS; k++) fprintf(out, "1 %d \"wall %d\"\n", k < STRIPS ? k : last, k);
    fprintf(out, "1 8 \"pull\"\n$EndPhysicalNames\n$Nodes\n%d\n", 2 * row * STRIPS);
    for (int k = 1; k <= STRIPS; k++)
        for (int side = 0; side < 2; side++)
            for (int i = 0; i < row; i++)
                fprintf(out, "%d %.17g %.17g 0\n", row * (2 * (k - 1) + side) + i + 1,
                        LENGTH * i / COLUMNS, 0.02 * k + side * width(k));
    fprintf(out, "$EndNodes\n$Elements\n%d\n", cells + STRIPS + 1);
    for (int k = 1, number = 1; k <= STRIPS; k++) {
        const int low = 2 * row * (k - 1) + 1, high = low + row;
        for (int i = 0; i < COLUMNS; i++, number += 2)
            fprintf(out, "%d 2 0 %d %d %d\n%d 2 0 %d %d %d\n", number, low + i, low + i + 1,
                    high + i + 1, number + 1, low + i, high + i + 1, high + i);
        fprintf(out, "%d 1 2 %d 1 %d %d\n", cells + k, k < STRIPS ? k : last, low, high);
        if (k == STRIPS)
            fprintf(out, "%d 1 2 8 1 %d %d\n", cells + k + 1, low + COLUMNS, high + COLUMNS);
    }
    fprintf(out, "$EndElements\n");
    return text_end(out);
}

/* A membrane that does not break, held by `keys` of `geometry`, for a number of periods of a strip:
 * 4 L/c, c^2 = E/rho. */
static fracas_campaign *campaign_of(const char *mesh, const char *keys, const char *loading,
                                    double periods)
{
    char path[40], text[2000];
    make_path(path);
    write_bytes(path, mesh, strlen(mesh));
    snprintf(text, sizeof text,
             "name: groups\nseed: 7\nmodel: membrane\n"
             "geometry: {shape: file, file: %s, thickness: %g%s}\nmesh: {spacing: given}\n"
             "material: {young: 70 GPa, poisson: 0.25, density: 2700}\n"
             "cohesive: {fracture_energy: 1e9}\nstrength: {minimum: 1e9, scale: 1e7, shape: 2}\n"
             "loading: %s\ntime: {end: %.9g}\nreplicas: 1\noutput: {reactions: edges}\n",
             path, THICKNESS, keys, loading, periods * 4 * LENGTH / sqrt(70e9 / 2700));
    fracas_campaign *campaign = read_text(text);
    unlink(path);
    return campaign;
}

static void run(const fracas_campaign *campaign, fracas_record *record)
{
    OWN(fracas_model) model = NULL;
    OK(fracas_point_model_create(campaign, 0, &model));
    OWN(fracas_batch) batch = batch_with(
        model, 1, (fracas_batch_options){.width = 1, .history = 2000, .reactions = true});
    for (size_t k = 0; k < strengths_of(model); k++) bar_set_strength(batch, 0, k, 1e9);
    OK(fracas_batch_run(batch, record));
    assert_int_equal(record->broken, 0);
    assert_true(fabs(record->residual) <= 1e-11 * record->work); /* round-off of some 1e4 steps */
}

/* Means over time of the forces of an edge, by the trapezoid, and the largest of each. */
typedef struct {
    double mean[3], largest[3];
} forces;

static forces forces_of(const fracas_record *record, int64_t edge)
{
    forces of = {{0}, {0}};
    const fracas_reaction_row *before = NULL;
    const double end = record->history[record->nhistory - 1].time;
    for (size_t n = 0; n < record->nreaction; n++) {
        const fracas_reaction_row *row = &record->reaction[n];
        if (row->edge != edge) continue;
        for (int i = 0; i < 3; i++) {
            of.largest[i] = fmax(of.largest[i], fabs(row->force[i]));
            if (before)
                of.mean[i] += 0.5 * (row->force[i] + before->force[i]) *
                              (row->time - before->time) / end;
        }
        before = row;
    }
    return of;
}

/* Bits of the edges with rows. */
static unsigned edges_of(const fracas_record *record)
{
    unsigned edges = 0;
    for (size_t n = 0; n < record->nreaction; n++) edges |= 1u << record->reaction[n].edge;
    return edges;
}

static double weight(int strip)
{
    return 2700 * GRAVITY * LENGTH * width(strip) * THICKNESS;
}

#define HANGING "[{type: body-force, x: 9.81}, {type: traction, edge: pull, normal: 3 kPa}]"

/* Each strip hangs by its own wall. The mean force of a wall is the weight, of the last strip with
 * the traction on its end, but for the momentum at the end: below that of the first quarter of a
 * period, so within 1 % after 25 periods. Walls that slide hold nothing along themselves. */
static void each_wall_holds_its_strip(void **unused)
{
    static const char keys[] = ", wall 1: fixed, wall 2: held, wall 3: sliding, wall 4: fixed, "
                               "wall 5: held, wall 6: sliding, wall 7: fixed";
    OWNED char *mesh = strips_file(STRIPS);
    OWN(fracas_campaign) campaign = campaign_of(mesh, keys, HANGING, PERIODS);
    RECORD(record);
    run(campaign, &record);
    assert_int_equal(edges_of(&record), 0xfe);
    for (int k = 1; k <= STRIPS; k++) {
        const forces of = forces_of(&record, k);
        const double pulled = weight(k) + (k == STRIPS ? PULL * width(k) * THICKNESS : 0);
        print_message("wall %d: mean %.5f of the load, along it %.2e\n", k, of.mean[0] / pulled,
                      of.largest[1] / pulled);
        assert_true(fabs(of.mean[0] / pulled + 1) < 0.01);
        assert_true((of.largest[1] == 0) == (k % 3 == 0) && of.largest[2] == 0);
    }
}

/* Groups 5 to 8 without a key are held as all others, and their forces are those of all others; a
 * key that says the same parts the force, and changes no bit of the rest. */
static void groups_without_a_key_are_all_others(void **unused)
{
    static const char *const keys[] = {", edges: fixed", ", edges: fixed, wall 6: fixed"};
    static const unsigned edges[] = {1u << 0, 1u << 0 | 1u << 6};
    OWNED char *mesh = strips_file(STRIPS);
    fracas_record record[2];
    for (int i = 0; i < 2; i++) {
        OWN(fracas_campaign) campaign = campaign_of(mesh, keys[i], "{type: body-force, x: 9.81}",
                                                    1);
        fracas_record_init(&record[i]);
        run(campaign, &record[i]);
        assert_int_equal(edges_of(&record[i]), edges[i]);
    }
    const forces all = forces_of(&record[0], 0), others = forces_of(&record[1], 0),
                 sixth = forces_of(&record[1], 6);
    print_message("all %.6e, others %.6e, wall 6 %.6e N\n", all.mean[0], others.mean[0],
                  sixth.mean[0]);
    assert_true(sixth.largest[0] > 0); /* a sum of some hundred terms in another order */
    assert_true(fabs(others.mean[0] + sixth.mean[0] - all.mean[0]) < 1e-13 * fabs(all.mean[0]));
    assert_memory_equal(&record[0], &record[1], offsetof(fracas_record, nfragment));
    for (int i = 0; i < 2; i++) fracas_record_clear(&record[i]);
}

/* Two groups without a key in `geometry`, both free, move apart: each has its force, and no other
 * edge has any. By symmetry of the load, at rest in the end: their means are equal and opposite
 * but for the momentum, as above. */
static void groups_move_by_their_names(void **unused)
{
    static const char loading[] = "{type: edge-motion, edge: pull, second_edge: wall 7, "
                                  "displacement: 1 um, rise: 40 us}";
    OWNED char *mesh = strips_file(STRIPS);
    OWN(fracas_campaign) campaign = campaign_of(mesh, "", loading, PERIODS);
    RECORD(record);
    run(campaign, &record);
    assert_int_equal(edges_of(&record), 1u << 7 | 1u << 8);
    const forces wall = forces_of(&record, 7), pull = forces_of(&record, 8);
    print_message("wall 7: %.6e, pull: %.6e N\n", wall.mean[0], pull.mean[0]);
    assert_true(pull.mean[0] > 0 && fabs(wall.mean[0] / pull.mean[0] + 1) < 0.01);
}

/* Of a group without a key a refusal says how all others are held. */
static void a_moved_group_is_held_as_all_others(void **unused)
{
    static const char loading[] = "{type: edge-motion, edge: pull, direction: along, "
                                  "displacement: 1 um, rise: 40 us}";
    OWNED char *mesh = strips_file(STRIPS);
    OWN(fracas_campaign) campaign = campaign_of(mesh, ", edges: sliding", loading, 1);
    fracas_model *model = NULL;
    FAILS(fracas_point_model_create(campaign, 0, &model), FRACAS_USAGE,
          "loading moves the edge edge_8 in a direction in which geometry, where it is sliding, "
          "does not hold it");
}

/* A group 33 is none of the load's, which is edge 1: tags are bits below 9 alone. */
static void groups_beyond_the_keys_stay(void **unused)
{
    static const char loading[] = "{type: edge-motion, edge: wall 1, displacement: 1 um, "
                                  "rise: 40 us}";
    OWNED char *mesh = strips_file(33);
    OWN(fracas_campaign) campaign = campaign_of(mesh, "", loading, 1);
    RECORD(record);
    run(campaign, &record);
    assert_int_equal(edges_of(&record), 1u << 1);
}

TESTS(each_wall_holds_its_strip, groups_without_a_key_are_all_others, groups_move_by_their_names,
      a_moved_group_is_held_as_all_others, groups_beyond_the_keys_stay)
