#include "sim/interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t caught;

static void catch (int signal)
{
    if (!caught)
        caught = signal;
}

/* A shell has its background jobs ignore SIGINT, nohup what it starts SIGHUP: that stays so. */
static void watch(int signal, int flags)
{
    struct sigaction old, action = {.sa_handler = catch, .sa_flags = flags | SA_RESTART};
    sigemptyset(&action.sa_mask);
    if (!sigaction(signal, NULL, &old) && old.sa_handler != SIG_IGN)
        sigaction(signal, &action, NULL);
}

void interrupt_watch(void)
{
    watch(SIGINT, SA_RESETHAND);
    watch(SIGTERM, SA_RESETHAND);
    watch(SIGHUP, 0); /* of one terminal, both its shell and the system tell */
}

enum status interrupt_caught(void)
{
    switch (caught) {
    case 0:
        return STATUS_OK;
    case SIGHUP:
        return STATUS_HUNG_UP;
    case SIGINT:
        return STATUS_INTERRUPTED;
    default:
        return STATUS_TERMINATED;
    }
}
