// Opens the control channel, over which other programs send requests as lines of JSON. They get a
// reply to every line, and the events that they subscribe to. docs/embedding.md describes the
// protocol.
//
// The channel reads and checks requests. It carries out `subscribe` and `unsubscribe` itself, and
// hands all others to a function of its owner, which carries them out. All functions must be called
// on one thread. None of them waits for a client.
#ifndef DIP_APP_CONTROL_CONTROL_H
#define DIP_APP_CONTROL_CONTROL_H

#include "app/control/request.h"

struct cJSON;

enum { DIP_CONTROL_MAX_CLIENTS = 8 }; // Greatest number of clients that are connected at once.

typedef enum DipControlAnswer {
    DIP_CONTROL_DONE,
    DIP_CONTROL_REFUSED, // Nothing has changed; the error says why.
    DIP_CONTROL_LATER    // carry_out wants to get the request again at the next poll.
} DipControlAnswer;

typedef struct DipControlDef {
    // "-" for standard input and output, or the path of a socket. Borrowed until the channel is
    // open.
    const char *where;
    // The program's version, which the channel sends to each new client in its first line.
    // Borrowed until the channel is closed.
    const char *version;
    void *context;
    // Carries out a request, or refuses it and fills *err. Adds the fields of the reply to `reply`,
    // an object. `attempt` counts how often this function has put off this request.
    DipControlAnswer (*carry_out)(void *context, const DipControlRequest *request, int attempt,
                                  struct cJSON *reply, DipError *err);
} DipControlDef;

typedef struct DipControl DipControl;

// Opens the channel. Only the user who runs the program can connect to a socket. Fails with
// CONFLICT (the path is in use), OVERSIZED (the path is empty or too long), IO or MEMORY.
DipControl *dip_control_open(const DipControlDef *def, DipError *err);

// Closes all connections and removes the socket. *control may be NULL and becomes NULL.
void dip_control_close(DipControl **control);

// Accepts clients, carries out the requests that have arrived, and writes replies and events. Call
// this function once in each turn of the program's loop.
void dip_control_poll(DipControl *control);

// Returns the topics that at least one client has subscribed to, as bits 1 << DipControlTopic.
unsigned dip_control_topics(const DipControl *control);

// Returns a number that changes whenever a client subscribes. The owner then sends the events that
// tell a new subscriber the current values.
unsigned dip_control_subscriptions(const DipControl *control);

// Sends an event to the clients that have subscribed to its topic. A client that reads too slowly
// misses the event; the next event that reaches the client says how many events it has missed.
// Takes ownership of `fields`, an object with the event's fields. `fields` may be NULL, which means
// that memory ran out.
void dip_control_send(DipControl *control, DipControlTopic topic, struct cJSON *fields);

#endif
