/* SPDX-License-Identifier: MIT */
/* What the files of the library mcs52 share. Nothing else includes this. */
#ifndef FUZZY51_MCS52_INSIDE_H
#define FUZZY51_MCS52_INSIDE_H

#include "mcs52.h"

/* Special function registers. */
enum {
    P0 = 0x80,
    SP = 0x81,
    DPL = 0x82,
    DPH = 0x83,
    PCON = 0x87,
    TCON = 0x88,
    TMOD = 0x89,
    TL0 = 0x8A,
    TL1 = 0x8B,
    TH0 = 0x8C,
    TH1 = 0x8D,
    AUXR = 0x8E,
    P1 = 0x90,
    SCON = 0x98,
    SBUF = 0x99,
    P2 = 0xA0,
    WDTRST = 0xA6,
    IE = 0xA8,
    P3 = 0xB0,
    IP = 0xB8,
    T2CON = 0xC8,
    T2MOD = 0xC9,
    RCAP2L = 0xCA,
    RCAP2H = 0xCB,
    TL2 = 0xCC,
    TH2 = 0xCD,
    PSW = 0xD0,
    ACC = 0xE0,
    WDT_CONTR = 0xE1,
    B = 0xF0
};

/* Bits of them. */
enum {
    PSW_CY = 0x80,
    PSW_AC = 0x40,
    PSW_BANK = 0x18,
    PSW_OV = 0x04,
    PSW_P = 0x01,
    PCON_SMOD = 0x80,
    PCON_POF = 0x10,
    PCON_PD = 0x02,
    PCON_IDL = 0x01,
    TCON_TF1 = 0x80,
    TCON_TR1 = 0x40,
    TCON_TF0 = 0x20,
    TCON_TR0 = 0x10,
    TCON_IE1 = 0x08,
    TCON_IT1 = 0x04,
    TCON_IE0 = 0x02,
    TCON_IT0 = 0x01,
    TMOD_GATE = 0x08,
    TMOD_CT = 0x04,
    TMOD_MODE = 0x03,
    AUXR_WDIDLE = 0x10,
    SCON_MODE = 0xC0,
    SCON_SM2 = 0x20,
    SCON_REN = 0x10,
    SCON_TB8 = 0x08,
    SCON_RB8 = 0x04,
    SCON_TI = 0x02,
    SCON_RI = 0x01,
    IE_EA = 0x80,
    T2_TF2 = 0x80,
    T2_EXF2 = 0x40,
    T2_RCLK = 0x20,
    T2_TCLK = 0x10,
    T2_EXEN2 = 0x08,
    T2_TR2 = 0x04,
    T2_CT2 = 0x02,
    T2_CAPTURE = 0x01,
    T2MOD_OE = 0x02,
    T2MOD_DCEN = 0x01,
    WDT_FLAG = 0x80,
    WDT_ENABLE = 0x20,
    WDT_CLEAR = 0x10,
    WDT_IN_IDLE = 0x08,
    WDT_PRESCALE = 0x07
};

/* Pins with a second meaning, as bits of their port. */
enum {
    P1_T2 = 0x01,
    P1_T2EX = 0x02,
    P3_RXD = 0x01,
    P3_TXD = 0x02,
    P3_INT0 = 0x04,
    P3_INT1 = 0x08,
    P3_T0 = 0x10,
    P3_T1 = 0x20
};

/* What can happen by itself, each with the cycle in which it is due. At the same cycle the first
 * one here is first. */
enum event {
    EVENT_COUNT_0, /* a pin's fall is counted: the cycle after it was seen */
    EVENT_COUNT_1,
    EVENT_COUNT_2,
    EVENT_PIN, /* the outside changes a pin */
    EVENT_T0,  /* overflows that somebody must hear of */
    EVENT_T1,
    EVENT_T2,
    EVENT_TX,
    EVENT_RX,
    EVENT_WATCHDOG,
    EVENT_FAULT,
    EVENTS
};
static const uint64_t NEVER = UINT64_MAX / 2; /* some cycles after it are still no wrap */

/* Interrupt sources in the order of [I]'s polling sequence; bit N of IE and IP belongs to source N.
 */
enum source {
    SOURCE_IE0,
    SOURCE_TF0,
    SOURCE_IE1,
    SOURCE_TF1,
    SOURCE_SERIAL,
    SOURCE_TIMER2,
    SOURCES
};

struct pin_change {
    uint64_t cycle;
    uint8_t port, mask;
    bool level;
};

/* Sixteen times the baud rate; ticks come in states, six a cycle. */
struct baud {
    uint64_t next_state; /* the next tick; NEVER: the clock stands, or ticks come from a pin */
    uint64_t period;
    unsigned phase; /* ticks since the last roll-over, 0..15 */
};

struct mcs52 {
    /* the processor */
    uint64_t now;  /* the next instruction begins in this cycle */
    uint64_t next; /* before this cycle there is nothing to do but instructions */
    uint64_t instructions;
    uint16_t pc;
    uint8_t a, psw; /* PSW without P */
    uint8_t ram[256];
    uint8_t sfr[256]; /* from 80h on; ACC and PSW are above */
    bool idle, power_down;
    enum mcs52_reset cause;
    /* interrupts: request N is there in the samples of the cycles from on[N] to before off[N] */
    uint64_t on[SOURCES], off[SOURCES];
    uint64_t held; /* the end of an RETI or of a write to IE or IP: no interrupt right after it */
    uint8_t in_service; /* bit 0: low priority, bit 1: high */
    bool poll;          /* a request may be waiting */
    /* timers: their registers are as of the begin of cycle timer_at */
    uint64_t timer_at[3];
    bool t1_is_odd; /* the count of its overflows */
    /* the serial port */
    struct baud tx_clock, rx_clock;
    uint16_t tx_bits; /* the frame, start bit first */
    uint8_t tx_byte;  /* its byte */
    uint8_t tx_next;  /* as written to SBUF, with its ninth bit */
    bool tx_next_ninth;
    bool tx_waits;       /* it is the next frame, after the stop bit of this one */
    bool tx_rolled;      /* the roll-over of EVENT_TX has been counted */
    uint8_t tx_position; /* 0: nothing is sent; 1: waits for a roll-over; then the bits */
    uint8_t rx_position; /* 0: looks for a start bit; then 1 + the bits so far */
    uint8_t rx_sample;   /* which of the three samples of a bit comes next */
    uint8_t rx_ones;     /* high ones among those so far */
    uint16_t rx_bits;    /* shifted in from the left */
    /* the watchdog */
    uint64_t watchdog_left; /* cycles, while it stands */
    bool watchdog_half;     /* the byte last written to WDTRST was 1Eh */
    bool bitten;            /* it resets the chip at the end of this instruction */
    /* pins */
    uint8_t outside_pins[4], alternate[4], pins[4], watched[4];
    uint8_t shorted_low[4], shorted_high[4], tied[4]; /* one group of tied pins a port */
    struct pin_change queue[MCS52_PIN_QUEUE];
    unsigned queue_first, queue_count;
    /* running */
    uint64_t due[EVENTS];
    uint64_t until;
    uint64_t slept_from; /* power-down began */
    bool clock_stands;   /* and it is no program's power-down */
    bool stop;
    struct mcs52_fault faults[MCS52_FAULTS];
    bool fault_done[MCS52_FAULTS];
    uint64_t fault_next[MCS52_FAULTS]; /* of one that is not of a bit: what it does next */
    int fault_count;
    uint64_t probe_from;  /* from here on one sticks, or may wait for an instruction count */
    uint32_t xdata_watch; /* 10000h: none */
    enum mcs52_part part;
    struct mcs52_outside outside;
    uint8_t *covered;
    uint8_t xdata[MCS52_XDATA_BYTES];
    uint8_t code[MCS52_CODE_BYTES + 2]; /* the first two bytes again, for operands at the end */
};

/* What is special about a register. Reading or writing it is more than an access to chip->sfr. A
 * timer counts in it. A write of the value that it has leaves the peripherals as they are. */
enum { READ_SPECIAL = 1, WRITE_SPECIAL = 2, IS_PORT = 4, IS_COUNT = 8, IS_SETTING = 16 };
extern const uint8_t mcs52_special[256];

/* R0..R7 of the bank in use. */
static inline uint8_t *mcs52_bank(struct mcs52 *chip)
{
    return chip->ram + (chip->psw & PSW_BANK);
}

/* mcs52.c: reset; a special register read in cycle CYCLE; written by an instruction that ends at
 * END.
 */
uint8_t mcs52_read(struct mcs52 *chip, uint8_t address, uint64_t cycle);
void mcs52_write(struct mcs52 *chip, uint8_t address, uint8_t value, uint64_t end);
void mcs52_restart(struct mcs52 *chip, enum mcs52_reset cause);

/* mcs52_run.c */
void mcs52_schedule(struct mcs52 *chip, enum event event, uint64_t cycle);
void mcs52_attend(struct mcs52 *chip); /* look at everything at the next instruction */
void mcs52_catch_up(struct mcs52 *chip, uint64_t through);
bool mcs52_boundary(struct mcs52 *chip); /* true: an instruction comes next */
void mcs52_power_down(struct mcs52 *chip, uint64_t end);
void mcs52_wake(struct mcs52 *chip, uint64_t cycle);

/* mcs52_cpu.c: runs until mcs52_boundary says no; ONE: for one instruction. */
void mcs52_execute(struct mcs52 *chip);
void mcs52_execute_probed(struct mcs52 *chip, bool one);
extern const uint8_t mcs52_op_cycles[256];

/* mcs52_interrupts.c */
void mcs52_request(struct mcs52 *chip, enum source source, bool on, uint64_t cycle);
void mcs52_requests_of(struct mcs52 *chip, uint8_t address, uint64_t cycle);
int mcs52_interrupt(struct mcs52 *chip);
void mcs52_vector(struct mcs52 *chip, int source);
void mcs52_return(struct mcs52 *chip, uint64_t end);
void mcs52_poll(struct mcs52 *chip);

/* mcs52_timers.c: brings timer N to the end of cycle THROUGH; plans its next overflow. */
void mcs52_timer_sync(struct mcs52 *chip, int n, uint64_t through);
void mcs52_timers_sync(struct mcs52 *chip, uint64_t through);
void mcs52_timers_plan(struct mcs52 *chip);
void mcs52_timer_count(struct mcs52 *chip, int n, uint64_t cycle);
void mcs52_timer2_pin(struct mcs52 *chip, uint64_t cycle);
unsigned mcs52_timer_mode(const struct mcs52 *chip, int n);
bool mcs52_timer_counts_cycles(const struct mcs52 *chip, int n);
unsigned mcs52_timer_distance(const struct mcs52 *chip, int n);
unsigned mcs52_timer_period(const struct mcs52 *chip, int n);

/* mcs52_uart.c: END is the end of the instruction that writes */
void mcs52_uart_advance(struct mcs52 *chip, uint64_t end);
void mcs52_uart_plan(struct mcs52 *chip, uint64_t end);
void mcs52_uart_overflow(struct mcs52 *chip, int timer, uint64_t cycle);
void mcs52_uart_shift(struct mcs52 *chip, uint64_t cycles);
void mcs52_uart_send(struct mcs52 *chip, uint8_t byte, uint64_t end);
void mcs52_uart_control(struct mcs52 *chip, uint8_t old, uint64_t end);
void mcs52_uart_fall(struct mcs52 *chip, uint64_t cycle);
void mcs52_uart_tx(struct mcs52 *chip, uint64_t cycle);
void mcs52_uart_rx(struct mcs52 *chip, uint64_t cycle);
void mcs52_uart_break(struct mcs52 *chip, uint64_t cycle);

/* mcs52_ports.c: by level, IE0 and IE1 are the pins: they become so in CYCLE. */
void mcs52_pins_follow(struct mcs52 *chip, uint64_t cycle);
void mcs52_pins_update(struct mcs52 *chip, int port, uint64_t cycle);
void mcs52_pins_release(struct mcs52 *chip); /* latches and alternate functions are high */
void mcs52_pins_event(struct mcs52 *chip, uint64_t cycle);
bool mcs52_pins_wake(const struct mcs52 *chip);
void mcs52_alternate(struct mcs52 *chip, int port, uint8_t mask, bool level, uint64_t cycle);

/* mcs52_watchdog.c */
void mcs52_watchdog_write(struct mcs52 *chip, uint8_t address, uint8_t value, uint64_t end);
void mcs52_watchdog_stand(struct mcs52 *chip, uint64_t end);
void mcs52_watchdog_go_on(struct mcs52 *chip, uint64_t end);
void mcs52_watchdog_bite(struct mcs52 *chip);

/* mcs52_electric.c: a fault that is not of a bit begins, goes on or ends now. Returns when it wants
 * to be called again; NEVER: it is over. mcs52_calm ends all that have begun. */
uint64_t mcs52_upset(struct mcs52 *chip, const struct mcs52_fault *fault);
void mcs52_calm(struct mcs52 *chip);

/* mcs52_faults.c */
void mcs52_faults_strike(struct mcs52 *chip);

#endif
