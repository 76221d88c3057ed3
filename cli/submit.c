/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/job.h"
#include "cli/run.h"

#include "base/file.h"
#include "base/param.h"
#include "base/text.h"
#include "campaigns/campaign.h"
#include "campaigns/scheduler/session/keep.h"
#include "campaigns/scheduler/session/prepare.h"
#include "campaigns/scheduler/session/space.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const fracas_option options[] = {
    FRACAS_STUDY_OPTION,
    FRACAS_RUN_OPTIONS,
    {"nodes", "N", "nodes of the job (1)"},
    {"time", "TIME", "the most it may take each time it is started: 2:00:00, 90m; needed"},
    {"tasks-per-node", "N", "processes on each node (the whole node: one a core)"},
    {"partition", "NAME", "partition (the cluster's default)"},
    {"account", "NAME", "account that is charged (your default)"},
    {"signal-lead", "S", "have Slurm signal S seconds before the end (60)"},
    {"output", "FILE", "what the run says; %j: number of the job (FILE.%j.out)"},
    {"script", "PATH", "write the script there (FILE.sbatch)"},
    {"submit", NULL, "hand it to sbatch, and print the number of the job"},
    {0}};

enum { MOST_WORDS = 4 + 2 * FRACAS_NRUN_OPTIONS };

typedef struct {
    fracas_job job;
    char folder[PATH_MAX], program[PATH_MAX], study[PATH_MAX], name[PATH_MAX], output[PATH_MAX],
        script[PATH_MAX];
    char option[FRACAS_NRUN_OPTIONS][40]; /* "--replicas" */
    char *run[MOST_WORDS];                /* "fracas", then the job's */
} submission;

/* The command line of the run, with the checks of `fracas run`. */
static fracas_err make_run(const fracas_arguments *arguments, submission *s,
                           fracas_run_options *run)
{
    int n = 0;
    s->run[n++] = (char *)"fracas";
    s->run[n++] = (char *)"run";
    s->run[n++] = (char *)arguments->operand;
    for (int i = 0; i < FRACAS_NRUN_OPTIONS; i++) {
        const fracas_option *option = &fracas_cli_run_options[i];
        const char *value = fracas_given(arguments, option->name);
        if (!value) continue;
        snprintf(s->option[i], sizeof s->option[i], "--%s", option->name);
        s->run[n++] = s->option[i];
        if (option->argument) s->run[n++] = (char *)value;
    }
    s->job.run = s->run + 1;
    s->job.nrun = n - 1;
    TRY(fracas_cli_read_run_options(arguments, run));
    run->file = arguments->operand;
    return FRACAS_OK;
}

/* Checks the run as far as possible before its start. */
static fracas_err check_campaign(const fracas_run_options *run, submission *s)
{
    OWN(fracas_campaign) campaign = NULL;
    OWNED double *cost = NULL;
    TRY(fracas_run_campaign(run, &campaign));
    TRY(fracas_study_folder(run, campaign, s->study, sizeof s->study));
    TRY(fracas_study_place(s->study));
    TRY(fracas_study_fits(s->study, campaign));
    snprintf(s->name, sizeof s->name, "%s", campaign->name);
    return fracas_costs_create(campaign, run, stderr, &cost, NULL);
}

static fracas_err read_job(const fracas_arguments *arguments, submission *s)
{
    fracas_job *job = &s->job;
    job->nodes = 1;
    job->lead = 60;
    TRY(fracas_arguments_integer(arguments, "nodes", 1, 1000000, &job->nodes));
    TRY(fracas_arguments_integer(arguments, "tasks-per-node", 1, 1000000, &job->tasks));
    TRY(fracas_arguments_integer(arguments, "signal-lead", 1, 65535, &job->lead));
    TRY(fracas_arguments_time(arguments, "time", &job->time));
    if (job->time == 0)
        return fracas_fail(
            FRACAS_USAGE,
            "submit: --time is missing: how long the job may take, such as --time 2:00:00");
    if (job->time < 60 || job->time <= job->lead)
        return fracas_fail(FRACAS_USAGE,
                           "submit: --time %s is too short: it must be a minute or more, and "
                           "longer than --signal-lead (%d s)",
                           fracas_given(arguments, "time"), job->lead);
    snprintf(s->output, sizeof s->output, "%s.%%j.out", arguments->operand);
    snprintf(s->script, sizeof s->script, "%s.sbatch", arguments->operand);
    if (fracas_given(arguments, "script"))
        snprintf(s->script, sizeof s->script, "%s", fracas_given(arguments, "script"));
    job->output = fracas_given(arguments, "output") ? fracas_given(arguments, "output") : s->output;
    job->partition = fracas_given(arguments, "partition");
    job->account = fracas_given(arguments, "account");
    job->more = arguments->rest;
    job->nmore = arguments->nrest;
    job->name = s->name;
    job->folder = s->folder;
    job->program = s->program;
    job->study = s->study;
    job->script = s->script;
    return fracas_job_check(job);
}

static fracas_err find_places(submission *s)
{
    if (!getcwd(s->folder, sizeof s->folder))
        return fracas_fail(FRACAS_ENVIRONMENT, "the current folder has no name: %s",
                           strerror(errno));
    ssize_t n = readlink("/proc/self/exe", s->program, sizeof s->program - 1);
    if (n < 0)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot find this program: /proc/self/exe: %s",
                           strerror(errno));
    s->program[n] = '\0';
    return FRACAS_OK;
}

/* Refuses to overwrite a foreign or changed file. */
static fracas_err check_place(const char *path)
{
    bool own;
    OWN(FILE) file = fracas_file_stream(fracas_file_open(path), "r");
    if (!file && errno == ENOENT) return FRACAS_OK;
    if (!file) return fracas_fail_system(errno, "cannot open %s", path);
    TRY(fracas_job_is_own(file, &own));
    if (own) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "submit: %s is there already and is not as `fracas submit` writes it: move "
                       "it away, or give --script PATH",
                       path);
}

static fracas_err write_script(const submission *s)
{
    TRY(check_place(s->script));
    FILE *out = fracas_file_stream(fracas_file_create(s->script), "w");
    if (!out) return fracas_fail_system(errno, "cannot write %s", s->script);
    fracas_err err = fracas_job_write(&s->job, out);
    const int bad = ferror(out);
    if (fclose(out) || bad)
        return fracas_fail(FRACAS_ENVIRONMENT, "cannot write %s: is the disk full?", s->script);
    return err;
}

/* The output of sbatch, the number of the job, goes to this program's stdout. */
static fracas_err hand_in(const submission *s)
{
    enum { MISSING = 127 };
    int status = 0;
    fflush(stdout);
    const pid_t pid = fork();
    if (pid < 0) return fracas_fail(FRACAS_ENVIRONMENT, "cannot start sbatch: %s", strerror(errno));
    if (pid == 0) {
        execlp("sbatch", "sbatch", "--parsable", s->script, (char *)NULL);
        _exit(MISSING);
    }
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
        ;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return FRACAS_OK;
    if (WIFEXITED(status) && WEXITSTATUS(status) == MISSING)
        return fracas_fail(FRACAS_ENVIRONMENT,
                           "there is no sbatch here; the script is written: on the cluster's login "
                           "node, sbatch %s",
                           fracas_shell_path(s->script, NULL).text);
    return fracas_fail(FRACAS_ENVIRONMENT, "sbatch refused %s (above: why)", s->script);
}

static fracas_err prepare(const fracas_arguments *arguments, submission *s)
{
    fracas_run_options run;
    TRY(find_places(s));
    TRY(read_job(arguments, s));
    TRY(make_run(arguments, s, &run));
    if (run.parts > 1 && !fracas_given(arguments, "script")) /* each part has a job of its own */
        snprintf(s->script, sizeof s->script, "%s.part%d.sbatch", arguments->operand, run.part);
    TRY(check_campaign(&run, s));
    if (fracas_file_same(s->job.output, arguments->operand))
        return fracas_fail(FRACAS_USAGE,
                           "submit: --output %s is the campaign file, to which the job would "
                           "write: name another file",
                           s->job.output);
    TRY(write_script(s));
    if (fracas_given(arguments, "submit")) return hand_in(s);
    printf("%s is written; submit it by: sbatch %s\n", s->script,
           fracas_shell_path(s->script, NULL).text);
    return FRACAS_OK;
}

static fracas_err submit(const fracas_arguments *arguments)
{
    OWNED submission *s = calloc(1, sizeof *s);
    return s ? prepare(arguments, s) : fracas_no_memory("the batch script");
}

const fracas_command fracas_command_submit = {
    .name = "submit",
    .operand = "FILE",
    .doc = "Writes a Slurm job that runs the campaign of FILE, and submits it",
    .more = "\nThe job drains before its time is over or when it is preempted, and is queued again "
            "until the study is complete.\n"
            "What follows `--` is handed to sbatch: fracas submit FILE --time 2:00:00 -- --mem=8G "
            "--constraint=skylake\n",
    .options = options,
    .refused = "walltime",
    .why = "follows from --time: leave it out",
    .takes_rest = true,
    .run = submit,
};
