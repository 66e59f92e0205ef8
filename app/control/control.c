// Accepts clients, answers their lines and sends them events.
#include "app/control/control.h"

#include "app/control/client_private.h"
#include "renderer/base/utf8.h"

#include <cjson/cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct DipControl {
    DipControlTarget target;
    const char *version;
    DipEndpoint endpoint;
    DipClient *clients[DIP_CONTROL_MAX_CLIENTS]; // NULL: free.
    unsigned subscriptions;
};

// What is sent instead of a reply when memory runs out, and to a client that is one too many.
static const char no_memory[] = "{\"id\":null,\"ok\":false,\"error\":{\"code\":\"MEMORY\","
                                "\"field\":\"\",\"message\":\"out of memory\"}}";
static const char too_many[] = "{\"id\":null,\"ok\":false,\"error\":{\"code\":\"BUSY\","
                               "\"field\":\"\",\"message\":\"too many clients are connected\"}}\n";

// --- sending -------------------------------------------------------------------------------------

// Sends an object, or else the line that says that memory ran out. Deletes the object.
static void send_object(DipClient *client, cJSON *object) {
    char *line = object ? cJSON_PrintUnformatted(object) : NULL;
    if (!line || !dip_client_send(client, line, strlen(line))) {
        dip_client_send(client, no_memory, sizeof no_memory - 1);
    }
    cJSON_free(line);
    cJSON_Delete(object);
}

static void add_names(cJSON *object, const char *name, const char *(*name_of)(int), int count,
                      unsigned bits) {
    cJSON *names = cJSON_AddArrayToObject(object, name);
    for (int i = 0; names && i < count; ++i) {
        if (bits >> i & 1) {
            cJSON_AddItemToArray(names, cJSON_CreateStringReference(name_of(i)));
        }
    }
}

static void greet(const DipControl *control, DipClient *client) {
    const unsigned topics = ~control->target.missing_topics;
    cJSON *greeting = cJSON_CreateObject();
    cJSON_AddStringToObject(greeting, "diptych", control->version);
    cJSON_AddNumberToObject(greeting, "protocol", DIP_CONTROL_PROTOCOL);
    cJSON_AddNumberToObject(greeting, "max_line_bytes", DIP_CONTROL_MAX_LINE_BYTES);
    add_names(greeting, "requests", dip_control_verb_name, DIP_CONTROL_VERB_COUNT, ~0u);
    add_names(greeting, "topics", dip_control_topic_name, DIP_CONTROL_TOPIC_COUNT, topics);
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
        snprintf(number, sizeof number, "%.0f", id->number); // cJSON prints only 15 digits.
        cJSON_AddRawToObject(reply, "id", number);
        break;
    case DIP_CONTROL_ID_TEXT:
        cJSON_AddStringToObject(reply, "id", id->text);
        break;
    }
    cJSON_AddBoolToObject(reply, "ok", ok);
    return reply;
}

static void send_error(DipClient *client, const DipControlId *id, const DipError *err) {
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
        DipClient *client = control->clients[c];
        if (!client || !(client->topics >> topic & 1)) {
            continue;
        }
        if (dip_client_is_full(client) || !fields) {
            ++client->dropped;
            continue;
        }
        cJSON *event = cJSON_CreateObject();
        cJSON_AddStringToObject(event, "event", dip_control_topic_name((int)topic));
        if (client->dropped) {
            cJSON_AddNumberToObject(event, "dropped", (double)client->dropped);
        }
        for (cJSON *field = fields->child; field; field = field->next) {
            cJSON_AddItemReferenceToObject(event, field->string, field);
        }
        client->dropped = 0;
        send_object(client, event);
        dip_client_write(client);
    }
    cJSON_Delete(fields);
}

// --- requests ------------------------------------------------------------------------------------

// Fails if the target cannot send events for one of the topics. The message names the first such.
static bool check_topics(const DipControl *control, unsigned topics, DipError *err) {
    const unsigned missing = topics & control->target.missing_topics;
    for (int t = 0; t < DIP_CONTROL_TOPIC_COUNT; ++t) {
        if (missing >> t & 1) {
            return dip_error_set(err, DIP_ERROR_UNSUPPORTED, NULL, 0, "to",
                                 "%s are not available yet", dip_control_topic_name(t));
        }
    }
    return true;
}

static DipControlAnswer subscribe(DipControl *control, DipClient *client,
                                  const DipControlRequest *request, cJSON *reply, DipError *err) {
    if (!check_topics(control, request->topics, err)) {
        return DIP_CONTROL_REFUSED;
    }
    if (request->verb == DIP_CONTROL_SUBSCRIBE) {
        client->topics |= request->topics;
        ++control->subscriptions;
    } else {
        client->topics &= ~request->topics;
    }
    add_names(reply, "to", dip_control_topic_name, DIP_CONTROL_TOPIC_COUNT, client->topics);
    return DIP_CONTROL_DONE;
}

static DipControlAnswer carry_out(DipControl *control, DipClient *client,
                                  const DipControlRequest *request, cJSON *reply, DipError *err) {
    const DipControlTarget *target = &control->target;
    if (request->verb == DIP_CONTROL_SUBSCRIBE || request->verb == DIP_CONTROL_UNSUBSCRIBE) {
        return subscribe(control, client, request, reply, err);
    }
    return target->carry_out(target->context, request, client->attempt, reply, err);
}

// Answers a line. Returns false if the target has put off the request.
static bool answer(DipControl *control, DipClient *client, const char *line, size_t length) {
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

static void refuse_long_line(DipClient *client) {
    static const DipControlId no_id = {.kind = DIP_CONTROL_ID_NONE};
    DipError err;
    dip_error_set(&err, DIP_ERROR_OVERSIZED, NULL, 0, "line", "is longer than %d bytes",
                  DIP_CONTROL_MAX_LINE_BYTES);
    send_error(client, &no_id, &err);
}

// Answers the lines that have arrived, until the client has too much left to read.
static void answer_lines(DipControl *control, DipClient *client) {
    const char *line;
    size_t length;
    for (;;) {
        if (dip_client_is_full(client)) {
            dip_client_write(client);
            if (dip_client_is_full(client)) {
                return;
            }
        }
        switch (dip_client_line(client, &line, &length)) {
        case DIP_CLIENT_NO_LINE:
            return;
        case DIP_CLIENT_LONG_LINE:
            refuse_long_line(client);
            break;
        case DIP_CLIENT_LINE:
            if (!answer(control, client, line, length)) {
                ++client->attempt;
                return;
            }
            dip_client_remove_line(client, length);
            break;
        }
    }
}

// --- clients -------------------------------------------------------------------------------------

// Greets a client, or tells it that there are too many.
static void welcome(DipControl *control, DipWire wire) {
    int c = 0;
    while (c < DIP_CONTROL_MAX_CLIENTS && control->clients[c]) {
        ++c;
    }
    DipClient *client = c < DIP_CONTROL_MAX_CLIENTS ? dip_client_create(wire) : NULL;
    if (!client) {
        dip_wire_write(&wire, too_many, sizeof too_many - 1);
        dip_wire_close(&wire);
        return;
    }
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
    control->target = def->target;
    control->version = def->version;
    if (!open_endpoint(control, def->where, err)) {
        free(control);
        return NULL;
    }
    return control;
}

void dip_control_close(DipControl **control_pointer) {
    DipControl *control = *control_pointer;
    if (!control) {
        return;
    }
    *control_pointer = NULL;
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        if (control->clients[c]) {
            dip_client_write(control->clients[c]);
        }
        dip_client_destroy(&control->clients[c]);
    }
    dip_endpoint_close(&control->endpoint);
    free(control);
}

// Reads at most one buffer, so that a client that sends without a pause cannot hold up the caller.
static void serve(DipControl *control, DipClient *client) {
    dip_client_read(client);
    answer_lines(control, client);
    dip_client_write(client);
}

void dip_control_poll(DipControl *control) {
    DipWire wire;
    while (dip_endpoint_accept(&control->endpoint, &wire)) {
        welcome(control, wire);
    }
    for (int c = 0; c < DIP_CONTROL_MAX_CLIENTS; ++c) {
        if (!control->clients[c]) {
            continue;
        }
        serve(control, control->clients[c]);
        if (dip_client_is_done(control->clients[c])) {
            dip_client_destroy(&control->clients[c]);
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
