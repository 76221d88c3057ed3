/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/file.h"
#include "base/param.h"
#include "campaigns/sample/sample.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const fracas_option options[] = {
    {"point", "P", "which point (0): the first column of `fracas plan FILE`"},
    {"replica", "R", "which of its replicas (0)"},
    {"csv", "PATH",
     "write strengths and positions to PATH, a line each; - for standard output, without "
     "the summary"},
    {"vtk", "PATH", "write them to PATH for ParaView"},
    {"json", NULL, "print the summary as JSON"},
    {0}};

static bool write_to(const char *path, bool plain, const fracas_sample *sample,
                     void (*write)(const fracas_sample *sample, FILE *out))
{
    errno = 0;
    FILE *out = plain ? fracas_file_stream(fracas_file_create(path), "w") : fopen(path, "w");
    if (!out) return false;
    write(sample, out);
    const bool bad = ferror(out);
    return fclose(out) == 0 && !bad;
}

/* Writes the file whole under another name and renames it; writes a device, pipe or link directly.
 * Errors are those of the stream. */
static fracas_err write_file(const fracas_sample *sample,
                             void (*write)(const fracas_sample *sample, FILE *out),
                             const char *path)
{
    struct stat found;
    char temporary[PATH_MAX];
    const bool plain = lstat(path, &found) != 0 || S_ISREG(found.st_mode);
    if (snprintf(temporary, sizeof temporary, plain ? "%s.tmp-%ld" : "%s", path, (long)getpid()) >=
        (int)sizeof temporary)
        return fracas_fail(FRACAS_USAGE, "the path of a file is too long: %s", path);
    const bool written = write_to(temporary, plain, sample, write);
    if (written && (!plain || rename(temporary, path) == 0)) return FRACAS_OK;
    const fracas_err err = fracas_fail(FRACAS_ENVIRONMENT, "cannot write %s: %s", path,
                                       strerror(errno));
    if (plain) unlink(temporary);
    return err;
}

static fracas_err show(const fracas_arguments *arguments, const fracas_sample *sample)
{
    const char *csv = fracas_given(arguments, "csv"), *vtk = fracas_given(arguments, "vtk");
    const bool piped = csv && strcmp(csv, "-") == 0;
    if (csv && !piped) TRY(write_file(sample, fracas_sample_write_csv, csv));
    if (vtk) TRY(write_file(sample, fracas_sample_write_vtk, vtk));
    if (!piped) return fracas_sample_summarize(sample, fracas_given(arguments, "json"), stdout);
    fracas_sample_write_csv(sample, stdout);
    return FRACAS_OK;
}

/* Standard output takes the summary or the CSV. */
static fracas_err check_outputs(const fracas_arguments *arguments)
{
    const char *csv = fracas_given(arguments, "csv"), *vtk = fracas_given(arguments, "vtk");
    if (vtk && strcmp(vtk, "-") == 0)
        return fracas_fail(FRACAS_USAGE, "sample: --vtk is `-`; it must be a file");
    if (csv && strcmp(csv, "-") == 0 && fracas_given(arguments, "json"))
        return fracas_fail(FRACAS_USAGE, "sample: --csv - and --json both print; name a file for "
                                         "--csv, or leave out one of them");
    return FRACAS_OK;
}

/* FRACAS_USAGE if `path` is one of the files that the strengths come from, or another that is
 * there and does not begin as those of this program do. */
static fracas_err check_file(const fracas_arguments *arguments, const fracas_campaign *campaign,
                             const char *option, const char *begin)
{
    const char *path = fracas_given(arguments, option), *input = arguments->operand;
    if (!path || strcmp(path, "-") == 0) return FRACAS_OK;
    bool same = fracas_file_same(path, input);
    for (const fracas_attached *a = campaign->attached; a && !same; a = a->next) {
        input = a->attachment.path;
        same = fracas_file_same(path, input);
    }
    if (same)
        return fracas_fail(FRACAS_USAGE,
                           "sample: --%s %s would replace %s, which is read: name another file",
                           option, path, input);
    if (fracas_file_begins(path, begin)) return FRACAS_OK;
    return fracas_fail(FRACAS_USAGE,
                       "sample: --%s %s is there already, and no `fracas sample` wrote it: name "
                       "another file, or move it away",
                       option, path);
}

static fracas_err check_files(const fracas_arguments *arguments, const fracas_campaign *campaign)
{
    const char *csv = fracas_given(arguments, "csv"), *vtk = fracas_given(arguments, "vtk");
    if (csv && vtk && (strcmp(csv, vtk) == 0 || fracas_file_same(csv, vtk)))
        return fracas_fail(FRACAS_USAGE, "sample: --csv and --vtk are both %s: name two files",
                           csv);
    TRY(check_file(arguments, campaign, "csv", FRACAS_SAMPLE_CSV));
    return check_file(arguments, campaign, "vtk", FRACAS_SAMPLE_VTK);
}

static fracas_err sample(const fracas_arguments *arguments)
{
    int point = 0, replica = 0;
    TRY(check_outputs(arguments));
    TRY(fracas_arguments_integer(arguments, "point", 0, INT_MAX, &point));
    TRY(fracas_arguments_integer(arguments, "replica", 0, INT_MAX, &replica));
    OWN(fracas_campaign) campaign = NULL;
    TRY(fracas_cli_read_file(arguments->operand, &campaign));
    TRY(check_files(arguments, campaign));
    FRACAS_CLEARED(fracas_sample) drawn = {0};
    TRY(fracas_sample_draw(campaign, (size_t)point, replica, &drawn));
    return show(arguments, &drawn);
}

const fracas_command fracas_command_sample = {
    .name = "sample",
    .operand = "FILE",
    .doc = "Draws the strengths of one realization of FILE, and computes nothing",
    .more =
        "\nThe values are those that `fracas run FILE` gives that realization, to the last "
        "bit: a strength depends on the campaign's\n"
        "seed, the point, the replica and its place alone. Prints what they are like; with "
        "--csv and --vtk writes all of them, with\n"
        "where they are at the start. FILE may be the campaign.yaml of a study, or its study.h5.\n",
    .from_study = true,
    .options = options,
    .run = sample,
};
