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

// Makes the matrices of the view's pose.
bool dip_kit_camera(DipKitCamera *camera, const DipGalleryView *view, double near_distance,
                    DipError *err);

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

// Vertex shader for a quad that fills the picture, whose corners are positions in clip space.
void dip_kit_screen_vertex(const DipVertexBatch *batch);

// For vertex shaders whose first three attributes are a position: takes the position to clip space.
void dip_kit_transform(const DipVertexBatch *batch, const float to_clip[16]);

// For vertex shaders: copies `count` attributes to varyings.
void dip_kit_copy(const DipVertexBatch *batch, int attribute, int varying, int count);

// The draws of a pass while they are put together, and the camera that sees them. After a failure,
// a list takes further draws, but dip_kit_show fails.
enum { DIP_KIT_MAX_DRAWS = 32 };

typedef struct DipKitList {
    const DipGalleryView *view;
    DipKitCamera seen;
    DipDraw draws[DIP_KIT_MAX_DRAWS];
    int count;
    bool failed;
    DipError *err; // Filled in by the first failure.
} DipKitList;

// Returns an empty list with the camera of the view's pose.
DipKitList dip_kit_list(const DipGalleryView *view, double near_distance, DipError *err);

// Adds an object that `model` takes to world space, drawn with dip_kit_vertex, and returns the
// draw. The uniforms begin with a DipKitObject, which this function fills in, and must outlive the
// pass.
DipDraw *dip_kit_add(DipKitList *list, const DipMesh *mesh, void *uniforms, const DipMatrix *model,
                     DipFragmentShader *fragment_shader);

// Draws the list into the view's picture.
bool dip_kit_show(const DipKitList *list, const float clear_lin[3]);

// --- meshes --------------------------------------------------------------------------------------

// Make a mesh of a shape (shapes.h).
bool dip_kit_sphere(DipMesh **mesh, float radius, int slices, int stacks, DipError *err);
bool dip_kit_box(DipMesh **mesh, float x, float y, float z, DipError *err);
bool dip_kit_prism(DipMesh **mesh, float radius, float height, int sides, bool smooth,
                   DipError *err);
bool dip_kit_plane(DipMesh **mesh, float size_x, float size_z, int columns, int rows,
                   DipError *err);
bool dip_kit_quad(DipMesh **mesh, float width, float height, DipError *err);

// Makes a mesh of a shape's vertices and frees the shape.
bool dip_kit_mesh(DipMesh **mesh, const char *name, DipShape *shape, DipError *err);

// --- textures ------------------------------------------------------------------------------------

// A texture and its compressed form, which settings with opt=standard or opt=advanced show.
typedef struct DipKitTexture {
    DipTexture *plain;
    DipTexture *compressed; // NULL for textures that hold no colours
} DipKitTexture;

// Computes the sRGB colour and the alpha of the texel at u, v, its centre in 0..1. It may use only
// + - * /, sqrt and functions of the kit, so that all machines have the same texels.
typedef void DipKitPaint(float u, float v, float rgba[4]);

// Makes a texture of painted texels that repeats or, if `clamps` is true, clamps.
bool dip_kit_texture(DipKitTexture *texture, const char *name, int width, int height, bool clamps,
                     DipKitPaint *paint, DipError *err);

// Returns a sampler that reads the texture as the settings of the pane say.
DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture);

// For fragment shaders: reads the first sampler's colours and multiplies them by a colour and by
// the light at each fragment.
void dip_kit_light_texture(DipFragmentBatch *batch, const float colour[3],
                           float (*light)[DIP_FRAGMENT_BATCH]);

// Sets the sampler to show the flat colour of each mip level instead of the texture.
void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view);

// --- content -------------------------------------------------------------------------------------

enum { DIP_KIT_MESHES = 6, DIP_KIT_TEXTURES = 3 };

// Meshes and textures of a scene, which the gallery frees. The content of each scene begins with
// this struct.
typedef struct DipKitStock {
    DipMesh *meshes[DIP_KIT_MESHES];
    DipKitTexture textures[DIP_KIT_TEXTURES];
} DipKitStock;

void dip_kit_stock_free(DipKitStock *stock);

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
