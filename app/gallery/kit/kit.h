// What a scene of the gallery consists of, what it gets to draw a frame with, and the kit: what
// several scenes share. The kit makes meshes and painted textures, turns a pose into matrices and
// settings into a pass and samplers, and has the vertex shader that most scenes use.
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
    DIP_KIT_NO_SHAPE, // The scene makes the mesh itself.
    DIP_KIT_SPHERE,   // radius, slices, stacks
    DIP_KIT_BOX,      // lengths along x, y and z
    DIP_KIT_PRISM,    // radius, height, sides, 1 for smooth normals or 0
    DIP_KIT_PLANE,    // lengths along x and z, columns, rows
    DIP_KIT_QUAD,     // width, height
    // The die of seed 001: a cube with edges of length 1. Face i shows the sixth number i of the
    // texture's width, as the seed computes it. Opposite faces add up to seven.
    DIP_KIT_DIE
} DipKitShape;

// A mesh to make: a shape, and the arguments of the shape's function in shapes.h, in its order.
typedef struct DipKitMeshDef {
    DipKitShape shape;
    float arguments[4];
} DipKitMeshDef;

// Makes the shape DIP_KIT_DIE, as the functions of shapes.h make theirs.
bool dip_kit_die_shape(DipShape *shape, DipError *err);

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

// A texture to make of painted texels.
typedef struct DipKitTextureDef {
    const char *name;
    int width, height; // texels
    DipWrap wrap;
    DipKitPaint *paint; // NULL: the scene makes the texture itself, or there is none.
} DipKitTextureDef;

// Paints the die's faces: six squares side by side, with one to six pips.
void dip_kit_paint_die(float u, float v, float rgba[4]);
#define DIP_KIT_DIE_TEXTURE                                                                        \
    { "die", 6 * 128, 128, DIP_WRAP_CLAMP, dip_kit_paint_die }

// --- scenes --------------------------------------------------------------------------------------

enum { DIP_KIT_MESHES = 6, DIP_KIT_TEXTURES = 3 };

// Meshes and textures of a scene, which the gallery frees.
typedef struct DipKitStock {
    DipMesh *meshes[DIP_KIT_MESHES];
    DipKitTexture textures[DIP_KIT_TEXTURES];
} DipKitStock;

// What a scene uses while it exists.
typedef struct DipGalleryRoom {
    const DipGalleryDef *def; // of the gallery
    DipKitStock stock;
    void *content; // what else the scene keeps, DipGalleryScene.content_bytes long
} DipGalleryRoom;

// A frame that a scene draws. Settings are those of the pane.
typedef struct DipGalleryView {
    const DipGalleryDef *def; // of the gallery
    DipKitStock *stock;
    void *content;
    const DipPose *pose;
    double time_s; // since the scene began, 0..DIP_GALLERY_SECONDS
    float turns;   // the same time as a share of DIP_GALLERY_SECONDS, 0..1
    double turn;   // the same time as the angle that a loop turns by, 0..2 pi
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
    DipKitMeshDef meshes[DIP_KIT_MESHES]; // The gallery makes these meshes and textures.
    DipKitTextureDef textures[DIP_KIT_TEXTURES];
    size_t content_bytes; // Size of what else the scene keeps; zeroed before the first frame.
    // turn: the time as an angle, 0..2 pi. Both ends have the same camera.
    DipGalleryCamera (*camera)(double turn);
    // Makes the other meshes and textures of the stock, and the content. NULL: there are none.
    bool (*create)(DipGalleryRoom *room, DipError *err);
    // Frees what the content owns, even if `create` has failed. NULL: it owns nothing.
    void (*destroy)(void *content);
    bool (*draw)(const DipGalleryView *view, DipError *err);
} DipGalleryScene;

// Lists the names of a scene's looks (DipGalleryInfo).
#define DIP_KIT_LOOKS(...)                                                                         \
    .looks = (const char *const[]){__VA_ARGS__},                                                   \
    .look_count = (int)(sizeof((const char *const[]){__VA_ARGS__}) / sizeof(const char *))

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

// Make and free the meshes and textures that a scene describes. dip_kit_stock_create leaves what it
// has made in the stock even if it fails.
bool dip_kit_stock_create(DipKitStock *stock, const DipGalleryScene *scene, DipError *err);
void dip_kit_stock_free(DipKitStock *stock);

// Writes the name of an asset's file. Fails with OVERSIZED if the name does not fit; `scene` is the
// error's key.
bool dip_kit_asset(char *file, size_t size_bytes, const DipGalleryDef *def, const char *asset,
                   const char *scene, DipError *err);

// Makes the memory of a picture, which dip_lines_free frees. Fails with MEMORY; `key` is the
// error's key, and target->rgba8 is then NULL.
bool dip_kit_target(DipTarget *target, int width, int height, const char *key, DipError *err);

// --- cameras and passes --------------------------------------------------------------------------

typedef struct DipKitCamera {
    DipMatrix view;
    DipMatrix to_clip; // from world space
    float eye[3];      // in world space
} DipKitCamera;

// Makes the matrices of the view's pose.
bool dip_kit_camera(DipKitCamera *camera, const DipGalleryView *view, double near_distance,
                    DipError *err);

// Makes the matrices of a camera, or of a light.
bool dip_kit_look_at(DipKitCamera *camera, const DipGalleryCamera *from, const DipPerspective *lens,
                     DipError *err);

// Return a * b and a * b * c, which apply the last matrix first.
DipMatrix dip_kit_chain(DipMatrix a, DipMatrix b);
DipMatrix dip_kit_chain3(DipMatrix a, DipMatrix b, DipMatrix c);

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

enum { DIP_KIT_MAX_DRAWS = 32, DIP_KIT_UNIFORM_DOUBLES = 64 };

// The draws of a pass while they are put together, and the camera that sees them. After a failure,
// a list takes further draws, but dip_kit_show fails. The draws refer to the list's own uniforms,
// so a list with draws must not be copied.
typedef struct DipKitList {
    const DipGalleryView *view;
    DipKitCamera seen;
    DipDraw draws[DIP_KIT_MAX_DRAWS];
    double uniforms[DIP_KIT_MAX_DRAWS][DIP_KIT_UNIFORM_DOUBLES]; // of each draw
    int count;
    bool failed;
    DipError *err; // Filled in by the first failure.
} DipKitList;

// Returns an empty list with the camera of the view's pose.
DipKitList dip_kit_list(const DipGalleryView *view, double near_distance, DipError *err);

// Adds an object that `model` takes to world space, drawn with dip_kit_vertex, and returns the
// draw. The list keeps a copy of the uniforms, which begin with a DipKitObject that this function
// fills in.
DipDraw *dip_kit_add_bytes(DipKitList *list, const DipMesh *mesh, const void *uniforms,
                           size_t size_bytes, const DipMatrix *model,
                           DipFragmentShader *fragment_shader);

// The same. uniforms: a pointer to a struct.
#define dip_kit_add(list, mesh, uniforms, model, fragment_shader)                                  \
    dip_kit_add_bytes(list, mesh, uniforms, sizeof *(uniforms), model, fragment_shader)

// Draws the list into the view's picture.
bool dip_kit_show(const DipKitList *list, const float clear_lin[3]);

// --- shading -------------------------------------------------------------------------------------

// Returns a sampler that reads the texture as the settings of the pane say.
DipSampler dip_kit_sampler(const DipGalleryView *view, const DipKitTexture *texture);

// Sets the sampler to show the flat colour of each mip level instead of the texture.
void dip_kit_show_mip_colours(DipSampler *sampler, const DipGalleryView *view);

// For fragment shaders: reads the first sampler's colours and multiplies them by a colour and by
// the light at each fragment.
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

// Returns element i of three arrays, for example of the varyings from one on: batch->varying +
// DIP_KIT_NORMAL.
static inline DipKitVector dip_kit_get(float (*arrays)[DIP_FRAGMENT_BATCH], int i) {
    return dip_kit_xyz(arrays[0][i], arrays[1][i], arrays[2][i]);
}

// Sets element i of three arrays, for example of batch->colour.
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

// Returns 1 / length. tiny: is added to the length's square, so that a vector of length 0 is safe.
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

// Returns the distance from x to the nearest whole number: to the edge of a tile of size 1.
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

// Returns about sin(2 pi turns), for |turns| < 2^22, with an error below 0.0012. It uses + - *
// only, so that a loop over a batch becomes vector code with the same bits everywhere.
static inline float dip_kit_wave(float turns) {
    const float t = turns - dip_kit_floor(turns) - 0.5f; // -0.5..0.5; its sine is negated
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
