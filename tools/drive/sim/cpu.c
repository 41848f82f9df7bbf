/* SPDX-License-Identifier: MIT */
#include "cpu.h"

#include <sched.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

/* The claim is a socket with a name but without a file: it is gone with its process, however that
 * ends. */
static int claim_name(size_t cpu)
{
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    int length =
        snprintf(address.sun_path + 1, sizeof address.sun_path - 1, "fuzzy51-cpu-%zu", cpu);
    int handle = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    socklen_t size = (socklen_t)(offsetof(struct sockaddr_un, sun_path) + 1 + (size_t)length);

    if (handle >= 0 && bind(handle, (const struct sockaddr *)&address, size) != 0) {
        close(handle);
        handle = -1;
    }
    return handle;
}

int cpu_claim(void)
{
    cpu_set_t allowed;

    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) {
        return -1;
    }
    for (size_t cpu = 0; cpu < CPU_SETSIZE; cpu++) {
        cpu_set_t one;

        if (!CPU_ISSET(cpu, &allowed) || claim_name(cpu) < 0) {
            continue;
        }
        CPU_ZERO(&one);
        CPU_SET(cpu, &one);
        return sched_setaffinity(0, sizeof one, &one) == 0 ? (int)cpu : -1;
    }
    return -1;
}
