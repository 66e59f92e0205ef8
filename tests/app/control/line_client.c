// Connects, sends and splits lines.
#include "tests/app/control/line_client.h"

#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmocka.h>

static char taken[1 << 20];

void line_client_open(LineClient *client, const char *path) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    snprintf(address.sun_path, sizeof address.sun_path, "%s", path);
    client->bytes = 0;
    client->descriptor = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_true(client->descriptor >= 0);
    assert_int_equal(connect(client->descriptor, (const struct sockaddr *)&address, sizeof address),
                     0);
}

void line_client_close(LineClient *client) {
    close(client->descriptor);
    client->descriptor = -1;
}

size_t line_client_send(LineClient *client, const char *bytes, size_t count) {
    const ssize_t sent = send(client->descriptor, bytes, count, MSG_DONTWAIT | MSG_NOSIGNAL);
    return sent > 0 ? (size_t)sent : 0;
}

void line_client_line(LineClient *client, const char *text) {
    assert_int_equal(line_client_send(client, text, strlen(text)), strlen(text));
    assert_int_equal(line_client_send(client, "\n", 1), 1);
}

static void receive(LineClient *client) {
    ssize_t count = 1;
    while (count > 0 && client->bytes < sizeof client->buffer) {
        count = recv(client->descriptor, client->buffer + client->bytes,
                     sizeof client->buffer - client->bytes, MSG_DONTWAIT);
        client->bytes += count > 0 ? (size_t)count : 0;
    }
}

bool line_client_take(LineClient *client, const char **line) {
    char *end = memchr(client->buffer, '\n', client->bytes);
    if (!end) {
        receive(client);
        end = memchr(client->buffer, '\n', client->bytes);
    }
    if (!end) {
        return false;
    }
    const size_t length = (size_t)(end - client->buffer);
    memcpy(taken, client->buffer, length);
    taken[length] = '\0';
    client->bytes -= length + 1;
    memmove(client->buffer, end + 1, client->bytes);
    *line = taken;
    return true;
}

bool line_client_is_closed(LineClient *client) {
    char byte;
    const ssize_t count = recv(client->descriptor, &byte, 1, MSG_DONTWAIT | MSG_PEEK);
    return count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK);
}
