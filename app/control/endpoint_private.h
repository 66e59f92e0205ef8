// Connects the control channel with its clients: the program at the other end of standard input and
// output, or the programs that connect to a Unix domain socket. No function here waits for a
// client.
#ifndef DIP_APP_CONTROL_ENDPOINT_PRIVATE_H
#define DIP_APP_CONTROL_ENDPOINT_PRIVATE_H

#include "renderer/base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <sys/types.h>

// A connection to a client. A closed descriptor is -1, so a zero-initialised wire is not valid.
typedef struct DipWire {
    int in;
    int out;
    bool socket;       // True if both descriptors are the same socket.
    bool sends;        // True if `out` is a socket.
    size_t most_bytes; // Greatest number of bytes in one write, so that it does not wait; 0 if
                       // there is no limit.
} DipWire;

// Reads at most `size` bytes. Returns their number, 0 if there are none now, or -1 at the end of
// the input or after an error.
ptrdiff_t dip_wire_read(const DipWire *wire, void *bytes, size_t size);

// Writes as many bytes as the connection takes now. Returns their number, or -1 after an error, for
// example because nobody reads any more.
ptrdiff_t dip_wire_write(const DipWire *wire, const void *bytes, size_t size);

// Returns whether nothing can reach the client any more, because the client has closed a socket in
// both directions or no longer reads standard output.
bool dip_wire_is_cut(const DipWire *wire);

void dip_wire_close(DipWire *wire);

typedef struct DipEndpoint {
    int listener; // Listening socket, or -1 with standard input and output.
    char path[128];
    dev_t device; // Device of the socket's file.
    ino_t inode;  // Inode of the socket's file. A file with another inode or device is not removed.
    int stdout_copy; // Copy of the descriptor of the original standard output, or -1.
} DipEndpoint;

// Takes over standard input and output. What the program prints on standard output from now on goes
// to standard error. From now on, the process ignores SIGPIPE. Fails with IO.
bool dip_endpoint_open_standard(DipEndpoint *endpoint, DipWire *wire, DipError *err);

// Listens on a socket that only the user who runs the program can open. Replaces a file at this
// path only if it is a socket on which no program listens. Fails with CONFLICT, OVERSIZED or IO.
bool dip_endpoint_listen(DipEndpoint *endpoint, const char *path, DipError *err);

// Accepts a client. Returns false if no client waits or an error occurs.
bool dip_endpoint_accept(const DipEndpoint *endpoint, DipWire *wire);

// Closes the listening socket and removes its file, or restores the process's standard output.
void dip_endpoint_close(DipEndpoint *endpoint);

#endif
