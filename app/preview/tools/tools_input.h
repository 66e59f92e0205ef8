// Declares what the preview's tools (loupe, comparison, maps and strip) need besides DipWindow, and
// the versions of the pictures that the tools make.
#ifndef DIP_APP_PREVIEW_TOOLS_TOOLS_INPUT_H
#define DIP_APP_PREVIEW_TOOLS_TOOLS_INPUT_H

#include "app/session/session.h"

// What the tools need to draw frames or read samples again. All pointers are borrowed for the call.
typedef struct DipToolsInput {
    DipSession *session;
    const DipPose *pose;               // Pose of the frame that was drawn last.
    int64_t play_ns;                   // Time of that frame.
    uint64_t frame_index;              // Index of that frame.
    uint64_t versions[DIP_PANE_COUNT]; // Versions of the panes' pictures, as in DipWindow.
    int width;                         // Width of the panes' pictures, in pixels.
    int height;                        // Height of the panes' pictures, in pixels.
    bool copied; // The requested pane shows a copy of the current one (DipSessionFrame).
    bool still;  // Camera and scene stand still.
    bool loupe;  // The loupe is on (dip_loupe_is_on).
} DipToolsInput;

// The versions of the tools' pictures begin at these numbers. Equal versions mean equal pixels
// (draw_list.h). The versions of frames begin at 0 and never reach these ranges. Each tool counts
// upwards from its own number.
#define DIP_LOUPE_VERSION       (UINT64_C(1) << 62)
#define DIP_MAP_TRUTH_VERSION   (UINT64_C(0x4d) << 56)
#define DIP_MAP_PICTURE_VERSION (UINT64_C(0x4e) << 56)
#define DIP_DIFFERENCE_VERSION  (UINT64_C(5) << 60)
#define DIP_STRIP_VERSION       (UINT64_C(6) << 60)

#endif
