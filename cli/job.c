/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/job.h"

#include "base/hash.h"
#include "base/param.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static fracas_err check(const char *what, const char *value, bool quotes)
{
    if (!value) return FRACAS_OK;
    for (const char *c = value; *c; c++)
        if ((unsigned char)*c < ' ' || (quotes && strchr("\"\\", *c)))
            return fracas_fail(FRACAS_USAGE,
                               "submit: %s is `%s`, which cannot stand in a batch script: it may "
                               "have no line breaks%s",
                               what, value, quotes ? ", quotes or backslashes" : "");
    return FRACAS_OK;
}

fracas_err fracas_job_check(const fracas_job *job)
{
    TRY(check("--partition", job->partition, true));
    TRY(check("--account", job->account, true));
    TRY(check("--output", job->output, true));
    for (int i = 0; i < job->nmore; i++) {
        TRY(check("an option of sbatch", job->more[i], true));
        if (i == 0 && job->more[i][0] != '-')
            return fracas_fail(FRACAS_USAGE,
                               "submit: `%s` after `--` is no option of sbatch: these begin with -",
                               job->more[i]);
    }
    return FRACAS_OK;
}

/* For the shell: in single quotes, a single quote as '\''. */
static void quote(const char *text, FILE *out)
{
    fputc('\'', out);
    for (; *text; text++) fputs(*text == '\'' ? "'\\''" : (const char[]){*text, '\0'}, out);
    fputc('\'', out);
}

static void write_options(const fracas_job *job, FILE *out)
{
    const long minutes = (long)ceil(job->time / 60);
    fprintf(out, "#SBATCH --job-name=\"%s\"\n#SBATCH --nodes=%d\n", job->name, job->nodes);
    if (job->tasks) fprintf(out, "#SBATCH --ntasks-per-node=%d\n", job->tasks);
    else fputs("#SBATCH --exclusive\n", out);
    fprintf(out, "#SBATCH --time=%ld:%02ld:00\n", minutes / 60, minutes % 60);
    fprintf(out, "#SBATCH --signal=B:USR1@%d\n#SBATCH --requeue\n#SBATCH --open-mode=append\n",
            job->lead);
    fprintf(out, "#SBATCH --output=\"%s\"\n", job->output);
    if (job->partition) fprintf(out, "#SBATCH --partition=\"%s\"\n", job->partition);
    if (job->account) fprintf(out, "#SBATCH --account=\"%s\"\n", job->account);
    for (int i = 0; i < job->nmore; i++) {
        if (job->more[i][0] == '-') fprintf(out, "%s#SBATCH %s", i ? "\n" : "", job->more[i]);
        else fprintf(out, " \"%s\"", job->more[i]);
    }
    if (job->nmore) fputc('\n', out);
}

static void write_settings(const fracas_job *job, FILE *out)
{
    fputs("\nprogram=", out);
    quote(job->program, out);
    fputs("\nstudy=", out);
    quote(job->study, out);
    fputs("\nscript=", out);
    quote(job->script, out);
    fputs("\nrun=(", out);
    for (int i = 0; i < job->nrun; i++) {
        if (i) fputc(' ', out);
        quote(job->run[i], out);
    }
    fprintf(out, ")\ntime=%.0f # s\ncd -- ", 60 * ceil(job->time / 60));
    quote(job->folder, out);
    fputs(" || exit 6\n", out);
}

/* What is the same in all scripts. */
static const char *const body[] = {
    "\n[ -n \"$SLURM_JOB_ID\" ] || { echo \"fracas: this is a batch script: sbatch $0\" >&2; exit "
    "2; }\n"
    "echo \"fracas: job $SLURM_JOB_ID on $SLURM_JOB_NODELIST, start $((${SLURM_RESTART_COUNT:-0} + "
    "1)), $(date)\" >&2\n",

    "\n# Seconds until Slurm ends the job.\n"
    "left() {\n"
    "    local text days=0 a b c\n"
    "    text=$(squeue -h -j \"$SLURM_JOB_ID\" -o %L 2>/dev/null)\n"
    "    case $text in *-*) days=${text%%-*} text=${text#*-} ;; esac\n"
    "    IFS=: read -r a b c <<<\"$text\"\n"
    "    [ -n \"$c\" ] || { c=$b b=$a a=0; }\n"
    "    if [[ $days:$a:$b:$c =~ ^[0-9]+:[0-9]+:[0-9]+:[0-9]+$ ]]; then\n"
    "        echo $((((10#$days * 24 + 10#$a) * 60 + 10#$b) * 60 + 10#$c))\n"
    "    else\n"
    "        echo $((time - SECONDS))\n"
    "    fi\n"
    "}\n",

    "\n# Realizations that are done.\n"
    "count() { \"$program\" status \"$study\" --json 2>/dev/null | sed -n 's/.*\"done\": "
    "*\\([0-9]*\\).*/\\1/p' | head -n 1; }\n",

    "\n# Slurm signals this shell, which has the run drain: USR1 before the time is over or the "
    "job preempted, TERM when it is ended.\n"
    "heard=0 pid=\n"
    "drain() { heard=$((heard + 1)); [ -z \"$pid\" ] || kill -USR1 \"$pid\" 2>/dev/null; }\n"
    "trap drain USR1 TERM\n",

    "\n# Another run may hold the study: one before this, whose node died or is being cleared.\n"
    "before=$(count)\n"
    "for try in 1 2 3 4 5 6; do\n"
    "    status=3\n"
    "    [ \"$heard\" -eq 0 ] || break\n"
    "    seconds=$(left)\n"
    "    margin=$((seconds / 10 < 30 ? seconds / 10 : 30))\n"
    "    [ \"$seconds\" -gt 10 ] || break\n"
    "    \"$program\" \"${run[@]}\" --walltime \"$((seconds - margin))s\" &\n"
    "    pid=$!\n"
    "    [ \"$heard\" -eq 0 ] || kill -USR1 \"$pid\"\n"
    "    seen=-1 status=255\n"
    "    while [ \"$status\" -gt 128 ] && [ \"$seen\" -ne \"$heard\" ]; do # a wait that a signal "
    "cut short\n"
    "        seen=$heard\n"
    "        wait \"$pid\"\n"
    "        status=$?\n"
    "    done\n"
    "    pid=\n"
    "    [ \"$status\" -le 128 ] || [ \"$heard\" -eq 0 ] || status=3\n"
    "    [ \"$status\" -eq 4 ] || break\n"
    "    sleep 20 &\n"
    "    wait $!\n"
    "done\n",

    "\n[ \"$status\" -eq 3 ] || exit \"$status\"\n"
    "state=$(squeue -h -j \"$SLURM_JOB_ID\" -o %T 2>/dev/null)\n"
    "case $state in\n"
    "COMPLETING | CANCELLED | '') echo 'fracas: Slurm has ended this job: it comes again only "
    "where Slurm queues it again' >&2; exit 3 ;;\n"
    "esac\n"
    "if [ \"$SECONDS\" -gt $((time / 2)) ] && [ \"$(count)\" = \"$before\" ]; then\n"
    "    echo \"fracas: nothing was finished in $SECONDS s: give the job more time; it is not "
    "queued again\" >&2\n"
    "    exit 3\n"
    "fi\n"
    "# Never status 0 here: a job that is being preempted would count as completed, and would not "
    "come again.\n"
    "scontrol requeue \"$SLURM_JOB_ID\" || echo \"fracas: the job could not be queued again; by "
    "hand: sbatch $script\" >&2\n"
    "exit 3\n",
};

static const char seal[] =
    "# Checksum of the lines above, by which `fracas submit` knows its own script: ";

fracas_err fracas_job_write(const fracas_job *job, FILE *out)
{
    char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return fracas_no_memory("the batch script");
    fputs("#!/bin/bash\n# Written by `fracas submit`.\n", memory);
    write_options(job, memory);
    write_settings(job, memory);
    for (size_t i = 0; i < FRACAS_COUNT(body); i++) fputs(body[i], memory);
    const bool whole = !fclose(memory);
    if (whole) fprintf(out, "%s%s%016" PRIx64 "\n", text, seal, fracas_checksum_of(text, size));
    free(text);
    return whole ? FRACAS_OK : fracas_no_memory("the batch script");
}

fracas_err fracas_job_is_own(FILE *in, bool *own)
{
    enum { MOST = 1 << 20 };
    char *text = malloc(MOST + 1);
    if (!text) return fracas_no_memory("the batch script");
    text[fread(text, 1, MOST, in)] = '\0';
    const char *last = strstr(text, seal);
    uint64_t checksum = 0;
    *own = !*text || (last && sscanf(last + sizeof seal - 1, "%16" SCNx64, &checksum) == 1 &&
                      checksum == fracas_checksum_of(text, (size_t)(last - text)));
    free(text);
    return FRACAS_OK;
}
