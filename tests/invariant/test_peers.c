/* SPDX-License-Identifier: GPL-3.0-or-later */
/* ctest-labels: slow-sanitize */
/* A body computed by several processes together: the bytes of one process, in the leading one's
 * records and checkpoints; none waits for ever for one that is gone. */
#include "campaigns/scheduler/worker/connections.h"
#include "tests/support/lanes.h"
#include "tests/support/shell_cracks.h"
#include "tests/support/test.h"

#include <signal.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PEERS = 5 };

static const lane_kind kind = {.scatter = 0.3};

/* ---- processes ---- */

typedef struct {
    fracas_connections connections;
    fracas_peers peers;
    int64_t left; /* exchanges before this process dies; 0: it does not */
    pid_t pid[PEERS];
} crew;

static fracas_err exchange(void *context, const fracas_parcel *out, const fracas_parcel *in)
{
    crew *c = context;
    if (c->left > 0 && --c->left == 0) _exit(7);
    return fracas_connections_exchange(&c->connections, out, in);
}

/* Forks the others: from here on each process is one peer, 0 the test's. */
static void fork_crew(crew *c, size_t count)
{
    int fd[PEERS][PEERS], pair[2];
    for (size_t a = 0; a < count; a++) {
        fd[a][a] = -1;
        for (size_t b = 0; b < a; b++) {
            assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
            fd[a][b] = pair[0];
            fd[b][a] = pair[1];
        }
    }
    *c = (crew){.connections.count = count, .peers = {count, 0, exchange, c}};
    for (size_t p = 1; p < count; p++) {
        c->pid[p] = fork();
        assert_true(c->pid[p] >= 0);
        if (c->pid[p]) continue;
        c->connections.number = c->peers.number = p;
        break;
    }
    const size_t me = c->peers.number;
    memcpy(c->connections.fd, fd[me], sizeof fd[me]);
    for (size_t a = 0; a < count; a++)
        for (size_t b = 0; b < count; b++)
            if (a != b && a != me) close(fd[a][b]);
}

/* The others end as told; in them, the end. */
static void end_crew(crew *c, bool good)
{
    if (c->peers.number > 0) _exit(good ? 0 : 1);
    fracas_connections_close(&c->connections);
    for (size_t p = 1; p < c->peers.count; p++) {
        int status;
        assert_int_equal(waitpid(c->pid[p], &status, 0), c->pid[p]);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), good ? 0 : p == 1 ? 7 : 1);
    }
}

/* ---- runs ---- */

/* Saves its lanes at one pause, or begins at those on a tape. */
typedef struct {
    lane_tape tape;
    int pauses;
    bool loads;
    bool drifts; /* lane 1 has drifted before it begins, and was sound until step 50 */
    size_t count;
} keeper;

static fracas_err begin(void *context, fracas_batch *batch, fracas_record *record)
{
    keeper *k = context;
    k->tape.at = 0;
    for (size_t l = 0; l < k->count && k->loads; l++)
        OK(fracas_batch_load(batch, l, get_from_tape, &k->tape));
    if (!k->drifts) return FRACAS_OK;
    batch->lane[1].running = false;
    batch->lane[1].guard.final = true;
    batch->lane[1].guard.sound = 50;
    record[1].outcome = FRACAS_ENERGY_DRIFT;
    return FRACAS_OK;
}

static bool is_due(void *context)
{
    keeper *k = context;
    return ++k->pauses == 2 && !k->loads;
}

static fracas_err keep(void *context, fracas_batch *batch, const fracas_record *record)
{
    keeper *k = context;
    for (size_t l = 0; l < k->count; l++) OK(fracas_batch_save(batch, l, put_on_tape, &k->tape));
    return FRACAS_OK;
}

static fracas_err run(const fracas_model *model, size_t count, int parts, crew *c, keeper *k,
                      fracas_record *record)
{
    const fracas_batch_watch watch = {begin, is_due, keep, k};
    OWN(fracas_batch) batch = batch_with(
        model, count,
        (fracas_batch_options){.history = 20,
                               .interfaces = true,
                               .width = count == 1 ? 1 : 8,
                               .isa = FRACAS_ISA_BEST,
                               .parts = parts,
                               .peers = c ? &c->peers : NULL,
                               .watch = c && c->peers.number ? NULL : &watch});
    for (size_t l = 0; l < count; l++) {
        bar_draw(batch, l, kind.scatter, l);
        fracas_record_init(&record[l]);
    }
    return fracas_batch_run(batch, record);
}

static void clear(fracas_record *record, size_t count)
{
    for (size_t l = 0; l < count; l++) fracas_record_clear(&record[l]);
}

/* Two to `most` processes, also from a state of one. */
static void compare(const fracas_model *model, size_t count, size_t most)
{
    fracas_record alone[8], together[8];
    keeper first = {.count = count};
    OK(run(model, count, 1, NULL, &first, alone));
    print_message("%zu elements, %zu lanes: %lld steps, %lld cracked, %lld broken\n",
                  model->elements, count, (long long)alone[0].steps, (long long)alone[0].cracked,
                  (long long)alone[0].broken);
    assert_true(alone[0].broken > 5 && first.tape.size > 0);
    for (size_t peers = 2; peers <= most; peers += peers == 3 ? 2 : 1)
        for (int loads = 0; loads < 2; loads++) {
            crew c;
            keeper k = {.count = count, .loads = loads};
            if (loads) k.tape = first.tape;
            fork_crew(&c, peers);
            /* Others may have other threads. */
            const fracas_err err = run(model, count, c.peers.number == 1 ? 2 : 1, &c, &k, together);
            end_crew(&c, !err);
            OK(err);
            for (size_t l = 0; l < count; l++) assert_same_record(&alone[l], &together[l]);
            clear(together, count);
            if (loads) continue;
            assert_int_equal(k.tape.size, first.tape.size);
            assert_memory_equal(k.tape.byte, first.tape.byte, k.tape.size);
            free(k.tape.byte);
        }
    free(first.tape.byte);
    clear(alone, count);
}

/* Cracks run through the cuts: tests/invariant/test_shell_cracks.c. */
static fracas_spec octant(void)
{
    fracas_spec spec = brittle_shell(&fracas_shape_sphere, 22);
    spec.geometry.part = &fracas_part_octant;
    spec.cohesive.fracture_energy = 50;
    spec.loading.rate = 1e5;
    spec.time.end = 4e-8;
    return spec;
}

static void shells_have_the_same_bytes(void **unused)
{
    OWN(fracas_model) model = distorted_model(octant(), 0.1, 3);
    compare(model, 1, 3);
    compare(model, 3, 2);
    model->tolerance = 5e-6; /* the guard looks beside the ledger, and ends it at step 344 */
    compare(model, 1, 2);
}

/* Of four blocks: one of five processes has no elements. */
static void membranes_have_the_same_bytes(void **unused)
{
    fracas_spec spec = surface_spec(&fracas_formulation_membrane, &fracas_shape_plate);
    spec.geometry.width = 6e-3;
    spec.geometry.height = 5e-3;
    spec.geometry.thickness = 1e-3;
    spec.mesh.divisions = 10;
    spec.mesh.order = 2;
    spec.cohesive.beta = 4;
    spec.loading.rate = 3e4;
    spec.time.end = 4e-7;
    spec.time.safety = 0.5;
    spec.cohesive.friction = 0.3;
    spec.time.integrator = &fracas_integrator_hulbert_chung;
    OWN(fracas_model) model = distorted_model(spec, 0.2, 3);
    compare(model, 1, PEERS);
    compare(model, 8, 3);
}

/* The others compute it again with the leading one. */
static void a_drift_before_the_start_is_known_to_all(void **unused)
{
    fracas_record alone[3], together[3];
    keeper k = {.count = 3, .drifts = true};
    crew c;
    OWN(fracas_model) model = distorted_model(octant(), 0.1, 3);
    OK(run(model, 3, 1, NULL, &k, alone));
    assert_int_equal(alone[1].steps, 50);
    free(k.tape.byte);
    k = (keeper){.count = 3, .drifts = true};
    fork_crew(&c, 2);
    const fracas_err err = run(model, 3, 1, &c, &k, together);
    end_crew(&c, !err);
    OK(err);
    for (size_t l = 0; l < 3; l++) assert_same_record(&alone[l], &together[l]);
    free(k.tape.byte);
    clear(alone, 3);
    clear(together, 3);
}

/* As from another build, or another library of mathematics. */
static void another_body_is_refused(void **unused)
{
    crew c;
    fracas_record record;
    keeper k = {.count = 1};
    fracas_spec spec = octant();
    fork_crew(&c, 2);
    if (c.peers.number == 1) spec.material.density = nextafter(spec.material.density, 0);
    OWN(fracas_model) model = distorted_model(spec, 0.1, 3);
    const fracas_err err = run(model, 1, 1, &c, &k, &record);
    if (c.peers.number == 1)
        _exit(err == FRACAS_ENVIRONMENT && strstr(fracas_message(), "another body") ? 0 : 1);
    end_crew(&c, true);
    assert_int_equal(err, FRACAS_ENVIRONMENT);
    fracas_record_clear(&record);
    free(k.tape.byte);
}

/* One dies at its first exchange, in the middle, or in the last steps: the others fail. */
static void a_death_ends_all(void **unused)
{
    OWN(fracas_model) model = distorted_model(octant(), 0.1, 3);
    for (int64_t left = 1; left < 1000; left *= 10) {
        crew c;
        fracas_record record;
        keeper k = {.count = 1};
        fork_crew(&c, 3);
        c.left = c.peers.number == 1 ? left : 0;
        const fracas_err err = run(model, 1, 1, &c, &k, &record);
        end_crew(&c, false);
        assert_int_equal(err, FRACAS_ENVIRONMENT);
        assert_has(fracas_message(), "for one body is gone");
        fracas_record_clear(&record);
        free(k.tape.byte);
    }
}

TESTS(shells_have_the_same_bytes, membranes_have_the_same_bytes,
      a_drift_before_the_start_is_known_to_all, another_body_is_refused, a_death_ends_all)
