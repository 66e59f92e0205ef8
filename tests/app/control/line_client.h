// A client of the control channel for tests. It never waits.
#ifndef DIP_TESTS_APP_CONTROL_LINE_CLIENT_H
#define DIP_TESTS_APP_CONTROL_LINE_CLIENT_H

#include <stdbool.h>
#include <stddef.h>

typedef struct LineClient {
    int descriptor;
    size_t bytes;
    char buffer[1 << 20];
} LineClient;

// Connects to a socket. Asserts that this succeeds.
void line_client_open(LineClient *client, const char *path);
void line_client_close(LineClient *client);

// Sends as many bytes as fit now. Returns their number.
size_t line_client_send(LineClient *client, const char *bytes, size_t count);

// Sends a text and a line feed, which must fit.
void line_client_line(LineClient *client, const char *text);

// Takes the next line that has arrived, without its line feed. Returns false if there is none. The
// line is valid until the next call.
bool line_client_take(LineClient *client, const char **line);

// Returns whether the other side has closed the connection.
bool line_client_is_closed(LineClient *client);

#endif
