// A client of the control channel: splits its input into lines and keeps what it has not read yet.
//
// Both buffers have fixed sizes. A client that does not read gets no further events, and its
// requests wait, until it reads again. Memory never grows, and nothing waits for the client.
#ifndef DIP_APP_CONTROL_CLIENT_PRIVATE_H
#define DIP_APP_CONTROL_CLIENT_PRIVATE_H

#include "app/control/endpoint_private.h"
#include "app/control/request.h"

#include <stdint.h>

enum {
    DIP_CLIENT_OUT_BYTES = 262144,
    // With more unread bytes than this, requests wait and events are dropped. The rest of the
    // buffer is room for one more reply.
    DIP_CLIENT_FULL_BYTES = 131072
};

typedef struct DipClient {
    DipWire wire;
    bool ended;       // The client has closed its side; no further input comes.
    bool broken;      // Nobody reads the output any more, so it is thrown away.
    bool skips;       // The rest of a line that is too long is skipped.
    unsigned topics;  // Subscriptions, as bits 1 << DipControlTopic.
    uint64_t dropped; // Events that were dropped since the last event that was sent.
    int attempt;      // How often the first line has been put off.
    size_t in_first;  // Index in `in` of the first byte that is not used yet.
    size_t in_bytes;  // Number of bytes in `in` that are not used yet.
    size_t out_bytes;
    char in[DIP_CONTROL_MAX_LINE_BYTES + 2]; // Room for the line, "\r" and "\n".
    char out[DIP_CLIENT_OUT_BYTES];
} DipClient;

DipClient *dip_client_create(DipWire wire); // NULL if memory runs out; the wire then stays open.
void dip_client_destroy(DipClient **client);

// Reads what has arrived, as far as there is room.
void dip_client_read(DipClient *client);

typedef enum DipClientLine {
    DIP_CLIENT_NO_LINE,
    DIP_CLIENT_LINE,
    DIP_CLIENT_LONG_LINE // A line was too long. It has been removed, and is reported once.
} DipClientLine;

// Finds the first line. The text is not terminated, and is valid until dip_client_remove_line.
DipClientLine dip_client_line(DipClient *client, const char **line, size_t *length);
void dip_client_remove_line(DipClient *client, size_t length);

// Returns whether the client has so much left to read that requests wait and events are dropped.
bool dip_client_is_full(const DipClient *client);

// Appends a line to the output. Returns false if there is no room.
bool dip_client_send(DipClient *client, const char *line, size_t length);

// Writes as much output as fits now.
void dip_client_write(DipClient *client);

// Returns whether the connection has served its purpose and can be closed.
bool dip_client_is_done(const DipClient *client);

#endif
