#include "render/hints.h"

#include "render/font.h"
#include "render/overlay.h"
#include "render/window.h"

#include <stdio.h>
#include <string.h>

void hints_say(struct hints *hints, const char *text)
{
    snprintf(hints->message, sizeof hints->message, "%s", text);
}

bool hints_key(struct hints *hints, int key)
{
    switch (key) {
    case WINDOW_F1:
    case '?':
        hints->page = hints->help ? hints->page + 1 : 0;
        hints->help = hints->page == 0 || hints->page < hints->pages;
        return true;
    case WINDOW_ESCAPE:
        hints->help = false;
        hints_say(hints, "");
        return true;
    default:
        return false;
    }
}

void hints_wrap(char *text, int columns)
{
    char *line = text, *space = NULL;
    for (char *at = text; *at; at++) {
        if (*at == '\n') {
            line = at + 1;
            space = NULL;
        } else if (*at == ' ') {
            space = at;
        }
        if (at - line >= columns && space) {
            *space = '\n';
            line = space + 1;
            space = NULL;
        }
    }
}

/* Behind so many lines; the text's end where there are fewer. */
static char *after_lines(char *text, int count)
{
    for (; count > 0 && *text; text++)
        count -= *text == '\n';
    return text;
}

void hints_page(struct hints *hints, const char *keys, int width, int height, char *text, size_t size)
{
    const int rows = (height - 2 * OVERLAY_BOX_MARGIN - FONT_HEIGHT) / FONT_STEP + 1,
              each = rows > 2 ? rows - 1 : 1;
    int lines = 1;
    snprintf(text, size, "%s", keys);
    hints_wrap(text, (width - 2 * OVERLAY_BOX_MARGIN) / (FONT_WIDTH + 1));
    for (const char *at = text; *at; at++)
        lines += *at == '\n';
    hints->pages = lines > rows ? (lines + each - 1) / each : 1;
    if (hints->pages == 1)
        return;
    if (hints->page >= hints->pages)
        hints->page = hints->pages - 1;
    char *first = after_lines(text, hints->page * each), *end = after_lines(first, each);
    const size_t length = (size_t)(end - first) - (end > first && end[-1] == '\n');
    memmove(text, first, length);
    snprintf(text + length, size - length, "\nF1 ?  this help: %d of %d", hints->page + 1, hints->pages);
}
