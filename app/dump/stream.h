// Writes the frames of `diptych dump` as a stream of video without compression, for other programs.
//
// There are two kinds of streams. --y4m writes YUV4MPEG2 (app/files/y4m.h). --raw writes the
// frames' pixels alone: 3 bytes per pixel (red, green, blue; sRGB), rows without padding, the top
// row first. A line on standard error tells the size, the format and the rate of a raw stream.
#ifndef DIP_APP_DUMP_STREAM_H
#define DIP_APP_DUMP_STREAM_H

#include "app/files/y4m.h"
#include "renderer/base/error.h"
#include "renderer/scene/frame.h"

#include <stdbool.h>

// Lists what a stream can show, as X(name, "its meaning"). The help prints the meaning.
#define DIP_STREAM_PICTURE_LIST(X)                                                                 \
    X(current, "shows the left pane")                                                              \
    X(requested, "shows the right pane")                                                           \
    X(both, "shows both panes side by side")                                                       \
    X(difference, "shows how much each channel of the two panes differs, in steps of 1/255")

typedef enum DipStreamPicture {
#define DIP_STREAM_PICTURE_ENUM(name, text) DIP_STREAM_##name,
    DIP_STREAM_PICTURE_LIST(DIP_STREAM_PICTURE_ENUM)
#undef DIP_STREAM_PICTURE_ENUM
        DIP_STREAM_PICTURE_COUNT
} DipStreamPicture;

extern const char *const dip_stream_picture_names[DIP_STREAM_PICTURE_COUNT];

typedef struct DipStreamDef {
    const char *option; // "--y4m" or "--raw", by which messages name the stream.
    const char *file;   // The file to write; "-" is standard output. Borrowed.
    bool y4m;           // True to write YUV4MPEG2, false to write raw pixels.
    DipStreamPicture picture;
    DipFrameRate rate; // Rate at which the frames are to be played.
} DipStreamDef;

typedef struct DipStream DipStream;

// Opens the file. From then on, the program ignores the signal SIGPIPE, so that writing to a pipe
// that nobody reads any more fails instead of ending the program. Fails with IO or MEMORY.
DipStream *dip_stream_open(const DipStreamDef *def, DipError *err);

// Writes a frame of both panes (current and requested), which have the same size. All frames of a
// stream have the size of the first one. Fails with IO if the file cannot be written, or if no
// program reads the pipe any more. The first frame can also fail with MEMORY.
bool dip_stream_add(DipStream *stream, const DipFrame panes[2], DipError *err);

// Writes the bytes that are still buffered, closes the file and frees the stream. *stream may be
// NULL and becomes NULL. Returns false if something could not be written; the file keeps what was
// written before.
bool dip_stream_close(DipStream **stream, DipError *err);

#endif
