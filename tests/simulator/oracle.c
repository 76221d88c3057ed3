/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "tests/simulator/oracle.h"

#include "tests/simulator/calls.h"
#include "tests/simulator/farm.h"

#include "base/version.h"
#include "campaigns/scheduler/director/state.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/store/checkpoint.h"
#include "campaigns/store/file/disk.h"
#include "campaigns/store/index/index.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_HOLDS = 4, MOST_HURT = 1 };
static const double OVERDUE = 10; /* s after which a lease may be given to a second worker */

/* A realization with a server. */
typedef struct {
    const process *server;
    uint64_t lease;
    size_t place; /* in the lease */
    double since; /* by the monotonic clock */
} hold;

typedef struct {
    bool ended;   /* done, or failed for good */
    bool written; /* its record is durable */
    int hurt;     /* attempts lost to faults */
    hold hold[MOST_HOLDS];
    size_t next;
} realization;

static struct {
    const fracas_campaign *campaign;
    realization **of; /* by point and replica */
    int64_t *room;    /* replicas of each point */
    int64_t ended;
    char **segment; /* names in the index */
    size_t nsegments, segments_room;
    const run *run; /* the holder of the study */
    double asked;   /* when the scheduler chose the present lease [s] */
} oracle;

static realization *of(uint64_t point, int64_t replica)
{
    if (replica < 0 || replica >= oracle.room[point])
        broken("replica %lld of point %llu", (long long)replica, (unsigned long long)point);
    return &oracle.of[point][replica];
}

static uint64_t point_of(const fracas_hash *hash)
{
    for (size_t p = 0; p < oracle.campaign->npoints; p++)
        if (fracas_hash_equal(&oracle.campaign->point[p].hash, hash)) return p;
    broken("a row of no point");
}

void oracle_begin(const fracas_campaign *campaign)
{
    memset(&oracle, 0, sizeof oracle);
    oracle.campaign = campaign;
    oracle.of = calloc(campaign->npoints, sizeof *oracle.of);
    oracle.room = calloc(campaign->npoints, sizeof *oracle.room);
    for (size_t p = 0; oracle.of && oracle.room && p < campaign->npoints; p++) {
        const fracas_point_row *row = &campaign->table.point[p];
        oracle.room[p] = row->most > row->replicas ? row->most : row->replicas;
        oracle.of[p] = calloc((size_t)oracle.room[p], sizeof **oracle.of);
        if (!oracle.of[p]) abort();
    }
}

void oracle_power_failed(void)
{
    oracle.run = NULL;
}

int64_t oracle_ended(void)
{
    return oracle.ended;
}

static void note_end(uint64_t point, int64_t replica)
{
    realization *r = of(point, replica);
    oracle.ended += !r->ended;
    r->ended = true;
}

bool oracle_may_hurt(const process *child)
{
    for (int pass = 0; pass < 2; pass++)
        for (size_t p = 0; p < oracle.campaign->npoints; p++)
            for (int64_t i = 0; i < oracle.room[p]; i++) {
                realization *r = of(p, i);
                for (size_t h = 0; h < MOST_HOLDS; h++) {
                    if (!r->hold[h].server || r->hold[h].server->pid != child->parent) continue;
                    if (pass) r->hurt++;
                    else if (r->hurt >= MOST_HURT) return false;
                    break;
                }
            }
    return true;
}

/* ---- leases ---- */

/* The server has it still: it lives, and has not given it back. */
static bool holds(const hold *h)
{
    return h->server && h->server->alive && !h->server->gave_up && h->server->run == oracle.run;
}

/* A first part of a lease may be done when its server dies, or is late with the rest. */
static bool may_be_in_part(const realization *r, uint64_t lease)
{
    for (size_t h = 0; h < MOST_HOLDS; h++) {
        const hold *held = &r->hold[h];
        const bool late = held->lease == lease && oracle.asked - held->since >= OVERDUE;
        if (held->server && held->server->run == oracle.run && (late || !holds(held))) return true;
    }
    return false;
}

static void lease_one(const process *server, const fracas_lease *lease, size_t i)
{
    const int64_t replica = lease->replica[i];
    realization *r = of(lease->point, replica);
    const double now = oracle.asked;
    if (r->ended && !may_be_in_part(r, lease->id))
        broken("replica %lld of point %llu is leased, and is done", (long long)replica,
               (unsigned long long)lease->point);
    for (size_t h = 0; h < MOST_HOLDS; h++)
        if (holds(&r->hold[h]) && now - r->hold[h].since < OVERDUE)
            broken("replica %lld of point %llu is leased to rank %d, and %s has had it for %.3f s",
                   (long long)replica, (unsigned long long)lease->point, server->number,
                   process_name(r->hold[h].server), now - r->hold[h].since);
    r->hold[r->next++ % MOST_HOLDS] = (hold){server, lease->id, i, now};
}

fracas_err __real_fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, double now,
                                        fracas_lease *lease, bool *given);
fracas_err __wrap_fracas_scheduler_next(fracas_scheduler *scheduler, size_t worker, double now,
                                        fracas_lease *lease, bool *given)
{
    oracle.asked = now;
    return __real_fracas_scheduler_next(scheduler, worker, now, lease, given);
}

void __real_fracas_scheduler_overdue(fracas_scheduler *scheduler, size_t worker, double now,
                                     fracas_lease *lease, size_t *late, bool *given);
void __wrap_fracas_scheduler_overdue(fracas_scheduler *scheduler, size_t worker, double now,
                                     fracas_lease *lease, size_t *late, bool *given)
{
    oracle.asked = now;
    __real_fracas_scheduler_overdue(scheduler, worker, now, lease, late, given);
}

fracas_err __real_fracas_director_post(fracas_director *director, size_t worker,
                                       fracas_packet_kind kind, const void *body, size_t size);
fracas_err __wrap_fracas_director_post(fracas_director *director, size_t worker,
                                       fracas_packet_kind kind, const void *body, size_t size)
{
    struct servers *servers = &world.current->run->servers[worker];
    const fracas_lease *lease = body;
    trace("message %d to rank %zu", (int)kind, worker);
    if (kind == FRACAS_PACKET_FRESH) servers->known++;
    if (kind == FRACAS_PACKET_LEASE) {
        trace("  lease %llu: %llu of point %llu from replica %lld", (unsigned long long)lease->id,
              (unsigned long long)lease->count, (unsigned long long)lease->point,
              (long long)lease->replica[0]);
        for (size_t i = 0; i < lease->count; i++)
            lease_one(servers->started[servers->known], lease, i);
    }
    return __real_fracas_director_post(director, worker, kind, body, size);
}

/* A server gives back all behind the first `kept` of a lease. */
static void give_back(const fracas_lease_failure *failure)
{
    for (size_t p = 0; p < oracle.campaign->npoints; p++)
        for (int64_t i = 0; i < oracle.room[p]; i++)
            for (size_t h = 0; h < MOST_HOLDS; h++) {
                hold *held = &of(p, i)->hold[h];
                if (held->server == world.current && held->lease == failure->lease &&
                    held->place >= failure->kept)
                    *held = (hold){0};
            }
}

/* A process of the server's, or itself, has met a fault. */
static bool is_hurt(const process *server)
{
    bool hurt = server->hurt || farm.jumps > 100;
    for (size_t i = 0; i < world.nprocesses && !hurt; i++)
        hurt = world.process[i]->parent == server->pid && world.process[i]->hurt;
    return hurt;
}

static void check_failure(const fracas_lease_failure *failure)
{
    bool sound = true;
    for (size_t p = 0; p < oracle.campaign->npoints; p++)
        for (int64_t i = 0; i < oracle.room[p]; i++)
            for (size_t h = 0; h < MOST_HOLDS; h++) {
                const hold *held = &of(p, i)->hold[h];
                if (held->server == world.current && held->lease == failure->lease &&
                    held->place >= failure->kept && held->place < failure->kept + failure->count)
                    sound &= farm_curse(p, i) == SOUND;
            }
    if (sound && !is_hurt(world.current))
        broken("a lease of sound realizations fails: %s", failure->reason);
}

fracas_err __real_fracas_packet_send(int fd, fracas_packet_kind kind, const void *body,
                                     size_t size);
fracas_err __wrap_fracas_packet_send(int fd, fracas_packet_kind kind, const void *body, size_t size)
{
    process *p = world.current;
    trace("sends message %d", (int)kind);
    if (p->role == SERVER && kind == FRACAS_PACKET_FAILED) {
        check_failure(body);
        give_back(body);
    }
    if (p->role == SERVER && (kind == FRACAS_PACKET_TROUBLE || kind == FRACAS_PACKET_ENDED))
        p->gave_up = true;
    if (kind == FRACAS_PACKET_TROUBLE || kind == FRACAS_PACKET_FAULT)
        trace("  %s", ((const fracas_trouble *)body)->text);
    if (kind == FRACAS_PACKET_FAILED) trace("  %s", ((const fracas_lease_failure *)body)->reason);
    return __real_fracas_packet_send(fd, kind, body, size);
}

/* ---- commits ---- */

static void check_segment(const char *name, const fracas_file_seal *seal)
{
    char path[512];
    snprintf(path, sizeof path, DISK_ROOT "/study/segments/%s", name);
    if (!disk_is_durable(path)) broken("%s is in the index, and is not durable", path);
    const node *n = disk_find(path);
    if (n->size != seal->bytes || fracas_checksum_of(n->data, n->size) != seal->checksum)
        broken("%s is in the index with other bytes", path);
}

static bool knows(const char *name)
{
    for (size_t s = 0; s < oracle.nsegments; s++)
        if (!strcmp(oracle.segment[s], name)) return true;
    return false;
}

static void know(const char *name)
{
    if (knows(name)) return;
    if (fracas_grow(&oracle.segment, sizeof *oracle.segment, oracle.nsegments,
                    &oracle.segments_room, "segments"))
        abort();
    oracle.segment[oracle.nsegments++] = strdup(name);
}

fracas_err __real_fracas_index_commit(fracas_index *index, const char *segment,
                                      const fracas_file_seal *seal, const fracas_segment_row *row,
                                      size_t count, const char *provenance);
fracas_err __wrap_fracas_index_commit(fracas_index *index, const char *segment,
                                      const fracas_file_seal *seal, const fracas_segment_row *row,
                                      size_t count, const char *provenance)
{
    for (size_t i = 0; i < count; i++) of(point_of(&row[i].point), row[i].replica)->written = true;
    TRY(__real_fracas_index_commit(index, segment, seal, row, count, provenance));
    trace("commits %s: %zu realizations", segment, count);
    check_segment(segment, seal);
    know(segment);
    for (size_t i = 0; i < count; i++) note_end(point_of(&row[i].point), row[i].replica);
    return FRACAS_OK;
}

fracas_err __real_fracas_index_fail(fracas_index *index, const fracas_hash *point, int64_t replica,
                                    const char *reason, bool final);
fracas_err __wrap_fracas_index_fail(fracas_index *index, const fracas_hash *point, int64_t replica,
                                    const char *reason, bool final)
{
    TRY(__real_fracas_index_fail(index, point, replica, reason, final));
    const uint64_t p = point_of(point);
    trace("replica %lld of point %llu failed%s: %s", (long long)replica, (unsigned long long)p,
          final ? " for good" : "", reason);
    if (final && farm_curse(p, replica) == SOUND)
        broken("replica %lld of point %llu failed for good: %s", (long long)replica,
               (unsigned long long)p, reason);
    if (final) note_end(p, replica);
    return FRACAS_OK;
}

/* ---- checkpoints ---- */

static void checkpoint_path(uint64_t point, int64_t replica, char path[256])
{
    snprintf(path, 256, DISK_ROOT "/study/" FRACAS_CHECKPOINTS "/%s-%lld",
             fracas_hash_hex(&oracle.campaign->point[point].hash).text, (long long)replica);
}

/* A whole checkpoint of this program; false: none. */
static bool read_checkpoint(const char *path, fracas_checkpoint_head *head)
{
    const node *n = disk_find(path);
    uint64_t seal[2];
    if (!n || n->size < sizeof *head + FRACAS_OWN_SEAL) return false;
    const size_t bytes = n->size - FRACAS_OWN_SEAL;
    memcpy(head, n->data, sizeof *head);
    memcpy(seal, n->data + n->size - sizeof seal, sizeof seal);
    return seal[0] == bytes && seal[1] == fracas_checksum_of(n->data, bytes) &&
           !strncmp(head->version, FRACAS_VERSION, sizeof head->version);
}

uint64_t oracle_checkpoint(uint64_t point, int64_t replica)
{
    char path[256];
    fracas_checkpoint_head head;
    checkpoint_path(point, replica, path);
    return read_checkpoint(path, &head) && disk_is_durable(path) ? (uint64_t)head.steps : 0;
}

/* Meanwhile another copy of the lease may have ended, or left an older one. */
void oracle_begins(uint64_t point, int64_t replica, uint64_t before, uint64_t steps)
{
    const uint64_t now = oracle_checkpoint(point, replica);
    if (steps < before && steps < now)
        broken("replica %lld of point %llu begins at step %llu, its checkpoint is of step %llu",
               (long long)replica, (unsigned long long)point, (unsigned long long)steps,
               (unsigned long long)before);
}

fracas_err __real_fracas_checkpoint_create(const char *study, const fracas_file_header *header,
                                           fracas_checkpoint_head *head,
                                           fracas_checkpoint **checkpoint);
fracas_err __wrap_fracas_checkpoint_create(const char *study, const fracas_file_header *header,
                                           fracas_checkpoint_head *head,
                                           fracas_checkpoint **checkpoint)
{
    TRY(__real_fracas_checkpoint_create(study, header, head, checkpoint));
    world.current->saves = (saving){point_of(&head->point), head->replica, (uint64_t)head->steps};
    return FRACAS_OK;
}

fracas_err __real_fracas_checkpoint_finish(fracas_checkpoint *checkpoint);
fracas_err __wrap_fracas_checkpoint_finish(fracas_checkpoint *checkpoint)
{
    TRY(__real_fracas_checkpoint_finish(checkpoint));
    const saving *s = &world.current->saves;
    const uint64_t steps = oracle_checkpoint(s->point, s->replica);
    trace("checkpoint of replica %lld of point %llu at step %llu", (long long)s->replica,
          (unsigned long long)s->point, (unsigned long long)s->steps);
    /* Another copy of the lease may have left another, or ended. */
    if (!steps && !of(s->point, s->replica)->written)
        broken("a checkpoint of step %llu is finished, and not durable",
               (unsigned long long)s->steps);
    return FRACAS_OK;
}

fracas_err __real_fracas_writer_create(const char *path, const fracas_file_header *header,
                                       const fracas_point_table *table, fracas_writer **writer);
fracas_err __wrap_fracas_writer_create(const char *path, const fracas_file_header *header,
                                       const fracas_point_table *table, fracas_writer **writer)
{
    snprintf(world.current->writes, sizeof world.current->writes, "%s", path);
    return __real_fracas_writer_create(path, header, table, writer);
}

void __real_fracas_checkpoints_remove(const char *study, const fracas_segment_row *row,
                                      size_t count);
void __wrap_fracas_checkpoints_remove(const char *study, const fracas_segment_row *row,
                                      size_t count)
{
    const bool durable = disk_is_durable(world.current->writes);
    for (size_t i = 0; i < count && durable; i++)
        of(point_of(&row[i].point), row[i].replica)->written = true;
    __real_fracas_checkpoints_remove(study, row, count);
}

static bool all_ended(void)
{
    for (size_t p = 0; p < oracle.campaign->npoints; p++)
        for (int64_t i = 0; i < oracle.campaign->table.point[p].replicas; i++)
            if (!of(p, i)->ended) return false;
    return true;
}

static void check_removal(const char *path, const char *name)
{
    fracas_checkpoint_head head;
    if (!strstr(path, "/" FRACAS_CHECKPOINTS "/") || *name == '.' || !read_checkpoint(path, &head))
        return;
    const realization *r = of(point_of(&head.point), head.replica);
    if (!r->ended && !r->written && !all_ended())
        broken("checkpoint %s is removed, and its record is nowhere", name);
}

/* ---- files ---- */

void oracle_removes(const char *path, bool replaced)
{
    const char *name = strrchr(path, '/') + 1;
    if (!replaced && disk_find(path)) check_removal(path, name);
    if (disk_find(path) && knows(name)) broken("%s is removed or written over", path);
}

/* ---- a study opened again ---- */

static bool ends(const char *name, const char *end)
{
    const size_t length = strlen(name), size = strlen(end);
    return length > size && !strcmp(name + length - size, end) && *name != '.';
}

/* A server of an earlier run lives, and may write its last segment. */
static bool any_late(void)
{
    for (size_t i = 0; i < world.nprocesses; i++) {
        const process *p = world.process[i];
        if (p->alive && p->role == SERVER && p->run != oracle.run) return true;
    }
    return false;
}

static void check_checkpoints(bool late)
{
    const node *folder = disk_find(DISK_ROOT "/study/" FRACAS_CHECKPOINTS);
    for (size_t e = 0; folder && e < folder->nentries; e++) {
        char path[256];
        fracas_checkpoint_head head;
        snprintf(path, sizeof path, DISK_ROOT "/study/" FRACAS_CHECKPOINTS "/%s",
                 folder->entry[e].name);
        if (!late && !read_checkpoint(path, &head)) broken("%s is of no use, and is kept", path);
    }
}

static void check_files(void)
{
    const bool late = any_late();
    check_checkpoints(late);
    const node *folder = disk_find(DISK_ROOT "/study/segments");
    for (size_t e = 0; e < folder->nentries; e++) {
        const char *name = folder->entry[e].name;
        if (ends(name, ".damaged")) broken("%s: a segment was damaged", name);
        if (ends(name, ".h5") && !knows(name) && !late) broken("%s is left out", name);
    }
}

static void check_rows(fracas_index *index)
{
    fracas_index_row *row;
    fracas_point_table table = oracle.campaign->table;
    size_t count;
    if (fracas_index_rows(index, &table, &row, &count)) broken("the index: %s", fracas_message());
    for (size_t i = 0; i < count; i++) {
        const bool ended = row[i].status == FRACAS_DONE || row[i].status == FRACAS_FAILED_ROW;
        if (of(row[i].point, row[i].replica)->ended && !ended)
            broken("replica %lld of point %zu was done, and is not", (long long)row[i].replica,
                   row[i].point);
        if (ended) note_end(row[i].point, row[i].replica);
    }
    free(row);
}

fracas_err __real_fracas_study_prepare(const char *study, const fracas_campaign *campaign,
                                       bool force, int *lock, fracas_index **index, char **report);
fracas_err __wrap_fracas_study_prepare(const char *study, const fracas_campaign *campaign,
                                       bool force, int *lock, fracas_index **index, char **report)
{
    FRACAS_CLEARED(fracas_known_segments) known = {0};
    TRY(__real_fracas_study_prepare(study, campaign, force, lock, index, report));
    trace("the study is open: %s", *report);
    oracle.run = world.current->run;
    if (fracas_index_segments_by_id(*index, &known)) broken("the index: %s", fracas_message());
    for (size_t s = 0; s < known.count; s++) {
        check_segment(known.segment[s].name, &known.segment[s].seal);
        know(known.segment[s].name);
    }
    for (size_t s = 0; s < oracle.nsegments; s++)
        if (!fracas_segment_of_name(&known, oracle.segment[s]) && known.count == 0)
            broken("the index has lost its segments");
    check_rows(*index);
    check_files();
    return FRACAS_OK;
}
