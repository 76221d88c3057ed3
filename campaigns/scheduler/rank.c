/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "campaigns/scheduler/rank.h"

#include "campaigns/campaign.h"
#include "campaigns/scheduler/director/director.h"
#include "campaigns/scheduler/launch/guard.h"
#include "campaigns/scheduler/launch/scratch.h"
#include "campaigns/scheduler/launch/signals.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/types/clock.h"
#include "campaigns/scheduler/types/environment.h"
#include "campaigns/scheduler/types/mailbox.h"
#include "campaigns/scheduler/worker/link.h"
#include "campaigns/store/file/disk.h"
#include "engine/integrator/frequencies.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <time.h>

/* A rank sleeps at most so long [ms]: a signal just before goes unnoticed until then. */
enum { SLEEP = 100 };

typedef struct {
    const fracas_run_options *options;
    fracas_run_facts *facts;
    double began;       /* fracas_now at the start of this process */
    fracas_mailbox box; /* to the other ranks */
    fracas_link link;   /* to its compute server */
} rank_state;

static fracas_err server_receive(rank_state *rank, fracas_packet **message)
{
    return fracas_link_receive(&rank->link, rank->box.rank, message);
}

/* Until a message may have come, of another rank or of its server. */
static void sleep_a_little(rank_state *rank)
{
    fracas_mailbox_wait(&rank->box, rank->link.supervisor.server, SLEEP);
}

/* ---- ranks but 0 ---- */

/* Forwards a message of rank 0 to the server; *come: there was one. */
static fracas_err receive_lead(rank_state *rank, bool *come, bool *quit)
{
    OWNED fracas_packet *message = NULL;
    int from;
    TRY(fracas_mailbox_receive(&rank->box, &from, &message));
    *come = message != NULL;
    if (message && message->kind == FRACAS_PACKET_QUIT) *quit = true;
    else if (message) fracas_link_send(&rank->link, message);
    return FRACAS_OK;
}

/* Sends to rank 0 and receives meanwhile: long messages wait until the other side receives, and
 * rank 0 may be sending, too. */
static fracas_err send_lead(rank_state *rank, const fracas_packet *message, bool *quit)
{
    TRY(fracas_mailbox_post(&rank->box, 0, message));
    for (;;) {
        bool come;
        TRY(fracas_mailbox_clear(&rank->box));
        if (!rank->box.outbox) return FRACAS_OK;
        TRY(receive_lead(rank, &come, quit));
        if (!come) fracas_mailbox_wait(&rank->box, -1, 1);
    }
}

static fracas_err tell(rank_state *rank, fracas_packet_kind kind, const void *body, size_t size,
                       bool *quit)
{
    OWNED fracas_packet *message = NULL;
    TRY(fracas_packet_create(kind, body, size, &message));
    return send_lead(rank, message, quit);
}

/* One message each way, if there is one. */
static fracas_err forward(rank_state *rank, bool *quit)
{
    OWNED fracas_packet *message = NULL;
    bool come;
    TRY(server_receive(rank, &message));
    if (message) TRY(send_lead(rank, message, quit));
    TRY(receive_lead(rank, &come, quit));
    if (!message && !come) sleep_a_little(rank);
    return FRACAS_OK;
}

static fracas_err follow(rank_state *rank, fracas_err set_up)
{
    bool told = false, quit = false;
    if (set_up) {
        fracas_trouble trouble;
        fracas_trouble_take(set_up, &trouble);
        TRY(tell(rank, FRACAS_PACKET_TROUBLE, &trouble, sizeof trouble, &quit));
    }
    while (!quit) {
        if (fracas_signals_ask() && !told) {
            TRY(tell(rank, FRACAS_PACKET_DRAIN, NULL, 0, &quit));
            told = true;
        }
        TRY(forward(rank, &quit));
    }
    return tell(rank, FRACAS_PACKET_QUIT, NULL, 0, &quit);
}

/* ---- rank 0 ---- */

static fracas_err send_worker(void *context, size_t worker, const fracas_packet *message)
{
    rank_state *rank = context;
    if (worker > 0) return fracas_mailbox_post(&rank->box, (int)worker, message);
    fracas_link_send(&rank->link, message);
    return FRACAS_OK;
}

/* Receives from the workers, its own server first, until all have ended. */
static fracas_err direct(rank_state *rank, fracas_director *director)
{
    while (!fracas_director_over(director)) {
        if (fracas_signals_ask()) fracas_director_drain(director);
        fracas_packet *message;
        int from = 0;
        TRY(server_receive(rank, &message));
        bool busy = message != NULL;
        if (message) fracas_director_receive(director, 0, message);
        free(message);
        do {
            TRY(fracas_mailbox_receive(&rank->box, &from, &message));
            busy |= message != NULL;
            if (message) fracas_director_receive(director, (size_t)from, message);
            free(message);
        } while (message);
        TRY(fracas_mailbox_clear(&rank->box));
        fracas_director_tick(director);
        if (!busy) sleep_a_little(rank);
    }
    return FRACAS_OK;
}

/* End of the walltime by fracas_now; 0: none. It counts from the start of the launcher, or of this
 * process under the user's own launcher. */
static double deadline_of(const rank_state *rank)
{
    const char *text = getenv(FRACAS_DEADLINE);
    struct timespec day;
    clock_gettime(CLOCK_REALTIME, &day);
    if (text)
        return fracas_now() + strtod(text, NULL) - (double)day.tv_sec - 1e-9 * (double)day.tv_nsec;
    return rank->options->walltime > 0 ? rank->began + rank->options->walltime : 0;
}

static fracas_err lead(rank_state *rank, fracas_channel *channel)
{
    fracas_director_setup setup = {.campaign = rank->facts->campaign,
                                   .options = rank->options,
                                   .study = rank->facts->study,
                                   .cost = rank->facts->cost,
                                   .workers = (size_t)rank->box.size,
                                   .send = send_worker,
                                   .context = rank,
                                   .channel = channel,
                                   .now = fracas_now,
                                   .deadline = deadline_of(rank)};
    fracas_director *director;
    fracas_err result;
    TRY(fracas_director_create(&setup, &director, &result));
    rank->facts->ran = director != NULL;
    if (!director) return result;
    const char *restarted = getenv(FRACAS_RESTARTED);
    if (channel->launcher && restarted) fracas_director_note(director, "restarted", restarted);
    result = direct(rank, director);
    if (!result) result = fracas_director_finish(director);
    fracas_director_destroy(director);
    return result;
}

/* Receives until all ranks have answered QUIT: a rank in the middle of a long message could not end
 * otherwise. A hung rank gets PATIENCE. */
static void receive_rest(rank_state *rank)
{
    enum { PATIENCE = 5 /* s */ };
    const double began = fracas_now();
    for (int left = rank->box.size - 1; left > 0 && fracas_now() - began < PATIENCE;) {
        fracas_packet *message;
        int from;
        if (fracas_mailbox_clear(&rank->box) || fracas_mailbox_receive(&rank->box, &from, &message))
            return;
        if (!message) fracas_mailbox_wait(&rank->box, -1, 1);
        else if (message->kind == FRACAS_PACKET_QUIT) left--;
        free(message);
    }
}

/* Rank 0 with an open mailbox: the run, its result on the status channel, and QUIT to the others.
 */
static fracas_err lead_to_end(rank_state *rank, fracas_err set_up)
{
    fracas_channel channel;
    fracas_channel_init(&channel);
    channel.progress.quiet = rank->options->quiet;
    fracas_err err = set_up;
    if (!err) err = lead(rank, &channel);
    fracas_channel_end(&channel, err, rank->facts->ran);
    fracas_trouble result;
    fracas_trouble_take(err, &result);
    const fracas_packet quit = {.kind = FRACAS_PACKET_QUIT};
    for (int other = 1; other < rank->box.size; other++)
        if (fracas_mailbox_post(&rank->box, other, &quit))
            fracas_mailbox_abort(&rank->box); /* or it waits */
    receive_rest(rank);
    if (!channel.launcher) return fracas_trouble_fail(&result);
    rank->facts->ran = false;
    return FRACAS_OK;
}

/* ---- every rank ---- */

/* For a rank that no process of ours has forked. */
static fracas_err find_facts(const fracas_run_options *options, fracas_run_facts *facts)
{
    const char *frequencies = getenv(FRACAS_FREQUENCIES), *of = getenv(FRACAS_OF);
    TRY(fracas_run_campaign(options, &facts->campaign));
    if (frequencies) TRY(fracas_frequencies_read(facts->campaign->frequencies, frequencies));
    TRY(fracas_study_folder(options, facts->campaign, facts->study, sizeof facts->study));
    if (!of || !strcmp(of, fracas_run_name_of(facts).text)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "%s was edited while the run computed it, and its ranks had to start again; "
                       "put it back and run again, or run the new one beside it",
                       options->file);
}

/* Before the mailbox is open: the supervisor is forked from a process without MPI. */
static fracas_err set_up(rank_state *rank)
{
    fracas_run_facts *facts = rank->facts;
    if (!facts->campaign) TRY(find_facts(rank->options, facts));
    return fracas_supervisor_start(facts->campaign, rank->options, facts->study,
                                   &rank->link.supervisor);
}

/* *plain: the same folder without "//", "./" and a slash at the end. FRACAS_ENVIRONMENT without
 * memory, as the next. */
static fracas_err simplify(const char *folder, char **plain)
{
    TRY(fracas_path(plain, "%s.", folder)); /* room for "." */
    char *to = *plain;
    if (*folder == '/') *to++ = '/';
    for (const char *from = folder; *from;) {
        const size_t slashes = strspn(from, "/"), length = strcspn(from + slashes, "/");
        from += slashes;
        if (length > 0 && !(length == 1 && *from == '.')) {
            if (to > *plain && to[-1] != '/') *to++ = '/';
            memcpy(to, from, length);
            to += length;
        }
        from += length;
    }
    if (to == *plain) *to++ = '.';
    *to = '\0';
    return FRACAS_OK;
}

/* Absolute, without links, as far as the folders exist. */
static fracas_err absolute(const char *folder, char **path)
{
    OWNED char *start = NULL;
    TRY(fracas_path(&start, "%s%s", *folder == '/' ? "" : "./", folder));
    for (size_t end = strlen(start); end > 0; end--) {
        if (start[end] != '/' && start[end]) continue;
        const char behind = start[end];
        start[end] = '\0';
        OWNED char *there = realpath(start, NULL);
        start[end] = behind;
        if (there) return fracas_path(path, "%s%s", there, start + end);
    }
    return fracas_path(path, "%s", folder);
}

static fracas_err whereabouts(const char *study, fracas_whereabouts *place)
{
    char host[FRACAS_HOST_TEXT], boot[FRACAS_BOOT_TEXT];
    OWNED char *given = NULL;
    OWNED char *path = NULL;
    TRY(simplify(study, &given));
    TRY(absolute(given, &path));
    fracas_disk_host(host, boot);
    *place = (fracas_whereabouts){.host = fracas_hash_of(host, strlen(host)),
                                  .path = fracas_hash_of(path, strlen(path)),
                                  .given = fracas_hash_of(given, strlen(given))};
    return FRACAS_OK;
}

/* All ranks are of one study, or none computes; `err`: the trouble of this rank so far. */
static fracas_err meet(rank_state *rank, fracas_err err)
{
    fracas_whereabouts mine;
    if (!err) err = whereabouts(rank->facts->study, &mine);
    const int other = fracas_mailbox_stranger(&rank->box, err ? NULL : &mine);
    if (err || other < 0) return err;
    return fracas_fail(FRACAS_USAGE,
                       "rank %d would compute another study than rank 0, by its --study, campaign "
                       "or working folder, and the ranks of one mpirun compute one: give all the "
                       "same, or start a run for each study with " FRACAS_JOB_VARIABLES
                       " taken out of its environment",
                       other);
}

fracas_err fracas_rank_run(const fracas_run_options *options, const fracas_mailbox *box,
                           fracas_run_facts *facts)
{
    facts->ran = false;
    /* No rank outlives the launcher's starter. (Not with other launchers: the signal follows the
     * starting thread, and theirs may end early.) */
    if (getenv(FRACAS_LAUNCHER_MARK)) prctl(PR_SET_PDEATHSIG, SIGKILL);
    fracas_scratch_import();
    fracas_signals_catch_rank();
    rank_state rank = {.options = options,
                       .facts = facts,
                       .began = fracas_now(),
                       .box = *box,
                       .link.supervisor = {.control = -1, .server = -1}};
    fracas_err err = set_up(&rank);
    fracas_trouble trouble;
    fracas_trouble_take(err, &trouble);
    fracas_guard_tell(&trouble);
    fracas_mailbox_open(&rank.box);
    fracas_guard_pass();
    err = meet(&rank, fracas_trouble_fail(&trouble));
    if (rank.box.rank == 0) {
        err = lead_to_end(&rank, err);
    } else if (follow(&rank, err)) {
        fracas_mailbox_abort(&rank.box); /* or rank 0 would wait for this rank */
    } else {
        err = FRACAS_OK;
    }
    fracas_supervisor_end(&rank.link.supervisor);
    fracas_mailbox_close(&rank.box);
    return err;
}
