/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/farm.h"

#include "tests/simulator/descriptors.h"
#include "tests/simulator/engine.h"
#include "tests/simulator/machine.h"
#include "tests/simulator/oracle.h"

#include "base/hash.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

struct farm farm;

static struct {
    process *user; /* the present `fracas run` */
    int starts, most_starts;
    bool finished;
    int64_t ended; /* when the user looked last */
} watch;

static const double LOOK = 4000; /* s between two looks of the user */

int farm_host(const process *p)
{
    return p->role >= RANK ? p->number % farm.hosts : 0;
}

/* ---- the user ---- */

static void user_main(void *argument)
{
    fracas_run_facts facts;
    (void)argument;
    const fracas_err err = fracas_run(&farm.options, 0, NULL, &facts);
    trace("the run ends with %d: %s", (int)err, err ? fracas_message() : "");
    if (err == FRACAS_USAGE || err == FRACAS_DAMAGED || err == FRACAS_BUG)
        broken("the run ends with status %d: %s", (int)err, fracas_message());
    fracas_run_facts_clear(&facts);
    process_end(world.current, (int)err << 8);
}

static bool any_living(void)
{
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive) return true;
    return false;
}

/* Another program version has left a checkpoint, or its bytes have rotted. */
static void spoil_one(void)
{
    node *folder = disk_find(DISK_ROOT "/study/" FRACAS_CHECKPOINTS);
    if (!folder || !folder->nentries || any_living()) return;
    const entry *e = &folder->entry[roll_below(DICE_FAULT, folder->nentries)];
    node *n = e->to;
    const size_t size = n->size, least = sizeof(fracas_checkpoint_head) + FRACAS_OWN_SEAL;
    const uint64_t how = roll_below(DICE_FAULT, 3);
    if (size < 2 * least) return;
    OWNED char *bytes = malloc(size);
    if (!bytes) abort();
    memcpy(bytes, n->data, size);
    if (how == 0) bytes[roll_below(DICE_FAULT, size)] ^= 4;
    if (how == 2) {
        bytes[offsetof(fracas_checkpoint_head, version)]++;
        engine_spoil(bytes + sizeof(fracas_checkpoint_head));
    }
    disk_truncate(n, 0);
    disk_write(n, 0, bytes,
               how == 0   ? size
               : how == 1 ? roll_below(DICE_FAULT, size)
                          : size - FRACAS_OWN_SEAL);
    const int fd = descriptor_new((descriptor){.file = n});
    if (how == 2 && fracas_disk_append_seal(fd, e->name)) trace("the disk is full");
    descriptor_shut(fd);
    disk_sync(n);
    trace("FAULT: checkpoint %s is %s", e->name,
          how == 2   ? "of another version"
          : how == 1 ? "cut short"
                     : "damaged");
}

static void start(void *what, uint64_t number)
{
    (void)what, (void)number;
    if (watch.user && watch.user->alive) return;
    if (farm.faults > 0 && chance(DICE_FAULT, 0.2)) spoil_one();
    if (++watch.starts > watch.most_starts) broken("%d starts, and no end", watch.starts);
    watch.user = process_start(USER_RUN, 0, NULL, user_main, NULL);
    trace("THE USER STARTS %s", process_name(watch.user));
}

void farm_user_ended(const process *p)
{
    const int status = WIFEXITED(p->status) ? WEXITSTATUS(p->status) : -1;
    watch.finished |= status == FRACAS_OK || status == FRACAS_SOME_FAILED;
    if (p != watch.user) return;
    /* On a network disk a lock torn by a power cut may be another host's: the user looks. */
    farm.options.force = status == FRACAS_IN_USE && !any_living();
    const double patience = status == FRACAS_IN_USE ? 10 : 1;
    const double rest = patience * roll_between(DICE_FARM, 0.5, 100);
    if (!watch.finished) world_at(world.now + rest, start, NULL, 0);
}

void farm_power_failed(void)
{
    world_at(world.now + roll_between(DICE_FARM, 10, 100), start, NULL, 0);
}

static bool any_frozen(void)
{
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive && isinf(world.process[i]->frozen_until)) return true;
    return false;
}

/* Nothing has happened for long: the user ends hung processes; without any, the farm fails. */
static void look(void *what, uint64_t number)
{
    (void)what, (void)number;
    const bool moved = oracle_ended() > watch.ended;
    watch.ended = oracle_ended();
    world_at(world.now + LOOK, look, NULL, 0);
    if (moved) return;
    if (!any_frozen()) broken("nothing has been done for %g s", LOOK);
    trace("THE USER ENDS WHAT HANGS");
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive) process_end(world.process[i], SIGKILL);
    world_at(world.now + 10, start, NULL, 0);
}

/* ---- its faults ---- */

static process *pick(role as)
{
    size_t count = 0;
    process *found = NULL;
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive && world.process[i]->role == as &&
            chance(DICE_FAULT, 1.0 / (double)++count))
            found = world.process[i];
    return found;
}

static void kill_one(void)
{
    static const role roles[] = {LEASE_CHILD, SERVER, SERVER, SERVER,  KEEPER,
                                 RANK,        RANK,   MPIRUN, USER_RUN};
    process *p = pick(roles[roll_below(DICE_FAULT, sizeof roles / sizeof *roles)]);
    if (!p || (p->role == LEASE_CHILD && !oracle_may_hurt(p))) return;
    const bool later = p->main && p->role != LEASE_CHILD && chance(DICE_FAULT, 0.7);
    if (later) p->doom = 1 + (int)roll_below(DICE_FAULT, 60);
    p->hurt = true;
    trace("FAULT: %s is killed%s", process_name(p), later ? " soon" : "");
    if (!later) process_end(p, SIGKILL);
}

static void freeze_one(void)
{
    static const role roles[] = {LEASE_CHILD, SERVER, SERVER, RANK, RANK};
    process *p = pick(roles[roll_below(DICE_FAULT, sizeof roles / sizeof *roles)]);
    if (!p || p->frozen_until > world.now) return;
    if (p->role == LEASE_CHILD && !oracle_may_hurt(p)) return;
    const bool for_ever = chance(DICE_FAULT, 0.2);
    p->hurt = true;
    p->frozen_until = for_ever ? INFINITY : world.now + roll_between(DICE_FAULT, 0.1, 30);
    trace("FAULT: %s hangs until %g", process_name(p), p->frozen_until);
}

static void jump(void)
{
    double by = roll_between(DICE_FAULT, 0.1, 20);
    if (!farm.jumped && chance(DICE_FAULT, 0.2)) {
        by = roll_between(DICE_FAULT, 20, 1e5);
        farm.jumped = true;
    }
    world.skew += by;
    farm.jumps += by;
    world.day += by + 1e4 * (roll(DICE_FAULT) - 0.5);
    trace("FAULT: the clock jumps by %g s", by);
}

static void calm(void *what, uint64_t number)
{
    (void)what, (void)number;
    world.delay = 1;
}

static void slow_messages(void)
{
    world.delay = roll_between(DICE_FAULT, 1, 300);
    world_at(world.now + roll_between(DICE_FAULT, 1, 60), calm, NULL, 0);
    trace("FAULT: messages take %g times as long", world.delay);
}

static void ask_to_end(void)
{
    process *p = watch.user;
    if (!p || !p->alive) return;
    trace("FAULT: a signal asks to end");
    machine_signal(p, chance(DICE_FAULT, 0.5) ? SIGINT : SIGUSR1);
    if (chance(DICE_FAULT, 0.2)) machine_signal(p, SIGINT);
}

/* Somebody runs the same command beside the present run. */
static void run_another(void)
{
    trace("FAULT: another run starts: %s",
          process_name(process_start(USER_RUN, 0, NULL, user_main, NULL)));
}

static void befall(void *mean, uint64_t number)
{
    (void)number;
    if (farm.faults-- <= 0) return;
    switch (roll_below(DICE_FAULT, 13)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4: kill_one(); break;
    case 5:
    case 6: freeze_one(); break;
    case 7:
        world.blackout = 1 + (int)roll_below(DICE_FAULT, 300);
        trace("FAULT: the power will fail");
        break;
    case 8:
        disk.full_until = world.now + roll_between(DICE_FAULT, 0.1, 60);
        trace("FAULT: the disk is full until %g", disk.full_until);
        break;
    case 9:
        disk.slow_until = world.now + roll_between(DICE_FAULT, 1, 60);
        trace("FAULT: the disk is slow until %g", disk.slow_until);
        break;
    case 10: chance(DICE_FAULT, 0.5) ? jump() : slow_messages(); break;
    case 11: ask_to_end(); break;
    default: run_another(); break;
    }
    world_at(world.now - *(double *)mean * log(roll(DICE_FAULT)), befall, mean, 0);
}

/* ---- a farm ---- */

static void draw(int workers)
{
    static const int widths[] = {0, 1, 4, 8};
    const bool many = workers >= 100;
    farm.kind =
        &farm_campaign[many ? MOST_CAMPAIGNS - 1 : roll_below(DICE_FARM, MOST_CAMPAIGNS - 1)];
    farm.hosts = chance(DICE_FARM, 0.5) ? 2 + (int)roll_below(DICE_FARM, 5) : 1;
    const bool is_long = !many && chance(DICE_FARM, 0.3);
    farm.seconds = is_long ? roll_between(DICE_FARM, 2, 60)
                           : roll_between(DICE_FARM, 0.02, many ? 5 : 2);
    fracas_run_options *o = &farm.options;
    fracas_run_options_init(o);
    o->file = DISK_ROOT "/campaign.yaml";
    o->study = DISK_ROOT "/study";
    o->jobs = workers ? workers : 2 + (int)roll_below(DICE_FARM, 15);
    o->width = widths[roll_below(DICE_FARM, 4)];
    o->isa = FRACAS_ISA_BEST;
    o->shuffle = chance(DICE_FARM, 0.2);
    o->isolation = chance(DICE_FARM, 0.3) ? FRACAS_ISOLATION_NONE : FRACAS_ISOLATION_LEASE;
    o->lease_seconds = roll_between(DICE_FARM, 0.1, 5);
    o->segment_age = roll_between(DICE_FARM, 0.1, 20);
    o->lease_limit = 450; /* the longest twice, and a slow disk */
    o->checkpoint_seconds = roll_between(DICE_FARM, 0.01, 1) * farm.seconds;
    if (!is_long && farm.kind->cursed == 0 && chance(DICE_FARM, 0.1))
        o->walltime = roll_between(DICE_FARM, 30, 200);
}

/* After status 0 study.h5 has the bytes of the undisturbed one. */
static void check_study(void)
{
    const node *n = disk_find(DISK_ROOT "/study/study.h5");
    campaign_kind *kind = farm.kind;
    if (!n || !disk_is_durable(DISK_ROOT "/study/study.h5")) broken("study.h5 is not there");
    const uint64_t checksum = fracas_checksum_of(n->data, n->size);
    if (!kind->bytes) {
        kind->bytes = n->size;
        kind->checksum = checksum;
    }
    if (n->size != kind->bytes || checksum != kind->checksum)
        broken("study.h5 has other bytes than that of an undisturbed run");
}

/* Nor is any checkpoint left. */
static void check_checkpoints(void)
{
    const node *folder = disk_find(DISK_ROOT "/study/" FRACAS_CHECKPOINTS);
    if (folder && folder->nentries) broken("checkpoint %s is left behind", folder->entry[0].name);
}

/* How long it takes undisturbed, about [s]. */
static double expected(void)
{
    double replicas = 0;
    for (size_t p = 0; p < farm.kind->read->npoints; p++)
        replicas += (double)farm.kind->read->table.point[p].replicas;
    return 2 + farm.seconds * replicas / farm.options.jobs;
}

/* Processes that heard too late of the end may leave a checkpoint: the next run removes it. */
static void end_late_ones(void)
{
    const double end = world.now + 100;
    farm.faults = 0;
    if (!any_living()) return;
    while (any_living() && world.now < end && world_step())
        ;
    for (size_t i = 0; i < world.nprocesses; i++)
        if (world.process[i]->alive) process_end(world.process[i], SIGKILL);
    watch.finished = false;
    watch.ended = -1;
    start(NULL, 0);
    while (!watch.finished)
        if (!world_step()) broken("nothing is left to happen");
    check_study();
    while (any_living() && world_step())
        ;
}

uint64_t farm_run(uint64_t seed, int workers, int64_t faults, bool tracing)
{
    static double mean;
    world_begin(seed, tracing);
    memset(&watch, 0, sizeof watch);
    memset(&farm, 0, sizeof farm);
    draw(workers);
    disk_begin(chance(DICE_FARM, 0.2));
    const node *n = disk_make(farm.options.file, false);
    disk_write((node *)(uintptr_t)n, 0, farm.kind->text, strlen(farm.kind->text));
    disk_sync(disk.root);
    disk_sync((node *)(uintptr_t)n);
    oracle_begin(farm.kind->read);
    farm.faults = (int64_t)roll_between(DICE_FARM, 0.5, 40);
    if (faults >= 0 && faults < farm.faults) farm.faults = faults;
    watch.most_starts = 60 + 5 * (int)farm.faults;
    mean = expected() * roll_between(DICE_FARM, 0.01, 0.5);
    trace("%d workers, campaign %zu, %lld faults, %s disk", farm.options.jobs,
          (size_t)(farm.kind - farm_campaign), (long long)farm.faults,
          disk.network ? "network" : "local");
    start(NULL, 0);
    world_at(LOOK, look, NULL, 0);
    world_at(mean * roll(DICE_FAULT), befall, &mean, 0);
    while (!watch.finished)
        if (!world_step()) broken("nothing is left to happen");
    check_study();
    end_late_ones();
    check_checkpoints();
    trace("ends after %llu events, %d starts", (unsigned long long)world.events, watch.starts);
    return fracas_checksum_of(&world.drawn, sizeof world.drawn) ^ world.events;
}
