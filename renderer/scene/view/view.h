// A camera as matrices: its view of the world and of the mirrored world, and planes in its clip
// space.
#ifndef DIP_RENDERER_SCENE_VIEW_VIEW_H
#define DIP_RENDERER_SCENE_VIEW_VIEW_H

#include "renderer/scene/pose.h"

typedef struct DipView {
    double eye[3];            // the camera's position in world space
    double axis[3][3];        // the camera's x, y, z axes in world space; left-handed if mirrored
    double scale[2];          // clip x = scale[0] * camera x, clip y = scale[1] * camera y
    double near_m;            // distance of the near plane; also the clip z of every point
    double shift[2];          // clip x and y are shifted by these multiples of clip w
    double world_to_clip[16]; // row-major; has the shift
} DipView;

// Computes the view from a pose, as docs/picture.md, Camera, defines it. aspect: width / height of
// the picture.
DipView dip_view_make(const DipPose *pose, double near_m, double aspect);

// Shifts what the view shows by parts of the picture: a shift of 2 is its whole width or height, to
// the right or up.
void dip_view_shift(DipView *view, const double shift[2]);

// Computes the matrix of three rows that takes a place in the picture of `now` and a depth to the
// place of the same point in the picture of `before` (to_before of DipHistoryPicture). Both views
// have the same near plane; their shifts do not matter.
void dip_view_motion(const DipView *now, const DipView *before, float to_before[12]);

// Computes the view of the world mirrored at y = level. It shows every point at the position at
// which the eye would see the point's mirror image. The view reverses the winding of every
// triangle.
DipView dip_view_mirror(const DipView *view, double level);

// Transforms a plane from world space to clip space: for a world point (x, y, z),
// dot(clip, clip position) = plane[0] x + plane[1] y + plane[2] z + plane[3].
void dip_view_plane(const DipView *view, const double plane[4], double clip[4]);

// Distance between neighbouring origins along each axis, in units of the object.
#define DIP_ORIGIN_CELL 1024.0

// Chooses the point of an object from which a vertex shader measures positions: the multiple of
// DIP_ORIGIN_CELL on each axis that is nearest to the eye. Vertices near the eye then have small
// coordinates, however far the eye is from the object's own origin, so their clip positions keep
// their precision in floats. world_to_object: see DipSceneObject; if it is 0, the point is (0, 0,
// 0).
void dip_view_object_origin(const double eye[3], const float transform[12],
                            const double world_to_object[9], float origin[3]);

// Computes product = world_to_clip * transform * translation by `origin`, which takes positions
// relative to the origin to clip space. The transform is a 3x4 matrix; its fourth row is
// (0, 0, 0, 1).
void dip_view_object_to_clip(const DipView *view, const float transform[12], const float origin[3],
                             double product[16]);

// The same for any linear camera: the first three elements of each row of `world_to_clip` are used,
// and at_eye is the clip position of the eye.
void dip_object_to_clip(const double world_to_clip[16], const double eye[3], const double at_eye[4],
                        const float transform[12], const float origin[3], double product[16]);

#endif
