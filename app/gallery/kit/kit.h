// The kit: what several gallery scenes share. It turns a pose into matrices and settings into a
// pass and samplers, and has the vertex shader that most scenes use.
#ifndef DIP_APP_GALLERY_KIT_KIT_H
#define DIP_APP_GALLERY_KIT_KIT_H

#include "app/gallery/scenes/scene.h"
#include "renderer/shapes/camera.h"
#include "renderer/shapes/shapes.h"

#include <math.h>

// --- cameras and passes --------------------------------------------------------------------------

typedef struct DipKitCamera {
    DipMatrix view;
    DipMatrix to_clip; // from world space
    float eye[3];      // in world space
} DipKitCamera;

// Makes the matrices of the view's pose, for a picture of width x height pixels.
bool dip_kit_camera(DipKitCamera *camera, const DipPose *pose, int width, int height,
                    double near_distance, DipError *err);

// Makes the matrices of a camera, or of a light, at `eye`.
bool dip_kit_look_at(DipKitCamera *camera, const double eye[3], const double target[3],
                     const DipPerspective *lens, DipError *err);

// Returns a pass that draws into the view's picture, with the samples of the pane's settings. The
// clear colour is in linear light.
DipPass dip_kit_pass(const DipGalleryView *view, const DipDraw *draws, int draw_count,
                     const float clear_lin[3]);

// Draws a pass with a pipeline of the pass's size, and adds its work to the view's counters.
bool dip_kit_draw(const DipGalleryView *view, DipPipeline *pipeline, const DipPass *pass,
                  DipError *err);

// --- objects -------------------------------------------------------------------------------------

// Uniforms that dip_kit_vertex reads. A scene's own uniforms begin with this struct.
typedef struct DipKitObject {
    float to_clip[16];
    float to_world[16];
    float normals[9]; // takes normals to world space; the results are not of unit length
    float eye[3];     // the camera's position in world space
} DipKitObject;

// Fills in the uniforms of an object that `model` takes to world space.
bool dip_kit_object(DipKitObject *object, const DipKitCamera *camera, const DipMatrix *model,
                    DipError *err);

// Varyings that dip_kit_vertex writes.
enum {
    DIP_KIT_UV = 0,     // u, v
    DIP_KIT_NORMAL = 2, // x, y, z in world space; not of unit length
    DIP_KIT_WORLD = 5,  // x, y, z of the position in world space
    DIP_KIT_VARYINGS = 8,
    DIP_KIT_VALUES_ONLY = 6 // normal and position are used without derivatives
};

// Vertex shader for meshes with the attributes of a shape (shapes.h).
void dip_kit_vertex(const DipVertexBatch *batch);

// Returns a draw of an object with dip_kit_vertex. The uniforms begin with a DipKitObject, must
// outlive the pass and give the matrix by which the pipeline culls.
DipDraw dip_kit_object_draw(const DipMesh *mesh, const void *uniforms,
                            DipFragmentShader *fragment_shader);

// Makes a mesh of a shape's vertices and frees the shape. made: what the function that made the
// shape returned; if it is false, the function returns NULL.
DipMesh *dip_kit_mesh(const char *name, DipShape *shape, bool made, DipError *err);

// Returns zeroed memory for the content of a scene. It is freed with free().
void *dip_kit_content(size_t size_bytes, const char *scene, DipError *err);

// --- textures ------------------------------------------------------------------------------------

// A texture and its compressed form, which settings with opt=standard or opt=advanced show.
typedef struct DipKitTexture {
    DipTexture *plain;
    DipTexture *compressed; // NULL for textures that hold no colours
} DipKitTexture;

// Computes the sRGB colour and the alpha of the texel at u, v, its centre in 0..1. It may use only
// + - * /, sqrt and functions of the kit, so that all machines have the same texels.
typedef void DipKitPaint(const void *context, float u, float v, float rgba[4]);

// Makes a texture of painted texels that repeats or, if `clamps` is true, clamps. The caller frees
// it with dip_kit_texture_free.
bool dip_kit_texture(DipKitTexture *texture, const char *name, int width, int height, bool clamps,
                     DipKitPaint *paint, const void *context, DipError *err);
void dip_kit_texture_free(DipKitTexture *texture);

// Returns a sampler that reads the texture as the settings of the pane say.
DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture);

// Sets the sampler to show the flat colour of each mip level instead of the texture.
void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view);

// --- numbers -------------------------------------------------------------------------------------

static inline float dip_kit_clamp(float x, float least, float greatest) {
    return x < least ? least : x > greatest ? greatest : x;
}

// Returns 0 below `from`, 1 above `to` and a smooth transition between them.
static inline float dip_kit_smooth(float from, float to, float x) {
    const float t = dip_kit_clamp((x - from) / (to - from), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static inline float dip_kit_mix(float a, float b, float share) {
    return a + (b - a) * share;
}

// Returns the greatest whole number that is not greater than x, for |x| < 2^31.
static inline float dip_kit_floor(float x) {
    const float whole = (float)(int)x;
    return whole > x ? whole - 1.0f : whole;
}

// Returns x to the power of 2^doublings.
static inline float dip_kit_power(float x, int doublings) {
    for (int i = 0; i < doublings; i++) {
        x *= x;
    }
    return x;
}

// Returns about sin(2 pi turns), for |turns| < 2^22, with an error below 0.0012. It uses + - *
// only, so that a loop over a batch becomes vector code with the same bits everywhere.
static inline float dip_kit_wave(float turns) {
    const float t = turns - dip_kit_floor(turns) - 0.5f; // -0.5..0.5; the sine of it is negated
    const float size = t < 0.0f ? -t : t;
    const float parabola = 8.0f * t - 16.0f * t * size;
    const float height = parabola < 0.0f ? -parabola : parabola;
    return -(0.775f * parabola + 0.225f * parabola * height);
}

// Returns a number 0..1 that depends on x, y and z without any visible pattern.
static inline float dip_kit_random(int x, int y, int z) {
    uint32_t h = (uint32_t)x * 0x8da6b343u ^ (uint32_t)y * 0xd8163841u ^ (uint32_t)z * 0xcb1ab31fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return (float)((h ^ h >> 15) >> 8) * (1.0f / 16777216.0f);
}

// Smooth noise, 0..1. It repeats along x and y after `period` units.
float dip_kit_noise(float x, float y, int period, int seed);

// Noise of several octaves, 0..1.
float dip_kit_turbulence(float x, float y, int period, int octaves, int seed);

#endif
