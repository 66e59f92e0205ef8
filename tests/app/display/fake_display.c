// Implements the display for tests with a queue of events and a picture in memory.
#include "tests/app/display/fake_display.h"

#include "app/ui/canvas.h"
#include "renderer/base/assert.h"

#include <stdio.h>
#include <stdlib.h>

static const double fake_refresh_hz = 60.0;

struct DipFakeDisplay {
    DipEvent events[DIP_FAKE_MAX_EVENTS]; // A ring buffer.
    int first;
    int count;
    DipCanvas shown;
    double scale;
    int64_t now_ns;
    int present_count;
    int64_t damaged_pixels;
    bool full_screen;
    bool hidden;
    char clipboard[512];
};

static bool present(void *context, const DipPixels *picture, const DipRect *damage, int count,
                    DipError *err) {
    DipFakeDisplay *fake = context;
    (void)err;
    ++fake->present_count;
    fake->damaged_pixels = 0;
    for (int i = 0; i < count; ++i) {
        dip_canvas_set_clip(&fake->shown, damage[i]);
        dip_canvas_copy(&fake->shown, (DipRect){0, 0, picture->width, picture->height}, picture);
        fake->damaged_pixels += (int64_t)damage[i].width * damage[i].height;
    }
    return true;
}

static bool next_event(void *context, int timeout_ms, DipEvent *event) {
    DipFakeDisplay *fake = context;
    if (fake->count == 0) {
        fake->now_ns += INT64_C(1000000) * timeout_ms;
        return false;
    }
    *event = fake->events[fake->first];
    fake->first = (fake->first + 1) % DIP_FAKE_MAX_EVENTS;
    --fake->count;
    return true;
}

static void size(void *context, int *width, int *height) {
    const DipFakeDisplay *fake = context;
    *width = fake->shown.width;
    *height = fake->shown.height;
}

static double scale(void *context) {
    return ((const DipFakeDisplay *)context)->scale;
}

static double refresh_hz(void *context) {
    (void)context;
    return fake_refresh_hz;
}

static int64_t now_ns(void *context) {
    return ((const DipFakeDisplay *)context)->now_ns;
}

static void set_full_screen(void *context, bool on) {
    ((DipFakeDisplay *)context)->full_screen = on;
}

static bool is_hidden(void *context) {
    return ((const DipFakeDisplay *)context)->hidden;
}

static bool set_clipboard(void *context, const char *text) {
    DipFakeDisplay *fake = context;
    snprintf(fake->clipboard, sizeof fake->clipboard, "%s", text);
    return true;
}

static bool get_clipboard(void *context, char *text, size_t size_bytes) {
    const DipFakeDisplay *fake = context;
    snprintf(text, size_bytes, "%s", fake->clipboard);
    return text[0] != '\0';
}

static void close_display(void *context) {
    DipFakeDisplay *fake = context;
    dip_canvas_free(&fake->shown);
    free(fake);
}

static bool set_size(DipFakeDisplay *fake, int width, int height) {
    if (!dip_canvas_resize(&fake->shown, width, height, NULL)) {
        return false;
    }
    dip_canvas_fill(&fake->shown, fake->shown.clip, (DipColour){0, 0, 0, 255});
    return true;
}

static void change_size(void *context, int width, int height) {
    dip_fake_display_resize(context, width, height);
}

DipFakeDisplay *dip_fake_display_open(DipDisplay *display, int width, int height) {
    DipFakeDisplay *fake = calloc(1, sizeof *fake);
    if (!fake || !set_size(fake, width, height)) {
        free(fake);
        return NULL;
    }
    fake->scale = 1.0;
    *display = (DipDisplay){
        .context = fake,
        .present = present,
        .next_event = next_event,
        .size = size,
        .scale = scale,
        .refresh_hz = refresh_hz,
        .now_ns = now_ns,
        .is_hidden = is_hidden,
        .set_full_screen = set_full_screen,
        .set_size = change_size,
        .set_clipboard = set_clipboard,
        .get_clipboard = get_clipboard,
        .close = close_display,
    };
    return fake;
}

void dip_fake_display_push(DipFakeDisplay *fake, const DipEvent *event) {
    DIP_ASSERT(fake->count < DIP_FAKE_MAX_EVENTS);
    fake->events[(fake->first + fake->count++) % DIP_FAKE_MAX_EVENTS] = *event;
}

void dip_fake_display_press(DipFakeDisplay *fake, DipKeycode key, unsigned modifiers) {
    DipEvent event = {
        .kind = DIP_EVENT_KEY_DOWN, .modifiers = modifiers, .key = key, .position = key};
    dip_fake_display_push(fake, &event);
    event.kind = DIP_EVENT_KEY_UP;
    dip_fake_display_push(fake, &event);
}

void dip_fake_display_click(DipFakeDisplay *fake, DipMouseButton button, int x, int y, int clicks) {
    DipEvent event = {
        .kind = DIP_EVENT_MOUSE_DOWN, .x = x, .y = y, .button = button, .clicks = clicks};
    dip_fake_display_push(fake, &event);
    event.kind = DIP_EVENT_MOUSE_UP;
    event.clicks = 0;
    dip_fake_display_push(fake, &event);
}

bool dip_fake_display_resize(DipFakeDisplay *fake, int width, int height) {
    dip_fake_display_push(fake, &(DipEvent){.kind = DIP_EVENT_RESIZE});
    return set_size(fake, width, height);
}

void dip_fake_display_rescale(DipFakeDisplay *fake, double scale_factor) {
    fake->scale = scale_factor;
    dip_fake_display_push(fake, &(DipEvent){.kind = DIP_EVENT_RESIZE});
}

void dip_fake_display_hide(DipFakeDisplay *fake, bool hidden) {
    fake->hidden = hidden;
    if (!hidden) {
        dip_fake_display_push(fake, &(DipEvent){.kind = DIP_EVENT_EXPOSE});
    }
}

void dip_fake_display_advance(DipFakeDisplay *fake, int64_t elapsed_ns) {
    fake->now_ns += elapsed_ns;
}

DipPixels dip_fake_display_picture(const DipFakeDisplay *fake) {
    return dip_canvas_pixels(&fake->shown);
}

int dip_fake_display_present_count(const DipFakeDisplay *fake) {
    return fake->present_count;
}

int64_t dip_fake_display_damaged_pixels(const DipFakeDisplay *fake) {
    return fake->damaged_pixels;
}

bool dip_fake_display_is_full_screen(const DipFakeDisplay *fake) {
    return fake->full_screen;
}

const char *dip_fake_display_clipboard(const DipFakeDisplay *fake) {
    return fake->clipboard;
}
