/* SPDX-License-Identifier: MIT */
/* Keeps the simulator and the plant on one processor. They take turns 2,000 times a simulated
 * second; handing over between two processors costs more than the work itself. */
#ifndef FUZZY51_CPU_H
#define FUZZY51_CPU_H

/* Moves this process and its later children to a processor that no other drive has claimed; the
 * claim ends with the process. Returns its number, or -1 when all are claimed: then the system
 * places the processes. */
int cpu_claim(void);

#endif
