// Shows how another program embeds Diptych's preview. This sample host is a settings panel in plain
// Xlib, with the preview inside its window.
//
// Usage: diptych_host PROGRAM [ARGUMENT]...   for example: diptych_host ./diptych --scene blend
//
// The host makes a window with a row of buttons and an area below them. It starts the program with
// --window-id, so that the preview fills the area, and with --control -, so that requests and
// replies are lines on two pipes. The host prints all that arrives. docs/embedding.md explains the
// protocol. The program in the area is called the guest.
#include <X11/Xlib.h>

#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { WIDTH = 642, HEIGHT = 280, BAR_HEIGHT = 40, BUTTON_WIDTH = 80, MAX_ARGUMENTS = 60 };

typedef struct Host {
    Display *display;
    Window window;
    Window area; // The parent of the preview's window.
    GC gc;
    pid_t guest;
    int requests; // Write end of the guest's standard input.
    int replies;  // Read end of the guest's standard output.
    int next_id;
} Host;

// The buttons, and the request that each of them sends. "change" names only the settings to change.
static const struct {
    const char *label;
    const char *request;
} buttons[] = {
    {"AA 4x", "\"request\":\"set\",\"pane\":\"requested\",\"change\":\"aa=4,asd=1\""},
    {"AA off", "\"request\":\"set\",\"pane\":\"requested\",\"change\":\"aa=none,asd=1\""},
    {"AF 16x", "\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=16\""},
    {"AF off", "\"request\":\"set\",\"pane\":\"requested\",\"change\":\"af=none\""},
    {"Apply", "\"request\":\"apply\""},
    {"Pause", "\"request\":\"pause\""},
    {"Play", "\"request\":\"play\""},
};
enum { BUTTON_COUNT = sizeof buttons / sizeof buttons[0] };

static void send_request(Host *host, const char *request) {
    dprintf(host->requests, "{\"id\":%d,%s}\n", ++host->next_id, request);
}

static void open_window(Host *host) {
    const unsigned long grey = 0x404040;
    const Window root = DefaultRootWindow(host->display);
    host->window = XCreateSimpleWindow(host->display, root, 0, 0, WIDTH, HEIGHT, 0, 0, grey);
    host->area = XCreateSimpleWindow(host->display, host->window, 0, BAR_HEIGHT, WIDTH,
                                     HEIGHT - BAR_HEIGHT, 0, 0, 0);
    host->gc = XCreateGC(host->display, host->window, 0, NULL);
    XStoreName(host->display, host->window, "Settings panel");
    XSelectInput(host->display, host->window, ButtonPressMask | ExposureMask | StructureNotifyMask);
    XMapSubwindows(host->display, host->window);
    XMapWindow(host->display, host->window);
    XSync(host->display, False); // The area must exist before the guest starts.
}

// Starts the preview in the area, with pipes instead of standard input and output.
static void start_guest(Host *host, int argc, char **argv) {
    int to_guest[2], from_guest[2];
    char id[32];
    char *arguments[MAX_ARGUMENTS + 5] = {argv[1], "--window-id", id, "--control", "-"};
    snprintf(id, sizeof id, "%lu", host->area);
    for (int i = 2; i < argc; ++i) {
        arguments[i + 3] = argv[i];
    }
    if (pipe(to_guest) != 0 || pipe(from_guest) != 0 || (host->guest = fork()) < 0) {
        perror("diptych_host");
        exit(1);
    }
    if (host->guest == 0) {
        dup2(to_guest[0], STDIN_FILENO);
        dup2(from_guest[1], STDOUT_FILENO);
        close(to_guest[0]), close(to_guest[1]), close(from_guest[0]), close(from_guest[1]);
        execvp(argv[1], arguments);
        perror(argv[1]);
        _exit(127);
    }
    close(to_guest[0]), close(from_guest[1]);
    host->requests = to_guest[1];
    host->replies = from_guest[0];
    printf("guest started with process id %d\n", (int)host->guest);
    send_request(host, "\"request\":\"subscribe\",\"to\":[\"settings\",\"times\",\"picks\"]");
}

static void draw_buttons(const Host *host) {
    for (int b = 0; b < BUTTON_COUNT; ++b) {
        const int x = 8 + b * (BUTTON_WIDTH + 8);
        XSetForeground(host->display, host->gc, 0x707070);
        XFillRectangle(host->display, host->window, host->gc, x, 8, BUTTON_WIDTH, BAR_HEIGHT - 16);
        XSetForeground(host->display, host->gc, 0xffffff);
        XDrawString(host->display, host->window, host->gc, x + 8, BAR_HEIGHT / 2 + 4,
                    buttons[b].label, (int)strlen(buttons[b].label));
    }
}

static void handle_event(Host *host, const XEvent *event) {
    if (event->type == Expose) {
        draw_buttons(host);
    } else if (event->type == ConfigureNotify && event->xconfigure.window == host->window) {
        const int height = event->xconfigure.height - BAR_HEIGHT;
        XResizeWindow(host->display, host->area, (unsigned)event->xconfigure.width,
                      height > 1 ? (unsigned)height : 1); // The preview adapts to the area.
    } else if (event->type == ButtonPress && event->xbutton.y < BAR_HEIGHT) {
        const int button = (event->xbutton.x - 8) / (BUTTON_WIDTH + 8);
        if (host->replies >= 0 && event->xbutton.x >= 8 && button < BUTTON_COUNT) {
            send_request(host, buttons[button].request);
        }
    }
}

// Prints what the guest has sent. Returns false once the guest has ended.
static int print_replies(Host *host) {
    char bytes[4096];
    const ssize_t count = read(host->replies, bytes, sizeof bytes);
    if (count > 0) {
        fwrite(bytes, 1, (size_t)count, stdout);
    }
    return count > 0;
}

static void end_guest(Host *host) {
    int status = 0;
    waitpid(host->guest, &status, 0);
    close(host->replies), close(host->requests);
    host->replies = host->requests = -1;
    printf("guest ended with exit code %d\n", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
}

int main(int argc, char **argv) {
    Host host = {.display = XOpenDisplay(NULL)};
    if (argc < 2 || !host.display) {
        fprintf(stderr, argc < 2 ? "Usage: diptych_host PROGRAM [ARGUMENT]...\n"
                                 : "diptych_host: there is no X11 display\n");
        return 2;
    }
    if (argc > MAX_ARGUMENTS) {
        fprintf(stderr, "diptych_host: %d arguments, at most %d accepted\n", argc - 1,
                MAX_ARGUMENTS - 1);
        return 2;
    }
    signal(SIGPIPE, SIG_IGN); // The guest may end at any time.
    setvbuf(stdout, NULL, _IONBF, 0);
    open_window(&host);
    start_guest(&host, argc, argv);
    for (;;) {
        while (XPending(host.display) > 0) {
            XEvent event;
            XNextEvent(host.display, &event);
            handle_event(&host, &event);
        }
        struct pollfd waits[] = {{ConnectionNumber(host.display), POLLIN, 0},
                                 {host.replies, POLLIN, 0}};
        poll(waits, 2, -1); // poll ignores a negative descriptor.
        if (waits[1].revents && !print_replies(&host)) {
            end_guest(&host);
        }
    }
}
