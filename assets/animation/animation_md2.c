// Reads MD2 files, the models of Quake II: key frames that share triangles and texture coordinates.
//
// A file has one index for the position and one for the texture coordinates of each corner. Each
// pair of them that occurs becomes a vertex, so that the same vertices hold in all frames.
#include "assets/animation/animation_parts.h"
#include "renderer/base/file.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const size_t max_file_bytes = (size_t)512 << 20;
static const double frames_per_s = 10.0; // as in the games

// The numbers of the header, in their order; each has 32 bits, low byte first.
enum {
    HEADER_MAGIC,
    HEADER_VERSION,
    HEADER_SKIN_WIDTH,
    HEADER_SKIN_HEIGHT,
    HEADER_FRAME_BYTES,
    HEADER_SKIN_COUNT,
    HEADER_POINT_COUNT,
    HEADER_COORDINATE_COUNT,
    HEADER_TRIANGLE_COUNT,
    HEADER_COMMAND_COUNT,
    HEADER_FRAME_COUNT,
    HEADER_SKINS,
    HEADER_COORDINATES,
    HEADER_TRIANGLES,
    HEADER_FRAMES,
    HEADER_COMMANDS,
    HEADER_END,
    HEADER_COUNT
};

enum {
    MAGIC = 0x32504449, // "IDP2"
    VERSION = 8,
    SKIN_BYTES = 64,
    COORDINATE_BYTES = 4,
    TRIANGLE_BYTES = 12,
    POINT_BYTES = 4,
    FRAME_HEADER_BYTES = 40,
    FRAME_NAME_AT = 24,
    FRAME_NAME_BYTES = 16
};

// A corner of a triangle: its point and its texture coordinates.
typedef struct Corner {
    uint32_t key; // point << 16 | coordinates
    uint32_t index;
} Corner;

typedef struct Md2 {
    DipAnimatedModel *model;
    const uint8_t *bytes;
    size_t size_bytes;
    int64_t header[HEADER_COUNT];
    Corner *corners; // 3 per triangle, ordered by key
    DipError *err;
} Md2;

static bool refuse(const Md2 *md2, DipErrorCode code, int64_t found, const char *what,
                   const char *accepted) {
    return dip_error_set(md2->err, code, md2->model->path, 0, NULL,
                         "the MD2 file has %lld %s, accepted %s", (long long)found, what, accepted);
}

static uint32_t read_u16(const uint8_t *at) {
    return at[0] | (uint32_t)at[1] << 8;
}

static int32_t read_i32(const uint8_t *at) {
    return (int32_t)(read_u16(at) | read_u16(at + 2) << 16);
}

static float read_float(const uint8_t *at) {
    const int32_t bits = read_i32(at);
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

// --- the header ----------------------------------------------------------------------------------

// Checks that a section lies within the file.
static bool check_section(const Md2 *md2, const char *name, int64_t count, int64_t least,
                          int64_t item_bytes, int64_t offset) {
    if (count < least) {
        return refuse(md2, least == 0 ? DIP_ERROR_RANGE : DIP_ERROR_MISSING, count, name,
                      least == 0 ? "at least 0" : "at least 1");
    }
    if (count > 0 && (offset < 4 * HEADER_COUNT || offset > (int64_t)md2->size_bytes ||
                      count > ((int64_t)md2->size_bytes - offset) / item_bytes)) {
        return dip_error_set(md2->err, DIP_ERROR_TRUNCATED, md2->model->path, 0, NULL,
                             "the MD2 file of %zu bytes is too short for %lld %s at byte %lld",
                             md2->size_bytes, (long long)count, name, (long long)offset);
    }
    return true;
}

static bool read_header(Md2 *md2) {
    int64_t *header = md2->header;
    if (md2->size_bytes < 4 * HEADER_COUNT) {
        return dip_error_set(md2->err, DIP_ERROR_TRUNCATED, md2->model->path, 0, NULL,
                             "the model file ends too early");
    }
    for (size_t i = 0; i < HEADER_COUNT; ++i) {
        header[i] = read_i32(md2->bytes + 4 * i);
    }
    if (header[HEADER_MAGIC] != MAGIC || header[HEADER_VERSION] != VERSION) {
        return dip_error_set(md2->err, DIP_ERROR_FORMAT, md2->model->path, 0, NULL,
                             "the file does not begin like an MD2 file, accepted IDP2, version 8");
    }
    const int64_t points = header[HEADER_POINT_COUNT];
    const int64_t frame_bytes = header[HEADER_FRAME_BYTES];
    return check_section(md2, "triangles", header[HEADER_TRIANGLE_COUNT], 1, TRIANGLE_BYTES,
                         header[HEADER_TRIANGLES]) &&
           check_section(md2, "skins", header[HEADER_SKIN_COUNT], 0, SKIN_BYTES,
                         header[HEADER_SKINS]) &&
           check_section(md2, "texture coordinates", header[HEADER_COORDINATE_COUNT], 0,
                         COORDINATE_BYTES, header[HEADER_COORDINATES]) &&
           (points >= 1 || refuse(md2, DIP_ERROR_RANGE, points, "points", "at least 1")) &&
           (frame_bytes >= FRAME_HEADER_BYTES + POINT_BYTES * points ||
            refuse(md2, DIP_ERROR_RANGE, frame_bytes, "bytes in a frame",
                   "at least 40 and 4 for each point")) &&
           check_section(md2, "frames", header[HEADER_FRAME_COUNT], 1, frame_bytes,
                         header[HEADER_FRAMES]);
}

// --- triangles -----------------------------------------------------------------------------------

static int by_key(const void *a, const void *b) {
    const Corner *x = a;
    const Corner *y = b;
    return x->key != y->key ? (x->key > y->key) - (x->key < y->key)
                            : (x->index > y->index) - (x->index < y->index);
}

// Checks the indices and orders the corners. A model without coordinates uses 0 for all.
static bool read_corners(Md2 *md2) {
    const int64_t points = md2->header[HEADER_POINT_COUNT];
    const int64_t coordinates = md2->header[HEADER_COORDINATE_COUNT];
    const size_t triangles = (size_t)md2->header[HEADER_TRIANGLE_COUNT];
    md2->corners = malloc(3 * triangles * sizeof *md2->corners);
    if (!md2->corners) {
        return dip_model_out_of_memory(md2->err, md2->model->path);
    }
    for (size_t t = 0; t < triangles; ++t) {
        const uint8_t *at = md2->bytes + md2->header[HEADER_TRIANGLES] + TRIANGLE_BYTES * t;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t point = read_u16(at + 2 * k);
            const uint32_t coordinate = coordinates ? read_u16(at + 6 + 2 * k) : 0;
            if (point >= points || (coordinates && coordinate >= coordinates)) {
                return dip_error_set(md2->err, DIP_ERROR_RANGE, md2->model->path, 0, NULL,
                                     "triangle %zu uses point %u of %lld and texture coordinates "
                                     "%u of %lld",
                                     t, point, (long long)points, coordinate,
                                     (long long)coordinates);
            }
            md2->corners[3 * t + k] = (Corner){point << 16 | coordinate, (uint32_t)(3 * t + k)};
        }
    }
    qsort(md2->corners, 3 * triangles, sizeof *md2->corners, by_key);
    return true;
}

// True if the corner begins a new vertex: corners with equal keys are one vertex.
static bool begins_vertex(const Md2 *md2, size_t corner) {
    return corner == 0 || md2->corners[corner].key != md2->corners[corner - 1].key;
}

// Numbers the vertices, and makes the indices of the triangles. MD2 winds front faces
// clockwise, so the second and third corner change places.
static bool make_indices(Md2 *md2, DipAnimatedMesh *mesh) {
    static const uint32_t places[3] = {0, 2, 1};
    const size_t count = 3 * (size_t)md2->header[HEADER_TRIANGLE_COUNT];
    uint32_t *indices = dip_animated_alloc(md2->model, count, sizeof *indices);
    if (!indices) {
        return dip_animated_no_room(md2->model, md2->err);
    }
    for (size_t i = 0; i < count; ++i) {
        const uint32_t at = md2->corners[i].index;
        mesh->vertex_count += begins_vertex(md2, i);
        indices[at - at % 3 + places[at % 3]] = mesh->vertex_count - 1;
    }
    mesh->indices = indices;
    mesh->index_count = (uint32_t)count;
    return true;
}

// Coordinates are in texels of the skin.
static bool make_uv(Md2 *md2, DipAnimatedMesh *mesh) {
    const int64_t width = md2->header[HEADER_SKIN_WIDTH];
    const int64_t height = md2->header[HEADER_SKIN_HEIGHT];
    if (md2->header[HEADER_COORDINATE_COUNT] == 0) {
        return true;
    }
    if (width < 1 || height < 1) {
        return refuse(md2, DIP_ERROR_RANGE, width < 1 ? width : height,
                      "texels along a side of its skin", "at least 1");
    }
    float *uv = dip_animated_alloc(md2->model, mesh->vertex_count, 2 * sizeof *uv);
    if (!uv) {
        return dip_animated_no_room(md2->model, md2->err);
    }
    mesh->uv0 = uv;
    for (size_t i = 0; i < mesh->index_count; ++i) {
        if (begins_vertex(md2, i)) {
            const uint8_t *at = md2->bytes + md2->header[HEADER_COORDINATES] +
                                COORDINATE_BYTES * (size_t)(md2->corners[i].key & 65535);
            *uv++ = (float)((int16_t)read_u16(at) / (double)width);
            *uv++ = (float)((int16_t)read_u16(at + 2) / (double)height);
        }
    }
    return true;
}

// --- frames --------------------------------------------------------------------------------------

// Writes a vector with z up as one with y up.
static void turn(const double from[3], float to[3]) {
    to[0] = (float)from[0];
    to[1] = (float)from[2];
    to[2] = (float)-from[1];
}

// Reads a point of a frame: three bytes, which the frame scales and moves, and the number of a
// normal.
static bool read_point(const Md2 *md2, const uint8_t *frame, uint32_t point, float position[3],
                       float normal[3]) {
    const uint8_t *at = frame + FRAME_HEADER_BYTES + POINT_BYTES * (size_t)point;
    double p[3];
    for (size_t axis = 0; axis < 3; ++axis) {
        const double scale = read_float(frame + 4 * axis);
        const double translate = read_float(frame + 12 + 4 * axis);
        p[axis] = scale * at[axis] + translate;
        if (!isfinite((float)p[axis])) {
            return dip_error_set(md2->err, DIP_ERROR_RANGE, md2->model->path, 0, NULL,
                                 "position of point %u is not finite", point);
        }
    }
    if (at[3] >= DIP_MD2_NORMAL_COUNT) {
        return refuse(md2, DIP_ERROR_RANGE, at[3], "as the number of a normal", "0..161");
    }
    turn(p, position);
    dip_md2_normal(at[3], p);
    turn(p, normal);
    return true;
}

// Fills one shape for each frame.
static bool make_shapes(Md2 *md2, DipAnimatedMesh *mesh) {
    const size_t frames = (size_t)md2->header[HEADER_FRAME_COUNT];
    const size_t vertices = mesh->vertex_count;
    float *positions = dip_animated_alloc(md2->model, frames * vertices, 3 * sizeof *positions);
    float *normals = dip_animated_alloc(md2->model, frames * vertices, 3 * sizeof *normals);
    if (!positions || !normals) {
        return dip_animated_no_room(md2->model, md2->err);
    }
    mesh->shape_count = (int)frames;
    mesh->positions = positions;
    mesh->normals = normals;
    for (size_t f = 0; f < frames; ++f) {
        const uint8_t *frame =
            md2->bytes + md2->header[HEADER_FRAMES] + f * (size_t)md2->header[HEADER_FRAME_BYTES];
        for (size_t i = 0; i < mesh->index_count; ++i) {
            if (!begins_vertex(md2, i)) {
                continue;
            }
            if (!read_point(md2, frame, md2->corners[i].key >> 16, positions, normals)) {
                return false;
            }
            positions += 3;
            normals += 3;
        }
    }
    return true;
}

// --- animations ----------------------------------------------------------------------------------

// Length of a frame's name without the digits at its end. A name of digits only has the length 0.
static size_t stem_length(const char *name) {
    size_t length = strlen(name);
    while (length > 0 && isdigit((unsigned char)name[length - 1])) {
        --length;
    }
    return length;
}

static bool same_stem(const char *a, const char *b) {
    const size_t length = stem_length(a);
    return length == stem_length(b) && strncmp(a, b, length) == 0;
}

static bool read_frame_names(Md2 *md2) {
    DipAnimatedModel *model = md2->model;
    const int count = (int)md2->header[HEADER_FRAME_COUNT];
    model->key_frames = dip_animated_alloc(model, (size_t)count, sizeof *model->key_frames);
    for (int i = 0; model->key_frames && i < count; ++i) {
        const uint8_t *frame = md2->bytes + md2->header[HEADER_FRAMES] +
                               (size_t)i * (size_t)md2->header[HEADER_FRAME_BYTES];
        const char *name =
            dip_animated_text(model, (const char *)frame + FRAME_NAME_AT, FRAME_NAME_BYTES);
        if (!name) {
            return dip_animated_no_room(model, md2->err);
        }
        model->key_frames[i].name = name;
    }
    model->def.key_frame_count = count;
    return model->key_frames || dip_animated_no_room(model, md2->err);
}

// Makes an animation of each run of frames with one name.
static bool make_animations(Md2 *md2) {
    DipAnimatedModel *model = md2->model;
    const int frames = model->def.key_frame_count;
    model->animations = dip_animated_alloc(model, (size_t)frames, sizeof *model->animations);
    model->animation_plans =
        dip_animated_alloc(model, (size_t)frames, sizeof *model->animation_plans);
    if (!model->animations || !model->animation_plans) {
        return dip_animated_no_room(model, md2->err);
    }
    for (int i = 0; i < frames; ++i) {
        DipKeyFrame *frame = &model->key_frames[i];
        if (i == 0 || !same_stem(frame->name, model->key_frames[i - 1].name)) {
            const char *name = dip_animated_text(model, frame->name, stem_length(frame->name));
            if (!name) {
                return dip_animated_no_room(model, md2->err);
            }
            model->animations[model->def.animation_count].name = name;
            model->animation_plans[model->def.animation_count++].first_frame = i;
        }
        frame->animation = model->def.animation_count - 1;
        DipAnimationPlan *plan = &model->animation_plans[frame->animation];
        frame->time_s = plan->frame_count++ / frames_per_s;
        model->animations[frame->animation].duration_s = plan->frame_count / frames_per_s;
    }
    return true;
}

// --- the model -----------------------------------------------------------------------------------

// The first skin is the colour texture; games choose among the others by themselves.
static bool make_material(DipAnimatedModel *model, const char *skin, DipError *err) {
    model->materials = dip_animated_alloc(model, 1, sizeof *model->materials);
    model->textures = dip_animated_alloc(model, 1, sizeof *model->textures);
    model->pictures = dip_animated_alloc(model, 1, sizeof *model->pictures);
    if (!model->materials || !model->textures || !model->pictures) {
        return dip_animated_no_room(model, err);
    }
    model->materials[0] = dip_animated_material("skin");
    model->materials[0].double_sided = false;
    model->def.material_count = 1;
    return !skin[0] ||
           dip_animated_add_picture_file(model, skin, &model->materials[0].colour_texture, err);
}

// Copies the name of the first skin, or an empty text if the model has no use for one.
static bool read_skin(Md2 *md2, const char **skin) {
    const bool used =
        md2->header[HEADER_SKIN_COUNT] > 0 && md2->header[HEADER_COORDINATE_COUNT] > 0;
    const char *name = used ? (const char *)md2->bytes + md2->header[HEADER_SKINS] : "";
    *skin = dip_animated_text(md2->model, name, SKIN_BYTES);
    return *skin || dip_animated_no_room(md2->model, md2->err);
}

// One node and one object, so that a pose works as for other models.
static bool make_object(Md2 *md2) {
    DipAnimatedModel *model = md2->model;
    model->objects = dip_animated_alloc(model, 1, sizeof *model->objects);
    model->plans = dip_animated_alloc(model, 1, sizeof *model->plans);
    model->nodes = dip_animated_alloc(model, 1, sizeof *model->nodes);
    if (!model->objects || !model->plans || !model->nodes) {
        return dip_animated_no_room(model, md2->err);
    }
    model->objects[0] = (DipAnimatedObject){.name = "model"};
    model->plans[0] = (DipObjectPlan){.node = 0, .skin = DIP_NO_SKIN};
    model->nodes[0] =
        (DipRigNode){.parent = DIP_NO_NODE, .rotation = {0, 0, 0, 1}, .scale = {1, 1, 1}};
    model->def.object_count = 1;
    model->node_count = 1;
    return true;
}

static bool read_all(Md2 *md2) {
    DipAnimatedModel *model = md2->model;
    model->meshes = dip_animated_alloc(model, 1, sizeof *model->meshes);
    if (!model->meshes) {
        return dip_animated_no_room(model, md2->err);
    }
    model->meshes[0].name = "model";
    model->def.mesh_count = 1;
    return read_header(md2) && read_corners(md2) && make_indices(md2, model->meshes) &&
           make_uv(md2, model->meshes) && make_shapes(md2, model->meshes) &&
           read_frame_names(md2) && make_animations(md2) && make_object(md2);
}

bool dip_md2_read(DipAnimatedModel *model, const char **skin, DipError *err) {
    unsigned char *bytes = NULL;
    Md2 md2 = {.model = model, .err = err};
    if (!dip_file_read(model->path, "model", max_file_bytes, &bytes, &md2.size_bytes, err)) {
        return false;
    }
    md2.bytes = bytes;
    const bool ok = read_all(&md2) && read_skin(&md2, skin);
    free(md2.corners);
    free(bytes);
    return ok;
}

bool dip_animated_read_md2(DipAnimatedModel *model, DipError *err) {
    const char *skin;
    return dip_md2_read(model, &skin, err) && make_material(model, skin, err);
}
