/* SPDX-License-Identifier: MIT */
#include "board.h"
#include "scenario.h"

/* --- [scenario] --------------------------------------------------------------------------- */

#define AT(member) offsetof(struct scenario, member)
static const struct key scenario_keys[] = {
    {.name = "title",
     .meaning = "one line that says what happens",
     .kind = VALUE_TEXT,
     .at = AT(title),
     .text = "",
     .required = true},
    {.name = "app",
     .meaning = "the controller, or the controller, _ and a variant of its image",
     .kind = VALUE_TEXT,
     .at = AT(app),
     .text = "brake"},
    {.name = "duration_s",
     .meaning = "how long it takes, at most",
     .at = AT(duration_s),
     .low = 0.1,
     .high = 3600,
     .required = true},
    {.name = "hold_s",
     .meaning = "ends as soon as both cars have stood for this time",
     .at = AT(hold_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "runs for duration_s"},
    {.name = "event_s",
     .meaning = "outcomes that end in _within_s count from here",
     .at = AT(event_s),
     .high = 3600},
    {.name = "seed",
     .meaning = "of all random numbers",
     .kind = VALUE_COUNT,
     .at = AT(seed),
     .high = 4294967295,
     .initial = 1},
    {.name = "demo",
     .meaning = "whether make demo shows this scenario for its app",
     .kind = VALUE_CHOICE,
     .at = AT(demo),
     .choices = "no yes"},
};
#undef AT

const struct section scenario_section = {.name = "scenario",
                                         .meaning = "what the whole is about",
                                         SECTION_KEYS(scenario_keys),
                                         .size = sizeof(struct scenario)};

/* --- [ego] -------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct ego, member)
static const struct key ego_keys[] = {
    {.name = "speed_mps",
     .meaning = "speed at the start",
     .at = AT(speed_mps),
     .high = 60,
     .required = true},
    {.name = "brake_max_mps2",
     .meaning = "deceleration at 100 % brake",
     .at = AT(brake_max_mps2),
     .low = 0.5,
     .high = 20,
     .initial = 8},
    {.name = "brake_lag_s",
     .meaning = "first-order lag of the brake",
     .at = AT(brake_lag_s),
     .low = 0.01,
     .high = 2,
     .initial = 0.2},
    {.name = "brake_dead_s",
     .meaning = "dead time of the brake, before the lag",
     .at = AT(brake_dead_s),
     .high = 1,
     .initial = 0.05},
    {.name = "rolling_mps2",
     .meaning = "deceleration of a car that only rolls",
     .at = AT(rolling_mps2),
     .high = 2,
     .initial = 0.15},
    {.name = "driver",
     .meaning = "whether the driver holds a speed while the brake is released",
     .kind = VALUE_CHOICE,
     .at = AT(driver),
     .choices = "holds coasts"},
    {.name = "driver_mps",
     .meaning = "the speed that the driver holds",
     .at = AT(driver_mps),
     .high = 60,
     .initial = SCENARIO_UNSET,
     .unset = "speed_mps"},
    {.name = "driver_mps2",
     .meaning = "strongest acceleration of the driver",
     .at = AT(driver_mps2),
     .low = 0.1,
     .high = 10,
     .initial = 2},
};
#undef AT

static void check_ego(struct section_check *check, const void *values)
{
    static const char *const of_driver[] = {"driver_mps", "driver_mps2"};
    const struct ego *ego = values;

    for (int i = 0; i < 2 && ego->driver == DRIVER_COASTS; i++) {
        if (section_line(check, of_driver[i]) != 0) {
            section_complain(check, of_driver[i],
                             "%s has no effect on a driver who coasts; take it out", of_driver[i]);
        }
    }
}

const struct section ego_section = {.name = "ego",
                                    .meaning = "the own car",
                                    SECTION_KEYS(ego_keys),
                                    .size = sizeof(struct ego),
                                    .check = check_ego};

/* --- [lead] ------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct lead, member)
static const struct key lead_keys[] = {
    {.name = "gap_m",
     .meaning = "distance at the start, or when it appears",
     .at = AT(gap_m),
     .low = 0.01,
     .high = 1000,
     .required = true},
    {.name = "speed_mps", .meaning = "speed at the start", .at = AT(speed_mps), .high = 60},
    {.name = "lane",
     .meaning = "0: the own lane; 1: the next one to the left; -1: to the right. From 0.5 lanes "
                "aside on, the own car drives past it",
     .at = AT(lane),
     .low = -3,
     .high = 3},
    {.name = "change_s",
     .meaning = "when its speed begins to change",
     .at = AT(change_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "it does not change"},
    {.name = "change_mps2",
     .meaning = "acceleration of that change",
     .at = AT(change_mps2),
     .low = -20,
     .high = 20},
    {.name = "change_to_mps",
     .meaning = "speed after that change",
     .at = AT(change_to_mps),
     .high = 60},
    {.name = "profile",
     .meaning = "its speed over time, in place of speed_mps: seconds:m/s, as in 0:2, 1.5:2, 2:0",
     .kind = VALUE_PROFILE,
     .at = AT(profile),
     .high = 60},
    {.name = "appears_s",
     .meaning = "when it cuts in",
     .at = AT(appears_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "there from the start"},
    {.name = "leaves_s",
     .meaning = "when it leaves the lane",
     .at = AT(leaves_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "stays"},
    {.name = "missed",
     .meaning = "share of the readings in which it gives no echo",
     .at = AT(missed),
     .high = 1},
};
#undef AT

static void check_lead(struct section_check *check, const void *values)
{
    const struct lead *lead = values;
    int changes = (section_line(check, "change_s") != 0) +
                  (section_line(check, "change_mps2") != 0) +
                  (section_line(check, "change_to_mps") != 0);

    if (changes != 0 && changes != 3) {
        section_complain(check, NULL,
                         "change_s, change_mps2 and change_to_mps go together; give all three");
    }
    if (lead->profile.count > 0 && (changes > 0 || section_line(check, "speed_mps") != 0)) {
        section_complain(check, "profile",
                         "a profile and other speeds are given; keep one of them");
    }
    if (lead->appears_s >= 0 && lead->leaves_s >= 0 && lead->leaves_s <= lead->appears_s) {
        section_complain(check, "leaves_s", "leaves_s comes before appears_s; exchange them");
    }
}

const struct section lead_section = {.name = "lead",
                                     .meaning = "a car ahead",
                                     SECTION_KEYS(lead_keys),
                                     .size = sizeof(struct lead),
                                     .check = check_lead};

/* --- [uart] ------------------------------------------------------------------------------- */

#define AT(member) offsetof(struct uart, member)
static const struct key uart_keys[] = {
    {.name = "at_s",
     .meaning = "when the characters are sent",
     .at = AT(at_s),
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .required = true},
    {.name = "send",
     .meaning = "these characters",
     .kind = VALUE_TEXT,
     .at = AT(send),
     .text = "",
     .required = true},
};
#undef AT

const struct section uart_section = {.name = "uart",
                                     .meaning = "characters sent to the controller",
                                     SECTION_KEYS(uart_keys),
                                     .size = sizeof(struct uart)};

/* --- [flip] ------------------------------------------------------------------------------- */

#define OF_A_BIT   "flip low high"
#define OF_PINS    "pin_low pin_high pins_tied"
#define PIN_WORDS  "pwm stop trigger lamp buzzer servo cut lane echo override rxd txd"
#define AT(member) offsetof(struct flip, member)
static const struct key flip_keys[] = {
    {.name = "kind",
     .meaning = "flip: a bit changes once; low, high: it is stuck there; pin_low, pin_high: a pin "
                "is shorted to ground or supply; pins_tied: to the pin `to`; power_dip: the supply "
                "fails, and RAM and registers are lost; clock_stop: the oscillator stands; "
                "interrupts: every 100 machine cycles, all interrupts are requested",
     .kind = VALUE_CHOICE,
     .at = AT(kind),
     .choices = OF_A_BIT " " OF_PINS " power_dip clock_stop interrupts"},
    {.name = "place",
     .meaning = "internal RAM; special function registers; R0 to R7 of the bank in use; the "
                "program counter; external RAM",
     .kind = VALUE_CHOICE,
     .at = AT(place),
     .choices = "ram sfr register pc xdata",
     .kinds = OF_A_BIT,
     .required = true},
    {.name = "address",
     .meaning = "where in that place, as in 0x50: ram 0 to 255, sfr 128 to 255, register 0 to 7, "
                "xdata 0 to 65535",
     .kind = VALUE_COUNT,
     .at = AT(address),
     .high = 65535,
     .initial = SCENARIO_UNSET,
     .unset = "none, for pc",
     .kinds = OF_A_BIT},
    {.name = "bit",
     .meaning = "0 is the lowest; up to 7, of the program counter up to 15",
     .kind = VALUE_COUNT,
     .at = AT(bit),
     .high = 15,
     .kinds = OF_A_BIT,
     .required = true},
    {.name = "pin",
     .meaning = "the pin",
     .kind = VALUE_CHOICE,
     .at = AT(pin),
     .choices = PIN_WORDS,
     .kinds = OF_PINS,
     .required = true},
    {.name = "to",
     .meaning = "the pin that it is tied to, of the same port",
     .kind = VALUE_CHOICE,
     .at = AT(to),
     .choices = PIN_WORDS,
     .kinds = "pins_tied",
     .required = true},
    {.name = "at_s",
     .meaning = "when, after the first trigger",
     .at = AT(at_s),
     .low = 0.001,
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "by at_cycle"},
    {.name = "at_cycle",
     .meaning = "or: before the first instruction at or after this machine cycle since power came "
                "up",
     .kind = VALUE_COUNT,
     .at = AT(at_cycle),
     .high = 1e12,
     .initial = SCENARIO_UNSET,
     .unset = "by at_instruction"},
    {.name = "at_instruction",
     .meaning = "or: before the instruction of this number, counted from 0",
     .kind = VALUE_COUNT,
     .at = AT(at_instruction),
     .high = 1e12,
     .initial = SCENARIO_UNSET,
     .unset = "by at_s",
     .kinds = OF_A_BIT},
    {.name = "for_s",
     .meaning = "how long it lasts",
     .at = AT(for_s),
     .low = 0.0001,
     .high = 3600,
     .initial = SCENARIO_UNSET,
     .unset = "pins: to the end",
     .kinds = OF_PINS " power_dip clock_stop interrupts"},
};
#undef AT

static void check_bit(struct section_check *check, const struct flip *flip)
{
    static const struct {
        double first, last, top_bit;
        const char *name;
    } places[] = {[FLIP_RAM] = {0, 255, 7, "ram"},
                  [FLIP_SFR] = {128, 255, 7, "sfr"},
                  [FLIP_REGISTER] = {0, 7, 7, "register"},
                  [FLIP_PC] = {SCENARIO_UNSET, SCENARIO_UNSET, 15, "pc"},
                  [FLIP_XDATA] = {0, 65535, 7, "xdata"}};

    if (flip->address < places[flip->place].first || flip->address > places[flip->place].last) {
        if (flip->place == FLIP_PC) {
            section_complain(check, "address", "the pc has no address; take it out");
        } else {
            section_complain(check, "address", "%s has the addresses %g to %g; give one of them",
                             places[flip->place].name, places[flip->place].first,
                             places[flip->place].last);
        }
    }
    if (flip->bit > places[flip->place].top_bit) {
        section_complain(check, "bit", "%s has the bits 0 to %g; give one of them",
                         places[flip->place].name, places[flip->place].top_bit);
    }
}

/* The pins of the serial line, of the echo and of the override belong to port 3, all others to port
 * 1. */
static bool is_of_port_3(int pin)
{
    return pin >= BOARD_OUTPUTS;
}

static void check_flip(struct section_check *check, const void *values)
{
    const struct flip *flip = values;

    if (flip->kind <= FLIP_STUCK_HIGH) {
        check_bit(check, flip);
    }
    if (flip->kind == FLIP_PINS_TIED &&
        (flip->pin == flip->to || is_of_port_3(flip->pin) != is_of_port_3(flip->to))) {
        section_complain(check, "to", "the pins are not two of one port; give others");
    }
    if (flip->kind >= FLIP_POWER_DIP && flip->for_s < 0) {
        section_complain(check, NULL, "lacks for_s; add it");
    }
    if ((flip->at_s >= 0) + (flip->at_cycle >= 0) + (flip->at_instruction >= 0) != 1) {
        section_complain(check, NULL, "give at_s, at_cycle or at_instruction, one of them");
    }
}

const struct section flip_section = {.name = "flip",
                                     .meaning =
                                         "a bit of the chip that flips or sticks, a pin "
                                         "that is shorted, or a chip without supply or clock",
                                     SECTION_KEYS(flip_keys),
                                     .size = sizeof(struct flip),
                                     .check = check_flip};
