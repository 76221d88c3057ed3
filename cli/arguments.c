/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/cli.h"

#include "base/terminal.h"
#include "base/units.h"
#include "campaigns/file/words.h"

#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const fracas_option fracas_json_option[] = {{"json", NULL, "print it as JSON"}, {0}};

/* getopt_long returns FIRST_OPTION + i for options[i] by its name, and letters as themselves. */
enum { FIRST_OPTION = 256 };

/* FRACAS_MOST_OPTIONS: none of this name. */
static size_t find(const fracas_command *command, const char *name)
{
    for (size_t i = 0; command->options && command->options[i].name; i++)
        if (!strcmp(command->options[i].name, name)) return i;
    return FRACAS_MOST_OPTIONS;
}

int fracas_cli_columns(const fracas_arguments *arguments)
{
    return fracas_given(arguments, "wide") ? 0 : fracas_terminal_of(STDOUT_FILENO).columns;
}

fracas_call fracas_operand_text(const fracas_command *command)
{
    fracas_call call = {""};
    if (command->operand)
        snprintf(call.text, sizeof call.text, command->optional ? "[%s]" : "%s", command->operand);
    return call;
}

const char *fracas_given(const fracas_arguments *arguments, const char *option)
{
    const size_t i = find(arguments->command, option);
    return i < FRACAS_MOST_OPTIONS ? arguments->value[i] : NULL;
}

void fracas_arguments_set(fracas_arguments *arguments, const char *option, const char *value)
{
    const size_t i = find(arguments->command, option);
    if (i < FRACAS_MOST_OPTIONS) arguments->value[i] = value;
}

/* *text: the value of an option, NULL if it was not given. FRACAS_BUG for no option of the command.
 */
static fracas_err value_of(const fracas_arguments *arguments, const char *option, const char **text)
{
    const size_t i = find(arguments->command, option);
    if (i == FRACAS_MOST_OPTIONS)
        return fracas_fail(FRACAS_BUG, "%s has no option --%s", arguments->command->name, option);
    *text = arguments->value[i];
    return FRACAS_OK;
}

static fracas_err unknown_option(const fracas_command *command, const char *given)
{
    const char *name = given + strspn(given, "-");
    char found[64];
    snprintf(found, sizeof found, "--%.*s", (int)strcspn(name, "="), name);
    fracas_words words;
    fracas_words_init(&words, found);
    char option[FRACAS_MOST_OPTIONS][32];
    for (size_t i = 0; command->options && command->options[i].name; i++) {
        if (!fracas_option_is_shown(command, &command->options[i])) continue;
        snprintf(option[i], sizeof option[i], "--%s", command->options[i].name);
        fracas_words_add(&words, option[i]);
    }
    fracas_words_add(&words, "--help");
    return fracas_fail(FRACAS_USAGE, "%s: unknown option `%s`%s%s", command->name, given,
                       fracas_words_hint(&words, "it knows"),
                       command->takes_rest ? "; options of another program follow `--`" : "");
}

/* The option for a result of getopt_long; NULL: none. */
static const fracas_option *option_of(const fracas_command *command, int found)
{
    if (found >= FIRST_OPTION) return &command->options[found - FIRST_OPTION];
    for (const fracas_option *option = command->options; option && option->name; option++)
        if (option->letter && option->letter == found) return option;
    return NULL;
}

/* The latest option word of getopt_long, without a value in a word of its own. */
static const char *given_option(char *const *argv)
{
    const char *last = argv[optind - 1];
    return optarg && optarg == last ? argv[optind - 2] : last;
}

/* getopt_long accepts any beginning of a name, --forc for --force; fracas does not. */
static bool is_abbreviated(const fracas_option *option, char *const *argv)
{
    const char *given = given_option(argv);
    return option && !strncmp(given, "--", 2) &&
           (strlen(option->name) != strcspn(given + 2, "=") ||
            strncmp(given + 2, option->name, strlen(option->name)) != 0);
}

/* A wrong use of an option, or an unknown one. */
static fracas_err misused(const fracas_command *command, int found, char *const *argv)
{
    const fracas_option *option = option_of(command, optopt);
    const char letter[] = {'-', (char)optopt, '\0'};
    if (!option) return unknown_option(command, optopt ? letter : argv[optind - 1]);
    if (found == ':')
        return fracas_fail(FRACAS_USAGE, "%s: --%s needs a value: --%s %s", command->name,
                           option->name, option->name, option->argument);
    return fracas_fail(FRACAS_USAGE, "%s: --%s takes no value", command->name, option->name);
}

static fracas_err read_options(const fracas_command *command, fracas_arguments *arguments)
{
    struct option table[FRACAS_MOST_OPTIONS + 2] = {{"help", no_argument, NULL, 'h'}};
    char letters[2 * FRACAS_MOST_OPTIONS + 3] = ":h";
    for (int i = 0; command->options && command->options[i].name; i++) {
        const fracas_option *option = &command->options[i];
        char *end = letters + strlen(letters);
        if (option->letter) snprintf(end, 3, "%c%s", option->letter, option->argument ? ":" : "");
        table[i + 1] = (struct option){option->name,
                                       option->argument ? required_argument : no_argument, NULL,
                                       FIRST_OPTION + i};
    }

    optind = 2;
    opterr = 0;
    int found;
    while ((found = getopt_long(arguments->argc, arguments->argv, letters, table, NULL)) != -1) {
        const fracas_option *option = option_of(command, found);
        if (is_abbreviated(option, arguments->argv))
            return unknown_option(command, given_option(arguments->argv));
        if (found == 'h') arguments->help = true;
        else if (option) arguments->value[option - command->options] = optarg ? optarg : "";
        else return misused(command, found, arguments->argv);
    }
    return FRACAS_OK;
}

/* Words from `--` on are for another program. */
static void cut_rest(fracas_arguments *arguments)
{
    for (int i = 2; i < arguments->argc; i++) {
        if (strcmp(arguments->argv[i], "--")) continue;
        arguments->rest = arguments->argv + i + 1;
        arguments->nrest = arguments->argc - i - 1;
        arguments->argc = i;
        return;
    }
}

fracas_err fracas_arguments_read(const fracas_command *command, int argc, char **argv,
                                 fracas_arguments *arguments)
{
    *arguments = (fracas_arguments){.command = command, .argc = argc, .argv = argv};
    if (command->takes_rest) cut_rest(arguments);
    TRY(read_options(command, arguments));
    if (arguments->help) return FRACAS_OK;
    if (command->refused && fracas_given(arguments, command->refused))
        return fracas_fail(FRACAS_USAGE, "%s: --%s %s", command->name, command->refused,
                           command->why);
    if (command->operand && optind < arguments->argc) arguments->operand = argv[optind++];
    const bool two = command->second &&
                     !(command->instead && fracas_given(arguments, command->instead));
    if (two && optind < arguments->argc) arguments->second = argv[optind++];
    if (optind < arguments->argc)
        return fracas_fail(FRACAS_USAGE, "%s: one argument too many: `%s`; see `fracas help %s`",
                           command->name, argv[optind], command->name);
    const bool needed = command->operand && !command->optional;
    const char *missing = needed && !arguments->operand ? command->operand
                          : two && !arguments->second   ? command->second
                                                        : NULL;
    if (missing)
        return fracas_fail(FRACAS_USAGE, "%s: %s is missing: fracas %s %s%s%s", command->name,
                           missing, command->name, command->operand, command->second ? " " : "",
                           command->second ? command->second : "");
    const char *empty = arguments->operand && !*arguments->operand ? command->operand
                        : arguments->second && !*arguments->second ? command->second
                                                                   : NULL;
    if (empty)
        return fracas_fail(FRACAS_USAGE, "%s: %s is empty: an empty name would be the folder `/`",
                           command->name, empty);
    return FRACAS_OK;
}

fracas_err fracas_arguments_integer(const fracas_arguments *arguments, const char *option,
                                    int minimum, int maximum, int *value)
{
    const char *text;
    TRY(value_of(arguments, option, &text));
    if (!text) return FRACAS_OK;
    char *end;
    errno = 0;
    long number = strtol(text, &end, 10);
    if (end == text || *end || errno || *text == '+' || *text == ' ' || number < minimum ||
        number > maximum)
        return fracas_fail(FRACAS_USAGE,
                           "%s: --%s is `%s`; it must be a whole number from %d to %d",
                           arguments->command->name, option, text, minimum, maximum);
    *value = (int)number;
    return FRACAS_OK;
}

fracas_err fracas_arguments_real(const fracas_arguments *arguments, const char *option,
                                 double scale, double *value)
{
    const char *text;
    TRY(value_of(arguments, option, &text));
    if (!text) return FRACAS_OK;
    char *end;
    double number = strtod(text, &end) * scale;
    if (end == text || *end || !isfinite(number) || number < 0)
        return fracas_fail(FRACAS_USAGE, "%s: --%s is `%s`; it must be a number, 0 or more",
                           arguments->command->name, option, text);
    *value = number;
    return FRACAS_OK;
}

fracas_err fracas_arguments_word(const fracas_arguments *arguments, const char *option,
                                 const char *const *words, size_t count, int *value)
{
    const char *text;
    TRY(value_of(arguments, option, &text));
    if (!text) return FRACAS_OK;
    fracas_words known;
    fracas_words_init(&known, text);
    for (size_t k = 0; k < count; k++) {
        if (!strcmp(words[k], text)) {
            *value = (int)k;
            return FRACAS_OK;
        }
        fracas_words_add(&known, words[k]);
    }
    return fracas_fail(FRACAS_USAGE, "%s: --%s is `%s`%s", arguments->command->name, option, text,
                       fracas_words_hint(&known, "it can be"));
}

/* [days-]hours:minutes:seconds, or hours:minutes:seconds without the days. */
static bool read_clock(const char *text, double *seconds)
{
    unsigned days = 0, hours, minutes, rest;
    int end = 0;
    const bool with_days = sscanf(text, "%u-%u:%2u:%2u%n", &days, &hours, &minutes, &rest, &end) ==
                           4;
    if (!with_days) days = 0;
    if (!with_days && sscanf(text, "%u:%2u:%2u%n", &hours, &minutes, &rest, &end) != 3)
        return false;
    if (text[end] || minutes > 59 || rest > 59 || text[strspn(text, "0123456789:-")]) return false;
    *seconds = 86400.0 * days + 3600.0 * hours + 60.0 * minutes + rest;
    return true;
}

/* Numbers, each with its unit: without one, Slurm and users mean different things. */
static bool read_duration(const char *text, double *seconds)
{
    static const char unit[] = "smhd";
    static const double length[] = {1, 60, 3600, 86400};
    *seconds = 0;
    if (!*text || text[strspn(text, "0123456789.smhd")]) return false;
    while (*text) {
        char *end;
        const double number = strtod(text, &end);
        const char *found = *end ? strchr(unit, *end) : NULL;
        if (end == text || !found) return false;
        *seconds += number * length[found - unit];
        text = end + 1;
    }
    return isfinite(*seconds);
}

fracas_err fracas_arguments_time(const fracas_arguments *arguments, const char *option,
                                 double *seconds)
{
    const char *text;
    double value;
    TRY(value_of(arguments, option, &text));
    if (!text) return FRACAS_OK;
    if ((!read_clock(text, &value) && !read_duration(text, &value)) || value <= 0)
        return fracas_fail(FRACAS_USAGE,
                           "%s: --%s is `%s`; it must be a time above 0 with its unit, such as "
                           "90s, 55m, 1h30m, 2:00:00 or 1-00:00:00",
                           arguments->command->name, option, text);
    *seconds = value;
    return FRACAS_OK;
}

fracas_err fracas_cli_read_time(const fracas_units *units, const char *text, double *seconds)
{
    char spaced[64];
    text += strspn(text, " ");
    const int digits = (int)strspn(text, "+-.0123456789eE");
    snprintf(spaced, sizeof spaced,
             digits > 0 && text[digits] && text[digits] != ' ' ? "%.*s %s" : "%.*s%s", digits, text,
             text + digits);
    return fracas_units_read(units, spaced, "s", seconds);
}
