/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The subcommands of fracas and their common command line. */
#ifndef FRACAS_CLI_CLI_H
#define FRACAS_CLI_CLI_H

#include "base/err.h"
#include "campaigns/store/datafile.h"

#include <stdbool.h>
#include <stddef.h>
#include <string.h>

typedef struct {
    const char *name;     /* "jobs" for --jobs */
    const char *argument; /* its value in the help; NULL: none */
    const char *doc;
    char letter; /* 'o' for -o; 0: none */
} fracas_option;

enum { FRACAS_MOST_OPTIONS = 32 }; /* per subcommand */

typedef struct fracas_arguments fracas_arguments;
struct fracas_campaign;

/* A subcommand is one const fracas_command and one line in main.c. */
typedef struct {
    const char *name;
    const char *operand;          /* its name in the help; NULL: none */
    bool optional;                /* the operand may be left out */
    const char *second;           /* a second operand */
    const char *instead;          /* an option that takes the place of the second; NULL: none */
    const char *doc;              /* one sentence, no full stop */
    const char *more;             /* paragraph for `fracas help NAME` */
    const fracas_option *options; /* up to one without a name; NULL: none */
    const char *refused; /* the option among them, left out of the help, that is refused ... */
    const char *why;     /* ... "follows from --time: leave it out" */
    bool from_study;     /* an operand FILE may be a study.h5, whose campaign is taken */
    bool takes_rest;     /* words after `--` are kept for another program */
    fracas_err (*run)(const fracas_arguments *arguments);
    /* In the place of `run`: gets the campaign of the operand, a study. */
    fracas_err (*run_on)(const fracas_arguments *arguments, const struct fracas_campaign *campaign);
} fracas_command;

extern const fracas_option fracas_json_option[]; /* --json alone */
#define FRACAS_WIDE_OPTION                                                      \
    {                                                                           \
        "wide", NULL, "tables as wide as they are, also on a narrower terminal" \
    }

extern const fracas_command fracas_command_run, fracas_command_plan, fracas_command_status,
    fracas_command_report, fracas_command_export, fracas_command_picture, fracas_command_verify,
    fracas_command_sample, fracas_command_distributions, fracas_command_reference,
    fracas_command_reindex, fracas_command_merge, fracas_command_gc, fracas_command_extend,
    fracas_command_retry, fracas_command_merge_studies, fracas_command_compare,
    fracas_command_submit, fracas_command_converge, fracas_command_fit, fracas_command_bench,
    fracas_command_man, fracas_command_completion, fracas_command_init, fracas_command_replay,
    fracas_command_doctor;

#define FRACAS_PROGRAM_DOC "from a campaign file to a report of fragment statistics"

/* "[FOLDER]": the operand, "" of a command without one. */
typedef struct {
    char text[24];
} fracas_call;
fracas_call fracas_operand_text(const fracas_command *command);

/* All of them, in the order of the help, up to a NULL. */
extern const fracas_command *const fracas_commands[];

/* FRACAS_USAGE, with the nearest, for an unknown name. */
FRACAS_MUST_USE fracas_err fracas_command_find(const char *name, const fracas_command **command);

/* False for the option that the command refuses. */
static inline bool fracas_option_is_shown(const fracas_command *command,
                                          const fracas_option *option)
{
    return !command->refused || strcmp(command->refused, option->name) != 0;
}

struct fracas_arguments {
    const fracas_command *command;
    const char *operand, *second;
    const char *value[FRACAS_MOST_OPTIONS]; /* by option: fracas_given */
    bool help;                              /* --help was given: nothing else is checked */
    int argc;                               /* the program's, with options in front */
    char **argv;
    char **rest; /* in argv: nrest words after `--` */
    int nrest;
};

/* The value of an option; "": it has none; NULL: not given, or no option of the command. */
const char *fracas_given(const fracas_arguments *arguments, const char *option);
/* Gives an option of the command another value, NULL: none. */
void fracas_arguments_set(fracas_arguments *arguments, const char *option, const char *value);

/* Reads the program's command line; argv[1] is the command's name. FRACAS_USAGE for an unknown
 * option (naming the nearest), a refused one (with the reason), a missing or extra argument. */
FRACAS_MUST_USE fracas_err fracas_arguments_read(const fracas_command *command, int argc,
                                                 char **argv, fracas_arguments *arguments);

/* The value of an option as a whole number in [minimum, maximum]; *value is unchanged if it was
 * not given. FRACAS_USAGE for anything else, FRACAS_BUG for no option of the command. */
FRACAS_MUST_USE fracas_err fracas_arguments_integer(const fracas_arguments *arguments,
                                                    const char *option, int minimum, int maximum,
                                                    int *value);
/* The same for a finite number >= 0, times `scale`. */
FRACAS_MUST_USE fracas_err fracas_arguments_real(const fracas_arguments *arguments,
                                                 const char *option, double scale, double *value);
/* The same for one of `count` words: *value becomes its place. */
FRACAS_MUST_USE fracas_err fracas_arguments_word(const fracas_arguments *arguments,
                                                 const char *option, const char *const *words,
                                                 size_t count, int *value);

/* The same for a duration in s: a sum of numbers with s, m, h or d (`55m`, `1h30m`), or
 * [days-]hours:minutes:seconds as Slurm writes it. */
FRACAS_MUST_USE fracas_err fracas_arguments_time(const fracas_arguments *arguments,
                                                 const char *option, double *seconds);

/* Columns for tables on standard output: the terminal's; 0, no limit: there is none, or --wide. */
int fracas_cli_columns(const fracas_arguments *arguments);

/* The option --times: a list [s], freed by the caller; or a number of times, and *time is NULL.
 * *count keeps its value without the option. */
FRACAS_MUST_USE fracas_err fracas_cli_times(const fracas_arguments *arguments, size_t *count,
                                            double **time);

/* Sorts such a list, each time once. FRACAS_USAGE for times below 0. */
FRACAS_MUST_USE fracas_err fracas_cli_times_in_order(const fracas_arguments *arguments,
                                                     size_t *count, double *time);

/* An instant or interval of a realization [s]: "26us" or "26 us". A campaign file wants the space,
 * a command line is easier without. FRACAS_USAGE for anything else. */
struct fracas_units;
FRACAS_MUST_USE fracas_err fracas_cli_read_time(const struct fracas_units *units, const char *text,
                                                double *seconds);

/* FRACAS_DAMAGED, with the remedy, if `study` is no folder of a study. */
FRACAS_MUST_USE fracas_err fracas_cli_check_study(const char *study);
/* The same, and if it has a study.h5 alone beside its campaign file, of which merge-studies knows
 * nothing. */
FRACAS_MUST_USE fracas_err fracas_cli_check_run(const char *study);

/* `err`, and, of FRACAS_DAMAGED, what to do behind the present message where STUDY/study.h5, or the
 * file of results `operand`, cannot be read. */
FRACAS_MUST_USE fracas_err fracas_cli_remedy(const char *operand, fracas_err err);

/* Reads STUDY/campaign.yaml. FRACAS_DAMAGED if it is damaged, or if study.h5 is of another campaign
 * and no run has made it there. */
FRACAS_MUST_USE fracas_err fracas_cli_read_campaign(const char *study,
                                                    struct fracas_campaign **campaign);

/* True of a folder with a study.h5 that is read as it is: there is no campaign.yaml, or the file is
 * of an earlier format version, and this program may understand its campaign file otherwise. */
bool fracas_cli_alone(const char *study);

/* True of a file of HDF5. */
bool fracas_cli_is_study_file(const char *path);
struct fracas_reader;
/* Reads every value of a study.h5. Results of this program version are held against their campaign,
 * unless it is NULL; `full`: their meshes, too. FRACAS_DAMAGED */
FRACAS_MUST_USE fracas_err fracas_cli_check_values(struct fracas_reader *reader, const char *file,
                                                   const struct fracas_campaign *campaign,
                                                   bool full);
/* The campaign in an open study.h5, `file` in messages; NULL where it has none. FRACAS_DAMAGED if
 * it cannot be read, or is not that of the results. */
FRACAS_MUST_USE fracas_err fracas_cli_campaign_in(struct fracas_reader *reader, const char *file,
                                                  struct fracas_campaign **campaign);
/* The same of a file by its name; FRACAS_DAMAGED, too, where it has none. *ours: the file is of
 * this program version; may be NULL. */
FRACAS_MUST_USE fracas_err fracas_cli_campaign_of_file(const char *file, bool *ours,
                                                       struct fracas_campaign **campaign);
/* The campaign of a study, or of a study.h5 alone. */
FRACAS_MUST_USE fracas_err fracas_cli_campaign_of(const char *study,
                                                  struct fracas_campaign **campaign);
/* The same to look at results: NULL of a study.h5 alone that has none, or is of another program
 * version, for which its text may mean something else. */
FRACAS_MUST_USE fracas_err fracas_cli_campaign_seen(const char *study,
                                                    struct fracas_campaign **campaign);
/* The campaign of an operand FILE, a campaign file or a study.h5 of any name. */
FRACAS_MUST_USE fracas_err fracas_cli_read_file(const char *file,
                                                struct fracas_campaign **campaign);

/* The analysis of a study by its campaign, partial or not; the campaign must outlive it, and may be
 * NULL of a study.h5 alone. Both are destroyed by the caller, after an error too. */
struct fracas_analysis;
FRACAS_MUST_USE fracas_err fracas_cli_analyse(const char *study, struct fracas_campaign **campaign,
                                              struct fracas_analysis **analysis);

/* FRACAS_USAGE, with the name of the file, if `report:` of a campaign file has keys that the report
 * of its study would refuse. */
FRACAS_MUST_USE fracas_err fracas_cli_check_report(const char *file,
                                                   const struct fracas_campaign *campaign);

/* Makes a study of the operand's study.h5, in a new folder (`export --study`). */
FRACAS_MUST_USE fracas_err fracas_cli_unpack(const fracas_arguments *arguments, const char *folder);

typedef struct {
    bool json, quiet;   /* the statistics as JSON, or nothing, in the place of the table */
    const char *output; /* folder; NULL: STUDY/report */
    int columns;        /* for the table; 0: no limit */
    const char *x, *series, *panels, *y; /* keys of the figures; NULL: the campaign's */
    const char *points;                  /* points with figures of their own; NULL: chosen */
} fracas_report_view;

/* Prints the result table and writes the report of all realizations done by now: the last step of
 * `fracas run`, and `fracas report`. */
FRACAS_MUST_USE fracas_err fracas_cli_report(const char *study, const fracas_report_view *view);

#endif
