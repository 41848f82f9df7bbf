/* SPDX-License-Identifier: MIT */
/* Under test: the instructions of tools/drive/sim/mcs52, against s51 of uCsim, which is not
 * ours.
 *
 * Programs are made while our chip runs them: at each address that it comes to, an instruction
 * is put whose operands do no more than an instruction may do here (no timer is started, no byte
 * is sent) and whose way on leads to unused code memory. So each instruction runs once, from
 * whatever state those before it left behind, until each of the 255 has run STATES times.
 * s51 runs the same programs; every CHUNK instructions all RAM, the registers, the program counter
 * and the cycles must be the same, and at a program's end the external RAM. What one instruction
 * does wrong goes into what the next ones do: the way on, the RAM, the cycles.
 *
 * A mutant (tests/mutants) has no s51 of its own: its chip must go through the very states that the
 * chip without a mutant went through just before, and that s51 has confirmed. */
#include "mcs52.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include <unity.h>

enum {
    STATES = 10000,      /* of each instruction */
    MUTANT_STATES = 200, /* that a mutant is judged by */
    CHUNK = 2000,
    ROOM = 6, /* unused bytes that an instruction is put into: it, and a jump away from there */
    RESERVED = 0xA5,
    MOV_A_DATA = 0x74,
    PSW = 0xD0,
    PSW_P = 0x01,
    FILLED = 0x5A, /* external RAM at the start */
    XDATA_LOOKS = 32,
    TICKS_PER_CYCLE = 12
};

/* Registers that are compared, and that direct addresses may name: nothing happens by itself when
 * they are written. The timers stand, so theirs are storage. */
static const uint8_t registers[] = {0x80, 0x81, 0x82, 0x83, 0x8A, 0x8B, 0x8C, 0x8D, 0x90,
                                    0xA0, 0xB0, 0xCA, 0xCB, 0xCC, 0xCD, 0xD0, 0xE0, 0xF0};
static const uint8_t bit_registers[] = {0x80, 0x90, 0xA0, 0xB0, 0xD0, 0xE0, 0xF0};

struct look {
    uint16_t pc;
    uint64_t cycles;
    uint8_t ram[256], sfr[sizeof registers];
};

struct program {
    struct look *looks;
    size_t count;
    uint64_t from; /* cycle */
    uint16_t xdata_at[XDATA_LOOKS];
    uint8_t xdata[XDATA_LOOKS];
    int xdata_count;
};

static const char folder[] = "build/tests/mcs52_s51";
static uint32_t seed = 0x52;
static long ran[256];
static struct mcs52 *chip;
static uint8_t code[0x10000];
static bool used[0x10000];
static bool renew_p; /* the next instruction changes A */
static struct program *programs;
static size_t program_count;

void setUp(void)
{
}

void tearDown(void)
{
}

static unsigned random_below(unsigned limit)
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return (unsigned)((uint64_t)seed * limit >> 32);
}

/* --- making a program --------------------------------------------------------------------- */

static bool has_room(unsigned address)
{
    for (unsigned i = 0; i < ROOM; i++) {
        if (used[(address + i) & 0xFFFF]) {
            return false;
        }
    }
    return true;
}

static void put_code(unsigned address, unsigned byte)
{
    uint16_t at = (uint16_t)address;

    code[at] = (uint8_t)byte;
    used[at] = true;
    mcs52_load(chip, at, &code[at], 1);
}

static uint8_t random_direct(void)
{
    return random_below(2) ? (uint8_t)random_below(0x80)
                           : registers[random_below(sizeof registers)];
}

static uint8_t random_bit(void)
{
    return random_below(2)
               ? (uint8_t)random_below(0x80)
               : (uint8_t)(bit_registers[random_below(sizeof bit_registers)] + random_below(8));
}

static bool is_in(uint8_t op, const char *list)
{
    char text[4];

    snprintf(text, sizeof text, "%02X", op);
    for (; *list != '\0'; list += 3) {
        if (strncmp(list, text, 2) == 0) {
            return true;
        }
    }
    return false;
}

/* What an instruction's second and third byte are: d direct, b bit, i immediate, r relative, a page
 * or long address, - none. */
static const char *find_operands(uint8_t op)
{
    unsigned low = op & 15, high = op >> 4;

    if (low == 1 || op == 0x02 || op == 0x12) {
        return low == 1 ? "a" : "aa";
    }
    if (is_in(op, "10 20 30 ")) {
        return "br";
    }
    if (is_in(op, "40 50 60 70 80 ") || (high == 13 && low >= 8)) {
        return "r";
    }
    if (is_in(op, "43 53 63 75 ")) {
        return "di";
    }
    if (op == 0xB4 || (high == 11 && low >= 6)) {
        return "ir";
    }
    if (is_in(op, "B5 D5 ")) {
        return "dr";
    }
    if (op == 0x85) {
        return "dd";
    }
    if (op == 0x90) {
        return "ii";
    }
    if (is_in(op, "72 82 92 A0 A2 B0 B2 C2 D2 ")) {
        return "b";
    }
    if (is_in(op, "24 34 44 54 64 74 94 ") || (high == 7 && low >= 6)) {
        return "i";
    }
    if (low == 5 || is_in(op, "42 52 62 C0 D0 ") || ((high == 8 || high == 10) && low >= 6)) {
        return "d";
    }
    return "";
}

static const char *operands_of[256];
static unsigned operand_bytes[256];
static bool always_jumps[256]; /* goes on only where the jump leads */
static bool writes_bit[256];

static void know_instructions(void)
{
    for (int op = 0; op < 256; op++) {
        operands_of[op] = find_operands((uint8_t)op);
        operand_bytes[op] = (unsigned)strlen(operands_of[op]);
        always_jumps[op] = (op & 15) == 1 || is_in((uint8_t)op, "02 12 22 32 73 80 ");
        writes_bit[op] = is_in((uint8_t)op, "10 92 B2 C2 D2 ");
    }
}

static unsigned stacked(void)
{
    uint8_t *ram = mcs52_ram(chip), sp = mcs52_sfr(chip, 0x81);

    return (unsigned)(ram[sp] << 8 | ram[(uint8_t)(sp - 1)]);
}

static unsigned dptr(void)
{
    return (unsigned)(mcs52_sfr(chip, 0x83) << 8 | mcs52_sfr(chip, 0x82));
}

/* What s51 does wrong itself. An instruction that writes RS0 or RS1 as a bit leaves it in the
 * register bank that it was in; */
static bool is_wrong_in_s51(uint8_t op, uint8_t bit)
{
    return writes_bit[op] && (bit == 0xD3 || bit == 0xD4);
}

/* and when PSW is written, P is what was written until the next change of A. */
static bool names_psw(const char *operands, const uint8_t *bytes)
{
    for (int i = 0; operands[i] != '\0'; i++) {
        if ((operands[i] == 'd' && bytes[i] == PSW) ||
            (operands[i] == 'b' && (bytes[i] & 0xF8) == PSW)) {
            return true;
        }
    }
    return false;
}

/* Puts instruction OP to where the chip stands. Returns false, with nothing put, when it would lead
 * to where there is no room. */
static bool put_instruction(uint8_t op)
{
    const char *operands = operands_of[op];
    unsigned count = operand_bytes[op];
    unsigned pc = mcs52_pc(chip), next = pc + 1 + count, target = next;
    unsigned a = mcs52_sfr(chip, 0xE0), data;
    uint8_t bytes[2] = {0, 0};

    for (int i = 0; operands[i] != '\0'; i++) {
        bytes[i] = operands[i] == 'd'   ? random_direct()
                   : operands[i] == 'b' ? random_bit()
                                        : (uint8_t)random_below(256);
    }
    if ((op & 15) == 1) {
        target = (next & 0xF800) | (unsigned)(op & 0xE0) << 3 | bytes[0];
    } else if (op == 0x02 || op == 0x12) {
        target = (unsigned)bytes[0] << 8 | bytes[1];
    } else if (op == 0x22 || op == 0x32) {
        target = stacked();
    } else if (op == 0x73) {
        target = dptr() + a;
    } else if (count > 0 && operands[count - 1] == 'r') {
        target = next + (unsigned)(int8_t)bytes[count - 1];
    }
    put_code(pc, op);
    for (unsigned i = 0; i < count; i++) {
        put_code(pc + 1 + i, bytes[i]);
    }
    data = op == 0x83 ? next + a : op == 0x93 ? dptr() + a : pc;
    /* s51 does not carry the sum of MOVC round to address 0. */
    if (data <= 0xFFFF && (uint16_t)(data - next) >= ROOM && !is_wrong_in_s51(op, bytes[0]) &&
        has_room(target) && (always_jumps[op] || has_room(next))) {
        used[data & 0xFFFF] = true; /* code that is read as data stays what it is */
        renew_p = names_psw(operands, bytes);
        return true;
    }
    for (unsigned i = 0; i <= count; i++) {
        used[(pc + i) & 0xFFFF] = false;
    }
    return false;
}

/* From here nothing else leads to room. Returns false when nothing is left at all. */
static bool put_far_jump(void)
{
    unsigned pc = mcs52_pc(chip);

    for (int i = 0; i < 3; i++) {
        put_code(pc + (unsigned)i, 0x02);
    }
    for (int i = 0; i < 20000; i++) {
        unsigned target = random_below(0x10000);

        if (has_room(target)) {
            put_code(pc + 1, target >> 8);
            put_code(pc + 2, target);
            return true;
        }
    }
    return false;
}

static void take_look(struct look *look)
{
    look->pc = mcs52_pc(chip);
    look->cycles = mcs52_cycles(chip);
    memcpy(look->ram, mcs52_ram(chip), sizeof look->ram);
    for (size_t i = 0; i < sizeof registers; i++) {
        look->sfr[i] = mcs52_sfr(chip, registers[i]);
    }
}

static bool all_ran(void)
{
    long states = getenv("MUTANT") == NULL ? STATES : MUTANT_STATES;

    for (int op = 0; op < 256; op++) {
        if (op != RESERVED && ran[op] < states) {
            return false;
        }
    }
    return true;
}

/* Of two instructions the one that has run less often: branches find room less often than others.
 */
static uint8_t random_op(void)
{
    unsigned one = random_below(256), other = random_below(256);

    return (uint8_t)(ran[one] < ran[other] ? one : other);
}

static bool is_mutant(void)
{
    const char *number = getenv("MUTANT");

    return number != NULL && strcmp(number, "0") != 0;
}

static FILE *create(size_t number, const char *ending)
{
    char path[64];
    FILE *file;

    snprintf(path, sizeof path, "%s/%zu.%s", folder, number, ending);
    file = fopen(is_mutant() ? "/dev/null" : path, "w+");
    TEST_ASSERT_NOT_NULL(file);
    return file;
}

static void write_image(size_t number)
{
    FILE *file = create(number, "ihx");

    for (unsigned at = 0; at < 0x10000; at += 128) {
        unsigned sum = 128 + (at >> 8) + at;

        fprintf(file, ":80%04X00", at);
        for (unsigned i = 0; i < 128; i++) {
            putc("0123456789ABCDEF"[code[at + i] >> 4], file);
            putc("0123456789ABCDEF"[code[at + i] & 15], file);
            sum += code[at + i];
        }
        fprintf(file, "%02X\n", -sum & 0xFF);
    }
    fputs(":00000001FF\n", file);
    fclose(file);
}

/* Puts a random instruction to where the chip stands. */
static bool put_any(void)
{
    for (int tries = 0; tries < 100; tries++) {
        uint8_t op = renew_p ? MOV_A_DATA : random_op();

        if (op != RESERVED && put_instruction(op)) {
            return true;
        }
    }
    return put_far_jump();
}

/* Makes a program and writes the commands by which s51 runs it. */
static void make_program(void)
{
    FILE *commands = create(program_count, "commands");
    struct program *program;
    long steps = 0;

    program = realloc(programs, (program_count + 1) * sizeof *programs);
    TEST_ASSERT_NOT_NULL(program);
    programs = program;
    program = &programs[program_count];
    memset(program, 0, sizeof *program);
    memset(used, 0, sizeof used);
    for (size_t i = 0; i < sizeof code; i++) {
        code[i] = (uint8_t)random_below(256);
    }
    fputs("set error stack off\n", commands); /* s51 would stop when SP goes round */
    fprintf(commands, "file \"%zu.ihx\"\nreset\nfill xram 0 65535 %d", program_count, FILLED);
    for (int i = 0; i < 256; i++) {
        mcs52_ram(chip)[i] = (uint8_t)random_below(256);
        if (i % 8 == 0) {
            fprintf(commands, "\nset mem iram %d", i);
        }
        fprintf(commands, " %d", mcs52_ram(chip)[i]);
    }
    fputs("\n", commands);
    memset(mcs52_xdata(chip), FILLED, MCS52_XDATA_BYTES);
    mcs52_load(chip, 0, code, sizeof code);
    mcs52_reset(chip);
    program->from = mcs52_cycles(chip);
    renew_p = false;
    while (put_any()) {
        ran[code[mcs52_pc(chip)]]++;
        mcs52_step(chip);
        if (++steps % CHUNK == 0) {
            program->looks = realloc(program->looks, (program->count + 1) * sizeof(struct look));
            take_look(&program->looks[program->count++]);
            fprintf(commands, "step %d\ndump iram 0 255\n", CHUNK);
            for (size_t i = 0; i < sizeof registers; i++) {
                fprintf(commands, "dump sfr %d %d\n", registers[i], registers[i]);
            }
        }
    }
    for (int i = 0; i < MCS52_XDATA_BYTES && program->xdata_count < XDATA_LOOKS; i++) {
        if (mcs52_xdata(chip)[i] != FILLED) {
            program->xdata_at[program->xdata_count] = (uint16_t)i;
            program->xdata[program->xdata_count++] = mcs52_xdata(chip)[i];
        }
    }
    fprintf(commands, "step %ld\n", steps % CHUNK);
    for (int i = 0; i < program->xdata_count; i++) {
        fprintf(commands, "dump xram %d %d\n", program->xdata_at[i], program->xdata_at[i]);
    }
    fputs("kill\n", commands);
    fclose(commands);
    if (!is_mutant()) {
        write_image(program_count);
    }
    program_count++;
}

/* --- running them in s51 ------------------------------------------------------------------ */

/* Runs program NUMBER. Returns what s51 said. Its input is a pipe that stays open, as it would quit
 * at the end. Each program has a process of its own: 0.6.4 notes all bytes on the stack, and some
 * 8,000 of them break its heap. */
static FILE *run_s51(size_t number)
{
    char commands[32];
    FILE *words = create(number, "words");
    int input[2];
    pid_t s51;

    snprintf(commands, sizeof commands, "%zu.commands", number);
    TEST_ASSERT_EQUAL(0, pipe2(input, O_CLOEXEC));
    s51 = fork();
    if (s51 == 0) {
        char *arguments[] = {"s51", "-t", "C52", "-X",     "12M", "-R",
                             "1",   "-b", "-C",  commands, NULL};

        if (chdir(folder) == 0 && dup2(input[0], 0) >= 0 && dup2(fileno(words), 1) >= 0) {
            execvp(arguments[0], arguments);
        }
        _exit(127);
    }
    waitpid(s51, NULL, 0);
    close(input[0]);
    close(input[1]);
    rewind(words);
    return words;
}

/* --- comparing ---------------------------------------------------------------------------- */

static char line[512];

/* The next line that starts with WORD. */
static void await(FILE *words, const char *word)
{
    size_t length = strlen(word);

    while (fgets(line, sizeof line, words) != NULL) {
        if (memcmp(line, word, length) == 0) {
            return;
        }
    }
    TEST_FAIL_MESSAGE("s51 says nothing more");
}

/* One line of a dump: "0x80 P0:  0b.. 0xff .." or "0x82  00 00 ..", bytes from a fixed column on.
 */
static void take_dump(uint8_t bytes[256])
{
    enum { FIRST_COLUMN = 26, LAST_COLUMN = FIRST_COLUMN + 7 * 3 };
    unsigned long at = strtoul(line, NULL, 16);
    unsigned named;

    if (sscanf(line, "0x%*x %*[A-Z0-9]: 0b%*[01] 0x%x", &named) == 1) {
        bytes[at & 0xFF] = (uint8_t)named;
        return;
    }
    for (int column = FIRST_COLUMN; column <= LAST_COLUMN && line[column] != ' '; column += 3) {
        bytes[at++ & 0xFF] = (uint8_t)strtoul(line + column, NULL, 16);
    }
}

static void compare_look(FILE *words, const struct look *look, uint64_t from, const char *place)
{
    uint8_t ram[256], sfr[256];
    unsigned pc;
    unsigned long ticks;

    await(words, "Stop at ");
    TEST_ASSERT_EQUAL_MESSAGE(2, sscanf(line, "Stop at %x: (109) stepped %lu", &pc, &ticks), line);
    TEST_ASSERT_EQUAL_HEX16_MESSAGE(pc, look->pc, place);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(ticks / TICKS_PER_CYCLE, look->cycles - from, place);
    for (await(words, "0x"); strstr(line, "P0:") == NULL; await(words, "0x")) {
        take_dump(ram);
    }
    for (size_t i = 1; i < sizeof registers; i++) {
        take_dump(sfr); /* the first line is P0's */
        await(words, "0x");
    }
    take_dump(sfr);
    TEST_ASSERT_EQUAL_HEX8_ARRAY_MESSAGE(ram, look->ram, 256, place);
    for (size_t i = 0; i < sizeof registers; i++) {
        char what[120];

        snprintf(what, sizeof what, "%s, register %02Xh", place, registers[i]);
        if (registers[i] == PSW) { /* P shows in what instructions read */
            sfr[PSW] = (uint8_t)((sfr[PSW] & ~PSW_P) | (look->sfr[i] & PSW_P));
        }
        TEST_ASSERT_EQUAL_HEX8_MESSAGE(sfr[registers[i]], look->sfr[i], what);
    }
}

static void compare_program(size_t number)
{
    const struct program *program = &programs[number];
    uint64_t from = program->from;
    FILE *words = run_s51(number);
    char place[80];

    for (size_t i = 0; i < program->count; i++) {
        snprintf(place, sizeof place, "program %zu, chunk %zu", number, i);
        compare_look(words, &program->looks[i], from, place);
        from = program->looks[i].cycles;
    }
    await(words, "Stop at ");
    for (int i = 0; i < program->xdata_count; i++) {
        char start[8];

        snprintf(start, sizeof start, "0x%04x", program->xdata_at[i]);
        await(words, start);
        TEST_ASSERT_EQUAL_HEX8_MESSAGE(strtoul(line + 26, NULL, 16), program->xdata[i], place);
    }
    fclose(words);
}

/* --- all states in one number ------------------------------------------------------------- */

static uint64_t hash_of(uint64_t hash, const void *data, size_t size) /* FNV-1a */
{
    for (size_t i = 0; i < size; i++) {
        hash = (hash ^ ((const uint8_t *)data)[i]) * 1099511628211U;
    }
    return hash;
}

static uint64_t hash_of_all(void)
{
    uint64_t hash = 14695981039346656037U;

    for (size_t i = 0; i < program_count; i++) {
        const struct program *program = &programs[i];

        for (size_t k = 0; k < program->count; k++) {
            const struct look *look = &program->looks[k];

            hash = hash_of(hash, look->ram, sizeof look->ram);
            hash = hash_of(hash, look->sfr, sizeof look->sfr);
            hash = hash_of(hash, &look->pc, sizeof look->pc);
            hash = hash_of(hash, &look->cycles, sizeof look->cycles);
        }
        hash = hash_of(hash, program->xdata_at, sizeof program->xdata_at);
        hash = hash_of(hash, program->xdata, sizeof program->xdata);
    }
    return hash;
}

/* The number that stands in the folder; with MODE "w" it is put there. */
static uint64_t noted_hash(const char *mode, uint64_t hash)
{
    char path[64];
    FILE *file;

    snprintf(path, sizeof path, "%s/hash", folder);
    file = fopen(path, mode);
    TEST_ASSERT_NOT_NULL(file);
    if (mode[0] == 'w') {
        TEST_ASSERT_EQUAL(1, fwrite(&hash, sizeof hash, 1, file));
    } else {
        TEST_ASSERT_EQUAL(1, fread(&hash, sizeof hash, 1, file));
    }
    fclose(file);
    return hash;
}

/* The console of other versions prints in other words. */
static bool is_known_s51(void)
{
    char version[128] = "";
    FILE *answer = popen("s51 -v 2>/dev/null </dev/null", "r");

    while (answer != NULL && fgets(version, sizeof version, answer) != NULL &&
           strstr(version, "0.6.4") == NULL) {
    }
    if (answer != NULL) {
        pclose(answer);
    }
    return strstr(version, "0.6.4") != NULL;
}

static void test_that_each_instruction_does_what_it_does_in_s51(void)
{
    if (!is_known_s51()) {
        TEST_IGNORE_MESSAGE("compares with s51 0.6.4 of Debian 12 only");
    }
    mkdir("build", 0777), mkdir("build/tests", 0777), mkdir(folder, 0777);
    know_instructions();
    chip = mcs52_create(MCS52_INTEL, NULL);
    while (!all_ran()) {
        make_program();
    }
    if (is_mutant()) {
        TEST_ASSERT_EQUAL_HEX64(noted_hash("r", 0), hash_of_all());
        return;
    }
    noted_hash("w", hash_of_all());
    for (size_t i = 0; i < program_count; i++) {
        compare_program(i);
        free(programs[i].looks);
    }
    free(programs);
    mcs52_destroy(chip);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_that_each_instruction_does_what_it_does_in_s51);
    return UNITY_END();
}
