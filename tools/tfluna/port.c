/* SPDX-License-Identifier: MIT */
#include "port.h"

#include "diag.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <string.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

static const struct {
    long baud;
    speed_t speed;
} speeds[] = {{9600, B9600},     {19200, B19200},   {38400, B38400},   {57600, B57600},
              {115200, B115200}, {230400, B230400}, {460800, B460800}, {921600, B921600}};

bool port_open(struct port *port, const char *path)
{
    port->path = path;
    port->fd = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (port->fd < 0) {
        diag_error(path, 0, "%s; %s", strerror(errno),
                   errno == EACCES
                       ? "put yourself into the group that owns it (dialout), or ask root"
                       : "say which serial port the sensor is on, such as /dev/ttyUSB0");
        return false;
    }
    if (!isatty(port->fd)) {
        diag_error(path, 0, "this is no serial port; give one such as /dev/ttyUSB0");
        close(port->fd);
        return false;
    }
    ioctl(port->fd, TIOCEXCL);
    return true;
}

bool port_set_baud(const struct port *port, long baud)
{
    struct termios line;
    size_t i = 0;

    while (speeds[i].baud != baud) {
        i++;
    }
    if (tcgetattr(port->fd, &line) == 0) {
        cfmakeraw(&line);
        line.c_cflag = (line.c_cflag & ~(tcflag_t)(CSTOPB | CRTSCTS)) | CLOCAL | CREAD;
        if (cfsetspeed(&line, speeds[i].speed) == 0 && tcsetattr(port->fd, TCSANOW, &line) == 0 &&
            tcflush(port->fd, TCIFLUSH) == 0) {
            return true;
        }
    }
    diag_error(port->path, 0, "cannot set %ld baud: %s; take another serial adapter", baud,
               strerror(errno));
    return false;
}

bool port_write(const struct port *port, const uint8_t *bytes, size_t count)
{
    while (count > 0) {
        struct pollfd ready = {.fd = port->fd, .events = POLLOUT};
        ssize_t written = write(port->fd, bytes, count);

        if (written < 0 && errno != EAGAIN && errno != EINTR) {
            diag_error(port->path, 0, "%s while writing; is it still plugged in?", strerror(errno));
            return false;
        }
        if (written > 0) {
            bytes += written;
            count -= (size_t)written;
        } else {
            poll(&ready, 1, 1000);
        }
    }
    tcdrain(port->fd);
    return true;
}

int port_read(const struct port *port, double until_ms, uint8_t *byte)
{
    for (;;) {
        struct pollfd ready = {.fd = port->fd, .events = POLLIN};
        double left_ms = until_ms - port_now_ms();
        ssize_t count = read(port->fd, byte, 1);

        if (count == 1) {
            return 1;
        }
        if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
            diag_error(port->path, 0, "%s while reading; is it still plugged in?",
                       count == 0 ? "nothing is there" : strerror(errno));
            return -1;
        }
        if (left_ms <= 0) {
            return 0;
        }
        poll(&ready, 1, (int)left_ms + 1);
    }
}

double port_now_ms(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

void port_close(struct port *port)
{
    close(port->fd);
}
