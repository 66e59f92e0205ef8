// Moves a scene to a time: places its moving objects, and computes the vertices of its moving
// meshes.
#include "renderer/scene/resources/posed.h"

#include "renderer/pipeline/cull.h"
#include "renderer/scene/resources/placement.h"
#include "renderer/scene/resources/scene_layout.h"

#include <stdlib.h>
#include <string.h>

enum { PART_VERTICES = 1536 }; // Vertices of a task for the pool; a multiple of 3.

// Some vertices of a moving mesh.
typedef struct Part {
    int moving;
    uint32_t first;
    uint32_t count;
} Part;

struct DipPosedScene {
    // A copy of the scene with objects, meshes and rows of its own. Everything else is the scene's.
    DipScene scene;
    DipMotionPose *pose;
    float **rows;     // For each moving mesh, the rows of its attributes.
    DipMesh **copies; // For each moving mesh, the mesh that changes.
    int moving_count;
    Part *parts;
    int part_count;
};

int dip_moving_mesh(const DipMotionDef *motion, int mesh) {
    int low = 0;
    int high = motion ? motion->mesh_count : 0;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (motion->meshes[middle].mesh < mesh) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return motion && low < motion->mesh_count && motion->meshes[low].mesh == mesh ? low : -1;
}

// --- creating and destroying ---------------------------------------------------------------------

static void *copy_array(const void *from, size_t size_bytes) {
    void *copy = malloc(size_bytes + 1);
    if (copy && size_bytes) {
        memcpy(copy, from, size_bytes);
    }
    return copy;
}

// Gives a moving mesh a copy that can be changed.
static bool copy_mesh(DipPosedScene *posed, const DipScene *scene, int moving) {
    const DipMovingMesh *def = &scene->motion->meshes[moving];
    const DipSceneMesh *mesh = &scene->meshes[def->mesh];
    const size_t row = (size_t)mesh->attribute_count * sizeof(float);
    posed->rows[moving] = copy_array(scene->moving_rows[moving], row * def->vertex_count);
    DipMesh *copy = dip_mesh_copy(mesh->mesh);
    posed->copies[moving] = copy;
    posed->scene.meshes[def->mesh].mesh = copy;
    return posed->rows[moving] && copy;
}

static bool divide(DipPosedScene *posed) {
    const DipMotionDef *motion = posed->scene.motion;
    size_t count = 0;
    for (int m = 0; m < motion->mesh_count; m++) {
        count += motion->meshes[m].vertex_count / PART_VERTICES + 1;
    }
    posed->parts = calloc(count + 1, sizeof *posed->parts);
    for (int m = 0; posed->parts && m < motion->mesh_count; m++) {
        const uint32_t vertices = motion->meshes[m].vertex_count;
        for (uint32_t first = 0; first < vertices; first += PART_VERTICES) {
            const uint32_t left = vertices - first;
            posed->parts[posed->part_count++] =
                (Part){m, first, left < PART_VERTICES ? left : PART_VERTICES};
        }
    }
    return posed->parts != NULL;
}

static bool make(DipPosedScene *posed, const DipScene *scene) {
    const size_t meshes = (size_t)scene->mesh_count;
    const size_t moving = (size_t)scene->motion->mesh_count;
    posed->moving_count = scene->motion->mesh_count;
    posed->scene.meshes = copy_array(scene->meshes, meshes * sizeof *scene->meshes);
    posed->scene.objects =
        copy_array(scene->objects, (size_t)scene->object_count * sizeof *scene->objects);
    posed->pose = dip_motion_pose_create(scene->motion);
    posed->rows = calloc(moving + 1, sizeof *posed->rows);
    posed->copies = calloc(moving + 1, sizeof *posed->copies);
    bool made = posed->scene.meshes && posed->scene.objects && posed->pose && posed->rows &&
                posed->copies && divide(posed);
    for (int m = 0; made && m < scene->motion->mesh_count; m++) {
        made = copy_mesh(posed, scene, m);
    }
    return made;
}

DipPosedScene *dip_posed_scene_create(const DipScene *scene, DipError *err) {
    DipPosedScene *posed = calloc(1, sizeof *posed);
    if (posed) {
        posed->scene = *scene;
        posed->scene.meshes = NULL;
        posed->scene.objects = NULL;
    }
    if (!posed || !make(posed, scene)) {
        dip_posed_scene_destroy(&posed);
        dip_error_set(err, DIP_ERROR_MEMORY, NULL, 0, "motion", "no memory for moving meshes");
    }
    return posed;
}

void dip_posed_scene_destroy(DipPosedScene **posed_pointer) {
    DipPosedScene *posed = *posed_pointer;
    if (!posed) {
        return;
    }
    for (int m = 0; posed->rows && posed->copies && m < posed->moving_count; m++) {
        free(posed->rows[m]);
        dip_mesh_destroy(&posed->copies[m]);
    }
    free(posed->rows);
    free(posed->copies);
    free(posed->parts);
    free(posed->scene.meshes);
    free(posed->scene.objects);
    dip_motion_pose_destroy(&posed->pose);
    free(posed);
    *posed_pointer = NULL;
}

// --- moving --------------------------------------------------------------------------------------

static const DipSceneMesh *mesh_of(const DipPosedScene *posed, int moving) {
    return &posed->scene.meshes[posed->scene.motion->meshes[moving].mesh];
}

static void pose_part(void *context, int index, int worker) {
    (void)worker;
    const DipPosedScene *posed = context;
    const Part *part = &posed->parts[index];
    const DipSceneMesh *mesh = mesh_of(posed, part->moving);
    const size_t stride = (size_t)mesh->attribute_count;
    float *rows = posed->rows[part->moving] + stride * part->first;
    float *normals =
        mesh->normal_attribute == DIP_ABSENT ? NULL : rows + (size_t)mesh->normal_attribute;
    dip_motion_pose_vertices(posed->pose, part->moving, part->first, part->count, stride, rows,
                             normals);
}

// Gives a mesh its new vertices. This cannot fail: the mesh can be changed, and its positions are
// finite.
static void update_mesh(void *context, int index, int worker) {
    (void)worker;
    const DipPosedScene *posed = context;
    dip_mesh_update(posed->copies[index], posed->rows[index], NULL);
}

static void place_objects(DipPosedScene *posed) {
    const DipMotionDef *motion = posed->scene.motion;
    for (int o = 0; o < motion->object_count; o++) {
        float transform[12];
        dip_motion_pose_transform(posed->pose, o, transform);
        dip_scene_object_place(&posed->scene.objects[motion->objects[o].object], transform);
    }
    for (int i = 0; i < posed->scene.object_count; i++) {
        DipSceneObject *object = &posed->scene.objects[i];
        const DipBox box = dip_mesh_box(posed->scene.meshes[object->mesh].mesh);
        object->bounds = dip_cull_transform_box(object->transform, &box);
    }
}

// Moves the scene to the time of its pose.
static void follow_pose(DipPosedScene *posed, DipPool *pool) {
    dip_pool_run(pool, posed->part_count, pose_part, posed);
    dip_pool_run(pool, posed->moving_count, update_mesh, posed);
    place_objects(posed);
}

const DipScene *dip_posed_scene_at(DipPosedScene *posed, int64_t time_ns, DipPool *pool) {
    dip_motion_pose_set(posed->pose, time_ns);
    follow_pose(posed, pool);
    return &posed->scene;
}
