/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/job.h"

#include "base/hash.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static fracas_err check(const char *option, const char *value, bool quotes)
{
    if (!value) return FRACAS_OK;
    for (const char *c = value; *c; c++)
        if ((unsigned char)*c < ' ' || (quotes && strchr("\"\\", *c)))
            return fracas_fail(FRACAS_USAGE,
                               "submit: %s is `%s`, which cannot stand in a batch script: it may "
                               "have no line breaks%s",
                               option, value, quotes ? ", quotes or backslashes" : "");
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

static const char seal[] =
    "# Checksum of the lines above, by which `fracas submit` knows its own script: ";

/* The last line of a script whose other lines are these bytes. */
static void write_seal(const char *text, size_t size, char *line, size_t room)
{
    snprintf(line, room, "%s%016" PRIx64 "\n", seal, fracas_checksum_of(text, size));
}

fracas_err fracas_job_write(const fracas_job *job, FILE *out)
{
    OWNED char *text = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&text, &size);
    if (!memory) return fracas_no_memory("the batch script");
    fputs("#!/bin/bash\n# Written by `fracas submit`.\n", memory);
    write_options(job, memory);
    write_settings(job, memory);
    fputs(fracas_job_body, memory);
    const bool whole = !fclose(memory);
    char line[sizeof seal + 20];
    if (whole) write_seal(text, size, line, sizeof line);
    if (whole) fprintf(out, "%s%s", text, line);
    return whole ? FRACAS_OK : fracas_no_memory("the batch script");
}

fracas_err fracas_job_is_own(FILE *in, bool *own)
{
    enum { MOST = 1 << 20 };
    OWNED char *text = malloc(MOST + 1);
    if (!text) return fracas_no_memory("the batch script");
    const size_t size = fread(text, 1, MOST, in);
    text[size] = '\0';
    const char *last = strstr(text, seal);
    char line[sizeof seal + 20] = "";
    if (last) write_seal(text, (size_t)(last - text), line, sizeof line);
    *own = !size || (last && !strcmp(last, line) && last + strlen(line) == text + size);
    return FRACAS_OK;
}
