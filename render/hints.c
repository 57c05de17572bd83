#include "render/hints.h"

#include "render/window.h"

#include <stdio.h>

void hints_say(struct hints *hints, const char *text)
{
    snprintf(hints->message, sizeof hints->message, "%s", text);
}

bool hints_key(struct hints *hints, int key)
{
    switch (key) {
    case WINDOW_F1:
    case '?':
        hints->help = !hints->help;
        return true;
    case WINDOW_ESCAPE:
        hints->help = false;
        hints_say(hints, "");
        return true;
    default:
        return false;
    }
}
