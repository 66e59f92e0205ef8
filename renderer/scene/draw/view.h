// A camera as matrices: its view of the world, the view of the mirrored world, planes.
#ifndef DIP_RENDERER_SCENE_DRAW_VIEW_H
#define DIP_RENDERER_SCENE_DRAW_VIEW_H

#include "renderer/scene/pose.h"

typedef struct DipView {
    double eye[3];            // world
    double axis[3][3];        // camera x, y, z in the world; left-handed in a mirrored view
    double scale[2];          // clip x and y = scale * camera x and y
    double near_m;            // clip z
    double world_to_clip[16]; // row-major
} DipView;

// aspect: width / height of the picture; see docs/picture.md, Camera.
DipView dip_view_make(const DipPose *pose, double near_m, double aspect);

// What the view shows of the world mirrored at y = level: every point where its mirror image would
// be. Windings turn around.
DipView dip_view_mirror(const DipView *view, double level);

// The clip-space form of a world plane: dot(clip, clip position) is plane[0] x + plane[1] y +
// plane[2] z + plane[3] at a world point.
void dip_view_plane(const DipView *view, const double plane[4], double clip[4]);

// product = world_to_clip * transform, whose last row is (0, 0, 0, 1).
void dip_view_object_to_clip(const DipView *view, const float transform[12], float product[16]);

#endif
