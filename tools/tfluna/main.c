/* SPDX-License-Identifier: MIT */
/* tfluna: sets a TF-Luna up once, from a PC, and shows what it measures. */
#include "diag.h"
#include "luna.h"
#include "manual.h"
#include "number.h"
#include "port.h"

#include <stdlib.h>
#include <string.h>

enum { BAUD = 9600, RATE_HZ = 100, SHOWN_EACH = 10, OPT_SHOW = 256, OPT_COUNT, OPT_WAIT };

const char *argp_program_version = "fuzzy51 " FUZZY51_VERSION;

struct arguments {
    const char *path;
    bool shows_only;
    long count; /* of readings to show; negative: without an end */
    double wait_ms;
};

static const struct argp_option options[] = {
    {"show", OPT_SHOW, NULL, 0, "change nothing, show what it measures", 0},
    {"count", OPT_COUNT, "N", 0,
     "show N readings and end; 0: none (default: until you press Ctrl-C)", 0},
    {"wait", OPT_WAIT, "SECONDS", 0, "wait so long for each answer, 0.01..60 (default 0.5)", 0},
    {0},
};

static error_t take_option(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;

    switch (key) {
    case OPT_SHOW:
        arguments->shows_only = true;
        return 0;
    case OPT_COUNT:
        arguments->count = parse_count(state, "count", text, 0, 1000000000);
        return 0;
    case OPT_WAIT:
        arguments->wait_ms = 1000 * parse_number(state, "wait", text, 0.01, 60);
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->path != NULL) {
            argp_error(state, "more than one port");
        }
        arguments->path = text;
        return 0;
    case ARGP_KEY_END:
        if (arguments->path == NULL) {
            argp_usage(state);
        }
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp parser = {
    .options = options,
    .parser = take_option,
    .args_doc = "PORT",
    .doc =
        "Sets up the TF-Luna lidar on a serial port, such as /dev/ttyUSB0, as the brake needs it, "
        "and shows what it measures. A new one sends at 115200 baud, which the chip cannot read: "
        "tfluna finds the rate that it has, sets 9600 baud and 100 readings a second, and lets it "
        "keep them without power.\vWire it to a serial adapter of 3.3 V: pin 1 to 5 V, pin 2 (RXD) "
        "to the adapter's TX, pin 3 (TXD) to its RX, pin 4 to GND; leave pin 5 open. Exit status: "
        "0 fine; 1 the port cannot be used, or the sensor does not answer; 2 bad usage.",
};

struct talk {
    struct port port;
    struct luna_stream stream;
    double wait_ms;
};

/* The next message. Returns 1; 0: none came in time; -1 after a message: the port is gone. */
static int next(struct talk *talk, double until_ms, struct luna_message *message)
{
    uint8_t byte;

    while (!luna_next(&talk->stream, message)) {
        int status = port_read(&talk->port, until_ms, &byte);

        if (status != 1) {
            return status;
        }
        luna_push(&talk->stream, byte);
    }
    return 1;
}

static bool set_baud(struct talk *talk, long baud)
{
    memset(&talk->stream, 0, sizeof talk->stream);
    return port_set_baud(&talk->port, baud);
}

/* Sends a command whose payload is VALUE in COUNT bytes. */
static bool tell(struct talk *talk, enum luna_id id, unsigned long value, size_t count)
{
    uint8_t payload[4], bytes[LUNA_MOST];

    for (size_t i = 0; i < count; i++) {
        payload[i] = (uint8_t)(value >> 8 * i);
    }
    return port_write(&talk->port, bytes, luna_command(bytes, id, payload, count));
}

/* Waits for the reply to ID. Returns as `next`. */
static int reply_to(struct talk *talk, enum luna_id id, struct luna_message *reply)
{
    double until_ms = port_now_ms() + talk->wait_ms;
    int status;

    do {
        status = next(talk, until_ms, reply);
    } while (status == 1 && (reply->is_reading || reply->id != (uint8_t)id));
    return status;
}

/* Finds the rate that the sensor has: one at which a reading comes or a question is answered.
 * Returns it; 0: it is silent; -1 after a message. */
static long find(struct talk *talk)
{
    static const long bauds[] = {115200, BAUD, 19200, 38400, 57600, 230400, 460800, 921600};
    struct luna_message message;

    for (size_t i = 0; i < sizeof bauds / sizeof bauds[0]; i++) {
        int status;

        if (!set_baud(talk, bauds[i]) || !tell(talk, LUNA_VERSION, 0, 0)) {
            return -1;
        }
        status = next(talk, port_now_ms() + talk->wait_ms, &message);
        if (status != 0) {
            return status == 1 ? bauds[i] : -1;
        }
    }
    return 0;
}

/* Tells it a setting and takes its word that it has it. */
static int set(struct talk *talk, enum luna_id id, unsigned long value, size_t count,
               const char *what)
{
    struct luna_message reply;
    unsigned long said = 0;
    int status;

    if (!tell(talk, id, value, count)) {
        return EXIT_INPUT;
    }
    status = reply_to(talk, id, &reply);
    if (status < 0) {
        return EXIT_INPUT;
    }
    if (status == 0) {
        return diag_error(talk->port.path, 0,
                          "the sensor does not answer when told %s; check its wire RXD (pin 2)",
                          what);
    }
    for (size_t i = 0; i < count && i < reply.payload_count; i++) {
        said |= (unsigned long)reply.payload[i] << 8 * i;
    }
    if (reply.payload_count != count || said != value) {
        return diag_error(talk->port.path, 0,
                          "the sensor refuses %s: it answers %lu; is it a TF-Luna?", what, said);
    }
    return EXIT_FINE;
}

/* The reply comes at the old rate or at the new one, by the sensor's firmware: what counts is that
 * a question is answered at the new rate. */
static int change_baud(struct talk *talk)
{
    struct luna_message reply;
    int status;

    if (!tell(talk, LUNA_BAUD, BAUD, 4) || reply_to(talk, LUNA_BAUD, &reply) < 0 ||
        !set_baud(talk, BAUD) || !tell(talk, LUNA_VERSION, 0, 0)) {
        return EXIT_INPUT;
    }
    status = reply_to(talk, LUNA_VERSION, &reply);
    if (status == 0) {
        diag_error(talk->port.path, 0,
                   "the sensor is silent at %d baud; switch its power off and on and try again",
                   BAUD);
    }
    return status == 1 ? EXIT_FINE : EXIT_INPUT;
}

static int save(struct talk *talk)
{
    struct luna_message reply;
    int status;

    if (!tell(talk, LUNA_SAVE, 0, 0)) {
        return EXIT_INPUT;
    }
    status = reply_to(talk, LUNA_SAVE, &reply);
    if (status == 1 && (reply.payload_count != 1 || reply.payload[0] != 0)) {
        status = 0;
    }
    if (status == 0) {
        diag_error(talk->port.path, 0,
                   "the sensor did not save its settings; switch its power off and on and try "
                   "again");
    }
    return status == 1 ? EXIT_FINE : EXIT_INPUT;
}

static int set_up(struct talk *talk, long baud)
{
    int status = set(talk, LUNA_RATE_HZ, RATE_HZ, 2, "100 readings a second");

    if (status == EXIT_FINE) {
        status = set(talk, LUNA_FORMAT, 1, 1, "readings of 9 bytes");
    }
    if (status == EXIT_FINE) {
        status = set(talk, LUNA_IS_SENDING, 1, 1, "to send by itself");
    }
    if (status == EXIT_FINE && baud != BAUD) {
        status = change_baud(talk);
    }
    if (status == EXIT_FINE) {
        status = save(talk);
    }
    if (status == EXIT_FINE) {
        printf("set and saved: %d baud, %d readings a second\n", BAUD, RATE_HZ);
    }
    return status;
}

static void print_reading(const struct luna_message *reading)
{
    if (reading->strength == LUNA_BLINDED) {
        printf("blinded, %.1f C\n", reading->chip_c);
    } else if (reading->strength < LUNA_WEAK || reading->dist_cm == 0) {
        printf("no target, strength %u, %.1f C\n", reading->strength, reading->chip_c);
    } else {
        printf("%.2f m, strength %u, %.1f C\n", reading->dist_cm / 100.0, reading->strength,
               reading->chip_c);
    }
    fflush(stdout);
}

/* Shows one of ten readings, COUNT in all; without an end if it is negative. */
static int show(struct talk *talk, long count)
{
    struct luna_message message;
    int until_shown = 1;

    while (count != 0) {
        int status = next(talk, port_now_ms() + talk->wait_ms, &message);

        if (status < 0) {
            return EXIT_INPUT;
        }
        if (status == 0) {
            return diag_error(talk->port.path, 0,
                              "the sensor sends no readings; set it up, without --show, and check "
                              "its supply");
        }
        if (message.is_reading && --until_shown == 0) {
            print_reading(&message);
            until_shown = SHOWN_EACH;
            count -= count > 0;
        }
    }
    return EXIT_FINE;
}

static const struct manual manual = {
    .program = "tfluna",
    .brief = "sets up a TF-Luna lidar for the brake and shows what it measures",
    .about = "",
    .command = &(const struct manual_command){.argp = &parser},
    .commands = 1,
};

int main(int argc, char **argv)
{
    static struct talk talk;
    struct arguments arguments = {.count = -1, .wait_ms = 500};
    int status;
    long baud;

    argp_err_exit_status = EXIT_USAGE;
    if (argc == 2 && manual_option(&manual, argv[1], &status)) {
        return status;
    }
    argp_parse(&parser, argc, argv, 0, NULL, &arguments);
    talk.wait_ms = arguments.wait_ms;
    if (!port_open(&talk.port, arguments.path)) {
        return EXIT_INPUT;
    }
    baud = find(&talk);
    status = EXIT_INPUT;
    if (baud == 0) {
        diag_error(arguments.path, 0,
                   "no sensor answers at any rate; check its supply of 5 V, and that pin 2 goes to "
                   "TX, pin 3 to RX, and pin 5 nowhere");
    } else if (baud > 0) {
        printf("the sensor is there, at %ld baud\n", baud);
        status = arguments.shows_only ? EXIT_FINE : set_up(&talk, baud);
    }
    if (status == EXIT_FINE) {
        status = show(&talk, arguments.count);
    }
    port_close(&talk.port);
    return status;
}
