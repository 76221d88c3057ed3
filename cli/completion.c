/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command completion: scripts for shells from the tables that `fracas help` prints. */
#include "cli/cli.h"

#include "base/version.h"
#include "campaigns/file/catalog.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* Prints each word of a value, "lease|none", after `before`. */
static void print_alternatives(const char *argument, const char *before)
{
    for (const char *word = argument; *word;) {
        const int length = (int)strcspn(word, "|");
        printf("%s%.*s", before, length, word);
        word += length + (word[length] == '|');
    }
}

/* Words that a value, or an operand, of this name can be. */
typedef struct {
    const char *argument;
    fracas_err (*print)(const char *before);
} vocabulary;

static fracas_err print_commands(const char *before)
{
    for (const fracas_command *const *command = fracas_commands; *command; command++)
        printf("%s%s", before, (*command)->name);
    return FRACAS_OK;
}

static fracas_err print_shells(const char *before);

/* Paths of keys, which are columns of points. */
static fracas_err print_keys(const char *before)
{
    OWN(fracas_campaign_memory) memory = fracas_memory_create();
    const fracas_catalog *catalog;
    if (!memory) return fracas_no_memory("the list of keys");
    TRY(fracas_catalog_make(memory, &catalog));
    for (size_t i = 0; i < catalog->nleaves; i++) printf("%s%s", before, catalog->leaf[i].path);
    return FRACAS_OK;
}

static fracas_err print_models(const char *before)
{
    for (size_t m = 0; m < fracas_engine_sections[0]->nkinds; m++)
        printf("%s%s", before, fracas_engine_sections[0]->kinds[m]->name);
    return FRACAS_OK;
}

static const vocabulary vocabularies[] = {
    {"COMMAND", print_commands}, {"COLUMNS", print_keys}, {"KEY", print_keys},
    {"MODEL", print_models},     {"SHELL", print_shells},
};

/* The words of a value or operand, each after `before`; none: any. One in small letters is such a
 * word itself. */
static fracas_err print_words(const char *argument, const char *before)
{
    if (strchr(argument, '|') || islower((unsigned char)*argument))
        print_alternatives(argument, before);
    for (size_t v = 0; v < sizeof vocabularies / sizeof *vocabularies; v++)
        if (!strcmp(vocabularies[v].argument, argument)) return vocabularies[v].print(before);
    return FRACAS_OK;
}

static bool is_path(const char *argument)
{
    static const char *const paths[] = {"FILE", "STUDY", "A", "B", "DIR", "FOLDER", "PATH"};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++)
        if (!strcmp(paths[i], argument)) return true;
    return false;
}

/* A text between ' and '; `special` get a backslash. */
static void print_quoted(const char *text, const char *special, const char *quote)
{
    for (; *text; text++)
        if (*text == '\'') fputs(quote, stdout);
        else printf("%s%c", strchr(special, *text) ? "\\" : "", *text);
}

#define EACH_OPTION(option, command)                                                         \
    for (const fracas_option *option = (command)->options; option && option->name; option++) \
        if (fracas_option_is_shown(command, option))

/* ---- bash ---- */

static fracas_err print_bash_command(const fracas_command *command)
{
    printf("    %s)\n        case $before in\n", command->name);
    EACH_OPTION(option, command)
    {
        if (!option->argument) continue;
        printf("        --%s", option->name);
        if (option->letter) printf(" | -%c", option->letter);
        fputs(") words='", stdout);
        TRY(print_words(option->argument, " "));
        printf("' files=%s ;;\n", is_path(option->argument) ? "yes" : "");
    }
    fputs("        *) words='", stdout);
    if (command->operand) TRY(print_words(command->operand, " "));
    EACH_OPTION(option, command) printf(" --%s", option->name);
    printf(" --help' files=%s ;;\n        esac\n        ;;\n",
           command->operand && is_path(command->operand) ? "yes" : "");
    return FRACAS_OK;
}

static fracas_err print_bash(void)
{
    puts("# bash completion of fracas " FRACAS_VERSION ", written by `fracas completion bash`\n"
         "_fracas()\n{\n"
         "    local cur=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words= files= "
         "one\n"
         "    COMPREPLY=()\n"
         "    case $COMP_CWORD:${COMP_WORDS[1]} in\n    1:*)");
    fputs("        words='", stdout);
    TRY(print_commands(" "));
    puts(" help --version' ;;\n    *) case ${COMP_WORDS[1]} in");
    for (const fracas_command *const *command = fracas_commands; *command; command++)
        TRY(print_bash_command(*command));
    fputs("    help) words='", stdout);
    TRY(print_commands(" "));
    puts("' ;;\n    esac ;;\n    esac\n"
         "    while IFS= read -r one; do COMPREPLY+=(\"$one\"); done < <(\n"
         "        compgen -W \"$words\" -- \"$cur\"\n"
         "        [ -z \"$files\" ] || compgen -f -- \"$cur\")\n"
         "}\ncomplete -o filenames -F _fracas fracas");
    return FRACAS_OK;
}

/* ---- zsh ---- */

/* ":NAME:ACTION" of a value. */
static fracas_err print_zsh_value(const char *argument)
{
    fputs(":", stdout);
    print_quoted(argument, ":|", "");
    fputs(":", stdout);
    if (is_path(argument)) {
        fputs("_files", stdout);
        return FRACAS_OK;
    }
    fputs("(", stdout);
    TRY(print_words(argument, " "));
    fputs(")", stdout);
    return FRACAS_OK;
}

/* The option by its name, "--" before it, or by its letter. */
static fracas_err print_zsh_option(const fracas_option *option, const char *dashes,
                                   const char *name)
{
    printf(" \\\n            '%s%s[", dashes, name);
    print_quoted(option->doc, "[]:\\", "'\\''");
    fputs("]", stdout);
    if (option->argument) TRY(print_zsh_value(option->argument));
    fputs("'", stdout);
    return FRACAS_OK;
}

static fracas_err print_zsh_command(const fracas_command *command)
{
    printf("    %s)\n        _arguments '--help[its help]'", command->name);
    EACH_OPTION(option, command)
    {
        const char letter[] = {option->letter, '\0'};
        TRY(print_zsh_option(option, "--", option->name));
        if (*letter) TRY(print_zsh_option(option, "-", letter));
    }
    for (int second = 0; second < 2; second++) {
        const char *operand = second ? command->second : command->operand;
        if (!operand) continue;
        fputs(" \\\n            '", stdout);
        printf("%d", second + 1);
        TRY(print_zsh_value(operand));
        fputs("'", stdout);
    }
    puts("\n        ;;");
    return FRACAS_OK;
}

static fracas_err print_zsh(void)
{
    puts("#compdef fracas\n# zsh completion of fracas " FRACAS_VERSION
         ", written by `fracas completion zsh`\n"
         "_fracas()\n{\n    local -a commands\n    commands=(");
    for (const fracas_command *const *command = fracas_commands; *command; command++) {
        printf("        '%s:", (*command)->name);
        print_quoted((*command)->doc, ":\\", "'\\''");
        puts("'");
    }
    puts("        'help:what a command does')\n"
         "    if (( CURRENT == 2 )); then _describe command commands; return; fi\n"
         "    local command=$words[2]\n    shift words\n    (( CURRENT-- ))\n    case $command in");
    for (const fracas_command *const *command = fracas_commands; *command; command++)
        TRY(print_zsh_command(*command));
    puts("    help) _describe command commands ;;\n    esac\n}\n_fracas \"$@\"");
    return FRACAS_OK;
}

/* ---- fish ---- */

/* A line of fish for a value: which files or words follow. */
static fracas_err print_fish_value(const char *argument)
{
    if (is_path(argument)) {
        fputs(" -r -F", stdout);
        return FRACAS_OK;
    }
    fputs(" -x -a '", stdout);
    TRY(print_words(argument, " "));
    fputs("'", stdout);
    return FRACAS_OK;
}

static fracas_err print_fish_command(const fracas_command *command)
{
    printf("complete -c fracas -n __fish_use_subcommand -f -a %s -d '", command->name);
    print_quoted(command->doc, "\\", "\\'");
    puts("'");
    if (command->operand && !is_path(command->operand)) {
        printf("complete -c fracas -n '__fish_seen_subcommand_from %s' -f -a '", command->name);
        TRY(print_words(command->operand, " "));
        puts("'");
    }
    EACH_OPTION(option, command)
    {
        printf("complete -c fracas -n '__fish_seen_subcommand_from %s' -l %s", command->name,
               option->name);
        if (option->letter) printf(" -s %c", option->letter);
        if (option->argument) TRY(print_fish_value(option->argument));
        fputs(" -d '", stdout);
        print_quoted(option->doc, "\\", "\\'");
        puts("'");
    }
    return FRACAS_OK;
}

static fracas_err print_fish(void)
{
    puts("# fish completion of fracas " FRACAS_VERSION ", written by `fracas completion fish`");
    for (const fracas_command *const *command = fracas_commands; *command; command++)
        TRY(print_fish_command(*command));
    fputs("complete -c fracas -n '__fish_seen_subcommand_from help' -f -a '", stdout);
    TRY(print_commands(" "));
    puts("'\ncomplete -c fracas -n __fish_use_subcommand -f -a help -d 'What a command does'");
    return FRACAS_OK;
}

/* ---- the command ---- */

static const struct {
    const char *name;
    fracas_err (*print)(void);
} shells[] = {{"bash", print_bash}, {"zsh", print_zsh}, {"fish", print_fish}};

static fracas_err print_shells(const char *before)
{
    for (size_t s = 0; s < sizeof shells / sizeof *shells; s++)
        printf("%s%s", before, shells[s].name);
    return FRACAS_OK;
}

static fracas_err completion(const fracas_arguments *arguments)
{
    for (size_t s = 0; s < sizeof shells / sizeof *shells; s++)
        if (!strcmp(shells[s].name, arguments->operand)) return shells[s].print();
    return fracas_fail(FRACAS_USAGE, "completion: unknown shell `%s`; there are bash, zsh, fish",
                       arguments->operand);
}

const fracas_command fracas_command_completion = {
    .name = "completion",
    .operand = "SHELL",
    .doc = "Prints a script with which SHELL completes command lines: bash, zsh, fish",
    .more = "\nAn installed fracas has them where the shells look. For now, in bash:\n\n"
            "  . <(fracas completion bash)\n",
    .run = completion,
};
