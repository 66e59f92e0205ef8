// Takes over standard input and output, or listens on a socket, and moves bytes over connections.
#include "app/control/endpoint_private.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

enum { WAITING_CLIENTS = 8 };

// --- wires ---------------------------------------------------------------------------------------

static int ready(int descriptor, int events) {
    struct pollfd entry = {.fd = descriptor, .events = (short)events};
    return poll(&entry, 1, 0) > 0 ? entry.revents : 0;
}

static bool is_for_later(void) {
    return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR;
}

ptrdiff_t dip_wire_read(const DipWire *wire, void *bytes, size_t size) {
    if (!ready(wire->in, POLLIN)) {
        return 0;
    }
    const ssize_t count =
        wire->socket ? recv(wire->in, bytes, size, MSG_DONTWAIT) : read(wire->in, bytes, size);
    if (count > 0) {
        return count;
    }
    return count < 0 && is_for_later() ? 0 : -1;
}

ptrdiff_t dip_wire_write(const DipWire *wire, const void *bytes, size_t size) {
    if (!wire->sends && !(ready(wire->out, POLLOUT) & (POLLOUT | POLLERR))) {
        return 0;
    }
    size = wire->most_bytes > 0 && size > wire->most_bytes ? wire->most_bytes : size;
    const ssize_t count = wire->sends ? send(wire->out, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL)
                                      : write(wire->out, bytes, size);
    if (count >= 0) {
        return count;
    }
    return is_for_later() ? 0 : -1;
}

bool dip_wire_is_cut(const DipWire *wire) {
    return wire->socket ? (ready(wire->in, 0) & (POLLHUP | POLLERR)) != 0
                        : (ready(wire->out, 0) & (POLLHUP | POLLERR)) != 0;
}

void dip_wire_close(DipWire *wire) {
    if (wire->out >= 0 && wire->out != wire->in) {
        close(wire->out);
    }
    if (wire->socket && wire->in >= 0) {
        close(wire->in);
    }
    wire->in = wire->out = -1;
}

// --- standard input and output -------------------------------------------------------------------

// Opens standard output once more, so that writing to it does not wait. Descriptors of the same
// open file share the flag O_NONBLOCK: if Diptych set it on the descriptor that it was given,
// writes of the parent process would no longer wait either. Sockets cannot be opened again, and
// ordinary files need not be, so these are only duplicated. A pipe or device that cannot be opened
// again is duplicated, too. If poll() finds it ready, it takes PIPE_BUF bytes or one byte, and each
// write is limited to this.
static void open_output(DipWire *wire) {
    struct stat status;
    const bool known = fstat(STDOUT_FILENO, &status) == 0;
    const bool is_pipe = known && S_ISFIFO(status.st_mode);
    const bool is_device = known && S_ISCHR(status.st_mode);
    wire->out = is_pipe || is_device
                    ? open("/proc/self/fd/1", O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC)
                    : -1;
    if (wire->out < 0) {
        wire->out = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
        wire->most_bytes = is_pipe ? PIPE_BUF : is_device ? 1 : 0;
    }
}

bool dip_endpoint_open_standard(DipEndpoint *endpoint, DipWire *wire, DipError *err) {
    struct stat status, input;
    *endpoint = (DipEndpoint){.listener = -1, .stdout_copy = -1};
    *wire = (DipWire){.in = STDIN_FILENO};
    open_output(wire);
    if (wire->out >= 0) {
        endpoint->stdout_copy = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    }
    fflush(stdout);
    if (wire->out < 0 || endpoint->stdout_copy < 0 || dup2(STDERR_FILENO, STDOUT_FILENO) < 0) {
        dip_error_set_runtime(err, DIP_ERROR_IO, NULL, 0, "--control",
                              "standard output cannot be used: %s", strerror(errno));
        dip_wire_close(wire);
        dip_endpoint_close(endpoint);
        return false;
    }
    wire->sends = fstat(wire->out, &status) == 0 && S_ISSOCK(status.st_mode);
    if (wire->sends && fstat(STDIN_FILENO, &input) == 0 && input.st_dev == status.st_dev &&
        input.st_ino == status.st_ino) {
        // Standard input and output are one socket, for example one end of a socketpair that the
        // parent process has made. Both reading and writing use the duplicate of this socket that
        // open_output made.
        wire->in = wire->out;
        wire->socket = true;
    }
    signal(SIGPIPE, SIG_IGN);
    return true;
}

// --- the socket ----------------------------------------------------------------------------------

static bool refuse_path(DipErrorCode code, const char *path, const char *why, DipError *err) {
    return dip_error_set(err, code, path, 0, "--control", "%s", why);
}

// Returns whether a program listens on the socket, or true if this cannot be found out. Does not
// wait for a program that listens but accepts no clients.
static bool is_in_use(const struct sockaddr_un *address) {
    const int probe = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0);
    const bool refused = probe >= 0 &&
                         connect(probe, (const struct sockaddr *)address, sizeof *address) != 0 &&
                         errno == ECONNREFUSED;
    if (probe >= 0) {
        close(probe);
    }
    return !refused;
}

// Removes the socket's file that an earlier run left behind. Fails if the file is no socket, or if
// a program listens on it.
static bool remove_stale(const struct sockaddr_un *address, DipError *err) {
    struct stat status;
    const char *path = address->sun_path;
    if (lstat(path, &status) != 0) {
        return true; // There is no file, or the caller's bind() fails and tells why.
    }
    if (!S_ISSOCK(status.st_mode)) {
        return refuse_path(DIP_ERROR_CONFLICT, path,
                           "this file exists and is no socket, so it is not replaced", err);
    }
    if (is_in_use(address)) {
        return refuse_path(DIP_ERROR_CONFLICT, path, "another program listens on this socket", err);
    }
    unlink(path);
    return true;
}

static bool bind_path(DipEndpoint *endpoint, const struct sockaddr_un *address) {
    struct stat status;
    const mode_t before = umask(077); // Only the user who runs the program may connect.
    const bool bound =
        bind(endpoint->listener, (const struct sockaddr *)address, sizeof *address) == 0;
    const int why = errno;
    umask(before);
    errno = why;
    if (!bound) {
        return false;
    }
    memcpy(endpoint->path, address->sun_path, strlen(address->sun_path) + 1);
    if (lstat(endpoint->path, &status) == 0) {
        endpoint->device = status.st_dev;
        endpoint->inode = status.st_ino;
    }
    return listen(endpoint->listener, WAITING_CLIENTS) == 0;
}

bool dip_endpoint_listen(DipEndpoint *endpoint, const char *path, DipError *err) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    *endpoint = (DipEndpoint){.listener = -1, .stdout_copy = -1};
    if (!path[0] || strlen(path) >= sizeof address.sun_path) {
        return dip_error_set(err, DIP_ERROR_OVERSIZED, path, 0, "--control",
                             "the path of a socket has 1 to %zu bytes",
                             sizeof address.sun_path - 1);
    }
    strcpy(address.sun_path, path);
    if (!remove_stale(&address, err)) {
        return false;
    }
    endpoint->listener = socket(AF_UNIX, SOCK_STREAM, 0);
    if (endpoint->listener < 0 || fcntl(endpoint->listener, F_SETFD, FD_CLOEXEC) != 0 ||
        fcntl(endpoint->listener, F_SETFL, O_NONBLOCK) != 0 || !bind_path(endpoint, &address)) {
        dip_error_set_runtime(err, DIP_ERROR_IO, path, 0, "--control", "%s", strerror(errno));
        dip_endpoint_close(endpoint);
        return false;
    }
    return true;
}

bool dip_endpoint_accept(const DipEndpoint *endpoint, DipWire *wire) {
    if (endpoint->listener < 0) {
        return false;
    }
    const int client = accept(endpoint->listener, NULL, NULL);
    if (client < 0) {
        return false;
    }
    fcntl(client, F_SETFD, FD_CLOEXEC);
    *wire = (DipWire){.in = client, .out = client, .socket = true, .sends = true};
    return true;
}

void dip_endpoint_close(DipEndpoint *endpoint) {
    struct stat status;
    if (endpoint->listener >= 0) {
        close(endpoint->listener);
    }
    if (endpoint->path[0] && lstat(endpoint->path, &status) == 0 &&
        status.st_dev == endpoint->device && status.st_ino == endpoint->inode) {
        unlink(endpoint->path);
    }
    if (endpoint->stdout_copy >= 0) {
        fflush(stdout);
        dup2(endpoint->stdout_copy, STDOUT_FILENO);
        close(endpoint->stdout_copy);
    }
    *endpoint = (DipEndpoint){.listener = -1, .stdout_copy = -1};
}
