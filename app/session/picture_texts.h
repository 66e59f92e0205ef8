// Makes the texts that Diptych writes into its PNG files, so that a picture tells how it was made:
//
//     Software             Diptych 1.0.0
//     Scene                file of the first model, or name of the gallery's scene
//     Path                 a category of camera paths such as "AA", a path's file, a model's
//                          camera, "orbit", "pose", "free camera", or "scene" for the path that a
//                          scene of the gallery has
//     Time                 "3.25 s", the time that the picture shows
//     Pose                 "x y z qx qy qz qw", as --pose takes it
//     Field of view        "55", vertical, in degrees, as --fov takes it
//     Current settings     "aa=4,..."
//     Current size         "640x480", of the drawn frame
//     Current hash         hash of the drawn frame, as `dump --hash` prints it
//
// A picture has the last three texts for each pane that it shows. For the requested pane, the names
// of these texts begin with "Requested".
#ifndef DIP_APP_SESSION_PICTURE_TEXTS_H
#define DIP_APP_SESSION_PICTURE_TEXTS_H

#include "app/files/pictures.h"
#include "app/session/session.h"

enum { DIP_PICTURE_MAX_TEXTS = 16, DIP_PICTURE_TEXT_BYTES = 8192 };

// The texts point into the struct, so the struct must not be copied.
typedef struct DipPictureTexts {
    DipPngText items[DIP_PICTURE_MAX_TEXTS];
    int count;
    size_t used_bytes;
    char bytes[DIP_PICTURE_TEXT_BYTES]; // A text that does not fit is cut.
} DipPictureTexts;

// Sets the texts that both panes share. `free_camera` is true if the user flies the camera, so that
// the pose does not come from a path.
void dip_picture_texts_make(DipPictureTexts *texts, const DipSession *session, const DipPose *pose,
                            int64_t time_ns, bool free_camera);

// Adds the texts of a pane that the picture shows.
void dip_picture_texts_add_pane(DipPictureTexts *texts, int pane, const DipQuality *quality,
                                const DipFrame *frame);

// Writes a pose as "x y z qx qy qz qw", the order of camera path files. Each number is read back as
// the same double.
void dip_pose_format(const DipPose *pose, char *text, size_t size_bytes);

#endif
