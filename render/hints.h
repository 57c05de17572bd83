/* What a window has to say besides its picture: its last message, and on F1 the list of its keys. */
#ifndef RENDER_HINTS_H
#define RENDER_HINTS_H

#include <stdbool.h>

struct hints {
    bool help;          /* the keys are shown */
    char message[1100]; /* the last thing there was to say; "": nothing */
};

/* The text is cut off where it is longer than any error. */
void hints_say(struct hints *hints, const char *text);

/* The keys for that, the same in every window: F1 and ? show the list and hide it, Escape takes all away.
 * False for any other key. */
bool hints_key(struct hints *hints, int key);

#endif
