// What the tools need besides the window, and the versions of the pictures that they make.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOLS_INPUT_H
#define DIP_APP_PREVIEW_TOOLS_TOOLS_INPUT_H

#include "app/session/session.h"

// What the tools need to draw parts of frames again. All of it is borrowed for the call.
typedef struct DipToolsInput {
    DipSession *session;
    const DipPose *pose; // Pose, time and number of the frame that was drawn last.
    int64_t play_ns;
    uint64_t frame_index;
    uint64_t versions[DIP_PANE_COUNT]; // Versions of the panes' pictures, as in DipWindow.
    int width;                         // Size of the panes' pictures.
    int height;
    bool copied; // See DipSessionFrame.
    bool still;  // Camera and scene stand still.
} DipToolsInput;

// Versions of the tools' pictures in the draw list. Frames count from 0, so no frame has these
// numbers, and each tool counts in a range of its own.
#define DIP_LOUPE_VERSION       (UINT64_C(1) << 62)
#define DIP_MAP_TRUTH_VERSION   (UINT64_C(0x4d) << 56)
#define DIP_MAP_PICTURE_VERSION (UINT64_C(0x4e) << 56)
#define DIP_DIFFERENCE_VERSION  (UINT64_C(5) << 60)
#define DIP_STRIP_VERSION       (UINT64_C(6) << 60)

#endif
