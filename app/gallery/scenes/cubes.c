// Draws the gallery scene "cubes": three cubes, as a picture or as characters. It is the sample
// scene of seed 004; gallery.h says what a seed is.
//
// Two cubes have a colour per corner, and one has texture coordinates; each kind of vertex has its
// own shaders. Two cubes turn in place, while the long one moves to the right and leaves the view.
// Before each frame, bounding boxes decide which cubes are drawn. While the long cube is out of
// view, the first cube has another mesh. One look draws the cubes into a target of characters: a
// function of this file stores each pixel as a char, and a second pass shows the chars.
#include "app/gallery/kit/kit.h"
#include "renderer/pipeline/cull.h"

#include <stdlib.h>
#include <string.h>

enum { CUBE, GEM, TEXTURED, QUAD, OBJECTS = 3, SIDES = 6 };
enum { SIMPLE_ATTRIBUTES = 6, TEXTURE_ATTRIBUTES = 5, GLYPHS = 10, CELL = 8 };

typedef struct Uniforms {
    float to_clip[16];
} Uniforms;

// A target of characters: one char for each pixel of the pass that draws into it.
typedef struct CharTarget {
    char *chars;
    int columns;
    int rows;
    int cell; // Side of a character in the picture, in pixels.
} CharTarget;

typedef struct Content {
    DipPipeline *char_pipeline;
    CharTarget target;
    Uniforms uniforms[OBJECTS];
} Content;

// The characters from dark to bright, and the picture of each character: eight rows of eight dots.
// Bit 7 of a row is the leftmost dot.
static const char ramp[GLYPHS + 1] = " .:-=+*#%@";
static const uint8_t glyphs[GLYPHS][CELL] = {
    {0, 0, 0, 0, 0, 0, 0, 0},
    {0, 0, 0, 0, 0, 0x18, 0x18, 0},
    {0, 0x18, 0x18, 0, 0, 0x18, 0x18, 0},
    {0, 0, 0, 0x7e, 0, 0, 0, 0},
    {0, 0, 0x7e, 0, 0x7e, 0, 0, 0},
    {0, 0x18, 0x18, 0x7e, 0x18, 0x18, 0, 0},
    {0, 0x66, 0x3c, 0xff, 0x3c, 0x66, 0, 0},
    {0x24, 0x24, 0x7e, 0x24, 0x7e, 0x24, 0x24, 0},
    {0x62, 0x64, 0x08, 0x10, 0x26, 0x46, 0, 0},
    {0x3c, 0x42, 0x9a, 0xaa, 0xbc, 0x40, 0x3e, 0},
};

// --- shaders -------------------------------------------------------------------------------------

// Vertex shader for vertices with a position and a colour, which the seed calls SimpleVertex.
static void simple_vertex(const DipVertexBatch *batch) {
    dip_vertices_transform(batch, ((const Uniforms *)batch->uniforms)->to_clip, 4, batch->clip);
    dip_vertices_copy(batch, 3, 0, 3);
}

// Vertex shader for vertices with a position and u, v, which the seed calls TextureVertex.
static void texture_vertex(const DipVertexBatch *batch) {
    dip_vertices_transform(batch, ((const Uniforms *)batch->uniforms)->to_clip, 4, batch->clip);
    dip_vertices_copy(batch, 3, 0, 2);
}

static void shade_colour(DipFragmentBatch *batch) {
    for (int c = 0; c < 3; c++) {
        memcpy(batch->colour[c], batch->varying[c], (size_t)batch->count * sizeof(float));
    }
}

static void shade_texture(DipFragmentBatch *batch) {
    batch->sample_colour(batch, &batch->samplers[0], 0, batch->colour);
}

static int smaller(int a, int b) {
    return a < b ? a : b;
}

// Shows the characters in green on black, as an old terminal does.
static void shade_chars(DipFragmentBatch *batch) {
    const CharTarget *target = batch->uniforms;
    for (int i = 0; i < batch->count; i++) {
        const int x = (int)batch->x[i];
        const int y = (int)batch->y[i];
        const int column = smaller(x / target->cell, target->columns - 1);
        const int row = smaller(y / target->cell, target->rows - 1);
        const char *found = strchr(ramp, target->chars[row * target->columns + column]);
        const int glyph = found ? (int)(found - ramp) : 0;
        const int dot_x = x % target->cell * CELL / target->cell;
        const int dot_y = y % target->cell * CELL / target->cell;
        const float lit = glyph < GLYPHS && glyphs[glyph][dot_y] >> (7 - dot_x) & 1 ? 1.0f : 0.0f;
        dip_kit_set(batch->colour, i, 0.004f + 0.10f * lit, 0.008f + 0.75f * lit,
                    0.006f + 0.16f * lit);
    }
}

// Stores a row of pixels as characters, by their luminance.
static void store_chars(void *context, int x, int y, int count, const float *const colour[4]) {
    const CharTarget *target = context;
    for (int i = 0; i < count; i++) {
        const float light =
            0.2126f * colour[0][i] + 0.7152f * colour[1][i] + 0.0722f * colour[2][i];
        const float step = sqrtf(dip_kit_greatest(light, 0.0f)) * 1.15f * GLYPHS;
        const int glyph = step >= GLYPHS ? GLYPHS - 1 : (int)step;
        target->chars[y * target->columns + x + i] = ramp[glyph];
    }
}

// --- content -------------------------------------------------------------------------------------

// Makes a mesh of SimpleVertex: a cube, or a smaller cube with a pyramid on each face (the gem).
static bool make_simple(DipMesh **mesh, bool gem, DipError *err) {
    static const float size[3] = {2.0f, 2.0f, 2.0f};
    float vertices[SIDES * 5][SIMPLE_ATTRIBUTES];
    uint32_t indices[SIDES * 12];
    uint32_t count = 0;
    DipShape box;
    if (!dip_shape_box(&box, size, err)) {
        return false;
    }
    for (uint32_t f = 0; f < SIDES; f++) {
        float *middle = vertices[5 * f + 4];
        const float *normal = box.attributes + (size_t)(4 * f) * DIP_SHAPE_ATTRIBUTES + 3;
        for (uint32_t k = 0; k < 4; k++) {
            const float *corner = box.attributes + (size_t)(4 * f + k) * DIP_SHAPE_ATTRIBUTES;
            for (int i = 0; i < 3; i++) {
                vertices[5 * f + k][i] = gem ? 0.62f * corner[i] : corner[i];
                vertices[5 * f + k][3 + i] = 0.08f + 0.42f * (corner[i] + 1.0f);
            }
            const uint32_t triangle[3] = {5 * f + k, 5 * f + (k + 1) % 4, 5 * f + 4};
            memcpy(indices + count, triangle, sizeof triangle);
            count += 3;
        }
        for (int i = 0; i < 3; i++) {
            middle[i] = normal[i] * (gem ? 1.75f : 1.0f);
            middle[3 + i] = gem ? 0.95f : 0.08f + 0.42f * (normal[i] + 1.0f);
        }
    }
    dip_shape_free(&box);
    const DipMeshData data = {
        gem ? "gem" : "cube", &vertices[0][0], SIMPLE_ATTRIBUTES, SIDES * 5, indices, count};
    *mesh = dip_mesh_create(&data, err);
    return *mesh != NULL;
}

// Makes a mesh of TextureVertex: a cube whose faces show the whole texture.
static bool make_textured(DipMesh **mesh, DipError *err) {
    static const float size[3] = {2.0f, 2.0f, 2.0f};
    float vertices[SIDES * 4][TEXTURE_ATTRIBUTES];
    DipShape box;
    if (!dip_shape_box(&box, size, err)) {
        return false;
    }
    for (uint32_t v = 0; v < box.vertex_count; v++) {
        const float *corner = box.attributes + (size_t)v * DIP_SHAPE_ATTRIBUTES;
        memcpy(vertices[v], corner, 3 * sizeof(float));
        memcpy(vertices[v] + 3, corner + DIP_SHAPE_TEXTURE, 2 * sizeof(float));
    }
    const DipMeshData data = {"textured",       &vertices[0][0], TEXTURE_ATTRIBUTES,
                              box.vertex_count, box.indices,     box.index_count};
    *mesh = dip_mesh_create(&data, err);
    dip_shape_free(&box);
    return *mesh != NULL;
}

// Paints a wooden crate: boards, a frame around them and a diagonal.
static void paint_crate(float u, float v, float rgba[4]) {
    const bool upright = dip_kit_to_edge(u) < 0.12f; // The grain runs upwards in these boards.
    const bool frame = upright || dip_kit_to_edge(v) < 0.12f || fabsf(u - v) < 0.085f;
    const float gap = frame ? 1.0f : dip_kit_smooth(0.0f, 0.08f, dip_kit_to_edge(v * 6.0f));
    const float grain =
        dip_kit_turbulence(4.0f * (upright ? v : u), 48.0f * (upright ? u : v), 48, 4, 5);
    const float light = (frame ? 0.92f : 0.62f) * (0.62f + 0.5f * grain) * (0.35f + 0.65f * gap);
    rgba[0] = 0.86f * light;
    rgba[1] = 0.66f * light;
    rgba[2] = 0.42f * light;
}

static void destroy(void *pointer) {
    Content *content = pointer;
    dip_pipeline_destroy(&content->char_pipeline);
    free(content->target.chars);
}

static bool create(DipGalleryRoom *room, DipError *err) {
    DipMesh **meshes = room->stock.meshes;
    return make_simple(&meshes[CUBE], false, err) && make_simple(&meshes[GEM], true, err) &&
           make_textured(&meshes[TEXTURED], err);
}

// Makes the target of characters for the view's picture, unless the last frame had the same number
// of columns and rows.
static bool prepare_chars(const DipGalleryView *view, DipError *err) {
    const int width = view->target.width;
    const int height = view->target.height;
    Content *content = view->content;
    CharTarget *target = &content->target;
    const int cell = height / 60 > CELL ? height / 60 : CELL;
    const int columns = (width + cell - 1) / cell;
    const int rows = (height + cell - 1) / cell;
    if (target->chars && content->char_pipeline && columns == target->columns &&
        rows == target->rows) {
        target->cell = cell;
        return true;
    }
    destroy(content);
    *target = (CharTarget){calloc((size_t)columns, (size_t)rows), columns, rows, cell};
    content->char_pipeline =
        dip_pipeline_create(view->def->pool, view->def->isa, columns, rows, err);
    return content->char_pipeline &&
           (target->chars || dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "cubes",
                                           "no memory for %dx%d characters", columns, rows));
}

// --- drawing -------------------------------------------------------------------------------------

static DipGalleryCamera camera(double turn) {
    return (DipGalleryCamera){.eye = {0.6 * dip_sin(turn), 1.5 + 0.4 * dip_cos(turn), 9.6}};
}

// Returns the matrix that takes an object to world space. Two objects turn in place. The long one,
// index 1, moves to the right and comes back by the end of the loop.
static DipMatrix place(int index, double turn) {
    if (index == 1) {
        const double way = 0.5 - 0.5 * dip_cos(turn);
        return dip_kit_chain3(dip_matrix_translation(11.0 * way, -0.2, -1.0),
                              dip_matrix_rotation(1, 0.4), dip_matrix_scaling(0.55, 1.7, 0.55));
    }
    return dip_kit_chain3(dip_matrix_translation(index ? 2.9 : -2.9, 0.0, index ? 0.6 : 0.0),
                          dip_matrix_rotation(0, 0.5),
                          dip_matrix_rotation(1, (index ? -2.0 : 3.0) * turn + 0.6));
}

// Returns whether some part of a mesh may be in view.
static bool in_view(const DipMesh *mesh, const DipMatrix *to_clip) {
    const DipCullPlanes planes = dip_cull_view_planes(to_clip->m);
    const DipBox box = dip_mesh_box(mesh);
    return !dip_cull_outside(&planes, &box);
}

// Fills in the draws of the objects in view and returns their number.
static int list_objects(const DipGalleryView *view, const DipKitCamera *seen,
                        const DipSampler *wood, DipDraw draws[OBJECTS]) {
    Content *content = view->content;
    DipMesh *const *meshes = view->stock->meshes;
    int count = 0;
    bool long_cube_seen = true;
    // Cube 0 comes last, since its mesh depends on whether cube 1 is in view.
    for (int i = OBJECTS - 1; i >= 0; i--) {
        const DipMatrix to_clip = dip_kit_chain(seen->to_clip, place(i, view->turn));
        const int mesh = i == 2 ? TEXTURED : i == 1 || long_cube_seen ? CUBE : GEM;
        if (!in_view(meshes[mesh], &to_clip)) {
            long_cube_seen = long_cube_seen && i != 1;
            view->counters->draws_culled++;
            continue;
        }
        dip_matrix_floats(&to_clip, content->uniforms[i].to_clip);
        draws[count++] = (DipDraw){
            .mesh = meshes[mesh],
            .vertex_shader = mesh == TEXTURED ? texture_vertex : simple_vertex,
            .fragment_shader = mesh == TEXTURED ? shade_texture : shade_colour,
            .varying_count = mesh == TEXTURED ? 2 : 3,
            .value_only_varying_count = mesh == TEXTURED ? 0 : 3,
            .uniforms = &content->uniforms[i],
            .samplers = wood,
            .cull = DIP_CULL_BACK,
        };
    }
    return count;
}

static bool draw_chars(const DipGalleryView *view, DipPass *pass, DipError *err) {
    static const float black[3] = {0.0f, 0.0f, 0.0f};
    Content *content = view->content;
    CharTarget *chars = &content->target;
    if (!prepare_chars(view, err)) {
        return false;
    }
    memcpy(pass->clear_lin, black, sizeof black);
    pass->target = (DipTarget){.width = chars->columns,
                               .height = chars->rows,
                               .format = DIP_FORMAT_CALLER,
                               .store = store_chars,
                               .context = chars};
    if (!dip_kit_draw(view, content->char_pipeline, pass, err)) {
        return false;
    }
    const DipDraw screen = {.mesh = view->stock->meshes[QUAD],
                            .vertex_shader = dip_kit_screen_vertex,
                            .fragment_shader = shade_chars,
                            .uniforms = chars};
    const DipPass show = dip_kit_pass(view, &screen, 1, black);
    return dip_kit_draw(view, view->pipeline, &show, err);
}

static bool draw(const DipGalleryView *view, DipError *err) {
    static const float clear_lin[3] = {0.10f, 0.13f, 0.18f};
    DipKitCamera seen;
    DipDraw draws[OBJECTS];
    const DipSampler wood = dip_kit_sampler(view, &view->stock->textures[0]);
    if (!dip_kit_camera(&seen, view, 0.1, err)) {
        return false;
    }
    const int count = list_objects(view, &seen, &wood, draws);
    DipPass pass = dip_kit_pass(view, draws, count, clear_lin);
    return view->look == 1 ? draw_chars(view, &pass, err)
                           : dip_kit_draw(view, view->pipeline, &pass, err);
}

const DipGalleryScene dip_gallery_cubes = {
    .info = {.name = "cubes",
             .title = "Cubes on two targets",
             .text =
                 "Objects with their own vertex types and shaders, culled by their bounds. When "
                 "the long cube has left the view, the left one changes its mesh.",
             DIP_KIT_LOOKS("colour target", "character target")},
    .meshes = {[QUAD] = {DIP_KIT_QUAD, {2.0f, 2.0f}}},
    .textures = {{"crate", 256, 256, DIP_WRAP_CLAMP, paint_crate}},
    .content_bytes = sizeof(Content),
    .camera = camera,
    .create = create,
    .destroy = destroy,
    .draw = draw,
};
