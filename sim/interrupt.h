/*
 * Ctrl-C, kill and a terminal that is closed, as a question between two steps:
 *
 *     interrupt_watch();
 *     while (!interrupt_caught()) ...       STATUS_OK, or STATUS_HUNG_UP, STATUS_INTERRUPTED, STATUS_TERMINATED
 *
 * The second SIGINT or SIGTERM ends the program at once, for whoever cannot wait for the step to end.
 */
#ifndef SIM_INTERRUPT_H
#define SIM_INTERRUPT_H

#include "common/status.h"

void interrupt_watch(void);
enum status interrupt_caught(void);

#endif
