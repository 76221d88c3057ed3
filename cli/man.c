/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command man: manual pages from the tables that `fracas help` prints. */
#include "cli/cli.h"

#include "base/version.h"

#include <stdio.h>
#include <string.h>

/* A text with the characters that roff takes for its own written out. */
static void print_text(const char *text)
{
    for (; *text; text++)
        if (*text == '\\') fputs("\\e", stdout);
        else if (*text == '-') fputs("\\-", stdout);
        else putchar(*text);
}

/* One line of text, which must not begin a request of roff. */
static void print_line(const char *line, size_t length)
{
    char text[1024];
    snprintf(text, sizeof text, "%.*s", (int)length, line);
    if (*text == '.' || *text == '\'') fputs("\\&", stdout);
    print_text(text);
    putchar('\n');
}

/* Paragraphs; indented lines, which are commands, stay lines. */
static void print_paragraphs(const char *text)
{
    bool began = false, kept = false;
    while (*text) {
        const size_t length = strcspn(text, "\n");
        if (length == 0 && began) puts(kept ? ".fi\n.PP" : ".PP");
        if (length == 0) kept = false;
        if (length > 0 && *text == ' ' && !kept) {
            puts(".nf");
            kept = true;
        }
        if (length > 0) print_line(text, length);
        began = began || length > 0;
        text += length + (text[length] == '\n');
    }
    if (kept) puts(".fi");
}

static void print_heading(const char *name, const char *doc)
{
    printf(".TH %s%s 1 \"\" \"fracas " FRACAS_VERSION "\" \"fracas\"\n.SH NAME\nfracas",
           name ? "fracas\\-" : "fracas", name ? name : "");
    if (name) fputs("\\-", stdout);
    if (name) print_text(name);
    fputs(" \\- ", stdout);
    print_text(doc);
    puts("\n.SH SYNOPSIS");
}

static void print_option(const fracas_option *option)
{
    fputs(".TP\n\\fB\\-\\-", stdout);
    print_text(option->name);
    fputs("\\fR", stdout);
    if (option->argument) printf(" \\fI%s\\fR", option->argument);
    if (option->letter) printf(", \\fB\\-%c\\fR", option->letter);
    putchar('\n');
    print_line(option->doc, strlen(option->doc));
}

static void print_call(const fracas_command *command)
{
    fputs("\\fBfracas ", stdout);
    print_text(command->name);
    fputs("\\fR", stdout);
    if (command->operand) printf(" \\fI%s\\fR", fracas_operand_text(command).text);
    if (command->second) printf(" \\fI%s\\fR", command->second);
    puts(command->options ? " [\\fIoptions\\fR]" : "");
}

static void print_command(const fracas_command *command)
{
    print_heading(command->name, command->doc);
    print_call(command);
    puts(".SH DESCRIPTION");
    print_paragraphs(*command->more ? command->more : command->doc);
    if (command->options) puts(".SH OPTIONS");
    for (const fracas_option *option = command->options; option && option->name; option++)
        if (fracas_option_is_shown(command, option)) print_option(option);
    puts(".SH SEE ALSO\n.BR fracas (1)");
}

static void print_program(void)
{
    print_heading(NULL, FRACAS_PROGRAM_DOC);
    puts("\\fBfracas\\fR \\fIcommand\\fR [\\fIoperands\\fR] [\\fIoptions\\fR]\n.SH COMMANDS");
    for (const fracas_command *const *command = fracas_commands; *command; command++) {
        puts(".TP");
        print_call(*command);
        print_line((*command)->doc, strlen((*command)->doc));
    }
    puts(".SH SEE ALSO");
    for (const fracas_command *const *command = fracas_commands; *command; command++) {
        fputs(".BR fracas\\-", stdout);
        print_text((*command)->name);
        puts(command[1] ? " (1)," : " (1)");
    }
}

static fracas_err man(const fracas_arguments *arguments)
{
    const fracas_command *command;
    if (!strcmp(arguments->operand, "fracas")) {
        print_program();
        return FRACAS_OK;
    }
    TRY(fracas_command_find(arguments->operand, &command));
    print_command(command);
    return FRACAS_OK;
}

const fracas_command fracas_command_man = {
    .name = "man",
    .operand = "COMMAND",
    .doc = "Prints the manual page of COMMAND, or of fracas",
    .more = "\nAn installed fracas has these pages: `man fracas-run`. Elsewhere:\n\n"
            "  fracas man run | man -l -\n",
    .run = man,
};
