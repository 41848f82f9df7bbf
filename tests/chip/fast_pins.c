/* SPDX-License-Identifier: MIT */
/* Our own simulator in the place that tests/chip/lib.sh gives to s51: it takes the same value
 * change dump with pin events and writes one with what the watched pins and cells do.
 *     fast_pins PART CLK_HZ IMAGE.ihx DIR CELL...
 * PART is the board's WATCHDOG. DIR has the FIFOs pins and keys; DIR/out and DIR/uart are written.
 * A CELL, iram[0x2f], is a byte of internal RAM. With S51_COVERS in the environment it also
 * writes DIR/covered, the address of each instruction that was run. As in s51, times restart at 0
 * with a watchdog reset, and so do those of the events that follow. */
#include "diag.h"
#include "hexfile.h"
#include "mcs52.h"

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { CLOCKS_PER_CYCLE = 12, BAUD = 9600, PORT_PINS = 5, MAX_CELLS = 8, FIRST_CELL_ID = 'a' };

struct bench {
    struct mcs52 *chip;
    double cycle_ns;
    uint64_t reset_cycle; /* times count from here */
    FILE *out, *uart;
    int keys;
    uint64_t line_free; /* the serial line to the chip is free from this cycle on */
    uint8_t cells[MAX_CELLS], values[MAX_CELLS];
    int cell_count;
    int set_cell; /* the byte of RAM that the events change, or -1 */
    uint8_t covered[MCS52_CODE_BYTES / 8];
};

/* --- what the chip does ------------------------------------------------------------------- */

static void stamp(struct bench *bench, uint64_t cycle)
{
    fprintf(bench->out, "#%.0f\n", (double)(cycle - bench->reset_cycle) * bench->cycle_ns);
}

static void note_edge(void *user, uint64_t cycle, int port, int bit, bool level)
{
    struct bench *bench = user;

    (void)port;
    stamp(bench, cycle);
    fprintf(bench->out, "%d%c\n", level, '0' + bit);
}

static void note_byte(void *user, uint64_t cycle, uint8_t byte)
{
    struct bench *bench = user;

    (void)cycle;
    putc(byte, bench->uart);
}

static void note_reset(void *user, uint64_t cycle)
{
    struct bench *bench = user;

    bench->reset_cycle = cycle;
    bench->line_free = 0;
}

static void note_cells(struct bench *bench)
{
    const uint8_t *ram = mcs52_ram(bench->chip);

    for (int i = 0; i < bench->cell_count; i++) {
        uint8_t value = ram[bench->cells[i]];

        if (value != bench->values[i]) {
            bench->values[i] = value;
            stamp(bench, mcs52_cycles(bench->chip));
            putc('b', bench->out);
            for (int bit = 7; bit >= 0; bit--) {
                putc('0' + (value >> bit & 1), bench->out);
            }
            fprintf(bench->out, " %c\n", FIRST_CELL_ID + i);
        }
    }
}

/* --- what comes in ------------------------------------------------------------------------ */

/* Cells are looked at after each instruction. A reset on the way sets the clock back: the event
 * comes so long after it. */
static void run_to(struct bench *bench, double time_ns)
{
    uint64_t cycle = (uint64_t)(time_ns / bench->cycle_ns), from;

    for (uint64_t next = mcs52_cycles(bench->chip) + 1;
         bench->cell_count > 0 && next <= bench->reset_cycle + cycle; next++) {
        mcs52_run(bench->chip, next);
        note_cells(bench);
    }
    do {
        from = bench->reset_cycle;
        mcs52_run(bench->chip, from + cycle);
    } while (bench->reset_cycle != from);
}

/* What was typed arrives from now on, at line rate. */
static void take_keys(struct bench *bench)
{
    double bit_cycles = 1e9 / BAUD / bench->cycle_ns;
    uint64_t now = mcs52_cycles(bench->chip) + 1;
    uint8_t byte;

    while (read(bench->keys, &byte, 1) == 1) {
        uint64_t at = bench->line_free > now ? bench->line_free : now;

        bench->line_free = mcs52_feed(bench->chip, at, byte, bit_cycles);
        if (bench->line_free == 0) {
            exit(diag_error(NULL, 0, "fast_pins: more was typed than the line takes"));
        }
    }
}

static void change(struct bench *bench, const char *line, double time_ns)
{
    uint64_t now = mcs52_cycles(bench->chip);

    if (line[0] == 'b' && strchr(line, '*') != NULL) {
        mcs52_jump(bench->chip, (uint16_t)strtoul(line + 1, NULL, 2));
    } else if (line[0] == 'b') {
        mcs52_ram(bench->chip)[bench->set_cell] = (uint8_t)strtoul(line + 1, NULL, 2);
        note_cells(bench);
    } else if (line[1] == '!' || line[1] == '@') {
        mcs52_set_pin(bench->chip, now + 1, 3, line[1] == '!' ? 2 : 3, line[0] == '1');
    } else if (line[1] == '%') {
        fprintf(bench->out, "#%.0f\nb%c %%\n", time_ns, line[0]);
    }
    fflush(bench->out);
    fflush(bench->uart);
}

static void play(struct bench *bench)
{
    char line[256];
    double time_ns = 0;

    while (fgets(line, sizeof line, stdin) != NULL) {
        char *name = strstr(line, "iram[");

        take_keys(bench);
        if (line[0] == '#') {
            time_ns = strtod(line + 1, NULL);
            run_to(bench, time_ns);
        } else if (line[0] == '$' && name != NULL) {
            bench->set_cell = (int)strtol(name + 5, NULL, 16) & 0xFF;
        } else if (line[0] != '$') {
            change(bench, line, time_ns);
        }
    }
}

/* --- outside ------------------------------------------------------------------------------ */

static enum mcs52_part part_of(const char *watchdog)
{
    return strcmp(watchdog, "at89s52") == 0 ? MCS52_AT89S52
           : strcmp(watchdog, "stc89") == 0 ? MCS52_STC89
                                            : MCS52_INTEL;
}

static void declare(struct bench *bench, char **cells)
{
    fputs("$timescale 1ns $end\n", bench->out);
    for (int bit = 0; bit < PORT_PINS; bit++) {
        mcs52_watch(bench->chip, 1, bit);
        fprintf(bench->out, "$var wire 1 %c port1_value.%d $end\n", '0' + bit, bit);
    }
    for (int i = 0; i < bench->cell_count; i++) {
        bench->cells[i] = (uint8_t)strtol(cells[i] + strlen("iram["), NULL, 16);
        fprintf(bench->out, "$var wire 8 %c iram_0x%02x $end\n", FIRST_CELL_ID + i,
                bench->cells[i]);
    }
    fputs("$var wire 1 % sync $end\n$enddefinitions $end\n", bench->out);
    fflush(bench->out);
}

static void write_covered(const struct bench *bench)
{
    FILE *out = fopen("covered", "w");

    for (unsigned address = 0; out != NULL && address < MCS52_CODE_BYTES; address++) {
        if (bench->covered[address / 8] >> address % 8 & 1) {
            fprintf(out, "%04X\n", address);
        }
    }
    if (out == NULL || fclose(out) != 0) {
        exit(diag_error("covered", 0, "fast_pins cannot write this file"));
    }
}

int main(int count, char **words)
{
    static const uint8_t hang[] = {0x80, 0xFE}; /* sjmp to itself, where no image has code */
    static struct hexfile hex;
    struct bench bench = {.set_cell = -1, .cell_count = count - 5};
    const struct mcs52_outside outside = {
        .user = &bench, .edge = note_edge, .byte = note_byte, .reset = note_reset};

    if (count < 5 || bench.cell_count > MAX_CELLS) {
        diag_error(NULL, 0, "use: fast_pins PART CLK_HZ IMAGE.ihx DIR CELL...");
        return EXIT_USAGE;
    }
    if (hexfile_read(&hex, words[3]) != EXIT_FINE) {
        return EXIT_USAGE;
    }
    bench.chip = mcs52_create(part_of(words[1]), &outside);
    bench.cycle_ns = CLOCKS_PER_CYCLE * 1e9 / strtod(words[2], NULL);
    if (bench.chip == NULL || chdir(words[4]) != 0 || freopen("pins", "r", stdin) == NULL ||
        (bench.out = fopen("out", "w")) == NULL || (bench.uart = fopen("uart", "w")) == NULL ||
        (bench.keys = open("keys", O_RDONLY | O_NONBLOCK)) < 0) {
        return diag_error(words[4], 0, "fast_pins cannot use this folder");
    }
    mcs52_load(bench.chip, 0, hex.code, sizeof hex.code);
    mcs52_load(bench.chip, MCS52_CODE_BYTES - sizeof hang, hang, sizeof hang);
    declare(&bench, words + 5);
    if (getenv("S51_COVERS") != NULL) {
        mcs52_cover(bench.chip, bench.covered);
    }
    play(&bench);
    if (getenv("S51_COVERS") != NULL) {
        write_covered(&bench);
    }
    mcs52_destroy(bench.chip);
    fclose(bench.uart);
    return fclose(bench.out) == 0 ? EXIT_FINE : EXIT_INPUT;
}
