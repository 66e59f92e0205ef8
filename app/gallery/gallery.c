// Finds scenes by name and time, opens and closes them, and draws the pictures of panes.
#include "app/gallery/gallery.h"

#include "app/gallery/kit/kit.h"
#include "renderer/base/assert.h"
#include "renderer/base/fp_mode.h"
#include "renderer/base/nearest.h"
#include "renderer/base/pages.h"
#include "renderer/scene/finish.h"
#include "renderer/scene/mip_debug.h"

#include <stdlib.h>
#include <string.h>

static const int64_t scene_ns = DIP_GALLERY_SECONDS * INT64_C(1000000000);

static const DipGalleryScene *const scenes[] = {
#define LIST_SCENE(name) &dip_gallery_##name,
    DIP_GALLERY_SCENE_LIST(LIST_SCENE)
#undef LIST_SCENE
};

enum { SCENE_COUNT = (int)DIP_ARRAY_COUNT(scenes) };

struct DipGallery {
    DipGalleryDef def;
    DipTexture *mip_colours;
    int open;            // Index of the open scene; -1 if none is open.
    DipGalleryRoom room; // Data of the open scene; room.content is NULL if none is open.
    int look;
};

struct DipGalleryPane {
    DipGallery *gallery;
    DipIsa isa;
    DipQuality quality;
    uint64_t frame_index;
    DipPipeline *pipeline;
    DipTarget target;
    DipFinish *finish; // The filters of finished pictures that the settings ask for.
};

// --- the list ------------------------------------------------------------------------------------

int dip_gallery_scene_count(void) {
    return SCENE_COUNT;
}

const DipGalleryInfo *dip_gallery_info(int scene) {
    DIP_ASSERT(scene >= 0 && scene < SCENE_COUNT);
    return &scenes[scene]->info;
}

// Fails with a message that names all scenes. If a scene has a similar name, the message suggests
// that scene.
static bool refuse_name(const char *name, DipError *err) {
    const char *names[SCENE_COUNT + 1];
    char known[200] = "";
    for (int i = 0; i <= SCENE_COUNT; i++) {
        names[i] = i < SCENE_COUNT ? scenes[i]->info.name : "tour";
        strcat(strcat(known, i ? "|" : ""), names[i]);
    }
    const char *likely = dip_nearest_likely(name, names, SCENE_COUNT + 1);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, NULL, 0, "--scene",
                         "'%.40s' is not a scene of the gallery%s%s%s; give one of %s", name,
                         likely ? " (did you mean '" : "", likely ? likely : "",
                         likely ? "'?)" : "", known);
}

bool dip_gallery_find(const char *name, int *scene, DipError *err) {
    for (int i = 0; i < SCENE_COUNT; i++) {
        if (strcmp(name, scenes[i]->info.name) == 0) {
            *scene = i;
            return true;
        }
    }
    *scene = DIP_GALLERY_TOUR;
    return strcmp(name, "tour") == 0 || refuse_name(name, err);
}

// --- time and cameras ----------------------------------------------------------------------------

int64_t dip_gallery_duration_ns(int scene) {
    return scene == DIP_GALLERY_TOUR ? SCENE_COUNT * scene_ns : scene_ns;
}

// Returns the time since the scene or the tour last started again.
static int64_t wrap_time(int scene, int64_t time_ns) {
    const int64_t duration_ns = dip_gallery_duration_ns(scene);
    const int64_t left_ns = time_ns % duration_ns;
    return left_ns < 0 ? left_ns + duration_ns : left_ns;
}

int dip_gallery_scene_at(int scene, int64_t time_ns) {
    return scene == DIP_GALLERY_TOUR ? (int)(wrap_time(scene, time_ns) / scene_ns) : scene;
}

// Writes the quaternion that takes view space to world space. `rows` is the matrix that takes world
// space to view space. Only the largest component comes from a square root, so that no digits are
// lost.
static void find_orientation(const double rows[16], double q[4]) {
    const double trace = rows[0] + rows[5] + rows[10];
    double twice[4] = {rows[0] - rows[5] - rows[10], rows[5] - rows[0] - rows[10],
                       rows[10] - rows[0] - rows[5], trace};
    int largest = 0;
    for (int i = 1; i < 4; i++) {
        largest = twice[i] > twice[largest] ? i : largest;
    }
    const double size = 0.5 * sqrt(1.0 + twice[largest]);
    const double part = 0.25 / size;
    const double sums[3] = {rows[9] + rows[6], rows[2] + rows[8], rows[4] + rows[1]};
    const double differences[3] = {rows[6] - rows[9], rows[8] - rows[2], rows[1] - rows[4]};
    for (int i = 0; i < 3; i++) {
        const int other = 3 - largest - i; // The axis that is neither i nor `largest`.
        q[i] = largest == 3 ? part * differences[i] : i == largest ? size : part * sums[other];
    }
    q[3] = largest == 3 ? size : part * differences[largest];
}

void dip_gallery_pose(int scene, int64_t time_ns, DipPose *pose) {
    static const double up[3] = {0.0, 1.0, 0.0};
    const DipGalleryScene *playing = scenes[dip_gallery_scene_at(scene, time_ns)];
    const double phase = (double)(wrap_time(scene, time_ns) % scene_ns) / (double)scene_ns;
    const DipGalleryCamera camera = playing->camera(2.0 * DIP_PI * phase);
    DipMatrix view;
    DipError err;
    const bool made = dip_camera_look_at(&view, camera.eye, camera.target, up, &err);
    DIP_ASSERT(made);
    (void)made;
    memcpy(pose->position_world, camera.eye, sizeof camera.eye);
    find_orientation(view.m, pose->orientation);
    pose->fov_y_deg = DIP_GALLERY_FOV_Y_DEG;
}

// --- opening and closing -------------------------------------------------------------------------

static void close_scene(DipGallery *gallery) {
    if (gallery->room.content && scenes[gallery->open]->destroy) {
        scenes[gallery->open]->destroy(gallery->room.content);
    }
    dip_kit_stock_free(&gallery->room.stock);
    free(gallery->room.content);
    gallery->open = -1;
    gallery->room.content = NULL;
}

// Opens a scene unless it is open. Closes the scene that was open before.
static bool open_scene(DipGallery *gallery, int index, DipError *err) {
    const DipGalleryScene *scene = scenes[index];
    if (gallery->open == index) {
        return true;
    }
    close_scene(gallery);
    gallery->open = index;
    gallery->room.content = calloc(1, scene->content_bytes + 1); // content_bytes may be 0.
    const bool made =
        gallery->room.content
            ? dip_kit_stock_create(&gallery->room.stock, scene, err) &&
                  (!scene->create || scene->create(&gallery->room, err))
            : dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, scene->info.name, "out of memory");
    if (!made) {
        close_scene(gallery);
    }
    return made;
}

DipGallery *dip_gallery_create(const DipGalleryDef *def, DipError *err) {
    DipGallery *gallery = calloc(1, sizeof *gallery);
    if (!gallery) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "gallery", "out of memory");
        return NULL;
    }
    gallery->def = *def;
    gallery->room.def = &gallery->def;
    gallery->open = -1;
    gallery->mip_colours = dip_mip_debug_create(NULL, err);
    if (!gallery->mip_colours || !open_scene(gallery, dip_gallery_scene_at(def->scene, 0), err)) {
        dip_gallery_destroy(&gallery);
    }
    return gallery;
}

void dip_gallery_destroy(DipGallery **gallery_pointer) {
    DipGallery *gallery = *gallery_pointer;
    if (!gallery) {
        return;
    }
    close_scene(gallery);
    dip_texture_destroy(&gallery->mip_colours);
    free(gallery);
    *gallery_pointer = NULL;
}

void dip_gallery_set_look(DipGallery *gallery, int look) {
    gallery->look = look;
}

// --- panes ---------------------------------------------------------------------------------------

// Creates a pipeline and a picture of one size, or neither.
static bool make_picture(const DipGalleryPane *pane, int width, int height, DipPipeline **pipeline,
                         DipTarget *target, DipError *err) {
    *pipeline = dip_pipeline_create(pane->gallery->def.pool, pane->isa, width, height, err);
    if (!*pipeline) {
        return false;
    }
    if (!dip_kit_target(target, width, height, "size", err)) {
        dip_pipeline_destroy(pipeline);
        return false;
    }
    return true;
}

DipGalleryPane *dip_gallery_pane_create(const DipGalleryPaneDef *def, DipError *err) {
    DIP_FP_MODE_SCOPE();
    if (!dip_quality_check(&def->quality, err)) {
        return NULL;
    }
    DipGalleryPane *pane = calloc(1, sizeof *pane);
    if (!pane) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "pane", "out of memory");
        return NULL;
    }
    pane->gallery = def->gallery;
    pane->isa = def->isa;
    pane->quality = def->quality;
    pane->finish = dip_finish_create(def->gallery->def.pool, def->isa, err);
    if (!pane->finish ||
        !make_picture(pane, def->width, def->height, &pane->pipeline, &pane->target, err)) {
        dip_gallery_pane_destroy(&pane);
    }
    return pane;
}

void dip_gallery_pane_destroy(DipGalleryPane **pane_pointer) {
    DipGalleryPane *pane = *pane_pointer;
    if (!pane) {
        return;
    }
    dip_finish_destroy(&pane->finish);
    dip_pipeline_destroy(&pane->pipeline);
    dip_lines_free(pane->target.rgba8);
    free(pane);
    *pane_pointer = NULL;
}

bool dip_gallery_pane_set_quality(DipGalleryPane *pane, const DipQuality *quality, DipError *err) {
    if (!dip_quality_check(quality, err)) {
        return false;
    }
    pane->quality = *quality;
    return true;
}

bool dip_gallery_pane_resize(DipGalleryPane *pane, int width, int height, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipPipeline *pipeline;
    DipTarget target;
    if (width == pane->target.width && height == pane->target.height) {
        return true;
    }
    if (!make_picture(pane, width, height, &pipeline, &target, err)) {
        return false;
    }
    dip_pipeline_destroy(&pane->pipeline);
    dip_lines_free(pane->target.rgba8);
    pane->pipeline = pipeline;
    pane->target = target;
    return true;
}

DipQuality dip_gallery_pane_quality(const DipGalleryPane *pane) {
    return pane->quality;
}

void dip_gallery_pane_set_frame_index(DipGalleryPane *pane, uint64_t frame_index) {
    pane->frame_index = frame_index;
}

// --- drawing -------------------------------------------------------------------------------------

static bool check_pose(const DipPose *pose, DipError *err) {
    const double *q = pose->orientation;
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    bool finite = true;
    for (int i = 0; i < 3; i++) {
        finite = finite && isfinite(pose->position_world[i]);
    }
    if (!finite || !isfinite(length) || length < 1e-150) {
        return dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "pose",
                             "the pose is not finite or has no orientation");
    }
    return (pose->fov_y_deg >= 1.0 && pose->fov_y_deg <= 170.0) ||
           dip_error_set(err, DIP_ERROR_RANGE, NULL, 0, "fov_y_deg",
                         "%g is out of range, accepted 1..170", pose->fov_y_deg);
}

// Returns a sampler that filters as the settings say. The scene sets the sampler's texture.
static DipSampler filter_of(const DipQuality *quality) {
    return (DipSampler){
        .max_anisotropy = dip_quality_max_anisotropy(quality),
        .exact_footprint = quality->step[DIP_SETTING_AAF] != 0,
        .bias_lod8 =
            dip_quality_bias_lod8(quality) +
            (dip_quality_groups_shade_all(quality) ? dip_quality_groups_bias_lod8(quality) : 0),
        .cheap = quality->step[DIP_SETTING_OPT] == DIP_OPT_ADVANCED,
    };
}

// Fills in a frame with the picture, the counters and the times of all passes. Of the scene
// renderer's effects, only the filters of the finished picture run in the gallery.
static void fill_frame(const DipGalleryPane *pane, const DipPipelineCounters *counters,
                       const DipStageTimes *times, DipFrame *frame) {
    static const DipEffect none = {.run = false, .why = "a gallery scene has its own shaders"};
    *frame = (DipFrame){
        .rgba8 = pane->target.rgba8,
        .stride_bytes = pane->target.stride_bytes,
        .width = pane->target.width,
        .height = pane->target.height,
        .stages = *times,
    };
#define COPY_COUNTER(name, text) frame->counters.name = counters->name;
    DIP_PIPELINE_COUNTER_LIST(COPY_COUNTER)
#undef COPY_COUNTER
#define SET_EFFECT(name, title) frame->effects.name = none;
    DIP_EFFECT_LIST(SET_EFFECT)
#undef SET_EFFECT
    frame->effects.history = (DipEffect){false, "gallery scenes have cameras of their own"};
    frame->effects.post = pane->quality.step[DIP_SETTING_POST]
                              ? (DipEffect){true, "the finished picture is searched for edges"}
                              : (DipEffect){false, "post is off"};
    frame->effects.upscale = (DipEffect){false, "gallery scenes are drawn at their own size"};
    frame->effects.sharpen = pane->quality.step[DIP_SETTING_SHARPEN]
                                 ? (DipEffect){true, "the finished picture is sharpened"}
                                 : (DipEffect){false, "sharpen is off"};
}

bool dip_gallery_pane_draw(DipGalleryPane *pane, const DipPose *pose, int64_t time_ns,
                           DipFrame *frame, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipGallery *gallery = pane->gallery;
    const int index = dip_gallery_scene_at(gallery->def.scene, time_ns);
    const int looks = scenes[index]->info.look_count;
    const double time_s = 1e-9 * (double)(wrap_time(gallery->def.scene, time_ns) % scene_ns);
    DipPipelineCounters counters = {0};
    DipStageTimes times = {0};
    DipQuality quality = pane->quality;
    quality.step[DIP_SETTING_SCALE] = DIP_SCALE_1; // A scene is drawn at the pane's size.
    if (dip_quality_has_history(&quality)) {
        quality.step[DIP_SETTING_TAA] = DIP_TAA_OFF; // A gallery scene has no history.
    }
    const DipFinishSize size = dip_finish_size(&quality, pane->target.width, pane->target.height);
    if (!check_pose(pose, err) || !open_scene(gallery, index, err) ||
        !dip_finish_follow(pane->finish, &quality, &size, err)) {
        return false;
    }
    const DipGalleryView view = {
        .def = &gallery->def,
        .stock = &gallery->room.stock,
        .content = gallery->room.content,
        .pose = pose,
        .time_s = time_s,
        .turns = (float)(time_s / DIP_GALLERY_SECONDS),
        .turn = 2.0 * DIP_PI * time_s / DIP_GALLERY_SECONDS,
        .look = (gallery->look % looks + looks) % looks,
        .quality = &quality,
        .pattern = dip_pattern_kind(dip_quality_alternates(&quality), pane->frame_index),
        .target = pane->target,
        .pipeline = pane->pipeline,
        .filter = filter_of(&quality),
        .mip_colours = gallery->mip_colours,
        .counters = &counters,
        .times = &times,
    };
    if (!scenes[index]->draw(&view, err)) {
        return false;
    }
    fill_frame(pane, &counters, &times, frame);
    dip_finish_frame(pane->finish, NULL, frame);
    return true;
}
