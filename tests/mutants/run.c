/* SPDX-License-Identifier: MIT */
/* Runs tests on each mutant of a LIST (mutate.c):
 *     run [--only=REGEX] [--share=PERCENT] ROOM LIST SURVIVORS PROGRAM...
 * A PROGRAM is a test by Unity that is linked with all mutants. Each of its cases must pass alone
 * while no mutant is alive. A mutant is found when one of the cases that reach its function fails
 * or crashes, or takes twice as many rounds of its loops as without the mutant, or 10 times the
 * processor's time.
 *
 * SURVIVORS lists the mutants that no test finds: one a line, as this program prints them, below
 * lines that begin with # and say why no test can. An empty line ends what a reason is for. Where
 * the reason begins with "# Open:", nobody has found a reason yet; these are counted apart.
 *
 * --only: the mutants whose file, function, line or change matches that extended regular
 * expression. --share: that part of
 * them, drawn by chance, the same ones each time.
 *
 * Prints each mutant that survives and is not listed, and each listed one that is found or does not
 * exist; ends with 1 if there is one of these. The last line counts, for ROOM. */
#include <fcntl.h>
#include <getopt.h>
#include <regex.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include "mutant.h"

enum { CASES_MAX = 3000, LINE_BYTES = 2000, CPU_LEAST_S = 1, LONG_S = 60 };
enum { ROUNDS_TIMES = 2, ROUNDS_LEAST = 100000, SECONDS_TIMES = 10 };

/* A case of a program; its functions are those that it reaches alone. */
struct test_case {
    const char *program;
    unsigned number;
    double seconds;
    unsigned long long rounds;
    unsigned char *reached;
};

struct mutant {
    char *key; /* NULL: no such mutant */
    unsigned function, line;
    pid_t pid; /* of who judges it */
    bool is_chosen, is_listed, is_open, is_found;
};

static struct test_case cases[CASES_MAX];
static unsigned case_count;
static struct mutant mutants[MUTANTS_MAX];
static unsigned last; /* the highest number */
static const char *survivors;

static void fail(const char *which, const char *what)
{
    fprintf(stderr, "%s: error: %s\n", which, what);
    exit(2);
}

/* Runs a case with one mutant alive; returns its status as waitpid gives it. */
static int run_case(const struct test_case *test, unsigned mutant, unsigned long long rounds,
                    const char *reached, struct rusage *usage)
{
    pid_t pid = fork();
    int status = 0;

    if (pid == 0) {
        char number[30], limit[30], alone[30];
        int nowhere = open("/dev/null", O_RDWR);
        rlim_t most_s = (rlim_t)(test->seconds * SECONDS_TIMES) + CPU_LEAST_S;
        struct rlimit seconds = {most_s, most_s};
        struct rlimit no_core = {0, 0};

        snprintf(number, sizeof number, "%u", mutant);
        snprintf(limit, sizeof limit, "%llu", rounds);
        snprintf(alone, sizeof alone, "%u", test->number);
        setenv("MUTANT", number, 1);
        setenv("MUTANT_ROUNDS", limit, 1);
        setenv("MUTANT_CASE", alone, 1);
        if (reached != NULL) {
            setenv("MUTANT_REACHED", reached, 1);
        }
        dup2(nowhere, 0);
        dup2(nowhere, 1);
        dup2(nowhere, 2);
        setrlimit(RLIMIT_CPU, &seconds);
        setrlimit(RLIMIT_CORE, &no_core);
        execl(test->program, test->program, (char *)NULL);
        _exit(127);
    }
    if (pid < 0 || wait4(pid, &status, 0, usage) != pid) {
        fail(test->program, "cannot be started");
    }
    return status;
}

/* Runs case NUMBER without a mutant: it must pass, and says what it reaches. Returns the number of
 * the program's cases. */
static unsigned measure(struct test_case *test, const char *program, unsigned number)
{
    char path[] = "/tmp/mutants.XXXXXX";
    struct rusage usage;
    FILE *file;
    int made = mkstemp(path);
    unsigned count;

    if (made < 0) {
        fail(path, "cannot be made");
    }
    close(made);
    *test = (struct test_case){program, number, LONG_S, 0, calloc(FUNCTIONS_MAX, 1)};
    if (run_case(test, 0, ~0ULL, path, &usage) != 0) {
        char text[LINE_BYTES];

        snprintf(text, sizeof text, "%s MUTANT_CASE=%u", program, number);
        fail(text, "fails without a mutant; see what it prints");
    }
    test->seconds = (double)usage.ru_utime.tv_sec + (double)usage.ru_utime.tv_usec / 1e6;
    file = fopen(path, "r");
    if (test->reached == NULL || file == NULL ||
        fscanf(file, "%u %llu", &count, &test->rounds) != 2 || getc(file) != '\n' ||
        fread(test->reached, 1, FUNCTIONS_MAX, file) != FUNCTIONS_MAX) {
        fail(program, "does not say what it reaches; is it linked with mutant.c?");
    }
    fclose(file);
    unlink(path);
    return count;
}

static void measure_cases(const char *program)
{
    struct test_case all;
    unsigned count = measure(&all, program, ~0U); /* there is no such case: all are only counted */

    free(all.reached);
    for (unsigned i = 1; i <= count; i++) {
        if (case_count == CASES_MAX) {
            fail(program, "has too many cases");
        }
        (void)measure(&cases[case_count++], program, i);
    }
}

static int compare_cases(const void *a, const void *b)
{
    const struct test_case *x = a, *y = b;

    return x->seconds < y->seconds ? -1 : x->seconds > y->seconds;
}

static bool is_found(unsigned mutant)
{
    for (unsigned i = 0; i < case_count; i++) {
        const struct test_case *test = &cases[i];
        struct rusage usage;

        if (test->reached[mutants[mutant].function] &&
            run_case(test, mutant, test->rounds * ROUNDS_TIMES + ROUNDS_LEAST, NULL, &usage) != 0) {
            return true;
        }
    }
    return false;
}

static bool is_reached(unsigned mutant)
{
    for (unsigned i = 0; i < case_count; i++) {
        if (cases[i].reached[mutants[mutant].function]) {
            return true;
        }
    }
    return false;
}

/* Says what is wrong with one that has been judged. */
static void say(unsigned mutant)
{
    const struct mutant *judged = &mutants[mutant];

    if (judged->is_found && judged->is_listed) {
        printf("%s: error: a test finds this mutant; delete its line:\n%s\n", survivors,
               judged->key);
    } else if (!judged->is_found && !judged->is_listed) {
        printf("%.*s:%u: error: no test %s this mutant; write one, or add it to %s:\n%s\n",
               (int)strcspn(judged->key, "\t"), judged->key, judged->line,
               is_reached(mutant) ? "finds" : "reaches", survivors, judged->key);
    }
    fflush(stdout);
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
    say(i);
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
    regex_t chosen;

    if (regcomp(&chosen, only, REG_EXTENDED | REG_NOSUB) != 0) {
        fail(only, "is no regular expression");
    }
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
        mutants[number].is_chosen = regexec(&chosen, line + key, 0, NULL, 0) == 0;
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
static unsigned read_survivors(const char *path)
{
    static const char open[] = "# Open:";
    FILE *file = open_list(path);
    char line[LINE_BYTES];
    unsigned wrong = 0, number = 0;
    bool has_reason = false, is_open = false;

    while (fgets(line, sizeof line, file) != NULL) {
        unsigned mutant;

        number++;
        line[strcspn(line, "\n")] = '\0';
        if (line[0] == '#' || line[0] == '\0') {
            is_open = line[0] == '#' &&
                      ((has_reason && is_open) || strncmp(line, open, strlen(open)) == 0);
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
            mutants[mutant].is_open = is_open;
        }
    }
    fclose(file);
    return wrong;
}

/* Keeps so many percent of the chosen ones, by their text: when one comes or goes, the others stay
 * the same. */
static void draw(unsigned share_pct)
{
    for (unsigned i = 1; i <= last; i++) {
        uint64_t hash = 14695981039346656037U; /* FNV-1a */

        for (const char *c = mutants[i].is_chosen ? mutants[i].key : ""; *c != '\0'; c++) {
            hash = (hash ^ (unsigned char)*c) * 1099511628211U;
        }
        mutants[i].is_chosen = mutants[i].is_chosen && (hash >> 32) % 100 < share_pct;
    }
}

/* Prints the counts; returns whether all is well. */
static bool report(const char *room, unsigned wrong)
{
    unsigned chosen = 0, found = 0, equivalent = 0, open = 0, unlisted = 0;

    for (unsigned i = 1; i <= last; i++) {
        const struct mutant *mutant = &mutants[i];

        if (!mutant->is_chosen) {
            continue;
        }
        chosen++;
        if (mutant->is_found) {
            found++;
            wrong += mutant->is_listed;
        } else if (!mutant->is_listed) {
            unlisted++;
        } else if (mutant->is_open) {
            open++;
        } else {
            equivalent++;
        }
    }
    printf("%s: %u of %u mutants: %u found; %u survive: %u equivalent, %u open, %u not listed\n",
           room, chosen, last, found, equivalent + open + unlisted, equivalent, open, unlisted);
    return unlisted == 0 && wrong == 0;
}

int main(int count, char **args)
{
    static const struct option options[] = {
        {"only", required_argument, NULL, 'o'}, {"share", required_argument, NULL, 's'}, {0}};
    const char *only = "", *room;
    unsigned share_pct = 100, wrong;
    int option;

    while ((option = getopt_long(count, args, "", options, NULL)) != -1) {
        if (option == 'o') {
            only = optarg;
        } else if (option == 's') {
            share_pct = (unsigned)strtoul(optarg, NULL, 10);
        } else {
            return 2;
        }
    }
    if (count - optind < 4) {
        fprintf(stderr,
                "usage: run [--only=REGEX] [--share=PERCENT] ROOM LIST SURVIVORS PROGRAM...\n");
        return 2;
    }
    room = args[optind++];
    read_mutants(args[optind++], only);
    survivors = args[optind++];
    wrong = read_survivors(survivors);
    draw(share_pct);
    while (optind < count) {
        measure_cases(args[optind++]);
    }
    qsort(cases, case_count, sizeof *cases, compare_cases);
    judge_all();
    return report(room, wrong) ? 0 : 1;
}
