/* ask_to_close WINDOW: asks as a window manager does when its close button is pressed (ICCCM 4.2.8.1). */
#include <stdlib.h>
#include <X11/Xlib.h>

int main(int count, char **words)
{
    Display *display = count == 2 ? XOpenDisplay(NULL) : NULL;
    if (!display)
        return 1;
    Window window = strtoul(words[1], NULL, 10);
    XEvent event = {.xclient = {.type = ClientMessage,
                                .window = window,
                                .message_type = XInternAtom(display, "WM_PROTOCOLS", False),
                                .format = 32}};
    event.xclient.data.l[0] = (long)XInternAtom(display, "WM_DELETE_WINDOW", False);
    event.xclient.data.l[1] = CurrentTime;
    int sent = XSendEvent(display, window, False, NoEventMask, &event);
    XCloseDisplay(display);
    return !sent;
}
