#include "sim/interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t caught;

static void catch (int signal)
{
    caught = signal;
}

/* A shell has its background jobs ignore SIGINT: that stays so. */
static void watch(int signal)
{
    struct sigaction old, action = {.sa_handler = catch, .sa_flags = SA_RESETHAND | SA_RESTART};
    sigemptyset(&action.sa_mask);
    if (!sigaction(signal, NULL, &old) && old.sa_handler != SIG_IGN)
        sigaction(signal, &action, NULL);
}

void interrupt_watch(void)
{
    watch(SIGINT);
    watch(SIGTERM);
}

int interrupt_caught(void)
{
    return caught;
}
