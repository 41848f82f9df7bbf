/* SPDX-License-Identifier: MIT */
/* Help, manual page and bash completion from argp's tables. */
#include "manual.h"

#include <ctype.h>
#include <errno.h>
#include <string.h>

#include "diag.h"

static bool has_commands(const struct manual *manual)
{
    return manual->command[0].name != NULL;
}

/* Calls VISIT for each option of ARGP and of its children. */
static void each_option(const struct argp *argp, FILE *out,
                        void (*visit)(FILE *out, const struct argp_option *option))
{
    for (const struct argp_option *o = argp->options; o != NULL && (o->name || o->key || o->doc);
         o++) {
        if (o->name != NULL && !(o->flags & OPTION_HIDDEN)) {
            visit(out, o);
        }
    }
    for (const struct argp_child *c = argp->children; c != NULL && c->argp != NULL; c++) {
        each_option(c->argp, out, visit);
    }
}

/* --- help ------------------------------------------------------------------------------------ */

void manual_help(FILE *out, const struct manual *manual)
{
    fprintf(out, "Usage: %s %s\n\n", manual->program, manual->usage);
    for (size_t i = 0; i < manual->commands; i++) {
        fprintf(out, "  %-8s %s\n", manual->command[i].name, manual->command[i].help);
    }
    fprintf(out, "\n%s\n\n`%s COMMAND --help` lists the options of a command.\n", manual->about,
            manual->program);
}

/* --- the manual page ------------------------------------------------------------------------- */

/* Text for roff: \ and - are written so that they stay, a line does not begin with a dot. */
static void put_roff(FILE *out, const char *text, size_t length)
{
    bool at_start = true;

    for (size_t i = 0; i < length; i++) {
        if (text[i] == '\\') {
            fputs("\\e", out);
        } else if (text[i] == '-') {
            fputs("\\-", out);
        } else {
            if (at_start && (text[i] == '.' || text[i] == '\'')) {
                fputs("\\&", out);
            }
            putc(text[i], out);
        }
        at_start = text[i] == '\n';
    }
}

/* Paragraphs, apart by empty lines; the ones that begin with a blank are examples. */
static void put_paragraphs(FILE *out, const char *text)
{
    while (*text != '\0') {
        const char *end = strstr(text, "\n\n");
        size_t length = end != NULL ? (size_t)(end - text) : strlen(text);

        fputs(*text == ' ' ? ".PP\n.EX\n" : ".PP\n", out);
        put_roff(out, text, length);
        fputs(*text == ' ' ? "\n.EE\n" : "\n", out);
        text += length + strspn(text + length, "\n");
    }
}

static void put_option(FILE *out, const struct argp_option *option)
{
    fputs(".TP\n.B ", out);
    if (option->key < 128 && isprint(option->key)) {
        fprintf(out, "\\-%c", option->key);
        fprintf(out, option->arg != NULL ? " \\fI%s\\fP, " : ", ",
                option->arg != NULL ? option->arg : "");
    }
    fputs("\\-\\-", out);
    put_roff(out, option->name, strlen(option->name));
    if (option->arg != NULL) {
        fprintf(out, "=\\fI%s\\fP", option->arg);
    }
    putc('\n', out);
    put_roff(out, option->doc, strlen(option->doc));
    putc('\n', out);
}

/* What argp prints before the options, and after them behind a \v. */
static void put_doc(FILE *out, const char *doc)
{
    size_t before = strcspn(doc, "\v");

    fputs(".PP\n", out);
    put_roff(out, doc, before);
    putc('\n', out);
    if (doc[before] != '\0') {
        put_paragraphs(out, doc + before + 1);
    }
}

static void put_capitals(FILE *out, const char *text)
{
    for (; *text != '\0'; text++) {
        putc(toupper((unsigned char)*text), out);
    }
}

/* The ways to give the arguments, one a line. */
static void put_ways(FILE *out, const char *ways)
{
    for (; *ways != '\0'; ways += strspn(ways, "\n")) {
        size_t length = strcspn(ways, "\n");

        put_roff(out, ways, length);
        ways += length;
        fputs(*ways != '\0' ? "\n.br\n" : "\n", out);
    }
}

static void write_man(FILE *out, const struct manual *manual)
{
    fputs(".TH ", out);
    put_capitals(out, manual->program);
    fprintf(out, " 1 \"\" \"%s\" \"User Commands\"\n.SH NAME\n%s \\- ", argp_program_version,
            manual->program);
    put_roff(out, manual->brief, strlen(manual->brief));
    fputs("\n.SH SYNOPSIS\n", out);
    for (size_t i = 0; i < manual->commands; i++) {
        const struct manual_command *command = &manual->command[i];

        fprintf(out, "%s.B %s%s%s\n.RI [ OPTION ...]\n", i > 0 ? ".br\n" : "", manual->program,
                has_commands(manual) ? " " : "", has_commands(manual) ? command->name : "");
        put_ways(out, command->argp->args_doc);
    }
    fputs(".SH DESCRIPTION\n", out);
    put_paragraphs(out, manual->about);
    for (size_t i = 0; i < manual->commands; i++) {
        const struct manual_command *command = &manual->command[i];

        if (has_commands(manual)) {
            fputs(".SH ", out);
            put_capitals(out, command->name);
            putc('\n', out);
        }
        if (command->argp->doc != NULL) {
            put_doc(out, command->argp->doc);
        }
        if (!has_commands(manual)) {
            fputs(".SH OPTIONS\n", out);
        }
        each_option(command->argp, out, put_option);
    }
    fputs(
        ".SH EXIT STATUS\n.TP\n.B 0\nAll is well.\n.TP\n.B 1\nThe input is bad, or an outcome does "
        "not hold; no output file was written or changed.\n.TP\n.B 2\nThe command line is bad, or "
        "a program that is needed failed.\n",
        out);
}

/* --- bash completion ------------------------------------------------------------------------- */

static void put_word(FILE *out, const struct argp_option *option)
{
    if (option->key < 128 && isprint(option->key)) {
        fprintf(out, "-%c ", option->key);
    }
    fprintf(out, "--%s%s ", option->name, option->arg != NULL ? "=" : "");
}

static void put_words(FILE *out, const struct argp *argp)
{
    each_option(argp, out, put_word);
    fputs("--help --version", out);
}

static void write_completion(FILE *out, const struct manual *manual)
{
    const char *program = manual->program;

    fprintf(out,
            "# bash completion of %s; made by `%s --completion`\n"
            "_%s()\n"
            "{\n"
            "    local current=${COMP_WORDS[COMP_CWORD]} words=\n",
            program, program, program);
    if (has_commands(manual)) {
        fputs("    case ${COMP_WORDS[1]} in\n", out);
        for (size_t i = 0; i < manual->commands; i++) {
            fprintf(out, "    %s) words='", manual->command[i].name);
            put_words(out, manual->command[i].argp);
            fputs("' ;;\n", out);
        }
        fputs("    esac\n    if ((COMP_CWORD == 1)); then\n        COMPREPLY=($(compgen -W '", out);
        for (size_t i = 0; i < manual->commands; i++) {
            fprintf(out, "%s ", manual->command[i].name);
        }
        fputs("--help --version' -- \"$current\"))\n        return\n    fi\n", out);
    } else {
        fputs("    words='", out);
        put_words(out, manual->command[0].argp);
        fputs("'\n", out);
    }
    fprintf(out,
            "    if [[ $current == -* ]]; then\n"
            "        COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
            "        [[ ${COMPREPLY[0]-} != *= ]] || compopt -o nospace 2>/dev/null\n"
            "    fi\n"
            "}\n"
            "complete -o default -F _%s %s\n",
            program, program);
}

bool manual_option(const struct manual *manual, const char *option, int *status)
{
    if (strcmp(option, "--man") == 0) {
        write_man(stdout, manual);
    } else if (strcmp(option, "--completion") == 0) {
        write_completion(stdout, manual);
    } else if (has_commands(manual) &&
               (strcmp(option, "--help") == 0 || strcmp(option, "-?") == 0)) {
        manual_help(stdout, manual);
    } else if (has_commands(manual) &&
               (strcmp(option, "--version") == 0 || strcmp(option, "-V") == 0)) {
        puts(argp_program_version);
    } else {
        return false;
    }
    *status = fflush(stdout) == 0 ? EXIT_FINE
                                  : diag_error("stdout", 0, "cannot write: %s", strerror(errno));
    return true;
}
