/*
 * Ctrl-C and kill, as a question between two steps:
 *
 *     interrupt_watch();
 *     while (!interrupt_caught()) ...       0, SIGINT or SIGTERM
 *
 * The second signal ends the program at once, for whoever cannot wait for the step to end.
 */
#ifndef SIM_INTERRUPT_H
#define SIM_INTERRUPT_H

void interrupt_watch(void);
int interrupt_caught(void);

#endif
