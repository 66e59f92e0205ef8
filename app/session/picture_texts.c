// Collects the texts that Diptych writes into a PNG file (picture_texts.h).
#include "app/session/picture_texts.h"

#include "app/files/put.h"
#include "renderer/base/assert.h"
#include "renderer/base/number.h"

#include <stdarg.h>
#include <stdio.h>

DIP_PRINTF(3, 4)
static void add(DipPictureTexts *texts, const char *keyword, const char *format, ...) {
    char *text = texts->bytes + texts->used_bytes;
    const size_t left = sizeof texts->bytes - texts->used_bytes;
    va_list arguments;
    DIP_ASSERT(texts->count < DIP_PICTURE_MAX_TEXTS && left > 0);
    va_start(arguments, format);
    const int length = vsnprintf(text, left, format, arguments);
    va_end(arguments);
    const size_t size_bytes = length > 0 ? (size_t)length + 1 : 1;
    // If this text was cut, its final zero is the last byte. All later texts are empty and share
    // this byte.
    texts->used_bytes += size_bytes < left ? size_bytes : left - 1;
    texts->items[texts->count++] = (DipPngText){keyword, text};
}

void dip_pose_format(const DipPose *pose, char *text, size_t size_bytes) {
    text[0] = '\0';
    for (int i = 0; i < 7; i++) {
        char number[DIP_NUMBER_TEXT_SIZE];
        dip_number_format(i < 3 ? pose->position_world[i] : pose->orientation[i - 3], number);
        dip_put_append(text, size_bytes, "%s%s", i ? " " : "", number);
    }
}

// Returns the text of "Path", which says where the camera's pose comes from.
static const char *path_name(const DipSession *session, bool free_camera) {
    const DipSessionOptions *options = session->options;
    if (free_camera) {
        return "free camera";
    }
    if (session->shows_gallery && session->gallery_path) {
        return "scene"; // The path of the gallery's scene has replaced that of --path or --pose.
    }
    if (options && options->has_pose) {
        return "pose";
    }
    if (options && options->path) {
        return options->path;
    }
    const DipCamTrack *track = &session->track;
    const int category = (int)(dip_camtrack_playing(track) - track->categories);
    return session->orbiting ? "orbit" : dip_session_path_name(track, category);
}

void dip_picture_texts_make(DipPictureTexts *texts, const DipSession *session, const DipPose *pose,
                            int64_t time_ns, bool free_camera) {
    char number[DIP_NUMBER_TEXT_SIZE];
    char pose_text[7 * DIP_NUMBER_TEXT_SIZE];
    texts->count = 0;
    texts->used_bytes = 0;
    add(texts, "Software", "Diptych %s", DIP_VERSION);
    add(texts, "Scene", "%s", session->options ? dip_session_scene_file(session) : "");
    add(texts, "Path", "%s", path_name(session, free_camera));
    dip_number_format(1e-9 * (double)time_ns, number);
    add(texts, "Time", "%s s", number);
    dip_pose_format(pose, pose_text, sizeof pose_text);
    add(texts, "Pose", "%s", pose_text);
    dip_number_format(pose->fov_y_deg, number);
    add(texts, "Field of view", "%s", number);
}

void dip_picture_texts_add_pane(DipPictureTexts *texts, int pane, const DipQuality *quality,
                                const DipFrame *frame) {
    static const char *const keywords[DIP_PANE_COUNT][3] = {
        {"Current settings", "Current size", "Current hash"},
        {"Requested settings", "Requested size", "Requested hash"}};
    char settings[DIP_SETTINGS_BYTES];
    char hash[33];
    dip_quality_format(quality, settings, sizeof settings);
    dip_frame_hash(frame, hash);
    add(texts, keywords[pane][0], "%s", settings);
    add(texts, keywords[pane][1], "%dx%d", frame->width, frame->height);
    add(texts, keywords[pane][2], "%s", hash);
}
