/* SPDX-License-Identifier: MIT */
/* A serial port of this machine, 8N1, without flow control. */
#ifndef FUZZY51_TFLUNA_PORT_H
#define FUZZY51_TFLUNA_PORT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct port {
    const char *path;
    int fd;
};

/* Opens PATH for this program alone. False after a message. */
bool port_open(struct port *port, const char *path);

/* Sets the line's rate and forgets what has come so far. False after a message. */
bool port_set_baud(const struct port *port, long baud);

/* Returns when all bytes have left. False after a message. */
bool port_write(const struct port *port, const uint8_t *bytes, size_t count);

/* The next byte, for which it waits until MS of port_now_ms. Returns 1; 0: none came; -1 after a
 * message: the port is gone. */
int port_read(const struct port *port, double until_ms, uint8_t *byte);

double port_now_ms(void);

void port_close(struct port *port);

#endif
