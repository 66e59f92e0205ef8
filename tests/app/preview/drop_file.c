// Drops a file onto a window, as a file manager does: the source of a drag by the X protocol
// XDND 5. Usage: drop_file WINDOW_ID /PATH/OF/FILE [--die MOMENT]. Ends with 0 when the window says
// that it has taken the file. With --die, the program is killed by a signal at one of these
// moments: enter (right after it has offered the file), status (after the window has said that it
// would take the file), drop (after it has dropped the file) or request (when the window asks for
// the file).
#include <X11/Xatom.h>
#include <X11/Xlib.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static Display *x;
static Window source;
static Window target;
static char uri[4096];
static const char *dies_at = "";

// Dies here if --die names this moment. The X server has then all that was sent so far.
static void pass_moment(const char *moment) {
    if (strcmp(dies_at, moment) == 0) {
        XSync(x, False);
        raise(SIGKILL);
    }
}

static Atom atom(const char *name) {
    return XInternAtom(x, name, False);
}

static void send(const char *type, long l1, long l2, long l3, long l4) {
    XEvent event = {.xclient = {.type = ClientMessage,
                                .window = target,
                                .message_type = atom(type),
                                .format = 32,
                                .data.l = {(long)source, l1, l2, l3, l4}}};
    XSendEvent(x, target, False, NoEventMask, &event);
    XFlush(x);
}

// Hands over the file's URI.
static void answer(const XSelectionRequestEvent *request) {
    pass_moment("request");
    XEvent event = {.xselection = {.type = SelectionNotify,
                                   .requestor = request->requestor,
                                   .selection = request->selection,
                                   .target = request->target,
                                   .property = request->property,
                                   .time = request->time}};
    XChangeProperty(x, request->requestor, request->property, request->target, 8, PropModeReplace,
                    (const unsigned char *)uri, (int)strlen(uri));
    XSendEvent(x, request->requestor, False, NoEventMask, &event);
    XFlush(x);
}

// Answers the window's questions until it sends a message. Gives up after a minute.
static bool wait_for(const char *type) {
    for (int i = 0; i < 6000; i++) {
        while (XPending(x)) {
            XEvent event;
            XNextEvent(x, &event);
            if (event.type == SelectionRequest) {
                answer(&event.xselectionrequest);
            } else if (event.type == ClientMessage && event.xclient.message_type == atom(type)) {
                return true;
            }
        }
        const struct timespec pause = {0, 10000000};
        nanosleep(&pause, NULL);
    }
    fprintf(stderr, "the window sends no %s\n", type);
    return false;
}

int main(int argc, char **argv) {
    x = XOpenDisplay(NULL);
    if (!x || (argc != 3 && argc != 5)) {
        return 2;
    }
    dies_at = argc == 5 ? argv[4] : "";
    target = (Window)strtoul(argv[1], NULL, 0);
    snprintf(uri, sizeof uri, "file://%s\r\n", argv[2]);
    source = XCreateSimpleWindow(x, DefaultRootWindow(x), 0, 0, 1, 1, 0, 0, 0);
    XSetSelectionOwner(x, atom("XdndSelection"), source, CurrentTime);
    send("XdndEnter", 5L << 24, (long)atom("text/uri-list"), 0, 0);
    send("XdndPosition", 0, 10L << 16 | 10, CurrentTime, (long)atom("XdndActionCopy"));
    pass_moment("enter");
    bool taken = wait_for("XdndStatus");
    pass_moment("status");
    if (taken) {
        send("XdndDrop", 0, CurrentTime, 0, 0);
        pass_moment("drop");
        taken = wait_for("XdndFinished");
    }
    XCloseDisplay(x);
    return taken ? 0 : 1;
}
