// Declares what a scene of the gallery consists of, and what the scene is given to draw a frame.
// Also declares the kit, which is the code that several scenes share. It makes meshes and textures,
// turns a pose into matrices, turns image-quality settings into a pass and samplers, and has the
// vertex shader that most scenes use.
#ifndef DIP_APP_GALLERY_KIT_KIT_H
#define DIP_APP_GALLERY_KIT_KIT_H

#include "app/gallery/gallery.h"
#include "renderer/base/trig.h"
#include "renderer/pipeline/pipeline.h"
#include "renderer/shapes/camera.h"
#include "renderer/shapes/shapes.h"

#include <math.h>

// --- meshes --------------------------------------------------------------------------------------

typedef enum DipKitShape {
    DIP_KIT_NO_SHAPE, // The scene makes the mesh itself or has none.
    DIP_KIT_SPHERE,   // Arguments: radius, slices, stacks.
    DIP_KIT_BOX,      // Arguments: lengths along x, y and z.
    DIP_KIT_PRISM,    // Arguments: radius, height, sides, and 1 for smooth or 0 for flat normals.
    DIP_KIT_PLANE,    // Arguments: lengths along x and z, columns, rows.
    DIP_KIT_QUAD,     // Arguments: width, height.
    // The die of seed 001 (gallery.h): a cube with edges of length 1. It has no arguments. Each
    // face shows another sixth of the texture's width, which holds the faces of one to six
    // pips side by side. The pips of opposite faces add up to seven.
    DIP_KIT_DIE
} DipKitShape;

// A mesh that the gallery makes for a scene: a shape, and the arguments of the function in shapes.h
// that makes this shape, in the function's order.
typedef struct DipKitMeshDef {
    DipKitShape shape;
    float arguments[4];
} DipKitMeshDef;

// Makes a mesh from a shape and frees the shape, even on failure.
bool dip_kit_mesh(DipMesh **mesh, const char *name, DipShape *shape, DipError *err);

// --- textures ------------------------------------------------------------------------------------

// A texture and its compressed form. dip_quality_compresses says with which settings the
// compressed form is drawn.
typedef struct DipKitTexture {
    DipTexture *plain;
    DipTexture *compressed; // NULL if `plain` is drawn with all settings.
} DipKitTexture;

// A function that computes the sRGB colour and the alpha of the texel with the centre u, v (0..1).
// All values are 0..1; before the call, rgba is opaque black. The function may use only + - * /,
// sqrt, fabs and functions of the kit, so that all machines have the same texels.
typedef void DipKitPaint(float u, float v, float rgba[4]);

// A texture that the gallery makes for a scene, by computing each texel.
typedef struct DipKitTextureDef {
    const char *name;
    int width, height; // Texels.
    DipWrap wrap;
    DipKitPaint *paint; // NULL if the scene makes the texture itself or has none.
} DipKitTextureDef;

// Paints the die's faces: six squares side by side, with one to six pips.
void dip_kit_paint_die(float u, float v, float rgba[4]);
#define DIP_KIT_DIE_TEXTURE                                                                        \
    { "die", 6 * 128, 128, DIP_WRAP_CLAMP, dip_kit_paint_die }

// --- scenes --------------------------------------------------------------------------------------

enum { DIP_KIT_MESHES = 6, DIP_KIT_TEXTURES = 3 };

// The meshes and textures of a scene. The gallery frees them.
typedef struct DipKitStock {
    DipMesh *meshes[DIP_KIT_MESHES];
    DipKitTexture textures[DIP_KIT_TEXTURES];
} DipKitStock;

// The data of a scene while the scene is open.
typedef struct DipGalleryRoom {
    const DipGalleryDef *def; // Definition of the gallery.
    DipKitStock stock;
    void *content; // The scene's own data, of DipGalleryScene.content_bytes bytes.
} DipGalleryRoom;

// What a scene gets to draw a frame of a pane.
typedef struct DipGalleryView {
    const DipGalleryDef *def; // Definition of the gallery.
    DipKitStock *stock;
    void *content; // The scene's own data.
    const DipPose *pose;
    double time_s;             // Time since the scene began, 0..DIP_GALLERY_SECONDS.
    float turns;               // The same time divided by DIP_GALLERY_SECONDS, 0..1.
    double turn;               // The same time as an angle, 0..2 pi.
    int look;                  // Index of the look (DipGalleryInfo), 0..look_count - 1.
    const DipQuality *quality; // The pane's settings.
    DipPatternKind pattern;
    DipTarget target;              // The pane's picture, of the format DIP_FORMAT_SRGB8.
    DipPipeline *pipeline;         // A pipeline of the picture's size.
    DipSampler filter;             // A sampler that filters as the settings say, without a texture.
    const DipTexture *mip_colours; // See dip_mip_debug_create (mip_debug.h).
    DipPipelineCounters *counters;
    DipStageTimes *times;
} DipGalleryView;

// The position of a scene's camera, and the point at which it looks.
typedef struct DipGalleryCamera {
    double eye[3];
    double target[3];
} DipGalleryCamera;

// The definition of a scene.
typedef struct DipGalleryScene {
    DipGalleryInfo info;
    DipKitMeshDef meshes[DIP_KIT_MESHES];        // Meshes that the gallery makes.
    DipKitTextureDef textures[DIP_KIT_TEXTURES]; // Textures that the gallery makes.
    size_t content_bytes; // Size of the scene's own data, which is zeroed when the scene opens.
    // Returns the camera at a time, given as an angle of 0..2 pi. 0 and 2 pi give the same camera.
    DipGalleryCamera (*camera)(double turn);
    // Makes the scene's own data, and those meshes and textures that the gallery does not make. May
    // be NULL.
    bool (*create)(DipGalleryRoom *room, DipError *err);
    // Frees what the scene's own data owns, even if `create` has failed. May be NULL.
    void (*destroy)(void *content);
    // Draws a frame.
    bool (*draw)(const DipGalleryView *view, DipError *err);
} DipGalleryScene;

// Sets the names of a scene's looks and their number (DipGalleryInfo).
#define DIP_KIT_LOOKS(...)                                                                         \
    .looks = (const char *const[]){__VA_ARGS__},                                                   \
    .look_count = (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

// Lists the scenes, in the order of the tour.
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

// These functions make and free the meshes and textures that a scene describes.
// dip_kit_stock_create leaves what it has made in the stock even if it fails.
bool dip_kit_stock_create(DipKitStock *stock, const DipGalleryScene *scene, DipError *err);
void dip_kit_stock_free(DipKitStock *stock);

// Writes the name of an asset's file with its folder. Fails with OVERSIZED if the name does not
// fit; `scene` becomes the error's key.
bool dip_kit_asset(char *file, size_t size_bytes, const DipGalleryDef *def, const char *asset,
                   const char *scene, DipError *err);

// Makes a target and allocates its pixels, which dip_lines_free frees. Fails with MEMORY; `key`
// becomes the error's key, and target->rgba8 is then NULL.
bool dip_kit_target(DipTarget *target, int width, int height, const char *key, DipError *err);

// --- cameras and passes --------------------------------------------------------------------------

typedef struct DipKitCamera {
    DipMatrix view;
    DipMatrix to_clip; // From world space to clip space.
    float eye[3];      // Position in world space.
} DipKitCamera;

// Makes the matrices of a camera that has the view's pose.
bool dip_kit_camera(DipKitCamera *camera, const DipGalleryView *view, double near_distance,
                    DipError *err);

// Makes the matrices of a camera at from->eye that looks at from->target. The camera may also stand
// for a light.
bool dip_kit_look_at(DipKitCamera *camera, const DipGalleryCamera *from, const DipPerspective *lens,
                     DipError *err);

// These functions return the products a * b and a * b * c, which apply the last matrix first.
DipMatrix dip_kit_chain(DipMatrix a, DipMatrix b);
DipMatrix dip_kit_chain3(DipMatrix a, DipMatrix b, DipMatrix c);

// Returns a pass that draws into the view's picture, with the samples of the pane's settings. The
// clear colour is in linear light.
DipPass dip_kit_pass(const DipGalleryView *view, const DipDraw *draws, int draw_count,
                     const float clear_lin[3]);

// Draws a pass with a pipeline of the pass's size. Adds the pass's work and times to the view's
// counters and times.
bool dip_kit_draw(const DipGalleryView *view, DipPipeline *pipeline, const DipPass *pass,
                  DipError *err);

// --- objects -------------------------------------------------------------------------------------

// Uniforms that dip_kit_vertex reads. A scene's own uniforms begin with this struct.
typedef struct DipKitObject {
    float to_clip[16];
    float to_world[16];
    float normals[9]; // Takes normals to world space; the results are not of unit length.
    float eye[3];     // The camera's position in world space.
} DipKitObject;

// Varyings that dip_kit_vertex writes.
enum {
    DIP_KIT_UV = 0,     // Texture coordinates u, v.
    DIP_KIT_NORMAL = 2, // Normal x, y, z in world space, not of unit length.
    DIP_KIT_WORLD = 5,  // Position x, y, z in world space.
    DIP_KIT_VARYINGS = 8,
    DIP_KIT_VALUES_ONLY = 6 // The last six varyings, normal and position, have no derivatives.
};

// Vertex shader for meshes with the attributes of a shape (shapes.h).
void dip_kit_vertex(const DipVertexBatch *batch);

// Vertex shader for a quad that fills the picture. The corners' x and y are in clip space.
void dip_kit_screen_vertex(const DipVertexBatch *batch);

enum { DIP_KIT_MAX_DRAWS = 32, DIP_KIT_UNIFORM_DOUBLES = 64 };

// A list of draws to which a scene adds its objects, and the camera that sees them. If adding an
// object fails, other objects can still be added, but dip_kit_show then fails. The draws point into
// the list's own uniforms, so a list with draws must not be copied.
typedef struct DipKitList {
    const DipGalleryView *view;
    DipKitCamera seen; // The camera that sees the draws.
    DipDraw draws[DIP_KIT_MAX_DRAWS];
    double uniforms[DIP_KIT_MAX_DRAWS][DIP_KIT_UNIFORM_DOUBLES]; // [draw]
    int count;
    bool failed;
    DipError *err; // Filled in by the first failure.
} DipKitList;

// Returns an empty list with the camera of the view's pose.
DipKitList dip_kit_list(const DipGalleryView *view, double near_distance, DipError *err);

// Adds an object and returns its draw, which the caller may change. `model` takes the object to
// world space, and the vertex shader is dip_kit_vertex. The uniforms begin with a DipKitObject. The
// list keeps a copy of the uniforms, and this function fills in the copy's DipKitObject.
DipDraw *dip_kit_add_bytes(DipKitList *list, const DipMesh *mesh, const void *uniforms,
                           size_t size_bytes, const DipMatrix *model,
                           DipFragmentShader *fragment_shader);

// Calls dip_kit_add_bytes with the size of *uniforms. `uniforms` points to a struct.
#define dip_kit_add(list, mesh, uniforms, model, fragment_shader)                                  \
    dip_kit_add_bytes(list, mesh, uniforms, sizeof *(uniforms), model, fragment_shader)

// Draws the list into the view's picture.
bool dip_kit_show(const DipKitList *list, const float clear_lin[3]);

// --- shading -------------------------------------------------------------------------------------

// Returns a sampler that reads and filters the texture as the pane's settings say.
DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture);

// Sets the sampler to show the flat colour of each mip level instead of the texture.
void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view);

// Reads the colours of the first sampler, multiplies them by `colour` and by the light at each
// fragment, and writes them to batch->colour. For fragment shaders.
void dip_kit_light_texture(DipFragmentBatch *batch, const float colour[3],
                           float (*light)[DIP_FRAGMENT_BATCH]);

// --- vectors -------------------------------------------------------------------------------------

typedef struct DipKitVector {
    float x, y, z;
} DipKitVector;

static inline DipKitVector dip_kit_xyz(float x, float y, float z) {
    const DipKitVector v = {x, y, z};
    return v;
}

static inline DipKitVector dip_kit_vector(const float v[3]) {
    return dip_kit_xyz(v[0], v[1], v[2]);
}

// Returns element i of three successive arrays, for example of batch->varying + DIP_KIT_NORMAL.
static inline DipKitVector dip_kit_get(float (*arrays)[DIP_FRAGMENT_BATCH], int i) {
    return dip_kit_xyz(arrays[0][i], arrays[1][i], arrays[2][i]);
}

// Sets element i of three successive arrays, for example of batch->colour.
static inline void dip_kit_set(float (*arrays)[DIP_FRAGMENT_BATCH], int i, float x, float y,
                               float z) {
    arrays[0][i] = x;
    arrays[1][i] = y;
    arrays[2][i] = z;
}

static inline void dip_kit_put(float (*arrays)[DIP_FRAGMENT_BATCH], int i, DipKitVector v) {
    dip_kit_set(arrays, i, v.x, v.y, v.z);
}

static inline DipKitVector dip_kit_plus(DipKitVector a, DipKitVector b) {
    return dip_kit_xyz(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline DipKitVector dip_kit_minus(DipKitVector a, DipKitVector b) {
    return dip_kit_xyz(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline DipKitVector dip_kit_times(DipKitVector v, float factor) {
    return dip_kit_xyz(v.x * factor, v.y * factor, v.z * factor);
}

static inline float dip_kit_dot(DipKitVector a, DipKitVector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Returns 1 / length. `tiny` is added to the square of the length, so that a vector of length 0
// causes no division by 0.
static inline float dip_kit_per_length(DipKitVector v, float tiny) {
    return 1.0f / sqrtf(dip_kit_dot(v, v) + tiny);
}

// --- numbers -------------------------------------------------------------------------------------

static inline float dip_kit_clamp(float x, float least, float greatest) {
    return x < least ? least : x > greatest ? greatest : x;
}

static inline float dip_kit_least(float a, float b) {
    return a < b ? a : b;
}

static inline float dip_kit_greatest(float a, float b) {
    return a > b ? a : b;
}

// Returns 0 if x is at `from` or beyond, 1 if it is at `to` or beyond, and a smooth transition
// between them. `from` may be greater than `to`.
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

// Returns the distance from x to the nearest whole number. If tiles have the size 1, this is the
// distance to the nearest edge of a tile.
static inline float dip_kit_to_edge(float x) {
    const float share = x - dip_kit_floor(x);
    return share < 0.5f ? share : 1.0f - share;
}

// Returns x to the power of 2^doublings.
static inline float dip_kit_power(float x, int doublings) {
    for (int i = 0; i < doublings; i++) {
        x *= x;
    }
    return x;
}

// Returns sin(2 pi turns), for |turns| < 2^22, with an error below 0.0012. Uses only + - *, so that
// a loop over a batch becomes vector code with the same bits on all machines.
static inline float dip_kit_wave(float turns) {
    const float t =
        turns - dip_kit_floor(turns) - 0.5f; // Half a turn less, so the sine is negated.
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

// Returns the weighted mean of several octaves of smooth noise, 0..1. It repeats along x and y
// after `period` units.
float dip_kit_turbulence(float x, float y, int period, int octaves, int seed);

#endif
