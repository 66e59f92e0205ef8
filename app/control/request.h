// Reads requests of the control channel: one line of JSON becomes one checked struct.
//
// docs/embedding.md describes the protocol. A request is an object such as
// {"id": 7, "request": "seek", "time_s": 2.5}. The functions of this file carry out no request.
#ifndef DIP_APP_CONTROL_REQUEST_H
#define DIP_APP_CONTROL_REQUEST_H

#include "renderer/base/error.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>

// Version of the protocol. It changes when a client of the previous version would misread a reply
// or an event. New requests, fields and topics do not change it.
enum { DIP_CONTROL_PROTOCOL = 1 };

enum {
    DIP_CONTROL_MAX_LINE_BYTES = 65536, // Longest line that is read, without its line feed.
    DIP_CONTROL_TEXT_SIZE = 512,        // Bytes of `settings` and of `change`, with the final 0.
    DIP_CONTROL_FILE_SIZE = 1024,       // Bytes of a file's name, with the final 0.
    DIP_CONTROL_NAME_SIZE = 64,         // Bytes of another name or of a text id, with the final 0.
    DIP_CONTROL_MAX_SIZE_PX = 8192      // Largest width and height of a pane.
};

// Lists the requests as X(name, NAME).
#define DIP_CONTROL_VERB_LIST(X)                                                                   \
    X(set, SET)                                                                                    \
    X(apply, APPLY)                                                                                \
    X(path, PATH)                                                                                  \
    X(animation, ANIMATION)                                                                        \
    X(pause, PAUSE)                                                                                \
    X(play, PLAY)                                                                                  \
    X(seek, SEEK)                                                                                  \
    X(scene, SCENE)                                                                                \
    X(size, SIZE)                                                                                  \
    X(panel, PANEL)                                                                                \
    X(subscribe, SUBSCRIBE)                                                                        \
    X(unsubscribe, UNSUBSCRIBE)                                                                    \
    X(pick, PICK)                                                                                  \
    X(get, GET)                                                                                    \
    X(screenshot, SCREENSHOT)                                                                      \
    X(quit, QUIT)

typedef enum DipControlVerb {
#define DIP_CONTROL_ENUM(name, NAME) DIP_CONTROL_##NAME,
    DIP_CONTROL_VERB_LIST(DIP_CONTROL_ENUM)
#undef DIP_CONTROL_ENUM
        DIP_CONTROL_VERB_COUNT
} DipControlVerb;

// Lists the topics that a client can subscribe to, as X(name, NAME). Every event of a topic has the
// topic's name.
#define DIP_CONTROL_TOPIC_LIST(X)                                                                  \
    X(times, TIMES)                                                                                \
    X(errors, ERRORS)                                                                              \
    X(settings, SETTINGS)                                                                          \
    X(prices, PRICES)                                                                              \
    X(picks, PICKS)                                                                                \
    X(notices, NOTICES)                                                                            \
    X(polls, POLLS)

typedef enum DipControlTopic {
#define DIP_CONTROL_ENUM(name, NAME) DIP_CONTROL_TOPIC_##NAME,
    DIP_CONTROL_TOPIC_LIST(DIP_CONTROL_ENUM)
#undef DIP_CONTROL_ENUM
        DIP_CONTROL_TOPIC_COUNT
} DipControlTopic;

// Lists the parts of the answer to `get`, as X(name, NAME).
#define DIP_CONTROL_PART_LIST(X)                                                                   \
    X(state, STATE)                                                                                \
    X(settings, SETTINGS)                                                                          \
    X(times, TIMES)                                                                                \
    X(errors, ERRORS)                                                                              \
    X(paths, PATHS)                                                                                \
    X(animations, ANIMATIONS)                                                                      \
    X(scenes, SCENES)                                                                              \
    X(steps, STEPS)                                                                                \
    X(warnings, WARNINGS)                                                                          \
    X(prices, PRICES)

typedef enum DipControlPart {
#define DIP_CONTROL_ENUM(name, NAME) DIP_CONTROL_PART_##NAME,
    DIP_CONTROL_PART_LIST(DIP_CONTROL_ENUM)
#undef DIP_CONTROL_ENUM
        DIP_CONTROL_PART_COUNT
} DipControlPart;

// The names in requests and events: "set", "times", "state".
extern const char *const dip_control_verb_names[DIP_CONTROL_VERB_COUNT];
extern const char *const dip_control_topic_names[DIP_CONTROL_TOPIC_COUNT];
extern const char *const dip_control_part_names[DIP_CONTROL_PART_COUNT];

// The bits that stand for the panes in a request.
enum { DIP_CONTROL_PANE_CURRENT = 1, DIP_CONTROL_PANE_REQUESTED = 2 };

// The bits that stand for the words "on" and "off" in a request.
enum { DIP_CONTROL_ON = 1, DIP_CONTROL_OFF = 2 };

// The type of the id that a client gives a request. The reply repeats the id.
typedef enum DipControlIdKind {
    DIP_CONTROL_ID_NONE, // The reply's id is null.
    DIP_CONTROL_ID_NUMBER,
    DIP_CONTROL_ID_TEXT
} DipControlIdKind;

typedef struct DipControlId {
    DipControlIdKind kind;
    double number; // A whole number from -2^53 to 2^53.
    char text[DIP_CONTROL_NAME_SIZE];
} DipControlId;

// A request. A field that the request does not have is zero (but see `parts`). Texts are UTF-8.
typedef struct DipControlRequest {
    DipControlId id;
    DipControlVerb verb;
    unsigned panes; // SET: DIP_CONTROL_PANE_... bits, at least one.
    // SET: exactly one of these two texts is not empty. `settings` replaces all settings;
    // dip_control_request_read has checked it. `change` names only the settings to change
    // (dip_control_change_settings).
    char settings[DIP_CONTROL_TEXT_SIZE];
    char change[DIP_CONTROL_TEXT_SIZE];
    unsigned notices; // SET: with DIP_CONTROL_OFF, the status line says nothing about the change.
    unsigned show;    // PANEL: DIP_CONTROL_ON or DIP_CONTROL_OFF. With both, OFF counts.
    // PATH: a category of camera paths, or the name of a camera of the models.
    char category[DIP_CONTROL_NAME_SIZE];
    // SCENE: name of a scene, or "models". ANIMATION: name of an animation, or "none".
    char name[DIP_CONTROL_NAME_SIZE];
    char file[DIP_CONTROL_FILE_SIZE]; // SCREENSHOT: file to write.
    double time_s;                    // SEEK: time on the path, 0..86400.
    int width;                        // SIZE: size of a pane, in pixels.
    int height;
    int x; // PICK: position of a pixel in a pane.
    int y;
    unsigned topics; // SUBSCRIBE and UNSUBSCRIBE: bits 1 << DipControlTopic, at least one.
    unsigned parts;  // GET: bits 1 << DipControlPart, at least one. If the request names no part,
                     // these are state, settings, times and errors.
} DipControlRequest;

// Reads a request from a line without its line feed. On failure, *err says what was found and what
// is accepted, and request->id holds the line's id if that is valid and given once. Thread-safe.
bool dip_control_request_read(const char *line, size_t length, DipControlRequest *request,
                              DipError *err);

// Changes the settings that the text names ("aa=4,af=16") and keeps the others. Fails with the
// error of dip_quality_parse, or with OVERSIZED if the text is too long. On failure *to is
// unchanged. `to` may point to the same struct as `from`.
bool dip_control_change_settings(const DipQuality *from, const char *change, DipQuality *to,
                                 DipError *err);

#endif
