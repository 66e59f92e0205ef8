// Buffers of a client.
#include "app/control/client_private.h"

#include <stdlib.h>
#include <string.h>

DipClient *dip_client_create(DipWire wire) {
    DipClient *client = calloc(1, sizeof *client);
    if (client) {
        client->wire = wire;
    }
    return client;
}

void dip_client_destroy(DipClient **client) {
    if (*client) {
        dip_wire_close(&(*client)->wire);
        free(*client);
        *client = NULL;
    }
}

static void drop_input(DipClient *client, size_t bytes) {
    client->in_first += bytes;
    client->in_bytes -= bytes;
}

void dip_client_read(DipClient *client) {
    memmove(client->in, client->in + client->in_first, client->in_bytes);
    client->in_first = 0;
    while (!client->ended && client->in_bytes < sizeof client->in) {
        const ptrdiff_t count = dip_wire_read(&client->wire, client->in + client->in_bytes,
                                              sizeof client->in - client->in_bytes);
        client->ended = count < 0;
        if (count <= 0) {
            return;
        }
        client->in_bytes += (size_t)count;
    }
}

// Skips the rest of a line that is too long. Returns whether the line's end has been reached.
static bool skip(DipClient *client) {
    const char *first = client->in + client->in_first;
    const char *end = memchr(first, '\n', client->in_bytes);
    drop_input(client, end ? (size_t)(end - first) + 1 : client->in_bytes);
    client->skips = !end;
    return end != NULL;
}

DipClientLine dip_client_line(DipClient *client, const char **line, size_t *length) {
    if (client->skips && !skip(client)) {
        return DIP_CLIENT_NO_LINE;
    }
    const char *first = client->in + client->in_first;
    const char *end = memchr(first, '\n', client->in_bytes);
    *line = first;
    *length = end ? (size_t)(end - first) : client->in_bytes;
    if (*length > DIP_CONTROL_MAX_LINE_BYTES + 1) { // 1: a carriage return may end the line.
        skip(client);
        return DIP_CLIENT_LONG_LINE;
    }
    // The last line may end without a line feed.
    return end || (client->ended && client->in_bytes > 0) ? DIP_CLIENT_LINE : DIP_CLIENT_NO_LINE;
}

void dip_client_remove_line(DipClient *client, size_t length) {
    drop_input(client, length < client->in_bytes ? length + 1 : length);
    client->attempt = 0;
}

bool dip_client_is_full(const DipClient *client) {
    return client->out_bytes > DIP_CLIENT_FULL_BYTES;
}

bool dip_client_send(DipClient *client, const char *line, size_t length) {
    if (client->broken) {
        return true; // Nobody reads replies any more, but the client's requests still count.
    }
    if (length + 1 > sizeof client->out - client->out_bytes) {
        return false;
    }
    memcpy(client->out + client->out_bytes, line, length);
    client->out[client->out_bytes + length] = '\n';
    client->out_bytes += length + 1;
    return true;
}

void dip_client_write(DipClient *client) {
    while (client->out_bytes > 0 && !client->broken) {
        const ptrdiff_t count = dip_wire_write(&client->wire, client->out, client->out_bytes);
        if (count < 0) {
            client->broken = true;
            client->out_bytes = 0;
        }
        if (count <= 0) {
            return;
        }
        client->out_bytes -= (size_t)count;
        memmove(client->out, client->out + count, client->out_bytes);
    }
}

bool dip_client_is_done(const DipClient *client) {
    const bool answered = client->ended && client->in_bytes == 0 && client->out_bytes == 0;
    return answered && (client->broken || client->topics == 0 || dip_wire_is_cut(&client->wire));
}
