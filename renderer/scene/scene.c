// Creates a scene from its description: textures, vertex layouts and bounds.
#include "renderer/scene/resources/scene_layout.h"

#include "renderer/base/clock.h"
#include "renderer/base/fp_mode.h"
#include "renderer/pipeline/cull.h"
#include "renderer/scene/resources/blended_pieces.h"
#include "renderer/scene/resources/placement.h"
#include "renderer/scene/resources/posed.h"
#include "renderer/scene/resources/repeats.h"
#include "renderer/scene/resources/scene_check.h"
#include "renderer/scene/resources/vertex_layout.h"

#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// --- meshes ------------------------------------------------------------------------------------

static float *interleave(const DipVertexLayout *layout, uint32_t vertex_count) {
    const size_t stride = (size_t)layout->attribute_count;
    float *rows = malloc((stride * vertex_count + 1) * sizeof *rows);
    for (uint32_t v = 0; rows && v < vertex_count; v++) {
        float *row = rows + stride * v;
        for (int i = 0; i < layout->count; i++) {
            const size_t size = (size_t)layout->size[i];
            memcpy(row, layout->source[i] + size * v, size * sizeof *row);
            row += size;
        }
    }
    return rows;
}

// Describes the metallic-roughness surface of a mesh.
static void add_pbr_surface(const DipSceneDef *def, int index, DipScene *scene) {
    DipSceneMesh *mesh = &scene->meshes[index];
    DipPbrUniforms *surface = &scene->pbr->surfaces[index];
    *surface =
        dip_pbr_surface(def, &def->meshes[index], mesh->uv_varyings[0], mesh->uv_varyings[1]);
    surface->environment = scene->pbr->environment;
    dip_pbr_add_sheen(def->materials[def->meshes[index].material].pbr,
                      scene->pbr->sheens ? &scene->pbr->sheens[index] : NULL, surface);
    mesh->full_layout.pbr = surface;
    scene->has_occlusion |= surface->occlusion_varying != DIP_ABSENT;
    scene->has_emission |= surface->emits;
    scene->has_coat |= surface->coat > 0.0f;
    scene->has_sheen |= surface->sheen != NULL;
    scene->has_transmission |= surface->transmission > 0.0f;
    scene->has_scattering |= surface->scattering > 0.0f;
}

static bool create_mesh(const DipSceneDef *def, int index, DipScene *scene, DipError *err) {
    const DipMeshDef *mesh = &def->meshes[index];
    DipSceneMesh *out = &scene->meshes[index];
    const DipVertexLayout layout = dip_mesh_lay_out(def, mesh, out);
    float *rows = interleave(&layout, mesh->vertex_count);
    if (!rows) {
        return dip_error_set(err, DIP_ERROR_MEMORY, mesh->name, 0, "mesh", "out of memory");
    }
    const DipMeshData data = {
        .name = mesh->name,
        .attributes = rows,
        .attribute_count = layout.attribute_count,
        .vertex_count = mesh->vertex_count,
        .indices = mesh->indices,
        .index_count = mesh->index_count,
    };
    const int moving = dip_moving_mesh(scene->motion, index);
    out->mesh = moving < 0 ? dip_mesh_create(&data, err) : dip_mesh_create_updatable(&data, err);
    out->material = mesh->material;
    out->attribute_count = layout.attribute_count;
    if (out->pbr) {
        add_pbr_surface(def, index, scene);
    }
    out->repeating_varyings = dip_scene_repeating_varyings(def, mesh, out);
    if (out->normal_mapped) {
        dip_scene_bound_coordinates(def, mesh, out);
    }
    scene->has_normal_map |= out->normal_mapped;
    scene->has_sky |= out->sky;
    scene->has_lit |= out->lit_by_lights;
    if (moving < 0) {
        free(rows);
    } else {
        scene->moving_rows[moving] = rows;
        scene->moving_vertices += mesh->vertex_count;
    }
    return out->mesh != NULL;
}

// --- textures ----------------------------------------------------------------------------------

static void mark_used_textures(const DipScene *scene, bool *used, bool *alpha) {
    for (int i = 0; i < scene->material_count; i++) {
        const DipSceneMaterial *material = &scene->materials[i];
        const int textures[] = {material->colour_texture, material->light_map,
                                material->normal_map,     material->pbr.metal_rough,
                                material->pbr.occlusion,  material->pbr.emission};
        for (size_t k = 0; k < sizeof textures / sizeof *textures; k++) {
            if (textures[k] != DIP_NO_TEXTURE) {
                used[textures[k]] = true;
            }
        }
        const bool has_alpha =
            material->surface == DIP_SURFACE_CLIPPED || material->surface == DIP_SURFACE_BLENDED;
        if (has_alpha && material->colour_texture != DIP_NO_TEXTURE) {
            alpha[material->colour_texture] = true;
        }
    }
}

// Creates only the textures that materials draw with. Alpha is kept only for clip maps and for the
// textures of blended surfaces.
static bool create_textures(const DipSceneDef *def, DipScene *scene, DipPool *pool, DipError *err) {
    bool *used = calloc(2 * (size_t)def->texture_count + 1, sizeof *used);
    if (!used) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "textures", "out of memory");
    }
    bool *alpha = used + def->texture_count;
    mark_used_textures(scene, used, alpha);
    const bool made = dip_textures_create(def->textures, used, alpha, def->texture_count, pool,
                                          scene->textures, err);
    free(used);
    return made;
}

// Whether a material uses a texture in a certain way.
typedef bool TextureUse(const DipSceneMaterial *material, int texture);

static bool is_normal_map(const DipSceneMaterial *material, int texture) {
    return material->normal_map == texture;
}

static bool is_clouds(const DipSceneMaterial *material, int texture) {
    return material->surface == DIP_SURFACE_SKY && material->colour_texture == texture;
}

static uint64_t bytes_used(const DipScene *scene, TextureUse *uses) {
    uint64_t bytes = 0;
    for (int i = 0; i < scene->texture_count; i++) {
        for (int m = 0; m < scene->material_count; m++) {
            if (uses(&scene->materials[m], i)) {
                bytes += dip_texture_colour_bytes(scene->textures[i]);
                break;
            }
        }
    }
    return bytes;
}

// Sums up the memory of each effect's textures. Only clip maps have alpha in memory.
static void add_effect_bytes(DipScene *scene) {
    scene->normal_map_bytes = bytes_used(scene, is_normal_map);
    scene->cloud_bytes = scene->has_sky ? bytes_used(scene, is_clouds) : 0;
    for (int i = 0; i < scene->texture_count; i++) {
        scene->clip_map_bytes += dip_texture_alpha_bytes(scene->textures[i]);
    }
}

// --- the scene ---------------------------------------------------------------------------------

static void add_bounds(DipScene *scene, const DipSceneObject *object, const float low[3],
                       const float high[3]) {
    for (int corner = 0; corner < 8; corner++) {
        const float p[3] = {corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                            corner & 4 ? high[2] : low[2]};
        for (int axis = 0; axis < 3; axis++) {
            const float *m = object->transform + 4 * axis;
            const float at = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + m[3];
            scene->min_world[axis] = fminf(scene->min_world[axis], at);
            scene->max_world[axis] = fmaxf(scene->max_world[axis], at);
        }
    }
}

static bool is_sky(DipSurface surface) {
    return surface == DIP_SURFACE_SKY;
}

static bool is_not_sky(DipSurface surface) {
    return surface != DIP_SURFACE_SKY;
}

static bool is_water(DipSurface surface) {
    return surface == DIP_SURFACE_WATER;
}

static DipSurface surface_of(const DipScene *scene, const DipSceneObject *object) {
    return scene->materials[scene->meshes[object->mesh].material].surface;
}

// Sets the scene's bounds to the bounds of all objects whose kind of surface `is` accepts. Returns
// false if no such object has triangles.
static bool bound_objects(DipScene *scene, bool (*is)(DipSurface)) {
    bool any = false;
    for (int axis = 0; axis < 3; axis++) {
        scene->min_world[axis] = INFINITY;
        scene->max_world[axis] = -INFINITY;
    }
    for (int i = 0; i < scene->object_count; i++) {
        const DipSceneObject *object = &scene->objects[i];
        if (is(surface_of(scene, object)) &&
            dip_mesh_triangle_count(scene->meshes[object->mesh].mesh)) {
            float low[3];
            float high[3];
            dip_mesh_bounds(scene->meshes[object->mesh].mesh, low, high);
            add_bounds(scene, object, low, high);
            any = true;
        }
    }
    return any;
}

static bool place_objects(const DipSceneDef *def, DipScene *scene, DipError *err) {
    bool *placed = calloc((size_t)def->mesh_count + 1, sizeof *placed);
    if (!placed) {
        return dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "objects", "out of memory");
    }
    for (int i = 0; i < def->object_count; i++) {
        DipSceneObject *object = &scene->objects[i];
        object->mesh = def->objects[i].mesh;
        dip_scene_object_place(object, def->objects[i].transform);
        const DipBox box = dip_mesh_box(scene->meshes[object->mesh].mesh);
        object->bounds = dip_cull_transform_box(object->transform, &box);
        object->first_of_mesh = !placed[object->mesh];
        if (object->first_of_mesh) {
            placed[object->mesh] = true;
            scene->drawn_mesh_count++;
            scene->geometry_bytes += dip_mesh_bytes(scene->meshes[object->mesh].mesh);
        }
        scene->triangle_count += dip_mesh_triangle_count(scene->meshes[object->mesh].mesh);
        const DipSceneMaterial *material = &scene->materials[scene->meshes[object->mesh].material];
        scene->has_caster |=
            material->casts && dip_mesh_triangle_count(scene->meshes[object->mesh].mesh);
        const DipPbrUniforms *pbr = scene->meshes[object->mesh].full_layout.pbr;
        const bool transmits = pbr && pbr->transmission > 0.0f;
        if (material->blended) {
            scene->blended_count++;
            scene->blended_added_draws +=
                (material->double_sided ? 2 : 1) * (transmits ? 2 : 1) - 1;
        }
    }
    scene->has_water = bound_objects(scene, is_water);
    scene->water_level = scene->has_water ? (double)scene->min_world[1] : 0.0;
    if (!bound_objects(scene, is_not_sky) && !bound_objects(scene, is_sky)) {
        for (int axis = 0; axis < 3; axis++) {
            scene->min_world[axis] = scene->max_world[axis] = 0.0f;
        }
    }
    free(placed);
    return true;
}

// Extends the scene's bounds by an object in a pose. moving: index of the moving object, or -1.
static void bound_object(DipScene *scene, const DipSceneObject *of, int moving,
                         const DipMotionPose *pose, const float (*boxes)[6]) {
    const int mesh = dip_moving_mesh(scene->motion, of->mesh);
    DipSceneObject object = *of;
    float box[6];
    if (!is_not_sky(surface_of(scene, of)) ||
        !dip_mesh_triangle_count(scene->meshes[of->mesh].mesh)) {
        return;
    }
    if (moving >= 0) {
        dip_motion_pose_transform(pose, moving, object.transform);
    }
    if (mesh >= 0) {
        memcpy(box, boxes[mesh], sizeof box);
    } else {
        dip_mesh_bounds(scene->meshes[of->mesh].mesh, box, box + 3);
    }
    add_bounds(scene, &object, box, box + 3);
}

// Extends the scene's bounds over its clips. boxes: those of the moving meshes.
static void bound_clips(DipScene *scene, DipMotionPose *pose, const float (*boxes)[6]) {
    const DipMotionDef *motion = scene->motion;
    for (int k = 0; k < DIP_MOTION_MOMENTS; k++) {
        int moving = 0;
        dip_motion_pose_set_share(pose, (double)k / DIP_MOTION_MOMENTS);
        for (int i = 0; i < scene->object_count; i++) {
            const bool moves = moving < motion->object_count && motion->objects[moving].object == i;
            bound_object(scene, &scene->objects[i], moves ? moving : -1, pose, boxes);
            moving += moves;
        }
    }
}

static bool bound_motion(DipScene *scene, DipError *err) {
    const DipMotionDef *motion = scene->motion;
    if (!motion) {
        return true;
    }
    DipMotionPose *pose = dip_motion_pose_create(motion);
    float(*boxes)[6] = calloc((size_t)motion->mesh_count + 1, sizeof *boxes);
    bool known = true;
    for (int m = 0; m < motion->mesh_count; m++) {
        known = known && motion->meshes[m].box;
    }
    const bool made = pose && boxes && (known || dip_motion_bound_meshes(motion, boxes));
    for (int m = 0; made && known && m < motion->mesh_count; m++) {
        memcpy(boxes[m], motion->meshes[m].box, sizeof boxes[m]);
    }
    if (made) {
        bound_clips(scene, pose, (const float(*)[6])boxes);
    }
    dip_motion_pose_destroy(&pose);
    free(boxes);
    return made ||
           dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "motion", "no memory for moving meshes");
}

// Marks the colour textures as compressible. Other textures are never compressed: BC1 would dent
// normals, displace clouds and put steps into a light map.
static void mark_compressible(const DipSceneDef *def, DipScene *scene) {
    for (int i = 0; i < def->material_count; i++) {
        const DipMaterialDef *material = &def->materials[i];
        if (material->colour_texture != DIP_NO_TEXTURE && material->surface != DIP_SURFACE_SKY) {
            scene->compressible[material->colour_texture] = true;
        }
    }
}

// Surfaces without light of any kind, such as backdrops, cast no shadow.
static bool casts(const DipMaterialDef *material) {
    return (material->surface == DIP_SURFACE_OPAQUE || material->surface == DIP_SURFACE_CLIPPED) &&
           (material->lit || material->light_map != DIP_NO_TEXTURE);
}

static void copy_materials(const DipSceneDef *def, DipScene *scene) {
    for (int i = 0; i < def->material_count; i++) {
        const DipMaterialDef *material = &def->materials[i];
        scene->materials[i] = (DipSceneMaterial){
            .surface = material->surface,
            .blended = dip_material_is_blended(material),
            .colour_texture = material->colour_texture,
            .light_map = material->light_map,
            .normal_map =
                dip_material_draws_normal_map(material) ? material->normal_map : DIP_NO_TEXTURE,
            .pbr = dip_pbr_maps(material),
            .double_sided = material->double_sided,
            .casts = casts(material),
        };
        scene->has_light_map |= material->light_map != DIP_NO_TEXTURE;
        scene->has_clipped |= material->surface == DIP_SURFACE_CLIPPED;
    }
}

static DipScene *allocate_scene(const DipSceneDef *def) {
    static atomic_uint_fast64_t serial;
    DipScene *scene = calloc(1, sizeof *scene);
    if (!scene) {
        return NULL;
    }
    scene->serial = atomic_fetch_add(&serial, 1) + 1;
    scene->texture_count = def->texture_count;
    scene->material_count = def->material_count;
    scene->mesh_count = def->mesh_count;
    scene->object_count = def->object_count;
    scene->near_m = def->near_m;
    scene->sky = def->sky;
    memcpy(scene->background_lin, def->background_lin, sizeof scene->background_lin);
    scene->textures = calloc((size_t)def->texture_count + 1, sizeof *scene->textures);
    scene->compressible = calloc((size_t)def->texture_count + 1, sizeof *scene->compressible);
    scene->late = dip_late_textures_create();
    scene->materials = calloc((size_t)def->material_count + 1, sizeof *scene->materials);
    scene->meshes = calloc((size_t)def->mesh_count + 1, sizeof *scene->meshes);
    scene->objects = calloc((size_t)def->object_count + 1, sizeof *scene->objects);
    scene->lighting = def->lighting ? dip_scene_lighting_create(def->lighting) : NULL;
    if (def->motion) {
        scene->motion = dip_motion_copy(def);
        scene->moving_rows =
            calloc((size_t)def->motion->mesh_count + 1, sizeof *scene->moving_rows);
    }
    const bool moves = scene->motion && scene->moving_rows;
    if (!scene->textures || !scene->compressible || !scene->late || !scene->materials ||
        !scene->meshes || !scene->objects || (def->lighting && !scene->lighting) ||
        (def->motion && !moves)) {
        dip_scene_destroy(&scene);
    }
    return scene;
}

// Creates a scene from a valid description whose blended meshes are cut.
static DipScene *create_scene(const DipSceneDef *def, DipPool *pool, DipError *err) {
    DipScene *scene = allocate_scene(def);
    if (!scene) {
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "scene", "out of memory");
        return NULL;
    }
    const int64_t begin_ns = dip_clock_ns();
    if (!dip_scene_pbr_create(def, pool, &scene->pbr, err)) {
        dip_scene_destroy(&scene);
        return NULL;
    }
    copy_materials(def, scene);
    mark_compressible(def, scene);
    bool made = create_textures(def, scene, pool, err);
    const int64_t textured_ns = dip_clock_ns();
    for (int i = 0; made && i < def->mesh_count; i++) {
        made = create_mesh(def, i, scene, err);
    }
    if (!made || !place_objects(def, scene, err) || !bound_motion(scene, err)) {
        dip_scene_destroy(&scene);
        return NULL;
    }
    add_effect_bytes(scene);
    scene->times = (DipSceneTimes){1e-6 * (double)(textured_ns - begin_ns),
                                   1e-6 * (double)(dip_clock_ns() - textured_ns)};
    return scene;
}

DipScene *dip_scene_create(const DipSceneDef *def, DipPool *pool, DipError *err) {
    DIP_FP_MODE_SCOPE();
    DipCutScene *cut;
    if (!dip_scene_check(def, err) || !dip_blended_cut(def, &cut, err)) {
        return NULL;
    }
    DipScene *scene = create_scene(cut ? dip_cut_scene_def(cut) : def, pool, err);
    dip_cut_scene_destroy(&cut);
    return scene;
}

void dip_scene_destroy(DipScene **scene_pointer) {
    DipScene *scene = *scene_pointer;
    if (!scene) {
        return;
    }
    dip_late_textures_destroy(&scene->late);
    for (int i = 0; scene->textures && i < scene->texture_count; i++) {
        dip_texture_destroy(&scene->textures[i]);
    }
    for (int i = 0; scene->meshes && i < scene->mesh_count; i++) {
        dip_mesh_destroy(&scene->meshes[i].mesh);
    }
    free(scene->textures);
    free(scene->compressible);
    free(scene->materials);
    free(scene->meshes);
    free(scene->objects);
    free(scene->lighting);
    for (int i = 0; scene->motion && scene->moving_rows && i < scene->motion->mesh_count; i++) {
        free(scene->moving_rows[i]);
    }
    free(scene->moving_rows);
    dip_motion_free(&scene->motion);
    dip_scene_pbr_destroy(&scene->pbr);
    free(scene);
    *scene_pointer = NULL;
}

void dip_scene_bounds(const DipScene *scene, float min_world[3], float max_world[3]) {
    memcpy(min_world, scene->min_world, sizeof scene->min_world);
    memcpy(max_world, scene->max_world, sizeof scene->max_world);
}

DipSceneTimes dip_scene_times(const DipScene *scene) {
    return scene->times;
}

bool dip_scene_moves(const DipScene *scene) {
    DIP_FP_MODE_SCOPE();
    const bool drifts = scene->has_sky && (scene->sky.layers[0].speed_per_min != 0.0 ||
                                           scene->sky.layers[1].speed_per_min != 0.0);
    return drifts || (scene->motion && dip_motion_plays(scene->motion));
}

bool dip_scene_water_level(const DipScene *scene, double *level_m) {
    *level_m = scene->water_level;
    return scene->has_water;
}

bool dip_scene_has_shadows(const DipScene *scene) {
    return scene->lighting && scene->lighting->shadow_light >= 0 && scene->has_lit &&
           scene->has_caster;
}

uint64_t dip_scene_triangle_count(const DipScene *scene) {
    return scene->triangle_count;
}

bool dip_scene_compress_textures(const DipScene *scene, DipPool *pool, DipError *err) {
    DIP_FP_MODE_SCOPE();
    return dip_late_textures_make(scene->late, scene->textures, scene->compressible,
                                  scene->texture_count, pool, err);
}

uint64_t dip_scene_texture_bytes(const DipScene *scene) {
    uint64_t bytes = 0;
    for (int i = 0; i < scene->texture_count; i++) {
        bytes += dip_texture_colour_bytes(scene->textures[i]) +
                 dip_texture_alpha_bytes(scene->textures[i]);
        // A compressed texture shares the alpha of its original.
        bytes += dip_texture_colour_bytes(dip_late_texture(scene->late, i));
    }
    return bytes;
}
