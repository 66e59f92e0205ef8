// Draws the gallery: scenes that show what the pipeline can do. Each scene is one file in scenes/.
// The gallery uses the public headers of renderer/pipeline and renderer/shapes, and is example code
// for users of these libraries.
//
// A gallery plays one scene, or the tour, which plays all scenes in turn. A pane is a picture with
// its own size and image-quality settings. The panes of a gallery share the scene's meshes and
// textures, so only one pane of a gallery may draw at a time.
//
// docs/gallery.md describes the scenes and says what each setting does to them. Where comments
// name a seed, they mean one of the documents, numbered 000 to 004, from which the project and most
// of the scenes come.
#ifndef DIP_APP_GALLERY_GALLERY_H
#define DIP_APP_GALLERY_GALLERY_H

#include "renderer/base/error.h"
#include "renderer/base/isa.h"
#include "renderer/base/pool.h"
#include "renderer/scene/frame.h"
#include "renderer/scene/pose.h"
#include "renderer/scene/quality.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Every scene lasts this long. Its camera and its motion then start again.
enum { DIP_GALLERY_SECONDS = 15 };

// Vertical field of view of the scenes' cameras, in degrees.
#define DIP_GALLERY_FOV_Y_DEG 45.0

// Describes a scene. All strings are static.
typedef struct DipGalleryInfo {
    const char *name;  // The name that --scene takes, such as "blend".
    const char *title; // The name for users, such as "Blend modes".
    const char *text;  // One or two sentences on what the scene shows.
    // Names of the looks: the scene's variants, between which a key of the preview changes, such as
    // "flat", "Gouraud" and "Phong". A scene has at least one look.
    const char *const *looks;
    int look_count;
} DipGalleryInfo;

// In the functions below, `scene` is the index of a scene, 0..dip_gallery_scene_count() - 1. Except
// for dip_gallery_info, `scene` may also be DIP_GALLERY_TOUR, which stands for the tour.
enum { DIP_GALLERY_TOUR = -1 };

int dip_gallery_scene_count(void);
const DipGalleryInfo *dip_gallery_info(int scene);

// Finds a scene by its name, or DIP_GALLERY_TOUR by the name "tour". If there is no such scene,
// fails with UNKNOWN and a message that names all scenes.
bool dip_gallery_find(const char *name, int *scene, DipError *err);

// Returns the scene that plays at a time: for the tour, the tour's scene at that time; otherwise
// `scene` itself.
int dip_gallery_scene_at(int scene, int64_t time_ns);

// Returns how long `scene` or the tour lasts before it starts again.
int64_t dip_gallery_duration_ns(int scene);

// Writes the pose that the scene's own camera has at a time.
void dip_gallery_pose(int scene, int64_t time_ns, DipPose *pose);

// --- galleries -----------------------------------------------------------------------------------

typedef struct DipGallery DipGallery;

typedef struct DipGalleryDef {
    int scene;          // Index of a scene, or DIP_GALLERY_TOUR.
    DipPool *pool;      // Borrowed; must outlive the gallery.
    DipIsa isa;         // Instruction set of the passes that draw something other than a pane's
                        // picture, such as a shadow map.
    const char *assets; // Folder of the shipped assets. Borrowed.
} DipGalleryDef;

// Creates a gallery and opens the scene, or the first scene of the tour. Fails with MEMORY, or with
// the error of an asset of the scene.
DipGallery *dip_gallery_create(const DipGalleryDef *def, DipError *err);
// Destroys a gallery. Its panes must be destroyed before. *gallery may be NULL and becomes NULL.
void dip_gallery_destroy(DipGallery **gallery);

// Chooses one of the scene's looks. The value is taken modulo the number of looks.
void dip_gallery_set_look(DipGallery *gallery, int look);

// --- panes ---------------------------------------------------------------------------------------

typedef struct DipGalleryPane DipGalleryPane;

typedef struct DipGalleryPaneDef {
    DipGallery *gallery; // Borrowed; must outlive the pane.
    DipIsa isa;          // Instruction set of the passes that draw the picture.
    int width;           // Pixels, 1..DIP_MAX_FRAME_SIZE.
    int height;          // Pixels, 1..DIP_MAX_FRAME_SIZE.
    DipQuality quality;
} DipGalleryPaneDef;

// Creates a pane. Fails with RANGE, CONFLICT (see dip_quality_check), UNSUPPORTED or MEMORY.
DipGalleryPane *dip_gallery_pane_create(const DipGalleryPaneDef *def, DipError *err);
void dip_gallery_pane_destroy(DipGalleryPane **pane);

// These two functions change the settings or the size from the next frame on. A function that fails
// changes nothing; its errors are those of dip_gallery_pane_create.
bool dip_gallery_pane_set_quality(DipGalleryPane *pane, const DipQuality *quality, DipError *err);
bool dip_gallery_pane_resize(DipGalleryPane *pane, int width, int height, DipError *err);

DipQuality dip_gallery_pane_quality(const DipGalleryPane *pane);

// Sets the number of the frame that is drawn next. Temporal antialiasing alternates between even
// and odd numbers.
void dip_gallery_pane_set_frame_index(DipGalleryPane *pane, uint64_t frame_index);

// Draws the scene from a pose at a time. The frame is the same to the bit for any number of threads
// and any instruction set. The pane owns the frame's pixels, which are valid until the pane draws
// again, changes its size or is destroyed. Fails with RANGE (a pose that is not finite or has no
// orientation, a field of view out of range), MEMORY, or the error of an asset that the tour's next
// scene needs.
bool dip_gallery_pane_draw(DipGalleryPane *pane, const DipPose *pose, int64_t time_ns,
                           DipFrame *frame, DipError *err);

#endif
