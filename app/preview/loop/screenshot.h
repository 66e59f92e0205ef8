// Saves what the preview shows as a PNG file, with texts that tell how the picture was made
// (app/session/picture_texts.h).
#ifndef DIP_APP_PREVIEW_LOOP_SCREENSHOT_H
#define DIP_APP_PREVIEW_LOOP_SCREENSHOT_H

#include "app/ui/pixels.h"
#include "app/session/session.h"

// All pointers are borrowed for the call.
typedef struct DipScreenshot {
    const DipPixels *picture; // What the window shows. NULL: save the panes without any overlay.
    const DipSession *session;
    const DipSessionFrame *frame; // The frame that the window shows, with its panes' pixels.
    const DipQuality *quality;    // The settings of both panes.
    const DipPose *pose;
    int64_t time_ns;  // The scene's time in the frame.
    bool free_camera; // The user flies the camera.
} DipScreenshot;

// Writes the picture to a file in the working folder: to the first of diptych-0001.png,
// diptych-0002.png, ... that does not exist yet. Fills in the file's name. Without the window's
// picture, writes the panes side by side, with the gap that the window has between them.
bool dip_screenshot_save(const DipScreenshot *shot, char *file, size_t size_bytes, DipError *err);

#endif
