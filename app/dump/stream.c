// Opens a stream, converts each frame to the stream's pixels, and writes them.
#include "app/dump/stream.h"

#include "app/cli/log.h"
#include "renderer/base/assert.h"

#include <errno.h>
#include <inttypes.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *const dip_stream_picture_names[DIP_STREAM_PICTURE_COUNT] = {
#define PICTURE_NAME(name, text) #name,
    DIP_STREAM_PICTURE_LIST(PICTURE_NAME)
#undef PICTURE_NAME
};

struct DipStream {
    DipStreamDef def;
    FILE *out;
    int width; // Size of the stream's pictures in pixels; 0 before the first frame.
    int height;
    int frame_count;
    uint8_t *rgb;    // One picture in packed RGB.
    uint8_t *planes; // The same picture as Y, Cb and Cr; NULL for a raw stream.
};

static bool is_standard_output(const DipStream *stream) {
    return stream->out == stdout;
}

static bool write_failed(const DipStream *stream, DipError *err) {
    const int reason = errno;
    const char *file = is_standard_output(stream) ? "standard output" : stream->def.file;
    if (reason == EPIPE) {
        return dip_error_set_runtime(err, DIP_ERROR_IO, file, 0, stream->def.option,
                                     "the program that reads the stream has closed it after %d "
                                     "frames",
                                     stream->frame_count);
    }
    return dip_error_set_runtime(err, DIP_ERROR_IO, file, 0, stream->def.option,
                                 "cannot be written: %s", strerror(reason));
}

static bool write_bytes(DipStream *stream, const void *bytes, size_t size_bytes, DipError *err) {
    errno = 0;
    return fwrite(bytes, 1, size_bytes, stream->out) == size_bytes || write_failed(stream, err);
}

DipStream *dip_stream_open(const DipStreamDef *def, DipError *err) {
    DipStream *stream = calloc(1, sizeof *stream);
    if (!stream) {
        dip_error_set(err, DIP_ERROR_MEMORY, def->file, 0, def->option, "out of memory");
        return NULL;
    }
    const struct sigaction ignore = {.sa_handler = SIG_IGN};
    sigaction(SIGPIPE, &ignore, NULL);
    stream->def = *def;
    stream->out = strcmp(def->file, "-") == 0 ? stdout : fopen(def->file, "wb");
    if (!stream->out) {
        write_failed(stream, err);
        free(stream);
        return NULL;
    }
    return stream;
}

bool dip_stream_close(DipStream **stream_pointer, DipError *err) {
    DipStream *stream = *stream_pointer;
    if (!stream) {
        return true;
    }
    *stream_pointer = NULL;
    errno = 0;
    const bool closed = is_standard_output(stream) ? fflush(stdout) == 0 : fclose(stream->out) == 0;
    const bool written = closed || write_failed(stream, err);
    free(stream->rgb);
    free(stream->planes);
    free(stream);
    return written;
}

// --- the header ----------------------------------------------------------------------------------

// Prints to standard error the options with which ffmpeg reads the raw stream.
static void describe_raw(const DipStream *stream) {
    const DipFrameRate rate = dip_frame_rate_reduce(stream->def.rate);
    dip_log_note("raw video: -pixel_format rgb24 -video_size %dx%d -framerate %" PRId64 "/%" PRId64
                 " (options of ffmpeg -f rawvideo)",
                 stream->width, stream->height, rate.frames, rate.seconds);
}

static bool begin(DipStream *stream, const DipFrame *pane, DipError *err) {
    const bool is_double = stream->def.picture == DIP_STREAM_both;
    stream->width = is_double ? 2 * pane->width : pane->width;
    stream->height = pane->height;
    const size_t size_bytes = 3 * (size_t)stream->width * (size_t)stream->height;
    stream->rgb = malloc(size_bytes);
    stream->planes = stream->def.y4m ? malloc(size_bytes) : NULL;
    if (!stream->rgb || (stream->def.y4m && !stream->planes)) {
        return dip_error_set(err, DIP_ERROR_MEMORY, stream->def.file, 0, stream->def.option,
                             "out of memory");
    }
    if (!stream->def.y4m) {
        describe_raw(stream);
        return true;
    }
    char header[DIP_Y4M_HEADER_SIZE];
    const size_t length = dip_y4m_header(stream->width, stream->height, stream->def.rate, header);
    return write_bytes(stream, header, length, err);
}

// --- pictures ------------------------------------------------------------------------------------

// Copies a pane's picture into the stream's picture, from column x on. If `other` is not NULL,
// writes the absolute difference of the two panes instead, channel by channel.
static void put_pane(DipStream *stream, const DipFrame *pane, const DipFrame *other, int x) {
    for (int y = 0; y < pane->height; y++) {
        const uint8_t *from = pane->rgba8 + (size_t)y * pane->stride_bytes;
        const uint8_t *less = other ? other->rgba8 + (size_t)y * other->stride_bytes : NULL;
        uint8_t *to = stream->rgb + 3 * ((size_t)y * (size_t)stream->width + (size_t)x);
        for (int i = 0; i < pane->width; i++, to += 3, from += 4) {
            for (int c = 0; c < 3; c++) {
                to[c] = less ? (uint8_t)abs(from[c] - less[4 * i + c]) : from[c];
            }
        }
    }
}

static void compose(DipStream *stream, const DipFrame panes[2]) {
    const DipStreamPicture picture = stream->def.picture;
    put_pane(stream, &panes[picture == DIP_STREAM_requested],
             picture == DIP_STREAM_difference ? &panes[1] : NULL, 0);
    if (picture == DIP_STREAM_both) {
        put_pane(stream, &panes[1], NULL, panes[0].width);
    }
}

bool dip_stream_add(DipStream *stream, const DipFrame panes[2], DipError *err) {
    static const char frame_line[] = "FRAME\n";
    DIP_ASSERT(panes[0].width == panes[1].width && panes[0].height == panes[1].height);
    if (stream->width == 0 && !begin(stream, &panes[0], err)) {
        return false;
    }
    DIP_ASSERT(stream->height == panes[0].height);
    const size_t count = (size_t)stream->width * (size_t)stream->height;
    const uint8_t *bytes = stream->rgb;
    compose(stream, panes);
    if (stream->def.y4m) {
        dip_y4m_planes(stream->rgb, count, stream->planes);
        bytes = stream->planes;
        if (!write_bytes(stream, frame_line, strlen(frame_line), err)) {
            return false;
        }
    }
    if (!write_bytes(stream, bytes, 3 * count, err)) {
        return false;
    }
    stream->frame_count++;
    return true;
}
