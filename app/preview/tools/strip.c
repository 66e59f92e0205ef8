// Draws the thumbnails of a path with a painter of the strip's own.
#include "app/preview/tools/strip.h"

#include "app/preview/tools/window.h"
#include "campaths/campath.h"

#include <string.h>

void dip_strip_free(DipStrip *strip) {
    dip_painter_destroy(&strip->painter);
    for (int i = 0; i < DIP_STRIP_COUNT; ++i) {
        dip_canvas_free(&strip->pictures[i]);
    }
}

void dip_strip_want(DipStrip *strip, int width, int height) {
    strip->wanted = width > 0 && height > 0;
    strip->wanted_width = width;
    strip->wanted_height = height;
}

static DipStripSubject subject_of(const DipStrip *strip, const DipToolsInput *input) {
    const DipCamCategory *category = dip_camtrack_playing(&input->session->track);
    DipStripSubject subject;
    memset(&subject, 0, sizeof subject); // Clears the padding, which memcmp compares, too.
    subject.path = category->path;
    subject.fov_y_deg = category->fov_y_deg;
    subject.scene = input->session->scene;
    subject.quality = dip_painter_quality(input->session->renderers[DIP_PANE_CURRENT]);
    subject.width = strip->wanted_width;
    subject.height = strip->wanted_height;
    return subject;
}

// Begins a new strip if the subject has changed.
static void follow_subject(DipStrip *strip, const DipToolsInput *input) {
    const DipStripSubject subject = subject_of(strip, input);
    if (memcmp(&subject, &strip->subject, sizeof subject) == 0) {
        return;
    }
    dip_painter_destroy(&strip->painter);
    memcpy(&strip->subject, &subject, sizeof subject);
    strip->drawn = 0;
    strip->failed = false;
    strip->duration_ns = subject.path ? dip_campath_info(subject.path).duration_ns : 0;
}

static int64_t time_of(const DipStrip *strip, int index) {
    return strip->duration_ns / DIP_STRIP_COUNT * index;
}

static bool draw_thumbnail(DipStrip *strip, const DipToolsInput *input) {
    const DipStripSubject *subject = &strip->subject;
    const int index = strip->drawn;
    DipCanvas *canvas = &strip->pictures[index];
    const int64_t time_ns = time_of(strip, index);
    DipPose pose = {.fov_y_deg = subject->fov_y_deg};
    DipFrame frame;
    dip_campath_sample(subject->path, time_ns, &pose);
    if (!strip->painter) {
        strip->painter = dip_session_make_painter(input->session, NULL, &subject->quality,
                                                  subject->width, subject->height, NULL);
    }
    if (!strip->painter || !dip_canvas_resize(canvas, subject->width, subject->height, NULL) ||
        !dip_painter_draw(strip->painter, input->session->scene, &pose, time_ns, &frame, NULL)) {
        return false;
    }
    const DipRect all = {0, 0, frame.width, frame.height};
    const DipPixels pixels = dip_frame_pixels(&frame);
    dip_canvas_copy(canvas, all, &pixels);
    strip->versions[index] = ++strip->version;
    strip->drawn++;
    return true;
}

// Draws the next thumbnail if there is one to draw. Returns whether it drew one.
static bool draw_next(DipStrip *strip, const DipToolsInput *input) {
    follow_subject(strip, input);
    if (strip->failed || !strip->subject.path || strip->drawn == DIP_STRIP_COUNT) {
        return false;
    }
    strip->failed = !draw_thumbnail(strip, input);
    return !strip->failed;
}

bool dip_strip_update(DipStrip *strip, const DipToolsInput *input) {
    const bool wanted = strip->wanted && input->still && !input->session->gallery;
    const bool drew = wanted && draw_next(strip, input);
    strip->wanted = false;
    if (!drew || strip->drawn == DIP_STRIP_COUNT) {
        dip_painter_destroy(&strip->painter);
    }
    return drew;
}

DipThumbnail dip_strip_thumbnail(const DipStrip *strip, int index) {
    DipThumbnail thumbnail = {.time_ns = time_of(strip, index)};
    if (index < strip->drawn) {
        thumbnail.picture = dip_canvas_pixels(&strip->pictures[index]);
        thumbnail.version = strip->versions[index];
    }
    return thumbnail;
}
