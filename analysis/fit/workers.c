/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fracas_fits_create_by: a process a point, some at a time; their rows come by pipes. */
#include "analysis/fit/part.h"

#include "analysis/summary/study.h"
#include "base/own.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

/* A process at work. */
typedef struct {
    pid_t pid; /* 0: none */
    int from;  /* its pipe */
    size_t point;
    char *text; /* rows that came, or the message of its error */
    size_t size;
    FILE *to; /* the stream of the text */
} worker;

typedef struct {
    const fracas_analysis *analysis;
    const fracas_fits_work *work;
    int64_t resamples;
    fracas_fits_part part;
    fracas_fits *of; /* rows of each point */
    size_t *order;   /* points to fit, the largest first */
    size_t norder, next, done, saved;
    worker *worker;
    struct pollfd *poll;
} crew;

/* ---- a worker ---- */

static _Noreturn void fit_one(const crew *all, size_t point, int to, pid_t parent)
{
    fracas_fits fits = {0};
    close(all->part.fd); /* the lock is the parent's */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(FRACAS_INTERRUPTED);
    FILE *out = fdopen(to, "w");
    fracas_err err = out ? fracas_fits_add_point(all->analysis, point, all->resamples, &fits)
                         : fracas_no_memory("a pipe");
    for (size_t i = 0; i < fits.n && !err; i++) fracas_fits_put_row(&fits.row[i], out);
    if (err && out) fputs(fracas_message(), out);
    if (out && fclose(out) && !err) err = FRACAS_ENVIRONMENT;
    _exit(err); /* not through the exit handlers of the parent */
}

static fracas_err start(crew *all, worker *one)
{
    int ends[2];
    const pid_t parent = getpid();
    const size_t point = all->order[all->next];
    *one = (worker){.from = -1, .point = point};
    one->to = open_memstream(&one->text, &one->size);
    if (!one->to) return fracas_no_memory("the fits of a point");
    if (pipe(ends)) return fracas_fail_system(errno, "cannot make a pipe to a process that fits");
    fflush(NULL);
    const pid_t pid = fork();
    if (pid == 0) {
        close(ends[0]);
        fit_one(all, point, ends[1], parent);
    }
    const int why = errno;
    close(ends[1]);
    one->from = ends[0];
    if (pid < 0)
        return fracas_fail_system(why, "cannot start a process that fits; give fewer --jobs");
    one->pid = pid;
    all->next++;
    return FRACAS_OK;
}

static void end(worker *one)
{
    if (one->pid > 0) {
        kill(one->pid, SIGKILL);
        while (waitpid(one->pid, NULL, 0) < 0 && errno == EINTR) {}
    }
    if (one->from >= 0) close(one->from);
    if (one->to) fclose(one->to);
    free(one->text);
    *one = (worker){.from = -1};
}

static fracas_err lost(const worker *one, int status)
{
    if (WIFEXITED(status) && *one->text)
        return fracas_fail((fracas_err)WEXITSTATUS(status), "point %zu: %s", one->point, one->text);
    return fracas_fail(FRACAS_ENVIRONMENT,
                       "the process that fitted point %zu was lost (%s %d); is memory short? "
                       "`fracas fit` goes on with fewer --jobs",
                       one->point, WIFSIGNALED(status) ? "signal" : "status",
                       WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status));
}

/* Takes the rows of a worker that has ended, and saves them. */
static fracas_err collect(crew *all, worker *one)
{
    int status = 0;
    while (waitpid(one->pid, &status, 0) < 0)
        if (errno != EINTR) return fracas_fail_system(errno, "cannot wait for a process that fits");
    one->pid = 0;
    if (fflush(one->to)) return fracas_no_memory("the fits of a point");
    if (!WIFEXITED(status) || WEXITSTATUS(status) != FRACAS_OK) return lost(one, status);
    const fracas_hash key = fracas_fits_part_key(all->analysis, one->point, all->resamples);
    TRY(fracas_fits_part_save(&all->part, &key, one->text, one->size));
    char *rest = one->text;
    while (*rest) {
        char *line = rest, *feed = strchr(rest, '\n');
        fracas_fits_row row;
        if (!feed) return lost(one, status);
        rest = feed + 1;
        const char kept = *rest;
        *rest = '\0';
        if (!fracas_fits_take_row(line, &row))
            return fracas_fail(FRACAS_BUG, "a row of point %zu is none", one->point);
        *rest = kept;
        TRY(fracas_fits_append(&all->of[one->point], &row));
    }
    end(one);
    return FRACAS_OK;
}

/* ---- the crew ---- */

static void tell(const crew *all)
{
    if (all->work->progress)
        all->work->progress(all->work->context, all->done, all->saved,
                            all->analysis->table->npoints);
}

/* Reads what a worker says; at its end collects it. */
static fracas_err listen_to(crew *all, worker *one)
{
    char block[1 << 14];
    const ssize_t got = read(one->from, block, sizeof block);
    if (got < 0)
        return errno == EINTR ? FRACAS_OK : fracas_fail_system(errno, "cannot read a pipe");
    if (got > 0) {
        fwrite(block, 1, (size_t)got, one->to);
        return FRACAS_OK;
    }
    TRY(collect(all, one));
    all->done++;
    tell(all);
    return FRACAS_OK;
}

static fracas_err fit_all(crew *all)
{
    const int jobs = all->work->jobs;
    for (;;) {
        bool any = false;
        for (int j = 0; j < jobs; j++) {
            worker *one = &all->worker[j];
            if (one->pid == 0 && all->next < all->norder) TRY(start(all, one));
            all->poll[j] = (struct pollfd){.fd = one->pid ? one->from : -1, .events = POLLIN};
            any = any || one->pid;
        }
        if (!any) return FRACAS_OK;
        if (poll(all->poll, (nfds_t)jobs, -1) < 0 && errno != EINTR)
            return fracas_fail_system(errno, "cannot wait for processes that fit");
        for (int j = 0; j < jobs; j++)
            if (all->worker[j].pid && all->poll[j].revents) TRY(listen_to(all, &all->worker[j]));
    }
}

/* Points that are saved come from there; the others are put in order, most fragments first. */
static fracas_err find_work(crew *all)
{
    const fracas_analysis *analysis = all->analysis;
    for (size_t p = 0; p < analysis->table->npoints; p++) {
        const fracas_hash key = fracas_fits_part_key(analysis, p, all->resamples);
        bool taken;
        TRY(fracas_fits_part_take(&all->part, &key, p, &all->of[p], &taken));
        all->saved += taken;
        if (taken) continue;
        size_t at = all->norder++;
        for (; at > 0 &&
               analysis->point[all->order[at - 1]].nfragments < analysis->point[p].nfragments;
             at--)
            all->order[at] = all->order[at - 1];
        all->order[at] = p;
    }
    all->done = all->saved;
    return FRACAS_OK;
}

static fracas_err work_on(crew *all, fracas_fits **fits)
{
    const size_t npoints = all->analysis->table->npoints, jobs = (size_t)all->work->jobs;
    OWN(fracas_fits) made = NULL;
    all->of = calloc(npoints + 1, sizeof *all->of);
    all->order = calloc(npoints + 1, sizeof *all->order);
    all->worker = calloc(jobs, sizeof *all->worker);
    all->poll = calloc(jobs, sizeof *all->poll);
    if (!all->of || !all->order || !all->worker || !all->poll)
        return fracas_no_memory("the fits of a study");
    for (size_t j = 0; j < jobs; j++) all->worker[j].from = -1;
    TRY(fracas_fits_part_open(all->work->study, &all->part));
    TRY(find_work(all));
    tell(all);
    TRY(fit_all(all));
    TRY(fracas_fits_begin(all->analysis, &made));
    for (size_t p = 0; p < npoints; p++)
        for (size_t i = 0; i < all->of[p].n; i++) TRY(fracas_fits_append(made, &all->of[p].row[i]));
    *fits = made;
    made = NULL;
    return FRACAS_OK;
}

fracas_err fracas_fits_create_by(const fracas_analysis *analysis, int64_t resamples,
                                 const fracas_fits_work *work, fracas_fits **fits)
{
    crew all = {.analysis = analysis, .work = work, .resamples = resamples, .part = {.fd = -1}};
    const fracas_err err = work_on(&all, fits);
    for (int j = 0; all.worker && j < work->jobs; j++) end(&all.worker[j]);
    for (size_t p = 0; all.of && p < analysis->table->npoints; p++) free(all.of[p].row);
    free(all.of);
    free(all.order);
    free(all.worker);
    free(all.poll);
    fracas_fits_part_clear(&all.part);
    return err;
}
