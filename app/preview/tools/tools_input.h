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

// The versions of the truth and of the strip's pictures are counted upwards from these numbers.
// Equal versions mean equal pixels (draw_list.h). The versions of frames begin at 0 and never reach
// these ranges. The versions of the other tools' pictures are hashes (kept.h).
#define DIP_MAP_TRUTH_VERSION (UINT64_C(0x4d) << 56)
#define DIP_STRIP_VERSION     (UINT64_C(6) << 60)

#endif
