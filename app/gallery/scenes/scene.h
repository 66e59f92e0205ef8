// What a scene of the gallery consists of, and what it gets to draw a frame with.
#ifndef DIP_APP_GALLERY_SCENES_SCENE_H
#define DIP_APP_GALLERY_SCENES_SCENE_H

#include "app/gallery/gallery.h"
#include "renderer/pipeline/pipeline.h"

// What a scene may use while it exists.
typedef struct DipGalleryRoom {
    DipPool *pool;
    DipIsa isa;         // for pipelines that the scene creates
    const char *assets; // folder of the shipped assets
} DipGalleryRoom;

// A frame that a scene draws. Settings are those of the pane.
typedef struct DipGalleryView {
    const DipPose *pose;
    double time_s; // 0..DIP_GALLERY_SECONDS
    double turn;   // The time as an angle that a loop turns by: 0..2 pi.
    int look;      // 0..look_count - 1
    const DipQuality *quality;
    DipPatternKind pattern;
    DipTarget target;              // the picture, format DIP_FORMAT_SRGB8
    DipPipeline *pipeline;         // of the picture's size
    DipSampler filter;             // how the settings filter textures; has no texture yet
    const DipTexture *mip_colours; // level i is a flat colour for mip levels of 1024 >> i texels
    DipPipelineCounters *counters;
    DipStageTimes *times;
} DipGalleryView;

// Where a scene's camera stands, and the point that it looks at.
typedef struct DipGalleryCamera {
    double eye[3];
    double target[3];
} DipGalleryCamera;

typedef struct DipGalleryScene {
    DipGalleryInfo info;
    size_t content_bytes; // Size of the scene's content, which begins with a DipKitStock.
    // turn: the time as an angle, 0..2 pi. Both ends have the same camera.
    DipGalleryCamera (*camera)(double turn);
    // Makes meshes and textures in the content, which is zeroed.
    bool (*create)(void *content, const DipGalleryRoom *room, DipError *err);
    // Frees what `create` has made besides the stock, even if it has failed. NULL: there is
    // nothing.
    void (*destroy)(void *content);
    bool (*draw)(void *content, const DipGalleryView *view, DipError *err);
} DipGalleryScene;

// The one list of scenes, in the order of the tour.
#define DIP_GALLERY_SCENE_LIST(X)                                                                  \
    X(model)                                                                                       \
    X(shadow)                                                                                      \
    X(prism)                                                                                       \
    X(blend)                                                                                       \
    X(stencil)                                                                                     \
    X(toon)                                                                                        \
    X(dice)                                                                                        \
    X(phone)                                                                                       \
    X(quads)                                                                                       \
    X(cubes)                                                                                       \
    X(tunnel)                                                                                      \
    X(water)

#define DIP_GALLERY_DECLARE(name) extern const DipGalleryScene dip_gallery_##name;
DIP_GALLERY_SCENE_LIST(DIP_GALLERY_DECLARE)
#undef DIP_GALLERY_DECLARE

// What a gallery plays at a time.
typedef struct DipGalleryPlaying {
    const DipGalleryScene *scene;
    void *content;
    double time_s; // since the scene began, 0..DIP_GALLERY_SECONDS
    int look;
    DipPool *pool;
    const DipTexture *mip_colours;
} DipGalleryPlaying;

// Finds what plays at a time. The tour closes the scene before it when it opens the next one.
bool dip_gallery_play(DipGallery *gallery, int64_t time_ns, DipGalleryPlaying *playing,
                      DipError *err);

#endif
