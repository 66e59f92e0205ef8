// The list of scenes, the tour through them, and opening and closing them.
#include "app/gallery/gallery.h"

#include "app/gallery/kit/kit.h"
#include "app/gallery/scenes/scene.h"
#include "renderer/base/assert.h"
#include "renderer/base/nearest.h"
#include "renderer/base/trig.h"
#include "renderer/shapes/camera.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t scene_ns = DIP_GALLERY_SECONDS * INT64_C(1000000000);

static const DipGalleryScene *const scenes[] = {
#define LIST_SCENE(name) &dip_gallery_##name,
    DIP_GALLERY_SCENE_LIST(LIST_SCENE)
#undef LIST_SCENE
};

enum { SCENE_COUNT = (int)DIP_ARRAY_COUNT(scenes), MIP_COLOURS = 8 };

struct DipGallery {
    DipGalleryDef def;
    DipTexture *mip_colours;
    int open;      // index of the open scene; -1: none
    void *content; // of the open scene
    int look;
};

// --- the list ------------------------------------------------------------------------------------

int dip_gallery_scene_count(void) {
    return SCENE_COUNT;
}

const DipGalleryInfo *dip_gallery_info(int scene) {
    DIP_ASSERT(scene >= 0 && scene < SCENE_COUNT);
    return &scenes[scene]->info;
}

// Fails with a message that names the scenes, and the one that the user may have meant.
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

// Returns a time as the time since the scene or the tour began.
static int64_t wrap_time(int scene, int64_t time_ns) {
    const int64_t duration_ns = dip_gallery_duration_ns(scene);
    const int64_t left_ns = time_ns % duration_ns;
    return left_ns < 0 ? left_ns + duration_ns : left_ns;
}

int dip_gallery_scene_at(int scene, int64_t time_ns) {
    return scene == DIP_GALLERY_TOUR ? (int)(wrap_time(scene, time_ns) / scene_ns) : scene;
}

// Writes the quaternion of a rotation. rows: takes world space to view space. The square roots are
// taken of the largest component only, so that no digits are lost.
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
        const int other = 3 - largest - i; // the axis that is neither i nor `largest`
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

// The colours of DipRendererDef's mip debugging: levels of 1024, 512, ... 8 texels, in sRGB.
static DipTexture *make_mip_colours(DipError *err) {
    static const uint8_t colours[MIP_COLOURS][4] = {
        {0, 0, 0, 255},     {128, 0, 0, 255}, {255, 0, 0, 255}, {255, 128, 0, 255},
        {255, 255, 0, 255}, {0, 255, 0, 255}, {0, 0, 255, 255}, {128, 0, 128, 255},
    };
    DipTextureDef levels[MIP_COLOURS];
    for (int i = 0; i < MIP_COLOURS; i++) {
        levels[i] = (DipTextureDef){.name = "mip colour",
                                    .width = 1,
                                    .height = 1,
                                    .rgba8 = colours[i],
                                    .encoding = DIP_ENCODING_SRGB,
                                    .wrap_u = DIP_WRAP_REPEAT,
                                    .wrap_v = DIP_WRAP_REPEAT};
    }
    return dip_texture_create_from_levels(levels, MIP_COLOURS, err);
}

static void close_scene(DipGallery *gallery) {
    if (gallery->content) {
        if (scenes[gallery->open]->destroy) {
            scenes[gallery->open]->destroy(gallery->content);
        }
        dip_kit_stock_free(gallery->content);
        free(gallery->content);
    }
    gallery->open = -1;
    gallery->content = NULL;
}

static bool open_scene(DipGallery *gallery, int index, DipError *err) {
    const DipGalleryRoom room = {gallery->def.pool, gallery->def.isa, gallery->def.assets};
    if (gallery->open == index) {
        return true;
    }
    close_scene(gallery);
    gallery->open = index;
    gallery->content = calloc(1, scenes[index]->content_bytes);
    const bool made = gallery->content ? scenes[index]->create(gallery->content, &room, err)
                                       : dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0,
                                                       scenes[index]->info.name, "out of memory");
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
    gallery->open = -1;
    gallery->mip_colours = make_mip_colours(err);
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

bool dip_gallery_play(DipGallery *gallery, int64_t time_ns, DipGalleryPlaying *playing,
                      DipError *err) {
    const int index = dip_gallery_scene_at(gallery->def.scene, time_ns);
    if (!open_scene(gallery, index, err)) {
        return false;
    }
    const int looks = scenes[index]->info.look_count;
    const int64_t since_ns = wrap_time(gallery->def.scene, time_ns) % scene_ns;
    *playing = (DipGalleryPlaying){
        .scene = scenes[index],
        .content = gallery->content,
        .time_s = 1e-9 * (double)since_ns,
        .look = (gallery->look % looks + looks) % looks,
        .pool = gallery->def.pool,
        .mip_colours = gallery->mip_colours,
    };
    return true;
}
