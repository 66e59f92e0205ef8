// Converts the scene's meshes to screen triangles: transform, vertex light, clipping, facing.
#include "renderer/reference/internal/clip.h"
#include "renderer/reference/internal/internal.h"
#include "renderer/reference/internal/wide.h"

#include <math.h>
#include <stdlib.h>

static const double pi = 3.14159265358979323846;

typedef struct Camera {
    double position[3];
    double rows[3][3]; // rows of the rotation from world to camera space
    double scale_x;    // clip.x = scale_x * x
    double scale_y;
    double width_px;
    double height_px;
    DipRefClipPlanes planes;
    bool rounded;
    bool mirrored;
    double level_m;
    double margin;
    bool shadows;
} Camera;

void dip_reference_orientation(const DipPose *pose, double q[4]) {
    const double *from = pose->orientation;
    const double greatest =
        fmax(fmax(fabs(from[0]), fabs(from[1])), fmax(fabs(from[2]), fabs(from[3])));
    int exponent;
    frexp(greatest, &exponent);
    for (int i = 0; i < 4; i++) {
        q[i] = ldexp(from[i], -exponent);
    }
}

static Camera make_camera(const DipReference *reference, const DipRefShot *shot) {
    const DipPose *pose = shot->pose;
    double q[4];
    dip_reference_orientation(pose, q);
    const double s = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double focal = 1.0 / tan(pose->fov_y_deg * (pi / 360.0));
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    // The transpose of the matrix that turns camera space into world space.
    const Camera camera = {
        .position = {pose->position_world[0], pose->position_world[1], pose->position_world[2]},
        .rows = {{1.0 - s * (y * y + z * z), s * (x * y + z * w), s * (x * z - y * w)},
                 {s * (x * y - z * w), 1.0 - s * (x * x + z * z), s * (y * z + x * w)},
                 {s * (x * z + y * w), s * (y * z - x * w), 1.0 - s * (x * x + y * y)}},
        .scale_x = focal / shot->aspect,
        .scale_y = focal,
        .width_px = shot->width,
        .height_px = shot->height,
        .planes = dip_reference_clip_planes(reference, shot),
        .rounded = shot->rounded,
        .mirrored = shot->mirrored,
        .level_m = reference->reflection.level_m,
        .margin = shot->margin,
        .shadows = shot->shadows,
    };
    return camera;
}

static double dot3(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The matrix that turns an object's normals, and whether the object is mirrored.
typedef struct Turn {
    double rows[3][3];
    bool mirrored;
} Turn;

// Computes the matrix that turns normals: the inverse transpose. Its cofactors have the same
// direction and need no division. The sign keeps normals pointing outwards if the object is
// mirrored.
static Turn find_turn(const float matrix[12]) {
    const double r[3][3] = {{matrix[0], matrix[1], matrix[2]},
                            {matrix[4], matrix[5], matrix[6]},
                            {matrix[8], matrix[9], matrix[10]}};
    Turn turn;
    for (int i = 0; i < 3; i++) {
        const double *a = r[(i + 1) % 3];
        const double *b = r[(i + 2) % 3];
        for (int j = 0; j < 3; j++) {
            turn.rows[i][j] = a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
        }
    }
    turn.mirrored = dot3(r[0], turn.rows[0]) < 0.0;
    for (int i = 0; i < 9; i++) {
        turn.rows[i / 3][i % 3] *= turn.mirrored ? -1.0 : 1.0;
    }
    return turn;
}

// Turns a normal of the mesh into the world and normalises it.
static void turn_normal(const Turn *turn, const float normal[3], double turned[3]) {
    const double local[3] = {normal[0], normal[1], normal[2]};
    for (int i = 0; i < 3; i++) {
        turned[i] = dot3(turn->rows[i], local);
    }
    const double length = sqrt(dot3(turned, turned));
    for (int i = 0; i < 3; i++) {
        turned[i] *= length > 0.0 ? 1.0 / length : 0.0;
    }
}

// Transforms a point of the mesh into the world. A product of two floats is exact in double.
static void find_world(const float m[12], const float p[3], DipWide world[3]) {
    for (int i = 0; i < 3; i++) {
        const float *row = m + 4 * i;
        const DipWide sum = dip_wide_sum((double)row[0] * p[0], (double)row[1] * p[1]);
        world[i] = dip_wide_add_double(dip_wide_add_double(sum, (double)row[2] * p[2]), row[3]);
    }
}

static DipWide dot_wide(const double a[3], const DipWide b[3]) {
    const DipWide sum = dip_wide_add(dip_wide_scale(b[0], a[0]), dip_wide_scale(b[1], a[1]));
    return dip_wide_add(sum, dip_wide_scale(b[2], a[2]));
}

// Computes where a point of the mesh appears.
static void place_vertex(const Camera *camera, const float m[12], const float p[3],
                         DipRefClipVertex *vertex) {
    DipWide world[3];
    DipWide from_camera[3];
    find_world(m, p, world);
    const DipWide above = dip_wide_add_double(world[1], -camera->level_m);
    if (camera->mirrored) {
        world[1] = dip_wide_add_double(dip_wide_negate(above), camera->level_m);
    }
    for (int i = 0; i < 3; i++) {
        from_camera[i] = dip_wide_add_double(world[i], -camera->position[i]);
        vertex->varyings[DIP_REF_X + i] = from_camera[i];
    }
    vertex->x = dip_wide_scale(dot_wide(camera->rows[0], from_camera), camera->scale_x);
    vertex->y = dip_wide_scale(dot_wide(camera->rows[1], from_camera), camera->scale_y);
    vertex->w = dip_wide_negate(dot_wide(camera->rows[2], from_camera));
    if (camera->mirrored) {
        vertex->above = dip_wide_add(above, dip_wide_scale(vertex->w, camera->margin));
        // The surface is lit as if it were not mirrored.
        vertex->varyings[DIP_REF_Y] = dip_wide_negate(from_camera[1]);
    }
}

// How the vertices of a mesh are lit.
typedef enum VertexLight { LIGHT_NONE, LIGHT_FIXED, LIGHT_OF_SCENE } VertexLight;

// Lights a vertex of the colour RED to BLUE.
static void light_vertex(VertexLight kind, const DipRefLit *lit, const double normal[3],
                         DipRefClipVertex *vertex) {
    double place[3];
    double diffuse[3];
    double highlight[3] = {0.0};
    double direct[3] = {0.0};
    for (int i = 0; i < 3; i++) {
        place[i] = vertex->varyings[DIP_REF_X + i].high;
        diffuse[i] = kind == LIGHT_FIXED ? dip_reference_light(normal, 1.0) : 1.0;
    }
    if (kind == LIGHT_OF_SCENE) {
        dip_reference_lights(lit, place, place, normal, 1.0, diffuse, highlight, direct);
    }
    for (int i = 0; i < 3; i++) {
        DipWide *colour = &vertex->varyings[DIP_REF_RED + i];
        vertex->varyings[DIP_REF_DIRECT_RED + i] = dip_wide(direct[i] * colour->high);
        *colour = dip_wide(diffuse[i] * colour->high);
        vertex->varyings[DIP_REF_HIGHLIGHT_RED + i] = dip_wide(highlight[i]);
    }
}

// Transforms one vertex, without its light. Returns its unit normal, or 0 if the mesh has none.
static DipRefClipVertex transform_vertex(const Camera *camera, const float m[12],
                                         const DipMeshDef *mesh, const Turn *turn, uint32_t index,
                                         double normal[3]) {
    DipRefClipVertex vertex = {.above = dip_wide(0.0)};
    place_vertex(camera, m, mesh->positions + 3 * (size_t)index, &vertex);
    for (int i = 0; i < 2; i++) {
        const size_t at = 2 * (size_t)index + (size_t)i;
        vertex.varyings[DIP_REF_U0 + i] = dip_wide(mesh->uv0 ? mesh->uv0[at] : 0.0);
        vertex.varyings[DIP_REF_U1 + i] = dip_wide(mesh->uv1 ? mesh->uv1[at] : 0.0);
    }
    vertex.varyings[DIP_REF_ALPHA] = dip_wide(mesh->alphas ? (double)mesh->alphas[index] : 1.0);
    normal[0] = normal[1] = normal[2] = 0.0;
    if (mesh->normals) {
        turn_normal(turn, mesh->normals + 3 * (size_t)index, normal);
    }
    for (int i = 0; i < 3; i++) {
        const double colour = mesh->colours_lin ? mesh->colours_lin[3 * (size_t)index + i] : 1.0;
        vertex.varyings[DIP_REF_NORMAL_X + i] = dip_wide(normal[i]);
        vertex.varyings[DIP_REF_RED + i] = dip_wide(colour);
    }
    return vertex;
}

static bool is_finite(const DipRefClipVertex *vertex) {
    return isfinite(vertex->x.high) && isfinite(vertex->y.high) && isfinite(vertex->w.high);
}

// Converts pixels to steps of 1/256 pixel.
static double to_steps(double px, bool rounded) {
    const double steps = px * 256.0;
    return rounded ? rint(steps) : steps;
}

// Computes where a vertex appears, without its varyings.
static void project(const Camera *camera, const DipRefClipVertex *vertex, DipRefVertex *screen) {
    const double x = vertex->x.high / vertex->w.high;
    const double y = vertex->y.high / vertex->w.high;
    screen->x = to_steps((x + 1.0) * camera->width_px * 0.5, camera->rounded);
    screen->y = to_steps((1.0 - y) * camera->height_px * 0.5, camera->rounded);
    screen->inv_w = 1.0 / vertex->w.high;
}

// Returns twice the area of a triangle, positive if its corners are clockwise to the eye (y points
// down). The sign is exact for rounded positions, which are whole numbers of at most 2^29.
static double find_area(const DipRefVertex v[3], bool rounded) {
    const double x1 = v[1].x - v[0].x, y1 = v[1].y - v[0].y;
    const double x2 = v[2].x - v[0].x, y2 = v[2].y - v[0].y;
    if (!rounded) {
        return x1 * y2 - y1 * x2;
    }
    return (double)((int64_t)x1 * (int64_t)y2 - (int64_t)y1 * (int64_t)x2);
}

// Finds the pixels that an interval of positions covers along one axis, cut to the frame. One more
// pixel is included at either end, since samples may lie anywhere in a pixel.
static bool find_pixels(double a, double b, double c, int size_px, int *first, int *last) {
    const double from = floor(fmin(a, fmin(b, c)) / 256.0) - 1.0;
    const double to = floor(fmax(a, fmax(b, c)) / 256.0) + 1.0;
    *first = (int)fmin(fmax(from, 0.0), size_px);
    *last = (int)fmin(fmax(to, -1.0), size_px - 1.0);
    return *first <= *last;
}

static bool append(DipRefTriangles *triangles, const DipRefTriangle *triangle) {
    if (triangles->count == triangles->capacity) {
        const size_t capacity = triangles->capacity ? 2 * triangles->capacity : 1024;
        DipRefTriangle *items = realloc(triangles->items, capacity * sizeof *items);
        if (!items) {
            return false;
        }
        triangles->items = items;
        triangles->capacity = capacity;
    }
    triangles->items[triangles->count++] = *triangle;
    triangles->has_blended = triangles->has_blended || triangle->blended;
    triangles->has_water = triangles->has_water || triangle->water;
    triangles->has_scattering = triangles->has_scattering || dip_reference_scatters(triangle);
    return true;
}

// Adds a piece of a triangle if the piece may be visible. *like contains the values that all
// triangles of the mesh share.
static bool add_piece(const Camera *camera, const DipRefClipVertex *a, const DipRefClipVertex *b,
                      const DipRefClipVertex *c, const DipRefTriangle *like,
                      DipRefTriangles *triangles) {
    const DipRefClipVertex *corners[3] = {a, b, c};
    DipRefTriangle piece = *like;
    DipRefVertex *v = piece.vertices;
    for (int i = 0; i < 3; i++) {
        project(camera, corners[i], &v[i]);
    }
    piece.area = find_area(v, camera->rounded);
    const bool is_front = (piece.area < 0.0) != like->mirrored;
    if (piece.area == 0.0 || (!is_front && !piece.material->double_sided)) {
        return true;
    }
    if (!find_pixels(v[0].x, v[1].x, v[2].x, (int)camera->width_px, &piece.min_x, &piece.max_x) ||
        !find_pixels(v[0].y, v[1].y, v[2].y, (int)camera->height_px, &piece.min_y, &piece.max_y)) {
        return true;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < DIP_REF_VARYINGS; k++) {
            v[i].varyings[k] = corners[i]->varyings[k].high;
        }
    }
    if (piece.area < 0.0) {
        const DipRefVertex swapped = v[1];
        v[1] = v[2];
        v[2] = swapped;
        piece.area = -piece.area;
    }
    return append(triangles, &piece);
}

// Finds what the coordinates that repeat count from: the multiples of 64 that are nearest to the
// coordinates of the corner nearest to the eye.
static void find_multiples(const DipRefClipVertex *const *corners, int count,
                           DipRefTriangle *triangle) {
    int nearest = 0;
    for (int i = 1; i < count; i++) {
        nearest = corners[i]->w.high < corners[nearest]->w.high ? i : nearest;
    }
    for (int axis = 0; axis < 2; axis++) {
        const double at = count > 0 ? corners[nearest]->varyings[DIP_REF_U0 + axis].high : 0.0;
        triangle->repeat[axis] = triangle->repeats[axis] ? 64.0 * rint(at / 64.0) : 0.0;
    }
}

// Adds the pieces of a triangle that clipping leaves.
static bool add_clipped(const Camera *camera, const DipRefClipVertex *const corners[3],
                        DipRefTriangle *like, DipRefTriangles *triangles) {
    if (!dip_reference_needs_clip(&camera->planes, corners)) {
        find_multiples(corners, 3, like);
        return add_piece(camera, corners[0], corners[1], corners[2], like, triangles);
    }
    DipRefClipVertex polygon[DIP_REF_MAX_CORNERS];
    const DipRefClipVertex *all[DIP_REF_MAX_CORNERS];
    const int count = dip_reference_clip(&camera->planes, corners, polygon);
    for (int k = 0; k < count; k++) {
        all[k] = &polygon[k];
    }
    find_multiples(all, count, like);
    bool added = true;
    for (int k = 2; added && k < count; k++) {
        added = add_piece(camera, &polygon[0], &polygon[k - 1], &polygon[k], like, triangles);
    }
    return added;
}

// Adds the triangles of a mesh. *like contains the values that these triangles share and the number
// of the mesh's first patch (a piece of a surface that is shaded as a whole).
static bool add_mesh(const DipReference *reference, const Camera *camera, int mesh_index,
                     const DipRefClipVertex *vertices, const DipRefTriangle *like,
                     DipRefTriangles *triangles) {
    const DipMeshDef *mesh = &reference->def->meshes[mesh_index];
    DipRefTriangle triangle = *like;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        if (i / 3 % DIP_REF_STOP_PERIOD == 0 && dip_reference_stopped(reference, NULL)) {
            return false;
        }
        const DipRefClipVertex *corners[3] = {&vertices[mesh->indices[i]],
                                              &vertices[mesh->indices[i + 1]],
                                              &vertices[mesh->indices[i + 2]]};
        if (!is_finite(corners[0]) || !is_finite(corners[1]) || !is_finite(corners[2])) {
            continue;
        }
        triangle.patch =
            like->patch + (reference->patches ? reference->patches[mesh_index][i / 3] : i / 3);
        if (!add_clipped(camera, corners, &triangle, triangles)) {
            return false;
        }
    }
    return true;
}

// Sets the values of a metallic-roughness surface.
static void describe_pbr(const DipReference *reference, const DipMeshDef *mesh,
                         DipRefTriangle *like) {
    const DipMaterialDef *material = like->material;
    const DipPbrDef *pbr = material->pbr;
    const float *const sets[2] = {mesh->uv0, mesh->uv1};
    if (!pbr || !material->lit || !dip_reference_is_solid(material) || !mesh->normals ||
        like->light_map) {
        return;
    }
    like->pbr = pbr;
    like->few_entries = reference->differs;
    like->environment = reference->environment;
    if (pbr->metal_rough_map != DIP_NO_TEXTURE && mesh->uv0) {
        like->metal_rough = &reference->textures[pbr->metal_rough_map];
    }
    if (pbr->occlusion_map != DIP_NO_TEXTURE && sets[pbr->occlusion_at_uv1]) {
        like->occlusion = &reference->textures[pbr->occlusion_map];
    }
    if (pbr->emission_map != DIP_NO_TEXTURE && sets[pbr->emission_at_uv1]) {
        like->emission = &reference->textures[pbr->emission_map];
    }
}

static bool repeats(DipWrap wrap) {
    return wrap == DIP_WRAP_REPEAT || wrap == DIP_WRAP_MIRROR;
}

// Finds the axes of uv0 along which all textures repeat that a mesh reads at uv0.
static void find_repeats(DipRefTriangle *like) {
    const bool occluded = like->occlusion && !like->pbr->occlusion_at_uv1;
    const bool emits = like->emission && !like->pbr->emission_at_uv1;
    const DipRefTexture *textures[] = {like->colour, like->normal_map, like->metal_rough,
                                       occluded ? like->occlusion : NULL,
                                       emits ? like->emission : NULL};
    like->repeats[0] = like->repeats[1] = true;
    for (size_t i = 0; i < sizeof textures / sizeof *textures; i++) {
        if (textures[i]) {
            like->repeats[0] = like->repeats[0] && repeats(textures[i]->def->wrap_u);
            like->repeats[1] = like->repeats[1] && repeats(textures[i]->def->wrap_v);
        }
    }
}

// Whether the alpha of the vertices changes the surface of a mesh.
static bool has_alphas(const DipMaterialDef *material, const DipMeshDef *mesh) {
    return mesh->alphas &&
           (material->surface == DIP_SURFACE_CLIPPED || material->surface == DIP_SURFACE_BLENDED);
}

// Returns the values that all triangles of a mesh share.
static DipRefTriangle describe_mesh(const DipReference *reference, const DipMeshDef *mesh) {
    const DipMaterialDef *material = &reference->def->materials[mesh->material];
    DipRefTriangle like = {.material = material};
    if (material->colour_texture != DIP_NO_TEXTURE && mesh->uv0) {
        like.colour = &reference->textures[material->colour_texture];
    }
    if (material->light_map != DIP_NO_TEXTURE && mesh->uv1) {
        like.light_map = &reference->textures[material->light_map];
    }
    const bool lit = like.light_map || material->lit;
    if (dip_reference_is_bumpy(material) && mesh->uv0 && mesh->normals && lit) {
        like.normal_map = &reference->textures[material->normal_map];
    }
    if (material->surface == DIP_SURFACE_SKY && like.colour) {
        like.sky = &reference->def->sky;
        like.time_ns = reference->time_ns;
    }
    if (reference->def->lighting && dip_reference_is_solid(material) && material->lit &&
        mesh->normals && !like.light_map) {
        const bool phong =
            reference->def->lighting->shading == DIP_SHADING_PHONG || has_alphas(material, mesh);
        like.lit = (DipRefLit){.lighting = reference->def->lighting,
                               .material = material,
                               .fragments = phong || like.normal_map};
    }
    like.clipped =
        material->surface == DIP_SURFACE_CLIPPED && (like.colour || has_alphas(material, mesh));
    like.in_floats = reference->in_floats;
    like.water = material->surface == DIP_SURFACE_WATER;
    like.blended =
        material->surface == DIP_SURFACE_BLENDED || (like.water && material->transmission > 0.0f);
    describe_pbr(reference, mesh, &like);
    find_repeats(&like);
    return like;
}

static VertexLight vertex_light(const DipRefTriangle *like, const DipMeshDef *mesh) {
    if (like->pbr) {
        return LIGHT_NONE;
    }
    if (like->lit.lighting) {
        return like->lit.fragments ? LIGHT_NONE : LIGHT_OF_SCENE;
    }
    const bool lit = like->material->lit && mesh->normals && !like->light_map && !like->normal_map;
    return lit ? LIGHT_FIXED : LIGHT_NONE;
}

// Adds the triangles of an object. Its patches are numbered from first_patch on. The 2^32 numbers
// from first_patch on belong to this object alone.
static bool add_object(const DipReference *reference, const Camera *camera,
                       const DipObjectDef *object, uint64_t first_patch,
                       DipRefTriangles *triangles) {
    const DipMeshDef *mesh = &reference->def->meshes[object->mesh];
    const Turn turn = find_turn(object->transform);
    DipRefTriangle like = describe_mesh(reference, mesh);
    like.patch = first_patch;
    like.mirrored = turn.mirrored != camera->mirrored;
    DipRefClipVertex *vertices = malloc(((size_t)mesh->vertex_count + 1) * sizeof *vertices);
    if (!vertices) {
        return false;
    }
    for (int i = 0; i < 3; i++) {
        like.lit.eye[i] = camera->position[i];
    }
    if (camera->mirrored) {
        like.lit.eye[1] = 2.0 * camera->level_m - camera->position[1];
    }
    if (like.lit.lighting && camera->shadows) {
        like.lit.shadows = reference->shadows;
    }
    const VertexLight light = vertex_light(&like, mesh);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        double normal[3];
        vertices[i] = transform_vertex(camera, object->transform, mesh, &turn, i, normal);
        light_vertex(light, &like.lit, normal, &vertices[i]);
    }
    const bool added = add_mesh(reference, camera, object->mesh, vertices, &like, triangles);
    free(vertices);
    return added;
}

static bool is_water(const DipReference *reference, const DipObjectDef *object) {
    const DipMeshDef *mesh = &reference->def->meshes[object->mesh];
    return reference->def->materials[mesh->material].surface == DIP_SURFACE_WATER;
}

bool dip_reference_build_triangles(const DipReference *reference, const DipRefShot *shot,
                                   DipRefTriangles *triangles, DipError *err) {
    const Camera camera = make_camera(reference, shot);
    *triangles = (DipRefTriangles){0};
    for (int o = 0; o < reference->def->object_count; o++) {
        if (shot->mirrored && is_water(reference, &reference->def->objects[o])) {
            continue;
        }
        if (!add_object(reference, &camera, &reference->def->objects[o], (uint64_t)o << 32,
                        triangles)) {
            dip_reference_triangles_free(triangles);
            return !dip_reference_stopped(reference, err) &&
                   dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, NULL, "no memory for triangles");
        }
    }
    return true;
}

void dip_reference_triangles_free(DipRefTriangles *triangles) {
    free(triangles->items);
    *triangles = (DipRefTriangles){0};
}
