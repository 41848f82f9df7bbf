/* SPDX-License-Identifier: MIT */
/* Runs tests on each mutant of a LIST (mutate.c):
 *     run [--only=TEXT] [--sample=N] LIST EQUIVALENT PROGRAM...
 * A PROGRAM is a test that is linked with all mutants, a command with its arguments. It must pass
 * while no mutant is alive. A mutant is found when one of the programs that reach it fails or
 * crashes, or takes twice as many rounds of its loops as without the mutant, or 10 times the
 * processor's time.
 *
 * EQUIVALENT lists the mutants that no test can find: one a line, as this program prints them,
 * below lines that begin with # and say why. An empty line ends what a reason is for.
 *
 * --only: the mutants whose file, function, line or change has that text. --sample: so many, drawn
 * by chance, the same ones each time.
 *
 * Prints each mutant that survives and is not listed, and each listed one that is found or does not
 * exist; ends with 1 if there is one of these. The last line counts. */
#include <fcntl.h>
#include <getopt.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "mutant.h"

enum { PROGRAMS_MAX = 200, LINE_BYTES = 2000, CPU_LEAST_S = 3, WORDS_MAX = 20 };
enum { ROUNDS_TIMES = 2, ROUNDS_LEAST = 100000, SECONDS_TIMES = 10 };

struct program {
    char *command;
    double seconds;
    unsigned long long rounds;
    unsigned char *reached;
};

struct mutant {
    char *key; /* NULL: no such mutant */
    unsigned function, line;
    pid_t pid; /* of who judges it */
    bool is_chosen, is_listed, is_found;
};

static struct program programs[PROGRAMS_MAX];
static unsigned program_count;
static struct mutant mutants[MUTANTS_MAX];
static unsigned last; /* the highest number */

static void fail(const char *which, const char *what)
{
    fprintf(stderr, "%s: error: %s\n", which, what);
    exit(2);
}

static void split(char *text, char **words)
{
    unsigned count = 0;

    for (char *word = strtok(text, " "); word != NULL && count + 1 < WORDS_MAX;
         word = strtok(NULL, " ")) {
        words[count++] = word;
    }
    words[count] = NULL;
}

/* Runs a program with one mutant alive; returns its status as waitpid gives it. */
static int run_program(const struct program *program, unsigned mutant, unsigned long long rounds,
                       const char *reached, struct rusage *usage)
{
    pid_t pid = fork();
    int status = 0;

    if (pid == 0) {
        char number[30], limit[30], *words[WORDS_MAX];
        int nowhere = open("/dev/null", O_RDWR);
        rlim_t most_s = (rlim_t)(program->seconds * SECONDS_TIMES) + CPU_LEAST_S;
        struct rlimit seconds = {most_s, most_s};
        struct rlimit no_core = {0, 0};

        snprintf(number, sizeof number, "%u", mutant);
        snprintf(limit, sizeof limit, "%llu", rounds);
        setenv("MUTANT", number, 1);
        setenv("MUTANT_ROUNDS", limit, 1);
        if (reached != NULL) {
            setenv("MUTANT_REACHED", reached, 1);
        }
        dup2(nowhere, 0);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        setrlimit(RLIMIT_CPU, &seconds);
        setrlimit(RLIMIT_CORE, &no_core);
        split(program->command, words);
        execv(words[0], words);
        _exit(127);
    }
    if (pid < 0 || wait4(pid, &status, 0, usage) != pid) {
        fail(program->command, "cannot be started");
    }
    return status;
}

/* Without a mutant: it must pass, and says what it reaches. */
static void measure(struct program *program)
{
    enum { LONG_S = 60 };
    char path[] = "/tmp/mutants.XXXXXX";
    struct rusage usage;
    FILE *file;
    int made = mkstemp(path);

    if (made < 0) {
        fail(path, "cannot be made");
    }
    close(made);
    program->seconds = LONG_S;
    if (run_program(program, 0, ~0ULL, path, &usage) != 0) {
        fail(program->command, "fails without a mutant; see what it prints");
    }
    program->seconds = (double)usage.ru_utime.tv_sec + (double)usage.ru_utime.tv_usec / 1e6;
    program->reached = calloc(FUNCTIONS_MAX, 1);
    file = fopen(path, "r");
    if (program->reached == NULL || file == NULL || fscanf(file, "%llu", &program->rounds) != 1 ||
        getc(file) != '\n' || fread(program->reached, 1, FUNCTIONS_MAX, file) != FUNCTIONS_MAX) {
        fail(program->command, "does not say what it reaches; is it linked with mutant.c?");
    }
    fclose(file);
    unlink(path);
}

static int compare_programs(const void *a, const void *b)
{
    const struct program *x = a, *y = b;

    return x->seconds < y->seconds ? -1 : x->seconds > y->seconds;
}

static bool is_found(unsigned mutant)
{
    for (unsigned i = 0; i < program_count; i++) {
        const struct program *program = &programs[i];
        struct rusage usage;

        if (program->reached[mutants[mutant].function] &&
            run_program(program, mutant, program->rounds * ROUNDS_TIMES + ROUNDS_LEAST, NULL,
                        &usage) != 0) {
            return true;
        }
    }
    return false;
}

static bool is_reached(unsigned mutant)
{
    for (unsigned i = 0; i < program_count; i++) {
        if (programs[i].reached[mutants[mutant].function]) {
            return true;
        }
    }
    return false;
}

/* Waits for one of those who judge. */
static void collect(void)
{
    int status;
    pid_t pid = wait(&status);
    unsigned i = 1;

    while (i <= last && (pid <= 0 || mutants[i].pid != pid)) {
        i++;
    }
    if (i > last || !WIFEXITED(status) || WEXITSTATUS(status) > 1) {
        fail("run", "a mutant could not be judged");
    }
    mutants[i].is_found = WEXITSTATUS(status) == 0;
    mutants[i].pid = 0;
}

/* So many at a time as there are processors. */
static void judge_all(void)
{
    unsigned running = 0, most = (unsigned)sysconf(_SC_NPROCESSORS_ONLN);

    for (unsigned i = 1; i <= last; i++) {
        if (!mutants[i].is_chosen) {
            continue;
        }
        if (running == most) {
            collect();
            running--;
        }
        mutants[i].pid = fork();
        if (mutants[i].pid == 0) {
            _exit(is_found(i) ? 0 : 1);
        }
        running++;
    }
    while (running != 0) {
        collect();
        running--;
    }
}

static FILE *open_list(const char *path)
{
    FILE *file = fopen(path, "r");

    if (file == NULL) {
        fail(path, "cannot be read");
    }
    return file;
}

static void read_mutants(const char *path, const char *only)
{
    FILE *file = open_list(path);
    char line[LINE_BYTES];

    while (fgets(line, sizeof line, file) != NULL) {
        unsigned number, function, place;
        int key;

        line[strcspn(line, "\n")] = '\0';
        if (sscanf(line, "%u\t%u\t%u\t%n", &number, &function, &place, &key) != 3 || number == 0 ||
            number >= MUTANTS_MAX || function >= FUNCTIONS_MAX) {
            fail(path, "is no list of mutants, or a too long one");
        }
        mutants[number].key = strdup(line + key);
        mutants[number].function = function;
        mutants[number].line = place;
        mutants[number].is_chosen = only == NULL || strstr(line + key, only) != NULL;
        last = number > last ? number : last;
    }
    fclose(file);
}

static unsigned find_mutant(const char *key)
{
    unsigned i = last;

    while (i != 0 && (mutants[i].key == NULL || strcmp(mutants[i].key, key) != 0)) {
        i--;
    }
    return i;
}

/* Returns the number of wrong lines. */
static unsigned read_equivalent(const char *path)
{
    FILE *file = open_list(path);
    char line[LINE_BYTES];
    unsigned wrong = 0, number = 0;
    bool has_reason = false;

    while (fgets(line, sizeof line, file) != NULL) {
        unsigned mutant;

        number++;
        line[strcspn(line, "\n")] = '\0';
        if (line[0] == '#' || line[0] == '\0') {
            has_reason = line[0] == '#';
            continue;
        }
        mutant = find_mutant(line);
        if (!has_reason) {
            printf("%s:%u: error: no reason; write it above, after #\n", path, number);
            wrong++;
        } else if (mutant == 0) {
            printf("%s:%u: error: there is no such mutant; delete the line: %s\n", path, number,
                   line);
            wrong++;
        } else {
            mutants[mutant].is_listed = true;
        }
    }
    fclose(file);
    return wrong;
}

/* Keeps that many of the chosen ones. */
static void draw(unsigned wanted)
{
    uint64_t random = 88172645463325252U;
    unsigned chosen = 0;

    for (unsigned i = 1; i <= last; i++) {
        chosen += mutants[i].is_chosen;
    }
    while (chosen > wanted) {
        unsigned i;

        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        i = 1 + (unsigned)((random >> 32) % last);
        chosen -= mutants[i].is_chosen;
        mutants[i].is_chosen = false;
    }
}

/* Prints what is wrong, and the counts; returns whether all is well. */
static bool report(const char *equivalent, unsigned wrong)
{
    unsigned chosen = 0, found = 0, listed = 0, survived = 0;

    for (unsigned i = 1; i <= last; i++) {
        const struct mutant *mutant = &mutants[i];

        if (!mutant->is_chosen) {
            continue;
        }
        chosen++;
        found += mutant->is_found;
        if (mutant->is_found && mutant->is_listed) {
            wrong++;
            printf("%s: error: a test finds this mutant; delete its line:\n%s\n", equivalent,
                   mutant->key);
        } else if (!mutant->is_found && mutant->is_listed) {
            listed++;
        } else if (!mutant->is_found) {
            survived++;
            printf("%.*s:%u: error: no test %s this mutant; write one, or add it to %s:\n%s\n",
                   (int)strcspn(mutant->key, "\t"), mutant->key, mutant->line,
                   is_reached(i) ? "finds" : "reaches", equivalent, mutant->key);
        }
    }
    printf("%u mutants: %u found, %u equivalent, %u survived\n", chosen, found, listed, survived);
    return survived == 0 && wrong == 0;
}

int main(int count, char **args)
{
    static const struct option options[] = {
        {"only", required_argument, NULL, 'o'}, {"sample", required_argument, NULL, 's'}, {0}};
    const char *only = NULL, *equivalent;
    unsigned sample = MUTANTS_MAX, wrong;
    int option;

    while ((option = getopt_long(count, args, "", options, NULL)) != -1) {
        if (option == 'o') {
            only = optarg;
        } else if (option == 's') {
            sample = (unsigned)strtoul(optarg, NULL, 10);
        } else {
            return 2;
        }
    }
    if (count - optind < 3 || count - optind - 2 > PROGRAMS_MAX) {
        fprintf(stderr, "usage: run [--only=TEXT] [--sample=N] LIST EQUIVALENT PROGRAM...\n");
        return 2;
    }
    read_mutants(args[optind++], only);
    equivalent = args[optind++];
    wrong = read_equivalent(equivalent);
    draw(sample);
    while (optind < count) {
        programs[program_count].command = args[optind++];
        measure(&programs[program_count++]);
    }
    qsort(programs, program_count, sizeof *programs, compare_programs);
    judge_all();
    return report(equivalent, wrong) ? 0 : 1;
}
