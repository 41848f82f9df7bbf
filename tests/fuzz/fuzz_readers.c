/* SPDX-License-Identifier: MIT */
/* Fuzzes the other readers: `make fuzz`. The first byte chooses what the bytes after it are:
 *   H  an image in Intel HEX, which bound then follows
 *   L  an image in Intel HEX; behind the byte 1 a listing or map of it
 *   S  a scenario
 *   V  the value change dump of the simulator, cut in two at the place that the second byte names
 *   U  lines of the serial port, cut in the same way
 * Whatever the bytes, no crash, hang or leak. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "bound/flow.h"
#include "bound/listing.h"
#include "common/diag.h"
#include "scenario.h"
#include "telemetry.h"
#include "vcd.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* A file in memory that holds the bytes; PATH becomes its name. */
static int as_file(const uint8_t *data, size_t size, char path[40])
{
    int file = memfd_create("fuzz", 0);

    if (file < 0 || write(file, data, size) != (ssize_t)size) {
        abort();
    }
    snprintf(path, 40, "/proc/self/fd/%d", file);
    return file;
}

/* What bound does with an image: it follows all, and counts each function that has a name. */
static void follow(const struct hexfile *hex, const struct listing *listing)
{
    struct flow *flow = malloc(sizeof *flow);
    long cycles;

    if (flow == NULL) {
        abort();
    }
    flow_init(flow, hex, listing, "fuzz");
    if (flow_follow(flow)) {
        for (int n = 0; n < FLOW_INTERRUPTS; n++) {
            uint16_t entry;

            if (flow_interrupt(flow, n, &entry)) {
                flow_cycles(flow, entry, false, &cycles);
            }
        }
        for (int i = 0, named = 0; i < HEX_CODE_SIZE && named < 8; i++) {
            if (listing->names[i] != NULL) {
                named++;
                flow_cycles(flow, (uint16_t)i, i % 2 == 1, &cycles);
            }
        }
    }
    flow_free(flow);
    free(flow);
}

static void check_image(const uint8_t *image, size_t size, const uint8_t *text, size_t length)
{
    static struct hexfile hex;
    struct listing *listing = malloc(sizeof *listing);
    char path[40];
    int file = as_file(image, size, path), status;

    if (listing == NULL) {
        abort();
    }
    listing_init(listing);
    status = hexfile_read(&hex, path);
    close(file);
    if (status == EXIT_FINE) {
        file = as_file(text, length, path);
        status = listing_read(listing, &hex, path);
        close(file);
    }
    if (status == EXIT_FINE) {
        follow(&hex, listing);
    }
    listing_free(listing);
    free(listing);
}

static void check_scenario(const uint8_t *text, size_t size)
{
    static struct scenario scenario;
    char path[40];
    int file = as_file(text, size, path);

    memset(&scenario, 0, sizeof scenario);
    scenario_read(&scenario, path, NULL, 0);
    close(file);
}

static void ignore_change(void *user, int64_t time_ns, int var, uint32_t value)
{
    (void)user;
    (void)time_ns;
    (void)value;
    if (var < 0 || var >= VCD_MAX_VARS) {
        abort();
    }
}

static void check_dump(const char *bytes, size_t size, size_t cut)
{
    struct vcd_reader reader;

    vcd_init(&reader);
    if (vcd_feed(&reader, bytes, cut, ignore_change, NULL)) {
        vcd_feed(&reader, bytes + cut, size - cut, ignore_change, NULL);
    }
    vcd_var_index(&reader, "P1");
}

static void check_lines(const char *bytes, size_t size, size_t cut)
{
    struct telemetry telemetry;

    telemetry_init(&telemetry);
    telemetry_take(&telemetry, 1, 0, bytes, cut, NULL, NULL);
    telemetry_take(&telemetry, 2, 1, bytes + cut, size - cut, NULL, NULL);
    telemetry_value(&telemetry, "dist_mm");
    telemetry_free(&telemetry);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    const uint8_t *behind = size > 1 ? memchr(data + 1, 1, size - 1) : NULL;
    size_t cut;

    if (size < 2) {
        return 0;
    }
    cut = data[1] < size - 2 ? data[1] : size - 2;
    switch (data[0]) {
    case 'H':
        check_image(data + 1, size - 1, (const uint8_t *)"", 0);
        break;
    case 'L':
        if (behind != NULL) {
            check_image(data + 1, (size_t)(behind - data - 1), behind + 1,
                        size - (size_t)(behind + 1 - data));
        }
        break;
    case 'S':
        check_scenario(data + 1, size - 1);
        break;
    case 'V':
        check_dump((const char *)data + 2, size - 2, cut);
        break;
    case 'U':
        check_lines((const char *)data + 2, size - 2, cut);
        break;
    default:
        break;
    }
    return 0;
}
