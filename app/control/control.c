// Accepts clients, answers their lines and sends them events.
#include "app/control/control.h"

#include "app/control/endpoint_private.h"
#include "renderer/base/utf8.h"

#include <cjson/cJSON.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    OUT_BYTES = 262144,
    // While a client has more unread bytes than this, its requests wait and its events are dropped.
    // The rest of the buffer is room for one more reply.
    FULL_BYTES = 131072
};

// A client. Both buffers have fixed sizes: a client that does not read gets no further events, and
// its requests wait, until it reads again. Memory never grows, and nothing waits for the client.
typedef struct Client {
    DipWire wire;
    bool ended; // True if the client has closed its side or reading failed; no further input comes.
    bool broken;      // True if the client does not read any more; its output is thrown away.
    bool skips;       // True if the current line is too long; its rest is skipped.
    unsigned topics;  // Subscriptions, as bits 1 << DipControlTopic.
    uint64_t dropped; // Number of events that were dropped since the last event that was sent.
    int attempt;      // How often the owner has put off the request in the first waiting line.
    size_t in_first;  // Index in `in` of the first byte that is not used yet.
    size_t in_bytes;  // Number of bytes in `in` that are not used yet.
    size_t out_bytes;
    char in[DIP_CONTROL_MAX_LINE_BYTES + 2]; // Room for the line, "\r" and "\n".
    char out[OUT_BYTES];
} Client;

struct DipControl {
    DipControlDef def;
    DipEndpoint endpoint;
    Client *clients[DIP_CONTROL_MAX_CLIENTS]; // NULL where no client is connected.
    unsigned subscriptions;
};

// Diptych sends no_memory instead of a line if there is no memory to write this line or no room for
// it in the output buffer. (An event whose fields could not be made is dropped.) It sends too_many
// to a client that connects when DIP_CONTROL_MAX_CLIENTS are connected already, or when there is no
// memory for another client.
static const char no_memory[] = "{\"id\":null,\"ok\":false,\"error\":{\"code\":\"MEMORY\","
                                "\"field\":\"\",\"message\":\"out of memory\"}}";
static const char too_many[] = "{\"id\":null,\"ok\":false,\"error\":{\"code\":\"BUSY\","
                               "\"field\":\"\",\"message\":\"too many clients are connected\"}}\n";

// --- input and output of a client ----------------------------------------------------------------

static void drop_input(Client *client, size_t bytes) {
    client->in_first += bytes;
    client->in_bytes -= bytes;
}

// Reads the bytes that have arrived, as far as the buffer has room.
static void read_input(Client *client) {
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
static bool skip(Client *client) {
    const char *first = client->in + client->in_first;
    const char *end = memchr(first, '\n', client->in_bytes);
    drop_input(client, end ? (size_t)(end - first) + 1 : client->in_bytes);
    client->skips = !end;
    return end != NULL;
}

typedef enum Line {
    NO_LINE,
    WHOLE_LINE,
    LONG_LINE // A line is too long. It is reported once and skipped, including the part that has
              // not arrived yet.
} Line;

// Finds the first line. Its text is not terminated, and is valid until the next call of read_input.
static Line find_line(Client *client, const char **line, size_t *length) {
    if (client->skips && !skip(client)) {
        return NO_LINE;
    }
    const char *first = client->in + client->in_first;
    const char *end = memchr(first, '\n', client->in_bytes);
    *line = first;
    *length = end ? (size_t)(end - first) : client->in_bytes;
    if (*length > DIP_CONTROL_MAX_LINE_BYTES + 1) { // The line may end with "\r".
        skip(client);
        return LONG_LINE;
    }
    // The last line may end without a line feed.
    return end || (client->ended && client->in_bytes > 0) ? WHOLE_LINE : NO_LINE;
}

static void remove_line(Client *client, size_t length) {
    drop_input(client, length < client->in_bytes ? length + 1 : length);
    client->attempt = 0;
}

static bool is_full(const Client *client) {
    return client->out_bytes > FULL_BYTES;
}

// Appends a line to the output. Returns false if there is no room.
static bool send_line(Client *client, const char *line, size_t length) {
    if (client->broken) {
        return true; // Nobody reads replies any more, but the client's requests are still carried
                     // out.
    }
    if (length + 1 > sizeof client->out - client->out_bytes) {
        return false;
    }
    memcpy(client->out + client->out_bytes, line, length);
    client->out[client->out_bytes + length] = '\n';
    client->out_bytes += length + 1;
    return true;
}

// Writes as much output as the connection takes now.
static void write_output(Client *client) {
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

// --- sending -------------------------------------------------------------------------------------

// Sends an object, or the line no_memory if memory or the room in the output buffer does not
// suffice. Deletes the object.
static void send_object(Client *client, cJSON *object) {
    char *line = object ? cJSON_PrintUnformatted(object) : NULL;
    if (!line || !send_line(client, line, strlen(line))) {
        send_line(client, no_memory, sizeof no_memory - 1);
    }
    cJSON_free(line);
    cJSON_Delete(object);
}

// Adds an array with the names whose bits are set.
static void add_names(cJSON *object, const char *key, const char *const *names, int count,
                      unsigned bits) {
    cJSON *array = cJSON_AddArrayToObject(object, key);
    for (int i = 0; array && i < count; ++i) {
        if (bits >> i & 1) {
            cJSON_AddItemToArray(array, cJSON_CreateStringReference(names[i]));
        }
    }
}

static void greet(const DipControl *control, Client *client) {
    cJSON *greeting = cJSON_CreateObject();
    cJSON_AddStringToObject(greeting, "diptych", control->def.version);
    cJSON_AddNumberToObject(greeting, "protocol", DIP_CONTROL_PROTOCOL);
    cJSON_AddNumberToObject(greeting, "max_line_bytes", DIP_CONTROL_MAX_LINE_BYTES);
    add_names(greeting, "requests", dip_control_verb_names, DIP_CONTROL_VERB_COUNT, ~0u);
    add_names(greeting, "topics", dip_control_topic_names, DIP_CONTROL_TOPIC_COUNT, ~0u);
    send_object(client, greeting);
}

static cJSON *begin_reply(const DipControlId *id, bool ok) {
    cJSON *reply = cJSON_CreateObject();
    char number[32];
    switch (id->kind) {
    case DIP_CONTROL_ID_NONE:
        cJSON_AddNullToObject(reply, "id");
        break;
    case DIP_CONTROL_ID_NUMBER:
        // cJSON would round some whole numbers near 2^53 to 15 digits.
        snprintf(number, sizeof number, "%.0f", id->number);
        cJSON_AddRawToObject(reply, "id", number);
        break;
    case DIP_CONTROL_ID_TEXT:
        cJSON_AddStringToObject(reply, "id", id->text);
        break;
    }
    cJSON_AddBoolToObject(reply, "ok", ok);
    return reply;
}

static void send_error(Client *client, const DipControlId *id, const DipError *err) {
    DipError mended = *err;
    dip_utf8_mend(mended.file);
    dip_utf8_mend(mended.key);
    dip_utf8_mend(mended.message);
    cJSON *reply = begin_reply(id, false);
    cJSON *error = cJSON_AddObjectToObject(reply, "error");
    cJSON_AddStringToObject(error, "code", dip_error_code_name(err->code));
    cJSON_AddStringToObject(error, "field", mended.key);
    cJSON_AddStringToObject(error, "message", mended.message);
    if (mended.file[0]) {
        cJSON_AddStringToObject(error, "file", mended.file);
    }
    send_object(client, reply);
}

void dip_control_send(DipControl *control, DipControlTopic topic, cJSON *fields) {
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        Client *client = control->clients[c];
        if (!client || !(client->topics >> topic & 1)) {
            continue;
        }
        if (is_full(client) || !fields) {
            ++client->dropped;
            continue;
        }
        cJSON *event = cJSON_CreateObject();
        cJSON_AddStringToObject(event, "event", dip_control_topic_names[topic]);
        if (client->dropped) {
            cJSON_AddNumberToObject(event, "dropped", (double)client->dropped);
        }
        for (cJSON *field = fields->child; field; field = field->next) {
            cJSON_AddItemReferenceToObject(event, field->string, field);
        }
        client->dropped = 0;
        send_object(client, event);
        write_output(client);
    }
    cJSON_Delete(fields);
}

// --- requests ------------------------------------------------------------------------------------

static DipControlAnswer carry_out(DipControl *control, Client *client,
                                  const DipControlRequest *request, cJSON *reply, DipError *err) {
    if (request->verb == DIP_CONTROL_SUBSCRIBE) {
        client->topics |= request->topics;
        ++control->subscriptions;
    } else if (request->verb == DIP_CONTROL_UNSUBSCRIBE) {
        client->topics &= ~request->topics;
    } else {
        return control->def.carry_out(control->def.context, request, client->attempt, reply, err);
    }
    add_names(reply, "to", dip_control_topic_names, DIP_CONTROL_TOPIC_COUNT, client->topics);
    return DIP_CONTROL_DONE;
}

// Answers a line. Returns false if the owner has put off the request.
static bool answer(DipControl *control, Client *client, const char *line, size_t length) {
    DipControlRequest request;
    DipError err = {0};
    if (!dip_control_request_read(line, length, &request, &err)) {
        send_error(client, &request.id, &err);
        return true;
    }
    cJSON *reply = begin_reply(&request.id, true);
    const DipControlAnswer result = carry_out(control, client, &request, reply, &err);
    if (result == DIP_CONTROL_DONE) {
        send_object(client, reply);
        return true;
    }
    cJSON_Delete(reply);
    if (result == DIP_CONTROL_REFUSED) {
        send_error(client, &request.id, &err);
    }
    return result == DIP_CONTROL_REFUSED;
}

static void refuse_long_line(Client *client) {
    static const DipControlId no_id = {.kind = DIP_CONTROL_ID_NONE};
    DipError err;
    dip_error_set(&err, DIP_ERROR_OVERSIZED, NULL, 0, "line", "is longer than %d bytes",
                  DIP_CONTROL_MAX_LINE_BYTES);
    send_error(client, &no_id, &err);
}

// Answers the lines that have arrived. Stops early if the output buffer is full because the
// client does not read, or if the owner puts off a request.
static void answer_lines(DipControl *control, Client *client) {
    const char *line;
    size_t length;
    for (;;) {
        if (is_full(client)) {
            write_output(client);
            if (is_full(client)) {
                return;
            }
        }
        const Line found = find_line(client, &line, &length);
        if (found == NO_LINE) {
            return;
        }
        if (found == LONG_LINE) {
            refuse_long_line(client);
        } else if (answer(control, client, line, length)) {
            remove_line(client, length);
        } else {
            ++client->attempt;
            return;
        }
    }
}

// --- clients -------------------------------------------------------------------------------------

// Adds and greets a client. If there is no room or memory for another client, tells the client that
// too many are connected and closes the connection.
static void welcome(DipControl *control, DipWire wire) {
    int c = 0;
    while (c < DIP_CONTROL_MAX_CLIENTS && control->clients[c]) {
        ++c;
    }
    Client *client = c < DIP_CONTROL_MAX_CLIENTS ? calloc(1, sizeof *client) : NULL;
    if (!client) {
        dip_wire_write(&wire, too_many, sizeof too_many - 1);
        dip_wire_close(&wire);
        return;
    }
    client->wire = wire;
    control->clients[c] = client;
    greet(control, client);
}

static bool open_endpoint(DipControl *control, const char *where, DipError *err) {
    if (strcmp(where, "-") != 0) {
        return dip_endpoint_listen(&control->endpoint, where, err);
    }
    DipWire wire;
    if (!dip_endpoint_open_standard(&control->endpoint, &wire, err)) {
        return false;
    }
    welcome(control, wire);
    return true;
}

DipControl *dip_control_open(const DipControlDef *def, DipError *err) {
    DipControl *control = calloc(1, sizeof *control);
    if (!control) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "--control", "out of memory");
        return NULL;
    }
    control->def = *def;
    if (!open_endpoint(control, def->where, err)) {
        free(control);
        return NULL;
    }
    return control;
}

static void drop_client(Client **client) {
    dip_wire_close(&(*client)->wire);
    free(*client);
    *client = NULL;
}

void dip_control_close(DipControl **control_pointer) {
    DipControl *control = *control_pointer;
    if (!control) {
        return;
    }
    *control_pointer = NULL;
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        if (control->clients[c]) {
            write_output(control->clients[c]);
            drop_client(&control->clients[c]);
        }
    }
    dip_endpoint_close(&control->endpoint);
    free(control);
}

// Returns whether the connection can be closed: the client has ended its input, all its requests
// are answered, and no event can reach it any more, because it has no subscriptions or no longer
// reads.
static bool is_done(const Client *client) {
    const bool answered = client->ended && client->in_bytes == 0 && client->out_bytes == 0;
    return answered && (client->broken || client->topics == 0 || dip_wire_is_cut(&client->wire));
}

void dip_control_poll(DipControl *control) {
    DipWire wire;
    while (dip_endpoint_accept(&control->endpoint, &wire)) {
        welcome(control, wire);
    }
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        Client *client = control->clients[c];
        if (!client) {
            continue;
        }
        // Reads at most one buffer, so that a client that sends without a pause cannot hold up the
        // caller.
        read_input(client);
        answer_lines(control, client);
        write_output(client);
        if (is_done(client)) {
            drop_client(&control->clients[c]);
        }
    }
}

unsigned dip_control_topics(const DipControl *control) {
    unsigned topics = 0;
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        topics |= control->clients[c] ? control->clients[c]->topics : 0;
    }
    return topics;
}

unsigned dip_control_subscriptions(const DipControl *control) {
    return control->subscriptions;
}
