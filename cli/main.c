/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The program fracas. */
#include "cli/cli.h"

#include "base/isa.h"
#include "base/text.h"
#include "base/version.h"
#include "campaigns/campaign.h"
#include "campaigns/file/words.h"
#include "campaigns/scheduler/run.h"
#include "campaigns/scheduler/status/channel.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

const fracas_command *const fracas_commands[] = {
    &fracas_command_run,        &fracas_command_plan,          &fracas_command_status,
    &fracas_command_report,     &fracas_command_fit,           &fracas_command_export,
    &fracas_command_compare,    &fracas_command_picture,       &fracas_command_verify,
    &fracas_command_replay,     &fracas_command_sample,        &fracas_command_distributions,
    &fracas_command_reference,  &fracas_command_extend,        &fracas_command_retry,
    &fracas_command_merge,      &fracas_command_merge_studies, &fracas_command_reindex,
    &fracas_command_gc,         &fracas_command_submit,        &fracas_command_converge,
    &fracas_command_bench,      &fracas_command_doctor,        &fracas_command_man,
    &fracas_command_completion, &fracas_command_init,          NULL,
};

static void print_usage(FILE *out)
{
    fputs("fracas " FRACAS_VERSION ": " FRACAS_PROGRAM_DOC "\n\nusage:\n", out);
    for (size_t i = 0; fracas_commands[i]; i++) {
        char call[40];
        const fracas_command *command = fracas_commands[i];
        const char *second = command->second ? command->second : "";
        snprintf(call, sizeof call, "%s %s %s", command->name, fracas_operand_text(command).text,
                 second);
        fprintf(out, "  fracas %-17s %s\n", call, command->doc);
    }
    fputs("  fracas help COMMAND      what COMMAND does, and its options\n"
          "  fracas --version         the version, and what computes here\n",
          out);
}

static void print_help(const fracas_command *command)
{
    printf("usage: fracas %s%s%s%s%s%s\n\n%s.\n%s", command->name, command->operand ? " " : "",
           fracas_operand_text(command).text, command->second ? " " : "",
           command->second ? command->second : "", command->options ? " [options]" : "",
           command->doc, command->more);
    if (command->options) puts("\noptions:");
    for (const fracas_option *option = command->options; option && option->name; option++) {
        char call[40];
        if (!fracas_option_is_shown(command, option)) continue;
        snprintf(call, sizeof call, "--%s %s", option->name,
                 option->argument ? option->argument : "");
        printf("  %-28s %s\n", call, option->doc);
    }
}

fracas_err fracas_command_find(const char *name, const fracas_command **command)
{
    fracas_words words;
    fracas_words_init(&words, name);
    for (size_t i = 0; fracas_commands[i]; i++) {
        *command = fracas_commands[i];
        if (!strcmp((*command)->name, name)) return FRACAS_OK;
        fracas_words_add(&words, (*command)->name);
    }
    fracas_words_add(&words, "help");
    return fracas_fail(FRACAS_USAGE, "unknown command `%s`%s", name,
                       fracas_words_hint(&words, "there are"));
}

static fracas_err run(const fracas_arguments *arguments)
{
    OWN(fracas_campaign) campaign = NULL;
    const fracas_command *command = arguments->command;
    const bool file = command->operand && !strcmp(command->operand, "FILE") && !command->from_study;
    if (file && arguments->operand && fracas_cli_is_study_file(arguments->operand))
        return fracas_fail(FRACAS_USAGE,
                           "%s: %s is a file of results, not a campaign file: `fracas export %s "
                           "--study NEW` makes a study of it, which goes on, and NEW/campaign.yaml",
                           command->name, arguments->operand,
                           fracas_shell_path(arguments->operand, NULL).text);
    if (arguments->command->run) return arguments->command->run(arguments);
    TRY(fracas_cli_read_campaign(arguments->operand, &campaign));
    return arguments->command->run_on(arguments, campaign);
}

/* The folder of FOLDER/study.h5, where an operand names the file in place of the study; freed by
 * the caller. */
static fracas_err take_folder(const char **operand, char **folder)
{
    static const char name[] = "study.h5";
    struct stat status;
    *folder = NULL;
    if (!*operand || stat(*operand, &status) || !S_ISREG(status.st_mode)) return FRACAS_OK;
    const char *base = strrchr(*operand, '/'), *file = base ? base + 1 : *operand;
    if (strcmp(file, name) != 0) return FRACAS_OK;
    *folder = base == *operand ? strdup("/")
              : base           ? strndup(*operand, (size_t)(base - *operand))
                               : strdup(".");
    *operand = *folder;
    return *folder ? FRACAS_OK : fracas_no_memory("the name of a folder");
}

static fracas_err run_command(int argc, char **argv)
{
    OWNED char *first = NULL, *second = NULL;
    const fracas_command *command;
    fracas_arguments arguments;
    TRY(fracas_command_find(argv[1], &command));
    TRY(fracas_arguments_read(command, argc, argv, &arguments));
    if (command->operand && (command->second || !strcmp(command->operand, "STUDY"))) {
        TRY(take_folder(&arguments.operand, &first));
        TRY(take_folder(&arguments.second, &second));
    }
    if (!arguments.help)
        return fracas_cli_remedy(arguments.second,
                                 fracas_cli_remedy(arguments.operand, run(&arguments)));
    print_help(command);
    return FRACAS_OK;
}

static fracas_err help(int argc, char **argv)
{
    if (argc < 3 || !strcmp(argv[2], "help")) {
        print_usage(stdout);
        return FRACAS_OK;
    }
    const fracas_command *command;
    TRY(fracas_command_find(argv[2], &command));
    print_help(command);
    return FRACAS_OK;
}

static fracas_err dispatch(int argc, char **argv)
{
    if (argc < 2) {
        print_usage(stderr);
        return fracas_fail(FRACAS_USAGE, "no command given");
    }
    if (!strcmp(argv[1], "help") || !strcmp(argv[1], "--help") || !strcmp(argv[1], "-h"))
        return help(argc, argv);
    if (!strcmp(argv[1], "--version")) {
        fracas_isa isa;
        TRY(fracas_isa_choose(FRACAS_ISA_BEST, &isa));
        printf("fracas " FRACAS_VERSION "\nkernels for %s by %s\n", fracas_isa_name[isa],
               fracas_compiler);
        return FRACAS_OK;
    }
    return run_command(argc, argv);
}

#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/lsan_interface.h>
/* Open MPI and its unloaded plugins leak memory without names for a suppression: a process with
 * MPI_Init is not searched for leaks. */
int __lsan_is_turned_off(void)
{
    return fracas_run_is_rank();
}
#endif

/* A closed standard stream must not become a file of the study, nor a pipe. */
static void open_standard_streams(void)
{
    for (int fd; (fd = open("/dev/null", O_RDWR)) >= 0;) {
        if (fd <= STDERR_FILENO) continue;
        close(fd);
        break;
    }
}

/* HDF5 ends the program by exit(-1) where it has no memory to note an error. */
static void say_why_hdf5_ends(int status, void *unused)
{
    static const char text[] = "fracas: no memory for HDF5; free some, or use fewer --jobs\n";
    (void)unused;
    if ((status & 0xff) != 0xff) return;
    fputs(text, stderr);
    _exit(FRACAS_ENVIRONMENT);
}

/* Each line of the message: those of a campaign file with several errors. */
static void print_message(void)
{
    for (const char *line = fracas_message(); line;) {
        const char *end = strchr(line, '\n');
        fprintf(stderr, "fracas: %.*s\n", end ? (int)(end - line) : (int)strlen(line), line);
        line = end ? end + 1 : NULL;
    }
}

int main(int argc, char **argv)
{
    on_exit(say_why_hdf5_ends, NULL);
    open_standard_streams();
    signal(SIGCHLD, SIG_DFL); /* nobody can wait for a child where it is ignored */
    if (!getenv(FRACAS_LAUNCHER_MARK)) fracas_text_guard_stdout(); /* else the status channel */
    fracas_err code = dispatch(argc, argv);
    const bool bad = ferror(stdout);
    if ((fclose(stdout) || bad) && !code)
        code = fracas_fail(FRACAS_ENVIRONMENT,
                           "the output could not be written; is the disk full?");
    if (code) print_message();
    if (code == FRACAS_BUG)
        fputs("fracas: this is a fault of fracas, not yours. Please report it with this message, "
              "the version (" FRACAS_VERSION "),\nfracas: the command line, and the campaign file "
              "or, if there is one, the study folder.\n",
              stderr);
    return code;
}
